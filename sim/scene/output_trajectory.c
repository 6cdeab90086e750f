/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of output `trajectory`: its table of keys. */
#include "sim/scene/output_rows.h"

#define FIELD_LISTED(id, name, unit, title, place) name ", "
#define FIELDS                                     BEAD_FIELDS(FIELD_LISTED)

static const struct bead_option trajectory_rows[] = {
    BEAD_FILE_ROW("trajectory", "FILE.h5", "run.h5"),
    {.key = "fields",
     .type = BEAD_OPTION_CUSTOM,
     .initial = "[displacement, velocity, force]",
     .shape = "a list of " FIELDS "or all",
     .help = "the fields to store; strain: of fput and shock",
     .example = "[displacement, force]",
     .like = "all|[text]",
     .read = bead_output_read_fields},
    {.key = "xdmf",
     .type = BEAD_OPTION_CUSTOM,
     .initial = "false",
     .shape = "true or false",
     .help = "an .xdmf file beside it, by which ParaView (its XDMF Reader) opens it: beads where they are, at each time",
     .example = "true",
     .like = "flag",
     .read = bead_output_read_xdmf},
};
static const struct bead_option_rows trajectory_shared[] = {
    {BEAD_OPTIONS(bead_time_row)}, {BEAD_OPTIONS(bead_beads_row)}, {BEAD_OPTIONS(bead_every_row)}, {NULL, 0}};
static const struct bead_options trajectory_options = {"trajectory", "samples of fields in an H5MD file",
                                                       BEAD_OPTIONS(trajectory_rows), trajectory_shared, &bead_output_family};
const struct bead_output_type bead_trajectory_output = {
    .options = &trajectory_options,
    .checks = {bead_output_check_field_list, bead_output_check_xdmf, bead_output_check_times},
    .stores_samples = true};
