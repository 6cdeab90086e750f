/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots: collects what a plot shows from samples, by the functions of its kind, and makes panels of graphs from it. Stills and
 * panels use it. */
#include "render/plot/plot_data.h"

#include <stdio.h>
#include <stdlib.h>

#include "beadreel/profile_times.h"
#include "render/draw/markup.h"
#include "render/draw/names.h"
#include "render/draw/quantity.h"
#include "render/plot/plot_private.h"

/* The first is the default. */
static const struct plot_kind *const kinds[] = {&bead_plot_sensors, &bead_plot_peaks, &bead_plot_modes, &bead_plot_profiles};

static const struct plot_kind *plot_kind_of(const struct bead_plot_data *data)
{
    for (size_t k = 1; k < sizeof kinds / sizeof *kinds; k++) {
        if (data->output->curves.show == kinds[k]->show)
            return kinds[k];
    }
    return kinds[0];
}

bool plot_shows(const struct bead_plot_data *data, size_t chain)
{
    return data->chain == SIZE_MAX || data->chain == chain;
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
    series->shape = index % BEAD_SHAPES;               /* rings are for what is open */
    if (series->mark == BEAD_MARK_LINE && round > 0) { /* more curves than dashes: with marks, too */
        series->mark = BEAD_MARK_LINE_POINTS;
        series->shape = (round - 1) % BEAD_SHAPES;
    }
}

enum bead_error plot_reserve(struct bead_plot_data *data, size_t panels, struct bead_message *msg)
{
    data->parts = calloc(panels + 1, sizeof *data->parts);
    data->panels = calloc(panels + 1, sizeof *data->panels);
    return data->parts && data->panels ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a plot");
}

enum bead_error plot_reserve_chains(struct bead_plot_data *data, size_t series, struct bead_message *msg)
{
    enum bead_error err = plot_reserve(data, data->context.chain_count, msg);
    for (size_t c = 0; !err && c < data->context.chain_count; c++) {
        if (!plot_shows(data, c))
            continue;
        struct plot_panel *part = &data->parts[data->count];
        struct bead_panel *panel = &data->panels[data->count++];
        part->chain = c;
        part->series = calloc(series + 1, sizeof *part->series);
        part->labels = calloc(series + 1, sizeof *part->labels);
        if (!part->series || !part->labels)
            err = bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a plot");
        bead_markup_quote(bead_chain_title(data->context.chains[c]), part->title, sizeof part->title);
        panel->title = *part->title ? part->title : NULL;
        panel->series = part->series;
        panel->series_count = series;
    }
    return err;
}

enum bead_error bead_plot_data_create(const struct bead_output *output, const struct bead_run_context *context, size_t chain,
                                      struct bead_plot_data **data, struct bead_message *msg)
{
    struct bead_plot_data *d = *data = calloc(1, sizeof *d);
    if (!d)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a plot");
    d->output = output;
    d->context = *context;
    d->chain = chain;
    enum bead_error err = plot_kind_of(d)->create(d, msg);
    if (err) {
        bead_plot_data_destroy(d);
        *data = NULL;
    }
    return err;
}

void bead_plot_data_destroy(struct bead_plot_data *data)
{
    if (!data)
        return;
    for (size_t p = 0; p < data->count; p++) {
        bead_curves_free(&data->parts[p].curves);
        bead_curves_free(&data->parts[p].differences);
        free(data->parts[p].series);
        free(data->parts[p].values);
        free(data->parts[p].labels);
    }
    free(data->parts);
    free(data->panels);
    free(data->sample);
    bead_profile_times_destroy(data->moments);
    free(data);
}

void bead_plot_data_needs(const struct bead_plot_data *data, struct bead_needs *needs)
{
    plot_kind_of(data)->needs(data, needs);
}

enum bead_error bead_plot_data_feed(struct bead_plot_data *data, const struct bead_sample *sample, struct bead_message *msg)
{
    return plot_kind_of(data)->feed(data, sample, msg);
}

enum bead_error bead_plot_data_finish(struct bead_plot_data *data, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    return plot_kind_of(data)->finish(data, outcomes, msg);
}

const struct bead_panel *bead_plot_data_panels(const struct bead_plot_data *data, size_t *count)
{
    *count = data->count;
    return data->panels;
}

enum bead_error bead_plot_data_write(struct bead_plot_data *data, const struct bead_outcome *outcomes, const char *path,
                                     uint64_t *bytes, struct bead_message *msg)
{
    const struct plot_kind *kind = plot_kind_of(data);
    enum bead_error err = bead_plot_data_finish(data, outcomes, msg);
    if (err)
        return err;
    struct bead_graph graph = {
        .panels = data->panels, .panel_count = data->count, .letters = true, .share_x = kind->share_x, .share_y = true};
    return bead_graph_write(&graph, data->output, data->context.scene, path, bytes, msg);
}
