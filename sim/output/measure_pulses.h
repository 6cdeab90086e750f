/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pulses: maxima of every contact's force, found as samples come in; the force must fall between two of them. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/chain.h"
#include "beadreel/sample.h"
#include "sim/output/measure_curve.h"

enum { BEAD_PULSES = 6, BEAD_PULSES_AHEAD = 4 };

struct bead_pulse {
    double force, time; /* N, less the static force; s */
};

struct bead_track {
    struct bead_pulse pulse[BEAD_PULSES]; /* in order of time; none after the reflection at the wall */
    size_t count;
    struct bead_pulse late; /* largest since the wave reached the wall; force 0: none */
};

struct bead_pulses {
    const struct bead_chain *chain;
    size_t contacts, fed, probe;
    double *memory, *row[BEAD_CURVE_POINTS]; /* N: the last samples of all contacts, oldest first */
    double time, spacing;                    /* s, of the last sample; between samples */
    bool ended;
    double record;                   /* N, largest so far */
    double struck;                   /* s: first maximum at the wall; NaN: none so far */
    double ahead[BEAD_PULSES_AHEAD]; /* forces 1, 2, ... contacts ahead at the maximum of the probe's first pulse; NaN: unknown */
    double *low;                     /* [contacts] N, least force since the last pulse */
    struct bead_track *track;        /* [contacts] */
};

/* Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_pulses_create(const struct bead_chain *chain, size_t probe, struct bead_pulses **pulses,
                                              struct bead_message *msg);
void bead_pulses_destroy(struct bead_pulses *pulses);
void bead_pulses_feed(struct bead_pulses *pulses, const struct bead_sample *sample);
/* After the last sample: finds the maxima near it, which have fewer samples after them. Does nothing when called again. */
void bead_pulses_end(struct bead_pulses *pulses);
/* The first pulse of a contact; force and time NaN if it has none. */
struct bead_pulse bead_pulses_first(const struct bead_pulses *pulses, size_t contact);
