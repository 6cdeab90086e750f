/* Branch points of one contact: where its compression crosses zero, or nearly does. */
#include <math.h>

#include "sim/events_patch.h"

/* Roots this close, in steps, are close enough: an error e of the branch point leaves one of order e^{5/2} in the impulse. */
static const double root_close = 1e-6;
enum { ITERATIONS = 60, SAMPLES = 8 };

void bead_patch_hermite(struct bead_patch_contact *k, const double start[3], const double end[3])
{
    double c0 = start[0], c1 = start[1], c2 = 0.5 * start[2];
    /* What the cubic and higher terms have to add at the end to d, d', d''. */
    double e = end[0] - ((c0 + c1) + c2), e1 = end[1] - (c1 + 2 * c2), e2 = end[2] - 2 * c2;
    k->c[0] = c0;
    k->c[1] = c1;
    k->c[2] = c2;
    k->c[3] = (10 * e - 4 * e1) + 0.5 * e2;
    k->c[4] = (7 * e1 - 15 * e) - e2;
    k->c[5] = (6 * e - 3 * e1) + 0.5 * e2;
    k->d = c0;
    k->rate = c1;
    k->end[0] = end[0];
    k->end[1] = end[1];
}

typedef double (*polynomial)(const double c[6], double s);

static double second(const double c[6], double s)
{
    return 2 * c[2] + s * (6 * c[3] + s * (12 * c[4] + s * (20 * c[5])));
}

/* Zero of f between a and b, where its signs differ (fa at a): Newton's method, halving where that leaves the bracket. */
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
    return fa == 0 ? a : fb == 0 ? b : find_zero(c, bead_patch_value, bead_patch_slope, a, b, fa, a + (b - a) * (fa / (fa - fb)));
}

static void add(struct bead_patch_branch *branch, size_t *count, double s, bool before, bool after)
{
    if (*count < BEAD_BRANCHES_MAX)
        branch[(*count)++] = (struct bead_patch_branch){s, before, after};
}

/* Where d, closed and moving away from zero at an end of the step, comes from: the nearest zero of d - rate x + curve x^2, x steps
 * outside. Where there is none the contact has grazed; then the minimum, between two complex branch points. */
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
    double sa = bead_patch_slope(c, a), sb = bead_patch_slope(c, b);
    double s = find_zero(c, bead_patch_slope, second, a, b, sa, a + (b - a) * (sa / (sa - sb)));
    double f = bead_patch_value(c, s);
    bool closed = fa > 0;
    if ((f > 0) != closed) {
        add(branch, count, root_between(c, a, s, fa, f), closed, !closed);
        add(branch, count, root_between(c, s, b, f, fb), !closed, closed);
    } else if (closed) {
        add(branch, count, s, true, true);
    }
}

/* All within the step, from samples that part zeros and extrema. */
static void search(const struct bead_patch_contact *k, struct bead_patch_branch *branch, size_t *count)
{
    double fa = k->c[0], sa = k->c[1];
    for (int i = 1; i <= SAMPLES; i++) {
        const double a = (i - 1.0) / SAMPLES, b = (double)i / SAMPLES;
        double fb = i < SAMPLES ? bead_patch_value(k->c, b) : k->end[0];
        double sb = i < SAMPLES ? bead_patch_slope(k->c, b) : k->end[1];
        bool closed = fa > 0;
        if (closed != (fb > 0))
            add(branch, count, root_between(k->c, a, b, fa, fb), closed, !closed);
        else if (closed ? sa < 0 && sb > 0 : sa > 0 && sb < 0)
            add_turn(k->c, a, b, fa, fb, branch, count);
        fa = fb;
        sa = sb;
    }
}

size_t bead_patch_branches(const struct bead_patch_contact *k, double reach, struct bead_patch_branch branch[BEAD_BRANCHES_MAX])
{
    const double d0 = k->c[0], v0 = k->c[1], d1 = k->end[0], v1 = k->end[1];
    const bool closed0 = d0 > 0, closed1 = d1 > 0;
    size_t count = 0;
    double x, end_curve = 0.5 * second(k->c, 1);

    if (closed0 && outside(d0, v0, k->c[2], reach, &x))
        add(branch, &count, -x, false, true);
    if (closed0 != closed1 && (closed0 ? v0 < 0 && v1 < 0 : v0 > 0 && v1 > 0))
        add(branch, &count, root_between(k->c, 0, 1, d0, d1), closed0, closed1);
    else if (closed0 != closed1 || (closed0 ? v0 < 0 && v1 > 0 : v0 > 0 && v1 < 0))
        search(k, branch, &count);
    if (closed1 && outside(d1, -v1, end_curve, reach, &x))
        add(branch, &count, 1 + x, true, false);
    return count;
}
