/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stills of several panels, and images with or without a caption: made and fed. Among the kinds that still.c tries, panels are the
 * first, images the last. */
#include "render/figure/panels_private.h"

#include <stdlib.h>

#include "render/draw/markup.h"
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
