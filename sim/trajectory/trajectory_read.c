/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the samples of an open trajectory in blocks, for replays. */
#include "sim/trajectory/trajectory_data.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/chain/chain_data.h"

const struct bead_scene *bead_trajectory_scene(const struct bead_trajectory *t)
{
    return t->scene;
}

const struct bead_chain *const *bead_trajectory_chains(const struct bead_trajectory *t, size_t *count)
{
    *count = t->chain_count;
    return (const struct bead_chain *const *)t->chains;
}

const struct bead_grid *bead_trajectory_grid(const struct bead_trajectory *t)
{
    return &t->grid;
}

unsigned bead_trajectory_fields(const struct bead_trajectory *t)
{
    return t->fields | t->derived;
}

struct bead_span bead_trajectory_beads(const struct bead_trajectory *t)
{
    return t->span;
}

bool bead_trajectory_complete(const struct bead_trajectory *t)
{
    return t->complete;
}

enum bead_error bead_trajectory_outcome(const struct bead_trajectory *t, size_t chain, struct bead_outcome *outcome,
                                        struct bead_message *msg)
{
    if (chain >= t->chain_count)
        return bead_fail(msg, BEAD_ERROR_USAGE, "%s: has %zu chains; there is no chain %zu", t->path, t->chain_count, chain);
    *outcome = t->outcomes[chain];
    return BEAD_OK;
}

/* In a number that is not finite all bits of the exponent are set: adding one to it carries into the sign. */
static bool all_finite(const double *values, size_t count)
{
    const uint64_t exponent = (uint64_t)0x7ff << 52, one = (uint64_t)1 << 52;
    uint64_t carries = 0, bits;
    for (size_t i = 0; i < count; i++) {
        memcpy(&bits, &values[i], sizeof bits);
        carries |= (bits & exponent) + one;
    }
    return !(carries >> 63);
}

/* Read the block that holds sample `index`, unless it is there. */
static enum bead_error read_ahead(struct bead_trajectory *t, struct bead_source *source, size_t index)
{
    if (source->held && index >= source->first && index - source->first < source->held)
        return BEAD_OK;
    if (!source->block && !(source->block = bead_large_take(t->block_rows * source->columns * sizeof(double))))
        return bead_trajectory_no_memory(t);
    size_t first = index - index % t->block_rows;
    size_t count = t->samples - first < t->block_rows ? t->samples - first : t->block_rows;
    source->held = 0;
    bead_h5_read_rows(&t->h5, source->value, first, count, source->columns, source->block);
    size_t all = count * source->columns, bad = t->h5.error || all_finite(source->block, all) ? all : 0;
    while (bad < all && isfinite(source->block[bad]))
        bad++;
    if (bad < all)
        bead_h5_fail(&t->h5, false, "sample %zu holds a number that is not finite", first + bad / source->columns);
    if (t->h5.error)
        return t->h5.error;
    source->first = first;
    source->held = count;
    return BEAD_OK;
}

/* Values of a sample for one chain, by bead or contact number; borrowed from the block if all are stored. */
static const double *values_of(struct bead_trajectory *t, enum bead_series_id id, size_t index, size_t chain)
{
    struct bead_source *source = &t->sources[id];
    const bool contacts = bead_series[id].of_contacts;
    const struct bead_rows *rows = bead_rows_of(&t->rows[chain], contacts);
    size_t all = contacts ? bead_chain_contacts(t->chains[chain]) : bead_chain_beads(t->chains[chain]);
    const double *values = source->block + (index - source->first) * source->columns + rows->row;
    if (rows->count == all)
        return values;
    if (!source->scratch && !(source->scratch = calloc(bead_trajectory_longest(t), sizeof *source->scratch)))
        return NULL;
    if (rows->count)
        memcpy(source->scratch + rows->first, values, rows->count * sizeof *values);
    return source->scratch;
}

static void derive(struct bead_trajectory *t, size_t chain, const double *u, unsigned fields, struct bead_sample *sample)
{
    size_t longest = bead_trajectory_longest(t);
    if (!t->forces && !(t->forces = calloc(3 * longest, sizeof *t->forces))) {
        bead_trajectory_no_memory(t);
        return;
    }
    const unsigned compression = BEAD_FIELD_BIT(BEAD_FIELD_COMPRESSION), derived = fields & t->derived;
    if (derived & ~compression)
        bead_derive_forces(t->chains[chain], u, t->forces, t->forces + longest);
    if (derived & compression)
        bead_derive_compressions(t->chains[chain], u, 0, longest, t->forces + 2 * longest);
    if (derived & BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE))
        sample->field[BEAD_FIELD_CONTACT_FORCE] = t->forces;
    if (derived & BEAD_FIELD_BIT(BEAD_FIELD_FORCE))
        sample->field[BEAD_FIELD_FORCE] = t->forces + longest;
    if (derived & compression)
        sample->field[BEAD_FIELD_COMPRESSION] = t->forces + 2 * longest;
}

enum bead_error bead_trajectory_read(struct bead_trajectory *t, size_t index, size_t chain, unsigned fields,
                                     struct bead_sample *sample, struct bead_message *msg)
{
    *sample = (struct bead_sample){.chain = chain, .index = index};
    if (index >= t->samples || chain >= t->chain_count)
        return bead_fail(msg, BEAD_ERROR_USAGE, "%s: there is no sample %zu of chain %zu", t->path, index, chain);
    if (fields & ~(t->fields | t->derived))
        return bead_fail(msg, BEAD_ERROR_USAGE, "%s: not all requested fields are stored", t->path);
    t->h5.msg = msg;
    t->h5.error = BEAD_OK;
    sample->time = bead_grid_time(&t->grid, index);
    sample->active = bead_chain_beads(t->chains[chain]);
    unsigned wanted = fields & t->derived ? fields | BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) : fields;
    for (int id = 0; id < BEAD_SERIES_COUNT && !t->h5.error; id++) {
        enum bead_field field = bead_series[id].field;
        if (!bead_series[id].stored || !(wanted & t->fields & BEAD_FIELD_BIT(field)) || read_ahead(t, &t->sources[id], index))
            continue;
        sample->field[field] = values_of(t, id, index, chain);
        if (!sample->field[field])
            bead_trajectory_no_memory(t);
    }
    if (!t->h5.error && fields & t->derived)
        derive(t, chain, sample->field[BEAD_FIELD_DISPLACEMENT], fields, sample);
    t->h5.msg = NULL;
    return t->h5.error;
}
