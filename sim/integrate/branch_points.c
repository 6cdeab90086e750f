/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the branch points of a step and what interpolation leaves out next to them: see branch_points.h. */
#include "sim/integrate/branch_points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/wide.h"
#include "sim/integrate/dense.h"

/* What septic interpolation makes of a velocity next to a branch point inside the step is off by less than this times h f/m, f the
 * force of the fastest rate for a step; x steps outside by less than this over (1 + x/nearby)^3. */
static const double spoilt = 1.2e-3, nearby = 0.1;
/* Contacts slower than this part of the striker may be spoilt by so much less. */
static const double usual_speed = 0.125;
/* Branch points further outside, in steps, leave forces that polynomials follow. */
static const double far_outside = 0.5;
/* A first round, of interpolated compressions, leaves this part of what a contact spoils, times h^2 f/(d m); less, mostly. */
static const double left_over = 0.01;
/* In a round a branch point is moved by this much at most, in steps. */
static const double farthest = 0.1;

/* y^power, y > 0 */
static double raise(double y, double power)
{
    if (power >= 2)
        return y * y * raise(y, power - 2);
    return power == 0 ? 1 : power == 1.5 ? y * sqrt(y) : power == 1 ? y : bead_pow(y, power);
}

/* ---- memory ---- */

enum bead_error bead_branch_points_create(const struct bead_chain *chain, struct bead_branch_points *p, struct bead_message *msg)
{
    *p = (struct bead_branch_points){.count = 0};
    if (!chain->law->one_sided || !chain->law->exponent)
        return BEAD_OK;
    p->rule = bead_patch_rule_make(chain->law, &chain->spec->law);
    for (size_t i = 0; i < BEAD_BRANCH_TERMS; i++)
        p->over[i] = 1 / raise(bead_gauss_node[i], p->rule.exponent);
    p->room = chain->contacts + 2 * BEAD_BRANCHES_MAX;
    p->point = calloc((1 + BEAD_BRANCH_SIDES) * p->room, sizeof *p->point); /* pages that are never used cost nothing */
    return p->point
               ? BEAD_OK
               : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the opening and closing of %zu contacts", chain->contacts);
}

void bead_branch_points_destroy(struct bead_branch_points *p)
{
    free(p->point);
    *p = (struct bead_branch_points){.count = 0};
}

/* ---- the double integral of the force ---- */

/* F and the first of its derivatives by x, `count` numbers: 2 or 4. */
static inline void integral(const struct bead_branch_point *b, double x, int count, double *out)
{
    const double y = b->slope * (x - b->base), k = b->slope;
    double sum[4] = {0, 0, 0, 0};
    memset(out, 0, (size_t)count * sizeof *out);
    if (!(y > 0) && (b->power > 0 || (b->base > 0 && b->base < 1)))
        return;
    if (b->ends && y > 1) {
        out[0] = b->far[0] + (y - 1) * b->far[1];
        out[1] = k * b->far[1];
        return;
    }
    for (int i = BEAD_BRANCH_TERMS - 1; i >= 0; i--) {
        const double e = b->power + i, c1 = b->c[i] * (e + 2), c2 = c1 * (e + 1);
        sum[0] = sum[0] * y + b->c[i];
        sum[1] = sum[1] * y + c1;
        if (count == 2)
            continue;
        sum[2] = sum[2] * y + c2;
        sum[3] = e > 0 ? sum[3] * y + c2 * e : sum[3]; /* y^-1 has no part in it */
    }
    const double power = raise(y, b->power);
    out[0] = power * (y * y) * sum[0];
    out[1] = k * (power * y * sum[1]);
    if (count == 2)
        return;
    out[2] = k * k * (power * sum[2]);
    out[3] = k * k * k * ((b->power > 0 ? power / y : 1) * sum[3]);
}

/* What interpolation leaves out of F, and its derivative by x. */
static void left_out(const struct bead_branch_point *b, double x, double out[2])
{
    double whole[2];
    integral(b, x, 2, whole);
    out[0] = whole[0] - bead_polynomial_value(&b->taken, x);
    out[1] = whole[1] - bead_polynomial_slope(&b->taken, x);
}

static double smaller(double x, double y)
{
    return x < y ? x : y;
}

static double larger(double x, double y)
{
    return x > y ? x : y;
}

static double inverse_mass(const struct bead_stepper *s, size_t bead)
{
    return bead < s->beads ? s->chain->inverse_mass[bead] : 0;
}

struct bead_branch_range bead_branch_points_near(const struct bead_branch_points *p, size_t contact)
{
    struct bead_branch_range r = {0, 0};
    for (size_t high = p->count; r.first < high;) {
        const size_t middle = r.first + (high - r.first) / 2;
        if (p->point[middle].contact + 1 < contact)
            r.first = middle + 1;
        else
            high = middle;
    }
    for (r.last = r.first; r.last < p->count && p->point[r.last].contact <= contact + 1;)
        r.last++;
    return r;
}

void bead_branch_points_correct_compression(const struct bead_branch_points *p, const struct bead_stepper *s,
                                            struct bead_branch_range near, size_t contact, double x, double d[2])
{
    const double left = inverse_mass(s, contact), right = inverse_mass(s, contact + 1);
    for (size_t i = near.first; i < near.last; i++) {
        const struct bead_branch_point *b = &p->point[i];
        const double factor = b->contact < contact ? left : b->contact > contact ? right : -(left + right);
        double rest[2];
        left_out(b, x, rest);
        d[0] += factor * rest[0];
        d[1] += factor * rest[1];
    }
}

void bead_branch_points_correct(const struct bead_branch_points *p, const struct bead_stepper *s, double x, struct bead_part part,
                                double *u, double *v)
{
    for (size_t i = 0; i < p->count + p->echoes; i++) {
        const struct bead_branch_point *b = &p->point[i];
        const size_t k = b->contact;
        double rest[2];
        if (k + 1 < part.from || k >= part.to)
            continue;
        left_out(b, x, rest);
        for (size_t j = k; j <= k + 1 && j < s->beads; j++) {
            const double w = j == k ? -s->chain->inverse_mass[j] : s->chain->inverse_mass[j];
            u[j] += w * rest[0];
            if (v)
                v[j] += w * rest[1] / s->h;
        }
    }
}

/* ---- finding them ---- */

/* Compression, rate and rate of rate, times h and h^2, of a contact in a state. */
static void end_of(const struct bead_stepper *s, const struct bead_state *state, const double *a, size_t k, double out[3])
{
    out[0] = s->table.static_compression[k] + (state->u[k] - state->u[k + 1]);
    out[1] = s->h * (state->v[k] - state->v[k + 1]);
    out[2] = s->h * s->h * (a[k] - a[k + 1]);
}

/* Which branch points are looked for. */
struct search {
    double reach, least; /* so many steps outside; m/s */
    double usual;        /* m: rate times h of a contact that counts as it is */
};

/* What a contact may spoil of a velocity, in units of the least, in the first round and in the second. */
struct effect {
    double first, second;
};

static struct effect effect_of(const struct bead_stepper *s, size_t k, const struct search *search)
{
    const double d0 = s->table.static_compression[k] + (s->start.u[k] - s->start.u[k + 1]);
    const double d1 = s->table.static_compression[k] + (s->end.u[k] - s->end.u[k + 1]);
    const double r0 = s->h * (s->start.v[k] - s->start.v[k + 1]), r1 = s->h * (s->end.v[k] - s->end.v[k + 1]);
    const double fast = larger(fabs(r0), fabs(r1)), away = larger(smaller(d0, d1), 0);
    if (!(away < search->reach * fast) || (d0 <= 0 && d1 <= 0 && !(r0 > 0 && r1 < 0)))
        return (struct effect){0, 0};
    const double w = larger(inverse_mass(s, k), inverse_mass(s, k + 1)), near = 1 + away / (nearby * fast);
    const double least = search->least * (fast < search->usual ? fast / search->usual : 1) * (near * near * near);
    const double change = s->h * w * s->chain->law->force(s->table.stiffness[k], s->table.law, fast),
                 effect = spoilt * change / least;
    return (struct effect){effect, left_over * (s->h * change / fast) * effect};
}

/* More than there is room for: hardly, and steps so long have no accuracy that could be lost. */
static void add(struct bead_branch_points *p, const struct bead_stepper *s, double rate, struct bead_branch_point point)
{
    const size_t k = point.contact;
    if (p->count == p->room)
        return;
    const double w = larger(inverse_mass(s, k), inverse_mass(s, k + 1));
    point.weight = s->h * s->h * w * s->chain->law->stiffness(s->table.stiffness[k], s->table.law, fabs(rate));
    p->point[p->count++] = point;
}

/* Whether the motion at an end of the step, a parabola, never comes to zero. */
static bool misses(const double end[3])
{
    return end[1] * end[1] < 2 * end[2] * end[0];
}

static void find_in_contact(struct bead_branch_points *p, const struct bead_stepper *s, size_t k, double reach, bool again)
{
    struct bead_patch_branch found[BEAD_BRANCHES_MAX];
    double a[3], b[3];
    end_of(s, &s->start, s->start.a, k, a);
    end_of(s, &s->end, s->last_a, k, b);
    const struct bead_polynomial d = bead_polynomial_quintic(a, b);
    const size_t count = bead_patch_branches(d.c, b, reach, found);
    for (size_t i = 0; i < count; i++) {
        const double at = found[i].s, rate = bead_polynomial_slope(&d, at);
        const bool blunt = (found[i].before && found[i].after) || (at < 0 && misses(a)) || (at > 1 && misses(b));
        struct bead_branch_point point = {
            .contact = k, .at = at, .side = -1, .again = again, .power = blunt ? 0 : p->rule.exponent};
        if (found[i].before)
            add(p, s, rate, point);
        point.side = 1;
        if (found[i].after)
            add(p, s, rate, point);
    }
}

/* ---- their forces ---- */

static double within_step(double x)
{
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

/* Until where a branch point's force is its own; it goes on behind the ends of the step. */
static double end_of_own(const struct bead_branch_points *p, size_t i)
{
    const struct bead_branch_point *b = &p->point[i], *next = b->side > 0 ? b + 1 : b - 1;
    const bool any = b->side > 0 ? i + 1 < p->count : i > 0;
    if (!any || next->contact != b->contact)
        return b->side * INFINITY;
    return next->side != b->side ? 0.5 * (b->at + next->at) : next->at;
}

/* Coefficients of Lagrange's polynomials of the nodes, [node][power]. Computed with 60 digits and rounded. */
static const double lagrange[BEAD_BRANCH_TERMS][BEAD_BRANCH_TERMS] = {
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

/* The compression of a contact as it is known so far. */
struct curve {
    const struct bead_branch_points *points;
    const struct bead_stepper *stepper;
    size_t contact;
    struct bead_branch_range near; /* those that are put right */
    struct bead_polynomial interpolated;
};

/* Where that is zero, by a step of Newton's. */
static double moved(const struct curve *c, const struct bead_branch_point *b)
{
    if (b->power == 0)
        return b->at;
    double d[2] = {bead_polynomial_value(&c->interpolated, b->at), bead_polynomial_slope(&c->interpolated, b->at)};
    bead_branch_points_correct_compression(c->points, c->stepper, c->near, c->contact, b->at, d);
    const double shift = -d[0] / d[1];
    return fabs(shift) < farthest ? b->at + shift : b->at;
}

/* From a polynomial in z to one in y = from + (1 - from) z. */
static void shift_polynomial(double c[BEAD_BRANCH_TERMS], double from)
{
    enum { N = BEAD_BRANCH_TERMS };
    double scale = 1;
    for (int i = 0; i < N; i++, scale /= 1 - from)
        c[i] *= scale;
    for (int i = 0; i < N; i++) {
        for (int j = N - 2; j >= i; j--)
            c[j] -= from * c[j + 1];
    }
}

/* The force's double integral, y = 0 to 1 being `length` steps, of which the first part, `from`, are outside of the step. */
static void find_integral(const struct curve *curve, struct bead_branch_point *b, double length, double from)
{
    const struct bead_stepper *s = curve->stepper;
    const double unit = s->h * s->h * (length * length);
    double c[BEAD_BRANCH_TERMS] = {0};
    for (size_t j = 0; j < BEAD_BRANCH_TERMS; j++) {
        const double y = from + (1 - from) * bead_gauss_node[j], x = b->base + b->side * (length * y);
        double d[2] = {bead_polynomial_value(&curve->interpolated, x), 0};
        bead_branch_points_correct_compression(curve->points, s, curve->near, b->contact, x, d);
        double force = unit * s->chain->law->force(s->table.stiffness[b->contact], s->table.law, d[0]);
        if (b->power > 0)
            force = from > 0 ? force / raise(y, b->power) : force * curve->points->over[j];
        for (size_t i = 0; i < BEAD_BRANCH_TERMS; i++)
            c[i] += force * lagrange[j][i];
    }
    if (from > 0)
        shift_polynomial(c, from);
    b->far[0] = b->far[1] = 0;
    for (size_t i = 0; i < BEAD_BRANCH_TERMS; i++) {
        const double e = b->power + (double)i;
        b->c[i] = c[i] / ((e + 1) * (e + 2));
        b->far[0] += b->c[i];
        b->far[1] += b->c[i] * (e + 2);
    }
}

/* Point i as it follows from the compression. */
static struct bead_branch_point shaped(const struct curve *curve, size_t i)
{
    struct bead_branch_point b = curve->points->point[i];
    const double until = end_of_own(curve->points, i);
    double at0[4], at1[4];
    b.at = moved(curve, &b);
    const double inside = within_step(b.at);
    if (fabs(b.at - inside) > far_outside)
        b.power = 0;
    b.base = b.power > 0 ? b.at : inside;
    const double length = b.side * (within_step(until) - b.base);
    b.slope = 0;
    memset(b.c, 0, sizeof b.c);
    memset(&b.taken, 0, sizeof b.taken);
    if (!(b.side * (within_step(until) - inside) > 0))
        return b;
    find_integral(curve, &b, length, b.side * (inside - b.base) / length);
    b.slope = b.side / length;
    b.ends = until > 0 && until < 1;
    integral(&b, 0, 4, at0);
    integral(&b, 1, 4, at1);
    b.taken = bead_polynomial_hermite(at0, at1);
    return b;
}

/* The beads of a contact that opens or closes push their other contacts: what F does to the force of contact k, which has no branch
 * point itself, is an F again, of two powers more. */
static void add_echo(struct bead_branch_points *p, const struct bead_stepper *s, const struct bead_branch_point *of, size_t k,
                     size_t bead)
{
    const struct bead_branch_range near = bead_branch_points_near(p, k);
    for (size_t i = near.first; i < near.last; i++) {
        if (p->point[i].contact == k)
            return;
    }
    const struct bead_polynomial d = bead_dense_compression(s, k);
    const double stiffness =
        s->chain->law->stiffness(s->table.stiffness[k], s->table.law, bead_polynomial_value(&d, within_step(of->at)));
    const double scale = s->h * s->h * stiffness * s->chain->inverse_mass[bead] / (of->slope * of->slope);
    struct bead_branch_point *echo = &p->point[p->count + p->echoes++];
    double at0[4], at1[4];
    *echo = *of;
    echo->contact = k;
    echo->power += 2;
    for (size_t i = 0; i < BEAD_BRANCH_TERMS; i++) {
        const double e = echo->power + (double)i;
        echo->c[i] *= scale / ((e + 1) * (e + 2));
    }
    integral(echo, 0, 4, at0);
    integral(echo, 1, 4, at1);
    echo->taken = bead_polynomial_hermite(at0, at1);
}

static void add_echoes(struct bead_branch_points *p, const struct bead_stepper *s)
{
    p->echoes = 0;
    for (size_t i = 0; i < p->count; i++) {
        const struct bead_branch_point *b = &p->point[i];
        if (!b->again || b->power == 0 || b->slope == 0 || b->ends)
            continue;
        if (b->contact > 0)
            add_echo(p, s, b, b->contact - 1, b->contact);
        if (b->contact + 1 < s->chain->contacts)
            add_echo(p, s, b, b->contact + 1, b->contact + 1);
    }
}

static void shape(struct bead_branch_points *p, const struct bead_stepper *s, size_t i, bool put_right)
{
    const size_t k = p->point[i].contact;
    struct curve curve = {p, s, k, {0, 0}, bead_dense_compression(s, k)};
    if (put_right)
        curve.near = bead_branch_points_near(p, k);
    p->point[i] = shaped(&curve, i);
}

void bead_branch_points_find(struct bead_branch_points *p, const struct bead_stepper *s, struct bead_part part, double reach,
                             double least)
{
    const size_t last = s->active < s->chain->contacts ? s->active : s->chain->contacts;
    const struct search search = {reach, least, usual_speed * fabs(s->chain->spec->striker_velocity) * s->h};
    p->count = 0;
    for (size_t k = part.from; p->room > 0 && k < last && k < part.to; k++) {
        const struct effect effect = effect_of(s, k, &search);
        if (effect.first > 1)
            find_in_contact(p, s, k, reach, effect.second > 1);
    }
    for (size_t i = 0; i < p->count; i++)
        shape(p, s, i, false);
    for (size_t i = 0; i < p->count; i++) {
        if (p->point[i].again)
            shape(p, s, i, true);
    }
    add_echoes(p, s);
}
