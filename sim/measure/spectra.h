/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spectra of runs, for tables and plots, and their curves, for those of sweeps (`show: sensors`): amplitudes of curves over
 * frequency (`show: spectrum`) and time (`spectrogram`), ratios to the driven bead (`transfer`), and amplitudes over wave number
 * and frequency (`dispersion`).
 *
 * For a spectrum, a segment of the run less its mean is multiplied by the window w (Hann's, or none) and transformed; squares of
 * amplitudes are averaged over half-overlapping segments (P. D. Welch, IEEE Trans. Audio Electroacoust. 15, 70 (1967)). Amplitudes
 * are 2 |X| / sum w: a sine between 0 and the Nyquist frequency has its own. Half of the sum of their squares is the mean square of
 * the segment, weighted by w^2, times n sum w^2 / (sum w)^2: 3/2 for Hann's, 1 for none (Parseval). A segment has as many samples
 * as fit, a number of the form 2^a 3^b 5^c. */
#pragma once

#include "beadreel/sink.h"
#include "sim/base/internal.h"
#include "sim/frequency/bands.h"

struct bead_spectra;

/* For one chain. */
struct bead_spectral {
    size_t columns, rows;  /* columns: places, segments or wave numbers; rows: frequencies, the first of them 0 */
    double step;           /* from row to row, Hz; for curves s, beginning at `first` */
    double first, between; /* segments: the middle of the first, and from one to the next, s; wave numbers: in pi by cell */
    double *values;        /* [columns][rows], in the field's unit, for `transfer` ratios (NaN where the drive is below a thousandth
                            * of its largest amplitude); the caller's */
};

/* `output` is borrowed. Errors: SCENE (with the output's place), MEMORY. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_spectra_create(const struct bead_output *output,
                                                             const struct bead_run_context *context, struct bead_spectra **made,
                                                             struct bead_message *msg);
BEAD_INTERNAL void bead_spectra_destroy(struct bead_spectra *spectra); /* NULL is allowed */
BEAD_INTERNAL struct bead_needs bead_spectra_needs(const struct bead_spectra *spectra);
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_spectra_feed(struct bead_spectra *spectra, const struct bead_sample *sample,
                                                           struct bead_message *msg);
/* After the last sample. Errors: SCENE (too few samples), MEMORY. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_spectra_of(const struct bead_spectra *spectra, size_t chain,
                                                         struct bead_spectral *found, struct bead_message *msg);
/* The cell whose bands belong to the dispersion of a chain; NULL: it repeats none, and cells are single beads. */
BEAD_INTERNAL const struct bead_medium *bead_spectra_medium(const struct bead_spectra *spectra, size_t chain);

/* A line of a dispersion: the strongest at this wave number, within a band's share of the frequencies (half-way to its neighbours).
 */
struct bead_spectral_line {
    double exact, found, amplitude; /* Hz; exact NaN: no band. `found` lies between rows, on a parabola through the logarithms of
                                     * three (with Hann's window at most 2 % of a step off) */
};
struct bead_spectral_line bead_spectral_line(const struct bead_spectral *dispersion, const struct bead_medium *medium,
                                             size_t column, size_t band);
