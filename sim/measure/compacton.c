/* SPDX-License-Identifier: GPL-3.0-or-later */
/* See compacton.h. */
#include "sim/measure/compacton.h"

#include <math.h>

#include "sim/base/elementary.h"
#include "sim/base/wide.h"
#include "sim/chain/chain_data.h"
#include "sim/chain/law_beginning.h"
#include "sim/chain/system.h"

static const double half_pi = 1.57079632679489662;

bool bead_compacton_is_of(const struct bead_chain *chain)
{
    bool alike = chain->spec->system->has_contacts && bead_chain_exponent(chain) == 1.5 && !(chain->spec->precompression > 0) &&
                 chain->spec->tilt == 0;
    for (size_t j = 1; alike && j < chain->beads; j++)
        alike = chain->mass[j] == chain->mass[1] && (j + 1 >= chain->beads || chain->stiffness[j] == chain->stiffness[1]);
    return alike;
}

/* By Newton's method: three steps are enough for angles of less than half a radian. */
static double arcsine(double s)
{
    double x = s;
    for (int i = 0; i < 4; i++)
        x += (s - bead_sin(x)) / bead_sin(half_pi - x);
    return x;
}

/* The sixth root of the forces is a cosine, which three of them next to each other determine. */
bool bead_compacton_find(const struct bead_chain *chain, const double *forces, size_t count, struct bead_compacton *found)
{
    static const double sixth = 1. / 6;
    size_t top = 1;
    for (size_t i = 1; i + 1 < count; i++)
        top = forces[i] > forces[top] ? i : top;
    if (count < 3 || !(forces[top] > 0) || !(forces[top - 1] > 0) || !(forces[top + 1] > 0))
        return false;
    const double k = sqrt(10) / 5, left = bead_pow(forces[top - 1], sixth), middle = bead_pow(forces[top], sixth),
                 right = bead_pow(forces[top + 1], sixth);
    /* middle cos(k n) + b sin(k n) */
    const double b = (right - left) / (2 * bead_sin(k)), height = sqrt(middle * middle + b * b);
    found->centre = (double)top + arcsine(b / height) / k;
    found->height = bead_pow(height, 6);
    found->speed = sqrt(0.8 / chain->mass[1]) * bead_cbrt(chain->stiffness[1]) * height;
    return true;
}

double bead_compacton_at(const struct bead_compacton *compacton, double n)
{
    const double phase = sqrt(10) / 5 * (n - compacton->centre);
    return fabs(phase) < half_pi ? compacton->height * bead_pow(bead_sin(half_pi - phase), 6) : 0;
}
