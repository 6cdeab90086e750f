/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The classical Runge-Kutta method of order 4 on (u, v), as the thesis uses it (its Appendix 1). */
#include "sim/integrate/stepper.h"

void bead_step_rk4(struct bead_stepper *s, double h)
{
    const struct bead_kernels *k = s->kernels;
    const struct bead_state *from = &s->start, *to = &s->end;
    double *v2 = s->w[0], *v3 = s->w[1], *v4 = s->w[2], *a2 = s->stage_a[0], *f = s->stage_f[0];
    const double half = 0.5 * h;
    size_t n = s->active;

    /* The bead after these is at rest; other code uses this memory between steps. */
    v2[n] = v3[n] = v4[n] = 0;
    k->combine(n, s->y, from->u, half, from->v, 0, NULL, NULL);
    k->combine(n, v2, from->v, half, from->a, 0, NULL, NULL);
    bead_stepper_evaluate(s, s->y, v2, f, a2);

    k->combine(n, s->y, from->u, half, v2, 0, NULL, NULL);
    k->combine(n, v3, from->v, half, a2, 0, NULL, NULL);
    /* end.a is free until the end: accelerations of the third stage */
    bead_stepper_evaluate(s, s->y, v3, f, to->a);

    k->combine(n, s->y, from->u, h, v3, 0, NULL, NULL);
    k->combine(n, v4, from->v, h, to->a, 0, NULL, NULL);
    const double *const sum_v[] = {from->v, v2, v3, v4};
    k->rk4_sum(n, to->u, from->u, h, sum_v);

    /* v2 is free by now: accelerations of the fourth stage */
    bead_stepper_evaluate(s, s->y, v4, f, v2);
    const double *const sum_a[] = {from->a, a2, to->a, v2};
    k->rk4_sum(n, to->v, from->v, h, sum_a);

    bead_stepper_evaluate(s, to->u, to->v, to->f, to->a);
}
