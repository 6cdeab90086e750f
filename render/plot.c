/* Sink for `plot:` outputs: curves of sensors, one panel for each chain that has some; peaks of contacts; or schematic
 * drawings, which need no data. */
#include <math.h>
#include <stdlib.h>

#include "beadreel/file.h"
#include "render/markup.h"
#include "render/page.h"
#include "render/plot_data.h"
#include "render/schematic.h"
#include "render/sheet.h"
#include "render/sinks.h"

struct bead_sink {
    const struct bead_output *output;
    const struct bead_scene *scene;
    struct bead_stage stage;
    struct bead_sheet *sheet;    /* or */
    struct bead_plot_data *data; /* or, where both are NULL, a drawing */
    struct bead_page page;
    char *path;
    uint64_t bytes;
};

static void destroy(struct bead_sink *sink)
{
    if (!sink)
        return;
    bead_sheet_destroy(sink->sheet);
    bead_plot_data_destroy(sink->data);
    free(sink->path);
    free(sink);
}

static enum bead_error create(const struct bead_output *output, const struct bead_stage *stage, struct bead_sink **sink,
                              struct bead_message *msg)
{
    struct bead_sink *s = *sink = calloc(1, sizeof *s);
    if (!s)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a plot");
    s->output = output;
    s->scene = stage->scene;
    s->stage = *stage;
    enum bead_error err = bead_file_join(stage->directory, output->path, &s->path, msg);
    if (!err)
        err = bead_page_find(output, stage->scene->file, &s->page, msg);
    if (!err && bead_sheet_wanted(output))
        err = bead_sheet_create(output, stage, &s->sheet, msg);
    else if (!err && bead_schematic_is(output->show))
        err = bead_schematic_check(output, stage, msg);
    else if (!err)
        err = bead_plot_data_create(output, stage, SIZE_MAX, &s->data, msg);
    if (err) {
        destroy(s);
        *sink = NULL;
    }
    return err;
}

static void needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    if (sink->sheet)
        bead_sheet_needs(sink->sheet, needs);
    else if (sink->data)
        bead_plot_data_needs(sink->data, needs);
    else
        *needs = (struct bead_needs){.why = "a drawing of the scene; nothing is computed for it"};
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
    return !sink->data ? BEAD_OK : bead_plot_data_feed(sink->data, sample, msg);
}

static enum bead_error end(struct bead_sink *sink, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    if (sink->sheet)
        return bead_sheet_write(sink->sheet, outcomes, sink->path, &sink->bytes, msg);
    const int least = 240; /* px of height where a title is worth its room */
    char title[2048] = "";
    struct bead_graph graph = {.title = title, .caption = sink->output->caption, .share_x = true, .share_y = true};
    if (!sink->data)
        return bead_schematic_write(sink->output, &sink->stage, sink->path, &sink->bytes, msg);
    enum bead_error err = bead_plot_data_finish(sink->data, outcomes, msg);
    if (err)
        return err;
    if (!sink->page.paper && sink->page.height >= least)
        bead_markup_quote(sink->scene->title, title, sizeof title);
    graph.letters = sink->page.paper;
    graph.panels = bead_plot_data_panels(sink->data, &graph.panel_count);
    return bead_graph_write(&graph, sink->output, sink->scene, sink->path, &sink->bytes, msg);
}

static void result(const struct bead_sink *sink, uint64_t *bytes, uint64_t *items)
{
    *bytes = sink->bytes;
    *items = 1;
}

static const char *const extensions[] = {"png", "pdf", "svg", NULL};

const struct bead_sink_type bead_plot_sink = {
    .name = "plot",
    .help = "force of sensors against time, peaks of contacts, or schematic drawings: png, pdf, svg",
    .kind = BEAD_OUTPUT_PLOT,
    .shows = 1 << BEAD_SHOW_SENSORS | 1 << BEAD_SHOW_PEAKS | 1 << BEAD_SHOW_SETUP | 1 << BEAD_SHOW_CONTACT | 1 << BEAD_SHOW_CELL,
    .extensions = extensions,
    .create = create,
    .needs = needs,
    .begin = begin,
    .sample = sample,
    .end = end,
    .destroy = destroy,
    .result = result,
};
