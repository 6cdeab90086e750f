/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Creates a figure and feeds it samples; figure_write.c finishes it. */
#include <stdlib.h>

#include "render/draw/picture_times.h"
#include "render/figure/figure.h"
#include "render/stage/magnify.h"
#include "render/stage/stage_key.h"
#include "render/view/orientation.h"
#include "render/view/theory_line.h"
#include "render/view/views.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"
#include "sim/kinds/view_kinds.h"

bool bead_tile_collects(const struct bead_tile *panel)
{
    return bead_view_has(panel->type, BEAD_SHOWS_ALL_TIMES);
}

void bead_figure_release(struct bead_figure *f)
{
    for (size_t t = 0; t < f->tile_count; t++) {
        if (f->tiles[t].view)
            f->tiles[t].type->destroy(f->tiles[t].view);
        f->tiles[t].view = NULL;
    }
}

void bead_figure_destroy(struct bead_figure *f)
{
    if (!f)
        return;
    bead_figure_release(f);
    for (size_t m = 0; m < 2 * f->cell_count; m++) {
        for (size_t field = 0; field < BEAD_FIELD_COUNT; field++)
            free((double *)f->cells[m / 2].moment[m % 2].field[field]);
    }
    free(f->tiles);
    free(f->cells);
    free(f);
}

enum bead_error bead_figure_span(const struct bead_output *output, const struct bead_chain *chain, struct bead_span *span,
                                 struct bead_message *msg)
{
    bool contacts = bead_field_info(output->shown.field)->of_contacts;
    size_t count = contacts ? bead_chain_contacts(chain) : bead_chain_beads(chain);
    *span = output->shown.beads;
    span->last = span->last < count ? span->last : count - 1;
    if (span->first > span->last)
        return bead_output_wrong(output, msg, "beads: begin at %zu, but the chain has %zu %s", span->first, count,
                                 contacts ? "contacts" : "beads");
    return BEAD_OK;
}

/* A picture of only sensors shows only chains that have some. */
static bool is_shown(const struct bead_figure *f, size_t chain)
{
    size_t sensors;
    if (f->set.chain != SIZE_MAX && f->set.chain != chain)
        return false;
    (void)bead_chain_sensors(f->context.chains[chain], &sensors);
    return sensors > 0 || f->view_count != 1 || !bead_views_any(&f->output->views, BEAD_SHOWS_SENSORS);
}

bool bead_figure_looks_at_beads(const struct bead_output *output)
{
    return !bead_views_all(&output->views, BEAD_SHOWS_ALL_TIMES);
}

/* Panels extend as far as the striker and the wall of the beads above them. */
static void reach_beyond(const struct bead_figure *f, struct bead_cell *cell)
{
    int beyond[2] = {0, 0};
    for (size_t v = 0; v < f->view_count; v++) {
        const struct bead_view_type *type = cell->panel[v].type;
        if ((f->output->views.axes || f->view_count == 1) && bead_view_has(type, BEAD_SHOWS_BEADS) && type->margins)
            type->margins(&f->look, &beyond[0], &beyond[1]);
    }
    for (size_t v = 0; v < f->view_count; v++)
        memcpy(cell->panel[v].setup.beyond, beyond, sizeof beyond);
}

static enum bead_error fill_cell(struct bead_figure *f, struct bead_cell *cell, double magnify, struct bead_message *msg)
{
    const struct bead_views_asked *views = &f->output->views;
    bool moments = bead_figure_looks_at_beads(f->output);
    for (size_t v = 0; v < f->view_count; v++) {
        struct bead_tile *panel = &cell->panel[v];
        panel->cell = cell;
        BEAD_TRY(bead_view_take(views, v, &panel->type, msg));
        panel->setup = (struct bead_view_setup){
            .chain = f->context.chains[cell->chain],
            .chain_index = cell->chain,
            .field = f->output->shown.field,
            .time = {f->time[0], f->time[1]},
            .colours = f->colours,
            .look = &f->look,
            .axes = f->output->views.axes,
            .bead_labels = true,
            .orientation = bead_orientation_of(f->output),
            .sampling = f->output->image.sampling,
            .marked = moments,
            .mark = f->at,
            .magnify = magnify,
            .over_beads = bead_views_any(views, BEAD_SHOWS_BEADS) &&
                          bead_orientation_across(bead_orientation_of(f->output), panel->type->info) == BEAD_ACROSS_CHAIN,
            .light = f->output->views.light,
            .elsewhere =
                f->set.chain != SIZE_MAX ? 0 : bead_stage_key_elsewhere(f->context.chains, f->context.chain_count, cell->chain),
            .fine = true,
            .theory = f->output->shown.theory,
            .trust = f->output->shown.trust};
        BEAD_TRY(bead_figure_span(f->output, panel->setup.chain, &panel->setup.beads, msg));
    }
    reach_beyond(f, cell);
    f->coloured = bead_views_any(views, BEAD_SHOWS_COLOURS);
    f->collects = bead_views_any(views, BEAD_SHOWS_ALL_TIMES);
    f->stills = f->stills || moments;
    return BEAD_OK;
}

static enum bead_error make_cells(struct bead_figure *f, struct bead_message *msg)
{
    BEAD_TRY(bead_new(&f->cells, f->context.chain_count, msg, "a figure"));
    BEAD_TRY(bead_new(&f->tiles, f->context.chain_count * f->view_count, msg, "a figure"));
    double magnify = f->output->views.magnify;
    if (!(magnify > 0))
        magnify = bead_figure_looks_at_beads(f->output) ? bead_magnify_auto(f->context.chains, f->context.chain_count) : 1;
    for (size_t c = 0; c < f->context.chain_count; c++) {
        if (!is_shown(f, c))
            continue;
        struct bead_cell *cell = &f->cells[f->cell_count++];
        cell->chain = c;
        cell->panel = &f->tiles[f->tile_count];
        f->tile_count += f->view_count;
        BEAD_TRY(fill_cell(f, cell, magnify, msg));
    }
    if (f->cell_count == 0)
        return bead_output_wrong(f->output, msg, "there is no sensor to show; give a bead one: {bead: steel, sensor: first}");
    return BEAD_OK;
}

enum bead_error bead_figure_views(struct bead_figure *f, bool collecting, struct bead_canvas *canvas, struct bead_message *msg)
{
    for (size_t t = 0; t < f->tile_count; t++) {
        struct bead_tile *panel = &f->tiles[t];
        if (bead_tile_collects(panel) != collecting)
            continue;
        BEAD_TRY(panel->type->create(&panel->setup, &panel->view, msg));
        BEAD_TRY(
            panel->type->place(panel->view, panel->plot, bead_view_has(panel->type, BEAD_DRAWS_ON_CANVAS) ? canvas : NULL, msg));
    }
    return BEAD_OK;
}

/* Pixels along time of the figure's space-time image; 2000 for curves without one. */
static double time_pixels(const struct bead_figure *f)
{
    for (size_t v = 0; v < f->view_count; v++) {
        const struct bead_tile *panel = &f->cells[0].panel[v];
        if (bead_view_has(panel->type, BEAD_SHOWS_IMAGE))
            return panel->setup.orientation == BEAD_TIME_DOWN ? panel->plot.height : panel->plot.width;
    }
    return 2000;
}

static void figure_choose_grid(struct bead_figure *f)
{
    const double times[2] = {f->collects ? f->time[0] : f->at, f->collects ? fmax(f->time[1], f->stills ? f->at : 0) : f->at};
    double pixels = time_pixels(f) * (f->collects ? (times[1] - times[0]) / (f->time[1] - f->time[0]) : 1);
    f->grid = bead_picture_grid(&f->context, &f->output->shown, times, pixels);
}

static void explain(struct bead_figure *f)
{
    char pixel[64];
    bead_quantity((f->time[1] - f->time[0]) / time_pixels(f), bead_chain_time_unit(f->context.chains[0]), 3, pixel, sizeof pixel);
    if (f->collects)
        snprintf(f->why, sizeof f->why, "%d x %d pixels, %s each along time", f->page.width, f->page.height, pixel);
    else
        snprintf(f->why, sizeof f->why, "%d x %d pixels, one moment", f->page.width, f->page.height);
}

/* Prepares everything except the layout. */
static enum bead_error figure_prepare(struct bead_figure *f, struct bead_message *msg)
{
    const struct bead_output *output = f->output;
    bool is_signed = bead_colour_range_signed(output, f->context.chains[0]);
    BEAD_TRY(bead_colour_range_check(output, msg));
    BEAD_TRY(bead_picture_times(output, &f->context, f->time, msg));
    f->at = isnan(output->image.at) ? f->time[1] : output->image.at;
    if (f->at > f->context.end * (1 + 1e-9))
        return bead_output_wrong(output, msg, "at: is %g; the run ends at %g", f->at, f->context.end);
    f->at = fmin(f->at, f->context.end);
    for (size_t c = 0; c < f->context.chain_count && output->shown.theory; c++)
        BEAD_TRY(bead_theory_line_check(output, f->context.chains[c], msg));
    BEAD_TRY(bead_colour_range_map(output, f->context.chains[0], f->look.dark, false, &f->map, msg));
    if (bead_colour_range_rest(f->context.chains, f->context.chain_count, output->shown.field) > 0)
        BEAD_TRY(bead_colour_range_map(output, f->context.chains[0], f->look.dark, true, &f->map_about_rest, msg));
    /* the widest labels; the real range is known at the end */
    f->range = bead_colour_range_find(&output->colours, is_signed,
                                      &(struct bead_shown_values){is_signed ? -888 : 0, 888, .typical = INFINITY});
    f->colours = bead_colour_range_colours(output, &f->range, &f->map);
    return make_cells(f, msg);
}

enum bead_error bead_figure_start(struct bead_figure *f, struct bead_message *msg)
{
    BEAD_TRY(bead_figure_views(f, true, NULL, msg));
    figure_choose_grid(f);
    explain(f);
    return BEAD_OK;
}

/* Beads without axes need room for striker and wall. */
static double bare_margin(const struct bead_figure *f)
{
    int left = 0, right = 0;
    const struct bead_views_asked *views = &f->output->views;
    if (!f->part && f->view_count == 1 && bead_views_all(views, BEAD_SHOWS_BEADS) && !bead_views_any(views, BEAD_ACTS))
        bead_view_find(BEAD_VIEW_BEADS)->margins(&f->look, &left, &right);
    return ceil(1.5 * fmax(left, right)); /* the striker's arrow precedes it */
}

enum bead_error bead_figure_create(const struct bead_output *output, const struct bead_run_context *context,
                                   const struct bead_page *page, const struct bead_look *look,
                                   const struct bead_part_settings *settings, struct bead_figure **figure, struct bead_message *msg)
{
    *figure = NULL;
    if (output->views.count < 1 || output->views.count > BEAD_MOST_VIEWS)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "a figure has 1 to %d views of each chain", BEAD_MOST_VIEWS);
    BEAD_TRY(bead_new(figure, 1, msg, "a figure"));
    struct bead_figure *f = *figure;
    f->output = output;
    f->context = *context;
    f->view_count = output->views.count;
    f->page = *page;
    f->look = *look;
    f->part = settings != NULL;
    f->set = settings ? *settings : (struct bead_part_settings){.chain = SIZE_MAX};
    f->margin = !f->part && output->views.axes ? look->margin : bare_margin(f);
    return figure_prepare(f, msg);
}

static unsigned figure_fields_of(const struct bead_figure *f, bool collecting)
{
    unsigned fields = 0;
    for (size_t v = 0; v < f->view_count; v++) {
        const struct bead_tile *panel = &f->cells[0].panel[v];
        if (bead_tile_collects(panel) == collecting)
            fields |= panel->type->fields(&panel->setup);
    }
    return fields;
}

static void take_beads(struct bead_span *all, size_t first, size_t last)
{
    all->first = first < all->first ? first : all->first;
    all->last = last > all->last ? last : all->last;
}

/* The beads shown, and those with sensors. */
static struct bead_span all_beads(const struct bead_figure *f)
{
    struct bead_span all = {SIZE_MAX, 0};
    for (size_t t = 0; t < f->tile_count; t++) {
        const struct bead_tile *panel = &f->tiles[t];
        size_t count;
        const struct bead_sensor *sensors = bead_chain_sensors(panel->setup.chain, &count);
        bool plotted = bead_view_has(panel->type, BEAD_SHOWS_SENSORS);
        for (size_t s = 0; plotted && s < count; s++)
            take_beads(&all, sensors[s].bead, sensors[s].bead);
        if (!plotted)
            take_beads(&all, panel->setup.beads.first, panel->setup.beads.last);
    }
    /* A drawn bead takes the values of the contacts on both sides. */
    if (f->stills && bead_field_info(f->output->shown.field)->of_contacts)
        all.last++;
    return all;
}

void bead_figure_needs(const struct bead_figure *f, struct bead_needs *needs)
{
    *needs = (struct bead_needs){.fields = figure_fields_of(f, true) | figure_fields_of(f, false),
                                 .beads = all_beads(f),
                                 .grid = f->grid,
                                 .comparison = f->output->shown.trust ? figure_fields_of(f, true) : 0,
                                 .until = f->grid.end,
                                 .why = f->why};
}

/* Keeps copies of the last sample before the moment and the first one after it. */
static enum bead_error keep_moment(struct bead_figure *f, struct bead_cell *cell, const struct bead_sample *sample,
                                   struct bead_message *msg)
{
    double slack = 1e-6 * f->grid.every;
    bool enough = cell->moments > 0 && cell->moment[1].time >= f->at - slack;
    if (enough || sample->time < f->at - 1.5 * f->grid.every)
        return BEAD_OK;
    struct bead_sample spare = cell->moment[0];
    cell->moment[0] = cell->moment[1];
    const struct bead_chain *chain = f->context.chains[cell->chain];
    unsigned fields = figure_fields_of(f, false);
    struct bead_span span = all_beads(f);
    for (size_t i = 0; i < BEAD_FIELD_COUNT; i++) {
        size_t count = bead_field_info((enum bead_field)i)->of_contacts ? bead_chain_contacts(chain) : bead_chain_beads(chain);
        double *copy = (double *)spare.field[i];
        if (!(fields & BEAD_FIELD_BIT(i)) || !sample->field[i])
            continue;
        if (!copy)
            BEAD_TRY(bead_new(&copy, count, msg, "a still of %zu beads", count));
        size_t last = span.last < count ? span.last : count - 1;
        if (span.first <= last)
            memcpy(copy + span.first, sample->field[i] + span.first, (last - span.first + 1) * sizeof *copy);
        spare.field[i] = copy;
    }
    spare.chain = sample->chain;
    spare.index = sample->index;
    spare.time = sample->time;
    spare.active = sample->active;
    cell->moment[1] = spare;
    cell->moments += cell->moments < 2;
    return BEAD_OK;
}

static void keep_peak(struct bead_figure *f, const struct bead_cell *cell, const struct bead_sample *sample)
{
    const struct bead_span *span = &cell->panel[0].setup.beads;
    const double *values = sample->field[f->output->shown.field];
    const bool within = values && sample->time >= f->time[0] && sample->time <= f->time[1];
    double peak = f->peak;
    for (size_t i = span->first; within && i <= span->last; i++)
        peak = fabs(values[i]) > peak ? fabs(values[i]) : peak;
    f->peak = peak;
}

enum bead_error bead_figure_feed(struct bead_figure *f, const struct bead_sample *sample, struct bead_message *msg)
{
    for (size_t c = 0; c < f->cell_count; c++) {
        struct bead_cell *cell = &f->cells[c];
        if (cell->chain != sample->chain)
            continue;
        keep_peak(f, cell, sample);
        for (size_t v = 0; v < f->view_count; v++) {
            if (cell->panel[v].view)
                BEAD_TRY(cell->panel[v].type->feed(cell->panel[v].view, sample, msg));
        }
        if (f->stills)
            BEAD_TRY(keep_moment(f, cell, sample, msg));
    }
    return BEAD_OK;
}
