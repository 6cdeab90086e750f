/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots of sweeps: peak force against magnetism, with its two regimes; or the decay of peaks along the chain. */
#include <math.h>
#include <stdlib.h>

#include "render/draw/words.h"
#include "render/plot/sweep_plot.h"
#include "sim/base/memory.h"
#include "sim/chain/spins.h"
#include "sim/kinds/output_kinds.h"
#include "sim/sweep/sweep_internal.h"

/* Series of one place: all configurations, or up to MARKS of each magnetism as marks with a key; median, mean. For decay, the means
 * of a magnetism and their two fits. */
enum { MARKS = 5, SERIES_OF_PLACE = MARKS + 2, SERIES_OF_DECAY = 3, DECAY_PANELS = 2, RULERS = 2 };
/* Numbers of the series of a place for each configuration, and for each magnetism: marks or a band, two curves. */
enum { NUMBERS_OF_EACH = 2, NUMBERS_OF_ROW = 2 * MARKS + 2 * SWEEP_PLOT_COLUMNS };
/* Points of the line of a fit. */
enum { POINTS = 65 };

/* ---- force against magnetism ---- */

/* The number of configurations of all magnetisms. */
static size_t configurations(const struct bead_sweep_statistics *s)
{
    size_t count = 0;
    for (size_t i = 0; i < s->row_count; i++)
        count += s->rows[i].count;
    return count;
}

static void add_points(struct plot_panel *part, const struct bead_sweep_statistics *s, struct bead_series series)
{
    const size_t count = configurations(s);
    series.mark = BEAD_MARK_POINTS;
    series.faint = series.jitter = true;
    double *x = plot_add_numbers(part, series, count, NUMBERS_OF_EACH);
    for (size_t i = 0; i < s->row_count; i++) {
        for (size_t k = 0; k < s->rows[i].count; k++)
            x[s->rows[i].first + k] = s->rows[i].magnetism;
    }
    memcpy(x + count, s->values, count * sizeof *x);
}

/* The label of the next series. */
static const char *name_series(struct plot_panel *part, const char *place, const char *statistic)
{
    char *text = plot_next_text(part);
    snprintf(text, sizeof(plot_text), "%s%s%s", place, *place ? ", " : "", statistic);
    return text;
}

/* One configuration of each magnetism, if there are few. All series of a place have its mark; the first has the label. */
static void add_marks(struct plot_panel *part, const struct bead_sweep_statistics *s, struct bead_series series, size_t number)
{
    size_t count = 0;
    series.mark = BEAD_MARK_POINTS;
    series.hollow = true;
    double *x = plot_add_numbers(part, series, s->row_count, NUMBERS_OF_EACH);
    for (size_t i = 0; i < s->row_count; i++) {
        if (number >= s->rows[i].count)
            continue;
        x[count] = s->rows[i].magnetism;
        x[s->row_count + count++] = s->values[s->rows[i].first + number];
    }
    plot_last(part)->count = count;
}

/* All configurations as points, or the middle half of them as a band if points of all would cover each other. */
static void add_configurations(struct plot_panel *part, const struct bead_sweep_statistics *s, const struct bead_sweep_curve *curve,
                               struct bead_series series, const char *place, bool crowded)
{
    const size_t most = sweep_plot_most_alike(curve);
    if (most > MARKS && crowded) {
        series.label = name_series(part, place, "quartiles");
        sweep_plot_add(part, series, curve, SWEEP_PLOT_QUARTILES);
    } else if (most > MARKS) {
        add_points(part, s, series);
    }
    for (size_t k = 0; most <= MARKS && k < most; k++) {
        series.label = k == 0 ? name_series(part, place, "each configuration") : NULL;
        add_marks(part, s, series, k);
    }
}

/* Means with bars of their standard errors, or medians; each curve of a panel has different dashes. */
static void add_curve(struct plot_panel *part, const struct bead_sweep_curve *curve, size_t colour, size_t line, bool median,
                      bool crowded, const char *place)
{
    const struct bead_series series = {.mark = median || crowded ? BEAD_MARK_LINE : BEAD_MARK_LINE_POINTS,
                                       .colour = colour,
                                       .shape = colour,
                                       .dash = line % BEAD_DASHES,
                                       .label = name_series(part, place, median ? "median" : "mean")};
    sweep_plot_add(part, series, curve, median ? SWEEP_PLOT_MEDIAN : SWEEP_PLOT_MEAN);
}

static enum bead_error add_rulers(struct bead_plot_data *data, size_t p, const struct bead_sweep_statistics *s,
                                  struct bead_message *msg)
{
    const struct bead_threshold *t = &s->threshold;
    struct plot_panel *part = &data->parts[p];
    struct bead_panel *panel = part->shown;
    if (!s->has_threshold)
        return BEAD_OK;
    BEAD_TRY(plot_new(&data->store, &part->rulers, RULERS, msg));
    char *plateau = plot_next_text(part), *critical = plot_next_text(part);
    panel->rulers = part->rulers;
    snprintf(plateau, sizeof(plot_text), "plateau %.3f", t->plateau);
    part->rulers[panel->ruler_count++] = (struct bead_ruler){false, t->plateau, NAN, NAN, plateau};
    if (!isfinite(t->critical))
        return BEAD_OK;
    const double error = isfinite(t->critical_error) ? t->critical_error : NAN;
    snprintf(critical, sizeof(plot_text), isnan(error) ? "*M*_c = %.3f" : "*M*_c = %.3f ± %.3f", t->critical, error);
    part->rulers[panel->ruler_count++] = (struct bead_ruler){true, t->critical, t->critical - error, t->critical + error, critical};
    return BEAD_OK;
}

/* The summaries against magnetism. */
static enum bead_error curve_of(struct bead_plot_data *data, const struct bead_sweep_statistics *s, double uncertain,
                                struct bead_sweep_curve *curve, struct bead_message *msg)
{
    BEAD_TRY(plot_new(&data->store, &curve->points, s->row_count, msg));
    for (curve->count = 0; curve->count < s->row_count; curve->count++) {
        const struct bead_sweep_row *row = &s->rows[curve->count];
        curve->points[curve->count] = (struct bead_sweep_point){
            .x = row->magnetism, .summary = row->summary, .uncertainty.mean = uncertain * row->summary.mean};
    }
    return BEAD_OK;
}

static enum bead_error add_place(struct bead_plot_data *data, size_t p, size_t place, const struct bead_sweep_statistics *s,
                                 bool crowded, struct bead_message *msg)
{
    const enum bead_sweep_show show = data->output->sweep_curves.show;
    const bool single = bead_sweep_panel(data->context.sweep, p)->places == 1, both = show == BEAD_SWEEP_BOTH;
    const char *name = single ? "" : bead_sweep_place(data->context.sweep, p, place);
    struct plot_panel *part = &data->parts[p];
    struct bead_sweep_curve curve;
    BEAD_TRY(curve_of(data, s, bead_sweep_uncertainty(data->context.sweep, p, place), &curve, msg));
    const struct bead_series each = {.colour = place, .shape = place, .dash = place % BEAD_DASHES};
    add_configurations(part, s, &curve, each, name, crowded);
    if (show != BEAD_SWEEP_MEDIAN)
        add_curve(part, &curve, place, both ? 2 * place : place, false, crowded, name);
    if (show != BEAD_SWEEP_MEAN)
        add_curve(part, &curve, single ? place + 1 : place, both ? 2 * place + 1 : place, true, crowded, name);
    return single ? add_rulers(data, p, s, msg) : BEAD_OK;
}

/* A point for each configuration, against the order of its spins. */
static void add_orders(struct bead_plot_data *data, size_t p, size_t place, const struct bead_sweep_statistics *s, int order)
{
    const struct bead_sweep *sweep = data->context.sweep;
    const struct bead_sweep_panel *panel = bead_sweep_panel(sweep, p);
    struct plot_panel *part = &data->parts[p];
    struct bead_sweep_configuration c;
    const size_t count = configurations(s);
    const struct bead_series points = {.mark = BEAD_MARK_POINTS,
                                       .colour = place,
                                       .shape = place,
                                       .label =
                                           panel->places > 1 ? name_series(part, bead_sweep_place(sweep, p, place), "each") : NULL};
    double *x = plot_add_numbers(part, points, count, NUMBERS_OF_EACH);
    for (size_t i = 0; i < count; i++)
        x[i] = bead_sweep_configuration(sweep, p, s->indices[i], &c) ? bead_spins_order(c.spins, panel->spec->cells, order) : NAN;
    memcpy(x + count, s->values, count * sizeof *x);
}

static void set_axes(struct bead_plot_data *data, size_t p)
{
    const double *range = data->output->plot.range;
    const char *against = data->output->sweep_curves.against;
    data->panels[p].x = (struct bead_graph_axis){"magnetism *M*", "", -0.02, 1.02, BEAD_SCALE_LINEAR, false};
    if (*against)
        data->panels[p].x = (struct bead_graph_axis){
            against, "", NAN, NAN, bead_order_named(against) == 0 ? BEAD_SCALE_LOG : BEAD_SCALE_LINEAR, false};
    data->panels[p].y = (struct bead_graph_axis){"peak force *F*/\u2060*F*(*M*\u00a0=\u00a01)",
                                                 "",
                                                 isnan(range[0]) ? 0 : range[0],
                                                 range[1],
                                                 BEAD_SCALE_LINEAR,
                                                 isnan(range[0])};
}

/* `statistics`: of the panel's places. */
static enum bead_error fill_magnetism(struct bead_plot_data *data, size_t p, const struct bead_sweep_statistics *statistics,
                                      bool crowded, struct bead_message *msg)
{
    const char *against = data->output->sweep_curves.against;
    const size_t places = bead_sweep_panel(data->context.sweep, p)->places;
    size_t numbers = 0;
    for (size_t k = 0; k < places; k++)
        numbers += NUMBERS_OF_EACH * configurations(&statistics[k]) + NUMBERS_OF_ROW * statistics[k].row_count;
    BEAD_TRY(plot_reserve_series(data, p, SERIES_OF_PLACE * places, numbers, msg));
    for (size_t k = 0; k < places; k++) {
        if (*against)
            add_orders(data, p, k, &statistics[k], bead_order_named(against));
        else
            BEAD_TRY(add_place(data, p, k, &statistics[k], crowded, msg));
    }
    set_axes(data, p);
    return BEAD_OK;
}

/* Statistics of all places of all panels, in a row. */
struct all {
    struct bead_sweep_statistics *of;
    size_t count;
};

static enum bead_error find_all(const struct bead_plot_data *data, struct all *all, struct bead_message *msg)
{
    const struct bead_sweep *sweep = data->context.sweep;
    size_t places = 0;
    for (size_t p = 0; p < data->count; p++)
        places += bead_sweep_panel(sweep, p)->places;
    BEAD_TRY(bead_new(&all->of, places, msg, "a plot"));
    for (size_t p = 0; p < data->count; p++) {
        for (size_t k = 0; k < bead_sweep_panel(sweep, p)->places; k++, all->count++)
            BEAD_TRY(bead_sweep_statistics(sweep, p, k, data->output->sweep_curves.threshold, &all->of[all->count], msg));
    }
    return BEAD_OK;
}

/* All panels look alike, because one legend explains them: marks only if there is room for them in each. */
static bool is_crowded(const struct all *all)
{
    enum { APART = 40 };
    bool crowded = false;
    for (size_t i = 0; i < all->count; i++)
        crowded = crowded || all->of[i].row_count > APART;
    return crowded;
}

static enum bead_error fill_spins(struct bead_plot_data *data, struct bead_message *msg)
{
    struct all all = {NULL, 0};
    enum bead_error err = find_all(data, &all, msg);
    for (size_t p = 0, used = 0; p < data->count && !err; used += bead_sweep_panel(data->context.sweep, p++)->places)
        err = fill_magnetism(data, p, all.of + used, is_crowded(&all), msg);
    for (size_t i = 0; i < all.count; i++)
        bead_sweep_statistics_free(&all.of[i]);
    free(all.of);
    return err;
}

/* ---- decay ---- */

/* The line of a fit from place `first` to `last`: exponential or power law. All look the same: each lies on its curve. */
static void add_fit(struct plot_panel *part, const struct bead_decay *fit, size_t first, size_t last, double half, bool power)
{
    const struct bead_series line = {.mark = BEAD_MARK_LINE, .colour = 5, .dash = BEAD_DASH_DOTTED};
    double *x = plot_add_numbers(part, line, POINTS, 2);
    for (size_t i = 0; i < POINTS; i++) {
        double place = (double)first * pow((double)last / (double)first, (double)i / (POINTS - 1));
        x[i] = place + half;
        x[POINTS + i] = exp(power ? fit->exponent_offset + fit->exponent * log(place) : fit->length_offset - place / fit->length);
    }
}

/* A run of a configuration ends when the front arrives, before the last beads reach their largest force, which follows the front by
 * up to about sixty beads in a thousand: this fraction of the random beads is left out. */
enum { LATE = 16 };

/* "M = 0.5, γ = 120 ± 3, F ∝ x^-0.33", as far as the fit was possible. */
static void name_profile(const struct bead_decay *fit, double uncertainty, double magnetism, int decimals, bool energy, char *word,
                         size_t size)
{
    char number[32];
    bead_number(magnetism, decimals, number, sizeof number);
    size_t used = (size_t)snprintf(word, size, "*M* = %s", number);
    if (isfinite(fit->length))
        used += (size_t)snprintf(word + used, size - used, ", *γ* = %.0f", fit->length);
    if (isfinite(fit->length) && isfinite(fit->length_error))
        used += (size_t)snprintf(word + used, size - used, " ± %.0f",
                                 hypot(fit->length_error, isfinite(uncertainty) ? uncertainty : 0));
    if (isfinite(fit->exponent))
        snprintf(word + used, size - used, ", *%s* ∝ *x*^{%s%.2f}", energy ? "E" : "F", fit->exponent < 0 ? "\u2212" : "",
                 fabs(fit->exponent));
}

/* Means in units of the clean chain's, with the exponential and the power law. */
static void add_profile(struct plot_panel *part, const struct bead_sweep *sweep, size_t index, const struct bead_sweep_decay *d,
                        bool energy, size_t number, int decimals)
{
    const struct bead_sweep_panel *panel = bead_sweep_panel(sweep, index);
    const struct bead_decay *fit = energy ? &d->of_energy : &d->of_force;
    size_t count = 0, beads = panel->beads;
    char *label = plot_next_text(part);
    struct bead_series series = {.mark = BEAD_MARK_LINE_POINTS, .label = label};
    struct bead_sweep_configuration clean;
    if (!bead_sweep_configuration(sweep, index, BEAD_SWEEP_CLEAN, &clean))
        return;
    plot_tell_apart(&series, number);
    double *x = plot_add_numbers(part, series, beads, 2);
    for (size_t i = 0; i < beads; i++)
        x[i] = energy ? d->energy[i] / clean.bead_energy[i] : d->force[i] / clean.bead_force[i];
    bead_sweep_smooth(sweep, index, x, x + beads, &count);
    const double half = 0.5 * (double)(panel->spec->last + 1 - count);
    count -= count / LATE;
    for (size_t i = 0; i < count; i++)
        x[i] = (double)i + half;
    plot_last(part)->count = count;
    name_profile(fit, d->uncertain[energy].length, d->magnetism, decimals, energy, label, sizeof(plot_text));
    const size_t end = fit->last < count ? fit->last : count - 1;
    if (isfinite(fit->length) && end > fit->first)
        add_fit(part, fit, fit->first, end, half, false);
    if (isfinite(fit->exponent) && end == fit->last)
        add_fit(part, fit, fit->last, count - 1, half, true);
}

/* Fills a panel up to the last random bead; beyond it the chain is ordered, or ends. */
static enum bead_error fill_panel(struct bead_plot_data *data, size_t p, const struct bead_sweep_decay *decays, size_t count,
                                  struct bead_message *msg)
{
    const size_t index = p / DECAY_PANELS;
    const bool energy = p % DECAY_PANELS;
    const struct bead_sweep_panel *panel = bead_sweep_panel(data->context.sweep, index);
    const double *range = data->output->plot.range;
    int decimals = 0;
    const size_t numbers = 2 * panel->beads + 2 * 2 * POINTS; /* a profile and two fits */
    BEAD_TRY(plot_reserve_series(data, p, SERIES_OF_DECAY * count, count * numbers, msg));
    for (size_t i = 0; i < count; i++) {
        const int digits = bead_magnetism_digits(decays[i].magnetism);
        decimals = digits > decimals ? digits : decimals;
    }
    for (size_t i = 0; i < count; i++)
        add_profile(&data->parts[p], data->context.sweep, index, &decays[i], energy, i, decimals);
    data->panels[p].x = (struct bead_graph_axis){"bead", "1", 0, (double)panel->spec->last, BEAD_SCALE_LINEAR, false};
    data->panels[p].y = (struct bead_graph_axis){energy ? "energy of the front *E*/\u2060*E*(*M*\u00a0=\u00a01)"
                                                        : "peak force *F*/\u2060*F*(*M*\u00a0=\u00a01)",
                                                 "",
                                                 range[0],
                                                 range[1],
                                                 BEAD_SCALE_LOG,
                                                 false};
    return BEAD_OK;
}

static enum bead_error fill_decay(struct bead_plot_data *data, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    for (size_t p = 0; p < data->count && !err; p += DECAY_PANELS) {
        struct bead_sweep_decay *decays = NULL;
        size_t count = 0;
        err = bead_sweep_decays(data->context.sweep, p / DECAY_PANELS, &decays, &count, msg);
        for (size_t i = 0; i < DECAY_PANELS && !err; i++)
            err = fill_panel(data, p + i, decays, count, msg);
        bead_sweep_decays_free(decays, count);
    }
    return err;
}

/* ---- the graph ---- */

/* Two panels of each sweep for decay, else one. */
static enum bead_error plot_sweeps(struct bead_plot_data *data, struct bead_message *msg)
{
    const bool decay = data->output->sweep_curves.show == BEAD_SWEEP_DECAY;
    const struct bead_sweep *sweep = data->context.sweep;
    const size_t each = decay ? DECAY_PANELS : 1;
    BEAD_TRY(plot_reserve(data, bead_sweep_panels(sweep) * each, msg));
    data->count = bead_sweep_panels(sweep) * each;
    for (size_t p = 0; p < data->count; p++)
        data->panels[p].title = bead_sweep_panel(sweep, p / each)->spec->title;
    return decay ? fill_decay(data, msg) : fill_spins(data, msg);
}

static sweep_plot *plot_of(const struct bead_output *output, const struct bead_sweep *sweep)
{
    const enum bead_sweep_show show = output->sweep_curves.show;
    return show == BEAD_SWEEP_SPREADING || bead_sweep_lines(show) != BEAD_SHOW_COUNT ? bead_lines_plot_fill
           : show == BEAD_SWEEP_PLANE                                                ? bead_plane_plot_fill
           : bead_sweep_panel(sweep, 0)->spec->over.key_count > 0                    ? bead_over_plot_fill
                                                                                     : plot_sweeps;
}

/* Panels whose number does not depend on results, without words. */
static enum bead_error reserve_unknown(struct bead_plot_data *data, struct bead_message *msg)
{
    const struct bead_sweep_curves_asked *asked = &data->output->sweep_curves;
    const struct bead_sweep *sweep = data->context.sweep;
    const bool own = plot_of(data->output, sweep) == plot_sweeps;
    const size_t panels = own                          ? bead_sweep_panels(sweep) * (data->apart[0] ? DECAY_PANELS : 1)
                          : bead_sweep_runs_own(asked) ? 1
                                                       : bead_sweep_panel(sweep, 0)->places;
    BEAD_TRY(plot_reserve(data, panels, msg));
    data->count = panels;
    for (size_t p = 0; p < panels; p++)
        data->panels[p].x = data->panels[p].y = (struct bead_graph_axis){.title = "", .unit = "", .low = NAN, .high = NAN};
    return BEAD_OK;
}

static enum bead_error begin(const struct bead_output *output, const struct bead_run_context *context, struct bead_plot_data **data,
                             struct bead_message *msg)
{
    BEAD_TRY(bead_new(data, 1, msg, "a plot"));
    **data = (struct bead_plot_data){.output = output, .context = *context};
    (*data)->context.scene = bead_sweep_scene(context->sweep);
    (*data)->apart[0] = (*data)->apart[1] = output->sweep_curves.show == BEAD_SWEEP_DECAY;
    return BEAD_OK;
}

BEAD_LEAVES(plot_left, struct bead_plot_data, bead_plot_data_destroy)

static enum bead_error write_plot(const struct bead_output *output, const struct bead_run_context *context, const char *path,
                                  uint64_t *bytes, struct bead_message *msg)
{
    BEAD_LEFT_TO(plot_left) struct bead_plot_data *data = NULL;
    BEAD_TRY(begin(output, context, &data, msg));
    BEAD_TRY(plot_of(output, context->sweep)(data, msg));
    return bead_plot_data_write(data, path, bytes, msg);
}

static enum bead_error check_plot(const struct bead_output *output, const struct bead_run_context *context,
                                  struct bead_message *msg)
{
    BEAD_LEFT_TO(plot_left) struct bead_plot_data *data = NULL;
    BEAD_TRY(begin(output, context, &data, msg));
    BEAD_TRY(reserve_unknown(data, msg));
    return bead_plot_data_check(data, msg);
}

static const char *sweep_plot_why(const struct bead_output *output)
{
    if (*output->sweep_curves.measure)
        return "a measure against a key, of chains that are run for it";
    if (bead_sweep_lines(output->sweep_curves.show) != BEAD_SHOW_COUNT)
        return "curves of chains that are run for them, averaged over seeds";
    if (output->sweep_curves.show == BEAD_SWEEP_PLANE)
        return "peak force by magnetism and number of cells, with the threshold, or by two keys";
    return output->sweep_curves.show == BEAD_SWEEP_SPREADING ? "how far energy has spread, in chains that are run for it"
           : output->sweep_curves.show == BEAD_SWEEP_DECAY
               ? "peaks along the chain, and how they decay"
               : "peak force against magnetism, with plateau and threshold, or against a key";
}

const struct bead_sink_type bead_sweep_plot_sink = {.name = "plot",
                                                    .help = "statistics of a sweep",
                                                    .kind = BEAD_OUTPUT_PLOT,
                                                    .check = check_plot,
                                                    .why = sweep_plot_why,
                                                    .write = write_plot};
