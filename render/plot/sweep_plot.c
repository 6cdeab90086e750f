/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots of sweeps: peak force against magnetism, with its two regimes; or the decay of peaks along the chain. */
#include <math.h>
#include <stdlib.h>

#include "render/draw/words.h"
#include "render/encode/page.h"
#include "render/plot/plot_private.h"
#include "render/plot/sweep_plot.h"
#include "sim/base/memory.h"
#include "sim/chain/spins.h"
#include "sim/kinds/output_kinds.h"
#include "sim/sweep/sweep_internal.h"

/* Series of one panel: all configurations, or up to MARKS of each magnetism as marks with a key; median, mean. For decay, the
 * means of a magnetism and their two fits. */
enum { MARKS = 5, SERIES_OF_PLACE = MARKS + 2, SERIES_OF_DECAY = 3, DECAY_PANELS = 2, RULERS = 2 };
/* Numbers of the series of a place for each magnetism, x and others, in addition to those of configurations: marks or a band, two
 * curves. */
enum { NUMBERS_OF_ROW = 2 * MARKS + 2 * 3 };
/* Points of the line of a fit. */
enum { POINTS = 65 };

/* A panel's data. */
struct panel {
    struct bead_series *series;
    struct bead_ruler rulers[RULERS];
    struct bead_sweep_statistics *statistics; /* [places] */
    struct bead_sweep_decay *decays;
    size_t decay_count, places, series_count, ruler_count, lines;
    double *numbers; /* room for numbers of further series */
    char (*words)[96];
    char ruler_words[RULERS][96];
};

struct plot {
    struct sweep_page *page;
    const struct bead_output *output;
    const struct bead_sweep *sweep;
    struct panel *panels;
};

static enum bead_error sweep_plot_reserve(struct plot *plot, struct panel *p, size_t series, size_t numbers,
                                          struct bead_message *msg)
{
    BEAD_TRY(plot_new(&plot->page->store, &p->series, series, msg));
    BEAD_TRY(plot_new(&plot->page->store, &p->numbers, numbers, msg));
    return plot_new(&plot->page->store, &p->words, series, msg);
}

/* Adds a series of `count` points and returns `columns` arrays for its numbers: x, y unless given, and others. */
static double *add_series(struct panel *p, struct bead_series series, size_t count, size_t columns)
{
    double *x = p->numbers;
    p->numbers += count * columns;
    series.x = x;
    series.y = series.y ? series.y : x + count;
    series.count = count;
    p->series[p->series_count++] = series;
    return x;
}

/* The label of the next series. */
static const char *name_series(struct panel *p, const char *place, const char *statistic)
{
    char *word = p->words[p->series_count];
    snprintf(word, sizeof *p->words, "%s%s%s", place, *place ? ", " : "", statistic);
    return word;
}

/* ---- force against magnetism ---- */

/* The number of configurations of all magnetisms. */
static size_t configurations(const struct bead_sweep_statistics *s)
{
    size_t count = 0;
    for (size_t i = 0; i < s->row_count; i++)
        count += s->rows[i].count;
    return count;
}

static void add_points(struct panel *p, const struct bead_sweep_statistics *s, size_t colour)
{
    const struct bead_series points = {
        .y = s->values, .mark = BEAD_MARK_POINTS, .colour = colour, .shape = colour, .faint = true, .jitter = true};
    double *x = add_series(p, points, configurations(s), 1);
    for (size_t i = 0; i < s->row_count; i++) {
        for (size_t k = 0; k < s->rows[i].count; k++)
            x[s->rows[i].first + k] = s->rows[i].magnetism;
    }
}

/* The middle half of the configurations, if points of all would cover each other. */
static void add_band(struct panel *p, const struct bead_sweep_statistics *s, size_t colour, const char *place)
{
    const size_t n = s->row_count;
    const struct bead_series band = {.mark = BEAD_MARK_BAND,
                                     .colour = colour,
                                     .dash = colour % BEAD_DASHES,
                                     .faint = true,
                                     .label = name_series(p, place, "quartiles")};
    double *x = add_series(p, band, n, 3);
    for (size_t i = 0; i < n; i++) {
        x[i] = s->rows[i].magnetism;
        x[n + i] = s->rows[i].summary.quartile[0];
        x[2 * n + i] = s->rows[i].summary.quartile[1];
    }
    p->series[p->series_count - 1].upper = x + 2 * n;
}

static size_t sweep_plot_most_configurations(const struct bead_sweep_statistics *s)
{
    size_t most = 0;
    for (size_t i = 0; i < s->row_count; i++)
        most = s->rows[i].count > most ? s->rows[i].count : most;
    return most;
}

/* One configuration of each magnetism, if there are few. All series of a place have its mark; the first has the label. */
static void add_marks(struct panel *p, const struct bead_sweep_statistics *s, size_t colour, const char *place, size_t number)
{
    const struct bead_series marks = {.mark = BEAD_MARK_POINTS,
                                      .colour = colour,
                                      .shape = colour,
                                      .hollow = true,
                                      .label = number == 0 ? name_series(p, place, "each configuration") : NULL};
    double *x = add_series(p, marks, s->row_count, 2);
    size_t count = 0;
    for (size_t i = 0; i < s->row_count; i++) {
        if (number >= s->rows[i].count)
            continue;
        x[count] = s->rows[i].magnetism;
        x[s->row_count + count++] = s->values[s->rows[i].first + number];
    }
    p->series[p->series_count - 1].count = count;
}

static void add_configurations(struct panel *p, const struct bead_sweep_statistics *s, size_t colour, const char *place,
                               bool crowded)
{
    size_t most = sweep_plot_most_configurations(s);
    if (most > MARKS && crowded)
        add_band(p, s, colour, place);
    else if (most > MARKS)
        add_points(p, s, colour);
    for (size_t k = 0; most <= MARKS && k < most; k++)
        add_marks(p, s, colour, place, k);
}

/* Means with bars of their standard errors, or medians; each curve of a panel has different dashes. */
static void add_curve(struct panel *p, const struct bead_sweep_statistics *s, double uncertain, size_t colour, bool median,
                      bool crowded, const char *place)
{
    const size_t n = s->row_count;
    const struct bead_series curve = {.mark = median || crowded ? BEAD_MARK_LINE : BEAD_MARK_LINE_POINTS,
                                      .colour = colour,
                                      .shape = colour,
                                      .dash = p->lines++ % BEAD_DASHES,
                                      .label = name_series(p, place, median ? "median" : "mean")};
    double *x = add_series(p, curve, n, 3);
    for (size_t i = 0; i < n; i++) {
        const struct bead_summary *m = &s->rows[i].summary;
        x[i] = s->rows[i].magnetism;
        x[n + i] = median ? m->median : m->mean;
        x[2 * n + i] = plot_bar_of_mean(m, uncertain * m->mean);
    }
    p->series[p->series_count - 1].error = !median ? x + 2 * n : NULL;
}

static void add_rulers(struct panel *p, const struct bead_sweep_statistics *s)
{
    const struct bead_threshold *t = &s->threshold;
    if (!s->has_threshold)
        return;
    snprintf(p->ruler_words[0], sizeof p->ruler_words[0], "plateau %.3f", t->plateau);
    p->rulers[p->ruler_count++] = (struct bead_ruler){false, t->plateau, NAN, NAN, p->ruler_words[0]};
    if (!isfinite(t->critical))
        return;
    bool error = isfinite(t->critical_error);
    if (error)
        snprintf(p->ruler_words[1], sizeof p->ruler_words[1], "*M*_c = %.3f ± %.3f", t->critical, t->critical_error);
    else
        snprintf(p->ruler_words[1], sizeof p->ruler_words[1], "*M*_c = %.3f", t->critical);
    p->rulers[p->ruler_count++] = (struct bead_ruler){true, t->critical, error ? t->critical - t->critical_error : NAN,
                                                      error ? t->critical + t->critical_error : NAN, p->ruler_words[1]};
}

static enum bead_error find_statistics(struct plot *plot, size_t index, struct bead_message *msg)
{
    struct panel *p = &plot->panels[index];
    const size_t places = bead_sweep_panel(plot->sweep, index)->places;
    enum bead_error err = BEAD_OK;
    BEAD_TRY(plot_new(&plot->page->store, &p->statistics, places, msg));
    for (; !err && p->places < places; p->places += !err)
        err = bead_sweep_statistics(plot->sweep, index, p->places, plot->output->sweep_curves.threshold, &p->statistics[p->places],
                                    msg);
    return err;
}

/* All panels look alike, because one legend explains them: marks only if there is room for them in each. */
static bool is_crowded(const struct plot *plot)
{
    enum { APART = 40 };
    for (size_t i = 0; i < plot->page->count; i++) {
        for (size_t k = 0; k < plot->panels[i].places; k++) {
            if (plot->panels[i].statistics[k].row_count > APART)
                return true;
        }
    }
    return false;
}

static void add_place(struct panel *p, size_t place, double uncertain, const char *name, enum bead_sweep_show show, bool crowded)
{
    const struct bead_sweep_statistics *s = &p->statistics[place];
    const bool single = p->places == 1;
    add_configurations(p, s, place, name, crowded);
    if (show != BEAD_SWEEP_MEDIAN)
        add_curve(p, s, uncertain, place, false, crowded, name);
    if (show != BEAD_SWEEP_MEAN)
        add_curve(p, s, uncertain, single ? place + 1 : place, true, crowded, name);
    if (single)
        add_rulers(p, s);
}

/* A point for each configuration, against the order of its spins. */
static void add_orders(const struct plot *plot, size_t index, size_t place, const char *name, int order)
{
    struct panel *p = &plot->panels[index];
    const struct bead_sweep_statistics *s = &p->statistics[place];
    struct bead_sweep_configuration c;
    const size_t count = configurations(s);
    const struct bead_series points = {.y = s->values,
                                       .mark = BEAD_MARK_POINTS,
                                       .colour = place,
                                       .shape = place,
                                       .label = *name ? name_series(p, name, "each") : NULL};
    double *x = add_series(p, points, count, 1);
    for (size_t i = 0; i < count; i++) {
        x[i] = NAN;
        if (bead_sweep_configuration(plot->sweep, index, s->indices[i], &c))
            x[i] = bead_spins_order(c.spins, bead_sweep_panel(plot->sweep, index)->spec->cells, order);
    }
}

static enum bead_error fill_magnetism(struct plot *plot, size_t index, struct bead_message *msg)
{
    struct panel *p = &plot->panels[index];
    const struct bead_plot_asked *asked = &plot->output->plot;
    const enum bead_sweep_show show = plot->output->sweep_curves.show;
    const char *against = plot->output->sweep_curves.against;
    size_t numbers = 0;
    for (size_t place = 0; place < p->places; place++)
        numbers += configurations(&p->statistics[place]) + NUMBERS_OF_ROW * p->statistics[place].row_count;
    BEAD_TRY(sweep_plot_reserve(plot, p, SERIES_OF_PLACE * p->places, numbers, msg));
    for (size_t place = 0; place < p->places; place++) {
        const char *name = p->places > 1 ? bead_sweep_place(plot->sweep, index, place) : "";
        if (*against)
            add_orders(plot, index, place, name, bead_order_named(against));
        else
            add_place(p, place, bead_sweep_uncertainty(plot->sweep, index, place), name, show, is_crowded(plot));
    }
    struct bead_panel *shown = &plot->page->panels[index];
    shown->x = (struct bead_graph_axis){.title = "magnetism *M*", .unit = "", .low = -0.02, .high = 1.02};
    if (*against)
        shown->x = (struct bead_graph_axis){.title = against,
                                            .low = NAN,
                                            .high = NAN,
                                            .unit = "",
                                            .scale = bead_order_named(against) == 0 ? BEAD_SCALE_LOG : BEAD_SCALE_LINEAR};
    shown->y = (struct bead_graph_axis){.title = "peak force *F*/\u2060*F*(*M*\u00a0=\u00a01)",
                                        .unit = "",
                                        .low = isnan(asked->range[0]) ? 0 : asked->range[0],
                                        .high = asked->range[1],
                                        .zero = isnan(asked->range[0])};
    return BEAD_OK;
}

/* ---- decay ---- */

/* The line of a fit from place `first` to `last`: exponential or power law. All look the same: each lies on its curve. */
static void add_fit(struct panel *p, const struct bead_decay *fit, size_t first, size_t last, double half, bool power)
{
    const struct bead_series line = {.mark = BEAD_MARK_LINE, .colour = 5, .dash = BEAD_DASH_DOTTED};
    double *x = add_series(p, line, POINTS, 2);
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
static void add_profile(struct panel *p, const struct plot *plot, size_t index, const struct bead_sweep_decay *d, bool energy,
                        size_t number, int decimals)
{
    const struct bead_sweep_panel *panel = bead_sweep_panel(plot->sweep, index);
    const struct bead_decay *fit = energy ? &d->of_energy : &d->of_force;
    size_t count = 0, beads = panel->beads;
    char *word = p->words[p->series_count];
    double *x = add_series(p, (struct bead_series){.mark = BEAD_MARK_LINE_POINTS, .label = word}, beads, 2);
    struct bead_series *series = &p->series[p->series_count - 1];
    struct bead_sweep_configuration clean;
    if (!bead_sweep_configuration(plot->sweep, index, BEAD_SWEEP_CLEAN, &clean))
        return;
    for (size_t i = 0; i < beads; i++)
        x[i] = energy ? d->energy[i] / clean.bead_energy[i] : d->force[i] / clean.bead_force[i];
    bead_sweep_smooth(plot->sweep, index, x, x + beads, &count);
    const double half = 0.5 * (double)(panel->spec->last + 1 - count);
    count -= count / LATE;
    for (size_t i = 0; i < count; i++)
        x[i] = (double)i + half;
    series->count = count;
    name_profile(fit, d->uncertain[energy].length, d->magnetism, decimals, energy, word, sizeof *p->words);
    plot_tell_apart(series, number);
    const size_t end = fit->last < count ? fit->last : count - 1;
    if (isfinite(fit->length) && end > fit->first)
        add_fit(p, fit, fit->first, end, half, false);
    if (isfinite(fit->exponent) && end == fit->last)
        add_fit(p, fit, fit->last, count - 1, half, true);
}

/* Fills a panel up to the last random bead; beyond it the chain is ordered, or ends. */
static enum bead_error fill_decay(struct plot *plot, size_t place, struct bead_message *msg)
{
    const size_t index = place / DECAY_PANELS;
    const bool energy = place % DECAY_PANELS;
    struct panel *p = &plot->panels[place];
    int decimals = 0;
    BEAD_TRY(bead_sweep_decays(plot->sweep, index, &p->decays, &p->decay_count, msg));
    const size_t numbers = 2 * bead_sweep_panel(plot->sweep, index)->beads + 2 * 2 * POINTS; /* a profile and two fits */
    BEAD_TRY(sweep_plot_reserve(plot, p, SERIES_OF_DECAY * p->decay_count, p->decay_count * numbers, msg));
    for (size_t i = 0; i < p->decay_count; i++) {
        const int digits = bead_magnetism_digits(p->decays[i].magnetism);
        decimals = digits > decimals ? digits : decimals;
    }
    for (size_t i = 0; i < p->decay_count; i++)
        add_profile(p, plot, index, &p->decays[i], energy, i, decimals);
    struct bead_panel *shown = &plot->page->panels[place];
    const double last = (double)bead_sweep_panel(plot->sweep, index)->spec->last;
    shown->x = (struct bead_graph_axis){.title = "bead", .unit = "1", .low = 0, .high = last};
    shown->y = (struct bead_graph_axis){.title = energy ? "energy of the front *E*/\u2060*E*(*M*\u00a0=\u00a01)"
                                                        : "peak force *F*/\u2060*F*(*M*\u00a0=\u00a01)",
                                        .unit = "",
                                        .low = plot->output->plot.range[0],
                                        .high = plot->output->plot.range[1],
                                        .scale = BEAD_SCALE_LOG};
    return BEAD_OK;
}

/* ---- the graph ---- */

static enum bead_error fill(struct plot *plot, bool decay, struct bead_message *msg)
{
    struct sweep_page *page = plot->page;
    BEAD_TRY(sweep_page_reserve(page, bead_sweep_panels(plot->sweep) * (decay ? DECAY_PANELS : 1), msg));
    BEAD_TRY(plot_new(&page->store, &plot->panels, page->count, msg));
    for (size_t i = 0; i < page->count && !decay; i++)
        BEAD_TRY(find_statistics(plot, i, msg));
    for (size_t i = 0; i < page->count; i++) {
        struct panel *p = &plot->panels[i];
        BEAD_TRY(decay ? fill_decay(plot, i, msg) : fill_magnetism(plot, i, msg));
        const char *name = bead_sweep_panel(plot->sweep, decay ? i / DECAY_PANELS : i)->spec->title;
        page->panels[i].title = *name ? name : NULL;
        page->panels[i].series = p->series;
        page->panels[i].series_count = p->series_count;
        page->panels[i].rulers = p->rulers;
        page->panels[i].ruler_count = p->ruler_count;
    }
    page->apart = decay;
    return sweep_page_write(page, msg);
}

static enum bead_error write_spins(struct sweep_page *page, struct bead_message *msg)
{
    struct plot plot = {.page = page, .output = page->output, .sweep = page->context->sweep};
    enum bead_error err = fill(&plot, page->output->sweep_curves.show == BEAD_SWEEP_DECAY, msg);
    for (size_t i = 0; plot.panels && i < page->count; i++) {
        for (size_t k = 0; k < plot.panels[i].places; k++)
            bead_sweep_statistics_free(&plot.panels[i].statistics[k]);
        bead_sweep_decays_free(plot.panels[i].decays, plot.panels[i].decay_count);
    }
    return err;
}

static sweep_plot *plot_of(const struct bead_output *output, const struct bead_sweep *sweep)
{
    const enum bead_sweep_show show = output->sweep_curves.show;
    return show == BEAD_SWEEP_SPREADING                           ? bead_spreading_plot_write
           : bead_sweep_lines(show) != BEAD_SHOW_COUNT            ? bead_lines_plot_write
           : show == BEAD_SWEEP_PLANE                             ? bead_plane_plot_write
           : bead_sweep_panel(sweep, 0)->spec->over.key_count > 0 ? bead_over_plot_write
                                                                  : write_spins;
}

static enum bead_error write_plot(const struct bead_output *output, const struct bead_run_context *context, const char *path,
                                  uint64_t *bytes, struct bead_message *msg)
{
    struct sweep_page page = {.output = output, .context = context, .path = path, .bytes = bytes};
    enum bead_error err = plot_of(output, context->sweep)(&page, msg);
    plot_store_free(&page.store);
    return err;
}

/* Panels whose number does not depend on results, without words. */
static enum bead_error check_plot(const struct bead_output *output, const struct bead_run_context *context,
                                  struct bead_message *msg)
{
    const struct bead_sweep_curves_asked *asked = &output->sweep_curves;
    const bool decay = asked->show == BEAD_SWEEP_DECAY;
    sweep_plot *const plot = plot_of(output, context->sweep);
    const size_t panels = plot == write_spins          ? bead_sweep_panels(context->sweep) * (decay ? DECAY_PANELS : 1)
                          : bead_sweep_runs_own(asked) ? 1
                                                       : bead_sweep_panel(context->sweep, 0)->places;
    struct sweep_page page = {.output = output, .context = context, .apart = decay};
    enum bead_error err = sweep_page_reserve(&page, panels, msg);
    for (size_t i = 0; i < panels && !err; i++)
        page.panels[i].x = page.panels[i].y = (struct bead_graph_axis){.title = "", .unit = "", .low = NAN, .high = NAN};
    if (!err)
        err = sweep_page_check(&page, msg);
    plot_store_free(&page.store);
    return err;
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
