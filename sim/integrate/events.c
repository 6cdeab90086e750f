/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Corrects a step near contacts that open or close: see events.h. The stepper calls it after every step. */
#include "sim/integrate/events.h"

#include <stdlib.h>

#include "sim/chain/law_beginning.h"
#include "sim/integrate/events_private.h"

/* Contacts integrated again on each side of a flagged one: fewer would lose an order, more would gain nothing. For states within
 * the step they are needed only if the effect of an event exceeds this multiple of the tolerance. */
enum { WIDTH = BEAD_PATCH_WIDTH };
static const double alone_below = 200;
/* Gaps of up to this many contacts between patches are refreshed with them, which costs less than skipping them. */
enum { GAP = 64 };

/* Pages that no event touches use no memory. */
static bool make_arrays(struct bead_events *e, size_t beads)
{
    struct bead_kinks *k = &e->kinks;
    double **const array[] = {&e->stiffness,    &e->static_compression,
                              &e->static_force, &e->inverse_mass,
                              &e->hardness,     &e->speeds.weighed,
                              &e->speeds.most,  &e->speeds.known,
                              &e->flags.d0,     &e->flags.r0,
                              &e->flags.d1,     &e->flags.r1,
                              &e->flags.effect, &k->left,
                              &k->impulse[0],   &k->impulse[1],
                              &k->impulse[2],   &k->moment[0],
                              &k->moment[1],    &k->moment[2],
                              &e->pull};
    const size_t count = sizeof array / sizeof *array, length = beads + 2 * BEAD_EVENTS_MARGIN;
    double *at = e->memory = calloc(length, count * sizeof *at);
    e->flags.contact = calloc(length, sizeof *e->flags.contact);
    for (size_t i = 0; at && i < count; i++, at += length)
        *array[i] = at + BEAD_EVENTS_MARGIN;
    return e->memory && e->flags.contact && bead_patch_make(&e->patch, beads);
}

static void copy_constants(struct bead_events *e, const struct bead_chain *chain)
{
    memcpy(e->stiffness, chain->stiffness, chain->beads * sizeof(double));
    memcpy(e->static_compression, chain->static_compression, chain->beads * sizeof(double));
    memcpy(e->static_force, chain->static_force, chain->beads * sizeof(double));
    memcpy(e->inverse_mass, chain->inverse_mass, chain->beads * sizeof(double));
    e->static_force[-1] = -chain->striker_force;
    e->speeds.hardness = e->hardness;
    e->source.stiffness = e->stiffness;
    e->source.static_compression = e->static_compression;
    e->source.static_force = e->static_force;
    e->source.inverse_mass = e->inverse_mass;
    for (size_t j = 0; chain->spring && j < chain->beads; j++)
        e->pull[j] = chain->spring[j] * chain->inverse_mass[j];
    e->source.pull = e->patch.pulled = chain->spring ? e->pull : NULL;
    if (chain->spec->drive.displacement) /* no spring moves it */
        e->pull[chain->spec->drive.bead] = 0;
}

/* Kinks are known for methods whose sums use no stages beyond BEAD_KINK_STAGES. */
static bool kinks_known(const struct bead_tableau *tableau)
{
    bool known = true;
    for (size_t i = BEAD_KINK_STAGES; i < tableau->stages; i++)
        known = known && tableau->b[i] == 0 && tableau->bp[i] == 0;
    return known;
}

static struct bead_kink_method kink_method(const struct bead_tableau *tableau)
{
    struct bead_kink_method method;
    memset(&method, 0, sizeof method);
    for (size_t i = 0; i < BEAD_KINK_STAGES && i < tableau->stages; i++) {
        method.c[i] = (float)tableau->c[i];
        method.b[i] = (float)tableau->b[i];
        method.bp[i] = (float)tableau->bp[i];
        for (size_t j = 0; j < i; j++)
            method.a[i][j] = (float)tableau->a[i * tableau->stages + j];
    }
    return method;
}

enum bead_error bead_events_create(const struct bead_stepper *s, struct bead_events **events, struct bead_message *msg)
{
    *events = NULL;
    const double exponent = bead_chain_exponent(s->chain);
    if (isnan(exponent))
        return BEAD_OK;
    struct bead_events *e = calloc(1, sizeof *e);
    if (!e || !make_arrays(e, s->chain->beads)) {
        bead_events_destroy(e);
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the contact events of %zu beads", s->beads);
    }
    copy_constants(e, s->chain);
    e->rule = bead_patch_rule_make(&s->chain->spec->law, exponent);
    e->kinks_known = s->method->events && kinks_known(s->method->tableau) && s->chain->law->hertz && !s->chain->law->as_printed;
    if (e->kinks_known)
        e->method = kink_method(s->method->tableau);
    bead_events_bound(e, s);
    *events = e;
    return BEAD_OK;
}

void bead_events_destroy(struct bead_events *events)
{
    if (!events)
        return;
    free(events->memory);
    free(events->flags.contact);
    free(events->patch.memory);
    free(events);
}

void bead_events_open(struct bead_events *e, size_t contact)
{
    e->stiffness[contact] = e->hardness[contact] = e->speeds.weighed[contact] = 0;
}

static void describe_ends(struct bead_events *e, const struct bead_stepper *s)
{
    struct bead_patch_source *source = &e->source;
    source->u0 = s->start.u;
    source->v0 = s->start.v;
    source->a0 = s->start.a;
    source->u1 = s->end.u;
    source->v1 = s->end.v;
    source->a1 = s->end.a;
    source->h = s->h;
    source->stages = 0;
}

/* Describes the states at both ends, and the forces in the method's quadrature. */
static void describe_step(struct bead_events *e, const struct bead_stepper *s)
{
    const struct bead_tableau *t = s->method->tableau;
    struct bead_patch_source *source = &e->source;
    describe_ends(e, s);
    for (size_t i = 0; i < t->stages; i++) {
        if (t->b[i] == 0 && t->bp[i] == 0)
            continue;
        source->impulse[source->stages] = t->bp[i];
        source->moment[source->stages] = t->b[i];
        source->stage[source->stages++] = i == 0 ? s->start.f : t->fsal && i + 1 == t->stages ? s->end.f : s->stage_f[i];
    }
}

void bead_events_weigh(struct bead_events *e, const struct bead_stepper *s)
{
    const double roomy = 1.5;
    const size_t o = s->first;
    if (!e)
        return;
    const struct bead_event_speeds *all = &e->speeds, here = {all->most + o,     all->known + o, all->weighed + o,
                                                              all->hardness + o, all->unit,      all->least};
    if (!s->kernels->weigh_speeds(bead_stepper_contacts(s) - o, s->end.v + o, &here))
        return;
    double hardest = s->kernels->largest(s->chain->contacts - o, here.weighed);
    if (hardest > e->hardest || roomy * roomy * hardest < e->hardest) {
        e->hardest = roomy * hardest;
        e->limits_h = 0; /* the limits are out of date */
    }
}

/* Gives the beads of contact k an impulse, and its moment, with opposite signs. The wall's share is zero. */
static void owe(const struct bead_events *e, struct bead_stepper *s, size_t k, double impulse, double moment)
{
    s->end.v[k] -= impulse * e->inverse_mass[k];
    s->end.u[k] -= moment * e->inverse_mass[k];
    s->end.v[k + 1] += impulse * e->inverse_mass[k + 1];
    s->end.u[k + 1] += moment * e->inverse_mass[k + 1];
}

/* Replaces the impulses of the method's quadrature by those of the patch. */
static void replace(struct bead_events *e, struct bead_stepper *s, size_t first, double h)
{
    double *const *array = e->patch.array;
    for (size_t i = 1; i <= e->patch.count; i++) {
        owe(e, s, first + i - 1, h * (array[BEAD_PATCH_IMPULSE][i] - array[BEAD_PATCH_GIVEN_IMPULSE][i]),
            h * h * (array[BEAD_PATCH_MOMENT][i] - array[BEAD_PATCH_GIVEN_MOMENT][i]));
    }
    s->event_change = fmax(s->event_change, e->patch.change / h);
}

/* Updates the forces and accelerations that depend on the displacements of beads first..last. */
static void refresh(struct bead_stepper *s, size_t first, size_t last)
{
    size_t from = first > s->first ? first - 1 : s->first, to = last + 1 < s->active ? last + 1 : s->active;
    size_t bead_to = to < s->active ? to + 1 : s->active;
    struct bead_contact_table table = s->table;
    table.stiffness += from;
    table.static_compression += from;
    table.static_force += from;
    s->force(to - from, &table, s->end.u + from, NULL, s->end.f + from);
    s->accelerate(bead_to - from, s->end.f + from, s->inverse_mass + from, s->end.a + from);
    bead_stepper_pull(s, s->end.u, s->end.v, s->end.a, (struct bead_part){from, bead_to});
}

/* Largest remaining error of kinks at..at + count - 1, m/s. */
static double left_undone(const struct bead_events *e, size_t at, size_t count)
{
    double most = 0;
    for (size_t i = at; i < at + count; i++)
        most = e->kinks.left[i] > most ? e->kinks.left[i] : most;
    return most;
}

/* Applies the impulses of kink i to the beads of its contact and its neighbours, as far as they are in the window. */
static void owe_kink(const struct bead_events *e, struct bead_stepper *s, size_t i)
{
    const struct bead_kinks *kink = &e->kinks;
    const size_t k = e->flags.contact[i];
    const bool right = k + 1 < s->active;
    const double *w = e->inverse_mass + k, here = kink->impulse[1][i], later = kink->moment[1][i];
    const double after = right ? kink->impulse[2][i] : 0, later_after = right ? kink->moment[2][i] : 0;
    double *v = s->end.v + k, *u = s->end.u + k, before = 0, later_before = 0;
    if (k > 0) {
        before = kink->impulse[0][i];
        later_before = kink->moment[0][i];
        v[-1] -= before * w[-1];
        u[-1] -= later_before * w[-1];
    }
    v[0] += (before - here) * w[0];
    u[0] += (later_before - later) * w[0];
    v[1] += (here - after) * w[1];
    u[1] += (later - later_after) * w[1];
    if (right) {
        v[2] += after * w[2];
        u[2] += later_after * w[2];
    }
}

/* Flagged contacts from number `at` on, which share a patch. */
struct cluster {
    size_t at;
    struct bead_patch_contacts of;
};

/* Contacts integrated again on each side of flagged contact number `i`. */
static size_t width_of(const struct bead_events *e, size_t i)
{
    return e->keep && e->flags.effect[i] < alone_below * e->limits.tolerance ? 0 : WIDTH;
}

/* Number of flagged contacts from number `at` on that share one patch. */
static size_t count_together(const struct bead_events *e, size_t at)
{
    const size_t *flagged = e->flags.contact,
                 most = e->flagged_count - at < BEAD_PATCH_FLAGGED ? e->flagged_count : at + BEAD_PATCH_FLAGGED;
    size_t i = at + 1;
    while (i < most && flagged[i] - flagged[i - 1] <= width_of(e, i - 1) + width_of(e, i) + 1)
        i++;
    return i - at;
}

/* Finds the cluster after `c`, initially {0}. Patches do not overlap. */
static bool next_cluster(const struct bead_events *e, const struct bead_stepper *s, struct cluster *c)
{
    const size_t at = c->at + c->of.count, end = at > 0 ? c->of.last + 1 : 0, *flagged = e->flags.contact + at;
    if (at >= e->flagged_count)
        return false;
    const size_t n = count_together(e, at), before = width_of(e, at);
    size_t first = flagged[0] > before ? flagged[0] - before : 0, last = flagged[n - 1] + width_of(e, at + n - 1);
    first = first < end ? end : first;
    if (at + n < e->flagged_count && last >= flagged[n])
        last = flagged[n] - 1;
    *c = (struct cluster){at, {first, last < s->active ? last : s->active - 1, flagged, n}};
    return true;
}

/* Corrects a cluster as kinks if that is accurate enough, else in a patch. */
static void correct_cluster(struct bead_events *e, struct bead_stepper *s, const struct cluster *c)
{
    const double left = e->kinks_known ? left_undone(e, c->at, c->of.count) : INFINITY;
    if (left > s->event_tolerance) {
        if (bead_patch_integrate(e, s, &c->of, 1))
            replace(e, s, c->of.first, s->h);
        return;
    }
    for (size_t i = c->at; i < c->at + c->of.count; i++)
        owe_kink(e, s, i);
    if (left > s->event_change)
        s->event_change = fmax(s->event_change, left / bead_patch_weight(e, c->of.flagged, c->of.count));
}

/* Corrects all flagged contacts. Forces are refreshed after the last patch, and before a gap longer than GAP. */
static void correct_flagged(struct bead_events *e, struct bead_stepper *s)
{
    struct cluster c = {0};
    size_t begin = 0, end = 0; /* beads moved */
    while (next_cluster(e, s, &c)) {
        correct_cluster(e, s, &c);
        if (end > 0 && c.of.first - end > GAP)
            refresh(s, begin, end);
        if (end == 0 || c.of.first - end > GAP)
            begin = c.of.first;
        end = c.of.last + 1;
    }
    refresh(s, begin, end);
}

void bead_events_correct(struct bead_events *e, struct bead_stepper *s)
{
    s->event_change = 0;
    describe_step(e, s);
    bead_events_flag(e, s, s->event_tolerance);
    if (e->flagged_count > 0)
        correct_flagged(e, s);
}

void bead_events_walk(struct bead_events *e, const struct bead_stepper *s, struct bead_part part, double tolerance,
                      bead_patch_keeper *keep, void *keeper)
{
    struct cluster c = {0};
    describe_ends(e, s);
    bead_events_flag(e, s, tolerance);
    e->keep = keep;
    e->keeper = keeper;
    while (next_cluster(e, s, &c)) {
        if (c.of.last + 1 >= part.from && c.of.first < part.to)
            bead_patch_integrate(e, s, &c.of, 1);
    }
}

/* True if a contact of first..last is flagged. */
static bool any_flagged(const struct bead_events *e, size_t first, size_t last)
{
    size_t low = 0, high = e->flagged_count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (e->flags.contact[middle] < first)
            low = middle + 1;
        else
            high = middle;
    }
    return low < e->flagged_count && e->flags.contact[low] <= last;
}

bool bead_events_compression(struct bead_events *e, const struct bead_stepper *s, size_t contact, double x, double d[2])
{
    size_t first = contact > WIDTH ? contact - WIDTH : 0, last = contact + WIDTH, inner[2 * WIDTH + 1], count = 0;
    last = last < s->active ? last : s->active - 1;
    if (!any_flagged(e, first, last))
        return false;
    for (size_t k = first; k <= last; k++)
        inner[count++] = k;
    describe_ends(e, s);
    if (!bead_patch_integrate(e, s, &(struct bead_patch_contacts){first, last, inner, count}, x))
        return false;
    d[0] = e->patch.array[BEAD_PATCH_D][contact - first + 1];
    d[1] = e->patch.array[BEAD_PATCH_RATE][contact - first + 1];
    return true;
}

const size_t *bead_events_flagged(const struct bead_events *events, size_t *count)
{
    *count = events->flagged_count;
    return events->flags.contact;
}
