/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the pulses in every contact's force, see measure_private.h; measures of speed, decay and walls use them. */
#include "sim/base/memory.h"
#include "sim/measure/measure_private.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/elementary.h"
#include "sim/base/wide.h"

/* Maxima below this part of the largest force, or of a contact's first pulse, are not pulses. */
static const double least = 1e-4, least_follower = 5e-3;

enum { CENTRE = BEAD_CURVE_POINTS / 2, LAST = BEAD_CURVE_POINTS - 1 };

enum bead_error bead_pulses_create(const struct bead_chain *chain, size_t probe, struct bead_pulses **pulses,
                                   struct bead_message *msg)
{
    size_t contacts = bead_chain_contacts(chain);
    BEAD_TRY(bead_new(pulses, 1, msg, "the pulses of %zu contacts", contacts));
    struct bead_pulses *p = *pulses;
    BEAD_TRY(bead_new(&p->memory, contacts * BEAD_CURVE_POINTS, msg, "the pulses of %zu contacts", contacts));
    BEAD_TRY(bead_new(&p->low, contacts, msg, "the pulses of %zu contacts", contacts));
    BEAD_TRY(bead_new(&p->track, contacts, msg, "the pulses of %zu contacts", contacts));
    p->chain = chain;
    p->contacts = contacts;
    p->probe = probe;
    p->struck = NAN;
    for (size_t i = 0; i < BEAD_CURVE_POINTS; i++)
        p->row[i] = p->memory + i * contacts;
    for (size_t i = 0; i < BEAD_PULSES_AHEAD; i++)
        p->ahead[i] = NAN;
    return BEAD_OK;
}

void bead_pulses_destroy(struct bead_pulses *pulses)
{
    if (!pulses)
        return;
    free(pulses->memory);
    free(pulses->low);
    free(pulses->track);
    free(pulses);
}

struct bead_pulse bead_pulses_first(const struct bead_pulses *pulses, size_t contact)
{
    bool there = contact < pulses->contacts && pulses->track[contact].count > 0;
    return there ? pulses->track[contact].pulse[0] : (struct bead_pulse){NAN, NAN};
}

static void column(const struct bead_pulses *p, size_t contact, double values[BEAD_CURVE_POINTS])
{
    for (size_t i = 0; i < BEAD_CURVE_POINTS; i++)
        values[i] = p->row[i][contact];
}

/* Fronts fall off doubly exponentially: interpolates their logarithms, which are smooth. */
static void look_ahead(struct bead_pulses *p, double x)
{
    for (size_t n = 1; n <= BEAD_PULSES_AHEAD; n++) {
        double values[BEAD_CURVE_POINTS];
        bool there = p->probe + n < p->contacts;
        if (there)
            column(p, p->probe + n, values);
        for (size_t i = 0; there && i < BEAD_CURVE_POINTS; i++) {
            there = values[i] > 0;
            values[i] = bead_log(values[i]);
        }
        if (there) {
            struct bead_curve curve = bead_curve_through(values, BEAD_CURVE_POINTS);
            p->ahead[n - 1] = bead_exp(bead_curve_value(&curve, x));
        }
    }
}

/* Could a maximum of about this force near row `at` change the record of a contact? Most of those behind the front cannot. */
static bool matters(const struct bead_pulses *p, size_t contact, size_t at, double force)
{
    const struct bead_track *track = &p->track[contact];
    const double after = (p->time - p->struck) / p->spacing - (double)(LAST - at); /* spacings after the wall was struck */
    if (after > -1 && force > track->late.force)
        return true;
    if (after > 1)
        return false;
    if (track->count == 0)
        return true;
    const struct bead_pulse *last = &track->pulse[track->count - 1];
    if (p->low[contact] > BEAD_PULSE_END * fmin(last->force, force)) /* still the same pulse */
        return force > last->force;
    return track->count < BEAD_PULSES && force > least_follower * track->pulse[0].force;
}

static void note(struct bead_pulses *p, size_t contact, struct bead_pulse found, double x)
{
    struct bead_track *track = &p->track[contact];
    if (contact + 1 == p->contacts && bead_chain_spec(p->chain)->wall != BEAD_WALL_NONE && isnan(p->struck))
        p->struck = found.time;
    if (found.time > p->struck) {
        if (found.force > track->late.force)
            track->late = found;
        return;
    }
    if (track->count > 0 && found.force < least_follower * track->pulse[0].force)
        return;
    struct bead_pulse *last = track->count > 0 ? &track->pulse[track->count - 1] : NULL;
    bool same = last && p->low[contact] > BEAD_PULSE_END * fmin(last->force, found.force);
    if (same && found.force <= last->force)
        return;
    if (!same && track->count == BEAD_PULSES)
        return;
    if (!same)
        last = &track->pulse[track->count++];
    *last = found;
    p->low[contact] = INFINITY;
    if (contact == p->probe && track->count == 1)
        look_ahead(p, x);
}

/* The contact has a maximum near row `at`. */
static void found_maximum(struct bead_pulses *p, size_t contact, size_t at)
{
    double values[BEAD_CURVE_POINTS];
    column(p, contact, values);
    struct bead_curve curve = bead_curve_through(values, BEAD_CURVE_POINTS);
    double x = bead_curve_maximum(&curve, (double)at - 1, fmin((double)at + 1, LAST)), force = bead_curve_value(&curve, x);
    if (at == LAST && x > LAST - 1e-6) /* still rising */
        return;
    if (!(force >= values[at])) { /* a kink is nearby */
        x = (double)at;
        force = values[at];
    }
    note(p, contact, (struct bead_pulse){force, p->time + (x - LAST) * p->spacing}, x);
}

static void look_at(struct bead_pulses *p, size_t k, size_t at)
{
    /* Between samples a maximum is higher by this factor, at most. */
    static const double higher = 1.1;
    const double before = p->row[at - 1][k], here = p->row[at][k], after = p->row[at < LAST ? at + 1 : LAST][k];
    p->low[k] = here < p->low[k] ? here : p->low[k];
    if (here > before && here >= after && here > least * p->record && matters(p, k, at, higher * here))
        found_maximum(p, k, at);
}

/* Looks for maxima near row `at`. The last contact comes first: if it is the wall's, its maximum ends the time of the pulses. */
static void look(struct bead_pulses *p, size_t moving, size_t at)
{
    if (moving > 0 && moving == p->contacts)
        look_at(p, moving - 1, at);
    for (size_t k = 0; k < moving && k + 1 < p->contacts; k++)
        look_at(p, k, at);
}

void bead_pulses_end(struct bead_pulses *p)
{
    for (size_t at = CENTRE + 1; at <= LAST && p->fed >= BEAD_CURVE_POINTS && !p->ended; at++)
        look(p, p->contacts, at);
    p->ended = true;
}

void bead_pulses_feed(struct bead_pulses *p, const struct bead_sample *sample)
{
    const double *force = sample->field[BEAD_FIELD_CONTACT_FORCE], *rest = bead_chain_static_force(p->chain);
    double *oldest = p->row[0];
    for (size_t i = 0; i + 1 < BEAD_CURVE_POINTS; i++)
        p->row[i] = p->row[i + 1];
    p->row[BEAD_CURVE_POINTS - 1] = oldest;
    size_t moving = sample->active < p->contacts ? sample->active : p->contacts;
    for (size_t k = 0; k < moving; k++) {
        oldest[k] = force[k] - rest[k];
        p->record = oldest[k] > p->record ? oldest[k] : p->record;
    }
    for (size_t k = moving; k < p->contacts; k++)
        oldest[k] = 0;
    p->spacing = sample->time - p->time;
    p->time = sample->time;
    if (++p->fed >= BEAD_CURVE_POINTS)
        look(p, moving, CENTRE);
}
