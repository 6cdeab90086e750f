/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures the uncertainty of peaks by other runs: see uncertainty.h. */
#include "sim/run/uncertainty.h"

#include <math.h>
#include <stdint.h>

#include "sim/base/elementary.h"
#include "sim/base/wide.h"
#include "sim/run/peaks.h"

/* The safety factor. The error X of a run and that of a finer one, X_q, with q of its tolerance, are scattered like normal deviates
 * of the ratio 1/q; their difference is less than a fifth of X only if X_q / X, a Cauchy deviate of scale q, lies between .8 and
 * 1.2: with a probability of (atan 1.2/q - atan .8/q) / pi, .0013 for q = .01 (and .013 for .1). */
static const double safety = 5;
/* A finer run is worth its cost if more than this part of the peaks responds strongly; else their whole difference from the coarser
 * run is their uncertainty, more than enough for most. Empirical: with .005 and .01, two chains of test_uncertainty are off by more
 * than their uncertainties; any such part fails if the few are a chain's late, chaotic maxima. */
static const double few = 0.003;
/* Chains with fewer peaks are always measured: that takes no time, and a single peak may agree by chance. Empirical: miss_c17 of
 * tests/errors needs it; longer chains of its kind may be missed. */
enum { SHORT = 64 };
/* Relative uncertainty of a peak that is not predictable: a choice; .03 and .3 were tried as well. */
static const double lost = 0.1;
/* How many of a chain's peaks called predictable may later be overtaken, on average, if logarithms of late maxima are normal
 * deviates whose scatter is known from a sample. That is assumed: a longer tail would overtake more often. */
static const double overtaken = 1e-3;
/* Neighbours whose late heights tell how much those of a peak scatter; even. Empirical: with 16, 32 and 64, 567, 691 and 719 of
 * 2000 random contacts (tests/cli/errors.sh, which asks for a third) are called predictable, and with 16 and 32 none of 43 132 rows
 * of stress_errors was missed. The more there are, the more often they belong to other parts of a chain. */
enum { ENOUGH = 32 };
/* Relative rounding error of a peak. */
static const double rounding = 1e-14;

/* The maxima of one peak in a run, the highest first. */
struct maxima {
    const struct bead_peak *most[2];
    size_t count;
};

static struct maxima maxima_of(const struct bead_uncertainty_of *of, const struct bead_peak *highest,
                               const struct bead_peak *second, size_t i)
{
    struct maxima m = {.most = {&highest[i]}, .count = 1};
    if (second && second[i].time > 0 && !(of->end > 0 && second[i].time > of->end))
        m.most[m.count++] = &second[i];
    return m;
}

/* Did both runs find the same maximum? */
static bool is_same(const struct bead_uncertainty_of *of, const struct bead_peak *a, const struct bead_peak *b)
{
    return !(fabs(a->time - b->time) > of->apart);
}

/* A run's maximum in another run; NULL: it is not among the highest there, or merges with another. */
static const struct bead_peak *same_in(const struct bead_uncertainty_of *of, const struct maxima *other,
                                       const struct bead_peak *one)
{
    for (size_t i = 0; i < other->count; i++) {
        if (is_same(of, other->most[i], one))
            return other->most[i];
    }
    return NULL;
}

/* The doubt about a peak: as a part of it; the time of its cause, s; and how much its own time is off, s. */
struct doubt {
    double part, time, shift;
};

/* The doubt about peak i, if errors of maxima are `scale` times the differences from another run; none after the end of either. */
static struct doubt doubt_by(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p,
                             const struct bead_maxima *by, size_t i, double scale)
{
    const struct bead_peak *peak = &p->peaks[i], *highest = &by->highest[i];
    const double largest = peak->value > 0 ? peak->value : fabs(highest->value);
    if (!(largest > 0) || (of->end > 0 && (peak->time > of->end || highest->time > of->end)))
        return (struct doubt){0, peak->time, 0};
    const struct maxima run = maxima_of(of, p->peaks, p->second, i), other = maxima_of(of, by->highest, by->second, i);
    const struct bead_peak *same = same_in(of, &other, peak), *second = run.count > 1 ? run.most[1] : NULL,
                           *rival = second ? same_in(of, &other, second) : NULL;
    const struct doubt doubts[] = {
        {scale * fabs(peak->value - highest->value), fmax(peak->time, highest->time),
         same == highest ? scale * fabs(peak->time - highest->time) : fabs(peak->time - highest->time)},
        {same ? scale * fabs(peak->value - same->value) : 0, peak->time, same ? scale * fabs(peak->time - same->time) : 0},
        {rival ? second->value + scale * fabs(second->value - rival->value) - peak->value : 0, rival ? second->time : peak->time,
         0}};
    struct doubt most = doubts[0];
    for (size_t d = 1; d < sizeof doubts / sizeof *doubts; d++) {
        const double shift = fmax(most.shift, doubts[d].shift);
        most = doubts[d].part > most.part ? doubts[d] : most;
        most.shift = shift;
    }
    return (struct doubt){most.part / largest, most.time, most.shift};
}

/* The peak itself in another run; NULL: another maximum took its place. The highest may have moved, unless this run also has the
 * other run's highest. */
static const struct bead_peak *itself_in(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p,
                                         const struct bead_maxima *by, size_t i)
{
    const struct maxima run = maxima_of(of, p->peaks, p->second, i), other = maxima_of(of, by->highest, by->second, i);
    const struct bead_peak *same = same_in(of, &other, run.most[0]);
    return same || same_in(of, &run, other.most[0]) ? same : other.most[0];
}

/* The relative difference of the peak itself in another run; NaN: it is not there. */
static double difference(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, const struct bead_maxima *by,
                         size_t i)
{
    const struct bead_peak *found = itself_in(of, p, by, i);
    return found ? fabs(p->peaks[i].value - found->value) / p->peaks[i].value : NAN;
}

/* The doubt from the coarser run, whose differences are factor - 1 times the run's errors if these are proportional to the
 * tolerance. */
static struct doubt answer(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, size_t i)
{
    return p->coarse.highest ? doubt_by(of, p, &p->coarse, i, safety / (of->factor - 1)) : (struct doubt){0, p->peaks[i].time, 0};
}

bool bead_uncertainty_wants_fine(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p)
{
    size_t strong = 0;
    for (size_t i = 0; i < p->count; i++)
        strong += answer(of, p, i).part > of->accuracy;
    return of->accuracy > 0 && p->count > 0 && (p->count < SHORT || (double)strong > few * (double)p->count);
}

/* The differences of a peak from both other runs. */
struct differences {
    double fine, answer; /* from the coarser run, in units of the error if errors are proportional to the tolerance */
};

/* Finds the differences of a peak that responds strongly and is not lost; else returns false. */
static bool find_differences(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, size_t i,
                             struct differences *d)
{
    if (!p->coarse.highest || !p->fine.highest)
        return false;
    *d = (struct differences){difference(of, p, &p->fine, i), difference(of, p, &p->coarse, i) / (of->factor - 1)};
    return safety * d->answer > of->accuracy && d->fine > 0 && safety * d->fine <= lost;
}

/* The usual ratio of the measured error to the answer, the geometric mean over the peaks that respond strongly and differ by
 * `least` or more. At most factor - 1, as the coarser run is not the better one. 0: there are none. */
static double usual_ratio(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, double least)
{
    double sum = 0;
    size_t count = 0;
    struct differences d;
    for (size_t i = 0; i < p->count; i++) {
        if (!find_differences(of, p, i, &d) || d.fine < least)
            continue;
        sum += bead_log(d.fine / d.answer);
        count++;
    }
    return count > 0 ? fmin(bead_exp(sum / (double)count), of->factor - 1) : 0;
}

/* The safety factor if errors fall more slowly than the tolerance, as its power p: the differences from both runs have the ratio of
 * 1 - q^p (nearly 1) to r^p - 1, and the finer run's error is q^p of the run's, while `safety` is for q. */
static double safety_for(const struct bead_uncertainty_of *of, double ratio)
{
    const double p = bead_log(1 + (of->factor - 1) / ratio) / bead_log(of->factor);
    return safety * fmax(bead_exp((p - 1) * bead_log(BEAD_UNCERTAINTY_FINER)), 1);
}

/* The largest difference from the finer run among peaks that are not lost. */
static double largest_difference(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p)
{
    double largest = 0;
    struct differences d;
    for (size_t i = 0; i < p->count; i++)
        largest = find_differences(of, p, i, &d) ? fmax(largest, d.fine) : largest;
    return largest;
}

/* The time from which peaks differ by `least` or more; INFINITY: none does. */
static double first_that_differs(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, double least)
{
    double first = INFINITY;
    struct differences d;
    for (size_t i = 0; i < p->count; i++) {
        if (find_differences(of, p, i, &d) && d.fine >= least)
            first = fmin(first, p->peaks[i].time);
    }
    return first;
}

/* The time from which the motion that differs most is not known to a tenth, with the safety factor that its own differences
 * require; INFINITY: it is. Chaos of light beads may stop at a per cent of the force on heavy ones: then no run knows it better. */
static double saturated_from(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p)
{
    const double largest = largest_difference(of, p), ratio = usual_ratio(of, p, lost * largest);
    return ratio > 0 && safety_for(of, ratio) * largest > lost ? first_that_differs(of, p, lost * largest) : INFINITY;
}

/* The doubt about peak i, at least the accuracy asked for. */
static struct doubt doubt_of(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, size_t i, double ratio)
{
    const struct doubt strong = answer(of, p, i);
    if (!(of->accuracy > 0)) /* steps of a given length: the difference of the runs is more than the better one's error */
        return doubt_by(of, p, &p->coarse, i, 1);
    if (!p->fine.highest)
        return strong.part > of->accuracy ? doubt_by(of, p, &p->coarse, i, 1) : (struct doubt){0, strong.time, strong.shift};
    struct doubt measured = doubt_by(of, p, &p->fine, i, safety);
    const struct bead_peak *coarse = p->coarse.highest ? itself_in(of, p, &p->coarse, i) : NULL;
    if (coarse) {
        const double usual = ratio / (of->factor - 1);
        measured.part = fmax(measured.part, usual * difference(of, p, &p->coarse, i)); /* fmax ignores NaN */
        measured.shift = fmax(measured.shift, usual * fabs(p->peaks[i].time - coarse->time));
    }
    return measured;
}

/* The time between the highest and the second maximum, s, if either may be the highest with errors of `part`; else 0. */
static double rival_distance(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, size_t i, double part)
{
    const struct maxima run = maxima_of(of, p->peaks, p->second, i);
    const bool close = run.count > 1 && run.most[1]->value >= (1 - 2 * fmax(part, rounding)) * run.most[0]->value;
    return close ? fabs(run.most[1]->time - run.most[0]->time) : 0;
}

double bead_uncertainty_find(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p)
{
    const double ratio = usual_ratio(of, p, 0), least = of->accuracy > 0 ? of->accuracy : rounding;
    double from = saturated_from(of, p);
    for (size_t i = 0; i < p->count; i++) {
        const struct doubt doubt = doubt_of(of, p, i, ratio);
        p->uncertainty[i] = fmax(least, doubt.part) * fabs(p->peaks[i].value);
        p->time_uncertainty[i] =
            fmax(least * p->peaks[i].time, doubt.shift) + rival_distance(of, p, i, fmax(doubt.part, answer(of, p, i).part));
        if (doubt.part > lost)
            from = fmin(from, doubt.time);
    }
    return from;
}

/* Is peak i less accurate than asked? */
static bool is_poor(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, size_t i)
{
    return p->uncertainty[i] > of->accuracy * p->peaks[i].value;
}

double bead_uncertainty_after(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, size_t i, double from)
{
    const double own = p->peaks[i].time + of->apart;
    return own > from && !is_poor(of, p, i) ? own : from;
}

/* The logarithm of the height that the other runs have at peak i's contact or bead after the horizon; -INFINITY: none. */
static double late_height(const struct bead_uncertain_peaks *p, size_t i)
{
    double sum = 0, count = 0;
    for (size_t r = 0; r < BEAD_UNCERTAINTY_LATE; r++) {
        if (!p->late[r] || !(p->late[r][i] > 0))
            continue;
        sum += bead_log(p->late[r][i]);
        count++;
    }
    return count > 0 ? sum / count : -INFINITY;
}

/* Adds the square of the difference of both other runs' late heights of peak i; false: one of them has none. */
static bool add_scatter(const struct bead_uncertain_peaks *p, size_t i, double *sum)
{
    const double *const *late = p->late;
    if (!late[0] || !late[1] || !(late[0][i] > 0) || !(late[1][i] > 0))
        return false;
    const double x = bead_log(late[0][i] / late[1][i]);
    *sum += x * x;
    return true;
}

/* By how many standard deviations peak i exceeds the other runs' late heights; INFINITY: they have none. Logarithms of heights
 * after the horizon scatter with the variance s^2, which follows from their differences x between two runs: the mean of x^2 is 2
 * s^2. A third run differs from the mean of these two by 3/2 s^2. Parts of a chain may be chaotic, and others not: its neighbours
 * count. */
static double excess(const struct bead_uncertain_peaks *p, size_t i)
{
    const double late = late_height(p, i);
    double sum = 0;
    if (!(p->peaks[i].value > 0) || !isfinite(late))
        return INFINITY;
    size_t count = add_scatter(p, i, &sum);
    for (size_t d = 1; count < ENOUGH && d < p->count; d++) {
        count += i >= d && add_scatter(p, i - d, &sum);
        count += i + d < p->count && add_scatter(p, i + d, &sum);
    }
    const double over = bead_log(p->peaks[i].value) - late, spread = count > 0 ? sqrt(0.75 * sum / (double)count) : 0;
    return spread > 0 ? over / spread : over > 0 ? INFINITY : -INFINITY;
}

/* The probability of a deviate above t, whose standard deviation is that of a sample of ENOUGH: Student's distribution, M.
 * Abramowitz and I. A. Stegun, Handbook of Mathematical Functions, 1964, 26.7.4. */
static double student_tail(double t)
{
    const double c2 = ENOUGH / (ENOUGH + t * t);
    double term = 1, sum = 1;
    for (int k = 2; k <= ENOUGH - 2; k += 2)
        sum += term *= c2 * (k - 1) / k;
    return 0.5 * (1 - sqrt(1 - c2) * sum);
}

/* Deviates beyond this do not matter. */
static const double furthest = 16;
enum { BINS = 4096 };

double bead_uncertainty_reach(const struct bead_uncertain_peaks *p)
{
    uint32_t bins[BINS] = {0};
    size_t above = BINS;
    for (size_t i = 0; i < p->count; i++) {
        const double own = excess(p, i);
        if (own >= 0 && own < furthest)
            bins[(size_t)(own * (BINS / furthest))]++;
    }
    for (double sum = 0; above > 0; above--) {
        const uint32_t count = bins[above - 1];
        sum += count > 0 ? count * student_tail((double)(above - 1) * (furthest / BINS)) : 0;
        if (sum > overtaken)
            break;
    }
    return (double)above * (furthest / BINS);
}

/* May a later maximum after the horizon be higher than peak i? It is in other runs, or nearly so. */
static bool may_be_overtaken(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks *p, size_t i, double from,
                             double reach)
{
    const struct bead_peak *const others[] = {p->coarse.highest, p->fine.highest};
    for (size_t r = 0; r < sizeof others / sizeof *others; r++) {
        const struct bead_peak *other = others[r] ? &others[r][i] : NULL;
        if (other && other->time >= from && other->value > 0 && !is_same(of, &p->peaks[i], other) &&
            !(of->end > 0 && other->time > of->end))
            return true;
    }
    return excess(p, i) < reach;
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
    return isnan(finer) ? NAN : fmax(accuracy * fabs(force), safety * fabs(force - finer));
}

bool bead_uncertainty_is_large(double value, double uncertainty)
{
    return uncertainty > lost * fabs(value);
}
