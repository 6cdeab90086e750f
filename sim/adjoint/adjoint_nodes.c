/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds stiffnesses and derivatives of forces at the nodes of a step: see adjoint_nodes.h. */
#include "sim/adjoint/adjoint_nodes.h"

#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/integrate/events_patch.h"

/* Branch points count up to this distance outside a step, in steps, if they may change a velocity by this part of the striker's,
 * which excludes contacts that the wave just reaches. */
static const double reach = 0.3, least = 8e-9;
/* Largest correction of times found by interpolation, in steps. */
static const double farthest = 0.1;
/* Second-order effects of a stiffness are negligible below the weight `slight`. The part of the step within `around` of a branch
 * point is stepped separately if the contact is heavy. */
static const double slight = 5e-4, around = 0.05;
/* Degree of the polynomials that replace a stiffness. Their product with r must be within the order of the method: both higher and
 * lower degrees give larger errors. */
enum { DEGREE = 3 };

/* ---- memory ---- */

size_t bead_adjoint_padded(const struct bead_chain *chain)
{
    return (chain->beads + 2 * BEAD_ADJOINT_MARGIN + 7) / 8 * 8;
}

static bool has_static(const struct bead_chain *chain)
{
    bool any = false;
    for (size_t k = 0; k < chain->contacts; k++)
        any = any || chain->static_force[k] > 0;
    return any;
}

static void lay_out(struct bead_adjoint_nodes *n, const struct bead_chain *chain)
{
    const size_t padded = bead_adjoint_padded(chain);
    double *at = (double *)n->memory + BEAD_ADJOINT_MARGIN;
    double **const alone[] = {&n->inverse_mass, &n->static_stiffness, &n->u};
    double **const each[] = {n->force, n->acceleration, n->stiffness, n->by_stiffness, n->by_static};
    for (size_t i = 0; i < sizeof alone / sizeof *alone; i++, at += padded)
        *alone[i] = at;
    for (size_t a = 0; a < sizeof each / sizeof *each; a++) {
        for (size_t i = 0; i < BEAD_NODES; i++, at += padded)
            each[a][i] = at;
    }
    for (size_t i = 0; i < BEAD_NODES; i++) {
        *(n->force[i] - 1) = chain->striker_force;
        if (!n->has_static)
            n->by_stiffness[i] = n->force[i];
    }
}

enum bead_error bead_adjoint_nodes_create(const struct bead_chain *chain, const struct bead_record *record,
                                          const struct bead_kernels *kernels, struct bead_adjoint_nodes *n,
                                          struct bead_message *msg)
{
    const struct bead_method *method = bead_method_row("rkn8");
    *n = (struct bead_adjoint_nodes){.method = method->tableau, .record = record, .has_static = has_static(chain)};
    enum bead_error err = bead_stepper_create(chain, method, kernels, false, &n->stepper, msg);
    if (!err)
        err = bead_dense_create(n->stepper, &n->dense, msg);
    n->memory = calloc(bead_adjoint_padded(chain) * (3 + 5 * BEAD_NODES), sizeof(double));
    if (!err && !n->memory)
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the sensitivities of %zu beads", chain->beads);
    if (err)
        return err;
    lay_out(n, chain);
    memcpy(n->inverse_mass, chain->inverse_mass, chain->beads * sizeof(double));
    for (size_t k = 0; k < chain->contacts; k++)
        n->static_stiffness[k] = chain->law->stiffness(chain->stiffness[k], &chain->spec->law, chain->static_compression[k]);
    return BEAD_OK;
}

void bead_adjoint_nodes_destroy(struct bead_adjoint_nodes *n)
{
    bead_stepper_destroy(n->stepper);
    bead_dense_destroy(&n->dense);
    free(n->memory);
    free(n->point);
}

/* ---- contacts that open or close ---- */

/* Contacts of a part of the beads that may have a stiffness. */
static struct bead_part contacts_of(const struct bead_stepper *s, const struct bead_part *part)
{
    const size_t last = bead_stepper_contacts(s);
    return (struct bead_part){part->from, part->to < last ? part->to : last};
}

struct bead_adjoint_curve bead_adjoint_curve(const struct bead_adjoint_nodes *n, size_t contact)
{
    return (struct bead_adjoint_curve){contact, bead_dense_compression(n->stepper, contact)};
}

void bead_adjoint_compression(const struct bead_adjoint_nodes *n, const struct bead_adjoint_curve *curve, double x, double d[2])
{
    d[0] = bead_polynomial_value(&curve->compression, x);
    d[1] = bead_polynomial_slope(&curve->compression, x);
    bead_between_correct_compression(n->dense.between, n->stepper, curve->contact, x, d);
}

/* Adds a branch point, after one Newton step to the zero of its compression. */
static void add_point(struct bead_adjoint_nodes *n, const struct bead_between_point *found)
{
    const struct bead_stepper *s = n->stepper;
    const size_t k = found->contact;
    const struct bead_adjoint_curve curve = bead_adjoint_curve(n, k);
    double d[2];
    bead_adjoint_compression(n, &curve, found->at, d);
    const double shift = -d[0] / d[1], w = fmax(n->inverse_mass[k], k + 1 < s->beads ? n->inverse_mass[k + 1] : 0);
    n->point[n->points++] =
        (struct bead_adjoint_point){k, fabs(shift) < farthest ? found->at + shift : found->at,
                                    s->h * s->h * w * s->chain->law->stiffness(s->table.stiffness[k], s->table.law, fabs(d[1]))};
}

enum bead_error bead_adjoint_nodes_load(struct bead_adjoint_nodes *n, size_t step, struct bead_part part, struct bead_message *msg)
{
    const struct bead_stepper *s = n->stepper;
    size_t count;
    bead_record_load(n->record, step, n->stepper);
    bead_between_find(n->dense.between, s, part, least * s->chain->speed);
    const struct bead_between_point *found = bead_between_points(n->dense.between, &count);
    if (bead_between_failed(n->dense.between) || !bead_memory_grow((void **)&n->point, &n->point_room, count, sizeof *n->point))
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the contacts that open or close");
    n->points = 0;
    for (size_t i = 0; i < count; i++) {
        if (found[i].at > -reach && found[i].at < 1 + reach)
            add_point(n, &found[i]);
    }
    return BEAD_OK;
}

/* ---- moments ---- */

/* Legendre's polynomials of 0 <= z <= 1. */
static void legendre(double z, double p[DEGREE + 1])
{
    const double x = 2 * z - 1;
    p[0] = 1;
    p[1] = x;
    for (int m = 1; m < DEGREE; m++)
        p[m + 1] = ((2 * m + 1) * x * p[m] - m * p[m - 1]) / (m + 1);
}

/* Integrals of a stiffness with itself, for z from 0 to 1 over a part of the step. */
struct twice {
    double once[3];   /* I_i, of z^i K so far */
    double second[3]; /* of K (z I_0 - I_1), K (z I_1 - I_2) and (1 - z) K (z I_1 - I_2) */
};

/* Continues the integrals over Gauss nodes z, with their dz. */
static void go_on(struct twice *t, const double z[BEAD_GAUSS_NODES], const double dz[BEAD_GAUSS_NODES],
                  const double stiffness[BEAD_GAUSS_NODES])
{
    double up_to[3][BEAD_GAUSS_NODES];
    for (size_t i = 0; i < BEAD_GAUSS_NODES; i++) {
        for (int q = 0; q < 3; q++)
            up_to[q][i] = t->once[q];
    }
    for (size_t j = 0; j < BEAD_GAUSS_NODES; j++) {
        const double k = dz[j] * stiffness[j], moment[3] = {k, k * z[j], k * (z[j] * z[j])};
        for (int q = 0; q < 3; q++) {
            t->once[q] += bead_gauss_weight[j] * moment[q];
            for (size_t i = 0; i < BEAD_GAUSS_NODES; i++)
                up_to[q][i] += bead_gauss_once[j][i] * moment[q];
        }
    }
    for (size_t i = 0; i < BEAD_GAUSS_NODES; i++) {
        const double k = bead_gauss_weight[i] * dz[i] * stiffness[i], late = z[i] * up_to[1][i] - up_to[2][i];
        t->second[0] += k * (z[i] * up_to[0][i] - up_to[1][i]);
        t->second[1] += k * late;
        t->second[2] += k * ((1 - z[i]) * late);
    }
}

/* Moments of the stiffness [0] and the force [1] of a contact over a part of the step next to a branch point at tau. */
struct moments {
    struct bead_adjoint_curve curve;
    double low, length; /* over low <= x <= low + length */
    double sum[2][DEGREE + 1];
    bool twice; /* includes those of its stiffness with itself */
    struct twice stiffness;
};

/* Integrates over nodes with x = tau +- z^m. */
static void integrate(const struct bead_adjoint_nodes *n, struct moments *m, double from, double to, double tau)
{
    const struct bead_stepper *s = n->stepper;
    const double a = s->table.stiffness[m->curve.contact];
    const struct bead_patch_piece piece = bead_patch_piece_make(bead_between_power(n->dense.between), &tau, from, to);
    double z[BEAD_GAUSS_NODES], dz[BEAD_GAUSS_NODES], stiffness[BEAD_GAUSS_NODES];
    for (size_t i = 0; i < BEAD_GAUSS_NODES; i++) {
        double d[2], p[DEGREE + 1], rate;
        const double at = bead_patch_place(&piece, bead_gauss_node[i], &rate);
        bead_adjoint_compression(n, &m->curve, at, d);
        z[i] = (at - m->low) / m->length;
        dz[i] = rate / m->length;
        stiffness[i] = s->chain->law->stiffness(a, s->table.law, d[0]);
        legendre(z[i], p);
        const double weight = bead_gauss_weight[i] * dz[i], force = s->chain->law->force(a, s->table.law, d[0]);
        for (int q = 0; q <= DEGREE; q++) {
            m->sum[0][q] += weight * stiffness[i] * p[q];
            m->sum[1][q] += weight * force * p[q];
        }
    }
    if (m->twice)
        go_on(&m->stiffness, z, dz, stiffness);
}

/* Integrates from one branch point to the next, or to an end of the part. Between two of them, each half uses the nearer one. */
static void integrate_between(const struct bead_adjoint_nodes *n, struct moments *m, double from, double to, double before,
                              double after)
{
    const double middle = 0.5 * (from + to);
    double d[2];
    bead_adjoint_compression(n, &m->curve, middle, d);
    if (!(to > from) || !(d[0] > 0))
        return;
    if (!isfinite(after) || !isfinite(before)) {
        integrate(n, m, from, to, isfinite(before) ? before : after);
        return;
    }
    integrate(n, m, from, middle, before);
    integrate(n, m, middle, to, after);
}

/* The value at z of the polynomial with these moments. */
static double value_of(const double sum[DEGREE + 1], double z)
{
    double p[DEGREE + 1], value = 0;
    legendre(z, p);
    for (int q = 0; q <= DEGREE; q++)
        value += (2 * q + 1) * sum[q] * p[q];
    return value;
}

/* A polynomial with the moments of K has the effect of K on e'' = - c K e to first order. To second order, e(1) and e'(1) also
 * contain c^2 times the integrals of (1 - t) K(t) and of K(t), both times that of (t - s) K(s) e(s), s < t. The moments of z^0, z^1
 * and z^2 are moved so that the polynomial gives the same contributions for e = 1 and e = s. */
static void move_moments(const struct bead_adjoint_nodes *n, struct moments *m)
{
    static const double even[BEAD_GAUSS_NODES] = {1, 1, 1, 1, 1, 1, 1, 1};
    const size_t k = m->curve.contact;
    const double h = n->stepper->h * m->length, right = k + 1 < n->stepper->beads ? n->inverse_mass[k + 1] : 0,
                 c = h * h * (n->inverse_mass[k] + right);
    struct twice smooth = {{0}, {0}};
    double stiffness[BEAD_GAUSS_NODES];
    for (size_t i = 0; i < BEAD_GAUSS_NODES; i++)
        stiffness[i] = value_of(m->sum[0], bead_gauss_node[i]);
    go_on(&smooth, bead_gauss_node, even, stiffness);
    const double *from = smooth.second, *to = m->stiffness.second;
    const double by0 = c * (from[0] - to[0]), by1 = c * (from[1] - to[1]), by2 = by1 - c * (from[2] - to[2]);
    m->sum[0][0] += by0;
    m->sum[0][1] += 2 * by1 - by0;
    m->sum[0][2] += 6 * by2 - 6 * by1 + by0;
}

/* Sets the nodes of the contact of branch points first..last - 1, in ascending order, from the moments. */
static void smooth_contact(struct bead_adjoint_nodes *n, double from, double back, size_t first, size_t last)
{
    const size_t k = n->point[first].contact;
    struct moments m = {.curve = bead_adjoint_curve(n, k), .low = back, .length = from - back};
    double at = back, before = -INFINITY;
    for (size_t i = first; i < last; i++)
        m.twice = m.twice || n->point[i].weight > slight;
    for (size_t i = first; i < last; i++) {
        const double tau = n->point[i].at, to = fmin(fmax(tau, at), from);
        integrate_between(n, &m, at, to, before, tau);
        before = tau;
        at = to;
    }
    integrate_between(n, &m, at, from, before, INFINITY);
    if (m.twice)
        move_moments(n, &m);
    for (size_t i = 0; i < BEAD_NODES; i++) {
        n->stiffness[i][k] = value_of(m.sum[0], 1 - n->method->c[i]);
        n->force[i][k] = value_of(m.sum[1], 1 - n->method->c[i]) - n->stepper->table.static_force[k];
    }
}

static bool within(const struct bead_part *part, size_t contact)
{
    return contact + 1 >= part->from && contact < part->to;
}

static void smooth_all(struct bead_adjoint_nodes *n, double from, double back, const struct bead_part *part)
{
    for (size_t first = 0, last; first < n->points; first = last) {
        for (last = first + 1; last < n->points && n->point[last].contact == n->point[first].contact;)
            last++;
        if (within(part, n->point[first].contact))
            smooth_contact(n, from, back, first, last);
    }
    /* the beads beside them */
    for (size_t b = 0; b < n->points; b++) {
        for (size_t j = n->point[b].contact; j <= n->point[b].contact + 1 && j < n->stepper->beads; j++) {
            for (size_t i = 0; within(part, n->point[b].contact) && i < BEAD_NODES; i++)
                n->acceleration[i][j] = (*(n->force[i] + j - 1) - n->force[i][j]) * n->inverse_mass[j];
        }
    }
}

/* ---- nodes ---- */

static void find_displacements(struct bead_adjoint_nodes *n, double x, const struct bead_part *part)
{
    const struct bead_stepper *s = n->stepper;
    const struct bead_part moving = {part->from, part->to + 1 < s->active ? part->to + 1 : s->active};
    bead_dense_displacement(&n->dense, s, x, moving, n->u);
    if (part->to >= s->active)
        memset(n->u + s->active, 0, (part->to + 1 - s->active) * sizeof *n->u);
    bead_between_correct(n->dense.between, s, x, *part, n->u, NULL);
}

static void find_stiffnesses(struct bead_adjoint_nodes *n, double *stiffness, const struct bead_part *part)
{
    const struct bead_stepper *s = n->stepper;
    const struct bead_law *law = s->chain->law;
    const struct bead_part contacts = contacts_of(s, part);
    memset(stiffness + part->from, 0, (part->to - part->from) * sizeof *stiffness);
    if (contacts.to <= contacts.from)
        return;
    if (law->hertz) {
        struct bead_contact_table table = s->table;
        table.stiffness += part->from;
        table.static_compression += part->from;
        s->kernels->hertz_stiffness(contacts.to - contacts.from, &table, n->u + part->from, n->u + part->from, 0,
                                    stiffness + part->from);
        return;
    }
    for (size_t k = contacts.from; k < contacts.to; k++)
        stiffness[k] =
            law->stiffness(s->table.stiffness[k], s->table.law, s->table.static_compression[k] + (n->u[k] - n->u[k + 1]));
}

/* Forces, accelerations and stiffnesses at the displacements. */
static void evaluate(struct bead_adjoint_nodes *n, size_t node, const struct bead_part *part)
{
    const struct bead_stepper *s = n->stepper;
    const size_t at = part->from;
    double *force = n->force[node], *stiffness = n->stiffness[node], *acceleration = n->acceleration[node];
    if (s->fused) {
        struct bead_contact_table table = s->table;
        table.stiffness += at;
        s->kernels->hertz_all(part->to - at, &table, n->u + at, n->inverse_mass + at, force + at, stiffness + at,
                              acceleration + at);
        return;
    }
    bead_stepper_evaluate_part(s, n->u, NULL, force, acceleration, *part);
    find_stiffnesses(n, stiffness, part);
}

/* df/dA and df/dF of f = A (d0 + u_k - u_{k+1})^p - F, where A d0^p = F. */
static void find_parts(struct bead_adjoint_nodes *n, size_t node, const struct bead_part *part)
{
    const struct bead_stepper *s = n->stepper;
    const double *still = s->table.static_force;
    const struct bead_part contacts = contacts_of(s, part);
    for (size_t k = contacts.from; k < contacts.to; k++) {
        const double share = still[k] > 0 ? n->stiffness[node][k] / n->static_stiffness[k] : 0;
        n->by_stiffness[node][k] = n->force[node][k] + still[k] * (1 - share);
        n->by_static[node][k] = still[k] > 0 ? share - 1 : 0;
    }
}

void bead_adjoint_nodes_fill(struct bead_adjoint_nodes *n, double from, double back, struct bead_part part)
{
    for (size_t i = 0; i < BEAD_NODES; i++) {
        find_displacements(n, from - (from - back) * n->method->c[i], &part);
        evaluate(n, i, &part);
    }
    smooth_all(n, from, back, &part);
    for (size_t i = 0; n->has_static && i < BEAD_NODES; i++)
        find_parts(n, i, &part);
}

double bead_adjoint_nodes_part(const struct bead_adjoint_nodes *n, double from, double heavy, struct bead_part part)
{
    double back = 0;
    for (size_t i = 0; i < n->points; i++) {
        const double edges[2] = {n->point[i].at - around, n->point[i].at + around};
        for (int e = 0; e < 2 && n->point[i].weight > heavy && within(&part, n->point[i].contact); e++) {
            if (edges[e] > back && edges[e] < from - 0.5 * around)
                back = edges[e];
        }
    }
    return back;
}
