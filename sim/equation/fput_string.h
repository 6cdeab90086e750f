/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The string of Fermi, Pasta, Ulam and Tsingou: unit masses between springs of unit length and stiffness.
 *
 * Spring j is left of mass j. With fixed ends there is one more at the right end; with periodic ones spring 0 joins the last mass
 * and the first. Tension of a spring stretched by r: r + alpha r^2 + beta r^3, so that
 * u_j'' = T(r_{j+1}) - T(r_j), which for beta = 0 is (u_{j+1} + u_{j-1} - 2 u_j) (1 + alpha (u_{j+1} - u_{j-1})), Eq. 5 of the
 * thesis. Where |r| is above `beyond`, a piecewise linear string adds (stiffness - 1) (|r| - beyond), with the sign of r: the third
 * force of Fermi, Pasta and Ulam (1955). r_j = u_j - u_{j-1} + stretch; the stretch is the distance of the ends beyond the springs'
 * total length, per spring. */
#pragma once

#include "sim/equation/equation.h"
#include "sim/integrate/stepper.h"

struct bead_string {
    const struct bead_equation_spec *spec;
    size_t masses, springs;
    double stretch;
    double *tension; /* [masses + 1], work */
    double *branch;  /* [springs] of the last step: 1 stretched beyond, -1 compressed beyond, 0 neither */
};

struct bead_string_state {
    double t, *u, *v, *a; /* [masses] */
};

/* A string and its states at both ends of a step; all arrays are in one block of memory. */
struct bead_string_stepper {
    struct bead_string string;
    const struct bead_method *method;
    struct bead_string_state start, end;
    double *stage[BEAD_STAGES_MAX]; /* [masses] accelerations */
    double *y, *w[3];               /* [masses] work */
    double *jerk[2];                /* [masses], at both ends of step `jerk_step` */
    uint64_t steps, evaluations, jerk_step;
    double *memory;
};

/* A string at rest, all zero. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_string_create(const struct bead_equation_spec *spec, const struct bead_method *method,
                                              struct bead_string_stepper *stepper, struct bead_message *msg);
void bead_string_destroy(struct bead_string_stepper *stepper);
/* Call this after setting end.u and end.v. */
void bead_string_begin(struct bead_string_stepper *stepper);
/* Make one step of h, to time t; the old end becomes the start. Steps end where a spring passes `beyond`, so that forces are smooth
 * within them: false if this one did, before t. */
bool bead_string_step(struct bead_string_stepper *stepper, double h, double t);
/* u and v [masses] at a time within the last step: septic Hermite. */
void bead_string_between(struct bead_string_stepper *stepper, double t, double *u, double *v);
/* Place of mass 0; `low` is the place of the left end, or on a ring of mass 0. */
double bead_string_first(const struct bead_equation_spec *spec);
/* Difference of any quantity of the masses across spring j, and the spring's stretch. */
static inline double bead_string_difference(const struct bead_string *s, const double *x, size_t j)
{
    double left = j > 0 ? x[j - 1] : s->spec->ends == BEAD_ENDS_PERIODIC ? x[s->masses - 1] : 0, right = j < s->masses ? x[j] : 0;
    return right - left;
}
static inline double bead_string_strain(const struct bead_string *s, const double *u, size_t j)
{
    return bead_string_difference(s, u, j) + s->stretch;
}
/* Energy of a spring above that in the string at rest, less the work against the tension there. */
double bead_string_spring_energy(const struct bead_string *string, double strain);
double bead_string_energy(const struct bead_string *string, const double *u, const double *v);
/* Displacements and velocities of the start in the spec; sets the stretch. */
void bead_string_start(struct bead_string *string, double *u, double *v);
/* dT/dr of a spring on its branch, and on that of its strain. */
double bead_string_slope(const struct bead_equation_spec *spec, double branch, double strain);
double bead_string_branch(const struct bead_equation_spec *spec, double strain);

/* ---- kinks of piecewise linear strings ---- */

/* A spring leaves its branch when sign * strain is above `limit`. */
struct bead_string_kink {
    double at; /* in steps from the start; INFINITY: there is none in this step */
    size_t spring;
    double sign, limit;
};
/* The first in the last step; needs the jerks. */
struct bead_string_kink bead_string_first_kink(const struct bead_string_stepper *stepper);
/* The spring's distance from the kink, as a time: Newton's correction of the step. */
double bead_string_from_kink(const struct bead_string_stepper *stepper, const struct bead_string_kink *kink);
/* Puts the springs at the end of the last step on the branches of the next one. */
void bead_string_settle(struct bead_string_stepper *stepper);
