/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Patches: the few contacts around one that opens or closes, integrated again over one step.
 *
 * Time is counted in steps, s = (t - t0)/h from 0 to 1, and d' means dd/ds: all numbers then follow the exact scaling of
 * Hertz's chain (v x 32, t / 2, d x 16) by powers of two, to the bit. */
#ifndef BEADREEL_SIM_INTEGRATE_EVENTS_PATCH_H
#define BEADREEL_SIM_INTEGRATE_EVENTS_PATCH_H

#include <stdalign.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/law.h"

enum { BEAD_GAUSS_NODES = 8 };

/* What a branch point inside the step, rate r, does to the velocity of a bead is less than this times A (h r)^{3/2} h/m. */
#define BEAD_EFFECT_INSIDE 0.01
/* The same for one x steps outside: less than this over (1 + x/0.03)^3 (1 + x/2)^4, at least 5 times what RKN8's quadrature of
 * (s + x)^{3/2} over 0 <= s <= 1 loses. */
#define BEAD_EFFECT_OUTSIDE 3e-4
#define BEAD_EFFECT_DECAY   0.03

extern const double bead_gauss_node[BEAD_GAUSS_NODES], bead_gauss_weight[BEAD_GAUSS_NODES];
extern const double bead_gauss_once[BEAD_GAUSS_NODES][BEAD_GAUSS_NODES], bead_gauss_twice[BEAD_GAUSS_NODES][BEAD_GAUSS_NODES],
    bead_gauss_twice_mixed[BEAD_GAUSS_NODES][BEAD_GAUSS_NODES], bead_gauss_twice_square[BEAD_GAUSS_NODES][BEAD_GAUSS_NODES];

/* Quantities of the contacts of a patch, an array each. */
enum bead_patch_array {
    BEAD_PATCH_C, /* d(s) = sum c_i s^i, m: quintic Hermite over the step just made, from d, d', d'' at both ends; 6 arrays */
    BEAD_PATCH_END_D = BEAD_PATCH_C + 6, /* d and d' at the end of the step */
    BEAD_PATCH_END_RATE,
    BEAD_PATCH_D, /* the same at the start of the piece at hand */
    BEAD_PATCH_RATE,
    BEAD_PATCH_STIFFNESS,
    BEAD_PATCH_STATIC_FORCE,
    BEAD_PATCH_LEFT, /* h^2/m of the two beads; 0 for the wall */
    BEAD_PATCH_RIGHT,
    BEAD_PATCH_IMPULSE, /* N: integrals of f ds and of (1 - s) f ds over the pieces done ... */
    BEAD_PATCH_MOMENT,
    BEAD_PATCH_GIVEN_IMPULSE, /* ... and what the method's quadrature took for them over the whole step */
    BEAD_PATCH_GIVEN_MOMENT,
    BEAD_PATCH_ARRAYS
};

/* Contacts 1..count; 0 and count + 1 are frozen, their forces follow from the quintic. Arrays have room for whole vectors. */
struct bead_patch {
    size_t count, room;
    double *array[BEAD_PATCH_ARRAYS];
    double *force, *curvature; /* BEAD_GAUSS_NODES each: at the nodes of the piece at hand, f less its static part, N, and d'', m */
    bool *closed;              /* in the piece at hand */
    uint32_t *pushing;         /* those contacts, in order */
    bool *bends;               /* opens, closes or is about to */
    double enough, much;       /* m: Picard steps end where the first, or a later one, changes no h^2 f/m by more */
    double change;             /* m: largest h^2/m |f - f before| at a node in the last Picard sweep */
    void *memory;
};

/* What load_patch needs of a step: states at both ends and constants of the contacts; stages are the forces that the method's
 * quadrature adds up, with weights for the impulse and its moment. */
enum { BEAD_PATCH_STAGES_MAX = 18 };
struct bead_patch_source {
    const double *u0, *v0, *a0, *u1, *v1, *a1;
    const double *stiffness, *static_compression, *static_force, *inverse_mass;
    double h;
    size_t stages;
    const double *stage[BEAD_PATCH_STAGES_MAX];
    double impulse[BEAD_PATCH_STAGES_MAX], moment[BEAD_PATCH_STAGES_MAX];
};

/* Contacts that have a branch point in the step, or near it. Arrays have room for a vector before and two behind what is asked. */
struct bead_event_flags {
    double *d0, *r0, *d1, *r1; /* m: of all contacts, compressions at both ends of the step, and their rates times h */
    size_t *contact;           /* those that matter, in order */
    double *effect;            /* m/s: what each of them can do to a velocity, at most */
};

/* How s = tau +- x^m takes the branch point out of (s - tau)^p: m p should be a whole number. For Hertz's p = 3/2, m = 2. */
struct bead_patch_rule {
    int power;       /* m */
    double exponent; /* p */
    const struct bead_law *law;
    const struct bead_law_spec *spec;
    bool hertz; /* A d^{3/2}, without calling the law */
};
struct bead_patch_rule bead_patch_rule_make(const struct bead_law *law, const struct bead_law_spec *spec);

/* Which branch points matter. */
struct bead_event_limits {
    const struct bead_patch_rule *rule;
    const double *hardness;  /* A/m, m the lighter bead's, of the contacts, times their weights */
    double reach, tolerance; /* so many steps outside; effects of more, m/s */
    double slow;             /* m: rates times h that are too small to do so much anywhere in the chain */
};

/* How fast the contacts have been, and what their events count for that: all arrays have room for whole vectors. */
struct bead_event_speeds {
    double *most;           /* m/s: fastest rate of the compression so far */
    double *known;          /* m/s: that rate when it was weighed last; 0: not yet */
    double *weighed;        /* A/m times the weight, `unit` over that rate, at least 1 */
    const double *hardness; /* A/m */
    double unit, least;     /* m/s: what tolerances are of; rates below the least are not weighed */
};

/* A part of the step in which every force of the patch is analytic in the variable that places the nodes. */
struct bead_patch_piece {
    alignas(64) double s[BEAD_GAUSS_NODES];           /* nodes */
    double weight[BEAD_GAUSS_NODES];                  /* integral of g ds = sum weight_i g(s_i) */
    double twice[BEAD_GAUSS_NODES][BEAD_GAUSS_NODES]; /* double integral up to node i = sum_j twice[j][i] g(s_j) */
    double from, to;
};
/* Nodes between two ends where s = tau +- x^m, and ds/dz, z from 0 to 1 over them. */
struct bead_patch_nodes {
    double s[BEAD_GAUSS_NODES], rate[BEAD_GAUSS_NODES];
};
void bead_patch_place_nodes(int power, double tau, const double ends[2], struct bead_patch_nodes *nodes);
/* The same of a piece. */
void bead_patch_place_power(int power, double tau, struct bead_patch_piece *piece);

/* Where, in s, a force has a branch point, or nearly one; may lie outside the step. */
struct bead_patch_branch {
    double s;
    bool before, after; /* which side of it must not be integrated as if it were smooth */
};
enum { BEAD_BRANCHES_MAX = 8 }; /* a quintic's 5 roots, or extrema in their place, and one outside at either end */

/* Branch points of d(s) = sum c_i s^i with d and d' at the end given to the last bit; `reach`: how far outside the step they
 * matter. Returns how many. */
size_t bead_patch_branches(const double c[6], const double end[2], double reach,
                           struct bead_patch_branch branch[BEAD_BRANCHES_MAX]);

/* Value of the quintic. */
static inline double bead_patch_value(const double c[6], double s)
{
    return c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * (c[4] + s * c[5]))));
}

#endif
