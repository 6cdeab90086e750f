/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of pair forces. A chain takes its row from the scene and asks it for forces, energies and coefficients. */
#include "beadreel/law.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "sim/base/elementary.h"
#include "sim/base/wide.h"
#include "sim/chain/chain_internal.h"

static double three_halves(const struct bead_law_spec *)
{
    return 1.5;
}

static double one(const struct bead_law_spec *)
{
    return 1;
}

static double power_exponent(const struct bead_law_spec *spec)
{
    return spec->power;
}

static double power_coefficient(const struct bead_law_spec *spec, const struct bead_material *, const struct bead_material *, bool)
{
    return spec->coefficient;
}

static double fpu_coefficient(const struct bead_law_spec *spec, const struct bead_material *, const struct bead_material *, bool)
{
    return spec->stiffness;
}

/* Contact of two spheres (thesis Eq. 13): A = 4 E1 E2 sqrt(R1 R2 / (R1 + R2)) / (3 [E2 (1 - nu1^2) + E1 (1 - nu2^2)]), N/m^{3/2};
 * with sqrt(R) instead of a sphere and a flat wall. */
static double hertz_coefficient(const struct bead_law_spec *, const struct bead_material *a, const struct bead_material *b,
                                bool wall)
{
    const double flat_a = 1 - a->poisson * a->poisson, flat_b = b ? 1 - b->poisson * b->poisson : 0;
    const double radius = wall || !b ? a->radius : a->radius * b->radius / (a->radius + b->radius);
    const double elastic =
        b ? 4 * a->modulus * b->modulus / (3 * (b->modulus * flat_a + a->modulus * flat_b)) : 4 * a->modulus / (3 * flat_a);
    return elastic * sqrt(radius);
}

/* As in the program of the thesis's Appendix 4, operation by operation; between spheres it takes
 * sqrt(R1 R2) / (R1 + R2) for the square root of R1 R2 / (R1 + R2). */
static double printed_coefficient(const struct bead_law_spec *spec, const struct bead_material *a, const struct bead_material *b,
                                  bool wall)
{
    if (!b)
        return hertz_coefficient(spec, a, NULL, true);
    const double flat_a = 1 - a->poisson * a->poisson, flat_b = 1 - b->poisson * b->poisson;
    if (wall)
        return 4 * a->modulus * b->modulus * sqrt(a->radius) / (3 * b->modulus * flat_a + 3 * a->modulus * flat_b);
    return 4 * sqrt(a->radius * b->radius) / (a->radius + b->radius) * a->modulus * b->modulus /
           (3 * b->modulus * flat_a + 3 * a->modulus * flat_b);
}

/* Logarithmic derivatives of 4 / 3 / (c1 + c2), c = (1 - nu^2) / E, times sqrt(R1 R2) / (R1 + R2)^sum_part; sqrt(R1) if it is 0. */
static struct bead_coefficient_rates rates_of(const struct bead_material *left, const struct bead_material *right, double sum_part)
{
    const double c1 = (1 - left->poisson * left->poisson) / left->modulus;
    const double c2 = right ? (1 - right->poisson * right->poisson) / right->modulus : 0;
    struct bead_coefficient_rates rates = {{0.5 / left->radius, 0}, {c1 / (c1 + c2) / left->modulus, 0}};
    if (right)
        rates.modulus[1] = c2 / (c1 + c2) / right->modulus;
    if (sum_part > 0) {
        const double sum = sum_part / (left->radius + right->radius);
        rates.radius[0] -= sum;
        rates.radius[1] = 0.5 / right->radius - sum;
    }
    return rates;
}

/* sqrt(R1 R2 / (R1 + R2)), or sqrt(R) at a wall. */
static struct bead_coefficient_rates hertz_rates(const struct bead_material *left, const struct bead_material *right, bool wall)
{
    return rates_of(left, right, wall ? 0 : 0.5);
}

/* sqrt(R1 R2) / (R1 + R2) */
static struct bead_coefficient_rates printed_rates(const struct bead_material *left, const struct bead_material *right, bool wall)
{
    return rates_of(left, right, wall ? 0 : 1);
}

/* f = A d^{3/2}; Hertz 1881, thesis Eq. 13. */
static double hertz_energy(double a, const struct bead_law_spec *, double d)
{
    return d > 0 ? 0.4 * a * (d * d * sqrt(d)) : 0;
}

static double hertz_force(double a, const struct bead_law_spec *, double d)
{
    return d > 0 ? a * (d * sqrt(d)) : 0;
}

static double hertz_stiffness(double a, const struct bead_law_spec *, double d)
{
    return d > 0 ? 1.5 * a * sqrt(d) : 0;
}

static double hertz_compression(double a, const struct bead_law_spec *, double f)
{
    return f > 0 && a > 0 ? bead_cbrt((f / a) * (f / a)) : 0;
}

static double hertz_energy_compression(double a, const struct bead_law_spec *, double e)
{
    return e > 0 && a > 0 ? bead_two_fifths(2.5 * e / a) : 0;
}

/* Hertz's force as computed by the thesis's program: the last bit may differ. */
static double printed_force(double a, const struct bead_law_spec *, double d)
{
    return d > 0 ? a * bead_three_halves(d) : 0;
}

/* f = A d^p, d > 0. */
static double power_energy(double a, const struct bead_law_spec *spec, double d)
{
    return d > 0 ? a * pow(d, spec->power + 1) / (spec->power + 1) : 0;
}

static double power_force(double a, const struct bead_law_spec *spec, double d)
{
    return d > 0 ? a * pow(d, spec->power) : 0;
}

static double power_stiffness(double a, const struct bead_law_spec *spec, double d)
{
    return d > 0 ? a * spec->power * pow(d, spec->power - 1) : 0;
}

static double power_compression(double a, const struct bead_law_spec *spec, double f)
{
    return f > 0 && a > 0 ? bead_pow(f / a, 1 / spec->power) : 0;
}

static double power_energy_compression(double a, const struct bead_law_spec *spec, double e)
{
    return e > 0 && a > 0 ? bead_pow((spec->power + 1) * e / a, 1 / (spec->power + 1)) : 0;
}

/* f = k d (1 - alpha d) for both signs of d: thesis Eq. 5 written for the compression d = x_j - x_{j+1}. */
static double fpu_energy(double a, const struct bead_law_spec *spec, double d)
{
    return a * (d * d) * (0.5 - spec->alpha * d / 3);
}

static double fpu_force(double a, const struct bead_law_spec *spec, double d)
{
    return a * (d * (1 - spec->alpha * d));
}

static double fpu_stiffness(double a, const struct bead_law_spec *spec, double d)
{
    return a * (1 - 2 * spec->alpha * d);
}

static double fpu_compression(double a, const struct bead_law_spec *spec, double f)
{
    if (!(a > 0))
        return 0;
    double under = 1 - 4 * spec->alpha * f / a;
    return under > 0 ? 2 * f / (a * (1 + sqrt(under))) : NAN;
}

/* The largest |d| that energy e allows in a linear spring, doubled to allow for the cubic term. */
static double fpu_energy_compression(double a, const struct bead_law_spec *, double e)
{
    return e > 0 && a > 0 ? 2 * sqrt(2 * e / a) : 0;
}

static const struct bead_law laws[] = {
    {.name = "hertz",
     .description = "A d^(3/2), Hertz's contact of spheres (thesis Eq. 13)",
     .one_sided = true,
     .hertz = true,
     .exponent = three_halves,
     .coefficient = hertz_coefficient,
     .coefficient_rates = hertz_rates,
     .coefficient_power = three_halves,
     .energy = hertz_energy,
     .force = hertz_force,
     .stiffness = hertz_stiffness,
     .compression = hertz_compression,
     .energy_compression = hertz_energy_compression},
    {.name = "power",
     .description = "coefficient d^power in every contact, one-sided",
     .one_sided = true,
     .exponent = power_exponent,
     .coefficient = power_coefficient,
     .coefficient_power = power_exponent,
     .energy = power_energy,
     .force = power_force,
     .stiffness = power_stiffness,
     .compression = power_compression,
     .energy_compression = power_energy_compression},
    {.name = "fpu-alpha",
     .description = "k d (1 - alpha d), two-sided (Fermi, Pasta, Ulam, Tsingou 1955; thesis Eq. 5)",
     .coefficient = fpu_coefficient,
     .coefficient_power = one,
     .energy = fpu_energy,
     .force = fpu_force,
     .stiffness = fpu_stiffness,
     .compression = fpu_compression,
     .energy_compression = fpu_energy_compression},
    {.name = "thesis-appendix",
     .description =
         "Hertz with A as printed in Appendix 4, 4 sqrt(R1 R2)/(R1+R2): too stiff by a factor of 10.25 for beads of 4.76 mm",
     .one_sided = true,
     .hertz = true,
     .as_printed = true,
     .exponent = three_halves,
     .coefficient = printed_coefficient,
     .coefficient_rates = printed_rates,
     .coefficient_power = three_halves,
     .energy = hertz_energy,
     .force = printed_force,
     .stiffness = hertz_stiffness,
     .compression = hertz_compression,
     .energy_compression = hertz_energy_compression},
};

enum bead_error bead_law_check(const struct bead_law *law, struct bead_message *msg)
{
    const struct {
        bool there;
        const char *what;
    } members[] = {{law->name && *law->name, "name"},
                   {law->description, "description"},
                   {law->coefficient, "coefficient"},
                   {law->coefficient_power, "coefficient_power"},
                   {law->energy, "energy"},
                   {law->force, "force"},
                   {law->stiffness, "stiffness"},
                   {law->compression, "compression"},
                   {law->energy_compression, "energy_compression"}};
    for (size_t i = 0; i < sizeof members / sizeof *members; i++) {
        if (!members[i].there)
            return bead_fail(msg, BEAD_ERROR_USAGE, "law `%s`: its `%s` is missing", law->name ? law->name : "", members[i].what);
    }
    return BEAD_OK;
}

const struct bead_law *bead_law_info(size_t index)
{
    return index < sizeof laws / sizeof *laws ? &laws[index] : NULL;
}

const struct bead_law *bead_law_find(const char *name)
{
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++) {
        if (strcmp(laws[i].name, name) == 0)
            return &laws[i];
    }
    return NULL;
}
