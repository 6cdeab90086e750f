/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Assigns entries to legends, and sizes the legend outside the panels. */
#include <math.h>

#include "render/plot/graph_private.h"

/* Pages wider than this ratio have legends beside the panels, up to this part of the width; others only if that enlarges the
 * plots. */
static const double most_below = 0.4; /* of the height: less than is left for the plots */
static const double usual_legend = 0.3, widest_legend = 0.5, wide_page = 1.5;

static bool same_entry(const struct graph_entry *a, const struct graph_entry *b)
{
    if (!a->series != !b->series || strcmp(a->markup, b->markup) != 0)
        return false;
    return !a->series || graph_look_alike(a->series, b->series);
}

static bool has_entry(const struct graph_legend *legend, const struct graph_entry *entry)
{
    for (size_t i = 0; i < legend->count; i++) {
        if (same_entry(&legend->entries[i], entry))
            return true;
    }
    return false;
}

static void add_entry(struct graph_legend *legend, struct graph_entry entry)
{
    if (!has_entry(legend, &entry))
        legend->entries[legend->count++] = entry;
}

static bool in_earlier(const struct graph_layout *l, size_t cell, const struct graph_entry *entry)
{
    for (size_t p = 0; p < cell; p++) {
        if (has_entry(&l->cells[p].legend, entry))
            return true;
    }
    return has_entry(&l->legend, entry);
}

/* With several panels, the words of rulers stay in their own panel; outside they begin with its letter. */
static void move_outside(struct graph_layout *l, struct graph_cell *cell)
{
    size_t kept = 0;
    for (size_t i = 0; i < cell->legend.count; i++) {
        struct graph_entry entry = cell->legend.entries[i];
        bool several = entry.ruler && l->graph->panel_count > 1;
        if (several && !cell->rulers_outside) {
            cell->legend.entries[kept++] = entry;
            continue;
        }
        if (several && l->graph->letters)
            entry.markup = cell->words[entry.ruler - cell->panel->rulers].lettered;
        add_entry(&l->legend, entry);
    }
    cell->legend.count = kept;
}

void graph_gather_legends(struct graph_layout *l)
{
    l->legend.count = 0;
    for (size_t p = 0; p < l->graph->panel_count; p++) {
        struct graph_cell *cell = &l->cells[p];
        cell->legend.count = 0;
        for (size_t i = 0; i < cell->panel->series_count + cell->panel->ruler_count; i++) {
            struct graph_entry entry = {0};
            size_t r = i - cell->panel->series_count;
            if (i < cell->panel->series_count && (l->frame.explained || cell->ends))
                continue;
            if (i < cell->panel->series_count) {
                entry.series = &cell->panel->series[i];
                entry.cell = cell;
                entry.markup = cell->labels[i];
            } else if (cell->words[r].state == GRAPH_WORD_IN_LEGEND) {
                entry.ruler = &cell->panel->rulers[r];
                entry.markup = cell->words[r].markup;
            }
            if (entry.markup && !in_earlier(l, p, &entry))
                add_entry(&cell->legend, entry);
        }
        if (cell->legend_outside)
            move_outside(l, cell);
    }
}

/* One column beside the panels. False: too wide or too high. */
static bool fits_beside(struct graph_layout *l, double part, double height)
{
    graph_legend_measure(&l->legend, l->look, part * (l->width - 2 * l->frame.margin), 1);
    return l->legend.wrap == 0 && l->legend.box.height < height;
}

static void full_size(struct graph_legend *legend)
{
    legend->shrunk = 0;
    legend->cut = false;
}

void graph_measure_outside(struct graph_layout *l)
{
    struct graph_legend *legend = &l->legend;
    const struct bead_lanes *columns = &l->grid.columns, *rows = &l->grid.rows;
    double page = l->width - 2 * l->frame.margin;
    l->legend_right = false;
    legend->box = (struct graph_box){0};
    if (legend->count == 0)
        return;
    /* Width and height of all plots together; before the first arrangement, of the page. */
    columns->lane[l->columns].least = rows->lane[l->rows + 1].least = 0;
    double width = columns->length - bead_lanes_fixed(columns);
    double height = fmax(0, rows->length - bead_lanes_fixed(rows) - ceil(graph_legend_gap * l->look->label));
    const double most = height * fmin(most_below, width / (width + page)); /* at most half of the area shared with plots */
    graph_legend_fit(legend, l->look, page, most);
    double below = legend->box.height;
    full_size(legend);
    if (l->width > wide_page * l->height && legend->count > 2 && fits_beside(l, usual_legend, height))
        l->legend_right = true;
    else if (fits_beside(l, widest_legend, height))
        l->legend_right = (width - legend->box.width) * height > width * (height - below);
    if (!l->legend_right)
        graph_legend_fit(legend, l->look, page, most);
}
