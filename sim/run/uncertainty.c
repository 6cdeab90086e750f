/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates the uncertainty of peaks from two runs: see uncertainty.h. */
#include "sim/run/uncertainty.h"

#include <math.h>

/* Uncertainty in units of the requested accuracy, for peaks whose difference is within the error bound of the comparison run:
 * `usual` times the difference over that bound, because runs may agree better by chance; `elsewhere` times the largest such ratio
 * in the chain, because they may agree although neither is right; at most `usual_most`. With damping, errors follow the tolerance:
 * `damped` times the ratio. */
static const double usual = 30, elsewhere = 20, usual_most = 9.5, damped = 3;
/* Peaks whose ratio exceeds `too_strong` are sensitive: uncertain by `strong` times their difference, which falls by the factor
 * `next` from one neighbour to the next. */
static const double too_strong = 1.5, strong = 20, next = 0.82;
/* Relative rounding error of a peak. */
static const double rounding = 1e-14;

/* Difference of the two runs, relative to the peak; 0 after the end of either. */
static double difference(const struct bead_uncertainty_of *of, const struct bead_peak *a, const struct bead_peak *b)
{
    if (of->end > 0 && (a->time > of->end || b->time > of->end))
        return 0;
    const double largest = fmax(fabs(a->value), fabs(b->value));
    return largest > 0 ? fabs(a->value - b->value) / fabs(a->value > 0 ? a->value : largest) : 0;
}

/* Returns the largest difference in units of `allowed`, the error bound of the comparison run. Sets the uncertainties of sensitive
 * peaks, and 0 for the others. */
static double find_strong(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, double allowed)
{
    double most = 0;
    for (size_t i = 0; i < p->count; i++) {
        const double d = difference(of, &p->peaks[i], &p->comparison[i]), part = d / allowed;
        most = fmax(most, part);
        p->uncertainty[i] = !of->damped && part > too_strong ? strong * d : 0;
    }
    return most;
}

/* Contact i is beside bead i: both take the larger uncertainty. */
static void share(const struct bead_uncertain_peaks kinds[2])
{
    for (size_t i = 0; i < kinds[0].count && i < kinds[1].count; i++)
        kinds[0].uncertainty[i] = kinds[1].uncertainty[i] = fmax(kinds[0].uncertainty[i], kinds[1].uncertainty[i]);
}

static void spread(double *u, size_t count)
{
    for (size_t i = 1; i < count; i++)
        u[i] = fmax(u[i], next * u[i - 1]);
    for (size_t i = count; i-- > 1;)
        u[i - 1] = fmax(u[i - 1], next * u[i]);
}

/* In units of the requested accuracy. `part`: difference of the peak over the error bound of the comparison run, `most`: the
 * largest in the chain. */
static double usual_uncertainty(const struct bead_uncertainty_of *of, double part, double most)
{
    return fmax(1, of->damped ? damped * part : fmin(fmax(usual * part, elsewhere * most), usual_most));
}

void bead_uncertainty_find(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks kinds[2])
{
    const double a = of->accuracy, allowed = a * fmax(of->tolerance_factor, 1);
    double most = 0;
    for (size_t kind = 0; kind < 2 && a > 0; kind++)
        most = fmax(most, find_strong(of, &kinds[kind], allowed));
    if (a > 0)
        share(kinds);
    for (size_t kind = 0; kind < 2; kind++) {
        const struct bead_uncertain_peaks *p = &kinds[kind];
        if (a > 0)
            spread(p->uncertainty, p->count);
        for (size_t i = 0; i < p->count; i++) {
            const double d = difference(of, &p->peaks[i], &p->comparison[i]);
            const double own = a > 0 ? a * usual_uncertainty(of, d / allowed, most) : fmax(d, rounding);
            const double near = a > 0 ? fmin(p->uncertainty[i], fmax(1, d)) : 0;
            p->uncertainty[i] = fmax(own, near) * fabs(p->peaks[i].value);
        }
    }
}
