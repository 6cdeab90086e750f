/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equations: how systems other than beads move, one const table each.
 *
 * The unknown is given at equidistant points x_0 < x_1 < ...; its samples are those of a chain with as many beads, so sinks and
 * views need not know the equation. Numbers have no units: time, length and the unknown are those of the equation. Results must not
 * depend on sample times: steps depend on the state only. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/sample.h"
#include "beadreel/scene.h"
#include "beadreel/sink.h"
#include "sim/chain/system.h"

struct bead_motion; /* each equation's own state */

struct bead_motion_settings {
    const struct bead_equation_spec *spec;
    size_t points;      /* by the system's `count` */
    const char *method; /* "auto", or one of the equation's `methods` */
    double accuracy;    /* relative error allowed in the unknown at the end of the run */
    double step;        /* 0: by the accuracy */
    double end;         /* of the run: the last step ends there; INFINITY: unknown */
    size_t shown;       /* points of samples, where the errors are decided by the grid; 0: all */
    double part;        /* of the longest step that bounds other than the accuracy allow, for a check run; 0: 1 */
};

/* Method and steps of a motion. */
struct bead_pace {
    const char *method; /* name to show */
    double step;        /* the first */
    double resolution;  /* samples this close show every oscillation */
    bool variable;      /* later steps depend on the state */
    const char *why;    /* reason for the method; NULL: there is no choice */
};

struct bead_equation {
    const char *const *methods; /* allowed in `simulate.method` besides auto, NULL-terminated; NULL: none */
    bool by_grid;               /* steps follow from the grid, which decides the errors: samples may have other points */
    /* An error of the settings as a whole, and the key to blame; NULL: none. */
    const char *(*check)(const struct bead_equation_spec *spec, const char **key);
    /* Errors: MEMORY, NUMBERS. On failure *motion is NULL, or what `destroy` frees. */
    enum bead_error (*create)(const struct bead_motion_settings *settings, struct bead_motion **motion, struct bead_message *msg);
    void (*destroy)(struct bead_motion *motion);
    void (*pace)(const struct bead_motion *motion, struct bead_pace *pace);
    double (*time)(const struct bead_motion *motion); /* end of the last step */
    /* One step, not beyond settings.end. Errors: NUMBERS. */
    enum bead_error (*step)(struct bead_motion *motion, struct bead_message *msg);
    /* Fields (BEAD_FIELD_BITs) of all points shown at time t within the last step into value[field][shown]. */
    enum bead_error (*sample)(struct bead_motion *motion, double t, unsigned fields, double *const value[BEAD_FIELD_COUNT],
                              struct bead_message *msg);
    uint64_t (*evaluations)(const struct bead_motion *motion); /* of the right-hand side at a point; NULL: not counted */
    /* The state after the last step, to be hashed: `count` numbers, borrowed. */
    const double *(*state)(const struct bead_motion *motion, size_t *count);
    /* The present value of the conserved quantity to watch: energy, or the integral of u^2. */
    double (*energy)(const struct bead_motion *motion);
    /* Write conserved integrals and events of the run (recurrence, breaking) into `measures`, at most `room`; returns their number.
     */
    size_t (*measures)(const struct bead_motion *motion, struct bead_measure *measures, size_t room);
};

/* The extremum of the cubic through values and rates at both ends of a step of length h: its value, and its place *x from 0 to 1.
 * It is a maximum if the cubic rises at the beginning and falls at the end, a minimum if it falls and rises. */
double bead_step_extremum(double h, double e0, double r0, double e1, double r1, double *x);

/* For `measures`: add one without a unit, if there is room; returns count + 1. */
size_t bead_measure_add(struct bead_measure *measures, size_t count, size_t room, const char *name, double value);

bool bead_equation_field_signed(const struct bead_chain_spec *spec, enum bead_field field);
/* Common to the rows of all equations: coordinates and numbers without units, fields with their own names. */
#define BEAD_EQUATION_WORDS                                                                  \
    .points = "points", .axis = "x", .axis_unit = "", .time_unit = "", .names_fields = true, \
    .field_signed = bead_equation_field_signed

/* The table of systems: row `index`, NULL after the last. Row 0 is beads, for chains without the key `equation`. */
const struct bead_system *bead_system_info(size_t index);

extern const struct bead_system bead_system_fput, bead_system_kdv, bead_system_shock;
