/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kinds of outputs that there are, one row each, in the order of --list keys. Of kinds that files may end alike, `-o FILE`
 * makes the first.
 *
 * To add a kind NAME: its row here; a file sim/kinds/output_NAME.c with its keys and a `const struct bead_output_type
 * bead_NAME_output`, which says all that sets the kind apart; and a sink that makes it, with its line in the list of sinks. */
#ifndef BEADREEL_OUTPUT_KIND_H
#define BEADREEL_OUTPUT_KIND_H

#define BEAD_OUTPUTS(OUTPUT)       \
    OUTPUT(TRAJECTORY, trajectory) \
    OUTPUT(IMAGE, image)           \
    OUTPUT(MOVIE, movie)           \
    OUTPUT(PLOT, plot)             \
    OUTPUT(TABLE, table)           \
    OUTPUT(SWEEP, sweep)           \
    OUTPUT(SHEET, sheet)           \
    OUTPUT(REPORT, report)

enum bead_output_kind {
#define BEAD_OUTPUT_ENUM(ID, name) BEAD_OUTPUT_##ID,
    BEAD_OUTPUTS(BEAD_OUTPUT_ENUM)
#undef BEAD_OUTPUT_ENUM
        BEAD_OUTPUT_KINDS,
    BEAD_OUTPUT_OWN = BEAD_OUTPUT_KINDS /* made by a sink of the program's own: bead_own in scene.h */
};

#endif
