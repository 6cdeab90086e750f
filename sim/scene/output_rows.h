/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the tables of keys of outputs are made of, each in a file of its own or in output_options.c. */
#ifndef BEADREEL_SIM_SCENE_OUTPUT_ROWS_H
#define BEADREEL_SIM_SCENE_OUTPUT_ROWS_H

#include "sim/scene/scene_output.h"

#define BEAD_OF_OUTPUT(member) offsetof(struct bead_output, member)

/* The first row of a kind: its key has the file as its value. */
#define BEAD_FILE_ROW(name, files, sample)                                                                                         \
    {                                                                                                                              \
        .key = name, .type = BEAD_OPTION_CUSTOM, .required = true, .shape = files, .example = sample,                              \
        .help = "name of the file, or a list of names for the same contents", .like = "text|[text]", .read = bead_output_read_path \
    }

/* The names of all views, for the shape of a value: "beads, profile, ". */
#define BEAD_VIEW_LISTED(ID, view, ...) #view ", "
#define BEAD_VIEWS_LISTED               BEAD_VIEWS(BEAD_VIEW_LISTED)

/* Rows that kinds share. What of the chains: */
extern const struct bead_option bead_field_row[1], bead_time_row[1], bead_beads_row[1], bead_every_row[1], bead_trust_row[1];
/* Of curves and their numbers; of sweeps: */
extern const struct bead_option bead_curves_rows[3], bead_threshold_row[1];
/* How it looks: style, dpi, size; colours of the paper; text below; and of values as colours. */
#define BEAD_COLORMAP_SHAPE "a name, a text file such as mine.txt, or colours such as \"#000000 #ff8000 #ffffff\""
extern const struct bead_option bead_page_rows[4], bead_theme_rows[3], bead_caption_row[1], bead_colormap_row[1],
    bead_square_root_row[1], bead_range_row[1], bead_magnify_row[1], bead_axes_row[1], bead_orientation_row[1];

#endif
