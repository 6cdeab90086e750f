/* Sink for `plot:` outputs: curves of sensors, one plot for each chain that has some; or peaks of contacts. */
#include <math.h>
#include <stdlib.h>

#include "beadreel/file.h"
#include "render/figure.h"
#include "render/peaks_plot.h"
#include "render/sinks.h"

struct bead_sink {
    struct bead_figure *figure; /* or */
    struct bead_peaks_plot *peaks;
    struct bead_output output; /* as the scene has it, with the settings that plots do not have at rest */
    char *path;
    uint64_t bytes;
};

static void destroy(struct bead_sink *sink)
{
    if (!sink)
        return;
    bead_figure_destroy(sink->figure);
    bead_peaks_plot_destroy(sink->peaks);
    free(sink->path);
    free(sink);
}

static enum bead_error create(const struct bead_output *output, const struct bead_stage *stage, struct bead_sink **sink,
                              struct bead_message *msg)
{
    static const enum bead_view_kind views[] = {BEAD_VIEW_SENSORS};
    *sink = NULL;
    bool peaks = output->show == BEAD_SHOW_PEAKS;
    struct bead_sink *s = calloc(1, sizeof *s);
    if (!s)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a plot");
    s->output = *output;
    s->output.field = BEAD_FIELD_FORCE;
    s->output.beads = (struct bead_span){0, SIZE_MAX};
    s->output.axes = true;
    s->output.range[0] = s->output.range[1] = s->output.at = NAN;
    s->output.scale = peaks ? output->scale : BEAD_SCALE_LINEAR;
    s->output.colormap = NULL;
    enum bead_error err = bead_file_join(stage->directory, output->path, &s->path, msg);
    if (!err && peaks)
        err = bead_peaks_plot_create(&s->output, stage, &s->peaks, msg);
    else if (!err)
        err = bead_figure_create(&s->output, stage, views, 1, &s->figure, msg);
    if (err)
        destroy(s);
    else
        *sink = s;
    return err;
}

static void needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    if (sink->peaks)
        bead_peaks_plot_needs(sink->peaks, needs);
    else
        bead_figure_needs(sink->figure, needs);
}

static enum bead_error begin(struct bead_sink *sink, struct bead_range range, struct bead_message *msg)
{
    (void)sink, (void)range, (void)msg;
    return BEAD_OK;
}

static enum bead_error sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    return sink->figure ? bead_figure_feed(sink->figure, sample, msg) : BEAD_OK;
}

static enum bead_error end(struct bead_sink *sink, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    if (sink->peaks)
        return bead_peaks_plot_write(sink->peaks, outcomes, sink->path, &sink->bytes, msg);
    return bead_figure_write(sink->figure, sink->path, &sink->bytes, msg);
}

static void result(const struct bead_sink *sink, uint64_t *bytes, uint64_t *items)
{
    *bytes = sink->bytes;
    *items = 1;
}

static const char *const extensions[] = {"png", "pdf", "svg", NULL};

const struct bead_sink_type bead_plot_sink = {
    .name = "plot",
    .help = "force of sensors against time, or peaks of contacts: png, pdf, svg",
    .kind = BEAD_OUTPUT_PLOT,
    .extensions = extensions,
    .create = create,
    .needs = needs,
    .begin = begin,
    .sample = sample,
    .end = end,
    .destroy = destroy,
    .result = result,
};
