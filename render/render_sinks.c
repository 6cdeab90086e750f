#include "beadreel/render.h"
#include "render/sinks.h"

/* Of plots the first that makes what is to be shown is taken: that of all others last. */
static const struct bead_sink_type *const sinks[] = {
    &bead_image_sink, &bead_modes_plot_sink, &bead_profiles_plot_sink, &bead_plot_sink, &bead_movie_sink, NULL,
};

const struct bead_sink_type *const *bead_render_sinks(void)
{
    return sinks;
}
