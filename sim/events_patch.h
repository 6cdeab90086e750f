/* Patches: the few contacts around one that opens or closes, integrated again over one step.
 *
 * Time is counted in steps, s = (t - t0)/h from 0 to 1, and d' means dd/ds: all numbers then follow the exact scaling of
 * Hertz's chain (v x 32, t / 2, d x 16) by powers of two, to the bit. */
#ifndef BEADREEL_SIM_EVENTS_PATCH_H
#define BEADREEL_SIM_EVENTS_PATCH_H

#include <stdalign.h>
#include <stdbool.h>
#include <stddef.h>

#include "beadreel/law.h"

enum { BEAD_GAUSS_NODES = 8 };

extern const double bead_gauss_node[BEAD_GAUSS_NODES], bead_gauss_weight[BEAD_GAUSS_NODES];
extern const double bead_gauss_once[BEAD_GAUSS_NODES][BEAD_GAUSS_NODES], bead_gauss_twice[BEAD_GAUSS_NODES][BEAD_GAUSS_NODES],
    bead_gauss_twice_mixed[BEAD_GAUSS_NODES][BEAD_GAUSS_NODES], bead_gauss_twice_square[BEAD_GAUSS_NODES][BEAD_GAUSS_NODES];

/* One contact of a patch. */
struct bead_patch_contact {
    alignas(64) double force[BEAD_GAUSS_NODES]; /* N, less the static force: at the nodes of the piece at hand */
    double c[6];                                /* d(s) = sum c_i s^i: quintic Hermite over the step just made */
    double end[2];                              /* m: d and d' at the end of the step */
    double d, rate;                             /* m: the same at the start of the piece at hand */
    double stiffness, static_force;
    double left, right;     /* h^2/m of its two beads; 0 for the wall */
    double impulse, moment; /* N: integrals of f ds and of (1 - s) f ds over the pieces done */
    double change, last;    /* N: what the last Picard sweep changed in the impulse: over the pieces done, over that at hand */
    bool closed;            /* in the piece at hand */
    bool bends;             /* flagged: opens, closes or is about to */
};

/* A part of the step in which every force of the patch is analytic in the variable that places the nodes. */
struct bead_patch_piece {
    alignas(64) double s[BEAD_GAUSS_NODES];           /* nodes */
    double weight[BEAD_GAUSS_NODES];                  /* integral of g ds = sum weight_i g(s_i) */
    double twice[BEAD_GAUSS_NODES][BEAD_GAUSS_NODES]; /* double integral up to node i = sum_j twice[j][i] g(s_j) */
    double from, to;
};

/* Where, in s, a force has a branch point, or nearly one; may lie outside the step. */
struct bead_patch_branch {
    double s;
    bool before, after; /* which side of it must not be integrated as if it were smooth */
};

enum { BEAD_BRANCHES_MAX = 8 }; /* a quintic's 5 roots, or extrema in their place, and one outside at either end */

/* Quintic Hermite of d, d', d'' at both ends. */
void bead_patch_hermite(struct bead_patch_contact *contact, const double start[3], const double end[3]);
/* Branch points of a flagged contact; `reach`: how far outside the step they matter. Returns how many. */
size_t bead_patch_branches(const struct bead_patch_contact *contact, double reach,
                           struct bead_patch_branch branch[BEAD_BRANCHES_MAX]);

/* How t = tau +- x^m takes the branch point out of (t - tau)^p: m p should be a whole number. For Hertz's p = 3/2, m = 2. */
struct bead_patch_rule {
    int power; /* m */
    const struct bead_law *law;
    const struct bead_law_spec *spec;
    bool hertz; /* A d^{3/2}, without calling the law */
};
struct bead_patch_rule bead_patch_rule_make(const struct bead_law *law, const struct bead_law_spec *spec);

/* Nodes of the piece [from, to]; `tau` is the branch point at or near one of its ends, NULL where there is none. */
void bead_patch_place(const struct bead_patch_rule *rule, double from, double to, const double *tau,
                      struct bead_patch_piece *piece);

/* Value and slope of the quintic. */
static inline double bead_patch_value(const double c[6], double s)
{
    return c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * (c[4] + s * c[5]))));
}

static inline double bead_patch_slope(const double c[6], double s)
{
    return c[1] + s * (2 * c[2] + s * (3 * c[3] + s * (4 * c[4] + s * (5 * c[5]))));
}

#endif
