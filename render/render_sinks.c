#include "beadreel/render.h"
#include "render/sinks.h"

static const struct bead_sink_type *const sinks[] = {
#if __has_include("render/image.c")
    &bead_image_sink,
#endif
#if __has_include("render/plot.c")
    &bead_plot_sink,
#endif
#if __has_include("render/movie_sink.c")
    &bead_movie_sink,
#endif
    NULL,
};

const struct bead_sink_type *const *bead_render_sinks(void)
{
    return sinks;
}
