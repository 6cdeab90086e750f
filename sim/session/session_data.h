/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of a session, shared by session_*.c. */
#pragma once

#include <string.h>

#include "beadreel/session.h"
#include "beadreel/sweep.h"
#include "beadreel/trajectory.h"
#include "sim/kinds/output_kinds.h"
#include "sim/run/play.h"
#include "sim/yaml/yaml.h"

/* One output of the scene, in its order. */
struct bead_made {
    const struct bead_output *output;
    const char *name;                  /* its file's in the scene */
    struct bead_output changed;        /* replaces it if `-o FILE` names it */
    const struct bead_sink_type *type; /* NULL: this program cannot make it */
    struct bead_sink *sink;            /* NULL: skipped */
    bool asked;                        /* not excluded by --only */
    bool shared;                       /* draws from the samples of the trajectory output */
    bool ended;
    uint64_t bytes;                /* written, if the type has no `result` */
    char *path;                    /* where it goes */
    char *beside;                  /* poster or slides of `changed`, own */
    struct bead_frame_asked frame; /* of `single`, with the job's frame */
    char *part;                    /* the part that a stopped run leaves; NULL: none */
    struct bead_claim *claims[2];  /* on `path` and on a second file; NULL: none */
    struct bead_needs needs;
    struct bead_range range; /* found by scouting */
};

/* Warnings, in this order: numbers that can hardly be meant; the default choice of what is shown; a file system without locks; a
 * step that is too long; a model that does not hold; forces of a sweep that were still rising; chains without an end; peaks that
 * could not be verified. */
enum {
    SESSION_DOUBTS,
    SESSION_CHOSEN,
    SESSION_NO_LOCKS,
    SESSION_LONG_STEP,
    SESSION_INVALID,
    SESSION_RISING,
    SESSION_LOST,
    SESSION_UNVERIFIED,
    SESSION_WARNINGS
};

struct bead_sensitivities; /* session_sensitivity.c */
struct bead_joined;        /* session_join.c */

struct bead_session {
    struct bead_job job;
    struct bead_scene *scene;           /* own; NULL with a trajectory or a sweep's file */
    struct bead_sweep *sweep;           /* of scenes with sweeps, and their files */
    bool sweep_read;                    /* read from a file */
    const char *single;                 /* the one file to make, if -o names it; else NULL */
    size_t single_index;                /* of its output in the scene */
    bool amid;                          /* the other outputs stay listed: frames keep a trajectory's sample times */
    char *frame_path;                   /* `single` of a frame, own */
    struct bead_trajectory *trajectory; /* NULL with a scene */
    struct bead_joined *joined;         /* with other trajectories; NULL: there are none */
    struct bead_stored stored;          /* its samples */
    double *bounds;                     /* [chains][BEAD_FIELD_COUNT]: of their errors; NULL: unknown */
    const struct bead_scene *source;    /* of the scene, sweep or trajectory */
    struct bead_chain **own_chains;
    const struct bead_chain *const *chains;
    size_t chain_count;
    const struct bead_kernels *kernels;
    int threads;
    bool passage;                        /* the scene's `until` is the default */
    bool extended;                       /* beyond that, because an output asks for later times */
    double end, needed;                  /* s; end INFINITY: not known before the run */
    double resolution;                   /* s */
    struct bead_simulate verified;       /* as the source's, with the accuracy that `verify` takes; 0: the source's */
    double tolerance_factor;             /* tolerance of comparison runs, in units of that of the runs */
    char warning[SESSION_WARNINGS][640]; /* "": none */
    bool unverified;
    bool strained;                      /* the energy of a chain suffices to take contacts beyond the model: finds their peaks */
    const struct bead_output *exacting; /* asks for the accuracy, if the scene does not; NULL: none */
    bool begun;                         /* it is running, or has run */
    struct bead_grid native;            /* of the trajectory output, every 0: none */
    const struct bead_output *keeper;   /* the trajectory output */
    struct bead_made *made;
    size_t made_count;
    struct bead_counts counts;
    struct bead_played played;                /* the last pass */
    struct bead_sensitivities *sensitivities; /* [chains] after it; NULL: no output asked for them */
    struct bead_outcome *outcomes;            /* [chains] */
    struct bead_result *results;
    size_t result_count;
};

/* The part after the last slash. */
static inline const char *bead_session_base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}
/* Is the output the file of all results of a sweep? */
static inline bool bead_session_holds_sweep(const struct bead_made *made)
{
    return bead_output_type(made->output->kind)->stores_sweep;
}
/* Is the output made, by a sink or from a sweep? */
static inline bool bead_session_makes(const struct bead_made *made)
{
    return made->sink || (made->asked && made->type && made->type->write);
}

/* Claim the files of all outputs before any is touched. On failure none is claimed. Errors: USAGE (another run is writing one), IO,
 * MEMORY. */
BEAD_CHECK enum bead_error bead_session_claim(struct bead_session *session, struct bead_message *msg);
/* Once an output is finished, others may read it, and HDF5 locks the files it reads. */
void bead_session_release_output(struct bead_made *made);
/* Gives up all claims and removes unfinished files, except the parts that a stopped run keeps. */
void bead_session_release(struct bead_session *session);

/* session_fit.c: the scene with the values that its `fit` finds. Errors: those of scenes, runs and bead_least_squares. */
BEAD_CHECK enum bead_error bead_session_fit(struct bead_session *session, struct bead_message *msg);

/* session_sinks.c */
/* The session's chains and settings, and no consumers yet. */
struct bead_play bead_session_play(const struct bead_session *session, const char *what);
/* The settings of a sweep's run. */
struct bead_sweep_settings bead_session_sweep_settings(const struct bead_session *session);
/* For sinks of outputs of sweeps. */
struct bead_run_context bead_session_sweep_context(const struct bead_session *session, const struct bead_sweep_settings *settings);
BEAD_CHECK enum bead_error bead_session_out_of_memory(struct bead_message *msg);
/* Chains begin as outlines, which suffice for most plans; this builds their arrays, unless they exist. */
BEAD_CHECK enum bead_error bead_session_lay(struct bead_session *session, struct bead_message *msg);
/* Find the sample interval that shows every oscillation of the fastest chain. */
BEAD_CHECK enum bead_error bead_session_find_resolution(struct bead_session *session, struct bead_message *msg);
/* Make the sink of an output; find what it needs and where its file goes. */
BEAD_CHECK enum bead_error bead_session_create_sink(struct bead_session *session, struct bead_made *made, struct bead_message *msg);
/* Ask a sink what it needs, within the session's chains. */
void bead_session_ask_needs(const struct bead_session *session, struct bead_made *made);
/* The latest time that any sink needs, s. */
double bead_session_latest(const struct bead_session *session);
/* Make the sinks of all outputs that are asked for. */
BEAD_CHECK enum bead_error bead_session_create_sinks(struct bead_session *session, struct bead_message *msg);
/* Does this output need to know the end of the run before it starts? */
bool bead_output_needs_end(const struct bead_output *output);

/* session_outputs.c */
/* The output of a scene that stores samples, whose times all outputs keep to; NULL: none. */
const struct bead_output *bead_session_keeper(const struct bead_scene *scene);
/* List the outputs and mark those that --only asks for. Errors: USAGE (--only names no output), MEMORY. */
BEAD_CHECK enum bead_error bead_session_list_outputs(struct bead_session *session, struct bead_message *msg);
/* Does --only let the output be made? It may be named `beads.mp4`, `movies/beads.mp4` or `beads` for movies/beads.mp4. */
bool bead_session_is_asked(const struct bead_session *session, const struct bead_output *output);
/* The type that makes an output, or one of sweeps; NULL: this program cannot make it. */
const struct bead_sink_type *bead_session_find_type(const struct bead_job *job, const struct bead_output *output, bool of_sweep);

/* session_single.c */
/* Does `-o` name a file to make, rather than a directory? */
bool bead_session_names_file(const char *output, const struct bead_own *own);
/* The scene that makes the one output asked for, a frame or the file `-o`: overrides it with `first` (NULL: nothing) before the
 * choice, then with the job's options for that output, its settings and config. Sets session->single and session->single_index; the
 * job's output becomes NULL. If the command line changes nothing, the scene keeps all outputs. Errors: USAGE, MEMORY, those of
 * bead_scene_load. */
BEAD_CHECK enum bead_error bead_session_choose(struct bead_session *session, const struct bead_scene *scene,
                                               enum bead_source_kind source, const struct bead_override *first,
                                               struct bead_scene **changed, struct bead_message *msg);
/* session_scene.c: the same for the one of several chains that the job's configuration names; *index becomes its number. Errors:
 * USAGE (no chain has this name), those above. */
BEAD_CHECK enum bead_error bead_session_choose_chain(struct bead_session *session, const struct bead_scene *scene,
                                                     enum bead_source_kind source, size_t *index, struct bead_scene **changed,
                                                     struct bead_message *msg);
/* session_run.c: the run of a scene or a trajectory; finish an output; finish all that are not, those that work in the background
 * last, and list the results. Errors: those of the outputs. */
BEAD_CHECK enum bead_error bead_session_run_single(struct bead_session *session, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_session_finish(struct bead_session *session, struct bead_made *made, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_session_finish_all(struct bead_session *session, struct bead_message *msg);

/* The first contact or bead of which an output wants anything, where only peaks of a passage are wanted: beads far behind the front
 * may be dropped. 0: all are wanted. */
size_t bead_session_target(const struct bead_session *session);
/* Warn about the first chain that its front did not pass. */
void bead_session_find_lost(struct bead_session *session, const struct bead_played *played);
/* session_validity.c: could the model fail? Then the peaks of contacts are wanted. */
void bead_session_doubt(struct bead_session *session);
/* Warn where it failed, in these outcomes. */
void bead_session_judge(struct bead_session *session, const struct bead_chain *const *chains, const struct bead_outcome *outcomes,
                        size_t count);
/* As above for a sweep, from the first chain of each panel. Errors: those of runs. */
BEAD_CHECK enum bead_error bead_session_judge_sweep(struct bead_session *session, struct bead_message *msg);

/* session_verify.c: warnings; with `verify`, extra runs find the tolerance at which two runs agree to the accuracy asked for. */
BEAD_CHECK enum bead_error bead_session_verify(struct bead_session *session, struct bead_message *msg);

/* session_sensitivity.c: adds what outputs need to know about the peaks of the last pass to its outcomes. Errors: MEMORY, NUMBERS,
 * STOPPED. */
BEAD_CHECK enum bead_error bead_session_find_sensitivities(struct bead_session *session, struct bead_message *msg);
void bead_session_free_sensitivities(struct bead_session *session);

/* session_again.c: a trajectory. */
BEAD_CHECK enum bead_error bead_session_open_trajectory(struct bead_session *session, struct bead_message *msg);

/* session_join.c: open the other trajectories of the job, then give the session the chains of all, or their difference. Errors:
 * USAGE, those of bead_trajectory_open. Between these two, the chains that outputs are to show; NULL: the scene's. The files, the
 * session's trajectory first; NULL after the last. The file of chain `*number` of the session, and its number there. Close the
 * others. */
BEAD_CHECK enum bead_error bead_session_open_others(struct bead_session *session, struct bead_message *msg);
struct bead_chain_spec *bead_session_shown(const struct bead_session *session, size_t *count);
BEAD_CHECK enum bead_error bead_session_join(struct bead_session *session, struct bead_message *msg);
const struct bead_trajectory *bead_session_file(const struct bead_session *session, size_t index);
const struct bead_trajectory *bead_session_file_of(const struct bead_session *session, size_t *number);
/* Takes the bounds of sample errors from the trajectories. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_session_bound(struct bead_session *session, struct bead_message *msg);
void bead_session_part(struct bead_session *session);

/* session_scene.c: the session's scene. Errors: USAGE, those of bead_scene_load and bead_sweep_open. */
BEAD_CHECK enum bead_error bead_session_load(struct bead_session *session, struct bead_message *msg);
/* The scene with only a sheet, the file `-o`, of its sweep, or a sweep of its chain if it has none. */
BEAD_CHECK enum bead_error bead_session_choose_sheet(struct bead_session *session, const struct bead_scene *scene,
                                                     struct bead_scene **changed, struct bead_message *msg);

/* session_sweep.c: the scene's sweeps; a sweep's file; running and planning. */
BEAD_CHECK enum bead_error bead_session_open_sweep(struct bead_session *session, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_session_open_sweep_file(struct bead_session *session, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_session_run_sweep(struct bead_session *session, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_session_plan_sweep(const struct bead_session *session, FILE *out, struct bead_message *msg);
