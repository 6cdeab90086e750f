/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Quadrature on the pieces of a step that events_body.h integrates again: the nodes and their matrices, and their places in a piece
 * that begins or ends at or near a branch point. */
#include <math.h>

#include "sim/integrate/events_patch.h"

/* Gauss-Legendre quadrature with 8 nodes on [0, 1], and integrals of the polynomial through values at its nodes: with l_j the
 * Lagrange polynomial of node j, the matrix is stored [j][i], to add to the sums at all nodes at once. Computed with 60 digits and
 * rounded. */

/* x_i and w_i */
alignas(64) const
    double bead_gauss_node[BEAD_GAUSS_NODES] = {0.019855071751231884, 0.10166676129318664, 0.2372337950418355, 0.4082826787521751,
                                                0.591717321247825,    0.7627662049581645,  0.8983332387068134, 0.9801449282487681};

alignas(64) const double bead_gauss_weight[BEAD_GAUSS_NODES] = {0.05061426814518813, 0.11119051722668724, 0.15685332293894363,
                                                                0.181341891689181,   0.181341891689181,   0.15685332293894363,
                                                                0.11119051722668724, 0.05061426814518813};

/* integral of l_j from 0 to x_i */
alignas(64) const double bead_gauss_once[BEAD_GAUSS_NODES][BEAD_GAUSS_NODES] = {
    {0.025307134072594065, 0.05475932176755432, 0.048587535998912884, 0.05186552097058123, 0.04975503156092328,
     0.051233073840438646, 0.05017146584084589, 0.05089177647230505},
    {-0.009105943305970076, 0.05559525861334362, 0.12085952499717317, 0.1061934901483484, 0.114388331537048, 0.10896480245140233,
     0.11275545213763617, 0.11021775956262797},
    {0.006280831147030474, -0.01363979623578167, 0.07842666146947182, 0.17067113427455363, 0.14961211637772137, 0.16149678880104812,
     0.15371356995347998, 0.1587709981935806},
    {-0.004483015613054752, 0.008149708858360551, -0.01597510336187843, 0.0906709458445905, 0.197362933010206, 0.17297015896895482,
     0.18655724377832814, 0.17826340032085422},
    {0.0030784913683267797, -0.0052153520891471536, 0.008371732720226163, -0.016021041321025012, 0.0906709458445905,
     0.19731699505105943, 0.17319218283082044, 0.18582490730223575},
    {-0.0019176752546369523, 0.003139752985463669, -0.00464346586210448, 0.00724120656122227, -0.013817811335609978,
     0.07842666146947182, 0.17049311917472532, 0.15057249179191318},
    {0.0009727576640592635, -0.0015649349109489424, 0.0022257147752849, -0.0031978143103607703, 0.004997027078338829,
     -0.009669007770485932, 0.05559525861334362, 0.12029646053265731},
    {-0.0002775083271169192, 0.00044280230434223783, -0.0006188056952505154, 0.0008592365842648527, -0.001251252825393105,
     0.0020267321462752487, -0.004145053622366191, 0.025307134072594065},
};

/* An exponent given as 1.4 differs from 7/5 in the last bit. */
static const double same_exponent = 1e-9;

struct bead_patch_rule bead_patch_rule_make(const struct bead_law_spec *spec, double exponent)
{
    struct bead_patch_rule rule = {2, exponent, spec->row, spec, spec->row->hertz};
    /* The smallest m that makes m p whole. If there is none, m = 4 gives x^{m p + m - 1}, the first term of the integrand, enough
     * derivatives for 8 nodes. */
    for (rule.power = 1; rule.power <= BEAD_POWER_MAX; rule.power++) {
        double product = rule.power * rule.exponent;
        if (fabs(product - round(product)) < same_exponent)
            return rule;
    }
    rule.power = 4;
    return rule;
}

static double root(double x, int power)
{
    return power == 1 ? x : power == 2 ? sqrt(x) : pow(x, 1.0 / power);
}

struct bead_patch_piece bead_patch_piece_make(int power, const double *tau, double from, double to)
{
    const int m = tau ? power : 1;
    const double at = tau ? *tau : from, sign = from + to >= 2 * at ? 1 : -1;
    const double a = root(fmax(sign * (from - at), 0), m), b = root(fmax(sign * (to - at), 0), m) - a;
    return (struct bead_patch_piece){from, to, at, sign, a, b, m};
}

double bead_patch_find(const struct bead_patch_piece *piece, double s)
{
    const double x = root(fmax(piece->sign * (s - piece->tau), 0), piece->power);
    return piece->b != 0 ? (x - piece->a) / piece->b : 0;
}
