/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces between the ends of a step, from the compressions' polynomials: see force_curve.h. */
#include "sim/run/force_curve.h"

#include "sim/integrate/damped_contacts.h"

struct bead_force_curve bead_force_curve_of(const struct bead_stepper *s, size_t index, bool of_bead)
{
    struct bead_force_curve curve = {.stepper = s, .part = of_bead ? 0.5 : 1};
    for (size_t k = of_bead && index > 0 ? index - 1 : index; k <= index && k < s->chain->contacts; k++) {
        curve.contact[curve.count] = k;
        curve.compression[curve.count++] = bead_dense_compression(s, k);
    }
    return curve;
}

static double force_at(const struct bead_force_curve *curve, size_t i, double x)
{
    const struct bead_stepper *s = curve->stepper;
    const double d = bead_polynomial_value(&curve->compression[i], x);
    if (bead_stepper_damped(s))
        return bead_damped_contacts_within(s, curve->contact[i], d, bead_polynomial_slope(&curve->compression[i], x) / s->h);
    return s->chain->law->force(s->chain->stiffness[curve->contact[i]], &s->chain->spec->law, d);
}

double bead_force_curve_value(const struct bead_force_curve *curve, double x)
{
    double force = 0;
    for (size_t i = 0; i < curve->count; i++)
        force += force_at(curve, i, x);
    return curve->part * force;
}

/* Differences: no closed form of the damping's rate is more accurate. */
static double damped_rate(const struct bead_force_curve *curve, double x)
{
    const double near = 1e-4, from = fmax(x - near, 0), to = fmin(x + near, 1);
    double change = 0;
    for (size_t i = 0; i < curve->count; i++)
        change += force_at(curve, i, to) - force_at(curve, i, from);
    return change;
}

double bead_force_curve_rate(const struct bead_force_curve *curve, double x)
{
    const struct bead_chain *c = curve->stepper->chain;
    double rate = 0;
    if (bead_stepper_damped(curve->stepper))
        return damped_rate(curve, x);
    /* For a single contact, d' gives the sign even if its force vanishes. */
    if (curve->count == 1)
        return bead_polynomial_slope(&curve->compression[0], x);
    for (size_t i = 0; i < curve->count; i++) {
        const double d = bead_polynomial_value(&curve->compression[i], x);
        const double stiffness = c->law->stiffness(c->stiffness[curve->contact[i]], &c->spec->law, d);
        rate += stiffness * bead_polynomial_slope(&curve->compression[i], x);
    }
    return rate;
}

static double part_rate(const void *context, double x)
{
    const struct bead_curve_part *part = context;
    return bead_force_curve_rate(part->curve, part->from + x * part->length);
}

double bead_curve_part_turn(const struct bead_curve_part *part, double rate0, double rate1)
{
    return part->from + part->length * bead_find_root(part_rate, part, rate0, rate1);
}
