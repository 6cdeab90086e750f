/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates the uncertainty of peaks from two runs, see uncertainty.h. */
#include "sim/run/uncertainty.h"

#include <math.h>

/* Of a peak that is as it should be: so many times its part of the difference that the comparison run may make, in units of what
 * was asked, as the two runs may agree better by chance; and at most so much. With damping errors follow the tolerance. */
static const double usual = 30, usual_most = 8, damped = 3;
/* Peaks that differ by more than so many times what the comparison run may be off by answer too strongly. They are uncertain by so
 * many times their difference, this part of it from one neighbour to the next. */
static const double too_strong = 1.5, strong = 7, next = 0.75;
/* Of what the comparison run may be off by, peaks that answer as they should show no more than this. */
static const double doubtful = 4. / 30;
/* Where differences are larger than this, and than so many times what was asked, they have stopped growing in proportion to the
 * errors: the chain is chaotic there, and nobody knows what the next difference would be. */
static const double chaotic = 5e-3, chaotic_times = 100, chaos = 10;
/* Rounding leaves this part of a peak. */
static const double rounding = 1e-14;

/* Difference of the two runs, relative to the peak; none behind the end of either. */
static double difference(const struct bead_uncertainty_of *of, const struct bead_peak *a, const struct bead_peak *b)
{
    if (of->end > 0 && (a->time > of->end || b->time > of->end))
        return 0;
    const double largest = fmax(fabs(a->value), fabs(b->value));
    return largest > 0 ? fabs(a->value - b->value) / fabs(a->value > 0 ? a->value : largest) : 0;
}

/* What peaks that answer too strongly say of themselves and their neighbours: into u. Returns whether one is chaotic. */
static bool find_strong(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, double allowed)
{
    const double limit = fmax(chaotic, chaotic_times * of->accuracy);
    bool any = false;
    for (size_t i = 0; i < p->count; i++) {
        const double d = difference(of, &p->peaks[i], &p->comparison[i]);
        any = any || (d > limit && !of->damped);
        p->uncertainty[i] = of->damped || !(d > too_strong * allowed) ? 0 : d > limit ? chaos * d : strong * d;
    }
    return any;
}

/* Contact i is beside bead i: each takes what the other has. */
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

bool bead_uncertainty_is_doubtful(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks kinds[2])
{
    const double bound = doubtful * of->accuracy * of->tolerance_factor;
    bool any = false;
    if (of->damped || !(of->accuracy > 0) || !(of->tolerance_factor > 1))
        return false;
    for (size_t kind = 0; kind < 2; kind++) {
        for (size_t i = 0; i < kinds[kind].count; i++)
            any = any || difference(of, &kinds[kind].peaks[i], &kinds[kind].comparison[i]) > bound;
    }
    return any;
}

void bead_uncertainty_find(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks kinds[2])
{
    const double a = of->accuracy, allowed = a * fmax(of->tolerance_factor, 1);
    bool shaken = false;
    for (size_t kind = 0; kind < 2 && a > 0; kind++)
        shaken |= find_strong(of, &kinds[kind], allowed);
    /* Nobody knows how hard a chaotic contact strikes the rest of the chain. */
    const double least = shaken ? usual_most : 1;
    if (a > 0)
        share(kinds);
    for (size_t kind = 0; kind < 2; kind++) {
        const struct bead_uncertain_peaks *p = &kinds[kind];
        if (a > 0)
            spread(p->uncertainty, p->count);
        for (size_t i = 0; i < p->count; i++) {
            const double d = difference(of, &p->peaks[i], &p->comparison[i]), part = allowed > 0 ? d / allowed : 0;
            const double own =
                a > 0 ? a * fmax(least, of->damped ? damped * part : fmin(usual * part, usual_most)) : fmax(d, rounding);
            const double near = a > 0 ? fmin(p->uncertainty[i], fmax(1, d)) : 0;
            p->uncertainty[i] = fmax(own, near) * fabs(p->peaks[i].value);
        }
    }
}
