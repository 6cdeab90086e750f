/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The spread of energy against time, on logarithmic axes, with fitted power laws: a panel for each chain of a run, or for each
 * curve of a sweep's means. */
#include <math.h>

#include "render/draw/markup.h"
#include "render/draw/words.h"
#include "render/plot/sweep_plot.h"
#include "sim/sweep/sweep_lines.h"

/* Three curves, two fitted power laws, and two of theory, of two points each. */
enum { THEORIES = 2, LAWS = 2 + THEORIES, SERIES = BEAD_SPREADING_NUMBERS + LAWS };

static void set_axes(struct bead_panel *panel, const char *seconds, const double range[2])
{
    panel->x = (struct bead_graph_axis){"time", seconds, NAN, NAN, BEAD_SCALE_LOG, false};
    panel->y = (struct bead_graph_axis){"beads", "", range[0], range[1], BEAD_SCALE_LOG, false};
}

/* Adds the power law of number `n`, in its colour, from the beginning of the window to the last time. Returns its ends: times, then
 * numbers; NULL: there is none. */
static const double *add_law(struct plot_panel *part, size_t n, const double *time, const struct bead_line *exponent)
{
    char slope[32], off[32] = "", *label = plot_next_text(part);
    if (part->taken == 0 || !isfinite(exponent->slope))
        return NULL;
    bead_number(exponent->slope, 3, slope, sizeof slope);
    if (isfinite(exponent->error))
        bead_number(exponent->error, 3, off, sizeof off);
    snprintf(label, sizeof(plot_text), "exponent %s%s%s", slope, *off ? " ± " : "", off);
    double *law = plot_add_numbers(part, plot_line(NULL, NULL, 0, label, n), 2, 2);
    plot_last(part)->dash = BEAD_DASH_DOTTED;
    for (int i = 0; i < 2; i++) {
        law[i] = (i ? 1 : BEAD_SPREADING_WINDOW) * time[part->taken - 1];
        law[2 + i] = exp(exponent->offset + exponent->slope * log(law[i]));
    }
    return law;
}

/* Adds the growth of the second moment if energy runs freely, as in an ordered chain, and if it diffuses: from the beginning of its
 * fit, for as long. */
static void add_theory(struct plot_panel *part, const double *fit)
{
    static const char *const theories[THEORIES] = {"theory: ballistic, exponent 2", "theory: diffusion, exponent 1"};
    for (size_t i = 0; i < THEORIES && fit && fit[0] > 0 && fit[2] > 0; i++) {
        const double ratio = fit[1] / fit[0];
        double *law = plot_add_numbers(part, plot_line(NULL, NULL, 0, theories[i], BEAD_SPREADING_NUMBERS + i), 2, 2);
        memcpy(law, fit, 3 * sizeof *law);
        law[3] = fit[2] * (i == 0 ? ratio * ratio : ratio);
    }
}

/* Adds the curves of the numbers, which are the panel's values, [BEAD_SPREADING_NUMBERS][times], with the power laws of all but the
 * front. */
static void add_all(const struct bead_plot_data *data, struct plot_panel *part, size_t times,
                    const struct bead_line exponents[BEAD_LAWS])
{
    static const char *const names[BEAD_SPREADING_NUMBERS] = {"second moment (beads²)", "participation", "front"};
    const double *y = part->values, *fits[BEAD_SPREADING_NUMBERS] = {NULL};
    part->values += BEAD_SPREADING_NUMBERS * times;
    for (size_t n = 0; n < BEAD_SPREADING_NUMBERS; n++) {
        plot_add(part, plot_line(data->sample, y + n * times, part->taken, names[n], n));
        if (n < BEAD_LAWS)
            fits[n] = add_law(part, n, data->sample, &exponents[n]);
    }
    if (data->output->shown.theory)
        add_theory(part, fits[BEAD_SECOND_MOMENT]);
}

/* ---- of a run ---- */

static enum bead_error plot_spreading_create(struct bead_plot_data *data, struct bead_message *msg)
{
    BEAD_TRY(plot_times_create(data, BEAD_SPREADING_NUMBERS, "the energy of every bead", msg));
    BEAD_TRY(plot_new(&data->store, &data->spreading, data->count, msg));
    for (size_t p = 0; p < data->count; p++) {
        const struct bead_chain *chain = data->context.chains[data->parts[p].chain];
        BEAD_TRY(bead_spreading_begin(&data->spreading[p], chain, bead_grid_count(&data->grid), msg));
        set_axes(&data->panels[p], bead_chain_time_unit(chain), data->output->plot.range);
    }
    return BEAD_OK;
}

static void plot_spreading_needs(const struct bead_plot_data *, struct bead_needs *needs)
{
    needs->fields = BEAD_FIELD_BIT(BEAD_FIELD_ENERGY);
    needs->beads = (struct bead_span){0, SIZE_MAX};
}

static enum bead_error plot_spreading_feed(struct bead_plot_data *data, const struct bead_sample *sample, struct bead_message *)
{
    double numbers[BEAD_SPREADING_NUMBERS];
    struct plot_panel *part = plot_times_take(data, sample);
    if (!part)
        return BEAD_OK;
    bead_spreading_feed(&data->spreading[part - data->parts], sample, numbers);
    plot_times_add(data, part, numbers);
    return BEAD_OK;
}

static enum bead_error plot_spreading_finish(struct bead_plot_data *data, const struct bead_outcome *, struct bead_message *)
{
    for (size_t p = 0; p < data->count; p++) {
        struct bead_line exponents[BEAD_LAWS];
        for (int n = 0; n < BEAD_LAWS; n++)
            exponents[n] = bead_spreading_exponent(&data->spreading[p], n);
        add_all(data, &data->parts[p], bead_grid_count(&data->grid), exponents);
    }
    return BEAD_OK;
}

const struct plot_kind bead_plot_spreading = {BEAD_SHOW_SPREADING, plot_spreading_create, plot_spreading_needs, plot_spreading_feed,
                                              plot_spreading_finish};

/* ---- of a sweep ---- */

static enum bead_error fill(struct bead_plot_data *data, const struct bead_sweep_line *line, size_t p, struct bead_message *msg)
{
    const size_t rows = line->mean.rows, numbers = BEAD_SPREADING_NUMBERS * rows, laws = bead_sweep_line_law(line, 0);
    const double *mean = line->mean.values;
    struct plot_panel *part = &data->parts[p];
    struct bead_line exponents[BEAD_LAWS];
    BEAD_TRY(plot_reserve_series(data, p, SERIES, numbers + 4 * LAWS, msg));
    memcpy(part->values, mean, numbers * sizeof *mean);
    for (size_t n = 0; n < BEAD_LAWS; n++)
        exponents[n] =
            (struct bead_line){.slope = mean[laws + n], .error = line->error[laws + n], .offset = mean[laws + BEAD_LAWS + n]};
    part->taken = rows;
    add_all(data, part, rows, exponents);
    bead_markup_quote(line->name, part->title, sizeof part->title);
    set_axes(part->shown, "s", data->output->plot.range);
    return BEAD_OK;
}

enum bead_error bead_spreading_plot_fill(struct bead_plot_data *data, const struct bead_sweep_lines *lines,
                                         struct bead_message *msg)
{
    BEAD_TRY(plot_reserve(data, lines->count, msg));
    BEAD_TRY(plot_new(&data->store, &data->sample, BEAD_SWEEP_TIMES, msg));
    for (size_t i = 0; i < BEAD_SWEEP_TIMES; i++)
        data->sample[i] = bead_grid_time(&lines->grid, i);
    data->count = lines->count;
    for (size_t p = 0; p < data->count; p++)
        BEAD_TRY(fill(data, &lines->of[p], p, msg));
    return BEAD_OK;
}
