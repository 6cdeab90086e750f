/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The insides of measures: data kept from a run for the rows of measure_rows.c. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/chain.h"
#include "beadreel/sample.h"
#include "sim/chain/validity.h"
#include "sim/measure/measure.h"

/* Places to measure along a chain: regular stretches, defects between them, the probe. */

enum { BEAD_PLACE_PERIOD = 8 }; /* beads of the longest cell searched for */

struct bead_places {
    size_t links;        /* contacts between beads */
    size_t probe;        /* contact */
    size_t cell;         /* beads of the cell that repeats at the probe; 1 if none does */
    bool regular;        /* the chain repeats itself at the probe */
    size_t regular_from; /* first bead of the stretch that repeats up to the end */
    bool defect;         /* the same cell also repeats at the beginning of the chain, but not in between */
    size_t before;       /* first contact of a cell before the defect, undisturbed by it; the cell after it is the probe's */
};

struct bead_places bead_places_find(const struct bead_chain *chain);
/* Last bead of the longest stretch from bead 1 that repeats every `period` beads. */
size_t bead_places_head(const struct bead_chain *chain, size_t period);

/* Curves through equally spaced samples: the polynomial through a few of them. */

enum { BEAD_CURVE_POINTS = 7 };

/* Newton's form through values at x = 0, 1, ..., count - 1. */
struct bead_curve {
    size_t count;
    double difference[BEAD_CURVE_POINTS];
};

/* count <= BEAD_CURVE_POINTS */
struct bead_curve bead_curve_through(const double *values, size_t count);
double bead_curve_value(const struct bead_curve *curve, double x);
double bead_curve_integral(const struct bead_curve *curve, double from, double to);
/* Place of the maximum between low, where the slope is positive, and high, where it is not. */
double bead_curve_maximum(const struct bead_curve *curve, double low, double high);
/* The place between low and high, on different sides of `value`, at which the curve has it. */
double bead_curve_crossing(const struct bead_curve *curve, double value, double low, double high);
/* First of the samples for a curve around index `at` of `count`, and their number. */
size_t bead_curve_window(size_t count, size_t at, size_t *points);

/* Place of the maximum of `count` values (not the first or last of them), in units of the index, and its value. */
double bead_samples_maximum(const double *values, size_t count, double *largest);
/* The first place, from index `from` in steps of -1 or 1, at which the values fall to `level`; NaN: they do not. */
double bead_samples_crossing(const double *values, size_t count, size_t from, int step, double level);

/* Pulses: maxima of every contact's force, found as samples arrive; the force must fall between two of them. */

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

/* To be destroyed even after an error. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_pulses_create(const struct bead_chain *chain, size_t probe, struct bead_pulses **pulses,
                                              struct bead_message *msg);
void bead_pulses_destroy(struct bead_pulses *pulses);
void bead_pulses_feed(struct bead_pulses *pulses, const struct bead_sample *sample);
/* Call it after the last sample: finds the maxima near it, which have fewer samples after them. Does nothing when called again. */
void bead_pulses_end(struct bead_pulses *pulses);
/* The first pulse of a contact; force and time NaN if it has none. */
struct bead_pulse bead_pulses_first(const struct bead_pulses *pulses, size_t contact);

/* The leading pulse as it passes the probe's cell: samples of its contacts and of the beads after them. */
struct bead_trace {
    double begin, spacing; /* s: time of the first sample; time between samples */
    size_t count, room;
    double *force[BEAD_PLACE_PERIOD + 1];        /* N, less the static force; contacts probe, probe + 1, ..., probe + cell */
    double *velocity[BEAD_PLACE_PERIOD];         /* m/s, of beads probe + 1, ... */
    double *displacement[BEAD_PLACE_PERIOD + 1]; /* m, of beads probe, probe + 1, ... */
};

/* The contact between striker and first bead. */
struct bead_strike {
    double compression[BEAD_CURVE_POINTS]; /* m, the last samples */
    size_t fed;
    double largest, opened; /* m; s, when it first opened; NaN: still closed */
    double behind[2];       /* m, m/s: compression and its rate at the first sample after it opened, until the next one; else NaN */
    double velocity;        /* m/s of the striker, at the last sample */
};

struct bead_measures {
    const struct bead_chain *chain;
    struct bead_places places;
    struct bead_pulses *pulses;
    struct bead_trace trace;
    struct bead_strike strike;
    double *u, *v;   /* [beads], of the last sample: m, m/s; one block of memory, with: */
    double *deepest; /* [beads], m: the largest compression of each contact, less the static one; 0 or more */
    double time;     /* s, of the last sample; NaN: none */
    struct bead_validity validity;
    double clean;        /* participation of the clean wave, beads; NaN: no clean wave */
    double arrived;      /* participation of the energies at the first sample after the front's arrival; NaN: not arrived */
    double arrived_time; /* s, of that sample */
};

/* The leading pulse, found once when the measures are read; the rows are computed from it. */
struct bead_pulse_found {
    double force, bead_force, velocity, compression; /* N, N, m/s, m: the largest in the cell */
    double beads_per_second, speed;                  /* at the probe: 1/s, m/s */
    double force_time[2], velocity_time[2];          /* s: widths at half height and 1 % of the height */
    double energy, momentum, kinetic, potential;     /* J, kg m/s, through the probe; J s of one cell */
};

/* Follow the probe's cell. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_trace_feed(struct bead_measures *m, const struct bead_sample *sample, struct bead_message *msg);
void bead_trace_free(struct bead_trace *trace);
/* All NaN if no pulse has passed. */
struct bead_pulse_found bead_trace_read(const struct bead_measures *m);
void bead_strike_feed(struct bead_measures *m, const struct bead_sample *sample);

/* 1/s and m/s, by least squares from the times of the first pulses in contacts first, first + step, ... <= last; NaN if fewer
 * than `fewest` contacts have one. */
void bead_front_speed(const struct bead_measures *m, size_t first, size_t last, size_t step, size_t fewest,
                      double *beads_per_second, double *speed);

/* The decay of the leading force along a chain. */
struct bead_decay_found {
    double rate, error; /* 1/bead; NaN: too few contacts */
    bool seen;          /* the rate, decay or growth, is larger than its error */
    size_t first, last; /* contacts of the fit */
};

/* `outcome` may be NULL. */
struct bead_decay_found bead_decay_find(const struct bead_measures *measures, const struct bead_outcome *outcome);
