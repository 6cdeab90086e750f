/* The list of the sinks of this room, which both programs hand to sessions. */
#include "sim/output/data_sinks.h"

#include <stddef.h>

static const struct bead_sink_type *const sinks[] = {&bead_trajectory_sink, &bead_table_sink, NULL};

const struct bead_sink_type *const *bead_data_sinks(void)
{
    return sinks;
}
