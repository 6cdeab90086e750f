/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Adds up energies and integrates the loss to damping: see budget.h.
 *
 * The force f of a contact takes the power f D from the beads, with D the rate of its compression, and the elastic force e stores e
 * D: (f - e) D is lost. That is gamma |D|^(a+1) in a closed contact. If damping would pull, the contact has no force, and the rest
 * of its elastic energy is lost as it opens. Both are integrated like the motion. */
#include "sim/run/budget.h"

#include "sim/integrate/damped_contacts.h"

/* Gauss-Legendre quadrature on 0..1, exact up to degree 11. */
enum { NODES = 6 };
static const double node[NODES] = {0.033765242898423975, 0.16939530676686776, 0.38069040695840156,
                                   0.61930959304159844,  0.83060469323313224, 0.96623475710157603},
                    weight[NODES] = {0.085662246189585178, 0.18038078652406930, 0.23395696728634552,
                                     0.23395696728634552,  0.18038078652406930, 0.085662246189585178};

static double power(const struct bead_stepper *s, size_t k, double d, double rate)
{
    return (bead_damped_contacts_within(s, k, d, rate) - s->chain->law->force(s->table.stiffness[k], s->table.law, d)) * rate;
}

/* Was contact k closed for the whole of the last step? Damped springs, which also pull, are. */
static bool was_closed(const struct bead_stepper *s, size_t k)
{
    return !s->was_closed || s->was_closed[k];
}

/* The energy still stored in contacts that are open, whose beads move apart without a force: it falls. */
static double left_behind(const struct bead_stepper *s)
{
    const size_t n = bead_stepper_contacts(s);
    double sum = 0;
    for (size_t k = 0; k < n; k++) {
        const double d0 = bead_stepper_compression(s, &s->start, k), d1 = bead_stepper_compression(s, &s->end, k);
        if (!was_closed(s, k) && (d0 > 0 || d1 > 0))
            sum += s->chain->law->energy(s->table.stiffness[k], s->table.law, d0) -
                   s->chain->law->energy(s->table.stiffness[k], s->table.law, d1);
    }
    return sum;
}

/* The power, W, at time t and u, v, that damped contacts or an absorbing end take, or a drive gives. */
typedef double power_in(const struct bead_stepper *s, double t, const double *u, const double *v);

static double into_contacts(const struct bead_stepper *s, double, const double *u, const double *v)
{
    const size_t n = bead_stepper_contacts(s);
    double sum = 0;
    for (size_t k = 0; k < n; k++)
        sum += !was_closed(s, k) || v[k] == v[k + 1]
                   ? 0
                   : power(s, k, s->table.static_compression[k] + (u[k] - u[k + 1]), v[k] - v[k + 1]);
    return sum;
}

static double into_end(const struct bead_stepper *s, double, const double *, const double *v)
{
    const double last = v[s->beads - 1];
    return bead_dashpot_force(&s->chain->end, last) * last;
}

/* Its integral over the last step, by the method that integrates the motion: an error of only one of them would look like energy
 * that is not conserved. rk4 keeps no stages, and its steps are so short that polynomials suffice. */
static double integral(const struct bead_stepper *s, power_in *power_of)
{
    double *u = s->y, *v = s->w[0], sum = 0;
    if (s->method->tableau) {
        for (size_t i = 0; i < s->method->tableau->stages; i++) {
            const double part = bead_stage_state(s, i, u, v);
            sum += part != 0 ? part * power_of(s, s->t0 + s->method->tableau->c[i] * s->h, u, v) : 0;
        }
        return sum * s->h;
    }
    for (int i = 0; i < NODES; i++) {
        for (size_t j = 0; j < s->active; j++) {
            const struct bead_polynomial p = bead_dense_bead(s, j);
            u[j] = bead_polynomial_value(&p, node[i]);
            v[j] = bead_polynomial_slope(&p, node[i]) / s->h;
        }
        u[s->active] = v[s->active] = 0;
        sum += weight[i] * power_of(s, s->t0 + node[i] * s->h, u, v);
    }
    return sum * s->h;
}

double bead_dissipation(const struct bead_stepper *s)
{
    return bead_stepper_damped(s) ? integral(s, into_contacts) + left_behind(s) : 0;
}

double bead_absorption(const struct bead_stepper *s)
{
    return s->chain->end.coefficient > 0 && s->active == s->beads ? integral(s, into_end) : 0;
}

/* The power of a drive, per step, at t0 + x h: for a bead whose displacement is given, against its contact k. */
static double against_contact(const struct bead_stepper *s, const struct bead_dense *dense, size_t k, double x)
{
    const struct bead_chain *c = s->chain;
    const struct bead_polynomial compression = bead_dense_compression(s, k);
    double d[2] = {bead_polynomial_value(&compression, x), bead_polynomial_slope(&compression, x)};
    bead_between_correct_compression(dense->between, s, k, x, d);
    const double force = c->law->force(s->table.stiffness[k], s->table.law, d[0]);
    return s->h * (force - c->static_force[k]) * bead_drive_at(c, s->t0 + x * s->h).x[1];
}

/* ... for a force on bead j. */
static double on_bead(const struct bead_stepper *s, const struct bead_dense *dense, size_t j, double x)
{
    const struct bead_polynomial displacement = bead_dense_bead(s, j);
    double u[2] = {bead_polynomial_value(&displacement, x), bead_polynomial_slope(&displacement, x)};
    bead_between_correct_bead(dense->between, s, j, x, u);
    return bead_drive_at(s->chain, s->t0 + x * s->h).x[0] * u[1];
}

typedef double power_at(const struct bead_stepper *s, const struct bead_dense *dense, size_t i, double x);

/* Its integral over from..to, where a contact opens or closes at both ends: with x = 3 y^2 - 2 y^3, d^(3/2) is smooth in y. */
static double work_between(const struct bead_stepper *s, const struct bead_dense *dense, power_at *power_of, size_t i, double from,
                           double to)
{
    enum { PANELS = 2 };
    double sum = 0;
    for (int n = 0; n < PANELS * NODES; n++) {
        const double y = (n / NODES + node[n % NODES]) / PANELS, x = from + (to - from) * (y * y * (3 - 2 * y));
        sum += weight[n % NODES] / PANELS * (to - from) * (6 * y * (1 - y)) * power_of(s, dense, i, x);
    }
    return sum;
}

/* Its integral over 0..until, split where one of contacts first..last opens or closes. */
static double work_with(const struct bead_stepper *s, const struct bead_dense *dense, power_at *power_of, size_t i, size_t first,
                        size_t last, double until)
{
    size_t count;
    const struct bead_between_point *point = bead_between_points(dense->between, &count);
    double sum = 0, from = 0;
    while (from < until) {
        double to = until;
        for (size_t n = 0; n < count; n++) {
            const bool here = point[n].contact >= first && point[n].contact <= last;
            to = here && point[n].at > from && point[n].at < to ? point[n].at : to;
        }
        sum += work_between(s, dense, power_of, i, from, to);
        from = to;
    }
    return sum;
}

/* The power of a drive while contacts are damped: of a bead whose displacement is given, against its contacts, or of a force. */
static double of_displacement(const struct bead_stepper *s, double t, const double *u, const double *v)
{
    const struct bead_chain *c = s->chain;
    const size_t j = s->driven;
    double sum = 0;
    for (size_t k = j > 0 ? j - 1 : 0; k <= j && k < c->contacts; k++) {
        const double d = c->static_compression[k] + (u[k] - u[k + 1]),
                     force = bead_damped_contacts_within(s, k, d, v[k] - v[k + 1]);
        sum += (k == j ? 1 : -1) * (force - c->static_force[k]);
    }
    return sum * bead_drive_at(c, t).x[1];
}

static double of_force(const struct bead_stepper *s, double t, const double *, const double *v)
{
    return bead_drive_at(s->chain, t).x[0] * v[s->driven];
}

/* For a bead whose displacement is given: the change of its own energy, and its work on its contacts. */
static double work_of_displacement(const struct bead_stepper *s, const struct bead_dense *dense, double until)
{
    const struct bead_chain *c = s->chain;
    const size_t j = s->driven;
    const struct bead_wave_at at0 = bead_drive_at(c, s->t0), at1 = bead_drive_at(c, s->t0 + until * s->h);
    double work = 0.5 * c->mass[j] * (at1.x[1] * at1.x[1] - at0.x[1] * at0.x[1]);
    work += bead_chain_spring_energy(c, j, at1.x[0]) - bead_chain_spring_energy(c, j, at0.x[0]);
    work -= j == 0 ? c->striker_force * (at1.x[0] - at0.x[0]) : 0;
    if (bead_stepper_damped(s))
        return work + integral(s, of_displacement);
    for (size_t k = j > 0 ? j - 1 : 0; k <= j && k < c->contacts; k++)
        work += (k == j ? 1 : -1) * work_with(s, dense, against_contact, k, k, k, until);
    return work;
}

double bead_drive_work(const struct bead_stepper *s, struct bead_dense *dense, double until)
{
    const size_t j = s->driven;
    if (j == SIZE_MAX || until <= 0)
        return 0;
    if (!bead_stepper_damped(s))
        bead_dense_find_events(dense, s);
    if (s->chain->spec->drive.displacement)
        return work_of_displacement(s, dense, until);
    if (bead_stepper_damped(s))
        return integral(s, of_force);
    return work_with(s, dense, on_bead, j, j > 0 ? j - 1 : 0, j, until);
}

/* Energy of a contact relative to its static state, including the work of the force that holds the precompression. Gravity is the
 * potential energy of the beads on their slope: contact k carries the weight of those above it, except the striker's, which the
 * static state leaves out. */
static void add_contact(const struct bead_stepper *s, const struct bead_state *state, size_t k, double *energy,
                        struct bead_budget *budget)
{
    const struct bead_chain *c = s->chain;
    const double d0 = c->static_compression[k], change = state->u[k] - state->u[k + 1], a = c->stiffness[k];
    const double held = c->spec->tilt != 0 ? fmin(c->spec->precompression, c->static_force[k]) : c->static_force[k];
    const double elastic = c->law->energy(a, &c->spec->law, d0 + change) - c->law->energy(a, &c->spec->law, d0) - held * change,
                 gravity = -(c->static_force[k] - held) * change;
    *(k + 1 < c->beads ? &budget->contacts : &budget->wall) += elastic;
    budget->gravity += gravity;
    for (size_t j = k; j <= k + 1 && j < c->beads; j++)
        energy[j] += bead_chain_share(c, k) * (elastic + gravity);
}

/* A pendulum's spring energy is potential energy of gravity. */
static void add_spring(const struct bead_chain *c, size_t bead, double u, double *energy, struct bead_budget *budget)
{
    const double gravity = 0.5 * bead_chain_pendulum_of(c, c->material[bead]) * (u * u);
    budget->gravity += gravity;
    budget->springs += bead_chain_spring_energy(c, bead, u) - gravity;
    energy[bead] += bead_chain_spring_energy(c, bead, u);
}

static struct bead_budget add_up(const struct bead_stepper *s, const struct bead_state *state, double dissipated, double work,
                                 double *beads)
{
    const size_t n = s->active;
    double *energy = beads, *force = energy + s->beads + 1, *velocity = force + s->beads + 1;
    struct bead_budget budget = {.gravity = 0 - s->chain->striker_force * state->u[0],
                                 .dissipated = dissipated,
                                 .work = work,
                                 .energy = energy,
                                 .force = force,
                                 .velocity = velocity};
    memset(energy, 0, s->beads * sizeof *energy);
    energy[0] = budget.gravity;
    for (size_t j = 0; j < n; j++) {
        const double kinetic = 0.5 * s->chain->mass[j] * (state->v[j] * state->v[j]);
        budget.kinetic += kinetic;
        energy[j] += kinetic;
        velocity[j] = state->v[j];
        if (s->chain->spring)
            add_spring(s->chain, j, state->u[j], energy, &budget);
        if (j >= s->chain->contacts)
            continue;
        add_contact(s, state, j, energy, &budget);
        force[j] = state->f[j];
    }
    return budget;
}

enum bead_error bead_budget_find(const struct bead_stepper *s, double t, double dissipated, double work, double *beads,
                                 struct bead_budget *budget, struct bead_message *msg)
{
    struct bead_stepper *part;
    if (s->steps == 0 || t <= s->t0) {
        *budget = add_up(s, s->steps == 0 ? &s->end : &s->start, dissipated, work, beads);
        return BEAD_OK;
    }
    if (t >= s->t1) {
        work += bead_stepper_damped(s) ? bead_drive_work(s, NULL, 1) : 0;
        *budget = add_up(s, &s->end, dissipated + bead_dissipation(s) + bead_absorption(s), work, beads);
        return BEAD_OK;
    }
    enum bead_error err = bead_stepper_branch(s, &part, msg);
    while (!err && part->t1 < t) { /* repeated if damped contacts close or open */
        bead_stepper_advance(part, t);
        dissipated += bead_dissipation(part) + bead_absorption(part);
        work += bead_stepper_damped(s) ? bead_drive_work(part, NULL, 1) : 0;
    }
    if (!err)
        *budget = add_up(part, &part->end, dissipated, work, beads);
    bead_stepper_destroy(err ? NULL : part);
    return err;
}
