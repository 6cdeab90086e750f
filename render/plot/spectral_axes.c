/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axes and colours of spectra, of single runs and of sweeps. */
#include <math.h>

#include "render/plot/plot_private.h"
#include "sim/measure/transform.h"

/* Automatic axes leave out amplitudes below this part of the largest, and extend this far beyond the highest band. */
static const double least_log = 1e-6, beyond = 1.15;
/* The lowest colour, dB of the largest amplitude. */
static const double deepest = -60;

double plot_spectral_largest(const struct bead_spectral *spectral)
{
    double most = 0;
    for (size_t i = 0; i < spectral->columns * spectral->rows; i++)
        most = fmax(most, spectral->values[i]);
    return most;
}

double plot_spectral_top(const struct bead_medium *medium)
{
    double ends[2] = {0, 0};
    if (medium)
        bead_band(medium, medium->cell.count - 1, ends);
    return ends[1];
}

double plot_spectral_reach(const struct bead_output *output, const struct bead_spectral *spectral, const struct bead_medium *medium,
                           double largest)
{
    const double some = output->curves.show == BEAD_SHOW_TRANSFER ? 0 : BEAD_TRANSFORM_LEAST * largest;
    double high = 0;
    if (plot_spectral_top(medium) > 0)
        return beyond * plot_spectral_top(medium);
    for (size_t i = 0; i < spectral->columns * spectral->rows; i++)
        high = spectral->values[i] > some ? fmax(high, (double)(i % spectral->rows) * spectral->step) : high;
    return high > 0 ? high : fmax(0, (double)spectral->rows - 1) * spectral->step; /* nothing but a mean */
}

enum bead_error plot_spectral_frequencies(const struct bead_output *output, double reach, double range[2], struct bead_message *msg)
{
    const double *asked = output->curves.frequencies;
    range[0] = isnan(asked[0]) ? 0 : asked[0];
    range[1] = isnan(asked[1]) ? reach : asked[1];
    return range[0] < range[1]
               ? BEAD_OK
               : bead_output_wrong(output, msg, "frequencies: from %g to %g Hz there is nothing to show", range[0], range[1]);
}

double plot_spectral_low(const struct bead_output *output, double largest)
{
    const double low = output->plot.range[0];
    return isnan(low) && output->plot.scale == BEAD_SCALE_LOG && largest > 0 ? least_log * largest : low;
}

struct bead_graph_image plot_spectral_image(struct bead_spectral *spectral, double largest, const char *title)
{
    for (size_t i = 0; i < spectral->columns * spectral->rows; i++)
        spectral->values[i] = fmax(2 * deepest, 20 * log10(spectral->values[i] / largest));
    return (struct bead_graph_image){.x = {spectral->first, spectral->first + (double)(spectral->columns - 1) * spectral->between},
                                     .y = {0, (double)(spectral->rows - 1) * spectral->step},
                                     .columns = spectral->columns,
                                     .rows = spectral->rows,
                                     .values = spectral->values,
                                     .low = deepest,
                                     .high = 0,
                                     .title = title,
                                     .unit = "dB"};
}

struct bead_series plot_exact_bands(const struct bead_medium *medium, double *at)
{
    struct bead_series bands = plot_bands_of(medium, at);
    bands.colour = 0;
    bands.dash = 1;
    bands.label = "exact bands";
    return bands;
}
