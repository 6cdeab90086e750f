#include "render/sinks.h"
#include "beadreel/render.h"

static const struct bead_sink_type *const sinks[] = {
    &bead_image_sink,
    &bead_plot_sink,
    &bead_movie_sink,
    NULL,
};

const struct bead_sink_type *const *bead_render_sinks(void)
{
    return sinks;
}
