/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the places to measure along a chain: see measure_private.h. */
#include "sim/measure/measure_private.h"

/* Contacts between the probe and the end of a long chain. */
enum { MARGIN = 20 };
/* Fewest cells of a regular stretch; cells between a measurement and a disturbance. */
enum { FEWEST_CELLS = 3, APART = 3 };

static bool same(const struct bead_chain *chain, size_t a, size_t b)
{
    return bead_chain_material(chain)[a] == bead_chain_material(chain)[b] && bead_chain_mass(chain)[a] == bead_chain_mass(chain)[b];
}

/* First bead of the longest stretch up to the last bead that repeats every `period`. */
static size_t tail_of(const struct bead_chain *chain, size_t period)
{
    size_t first = bead_chain_beads(chain) - 1;
    while (first > 1 && (first - 1 + period >= bead_chain_beads(chain) || same(chain, first - 1, first - 1 + period)))
        first--;
    return first;
}

size_t bead_places_head(const struct bead_chain *chain, size_t period)
{
    size_t last = 1;
    while (last + 1 < bead_chain_beads(chain) && (last < period || same(chain, last + 1, last + 1 - period)))
        last++;
    return last;
}

/* Do the cells at beads a and b hold the same beads, up to a cyclic shift? */
static bool same_cell(const struct bead_chain *chain, size_t a, size_t b, size_t period)
{
    for (size_t shift = 0; shift < period; shift++) {
        bool all = true;
        for (size_t i = 0; all && i < period; i++)
            all = same(chain, a + i, b + (i + shift) % period);
        if (all)
            return true;
    }
    return false;
}

static void find_defect(struct bead_places *places, const struct bead_chain *chain)
{
    size_t cell = places->cell, head = bead_places_head(chain, cell), last = bead_chain_beads(chain) - 1;
    size_t room = APART * cell + 2; /* the pulse extends about two beads to each side */
    if (head >= last || head < cell * FEWEST_CELLS || !same_cell(chain, 1, places->regular_from, cell))
        return;
    if (head < 2 * room + cell || places->probe < places->regular_from + room)
        return;
    places->defect = true;
    places->before = head - room - cell;
}

struct bead_places bead_places_find(const struct bead_chain *chain)
{
    size_t last = bead_chain_beads(chain) - 1; /* bead, and contacts between beads */
    struct bead_places places = {.links = last, .cell = 1, .regular_from = last};
    size_t margin = last / 4 < MARGIN ? last / 4 : MARGIN;
    places.probe = last > 0 ? last - 1 - margin : 0;
    for (size_t period = 1; period <= BEAD_PLACE_PERIOD && !places.regular; period++) {
        size_t first = tail_of(chain, period);
        if (last + 1 - first < FEWEST_CELLS * period || places.probe < first + period || places.probe + period > last - 1)
            continue;
        places.regular = true;
        places.regular_from = first;
        places.cell = period;
    }
    if (places.regular)
        find_defect(&places, chain);
    return places;
}
