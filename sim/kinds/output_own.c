/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of outputs made by a program's own sinks: keys for the parts of the chains they get. The key of the file is the sink's
 * name: output_list.c. */
#include <string.h>

#include "beadreel/sink.h"
#include "sim/kinds/outputs.h"

static const struct bead_option file_row[] = {BEAD_FILE_ROW("own", "FILE.own", "mine.own")};
static const struct bead_option_rows shared[] = {{BEAD_OPTIONS(bead_field_row)},
                                                 {BEAD_OPTIONS(bead_time_row)},
                                                 {BEAD_OPTIONS(bead_beads_row)},
                                                 {BEAD_OPTIONS(bead_every_row)},
                                                 {NULL, 0}};
static const struct bead_options options = {"own", "made by the program", BEAD_OPTIONS(file_row), shared, &bead_output_family};

const struct bead_output_type bead_own_output = {.options = &options, .checks = {bead_output_check_field, bead_output_check_times}};

const struct bead_sink_type *bead_output_own_of(const struct bead_own *own, const char *file)
{
    const struct bead_sink_type *const *sink = own ? own->sinks : NULL;
    while (sink && *sink && !bead_output_ends_like(strchr((*sink)->endings, '.'), file))
        sink++;
    return sink ? *sink : NULL;
}
