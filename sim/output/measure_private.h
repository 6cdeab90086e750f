/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The insides of measures: data kept from a run for the rows of measure_rows.c. */
#pragma once

#include "sim/chain/validity.h"
#include "sim/output/measure.h"
#include "sim/output/measure_place.h"
#include "sim/output/measure_pulses.h"

/* The leading pulse as it passes the probe's cell: samples of its contacts and of the beads behind them. */
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
    double *u, *v; /* [beads], of the last sample: m, m/s; one block of memory */
    double time;   /* s, of the last sample; NaN: none */
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
