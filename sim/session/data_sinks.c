/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of the sinks of the computing half, which both programs hand to sessions: a word for each. */
#include <stddef.h>

#include "beadreel/sink.h"

/* `const struct bead_sink_type bead_NAME_sink` of sim/output and sim/sweep */
#define SINKS(SINK) SINK(trajectory), SINK(table), SINK(sweep_table), SINK(sweep_results)

#define SINK_NAME(name) bead_##name##_sink
extern const struct bead_sink_type SINKS(SINK_NAME);
#define SINK_AT(name) &bead_##name##_sink
static const struct bead_sink_type *const sinks[] = {SINKS(SINK_AT), NULL};

const struct bead_sink_type *const *bead_data_sinks(void)
{
    return sinks;
}
