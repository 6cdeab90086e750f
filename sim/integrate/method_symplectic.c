/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Symplectic compositions of drifts and kicks. */
#include "sim/integrate/stepper.h"
#include "sim/integrate/tableau.h"

static const double verlet[] = {0.5, 1, 0.5};

/* Omelyan, Mryglod, Folk 2002 (Comput. Phys. Commun. 146, 188): the constants of their Eqs. 20 (position) and 21 (velocity). */
#define FOREST_RUTH(xi, lambda, chi)                                                                             \
    {                                                                                                            \
        xi, (1 - 2 * (lambda)) / 2, chi, lambda, 1 - 2 * ((chi) + (xi)), lambda, chi, (1 - 2 * (lambda)) / 2, xi \
    }
static const double pefrl[] = FOREST_RUTH(0.1786178958448091, -0.2123418310626054, -0.06626458266981849);
static const double vefrl[] = FOREST_RUTH(0.1644986515575760, -0.02094333910398989, 1.235692651138917);

#define ROW(first, array)                          \
    {                                              \
        first, sizeof array / sizeof *array, array \
    }
const struct bead_composition bead_composition_verlet = ROW(true, verlet);
const struct bead_composition bead_composition_pefrl = ROW(false, pefrl);
const struct bead_composition bead_composition_vefrl = ROW(true, vefrl);

void bead_step_composition(struct bead_stepper *s, double h)
{
    const struct bead_composition *c = s->method->composition;
    const double *u = s->start.u, *v = s->start.v;
    bool kick = c->kick_first, fresh = true; /* fresh: a belongs to u */
    const double *a = s->start.a;
    for (size_t i = 0; i < c->count; i++, kick = !kick) {
        if (!kick) {
            s->kernels->combine(s->active, s->end.u, u, c->coefficient[i] * h, v, 0, NULL, NULL);
            u = s->end.u;
            fresh = false;
            continue;
        }
        if (!fresh) {
            bead_stepper_evaluate(s, u, v, s->end.f, s->end.a);
            a = s->end.a;
            fresh = true;
        }
        s->kernels->combine(s->active, s->end.v, v, c->coefficient[i] * h, a, 0, NULL, NULL);
        v = s->end.v;
    }
    if (!fresh)
        bead_stepper_evaluate(s, u, v, s->end.f, s->end.a);
}
