/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the kinds of plots: panels, their headings, and distinguishable curves. */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

#include "render/draw/markup.h"
#include "render/draw/words.h"
#include "render/plot/plot_private.h"
#include "sim/base/memory.h"
#include "sim/kinds/output_kinds.h"
#include "sim/measure/places.h"

bool plot_shows(const struct bead_plot_data *data, size_t chain)
{
    const struct bead_show_type *show = bead_show_type(data->output->curves.show);
    return (data->chain == SIZE_MAX || data->chain == chain) &&
           !(show->of_places && bead_places_count(data->output, data->context.chains[chain]) == 0);
}

void plot_heading(const struct bead_plot_data *data, size_t number, char *text, size_t size)
{
    const struct bead_chain *chain = data->context.chains[number];
    char name[300], value[32], magnetism[64] = "";
    bead_markup_quote(bead_chain_title(chain), name, sizeof name);
    if (*bead_chain_spins(chain)) {
        const int decimals = bead_magnetism_decimals(data->context.chains, data->context.chain_count);
        bead_number(bead_chain_magnetism(chain), decimals, value, sizeof value);
        snprintf(magnetism, sizeof magnetism, "*M*\u00a0=\u00a0%s", value);
    }
    snprintf(text, size, "%s%s%s", name, *name && *magnetism ? ", " : "", magnetism);
}

void plot_tell_apart(struct bead_series *series, size_t index)
{
    enum { COLOURS = 6 };
    size_t round = index / BEAD_DASHES;
    series->colour = index % COLOURS;
    series->dash = (series->mark == BEAD_MARK_LINE ? index : index + round) % BEAD_DASHES;
    series->shape = index % BEAD_SHAPES;
    if (series->mark == BEAD_MARK_LINE && round > 0) { /* more curves than dashes: also with marks */
        series->mark = BEAD_MARK_LINE_POINTS;
        series->shape = (round - 1) % BEAD_SHAPES;
    }
}

struct bead_series plot_line(const double *x, const double *y, size_t count, const char *label, size_t index)
{
    struct bead_series line = {.x = x, .y = y, .count = count, .mark = BEAD_MARK_LINE, .label = label};
    plot_tell_apart(&line, index);
    return line;
}

/* Bars of less than this part of the value are hidden by marks. */
static const double visible = 0.01;

double plot_bar(double value, double uncertainty)
{
    return uncertainty > visible * fabs(value) ? uncertainty : NAN;
}

double plot_bar_of_mean(const struct bead_summary *mean, double uncertainty)
{
    const double bar = plot_bar(mean->mean, uncertainty);
    return hypot(isfinite(mean->standard_error) ? mean->standard_error : 0, isnan(bar) ? 0 : bar);
}

struct plot_block {
    struct plot_block *next;
    max_align_t memory[];
};

enum bead_error plot_allocate(struct plot_store *store, void *pointer, size_t count, size_t size, struct bead_message *msg)
{
    struct plot_block *block;
    memset(pointer, 0, sizeof(void *));
    BEAD_TRY(bead_allocate(&block, sizeof *block + count * size, 1, msg, "a plot"));
    block->next = store->last;
    store->last = block;
    memcpy(pointer, &(void *){block->memory}, sizeof(void *));
    return BEAD_OK;
}

void plot_store_free(struct plot_store *store)
{
    for (struct plot_block *block = store->last, *next; block; block = next) {
        next = block->next;
        free(block);
    }
}

enum bead_error plot_reserve(struct bead_plot_data *data, size_t panels, struct bead_message *msg)
{
    BEAD_TRY(plot_new(&data->store, &data->parts, panels + 1, msg));
    BEAD_TRY(plot_new(&data->store, &data->panels, panels + 1, msg));
    for (size_t p = 0; p < panels; p++) {
        data->panels[p].title = data->parts[p].title;
        data->parts[p].shown = &data->panels[p];
    }
    return BEAD_OK;
}

enum bead_error plot_reserve_series(struct bead_plot_data *data, size_t p, size_t series, size_t values, struct bead_message *msg)
{
    struct plot_panel *part = &data->parts[p];
    BEAD_TRY(plot_new(&data->store, &part->series, series, msg));
    BEAD_TRY(plot_new(&data->store, &part->labels, series + PLOT_TEXTS, msg));
    BEAD_TRY(plot_new(&data->store, &part->values, values, msg));
    data->panels[p].series = part->series;
    return BEAD_OK;
}

struct bead_series *plot_add(struct plot_panel *part, struct bead_series series)
{
    struct bead_series *own = &part->series[part->shown->series_count++];
    *own = series;
    return own;
}

double *plot_add_numbers(struct plot_panel *part, struct bead_series series, size_t count, size_t columns)
{
    double *x = part->values;
    part->values += count * columns;
    series.x = x;
    series.y = series.y ? series.y : x + count;
    series.count = count;
    plot_add(part, series);
    return x;
}

struct bead_series *plot_last(const struct plot_panel *part)
{
    return &part->series[part->shown->series_count - 1];
}

char *plot_next_text(struct plot_panel *part)
{
    return part->labels[part->texts++];
}

enum bead_error plot_reserve_chains(struct bead_plot_data *data, size_t series, size_t values, struct bead_message *msg)
{
    BEAD_TRY(plot_reserve(data, data->context.chain_count, msg));
    for (size_t c = 0; c < data->context.chain_count; c++) {
        if (!plot_shows(data, c))
            continue;
        struct plot_panel *part = &data->parts[data->count];
        part->chain = c;
        plot_heading(data, c, part->title, sizeof part->title);
        BEAD_TRY(plot_reserve_series(data, data->count++, series, values, msg));
    }
    return BEAD_OK;
}

void plot_add_curve(struct plot_panel *part, struct bead_series series, const struct bead_curves *curves, size_t k, double factor)
{
    double *x = plot_add_numbers(part, series, 4 * curves->count, 2), *y = x + 4 * curves->count;
    size_t used = 0;
    for (size_t s = 0; s < curves->count; s++) {
        struct bead_point points[4];
        const size_t more = bead_curves_points(curves, s, k, points);
        for (size_t i = 0; i < more; i++) {
            x[used] = points[i].time;
            y[used++] = factor * points[i].value;
        }
    }
    plot_last(part)->count = used;
}
