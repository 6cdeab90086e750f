/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The dashpot of an absorbing end.
 *
 * Where the contacts at rest have a stiffness k, long waves run at sqrt(k/m) beads a second, and push with sqrt(k m) times the
 * velocity of the beads: the impedance of a chain (L. Brillouin, Wave Propagation in Periodic Structures, chapter 5). A dashpot Z
 * holds the last bead instead of the beads that would follow. With u_j = exp(i q j) + R exp(-i q j) its equation gives the
 * reflected part of the energy, |R|^2 = (1 + z^2 - 2 z cos(q/2)) / (1 + z^2 + 2 z cos(q/2)), z = Z / sqrt(k m): ((1 - z) / (1 +
 * z))^2 for long waves, tan^2(q/4) for z = 1. In cells of several beads long waves see the mean mass and the mean of 1/k.
 *
 * Contacts F = A d^n that nothing presses together have no stiffness at rest, and no dashpot absorbs their waves whole. Forces of
 * solitary waves go with v^(2n/(n+1)), and so does that of the dashpot: what is reflected does not depend on the strength of the
 * wave. Its coefficient is the one that takes the momentum of Nesterenko's wave in the time of its passage: d = d_m cos^(2/(n-1))
 * t, v = c d, c^2 = 2/(n+1) A/m d_m^(n-1) (V. F. Nesterenko, Dynamics of Heterogeneous Materials, chapter 1). */
#include <math.h>

#include "sim/base/wide.h"
#include "sim/chain/contact_walk.h"

static const double pi = 3.14159265358979323846;

/* Sums over contacts. */
struct medium {
    double mass, softness, give; /* of m, 1/k and A^(-1/n) */
    size_t count;
};

/* Bead from which on the chain is of one kind, with the contact before it: the second cell of the last segment that repeats
 * anything, if there is one. */
static size_t last_medium(const struct bead_chain_spec *spec, size_t *end)
{
    size_t beads = 1, from = 0;
    *end = 0;
    for (size_t s = 0; s < spec->segment_count; s++) {
        const size_t next = beads + spec->segments[s].cell_beads * spec->segments[s].count;
        if (spec->segments[s].count > 1 || *end == 0) {
            from = beads + (spec->segments[s].count > 1 ? spec->segments[s].cell_beads : 0);
            *end = next;
        }
        beads = next;
    }
    return from;
}

static struct medium find_medium(const struct bead_chain *chain)
{
    const struct bead_chain_spec *spec = chain->spec;
    size_t end;
    const size_t from = last_medium(spec, &end);
    struct medium sum = {.count = 0};
    struct bead_contact_walk w;
    for (bead_contact_walk_start(&w, chain, false); bead_contact_walk_next(&w) && w.k + 1 < end;) {
        if (w.k + 1 < from)
            continue;
        const double k = w.static_compression > 0 || !spec->law.row->one_sided
                             ? spec->law.row->stiffness(w.stiffness, &spec->law, w.static_compression)
                             : 0;
        sum.mass += w.right_mass;
        sum.softness += 1 / k;
        sum.give += spec->law.row->exponent ? bead_pow(w.stiffness, -1 / spec->law.row->exponent(&spec->law)) : NAN;
        sum.count++;
    }
    return sum;
}

/* The integral of cos^p between its zeros, sqrt(pi) Gamma((p + 1)/2) / Gamma(p/2 + 1), from the series of the quotient for large p
 * (F. W. J. Olver and others, NIST Handbook of Mathematical Functions, 5.11.13) and I(p) = I(p + 2) (p + 2)/(p + 1). */
static double cosine_integral(double p)
{
    double product = 1;
    for (; p < 40; p += 2)
        product *= (p + 2) / (p + 1);
    const double x = 2 / p; /* one over Gamma's argument */
    return product * sqrt(pi * x) * (1 - x * (1. / 8 - x * (1. / 128 + x * (5. / 1024 - x * (21. / 32768)))));
}

static struct bead_dashpot of_solitary_waves(double mass, double stiffness, double n)
{
    const double exponent = 2 * n / (n + 1);
    const double shape = n > 1 ? cosine_integral(2 * n / (n - 1)) / cosine_integral(4 * n / (n * n - 1)) : 1;
    return (struct bead_dashpot){stiffness * bead_pow(0.5 * (n + 1) * mass / stiffness, n / (n + 1)) * shape, exponent};
}

bool bead_chain_find_end(struct bead_chain *chain)
{
    const struct bead_chain_spec *spec = chain->spec;
    chain->end = (struct bead_dashpot){spec->impedance, 1};
    if (!spec->absorbs || !isnan(spec->impedance))
        return true;
    const struct medium sum = find_medium(chain);
    if (isfinite(sum.softness)) {
        chain->end.coefficient = sqrt(sum.mass / sum.softness);
        return true;
    }
    if (!isfinite(sum.give))
        return false;
    const double n = spec->law.row->exponent(&spec->law), count = (double)sum.count;
    chain->end = of_solitary_waves(sum.mass / count, bead_pow(sum.give / count, -n), n);
    return true;
}

double bead_dashpot_force(const struct bead_dashpot *dashpot, double v)
{
    const double size = fabs(v);
    return copysign(dashpot->coefficient * (dashpot->exponent == 1 ? size : bead_pow(size, dashpot->exponent)), v);
}
