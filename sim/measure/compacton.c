/* SPDX-License-Identifier: GPL-3.0-or-later */
/* See compacton.h. */
#include "sim/measure/compacton.h"

#include <math.h>

#include "sim/base/elementary.h"
#include "sim/base/wide.h"
#include "sim/chain/chain_data.h"
#include "sim/chain/law_beginning.h"
#include "sim/chain/system.h"

static const double half_pi = 1.57079632679489662, sixth = 1. / 6;

/* Beads 1, 3, ... of the chain are alike, and so are 2, 4, ...; nothing presses or holds them. */
static bool is_homogeneous(const struct bead_chain *chain)
{
    const struct bead_chain_spec *spec = chain->spec;
    bool alike = spec->system->has_contacts && bead_chain_exponent(chain) == 1.5 && !(spec->precompression > 0) &&
                 spec->tilt == 0 && !chain->spring;
    for (size_t j = 1; alike && j < chain->beads; j++) {
        const bool inner = j + 1 < chain->beads;
        alike = (j < 3 || chain->mass[j] == chain->mass[j - 2]) && (!inner || chain->stiffness[j] == chain->stiffness[1]) &&
                !(inner && chain->static_compression[j] < 0);
    }
    return alike;
}

static double second_mass(const struct bead_chain *chain)
{
    return chain->mass[chain->beads > 2 ? 2 : 1];
}

bool bead_compacton_is_of(const struct bead_chain *chain)
{
    return is_homogeneous(chain) && second_mass(chain) == chain->mass[1];
}

bool bead_compacton_of_dimers(const struct bead_chain *chain)
{
    return is_homogeneous(chain) && second_mass(chain) != chain->mass[1];
}

double bead_compacton_width(const struct bead_chain *chain)
{
    const double one = chain->mass[1], two = second_mass(chain), unlike = (one - two) / (one + two);
    return 2 * half_pi * sqrt(2.5 * (1 + 3 * unlike * unlike));
}

double bead_compacton_speed(const struct bead_chain *chain, double force)
{
    return sqrt(1.6 / (chain->mass[1] + second_mass(chain))) * bead_cbrt(chain->stiffness[1]) * bead_pow(force, sixth);
}

/* Newton's method: three steps suffice for angles below half a radian. */
static double arcsine(double s)
{
    double x = s;
    for (int i = 0; i < 4; i++)
        x += (s - bead_sin(x)) / bead_sin(half_pi - x);
    return x;
}

/* The sixth root of the forces is a cosine, which three adjacent values determine. */
bool bead_compacton_find(const struct bead_chain *chain, const double *forces, size_t count, struct bead_compacton *found)
{
    size_t top = 1;
    for (size_t i = 2; i + 1 < count; i++)
        top = forces[i] > forces[top] ? i : top;
    if (count < 3 || !(forces[top] > 0) || !(forces[top - 1] > 0) || !(forces[top + 1] > 0))
        return false;
    const double k = sqrt(10) / 5, left = bead_pow(forces[top - 1], sixth), middle = bead_pow(forces[top], sixth),
                 right = bead_pow(forces[top + 1], sixth);
    /* middle cos(k n) + b sin(k n) */
    const double b = (right - left) / (2 * bead_sin(k)), height = sqrt(middle * middle + b * b);
    found->centre = (double)top + arcsine(b / height) / k;
    found->height = bead_pow(height, 6);
    found->speed = bead_compacton_speed(chain, found->height);
    return true;
}

double bead_compacton_at(const struct bead_compacton *compacton, double n)
{
    const double phase = sqrt(10) / 5 * (n - compacton->centre);
    return fabs(phase) < half_pi ? compacton->height * bead_pow(bead_sin(half_pi - phase), 6) : 0;
}
