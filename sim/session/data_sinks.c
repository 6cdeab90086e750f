/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of the sinks of the computing half, which both programs hand to sessions: one line for each. */
#include "sim/output/data_sinks.h"

#include <stddef.h>

#include "sim/sweep/sweep_data.h"

static const struct bead_sink_type *const sinks[] = {
    &bead_trajectory_sink, &bead_table_sink, &bead_sweep_table_sink, &bead_sweep_results_sink, NULL,
};

const struct bead_sink_type *const *bead_data_sinks(void)
{
    return sinks;
}
