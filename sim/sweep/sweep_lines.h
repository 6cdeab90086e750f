/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves of an ensemble: the curves of `show: sensors`, `spectrum`, `transfer`, `dispersion` and `spreading`, as means over the
 * seeds of a sweep over keys, for each combination of the other keys. */
#pragma once

#include <stdio.h>

#include "beadreel/sweep.h"
#include "sim/measure/spectra.h"
#include "sim/measure/spreading.h"

/* Spreading: the number of samples is at most this many, at times that widen from a spacing of at least 1e-10 of the end. After the
 * numbers of its curves come these of the whole: exponents of second moment and participation, and ln y of their laws at t = 1 s.
 */
enum { BEAD_SWEEP_TIMES = 1024, BEAD_LAWS = 2, BEAD_LAW_NUMBERS = 2 * BEAD_LAWS };

struct bead_sweep_line {
    char name[200];                   /* the values of the other keys; "" if there are none */
    size_t chains;                    /* in the mean */
    struct bead_spectral mean;        /* of amplitudes, of ratios; spreading: columns as in spreading.h, rows at the grid's times */
    double *error;                    /* like mean.values: standard errors; NaN of one chain */
    double *uncertainty;              /* likewise, from second runs of some chains, in all rows of a column the worst row's, for
                                       * spreading the worst so far; NULL: not asked for; NaN: unknown */
    double *of_frequency;             /* [columns][bands] Hz: dispersion: of the strongest lines' frequencies, in the same way */
    size_t bands;                     /* of the medium; 1 if there is none */
    const struct bead_chain *chain;   /* the first of them, */
    const struct bead_medium *medium; /* and the cell that it repeats; NULL: none */
};
struct bead_sweep_line_chain;
struct bead_sweep_lines {
    struct bead_output output;  /* as for a run */
    struct bead_grid grid;      /* of the samples of all chains */
    size_t laws;                /* numbers after those of the curves: BEAD_LAW_NUMBERS, or 0 */
    struct bead_sweep_line *of; /* with as many columns and rows each */
    size_t count;
    struct bead_sweep_line_chain *chains;
    size_t chain_count;
};
/* The place in mean.values, error and uncertainty of number `n` after the curves. */
static inline size_t bead_sweep_line_law(const struct bead_sweep_line *line, size_t n)
{
    return line->mean.columns * line->mean.rows + n;
}
/* Runs all chains of the sweep: to `until`, else to the time at which the last front arrives; `checked`: one in 64 chains, at least
 * five of each curve, and long ones, again at the tolerance of check runs. To be freed even after an error. Errors: those of
 * bead_sweep_watch and bead_spectra_of. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_sweep_lines_find(const struct bead_sweep *sweep, const struct bead_output *output,
                                                               const struct bead_sweep_settings *settings, bool checked,
                                                               struct bead_sweep_lines *lines, struct bead_message *msg);
/* Writes them as comma-separated values. Errors: as above. */
BEAD_CHECK enum bead_error bead_sweep_lines_write(FILE *file, const struct bead_sweep *sweep, const struct bead_output *output,
                                                  const struct bead_sweep_settings *settings, struct bead_message *msg);
BEAD_INTERNAL void bead_sweep_lines_free(struct bead_sweep_lines *lines);
