/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks: what is known about a chain after a run, the largest force of each contact and bead above all, and how well it is known.
 *
 * The library fills these structures in. Their arrays belong to what gave them, a session or a player, and live as long. SI units.
 */
#ifndef BEADREEL_PEAKS_H
#define BEADREEL_PEAKS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/api.h"

BEAD_BEGIN

struct bead_peak {
    double value;       /* N: the largest; the static force where the wave has not come */
    double time;        /* s; NaN where the contact was never loaded, 0 where it never carried more than its static force */
    bool open;          /* that of the end of the run, where the force was still rising */
    bool exceeded;      /* a passage ended the search for peaks, and the run went on to a force above this one */
    bool unpredictable; /* runs of other tolerances differ here too much to say anything, or from an earlier time on */
};

/* A number that a run has measured: "recurrence time", "", 9376.4 */
struct bead_measure {
    char name[48];
    const char *unit; /* SI; "" of numbers without */
    double value;
    char note[40]; /* what the number does not say: "none seen" of a NaN, the time of a sample; "": nothing */
};

/* All beads at one time. */
struct bead_moment {
    double time;                           /* s */
    const double *displacement, *velocity; /* [beads] m, m/s; NULL: not known, or not asked for */
};

/* The derivatives of one contact's peak force. */
struct bead_sensitivity {
    size_t index;                    /* of the contact; all NaN where its force still rises as a run ends by itself */
    bool of_default;                 /* it is one of those meant where a sink names none */
    double *mass, *radius, *modulus; /* [beads] N/kg, N/m, N/Pa: by those of each bead, all else kept */
    double velocity;                 /* N s/m: by that of the striker */
    double wall_modulus;             /* N/Pa: by that of the wall; 0 where there is none, or a rigid one */
};

/* Results of one chain's run. */
struct bead_outcome {
    double end;           /* s: simulated until here */
    double front_arrival; /* s: last contact exceeded 1e-4 of the largest force so far; NaN: never */
    const char *method;
    double step;                         /* s, nominal */
    uint64_t steps, evaluations;         /* evaluations of one bead's force */
    double energy_start, energy_end;     /* J */
    double momentum_start, momentum_end; /* kg m/s */
    /* The run's own errors, the largest of each, as parts of what was put in; NaN where the method
     * has no such estimate: */
    double energy_error;   /* of the energy */
    double embedded_error; /* of a velocity: a step against the embedded method of lower order, away from contacts that open or
                              close */
    double event_error;    /* of a velocity: the last correction of a contact that opens or closes */
    const struct bead_peak *contact_peaks;                /* [contacts], NULL where not asked */
    const struct bead_peak *bead_peaks;                   /* [beads], NULL where not asked */
    const double *contact_uncertainty, *bead_uncertainty; /* N, of these; NULL where not asked */
    double predictable_until; /* s: time of the first peak that is not predictable; INFINITY: all are; 0: not asked */
    const double *contact_deviation, *bead_deviation; /* N, standard deviations of these; NULL where not asked */
    const struct bead_sensitivity *sensitivities;     /* of the contacts asked for by any sink, rising */
    size_t sensitivity_count;
    /* The peak that is known least well, as a part of itself: its contact, or bead, its force and uncertainty, N; NaN where not
     * asked.
     */
    double worst_contact, worst_bead, worst_force, worst_uncertainty;
    struct bead_moment arrived, final;   /* as the front arrives; at `end` */
    const struct bead_measure *measures; /* what an equation's run has measured; NULL: none */
    size_t measure_count;
};

BEAD_END

#endif
