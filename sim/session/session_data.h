/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of a session, shared by the session_*.c. */
#ifndef BEADREEL_SIM_SESSION_SESSION_DATA_H
#define BEADREEL_SIM_SESSION_SESSION_DATA_H

#include "beadreel/session.h"
#include "sim/session/driver.h"

/* One output of the scene, in its order. */
struct bead_made {
    const struct bead_output *output;
    struct bead_output changed;               /* what replaces it where `-o FILE` names it */
    const struct bead_sink_type *type;        /* NULL: this program cannot make it */
    struct bead_sink *sink;                   /* NULL: skipped */
    const struct bead_sweep_sink *sweep_type; /* the same for outputs of sweeps */
    bool asked;                               /* not excluded by --only */
    bool shared;                              /* draws from the samples of the trajectory output */
    bool ended;
    char *path;                    /* where it goes */
    char *poster;                  /* of `changed`, own */
    struct bead_frame_asked frame; /* of `single`, with the job's frame */
    char *part;                    /* what a stopped run leaves of it; NULL: nothing */
    struct bead_claim *claims[2];  /* on `path` and on a second file; NULL: none */
    struct bead_needs needs;
    struct bead_range range; /* found by scouting */
};

/* Of the step, of what could not be verified. */
enum { SESSION_WARNINGS = 2 };

struct bead_sensitivities; /* session_sensitivity.c */

struct bead_session {
    struct bead_job job;
    struct bead_scene *scene;           /* own; NULL with a trajectory or a sweep's file */
    struct bead_sweep *sweep;           /* of scenes with sweeps, and their files */
    bool sweep_read;                    /* it comes from a file */
    const char *single;                 /* the one file to make, where -o names it; else NULL */
    size_t single_index;                /* of its output in the scene */
    bool amid;                          /* the other outputs stay known: frames keep the sample times of a trajectory */
    char *config;                       /* the job's as a setting of scenes, own; job.config, too, from then on */
    char *frame_path;                   /* what `single` is for a frame, own */
    struct bead_trajectory *trajectory; /* NULL with a scene */
    const struct bead_scene *source;    /* either's */
    struct bead_chain **own_chains;
    const struct bead_chain *const *chains;
    size_t chain_count;
    const struct bead_kernels *kernels;
    int threads;
    bool passage;                        /* the scene's `until` is the default */
    bool extended;                       /* beyond that, since an output asks for later times */
    double end, needed;                  /* s; end INFINITY: not known before the run */
    double resolution;                   /* s */
    double refinement;                   /* tolerance of the runs, in units of what is asked */
    double tolerance_factor;             /* of comparison runs, in the same units */
    char warning[SESSION_WARNINGS][320]; /* "": none */
    bool unverified;
    struct bead_grid native;          /* of the trajectory output, every 0: none */
    const struct bead_output *keeper; /* that output */
    struct bead_made *made;
    size_t made_count;
    struct bead_counts counts;
    uint64_t scout_steps;                     /* steps of passes before the last */
    struct bead_passed passed;                /* the last pass */
    struct bead_sensitivities *sensitivities; /* [chains] after it; NULL: nobody asked */
    struct bead_outcome *outcomes;            /* [chains] */
    struct bead_result *results;
    size_t result_count;
};

/* session_claims.c */
/* A scene may be a stranger's: files that it names stay in the output directory, unless the job allows more. Errors: SCENE. */
BEAD_CHECK enum bead_error bead_session_check_inside(const struct bead_session *session, const struct bead_output *output,
                                                     const char *path, struct bead_message *msg);
/* Claim the files of all outputs before any is touched. On failure none is claimed. Errors: USAGE (another run is writing one), IO,
 * MEMORY. */
BEAD_CHECK enum bead_error bead_session_claim(struct bead_session *session, struct bead_message *msg);
/* As soon as an output is finished others may read it, and HDF5 locks what it reads. */
void bead_session_release_output(struct bead_made *made);
/* What was claimed and not finished goes, but for what a stopped run keeps. */
void bead_session_release(struct bead_session *session);

/* session_sinks.c */
/* A driver with the session's chains and settings and no consumers yet. */
struct bead_driver bead_session_driver(const struct bead_session *session, const char *what);
BEAD_CHECK enum bead_error bead_session_out_of_memory(struct bead_message *msg);
/* Chains begin as outlines, which are enough for most plans; this builds their arrays, where that has not been done. */
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

/* session_outputs.c: list the outputs and mark those that --only asks for. Errors: USAGE (--only names no output), MEMORY. */
BEAD_CHECK enum bead_error bead_session_list_outputs(struct bead_session *session, struct bead_message *msg);
/* Is it the file of all results of a sweep? */
bool bead_session_holds_sweep(const struct bead_made *made);
/* Behind the last slash. */
const char *bead_session_base_name(const char *path);
/* Does --only NAME mean it: `beads.mp4`, `movies/beads.mp4` or `beads` for movies/beads.mp4? */
bool bead_session_is_named(const struct bead_output *output, const char *name);
/* The one output that is made, where `single` is. */
struct bead_made *bead_session_single_made(const struct bead_session *session);
/* NULL: this program cannot make it. */
const struct bead_sink_type *bead_session_find_type(const struct bead_job *job, const struct bead_output *output);

/* session_single.c */
/* Does `-o` name a file to make, rather than a directory? */
bool bead_session_names_file(const char *output);
/* An output that a file alone can ask for, by its ending; more: ", show: sensors" or NULL. */
struct bead_file_kind {
    enum bead_output_kind kind; /* BEAD_OUTPUT_KINDS: behind the last */
    const char *more;
};
/* `[{movie: "a.mp4"}]` for a file of the first kind that it ends like; to be freed. Errors: USAGE, MEMORY. */
BEAD_CHECK enum bead_error bead_session_outputs_for(const char *file, const struct bead_file_kind *kinds, char **outputs,
                                                    struct bead_message *msg);
/* Settings of a scene: the job's config, `first` (NULL: none; borrowed), the outputs (NULL: those of the scene), what the job's
 * options say of output `index`, then the job's settings. To be freed only where there was no error. Errors: MEMORY. */
struct bead_settings {
    const char **all;
    size_t count;
    char **own;
    size_t own_count;
};
BEAD_CHECK enum bead_error bead_session_settings_make(const struct bead_job *job, size_t index, const char *outputs,
                                                      const char *first, struct bead_settings *settings, struct bead_message *msg);
void bead_session_settings_free(struct bead_settings *settings);
/* A scene as it is, but for the user's own settings. Errors: those of bead_scene_load. */
BEAD_CHECK enum bead_error bead_session_load_plain(const struct bead_session *session, const char *path, struct bead_scene **scene,
                                                   struct bead_message *msg);
/* Settings that leave nothing but the output of the scene that `-o FILE` means; where it has none (or is NULL), one of `kinds`.
 * None where the command line changes nothing: session->single_index is the output then. To be freed in any case. Errors: USAGE,
 * MEMORY. */
BEAD_CHECK enum bead_error bead_session_single_settings(struct bead_session *session, const struct bead_scene *scene,
                                                        const struct bead_file_kind *kinds, struct bead_settings *settings,
                                                        struct bead_message *msg);
/* What is found wrong with an output once it is known where it stands in a scene, as in `run.h5:9:3: colormap: ...`, names the
 * option that set the key, where one did. */
void bead_session_name_option(const struct bead_job *job, struct bead_message *msg);
/* Can the program make the file that `-o` names, once its types are known? Errors: USAGE. */
BEAD_CHECK enum bead_error bead_session_check_single(const struct bead_session *session, const struct bead_made *made,
                                                     struct bead_message *msg);
/* The session's only output, which may then be changed, and its poster beside it. Errors: USAGE, MEMORY. */
BEAD_CHECK enum bead_error bead_session_place_single(const struct bead_session *session, struct bead_made *made,
                                                     struct bead_message *msg);

/* session_frame.c: which movie of the scene the job's frame is of, and where it goes; settings as above. Errors: USAGE, MEMORY. */
BEAD_CHECK enum bead_error bead_session_frame_settings(struct bead_session *session, const struct bead_scene *scene,
                                                       struct bead_settings *settings, struct bead_message *msg);
/* What the job's frame says. Errors: USAGE, MEMORY. */
BEAD_CHECK enum bead_error bead_session_read_frame(const struct bead_session *session, struct bead_frame_asked *frame,
                                                   struct bead_message *msg);

/* session_verify.c: warnings; and with `verify` the tolerance at which two runs agree to what was asked, in runs of their own. */
BEAD_CHECK enum bead_error bead_session_verify(struct bead_session *session, struct bead_message *msg);

/* session_sensitivity.c: what outputs want to know of the peaks of the last pass, into its outcomes. Errors: MEMORY, NUMBERS,
 * STOPPED. */
BEAD_CHECK enum bead_error bead_session_find_sensitivities(struct bead_session *session, struct bead_message *msg);
void bead_session_free_sensitivities(struct bead_session *session);

/* session_again.c: a trajectory. */
BEAD_CHECK enum bead_error bead_session_open_trajectory(struct bead_session *session, struct bead_message *msg);

/* session_sweep.c: the scene's sweeps; a sweep's file; one configuration of it as the session's scene; running and planning. */
/* What `-o FILE` may be of a sweep. */
extern const struct bead_file_kind bead_sweep_file_kinds[];
BEAD_CHECK enum bead_error bead_session_open_sweep(struct bead_session *session, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_session_open_sweep_file(struct bead_session *session, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_session_load_sheet(struct bead_session *session, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_session_load_configuration(struct bead_session *session, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_session_run_sweep(struct bead_session *session, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_session_plan_sweep(const struct bead_session *session, FILE *out, struct bead_message *msg);

#endif
