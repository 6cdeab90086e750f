/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Follows the front of the wave and finds the time when it reaches the end of the chain. */
#include "sim/run/front.h"

#include "sim/base/wide.h"
#include "sim/run/force_curve.h"

static const double part = 1e-4;
/* The front grows doubly exponentially, so no polynomial over a whole step fits it: the step in which it arrives is repeated in
 * SUBSTEPS parts, then the part in which it arrives, REFINEMENTS times in all. */
enum { SUBSTEPS = 8, REFINEMENTS = 3 };

/* A force at the end of a step below this part of the record set no new record within the step either. */
static const double near_record = 0.5;

/* The maximum of contact k's force within the last step, without the static part; 0 if the force does not turn. */
static double peak_within(const struct bead_stepper *s, size_t k)
{
    const struct bead_force_curve curve = bead_force_curve_of(s, k, false);
    const double at0 = bead_force_curve_rate(&curve, 0), at1 = bead_force_curve_rate(&curve, 1);
    if (!(at0 > 0 && at1 <= 0))
        return 0;
    const struct bead_curve_part whole = {&curve, 0, 1};
    return bead_force_curve_value(&curve, bead_curve_part_turn(&whole, at0, at1)) - s->chain->static_force[k];
}

/* Only the contact that was strongest at one end of the step can set a new record. */
static void update_record(struct bead_front *front, const struct bead_stepper *s, size_t n)
{
    double force = s->kernels->largest(n - s->first, s->end.f + s->first);
    if (s->steps == 1) /* with damping, the force jumps at the striker's impact, often higher than ever after */
        front->largest_force = s->kernels->largest(n, s->start.f);
    if (!(force > near_record * front->largest_force))
        return;
    size_t strongest = s->first;
    while (strongest + 1 < n && s->end.f[strongest] != force)
        strongest++;
    front->largest_force =
        fmax(front->largest_force, fmax(force, fmax(peak_within(s, front->strongest), peak_within(s, strongest))));
    front->strongest = strongest;
}

/* The threshold of the last contact's force and, used without damping, of its compression. */
struct threshold {
    struct bead_force_curve curve;
    double force, compression; /* N, m */
};

static double above(const void *context, double x)
{
    const struct threshold *t = context;
    if (bead_stepper_damped(t->curve.stepper))
        return bead_force_curve_value(&t->curve, x) - t->force;
    return bead_polynomial_value(&t->curve.compression[0], x) - t->compression;
}

/* Time in the last step from which the last contact's force exceeds `level`. */
static double crossing(const struct bead_stepper *s, double level)
{
    const struct bead_chain *c = s->chain;
    const size_t last = c->contacts - 1;
    const double force = level + c->static_force[last];
    struct threshold t = {bead_force_curve_of(s, last, false), force,
                          c->law->compression(c->stiffness[last], &c->spec->law, force)};
    double at0 = above(&t, 0), at1 = above(&t, 1);
    double x = at0 >= 0 ? 0 : at1 <= 0 ? 1 : bead_find_root(above, &t, at0, at1);
    return s->t0 + x * s->h;
}

/* Makes up to SUBSTEPS steps of length h; returns true after the one in which the front arrives. */
static bool arrives(struct bead_stepper *fine, double h, double level)
{
    const size_t last = fine->chain->contacts - 1;
    const double from = fine->t1;
    for (int i = 1; i <= SUBSTEPS; i++) {
        const double to = from + i * h;
        for (double length = h; fine->t1 < to; length = to - fine->t1) { /* with damping, steps end where contacts close */
            bead_stepper_advance_by(fine, length, to);
            if (fine->end.f[last] > level)
                return true;
        }
    }
    return false;
}

static enum bead_error refine(const struct bead_stepper *s, double level, double *arrival, struct bead_message *msg)
{
    struct bead_stepper *fine;
    BEAD_TRY(bead_stepper_branch(s, &fine, msg));
    *arrival = crossing(s, level);
    double h = s->h;
    for (int i = 0; i < REFINEMENTS && arrives(fine, h / SUBSTEPS, level); i++) {
        *arrival = crossing(fine, level);
        h = fine->h;
        bead_stepper_take_back(fine);
    }
    bead_stepper_destroy(fine);
    return BEAD_OK;
}

/* Energy, J, of the beads that still push those behind them. Each bead before them moves to the left at least as fast as the next,
 * without touching it: a bead that catches up with one of them only loses energy. At a free end, their common motion presses
 * nothing. */
static double energy_behind(const struct bead_stepper *s)
{
    const struct bead_chain *c = s->chain;
    const size_t n = bead_stepper_contacts(s);
    size_t from = s->first;
    while (from < n && bead_stepper_compression(s, &s->end, from) <= 0 && s->end.v[from] <= s->end.v[from + 1])
        from++;
    double energy = 0, mass = 0, momentum = 0;
    for (size_t j = from; j < c->beads; j++) {
        mass += c->mass[j];
        momentum += c->mass[j] * s->end.v[j];
        energy += 0.5 * c->mass[j] * (s->end.v[j] * s->end.v[j]);
        if (j < n)
            energy += c->law->energy(c->stiffness[j], s->table.law, bead_stepper_compression(s, &s->end, j));
    }
    return c->spec->wall == BEAD_WALL_NONE && !c->spec->absorbs ? energy - 0.5 * momentum * momentum / mass : energy;
}

/* The last contact's force, N, if it stores this energy, or its beads meet with it: then damping adds to it. */
static double last_force(const struct bead_stepper *s, double energy, bool meeting)
{
    const struct bead_chain *c = s->chain;
    const size_t last = c->contacts - 1;
    const double compression = c->law->energy_compression(c->stiffness[last], s->table.law, energy),
                 force = c->law->force(c->stiffness[last], s->table.law, compression);
    if (!meeting)
        return force;
    const double weight = c->inverse_mass[last] + (last + 1 < c->beads ? c->inverse_mass[last + 1] : 0);
    return force + bead_damping_force(&s->table, compression, sqrt(2 * energy * weight));
}

/* A bead hands over up to four times the energy of its motion with a lighter one, which then moves twice as fast. So do the first
 * beads of a broad pulse that breaks into narrow ones. A rigid wall doubles the force. Both are margins, not bounds: of 70 random
 * damped chains 17 were given up; run five times as long, none of them reached more than .82 of the level. A chain that gathers the
 * energy of many contacts in one would exceed them. */
static const double handed_over = 4, doubled = 2;

/* With damping: can the energy that contacts store, or with which their beads meet now, cause a force of the last contact above
 * `level`, N? Damping forces alone spread like heat, so none ever exceeds the largest; pulses of elastic forces at most keep their
 * energies. The strongest contacts are at the front, and one is enough. */
static bool is_enough(const struct bead_stepper *s, double level)
{
    const struct bead_chain *c = s->chain;
    bool enough = false;
    for (size_t k = bead_stepper_contacts(s); k-- > s->first && !enough;) {
        const double force = s->end.f[k], meeting = fmax(s->end.v[k] - s->end.v[k + 1], 0),
                     weight = c->inverse_mass[k] + (k + 1 < c->beads ? c->inverse_mass[k + 1] : 0),
                     stored =
                         c->law->energy(c->stiffness[k], s->table.law, c->law->compression(c->stiffness[k], s->table.law, force));
        enough =
            doubled * force > level || doubled * last_force(s, handed_over * stored, false) > level ||
            (meeting > 0 && weight > 0 && doubled * last_force(s, handed_over * 0.5 * meeting * meeting / weight, true) > level);
    }
    return enough;
}

bool bead_front_is_lost(const struct bead_front *front, const struct bead_stepper *s)
{
    const struct bead_chain *c = s->chain;
    const size_t last = c->contacts - 1;
    if (!isnan(front->arrival) || !c->law->one_sided || c->striker_force != 0 || c->spring || c->static_force[0] != 0 ||
        c->static_force[last] != 0)
        return false;
    const double level = part * front->largest_force;
    return !(last_force(s, energy_behind(s), true) > level) || (s->table.damping > 0 && !is_enough(s, level));
}

enum bead_error bead_front_watch(struct bead_front *front, const struct bead_stepper *s, struct bead_message *msg)
{
    const size_t last = s->chain->contacts - 1;
    if (!isnan(front->arrival) || s->chain->spec->start_count > 0 || s->driven != SIZE_MAX) /* several waves have no front */
        return BEAD_OK;
    update_record(front, s, bead_stepper_contacts(s));
    const double level = part * front->largest_force;
    if (last >= s->active || !(s->end.f[last] > level))
        return BEAD_OK;
    return refine(s, level, &front->arrival, msg);
}
