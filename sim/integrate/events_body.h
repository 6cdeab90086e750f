/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included by kernels_body.h: integrates the pieces of patches, in GCC's and Clang's vector types of the set's width. Lanes are the
 * nodes of a piece; sums have a fixed order, so every set gives the same bits. */

#include "sim/integrate/events_patch.h"

enum { NODES = BEAD_GAUSS_NODES };

/* Pairwise sum over the nodes. */
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

/* The nodes of a piece, and ds/dz there. */
struct nodes {
    double s[NODES], rate[NODES];
};

static inline void place_nodes(const struct bead_patch_piece *piece, struct nodes *nodes)
{
    for (size_t i = 0; i < NODES; i += LANES) {
        const lanes x = piece->a + piece->b * load_lanes(bead_gauss_node + i);
        lanes less = (lanes){0} + 1;
        for (int m = 1; m < piece->power; m++)
            less *= x;
        store_lanes(nodes->s + i, piece->tau + piece->sign * (x * less));
        store_lanes(nodes->rate + i, piece->sign * (piece->power * piece->b * less));
    }
}

/* f at compressions d of one contact. d < 0 in a closed contact is an error of tau: no force. */
static inline lanes node_forces(const struct bead_patch_rule *rule, double a, double f0, lanes d)
{
    if (__builtin_expect(rule->hertz, 1)) {
        /* the instruction has less throughput than root_of, but also less latency */
        d = positive_part(d);
        return a * (d * ROOT_OF(d)) - f0;
    }
    for (size_t i = 0; i < LANES; i++)
        d[i] = rule->law->force(a, rule->spec, d[i]) - f0;
    return d;
}

/* The closed contacts of a piece: a list, because the processor would mispredict every other branch. */
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

/* Initial forces: those of the quintics. */
static void guess_forces(const struct nodes *nodes, const struct bead_patch_rule *rule, const struct bead_patch *patch,
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
            lanes s = load_lanes(nodes->s + i);
            store_lanes(force + NODES * k + i, node_forces(rule, a, f0, c0 + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5))))));
        }
    }
}

/* Adds to d'' the pull that holds beads in place: a cubic in s. */
static void pull_curvatures(const struct nodes *nodes, const struct bead_patch *patch, const struct pushing *pushing)
{
    double *const *p = patch->array + BEAD_PATCH_PULL;
    for (size_t n = pushing->first; n < pushing->last; n++) {
        const size_t k = pushing->contact[n];
        for (size_t i = 0; i < NODES; i += LANES) {
            const lanes s = load_lanes(nodes->s + i), pull = p[0][k] + s * (p[1][k] + s * (p[2][k] + s * p[3][k]));
            double *curvature = patch->curvature + NODES * k + i;
            store_lanes(curvature, load_lanes(curvature) + load_lanes(nodes->rate + i) * pull);
        }
    }
}

/* Adds to d and d' at the end of the piece the double and the single integral of these cubics. */
static void pull_ends(const struct bead_patch_piece *piece, const struct bead_patch *patch)
{
    double *const *p = patch->array + BEAD_PATCH_PULL, *d = patch->array[BEAD_PATCH_D], *rate = patch->array[BEAD_PATCH_RATE];
    const double from = piece->from, l = piece->to - from;
    for (size_t k = 1; k <= patch->count; k++) {
        /* the cubic about `from` */
        const double c3 = p[3][k], c2 = p[2][k] + 3 * from * c3, c1 = p[1][k] + from * (2 * p[2][k] + 3 * from * c3);
        const double c0 = p[0][k] + from * (p[1][k] + from * (p[2][k] + from * c3));
        d[k] += l * l * (c0 / 2 + l * (c1 / 6 + l * (c2 / 12 + l * c3 / 20)));
        rate[k] += l * (c0 + l * (c1 / 2 + l * (c2 / 3 + l * c3 / 4)));
    }
}

/* Adds to d'' the effect of a drive on a bead between two contacts. */
static void drive_curvatures(const struct nodes *nodes, const struct bead_patch *patch)
{
    for (ptrdiff_t k = patch->driven - 1; k <= patch->driven; k++) {
        if (k < 1 || (size_t)k > patch->count || !patch->closed[k])
            continue;
        const double sign = k == patch->driven ? 1 : -1;
        for (size_t i = 0; i < NODES; i += LANES) {
            double *curvature = patch->curvature + NODES * k + i;
            store_lanes(curvature, load_lanes(curvature) + sign * (load_lanes(nodes->rate + i) * load_lanes(patch->drive + i)));
        }
    }
}

/* Adds to d and d' at the end of the piece the double and the single integral of the drive. */
static void drive_ends(const struct bead_patch_piece *piece, const struct nodes *nodes, const struct bead_patch *patch)
{
    double now[NODES], later[NODES];
    for (size_t i = 0; i < NODES; i += LANES) {
        const lanes a = load_lanes(bead_gauss_weight + i) * load_lanes(nodes->rate + i) * load_lanes(patch->drive + i);
        store_lanes(now + i, a);
        store_lanes(later + i, (piece->to - load_lanes(nodes->s + i)) * a);
    }
    for (ptrdiff_t k = patch->driven - 1; k <= patch->driven; k++) {
        if (k < 1 || (size_t)k > patch->count)
            continue;
        const double sign = k == patch->driven ? 1 : -1;
        patch->array[BEAD_PATCH_D][k] += sign * total(later);
        patch->array[BEAD_PATCH_RATE][k] += sign * total(now);
    }
}

/* d'' = h^2 (u_k'' - u_{k+1}'') ds/dz at the nodes from the forces of the contact and its neighbours. */
static void find_curvatures(const struct nodes *nodes, const struct bead_patch *patch, const struct pushing *pushing)
{
    const double *left = patch->array[BEAD_PATCH_LEFT], *right = patch->array[BEAD_PATCH_RIGHT];
    double *force = patch->force, *curvature = patch->curvature;
    for (size_t n = pushing->first; n < pushing->last; n++) {
        const size_t k = pushing->contact[n];
        const double w = left[k], y = right[k];
        for (size_t i = 0; i < NODES; i += LANES) {
            const double *f = force + NODES * k + i;
            lanes neighbours = w * load_lanes(f - NODES) + y * load_lanes(f + NODES);
            store_lanes(curvature + NODES * k + i, load_lanes(nodes->rate + i) * (neighbours - (w + y) * load_lanes(f)));
        }
    }
}

/* Integrals of x from the start of the piece to its nodes, times `rate`: the integrand of the next integral. */
static inline void integrate_nodes(const double x[NODES], const lanes rate[NODES / LANES], double sum[NODES])
{
    for (size_t i = 0; i < NODES; i += LANES) {
        lanes even = load_lanes(bead_gauss_once[0] + i) * x[0], odd = load_lanes(bead_gauss_once[1] + i) * x[1];
        for (size_t j = 2; j < NODES; j += 2) {
            even += load_lanes(bead_gauss_once[j] + i) * x[j];
            odd += load_lanes(bead_gauss_once[j + 1] + i) * x[j + 1];
        }
        store_lanes(sum + i, rate[i / LANES] * (even + odd));
    }
}

/* One Picard step: d(s) = d + s d' + double integral of d'', and its force. Returns the largest change of h^2 f/m. */
static double picard(const struct nodes *nodes, double from, const struct bead_patch_rule *rule, const struct bead_patch *patch,
                     const struct pushing *pushing)
{
    double *const *array = patch->array, *force = patch->force;
    const double *stiffness = array[BEAD_PATCH_STIFFNESS], *static_force = array[BEAD_PATCH_STATIC_FORCE];
    const double *left = array[BEAD_PATCH_LEFT], *right = array[BEAD_PATCH_RIGHT];
    const double *compression = array[BEAD_PATCH_D], *compression_rate = array[BEAD_PATCH_RATE];
    lanes change = {0}, ds[NODES / LANES], one[NODES / LANES];
    for (size_t i = 0; i < NODES / LANES; i++) {
        ds[i] = load_lanes(nodes->rate + LANES * i);
        one[i] = (lanes){0} + 1;
    }
    find_curvatures(nodes, patch, pushing);
    if (patch->pulled)
        pull_curvatures(nodes, patch, pushing);
    if (bead_patch_drives(patch))
        drive_curvatures(nodes, patch);
    for (size_t n = pushing->first; n < pushing->last; n++) {
        const size_t k = pushing->contact[n];
        const double a = stiffness[k], f0 = static_force[k], weight = larger(left[k], right[k]);
        const double d = compression[k], rate = compression_rate[k];
        double once[NODES], twice[NODES];
        integrate_nodes(patch->curvature + NODES * k, ds, once);
        integrate_nodes(once, one, twice);
        for (size_t i = 0; i < NODES; i += LANES) {
            double *f = force + NODES * k + i;
            lanes now = node_forces(rule, a, f0, d + (load_lanes(nodes->s + i) - from) * rate + load_lanes(twice + i));
            change = larger_lanes(weight * magnitude(now - load_lanes(f)), change);
            store_lanes(f, now);
        }
    }
    return largest_lane(change);
}

/* Impulses: integrals of f and (to - s) f over the piece, two numbers for each contact. */
static void find_impulses(const struct bead_patch_piece *piece, const struct nodes *nodes, const struct bead_patch *patch,
                          const struct pushing *pushing, double *sum)
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
            lanes f = load_lanes(bead_gauss_weight + i) * load_lanes(nodes->rate + i) * load_lanes(force + NODES * k + i);
            store_lanes(now + i, f);
            store_lanes(later + i, (piece->to - load_lanes(nodes->s + i)) * f);
        }
        sum[2 * k] = total(now);
        sum[2 * k + 1] = total(later);
    }
}

/* Adds the impulses, and finds d and d' at the end of the piece. */
static void finish_piece(const struct bead_patch_piece *piece, const struct nodes *nodes, const struct bead_patch *patch,
                         const struct pushing *pushing)
{
    const size_t count = patch->count;
    const double *left = patch->array[BEAD_PATCH_LEFT], *right = patch->array[BEAD_PATCH_RIGHT];
    const double length = piece->to - piece->from, after = 1 - piece->to;
    double *impulse = patch->array[BEAD_PATCH_IMPULSE], *moment = patch->array[BEAD_PATCH_MOMENT];
    double *d = patch->array[BEAD_PATCH_D], *rate = patch->array[BEAD_PATCH_RATE], *sum = patch->curvature;
    find_impulses(piece, nodes, patch, pushing, sum);
    for (size_t k = 1; k <= count; k++) {
        const double *i = sum + 2 * k, w = left[k], y = right[k];
        impulse[k] += i[0];
        moment[k] += i[1] + after * i[0];
        d[k] += length * rate[k] + ((w * i[-1] + y * i[3]) - (w + y) * i[1]);
        rate[k] += (w * i[-2] + y * i[2]) - (w + y) * i[0];
    }
    if (patch->pulled)
        pull_ends(piece, patch);
    if (bead_patch_drives(patch))
        drive_ends(piece, nodes, patch);
}

/* Makes at most `sweeps` Picard steps, until one changes little enough: see bead_patch. */
static void integrate_piece(const struct bead_patch_piece *piece, const struct bead_patch_rule *rule, size_t sweeps,
                            struct bead_patch *patch)
{
    const struct pushing pushing = list_pushing(patch);
    struct nodes nodes;
    double most = 0;
    place_nodes(piece, &nodes);
    guess_forces(&nodes, rule, patch, &pushing);
    for (size_t n = 0; n < sweeps && (n == 0 || most > (n == 1 ? patch->enough : patch->much)); n++)
        most = picard(&nodes, piece->from, rule, patch, &pushing);
    finish_piece(piece, &nodes, patch, &pushing);
    patch->change = larger(most, patch->change);
}
