/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves of an ensemble: the curves of `show: sensors`, `spectrum`, `transfer` and `dispersion`, as means over the seeds of a sweep
 * over keys, for each combination of the other keys. */
#pragma once

#include <stdio.h>

#include "beadreel/sweep.h"
#include "sim/measure/spectra.h"

struct bead_sweep_line {
    char name[200];                   /* the values of the other keys; "" if there are none */
    size_t chains;                    /* in the mean */
    struct bead_spectral mean;        /* of amplitudes, of ratios */
    double *error;                    /* [columns][rows]: standard errors; NaN of one chain */
    double *uncertainty;              /* [columns]: of the worst row, from second runs of some chains; NaN: unknown */
    double *of_frequency;             /* [columns][bands] Hz: dispersion: of the strongest lines' frequencies, in the same way */
    size_t bands;                     /* of the medium; 1 if there is none */
    const struct bead_chain *chain;   /* the first of them, */
    const struct bead_medium *medium; /* and the cell that it repeats; NULL: none */
};
struct bead_sweep_line_chain;
struct bead_sweep_lines {
    struct bead_output output;  /* as for a run */
    struct bead_sweep_line *of; /* with as many columns and rows each */
    size_t count;
    struct bead_sweep_line_chain *chains;
    size_t chain_count;
};
/* Runs all chains of the sweep: to `until`, else to the time at which the last front arrives; `checked`: some of them twice, as for
 * spreading. To be freed even after an error. Errors: those of bead_sweep_watch and bead_spectra_of. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_sweep_lines_find(const struct bead_sweep *sweep, const struct bead_output *output,
                                                               const struct bead_sweep_settings *settings, bool checked,
                                                               struct bead_sweep_lines *lines, struct bead_message *msg);
/* Writes them as comma-separated values. Errors: as above. */
BEAD_CHECK enum bead_error bead_sweep_lines_write(FILE *file, const struct bead_sweep *sweep, const struct bead_output *output,
                                                  const struct bead_sweep_settings *settings, struct bead_message *msg);
BEAD_INTERNAL void bead_sweep_lines_free(struct bead_sweep_lines *lines);
