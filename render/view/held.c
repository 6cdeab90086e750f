/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "render/view/held.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"
#include "sim/chain/system.h"

/* The spacing that shows every oscillation is 1/4 of 1/omega (run_kinds.c), omega the largest frequency that a chain's energy
 * allows. Its shortest pulse, half an oscillation, lasts pi/omega: one of the samples 1/omega apart is within half of that from the
 * maximum, with at least cos(1/2) = 88 % of it; longer pulses lose less. */
static const double widest = 4;
/* Only forces and compressions of contacts come and go; oscillations would be distorted. */
static const unsigned come_and_go =
    BEAD_FIELD_BIT(BEAD_FIELD_FORCE) | BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE) | BEAD_FIELD_BIT(BEAD_FIELD_COMPRESSION);

struct bead_held {
    struct bead_sample sample;
    double *numbers;                 /* memory of `value` */
    double *value[BEAD_FIELD_COUNT]; /* NULL: not asked for */
    size_t first, end[BEAD_FIELD_COUNT];
    bool fed; /* since the last sample was taken */
};

bool bead_held_shows(enum bead_field field)
{
    return (come_and_go & BEAD_FIELD_BIT(field)) != 0;
}

double bead_held_spacing(double resolution)
{
    return widest * resolution;
}

bool bead_held_is_needed(const struct bead_chain *chain, unsigned fields, double every, double resolution)
{
    return bead_chain_spec(chain)->system->has_contacts && (fields & come_and_go) && every > bead_held_spacing(resolution);
}

void bead_held_destroy(struct bead_held *h)
{
    if (h)
        free(h->numbers);
    free(h);
}

enum bead_error bead_held_create(const struct bead_chain *chain, unsigned fields, struct bead_span beads, struct bead_held **held,
                                 struct bead_message *msg)
{
    const size_t all = bead_chain_beads(chain), room = beads.last < all ? beads.last + 1 : all;
    BEAD_TRY(bead_new(held, 1, msg, "samples"));
    struct bead_held *h = *held;
    h->first = beads.first < room ? beads.first : room;
    if (bead_new(&h->numbers, room * (size_t)__builtin_popcount(fields) + 1, msg, "samples of %zu beads", room) != BEAD_OK) {
        bead_held_destroy(h);
        *held = NULL;
        return BEAD_ERROR_MEMORY;
    }
    double *next = h->numbers;
    for (int f = 0; f < BEAD_FIELD_COUNT; f++) {
        const size_t count = bead_field_info((enum bead_field)f)->of_contacts ? bead_chain_contacts(chain) : all;
        if (!(fields & BEAD_FIELD_BIT(f)))
            continue;
        h->end[f] = count < room ? count : room;
        h->value[f] = next;
        next += room;
    }
    return BEAD_OK;
}

static void hold(double *largest, const double *values, size_t first, size_t end)
{
    for (size_t i = first; i < end; i++)
        largest[i] = fabs(values[i]) > fabs(largest[i]) ? values[i] : largest[i];
}

void bead_held_feed(struct bead_held *h, const struct bead_sample *sample)
{
    struct bead_sample *own = &h->sample;
    *own = (struct bead_sample){.chain = sample->chain, .index = sample->index, .time = sample->time, .active = sample->active};
    for (int f = 0; f < BEAD_FIELD_COUNT; f++) {
        const double *values = sample->field[f];
        if (!h->value[f] || !values)
            continue;
        if (h->fed && bead_held_shows((enum bead_field)f))
            hold(h->value[f], values, h->first, h->end[f]);
        else if (h->end[f] > h->first)
            memcpy(h->value[f] + h->first, values + h->first, (h->end[f] - h->first) * sizeof *values);
        own->field[f] = h->value[f];
    }
    h->fed = true;
}

const struct bead_sample *bead_held_take(struct bead_held *h)
{
    const bool fed = h->fed;
    h->fed = false;
    return fed ? &h->sample : NULL;
}
