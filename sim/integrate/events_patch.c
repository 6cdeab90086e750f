/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrates a few contacts again over the last step, from branch point to branch point: items 2 to 4 of events.h. */
#include <stdlib.h>

#include "sim/chain/drive.h"
#include "sim/integrate/events_private.h"

/* Picard sweeps: each changes 20 to 40 times less than the one before. After the second, other errors are larger, unless it changes
 * a velocity by more than `much` times the striker's: a light bead between stiff contacts, in a long step. */
enum { SWEEPS = 5, SWEEP_GAIN = 8 };
static const double much = 0x1p-24;

bool bead_patch_make(struct bead_patch *patch, size_t beads)
{
    const size_t count = (beads < BEAD_PATCH_MOST ? beads : BEAD_PATCH_MOST) + 2;
    const size_t room = (count + 2 * BEAD_EVENTS_LANES) / BEAD_EVENTS_LANES * BEAD_EVENTS_LANES;
    const size_t each = (BEAD_PATCH_ARRAYS + 2 * BEAD_GAUSS_NODES) * sizeof(double) + sizeof(uint32_t) + 2 * sizeof(bool);
    double *at = patch->memory = aligned_alloc(64, (room * each + 63) / 64 * 64);
    for (size_t i = 0; at && i < BEAD_PATCH_ARRAYS; i++, at += room)
        patch->array[i] = at;
    if (!at)
        return false;
    patch->force = at;
    patch->curvature = at + BEAD_GAUSS_NODES * room;
    patch->pushing = (void *)(patch->curvature + BEAD_GAUSS_NODES * room);
    patch->closed = (bool *)(patch->pushing + room);
    patch->bends = patch->closed + room;
    return true;
}

double bead_patch_weight(const struct bead_events *e, const size_t *flagged, size_t count)
{
    double most = 1;
    for (size_t i = 0; i < count; i++)
        most = fmax(most, e->speeds.weighed[flagged[i]] / e->hardness[flagged[i]]);
    return most;
}

/* Loads contacts first..last of the chain, and the frozen ones on either side. */
static void load(struct bead_events *e, const struct bead_stepper *s, size_t first, size_t last)
{
    e->patch_first = first;
    e->patch.count = last - first + 1;
    s->kernels->load_patch(&e->source, (ptrdiff_t)first - 1, &e->patch);
    memset(e->patch.bends, 0, (e->patch.count + 2) * sizeof(bool));
    e->patch.change = 0;
    e->patch.driven = s->driven == SIZE_MAX ? 0 : (ptrdiff_t)s->driven - (ptrdiff_t)first + 1;
}

static void load_quintic(const struct bead_patch *patch, size_t k, double c[6])
{
    for (size_t i = 0; i < 6; i++)
        c[i] = patch->array[BEAD_PATCH_C + i][k];
}

/* Inserts a branch point in order of s. */
static void insert(struct bead_events *e, struct bead_patch_branch branch)
{
    size_t i = e->branch_count;
    while (i > 0 && e->branch[i - 1].s > branch.s)
        i--;
    for (size_t j = e->branch_count++; j > i; j--)
        e->branch[j] = e->branch[j - 1];
    e->branch[i] = branch;
}

/* Finds the branch points of some contacts of the patch, and the limits of the Picard sweeps. */
static void find_branches(struct bead_events *e, const size_t *flagged, size_t count)
{
    e->branch_count = 0;
    const double weight = bead_patch_weight(e, flagged, count);
    e->patch.enough = SWEEP_GAIN * e->limits.tolerance * e->source.h / weight;
    e->patch.much = fmax(e->patch.enough, much * e->unit * e->source.h / weight);
    for (size_t i = 0; i < count; i++) {
        struct bead_patch_branch found[BEAD_BRANCHES_MAX];
        const size_t k = flagged[i] - e->patch_first + 1;
        double c[6], end[2] = {e->patch.array[BEAD_PATCH_END_D][k], e->patch.array[BEAD_PATCH_END_RATE][k]};
        load_quintic(&e->patch, k, c);
        size_t n = bead_patch_branches(c, end, e->limits.reach, found);
        e->patch.bends[k] = n > 0;
        for (size_t j = 0; j < n; j++) {
            found[j].contact = flagged[i];
            insert(e, found[j]);
        }
    }
}

/* The drive at the nodes of a piece. */
static void find_drive(struct bead_events *e, const struct bead_stepper *s, const struct bead_patch_piece *piece)
{
    struct bead_patch *patch = &e->patch;
    if (!bead_patch_drives(patch))
        return;
    for (size_t i = 0; i < BEAD_GAUSS_NODES; i++) {
        double rate, a[2];
        bead_drive_acceleration(s->chain, s->t0 + s->h * bead_patch_place(piece, bead_gauss_node[i], &rate), a);
        patch->drive[i] = s->h * s->h * a[0];
    }
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
    const struct bead_patch_piece piece = bead_patch_piece_make(e->rule.power, tau, from, to);
    find_drive(e, s, &piece);
    s->kernels->integrate_piece(&piece, &e->rule, SWEEPS, &e->patch);
    if (e->keep)
        e->keep(e->keeper, e, &piece);
}

/* The nearest branch point at or before branch[at] after which the force is not smooth; NULL if it is too far from the piece. */
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

/* Integrates from 0 to `until`. An interval with branch points near both ends is split in the middle. */
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

bool bead_patch_integrate(struct bead_events *e, const struct bead_stepper *s, const struct bead_patch_contacts *c, double until)
{
    load(e, s, c->first, c->last);
    find_branches(e, c->flagged, c->count);
    if (e->branch_count > 0)
        integrate(e, s, until);
    return e->branch_count > 0;
}
