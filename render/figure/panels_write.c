/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finishes a still of several panels: the ranges are known now, and everything is drawn. */

#include "render/draw/raster.h"
#include "render/figure/panels_private.h"

/* Panels of one group have one range. */
static void set_ranges(struct bead_still *s)
{
    for (size_t p = 0; p < s->count; p++) {
        struct bead_shown_values colours = BEAD_NOTHING_SHOWN, sensors = BEAD_NOTHING_SHOWN;
        for (size_t q = 0; s->panels[p].figure && q < s->count; q++) {
            if (s->panels[q].figure && s->panels[q].group == s->panels[p].group)
                bead_figure_extremes(s->panels[q].figure, &colours, &sensors);
        }
        if (s->panels[p].figure)
            bead_figure_set_range(s->panels[p].figure, &colours, &sensors);
    }
}

static bool has_entry(const struct bead_graph *graph, const struct bead_series *wanted)
{
    for (size_t p = 0; p < graph->panel_count; p++) {
        for (size_t i = 0; i < graph->panels[p].series_count; i++) {
            const struct bead_series *series = &graph->panels[p].series[i];
            if (series->label && strcmp(series->label, wanted->label) == 0 && graph_look_alike(series, wanted))
                return true;
        }
    }
    return false;
}

static bool has_all_entries(const struct bead_graph *graph, const struct bead_graph *wanted)
{
    bool all = true;
    for (size_t p = 0; p < wanted->panel_count; p++) {
        for (size_t i = 0; all && i < wanted->panels[p].series_count; i++) {
            const struct bead_series *series = &wanted->panels[p].series[i];
            all = !series->label || has_entry(graph, series);
        }
    }
    return all;
}

/* Does an earlier panel have all entries of this one's legend? */
static bool is_explained(const struct bead_still *s, const struct still_panel *panel, const struct bead_graph *graph)
{
    bool explained = false;
    for (size_t q = 0; !explained && &s->panels[q] < panel; q++) {
        struct bead_panel plots[PANEL_PLOTS];
        if (!s->panels[q].plot)
            continue;
        struct bead_graph earlier = panel_graph(&s->panels[q], plots);
        explained = has_all_entries(&earlier, graph);
    }
    return explained;
}

static enum bead_error draw_plot(const struct bead_still *s, const struct still_panel *panel, cairo_t *cr, struct bead_message *msg)
{
    struct bead_panel plots[PANEL_PLOTS];
    struct bead_graph graph = panel_graph(panel, plots);
    struct graph_frame frame = {.least = panel->insets,
                                .letter = panel->set.letter,
                                .explained = is_explained(s, panel, &graph),
                                .no_across = panel->set.no_across};
    struct graph_layout layout;
    BEAD_TRY(graph_layout_make(&graph, &s->look, panel->area.width, panel->area.height, &frame, &layout, msg));
    cairo_save(cr);
    cairo_translate(cr, panel->area.x, panel->area.y);
    enum bead_error err = graph_draw_all(cr, &layout, msg);
    cairo_restore(cr);
    graph_layout_free(&layout);
    return err;
}

static enum bead_error panels_decorate(void *context, cairo_t *cr, struct bead_message *msg)
{
    const struct bead_still *s = context;
    bead_look_paint(&s->look, cr);
    graph_page_draw(&s->words, &s->look, cr, s->panels[0].area.x + s->panels[0].insets.left);
    int terseness = 0; /* all headings are as short as the one with the least room */
    for (size_t p = 0; p < s->count; p++) {
        const int least = s->panels[p].figure ? bead_figure_terseness(s->panels[p].figure, cr) : 0;
        terseness = least > terseness ? least : terseness;
    }
    for (size_t p = 0; p < s->count; p++) {
        if (s->panels[p].figure)
            s->panels[p].figure->set.terseness = terseness;
    }
    for (size_t p = 0; p < s->count; p++) {
        const struct still_panel *panel = &s->panels[p];
        BEAD_TRY(panel->figure ? bead_figure_decorate(panel->figure, cr, msg) : draw_plot(s, panel, cr, msg));
    }
    return bead_raster_status(cr, "figure", msg);
}

static enum bead_error draw_vector(void *context, cairo_t *cr, struct bead_message *msg)
{
    const struct bead_still *s = context;
    BEAD_TRY(panels_decorate(context, cr, msg));
    for (size_t p = 0; p < s->count; p++) {
        if (s->panels[p].figure)
            BEAD_TRY(bead_figure_vector(s->panels[p].figure, cr, msg));
    }
    return BEAD_OK;
}

static enum bead_error panels_draw_frame(void *context, struct bead_frame *frame, struct bead_message *msg)
{
    struct bead_still *s = context;
    BEAD_LEFT_TO(bead_frame_free) struct bead_frame background = {0};
    BEAD_TRY(bead_raster_draw(frame, panels_decorate, s, msg));
    bool moments = false;
    for (size_t p = 0; p < s->count; p++)
        moments = moments || (s->panels[p].figure && bead_figure_looks_at_beads(s->panels[p].output));
    if (moments) { /* only views of one moment draw over the background */
        BEAD_TRY(bead_frame_create(frame->width, frame->height, &background, msg));
        bead_frame_copy(&background, frame, (struct bead_rect){0, 0, frame->width, frame->height});
    }
    background.alpha = frame->alpha;
    for (size_t p = 0; p < s->count; p++) {
        if (s->panels[p].figure)
            BEAD_TRY(bead_figure_draw(s->panels[p].figure, frame, background.pixels ? &background : frame, msg));
    }
    return BEAD_OK;
}

static enum bead_error panels_finish(struct bead_still *s, const struct bead_outcome *outcomes, struct bead_canvas **canvas,
                                     struct bead_message *msg)
{
    set_ranges(s);
    for (size_t p = 0; p < s->count; p++) {
        struct still_panel *panel = &s->panels[p];
        if (panel->figure && bead_figure_needs_canvas(panel->figure) && !*canvas)
            BEAD_TRY(bead_canvas_create(s->context.canvas, s->page.width, s->page.height, canvas, msg));
        BEAD_TRY(panel->figure ? bead_figure_finish(panel->figure, *canvas, msg)
                               : bead_plot_data_finish(panel->plot, outcomes, msg));
    }
    return BEAD_OK;
}

enum bead_error panels_write(struct bead_still *s, const struct bead_outcome *outcomes, const char *path, uint64_t *bytes,
                             struct bead_message *msg)
{
    struct bead_canvas *canvas = NULL;
    char tale[BEAD_TALE_WORDS];
    bead_tale_words(s->tale, tale, sizeof tale);
    const struct bead_drawing drawing = {draw_vector, panels_draw_frame, s, tale};
    enum bead_error err = panels_finish(s, outcomes, &canvas, msg);
    if (canvas)
        snprintf(s->painter, sizeof s->painter, "%s", bead_canvas_painter(canvas));
    if (!err)
        err = bead_page_write(&s->page, s->output, s->context.scene, &drawing, path, bytes, msg);
    for (size_t p = 0; p < s->count; p++) {
        if (s->panels[p].figure)
            bead_figure_release(s->panels[p].figure);
    }
    bead_canvas_destroy(canvas);
    return err;
}
