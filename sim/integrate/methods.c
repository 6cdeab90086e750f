/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of methods: one row each, with its step in units of 1/omega. Scenes name them, the stepper uses them. */
#include "sim/integrate/methods.h"

#include <math.h>

#include "sim/integrate/events.h"
#include "sim/integrate/stepper.h"

/* The classical Runge-Kutta method of order 4 on (u, v), as the thesis uses it (its Appendix 1). */

/* step functions of the methods */
static void step_rk4(struct bead_stepper *s, double h)
{
    const struct bead_kernels *k = s->kernels;
    const struct bead_state *from = &s->start, *to = &s->end;
    double *v2 = s->w[0], *v3 = s->w[1], *v4 = s->w[2], *a2 = s->stage_a[0], *f = s->stage_f[0];
    const double half = 0.5 * h;
    size_t n = s->active;

    /* The bead after these is at rest; other code uses this memory between steps. */
    v2[n] = v3[n] = v4[n] = 0;
    s->now = s->t0 + half;
    k->combine(n, s->y, from->u, half, from->v, 0, NULL, NULL);
    k->combine(n, v2, from->v, half, from->a, 0, NULL, NULL);
    bead_stepper_evaluate(s, s->y, v2, f, a2);

    k->combine(n, s->y, from->u, half, v2, 0, NULL, NULL);
    k->combine(n, v3, from->v, half, a2, 0, NULL, NULL);
    /* end.a is free until the end: accelerations of the third stage */
    bead_stepper_evaluate(s, s->y, v3, f, to->a);

    s->now = s->t1;
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

/* Symplectic compositions of drifts and kicks. */

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
static const struct bead_composition composition_verlet = ROW(true, verlet);
static const struct bead_composition composition_pefrl = ROW(false, pefrl);
static const struct bead_composition composition_vefrl = ROW(true, vefrl);

static void step_composition(struct bead_stepper *s, double h)
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

/* Runge-Kutta-Nystrom methods for u'' = a(u), from a tableau, and Runge-Kutta methods for u'' = a(u, v).
 *
 * A long chain is stepped in tiles that fit in the cache: each stage of a tile is shifted SKEW beads to the left of the stage
 * before, so that its right neighbours are known and the previous tile has computed the left ones. Results are equal to those of
 * whole stages, bit for bit. */

enum { TILE = 512, SKEW = 8, LONG = 12288 };

/* Accelerations at the stages, for a sum with coefficients: the non-zero ones among scale * row[i], in order. */
struct terms {
    size_t count;
    double coefficient[BEAD_STAGES_MAX];
    const double *array[BEAD_STAGES_MAX];
};

static struct terms gather(const struct bead_stepper *s, const double *row, size_t count, double scale)
{
    const struct bead_tableau *t = s->method->tableau;
    struct terms terms = {.count = 0};
    for (size_t i = 0; i < count; i++) {
        if (row[i] == 0)
            continue;
        terms.coefficient[terms.count] = scale * row[i];
        terms.array[terms.count++] = i == 0 ? s->start.a : t->fsal && i + 1 == t->stages ? s->end.a : s->stage_a[i];
    }
    return terms;
}

/* y = base + scale v + the terms from `first` on, in a part. */
static void sum(const struct bead_stepper *s, struct bead_part part, double *y, const double *base, double scale, const double *v,
                const struct terms *terms, size_t first)
{
    const double *at[BEAD_STAGES_MAX];
    for (size_t i = first; i < terms->count; i++)
        at[i] = terms->array[i] + part.from;
    s->kernels->combine(part.to - part.from, y + part.from, base + part.from, scale, v + part.from, terms->count - first,
                        terms->coefficient + first, at + first);
}

/* Velocities of a part with weights of the first `count` stages. They have no drift: the first term takes its place. */
static void make_velocities(const struct bead_stepper *s, struct bead_part part, double *v, double h, const double *row,
                            size_t count)
{
    const struct terms terms = gather(s, row, count, h);
    sum(s, part, v, s->start.v, terms.coefficient[0], terms.array[0], &terms, 1);
}

/* Stage i of a part; the last stage is the end of the step. Displacements are needed for one more vector than forces. */
static void make_stage(struct bead_stepper *s, double h, size_t i, struct bead_part part)
{
    const struct bead_tableau *t = s->method->tableau;
    const size_t stages = t->fsal ? t->stages - 1 : t->stages;
    const struct bead_part beads = {part.from, part.to + SKEW < s->span ? part.to + SKEW : s->span};
    struct terms terms;
    if (i < stages) {
        s->now = s->t0 + t->c[i] * h;
        terms = gather(s, t->a + i * t->stages, i, h * h);
        sum(s, beads, s->y, s->start.u, t->c[i] * h, s->start.v, &terms, 0);
        if (t->av)
            make_velocities(s, beads, s->w[0], h, t->av + i * t->stages, i);
        bead_stepper_evaluate_part(s, s->y, t->av ? s->w[0] : NULL, s->stage_f[i], s->stage_a[i], part);
        return;
    }
    s->now = s->t1;
    terms = gather(s, t->b, t->stages, h * h);
    sum(s, beads, s->end.u, s->start.u, h, s->start.v, &terms, 0);
    if (t->av)
        make_velocities(s, beads, s->end.v, h, t->bp, t->stages);
    bead_stepper_evaluate_part(s, s->end.u, t->av ? s->end.v : NULL, s->end.f, s->end.a, part);
    if (!t->av) /* of the last force, too */
        make_velocities(s, part, s->end.v, h, t->bp, t->stages);
}

double bead_stage_state(const struct bead_stepper *s, size_t i, double *u, double *v)
{
    const struct bead_tableau *t = s->method->tableau;
    const struct bead_part beads = {s->first, s->span};
    if (t->bp[i] == 0)
        return 0;
    if (i == 0) {
        memcpy(u, s->start.u, s->span * sizeof *u);
        memcpy(v, s->start.v, s->span * sizeof *v);
    } else {
        const struct terms terms = gather(s, t->a + i * t->stages, i, s->h * s->h);
        sum(s, beads, u, s->start.u, t->c[i] * s->h, s->start.v, &terms, 0);
        make_velocities(s, beads, v, s->h, t->av + i * t->stages, i);
    }
    u[s->span] = v[s->span] = 0;
    return t->bp[i];
}

static void step_nystrom(struct bead_stepper *s, double h)
{
    const struct bead_tableau *t = s->method->tableau;
    const size_t stages = t->fsal ? t->stages - 1 : t->stages, tile = s->span > LONG ? TILE : s->span + SKEW * stages;
    if (t->av)
        s->w[0][s->span] = 0; /* velocities of stages, if needed: the wall, or a bead at rest */
    for (size_t p = s->first; p < s->span + SKEW * stages; p += tile) {
        for (size_t i = 1; i <= stages; i++) {
            /* a single tile is not skewed */
            const size_t shift = tile == TILE ? SKEW * i : 0, from = p > s->first + shift ? p - shift : s->first;
            const size_t end = p + tile > shift ? p + tile - shift : 0, to = end < s->span ? end : s->span;
            if (from < to)
                make_stage(s, h, i, (struct bead_part){from, to});
        }
    }
    s->evaluations += stages * (s->active - s->first);
}

/* Contacts this close to one that opens or closes are integrated again with it. */
enum { NEAR = 2 };

static double embedded_difference(const struct bead_stepper *s, const struct terms *terms, size_t bead)
{
    double sum = 0;
    for (size_t i = 0; i < terms->count; i++)
        sum += terms->coefficient[i] * terms->array[i][bead];
    return s->h * sum;
}

double bead_nystrom_error(const struct bead_stepper *s)
{
    const struct bead_tableau *t = s->method->tableau;
    const size_t *flagged = NULL;
    size_t count = 0, next = 0;
    double worst = 0;
    if (!t || !t->bpe)
        return 0;
    const struct terms terms = gather(s, t->bpe, t->stages, 1);
    if (s->events)
        flagged = bead_events_flagged(s->events, &count);
    for (size_t j = s->first; j < s->active; j++) {
        while (next < count && flagged[next] + NEAR + 1 < j)
            next++;
        if (next < count && flagged[next] <= j + NEAR)
            continue;
        worst = fmax(worst, fabs(embedded_difference(s, &terms, j)));
    }
    return worst;
}

static const double simpson_nodes[] = {0, 0.5, 1}, simpson_weights[] = {1 / 6.0, 2 / 3.0, 1 / 6.0};
static const double lobatto_nodes[] = {0, 0.17267316464601143, 0.5, 0.8273268353539886, 1},
                    lobatto_weights[] = {0.05, 49 / 180.0, 16 / 45.0, 49 / 180.0, 0.05};

/* The thetas were measured on disordered chains (tests/bench), theta_max in tests/stress. */
static const struct bead_method methods[] = {
    {.info = {"rk4", "classical Runge-Kutta 4, the thesis's method (its Appendix 1)", 4, 4, true, false, 0.04, 3, 0.5, 2.8},
     .step = step_rk4,
     .quadrature = {3, 4, simpson_nodes, simpson_weights}},
    {.info = {"rk8", "Runge-Kutta of order 8 (Cooper, Verner 1972): the default with damping", 8, 12, true, true, 0.35, 6, 0.6, 3},
     .step = step_nystrom,
     .tableau = &bead_tableau_rk8,
     .quadrature = {5, 8, lobatto_nodes, lobatto_weights}},
    {.info = {"verlet", "velocity Verlet, symplectic (Swope et al. 1982)", 2, 1, false, false, 0.004, 2, 0.5, 2.0},
     .step = step_composition,
     .composition = &composition_verlet},
    {.info = {"pefrl", "position extended Forest-Ruth like, symplectic (Omelyan, Mryglod, Folk 2002)", 4, 5, false, false, 0.05, 3,
              0.5, 2.5},
     .step = step_composition,
     .composition = &composition_pefrl},
    {.info = {"vefrl", "velocity extended Forest-Ruth like, symplectic (Omelyan, Mryglod, Folk 2002)", 4, 4, false, false, 0.04, 3,
              0.5, 2.5},
     .step = step_composition,
     .composition = &composition_vefrl},
    {.info = {"rkn6", "Runge-Kutta-Nystrom RKN6(4)6FM (Dormand, El-Mikkawy, Prince 1987)", 6, 5, false, true, 0.1, 3, 1, 2.5},
     .step = step_nystrom,
     .tableau = &bead_tableau_rkn6},
    {.info = {"rkn8", "RKN8(6)9FM with contacts that open or close integrated again: the default", 8, 8, false, true, 0.95, 8.5,
              2.2, 2.5},
     .step = step_nystrom,
     .tableau = &bead_tableau_rkn8,
     .events = true},
    {.info = {"rkn8-plain", "Runge-Kutta-Nystrom RKN8(6)9FM (Dormand, El-Mikkawy, Prince 1987)", 8, 8, false, true, 0.16, 3, 1.6,
              2.5},
     .step = step_nystrom,
     .tableau = &bead_tableau_rkn8},
    {.info = {"rkn12", "Runge-Kutta-Nystrom RKN12(10)17M (Dormand, El-Mikkawy, Prince 1987)", 12, 17, false, true, 0.2, 3, 1.6,
              2.5},
     .step = step_nystrom,
     .tableau = &bead_tableau_rkn12},
};

static const size_t method_count = sizeof methods / sizeof *methods;

const struct bead_method *bead_method_row(const char *name)
{
    for (size_t i = 0; i < method_count; i++) {
        if (strcmp(name, methods[i].info.name) == 0)
            return &methods[i];
    }
    return NULL;
}

const struct bead_method_info *bead_method_info(size_t index)
{
    return index < method_count ? &methods[index].info : NULL;
}

const struct bead_method_info *bead_method_find(const char *name)
{
    const struct bead_method *row = bead_method_row(name);
    return row ? &row->info : NULL;
}
