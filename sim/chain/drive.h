/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drives: a force on one bead of a chain, or its displacement, as a function of time. */
#pragma once

#include "sim/chain/chain_data.h"

/* A wave and its first three derivatives by time: N or m, over s, s^2, s^3. */
struct bead_wave_at {
    double x[4];
};

static inline bool bead_is_driven(const struct bead_chain_spec *spec)
{
    return spec->drive.force || spec->drive.displacement;
}

/* The second derivatives of a cubic spline with slope 0 at both ends, by the points' times and values: C. de Boor, A Practical
 * Guide to Splines (Springer, 1978), chapter IV. `work`: [count]. */
void bead_wave_spline(struct bead_wave_point *points, size_t count, double *work);
struct bead_wave_at bead_drive_at(const struct bead_chain *chain, double t);
/* The acceleration that a drive gives its bead, or adds to it if it is a force, m/s^2, and its derivative. */
void bead_drive_acceleration(const struct bead_chain *chain, double t, double a[2]);
/* Gives the driven bead this acceleration (order 0), or its derivative (1), beside the others that `a` has. */
void bead_drive_apply(const struct bead_chain *chain, double t, int order, double *a);
/* The first time behind t where a derivative up to the third jumps; INFINITY: there is none. */
double bead_drive_break(const struct bead_chain *chain, double t);
/* When the derivatives of a drive belong to a step from t0 to t1, at its end: where one jumps there, just before. */
double bead_drive_end(const struct bead_chain *chain, double t0, double t1);
/* The highest frequency of what a drive does at t where it is smooth, rad/s; that of splines is 0, because steps end at their
 * points. */
double bead_drive_omega(const struct bead_chain *chain, double t);
/* About the largest velocity that it can give its bead, m/s, whose mass is m and whose contacts have this coefficient. */
double bead_drive_speed(const struct bead_chain *chain, double mass, double stiffness);
