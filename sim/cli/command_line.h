/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command line of both programs: options, help, lists, progress and results.
 * Linked into the two programs only: the libraries neither print nor exit. */
#ifndef BEADREEL_SIM_CLI_COMMAND_LINE_H
#define BEADREEL_SIM_CLI_COMMAND_LINE_H

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "beadreel/error.h"
#include "beadreel/library.h"
#include "beadreel/session.h"
#include "beadreel/sink.h"
#include "beadreel/sweep.h"
#include "beadreel/trajectory.h"

/* One thing that --list can show: a line each with a name and a description. */
struct command_list {
    const char *name;
    enum bead_error (*print)(FILE *out, struct bead_message *msg);
};

/* What differs between the programs. */
struct command_program {
    const char *name;                                 /* "beadreel" */
    const char *purpose;                              /* one line for --help */
    const char *usage, *examples;                     /* paragraphs for --help */
    const struct command_list *lists;                 /* ends with a NULL name */
    const struct bead_sink_type *const *const *sinks; /* for the job, NULL-terminated */
    const struct bead_sweep_sink *const *const *sweep_sinks;
    const char *const *canvases; /* what --canvas allows, NULL-terminated; NULL: the program does not draw */
};

enum command_action {
    COMMAND_RUN,
    COMMAND_PLAN,
    COMMAND_LIST,
    COMMAND_INFO,
    COMMAND_MERGE,
    COMMAND_NEW,
    COMMAND_HELP,
    COMMAND_MAN,
    COMMAND_MAN_KEYS,
    COMMAND_WORDS,
    COMMAND_VERSION
};
enum command_progress { COMMAND_PROGRESS_AUTO, COMMAND_PROGRESS_PLAIN, COMMAND_PROGRESS_JSON, COMMAND_PROGRESS_NONE };

/* A parsed command line; strings are borrowed from argv. */
struct command {
    const struct command_program *program;
    enum command_action action;
    const struct command_list *list;
    const char *input, *output, *instructions, *canvas, *configuration, *frame;
    bool allow_outside;
    bool sheet;
    bool json, watch, no_config;
    struct bead_config *config;             /* the user's own settings, owned; NULL: none */
    char *config_setting;                   /* the same as a setting of scenes, for --info; owned */
    const char *kind;                       /* of a new scene */
    const char **settings, **only, **parts; /* owned arrays; parts: files to merge */
    char **looks;                           /* owned, and their texts */
    size_t setting_count, only_count, part_count, look_count;
    size_t shard, shards; /* 0, 0: all */
    int threads;
    enum command_progress progress;
};

/* All of it: returns the exit status (0 done, 1 failed while running, 2 wrong command line or scene, 128+n signal n). */
int command_main(const struct command_program *program, int argc, char **argv);

/* Options and the input of a command line into `command`, whose arrays have room for argc strings. Errors: USAGE. */
enum bead_error command_parse(struct command *command, int argc, char **argv, struct bead_message *msg);
/* The user's own settings, and what --info says of them. Errors: those of bead_config_load; SCENE (no such canvas). */
enum bead_error command_load_config(struct command *command, struct bead_message *msg);
void command_print_config(FILE *out, const struct bead_config *config);
struct json;
void command_write_config(struct json *json, const struct bead_config *config);
/* "0.2ms:1ms" as a scene has it: "[0.2ms, 1ms]"; "30:" is "[30, auto]". What is written as in a scene stays so; lists of words,
 * with a single separator, may have one alone. To be freed; NULL: out of memory. */
char *command_listed(const char *value, const char *separators);
/* What the table of options says: --help, the options of the man page, a line per option for completions, --version. */
void command_print_help(const struct command_program *program, FILE *out);
void command_print_man(const struct command_program *program, FILE *out);
void command_print_words(const struct command_program *program, FILE *out);
void command_print_version(const struct command_program *program, FILE *out);

/* The exit status: that of the error, or 128 + N where signal N stopped the run. */
int command_status(enum bead_error err, int signal);

/* The actions. Errors: those of session.h, scene.h, trajectory.h; IO where stdout fails. */
enum bead_error command_run(const struct command *command, const volatile sig_atomic_t *stop, struct bead_message *msg);
enum bead_error command_plan(const struct command *command, const volatile sig_atomic_t *stop, struct bead_message *msg);
enum bead_error command_merge(const struct command *command, struct bead_message *msg);
enum bead_error command_info(const struct command *command, FILE *out, struct bead_message *msg);

/* Lists that need no graphics. */
enum bead_error command_list_scenes(FILE *out, struct bead_message *msg);
enum bead_error command_list_materials(FILE *out, struct bead_message *msg);
enum bead_error command_list_methods(FILE *out, struct bead_message *msg);
enum bead_error command_list_laws(FILE *out, struct bead_message *msg);
enum bead_error command_list_equations(FILE *out, struct bead_message *msg); /* that a chain may be instead of beads */
enum bead_error command_list_measures(FILE *out, struct bead_message *msg);
enum bead_error command_list_thresholds(FILE *out, struct bead_message *msg);
enum bead_error command_list_libraries(FILE *out, struct bead_message *msg); /* that are opened at run time */
void command_list_library(FILE *out, const struct bead_library_info *library);
enum bead_error command_list_keys(FILE *out, struct bead_message *msg);   /* of scenes: unit, range, default */
enum bead_error command_list_schema(FILE *out, struct bead_message *msg); /* of the same: a JSON Schema, for editors */

/* --watch: runs the scene, and again each time its file is saved, until a signal. --new: a scene to start from. Errors: those of
 * command_run; USAGE, IO. */
enum bead_error command_watch(const struct command *command, const volatile sig_atomic_t *stop, struct bead_message *msg);
enum bead_error command_new(const struct command *command, struct bead_message *msg);
/* The message on stderr. */
void command_complain(const struct command_program *program, enum bead_error err, const struct bead_message *msg);
/* Is the result to be JSON on stdout? */
bool command_is_json(const struct command *command);
/* That of a run: one line on stdout. `session` is NULL where it could not be opened. */
void command_print_result(const struct bead_session *session, enum bead_error err, int status, double seconds,
                          const struct bead_message *msg);
/* --plan and --info as JSON. Errors: those of what is described. */
enum bead_error command_describe_plan(FILE *out, const struct bead_session *session, struct bead_message *msg);
enum bead_error command_describe_scene(FILE *out, const struct bead_scene *scene, const struct bead_config *config,
                                       struct bead_message *msg);
enum bead_error command_describe_trajectory(FILE *out, const char *file, struct bead_trajectory *trajectory,
                                            const struct bead_config *config, struct bead_message *msg);
void command_describe_journal(FILE *out, const char *file, const struct bead_sweep_progress *progress);
void command_describe_sweep(FILE *out, const char *file, const struct bead_sweep *sweep, const struct bead_config *config);
/* "runs": an object for each chain, with its outcome. */
void command_write_runs(struct json *json, const struct bead_chain *const *chains, const struct bead_outcome *outcomes,
                        size_t count);

/* Progress on stderr. */
struct command_meter {
    enum command_progress mode;     /* AUTO stands for a bar on a terminal */
    double done_began, items_began; /* when a stage continues what a stopped process began */
    double began, said;             /* s, monotonic clock: this stage began, the last line was written */
    struct {
        double time, done;
    } marks[2]; /* some seconds ago, the older one first: the rate is that since then */
    char what[160];
    bool drawn; /* the terminal's line is not empty */
};
void command_meter_init(struct command_meter *meter, enum command_progress mode);
/* `context` is the meter; fits bead_job.progress. */
void command_meter_tell(void *context, const struct bead_progress *progress);
/* Clear the terminal's line, so that other text can be written. */
void command_meter_clear(struct command_meter *meter);
/* Seconds of a clock that only runs forward. */
double command_clock(void);

/* Print the measures (measure.h) of a chain's samples, if these have the fields it takes and are not too many. */
enum bead_error command_measures(FILE *out, struct bead_trajectory *trajectory, size_t chain, const struct bead_outcome *outcome,
                                 struct bead_message *msg);

/* "4.76 mm", "470 kB": number with an SI prefix and unit into `text`; returns text. */
const char *command_quantity(double value, const char *unit, char *text, size_t size);

#endif
