/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps the largest values, and the latest samples for as long as a wave takes for a cell. */
#include "render/view/profile_hold.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"

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
    h->lasting = passage * (double)h->cell / fmax(1, (double)bead_chain_contacts(chain));
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
