/* Finds what adjoints need of a chain at the nodes of a step: see adjoint_nodes.h. */
#include "sim/adjoint/adjoint_nodes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/wide.h"

/* Branch points this far outside of a step are looked for, in steps. */
static const double reach = 0.3;
/* Contacts whose stiffness at a step's length from opening moves their beads by less, as h^2 K/m, have no branch points to speak
 * of: those that the wave just reaches. */
static const double least_stiffness = 1e-7;
/* What is left of the error goes with the square of the contact's weight. Of a heavy one this part of the step on either side of a
 * branch point is gone back over for itself. */
static const double around = 0.05;
/* Of the polynomials that take a stiffness's place. Their product with what they move is to be within the order of the method:
 * with higher degrees, as with lower ones, errors are larger. */
enum { DEGREE = 3 };
enum { FIRST_BRANCHES = 64 };

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
    n->branch = calloc(FIRST_BRANCHES, sizeof *n->branch);
    n->branch_room = FIRST_BRANCHES;
    if (!err && (!n->memory || !n->branch))
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the sensitivities of %zu beads", chain->beads);
    if (err)
        return err;
    lay_out(n, chain);
    if (chain->law->one_sided)
        n->rule = bead_patch_rule_make(chain->law, &chain->spec->law);
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
    free(n->branch);
}

/* ---- contacts that open or close ---- */

/* Double integral of the force of a branch point's contact over time counted in steps, and its derivatives, at x. */
static void kink(const struct bead_branch_point *b, const struct bead_patch_rule *rule, double x, double out[4])
{
    const double y = b->side * (x - b->at), p = rule->exponent, s = b->side, g = b->next * y;
    memset(out, 0, 4 * sizeof *out);
    if (!(y > 0))
        return;
    const double power = b->strength * (rule->hertz ? sqrt(y) : bead_pow(y, p - 1));
    out[0] = power * y * y * y * (1 + g);
    out[1] = s * power * y * y * (p + 2 + (p + 3) * g);
    out[2] = power * y * (p + 2) * (p + 1 + (p + 3) * g);
    out[3] = s * power * (p + 2) * (p + 1) * (p + (p + 3) * g);
}

/* What interpolation leaves out of that, and its derivative by x. */
static void left_out(const struct bead_branch_point *b, const struct bead_patch_rule *rule, double x, double out[2])
{
    double whole[4];
    kink(b, rule, x, whole);
    out[0] = whole[0] - bead_polynomial_value(&b->taken, x);
    out[1] = whole[1] - bead_polynomial_slope(&b->taken, x);
}

static enum bead_error add_branch(struct bead_adjoint_nodes *n, const struct bead_branch_point *b, struct bead_message *msg)
{
    if (n->branches == n->branch_room) {
        struct bead_branch_point *grown = realloc(n->branch, 2 * n->branch_room * sizeof *grown);
        if (!grown)
            return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the contacts that open or close");
        n->branch = grown;
        n->branch_room *= 2;
    }
    n->branch[n->branches++] = *b;
    return BEAD_OK;
}

/* The leading terms of the motion next to a branch point: d = rate y + bend y^2/2, f = A (rate y)^p (1 + p/2 bend/rate y). */
static void find_kink(const struct bead_adjoint_nodes *n, const double c[6], struct bead_branch_point *b)
{
    const struct bead_stepper *s = n->stepper;
    const double x = b->at, p = n->rule.exponent;
    const double rate = b->side * (c[1] + x * (2 * c[2] + x * (3 * c[3] + x * (4 * c[4] + x * 5 * c[5]))));
    b->weight = s->h * s->h * fmax(n->inverse_mass[b->contact], n->inverse_mass[b->contact + 1]) *
                s->chain->law->stiffness(s->table.stiffness[b->contact], s->table.law, fabs(rate));
    if (b->side == 0 || !(rate > 0))
        return;
    const double bend = 2 * c[2] + x * (6 * c[3] + x * (12 * c[4] + x * 20 * c[5])), ratio = bend / rate;
    double at0[4], at1[4];
    b->next = fabs(ratio) <= 1 ? 0.5 * p * ratio * (p + 1) / (p + 3) : 0; /* else it bends too soon for two terms */
    b->strength = s->h * s->h * s->chain->law->force(s->table.stiffness[b->contact], s->table.law, rate) / ((p + 1) * (p + 2));
    kink(b, &n->rule, 0, at0);
    kink(b, &n->rule, 1, at1);
    b->taken = bead_polynomial_hermite(at0, at1);
}

/* Compression and rate, counted in steps, of a contact in a state, and its rate of rate. */
static void quintic_end(const struct bead_stepper *s, const struct bead_state *state, size_t k, double out[3])
{
    out[0] = s->table.static_compression[k] + (state->u[k] - state->u[k + 1]);
    out[1] = s->h * (state->v[k] - state->v[k + 1]);
    out[2] = s->h * s->h * (state->a[k] - state->a[k + 1]);
}

/* Whether a contact may have a branch point in the step, or close to it. */
static bool may_branch(const struct bead_adjoint_nodes *n, size_t k)
{
    const struct bead_stepper *s = n->stepper;
    const double d0 = s->table.static_compression[k] + (s->start.u[k] - s->start.u[k + 1]);
    const double d1 = s->table.static_compression[k] + (s->end.u[k] - s->end.u[k + 1]);
    const double r0 = s->h * (s->start.v[k] - s->start.v[k + 1]), r1 = s->h * (s->end.v[k] - s->end.v[k + 1]);
    const double fast = fmax(fabs(r0), fabs(r1));
    if (d0 > 0 && d1 > 0 && fmin(d0, d1) > reach * fast)
        return false;
    if (d0 <= 0 && d1 <= 0 && !(r0 > 0 && r1 < 0))
        return false;
    const double w = fmax(n->inverse_mass[k], n->inverse_mass[k + 1]), a = s->table.stiffness[k];
    return s->h * s->h * w * s->chain->law->stiffness(a, s->table.law, fast) > least_stiffness;
}

static enum bead_error find_branches(struct bead_adjoint_nodes *n, size_t k, struct bead_message *msg)
{
    const struct bead_stepper *s = n->stepper;
    struct bead_patch_branch found[BEAD_BRANCHES_MAX];
    double a[3], b[3];
    quintic_end(s, &s->start, k, a);
    quintic_end(s, &s->end, k, b);
    const double c0 = a[0], c1 = a[1], c2 = a[2] / 2, r0 = b[0] - (c0 + c1 + c2), r1 = b[1] - (c1 + 2 * c2), r2 = b[2] - 2 * c2;
    const double c[6] = {c0, c1, c2, 10 * r0 - 4 * r1 + 0.5 * r2, -15 * r0 + 7 * r1 - r2, 6 * r0 - 3 * r1 + 0.5 * r2};
    const size_t count = bead_patch_branches(c, b, reach, found);
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < count; i++) {
        struct bead_branch_point point = {.contact = k, .at = found[i].s, .side = (double)found[i].after - (double)found[i].before};
        find_kink(n, c, &point);
        err = add_branch(n, &point, msg);
    }
    return err;
}

/* Contacts of a part of the beads, those that may have a stiffness. */
static struct bead_part contacts_of(const struct bead_stepper *s, const struct bead_part *part)
{
    const size_t last = s->active < s->chain->contacts ? s->active : s->chain->contacts;
    return (struct bead_part){part->from, part->to < last ? part->to : last};
}

enum bead_error bead_adjoint_nodes_load(struct bead_adjoint_nodes *n, size_t step, struct bead_part part, struct bead_message *msg)
{
    bead_record_load(n->record, step, n->stepper);
    const struct bead_part contacts = contacts_of(n->stepper, &part);
    enum bead_error err = BEAD_OK;
    n->branches = 0;
    for (size_t k = contacts.from; !err && n->stepper->chain->law->one_sided && k < contacts.to; k++) {
        if (may_branch(n, k))
            err = find_branches(n, k, msg);
    }
    return err;
}

struct bead_adjoint_curve bead_adjoint_curve(const struct bead_adjoint_nodes *n, size_t contact)
{
    struct bead_adjoint_curve curve = {.contact = contact, .compression = bead_dense_compression(n->stepper, contact)};
    while (curve.first < n->branches && n->branch[curve.first].contact + 1 < contact)
        curve.first++;
    for (curve.last = curve.first; curve.last < n->branches && n->branch[curve.last].contact <= contact + 1;)
        curve.last++;
    return curve;
}

void bead_adjoint_compression(const struct bead_adjoint_nodes *n, const struct bead_adjoint_curve *curve, double x, double d[2])
{
    const double *w = n->inverse_mass + curve->contact;
    d[0] = bead_polynomial_value(&curve->compression, x);
    d[1] = bead_polynomial_slope(&curve->compression, x);
    for (size_t i = curve->first; i < curve->last; i++) {
        const struct bead_branch_point *b = &n->branch[i];
        const double factor = b->contact < curve->contact ? w[0] : b->contact > curve->contact ? w[1] : -(w[0] + w[1]);
        double rest[2];
        left_out(b, &n->rule, x, rest);
        d[0] += factor * rest[0];
        d[1] += factor * rest[1];
    }
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

/* Moments of the stiffness [0] and the force [1] of a contact over a part of the step next to a branch point at tau. */
struct moments {
    struct bead_adjoint_curve curve;
    double low, length; /* over low <= x <= low + length */
    double sum[2][DEGREE + 1];
};

/* Nodes where x = tau +- z^m. */
static void integrate(const struct bead_adjoint_nodes *n, struct moments *m, double from, double to, double tau)
{
    const struct bead_stepper *s = n->stepper;
    const double a = s->table.stiffness[m->curve.contact];
    struct bead_patch_nodes nodes;
    bead_patch_place_nodes(n->rule.power, tau, (const double[2]){from, to}, &nodes);
    for (size_t i = 0; i < BEAD_GAUSS_NODES; i++) {
        double d[2], p[DEGREE + 1];
        bead_adjoint_compression(n, &m->curve, nodes.s[i], d);
        legendre((nodes.s[i] - m->low) / m->length, p);
        const double weight = bead_gauss_weight[i] * nodes.rate[i] / m->length,
                     stiffness = s->chain->law->stiffness(a, s->table.law, d[0]);
        const double force = s->chain->law->force(a, s->table.law, d[0]);
        for (int q = 0; q <= DEGREE; q++) {
            m->sum[0][q] += weight * stiffness * p[q];
            m->sum[1][q] += weight * force * p[q];
        }
    }
}

/* From one branch point to the next, or the end of the step. Between two of them each half has its own. */
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

/* Nodes of the contact of branch points first..last - 1, which ascend, from the moments. */
static void smooth_contact(struct bead_adjoint_nodes *n, double from, double back, size_t first, size_t last)
{
    const size_t k = n->branch[first].contact;
    struct moments m = {.curve = bead_adjoint_curve(n, k), .low = back, .length = from - back};
    double at = back, before = -INFINITY;
    for (size_t i = first; i < last; i++) {
        const double tau = n->branch[i].at, to = fmin(fmax(tau, at), from);
        integrate_between(n, &m, at, to, before, tau);
        before = tau;
        at = to;
    }
    integrate_between(n, &m, at, from, before, INFINITY);
    for (size_t i = 0; i < BEAD_NODES; i++) {
        double p[DEGREE + 1], stiffness = 0, force = 0;
        legendre(1 - n->method->c[i], p);
        for (int q = 0; q <= DEGREE; q++) {
            stiffness += (2 * q + 1) * m.sum[0][q] * p[q];
            force += (2 * q + 1) * m.sum[1][q] * p[q];
        }
        n->stiffness[i][k] = stiffness;
        n->force[i][k] = force - n->stepper->table.static_force[k];
    }
}

static bool within(const struct bead_part *part, size_t contact)
{
    return contact + 1 >= part->from && contact < part->to;
}

static void smooth_all(struct bead_adjoint_nodes *n, double from, double back, const struct bead_part *part)
{
    for (size_t first = 0, last; first < n->branches; first = last) {
        for (last = first + 1; last < n->branches && n->branch[last].contact == n->branch[first].contact;)
            last++;
        if (within(part, n->branch[first].contact))
            smooth_contact(n, from, back, first, last);
    }
    /* Of all beads beside them. */
    for (size_t b = 0; b < n->branches; b++) {
        for (size_t j = n->branch[b].contact; j <= n->branch[b].contact + 1 && j < n->stepper->beads; j++) {
            for (size_t i = 0; within(part, n->branch[b].contact) && i < BEAD_NODES; i++)
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
    if (moving.to == s->active)
        memset(n->u + s->active, 0, (s->span + 8 - s->active) * sizeof *n->u);
    for (size_t i = 0; i < n->branches; i++) {
        const struct bead_branch_point *b = &n->branch[i];
        double rest[2];
        if (!within(part, b->contact))
            continue;
        left_out(b, &n->rule, x, rest);
        n->u[b->contact] -= n->inverse_mass[b->contact] * rest[0];
        if (b->contact + 1 < s->beads)
            n->u[b->contact + 1] += n->inverse_mass[b->contact + 1] * rest[0];
    }
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
        if (n->method->bp[i] != 0) /* else nobody asks for its forces */
            bead_stepper_evaluate_part(n->stepper, n->u, NULL, n->force[i], n->acceleration[i], part);
        find_stiffnesses(n, n->stiffness[i], &part);
    }
    smooth_all(n, from, back, &part);
    for (size_t i = 0; n->has_static && i < BEAD_NODES; i++)
        find_parts(n, i, &part);
}

double bead_adjoint_nodes_part(const struct bead_adjoint_nodes *n, double from, double heavy, struct bead_part part)
{
    double back = 0;
    for (size_t i = 0; i < n->branches; i++) {
        const double edges[2] = {n->branch[i].at - around, n->branch[i].at + around};
        for (int e = 0; e < 2 && n->branch[i].weight > heavy && within(&part, n->branch[i].contact); e++) {
            if (edges[e] > back && edges[e] < from - 0.5 * around)
                back = edges[e];
        }
    }
    return back;
}
