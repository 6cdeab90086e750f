/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equations: what can move in a scene instead of a chain of beads, one const table each.
 *
 * The unknown stands at points x_0 < x_1 < ..., equally far apart; samples of it are those of a chain with as many beads, so
 * sinks and views show it without knowing what it is. Numbers have no units: time, length and the unknown are those of the
 * equation. Results must not depend on when they are sampled: steps follow from the state alone. */
#ifndef BEADREEL_SIM_EQUATION_EQUATION_H
#define BEADREEL_SIM_EQUATION_EQUATION_H

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
    size_t points;      /* as `points` below found */
    const char *method; /* "auto", or one of the equation's `methods` */
    double accuracy;    /* relative error wanted in the unknown at the end of the run */
    double step;        /* 0: as the accuracy asks */
    double end;         /* of the run: steps end there; INFINITY: not known */
};

/* How a motion moves on. */
struct bead_pace {
    const char *method; /* name for people */
    double step;        /* the first */
    double resolution;  /* samples this close show every oscillation */
    bool variable;      /* later steps follow the state */
    const char *why;    /* this method; NULL: there is no choice */
};

struct bead_equation {
    struct bead_system system;  /* its name, points and fields */
    const char *const *methods; /* that `simulate.method` may have beside auto, NULL-terminated; NULL: none */
    /* Everything that does not fit together in the settings, and the key it is about; NULL: nothing is wrong. */
    const char *(*check)(const struct bead_equation_spec *spec, const char **key);
    /* Errors: MEMORY, NUMBERS. On failure *motion is NULL. */
    enum bead_error (*create)(const struct bead_motion_settings *settings, struct bead_motion **motion, struct bead_message *msg);
    void (*destroy)(struct bead_motion *motion);
    void (*pace)(const struct bead_motion *motion, struct bead_pace *pace);
    double (*time)(const struct bead_motion *motion); /* end of the last step */
    /* One step, not beyond settings.end. Errors: NUMBERS. */
    enum bead_error (*step)(struct bead_motion *motion, struct bead_message *msg);
    /* Fields (BEAD_FIELD_BITs) of all points at time t within the last step into value[field][points]. */
    enum bead_error (*sample)(struct bead_motion *motion, double t, unsigned fields, double *const value[BEAD_FIELD_COUNT],
                              struct bead_message *msg);
    uint64_t (*evaluations)(const struct bead_motion *motion); /* of the right-hand side at a point; NULL: not counted */
    /* The state after the last step, for its hash; `count` numbers, borrowed. */
    const double *(*state)(const struct bead_motion *motion, size_t *count);
    /* The conserved quantity to watch (energy, or the integral of u^2), now. */
    double (*energy)(const struct bead_motion *motion);
    /* Conserved integrals and events of the run (recurrence, breaking) into `measures`, at most `room`; returns how many there are.
     */
    size_t (*measures)(const struct bead_motion *motion, struct bead_measure *measures, size_t room);
};

/* For `measures`: one more, without a unit, where there is room; returns count + 1. */
size_t bead_measure_add(struct bead_measure *measures, size_t count, size_t room, const char *name, double value);

extern const struct bead_equation bead_equation_fput;
extern const struct bead_equation bead_equation_kdv;
extern const struct bead_equation bead_equation_shock;

/* NULL: there is no such equation. */
const struct bead_equation *bead_equation_find(const char *name);
/* Row `index`, NULL behind the last. */
const struct bead_equation *bead_equation_info(size_t index);

#endif
