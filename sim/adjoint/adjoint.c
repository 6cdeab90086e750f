/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sweeps back over the steps of a run for the derivatives of contact forces: see adjoint.h. */
#include "sim/adjoint/adjoint.h"

#include <stdlib.h>

#include "sim/adjoint/adjoint_nodes.h"
#include "sim/base/memory.h"

/* Beads on either side that one step reaches, normally and from an end that is below the part `faded` of the largest r. */
enum { REACH = 8, REACH_OF_FADED = 2, VECTOR = 8 };
static const double faded = 1e-9;
/* Steps between updates of the largest r. */
enum { LOOK_EVERY = 16 };
/* h^2 K/m up to which a contact has no stiffness, and the part of the chain's speed up to which a bead is at
 * rest: ahead of a front it is 0, but for what is below all rounding. */
static const double no_stiffness = 1e-30, at_rest = 1e-20;

/* A force on its way back. Beads outside low..high - 1 have r = r' = 0. */
struct traveller {
    struct bead_adjoint *of;
    size_t step; /* of the record, in which it starts */
    double from; /* x of the start in that step */
    size_t low, high;
    double *r, *rate;                           /* [beads] m/N.., and its derivative by backward time */
    double *by_stiffness, *by_static, *by_mass; /* integrals */
    double striker;
    double most; /* the largest r + h r', at the last update */
};

struct sweep {
    const struct bead_chain *chain;
    struct bead_adjoint_nodes nodes;
    const struct bead_adjoint_care *care;
    double *y, *spare, *slope[BEAD_NODES]; /* work; slope: h^2 r'' at the nodes */
    struct traveller *traveller;
    size_t count;
    double *memory;
};

enum { OWN_ARRAYS = 2 + BEAD_NODES, ARRAYS = 5 };

static enum bead_error allocate(struct sweep *w, struct bead_adjoint *adjoints, size_t count, struct bead_message *msg)
{
    const size_t padded = bead_adjoint_padded(w->chain);
    w->count = count;
    BEAD_TRY(bead_new(&w->traveller, count, msg, "the sensitivities of %zu beads", w->chain->beads));
    BEAD_TRY(bead_new(&w->memory, padded * (OWN_ARRAYS + ARRAYS * count), msg, "the sensitivities of %zu beads", w->chain->beads));
    double *at = w->memory + BEAD_ADJOINT_MARGIN, **const own[] = {&w->y, &w->spare};
    for (size_t i = 0; i < sizeof own / sizeof *own; i++, at += padded)
        *own[i] = at;
    for (size_t i = 0; i < BEAD_NODES; i++, at += padded)
        w->slope[i] = at;
    for (size_t c = 0; c < count; c++) {
        struct traveller *t = &w->traveller[c];
        double **const array[ARRAYS] = {&t->r, &t->rate, &t->by_stiffness, &t->by_static, &t->by_mass};
        t->of = &adjoints[c];
        for (size_t i = 0; i < ARRAYS; i++, at += padded)
            *array[i] = at;
    }
    return BEAD_OK;
}

/* ---- the start of a force ---- */

struct rising {
    const struct bead_adjoint_nodes *nodes;
    size_t contacts;
    struct bead_adjoint_curve curve[2];
};

static struct rising rising_of(const struct sweep *w, const struct bead_adjoint *of)
{
    struct rising rising = {.nodes = &w->nodes, .contacts = of->contacts};
    for (size_t i = 0; i < of->contacts; i++)
        rising.curve[i] = bead_adjoint_curve(&w->nodes, of->contact[i]);
    return rising;
}

/* The rate of the force, or of the compression of a single contact. */
static double force_rate(const void *context, double x)
{
    const struct rising *r = context;
    const struct bead_stepper *s = r->nodes->stepper;
    double rate = 0;
    for (size_t i = 0; i < r->contacts; i++) {
        double d[2];
        bead_adjoint_compression(r->nodes, &r->curve[i], x, d);
        rate +=
            (r->contacts > 1 ? s->chain->law->stiffness(s->table.stiffness[r->curve[i].contact], s->table.law, d[0]) : 1) * d[1];
    }
    return rate;
}

static size_t step_at(const struct bead_record *record, double time)
{
    size_t low = 0, high = record->steps;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        *(record->state[middle].time <= time ? &low : &high) = middle;
    }
    return low;
}

/* The beads of a force and their neighbours. */
static struct bead_part beads_near(const struct traveller *t)
{
    const size_t first = t->of->contact[0], last = t->of->contact[t->of->contacts - 1];
    return (struct bead_part){first > 0 ? first - 1 : 0, last + 2};
}

/* Finds the start: at a maximum, in the step of its time or in a neighbouring one. */
static enum bead_error find_start(struct sweep *w, struct traveller *t, struct bead_message *msg)
{
    const struct bead_record *record = w->nodes.record;
    const size_t here = step_at(record, t->of->time), steps[3] = {here, here + 1, here - 1};
    const double start = record->state[here].time, end = record->state[here + 1].time;
    t->step = here;
    t->from = fmin((t->of->time - start) / (end - start), 1);
    for (size_t i = 0; t->of->at_maximum && i < 3; i++) {
        if (steps[i] >= record->steps)
            continue;
        enum bead_error err = bead_adjoint_nodes_load(&w->nodes, steps[i], beads_near(t), msg);
        if (err)
            return err;
        const struct rising rising = rising_of(w, t->of);
        const double rate0 = force_rate(&rising, 0), rate1 = force_rate(&rising, 1);
        if (!(rate0 > 0 && rate1 <= 0))
            continue;
        t->step = steps[i];
        t->from = bead_find_root(force_rate, &rising, rate0, rate1);
        break;
    }
    return BEAD_OK;
}

/* Sets r = 0, r' from the force's stiffnesses, and the direct derivatives. */
static void start(struct sweep *w, struct traveller *t)
{
    const struct bead_chain *c = w->chain;
    struct bead_adjoint *of = t->of;
    const double *m = w->nodes.inverse_mass;
    t->low = of->contact[0];
    t->high = of->contact[of->contacts - 1] + 2;
    t->high = t->high < c->beads ? t->high : c->beads;
    of->force = 0;
    for (size_t i = 0; i < of->contacts; i++) {
        const size_t k = of->contact[i];
        const double a = c->stiffness[k], still = c->static_force[k];
        const struct bead_adjoint_curve curve = bead_adjoint_curve(&w->nodes, k);
        double d[2];
        bead_adjoint_compression(&w->nodes, &curve, t->from, d);
        const double stiffness = of->weight * c->law->stiffness(a, &c->spec->law, d[0]),
                     force = of->weight * c->law->force(a, &c->spec->law, d[0]);
        const double part = still > 0 ? stiffness / w->nodes.static_stiffness[k] : 0;
        of->force += force;
        t->by_stiffness[k] += force - still * part;
        t->by_static[k] += part;
        t->rate[k] += m[k] * stiffness;
        if (k + 1 < c->beads)
            t->rate[k + 1] -= m[k + 1] * stiffness;
    }
}

/* ---- steps ---- */

/* Leaves out beads ahead of the front: their contacts have no stiffness, and had none before, as they are at rest. Others fly. */
static void leave_front(const struct sweep *w, struct traveller *t, double h)
{
    const double *stiffness = w->nodes.stiffness[BEAD_NODES - 1], *m = w->nodes.inverse_mass, *v = w->nodes.stepper->start.v;
    for (; t->high > t->low + 1; t->high--) {
        const size_t j = t->high - 1;
        if (h * h * m[j] * (stiffness[j] + stiffness[j - 1]) > no_stiffness || fabs(v[j]) > at_rest * w->chain->speed)
            return;
        t->r[j] = t->rate[j] = 0;
    }
}

/* Leaves out negligible beads at both ends. */
static void trim(const struct sweep *w, struct traveller *t, double h)
{
    leave_front(w, t, h);
    if (!(t->most > 0) || w->nodes.stepper->steps % LOOK_EVERY == 0) {
        t->most = 0;
        for (size_t j = t->low; j < t->high; j++) {
            const double here = fabs(t->r[j]) + h * fabs(t->rate[j]);
            t->most = t->most > here ? t->most : here;
        }
    }
    const double least = w->care->negligible * t->most;
    while (t->high > t->low + 1 && fabs(t->r[t->high - 1]) + h * fabs(t->rate[t->high - 1]) <= least) {
        t->high--;
        t->r[t->high] = t->rate[t->high] = 0;
    }
    while (t->low + 1 < t->high && fabs(t->r[t->low]) + h * fabs(t->rate[t->low]) <= least) {
        t->r[t->low] = t->rate[t->low] = 0;
        t->low++;
    }
}

static size_t reach_of(const struct sweep *w, const struct traveller *t, size_t bead)
{
    return fabs(t->r[bead]) + w->nodes.stepper->h * fabs(t->rate[bead]) <= faded * t->most ? REACH_OF_FADED : REACH;
}

static struct bead_part whole_vectors(size_t from, size_t to)
{
    return (struct bead_part){from, from + (to - from + VECTOR - 1) / VECTOR * VECTOR};
}

/* Beads that a step moves, in whole vectors. */
static struct bead_part reached(const struct sweep *w, const struct traveller *t)
{
    const size_t left = reach_of(w, t, t->low), from = t->low > left ? t->low - left : 0;
    const size_t to = t->high + reach_of(w, t, t->high - 1), span = w->nodes.stepper->span;
    return whole_vectors(from, to < span ? to : span > from ? span : from);
}

/* Finds r'' at a node from r = y, and adds the node's share to the integrals. */
static void pass_node(struct sweep *w, struct traveller *t, struct bead_part part, size_t node, double h)
{
    const struct bead_adjoint_nodes *nodes = &w->nodes;
    const size_t n = part.to - part.from, at = part.from;
    const double weight = -h * nodes->method->bp[node], *y = w->y + at;
    const struct bead_springs springs = {nodes->stiffness[node] + at,
                                         nodes->inverse_mass + at,
                                         nodes->by_stiffness[node] + at,
                                         nodes->acceleration[node] + at,
                                         weight,
                                         t->by_stiffness + at,
                                         t->by_mass + at};
    nodes->stepper->kernels->move_springs(n, h * h, y, &springs, w->slope[node] + at);
    if (nodes->has_static)
        nodes->stepper->kernels->add_springs(n, weight, nodes->by_static[node] + at, y, t->by_static + at);
    t->striker -= at == 0 ? weight * y[0] : 0;
}

/* Steps back by `h`, over the nodes as they are filled. */
static void step(struct sweep *w, struct traveller *t, double h)
{
    const struct bead_tableau *m = w->nodes.method;
    const struct bead_kernels *kernels = w->nodes.stepper->kernels;
    const struct bead_part part = reached(w, t);
    const size_t n = part.to - part.from, at = part.from;
    double *y = w->y + at, *r = t->r + at, *rate = t->rate + at, *spare = w->spare + at, later[BEAD_NODES];
    const double *slope[BEAD_NODES];
    if (part.to <= part.from)
        return;
    y[n] = 0;
    for (size_t i = 0; i < BEAD_NODES; i++) {
        slope[i] = w->slope[i] + at;
        later[i] = m->bp[i] / h;
        kernels->combine(n, y, r, m->c[i] * h, rate, i, m->a + i * m->stages, slope);
        pass_node(w, t, part, i, h);
    }
    kernels->combine(n, spare, r, h, rate, BEAD_NODES, m->b, slope);
    memcpy(r, spare, n * sizeof *r);
    /* rates have no drift: the first slope takes its place */
    kernels->combine(n, spare, rate, later[0], slope[0], BEAD_NODES - 1, later + 1, slope + 1);
    memcpy(rate, spare, n * sizeof *rate);
    t->low = part.from;
    t->high = part.to < w->chain->beads ? part.to : w->chain->beads;
    trim(w, t, h);
}

/* Beads that the next step moves, for all travellers that started in steps after `index`. */
static struct bead_part reached_by_all(const struct sweep *w, size_t index)
{
    struct bead_part all = {SIZE_MAX, 0};
    for (size_t i = 0; i < w->count; i++) {
        const struct traveller *t = &w->traveller[i];
        if (t->step <= index)
            continue;
        const struct bead_part part = reached(w, t);
        all.from = part.from < all.from ? part.from : all.from;
        all.to = part.to > all.to ? part.to : all.to;
    }
    return all.to > all.from ? whole_vectors(all.from, all.to) : all;
}

/* Beads that any traveller may reach in step `index`. */
static struct bead_part touched_by_all(const struct sweep *w, size_t index)
{
    struct bead_part all = reached_by_all(w, index);
    for (size_t i = 0; i < w->count; i++) {
        const struct bead_part near = beads_near(&w->traveller[i]);
        if (w->traveller[i].step != index)
            continue;
        const size_t from = near.from > REACH ? near.from - REACH : 0, to = near.to + REACH;
        all.from = from < all.from ? from : all.from;
        all.to = to > all.to ? to : all.to;
    }
    return all;
}

/* Moves one traveller, or all that started in later steps (NULL), from x = `from` of the current step to its start. */
static void go_back(struct sweep *w, size_t index, double from, struct traveller *alone)
{
    const double h = w->nodes.stepper->h;
    for (double back; from > 0; from = back) {
        const struct bead_part part = alone ? reached(w, alone) : reached_by_all(w, index);
        if (part.to <= part.from)
            return;
        back = bead_adjoint_nodes_part(&w->nodes, from, w->care->heavy, part);
        bead_adjoint_nodes_fill(&w->nodes, from, back, part);
        for (size_t i = 0; !alone && i < w->count; i++) {
            if (w->traveller[i].step > index)
                step(w, &w->traveller[i], (from - back) * h);
        }
        if (alone)
            step(w, alone, (from - back) * h);
    }
}

static enum bead_error step_all(struct sweep *w, size_t index, struct bead_message *msg)
{
    const struct bead_part touched = touched_by_all(w, index);
    BEAD_TRY(touched.to > touched.from ? bead_adjoint_nodes_load(&w->nodes, index, touched, msg) : BEAD_OK);
    for (size_t i = 0; i < w->count; i++) {
        if (w->traveller[i].step != index)
            continue;
        start(w, &w->traveller[i]);
        go_back(w, index, w->traveller[i].from, &w->traveller[i]);
    }
    go_back(w, index, 1, NULL);
    return BEAD_OK;
}

static void finish(const struct sweep *w, const struct traveller *t)
{
    const struct bead_chain *c = w->chain;
    struct bead_adjoint *of = t->of;
    for (size_t k = 0; k < c->contacts; k++) {
        of->stiffness[k] = t->by_stiffness[k] / c->stiffness[k];
        of->static_force[k] = t->by_static[k];
    }
    memcpy(of->mass, t->by_mass, c->beads * sizeof *of->mass);
    of->velocity = c->mass[0] * t->r[0];
    of->striker_force = t->striker;
}

enum bead_error bead_adjoint_sweep(const struct bead_chain *chain, const struct bead_record *record,
                                   const struct bead_kernels *kernels, const struct bead_adjoint_care *care,
                                   struct bead_adjoint *adjoints, size_t count, struct bead_message *msg)
{
    struct sweep w = {.chain = chain, .care = care};
    size_t last = 0;
    enum bead_error err = bead_adjoint_nodes_create(chain, record, kernels, &w.nodes, msg);
    if (!err)
        err = allocate(&w, adjoints, count, msg);
    for (size_t i = 0; !err && i < count; i++) {
        err = find_start(&w, &w.traveller[i], msg);
        last = w.traveller[i].step > last ? w.traveller[i].step : last;
    }
    for (size_t i = last + 1; !err && i-- > 0;)
        err = step_all(&w, i, msg);
    for (size_t i = 0; !err && i < count; i++)
        finish(&w, &w.traveller[i]);
    bead_adjoint_nodes_destroy(&w.nodes);
    free(w.traveller);
    free(w.memory);
    return err;
}
