/* Quadrature on a piece of the step that may begin or end at, or near, a branch point. */
#include <math.h>

#include "sim/integrate/events_patch.h"

enum { POWER_MAX = 5 };
/* Exponents are given by people, 1.4 rather than 7/5 to the bit. */
static const double same_exponent = 1e-9;

struct bead_patch_rule bead_patch_rule_make(const struct bead_law *law, const struct bead_law_spec *spec)
{
    struct bead_patch_rule rule = {2, law->exponent(spec), law, spec, law->hertz};
    /* The smallest m that makes m p whole. Where none does, x^{m p + m - 1}, the integrand's first term, has with m = 4 enough
     * derivatives that 8 nodes do not feel the rest. */
    for (rule.power = 1; rule.power <= POWER_MAX; rule.power++) {
        double product = rule.power * rule.exponent;
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

void bead_patch_place_power(int power, double tau, struct bead_patch_piece *piece)
{
    const double sign = piece->from + piece->to >= 2 * tau ? 1 : -1;
    const double a = root(fmax(sign * (piece->from - tau), 0), power), b = root(fmax(sign * (piece->to - tau), 0), power) - a;
    double rate[BEAD_GAUSS_NODES]; /* ds/dz */
    for (size_t i = 0; i < BEAD_GAUSS_NODES; i++) {
        double x = a + b * bead_gauss_node[i];
        piece->s[i] = tau + sign * raise(x, power);
        rate[i] = sign * (power * b * (power > 1 ? raise(x, power - 1) : 1));
        piece->weight[i] = rate[i] * bead_gauss_weight[i];
    }
    for (size_t j = 0; j < BEAD_GAUSS_NODES; j++) {
        for (size_t i = 0; i < BEAD_GAUSS_NODES; i++) {
            double sum = 0;
            for (size_t l = 0; l < BEAD_GAUSS_NODES; l++)
                sum += bead_gauss_once[l][i] * rate[l] * bead_gauss_once[j][l];
            piece->twice[j][i] = sum * rate[j];
        }
    }
}
