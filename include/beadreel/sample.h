/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Samples: the state of one chain at one time, as outputs receive it. */
#ifndef BEADREEL_SAMPLE_H
#define BEADREEL_SAMPLE_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/api.h"

BEAD_BEGIN

/* name in scenes, unit, long name, one value for each BEAD or CONTACT */
#define BEAD_FIELDS(X)                                               \
    X(FORCE, "force", "N", "bead force", BEAD)                       \
    X(CONTACT_FORCE, "contact-force", "N", "contact force", CONTACT) \
    X(COMPRESSION, "compression", "m", "compression", CONTACT)       \
    X(VELOCITY, "velocity", "m/s", "velocity", BEAD)                 \
    X(DISPLACEMENT, "displacement", "m", "displacement", BEAD)       \
    X(ENERGY, "energy", "J", "energy", BEAD)                         \
    X(STRAIN, "strain", "", "strain", BEAD) /* of equations only: see bead_chain_field */

enum bead_field {
#define BEAD_FIELD_ENUM(id, name, unit, title, place) BEAD_FIELD_##id,
    BEAD_FIELDS(BEAD_FIELD_ENUM)
#undef BEAD_FIELD_ENUM
        BEAD_FIELD_COUNT
};

struct bead_field_info {
    const char *name;  /* as in scenes: "contact-force" */
    const char *unit;  /* SI: "N" */
    const char *title; /* for axes and colour bars: "contact force" */
    int of_contacts;   /* 1: one value a contact; 0: one a bead */
};
/* One row a field, in the order of the enum: its meaning for beads. For its meaning in any chain see bead_chain_field. */
BEAD_API const struct bead_field_info *bead_field_info(enum bead_field field);

/* Bit of a field in a set of fields. */
#define BEAD_FIELD_BIT(field) (1u << (field))

/* An inclusive range of beads; bead 0 is the striker. A contact has the number of its left bead. */
struct bead_span {
    size_t first, last;
};

/* Equally spaced times start, start + every, ... <= end (seconds). every == 0: no samples. If they widen, for laws that are powers
 * of time, only the first 64 are so close; then there are 32 for each doubling of the distance from the start, and the last is the
 * end. All others are multiples of `every` from the start. Or they are `count` given ones, ascending from start to end, borrowed.
 */
struct bead_grid {
    double start, every, end;
    bool widens;
    const double *times; /* [count]; NULL: none are given */
    size_t count;
};

/* Number of times on the grid; an end that misses a grid point only by rounding counts. */
BEAD_API size_t bead_grid_count(const struct bead_grid *grid);
/* Time of sample `index`. */
BEAD_API double bead_grid_time(const struct bead_grid *grid, size_t index);

/* The parts of a chain's energy, including losses: their sum, less the work of a drive, is the energy at the start, J. */
struct bead_budget {
    double kinetic;
    double contacts, wall; /* elastic, relative to the chain at rest, less the work of the precompression */
    double gravity;        /* potential: minus the work of gravity, on a tilt and on pendulums */
    double springs;        /* of springs that hold beads at their places */
    double dissipated;     /* lost to damping and to an absorbing end */
    double work;           /* of the drive, contained in the sum of the others */
    /* For every bead, J, including its share of contacts and gravity (they add up to all parts but the dissipated one); for every
     * contact, N, less the static force; for every bead, m/s. Borrowed. */
    const double *energy, *force, *velocity;
};

/* One chain at one time. Arrays are borrowed until the call returns. They have one value for every
 * bead (or contact) of the chain, are indexed by its number, and are valid in the spans asked for; a field that no sink asked for
 * is NULL. SI units. */
struct bead_sample {
    size_t chain;  /* index in the scene */
    size_t index;  /* in the receiving sink's own grid */
    double time;   /* s */
    size_t active; /* beads >= active are exactly at rest, all their values 0 (or static) */
    const double *field[BEAD_FIELD_COUNT];
    const struct bead_budget *budget; /* if a sink asks for it; NULL in stored samples */
    /* Values of the comparison run: the same chain run a second time with another accuracy, at the same time. Its beads >=
     * comparison_active are at rest. NULL if no sink asked. */
    const double *comparison[BEAD_FIELD_COUNT];
    size_t comparison_active;
    /* The sample of a run with a hundredth of the tolerance, which tells the error of this one; NULL if no sink asked, in stored
     * samples, and where no such run is possible. */
    const struct bead_sample *check;
};

BEAD_END

#endif
