/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of output `trajectory`: its table of keys, readers and checks. */
#include <stdlib.h>
#include <string.h>

#include "sim/kinds/outputs.h"

/* The file beside "run.h5" is "run.xdmf"; its readers take text after a colon for the name of a dataset. */
static BEAD_OPTION_READER(read_xdmf)
{
    struct bead_output *output = settings;
    static const char ending[] = ".xdmf";
    bool asked = false;
    BEAD_TRY(bead_read_flag(reader, at, &asked));
    if (!asked)
        return BEAD_OK;
    const size_t length = (size_t)(strrchr(output->path, '.') - output->path);
    if (strchr(output->path, ':'))
        return bead_wrong(reader, at, "cannot name a file with a colon: rename the trajectory");
    output->trajectory.xdmf = malloc(length + sizeof ending);
    if (!output->trajectory.xdmf)
        return bead_no_memory(reader);
    memcpy(output->trajectory.xdmf, output->path, length);
    memcpy(output->trajectory.xdmf + length, ending, sizeof ending);
    return BEAD_OK;
}

#define FIELD_LISTED(id, name, unit, title, place) name ", "
#define FIELDS                                     BEAD_FIELDS(FIELD_LISTED)

static const struct bead_option trajectory_rows[] = {
    BEAD_FILE_ROW("trajectory", "FILE.h5", "run.h5"),
    {"fields", BEAD_OPTION_CUSTOM, .initial = "[displacement, velocity, force]", .shape = "a list of " FIELDS "or all",
     .like = "all|[text]", .read = bead_output_read_fields, .help = "the fields to store; strain: of fput and shock",
     .example = "[displacement, force]"},
    {"uncertainty", BEAD_OPTION_FLAG, BEAD_OF_OUTPUT(curves.uncertainty), .initial = "false",
     .help = "how far the samples of each field may be off, chain by chain, in the group `/parameters/beadreel/uncertainty`: five "
             "times the largest difference to a run with a hundredth of the tolerance (equations: a tenth), which takes as long "
             "again or longer",
     .example = "true"},
    {"xdmf", BEAD_OPTION_CUSTOM, .initial = "false", .shape = "true or false", .like = "flag", .read = read_xdmf,
     .help = "an .xdmf file beside it, with which ParaView (its XDMF Reader) opens it: beads where they are, at each time",
     .example = "true"},
};
static const struct bead_option_rows trajectory_shared[] = {
    {BEAD_OPTIONS(bead_time_row)}, {BEAD_OPTIONS(bead_beads_row)}, {BEAD_OPTIONS(bead_every_row)}, {NULL, 0}};
static const struct bead_options trajectory_options = {"trajectory", "samples of fields in an H5MD file",
                                                       BEAD_OPTIONS(trajectory_rows), trajectory_shared, &bead_output_family};

static BEAD_OUTPUT_CHECK(check_xdmf)
{
    if (!output->trajectory.xdmf)
        return BEAD_OK;
    if (!bead_scene_has_beads(reader->scene))
        return BEAD_WRONG_KEY(reader, at, "xdmf", "tells where beads are, but there are none in this scene");
    if (!(output->trajectory.fields & BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT)))
        return BEAD_WRONG_KEY(reader, at, "xdmf", "tells where beads are: add displacement to `fields`");
    return BEAD_OK;
}

const struct bead_output_type bead_trajectory_output = {
    .options = &trajectory_options,
    .checks = {bead_output_check_field_list, check_xdmf, bead_output_check_times},
    .stores_samples = true};
