/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps the forces of patches over a step as polynomials, and corrects interpolated states with them: see between.h. */
#include "sim/integrate/between.h"

#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/integrate/events_private.h"
#include "sim/integrate/polynomial.h"

/* Branch points outside the step affect interpolation more, and at larger distances, than the method's quadrature: see
 * events_patch.h. */
static const double outside = 0.01, decay = 0.1;

/* A contact over a piece: coefficients in z of the single and double integral of its force from the start of the step, times h^2,
 * kg m. */
enum { ONCE = BEAD_GAUSS_NODES + BEAD_POWER_MAX, TWICE = ONCE + BEAD_POWER_MAX };
struct cell {
    double once[ONCE], twice[TWICE];
};

/* Contacts first..first + contacts - 1 over the whole step, with a row of cells for each piece. */
struct patch {
    size_t first, contacts, pieces, piece_at, cell_at, contact_at;
};

struct bead_between {
    struct bead_events *events;
    const struct bead_stepper *stepper; /* during bead_between_find */
    struct patch *patch;                /* by contacts */
    struct bead_patch_piece *piece;
    struct cell *cell;
    struct bead_polynomial *taken; /* [contacts] H, in x */
    struct bead_between_point *point;
    size_t patches, pieces, cells, contacts, points;
    size_t patch_room, piece_room, cell_room, contact_room, point_room;
    bool failed;
};

enum bead_error bead_between_create(const struct bead_stepper *s, struct bead_between **between, struct bead_message *msg)
{
    struct bead_events *events = NULL;
    *between = NULL;
    enum bead_error err = bead_stepper_damped(s) ? BEAD_OK : bead_events_create(s, &events, msg);
    if (err || !events)
        return err;
    struct bead_between *b = *between = calloc(1, sizeof *b);
    if (!b) {
        bead_events_destroy(events);
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the contact events within steps");
    }
    events->kinks_known = false;
    events->limits.outside = outside;
    events->limits.decay = decay;
    b->events = events;
    return BEAD_OK;
}

void bead_between_destroy(struct bead_between *b)
{
    if (!b)
        return;
    bead_events_destroy(b->events);
    free(b->patch);
    free(b->piece);
    free(b->cell);
    free(b->taken);
    free(b->point);
    free(b);
}

bool bead_between_failed(const struct bead_between *b)
{
    return b && b->failed;
}

const struct bead_between_point *bead_between_points(const struct bead_between *b, size_t *count)
{
    *count = b ? b->points : 0;
    return b ? b->point : NULL;
}

int bead_between_power(const struct bead_between *b)
{
    return b->events->rule.power;
}

/* ---- polynomials in z ---- */

static double value(const double *c, int count, double z)
{
    double sum = 0;
    for (int i = count - 1; i >= 0; i--)
        sum = sum * z + c[i];
    return sum;
}

/* Coefficients of the Lagrange polynomials at the Gauss nodes, [node][power]. Computed with 60 digits and rounded. */
static const double lagrange[BEAD_GAUSS_NODES][BEAD_GAUSS_NODES] = {
    {1.5806870630309555, -34.19821944098574, 269.27356357270816, -1043.5947738729512, 2210.192149076438, -2607.027087688406,
     1607.6621713958732, -403.92051052855294},
    {-0.9912041583117163, 61.617159374705814, -642.8473834948168, 2835.6432900448704, -6453.676700929121, 7959.337958583151,
     -5055.913230284589, 1296.9422880743202},
    {0.7101568903172424, -48.13780653617997, 691.8847429931317, -3645.381787782764, 9240.736896909015, -12230.40163347763,
     8158.618825941829, -2168.2502663044247},
    {-0.5126556338013685, 35.65556668431134, -558.6155099071855, 3368.7303439267807, -9512.542298244834, 13649.204606959804,
     -9675.365630154633, 2693.7993067876628},
    {0.3537304181064418, -24.870787055815747, 403.66879222363394, -2586.270355021045, 7885.972021802905, -12166.79626857293,
     9181.229517359008, -2693.7993067876628},
    {-0.2208713667044389, 15.613172130290746, -257.8287769428396, 1702.833336741272, -5420.748202006554, 8811.94427021957,
     -7019.133038189143, 2168.2502663044247},
    {0.11217721020871642, -7.951886531660262, 132.49146218846235, -889.0315490693146, 2897.2947203189983, -4859.646626436338,
     4022.6827862356517, -1296.9422880743202},
    {-0.032020422845832404, 2.2728013753338194, -38.02689063309427, 257.0714950331516, -847.2285869268491, 1443.3847804127793,
     -1219.7814023039975, 403.92051052855294},
};

/* integral = start + integral of p ds/dz from 0, where ds/dz = sign m b (a + b z)^{m - 1}. Returns its number of coefficients. */
static int integrate(const struct bead_patch_piece *piece, double start, const double *p, int count, double *integral)
{
    double *q = integral + 1; /* the integrand, then divided by the powers */
    for (int i = 0; i < count; i++)
        q[i] = piece->sign * (piece->power * piece->b) * p[i];
    for (int m = 1; count > 0 && m < piece->power; m++, count++) {
        q[count] = 0;
        for (int i = count; i > 0; i--)
            q[i] = piece->a * q[i] + piece->b * q[i - 1];
        q[0] *= piece->a;
    }
    for (int i = 0; i < count; i++)
        q[i] /= i + 1;
    integral[0] = start;
    return count + 1;
}

static int count_once(const struct bead_patch_piece *piece)
{
    return BEAD_GAUSS_NODES + piece->power;
}

static int count_twice(const struct bead_patch_piece *piece)
{
    return BEAD_GAUSS_NODES + 2 * piece->power;
}

/* ---- keeping ---- */

/* The cell of contact number `index` of a patch over one of its pieces. */
static struct cell *cell_of(const struct bead_between *b, const struct patch *p, size_t piece, size_t index)
{
    return &b->cell[p->cell_at + piece * p->contacts + index];
}

/* Second and third derivative of F by x at an end of the step. */
static void end_of(const struct bead_stepper *s, const struct bead_state *state, size_t k, double out[4])
{
    const struct bead_law *law = s->chain->law;
    const double d = bead_stepper_compression(s, state, k), square = s->h * s->h;
    out[2] = square * law->force(s->table.stiffness[k], s->table.law, d);
    out[3] = square * s->h * law->stiffness(s->table.stiffness[k], s->table.law, d) * (state->v[k] - state->v[k + 1]);
}

/* F and its derivative at the end of the patch's pieces so far. */
static void find_end(const struct bead_between *b, const struct patch *p, size_t index, double out[2])
{
    out[0] = out[1] = 0;
    if (p->pieces == 0)
        return;
    const struct cell *last = cell_of(b, p, p->pieces - 1, index);
    const struct bead_patch_piece *piece = &b->piece[p->piece_at + p->pieces - 1];
    out[0] = value(last->twice, count_twice(piece), 1);
    out[1] = value(last->once, count_once(piece), 1);
}

/* Stores the force of a contact over a piece that has just been integrated. */
static void fill_cell(const struct bead_between *b, const struct patch *p, const struct bead_patch_piece *piece, size_t index)
{
    const struct bead_patch *patch = &b->events->patch;
    const double square = b->stepper->h * b->stepper->h, still = patch->array[BEAD_PATCH_STATIC_FORCE][index + 1];
    const double *force = patch->force + BEAD_GAUSS_NODES * (index + 1);
    double c[BEAD_GAUSS_NODES] = {0}, start[2];
    struct cell *cell = cell_of(b, p, p->pieces, index);
    const bool closed = patch->closed[index + 1];
    find_end(b, p, index, start);
    memset(cell, 0, sizeof *cell);
    for (size_t j = 0; closed && j < BEAD_GAUSS_NODES; j++) {
        for (size_t i = 0; i < BEAD_GAUSS_NODES; i++)
            c[i] += square * (force[j] + still) * lagrange[j][i];
    }
    const int count = integrate(piece, start[1], c, closed ? BEAD_GAUSS_NODES : 0, cell->once);
    integrate(piece, start[0], cell->once, count, cell->twice);
}

static bool add_points(struct bead_between *b)
{
    const struct bead_events *e = b->events;
    if (!bead_memory_grow((void **)&b->point, &b->point_room, b->points + e->branch_count, sizeof *b->point))
        return false;
    for (size_t i = 0; i < e->branch_count; i++) {
        size_t at = b->points++;
        for (; at > 0 && b->point[at - 1].contact > e->branch[i].contact; at--)
            b->point[at] = b->point[at - 1];
        b->point[at] = (struct bead_between_point){e->branch[i].contact, e->branch[i].s};
    }
    return true;
}

static bool add_patch(struct bead_between *b)
{
    const size_t contacts = b->events->patch.count;
    if (!bead_memory_grow((void **)&b->patch, &b->patch_room, b->patches + 1, sizeof *b->patch) ||
        !bead_memory_grow((void **)&b->taken, &b->contact_room, b->contacts + contacts, sizeof *b->taken) || !add_points(b))
        return false;
    b->patch[b->patches++] = (struct patch){b->events->patch_first, contacts, 0, b->pieces, b->cells, b->contacts};
    b->contacts += contacts;
    return true;
}

/* Finds the Hermite polynomials that interpolation uses for F. */
static void find_taken(const struct bead_between *b, const struct patch *p)
{
    for (size_t i = 0; i < p->contacts; i++) {
        double at0[4] = {0}, at1[4];
        end_of(b->stepper, &b->stepper->start, p->first + i, at0);
        end_of(b->stepper, &b->stepper->end, p->first + i, at1);
        find_end(b, p, i, at1);
        b->taken[p->contact_at + i] = bead_polynomial_hermite(at0, at1);
    }
}

/* Keeps a piece. A patch begins and ends with the step. */
static void keep(void *keeper, struct bead_events *e, const struct bead_patch_piece *piece)
{
    struct bead_between *b = keeper;
    if (piece->from == 0)
        b->failed |= !add_patch(b);
    b->failed |= !bead_memory_grow((void **)&b->piece, &b->piece_room, b->pieces + 1, sizeof *b->piece) ||
                 !bead_memory_grow((void **)&b->cell, &b->cell_room, b->cells + e->patch.count, sizeof *b->cell);
    if (b->failed)
        return;
    struct patch *p = &b->patch[b->patches - 1];
    b->piece[b->pieces++] = *piece;
    b->cells += p->contacts;
    for (size_t i = 0; i < p->contacts; i++)
        fill_cell(b, p, piece, i);
    p->pieces++;
    if (piece->to == 1)
        find_taken(b, p);
}

void bead_between_find(struct bead_between *b, const struct bead_stepper *s, struct bead_part part, double tolerance)
{
    if (!b)
        return;
    b->stepper = s;
    b->patches = b->pieces = b->cells = b->contacts = b->points = 0;
    bead_events_weigh(b->events, s);
    bead_events_walk(b->events, s, part, tolerance, keep, b);
    if (b->failed)
        b->patches = b->points = 0;
}

/* ---- correcting ---- */

static const struct bead_patch_piece *piece_at(const struct bead_between *b, const struct patch *p, double x)
{
    const struct bead_patch_piece *piece = b->piece + p->piece_at, *last = piece + p->pieces - 1;
    while (piece < last && piece->to < x)
        piece++;
    return piece;
}

/* F - H of a contact at x, z in a piece, and its derivative by x. */
static void left_out(const struct bead_between *b, const struct patch *p, const struct bead_patch_piece *piece, double z, double x,
                     size_t index, double out[2])
{
    const struct cell *cell = cell_of(b, p, (size_t)(piece - b->piece) - p->piece_at, index);
    const struct bead_polynomial *taken = &b->taken[p->contact_at + index];
    out[0] = value(cell->twice, count_twice(piece), z) - bead_polynomial_value(taken, x);
    out[1] = value(cell->once, count_once(piece), z) - bead_polynomial_slope(taken, x);
}

void bead_between_correct(const struct bead_between *b, const struct bead_stepper *s, double x, struct bead_part part, double *u,
                          double *v)
{
    for (size_t n = 0; b && n < b->patches; n++) {
        const struct patch *p = &b->patch[n];
        const struct bead_patch_piece *piece = piece_at(b, p, x);
        const double z = bead_patch_find(piece, x);
        for (size_t i = 0; i < p->contacts; i++) {
            const size_t k = p->first + i;
            double rest[2];
            if (k + 1 < part.from || k >= part.to)
                continue;
            left_out(b, p, piece, z, x, i, rest);
            for (size_t j = k; j <= k + 1 && j < s->beads; j++) {
                const double w = j == k ? -s->chain->inverse_mass[j] : s->chain->inverse_mass[j];
                u[j] += w * rest[0];
                if (v)
                    v[j] += w * rest[1] / s->h;
            }
        }
    }
}

/* The first patch with this contact or later ones. */
static size_t patch_from(const struct bead_between *b, size_t contact)
{
    size_t low = 0, high = b->patches;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (b->patch[middle].first + b->patch[middle].contacts <= contact)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Adds the corrections of contacts first..last times a factor each. */
static void correct_by(const struct bead_between *b, size_t first, size_t last, const double *factor, double x, double d[2])
{
    for (size_t n = b ? patch_from(b, first) : SIZE_MAX; b && n < b->patches && b->patch[n].first <= last; n++) {
        const struct patch *p = &b->patch[n];
        const struct bead_patch_piece *piece = piece_at(b, p, x);
        const double z = bead_patch_find(piece, x);
        for (size_t k = first < p->first ? p->first : first; k <= last && k < p->first + p->contacts; k++) {
            double rest[2];
            left_out(b, p, piece, z, x, k - p->first, rest);
            d[0] += factor[k - first] * rest[0];
            d[1] += factor[k - first] * rest[1];
        }
    }
}

void bead_between_correct_compression(const struct bead_between *b, const struct bead_stepper *s, size_t contact, double x,
                                      double d[2])
{
    const double left = s->chain->inverse_mass[contact], right = contact + 1 < s->beads ? s->chain->inverse_mass[contact + 1] : 0;
    const double factor[] = {left, -(left + right), right};
    correct_by(b, contact > 0 ? contact - 1 : 0, contact + 1, factor + (contact == 0), x, d);
}

void bead_between_correct_bead(const struct bead_between *b, const struct bead_stepper *s, size_t bead, double x, double u[2])
{
    const double factor[] = {s->chain->inverse_mass[bead], -s->chain->inverse_mass[bead]};
    correct_by(b, bead > 0 ? bead - 1 : 0, bead, factor + (bead == 0), x, u);
}
