/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of everything that draws: one line for each kind of output. */
#include "beadreel/render.h"
#include "render/figure/contact_sheet.h"
#include "render/figure/still.h"
#include "render/figure/sweep_image.h"
#include "render/movie/film.h"
#include "render/plot/sweep_plot.h"
#include "render/report/report.h"

static const struct bead_sink_type *const sinks[] = {
    &bead_image_sink,
    &bead_plot_sink,
    &bead_frame_sink, /* before that of all frames: the first that fits is taken */
    &bead_movie_sink,
    &bead_report_sink,
    &bead_sweep_plot_sink,
    &bead_contact_sheet_sink,
    &bead_sweep_image_sink,
    &bead_report_sweep_sink,
    NULL,
};

const struct bead_sink_type *const *bead_render_sinks(void)
{
    return sinks;
}
