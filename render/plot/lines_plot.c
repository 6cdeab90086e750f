/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves of the chains of a sweep over keys, means over seeds with a band of a standard error on both sides: a panel for each
 * place. A dispersion is an image with the exact bands over it, a panel for each combination of the other keys. */
#include <math.h>

#include "render/draw/markup.h"
#include "render/plot/sweep_plot.h"
#include "sim/measure/places.h"
#include "sim/sweep/sweep_lines.h"

/* Series for each curve, its band and itself, with numbers for each of its points. */
enum { SERIES = 2, NUMBERS = 2 * 3 };

static void label(const struct bead_sweep_line *line, char *text, size_t size)
{
    char mean[60] = "";
    if (line->chains > 1)
        snprintf(mean, sizeof mean, "mean of %zu chains", line->chains);
    bead_markup_quote(line->name, text, size);
    const size_t used = strlen(text);
    snprintf(text + used, size - used, "%s%s", used > 0 && *mean ? ", " : "", mean);
}

/* The ranges of frequencies (of `show: sensors`, times) and of amplitudes. */
static enum bead_error find_ranges(struct bead_plot_data *data, const struct bead_sweep_lines *lines, struct plot_spectrum **all,
                                   double *largest, double range[2], struct bead_message *msg)
{
    const struct bead_spectral *first = &lines->of[0].mean;
    *largest = 0;
    range[0] = first->first;
    range[1] = first->first + (double)(first->rows - 1) * first->step;
    BEAD_TRY(plot_new(&data->store, all, lines->count, msg));
    for (size_t k = 0; k < lines->count; k++)
        (*all)[k] = (struct plot_spectrum){&lines->of[k].mean, lines->of[k].medium};
    return data->output->curves.show == BEAD_SHOW_SENSORS
               ? BEAD_OK
               : plot_spectral_ranges(data->output, *all, lines->count, largest, range, msg);
}

/* ---- curves ---- */

/* Adds a series whose x are times or frequencies from `first` on; returns its y. */
static double *add(struct plot_panel *part, const struct bead_spectral *mean, double first, const char *words, size_t k)
{
    double *x = plot_add_numbers(part, plot_line(NULL, NULL, 0, *words ? words : NULL, k), mean->rows, 3);
    for (size_t i = 0; i < mean->rows; i++)
        x[i] = first + (double)i * mean->step;
    return x + mean->rows;
}

static void add_line(struct plot_panel *part, const struct bead_sweep_line *line, size_t place, bool sensors, size_t k)
{
    const size_t n = line->mean.rows;
    const double first = sensors ? line->mean.first : 0;
    const double *mean = line->mean.values + place * n, *error = line->error + place * n;
    char *words = plot_next_text(part);
    if (line->chains > 1) {
        double *low = add(part, &line->mean, first, k == 0 ? "± standard error" : "", k), *high = low + n;
        for (size_t i = 0; i < n; i++) {
            low[i] = mean[i] - error[i];
            high[i] = mean[i] + error[i];
        }
        plot_last(part)->upper = high;
        plot_last(part)->faint = true;
        plot_last(part)->mark = BEAD_MARK_BAND;
    }
    label(line, words, sizeof(plot_text));
    memcpy(add(part, &line->mean, first, words, k), mean, n * sizeof *mean);
}

static enum bead_error fill_curves(struct bead_plot_data *data, const struct bead_sweep_lines *lines, size_t place,
                                   const double range[2], double largest, struct bead_message *msg)
{
    const bool sensors = data->output->curves.show == BEAD_SHOW_SENSORS;
    const struct bead_chain *chain = lines->of[0].chain;
    const struct bead_place_shown shown = bead_place_shown(data->output, chain, place);
    struct plot_panel *part = &data->parts[place];
    BEAD_TRY(plot_reserve_series(data, place, SERIES * lines->count, NUMBERS * lines->count * lines->of[0].mean.rows, msg));
    for (size_t k = 0; k < lines->count; k++)
        add_line(part, &lines->of[k], place, sensors, k);
    part->shown->x = (struct bead_graph_axis){
        sensors ? "time" : "frequency", sensors ? "s" : "Hz", range[0], range[1], BEAD_SCALE_LINEAR, false};
    part->shown->y = plot_spectral_axis(data, bead_chain_field(chain, shown.field), largest);
    bead_markup_quote(shown.name, part->title, sizeof part->title);
    return BEAD_OK;
}

/* ---- images ---- */

/* The panel keeps the amplitudes. */
static enum bead_error fill_image(struct bead_plot_data *data, struct bead_sweep_line *line, size_t p, const double range[2],
                                  double largest, struct bead_message *msg)
{
    struct plot_panel *part = &data->parts[p];
    if (line->mean.columns < 2 || !(largest > 0))
        return bead_output_wrong(data->output, msg, "show: there are no waves, or only one column of amplitudes");
    part->spectral = line->mean;
    line->mean.values = NULL;
    (void)plot_spectral_axis(data, bead_chain_field(line->chain, data->output->shown.field), largest);
    BEAD_TRY(plot_spectral_image(data, p, &(struct plot_spectrum){&part->spectral, line->medium}, largest, msg));
    label(line, part->title, sizeof part->title);
    part->shown->x = plot_wave_numbers;
    part->shown->y = (struct bead_graph_axis){"frequency", "Hz", range[0], range[1], BEAD_SCALE_LINEAR, false};
    return BEAD_OK;
}

/* ---- the graph ---- */

static enum bead_error fill(struct bead_plot_data *data, const struct bead_sweep_lines *lines, struct bead_message *msg)
{
    const bool images = data->output->curves.show == BEAD_SHOW_DISPERSION;
    const size_t panels = images ? lines->count : lines->of[0].mean.columns;
    struct plot_spectrum *all = NULL;
    double range[2], largest;
    BEAD_TRY(find_ranges(data, lines, &all, &largest, range, msg));
    BEAD_TRY(plot_reserve(data, panels, msg));
    data->count = panels;
    for (size_t p = 0; p < panels; p++)
        BEAD_TRY(images ? fill_image(data, &lines->of[p], p, range, largest, msg)
                        : fill_curves(data, lines, p, range, largest, msg));
    return BEAD_OK;
}

enum bead_error bead_lines_plot_fill(struct bead_plot_data *data, struct bead_message *msg)
{
    BEAD_LEFT_TO(bead_sweep_lines_free) struct bead_sweep_lines lines;
    BEAD_TRY(bead_sweep_lines_find(data->context.sweep, data->output, data->context.sweep_settings, false, &lines, msg));
    return lines.laws > 0 ? bead_spreading_plot_fill(data, &lines, msg) : fill(data, &lines, msg);
}
