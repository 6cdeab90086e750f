/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Walks along a chain from contact to contact: materials, stiffness and static state of each. */
#include "sim/chain/contact_walk.h"

#include <math.h>

/* The walk visits at least this many equal cells at each end of their segment: no caller needs more than four neighbours. */
static const size_t enough = 4;

void bead_contact_walk_start(struct bead_contact_walk *w, const struct bead_chain *chain, bool kinds)
{
    const struct bead_chain_spec *spec = chain->spec;
    *w = (struct bead_contact_walk){.chain = chain,
                                    .kinds = kinds && spec->tilt == 0, /* on a tilt no two contacts are equal */
                                    .right = spec->striker_material,
                                    .spin = chain->spins};
    for (size_t i = 0; i < BEAD_KNOWN_CONTACTS; i++)
        w->known[i].left = SIZE_MAX;
}

static void end_cell(struct bead_contact_walk *w, const struct bead_segment *segment)
{
    const bool spins = segment->cell_beads > 1;
    const bool equal = !segment->each && (!spins || segment->spins == BEAD_SPINS_UP || segment->spins == BEAD_SPINS_DOWN);
    size_t cells = 1;
    if (w->kinds && equal && w->cell + 1 == enough && segment->count > 2 * enough)
        cells += segment->count - 2 * enough;
    w->spin += spins ? cells : 0;
    w->next += (cells - 1) * segment->cell_beads;
    w->cell += cells;
    w->place = 0;
    if (w->cell == segment->count) {
        w->cell = 0;
        w->segment++;
    }
}

/* Step to the next bead on the right; returns its material. */
static size_t take_bead(struct bead_contact_walk *w)
{
    const struct bead_segment *segment = &w->chain->spec->segments[w->segment];
    const size_t last = segment->cell_beads - 1, at = w->place++;
    const bool reversed = last > 0 && *w->spin == '0';
    const size_t *cell = segment->each ? segment->each + w->cell * segment->cell_beads : segment->cell;
    if (at == last)
        end_cell(w, segment);
    return cell[reversed ? last - at : at];
}

static double stiffness_of(const struct bead_contact_walk *w)
{
    const struct bead_chain_spec *spec = w->chain->spec;
    const struct bead_material *materials = w->chain->scene->materials, *left = &materials[w->left];
    const bool at_wall = w->right == SIZE_MAX;
    if (at_wall && spec->wall == BEAD_WALL_RIGID)
        return spec->law.row->coefficient(&spec->law, left, NULL, true);
    return spec->law.row->coefficient(&spec->law, left, &materials[at_wall ? spec->wall_material : w->right], at_wall);
}

/* Store the force of the stored compression, to the bit, so that the forces in a chain at rest cancel exactly. */
static struct bead_known_contact solve(const struct bead_contact_walk *w, double force, double gap)
{
    const struct bead_law_spec *law = &w->chain->spec->law;
    struct bead_known_contact found = {.left = w->left,
                                       .right = w->right,
                                       .force = force,
                                       .gap = gap,
                                       .stiffness = stiffness_of(w),
                                       .static_compression = 0 - gap};
    if (force > 0) {
        found.static_compression = law->row->compression(found.stiffness, law, force);
        found.static_force = law->row->force(found.stiffness, law, found.static_compression);
    }
    return found;
}

static const struct bead_known_contact *known_contact(struct bead_contact_walk *w, double force, double gap)
{
    struct bead_known_contact *known = &w->known[(3 * w->left + w->right) % BEAD_KNOWN_CONTACTS];
    if (known->left != w->left || known->right != w->right || known->force != force || known->gap != gap)
        *known = solve(w, force, gap);
    return known;
}

/* Free space between the beads of the contact: the striker touches the first, the last touches the wall. */
static double gap_of(const struct bead_contact_walk *w)
{
    return w->k > 0 && w->right != SIZE_MAX ? w->chain->spec->gap + w->chain->scene->materials[w->right].gap : 0;
}

bool bead_contact_walk_next(struct bead_contact_walk *w)
{
    const struct bead_chain *c = w->chain;
    const struct bead_material *materials = c->scene->materials;
    if (w->next >= c->contacts)
        return false;
    w->k = w->next++;
    w->left = w->right;
    w->right = w->k + 1 < c->beads ? take_bead(w) : SIZE_MAX;
    w->left_mass = materials[w->left].mass;
    w->right_mass = w->right != SIZE_MAX ? materials[w->right].mass : INFINITY;
    /* Static force: the precompression and, on a tilt, the weight of the beads above. The striker has not landed, so its own weight
     * is not balanced. */
    w->weight += w->k > 0 ? w->left_mass * c->slope : 0;
    const struct bead_known_contact *known = known_contact(w, c->spec->precompression + w->weight, gap_of(w));
    w->stiffness = known->stiffness;
    w->static_force = known->static_force;
    w->static_compression = known->static_compression;
    return true;
}
