/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots: gathers their data from samples, by the functions of their kind, and makes panels of graphs. */
#include "render/plot/plot_data.h"

#include <stdlib.h>

#include "render/plot/plot_private.h"
#include "sim/base/memory.h"
#include "sim/kinds/output_kinds.h"
#include "sim/measure/profile_times.h"

/* `const struct plot_kind bead_plot_NAME`; the first is the default. */
#define PLOTS(PLOT)                                                                                                         \
    PLOT(sensors), PLOT(peaks), PLOT(modes), PLOT(profiles), PLOT(bands), PLOT(eigenmodes), PLOT(spectrum), PLOT(transfer), \
        PLOT(spectrogram), PLOT(dispersion), PLOT(energy), PLOT(spreading)

#define PLOT_NAME(name) bead_plot_##name
extern const struct plot_kind PLOTS(PLOT_NAME);
#define PLOT_AT(name) &bead_plot_##name
static const struct plot_kind *const kinds[] = {PLOTS(PLOT_AT)};

static const struct plot_kind *plot_kind_of(const struct bead_plot_data *data)
{
    for (size_t k = 1; k < sizeof kinds / sizeof *kinds; k++) {
        if (data->output->curves.show == kinds[k]->show)
            return kinds[k];
    }
    return kinds[0];
}

enum bead_error bead_plot_data_create(const struct bead_output *output, const struct bead_run_context *context, size_t chain,
                                      struct bead_plot_data **data, struct bead_message *msg)
{
    BEAD_TRY(bead_new(data, 1, msg, "a plot"));
    struct bead_plot_data *d = *data;
    d->output = output;
    d->context = *context;
    d->chain = chain;
    enum bead_error err = plot_kind_of(d)->create(d, msg);
    if (!err && d->count == 0)
        err = bead_output_wrong(output, msg, "beads: the chain that is shown has no sensor, or none of the places listed");
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
    for (size_t p = 0; p < data->count << data->residuals; p++) {
        bead_curves_free(&data->parts[p].curves);
        bead_recorded_free(&data->parts[p].recorded);
        bead_curves_free(&data->parts[p].differences);
        free(data->parts[p].spectral.values);
    }
    for (size_t p = 0; data->spreading && p < data->count; p++)
        bead_spreading_free(&data->spreading[p]);
    plot_store_free(&data->store);
    bead_profile_times_destroy(data->moments);
    bead_spectra_destroy(data->spectra);
    free(data);
}

void bead_plot_data_needs(const struct bead_plot_data *data, struct bead_needs *needs)
{
    const struct plot_kind *kind = plot_kind_of(data);
    *needs = (struct bead_needs){.why = data->why};
    if (!kind->needs)
        return;
    needs->grid = data->grid;
    needs->until = data->grid.end;
    kind->needs(data, needs);
}

enum bead_error bead_plot_data_feed(struct bead_plot_data *data, const struct bead_sample *sample, struct bead_message *msg)
{
    const struct plot_kind *kind = plot_kind_of(data);
    return kind->feed ? kind->feed(data, sample, msg) : BEAD_OK;
}

/* Moves the series of panels from `first`, one for each chain, into panel `into`, under the names of their chains. */
static void overlay_row(struct bead_plot_data *data, size_t first, size_t into, size_t *used)
{
    struct bead_panel *row = &data->panels[first];
    const size_t from = *used;
    for (size_t p = 0; p < data->count; p++) {
        const struct bead_panel *panel = &row[p];
        for (size_t k = 0; k < panel->series_count; k++, ++*used) {
            const struct bead_panel *labelled = panel->series[k].label ? panel : row; /* else as in the first panel */
            const char *own = k < labelled->series_count && labelled->series[k].label ? labelled->series[k].label : "";
            const char *name = data->panels[p].title ? data->panels[p].title : "";
            const bool ours = panel->series[k].mark != BEAD_MARK_POINTS; /* measured points belong to no chain */
            const bool both = ours && *own && *name && panel->series_count > 1;
            data->overlaid[*used] = panel->series[k];
            snprintf(data->overlaid_labels[*used], sizeof *data->overlaid_labels, "%.140s%s%.140s", ours ? name : "",
                     both ? ": " : "", both || !ours || !*name ? own : "");
            data->overlaid[*used].label = data->overlaid_labels[*used];
            plot_tell_apart(&data->overlaid[*used], *used - from);
        }
    }
    data->panels[into] = *row;
    data->panels[into].series = data->overlaid + from;
    data->panels[into].series_count = *used - from;
}

/* The bead or time that all chains show if each has one curve; NULL: they differ, or the legend names it. */
static const char *common_label(const struct bead_plot_data *data)
{
    const char *label = data->panels[0].series_count > 0 ? data->panels[0].series[0].label : NULL;
    for (size_t p = 0; p < data->count && label; p++) {
        const struct bead_panel *panel = &data->panels[p];
        size_t own = 0;
        for (size_t k = 0; k < panel->series_count; k++) {
            own += panel->series[k].mark != BEAD_MARK_POINTS;
            label = panel->series[k].mark == BEAD_MARK_POINTS || !panel->series[k].label ||
                            (label && strcmp(panel->series[k].label, label) == 0)
                        ? label
                        : NULL;
        }
        label = own == 1 && panel->title ? label : NULL;
    }
    return label;
}

static enum bead_error overlay(struct bead_plot_data *data, struct bead_message *msg)
{
    size_t all = 0, used = 0;
    const char *title = common_label(data);
    for (size_t p = 0; p < data->count << data->residuals; p++)
        all += data->panels[p].series_count;
    BEAD_TRY(plot_new(&data->store, &data->overlaid, all, msg));
    BEAD_TRY(plot_new(&data->store, &data->overlaid_labels, all, msg));
    overlay_row(data, 0, 0, &used);
    if (data->residuals)
        overlay_row(data, data->count, 1, &used);
    data->panels[0].title = data->count > 1 ? title : data->panels[0].title;
    return BEAD_OK;
}

static bool is_overlay(const struct bead_plot_data *data)
{
    return data->output->curves.overlay && data->count > 1;
}

enum bead_error bead_plot_data_finish(struct bead_plot_data *data, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    BEAD_TRY(plot_kind_of(data)->finish(data, outcomes, msg));
    return is_overlay(data) ? overlay(data, msg) : BEAD_OK;
}

const struct bead_panel *bead_plot_data_panels(const struct bead_plot_data *data, size_t *count)
{
    *count = (is_overlay(data) ? 1 : data->count) << data->residuals;
    return data->panels;
}

static struct bead_graph graph_of(const struct bead_plot_data *data)
{
    struct bead_graph graph = {
        .letters = true, .share_x = !data->apart[0], .share_y = !data->apart[1], .residuals = data->residuals};
    graph.panels = bead_plot_data_panels(data, &graph.panel_count);
    return graph;
}

enum bead_error bead_plot_data_check(const struct bead_plot_data *data, struct bead_message *msg)
{
    const struct bead_graph graph = graph_of(data);
    return bead_graph_check(&graph, data->output, data->context.scene, msg);
}

enum bead_error bead_plot_data_write(const struct bead_plot_data *data, const char *path, uint64_t *bytes, struct bead_message *msg)
{
    const struct bead_graph graph = graph_of(data);
    return bead_graph_write(&graph, data->output, data->context.scene, path, bytes, msg);
}
