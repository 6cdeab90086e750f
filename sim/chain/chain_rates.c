/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Converts derivatives by stiffnesses and static forces into derivatives by the masses, radii and moduli of beads. */

#include "sim/chain/chain_data.h"

/* A contact's coefficient depends on both bodies; the wall has only a modulus. */
static void add_contact(const struct bead_chain *c, size_t k, double by_stiffness, struct bead_chain_rates *rates)
{
    const struct bead_material *materials = c->scene->materials, *left = &materials[c->material[k]], *right = NULL;
    const bool wall = k + 1 == c->beads;
    if (!wall || c->spec->wall == BEAD_WALL_MATERIAL)
        right = &materials[wall ? c->spec->wall_material : c->material[k + 1]];
    const struct bead_coefficient_rates of = c->law->coefficient_rates(left, right, wall);
    const double scale = by_stiffness * c->stiffness[k];
    rates->radius[k] += scale * of.radius[0];
    rates->modulus[k] += scale * of.modulus[0];
    if (wall) {
        rates->wall_modulus += scale * of.modulus[1];
        return;
    }
    rates->radius[k + 1] += scale * of.radius[1];
    rates->modulus[k + 1] += scale * of.modulus[1];
}

void bead_chain_find_rates(const struct bead_chain *c, const struct bead_chain_raw_rates *raw, struct bead_chain_rates *rates)
{
    double below = 0; /* of the static forces in this contact and all to its right, which carry the bead's weight */
    rates->wall_modulus = 0;
    memset(rates->radius, 0, c->beads * sizeof(double));
    memset(rates->modulus, 0, c->beads * sizeof(double));
    for (size_t k = 0; c->law->coefficient_rates && k < c->contacts; k++)
        add_contact(c, k, raw->stiffness[k], rates);
    for (size_t j = c->beads; j-- > 0;) {
        below += j < c->contacts ? raw->static_force[j] : 0;
        rates->mass[j] = raw->mass[j] + c->slope * (j > 0 ? below : raw->striker_force);
    }
}
