/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peak forces of contacts along the chain: one curve for each chain, hollow where the force was still rising at the end, where the
 * run later had a larger one, or where it cannot be predicted. Bars show the uncertainty of the others. */
#include <math.h>
#include <stdlib.h>

#include "render/plot/plot_private.h"

/* A logarithmic axis extends down to at least this fraction of the largest force; room at its ends. */
static const double log_span = 1e-4, log_room = 1.35;

static size_t contacts_of(const struct bead_plot_data *data, size_t chain)
{
    return plot_shows(data, chain) ? bead_chain_contacts(data->context.chains[chain]) : 0;
}

/* A single chain is named above the panel; several (SIZE_MAX) in the legend. */
static size_t only_chain(const struct bead_plot_data *data)
{
    return data->context.chain_count == 1 ? 0 : data->chain;
}

static enum bead_error plot_peaks_create(struct bead_plot_data *data, struct bead_message *msg)
{
    BEAD_TRY(plot_reserve(data, 1, msg));
    size_t most = 1;
    const struct bead_field_info *own = bead_chain_field(data->context.chains[0], BEAD_FIELD_CONTACT_FORCE);
    const char *unit = own ? own->unit : bead_field_info(BEAD_FIELD_CONTACT_FORCE)->unit;
    for (size_t c = 0; c < data->context.chain_count; c++)
        most = contacts_of(data, c) > most ? contacts_of(data, c) : most;
    data->count = 1;
    const struct bead_plot_asked *asked = &data->output->plot;
    data->panels[0].x = (struct bead_graph_axis){"contact", "1", -0.5, (double)most - 0.5, BEAD_SCALE_LINEAR, false};
    data->panels[0].y = (struct bead_graph_axis){"peak force", unit, asked->range[0], asked->range[1], asked->scale, true};
    size_t only = only_chain(data);
    if (only != SIZE_MAX)
        plot_heading(data, only, data->parts[0].title, sizeof data->parts[0].title);
    snprintf(data->why, sizeof data->why, "peaks of contacts");
    return BEAD_OK;
}

static void plot_peaks_needs(const struct bead_plot_data *data, struct bead_needs *needs)
{
    needs->contact_peaks = true;
    needs->uncertainty = data->output->curves.uncertainty && !data->context.replayed;
}

/* Contacts that were never loaded have no peak. */
static bool has_peak(const struct bead_peak *peak)
{
    return isfinite(peak->value) && !(peak->value == 0 && isnan(peak->time));
}

/* Finished peaks determine how far down the axis extends. */
static void plot_peaks_find_range(const struct bead_plot_data *data, const struct bead_outcome *outcomes,
                                  struct bead_graph_axis *axis)
{
    double least = INFINITY, largest = 0;
    for (size_t c = 0; c < data->context.chain_count; c++) {
        for (size_t i = 0; i < contacts_of(data, c); i++) {
            const struct bead_peak *peak = &outcomes[c].contact_peaks[i];
            largest = fmax(largest, has_peak(peak) ? peak->value : 0);
            least = peak->value > 0 && !peak->open ? fmin(least, peak->value) : least;
        }
    }
    largest = largest > 0 ? largest : 1;
    if (axis->scale != BEAD_SCALE_LOG)
        return;
    axis->high = isnan(axis->high) ? largest * log_room : axis->high;
    axis->low = isnan(axis->low) ? fmax(log_span * largest, fmin(least, largest)) / log_room : axis->low;
}

/* Why marks are hollow. */
enum { RISING = 1, EXCEEDED = 2, LOST = 4 };
/* NaN: no bar. */
static double bar_of(const struct bead_outcome *outcome, size_t contact)
{
    const struct bead_peak *peak = &outcome->contact_peaks[contact];
    const double u = outcome->contact_uncertainty ? outcome->contact_uncertainty[contact] : 0;
    return peak->unpredictable ? NAN : plot_bar(peak->value, u);
}

enum { ROWS = 4 };

/* Adds finished peaks, and hollow marks. Returns the reason for the hollow ones. */
static unsigned plot_peaks_fill(struct bead_plot_data *data, const struct bead_outcome *outcome, size_t chain)
{
    struct plot_panel *part = &data->parts[0];
    const size_t count = contacts_of(data, chain);
    const bool alone = only_chain(data) != SIZE_MAX;
    char *name = part->labels[chain];
    unsigned why = 0;
    plot_heading(data, chain, name, sizeof *part->labels);
    double *x = part->values, *done = x + count, *bars = done + count, *open = bars + count;
    part->values = open + count;
    for (size_t i = 0; i < count; i++) {
        const struct bead_peak *peak = &outcome->contact_peaks[i];
        bool is_open = has_peak(peak) && peak->open;
        x[i] = (double)i;
        done[i] = has_peak(peak) && !peak->open ? peak->value : NAN;
        const unsigned reasons =
            (is_open ? RISING : 0u) | (peak->exceeded ? EXCEEDED : 0u) | (peak->unpredictable && has_peak(peak) ? LOST : 0u);
        open[i] = reasons ? peak->value : NAN;
        bars[i] = bar_of(outcome, i);
        why |= reasons;
    }
    struct bead_series series = {.x = x, .y = done, .error = bars, .count = count, .mark = BEAD_MARK_LINE_POINTS, .arrows = true};
    series.label = !alone && *name ? name : NULL;
    plot_tell_apart(&series, alone ? 0 : chain);
    plot_add(part, series);
    series.y = open;
    series.error = NULL;
    series.mark = BEAD_MARK_POINTS;
    series.hollow = true;
    series.label = NULL;
    plot_add(part, series);
    return why;
}

static enum bead_error plot_peaks_finish(struct bead_plot_data *data, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    static const char *const words[] = {[RISING] = "hollow: still rising at the end",
                                        [EXCEEDED] = "hollow: more after the first passage",
                                        [RISING | EXCEEDED] = "hollow: still rising, or more later",
                                        [LOST] = "hollow: not predictable",
                                        [LOST | RISING] = "hollow: not predictable, or still rising",
                                        [LOST | EXCEEDED] = "hollow: not predictable, or more later",
                                        [LOST | RISING | EXCEEDED] = "hollow: not predictable, rising, or more later"};
    size_t chains = data->context.chain_count, all = 0;
    unsigned why = 0;
    for (size_t c = 0; c < chains; c++) {
        if (contacts_of(data, c) > 0 && (!outcomes || !outcomes[c].contact_peaks))
            return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "%s: peaks are known only at the end of a run", data->output->path);
        all += ROWS * contacts_of(data, c);
    }
    BEAD_TRY(plot_reserve_series(data, 0, 2 * chains + 1, all, msg));
    for (size_t c = 0; c < chains; c++) {
        if (plot_shows(data, c))
            why |= plot_peaks_fill(data, &outcomes[c], c);
    }
    if (why)
        plot_add(data->parts, (struct bead_series){.mark = BEAD_MARK_POINTS, .hollow = true, .colour = 5, .label = words[why]});
    plot_peaks_find_range(data, outcomes, &data->panels[0].y);
    return BEAD_OK;
}

const struct plot_kind bead_plot_peaks = {BEAD_SHOW_PEAKS, plot_peaks_create, plot_peaks_needs, NULL, plot_peaks_finish};
