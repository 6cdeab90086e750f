/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the branch points of one contact, where its compression crosses zero or nearly does. */
#include <math.h>

#include "sim/integrate/events_patch.h"

/* An error e of a branch point, in steps, causes one of order e^{5/2} in the impulse. Newton's method squares it, and has converged
 * when it moves by less than this. */
static const double root_close = 1e-4;
enum { ITERATIONS = 60, SAMPLES = 8 };

typedef double (*polynomial)(const double c[6], double s);

static double first(const double c[6], double s)
{
    return c[1] + s * (2 * c[2] + s * (3 * c[3] + s * (4 * c[4] + s * (5 * c[5]))));
}

static double second(const double c[6], double s)
{
    return 2 * c[2] + s * (6 * c[3] + s * (12 * c[4] + s * (20 * c[5])));
}

/* Zero of f between a and b, at which its signs differ (fa at a): Newton's method, with bisection where that leaves the bracket. */
static double find_zero(const double c[6], polynomial f, polynomial slope, double a, double b, double fa, double guess)
{
    double s = guess;
    for (int i = 0; i < ITERATIONS; i++) {
        double fs = f(c, s);
        if (fs == 0)
            return s;
        if ((fs > 0) == (fa > 0))
            a = s;
        else
            b = s;
        double next = s - fs / slope(c, s);
        if (!(next > a && next < b))
            next = 0.5 * (a + b);
        double step = fabs(next - s);
        s = next;
        if (step < root_close)
            break;
    }
    return s;
}

static double root_between(const double c[6], double a, double b, double fa, double fb)
{
    return fa == 0 ? a : fb == 0 ? b : find_zero(c, bead_patch_value, first, a, b, fa, a + (b - a) * (fa / (fa - fb)));
}

static void add(struct bead_patch_branch *branch, size_t *count, double s, bool before, bool after)
{
    if (*count < BEAD_BRANCHES_MAX)
        branch[(*count)++] = (struct bead_patch_branch){.s = s, .before = before, .after = after};
}

/* The zero outside, x steps away, from which d moves towards a closed end of the step: the nearest of d - rate x + curve x^2.
 * Without one the contact has grazed: the minimum, between two complex branch points. */
static bool outside(double d, double rate, double curve, double reach, double *x)
{
    if (!(rate > 0 && d < reach * rate))
        return false;
    double under = rate * rate - 4 * curve * d;
    *x = under >= 0 ? 2 * d / (rate + sqrt(under)) : 0.5 * rate / curve;
    return true;
}

/* The minimum of a closed, or maximum of an open contact between a and b: zeros on both sides, or a near miss. */
static void add_turn(const double c[6], double a, double b, double fa, double fb, struct bead_patch_branch *branch, size_t *count)
{
    double sa = first(c, a), sb = first(c, b);
    double s = find_zero(c, first, second, a, b, sa, a + (b - a) * (sa / (sa - sb)));
    double f = bead_patch_value(c, s);
    bool closed = fa > 0;
    if ((f > 0) != closed) {
        add(branch, count, root_between(c, a, s, fa, f), closed, !closed);
        add(branch, count, root_between(c, s, b, f, fb), !closed, closed);
    } else if (closed) {
        add(branch, count, s, true, true);
    }
}

/* All branch points within the step, from samples dense enough to separate zeros and extrema. */
static void search(const double c[6], const double end[2], struct bead_patch_branch *branch, size_t *count)
{
    double fa = c[0], sa = c[1];
    for (int i = 1; i <= SAMPLES; i++) {
        const double a = (i - 1.0) / SAMPLES, b = (double)i / SAMPLES;
        double fb = i < SAMPLES ? bead_patch_value(c, b) : end[0];
        double sb = i < SAMPLES ? first(c, b) : end[1];
        bool closed = fa > 0;
        if (closed != (fb > 0))
            add(branch, count, root_between(c, a, b, fa, fb), closed, !closed);
        else if (closed ? sa < 0 && sb > 0 : sa > 0 && sb < 0)
            add_turn(c, a, b, fa, fb, branch, count);
        fa = fb;
        sa = sb;
    }
}

size_t bead_patch_branches(const double c[6], const double end[2], double reach, struct bead_patch_branch branch[BEAD_BRANCHES_MAX])
{
    const double d0 = c[0], v0 = c[1], d1 = end[0], v1 = end[1];
    const bool closed0 = d0 > 0, closed1 = d1 > 0;
    size_t count = 0;
    double x, end_curve = 0.5 * second(c, 1);

    if (closed0 && outside(d0, v0, c[2], reach, &x))
        add(branch, &count, -x, false, true);
    if (closed0 != closed1 && (closed0 ? v0 < 0 && v1 < 0 : v0 > 0 && v1 > 0))
        add(branch, &count, root_between(c, 0, 1, d0, d1), closed0, closed1);
    else if (closed0 != closed1 || (closed0 ? v0 < 0 && v1 > 0 : v0 > 0 && v1 < 0))
        search(c, end, branch, &count);
    if (closed1 && outside(d1, -v1, end_curve, reach, &x))
        add(branch, &count, 1 + x, true, false);
    return count;
}
