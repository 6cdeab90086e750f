/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The spread of energy against time, on logarithmic axes, with fitted power laws: a panel for each chain of a run, or for each
 * curve of a sweep's means. */
#include <math.h>

#include "render/draw/markup.h"
#include "render/draw/words.h"
#include "render/plot/sweep_plot.h"
#include "sim/sweep/sweep_internal.h"
#include "sim/sweep/sweep_lines.h"

/* Three curves, two fitted power laws, and two of theory, of two points each. */
enum { LAWS = 4, SERIES = BEAD_SPREADING_NUMBERS + LAWS, LAW = 4 };
static const char *const names[BEAD_SPREADING_NUMBERS] = {"second moment (beads²)", "participation", "front"};

static void set_axes(struct bead_panel *panel, const char *seconds, const double range[2])
{
    panel->x = (struct bead_graph_axis){"time", seconds, NAN, NAN, BEAD_SCALE_LOG, false};
    panel->y = (struct bead_graph_axis){"beads", "", range[0], range[1], BEAD_SCALE_LOG, false};
}

/* Adds the curve of number `n`, and its power law in the same colour, whose values go to `law`: times, then numbers. Returns the
 * number of series. */
static size_t add(struct bead_series *series, char (*labels)[256], int n, const double *time, const double *y, size_t count,
                  const struct bead_line *exponent, double law[LAW])
{
    char slope[32], off[32] = "";
    *series = plot_line(time, y, count, labels[0], (size_t)n);
    snprintf(labels[0], sizeof *labels, "%s", names[n]);
    if (n == BEAD_FRONT || count == 0 || !isfinite(exponent->slope))
        return 1;
    for (int i = 0; i < 2; i++) {
        law[i] = (i ? 1 : BEAD_SPREADING_WINDOW) * time[count - 1];
        law[2 + i] = exp(exponent->offset + exponent->slope * log(law[i]));
    }
    bead_number(exponent->slope, 3, slope, sizeof slope);
    if (isfinite(exponent->error))
        bead_number(exponent->error, 3, off, sizeof off);
    snprintf(labels[1], sizeof *labels, "exponent %s%s%s", slope, *off ? " ± " : "", off);
    series[1] = plot_line(law, law + 2, 2, labels[1], (size_t)n);
    series[1].dash = BEAD_DASH_DOTTED;
    return 2;
}

/* Adds the growth of the second moment if energy runs freely, as in an ordered chain, and if it diffuses: from the beginning of its
 * fit, for as long. Returns the number of series. */
static size_t add_theory(struct bead_series *series, const double *fit, double (*laws)[LAW])
{
    static const struct {
        const char *name;
        int power;
    } theories[LAWS - 2] = {{"theory: ballistic, exponent 2", 2}, {"theory: diffusion, exponent 1", 1}};
    if (!(fit[0] > 0 && fit[2] > 0))
        return 0;
    for (int i = 0; i < LAWS - 2; i++) {
        double *law = laws[i], ratio = fit[1] / fit[0];
        memcpy(law, fit, 3 * sizeof *law);
        law[3] = fit[2] * (theories[i].power == 2 ? ratio * ratio : ratio);
        series[i] = plot_line(law, law + 2, 2, theories[i].name, (size_t)(BEAD_SPREADING_NUMBERS + i));
    }
    return LAWS - 2;
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
    const size_t times = bead_grid_count(&data->grid);
    for (size_t p = 0; p < data->count; p++) {
        struct plot_panel *part = &data->parts[p];
        double(*laws)[LAW] = (double(*)[LAW])(part->values + BEAD_SPREADING_NUMBERS * times);
        size_t used = 0;
        for (int n = 0; n < BEAD_SPREADING_NUMBERS; n++) {
            const struct bead_line e =
                n == BEAD_FRONT ? bead_line_of(NULL, NULL, 0) : bead_spreading_exponent(&data->spreading[p], n);
            used += add(&part->series[used], &part->labels[used], n, data->sample, part->values + (size_t)n * times, part->taken,
                        &e, laws[n % 2]);
        }
        if (data->output->shown.theory)
            used += add_theory(&part->series[used], laws[BEAD_SECOND_MOMENT], laws + 2);
        data->panels[p].series_count = used;
    }
    return BEAD_OK;
}

const struct plot_kind bead_plot_spreading = {
    BEAD_SHOW_SPREADING, true, plot_spreading_create, plot_spreading_needs, plot_spreading_feed, plot_spreading_finish};

/* ---- of a sweep ---- */

struct means {
    struct bead_series series[SERIES];
    char labels[SERIES][256], title[300];
    double law[LAWS][LAW];
};

static void fill(const struct bead_sweep_line *line, const double *time, const struct bead_output *output, struct means *m,
                 struct bead_panel *panel)
{
    const size_t rows = line->mean.rows, laws = bead_sweep_line_law(line, 0);
    const double *mean = line->mean.values;
    size_t used = 0;
    for (int n = 0; n < BEAD_SPREADING_NUMBERS; n++) {
        struct bead_line e = {.slope = NAN};
        if (n != BEAD_FRONT)
            e = (struct bead_line){.slope = mean[laws + (size_t)n],
                                   .error = line->error[laws + (size_t)n],
                                   .offset = mean[laws + BEAD_LAWS + (size_t)n]};
        used += add(&m->series[used], &m->labels[used], n, time, mean + (size_t)n * rows, rows, &e, m->law[n % 2]);
    }
    if (output->shown.theory)
        used += add_theory(&m->series[used], m->law[BEAD_SECOND_MOMENT], m->law + 2);
    bead_markup_quote(line->name, m->title, sizeof m->title);
    *panel = (struct bead_panel){.title = *m->title ? m->title : NULL, .series = m->series, .series_count = used};
    set_axes(panel, "s", output->plot.range);
}

enum bead_error bead_spreading_plot_write(struct sweep_page *page, struct bead_message *msg)
{
    struct bead_sweep_lines lines;
    struct means *means = NULL;
    double time[BEAD_SWEEP_TIMES];
    enum bead_error err =
        bead_sweep_lines_find(page->context->sweep, page->output, page->context->sweep_settings, false, &lines, msg);
    if (!err)
        err = sweep_page_reserve(page, lines.count, msg);
    if (!err)
        err = plot_new(&page->store, &means, lines.count, msg);
    for (size_t i = 0; i < BEAD_SWEEP_TIMES && !err; i++)
        time[i] = bead_grid_time(&lines.grid, i);
    for (size_t k = 0; k < lines.count && !err; k++)
        fill(&lines.of[k], time, page->output, &means[k], &page->panels[k]);
    if (!err)
        err = sweep_page_write(page, msg);
    bead_sweep_lines_free(&lines);
    return err;
}
