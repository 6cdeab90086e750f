/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the places of curves over time: see places.h. */
#include "sim/measure/places.h"

/* The index of a listed place among `limit` beads or contacts. */
static size_t index_of(size_t listed, size_t limit)
{
    return listed == BEAD_LAST ? limit - 1 : listed;
}

/* The `k`-th listed one that exists: its place in the list, or the list's length if there are fewer. */
static size_t find(const struct bead_listed *listed, size_t limit, size_t k)
{
    size_t i = 0;
    for (; i < listed->count; i++) {
        if (index_of(listed->all[i], limit) < limit && k-- == 0)
            break;
    }
    return i;
}

static size_t below(const struct bead_listed *listed, size_t limit)
{
    size_t count = 0;
    for (size_t i = 0; i < listed->count; i++)
        count += index_of(listed->all[i], limit) < limit;
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
    const struct bead_listed *of = k < beads ? &output->curves.beads : &output->curves.contacts;
    const size_t limit = k < beads ? bead_chain_beads(chain) : bead_chain_contacts(chain);
    const size_t listed = of->all[find(of, limit, k < beads ? k : k - beads)];
    const char *kind = k < beads ? "bead" : "contact";
    place.index = index_of(listed, limit);
    if (k >= beads && !bead_field_info(place.field)->of_contacts)
        place.field = BEAD_FIELD_CONTACT_FORCE;
    if (listed == BEAD_LAST)
        snprintf(place.name, sizeof place.name, "last %s", kind);
    else
        snprintf(place.name, sizeof place.name, "%s %zu", kind, place.index);
    return place;
}

static enum bead_error check(const struct bead_output *output, const struct bead_listed *listed, const char *kind, size_t limit,
                             struct bead_message *msg)
{
    for (size_t i = 0; i < listed->count; i++) {
        if (index_of(listed->all[i], limit) >= limit)
            return bead_output_wrong(output, msg, "%ss: a chain has no %s %zu: its last is %zu", kind, kind, listed->all[i],
                                     limit - 1);
    }
    return BEAD_OK;
}

enum bead_error bead_places_check(const struct bead_output *output, const struct bead_chain *chain, struct bead_message *msg)
{
    BEAD_TRY(check(output, &output->curves.beads, "bead", bead_chain_beads(chain), msg));
    return check(output, &output->curves.contacts, "contact", bead_chain_contacts(chain), msg);
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
