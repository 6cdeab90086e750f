/* Included by kernels_body.h: the part of the contact-event correction that is worth vectors. Element-wise over contacts or
 * over Gauss nodes, sums in a fixed order. */
#include "sim/events_patch.h"

enum { NODES = BEAD_GAUSS_NODES };

/* Which contacts may have a branch point in the step or within `reach` steps outside. Every test compares d with what the rate
 * alone would change it by. What is at rest and just touching, d = d' = 0, passes none of them. */
static bool mark_events(size_t n, const struct bead_event_ends *ends, double reach, unsigned char *mark)
{
    const double *restrict d0 = ends->static_compression, *restrict u = ends->u0, *restrict v = ends->v0;
    const double *restrict y = ends->u1, *restrict w = ends->v1;
    const double h = ends->h, near = reach * h;
    unsigned char *restrict out = mark;
    unsigned any = 0;
    for (size_t k = 0; k < n; k++) {
        double a = d0[k] + (u[k] - u[k + 1]), b = d0[k] + (y[k] - y[k + 1]);
        double p = v[k] - v[k + 1], q = w[k] - w[k + 1];
        unsigned a_closed = a > 0, b_closed = b > 0;
        unsigned at_branch = (a < near * fabs(p)) | (b < near * fabs(q));
        unsigned bounce = (p > 0) & (q < 0) & (a + h * p > 0) & (b - h * q > 0);
        unsigned marked = (a_closed ^ b_closed) | (a_closed & b_closed & at_branch) | (~(a_closed | b_closed) & bounce & 1);
        out[k] = (unsigned char)marked;
        any |= marked;
    }
    return any != 0;
}

static double total(const double *restrict weight, const double *restrict value)
{
    double t[NODES];
    for (size_t i = 0; i < NODES; i++)
        t[i] = weight[i] * value[i];
    return ((t[0] + t[4]) + (t[2] + t[6])) + ((t[1] + t[5]) + (t[3] + t[7]));
}

/* f of compressions d, in place. A contact known to be closed may seem open by an error in tau: no force then. */
static void node_forces(const struct bead_patch_rule *rule, const struct bead_patch_contact *k, double *restrict d)
{
    const double a = k->stiffness, f0 = k->static_force;
    if (!rule->hertz) {
        for (size_t i = 0; i < NODES; i++)
            d[i] = rule->law->force(a, rule->spec, d[i]) - f0;
        return;
    }
    for (size_t i = 0; i < NODES; i++) {
        double x = d[i] > 0 ? d[i] : 0;
        d[i] = a * (x * sqrt(x)) - f0;
    }
}

/* First guess: forces of the quintic. */
static void guess(const struct bead_patch_piece *piece, const struct bead_patch_rule *rule, struct bead_patch_contact *k)
{
    double d[NODES];
    if (!k->closed) {
        for (size_t i = 0; i < NODES; i++)
            k->force[i] = -k->static_force;
        return;
    }
    for (size_t i = 0; i < NODES; i++)
        d[i] = bead_patch_value(k->c, piece->s[i]);
    node_forces(rule, k, d);
    for (size_t i = 0; i < NODES; i++)
        k->force[i] = d[i];
}

/* d'' = h^2 (u_k'' - u_{k+1}'') at the nodes from the forces of the contact and its neighbours. */
static void curvature(const struct bead_patch_contact *k, double *restrict r)
{
    const double both = k->left + k->right;
    for (size_t i = 0; i < NODES; i++)
        r[i] = (k->left * k[-1].force[i] + k->right * k[1].force[i]) - both * k->force[i];
}

/* One Picard step of one contact: d(s) = d + s d' + double integral of d'', and the force of that. */
static void sweep(const struct bead_patch_piece *piece, const struct bead_patch_rule *rule, struct bead_patch_contact *k)
{
    double r[NODES], even[NODES], odd[NODES];
    curvature(k, r);
    for (size_t i = 0; i < NODES; i++) {
        even[i] = k->d + (piece->s[i] - piece->from) * k->rate;
        odd[i] = 0;
    }
    for (size_t j = 0; j < NODES; j += 2) {
        for (size_t i = 0; i < NODES; i++) {
            even[i] += piece->twice[j][i] * r[j];
            odd[i] += piece->twice[j + 1][i] * r[j + 1];
        }
    }
    for (size_t i = 0; i < NODES; i++)
        even[i] += odd[i];
    node_forces(rule, k, even);
    for (size_t i = 0; i < NODES; i++) {
        r[i] = even[i] - k->force[i];
        k->force[i] = even[i];
    }
    k->last = total(piece->weight, r);
}

/* d and d' at the end of the piece, impulses over it. */
static void finish(const struct bead_patch_piece *piece, struct bead_patch_contact *k)
{
    double r[NODES], later[NODES], moment[NODES];
    curvature(k, r);
    for (size_t i = 0; i < NODES; i++) {
        later[i] = piece->weight[i] * (piece->to - piece->s[i]);
        moment[i] = piece->weight[i] * (1 - piece->s[i]);
    }
    k->d = (k->d + (piece->to - piece->from) * k->rate) + total(later, r);
    k->rate += total(piece->weight, r);
    k->impulse += total(piece->weight, k->force);
    k->moment += total(moment, k->force);
    k->change += k->last;
}

static void integrate_patch(const struct bead_patch_piece *piece, const struct bead_patch_rule *rule, size_t sweeps, size_t count,
                            struct bead_patch_contact *contact)
{
    for (size_t k = 0; k <= count + 1; k++) {
        contact[k].last = 0;
        guess(piece, rule, &contact[k]);
    }
    for (size_t i = 0; i < sweeps; i++) {
        for (size_t k = 1; k <= count; k++) {
            if (contact[k].closed)
                sweep(piece, rule, &contact[k]);
        }
    }
    for (size_t k = 1; k <= count; k++)
        finish(piece, &contact[k]);
}
