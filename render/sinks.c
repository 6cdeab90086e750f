/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of everything that draws: one word for each kind of output. */
#include <stddef.h>

#include "beadreel/render.h"

/* `const struct bead_sink_type bead_NAME_sink` of the rooms. The sink of one frame of a film comes before that of all frames: the
 * first that fits is taken. */
#define SINKS(SINK)                                                                                                            \
    SINK(image), SINK(plot), SINK(frame), SINK(movie), SINK(report), SINK(sweep_plot), SINK(contact_sheet), SINK(sweep_image), \
        SINK(report_sweep)

#define SINK_NAME(name) bead_##name##_sink
extern const struct bead_sink_type SINKS(SINK_NAME);
#define SINK_AT(name) &bead_##name##_sink
static const struct bead_sink_type *const sinks[] = {SINKS(SINK_AT), NULL};

const struct bead_sink_type *const *bead_render_sinks(void)
{
    return sinks;
}
