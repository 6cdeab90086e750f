/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Adds up energies and integrates the loss to damping: see budget.h.
 *
 * The force f of a contact takes the power f D from the beads, with D the rate of its compression, and the elastic force e stores
 * e D: (f - e) D is lost. That is gamma |D|^(a+1) in a closed contact. If damping would pull, the contact has no force, and the
 * rest of its elastic energy is lost as it opens. Both are smooth within a step, because steps end where contacts close or open;
 * compressions within it are the polynomials used for samples. */
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

/* True if the beads of contact k move alike, or do not touch. */
static bool idle(const struct bead_stepper *s, size_t k)
{
    const bool still = s->start.v[k] == s->start.v[k + 1] && s->end.v[k] == s->end.v[k + 1];
    const bool open = s->was_closed && !s->was_closed[k] && bead_stepper_compression(s, &s->start, k) <= 0 &&
                      bead_stepper_compression(s, &s->end, k) <= 0;
    return still || open;
}

double bead_dissipation(const struct bead_stepper *s)
{
    const size_t n = bead_stepper_contacts(s);
    double sum = 0;
    for (size_t k = 0; k < n && bead_stepper_damped(s); k++) {
        if (idle(s, k))
            continue;
        const struct bead_polynomial d = bead_dense_compression(s, k);
        for (int i = 0; i < NODES; i++)
            sum += weight[i] * power(s, k, bead_polynomial_value(&d, node[i]), bead_polynomial_slope(&d, node[i]) / s->h);
    }
    return sum * s->h;
}

double bead_absorption(const struct bead_stepper *s)
{
    const struct bead_dashpot *end = &s->chain->end;
    if (!(end->coefficient > 0) || s->active < s->beads)
        return 0;
    const struct bead_polynomial u = bead_dense_bead(s, s->beads - 1);
    double sum = 0;
    for (int i = 0; i < NODES; i++) {
        const double v = bead_polynomial_slope(&u, node[i]) / s->h;
        sum += weight[i] * bead_dashpot_force(end, v) * v;
    }
    return sum * s->h;
}

/* The power of a drive, per step, at t0 + x h: of a bead whose displacement is given, against its contact k. */
static double against_contact(const struct bead_stepper *s, const struct bead_dense *dense, size_t k, double x)
{
    const struct bead_chain *c = s->chain;
    const struct bead_polynomial compression = bead_dense_compression(s, k);
    double d[2] = {bead_polynomial_value(&compression, x), bead_polynomial_slope(&compression, x)};
    bead_between_correct_compression(dense->between, s, k, x, d);
    const double force = bead_stepper_damped(s) ? bead_damped_contacts_within(s, k, d[0], d[1] / s->h)
                                                : c->law->force(s->table.stiffness[k], s->table.law, d[0]);
    return s->h * (force - c->static_force[k]) * bead_drive_at(c, s->t0 + x * s->h).x[1];
}

/* ... of a force on bead j. */
static double on_bead(const struct bead_stepper *s, const struct bead_dense *dense, size_t j, double x)
{
    const struct bead_polynomial displacement = bead_dense_bead(s, j);
    double u[2] = {bead_polynomial_value(&displacement, x), bead_polynomial_slope(&displacement, x)};
    bead_between_correct_bead(dense->between, s, j, x, u);
    return bead_drive_at(s->chain, s->t0 + x * s->h).x[0] * u[1];
}

typedef double power_at(const struct bead_stepper *s, const struct bead_dense *dense, size_t i, double x);

/* Its integral over from..to, at both ends of which it is not smooth, because a contact opens or closes: x runs as 3 y^2 - 2 y^3,
 * so that d^(3/2) is smooth in y. */
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

/* Its integral over 0..until, from point to point where one of contacts first..last opens or closes. */
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

/* A bead whose displacement is given: what its own energy changes by, and what it does to its contacts. */
static double work_of_displacement(const struct bead_stepper *s, const struct bead_dense *dense, double until)
{
    const struct bead_chain *c = s->chain;
    const size_t j = s->driven;
    const struct bead_wave_at at0 = bead_drive_at(c, s->t0), at1 = bead_drive_at(c, s->t0 + until * s->h);
    double work = 0.5 * c->mass[j] * (at1.x[1] * at1.x[1] - at0.x[1] * at0.x[1]);
    work += bead_chain_spring_energy(c, j, at1.x[0]) - bead_chain_spring_energy(c, j, at0.x[0]);
    work -= j == 0 ? c->striker_force * (at1.x[0] - at0.x[0]) : 0;
    for (size_t k = j > 0 ? j - 1 : 0; k <= j && k < c->contacts; k++)
        work += (k == j ? 1 : -1) * work_with(s, dense, against_contact, k, k, k, until);
    return work;
}

double bead_drive_work(const struct bead_stepper *s, struct bead_dense *dense, double until)
{
    const size_t j = s->driven;
    if (j == SIZE_MAX || until <= 0)
        return 0;
    bead_dense_find_events(dense, s);
    if (s->chain->spec->drive.displacement)
        return work_of_displacement(s, dense, until);
    return work_with(s, dense, on_bead, j, j > 0 ? j - 1 : 0, j, until);
}

/* Energy of a contact relative to its static state, including the work of the force that holds the precompression. Gravity is the
 * potential energy of the beads on their slope: contact k carries the weight of those above it, except that of the striker, which
 * the static state leaves out. */
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

/* A pendulum's is potential energy of gravity. */
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
        *budget = add_up(s, &s->end, dissipated + bead_dissipation(s) + bead_absorption(s), work, beads);
        return BEAD_OK;
    }
    enum bead_error err = bead_stepper_branch(s, &part, msg);
    while (!err && part->t1 < t) { /* repeated if damped contacts close or open */
        bead_stepper_advance(part, t);
        dissipated += bead_dissipation(part) + bead_absorption(part);
    }
    if (!err)
        *budget = add_up(part, &part->end, dissipated, work, beads);
    bead_stepper_destroy(err ? NULL : part);
    return err;
}
