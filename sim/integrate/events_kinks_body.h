/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included by kernels_body.h: kinks, see events_kinks.h. Lanes are kinks. */
#include <math.h>

#include "sim/integrate/events_kinks.h"

/* The series of g is accurate if its coefficients, in units of the step, are below this: not if the contact grazes. */
static const float kink_bend = 2;
/* The bending of the quintic by the kink is ignored if it changes a velocity by less than half the tolerance: this part of the
 * correction, times h^2 A sqrt(rho)/m. */
static const float kink_bent = 0.02f;
/* A zero of the quintic is found when the next step to it is shorter than this. */
static const float kink_found = 1e-3f;
/* Remaining errors as parts of a correction: of second order, times q^2; from the end of the series, times the third power of its
 * bend; all others. */
static const float kink_second = 0.0005f, kink_series = 0.002f, kink_rest = 1e-4f;

/* All lengths are in units of the change of the kink's compression within the step. */

/* d and d' of contacts k - 1, k, k + 1, and d'' of contact k, at one end of the step. */
struct kink_end {
    floats d[3], rate[3], bend;
};

/* The beginning or the end of a force. */
struct kink_shape {
    floats tau, sign, closes; /* x = sign (s - tau); closes: 1 if it closes, 0 if it opens */
    floats rho, e1, e2;
    floats bend;        /* of the compression, in units of rho */
    floats full, late;  /* if the contact opens: integrals of g over all x > 0, and of (tau - x) g; else 0 */
    floats once, twice; /* integrals over the step of g and (1 - s) g */
};

/* Numbers of FLOATS contacts, each times its scale. */
static inline floats gather_floats(const double *x, const size_t *contact, const lanes scale[2])
{
    return narrow_lanes(scale[0] * gather_lanes(x, contact), scale[1] * gather_lanes(x, contact + LANES));
}

static inline void gather_end(const size_t *contact, const double *d, const double *rate, const double *a, const lanes scale[2],
                              double square, struct kink_end *end)
{
    lanes bend[2];
    for (ptrdiff_t j = 0; j < 3; j++) {
        end->d[j] = gather_floats(d + j - 1, contact, scale);
        end->rate[j] = gather_floats(rate + j - 1, contact, scale);
    }
    for (size_t i = 0; i < 2; i++)
        bend[i] = scale[i] * (square * (gather_lanes(a, contact + i * LANES) - gather_lanes(a + 1, contact + i * LANES)));
    end->bend = narrow_lanes(bend[0], bend[1]);
}

/* Coefficients of the quintic Hermite interpolant from value, slope and second derivative at both ends. */
static inline void kink_quintic(floats d0, floats r0, floats b0, floats d1, floats r1, floats b1, floats c[6])
{
    const floats c2 = 0.5f * b0, e = d1 - ((d0 + r0) + c2), e1 = r1 - (r0 + 2 * c2), e2 = b1 - 2 * c2;
    c[0] = d0;
    c[1] = r0;
    c[2] = c2;
    c[3] = (10 * e - 4 * e1) + 0.5f * e2;
    c[4] = (7 * e1 - 15 * e) - e2;
    c[5] = (6 * e - 3 * e1) + 0.5f * e2;
}

static inline floats kink_value(const floats c[6], floats s)
{
    return c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * (c[4] + s * c[5]))));
}

static inline floats kink_slope(const floats c[6], floats s)
{
    return c[1] + s * (2 * c[2] + s * (3 * c[3] + s * (4 * c[4] + s * (5 * c[5]))));
}

/* Half the second derivative. */
static inline floats kink_curve(const floats c[6], floats s)
{
    return c[2] + s * (3 * c[3] + s * (6 * c[4] + s * (10 * c[5])));
}

/* Zero of the quintic between 0 and 1. Two steps of Newton's method, from the zero of the cubic s(d) through both ends or, if the
 * rate changes sign in between, of the tangent at the end with the right sign. */
static inline floats kink_root(const floats c[6], const struct kink_end *end0, const struct kink_end *end1)
{
    const floats span = end1->d[1] - end0->d[1], y = -end0->d[1] / span, z = 1 - y;
    const floats a = span / end0->rate[1], b = span / end1->rate[1];
    floats s = y * y * (3 - 2 * y) + y * z * (z * a - y * b);
    s = choose_floats(a > 0, choose_floats(b > 0, s, -end0->d[1] / end0->rate[1]), 1 - end1->d[1] / end1->rate[1]);
    s = choose_floats((s > 0) & (s < 1), s, y);
    for (int i = 0; i < 2; i++)
        s -= kink_value(c, s) / kink_slope(c, s);
    return s;
}

static inline floats kink_force(const struct kink_shape *k, floats x)
{
    x = positive_floats(x);
    return x * root_floats(x) * (1 + x * (k->e1 + x * k->e2));
}

/* Finds shapes from the quintic's slope, half its second and a sixth of its third derivative at tau. Returns which are kinks. */
static inline float_masks shape_kink(struct kink_shape *k, floats tau, floats q1, floats q2, floats q3)
{
    const floats zero = {0};
    k->rho = k->sign * q1;
    floats bend = q2 / k->rho, turn = k->sign * q3 / k->rho;
    const float_masks good =
        (tau > 0) & (tau < 1) & (k->rho > 0) & (magnitude_floats(bend) < kink_bend) & (magnitude_floats(turn) < kink_bend);
    /* the others get harmless numbers */
    bend = choose_floats(good, bend, zero);
    turn = choose_floats(good, turn, zero);
    k->rho = choose_floats(good, k->rho, zero);
    k->tau = choose_floats(good, tau, zero + 0.5f);
    k->bend = magnitude_floats(bend) + root_floats(magnitude_floats(turn));
    k->e1 = 1.5f * bend;
    k->e2 = 1.5f * turn + 0.375f * (bend * bend);
    const floats x = k->closes + -k->sign * k->tau, power = x * x * root_floats(x);
    const floats once = power * (1 / 2.5f + x * (k->e1 * (1 / 3.5f) + x * (k->e2 * (1 / 4.5f))));
    const floats twice = power * x * (1 / 8.75f + x * (k->e1 * (1 / 15.75f) + x * (k->e2 * (1 / 24.75f))));
    k->full = (1 - k->closes) * once;
    k->late = (1 - k->closes) * twice;
    k->once = once;
    k->twice = choose_floats(k->sign > 0, twice, once - twice);
    return good;
}

/* g and its double integral over x at the stages. */
static inline void spread_kink(const struct bead_kink_method *t, const struct kink_shape *k, floats *g, floats *twice)
{
    for (size_t i = 0; i < BEAD_KINK_STAGES; i++) {
        const floats x = positive_floats(k->sign * (t->c[i] - k->tau)), power = x * root_floats(x);
        g[i] = power * (1 + x * (k->e1 + x * k->e2));
        twice[i] = power * (x * x) * (1 / 8.75f + x * (k->e1 * (1 / 15.75f) + x * (k->e2 * (1 / 24.75f))));
    }
}

static inline floats kink_sum(const float *weight, const floats *x)
{
    floats sum = weight[0] * x[0];
    for (size_t i = 1; i < BEAD_KINK_STAGES; i++)
        sum += weight[i] * x[i];
    return sum;
}

/* The kink bends the quintic: finds the error of its value, slope and half second derivative at tau, times `scale`. `twice`,
 * `once`: the method's moment and impulse of the kink. */
static inline void unbend(const struct kink_shape *k, floats scale, floats once, floats twice, floats d[3])
{
    const floats zero = {0};
    floats c[6];
    kink_quintic(zero, zero, kink_force(k, -k->sign * k->tau), twice, once, kink_force(k, k->sign * (1 - k->tau)), c);
    d[0] = scale * ((k->tau * k->full - k->late) - kink_value(c, k->tau));
    d[1] = scale * (k->full - kink_slope(c, k->tau));
    d[2] = -scale * kink_curve(c, k->tau);
}

/* Cubics through both ends, sufficient for stiffnesses. */
static inline void kink_cubics(const struct kink_end *end0, const struct kink_end *end1, floats c[3][4])
{
    for (size_t j = 0; j < 3; j++) {
        const floats rise = end1->d[j] - end0->d[j], r0 = end0->rate[j], r1 = end1->rate[j];
        c[j][0] = end0->d[j];
        c[j][1] = r0;
        c[j][2] = 3 * rise - 2 * r0 - r1;
        c[j][3] = r0 + r1 - 2 * rise;
    }
}

/* Adds the effect of the stages of a kink on its three contacts; returns q. spring: h^2/m times 3/2 A of each contact, 1/m of the
 * bead that it shares with the kink (k - 1, k + 1), or of both beads (k). */
static floats sum_stages(const struct bead_kink_method *t, const struct kink_shape *shape, const floats *g, const floats *twice,
                         floats cubic[3][4], const floats spring[3], floats impulse[3], floats moment[3])
{
    floats most = {0};
    for (size_t i = 0; i < BEAD_KINK_STAGES; i++) {
        const float s = t->c[i];
        if (t->b[i] == 0 && t->bp[i] == 0)
            continue;
        floats eps = shape->late - s * shape->full - twice[i], k[3];
        for (size_t j = 0; j < i; j++)
            eps += t->a[i][j] * g[j];
        for (size_t j = 0; j < 3; j++)
            k[j] = spring[j] * root_floats(positive_floats(cubic[j][0] + s * (cubic[j][1] + s * (cubic[j][2] + s * cubic[j][3]))));
        most = larger_floats(k[1] + (k[0] + k[2]), most);
        const floats change[3] = {-k[0] * eps, k[1] * eps, -k[2] * eps};
        for (size_t j = 0; j < 3; j++) {
            impulse[j] += t->bp[i] * change[j];
            moment[j] += t->b[i] * change[j];
        }
    }
    return most;
}

/* Contacts that open or close, with a rate that agrees at one end of the step or both. */
static inline float_masks simple_kinks(const struct kink_end *end0, const struct kink_end *end1)
{
    const float_masks closed0 = end0->d[1] > 0, closed1 = end1->d[1] > 0;
    const float_masks opening = (end0->rate[1] < 0) | (end1->rate[1] < 0), closing = (end0->rate[1] > 0) | (end1->rate[1] > 0);
    return (closed0 & ~closed1 & opening) | (~closed0 & closed1 & closing);
}

/* Input data of kinks. */
struct kink_facts {
    lanes unit[2]; /* N s: h A span^{3/2} */
    struct kink_end end0, end1;
    floats spring[3]; /* see sum_stages */
    floats effect;    /* m/s */
};

static inline void gather_facts(const struct bead_patch_source *source, const struct bead_event_flags *flags, size_t at,
                                struct kink_facts *facts)
{
    const size_t *contact = flags->contact + at;
    const double h = source->h, square = h * h;
    lanes scale[2], spring[3][2];
    for (size_t i = 0; i < 2; i++, contact += LANES) {
        const lanes span = magnitude(gather_lanes(flags->d1, contact) - gather_lanes(flags->d0, contact)), root = ROOT_OF(span);
        const lanes left = square * gather_lanes(source->inverse_mass, contact),
                    right = square * gather_lanes(source->inverse_mass + 1, contact), a = gather_lanes(source->stiffness, contact);
        scale[i] = 1 / span;
        facts->unit[i] = h * (a * (span * root));
        spring[0][i] = left * (1.5 * root * gather_lanes(source->stiffness - 1, contact));
        spring[1][i] = (left + right) * (1.5 * root * a);
        spring[2][i] = right * (1.5 * root * gather_lanes(source->stiffness + 1, contact));
    }
    contact = flags->contact + at;
    for (size_t j = 0; j < 3; j++)
        facts->spring[j] = narrow_lanes(spring[j][0], spring[j][1]);
    facts->effect = narrow_lanes(load_lanes(flags->effect + at), load_lanes(flags->effect + at + LANES));
    gather_end(contact, flags->d0, flags->r0, source->a0, scale, square, &facts->end0);
    gather_end(contact, flags->d1, flags->r1, source->a1, scale, square, &facts->end1);
}

/* Finds the kinks' shapes; returns which are kinks. `unknown`: uncertainty of the shapes as a part of each correction. */
static inline float_masks find_shapes(const struct kink_facts *facts, const struct bead_kink_method *t, float tolerance,
                                      struct kink_shape *shape, floats *unknown)
{
    const floats zero = {0}, one = zero + 1;
    const struct kink_end *end0 = &facts->end0, *end1 = &facts->end1;
    floats c[6], bent[3] = {zero, zero, zero}, g[BEAD_KINK_STAGES], twice[BEAD_KINK_STAGES];
    /* tau of the quintic */
    kink_quintic(end0->d[1], end0->rate[1], end0->bend, end1->d[1], end1->rate[1], end1->bend, c);
    shape->sign = choose_floats(end0->d[1] > 0, -one, one);
    shape->closes = choose_floats(end0->d[1] > 0, zero, one);
    const floats tau = kink_root(c, end0, end1), q0 = kink_value(c, tau), q1 = kink_slope(c, tau), q2 = kink_curve(c, tau);
    const floats q3 = c[3] + tau * (4 * c[4] + tau * (10 * c[5]));
    float_masks good =
        simple_kinks(end0, end1) & shape_kink(shape, tau, q1, q2, q3) & (magnitude_floats(q0) < kink_found * magnitude_floats(q1));
    /* tau without the bending */
    const floats strength = (1 / 1.5f) * (facts->spring[1] * root_floats(shape->rho)), bends = kink_bent * strength;
    const float_masks bending = bends * facts->effect > 0.5f * tolerance;
    if (any_float(bending)) {
        spread_kink(t, shape, g, twice);
        unbend(shape, -strength * shape->rho, kink_sum(t->bp, g), kink_sum(t->b, g), bent);
        for (size_t j = 0; j < 3; j++)
            bent[j] = choose_floats(bending, bent[j], zero);
    }
    const floats shift = -(q0 + bent[0]) / (q1 + bent[1]);
    good &= shape_kink(shape, tau + shift, q1 + bent[1] + 2 * (q2 * shift), q2 + bent[2] + 3 * (q3 * shift), q3);
    *unknown = kink_series * (shape->bend * (shape->bend * shape->bend)) + kink_rest + choose_floats(bending, zero, bends);
    return good;
}

/* Kinks at..at + FLOATS - 1. */
static void correct_some(const struct bead_patch_source *source, const struct bead_kink_method *t,
                         const struct bead_event_flags *flags, double tolerance, size_t at, struct bead_kinks *kinks)
{
    const floats zero = {0};
    struct kink_facts facts;
    struct kink_shape shape;
    floats cubic[3][4], g[BEAD_KINK_STAGES], twice[BEAD_KINK_STAGES], unknown;
    gather_facts(source, flags, at, &facts);
    const float_masks good = find_shapes(&facts, t, (float)tolerance, &shape, &unknown);
    spread_kink(t, &shape, g, twice);

    floats impulse[3] = {zero, shape.once - kink_sum(t->bp, g), zero}, moment[3] = {zero, shape.twice - kink_sum(t->b, g), zero};
    kink_cubics(&facts.end0, &facts.end1, cubic);
    const floats most = sum_stages(t, &shape, g, twice, cubic, facts.spring, impulse, moment);
    const floats scale = shape.rho * root_floats(shape.rho),
                 left = choose_floats(good, unknown + kink_second * (most * most), zero + INFINITY);
    const lanes unit[2] = {facts.unit[0], facts.unit[1]};
    store_lanes(kinks->left + at, widen_lower(left) * load_lanes(flags->effect + at));
    store_lanes(kinks->left + at + LANES, widen_upper(left) * load_lanes(flags->effect + at + LANES));
    for (size_t j = 0; j < 3; j++) {
        store_lanes(kinks->impulse[j] + at, unit[0] * widen_lower(impulse[j] * scale));
        store_lanes(kinks->impulse[j] + at + LANES, unit[1] * widen_upper(impulse[j] * scale));
        store_lanes(kinks->moment[j] + at, source->h * unit[0] * widen_lower(moment[j] * scale));
        store_lanes(kinks->moment[j] + at + LANES, source->h * unit[1] * widen_upper(moment[j] * scale));
    }
}

static void correct_kinks(const struct bead_patch_source *source, const struct bead_kink_method *method, size_t count,
                          struct bead_event_flags *flags, double tolerance, struct bead_kinks *kinks)
{
    /* fill the last vector */
    for (size_t i = count; i % FLOATS != 0; i++) {
        flags->contact[i] = flags->contact[count - 1];
        flags->effect[i] = flags->effect[count - 1];
    }
    for (size_t i = 0; i < count; i += FLOATS)
        correct_some(source, method, flags, tolerance, i, kinks);
}
