/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stills of several panels, and images with or without a caption: made, fed and drawn. Among the kinds that still.c tries, panels
 * are the first, images the last. */
#include "render/figure/panels_private.h"

#include <stdlib.h>

#include "render/draw/markup.h"
#include "render/draw/raster.h"
#include "sim/base/memory.h"

static bool panels_wanted(const struct bead_output *output)
{
    return output->still.panel_count > 0 || (output->still.caption && output->views.count > 0);
}

static void panels_destroy(struct bead_still *still)
{
    for (size_t p = 0; still->panels && p < still->count; p++) {
        bead_figure_destroy(still->panels[p].figure);
        bead_plot_data_destroy(still->panels[p].plot);
    }
    bead_tale_destroy(still->tale);
    free(still->panels);
    free(still->words.title);
    free(still->words.caption);
}

/* Makes the title, only on screens, and the caption. */
static enum bead_error make_words(struct bead_still *s, struct bead_message *msg)
{
    const char *title = s->context.scene->title, *caption = s->output->still.caption;
    if (s->alone) /* a figure with the whole page has its own line for these */
        return BEAD_OK;
    if (bead_page_titled(&s->page) && *title) {
        size_t size = 6 * strlen(title) + 1;
        BEAD_TRY(bead_new(&s->words.title, size, msg, "a figure"));
        bead_text_escape(title, s->words.title, size);
    }
    if (caption && *caption)
        s->words.caption = bead_markup_new(caption);
    return !caption || !*caption || s->words.caption ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a figure");
}

static enum bead_error panels_make_panel(struct bead_still *s, size_t index, struct bead_message *msg)
{
    struct still_panel *panel = &s->panels[index];
    bool own = s->output->still.panel_count == 0; /* an image is one panel */
    panel->output = own ? s->output : &s->output->still.panels[index];
    panel->row = own ? 0 : panel->output->panel.row;
    for (size_t p = 0; p < index; p++)
        panel->column += s->panels[p].row == panel->row;
    s->rows = panel->row + 1;
    panel->set =
        (struct bead_part_settings){.chain = own ? SIZE_MAX : panel->output->panel.chain, .title = panel->output->panel.title};
    if (s->output->still.letters && s->count > 1)
        graph_letter(index, panel->set.letter, sizeof panel->set.letter);
    if (panel->output->views.count == 0)
        return bead_plot_data_create(panel->output, &s->context, panel->set.chain, &panel->plot, msg);
    const struct bead_part_settings *set = s->alone ? NULL : &panel->set;
    return bead_figure_create(panel->output, &s->context, &s->page, &s->look, set, &panel->figure, msg);
}

/* Makes one sampling grid for all panels: as fine as the finest, over all times shown. Profiles are interpolated linearly between
 * its times. */
static void join_grids(struct bead_still *s)
{
    struct bead_grid all = {.start = INFINITY, .every = INFINITY, .end = -INFINITY};
    bool profiles = false;
    size_t grids = 0;
    for (size_t p = 0; p < s->count; p++) {
        const struct bead_grid *grid = &s->panels[p].needs.grid;
        if (!(grid->every > 0))
            continue;
        all.start = fmin(all.start, grid->start);
        all.every = fmin(all.every, grid->every);
        all.end = fmax(all.end, grid->end);
        all.widens = grid->widens && (grids == 0 || all.widens);
        all.times = grids++ == 0 ? grid->times : NULL;
        all.count = grid->count;
        profiles = profiles || (s->panels[p].plot && s->panels[p].output->curves.show == BEAD_SHOW_PROFILES);
    }
    if (profiles && s->context.resolution > 0 && !(s->context.native.every > 0))
        all.every = fmin(all.every, s->context.resolution / 8);
    s->grid = all.end >= all.start ? all : (struct bead_grid){.every = 0};
    for (size_t p = 0; p < s->count; p++) {
        if (s->panels[p].figure)
            s->panels[p].figure->grid = s->grid;
    }
}

static enum bead_error start_panel(struct still_panel *panel, struct bead_message *msg)
{
    if (panel->plot) {
        bead_plot_data_needs(panel->plot, &panel->needs);
        return BEAD_OK;
    }
    BEAD_TRY(bead_figure_start(panel->figure, msg));
    bead_figure_needs(panel->figure, &panel->needs);
    return BEAD_OK;
}

static enum bead_error panels_create(const struct bead_output *output, const struct bead_run_context *context, struct bead_still *s,
                                     struct bead_message *msg)
{
    size_t count = output->still.panel_count > 0 ? output->still.panel_count : 1;
    BEAD_TRY(bead_new(&s->panels, count, msg, "a figure"));
    s->output = output;
    s->context = *context;
    s->count = count;
    s->alone = !panels_wanted(output);
    BEAD_TRY(bead_page_find(output, &s->page, msg));
    bead_page_look(&s->page, &output->paper, &s->look);
    BEAD_TRY(make_words(s, msg));
    for (size_t p = 0; p < count; p++)
        BEAD_TRY(panels_make_panel(s, p, msg));
    BEAD_TRY(panels_arrange(s, msg));
    for (size_t p = 0; p < count; p++)
        BEAD_TRY(start_panel(&s->panels[p], msg));
    join_grids(s);
    for (size_t p = 0; !s->tale && p < count; p++) {
        const struct bead_shown *shown = &s->panels[p].output->shown;
        if (s->panels[p].figure)
            BEAD_TRY(bead_tale_create(s->context.chains, s->context.chain_count, shown->field, shown->beads, &s->tale, msg));
    }
    if (s->alone)
        snprintf(s->why, sizeof s->why, "%s", s->panels[0].needs.why);
    else
        snprintf(s->why, sizeof s->why, "%d x %d pixels, %zu panel%s", s->page.width, s->page.height, count, count == 1 ? "" : "s");
    return BEAD_OK;
}

static void panels_needs(const struct bead_still *still, struct bead_needs *needs)
{
    *needs = (struct bead_needs){.beads = {SIZE_MAX, 0}, .grid = still->grid, .why = still->why};
    for (size_t p = 0; p < still->count; p++) {
        const struct bead_needs *more = &still->panels[p].needs;
        needs->fields |= more->fields;
        needs->comparison |= more->comparison;
        needs->contact_peaks = needs->contact_peaks || more->contact_peaks;
        needs->uncertainty = needs->uncertainty || more->uncertainty;
        needs->budget = needs->budget || more->budget;
        needs->until = fmax(needs->until, more->until);
        if (!more->fields)
            continue;
        needs->beads.first = more->beads.first < needs->beads.first ? more->beads.first : needs->beads.first;
        needs->beads.last = more->beads.last > needs->beads.last ? more->beads.last : needs->beads.last;
    }
    if (!needs->fields)
        needs->beads = (struct bead_span){0, 0};
}

static enum bead_error panels_feed(struct bead_still *still, const struct bead_sample *sample, struct bead_message *msg)
{
    if (still->tale)
        bead_tale_feed(still->tale, sample);
    for (size_t p = 0; p < still->count; p++) {
        struct still_panel *panel = &still->panels[p];
        const struct bead_grid *grid = &panel->needs.grid;
        double slack = 1.5 * still->grid.every; /* one sample before and after */
        if (!panel->needs.fields || sample->time < grid->start - slack || sample->time > grid->end + slack)
            continue;
        BEAD_TRY(panel->figure ? bead_figure_feed(panel->figure, sample, msg) : bead_plot_data_feed(panel->plot, sample, msg));
    }
    return BEAD_OK;
}

static const char *panels_painter(const struct bead_still *s)
{
    return s->painter;
}

static bool panels_look_at_beads(const struct bead_output *output)
{
    bool any = output->still.panel_count == 0 && (bead_figure_looks_at_beads(output) || output->shown.theory);
    for (size_t p = 0; p < output->still.panel_count; p++)
        any = any || bead_figure_looks_at_beads(&output->still.panels[p]) || output->still.panels[p].shown.theory;
    return any;
}

const struct bead_still_kind bead_panels = {
    .size = sizeof(struct bead_still),
    .wanted = panels_wanted,
    .create = panels_create,
    .looks_at_beads = panels_look_at_beads,
    .needs = panels_needs,
    .feed = panels_feed,
    .write = panels_write,
    .painter = panels_painter,
    .destroy = panels_destroy,
};

/* ---- the end: the ranges are known, and everything is drawn ---- */

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
