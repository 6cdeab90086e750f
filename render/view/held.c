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

/* ---- the largest values, and the latest samples for as long as a wave takes for a cell ---- */

enum { SAMPLES = 32, LONGEST_CELL = 8 };
/* bead_chain_passage is an estimate, never too long by more than this; see movie_times.c. */
static const double passages = 2;

struct bead_hold {
    size_t count, cell;
    double *most, *ring; /* [count]; [SAMPLES][count] */
    double time[SAMPLES], lasting;
    size_t next; /* the place of the next sample; SAMPLES have been kept from then on */
};

void bead_hold_destroy(struct bead_hold *h)
{
    if (!h)
        return;
    free(h->most);
    free(h->ring);
    free(h);
}

enum bead_error bead_hold_create(const struct bead_chain *chain, struct bead_span beads, struct bead_hold **hold,
                                 struct bead_message *msg)
{
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    const double passage = passages * bead_chain_passage(chain, bead_chain_energy(chain));
    BEAD_TRY(bead_new(hold, 1, msg, "a profile"));
    struct bead_hold *h = *hold;
    h->count = beads.last - beads.first + 1;
    h->cell = 1;
    for (size_t i = 0; i < spec->segment_count; i++)
        h->cell = spec->segments[i].cell_beads > h->cell ? spec->segments[i].cell_beads : h->cell;
    h->cell = h->cell < LONGEST_CELL ? h->cell : LONGEST_CELL;
    h->lasting = isfinite(passage) ? passage * (double)h->cell / fmax(1, (double)bead_chain_contacts(chain)) : 0;
    for (size_t k = 0; k < SAMPLES; k++)
        h->time[k] = -INFINITY;
    BEAD_TRY(bead_new(&h->most, h->count, msg, "a profile"));
    return bead_new(&h->ring, SAMPLES * h->count, msg, "a profile");
}

void bead_hold_feed(struct bead_hold *h, double time, const double *values)
{
    size_t last = (h->next + SAMPLES - 1) % SAMPLES;
    for (size_t i = 0; i < h->count; i++)
        h->most[i] = fmax(h->most[i], values[i]);
    /* If samples come faster than the ring can hold, those that do not last a part of it are replaced. */
    size_t before = (h->next + SAMPLES - 2) % SAMPLES;
    if (time - h->time[before] < h->lasting / (SAMPLES - 1)) {
        double *row = h->ring + last * h->count;
        for (size_t i = 0; i < h->count; i++)
            row[i] = fmax(row[i], values[i]);
        h->time[last] = time;
        return;
    }
    memcpy(h->ring + h->next * h->count, values, h->count * sizeof *values);
    h->time[h->next] = time;
    h->next = (h->next + 1) % SAMPLES;
}

static double over_cell(const struct bead_hold *h, const double *values, size_t i)
{
    size_t from = i > (h->cell - 1) / 2 ? i - (h->cell - 1) / 2 : 0;
    double most = values[i];
    for (size_t j = from; j < from + h->cell && j < h->count; j++)
        most = fmax(most, values[j]);
    return most;
}

double bead_hold_largest(const struct bead_hold *h, size_t i)
{
    return over_cell(h, h->most, i);
}

double bead_hold_passing(const struct bead_hold *h, size_t i)
{
    double now = h->time[(h->next + SAMPLES - 1) % SAMPLES], most = -INFINITY;
    for (size_t k = 0; k < SAMPLES; k++) {
        if (h->time[k] >= now - h->lasting)
            most = fmax(most, over_cell(h, h->ring + k * h->count, i));
    }
    return most;
}
