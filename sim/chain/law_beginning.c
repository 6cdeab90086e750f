/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the beginning of forces: see law_beginning.h. */
#include "sim/chain/law_beginning.h"

#include <math.h>

#include "sim/base/wide.h"
#include "sim/chain/contact_walk.h"

/* A small compression, as a part of the largest. */
static const double small = 0x1p-20;
/* An exponent this near to a fraction with a denominator up to DENOMINATORS is rounded to it. Any number would do between `small`,
 * by which d f'/f may still change, and .025, half of the least distance of two such fractions. Above `highest`, the order of the
 * methods with events, the branch point does not disturb steps. */
enum { DENOMINATORS = 5 };
static const double near = 1e-3, highest = 8;

/* The compression by all the energy, on top of the static one. */
static double largest(const struct bead_chain *chain, double stiffness, double static_compression)
{
    const struct bead_law_spec *law = &chain->spec->law;
    return fmax(static_compression, 0) + law->row->energy_compression(stiffness, law, bead_chain_energy(chain));
}

/* d f'/f, which is p + O(d). */
static double slope(const struct bead_law_spec *law, double stiffness, double d)
{
    return d * law->row->stiffness(stiffness, law, d) / law->row->force(stiffness, law, d);
}

static double nearest_fraction(double p)
{
    for (int m = 1; m <= DENOMINATORS; m++) {
        if (fabs(m * p - round(m * p)) < near)
            return round(m * p) / m;
    }
    return p;
}

double bead_chain_exponent(const struct bead_chain *chain)
{
    const struct bead_law_spec *law = &chain->spec->law;
    struct bead_contact_walk w;
    if (!law->row->one_sided)
        return NAN;
    if (law->row->exponent)
        return law->row->exponent(law);
    bead_contact_walk_start(&w, chain, true);
    if (!bead_contact_walk_next(&w))
        return NAN;
    const double d = small * largest(chain, w.stiffness, w.static_compression);
    const double whole = slope(law, w.stiffness, d), half = slope(law, w.stiffness, 0.5 * d), p = 2 * half - whole;
    return fabs(half - whole) < near && p > 0 && p < highest ? nearest_fraction(p) : NAN;
}

double bead_chain_coefficient(const struct bead_chain *chain, size_t k, double exponent)
{
    const struct bead_law_spec *law = &chain->spec->law;
    const double a = chain->stiffness[k];
    if (law->row->exponent || !(a > 0))
        return a;
    const double d = largest(chain, a, chain->static_compression[k]);
    if (!(d > 0))
        return a;
    return fmax(law->row->force(a, law, d) / bead_pow(d, exponent),
                law->row->force(a, law, small * d) / bead_pow(small * d, exponent));
}
