/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holds the state of one chain and advances it by a method: forces, window, events. Runs drive it. */
#include "sim/integrate/stepper.h"

#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/integrate/damped_contacts.h"
#include "sim/integrate/events.h"
#include "sim/integrate/subnormals.h"

/* Elements before and after each array: f[-1], u[n], and whole vectors for the aligned ends. */
enum { MARGIN = 16, ALIGN = 64, VECTOR = 8 };

static size_t padded(size_t beads)
{
    return (beads + 2 * MARGIN + 7) / 8 * 8;
}

static size_t stage_count(const struct bead_method *method)
{
    return method->tableau ? method->tableau->stages : 1;
}

/* Takes the next array from the block of memory. */
static double *take(double **at, size_t beads)
{
    double *array = *at + MARGIN;
    *at += padded(beads);
    return array;
}

static enum bead_error allocate(struct bead_stepper *s, struct bead_message *msg)
{
    size_t stages = stage_count(s->method), arrays = 2 * 4 + 2 * stages + 5 + 2 + (s->chain->spring != NULL);
    size_t bytes;
    /* calloc maps zero pages, which use no memory until touched: beads that the wave never reaches cost nothing. */
    if (__builtin_mul_overflow(padded(s->beads) * sizeof(double), arrays, &bytes) || !(s->memory = calloc(1, bytes + ALIGN)))
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the state of %zu beads", s->beads);
    double *at = (double *)(((uintptr_t)s->memory + ALIGN - 1) / ALIGN * ALIGN);
    struct bead_state *state[2] = {&s->start, &s->end};
    for (int i = 0; i < 2; i++) {
        state[i]->u = take(&at, s->beads);
        state[i]->v = take(&at, s->beads);
        state[i]->a = take(&at, s->beads);
        state[i]->f = take(&at, s->beads);
        state[i]->f[-1] = s->chain->striker_force;
    }
    for (size_t i = 0; i < stages; i++) {
        s->stage_a[i] = take(&at, s->beads);
        s->stage_f[i] = take(&at, s->beads);
        s->stage_f[i][-1] = s->chain->striker_force;
    }
    s->y = take(&at, s->beads);
    s->before_a = take(&at, s->beads);
    for (int i = 0; i < 3; i++)
        s->w[i] = take(&at, s->beads);
    double *stiffness = take(&at, s->beads), *inverse_mass = take(&at, s->beads);
    memcpy(stiffness, s->chain->stiffness, s->beads * sizeof *stiffness);
    memcpy(inverse_mass, s->force == bead_force_printed ? s->chain->mass : s->chain->inverse_mass, s->beads * sizeof *inverse_mass);
    s->table.stiffness = stiffness;
    s->inverse_mass = inverse_mass;
    double *pull = s->chain->spring ? take(&at, s->beads) : NULL;
    for (size_t j = 0; pull && j < s->beads; j++)
        pull[j] = s->chain->spring[j] * s->chain->inverse_mass[j];
    s->pull = pull;
    return BEAD_OK;
}

static bool has_static(const struct bead_chain *chain)
{
    for (size_t k = 0; k < chain->contacts; k++) {
        if (chain->static_compression[k] != 0)
            return true;
    }
    return false;
}

static bead_force_kernel choose_force(const struct bead_chain *chain, const struct bead_kernels *kernels)
{
    if (chain->spec->damping_coefficient > 0)
        return bead_force_damped;
    if (chain->law->as_printed)
        return bead_force_printed;
    if (!chain->law->hertz)
        return bead_force_general;
    return kernels->hertz;
}

/* Opens the window to all beads that one step may move: those in motion, and one more per evaluation of the force. */
static void open_window(struct bead_stepper *s, const struct bead_state *from)
{
    size_t reach = (size_t)s->method->info.evaluations + 2, last = s->active;
    /* the wave may have stopped short of the old window's end */
    while (last > 1 && last != s->driven + 1 && from->u[last - 1] == 0 && from->v[last - 1] == 0)
        last--;
    last = s->full ? s->beads : last + reach;
    size_t active = last < s->beads ? last : s->beads;
    if (active > s->active)
        s->active = active;
    s->span = (s->active + VECTOR - 1) / VECTOR * VECTOR;
}

/* Puts a bead whose displacement is given in its place at the end of the step, without the quadrature error of the method. */
static void hold(struct bead_stepper *s)
{
    if (!s->chain->spec->drive.displacement)
        return;
    const struct bead_wave_at at = bead_drive_at(s->chain, s->t1);
    s->end.u[s->driven] = at.x[0];
    s->end.v[s->driven] = at.x[1];
    s->end.a[s->driven] = bead_drive_at(s->chain, bead_drive_end(s->chain, s->t0, s->t1)).x[2];
}

/* Where the acceleration of such a bead jumps, the next step begins with the acceleration of `end`. */
static void go_on_behind_jump(struct bead_stepper *s)
{
    const double end = bead_drive_end(s->chain, s->t0, s->t1);
    if (!s->chain->spec->drive.displacement || end == s->t1)
        return;
    if (s->last_a != s->before_a)
        memcpy(s->before_a, s->end.a, s->active * sizeof *s->before_a);
    s->last_a = s->before_a;
    s->before_a[s->driven] = bead_drive_at(s->chain, end).x[2];
    s->end.a[s->driven] = bead_drive_at(s->chain, s->t1).x[2];
}

enum bead_error bead_stepper_create(const struct bead_chain *chain, const struct bead_method *method,
                                    const struct bead_kernels *kernels, bool full, struct bead_stepper **stepper,
                                    struct bead_message *msg)
{
    *stepper = NULL;
    struct bead_stepper *s;
    BEAD_TRY(bead_new(&s, 1, msg, "a stepper"));
    s->chain = chain;
    s->method = method;
    s->kernels = kernels;
    s->beads = chain->beads;
    s->full = full;
    s->damped = bead_chain_is_damped(chain);
    s->driven = bead_is_driven(chain->spec) ? chain->spec->drive.bead : SIZE_MAX;
    s->force = choose_force(chain, kernels);
    s->fused = s->force == kernels->hertz && !has_static(chain);
    bool printed = s->force == bead_force_printed;
    s->accelerate = printed ? bead_accelerations_printed : kernels->accelerations;
    s->table = (struct bead_contact_table){.static_compression = chain->static_compression,
                                           .static_force = chain->static_force,
                                           .law = &chain->spec->law,
                                           .damping = chain->spec->damping_coefficient,
                                           .damping_exponent = chain->spec->damping_exponent,
                                           .damping_compression = chain->spec->damping_compression};
    s->event_tolerance = ldexp(chain->speed, -43);
    enum bead_error err = allocate(s, msg);
    if (!err && s->damped && chain->law->one_sided) {
        s->table.closed = s->closed = calloc(s->beads + 1, 1);
        s->was_closed = calloc(s->beads + 1, 1);
        if (!s->closed || !s->was_closed)
            err = bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the contacts of %zu beads", s->beads);
    }
    if (!err && method->events)
        err = bead_events_create(s, &s->events, msg);
    if (err) {
        bead_stepper_destroy(s);
        return err;
    }
    s->last_a = s->end.a;
    s->end.v[0] = chain->spec->striker_velocity;
    s->active = 1;
    for (size_t i = 0; i < chain->spec->start_count; i++) {
        const struct bead_start *start = &chain->spec->starts[i];
        s->end.u[start->bead] = start->displacement;
        s->end.v[start->bead] = start->bead > 0 ? start->velocity : s->end.v[0];
        s->active = start->bead + 1;
    }
    if (s->driven != SIZE_MAX) {
        hold(s);
        s->active = s->driven + 1 > s->active ? s->driven + 1 : s->active;
    }
    open_window(s, &s->end);
    if (s->closed) { /* beads ahead of the window are at rest, those in it may start apart */
        memset(s->closed, 1, s->beads);
        bead_damped_contacts_update(s);
    }
    bead_stepper_evaluate(s, s->end.u, s->end.v, s->end.f, s->end.a);
    *stepper = s;
    return BEAD_OK;
}

void bead_stepper_destroy(struct bead_stepper *stepper)
{
    if (!stepper)
        return;
    bead_events_destroy(stepper->events);
    free(stepper->closed);
    free(stepper->was_closed);
    free(stepper->memory);
    free(stepper);
}

enum bead_error bead_stepper_branch(const struct bead_stepper *s, struct bead_stepper **branch, struct bead_message *msg)
{
    BEAD_TRY(bead_stepper_create(s->chain, s->method, s->kernels, s->full, branch, msg));
    struct bead_stepper *b = *branch;
    const double *from[] = {s->start.u, s->start.v, s->start.a, s->start.f};
    double *to[] = {b->end.u, b->end.v, b->end.a, b->end.f};
    for (int i = 0; i < 4; i++)
        memcpy(to[i], from[i], s->active * sizeof(double));
    b->active = s->active;
    b->t1 = s->t0;
    if (b->closed)
        memcpy(b->closed, s->was_closed, s->active);
    bead_stepper_drop(b, s->first);
    return BEAD_OK;
}

void bead_stepper_drop(struct bead_stepper *s, size_t first)
{
    first = first / VECTOR * VECTOR;
    if (first <= s->first)
        return;
    s->first = first;
    ((double *)s->table.stiffness)[first - 1] = 0; /* our own copy */
    s->start.f[first - 1] = s->end.f[first - 1] = 0;
    for (size_t i = 0; i < stage_count(s->method); i++)
        s->stage_f[i][first - 1] = 0;
    s->end.a[first] = -s->end.f[first] * s->inverse_mass[first];
    if (s->events)
        bead_events_open(s->events, first - 1);
}

void bead_stepper_evaluate(struct bead_stepper *s, const double *u, const double *v, double *f, double *a)
{
    bead_stepper_evaluate_part(s, u, v, f, a, (struct bead_part){s->first, s->span});
    s->evaluations += s->active - s->first;
}

void bead_stepper_evaluate_part(const struct bead_stepper *s, const double *u, const double *v, double *f, double *a,
                                struct bead_part part)
{
    const size_t from = part.from;
    struct bead_contact_table table = s->table;
    table.stiffness += from;
    if (s->fused) {
        s->kernels->hertz_move(part.to - from, &table, u + from, s->inverse_mass + from, f + from, a + from);
        bead_stepper_pull(s, u, v, a, part);
        return;
    }
    const size_t to = part.to < s->active ? part.to : s->active;
    if (to <= from)
        return;
    table.static_compression += from;
    table.static_force += from;
    table.closed = table.closed ? table.closed + from : NULL;
    s->force(to - from, &table, u + from, v ? v + from : NULL, f + from);
    s->accelerate(to - from, f + from, s->inverse_mass + from, a + from);
    bead_stepper_pull(s, u, v, a, (struct bead_part){from, to});
}

void bead_stepper_advance(struct bead_stepper *s, double t1)
{
    bead_stepper_advance_by(s, t1 - s->t1, t1);
}

/* Repeats a step in which a contact closes or opens up to that moment; the next begins with the new state and force. */
static void end_at_closing(struct bead_stepper *s)
{
    enum { TRIES = 4 }; /* each misses by the interpolation error of the one before */
    struct bead_damped_contact first = bead_damped_contacts_first(s);
    unsigned char other = !s->closed[first.contact];
    double longer = first.at - 1;
    for (int i = 0; i < TRIES && longer != 0; i++) {
        s->h *= 1 + longer;
        s->t1 = s->t0 + s->h;
        s->method->step(s, s->h);
        s->last_a = s->end.a;
        if (s->driven != SIZE_MAX)
            hold(s);
        longer = bead_damped_contacts_miss(s, first.contact);
    }
    memcpy(s->was_closed, s->closed, s->active);
    bead_damped_contacts_update(s);
    if (first.at < 1)
        s->closed[first.contact] = other;
    if (memcmp(s->was_closed, s->closed, s->active) == 0)
        return; /* the method's last forces remain valid */
    memcpy(s->before_a, s->end.a, s->active * sizeof *s->before_a);
    s->last_a = s->before_a;
    bead_stepper_evaluate(s, s->end.u, s->end.v, s->end.f, s->end.a);
}

void bead_stepper_advance_by(struct bead_stepper *s, double h, double t1)
{
    struct bead_state end = s->start;
    s->start = s->end;
    s->end = end;
    s->t0 = s->t1;
    s->t1 = t1;
    s->h = h;
    open_window(s, &s->start);
    /* Displacements decrease doubly exponentially ahead of the front: those below 1e-308 are flushed to zero, because computing
     * with subnormal numbers is slow. The caller's flags are restored afterwards. */
    const uint64_t flags = flush_subnormals();
    s->method->step(s, h);
    s->last_a = s->end.a;
    if (s->driven != SIZE_MAX)
        hold(s);
    if (s->closed)
        end_at_closing(s);
    if (s->events)
        bead_events_correct(s->events, s);
    if (s->driven != SIZE_MAX)
        go_on_behind_jump(s);
    set_arithmetic_flags(flags);
    s->steps++;
}

void bead_stepper_take_back(struct bead_stepper *s)
{
    struct bead_state end = s->start;
    s->start = s->end;
    s->end = end;
    s->t1 = s->t0;
    if (s->closed)
        memcpy(s->closed, s->was_closed, s->active);
    s->steps--;
}

double bead_stepper_energy(const struct bead_stepper *s, const struct bead_state *state)
{
    const struct bead_chain *c = s->chain;
    double energy = -c->striker_force * state->u[0];
    for (size_t j = s->first; j < s->active; j++) {
        double d0 = c->static_compression[j], d = d0 + (state->u[j] - state->u[j + 1]);
        energy += 0.5 * c->mass[j] * (state->v[j] * state->v[j]);
        if (c->spring)
            energy += bead_chain_spring_energy(c, j, state->u[j]);
        if (c->stiffness[j] > 0)
            energy += c->law->energy(c->stiffness[j], &c->spec->law, d) - c->law->energy(c->stiffness[j], &c->spec->law, d0) -
                      c->static_force[j] * (d - d0);
    }
    return energy;
}

double bead_stepper_momentum(const struct bead_stepper *s, const struct bead_state *state)
{
    double momentum = 0;
    for (size_t j = s->first; j < s->active; j++)
        momentum += s->chain->mass[j] * state->v[j];
    return momentum;
}
