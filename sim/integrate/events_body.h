/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included by kernels_body.h: the part of the contact-event correction that vectors speed up, in GCC's and Clang's vector types of
 * the set's width. Lanes are contacts or the nodes of a piece; sums have a fixed order, so every set gives the same bits.
 */
#include <string.h>

#include "sim/integrate/events_patch.h"

enum { NODES = BEAD_GAUSS_NODES };

/* Sum over the nodes, in pairs. */
static inline double total(const double x[NODES])
{
    return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}

static inline double larger(double x, double y)
{
    return x > y ? x : y;
}

static inline double largest_lane(lanes x)
{
    double y[NODES] = {0};
    for (size_t i = 0; i < LANES; i++)
        y[i] = x[i];
    return larger(larger(larger(y[0], y[4]), larger(y[2], y[6])), larger(larger(y[1], y[5]), larger(y[3], y[7])));
}

/* s = from + length z: the double integral of g up to z_i is length^2 times that of (z_i - z) g. */
static void place_linear(struct bead_patch_piece *piece)
{
    const double length = piece->to - piece->from, square = length * length;
    for (size_t i = 0; i < NODES; i += LANES) {
        store_lanes(piece->s + i, piece->from + length * load_lanes(bead_gauss_node + i));
        store_lanes(piece->weight + i, length * load_lanes(bead_gauss_weight + i));
        for (size_t j = 0; j < NODES; j++)
            store_lanes(piece->twice[j] + i, square * load_lanes(bead_gauss_twice[j] + i));
    }
}

/* s = tau + sign x^2 with x = a + b z. Between nodes s_i - s = sign (x_i^2 - x^2) and ds = sign 2 b x dz, so the double integral up
 * to node i is that of (x_i^2 - x^2) 2 b x = b^2 (z_i - z) (2 a + b (z_i + z)) 2 (a + b z) = b^2 [4 a^2 (z_i - z) + 2 a b (z_i -
 * z)(z_i + 3 z) + b^2 2 z (z_i^2 - z^2)], three matrices that are known once and for all. */
static void place_square(double tau, struct bead_patch_piece *piece)
{
    const double sign = piece->from + piece->to >= 2 * tau ? 1 : -1, first = sign * (piece->from - tau),
                 last = sign * (piece->to - tau);
    const double a = first > 0 ? sqrt(first) : 0, b = (last > 0 ? sqrt(last) : 0) - a;
    const double square = b * b, twice = square * (4 * (a * a)), mixed = square * (2 * (a * b)), both = square * square;
    for (size_t i = 0; i < NODES; i += LANES) {
        lanes x = a + b * load_lanes(bead_gauss_node + i);
        store_lanes(piece->s + i, tau + sign * (x * x));
        store_lanes(piece->weight + i, sign * (2 * b * x) * load_lanes(bead_gauss_weight + i));
        for (size_t j = 0; j < NODES; j++) {
            lanes sum = twice * load_lanes(bead_gauss_twice[j] + i) + mixed * load_lanes(bead_gauss_twice_mixed[j] + i);
            store_lanes(piece->twice[j] + i, sum + both * load_lanes(bead_gauss_twice_square[j] + i));
        }
    }
}

/* f of compressions d of one contact. One known to be closed may seem open by an error in tau: no force then. */
static inline lanes node_forces(const struct bead_patch_rule *rule, double a, double f0, lanes d)
{
    if (__builtin_expect(rule->hertz, 1)) {
        /* Few at a time: the instruction takes longer but is done sooner. */
        d = positive_part(d);
        return a * (d * ROOT_OF(d)) - f0;
    }
    for (size_t i = 0; i < LANES; i++)
        d[i] = rule->law->force(a, rule->spec, d[i]) - f0;
    return d;
}

/* The closed contacts that a piece is integrated for: a list, because the processor would mispredict every other branch. */
struct pushing {
    const uint32_t *contact;
    size_t count, first, last; /* contact[first..last - 1] are not frozen */
};

static struct pushing list_pushing(const struct bead_patch *patch)
{
    const size_t all = patch->count + 2;
    const bool *closed = patch->closed;
    uint32_t *list = patch->pushing;
    size_t n = 0;
    for (size_t k = 0; k < all; k++) {
        list[n] = (uint32_t)k;
        n += closed[k];
    }
    return (struct pushing){list, n, closed[0], n - closed[all - 1]};
}

/* First guess: forces of the quintics. */
static void guess_forces(const struct bead_patch_piece *piece, const struct bead_patch_rule *rule, const struct bead_patch *patch,
                         const struct pushing *pushing)
{
    const size_t all = patch->count + 2;
    const double *stiffness = patch->array[BEAD_PATCH_STIFFNESS], *static_force = patch->array[BEAD_PATCH_STATIC_FORCE];
    double *const *array = patch->array + BEAD_PATCH_C, *force = patch->force;
    const double *p0 = array[0], *p1 = array[1], *p2 = array[2], *p3 = array[3], *p4 = array[4], *p5 = array[5];
    for (size_t k = 0; k < all; k++) {
        const lanes open = (lanes){0} - static_force[k];
        for (size_t i = 0; i < NODES; i += LANES)
            store_lanes(force + NODES * k + i, open);
    }
    for (size_t n = 0; n < pushing->count; n++) {
        const size_t k = pushing->contact[n];
        const double c0 = p0[k], c1 = p1[k], c2 = p2[k], c3 = p3[k], c4 = p4[k], c5 = p5[k], a = stiffness[k], f0 = static_force[k];
        for (size_t i = 0; i < NODES; i += LANES) {
            lanes s = load_lanes(piece->s + i);
            store_lanes(force + NODES * k + i, node_forces(rule, a, f0, c0 + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5))))));
        }
    }
}

/* d'' = h^2 (u_k'' - u_{k+1}'') at the nodes from the forces of the contact and its neighbours. */
static void find_curvatures(const struct bead_patch *patch, const struct pushing *pushing)
{
    const double *left = patch->array[BEAD_PATCH_LEFT], *right = patch->array[BEAD_PATCH_RIGHT];
    double *force = patch->force, *curvature = patch->curvature;
    for (size_t n = pushing->first; n < pushing->last; n++) {
        const size_t k = pushing->contact[n];
        const double w = left[k], y = right[k];
        for (size_t i = NODES * k; i < NODES * (k + 1); i += LANES) {
            lanes neighbours = w * load_lanes(force + i - NODES) + y * load_lanes(force + i + NODES);
            store_lanes(curvature + i, neighbours - (w + y) * load_lanes(force + i));
        }
    }
}

/* One Picard step: d(s) = d + s d' + double integral of d'', and the force of that. Returns the largest change of h^2 f/m. */
static double picard(const struct bead_patch_piece *piece, const struct bead_patch_rule *rule, const struct bead_patch *patch,
                     const struct pushing *pushing)
{
    double *const *array = patch->array, *force = patch->force;
    const double *stiffness = array[BEAD_PATCH_STIFFNESS], *static_force = array[BEAD_PATCH_STATIC_FORCE];
    const double *left = array[BEAD_PATCH_LEFT], *right = array[BEAD_PATCH_RIGHT], *curvature = patch->curvature;
    const double *compression = array[BEAD_PATCH_D], *compression_rate = array[BEAD_PATCH_RATE], from = piece->from;
    lanes change = {0};
    find_curvatures(patch, pushing);
    for (size_t n = pushing->first; n < pushing->last; n++) {
        const size_t k = pushing->contact[n];
        const double *r = curvature + NODES * k, a = stiffness[k], f0 = static_force[k], weight = larger(left[k], right[k]);
        const double d = compression[k], rate = compression_rate[k];
        for (size_t i = 0; i < NODES; i += LANES) {
            double *f = force + NODES * k + i;
            lanes even = d + (load_lanes(piece->s + i) - from) * rate, odd = load_lanes(piece->twice[1] + i) * r[1];
            even += load_lanes(piece->twice[0] + i) * r[0];
            for (size_t j = 2; j < NODES; j += 2) {
                even += load_lanes(piece->twice[j] + i) * r[j];
                odd += load_lanes(piece->twice[j + 1] + i) * r[j + 1];
            }
            lanes now = node_forces(rule, a, f0, even + odd), moved = weight * magnitude(now - load_lanes(f));
            change = larger_lanes(moved, change);
            store_lanes(f, now);
        }
    }
    return largest_lane(change);
}

/* Impulses: integrals over the piece of f and (to - s) f, two numbers a contact. */
static void find_impulses(const struct bead_patch_piece *piece, const struct bead_patch *patch, const struct pushing *pushing,
                          double *sum)
{
    const size_t all = patch->count + 2;
    const double *static_force = patch->array[BEAD_PATCH_STATIC_FORCE], *force = patch->force, length = piece->to - piece->from;
    for (size_t k = 0; k < all; k++) {
        sum[2 * k] = -static_force[k] * length;
        sum[2 * k + 1] = sum[2 * k] * (0.5 * length);
    }
    for (size_t n = 0; n < pushing->count; n++) {
        const size_t k = pushing->contact[n];
        double now[NODES], later[NODES];
        for (size_t i = 0; i < NODES; i += LANES) {
            lanes f = load_lanes(piece->weight + i) * load_lanes(force + NODES * k + i);
            store_lanes(now + i, f);
            store_lanes(later + i, (piece->to - load_lanes(piece->s + i)) * f);
        }
        sum[2 * k] = total(now);
        sum[2 * k + 1] = total(later);
    }
}

/* The impulses so far, and d and d' at the end of the piece. */
static void finish_piece(const struct bead_patch_piece *piece, const struct bead_patch *patch, const struct pushing *pushing)
{
    const size_t count = patch->count;
    const double *left = patch->array[BEAD_PATCH_LEFT], *right = patch->array[BEAD_PATCH_RIGHT];
    const double length = piece->to - piece->from, after = 1 - piece->to;
    double *impulse = patch->array[BEAD_PATCH_IMPULSE], *moment = patch->array[BEAD_PATCH_MOMENT];
    double *d = patch->array[BEAD_PATCH_D], *rate = patch->array[BEAD_PATCH_RATE], *sum = patch->curvature;
    find_impulses(piece, patch, pushing, sum);
    for (size_t k = 1; k <= count; k++) {
        const double *i = sum + 2 * k, w = left[k], y = right[k];
        impulse[k] += i[0];
        moment[k] += i[1] + after * i[0];
        d[k] += length * rate[k] + ((w * i[-1] + y * i[3]) - (w + y) * i[1]);
        rate[k] += (w * i[-2] + y * i[2]) - (w + y) * i[0];
    }
}

/* Picard steps, `sweeps` at most, until one changes little enough, see bead_patch. */
static void integrate_piece(double from, double to, const double *tau, const struct bead_patch_rule *rule, size_t sweeps,
                            struct bead_patch *patch)
{
    struct bead_patch_piece piece;
    double most = 0;
    piece.from = from;
    piece.to = to;
    if (!tau)
        place_linear(&piece);
    else if (rule->power == 2)
        place_square(*tau, &piece);
    else
        bead_patch_place_power(rule->power, *tau, &piece);
    const struct pushing pushing = list_pushing(patch);
    guess_forces(&piece, rule, patch, &pushing);
    for (size_t n = 0; n < sweeps && (n == 0 || most > (n == 1 ? patch->enough : patch->much)); n++)
        most = picard(&piece, rule, patch, &pushing);
    finish_piece(&piece, patch, &pushing);
    patch->change = larger(most, patch->change);
}
