/* Sinks for `image:` and `plot:` outputs: bare pixels, a figure, a plot, a drawing, or a sheet of several. */
#include <math.h>
#include <stdlib.h>

#include "beadreel/file.h"
#include "render/figure/bare_image.h"
#include "render/figure/figure.h"
#include "render/figure/sheet.h"
#include "render/figure/still.h"
#include "render/plot/plot_data.h"
#include "render/schematic/schematic.h"

struct bead_sink {
    const struct bead_output *output;
    struct bead_run_context context;
    struct bead_page page;
    /* One of these, or none: a drawing */
    struct bead_bare_image *bare;
    struct bead_figure *figure;
    struct bead_plot_data *plot;
    struct bead_sheet *sheet;
    char *path;
    uint64_t bytes;
};

static void destroy(struct bead_sink *sink)
{
    if (!sink)
        return;
    bead_bare_image_destroy(sink->bare);
    bead_figure_destroy(sink->figure);
    bead_plot_data_destroy(sink->plot);
    bead_sheet_destroy(sink->sheet);
    free(sink->path);
    free(sink);
}

static enum bead_error create_content(struct bead_sink *s, struct bead_message *msg)
{
    const struct bead_output *output = s->output;
    bool bare = !output->axes && output->view_count == 1 && bead_views_any(output->views, 1, BEAD_SHOWS_IMAGE);
    if (bead_sheet_wanted(output))
        return bead_sheet_create(output, &s->context, &s->sheet, msg);
    if (output->kind == BEAD_OUTPUT_PLOT && bead_schematic_is(output->show))
        return bead_schematic_check(output, &s->context, msg);
    if (output->kind == BEAD_OUTPUT_PLOT)
        return bead_plot_data_create(output, &s->context, SIZE_MAX, &s->plot, msg);
    if (bare)
        return bead_bare_image_create(output, &s->context, &s->bare, msg);
    return bead_figure_create(output, &s->context, output->views, output->view_count, &s->figure, msg);
}

static enum bead_error create(const struct bead_output *output, const struct bead_run_context *context, struct bead_sink **sink,
                              struct bead_message *msg)
{
    struct bead_sink *s = *sink = calloc(1, sizeof *s);
    if (!s)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a picture");
    s->output = output;
    s->context = *context;
    enum bead_error err = bead_file_join(context->directory, output->path, &s->path, msg);
    if (!err)
        err = bead_page_find(output, context->scene->file, &s->page, msg);
    if (!err)
        err = create_content(s, msg);
    if (err) {
        destroy(s);
        *sink = NULL;
    }
    return err;
}

static void needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    *needs = (struct bead_needs){.why = "a drawing of the scene; nothing is computed for it"};
    if (sink->sheet)
        bead_sheet_needs(sink->sheet, needs);
    else if (sink->plot)
        bead_plot_data_needs(sink->plot, needs);
    else if (sink->figure)
        bead_figure_needs(sink->figure, needs);
    else if (sink->bare)
        bead_bare_image_needs(sink->bare, needs);
}

static enum bead_error begin(struct bead_sink *sink, struct bead_range range, struct bead_message *msg)
{
    (void)sink, (void)range, (void)msg;
    return BEAD_OK;
}

static enum bead_error sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    if (sink->sheet)
        return bead_sheet_feed(sink->sheet, sample, msg);
    if (sink->plot)
        return bead_plot_data_feed(sink->plot, sample, msg);
    if (sink->figure)
        return bead_figure_feed(sink->figure, sample, msg);
    return sink->bare ? bead_bare_image_feed(sink->bare, sample, msg) : BEAD_OK;
}

static enum bead_error end(struct bead_sink *sink, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    if (sink->sheet)
        return bead_sheet_write(sink->sheet, outcomes, sink->path, &sink->bytes, msg);
    if (sink->plot)
        return bead_plot_data_write(sink->plot, outcomes, &sink->page, sink->path, &sink->bytes, msg);
    if (sink->figure)
        return bead_figure_write(sink->figure, sink->path, &sink->bytes, msg);
    return sink->bare ? bead_bare_image_write(sink->bare, sink->path, &sink->bytes, msg)
                      : bead_schematic_write(sink->output, &sink->context, sink->path, &sink->bytes, msg);
}

static void result(const struct bead_sink *sink, uint64_t *bytes, uint64_t *items)
{
    *bytes = sink->bytes;
    *items = 1;
}

#define STILL(title, words, of)                                                                                          \
    {                                                                                                                    \
        .name = title, .help = words, .kind = of, .extensions = bead_still_extensions, .create = create, .needs = needs, \
        .begin = begin, .sample = sample, .end = end, .destroy = destroy, .result = result                               \
    }

const struct bead_sink_type bead_image_sink =
    STILL("image", "space-time image or a still of other views: png, pdf, svg", BEAD_OUTPUT_IMAGE);
const struct bead_sink_type bead_plot_sink =
    STILL("plot", "sensors, peaks, modes, profiles, or schematic drawings: png, pdf, svg", BEAD_OUTPUT_PLOT);
