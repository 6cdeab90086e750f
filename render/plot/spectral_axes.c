/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axes, colours and exact bands of spectra, of single runs and of sweeps. */
#include <math.h>

#include "render/plot/plot_private.h"
#include "sim/base/wide.h"
#include "sim/measure/transform.h"

/* Automatic axes leave out amplitudes below this part of the largest, and extend this far beyond the highest band. */
static const double least_log = 1e-6, beyond = 1.15;
/* The lowest colour, dB of the largest amplitude. */
static const double deepest = -60;

const struct bead_graph_axis plot_wave_numbers = {"wave number × cell / π", "", 0, 1, BEAD_SCALE_LINEAR, false};

/* The top of the highest band, Hz; 0: nothing presses the contacts, so at rest they are not stiff; or there is no medium. */
static double top_of(const struct bead_medium *medium)
{
    double ends[2] = {0, 0};
    if (medium)
        bead_band(medium, medium->cell.count - 1, ends);
    return ends[1];
}

/* The end of an automatic axis of frequencies, Hz: beyond the highest band of the medium if it has any, else at the last amplitude
 * that is not small compared with the largest; a transfer shows all. */
static double reach_of(const struct bead_output *output, const struct plot_spectrum *s, double largest)
{
    const double some = output->curves.show == BEAD_SHOW_TRANSFER ? 0 : BEAD_TRANSFORM_LEAST * largest;
    const struct bead_spectral *found = s->found;
    double high = 0;
    if (top_of(s->medium) > 0)
        return beyond * top_of(s->medium);
    for (size_t i = 0; i < found->columns * found->rows; i++)
        high = found->values[i] > some ? fmax(high, (double)(i % found->rows) * found->step) : high;
    return high > 0 ? high : fmax(0, (double)found->rows - 1) * found->step; /* nothing but a mean */
}

enum bead_error plot_spectral_ranges(const struct bead_output *output, const struct plot_spectrum *all, size_t count,
                                     double *largest, double range[2], struct bead_message *msg)
{
    const double *asked = output->curves.frequencies;
    double reach = 0;
    *largest = 0;
    for (size_t k = 0; k < count; k++) {
        for (size_t i = 0; i < all[k].found->columns * all[k].found->rows; i++)
            *largest = fmax(*largest, all[k].found->values[i]);
    }
    for (size_t k = 0; k < count; k++)
        reach = fmax(reach, reach_of(output, &all[k], *largest));
    range[0] = isnan(asked[0]) ? 0 : asked[0];
    range[1] = isnan(asked[1]) ? reach : asked[1];
    return range[0] < range[1]
               ? BEAD_OK
               : bead_output_wrong(output, msg, "frequencies: from %g to %g Hz there is nothing to show", range[0], range[1]);
}

struct bead_graph_axis plot_spectral_axis(struct bead_plot_data *data, const struct bead_field_info *field, double largest)
{
    const enum bead_show show = data->output->curves.show;
    const bool transfer = show == BEAD_SHOW_TRANSFER, logarithmic = data->output->plot.scale == BEAD_SCALE_LOG;
    const double *range = data->output->plot.range,
                 low = isnan(range[0]) && logarithmic && largest > 0 ? least_log * largest : range[0];
    snprintf(data->axis_title, sizeof data->axis_title, "%s%s",
             transfer                    ? "transfer of "
             : show == BEAD_SHOW_SENSORS ? ""
                                         : "amplitude of ",
             field->title);
    return (struct bead_graph_axis){data->axis_title, transfer ? "" : field->unit, low, range[1], data->output->plot.scale, true};
}

/* The last point of each band is a break. */
struct bead_series *plot_add_bands(struct plot_panel *part, const struct bead_medium *medium)
{
    const size_t count = PLOT_BAND_POINTS * medium->cell.count;
    double *x = plot_add_numbers(part, (struct bead_series){.mark = BEAD_MARK_LINE}, count, 2), *y = x + count;
    for (size_t i = 0; i < count; i++) {
        const double at = (double)(i % PLOT_BAND_POINTS) / (PLOT_BAND_POINTS - 2), turn = (0.5 - at) * 3.14159265358979323846;
        x[i] = fmin(at, 1);
        y[i] = at > 1 ? NAN : bead_jacobi_frequency(&medium->cell, i / PLOT_BAND_POINTS, bead_sin(turn));
    }
    return plot_last(part);
}

void plot_spectral_colours(struct bead_plot_data *data, size_t p, const struct bead_spectral *spectral, double largest)
{
    for (size_t i = 0; i < spectral->columns * spectral->rows; i++)
        spectral->values[i] = fmax(2 * deepest, 20 * log10(spectral->values[i] / largest));
    data->parts[p].image =
        (struct bead_graph_image){.x = {spectral->first, spectral->first + (double)(spectral->columns - 1) * spectral->between},
                                  .y = {0, (double)(spectral->rows - 1) * spectral->step},
                                  .columns = spectral->columns,
                                  .rows = spectral->rows,
                                  .values = spectral->values,
                                  .low = deepest,
                                  .high = 0,
                                  .title = data->axis_title,
                                  .unit = "dB"};
    data->panels[p].image = &data->parts[p].image;
}

enum bead_error plot_spectral_image(struct bead_plot_data *data, size_t p, const struct plot_spectrum *spectrum, double largest,
                                    struct bead_message *msg)
{
    plot_spectral_colours(data, p, spectrum->found, largest);
    if (!(top_of(spectrum->medium) > 0))
        return BEAD_OK;
    BEAD_TRY(plot_reserve_series(data, p, 1, PLOT_BAND_VALUES * spectrum->medium->cell.count, msg));
    struct bead_series *bands = plot_add_bands(&data->parts[p], spectrum->medium);
    bands->dash = 1;
    bands->label = "exact bands";
    return BEAD_OK;
}
