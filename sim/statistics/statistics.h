/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statistics of many random chains: summaries, the threshold between two regimes, lengths and exponents of decay.
 *
 * Forces are in units of that of the chain with all cells up (M = 1), or in N: nothing here depends on it unless it says so. Sums
 * go in fixed order; resampling draws from Philox, keyed by a seed: equal input gives equal bits. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/sweep.h"
#include "sim/base/internal.h"

/* Sorts `values`. count 0: all NaN. */
BEAD_INTERNAL void bead_summary_of(double *values, size_t count, struct bead_summary *summary);

/* By how much the mean, ends, median and quartiles may be off if each value may be off by its own `off`, the worst way: each of
 * them rises with every value, so it lies between that of the values less theirs and that of the values plus theirs. NaN if one is
 * not known. `room`: for `count` numbers. */
BEAD_INTERNAL void bead_summary_uncertainty(const double *values, const double *off, size_t count, double *room,
                                            struct bead_summary *uncertainty);

/* A straight line by least squares. */
struct bead_line {
    double slope, error; /* standard error */
    double offset;       /* y at x = 0 */
    double centre;       /* mean of x */
    double spread;       /* sum of (x - centre)^2 */
};
/* Through `count` points; all NaN of fewer than three, of equal x, or if a number is not finite. */
BEAD_INTERNAL struct bead_line bead_line_of(const double *x, const double *y, size_t count);

/* A mean of `all` numbers, of which a sample was taken: by how much that mean may differ from the sample's, with a probability of
 * .0013 for normal numbers; 0 if the sample is all of them, NaN if it is one number of several. Student's quantile times the
 * standard error of a sample without replacement (W. G. Cochran, Sampling Techniques, 1977, 2.6 to 2.8). */
BEAD_INTERNAL double bead_sample_error(const struct bead_summary *sample, size_t all);

/* A sample for that has one number in so many: one in 64, or at least five, or all of fewer. Student's quantiles are much larger
 * for a smaller sample. */
BEAD_INTERNAL size_t bead_sample_every(size_t all);

/* Results of one magnetism. */
struct bead_group_results {
    double magnetism;
    const double *values; /* [count], in units of the value at M = 1; all positive */
    size_t count;
};

/* A method to find M_c: row `index`, NULL after the last. */
struct bead_threshold_info {
    const char *name;
    const char *formula;
    double (*find)(const double *magnetism, const double *mean, size_t count, const struct bead_threshold *regimes);
};
BEAD_INTERNAL const struct bead_threshold_info *bead_threshold_info(size_t index);
BEAD_INTERNAL const struct bead_threshold_info *bead_threshold_info_named(const char *name); /* NULL: there is none */

/* Fit both regimes to groups of rising magnetism. The law is fitted to the means' logarithms, by least squares, where the mean is
 * above the square root of the plateau and M < 1: the upper half of the fall. Errors are deviations over `resamples` bootstrap
 * samples: configurations drawn again within each group. Errors: MEMORY; NUMBERS where there is no plateau (no M <= 0.2) or nothing
 * above it. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_threshold_fit(const struct bead_group_results *groups, size_t count,
                                                            const struct bead_threshold_info *how, size_t resamples, uint64_t seed,
                                                            struct bead_threshold *threshold, struct bead_message *msg);

/* How far errors of the means move M_c: each mean may be off by `part` of itself, either way, and all alike by `common`, as by the
 * error of the value at M = 1. NaN: no threshold. Errors: MEMORY. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_threshold_uncertainty(const struct bead_group_results *groups, size_t count,
                                                                    const struct bead_threshold_info *how, double part,
                                                                    double common, double *uncertainty, struct bead_message *msg);

/* Decay along a chain of what is 1 without disorder, y at places (beads) 0, 1, ...: exponential near the striker, y ~ exp(-x /
 * length), a power law farther on, y ~ x^exponent. */
struct bead_decay {
    double length, length_error;           /* beads; INFINITY where it does not decay */
    double rate;                           /* 1 / length; negative where it grows */
    double exponent, exponent_error;       /* NaN where the places do not reach to eight times `last` */
    double length_offset, exponent_offset; /* ln y at place 0, and at place 1, of the two lines */
    size_t first, last;                    /* places that the exponential was fitted over; the power law: from `last` on */
};

/* The place from `first` on at which the mean of ln y over `cell` places has fallen to -1, or the last one of all. */
BEAD_INTERNAL size_t bead_decay_reach(const double *logs, size_t places, size_t first, size_t cell);
/* Lines by least squares through ln y, given; places where it is not finite are left out. The errors are NaN. */
BEAD_INTERNAL void bead_decay_fit(const double *logs, size_t places, size_t first, size_t last, struct bead_decay *decay);

/* Logarithms of forces and energies, [rows][places] of configurations that differ by chance only. */
struct bead_decay_profiles {
    const double *force, *energy;
    size_t rows, places;
    size_t first, cell; /* where the wave has formed; beads of a cell, over which forces differ however clean the wave is */
};
/* Fits the means of the logarithms, that is, geometric means: the logarithm of a wave's force is a sum over the domains it has
 * passed, so its mean is that of the typical wave, and spreads least. Both use the force's range: one length, over which the
 * exponential holds for any disorder, and which has equally many domains at any. Errors are deviations over `resamples` bootstrap
 * samples of the rows, the range found anew in each; NaN below two rows. Errors: MEMORY. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_decay_of(const struct bead_decay_profiles *profiles, size_t resamples, uint64_t seed,
                                                       struct bead_decay *of_force, struct bead_decay *of_energy,
                                                       struct bead_message *msg);

/* Participation ratio (sum y)^2 / sum y^2 of what is not negative: about how many share what there is; 1 to count. NaN where all
 * are 0. */
BEAD_INTERNAL double bead_participation(const double *y, size_t count);
