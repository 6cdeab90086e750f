/* Included by kernels_body.h: kinks, see events_kinks.h. Lanes are kinks. */
#include <math.h>

#include "sim/events_kinks.h"
#include "sim/tableau.h"

/* The series of g is of use where its coefficients, in units of the step, stay below this: not where the contact grazes. */
static const double kink_bend = 2;
/* How the kink bends the quintic is left out where it can change a velocity by less than half the tolerance: this part of the
 * correction, times h^2 A sqrt(rho)/m. */
static const double kink_bent = 0.02;
/* A zero of the quintic is found when the next step to it is shorter than this. */
static const double kink_found = 1e-3;
/* Parts of a correction that are left undone: by second orders, times q^2; by the end of the series, times the third power of its
 * bend; by all the rest. */
static const double kink_second = 0.0005, kink_series = 0.002, kink_rest = 1e-4;

/* d and d', and where the kink is d'', of contacts k - 1, k, k + 1 at one end of the step. */
struct kink_end {
    lanes d[3], rate[3], bend;
};

/* Where and how a force sets in or ends. */
struct kink_shape {
    lanes tau, sign, closes; /* x = sign (s - tau); closes: 1 where it does, else 0 */
    lanes rho, e1, e2;
    lanes bend;        /* of the compression, in units of rho */
    lanes full, late;  /* of a contact that opens: integrals of g over all x > 0, and of (tau - x) g; else 0 */
    lanes once, twice; /* integrals over the step of g and (1 - s) g */
};

static void gather_end(const struct bead_patch_source *source, const size_t *contact, size_t count, const double *u,
                       const double *v, const double *a, struct kink_end *end)
{
    const double h = source->h;
    double d[3][LANES], rate[3][LANES], bend[LANES];
    for (size_t i = 0; i < LANES; i++) {
        const ptrdiff_t k = (ptrdiff_t)contact[i < count ? i : count - 1];
        for (ptrdiff_t j = 0; j < 3; j++) {
            const ptrdiff_t at = k + j - 1;
            d[j][i] = source->static_compression[at] + (u[at] - u[at + 1]);
            rate[j][i] = h * (v[at] - v[at + 1]);
        }
        bend[i] = (h * h) * (a[k] - a[k + 1]);
    }
    for (size_t j = 0; j < 3; j++) {
        end->d[j] = load_lanes(d[j]);
        end->rate[j] = load_lanes(rate[j]);
    }
    end->bend = load_lanes(bend);
}

static inline lanes gather_constants(const double *x, ptrdiff_t shift, const size_t *contact, size_t count)
{
    double y[LANES];
    for (size_t i = 0; i < LANES; i++)
        y[i] = x[(ptrdiff_t)contact[i < count ? i : count - 1] + shift];
    return load_lanes(y);
}

/* x[0..count - 1], and 0 behind them. */
static inline lanes first_lanes(const double *x, size_t count)
{
    double y[LANES];
    for (size_t i = 0; i < LANES; i++)
        y[i] = i < count ? x[i] : 0;
    return load_lanes(y);
}

/* Coefficients of the quintic Hermite interpolant from value, slope and second derivative at both ends. */
static inline void kink_quintic(lanes d0, lanes r0, lanes b0, lanes d1, lanes r1, lanes b1, lanes c[6])
{
    const lanes c2 = 0.5 * b0, e = d1 - ((d0 + r0) + c2), e1 = r1 - (r0 + 2 * c2), e2 = b1 - 2 * c2;
    c[0] = d0;
    c[1] = r0;
    c[2] = c2;
    c[3] = (10 * e - 4 * e1) + 0.5 * e2;
    c[4] = (7 * e1 - 15 * e) - e2;
    c[5] = (6 * e - 3 * e1) + 0.5 * e2;
}

static inline lanes kink_value(const lanes c[6], lanes s)
{
    return c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * (c[4] + s * c[5]))));
}

static inline lanes kink_slope(const lanes c[6], lanes s)
{
    return c[1] + s * (2 * c[2] + s * (3 * c[3] + s * (4 * c[4] + s * (5 * c[5]))));
}

/* Half the second derivative. */
static inline lanes kink_curve(const lanes c[6], lanes s)
{
    return c[2] + s * (3 * c[3] + s * (6 * c[4] + s * (10 * c[5])));
}

/* Zero of the quintic between 0 and 1: where the cubic s(d) through both ends has it or, where the rate changes its sign on the
 * way, the tangent at the end beyond which it does not; then two steps of Newton's method. */
static inline lanes kink_root(const lanes c[6], const struct kink_end *end0, const struct kink_end *end1)
{
    const lanes span = end1->d[1] - end0->d[1], y = -end0->d[1] / span, z = 1 - y;
    const lanes a = span / end0->rate[1], b = span / end1->rate[1];
    lanes s = y * y * (3 - 2 * y) + y * z * (z * a - y * b);
    s = choose(a > 0, choose(b > 0, s, -end0->d[1] / end0->rate[1]), 1 - end1->d[1] / end1->rate[1]);
    s = choose((s > 0) & (s < 1), s, y);
    for (int i = 0; i < 2; i++)
        s -= kink_value(c, s) / kink_slope(c, s);
    return s;
}

static inline lanes kink_force(const struct kink_shape *k, lanes x)
{
    x = positive_part(x);
    return x * ROOT_OF(x) * (1 + x * (k->e1 + x * k->e2));
}

/* From the quintic's slope, half its second and a sixth of its third derivative at tau. Returns where it is a kink. */
static inline lane_masks shape_kink(struct kink_shape *k, lanes tau, lanes q1, lanes q2, lanes q3)
{
    const lanes zero = {0};
    k->rho = k->sign * q1;
    lanes bend = q2 / k->rho, turn = k->sign * q3 / k->rho;
    const lane_masks good = (tau > 0) & (tau < 1) & (k->rho > 0) & (magnitude(bend) < kink_bend) & (magnitude(turn) < kink_bend);
    /* The others go along with numbers that do no harm. */
    bend = choose(good, bend, zero);
    turn = choose(good, turn, zero);
    k->rho = choose(good, k->rho, zero);
    k->tau = choose(good, tau, zero + 0.5);
    k->bend = magnitude(bend) + ROOT_OF(magnitude(turn));
    k->e1 = 1.5 * bend;
    k->e2 = 1.5 * turn + 0.375 * (bend * bend);
    const lanes x = k->closes + -k->sign * k->tau, power = x * x * ROOT_OF(x);
    const lanes once = power * (1 / 2.5 + x * (k->e1 * (1 / 3.5) + x * (k->e2 * (1 / 4.5))));
    const lanes twice = power * x * (1 / 8.75 + x * (k->e1 * (1 / 15.75) + x * (k->e2 * (1 / 24.75))));
    k->full = (1 - k->closes) * once;
    k->late = (1 - k->closes) * twice;
    k->once = once;
    k->twice = choose(k->sign > 0, twice, once - twice);
    return good;
}

/* g at the stages, and its integral over x twice. */
static inline void spread_kink(const struct bead_tableau *t, const struct kink_shape *k, lanes *g, lanes *twice)
{
    for (size_t i = 0; i < BEAD_KINK_STAGES; i++) {
        const lanes x = positive_part(k->sign * (t->c[i] - k->tau)), power = x * ROOT_OF(x);
        g[i] = power * (1 + x * (k->e1 + x * k->e2));
        twice[i] = power * (x * x) * (1 / 8.75 + x * (k->e1 * (1 / 15.75) + x * (k->e2 * (1 / 24.75))));
    }
}

static inline lanes kink_sum(const double *weight, const lanes *x)
{
    lanes sum = weight[0] * x[0];
    for (size_t i = 1; i < BEAD_KINK_STAGES; i++)
        sum += weight[i] * x[i];
    return sum;
}

/* The kink bends the quintic: what it should have been at tau, less what it is, times `scale`. d: value, slope, half the second
 * derivative. `twice`, `once`: what the method has for the kink's moment and impulse. */
static inline void unbend(const struct kink_shape *k, lanes scale, lanes once, lanes twice, lanes d[3])
{
    const lanes zero = {0};
    lanes c[6];
    kink_quintic(zero, zero, kink_force(k, -k->sign * k->tau), twice, once, kink_force(k, k->sign * (1 - k->tau)), c);
    d[0] = scale * ((k->tau * k->full - k->late) - kink_value(c, k->tau));
    d[1] = scale * (k->full - kink_slope(c, k->tau));
    d[2] = -scale * kink_curve(c, k->tau);
}

/* Stiffnesses are wanted in few digits only: from the cubics through both ends. */
static inline void kink_cubics(const struct kink_end *end0, const struct kink_end *end1, lanes c[3][4])
{
    for (size_t j = 0; j < 3; j++) {
        const lanes rise = end1->d[j] - end0->d[j], r0 = end0->rate[j], r1 = end1->rate[j];
        c[j][0] = end0->d[j];
        c[j][1] = r0;
        c[j][2] = 3 * rise - 2 * r0 - r1;
        c[j][3] = r0 + r1 - 2 * rise;
    }
}

/* A kink of known shape: what its stages do to the three contacts, and q. */
static lanes sum_stages(const struct bead_tableau *t, const struct kink_shape *shape, const lanes *g, const lanes *twice,
                        lanes cubic[3][4], const lanes stiffness[3], const lanes square[2], lanes impulse[3], lanes moment[3])
{
    const lanes both = square[0] + square[1];
    lanes most = {0};
    for (size_t i = 0; i < BEAD_KINK_STAGES; i++) {
        const double s = t->c[i], *row = t->a + i * t->stages;
        if (t->b[i] == 0 && t->bp[i] == 0)
            continue;
        lanes eps = shape->late - s * shape->full - twice[i], k[3];
        for (size_t j = 0; j < i; j++)
            eps += row[j] * g[j];
        for (size_t j = 0; j < 3; j++)
            k[j] = stiffness[j] * ROOT_OF(positive_part(cubic[j][0] + s * (cubic[j][1] + s * (cubic[j][2] + s * cubic[j][3]))));
        const lanes circle = both * k[1] + (square[0] * k[0] + square[1] * k[2]);
        most = larger_lanes(circle, most);
        const lanes change[3] = {-square[0] * k[0] * eps, both * k[1] * eps, -square[1] * k[2] * eps};
        for (size_t j = 0; j < 3; j++) {
            impulse[j] += t->bp[i] * change[j];
            moment[j] += t->b[i] * change[j];
        }
    }
    return most;
}

/* `count` kinks, LANES at most. */
static void correct_some(const struct bead_patch_source *source, const struct bead_tableau *t, const size_t *contact,
                         const double *effect, double tolerance, size_t count, struct bead_kink *kink)
{
    const lanes zero = {0};
    struct kink_end end0, end1;
    struct kink_shape shape;
    lanes stiffness[3], square[2], c[6], bent[3], cubic[3][4], g[BEAD_KINK_STAGES], twice[BEAD_KINK_STAGES];
    gather_end(source, contact, count, source->u0, source->v0, source->a0, &end0);
    gather_end(source, contact, count, source->u1, source->v1, source->a1, &end1);
    for (ptrdiff_t j = 0; j < 3; j++)
        stiffness[j] = 1.5 * gather_constants(source->stiffness, j - 1, contact, count);
    for (ptrdiff_t j = 0; j < 2; j++)
        square[j] = (source->h * source->h) * gather_constants(source->inverse_mass, j, contact, count);

    /* Where the quintic has it ... */
    kink_quintic(end0.d[1], end0.rate[1], end0.bend, end1.d[1], end1.rate[1], end1.bend, c);
    shape.sign = choose(end0.d[1] > 0, zero - 1, zero + 1);
    shape.closes = choose(end0.d[1] > 0, zero, zero + 1);
    lanes tau = kink_root(c, &end0, &end1), q0 = kink_value(c, tau), q1 = kink_slope(c, tau), q2 = kink_curve(c, tau);
    const lanes q3 = c[3] + tau * (4 * c[4] + tau * (10 * c[5])), a = stiffness[1] * (1 / 1.5);
    lane_masks good = shape_kink(&shape, tau, q1, q2, q3) & (magnitude(q0) < kink_found * magnitude(q1));
    /* ... and where it is. */
    const lanes strength = (square[0] + square[1]) * (a * ROOT_OF(shape.rho)), bends = kink_bent * strength;
    const lane_masks bending = bends * first_lanes(effect, count) > 0.5 * tolerance;
    for (size_t j = 0; j < 3; j++)
        bent[j] = zero;
    if (any_lane(bending)) {
        spread_kink(t, &shape, g, twice);
        unbend(&shape, -strength * shape.rho, kink_sum(t->bp, g), kink_sum(t->b, g), bent);
        for (size_t j = 0; j < 3; j++)
            bent[j] = choose(bending, bent[j], zero);
    }
    const lanes shift = -(q0 + bent[0]) / (q1 + bent[1]);
    good &= shape_kink(&shape, tau + shift, q1 + bent[1] + 2 * (q2 * shift), q2 + bent[2] + 3 * (q3 * shift), q3);
    spread_kink(t, &shape, g, twice);

    lanes impulse[3] = {zero, shape.once - kink_sum(t->bp, g), zero}, moment[3] = {zero, shape.twice - kink_sum(t->b, g), zero};
    kink_cubics(&end0, &end1, cubic);
    const lanes most = sum_stages(t, &shape, g, twice, cubic, stiffness, square, impulse, moment);
    const lanes scale = a * (shape.rho * ROOT_OF(shape.rho)), cube = shape.bend * (shape.bend * shape.bend);
    const lanes unknown = kink_second * (most * most) + kink_series * cube + kink_rest + choose(bending, zero, bends);
    const lanes left = choose(good, unknown, zero + INFINITY);
    for (size_t j = 0; j < 3; j++) {
        impulse[j] *= scale;
        moment[j] *= scale;
    }
    for (size_t i = 0; i < count; i++) {
        kink[i].left = left[i];
        for (size_t j = 0; j < 3; j++) {
            kink[i].impulse[j] = impulse[j][i];
            kink[i].moment[j] = moment[j][i];
        }
    }
}

static void correct_kinks(const struct bead_patch_source *source, const struct bead_tableau *tableau, size_t count,
                          const size_t *contact, const double *effect, double tolerance, struct bead_kink *kink)
{
    for (size_t i = 0; i < count; i += LANES)
        correct_some(source, tableau, contact + i, effect + i, tolerance, count - i < LANES ? count - i : LANES, kink + i);
}
