/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Corrects a step near contacts that open or close, see events.h. The stepper calls it after every step. */
#include "sim/integrate/events.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/integrate/events_private.h"
#include "sim/integrate/tableau.h"

/* Picard sweeps: each changes 20 to 40 times less than the one before. Behind the second other errors are larger, unless it still
 * changes a velocity by more than this part of the striker's: a light bead between hard contacts, in a long step. */
enum { SWEEPS = 5, SWEEP_GAIN = 8 };
static const double much = 0x1p-24;
/* Contacts integrated again on each side of a flagged one: without them an order is lost, more gain nothing. */
enum { WIDTH = 1 };
/* Most flagged contacts of a patch, whose cost grows as their square. Longer patches are cut, which loses a little accuracy there.
 */
enum { CLUSTER = 64 };
/* Gaps between patches up to this many contacts are refreshed with them; skipping these would cost more. */
enum { GAP = 64 };

static bool copy_constants(struct bead_events *e, const struct bead_stepper *s)
{
    const struct bead_chain *chain = s->chain;
    size_t length = chain->beads + 2 * BEAD_EVENTS_MARGIN;
    e->constants = calloc(length, 8 * sizeof *e->constants);
    if (!e->constants)
        return false;
    e->stiffness = e->constants + BEAD_EVENTS_MARGIN;
    e->static_compression = e->stiffness + length;
    e->static_force = e->static_compression + length;
    e->inverse_mass = e->static_force + length;
    e->hardness = e->inverse_mass + length;
    e->speeds = (struct bead_event_speeds){.weighed = e->hardness + length, .hardness = e->hardness};
    e->speeds.most = e->speeds.weighed + length;
    e->speeds.known = e->speeds.most + length;
    memcpy(e->stiffness, chain->stiffness, chain->beads * sizeof(double));
    memcpy(e->static_compression, chain->static_compression, chain->beads * sizeof(double));
    memcpy(e->static_force, chain->static_force, chain->beads * sizeof(double));
    memcpy(e->inverse_mass, chain->inverse_mass, chain->beads * sizeof(double));
    e->static_force[-1] = -chain->striker_force;
    e->source.stiffness = e->stiffness;
    e->source.static_compression = e->static_compression;
    e->source.static_force = e->static_force;
    e->source.inverse_mass = e->inverse_mass;
    return true;
}

static bool make_block(struct bead_events *e, size_t beads)
{
    const size_t length = (beads < BEAD_EVENTS_BLOCK ? beads : BEAD_EVENTS_BLOCK) + 2 * BEAD_EVENTS_MARGIN;
    double **const array[] = {&e->flags.d0, &e->flags.r0, &e->flags.d1, &e->flags.r1};
    double *at = e->block = calloc(length, sizeof array / sizeof *array * sizeof *at);
    for (size_t i = 0; at && i < sizeof array / sizeof *array; i++, at += length)
        *array[i] = at + BEAD_EVENTS_MARGIN;
    return e->block;
}

/* Kinks are not known where the method has more stages, or the last of more counts in its sums. */
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
    if (!s->chain->law->one_sided || !s->chain->law->exponent)
        return BEAD_OK;
    struct bead_events *e = calloc(1, sizeof *e);
    if (!e || !copy_constants(e, s) || !make_block(e, s->chain->beads)) {
        bead_events_destroy(e);
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the contact events of %zu beads", s->beads);
    }
    e->rule = bead_patch_rule_make(s->chain->law, &s->chain->spec->law);
    e->kinks_known = kinks_known(s->method->tableau) && s->chain->law->hertz && !s->chain->law->as_printed;
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
    free(events->constants);
    free(events->block);
    free(events->flags.contact);
    free(events->flags.effect);
    free(events->kinks.left);
    for (size_t i = 0; i < 3; i++) {
        free(events->kinks.impulse[i]);
        free(events->kinks.moment[i]);
    }
    free(events->patch.memory);
    free(events->branch);
    free(events);
}

bool bead_events_failed(const struct bead_events *events)
{
    return events && events->failed;
}

/* Make room for `count` contacts in the arrays of a patch; their contents are lost. */
static bool grow_patch(struct bead_patch *patch, size_t count)
{
    size_t room = (count + count / 2 + 2 * BEAD_EVENTS_LANES) / BEAD_EVENTS_LANES * BEAD_EVENTS_LANES, bytes;
    const size_t each = (BEAD_PATCH_ARRAYS + 2 * BEAD_GAUSS_NODES) * sizeof(double) + sizeof(uint32_t) + 2 * sizeof(bool);
    if (count <= patch->room)
        return true;
    if (__builtin_mul_overflow(room, each, &bytes))
        return false;
    void *memory = aligned_alloc(64, (bytes + 63) / 64 * 64);
    if (!memory)
        return false;
    free(patch->memory);
    patch->memory = memory;
    patch->room = room;
    double *at = memory;
    for (size_t i = 0; i < BEAD_PATCH_ARRAYS; i++, at += room)
        patch->array[i] = at;
    patch->force = at;
    patch->curvature = at + BEAD_GAUSS_NODES * room;
    patch->pushing = (void *)(patch->curvature + BEAD_GAUSS_NODES * room);
    patch->closed = (bool *)(patch->pushing + room);
    patch->bends = patch->closed + room;
    return true;
}

/* The states, and the forces that the method's quadrature has added up. */
static void describe_step(struct bead_events *e, const struct bead_stepper *s)
{
    const struct bead_tableau *t = s->method->tableau;
    struct bead_patch_source *source = &e->source;
    source->u0 = s->start.u;
    source->v0 = s->start.v;
    source->a0 = s->start.a;
    source->u1 = s->end.u;
    source->v1 = s->end.v;
    source->a1 = s->end.a;
    source->h = s->h;
    source->stages = 0;
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
    const size_t n = s->active < s->chain->contacts ? s->active : s->chain->contacts;
    const double roomy = 1.5;
    if (!e || !s->kernels->weigh_speeds(n, s->end.v, &e->speeds))
        return;
    double hardest = s->kernels->largest(s->chain->contacts, e->speeds.weighed);
    if (hardest > e->hardest || roomy * roomy * hardest < e->hardest) {
        e->hardest = roomy * hardest;
        e->limits_h = 0; /* find the limits again */
    }
}

/* The weight of the flagged contacts of a patch: the largest. */
static double weight_of(const struct bead_events *e, const size_t *flagged, size_t count)
{
    double most = 1;
    for (size_t i = 0; i < count; i++)
        most = fmax(most, e->speeds.weighed[flagged[i]] / e->hardness[flagged[i]]);
    return most;
}

/* Contacts first..last of the chain, and the frozen ones around them. */
static bool load(struct bead_events *e, const struct bead_stepper *s, size_t first, size_t last)
{
    e->patch.count = last - first + 1;
    if (!grow_patch(&e->patch, e->patch.count + 2))
        return false;
    s->kernels->load_patch(&e->source, (ptrdiff_t)first - 1, &e->patch);
    memset(e->patch.bends, 0, (e->patch.count + 2) * sizeof(bool));
    e->patch.change = 0;
    return true;
}

static void load_quintic(const struct bead_patch *patch, size_t k, double c[6])
{
    for (size_t i = 0; i < 6; i++)
        c[i] = patch->array[BEAD_PATCH_C + i][k];
}

/* Insert in order of s; equal branch points become one. */
static void insert(struct bead_events *e, struct bead_patch_branch branch)
{
    size_t i = e->branch_count;
    while (i > 0 && e->branch[i - 1].s > branch.s)
        i--;
    if (i > 0 && e->branch[i - 1].s == branch.s) {
        e->branch[i - 1].before |= branch.before;
        e->branch[i - 1].after |= branch.after;
        return;
    }
    for (size_t j = e->branch_count++; j > i; j--)
        e->branch[j] = e->branch[j - 1];
    e->branch[i] = branch;
}

/* The branch points of the flagged contacts of a patch that begins with contact `first`. */
static bool find_branches(struct bead_events *e, size_t first, const size_t *flagged, size_t count)
{
    e->branch_count = 0;
    const double weight = weight_of(e, flagged, count);
    e->patch.enough = SWEEP_GAIN * e->limits.tolerance * e->source.h / weight;
    e->patch.much = fmax(e->patch.enough, much * e->unit * e->source.h / weight);
    if (!bead_events_grow((void **)&e->branch, &e->branch_room, count * BEAD_BRANCHES_MAX, sizeof *e->branch))
        return false;
    for (size_t i = 0; i < count; i++) {
        struct bead_patch_branch found[BEAD_BRANCHES_MAX];
        const size_t k = flagged[i] - first + 1;
        double c[6], end[2] = {e->patch.array[BEAD_PATCH_END_D][k], e->patch.array[BEAD_PATCH_END_RATE][k]};
        load_quintic(&e->patch, k, c);
        size_t n = bead_patch_branches(c, end, e->limits.reach, found);
        e->patch.bends[k] = n > 0;
        for (size_t j = 0; j < n; j++)
            insert(e, found[j]);
    }
    return true;
}

static void integrate_piece(struct bead_events *e, const struct bead_stepper *s, double from, double to, const double *tau)
{
    if (!(to > from))
        return;
    for (size_t k = 1; k <= e->patch.count; k++) {
        double c[6];
        if (!e->patch.bends[k])
            continue;
        load_quintic(&e->patch, k, c);
        e->patch.closed[k] = bead_patch_value(c, 0.5 * (from + to)) > 0;
    }
    s->kernels->integrate_piece(from, to, tau, &e->rule, SWEEPS, &e->patch);
}

/* The nearest branch point at or before branch[at] that must not be approached from behind, unless it is too far from the piece. */
static const double *branch_left(const struct bead_events *e, size_t at, double from, double to)
{
    while (at > 0 && !e->branch[at - 1].after)
        at--;
    return at > 0 && from - e->branch[at - 1].s < BEAD_EVENTS_REACH * (to - from) ? &e->branch[at - 1].s : NULL;
}

static const double *branch_right(const struct bead_events *e, size_t at, double from, double to)
{
    while (at < e->branch_count && !e->branch[at].before)
        at++;
    return at < e->branch_count && e->branch[at].s - to < BEAD_EVENTS_REACH * (to - from) ? &e->branch[at].s : NULL;
}

static double within(double s, double until)
{
    return s < 0 ? 0 : s > until ? until : s;
}

/* Integrate from 0 to `until`, from branch point to branch point. An interval with one near either end is split in the middle. */
static void integrate(struct bead_events *e, const struct bead_stepper *s, double until)
{
    for (size_t i = 0; i <= e->branch_count; i++) {
        double from = i > 0 ? within(e->branch[i - 1].s, until) : 0,
               to = i < e->branch_count ? within(e->branch[i].s, until) : until;
        const double *left = branch_left(e, i, from, to), *right = branch_right(e, i, from, to);
        if (left && right) {
            double middle = fmin(fmax(0.5 * (*left + *right), from), to);
            integrate_piece(e, s, from, middle, left);
            integrate_piece(e, s, middle, to, right);
        } else {
            integrate_piece(e, s, from, to, left ? left : right);
        }
    }
}

/* Give the beads of contact k an impulse, and its moment, with opposite signs. Nothing but zero is added to the wall. */
static void owe(const struct bead_events *e, struct bead_stepper *s, size_t k, double impulse, double moment)
{
    s->end.v[k] -= impulse * e->inverse_mass[k];
    s->end.u[k] -= moment * e->inverse_mass[k];
    s->end.v[k + 1] += impulse * e->inverse_mass[k + 1];
    s->end.u[k + 1] += moment * e->inverse_mass[k + 1];
}

/* Replace the impulses of the method's quadrature by those of the patch. */
static void replace(struct bead_events *e, struct bead_stepper *s, size_t first, double h)
{
    double *const *array = e->patch.array;
    for (size_t i = 1; i <= e->patch.count; i++) {
        owe(e, s, first + i - 1, h * (array[BEAD_PATCH_IMPULSE][i] - array[BEAD_PATCH_GIVEN_IMPULSE][i]),
            h * h * (array[BEAD_PATCH_MOMENT][i] - array[BEAD_PATCH_GIVEN_MOMENT][i]));
    }
    s->event_change = fmax(s->event_change, e->patch.change / h);
}

/* Compute again the forces and accelerations that depend on the displacements of beads first..last. */
static void refresh(struct bead_stepper *s, size_t first, size_t last)
{
    size_t from = first > 0 ? first - 1 : 0, to = last + 1 < s->active ? last + 1 : s->active;
    size_t bead_to = to < s->active ? to + 1 : s->active;
    struct bead_contact_table table = s->table;
    table.stiffness += from;
    table.static_compression += from;
    table.static_force += from;
    s->force(to - from, &table, s->end.u + from, NULL, s->end.f + from);
    s->accelerate(bead_to - from, s->end.f + from, s->inverse_mass + from, s->end.a + from);
}

/* Contacts first..last, of which some are flagged. */
static bool correct_patch(struct bead_events *e, struct bead_stepper *s, size_t first, size_t last, const size_t *flagged,
                          size_t count)
{
    if (!load(e, s, first, last) || !find_branches(e, first, flagged, count))
        return false;
    if (e->branch_count == 0)
        return true;
    integrate(e, s, 1);
    replace(e, s, first, s->h);
    return true;
}

/* The largest error left by kinks at..at + count - 1, m/s. */
static double left_undone(const struct bead_events *e, size_t at, size_t count)
{
    double most = 0;
    for (size_t i = at; i < at + count; i++)
        most = e->kinks.left[i] > most ? e->kinks.left[i] : most;
    return most;
}

/* Apply the impulses of kink i to the beads of its contact and of its neighbours, if these exist and lie in the window.
 */
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

/* How many flagged contacts from number `at` on share one patch. */
static size_t cluster(const struct bead_events *e, size_t at)
{
    const size_t *flagged = e->flags.contact + at, left = e->flagged_count - at;
    size_t n = 1;
    while (n < left && n < CLUSTER && flagged[n] - flagged[n - 1] <= 2 * WIDTH + 1)
        n++;
    return n;
}

/* Correct flagged contacts at..at + count - 1 as kinks if that is accurate enough, else in a patch of contacts first..last. */
static bool correct_cluster(struct bead_events *e, struct bead_stepper *s, size_t at, size_t count, size_t first, size_t last)
{
    const double left = e->kinks_known ? left_undone(e, at, count) : INFINITY;
    if (left > s->event_tolerance)
        return correct_patch(e, s, first, last, e->flags.contact + at, count);
    for (size_t i = at; i < at + count; i++)
        owe_kink(e, s, i);
    if (left > s->event_change)
        s->event_change = fmax(s->event_change, left / weight_of(e, e->flags.contact + at, count));
    return true;
}

/* Correct all flagged contacts. Patches that touch or overlap are one. Forces are refreshed after the last patch, and before a gap
 * that is longer than GAP. */
static bool correct_flagged(struct bead_events *e, struct bead_stepper *s)
{
    size_t begin = 0, end = 0; /* beads moved */
    bool ok = true, kinks = e->kinks_known && left_undone(e, 0, e->flagged_count) <= s->event_tolerance;
    for (size_t i = 0, n; ok && i < e->flagged_count; i += n) {
        const size_t *flagged = e->flags.contact + i;
        n = kinks ? 1 : cluster(e, i);
        size_t first = flagged[0] > WIDTH ? flagged[0] - WIDTH : 0, last = flagged[n - 1] + WIDTH;
        if (i > 0 && first < end)
            first = end;
        if (i + n < e->flagged_count && last >= flagged[n])
            last = flagged[n] - 1;
        last = last < s->active ? last : s->active - 1;
        ok = correct_cluster(e, s, i, n, first, last);
        if (i > 0 && first - end > GAP) {
            refresh(s, begin, end);
            begin = first;
        } else if (i == 0) {
            begin = first;
        }
        end = last + 1;
    }
    refresh(s, begin, end);
    return ok;
}

void bead_events_correct(struct bead_events *e, struct bead_stepper *s)
{
    s->event_change = 0;
    describe_step(e, s);
    bool ok = bead_events_flag(e, s);
    if (ok && e->flagged_count > 0)
        ok = correct_flagged(e, s);
    e->failed |= !ok;
}

/* Whether a contact of first..last is flagged. */
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
    describe_step(e, s);
    e->source.stages = 0;
    if (!load(e, s, first, last) || !find_branches(e, first, inner, count)) {
        e->failed = true;
        return false;
    }
    if (e->branch_count == 0)
        return false;
    integrate(e, s, x);
    d[0] = e->patch.array[BEAD_PATCH_D][contact - first + 1];
    d[1] = e->patch.array[BEAD_PATCH_RATE][contact - first + 1];
    return true;
}

const size_t *bead_events_flagged(const struct bead_events *events, size_t *count)
{
    *count = events->flagged_count;
    return events->flags.contact;
}
