/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Entry to graphs: draws one into a picture, or writes it to a file. */
#include <math.h>

#include "render/draw/markup.h"
#include "render/encode/page.h"
#include "render/plot/graph_private.h"
#include "sim/base/memory.h"
#include "sim/kinds/output_kinds.h"

enum bead_error bead_graph_draw(const struct bead_graph *graph, const struct bead_look *look, cairo_t *cr, double width,
                                double height, struct bead_message *msg)
{
    struct graph_layout layout;
    BEAD_TRY(graph_layout_make(graph, look, width, height, NULL, &layout, msg));
    cairo_save(cr);
    enum bead_error err = graph_draw_all(cr, &layout, msg);
    cairo_restore(cr);
    graph_layout_free(&layout);
    BEAD_TRY(err);
    cairo_status_t status = cairo_status(cr);
    return status ? bead_fail(msg, BEAD_ERROR_MEMORY, "graph: %s", cairo_status_to_string(status)) : BEAD_OK;
}

/* A graph on its page. */
struct job {
    struct bead_graph graph;
    const struct bead_output *output;
    struct bead_page page;
    struct bead_look look;
    char title[2048], size[BEAD_SIZE_WORDS];
};

static enum bead_error prepare(const struct bead_graph *graph, const struct bead_output *output, const struct bead_scene *scene,
                               struct job *job, struct bead_message *msg)
{
    job->graph = *graph;
    job->output = output;
    job->title[0] = '\0';
    BEAD_TRY(bead_page_find(output, &job->page, msg));
    if (bead_page_titled(&job->page))
        bead_markup_quote(scene->title, job->title, sizeof job->title);
    job->graph.title = job->title;
    job->graph.caption = output->still.caption;
    job->graph.size = bead_page_size(&job->page, job->size);
    bead_page_look(&job->page, &output->paper, &job->look);
    return BEAD_OK;
}

static enum bead_error graph_draw(void *context, cairo_t *cr, struct bead_message *msg)
{
    const struct job *job = context;
    struct bead_message why = {""};
    return bead_output_tell(job->output, bead_graph_draw(&job->graph, &job->look, cr, job->page.width, job->page.height, &why),
                            &why, msg);
}

/* Ends that are not known yet: numbers of one digit, or like the end that is known. */
static void assume_ends(struct bead_graph_axis *axis)
{
    if (isnan(axis->low))
        axis->low = isnan(axis->high) ? 1 : axis->high > 0 ? axis->high / 9 : axis->high - 8;
    if (isnan(axis->high))
        axis->high = axis->low > 0 ? 9 * axis->low : axis->low + 8;
}

enum bead_error bead_graph_check(const struct bead_graph *graph, const struct bead_output *output, const struct bead_scene *scene,
                                 struct bead_message *msg)
{
    struct job job;
    struct graph_layout layout;
    struct bead_message why = {""};
    BEAD_FREED struct bead_panel *panels = NULL;
    BEAD_TRY(prepare(graph, output, scene, &job, msg));
    BEAD_TRY(bead_new(&panels, graph->panel_count, msg, "a plot"));
    for (size_t i = 0; i < graph->panel_count; i++) {
        panels[i] = (struct bead_panel){.title = graph->panels[i].title, .x = graph->panels[i].x, .y = graph->panels[i].y};
        assume_ends(&panels[i].x);
        assume_ends(&panels[i].y);
    }
    job.graph.panels = panels;
    const enum bead_error err = graph_layout_make(&job.graph, &job.look, job.page.width, job.page.height, NULL, &layout, &why);
    if (!err)
        graph_layout_free(&layout);
    return bead_output_tell(output, err, &why, msg);
}

/* Text without its markup. */
static void plain(const char *text, char *out, size_t size)
{
    size_t used = 0;
    for (; *text && used + 1 < size; text++) {
        if (!strchr("*_^{}", *text))
            out[used++] = *text;
    }
    out[used] = '\0';
}

/* "peak force: ordered, M = 1.0: 40 N to 84 N, most at contact 0; ...", for those who cannot see the curves. */
static void tell(const struct bead_graph *graph, char *out, size_t size)
{
    size_t used = 0;
    const char *axis = "";
    for (size_t p = 0; p < graph->panel_count; p++) {
        const struct bead_panel *panel = &graph->panels[p];
        for (size_t s = 0; s < panel->series_count && used + 1 < size; s++) {
            const struct bead_series *series = &panel->series[s];
            char label[160], y[96], x[96], least[48], most[48], at[48];
            double low = INFINITY, high = -INFINITY, where = NAN;
            for (size_t i = 0; i < series->count; i++) {
                where = series->y[i] > high ? series->x[i] : where;
                high = fmax(high, series->y[i]);
                low = fmin(low, series->y[i]);
            }
            if (series->faint || !(low <= high))
                continue;
            low = fabs(low) < 1e-6 * fabs(high) ? 0 : low;
            plain(series->label ? series->label : panel->title ? panel->title : "", label, sizeof label);
            plain(panel->y.title, y, sizeof y);
            plain(panel->x.title, x, sizeof x);
            bead_quantity(low, panel->y.unit, 3, least, sizeof least);
            bead_quantity(high, panel->y.unit, 3, most, sizeof most);
            bead_quantity(where, strcmp(panel->x.unit, "1") == 0 ? "" : panel->x.unit, 3, at, sizeof at);
            used += (size_t)snprintf(out + used, size - used, "%s%s%s%s%s%s to %s, most at %s %s", used ? "; " : "",
                                     axis == panel->y.title ? "" : y, axis == panel->y.title ? "" : ": ", label, *label ? ": " : "",
                                     least, most, x, at);
            axis = panel->y.title;
        }
    }
}

enum bead_error bead_graph_write(const struct bead_graph *graph, const struct bead_output *output, const struct bead_scene *scene,
                                 const char *path, uint64_t *bytes, struct bead_message *msg)
{
    struct job job;
    char tale[BEAD_DESCRIPTION / 2] = "";
    BEAD_TRY(prepare(graph, output, scene, &job, msg));
    tell(graph, tale, sizeof tale);
    return bead_page_write(&job.page, output, scene, &(struct bead_drawing){graph_draw, NULL, &job, tale}, path, bytes, msg);
}
