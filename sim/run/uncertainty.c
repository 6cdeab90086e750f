/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures the uncertainty of peaks by other runs: see uncertainty.h. */
#include "sim/run/uncertainty.h"

#include <math.h>

#include "sim/base/elementary.h"
#include "sim/base/wide.h"

/* The safety factor. The error X of a run and that of a finer one, X_q, with q of its tolerance, are scattered like normal deviates
 * of the ratio 1/q; their difference is less than a fifth of X only if X_q / X, a Cauchy deviate of scale q, lies between .8 and
 * 1.2: with a probability of (atan 1.2/q - atan .8/q) / pi, .0013 for q = .01 (and .013 for .1). */
static const double safety = 5;
/* A finer run is worth its cost if more than this part of the peaks answers strongly; else those are uncertain by their whole
 * difference to the coarser run, which is more than enough for most of them. Empirical: with .005 and .01, two chains of
 * test_uncertainty are off by more than they say; any such part fails where the few are a chain's late, chaotic maxima. */
static const double few = 0.003;
/* A chain of fewer peaks is always measured: that takes no time, and one peak alone may agree by chance. Empirical: miss_c17 of
 * tests/errors needs it, and longer chains of its kind may be missed. */
enum { SHORT = 64 };
/* Relative uncertainty of a peak that is not predictable: chosen, where .03 and .3 were tried as well. */
static const double lost = 0.1;
/* How many of a chain's peaks that are called predictable may be overtaken later, on average, were logarithms of late maxima normal
 * deviates. That is supposed, not measured: a longer tail would overtake more often. */
static const double overtaken = 1e-3;
/* Relative rounding error of a peak. */
static const double rounding = 1e-14;

/* Difference of two runs, relative to the peak; 0 after the end of either. */
static double difference(const struct bead_uncertainty_of *of, const struct bead_peak *a, const struct bead_peak *b)
{
    if (of->end > 0 && (a->time > of->end || b->time > of->end))
        return 0;
    const double largest = fmax(fabs(a->value), fabs(b->value));
    return largest > 0 ? fabs(a->value - b->value) / fabs(a->value > 0 ? a->value : largest) : 0;
}

/* Did both runs find the same maximum? */
static bool is_same(const struct bead_uncertainty_of *of, const struct bead_peak *a, const struct bead_peak *b)
{
    return !(fabs(a->time - b->time) > of->apart);
}

/* The answer of peak i to the coarser run: what this says of the error of the run itself, relative, if errors are proportional to
 * the tolerance. */
static double answer(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, size_t i)
{
    return p->coarse ? difference(of, &p->peaks[i], &p->coarse[i]) / (of->factor - 1) : 0;
}

static bool is_strong(const struct bead_uncertainty_of *of, double answer)
{
    return safety * answer > of->accuracy;
}

bool bead_uncertainty_wants_fine(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks kinds[2])
{
    size_t strong = 0, all = 0;
    for (size_t kind = 0; kind < 2; kind++) {
        for (size_t i = 0; i < kinds[kind].count; i++)
            strong += is_strong(of, answer(of, &kinds[kind], i));
        all += kinds[kind].count;
    }
    return of->accuracy > 0 && (all < SHORT || (double)strong > few * (double)all);
}

/* The usual ratio of the measured error to the answer, the geometric mean of those of all peaks that answer strongly. At most
 * factor - 1: the coarser run is not the better one. */
static double usual_ratio(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks kinds[2])
{
    double sum = 0;
    size_t count = 0;
    for (size_t kind = 0; kind < 2; kind++) {
        const struct bead_uncertain_peaks *p = &kinds[kind];
        for (size_t i = 0; p->coarse && p->fine && i < p->count; i++) {
            const double a = answer(of, p, i), error = difference(of, &p->peaks[i], &p->fine[i]);
            if (!is_strong(of, a) || !(error > 0) || safety * error > lost || !is_same(of, &p->peaks[i], &p->coarse[i]) ||
                !is_same(of, &p->peaks[i], &p->fine[i]))
                continue;
            sum += bead_log(error / a);
            count++;
        }
    }
    return count > 0 ? fmin(bead_exp(sum / (double)count), of->factor - 1) : 0;
}

/* Bound of the relative error of peak i, unless it is smaller than what was asked. */
static double error_of(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, size_t i, double ratio)
{
    const double a = answer(of, p, i);
    if (!p->fine)
        return is_strong(of, a) ? (of->factor - 1) * a : 0;
    const double measured = safety * difference(of, &p->peaks[i], &p->fine[i]);
    return p->coarse && is_same(of, &p->peaks[i], &p->coarse[i]) ? fmax(measured, ratio * a) : measured;
}

double bead_uncertainty_find(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks kinds[2])
{
    const double ratio = usual_ratio(of, kinds);
    double from = INFINITY;
    for (size_t kind = 0; kind < 2; kind++) {
        const struct bead_uncertain_peaks *p = &kinds[kind];
        for (size_t i = 0; i < p->count; i++) {
            /* steps of a given length: the runs differ by more than the better one is off */
            const double part = of->accuracy > 0 ? fmax(of->accuracy, error_of(of, p, i, ratio))
                                                 : fmax(difference(of, &p->peaks[i], &p->coarse[i]), rounding);
            p->uncertainty[i] = part * fabs(p->peaks[i].value);
            if (part > lost)
                from = fmin(from, p->fine ? fmax(p->peaks[i].time, p->fine[i].time) : p->peaks[i].time);
        }
    }
    return from;
}

/* Is peak i not known as well as asked? */
static bool is_poor(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, size_t i)
{
    return p->uncertainty[i] > of->accuracy * p->peaks[i].value;
}

double bead_uncertainty_after(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, size_t i, double from)
{
    const double own = p->peaks[i].time + of->apart;
    return own > from && !is_poor(of, p, i) ? own : from;
}

/* Did the run find a maximum after the horizon? */
static bool is_late(const struct bead_peak *peak, double from)
{
    return peak->time >= from && peak->value > 0;
}

/* The logarithm of what the late runs find in the place of peak i after the horizon; -INFINITY: nothing. */
static double late_height(const struct bead_uncertain_peaks *p, size_t i, double from)
{
    double sum = 0, count = 0;
    for (size_t r = 0; r < BEAD_UNCERTAINTY_LATE; r++) {
        if (!p->late[r] || !is_late(&p->late[r][i], from))
            continue;
        sum += bead_log(p->late[r][i].value);
        count++;
    }
    return count > 0 ? sum / count : -INFINITY;
}

/* Logarithms of maxima after the horizon are scattered with the variance s^2, which their differences x between two runs tell: the
 * mean of x^2 is 2 s^2. A third run differs from the mean of these two by 3/2 s^2. */
static double spread_of(const struct bead_uncertain_peaks kinds[2], double from)
{
    double sum = 0;
    size_t count = 0;
    for (size_t kind = 0; kind < 2; kind++) {
        const struct bead_peak *const *late = kinds[kind].late;
        for (size_t i = 0; late[0] && late[1] && i < kinds[kind].count; i++) {
            if (!is_late(&late[0][i], from) || !is_late(&late[1][i], from))
                continue;
            const double x = bead_log(late[0][i].value / late[1][i].value);
            sum += x * x;
            count++;
        }
    }
    return count > 0 ? sqrt(0.75 * sum / (double)count) : 0;
}

/* Normal deviates beyond this are no matter. */
static const double furthest = 8;

/* How many of the peaks that exceed what the late runs find by more than z standard deviations will be overtaken, on average. */
static double expected(const struct bead_uncertain_peaks kinds[2], double from, double spread, double z)
{
    double sum = 0;
    for (size_t kind = 0; kind < 2; kind++) {
        for (size_t i = 0; i < kinds[kind].count; i++) {
            const double value = kinds[kind].peaks[i].value;
            const double own = value > 0 ? (bead_log(value) - late_height(&kinds[kind], i, from)) / spread : INFINITY;
            if (own >= z && own < furthest)
                sum += bead_erfc(own * sqrt(0.5)) / 2;
        }
    }
    return sum;
}

double bead_uncertainty_reach(const struct bead_uncertain_peaks kinds[2], double from)
{
    enum { HALVINGS = 12 };
    const double spread = spread_of(kinds, from);
    double low = 0, high = furthest;
    if (!(spread > 0))
        return 1;
    for (int i = 0; i < HALVINGS; i++) {
        const double z = 0.5 * (low + high);
        *(expected(kinds, from, spread, z) > overtaken ? &low : &high) = z;
    }
    return bead_exp(high * spread);
}

/* May a later maximum after the horizon be higher than peak i? In other runs it is, or nearly. */
static bool may_be_overtaken(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, size_t i, double from,
                             double reach)
{
    const struct bead_peak *const others[] = {p->coarse, p->fine};
    for (size_t r = 0; r < sizeof others / sizeof *others; r++) {
        const struct bead_peak *other = others[r] ? &others[r][i] : NULL;
        if (other && is_late(other, from) && !is_same(of, &p->peaks[i], other) && !(of->end > 0 && other->time > of->end))
            return true;
    }
    return bead_log(reach) + late_height(p, i, from) > bead_log(p->peaks[i].value);
}

bool bead_uncertainty_is_lost(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, size_t i, double from,
                              double reach)
{
    const struct bead_peak *peak = &p->peaks[i];
    const double uncertainty = p->uncertainty[i];
    if (!(peak->time < from) && is_poor(of, p, i))
        return true;
    return uncertainty > lost * peak->value || (peak->value > 0 && may_be_overtaken(of, p, i, from, reach));
}

double bead_uncertainty_measured(double accuracy, double force, double finer)
{
    return fmax(accuracy * fabs(force), safety * fabs(force - finer));
}

bool bead_uncertainty_is_large(double value, double uncertainty)
{
    return uncertainty > lost * fabs(value);
}
