/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses, from the first hit, the factor that magnifies displacements in stills and movies, if the scene gives none. */
#include "render/stage/magnify.h"

#include <math.h>

#include "beadreel/law.h"
#include "sim/chain/chain_internal.h"

/* In radii: the compression of the striker's hit as drawn, and the limit for any contact whose neighbours meet as fast. */
static const double share = 0.25, limit = 0.5;
/* In radii of the smallest bead: how far a bead held in place swings as drawn, that is, to the place of the next. */
static const double farthest = 2;

static double reduced(double a, double b)
{
    return a * b / (a + b);
}

/* Energy of the hit that the first contact stores, J, or would store if hit with the largest velocity. */
static double hit_energy(const struct bead_chain *chain)
{
    const double *mass = bead_chain_mass(chain), v = bead_chain_speed(chain);
    return 0.5 * (bead_chain_beads(chain) < 2 ? mass[0] : reduced(mass[0], mass[1])) * v * v;
}

/* Energy of a contact where its neighbours meet with the largest velocity; light ones are pressed by those behind them. */
static double squeeze_energy(const struct bead_chain *chain, size_t contact)
{
    const double *mass = bead_chain_mass(chain), v = bead_chain_speed(chain);
    const size_t beads = bead_chain_beads(chain), right = contact + 1;
    const double left = fmax(mass[contact], contact > 0 ? mass[contact - 1] : 0);
    if (right >= beads) /* the wall */
        return 0.5 * left * v * v;
    return 0.5 * reduced(left, fmax(mass[right], right + 1 < beads ? mass[right + 1] : 0)) * v * v;
}

/* Compression of a contact that stores `energy`, m; 0 if it cannot store any. */
static double magnify_compression(const struct bead_chain *chain, size_t contact, double energy)
{
    const struct bead_law_spec *spec = &bead_chain_spec(chain)->law;
    const struct bead_law *law = spec->row;
    double d = law && energy > 0 ? law->energy_compression(bead_chain_stiffness(chain)[contact], spec, energy) : 0;
    return isfinite(d) && d > 0 ? d : 0;
}

double bead_compression_scale(const struct bead_chain *chain)
{
    return bead_chain_contacts(chain) > 0 ? magnify_compression(chain, 0, hit_energy(chain)) : 0;
}

/* The factor for one chain, not rounded; infinite if nothing is struck. */
static double magnify_factor_of(const struct bead_chain *chain)
{
    const double *radius = bead_chain_radius(chain);
    double factor = INFINITY, smallest = INFINITY;
    for (size_t i = 0; i < bead_chain_beads(chain); i++)
        smallest = fmin(smallest, radius[i]);
    const double swing = bead_chain_swing(chain);
    if (swing > 0)
        factor = farthest * smallest / swing;
    for (size_t k = 0; k < bead_chain_contacts(chain); k++) {
        const double hit = k == 0 ? magnify_compression(chain, k, hit_energy(chain)) : 0,
                     d = magnify_compression(chain, k, squeeze_energy(chain, k));
        const double r = k + 1 < bead_chain_beads(chain) ? fmin(radius[k], radius[k + 1]) : radius[k];
        if (hit > 0)
            factor = fmin(factor, share * r / hit);
        if (d > 0)
            factor = fmin(factor, limit * r / d);
    }
    return factor;
}

static double round_factor(double x)
{
    static const double steps[] = {8, 6, 5, 4, 3, 2, 1.5, 1};
    if (!(x > 1))
        return 1;
    double unit = pow(10, floor(log10(x)));
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        if (x >= steps[i] * unit)
            return steps[i] * unit;
    }
    return unit;
}

double bead_magnify_auto(const struct bead_chain *const *chains, size_t count)
{
    double factor = INFINITY;
    for (size_t c = 0; c < count; c++)
        factor = fmin(factor, magnify_factor_of(chains[c]));
    return isfinite(factor) ? round_factor(factor) : 1;
}
