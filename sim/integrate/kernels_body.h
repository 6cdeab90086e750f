/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included by kernels_<set>.c, which defines KERNELS_NAME, KERNELS_DESCRIPTION and KERNELS_TABLE.
 * Plain C that the compiler vectorises for the set. */
#include <math.h>

#include "sim/integrate/kernels.h"
#include "sim/integrate/kernels_vector.h"

static inline double hertz_alone(double stiffness, double d)
{
    d = d > 0 ? d : 0;
    return stiffness * (d * sqrt(d));
}

/* The start of a vector; the last one overlaps with the one before. */
static inline size_t vector_at(size_t k, size_t n)
{
    return k + LANES <= n ? k : n - LANES;
}

static void hertz(size_t n, const struct bead_contact_table *table, const double *u, const double *, double *f)
{
    const double *a = table->stiffness, *d0 = table->static_compression, *f0 = table->static_force;
    for (size_t k = 0; n < LANES && k < n; k++)
        f[k] = hertz_alone(a[k], d0[k] + (u[k] - u[k + 1])) - f0[k];
    for (size_t i = 0; n >= LANES && i < n; i += LANES) {
        const size_t k = vector_at(i, n);
        lanes d = load_lanes(d0 + k) + (load_lanes(u + k) - load_lanes(u + k + 1));
        store_lanes(f + k, hertz_of(load_lanes(a + k), d) - load_lanes(f0 + k));
    }
}

/* Forces of a vector of contacts, their stiffnesses (NULL: not wanted) and the accelerations of the beads before them; returns the
 * forces. `before`: the forces of the vector before. */
static inline __attribute__((always_inline)) lanes move(const double *a, const double *w, const double *u, double *f,
                                                        double *stiffness, double *out, size_t k, lanes before, bool instruction)
{
    const lanes d = positive_part(load_lanes(u + k) - load_lanes(u + k + 1)), root = instruction ? ROOT_OF(d) : root_of(d);
    const lanes now = load_lanes(a + k) * (d * root);
    store_lanes(f + k, now);
    if (stiffness)
        store_lanes(stiffness + k, 1.5 * load_lanes(a + k) * root);
    store_lanes(out + k, (follow_lanes(before, now) - now) * load_lanes(w + k));
    return now;
}

/* One root in ROOTS is computed by the slow instruction, in parallel with the others. */
static void hertz_move(size_t n, const struct bead_contact_table *table, const double *u, const double *w, double *f, double *out)
{
    const double *a = table->stiffness;
    size_t k = 0;
    lanes now = {0};
    now[LANES - 1] = f[-1];
    for (; k + ROOTS * LANES <= n; k += ROOTS * LANES) {
        now = move(a, w, u, f, NULL, out, k, now, true);
        for (size_t i = 1; i < ROOTS; i++)
            now = move(a, w, u, f, NULL, out, k + i * LANES, now, false);
    }
    for (; k < n; k += LANES)
        now = move(a, w, u, f, NULL, out, k, now, true);
}

static void hertz_all(size_t n, const struct bead_contact_table *table, const double *u, const double *w, double *f,
                      double *stiffness, double *out)
{
    lanes now = {0};
    now[LANES - 1] = f[-1];
    for (size_t k = 0; k < n; k += LANES)
        now = move(table->stiffness, w, u, f, stiffness, out, k, now, false);
}

static inline lanes expected_stiffness(const struct bead_contact_table *table, const double *u, const double *v, double ahead,
                                       size_t k)
{
    lanes d = load_lanes(table->static_compression + k) + (load_lanes(u + k) - load_lanes(u + k + 1));
    d += ahead * positive_part(load_lanes(v + k) - load_lanes(v + k + 1));
    return 1.5 * load_lanes(table->stiffness + k) * root_of(positive_part(d));
}

static void hertz_stiffness(size_t n, const struct bead_contact_table *table, const double *u, const double *v, double ahead,
                            double *stiffness)
{
    for (size_t k = 0; n < LANES && k < n; k++) {
        double rate = v[k] - v[k + 1], d = table->static_compression[k] + (u[k] - u[k + 1]) + ahead * (rate > 0 ? rate : 0);
        stiffness[k] = 1.5 * table->stiffness[k] * sqrt(d > 0 ? d : 0);
    }
    for (size_t i = 0; n >= LANES && i < n; i += LANES) {
        const size_t k = vector_at(i, n);
        store_lanes(stiffness + k, expected_stiffness(table, u, v, ahead, k));
    }
}

/* The largest element of a vector, or 0. */
static inline double largest_of(lanes x)
{
    double most = 0;
    for (size_t i = 0; i < LANES; i++)
        most = x[i] > most ? x[i] : most;
    return most;
}

static double circles(size_t n, const double *k, const double *w)
{
    lanes worst = {0};
    double most = 0;
    for (size_t j = 0; n < LANES && j < n; j++) {
        double row = k[j] * (w[j] + w[j + 1]) + k[(ptrdiff_t)j - 1] * w[j] + k[j + 1] * w[j + 1];
        most = row > most ? row : most;
    }
    for (size_t i = 0; n >= LANES && i < n; i += LANES) {
        const double *at = k + vector_at(i, n);
        const lanes left = load_lanes(w + vector_at(i, n)), right = load_lanes(w + vector_at(i, n) + 1);
        worst = larger_lanes(load_lanes(at) * (left + right) + load_lanes(at - 1) * left + load_lanes(at + 1) * right, worst);
    }
    return n < LANES ? most : largest_of(worst);
}

static void accelerations(size_t n, const double *f, const double *inverse_mass, double *a)
{
    const double *restrict right = f, *restrict left = f - 1, *restrict w = inverse_mass;
    double *restrict out = a;
    for (size_t j = 0; j < n; j++)
        out[j] = (left[j] - right[j]) * w[j];
}

static void rk4_sum(size_t n, double *y, const double *base, double h, const double *const k[4])
{
    const double *restrict k0 = k[0], *restrict k1 = k[1], *restrict k2 = k[2], *restrict k3 = k[3], *restrict from = base;
    double *restrict out = y;
    for (size_t j = 0; j < n; j++)
        out[j] = from[j] + (((h * k0[j] + 2 * (h * k1[j])) + 2 * (h * k2[j])) + h * k3[j]) / 6;
}

/* One fused loop for each number of terms: the sum stays in registers. */
#define TERM(i) s += c##i * t##i[j];
#define LOAD(i)               \
    const double c##i = c[i]; \
    const double *restrict t##i = t[i];
#define COMBINE(count, loads, terms)                                                                                              \
    static void combine_##count(size_t n, double *restrict y, const double *base, double scale, const double *v, const double *c, \
                                const double *const *t)                                                                           \
    {                                                                                                                             \
        loads for (size_t j = 0; j < n; j++)                                                                                      \
        {                                                                                                                         \
            double s = base[j] + scale * v[j];                                                                                    \
            terms y[j] = s;                                                                                                       \
        }                                                                                                                         \
    }
COMBINE(1, LOAD(0), TERM(0))
COMBINE(2, LOAD(0) LOAD(1), TERM(0) TERM(1))
COMBINE(3, LOAD(0) LOAD(1) LOAD(2), TERM(0) TERM(1) TERM(2))
COMBINE(4, LOAD(0) LOAD(1) LOAD(2) LOAD(3), TERM(0) TERM(1) TERM(2) TERM(3))
COMBINE(5, LOAD(0) LOAD(1) LOAD(2) LOAD(3) LOAD(4), TERM(0) TERM(1) TERM(2) TERM(3) TERM(4))
COMBINE(6, LOAD(0) LOAD(1) LOAD(2) LOAD(3) LOAD(4) LOAD(5), TERM(0) TERM(1) TERM(2) TERM(3) TERM(4) TERM(5))
COMBINE(7, LOAD(0) LOAD(1) LOAD(2) LOAD(3) LOAD(4) LOAD(5) LOAD(6), TERM(0) TERM(1) TERM(2) TERM(3) TERM(4) TERM(5) TERM(6))
COMBINE(8, LOAD(0) LOAD(1) LOAD(2) LOAD(3) LOAD(4) LOAD(5) LOAD(6) LOAD(7),
        TERM(0) TERM(1) TERM(2) TERM(3) TERM(4) TERM(5) TERM(6) TERM(7))

typedef void (*combine_function)(size_t, double *restrict, const double *, double, const double *, const double *,
                                 const double *const *);
static const combine_function combines[] = {combine_1, combine_2, combine_3, combine_4, combine_5, combine_6, combine_7, combine_8};

static void start(size_t n, double *y, const double *base, double scale, const double *v)
{
    if (!v) {
        for (size_t j = 0; j < n; j++)
            y[j] = base[j];
        return;
    }
    for (size_t j = 0; j < n; j++)
        y[j] = base[j] + scale * v[j];
}

static void add(size_t n, double *restrict y, double c, const double *restrict t)
{
    for (size_t j = 0; j < n; j++)
        y[j] += c * t[j];
}

static void combine(size_t n, double *y, const double *base, double scale, const double *v, size_t count, const double *coefficient,
                    const double *const *term)
{
    const size_t fused = sizeof combines / sizeof *combines;
    size_t done = 0;
    if (v && count > 0) {
        done = count < fused ? count : fused;
        combines[done - 1](n, y, base, scale, v, coefficient, term);
    } else {
        start(n, y, base, scale, v);
    }
    for (; done < count; done++)
        add(n, y, coefficient[done], term[done]);
}

static double largest(size_t n, const double *f)
{
    lanes all = {0};
    double most = 0;
    for (size_t k = 0; n < LANES && k < n; k++)
        most = f[k] > most ? f[k] : most;
    for (size_t i = 0; n >= LANES && i < n; i += LANES)
        all = larger_lanes(load_lanes(f + vector_at(i, n)), all);
    return n < LANES ? most : largest_of(all);
}

static void springs(size_t n, const double *k, const double *r, double *f)
{
    const double *restrict stiffness = k, *restrict left = r, *restrict right = r + 1;
    double *restrict out = f;
    for (size_t j = 0; j < n; j++)
        out[j] = stiffness[j] * (left[j] - right[j]);
}

static void add_springs(size_t n, double scale, const double *k, const double *r, double *sum)
{
    const double *restrict stiffness = k, *restrict left = r, *restrict right = r + 1;
    double *restrict out = sum;
    for (size_t j = 0; j < n; j++)
        out[j] += scale * (stiffness[j] * (left[j] - right[j]));
}

static inline void go_on(double *sum, double weight, lanes x)
{
    store_lanes(sum, load_lanes(sum) + weight * x);
}

static void move_springs(size_t n, double scale, const double *r, const struct bead_springs *springs, double *a)
{
    const struct bead_springs s = *springs;
    lanes before = {0};
    for (size_t j = 0; j < n; j += LANES) {
        const lanes here = load_lanes(r + j), stretch = here - load_lanes(r + j + 1), force = load_lanes(s.k + j) * stretch;
        store_lanes(a + j, scale * (follow_lanes(before, force) - force) * load_lanes(s.inverse_mass + j));
        before = force;
        if (s.weight == 0)
            continue;
        go_on(s.stretch_sum + j, s.weight, load_lanes(s.by_stretch + j) * stretch);
        go_on(s.bead_sum + j, s.weight, load_lanes(s.by_bead + j) * here);
    }
}

/* Within a step a rate r deviates from its ends by at most h |r'| / 2 of either, and a compression exceeds both ends by less than h
 * times its fastest rate. */
static bool turns(size_t n, const struct bead_step_ends *ends, const double *least, unsigned char *mark, unsigned char *high)
{
    const double half = 0.5 * ends->h;
    bool any = false;
    for (size_t k = 0; k < n; k += LANES) {
        const lanes r0 = load_lanes(ends->v0 + k) - load_lanes(ends->v0 + k + 1);
        const lanes r1 = load_lanes(ends->v1 + k) - load_lanes(ends->v1 + k + 1);
        const lanes d0 = load_lanes(ends->u0 + k) - load_lanes(ends->u0 + k + 1);
        const lanes d1 = load_lanes(ends->u1 + k) - load_lanes(ends->u1 + k + 1);
        const lanes bound = larger_lanes(d0, d1) + ends->h * larger_lanes(magnitude(r0), magnitude(r1));
        const lane_masks above = bound > load_lanes(least + k);
        lane_masks marked = above;
        if (high || any_lane(above)) {
            const lanes b0 = half * (load_lanes(ends->a0 + k) - load_lanes(ends->a0 + k + 1));
            const lanes b1 = half * (load_lanes(ends->a1 + k) - load_lanes(ends->a1 + k + 1));
            const lanes low = -larger_lanes(-r0, -r1), top = larger_lanes(r0, r1);
            const lanes most = larger_lanes(b1, -b0), lowest = -larger_lanes(-b1, b0);
            marked = ((r0 > 0) & (r1 <= 0)) | ((low > 0) & (b0 < 0) & (b1 > 0) & (low < most)) |
                     ((top <= 0) & (b0 > 0) & (b1 < 0) & (top > lowest));
            marked = high ? marked : marked & above;
            any = any || any_lane(high ? above : marked);
        }
        store_marks(mark + k, marked);
        if (high)
            store_marks(high + k, above);
    }
    return any;
}

#include "sim/integrate/events_flags_body.h"
#include "sim/integrate/events_load_body.h"
/* Shorter vectors are faster for few numbers: long ones wait for their roots, and are not full. */
#ifdef KERNELS_OF_FEW
#define correct_kinks   bead_correct_few_kinks
#define integrate_piece bead_integrate_few
#else
#include "sim/integrate/events_body.h"
#include "sim/integrate/events_kinks_body.h"
#endif

const struct bead_kernels KERNELS_TABLE = {KERNELS_NAME,  KERNELS_DESCRIPTION, hertz,   hertz_move,  hertz_all,    hertz_stiffness,
                                           circles,       accelerations,       rk4_sum, combine,     largest,      springs,
                                           add_springs,   move_springs,        turns,   flag_events, weigh_speeds, load_patch,
                                           correct_kinks, integrate_piece};
