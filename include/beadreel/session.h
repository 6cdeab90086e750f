/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sessions: a scene, or a trajectory, played into its outputs.
 *
 *   struct bead_job job;
 *   BEAD_DEFAULT(&job);
 *   job.input = "scene.yaml"; job.sinks = bead_data_sinks();
 *   err = bead_session_open(&job, &session, &msg);
 *   bead_session_plan(session, &print, file, ...);   or   err = bead_session_run(session, &msg);
 *   bead_session_close(session);
 *
 * The session makes the chains and sinks, takes the union of the sinks' needs, scouts what must be
 * known in advance (end, ranges), plays the source once and finishes every sink. */
#ifndef BEADREEL_SESSION_H
#define BEADREEL_SESSION_H

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "beadreel/error.h"
#include "beadreel/play.h"
#include "beadreel/scene.h"
#include "beadreel/sink.h"

BEAD_BEGIN

struct bead_chain; /* chain.h */
struct bead_sweep;

struct bead_job {
    size_t size;                 /* of this structure: BEAD_DEFAULT */
    const char *input;           /* scene.yaml, a ready scene's name, a trajectory or a sweep's file (.h5) */
    const char *const *settings; /* key.path=value */
    size_t setting_count;
    const char *output;      /* -o: a directory, or the only file to make, by its ending; NULL: "." */
    const char *const *only; /* names of outputs to make; all others are skipped */
    size_t only_count;
    int threads;                                      /* 0: all cores; 1: everything in one thread; same results for any */
    const char *instructions;                         /* NULL: the best; or portable, sse2, avx2, avx512: same results for any */
    const char *canvas;                               /* NULL: the first that works; see canvas.h */
    bool hash;                                        /* fill bead_counts.state_hash */
    bool full_window;                                 /* compute beads at rest too (for checks; same results) */
    const struct bead_sink_type *const *const *sinks; /* NULL-terminated list of NULL-terminated lists */
    const char *configuration; /* run this chain of a sweep's file, or of a scene: "17", or "NAME:17" where it has several
                                  sweeps; of several chains, also those of a trajectory: "NAME" */
    bool sheet;                /* make only a contact sheet, the file `output` */
    bool allow_outside;        /* outputs may leave the directory `output`: absolute paths and `..`, of scenes that are trusted */
    size_t part, parts;        /* compute part 1..parts of a sweep, into a file of its own; 0, 0: all */
    const volatile sig_atomic_t *stop; /* non-zero: finish files and return STOPPED; may be NULL */
    void (*progress)(void *context, const struct bead_progress *progress); /* may be NULL */
    void *progress_context;
    const char *const *looks; /* "--KEY=VALUE": options for keys of the one output that `output` names */
    size_t look_count;
    const char *config; /* a file of the user's own settings, see bead_config in scene.h; NULL: none */
    const char *frame;  /* make only this frame of a movie, as PNG: "2.1 ms" of the motion, "50%" of the film, or "peak", the moment
                           that a poster shows; NULL: no */
    const struct bead_own *own; /* what the program adds to scenes (scene.h); NULL: nothing. Must outlive the session */
    const char *const *others;  /* more trajectories, whose chains are shown beside those of `input` */
    size_t other_count;
    bool difference;   /* show the second of two trajectories less the first */
    const char *name;  /* the scene's name in messages and in its files; NULL: as `input` */
    const char *still; /* "poster": only the beads, large, of `frame`, or else of "peak"; NULL: no */
};

struct bead_session;

/* Reads and checks everything; simulates only as far as needed to know times (default `until`).
 * Errors: SCENE, USAGE, IO, FORMAT, MEMORY. On failure *session is NULL. */
BEAD_API BEAD_CHECK enum bead_error bead_session_open(const struct bead_job *job, struct bead_session **session,
                                                      struct bead_message *msg);
/* Writes the plan, lines of text, to `out`: the work that will be done, the work that is skipped, and why. */
BEAD_API BEAD_CHECK enum bead_error bead_session_plan(const struct bead_session *session, FILE *out, struct bead_message *msg);
/* Only once: after success or failure, another run is refused with USAGE. */
BEAD_API BEAD_CHECK enum bead_error bead_session_run(struct bead_session *session, struct bead_message *msg);

/* After a run: the files made, in the order of the scene; and the counts that --plan promised. */
struct bead_result {
    const char *path;
    uint64_t bytes, items;
    const char *makers;      /* "painted by ..., encoded by ..."; NULL or "": nothing to report */
    const char *name, *kind; /* as in the scene: "force.png", "image"; for a second file "poster" or "xdmf" */
};
BEAD_API size_t bead_session_results(const struct bead_session *session, const struct bead_result **results);

struct bead_counts {
    uint64_t evaluations; /* of one contact's force, in steps */
    uint64_t steps;
    uint64_t samples;                                  /* sample times computed, of all chains */
    uint64_t sample_values;                            /* bead values interpolated for samples */
    uint64_t comparison_evaluations, comparison_steps; /* of comparison runs, not counted elsewhere */
    uint64_t chains;                                   /* of a sweep, computed now */
    uint64_t passes;                                   /* times the chains were simulated: 1, or more with scouting */
    uint64_t state_hash; /* fingerprint of displacement and velocity bits of all chains after every step */
};
BEAD_API const struct bead_counts *bead_session_counts(const struct bead_session *session);
/* After a run: sentence `index` of what the user should know before trusting it; NULL after the last. */
BEAD_API const char *bead_session_warning(const struct bead_session *session, size_t index);
BEAD_API const struct bead_chain *const *bead_session_chains(const struct bead_session *session, size_t *count);
BEAD_API const struct bead_outcome *bead_session_outcomes(const struct bead_session *session, size_t *chain_count);
/* The sweep of a scene or file that has one, else NULL. */
BEAD_API const struct bead_sweep *bead_session_sweep(const struct bead_session *session);
BEAD_API void bead_session_close(struct bead_session *session);

BEAD_END

#endif
