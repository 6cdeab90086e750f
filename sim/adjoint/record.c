/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records the states between the steps of a run: see record.h. */
#include "sim/adjoint/record.h"

#include <stdlib.h>

#include "sim/base/memory.h"

enum { FIRST_STATES = 256, FIRST_VALUES = 1 << 14, ARRAYS = 3 };

static enum bead_error grow(struct bead_record *r, size_t values, struct bead_message *msg)
{
    const size_t states = r->room > r->steps + 1 ? r->room : r->room ? 2 * r->room : FIRST_STATES;
    size_t size = r->size ? r->size : FIRST_VALUES;
    while (size < r->used + values)
        size *= 2;
    if (states == r->room && size == r->size)
        return BEAD_OK;
    enum bead_error err =
        bead_memory_check((size - r->size) * sizeof *r->values, "the steps of a run, recorded for its sensitivities", msg);
    if (err)
        return err;
    struct bead_recorded *state = realloc(r->state, states * sizeof *state);
    r->state = state ? state : r->state;
    double *grown = state ? realloc(r->values, size * sizeof *grown) : NULL;
    if (!grown)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the steps of a run, recorded for its sensitivities");
    r->room = states;
    r->values = grown;
    r->size = size;
    return BEAD_OK;
}

static enum bead_error keep(struct bead_record *r, size_t index, double time, size_t active, const struct bead_state *state,
                            struct bead_message *msg)
{
    const double *from[ARRAYS] = {state->u, state->v, state->a};
    BEAD_TRY(grow(r, ARRAYS * active, msg));
    r->state[index] = (struct bead_recorded){time, active, r->used};
    for (int i = 0; i < ARRAYS; i++, r->used += active)
        memcpy(r->values + r->used, from[i], active * sizeof *r->values);
    return BEAD_OK;
}

enum bead_error bead_record_add(struct bead_record *r, const struct bead_stepper *s, struct bead_message *msg)
{
    enum bead_error err = r->steps == 0 ? keep(r, 0, s->t0, s->active, &s->start, msg) : BEAD_OK;
    if (!err)
        err = keep(r, r->steps + 1, s->t1, s->active, &s->end, msg);
    r->steps += !err;
    return err;
}

static void load(const struct bead_record *r, const struct bead_recorded *from, struct bead_state *state, size_t before)
{
    double *to[ARRAYS] = {state->u, state->v, state->a};
    const double *values = r->values + from->at;
    for (int i = 0; i < ARRAYS; i++, values += from->active) {
        memcpy(to[i], values, from->active * sizeof *values);
        if (before > from->active)
            memset(to[i] + from->active, 0, (before - from->active) * sizeof *values);
    }
}

void bead_record_load(const struct bead_record *r, size_t step, struct bead_stepper *s)
{
    const struct bead_recorded *start = &r->state[step], *end = &r->state[step + 1];
    const size_t before = s->active;
    load(r, start, &s->start, before);
    load(r, end, &s->end, before);
    s->last_a = s->end.a;
    s->t0 = start->time;
    s->t1 = end->time;
    s->h = end->time - start->time;
    s->steps = step + 1;
    s->active = end->active;
    s->span = (s->active + 7) / 8 * 8;
}

void bead_record_free(struct bead_record *r)
{
    free(r->state);
    free(r->values);
    *r = (struct bead_record){0};
}
