/* Uncertainty: how well the peaks of a run are known, from those of a comparison run with other steps.
 *
 * A peak that answers to errors as most do differs between a run and one at ten times its tolerance by about as much as was asked.
 * One that differs by more answers more strongly, and so it does to the errors of the run itself. */
#ifndef BEADREEL_SIM_RUN_UNCERTAINTY_H
#define BEADREEL_SIM_RUN_UNCERTAINTY_H

#include <stddef.h>

#include "beadreel/sink.h"

/* What is compared: the accuracy that the run was made for (0: steps were given), and the comparison run's in units of it, or its
 * step where steps were given. */
struct bead_uncertainty_of {
    double accuracy, tolerance_factor;
};

/* Uncertainties of peaks 0..count-1 of a chain, of neighbours in order, in N. Where the runs differ by so much that errors have
 * stopped growing in proportion (the chain is chaotic there) peaks nearby are uncertain as well: another maximum may become the
 * largest. */
void bead_uncertainty_find(const struct bead_uncertainty_of *of, const struct bead_peak *peaks, const struct bead_peak *comparison,
                           size_t count, double *uncertainty);

#endif
