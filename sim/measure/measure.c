/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The measures of a run: feeds its samples to the pulses, the trace and the striker, and keeps the state at the arrival. */
#include "sim/measure/measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/memory.h"
#include "sim/measure/measure_private.h"
#include "sim/measure/participation.h"
#include "sim/run/uncertainty.h"

/* If errors fall as the power p of the spacing, a safety factor of 5 holds where 5 (1 - each^-p) > 1: 2 serves above p = .32, 8
 * above .11. Where no dashpot acts, p is 3/2 or more, as forces begin with that power of the time. A damping force |D|^a with a > 1
 * has a branch point beside the maximum, where D changes its sign: p = a - 1 for its time. For a below 1.11 nothing is derived; .7
 * to 3 were tried by tests/stress/tables.py. */
size_t bead_measures_each(const struct bead_chain *const *chains, size_t count)
{
    bool damped = false;
    for (size_t c = 0; c < count; c++)
        damped = damped || bead_chain_spec(chains[c])->damping_coefficient > 0;
    return damped ? 8 : 2;
}

enum bead_error bead_measures_create(const struct bead_chain *chain, bool of_check, struct bead_measures **measures,
                                     struct bead_message *msg)
{
    size_t beads = bead_chain_beads(chain);
    BEAD_TRY(bead_new(measures, 1, msg, "the measures of %zu beads", beads));
    struct bead_measures *m = *measures;
    enum bead_error err = bead_new(&m->u, 3 * beads, msg, "the measures of %zu beads", beads);
    m->v = err ? NULL : m->u + beads;
    m->deepest = err ? NULL : m->v + beads;
    m->chain = chain;
    m->places = bead_places_find(chain);
    m->time = m->clean = m->arrived = m->strike.opened = m->strike.velocity = NAN;
    m->validity = bead_validity_begin(chain);
    if (!err)
        err = bead_pulses_create(chain, m->places.probe, &m->pulses, msg);
    if (!err)
        err = bead_participation_clean(chain, of_check ? BEAD_UNCERTAINTY_FINER : 1, &m->clean, msg);
    if (err) {
        bead_measures_destroy(m);
        *measures = NULL;
    }
    return err;
}

void bead_measures_destroy(struct bead_measures *measures)
{
    if (!measures)
        return;
    bead_pulses_destroy(measures->pulses);
    bead_trace_free(&measures->trace);
    free(measures->u);
    free(measures);
}

/* The front has arrived when the last contact's force exceeds this part of the largest so far. */
static const double front_part = 1e-4;

static bool at_end(const struct bead_measures *m, const struct bead_sample *sample)
{
    size_t last = bead_chain_contacts(m->chain) - 1;
    return last < sample->active &&
           sample->field[BEAD_FIELD_CONTACT_FORCE][last] - bead_chain_static_force(m->chain)[last] > front_part * m->pulses->record;
}

/* The largest compression of contact k since the last sample, less the static one: if it has turned back, the maximum of the cubic
 * through both values and rates. */
static double deepest(const struct bead_measures *m, const struct bead_sample *sample, size_t k)
{
    const double *u = sample->field[BEAD_FIELD_DISPLACEMENT], *v = sample->field[BEAD_FIELD_VELOCITY], h = sample->time - m->time;
    const bool wall = k + 1 == bead_chain_beads(m->chain);
    const double d[2] = {m->u[k] - (wall ? 0 : m->u[k + 1]), u[k] - (wall ? 0 : u[k + 1])};
    const double r[2] = {h * (m->v[k] - (wall ? 0 : m->v[k + 1])), h * (v[k] - (wall ? 0 : v[k + 1]))};
    if (!(r[0] > 0 && r[1] < 0))
        return d[1];
    const double x = r[0] / (r[0] - r[1]);
    const double rise = x * r[0] + x * x * (3 * (d[1] - d[0]) - 2 * r[0] - r[1] + x * (r[0] + r[1] - 2 * (d[1] - d[0])));
    return d[0] + rise > d[1] ? d[0] + rise : d[1];
}

enum bead_error bead_measures_feed(struct bead_measures *m, const struct bead_sample *sample, struct bead_message *msg)
{
    size_t beads = bead_chain_beads(m->chain), moving = sample->active < beads ? sample->active : beads;
    bead_pulses_feed(m->pulses, sample);
    bead_strike_feed(m, sample);
    for (size_t k = 0; k < moving && k < bead_chain_contacts(m->chain); k++) {
        const double d = deepest(m, sample, k);
        m->deepest[k] = d > m->deepest[k] ? d : m->deepest[k];
    }
    memcpy(m->u, sample->field[BEAD_FIELD_DISPLACEMENT], moving * sizeof *m->u);
    memcpy(m->v, sample->field[BEAD_FIELD_VELOCITY], moving * sizeof *m->v);
    m->time = sample->time;
    if (isnan(m->arrived) && at_end(m, sample)) {
        m->arrived = bead_chain_participation(m->chain, m->u, m->v);
        m->arrived_time = sample->time;
    }
    return bead_trace_feed(m, sample, msg);
}

double bead_measure_uncertainty(const struct bead_measure *measure, const struct bead_measure *checks, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (strcmp(checks[i].name, measure->name) == 0)
            return bead_uncertainty_measured(0, measure->value, checks[i].value);
    }
    return NAN;
}
