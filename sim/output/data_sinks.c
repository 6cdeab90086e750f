/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of the sinks of this room, which both programs hand to sessions. */
#include "sim/output/data_sinks.h"

#include <stddef.h>

#define SINK_LISTED(name) &bead_##name##_sink,
static const struct bead_sink_type *const sinks[] = {BEAD_DATA_SINKS(SINK_LISTED) NULL};

const struct bead_sink_type *const *bead_data_sinks(void)
{
    return sinks;
}
