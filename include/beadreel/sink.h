/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sinks: where samples go. A trajectory, a table, an image and a movie are each one const table
 * `struct bead_sink_type`, found by the kind of output, which also has the endings of its files.
 *
 * Life of a sink, for outputs in the order of the scene:
 * create gets the output's settings and the run context (what is known before the run), decides what it needs,
 *            takes no time and touches no file that a failed run would leave behind;
 *   begin    once, when the run starts: ranges found by a scouting pass are known now; opens `name.part`;
 *   sample   once for each time on its grid and each chain, chains in order within a time;
 * again if there is one, after the last sample: may ask for all samples once more;
 *   end      once after the last sample: finish, fsync, rename to `name`;
 *   destroy  always; where end was not reached, removes or (trajectory) closes the .part file properly.
 *
 * A sink of your own is of the kind BEAD_OUTPUT_OWN. Hand it to a session (bead_job.own); scenes then ask for it by its name,
 * `- NAME: FILE`, with the keys field, beads, time and every, and `-o FILE` by the ending of the file. It must have the functions
 * create, needs, begin, sample, end and destroy.
 *
 * Outputs of sweeps show results that are known already: their sinks only `write`. */
#ifndef BEADREEL_SINK_H
#define BEADREEL_SINK_H

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "beadreel/chain.h"
#include "beadreel/error.h"
#include "beadreel/play.h"
#include "beadreel/sample.h"
#include "beadreel/scene.h"

BEAD_BEGIN

/* Needs of a sink; the run computes their union and nothing else. */
struct bead_needs {
    unsigned fields;        /* BEAD_FIELD_BITs of samples; 0 with grid.every == 0: no samples */
    struct bead_span beads; /* valid part of the samples' arrays; the same for contacts first..last */
    struct bead_grid grid;
    bool contact_peaks, bead_peaks; /* maxima of every contact's / bead's force: in the outcome */
    bool budget;                    /* the energy budget, in samples */
    bool states;                    /* the beads as the front arrives and at the end: in the outcome */
    bool range;                     /* wants the range of `range_field` over beads and times before begin (a scouting pass) */
    enum bead_field range_field;
    unsigned comparison;    /* BEAD_FIELD_BITs, of `fields`, that samples must also have from the comparison run: see bead_sample */
    bool uncertainty;       /* of these maxima: their uncertainty, in the outcome (a comparison run) */
    bool checked;           /* samples and outcomes come with those of a finer run, `check` */
    size_t each;            /* only the first of so many samples has fields of the run, the others those of `check` alone; 0: all */
    bool deviation;         /* of these maxima: their standard deviations, from the tolerances of materials, in the outcome */
    bool sensitivities;     /* of maxima of contacts: in the outcome */
    const size_t *contacts; /* their numbers, rising; NULL: see bead_sensitive_contacts (sim/run/sensitivity.h) */
    size_t contact_count;
    double until;    /* s: nothing after this time is needed; 0: nothing at all, or, with maxima or states of the outcome, the whole
                        run */
    const char *why; /* a few words for --plan: "600 frames of 1920 x 1080, every 5 us" (owned by the sink) */
};

/* A frame of a film. */
struct bead_frame_asked {
    const char *text;  /* as given */
    double time, part; /* s of the motion, or a part of the film, 0..1; the other is NaN; both NaN: the frame of posters */
    const char *still; /* the part to draw: "poster"; NULL: all */
};

struct bead_sweep;          /* sweep.h */
struct bead_sweep_settings; /* sweep.h */

/* Known before the first sample. */
struct bead_run_context {
    const struct bead_scene *scene;
    const struct bead_chain *const *chains;
    size_t chain_count;
    double end;              /* s: the end of the run */
    struct bead_grid native; /* every > 0: use these samples (those of the trajectory); 0: choose */
    double resolution;       /* s: samples this close show every oscillation */
    double tolerance_factor; /* of a comparison run: its accuracy, or its step if the scene gives one, relative to the first's */
    int threads;             /* 1: do everything in the calling thread */
    const char *canvas;      /* back end for what is drawn with GL; NULL: the first that works */
    const char *directory;   /* where relative paths of outputs go */
    const volatile sig_atomic_t *stop; /* non-zero: end long work soon, with STOPPED; NULL: never */
    bool replayed;                     /* samples come from a trajectory: there are no peaks */
    bool difference;                   /* of two runs: values are differences, `comparison` has those of the first run */
    const double *bounds;              /* [chains][BEAD_FIELD_COUNT]: bounds of the errors of samples, NaN: unknown; NULL: all */
    /* Has this run already made that output of the scene? For sinks that come last, in `end`. NULL: unknown. */
    bool (*is_made)(const void *asker, const struct bead_output *output);
    const void *asker;
    const struct bead_frame_asked *frame; /* of sinks with `one_frame`; else NULL */
    bool claimed; /* the caller has claimed all files (file.h); else sinks that write as they go claim their own */
    const struct bead_sweep *sweep;                   /* of outputs of sweeps; else NULL */
    const struct bead_sweep_settings *sweep_settings; /* for those that run chains of it (bead_sweep_watch) */
};

/* Found by scouting: of the sink's range_field, over all chains. */
struct bead_range {
    double low, high;
};

struct bead_sink; /* each type's own */

struct bead_sink_type {
    const char *name; /* "image" */
    const char *help; /* one line */
    enum bead_output_kind kind;
    const char *endings; /* of BEAD_OUTPUT_OWN: endings of its files, ".txt or .dat"; else NULL, the kind has them */
    bool background;     /* works in its own threads: ended after the others, which work meanwhile */
    /* On failure *sink is NULL, or what `destroy` frees. */
    enum bead_error (*create)(const struct bead_output *output, const struct bead_run_context *context, struct bead_sink **sink,
                              struct bead_message *msg);
    /* Called again after `begin` and `again`, when the needs may be less. */
    void (*needs)(const struct bead_sink *sink, struct bead_needs *needs);
    enum bead_error (*begin)(struct bead_sink *sink, struct bead_range range, struct bead_message *msg);
    enum bead_error (*sample)(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg);
    enum bead_error (*end)(struct bead_sink *sink, const struct bead_outcome *outcomes, struct bead_message *msg);
    /* Instead of `end` if the run was stopped, or after `end` returned STOPPED: leave the unfinished file, `path.part`, readable up
     * to there. An earlier finished file of that name stays. NULL: a part is worthless, and removed. */
    enum bead_error (*stop)(struct bead_sink *sink, const struct bead_outcome *outcomes, struct bead_message *msg);
    void (*destroy)(struct bead_sink *sink);
    /* For the result line: bytes written so far, and a work measure such as frames. NULL: the bytes are those of the file. */
    void (*result)(const struct bead_sink *sink, uint64_t *bytes, uint64_t *items);
    /* What made it, after `end`: "painted by ..., encoded by ..." (the sink's). "": nothing to report. May be NULL. */
    const char *(*makers)(const struct bead_sink *sink);
    /* A second file, such as a movie's poster: where it goes (the sink's), and bytes written so far. NULL: none. May be NULL. */
    const char *(*beside)(const struct bead_sink *sink, uint64_t *bytes);
    /* Does `create` read arrays of the chains, such as the places of beads? Else a plan need not build them: until `begin`, only
     * functions that return no arrays may be called. NULL: it does not. */
    bool (*looks_at_beads)(const struct bead_output *output, const struct bead_run_context *context);
    /* The accuracy that its run should have if the scene gives none; 0: it does not matter. Called before `create`, and only for
     * outputs that are made. NULL: it does not matter. */
    double (*accuracy)(const struct bead_output *output);
    bool one_frame; /* makes one frame instead of the film: listed before the sink that makes all */
    /* A sample of the scouting pass for its range, with only that field, before `begin`. NULL: it only needs the range. */
    enum bead_error (*scout)(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg);
    /* After the last sample: does it want all of them once more? Only for a sink that is alone. NULL: no. */
    enum bead_error (*again)(struct bead_sink *sink, bool *again, struct bead_message *msg);
    /* Only in types for outputs of sweeps, which have none of the functions above: write the whole file. */
    enum bead_error (*write)(const struct bead_output *output, const struct bead_run_context *context, const char *path,
                             uint64_t *bytes, struct bead_message *msg);
    /* Before chains run, which may take hours: an error that `write` would meet whatever their results are. NULL: none. */
    enum bead_error (*check)(const struct bead_output *output, const struct bead_run_context *context, struct bead_message *msg);
    const char *(*why)(const struct bead_output *output); /* what is written, in words for --plan */
    bool runs_chains;                                     /* `write` runs the chains that it shows, */
    bool without_results;                                 /* and needs no results of others */
};

/* ---- files of sinks: they appear whole, or not at all ---- */

/* `path` seen from `directory` (NULL, "" or ".": the working directory; absolute paths stay as they are).
 * *joined belongs to the caller (free), NULL on failure. Errors: MEMORY, IO (empty path). */
BEAD_API BEAD_CHECK enum bead_error bead_file_join(const char *directory, const char *path, char **joined,
                                                   struct bead_message *msg);
/* Fills the opened `file`, named `part` in messages. */
typedef enum bead_error (*bead_file_fill)(void *context, FILE *file, const char *part, struct bead_message *msg);
/* Writes the file `path` with `fill`, whole or not at all. bytes may be NULL. Errors: MEMORY, IO, those of `fill`. */
BEAD_API BEAD_CHECK enum bead_error bead_file_write(const char *path, bead_file_fill fill, void *context, uint64_t *bytes,
                                                    struct bead_message *msg);

/* The sinks that need no graphics: trajectory, tables, results of sweeps. NULL-terminated. */
BEAD_API const struct bead_sink_type *const *bead_data_sinks(void);

BEAD_END

#endif
