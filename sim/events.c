#include "sim/events.h"

#include <math.h>
#include <stdlib.h>

#include "sim/events_patch.h"
#include "sim/stepper.h"
#include "sim/tableau.h"

/* Picard sweeps: one is 40 times worse, a third brings nothing. */
enum { SWEEPS = 2 };
/* Contacts integrated again on each side of a flagged one. */
enum { WIDTH = 1 };
/* A branch point further outside the step than this does no harm that doubles can hold. */
static const double reach = 2;
/* What a branch point inside the step, rate r, does to the velocity of a bead is less than this times A (h r)^{3/2} h/m. */
static const double effect = 0.01;
/* The same for one x steps outside: less than this over (1 + x/0.03)^3 (1 + x/2)^4, at least 5 times what RKN8's quadrature of
 * (s + x)^{3/2} over 0 <= s <= 1 loses. */
static const double effect_outside = 3e-4, effect_decay = 0.03;

struct bead_events {
    struct bead_patch_rule rule;
    unsigned char *mark; /* [beads] */
    size_t *flagged, flagged_room, flagged_count;
    struct bead_patch_contact *contact;
    size_t contact_room;
    struct bead_patch_branch *branch;
    size_t branch_room, branch_count;
    bool failed;
};

/* Room for `count` elements; what was there is lost unless `keep`. */
static bool grow(void **array, size_t *room, size_t count, size_t size, bool keep)
{
    if (count <= *room)
        return true;
    size_t more = count + count / 2 + 16, bytes;
    if (__builtin_mul_overflow(more, size, &bytes))
        return false;
    void *made;
    if (keep) {
        made = realloc(*array, bytes);
    } else {
        made = aligned_alloc(64, (bytes + 63) / 64 * 64);
        if (made)
            free(*array);
    }
    if (!made)
        return false;
    *array = made;
    *room = more;
    return true;
}

enum bead_error bead_events_create(const struct bead_stepper *s, struct bead_events **events, struct bead_message *msg)
{
    *events = NULL;
    if (!s->chain->law->one_sided)
        return BEAD_OK;
    struct bead_events *e = calloc(1, sizeof *e);
    if (e)
        e->mark = malloc((s->beads + 7) / 8 * 8);
    if (!e || !e->mark) {
        bead_events_destroy(e);
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the contact events of %zu beads", s->beads);
    }
    e->rule = bead_patch_rule_make(s->chain->law, &s->chain->spec->law);
    *events = e;
    return BEAD_OK;
}

void bead_events_destroy(struct bead_events *events)
{
    if (!events)
        return;
    free(events->mark);
    free(events->flagged);
    free(events->contact);
    free(events->branch);
    free(events);
}

bool bead_events_failed(const struct bead_events *events)
{
    return events && events->failed;
}

static double inverse_mass(const struct bead_stepper *s, size_t bead)
{
    return bead < s->beads ? s->chain->inverse_mass[bead] : 0;
}

static double force_power(const struct bead_patch_rule *rule, double r)
{
    return rule->hertz ? r * sqrt(r) : pow(r, rule->spec->power);
}

/* Effect in units of A h/m of a branch point outside the step that compression d and rate r, away from zero, point to. */
static double outside(const struct bead_patch_rule *rule, double d, double r)
{
    if (!(r > 0 && d < reach * r))
        return 0;
    double near = 1 + d / (effect_decay * r), far = (1 + d / (2 * r)) * (1 + d / (2 * r));
    return effect_outside * force_power(rule, r) / (near * near * near * far * far);
}

/* Whether what contact k can do to a velocity exceeds the tolerance. */
static bool matters(const struct bead_patch_rule *rule, const struct bead_stepper *s, size_t k, double h)
{
    const double *u = s->start.u, *v = s->start.v, *y = s->end.u, *w = s->end.v, d = s->chain->static_compression[k];
    double d0 = d + (u[k] - u[k + 1]), d1 = d + (y[k] - y[k + 1]), r0 = h * (v[k] - v[k + 1]), r1 = h * (w[k] - w[k + 1]);
    double left = s->chain->inverse_mass[k], right = inverse_mass(s, k + 1), loss;
    if (d0 > 0 && d1 > 0 && !(r0 < 0 && r1 > 0))
        loss = fmax(outside(rule, d0, r0), outside(rule, d1, -r1));
    else
        loss = effect * force_power(rule, fmax(fabs(r0), fabs(r1)));
    return loss * s->chain->stiffness[k] * h * (left > right ? left : right) > s->event_tolerance;
}

static bool flag(struct bead_events *e, const struct bead_stepper *s, double h)
{
    struct bead_event_ends ends = {s->chain->static_compression, s->start.u, s->start.v, s->end.u, s->end.v, h};
    e->flagged_count = 0;
    if (!s->kernels->mark_events(s->active, &ends, reach, e->mark))
        return true;
    for (size_t k = 0; k < s->active; k++) {
        if (!e->mark[k] || !matters(&e->rule, s, k, h))
            continue;
        if (!grow((void **)&e->flagged, &e->flagged_room, e->flagged_count + 1, sizeof *e->flagged, true))
            return false;
        e->flagged[e->flagged_count++] = k;
    }
    return true;
}

static void load_state(const struct bead_stepper *s, const struct bead_state *state, size_t k, double h, double out[3])
{
    double next = k + 1 < s->beads ? state->a[k + 1] : 0;
    out[0] = s->chain->static_compression[k] + (state->u[k] - state->u[k + 1]);
    out[1] = h * (state->v[k] - state->v[k + 1]);
    out[2] = h * h * (state->a[k] - next);
}

static void load_contact(const struct bead_stepper *s, size_t k, double h, struct bead_patch_contact *contact)
{
    double start[3], end[3];
    *contact = (struct bead_patch_contact){.stiffness = s->chain->stiffness[k],
                                           .static_force = s->chain->static_force[k],
                                           .left = h * h * s->chain->inverse_mass[k],
                                           .right = h * h * inverse_mass(s, k + 1)};
    load_state(s, &s->start, k, h, start);
    load_state(s, &s->end, k, h, end);
    bead_patch_hermite(contact, start, end);
    contact->closed = start[0] > 0 || end[0] > 0;
}

/* Contacts first..last of the chain into contact[1..], the frozen ones around them. Beyond the ends of the chain there is a
 * constant force on the striker, and nothing behind the last contact. */
static bool load(struct bead_events *e, const struct bead_stepper *s, size_t first, size_t last, double h)
{
    size_t count = last - first + 1;
    if (!grow((void **)&e->contact, &e->contact_room, count + 2, sizeof *e->contact, false))
        return false;
    for (size_t k = first; k <= last; k++)
        load_contact(s, k, h, &e->contact[k - first + 1]);
    if (first > 0)
        load_contact(s, first - 1, h, &e->contact[0]);
    else
        e->contact[0] = (struct bead_patch_contact){.static_force = -s->start.f[-1]};
    if (last + 1 < s->beads)
        load_contact(s, last + 1, h, &e->contact[count + 1]);
    else
        e->contact[count + 1] = (struct bead_patch_contact){0};
    return true;
}

/* Into the list, which is in order of s; equal ones become one. */
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

/* The branch points of the flagged contacts among first..last. */
static bool find_branches(struct bead_events *e, size_t first, const size_t *flagged, size_t count)
{
    e->branch_count = 0;
    if (!grow((void **)&e->branch, &e->branch_room, count * BEAD_BRANCHES_MAX, sizeof *e->branch, false))
        return false;
    for (size_t i = 0; i < count; i++) {
        struct bead_patch_branch found[BEAD_BRANCHES_MAX];
        struct bead_patch_contact *contact = &e->contact[flagged[i] - first + 1];
        size_t n = bead_patch_branches(contact, reach, found);
        contact->bends = n > 0;
        for (size_t j = 0; j < n; j++)
            insert(e, found[j]);
    }
    return e->branch_count > 0;
}

static void integrate_piece(struct bead_events *e, const struct bead_stepper *s, size_t count, double from, double to,
                            const double *tau)
{
    struct bead_patch_piece piece;
    if (!(to > from))
        return;
    bead_patch_place(&e->rule, from, to, tau, &piece);
    for (size_t k = 0; k <= count + 1; k++) {
        if (e->contact[k].bends)
            e->contact[k].closed = bead_patch_value(e->contact[k].c, 0.5 * (from + to)) > 0;
    }
    s->kernels->integrate_patch(&piece, &e->rule, SWEEPS, count, e->contact);
}

/* The nearest branch point at or before branch[at] that must not be approached from behind, unless it is too far from the piece. */
static const double *branch_left(const struct bead_events *e, size_t at, double from, double to)
{
    while (at > 0 && !e->branch[at - 1].after)
        at--;
    return at > 0 && from - e->branch[at - 1].s < reach * (to - from) ? &e->branch[at - 1].s : NULL;
}

static const double *branch_right(const struct bead_events *e, size_t at, double from, double to)
{
    while (at < e->branch_count && !e->branch[at].before)
        at++;
    return at < e->branch_count && e->branch[at].s - to < reach * (to - from) ? &e->branch[at].s : NULL;
}

static double in_step(double s)
{
    return s < 0 ? 0 : s > 1 ? 1 : s;
}

/* From branch point to branch point; where one is near either end of an interval, to the middle between them first. */
static void integrate(struct bead_events *e, const struct bead_stepper *s, size_t count)
{
    for (size_t i = 0; i <= e->branch_count; i++) {
        double from = i > 0 ? in_step(e->branch[i - 1].s) : 0, to = i < e->branch_count ? in_step(e->branch[i].s) : 1;
        const double *left = branch_left(e, i, from, to), *right = branch_right(e, i, from, to);
        if (left && right) {
            double middle = fmin(fmax(0.5 * (*left + *right), from), to);
            integrate_piece(e, s, count, from, middle, left);
            integrate_piece(e, s, count, middle, to, right);
        } else {
            integrate_piece(e, s, count, from, to, left ? left : right);
        }
    }
}

/* What the method's quadrature gave contact k: sums of weight_i f_i. */
static double quadrature(const struct bead_stepper *s, const double *weight, size_t k)
{
    const struct bead_tableau *t = s->method->tableau;
    double sum = weight[0] * s->start.f[k];
    for (size_t i = 1; i < t->stages; i++) {
        const double *f = t->fsal && i + 1 == t->stages ? s->end.f : s->stage_f[i];
        sum += weight[i] * f[k];
    }
    return sum;
}

/* Give the beads of each contact the impulse it is owed, with opposite signs. */
static void replace(struct bead_events *e, struct bead_stepper *s, size_t first, size_t last, double h)
{
    const struct bead_tableau *t = s->method->tableau;
    for (size_t k = first; k <= last; k++) {
        const struct bead_patch_contact *contact = &e->contact[k - first + 1];
        double dv = h * (contact->impulse - quadrature(s, t->bp, k)), du = h * h * (contact->moment - quadrature(s, t->b, k));
        double left = s->chain->inverse_mass[k], right = inverse_mass(s, k + 1);
        double change = fabs(h * contact->change) * (left > right ? left : right);
        s->end.v[k] -= dv * left;
        s->end.u[k] -= du * left;
        if (k + 1 < s->beads) {
            s->end.v[k + 1] += dv * right;
            s->end.u[k + 1] += du * right;
        }
        if (change > s->event_change)
            s->event_change = change;
    }
}

/* Forces of all contacts whose beads have been moved, accelerations of all beads that feel them. */
static void refresh(struct bead_stepper *s, size_t first, size_t last)
{
    size_t from = first > 0 ? first - 1 : 0, to = last + 2 < s->active ? last + 2 : s->active;
    size_t bead_to = to < s->active ? to + 1 : s->active;
    struct bead_contact_table table = s->table;
    table.stiffness += from;
    table.static_compression += from;
    table.static_force += from;
    s->force(to - from, &table, s->end.u + from, NULL, s->end.f + from);
    s->accelerate(bead_to - from, s->end.f + from, s->inverse_mass + from, s->end.a + from);
}

static bool correct_patch(struct bead_events *e, struct bead_stepper *s, const size_t *flagged, size_t count, double h)
{
    size_t first = flagged[0] > WIDTH ? flagged[0] - WIDTH : 0, last = flagged[count - 1] + WIDTH;
    last = last < s->active ? last : s->active - 1;
    if (!load(e, s, first, last, h))
        return false;
    if (!find_branches(e, first, flagged, count))
        return e->branch_room >= count * BEAD_BRANCHES_MAX;
    integrate(e, s, last - first + 1);
    replace(e, s, first, last, h);
    refresh(s, first, last);
    return true;
}

void bead_events_correct(struct bead_events *e, struct bead_stepper *s)
{
    const double h = s->h;
    s->event_change = 0;
    bool ok = flag(e, s, h);
    /* Patches that touch or overlap are one. */
    for (size_t i = 0, n; ok && i < e->flagged_count; i += n) {
        n = 1;
        while (i + n < e->flagged_count && e->flagged[i + n] - e->flagged[i + n - 1] <= 2 * WIDTH + 1)
            n++;
        ok = correct_patch(e, s, e->flagged + i, n, h);
    }
    e->failed |= !ok;
}
