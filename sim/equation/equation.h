/* Equations: what else than a chain of beads can move in a scene, one const table each.
 *
 * The unknown stands at points x_0 < x_1 < ..., equally far apart; samples of it are those of a chain with as many beads, so
 * sinks and views show it without knowing what it is. Numbers have no units: time, length and the unknown are those of the
 * equation. Results must not depend on who samples them when: steps follow from the state alone. */
#ifndef BEADREEL_SIM_EQUATION_EQUATION_H
#define BEADREEL_SIM_EQUATION_EQUATION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/chain.h"
#include "beadreel/error.h"
#include "beadreel/sample.h"
#include "beadreel/scene.h"
#include "beadreel/sink.h"

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
    const char *name, *help;       /* as in scenes: "fput", "kdv", "shock"; with the source of the equation */
    const char *const *methods;    /* that `simulate.method` may have beside auto, NULL-terminated; NULL: none */
    const enum bead_field *fields; /* that its samples have, the one to show by default first; BEAD_FIELD_COUNT behind the last;
 NULL: spec->variable alone */
    bool beads;                    /* masses at the points: the view of the beads can show them */
    /* What a field means: name, unit "" and title ("strain"); asked for fields that it has. */
    const struct bead_field_info *(*field)(const struct bead_equation_spec *spec, enum bead_field field);
    /* Everything that does not fit together in the settings, and the key it is about; NULL: nothing is wrong. */
    const char *(*check)(const struct bead_equation_spec *spec, const char **key);
    /* Its formula with its numbers, in a line of plain text; NULL: the name says it. */
    void (*describe)(const struct bead_equation_spec *spec, char *text, size_t size);
    /* Number of points for this accuracy (the same for twin runs of another accuracy), and the first of them and their spacing. */
    size_t (*points)(const struct bead_equation_spec *spec, double accuracy);
    void (*places)(const struct bead_equation_spec *spec, size_t points, double *first, double *spacing);
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
    /* Conserved integrals and what was found on the way (recurrence, breaking); returns how many there are, fills `room`. */
    size_t (*measures)(const struct bead_motion *motion, struct bead_measure *measures, size_t room);
    /* Linear modes 1..count of a sample that has `mode_fields`: energy[k - 1] is that of mode k. NULL: it has none. */
    unsigned mode_fields;
    const char *mode_title; /* "energy of the mode" */
    void (*modes)(const struct bead_equation_spec *spec, size_t points, const double *const field[BEAD_FIELD_COUNT], size_t count,
                  double *energy);
};

/* For `measures`: one more, without a unit, where there is room; returns count + 1. */
size_t bead_measure_add(struct bead_measure *measures, size_t count, size_t room, const char *name, double value);

extern const struct bead_equation bead_equation_fput;
extern const struct bead_equation bead_equation_kdv;
extern const struct bead_equation bead_equation_shock;

/* NULL: there is no such equation. */
const struct bead_equation *bead_equation_find(const char *name);
/* BEAD_FIELD_BITs of the fields that it has, and the one to show by default; of beads where spec->name is NULL. */
unsigned bead_equation_fields(const struct bead_equation_spec *spec);
enum bead_field bead_equation_shown(const struct bead_equation_spec *spec);
/* Row `index`, NULL behind the last. */
const struct bead_equation *bead_equation_info(size_t index);

#endif
