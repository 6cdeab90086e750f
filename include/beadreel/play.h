/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Play: one chain in time, into functions of the caller. No file is written.
 *
 *   struct bead_player_settings settings;
 *   BEAD_DEFAULT(&settings);
 *   settings.chain = chain; settings.contact_peaks = true;
 *   err = bead_player_create(&settings, &player, &msg);
 *   err = bead_player_until(player, 1e-4, &msg);       as often as wanted; INFINITY: until the run is over
 *   err = bead_player_step(player, &msg);              or step by step
 *   err = bead_player_finish(player, &outcome, &msg);  peaks, and how well they are known
 *   bead_player_destroy(player);
 *
 * Sessions play their chains with the same loop and give the same numbers, to the bit. All numbers are in SI units. A player is
 * used by one thread at a time; several players may share a chain. Calls out of order, such as a step after the end, return USAGE
 * and change nothing. After STOPPED a player may go on or be finished; after any other error it can only be destroyed, and every
 * other call fails with the first error's message. */
#ifndef BEADREEL_PLAY_H
#define BEADREEL_PLAY_H

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/sample.h"

BEAD_BEGIN

/* ---- what is known about a chain after a run, above all the largest force of each contact and bead, and its uncertainty. The
 * library fills these structures in. Their arrays belong to the session or player that gave them, and live as long. ---- */

struct bead_peak {
    double value;       /* N: the largest; the static force where the wave never arrived */
    double time;        /* s; NaN where the contact was never loaded, 0 where it never carried more than its static force */
    bool open;          /* taken at the end of the run, where the force was still rising */
    bool exceeded;      /* a passage ended the search for peaks, and the run went on to a force above this one */
    bool unpredictable; /* runs with other tolerances differ too much here, or since an earlier time, to say anything */
};

/* A number that a run has measured: "recurrence time", "", 9376.4 */
struct bead_measure {
    char name[48];
    const char *unit; /* SI; "" for plain numbers */
    double value;
    char note[40]; /* what the number does not say: "none seen" for a NaN, the time of a sample; "": nothing */
};

/* All beads at one time. */
struct bead_moment {
    double time;                           /* s */
    const double *displacement, *velocity; /* [beads] m, m/s; NULL: not known, or not asked for */
};

/* The derivatives of one contact's peak force. */
struct bead_sensitivity {
    size_t index;                    /* of the contact; all NaN if its force still rises when a run ends by itself */
    bool of_default;                 /* one of those meant by a sink that names none */
    double *mass, *radius, *modulus; /* [beads] N/kg, N/m, N/Pa: by the values of each bead, all else kept */
    double velocity;                 /* N s/m: by the striker's */
    double wall_modulus;             /* N/Pa: by the wall's; 0 without a wall, or with a rigid one */
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
    const struct bead_peak *contact_peaks;                          /* [contacts], NULL where not asked */
    const struct bead_peak *bead_peaks;                             /* [beads], NULL where not asked */
    const double *contact_uncertainty, *bead_uncertainty;           /* N, of these; NULL where not asked */
    const double *contact_time_uncertainty, *bead_time_uncertainty; /* s, of their times; the same */
    double predictable_until; /* s: time of the first peak that is not predictable; INFINITY: all are; 0: not asked */
    const double *contact_deviation, *bead_deviation; /* N, standard deviations of these; NULL where not asked */
    const bool *contact_rivalled, *bead_rivalled;     /* with these: could another maximum be the highest? */
    const struct bead_sensitivity *sensitivities;     /* of the contacts that any sink asks for, rising */
    size_t sensitivity_count;
    /* The least certain peak, relative to itself: its contact or bead, its force and uncertainty, N; NaN if not asked. Forces that
     * still rise at the end do not count. */
    double worst_contact, worst_bead, worst_force, worst_uncertainty;
    struct bead_moment arrived, final;   /* as the front arrives; at `end` */
    const struct bead_measure *measures; /* measured by an equation's run; NULL: none */
    size_t measure_count;
    double absorbed;                  /* J: taken by an absorbing end; NaN: there is none */
    const struct bead_outcome *check; /* that of a run with a hundredth of the tolerance; NULL: not asked, or not possible */
};

/* ---- the player ---- */

struct bead_chain; /* chain.h */

/* Reported now and then (at most about ten times a second) while a session runs. */
struct bead_progress {
    const char *what; /* "scouting", "simulating", "drawing beads.mp4" */
    double done;      /* 0..1 */
    double time;      /* s of physical time reached; NaN: there is no single time */
    double items;     /* things done so far; 0: not counted */
    const char *item; /* "chains" */
};

struct bead_player_settings {
    size_t size;                    /* of this structure: BEAD_DEFAULT */
    const struct bead_chain *chain; /* must outlive the player */
    double until;                   /* s, end of the run; 0: from the chain's scene, or when the first pulse has passed the end */
    double accuracy;                /* relative error of first-passage peaks; 0: from the chain's scene, or 1e-6 */
    const char *method;             /* a name of --list methods; NULL: from the chain's scene, or chosen by the library */
    double step;                    /* s; 0: follows from accuracy */
    bool contact_peaks, bead_peaks; /* wanted in the outcome */
    bool uncertainty;               /* of these peaks: a comparison run is made when the player is finished */
    /* Samples for the caller: fields (BEAD_FIELD_BITs) of all beads at 0, every, 2 every, ... s. If `take` returns an error, the
     * call that played ends with it. NULL: none. */
    enum bead_error (*take)(void *context, const struct bead_sample *sample, struct bead_message *msg);
    void *context;
    unsigned fields;
    double every;
    const volatile sig_atomic_t *stop; /* non-zero: playing ends soon, with STOPPED; may be NULL */
    void (*progress)(void *context, const struct bead_progress *progress); /* may be NULL */
    void *progress_context;
    const char *instructions; /* as in bead_job */
};

struct bead_player;

/* On failure *player is NULL. Errors: USAGE (settings), SCENE (method or step does not suit the chain), MEMORY. */
BEAD_API BEAD_CHECK enum bead_error bead_player_create(const struct bead_player_settings *settings, struct bead_player **player,
                                                       struct bead_message *msg);
/* Make one step, whose length the library chooses, and deliver the samples within it. Errors: those of `until`. */
BEAD_API BEAD_CHECK enum bead_error bead_player_step(struct bead_player *player, struct bead_message *msg);
/* Play to the end of the step that reaches `time`, or to the end of the run if that comes first, and deliver all samples up to
 * `time`. Errors: NUMBERS, MEMORY, STOPPED, those of `take`, USAGE (finished). */
BEAD_API BEAD_CHECK enum bead_error bead_player_until(struct bead_player *player, double time, struct bead_message *msg);
/* End of the last step, s. */
BEAD_API double bead_player_time(const struct bead_player *player);
/* Is the run over, or finished? */
BEAD_API bool bead_player_is_over(const struct bead_player *player);
/* The state now: fields (BEAD_FIELD_BITs) of all beads. Arrays are the player's, valid until its next call. Errors: NUMBERS,
 * MEMORY, USAGE (finished). */
BEAD_API BEAD_CHECK enum bead_error bead_player_sample(struct bead_player *player, unsigned fields, struct bead_sample *sample,
                                                       struct bead_message *msg);
/* End the run where it is, once. *outcome is the player's, valid until it is destroyed. Errors: NUMBERS, MEMORY, STOPPED, USAGE. */
BEAD_API BEAD_CHECK enum bead_error bead_player_finish(struct bead_player *player, const struct bead_outcome **outcome,
                                                       struct bead_message *msg);
BEAD_API void bead_player_destroy(struct bead_player *player); /* NULL is allowed */

BEAD_END

#endif
