/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The end of a figure: ranges are known, the views of one moment are created, and everything is drawn. */
#include <math.h>

#include "render/figure/figure.h"
#include "sim/chain/chain_internal.h"

static void figure_widen(double low, double high, double typical, struct bead_shown_values *all)
{
    all->least = fmin(all->least, low);
    all->largest = fmax(all->largest, high);
    all->typical = fmax(all->typical, typical);
}

/* Adds the values of a view; false: it has none. */
static bool widen_by_view(const struct bead_tile *panel, struct bead_shown_values *all)
{
    const struct bead_view_type *type = panel->type;
    double low, high, away;
    type->extremes(panel->view, &low, &high);
    figure_widen(low, high, type->typical ? type->typical(panel->view, 0, &away) : INFINITY, all);
    if (type->typical && all->rest > 0) {
        all->usually_away = fmax(all->usually_away, type->typical(panel->view, all->rest, &away));
        all->away = fmax(all->away, away);
    }
    return low <= high;
}

/* Values shown as colours: the pixels of images if there are any, else the values of the moment. */
void bead_figure_extremes(const struct bead_figure *f, struct bead_shown_values *colours, struct bead_shown_values *sensors)
{
    struct bead_shown_values moment = BEAD_NOTHING_SHOWN;
    bool images = false;
    colours->peak = fmax(colours->peak, f->peak);
    colours->rest = bead_colour_range_rest(f->context.chains, f->context.chain_count, f->output->shown.field);
    for (size_t t = 0; t < f->tile_count; t++) {
        const struct bead_tile *panel = &f->tiles[t];
        bool coloured = bead_view_has(panel->type, BEAD_SHOWS_COLOURS);
        if (!panel->type->extremes)
            continue;
        images = (widen_by_view(panel, coloured ? colours : sensors) && coloured) || images;
    }
    for (size_t c = 0; c < f->cell_count; c++) {
        const struct bead_cell *cell = &f->cells[c];
        const double *values = cell->moments ? cell->moment[1].field[f->output->shown.field] : NULL;
        const struct bead_span *span = &cell->panel[0].setup.beads;
        for (size_t i = span->first; values && i <= span->last; i++)
            figure_widen(values[i], values[i], INFINITY, &moment);
    }
    if (!images)
        figure_widen(moment.least, moment.largest, INFINITY, colours);
}

void bead_figure_set_range(struct bead_figure *f, const struct bead_shown_values *colours, const struct bead_shown_values *sensors)
{
    const double ends[2] = {sensors->least, sensors->largest};
    f->range = bead_colour_range_find(&f->output->colours, bead_colour_range_signed(f->output, f->context.chains[0]), colours);
    f->colours = bead_colour_range_colours(f->output, &f->range, f->range.rest > 0 ? &f->map_about_rest : &f->map);
    for (size_t t = 0; t < f->tile_count; t++) {
        struct bead_tile *panel = &f->tiles[t];
        panel->setup.colours = f->colours;
        if (panel->type->set_range)
            panel->type->set_range(panel->view, &f->colours, ends);
    }
}

/* The earliest horizon of each cell's views. */
static void find_horizons(struct bead_figure *f)
{
    for (size_t c = 0; c < f->cell_count; c++)
        f->cells[c].horizon = INFINITY;
    for (size_t t = 0; f->output->shown.trust && t < f->tile_count; t++) {
        const struct bead_tile *panel = &f->tiles[t];
        if (panel->type->horizon)
            panel->cell->horizon = fmin(panel->cell->horizon, panel->type->horizon(panel->view));
    }
}

static enum bead_error feed_moments(struct bead_figure *f, struct bead_message *msg)
{
    for (size_t t = 0; t < f->tile_count; t++) {
        const struct bead_tile *panel = &f->tiles[t];
        for (size_t m = 2 - panel->cell->moments; !bead_tile_collects(panel) && m < 2; m++)
            BEAD_TRY(panel->type->feed(panel->view, &panel->cell->moment[m], msg));
    }
    return BEAD_OK;
}

/* The moment, limited to the last two samples. */
static double moment_of(const struct bead_figure *f, const struct bead_cell *cell)
{
    if (cell->moments == 0)
        return f->at;
    double first = cell->moment[2 - cell->moments].time, last = cell->moment[1].time;
    return fmin(last, fmax(first, f->at));
}

enum bead_error bead_figure_draw(struct bead_figure *f, struct bead_frame *frame, const struct bead_frame *background,
                                 struct bead_message *msg)
{
    struct bead_changes changes = {0};
    for (size_t t = 0; t < f->tile_count; t++) {
        const struct bead_tile *panel = &f->tiles[t];
        BEAD_TRY(panel->type->draw(panel->view, moment_of(f, panel->cell), frame, background, &changes, msg));
    }
    return BEAD_OK;
}

bool bead_figure_needs_canvas(const struct bead_figure *f)
{
    for (size_t v = 0; v < f->view_count; v++) {
        if (bead_view_has(f->cells[0].panel[v].type, BEAD_DRAWS_ON_CANVAS))
            return !f->page.vector;
    }
    return false;
}

enum bead_error bead_figure_vector(struct bead_figure *f, cairo_t *cr, struct bead_message *msg)
{
    for (size_t t = 0; t < f->tile_count; t++) {
        const struct bead_tile *panel = &f->tiles[t];
        BEAD_TRY(panel->type->vector(panel->view, moment_of(f, panel->cell), cr, msg));
    }
    return BEAD_OK;
}

enum bead_error bead_figure_finish(struct bead_figure *f, struct bead_canvas *canvas, struct bead_message *msg)
{
    find_horizons(f);
    BEAD_TRY(bead_figure_views(f, false, canvas, msg));
    return feed_moments(f, msg);
}
