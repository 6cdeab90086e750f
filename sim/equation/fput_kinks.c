/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds when a spring of a piecewise linear string passes from one stiffness to the other. The stiffness jumps there, so no method
 * keeps its order over such a point, and steps end at it. */
#include <float.h>
#include <math.h>

#include "sim/equation/fput_string.h"
#include "sim/integrate/dense.h"

/* Springs pass a little behind the kink, by some roundings of the strain: this way they do not come back by rounding, and those
 * that pass at the same time, by symmetry, do so in one step. Tensions are continuous, so the energy is wrong by the square of
 * this. */
static double slack(const struct bead_string_stepper *s, const struct bead_string_state *at, size_t j)
{
    const struct bead_string *string = &s->string;
    const double *u = at->u;
    double left = j > 0 ? u[j - 1] : u[string->masses - 1], right = j < string->masses ? u[j] : 0;
    return 64 * DBL_EPSILON * (string->spec->piecewise.beyond + fabs(string->stretch) + fabs(left) + fabs(right));
}

/* The ways out of a branch: two from the middle, one from the others. */
static size_t ways_out(const struct bead_string *string, size_t j, struct bead_string_kink way[2])
{
    const double branch = string->branch[j], beyond = string->spec->piecewise.beyond;
    way[0] = (struct bead_string_kink){INFINITY, j, branch != 0 ? -branch : 1, branch != 0 ? -beyond : beyond};
    way[1] = (struct bead_string_kink){INFINITY, j, -1, beyond};
    return branch != 0 ? 1 : 2;
}

/* The strain over the last step, times a sign. */
static struct bead_polynomial strain_of(const struct bead_string_stepper *s, size_t j, double sign)
{
    const struct bead_string *string = &s->string;
    const struct bead_string_state *const ends[] = {&s->start, &s->end};
    double at[2][4], h = s->end.t - s->start.t;
    for (int i = 0; i < 2; i++) {
        at[i][0] = sign * bead_string_strain(string, ends[i]->u, j);
        at[i][1] = sign * h * bead_string_difference(string, ends[i]->v, j);
        at[i][2] = sign * h * h * bead_string_difference(string, ends[i]->a, j);
        at[i][3] = sign * h * h * h * bead_string_difference(string, s->jerk[i], j);
    }
    return bead_polynomial_hermite(at[0], at[1]);
}

struct bead_string_kink bead_string_first_kink(const struct bead_string_stepper *s)
{
    struct bead_string_kink first = {.at = INFINITY}, way[2];
    for (size_t j = 0; j < s->string.springs; j++) {
        const size_t ways = ways_out(&s->string, j, way);
        for (size_t i = 0; i < ways; i++) {
            const struct bead_polynomial p = strain_of(s, j, way[i].sign);
            way[i].at = bead_polynomial_first_above(&p, way[i].limit + slack(s, &s->start, j));
            if (way[i].at < first.at)
                first = way[i];
        }
    }
    return first;
}

double bead_string_from_kink(const struct bead_string_stepper *s, const struct bead_string_kink *kink)
{
    const double margin = slack(s, &s->end, kink->spring);
    double gone = kink->sign * bead_string_strain(&s->string, s->end.u, kink->spring) - kink->limit - margin;
    double rate = kink->sign * bead_string_difference(&s->string, s->end.v, kink->spring);
    return fabs(gone) <= 0.5 * margin || !(rate > 0) ? 0 : -gone / rate;
}

void bead_string_settle(struct bead_string_stepper *s)
{
    const struct bead_string *string = &s->string;
    struct bead_string_kink way[2];
    for (size_t j = 0; j < string->springs; j++) {
        const size_t ways = ways_out(string, j, way);
        const double r = bead_string_strain(string, s->end.u, j), rate = bead_string_difference(string, s->end.v, j);
        for (size_t i = 0; i < ways; i++) {
            double gone = way[i].sign * r - way[i].limit;
            if (gone > slack(s, &s->end, j) || (gone > 0 && way[i].sign * rate > 0))
                string->branch[j] = string->branch[j] != 0 ? 0 : way[i].sign;
        }
    }
}
