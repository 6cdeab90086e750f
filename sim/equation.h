/* Equations: what else than a chain of beads can move in a scene, one const table each.
 *
 * The unknown stands at points x_0 < x_1 < ... ; samples of it are those of a chain with as many beads, so sinks and views show
 * it without knowing what it is. Numbers have no units: time, length and the unknown are those of the equation. */
#ifndef BEADREEL_SIM_EQUATION_H
#define BEADREEL_SIM_EQUATION_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "beadreel/sample.h"
#include "beadreel/scene.h"

/* A number that a run has measured: "recurrence time", 9376.4, "" */
struct bead_measure {
    char name[48], unit[16];
    double value;
};

struct bead_motion; /* each equation's own state */

struct bead_equation {
    const char *name, *help; /* as in scenes: "fput", "kdv", "shock"; with the source of the equation */
    /* What the fields of samples mean: name, unit "" and title ("φ", "strain"); NULL: the equation has no such field. */
    const struct bead_field_info *(*field)(const struct bead_equation_spec *spec, enum bead_field field);
    /* Everything that does not fit together in the settings; NULL: nothing is wrong. */
    const char *(*check)(const struct bead_equation_spec *spec);
    /* Number of points, and their places. */
    size_t (*points)(const struct bead_equation_spec *spec);
    void (*places)(const struct bead_equation_spec *spec, double *x);
    /* step 0: as `accuracy` asks. Errors: MEMORY, SCENE. */
    enum bead_error (*create)(const struct bead_equation_spec *spec, double accuracy, double step, struct bead_motion **motion,
                              struct bead_message *msg);
    void (*destroy)(struct bead_motion *motion);
    double (*time)(const struct bead_motion *motion);    /* end of the last step */
    double (*longest)(const struct bead_motion *motion); /* samples this close show every oscillation */
    /* One step, that does not go beyond `limit`. Errors: NUMBERS. */
    enum bead_error (*step)(struct bead_motion *motion, double limit, struct bead_message *msg);
    /* Fields (BEAD_FIELD_BITs) of all points at time t within the last step. */
    enum bead_error (*sample)(struct bead_motion *motion, double t, unsigned fields, double *const value[BEAD_FIELD_COUNT],
                              struct bead_message *msg);
    /* Conserved integrals and what was found on the way (recurrence, breaking); returns how many there are, fills `room`. */
    size_t (*measures)(const struct bead_motion *motion, struct bead_measure *measures, size_t room);
    double (*energy)(const struct bead_motion *motion); /* of conserved quantities, the one to watch */
};

const struct bead_equation *bead_equation_find(const char *name);
/* Row `index`, NULL behind the last. */
const struct bead_equation *bead_equation_info(size_t index);

#endif
