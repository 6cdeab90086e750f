/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command line of both programs: options, help, lists, progress and results.
 * Linked into the two programs only: the libraries neither print nor exit. */
#pragma once

#include <limits.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <time.h>

#include "beadreel/error.h"
#include "beadreel/session.h"
#include "beadreel/sink.h"
#include "beadreel/trajectory.h"
#include "sim/base/library.h"
#include "sim/scene/scene_internal.h"
#include "sim/sweep/sweep_internal.h"

/* One thing that --list can show: a line each with a name and a description. */
#define COMMAND_LISTS(print) enum bead_error print(FILE *out, __attribute__((unused)) struct bead_message *msg)
struct command_list {
    const char *name;
    COMMAND_LISTS((*print));
};

/* The differences between the two programs. */
struct command_program {
    const char *name;                                 /* "beadreel" */
    const char *purpose;                              /* one line for --help */
    const char *usage, *examples;                     /* paragraphs for --help */
    const struct command_list *lists;                 /* ends with a NULL name */
    const struct bead_sink_type *const *const *sinks; /* for the job, NULL-terminated */
    const char *const *canvases;                      /* what --canvas allows, NULL-terminated; NULL: the program does not draw */
    /* The scene in the file of a picture, film or page, as bead_origin_read; NULL: the program makes none. */
    enum bead_error (*find_origin)(const char *path, char **source, char *version, size_t size, struct bead_message *msg);
};

enum command_action {
    COMMAND_RUN,
    COMMAND_PLAN,
    COMMAND_LIST,
    COMMAND_INFO,
    COMMAND_VERIFY,
    COMMAND_REPRODUCE,
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
    struct bead_job job; /* the session's part of it */
    bool json, watch, no_config, crate;
    bool piped;                             /* the one file goes to standard output */
    struct bead_config *config;             /* the user's own settings, owned; NULL: none */
    const char *kind;                       /* of a new scene */
    const char **settings, **only, **parts; /* owned arrays; parts: files to merge */
    char **looks;                           /* owned, and their texts */
    size_t part_count;
    enum command_progress progress;
};

/* The whole program: returns the exit status (0 done, 1 failed while running, 2 wrong command line or scene, 128+n signal n). */
int command_main(const struct command_program *program, int argc, char **argv);

/* Options and the input of a command line into `command`, whose arrays have room for argc strings. Errors: USAGE. */
enum bead_error command_parse(struct command *command, int argc, char **argv, struct bead_message *msg);
/* The user's own settings, and what --info says about them. Errors: those of bead_config_load; SCENE (no such canvas). */
enum bead_error command_load_config(struct command *command, struct bead_message *msg);
/* Changes of scenes: --set, and the user's own settings. */
struct bead_overrides command_overrides(const struct command *command);
void command_print_config(FILE *out, const struct bead_config *config);
struct bead_json;
void command_write_config(struct bead_json *json, const struct bead_config *config);
struct bead_option;

/* A row of the table of options. */
struct command_option {
    const char *name;
    char letter; /* 0: none */
    const char *argument;
    const char *help;           /* one line; %s: the words it takes */
    const char *const *words;   /* the only values it takes, NULL-terminated; NULL: any, or as `apply` checks */
    size_t text, flag;          /* offsets in struct command, of a text that keeps the value and of a flag that is set; 0: none */
    enum command_action action; /* the action asked for; COMMAND_RUN: the option does not choose one */
    bool draws;                 /* only for programs that draw */
    enum bead_error (*apply)(struct command *command, const char *value, struct bead_message *msg); /* NULL: no more than that */
    const char
        *separators; /* for keys of the output -o: characters between the values of a list; "": one value; NULL: no such key */
    bool run;        /* 10:20 are all from 10 to 20, written 10..20 */
    const struct bead_option *key; /* that key, if it has choices; NULL: the choices of the list with its name, if any */
};

/* Row i of the table; NULL: there are no more. */
const struct command_option *command_option(size_t i);
/* Does this program have the option? A program that does not draw has no options for drawing. */
bool command_offers(const struct command_program *program, const struct command_option *row);
/* The only values that an option takes, at most COMMAND_MOST_WORDS of them; returns their number, 0 if any value may be tried. */
enum { COMMAND_MOST_WORDS = 16 };
size_t command_words(const struct command_program *program, const struct command_option *row,
                     const char *words[COMMAND_MOST_WORDS]);

/* The exit status: the error's, or 128 + N if signal N stopped the run. */
int command_status(enum bead_error err, int signal);

/* The actions. Errors: those of session.h, scene.h, trajectory.h; IO if stdout fails. */
enum bead_error command_run(const struct command *command, const volatile sig_atomic_t *stop, struct bead_message *msg);
/* Makes a new directory, and removes it with its contents. Errors: IO. */
enum bead_error command_make_temporary(char path[PATH_MAX], struct bead_message *msg);
void command_remove_temporary(const char *path);
enum bead_error command_plan(const struct command *command, const volatile sig_atomic_t *stop, struct bead_message *msg);
enum bead_error command_verify(const struct command *command, struct bead_message *msg);
enum bead_error command_merge(const struct command *command, struct bead_message *msg);
/* Makes the file `job.input` again from the scene stored in it, in a new directory or in -o, and says whether all bytes agree.
 * Errors: those of command_run; NUMBERS: they do not; FORMAT: the file has no scene. */
enum bead_error command_reproduce(const struct command *command, const volatile sig_atomic_t *stop, struct bead_message *msg);
/* Refuses a --crate whose files the run reads: before it begins. Errors: USAGE. */
enum bead_error command_crate_spare(const struct command *command, const struct bead_session *session, struct bead_message *msg);
/* --crate: writes ro-crate-metadata.json beside the results of a run, and the scene as it was run, ro-crate-scene.yaml. The crate
 * is a Process Run Crate (https://w3id.org/ro/wfrun/process/0.5). `began`: when the run did. Errors: IO, MEMORY. */
enum bead_error command_crate(const struct command *command, const struct bead_session *session, time_t began,
                              struct bead_message *msg);
/* A file's account of how it was made. */
struct command_origin {
    char *scene;               /* owned; NULL: nothing */
    char version[32];          /* of the program; "": not said */
    char file[4096];           /* the name of the scene's file; "": not said */
    char frame[64], still[16]; /* the options that it was made with; "": without */
    char beside[256];          /* another file that says so; "": the file itself */
};
/* Errors: IO, FORMAT, MEMORY. */
enum bead_error command_find_origin(const struct command *command, const char *path, struct command_origin *origin,
                                    struct bead_message *msg);
enum bead_error command_info(const struct command *command, FILE *out, struct bead_message *msg);

/* Lists that need no graphics. */
COMMAND_LISTS(command_list_scenes);
COMMAND_LISTS(command_list_materials);
COMMAND_LISTS(command_list_methods);
COMMAND_LISTS(command_list_laws);
COMMAND_LISTS(command_list_equations); /* that a chain can solve instead of having beads */
COMMAND_LISTS(command_list_measures);
COMMAND_LISTS(command_list_thresholds);
COMMAND_LISTS(command_list_libraries); /* that are opened at run time */
void command_list_opened(FILE *out, const struct bead_library_info *library);
COMMAND_LISTS(command_list_keys);   /* of scenes: unit, range, default */
COMMAND_LISTS(command_list_schema); /* of the same: a JSON Schema, for editors */

/* --watch: runs the scene, and again each time its file is saved, until a signal. --new: a scene to start from. Errors: those of
 * command_run; USAGE, IO. */
enum bead_error command_watch(const struct command *command, const volatile sig_atomic_t *stop, struct bead_message *msg);
enum bead_error command_new(const struct command *command, struct bead_message *msg);
/* Sets the session whose unfinished files are removed if a fault ends the program; NULL: none. */
void command_guard(struct bead_session *session);
/* Installs the handlers. */
void command_catch_faults(void);
/* Makes small stacks (ulimit -s) as large as usual, and spares addresses where they are few (ulimit -v). */
void command_take_room(void);
/* Prints words with names of files, or other text that may come from anybody, without control characters. */
BEAD_PRINTF(2, 3) void command_print(FILE *out, const char *format, ...);
/* The same for everything that is written to `file`, once it is released. Errors: `err`, MEMORY. */
struct command_held {
    FILE *file;
    char *text;
    size_t size;
};
BEAD_CHECK enum bead_error command_hold(struct command_held *held, struct bead_message *msg);
BEAD_CHECK enum bead_error command_let_go(struct command_held *held, FILE *out, enum bead_error err, struct bead_message *msg);
/* The message on stderr. */
void command_complain(const struct command_program *program, enum bead_error err, const struct bead_message *msg);
/* As above for a warning, which may have several lines. */
void command_warn(const struct command_program *program, const char *warning);
/* Is the result to be JSON on stdout? */
bool command_is_json(const struct command *command);
/* The result of a run: one line on stdout. `session` is NULL if it could not be opened. */
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
void command_write_runs(struct bead_json *json, const struct bead_chain *const *chains, const struct bead_outcome *outcomes,
                        size_t count);

/* Progress on stderr. */
struct command_meter {
    enum command_progress mode;     /* AUTO: a bar on a terminal */
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

/* The beads of a chain by materials, and the stiffness of its contacts: how the scene was understood. */
void command_print_beads(FILE *out, const struct bead_chain *chain);
void command_write_beads(struct bead_json *json, const struct bead_chain *chain);

/* "4.76 mm", "470 kB": number with an SI prefix and unit into `text`; returns text. */
const char *command_quantity(double value, const char *unit, char *text, size_t size);
