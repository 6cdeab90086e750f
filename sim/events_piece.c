/* Quadrature on a piece of the step that may begin or end at, or near, a branch point. */
#include <math.h>

#include "sim/events_patch.h"

enum { POWER_MAX = 5 };
/* Exponents are given by people, 1.4 rather than 7/5 to the bit. */
static const double same_exponent = 1e-9;

struct bead_patch_rule bead_patch_rule_make(const struct bead_law *law, const struct bead_law_spec *spec)
{
    struct bead_patch_rule rule = {2, law, spec, spec->kind != BEAD_LAW_POWER};
    if (rule.hertz)
        return rule;
    /* The smallest m that makes m p whole. Where none does, x^{m p + m - 1}, the integrand's first term, has with m = 4 enough
     * derivatives that 8 nodes do not feel the rest. */
    for (rule.power = 1; rule.power <= POWER_MAX; rule.power++) {
        double product = rule.power * spec->power;
        if (fabs(product - round(product)) < same_exponent)
            return rule;
    }
    rule.power = 4;
    return rule;
}

static double raise(double x, int power)
{
    double y = x;
    for (int i = 1; i < power; i++)
        y *= x;
    return y;
}

static double root(double x, int power)
{
    return power == 1 ? x : power == 2 ? sqrt(x) : pow(x, 1.0 / power);
}

/* weight_i so far is ds/dz at node z_i of [0, 1]. */
static void scale_weights(struct bead_patch_piece *piece)
{
    for (size_t i = 0; i < BEAD_GAUSS_NODES; i++)
        piece->weight[i] *= bead_gauss_weight[i];
}

/* s = from + length z: the double integral of g up to z_i is length^2 times that of (z_i - z) g. */
static void place_linear(struct bead_patch_piece *piece)
{
    const double length = piece->to - piece->from, square = length * length;
    for (size_t i = 0; i < BEAD_GAUSS_NODES; i++) {
        piece->s[i] = piece->from + length * bead_gauss_node[i];
        piece->weight[i] = length * bead_gauss_weight[i];
    }
    const double *in = &bead_gauss_twice[0][0];
    double *out = &piece->twice[0][0];
    for (size_t i = 0; i < BEAD_GAUSS_NODES * BEAD_GAUSS_NODES; i++)
        out[i] = square * in[i];
}

/* s = tau + sign x^2 with x = a + b z. Between nodes s_i - s = sign (x_i^2 - x^2) and ds = sign 2 b x dz, so the double integral up
 * to node i is that of (x_i^2 - x^2) 2 b x = b^2 (z_i - z) (2 a + b (z_i + z)) 2 (a + b z) = b^2 [4 a^2 (z_i - z) + 2 a b (z_i -
 * z)(z_i + 3 z) + b^2 2 z (z_i^2 - z^2)], three matrices that are known once and for all. */
static void place_square(double tau, struct bead_patch_piece *piece)
{
    const double sign = piece->from + piece->to >= 2 * tau ? 1 : -1;
    const double a = sqrt(fmax(sign * (piece->from - tau), 0)), b = sqrt(fmax(sign * (piece->to - tau), 0)) - a;
    const double square = b * b, twice = square * (4 * (a * a)), mixed = square * (2 * (a * b)), both = square * square;
    for (size_t i = 0; i < BEAD_GAUSS_NODES; i++) {
        double x = a + b * bead_gauss_node[i];
        piece->s[i] = tau + sign * (x * x);
        piece->weight[i] = sign * (2 * b * x) * bead_gauss_weight[i];
    }
    const double *t = &bead_gauss_twice[0][0], *m = &bead_gauss_twice_mixed[0][0], *s = &bead_gauss_twice_square[0][0];
    double *out = &piece->twice[0][0];
    for (size_t i = 0; i < BEAD_GAUSS_NODES * BEAD_GAUSS_NODES; i++)
        out[i] = (twice * t[i] + mixed * m[i]) + both * s[i];
}

/* s = tau + sign x^m: integrate twice with the matrix of single integrals, after multiplying by ds/dz each time. */
static void place_power(const struct bead_patch_rule *rule, double tau, struct bead_patch_piece *piece)
{
    const double sign = piece->from + piece->to >= 2 * tau ? 1 : -1;
    const double a = root(fmax(sign * (piece->from - tau), 0), rule->power);
    const double b = root(fmax(sign * (piece->to - tau), 0), rule->power) - a;
    for (size_t i = 0; i < BEAD_GAUSS_NODES; i++) {
        double x = a + b * bead_gauss_node[i];
        piece->s[i] = tau + sign * raise(x, rule->power);
        piece->weight[i] = sign * (rule->power * b * (rule->power > 1 ? raise(x, rule->power - 1) : 1));
    }
    for (size_t j = 0; j < BEAD_GAUSS_NODES; j++) {
        for (size_t i = 0; i < BEAD_GAUSS_NODES; i++) {
            double sum = 0;
            for (size_t l = 0; l < BEAD_GAUSS_NODES; l++)
                sum += bead_gauss_once[l][i] * piece->weight[l] * bead_gauss_once[j][l];
            piece->twice[j][i] = sum * piece->weight[j];
        }
    }
    scale_weights(piece);
}

void bead_patch_place(const struct bead_patch_rule *rule, double from, double to, const double *tau, struct bead_patch_piece *piece)
{
    piece->from = from;
    piece->to = to;
    if (!tau)
        place_linear(piece);
    else if (rule->power == 2)
        place_square(*tau, piece);
    else
        place_power(rule, *tau, piece);
}
