/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Patches: a few contacts around one that opens or closes, integrated again over one step.
 *
 * Time is counted in steps, s = (t - t0)/h from 0 to 1, and d' means dd/ds: all numbers then follow the exact scaling of
 * Hertz's chain (v x 32, t / 2, d x 16) by powers of two, to the bit. */
#pragma once

#include <stdalign.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/law.h"

enum { BEAD_GAUSS_NODES = 8 };

/* Upper bound of the effect of a branch point inside the step, with rate r, on the velocity of a bead, in units of A (h r)^{3/2}
 * h/m.
 */
#define BEAD_EFFECT_INSIDE 0.01
/* Bound for a branch point x steps outside: this over (1 + x/0.03)^3 (1 + x/2)^4, at least 5 times the error of RKN8's quadrature
 * of (s + x)^{3/2} over 0 <= s <= 1. */
#define BEAD_EFFECT_OUTSIDE 3e-4
#define BEAD_EFFECT_DECAY   0.03

extern const double bead_gauss_node[BEAD_GAUSS_NODES], bead_gauss_weight[BEAD_GAUSS_NODES];
extern const double bead_gauss_once[BEAD_GAUSS_NODES][BEAD_GAUSS_NODES];

/* Quantities of the contacts of a patch, an array for each. */
enum bead_patch_array {
    BEAD_PATCH_C, /* d(s) = sum c_i s^i, m: quintic Hermite over the last step, from d, d', d'' at both ends; 6 arrays */
    BEAD_PATCH_END_D = BEAD_PATCH_C + 6, /* d and d' at the end of the step */
    BEAD_PATCH_END_RATE,
    BEAD_PATCH_D, /* the same at the start of the current piece */
    BEAD_PATCH_RATE,
    BEAD_PATCH_STIFFNESS,
    BEAD_PATCH_STATIC_FORCE,
    BEAD_PATCH_LEFT, /* h^2/m of the two beads; 0 for the wall */
    BEAD_PATCH_RIGHT,
    BEAD_PATCH_IMPULSE, /* N: integrals of f ds and of (1 - s) f ds over the pieces so far */
    BEAD_PATCH_MOMENT,
    BEAD_PATCH_GIVEN_IMPULSE, /* N: the same by the method's quadrature over the whole step */
    BEAD_PATCH_GIVEN_MOMENT,
    BEAD_PATCH_PULL, /* h^2 (a_k - a_{k+1}) from springs that hold beads in place, m: cubic Hermite over the step; 4 arrays */
    BEAD_PATCH_PULL_END = BEAD_PATCH_PULL + 3,
    BEAD_PATCH_ARRAYS
};

/* Contacts 1..count; 0 and count + 1 are frozen: their forces follow from the quintic. Arrays have room for whole vectors. */
struct bead_patch {
    size_t count;
    double *array[BEAD_PATCH_ARRAYS];
    const double *pulled;           /* NULL: no bead is held in place, and BEAD_PATCH_PULL is not set */
    ptrdiff_t driven;               /* the contact whose left bead has a drive; outside 1..count + 1: none here */
    double drive[BEAD_GAUSS_NODES]; /* m: h^2 times the acceleration that it gives the bead, at the nodes of the current piece */
    double *force, *curvature; /* BEAD_GAUSS_NODES each: at the nodes of the current piece, f less its static part, N, and d'', m */
    bool *closed;              /* in the current piece */
    uint32_t *pushing;         /* the closed contacts, in order */
    bool *bends;               /* opens, closes or is about to */
    double enough, much;       /* m: Picard steps end when the first, or a later one, changes no h^2 f/m by more */
    double change;             /* m: largest change of h^2/m f at a node in the last Picard sweep */
    void *memory;
};

/* True if a bead of the contacts that are not frozen has a drive. */
static inline bool bead_patch_drives(const struct bead_patch *patch)
{
    return patch->driven >= 1 && (size_t)patch->driven <= patch->count + 1;
}

/* Data of a step for load_patch: states at both ends and constants of the contacts; stages are the forces in the method's
 * quadrature, with weights for the impulse and its moment. */
enum { BEAD_PATCH_STAGES_MAX = 18 };
struct bead_patch_source {
    const double *u0, *v0, *a0, *u1, *v1, *a1;
    const double *stiffness, *static_compression, *static_force, *inverse_mass;
    const double *pull; /* 1/s^2, or NULL: see bead_stepper */
    double h;
    size_t stages;
    const double *stage[BEAD_PATCH_STAGES_MAX];
    double impulse[BEAD_PATCH_STAGES_MAX], moment[BEAD_PATCH_STAGES_MAX];
};

/* Contacts that have a branch point in the step, or near it. Arrays have room for one vector more before and two after. */
struct bead_event_flags {
    double *d0, *r0, *d1, *r1; /* m: of all contacts, compressions at both ends of the step, and their rates times h */
    size_t *contact;           /* those that matter, in order */
    double *effect;            /* m/s: the largest effect of each on a velocity */
};

/* s = tau +- x^m removes the branch point from (s - tau)^p: m p should be a whole number. For Hertz's p = 3/2, m = 2. */
struct bead_patch_rule {
    int power;       /* m */
    double exponent; /* p */
    const struct bead_law *law;
    const struct bead_law_spec *spec;
    bool hertz; /* A d^{3/2}, without calling the law */
};
struct bead_patch_rule bead_patch_rule_make(const struct bead_law_spec *spec, double exponent);

/* Limits within which branch points matter. */
struct bead_event_limits {
    const struct bead_patch_rule *rule;
    const double *hardness;  /* A/m of the contacts, with the mass m of the lighter bead, times their weights */
    double outside, decay;   /* in place of BEAD_EFFECT_OUTSIDE and BEAD_EFFECT_DECAY */
    double reach, tolerance; /* distance outside, in steps; effects up to this, m/s, do not matter */
    double slow;             /* m: smaller rates times h matter nowhere in the chain */
};

/* Speeds of the contacts, and the weights of their events. All arrays have room for whole vectors. */
struct bead_event_speeds {
    double *most;           /* m/s: fastest rate of the compression so far */
    double *known;          /* m/s: that rate when it was last weighed; 0: not yet */
    double *weighed;        /* A/m times the weight, which is `unit` over that rate, at least 1 */
    const double *hardness; /* A/m */
    double unit, least;     /* m/s: speed of weight 1; slower rates than `least` are not weighed */
};

/* A part of the step in which every force of the patch is analytic in z, from 0 to 1: s = tau + sign x^m, x = a + b z, with the
 * branch point tau at or near one end; without one m = 1. */
struct bead_patch_piece {
    double from, to, tau, sign, a, b;
    int power; /* m */
};
/* The largest m. */
enum { BEAD_POWER_MAX = 5 };
/* tau NULL: no branch point is near. */
struct bead_patch_piece bead_patch_piece_make(int power, const double *tau, double from, double to);
/* z at s within the piece. */
double bead_patch_find(const struct bead_patch_piece *piece, double s);
/* s at z, and ds/dz. */
static inline double bead_patch_place(const struct bead_patch_piece *piece, double z, double *rate)
{
    const double x = piece->a + piece->b * z;
    double less = 1;
    for (int i = 1; i < piece->power; i++)
        less *= x;
    *rate = piece->sign * (piece->power * piece->b * less);
    return piece->tau + piece->sign * (x * less);
}

/* A branch point of a force, or nearly one; s may lie outside the step. */
struct bead_patch_branch {
    double s;
    bool before, after; /* the sides on which the force is not smooth */
    size_t contact;     /* of the chain */
};
enum { BEAD_BRANCHES_MAX = 8 }; /* a quintic's 5 roots, or extrema in their place, and one outside at either end */

/* Branch points of d(s) = sum c_i s^i with exact d and d' at the end, up to `reach` outside the step. Returns their number. */
size_t bead_patch_branches(const double c[6], const double end[2], double reach,
                           struct bead_patch_branch branch[BEAD_BRANCHES_MAX]);

static inline double bead_patch_value(const double c[6], double s)
{
    return c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * (c[4] + s * c[5]))));
}
