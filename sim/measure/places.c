/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the places of curves over time: see places.h. */
#include "sim/measure/places.h"

static size_t below(const struct bead_listed *listed, size_t limit)
{
    size_t count = 0;
    while (count < listed->count && listed->all[count] < limit) /* they rise */
        count++;
    return count;
}

static bool lists(const struct bead_output *output)
{
    return output->curves.beads.count + output->curves.contacts.count > 0;
}

size_t bead_places_count(const struct bead_output *output, const struct bead_chain *chain)
{
    size_t count;
    if (lists(output))
        return below(&output->curves.beads, bead_chain_beads(chain)) + below(&output->curves.contacts, bead_chain_contacts(chain));
    (void)bead_chain_sensors(chain, &count);
    return count;
}

struct bead_place_shown bead_place_shown(const struct bead_output *output, const struct bead_chain *chain, size_t k)
{
    struct bead_place_shown place = {.field = output->shown.field};
    const size_t beads = below(&output->curves.beads, bead_chain_beads(chain));
    size_t count;
    if (!lists(output)) {
        const struct bead_sensor *sensor = &bead_chain_sensors(chain, &count)[k];
        place.index = sensor->bead;
        snprintf(place.name, sizeof place.name, "%s", sensor->name);
        return place;
    }
    place.index = k < beads ? output->curves.beads.all[k] : output->curves.contacts.all[k - beads];
    if (k >= beads && !bead_field_info(place.field)->of_contacts)
        place.field = BEAD_FIELD_CONTACT_FORCE;
    snprintf(place.name, sizeof place.name, "%s %zu", k < beads ? "bead" : "contact", place.index);
    return place;
}

void bead_place_needs(const struct bead_place_shown *place, struct bead_needs *needs)
{
    needs->fields |= BEAD_FIELD_BIT(place->field);
    needs->beads.first = place->index < needs->beads.first ? place->index : needs->beads.first;
    needs->beads.last = place->index > needs->beads.last ? place->index : needs->beads.last;
}

void bead_places_need(const struct bead_output *output, const struct bead_chain *chain, struct bead_needs *needs)
{
    const size_t count = bead_places_count(output, chain);
    for (size_t k = 0; k < count; k++) {
        const struct bead_place_shown place = bead_place_shown(output, chain, k);
        bead_place_needs(&place, needs);
    }
}

bool bead_is_listed(const struct bead_listed *listed, size_t index)
{
    bool is = listed->count == 0;
    for (size_t i = 0; i < listed->count; i++)
        is = is || listed->all[i] == index;
    return is;
}
