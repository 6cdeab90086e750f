/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Branch points: where a contact opens or closes in a step, or near it, and what they do to the motion between its ends.
 *
 * A force d^p, d > 0, has a branch point where d crosses zero: beads then move like y^{p+2}, y from there on. The Hermite
 * interpolants of dense output know nothing of that; next to a branch point they are off by 1e-3 h f/m, f the force a step's length
 * from it, whatever the accuracy of the step. Here that is put right. Next to its branch point the force is y^p times a smooth
 * function, a polynomial through its values at some nodes, whose double integral F over time is known in closed form. Interpolation
 * makes of F the Hermite polynomial H; so F - H, over the masses and with opposite signs, is what it owes the two beads.
 *
 * The compression, which both the branch point and the force follow from, is interpolated, too: in a second round it is the one put
 * right in the first. What F does to the forces of the contacts beside it is put right in the same way: its echoes. */
#ifndef BEADREEL_SIM_INTEGRATE_BRANCH_POINTS_H
#define BEADREEL_SIM_INTEGRATE_BRANCH_POINTS_H

#include "sim/integrate/events_patch.h"
#include "sim/integrate/polynomial.h"
#include "sim/integrate/stepper.h"

/* With fewer, a force that has no branch point would be one that septic interpolation follows. */
enum { BEAD_BRANCH_TERMS = BEAD_GAUSS_NODES, BEAD_BRANCH_SIDES = 2 };

struct bead_branch_point {
    size_t contact;
    double at;     /* in steps from the start */
    double side;   /* the contact is closed behind it (+1) or before (-1); one that nearly opens has a pair of both */
    double weight; /* h^2 K/m of the stiffness a step's length from it */
    bool again;    /* a second round is worth it */
    /* F = y^{power + 2} sum c_i y^i, kg m, y = slope (x - base): from 0 to 1 over the part of the step that is this branch point's.
     * The power is p, or 0 for what is too far outside, or not quite a branch point; base is `at`, or an end of the step. */
    double power, base, slope, c[BEAD_BRANCH_TERMS];
    bool ends;                    /* at y = 1, and is linear from there on: what follows is another branch point's, or nil */
    double far[2];                /* F and dF/dy there */
    struct bead_polynomial taken; /* H, in x */
};

struct bead_branch_points {
    struct bead_patch_rule rule;
    double over[BEAD_BRANCH_TERMS];  /* z^-p of the nodes z */
    struct bead_branch_point *point; /* by contacts, then times */
    size_t count, room;
    size_t echoes; /* behind them: what they do to contacts beside them */
};

/* For steps of this chain, without damping; none are ever found where no contact opens, or where the law is no power. Errors:
 * MEMORY.
 */
BEAD_CHECK enum bead_error bead_branch_points_create(const struct bead_chain *chain, struct bead_branch_points *points,
                                                     struct bead_message *msg);
void bead_branch_points_destroy(struct bead_branch_points *points);
/* Those of the step just made, of contacts of a part of the beads, at most `reach` steps outside; not those that can spoil no
 * velocity by `least`, m/s, or by so much less as their contact is slower than most. */
void bead_branch_points_find(struct bead_branch_points *points, const struct bead_stepper *stepper, struct bead_part part,
                             double reach, double least);
/* Put interpolated displacements u at t0 + x h right, and velocities v (NULL: there are none), of a part of the beads. */
void bead_branch_points_correct(const struct bead_branch_points *points, const struct bead_stepper *stepper, double x,
                                struct bead_part part, double *u, double *v);
/* The branch points of a contact and its neighbours: first..last - 1. */
struct bead_branch_range {
    size_t first, last;
};
struct bead_branch_range bead_branch_points_near(const struct bead_branch_points *points, size_t contact);
/* The same for the interpolated compression d[0] of a contact, m, and its derivative d[1] by x. */
void bead_branch_points_correct_compression(const struct bead_branch_points *points, const struct bead_stepper *stepper,
                                            struct bead_branch_range near, size_t contact, double x, double d[2]);

#endif
