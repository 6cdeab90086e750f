/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options of both programs: one table gives parser, help, man page, completion and error messages. */
#include "sim/cli/command_line.h"

#include <errno.h>
#include <getopt.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/base/suggest.h"
#include "sim/kinds/outputs.h"
#include "sim/scene/scene_private.h"

static const char *const progress_words[] = {[COMMAND_PROGRESS_AUTO] = "auto",
                                             [COMMAND_PROGRESS_PLAIN] = "plain",
                                             [COMMAND_PROGRESS_JSON] = "json",
                                             [COMMAND_PROGRESS_NONE] = "none",
                                             NULL};
static const char *const instruction_words[] = {"portable", "sse2", "avx2", "avx512", NULL};

static enum bead_error set_setting(struct command *command, const char *value, struct bead_message *msg)
{
    const char *equals = strchr(value, '=');
    if (!equals || equals == value)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--set: `%s` is not of the form key.path=value", value);
    command->settings[command->job.setting_count++] = value;
    return BEAD_OK;
}

static enum bead_error set_only(struct command *command, const char *value, struct bead_message *msg)
{
    if (!*value)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--only: NAME is empty");
    command->only[command->job.only_count++] = value;
    return BEAD_OK;
}

static enum bead_error set_threads(struct command *command, const char *value, struct bead_message *msg)
{
    char *end;
    errno = 0;
    long threads = strtol(value, &end, 10);
    if (end == value || *end || errno || threads < 0 || threads > 1024)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--threads: `%s` is not a whole number from 0 (all cores) to 1024", value);
    command->job.threads = (int)threads;
    return BEAD_OK;
}

static size_t place_of(const char *word, const char *const *words)
{
    size_t i = 0;
    while (strcmp(word, words[i]) != 0)
        i++;
    return i;
}

static enum bead_error set_progress(struct command *command, const char *value, struct bead_message *)
{
    command->progress = (enum command_progress)place_of(value, progress_words);
    return BEAD_OK;
}

static const char *const still_words[] = {"poster", NULL};
static const char *const new_words[] = {"paper", "lecture", "sweep", "compare", NULL};

static enum bead_error set_quiet(struct command *command, const char *, struct bead_message *)
{
    command->progress = COMMAND_PROGRESS_NONE;
    return BEAD_OK;
}

static enum bead_error check_draws(const struct command *command, const char *option, struct bead_message *msg)
{
    if (command->program->canvases)
        return BEAD_OK;
    return bead_fail(msg, BEAD_ERROR_USAGE, "--%s: %s does not draw", option, command->program->name);
}

static enum bead_error set_list(struct command *command, const char *value, struct bead_message *)
{
    command->action = COMMAND_LIST;
    command->list = command->program->lists;
    while (strcmp(command->list->name, value) != 0)
        command->list++;
    return BEAD_OK;
}

static enum bead_error set_shard(struct command *command, const char *value, struct bead_message *msg)
{
    char *slash = NULL, *end = NULL;
    errno = 0;
    unsigned long part = strtoul(value, &slash, 10), parts = *slash == '/' ? strtoul(slash + 1, &end, 10) : 0;
    if (*value < '0' || *value > '9' || *slash != '/' || slash[1] < '0' || slash[1] > '9' || *end || errno || part < 1 ||
        part > parts || parts > 1000000)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--shard: `%s` is not of the form K/N with K from 1 to N, N at most 1000000",
                         value);
    command->job.part = part;
    command->job.parts = parts;
    return BEAD_OK;
}

/* --help alone is for people. With a value it prints the source of the man pages and the shell's completion. */
static enum bead_error set_help(struct command *command, const char *value, struct bead_message *msg)
{
    static const struct {
        const char *value;
        enum command_action action;
    } parts[] = {{"man", COMMAND_MAN}, {"man-keys", COMMAND_MAN_KEYS}, {"words", COMMAND_WORDS}};
    command->action = COMMAND_HELP;
    if (!value)
        return BEAD_OK;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        if (strcmp(value, parts[i].value) == 0)
            command->action = parts[i].action;
    }
    return command->action != COMMAND_HELP ? BEAD_OK : bead_fail(msg, BEAD_ERROR_USAGE, "--help: takes no value");
}

#define COMMAND(member) offsetof(struct command, member)
static const struct command_option rows[] = {
    {"output", 'o', "PATH", "directory for a scene's files (default: this one), or the one file, by its ending; -: standard output",
     .text = COMMAND(job.output)},
    {"set", 0, "KEY=VALUE", "change the scene, as in --set chain.striker.velocity='1 m/s' (repeatable)", .apply = set_setting},
    {"only", 0, "NAME", "make only this output, named by its file (repeatable)", .apply = set_only},
    {"field", 0, "NAME", "of the file -o: what it shows, such as velocity", .separators = "", .key = bead_field_row},
    {"colormap", 0, "NAME", "of the file -o: its colours, one of --list colormaps, or a text file of them", .separators = ""},
    {"range", 0, "LOW:HIGH", "of the file -o: values at the ends of the colours", .separators = ":,-"},
    {"time", 0, "FROM:TO", "of the file -o: span of time, such as 0.2ms:1ms", .separators = ":,"},
    {"beads", 0, "FIRST:LAST", "of the file -o: which beads", .separators = ":,-", .run = true},
    {"size", 0, "WxH", "of the file -o: in pixels, or as lengths: 86mmx60mm", .separators = "x,"},
    {"style", 0, "NAME", "of the file -o: paper, slide or movie", .separators = "", .key = bead_page_rows},
    {"views", 0, "VIEW,VIEW", "of the file -o: what is drawn, from top to bottom; see --list views", .separators = ","},
    {"frame", 0, "MOMENT", "draw only a frame of the scene's film as a picture: 2.1ms of the motion, 50% of the film, or peak",
     .text = COMMAND(job.frame), .draws = true},
    {"still", 0, "KIND", "draw only the film's beads, large, as PNG, for a title slide: poster; at the peak, or --frame MOMENT",
     .words = still_words, .text = COMMAND(job.still), .draws = true},
    {"plan", 0, NULL, "show what would be computed, what is skipped, and why; compute nothing", .action = COMMAND_PLAN},
    {"new", 0, "KIND", "write a commented scene to start from, KIND.yaml or -o FILE: paper, lecture, sweep or compare",
     .words = new_words, .text = COMMAND(kind), .action = COMMAND_NEW},
    {"watch", 0, NULL, "run the scene again whenever it is saved, until interrupted", .flag = COMMAND(watch)},
    {"list", 0, "WHAT", "list %s", .apply = set_list},
    {"info", 0, "FILE", "describe a scene, a trajectory or the results of a sweep", .text = COMMAND(job.input),
     .action = COMMAND_INFO},
    {"verify", 0, "FILE", "say whether a finished trajectory, or a sweep's file, is bit for bit what was written",
     .text = COMMAND(job.input), .action = COMMAND_VERIFY},
    {"reproduce", 0, "FILE", "make a picture, film, table or trajectory again, from the scene stored in it: same bits?",
     .text = COMMAND(job.input), .action = COMMAND_REPRODUCE},
    {"crate", 0, NULL, "describe the run for archives, beside its files: ro-crate-metadata.json", .flag = COMMAND(crate)},
    {"configuration", 0, "N",
     "only chain N of a sweep (NAME:N of several sweeps), or chain NAME of several chains, into the file -o",
     .text = COMMAND(job.configuration)},
    {"diff", 0, NULL, "show the second of two trajectories minus the first, into the file -o", .flag = COMMAND(job.difference)},
    {"sheet", 0, NULL, "draw only a contact sheet, of a sweep or of a random chain, into the file -o", .flag = COMMAND(job.sheet),
     .draws = true},
    {"allow-outside", 0, NULL, "let the scene write outside the directory -o (absolute paths, `..`); for scenes you trust",
     .flag = COMMAND(job.allow_outside)},
    {"shard", 0, "K/N", "compute part K of N of a sweep into a file of its own: sweep.h5 becomes sweep.KofN.h5",
     .apply = set_shard},
    {"merge", 0, NULL, "merge the given parts of a sweep, in any order, into the file -o", .action = COMMAND_MERGE},
    {"no-config", 0, NULL, "without your own settings, beadreel/config.yaml in ~/.config", .flag = COMMAND(no_config)},
    {"threads", 0, "N", "use N threads (default 0: all cores); the results do not depend on N", .apply = set_threads},
    {"instructions", 0, "SET", "portable, or on x86-64 sse2, avx2 or avx512 (default: the best there is); the results are the same",
     .words = instruction_words, .text = COMMAND(job.instructions)},
    {"canvas", 0, "NAME", "what paints beads: osmesa (the default), else egl, else plain, which is the fastest; all look the same",
     .text = COMMAND(job.canvas), .draws = true},
    {"progress", 0, "HOW", "how to show progress on stderr: auto (default), plain, json (the result is JSON, too) or none",
     .words = progress_words, .apply = set_progress},
    {"quiet", 'q', NULL, "the same as --progress none", .apply = set_quiet},
    {"json", 0, NULL, "print the result, the plan or the description as one JSON object", .flag = COMMAND(json)},
    {"help", 'h', NULL, "show this help", .apply = set_help},
    {"version", 'V', NULL, "show the version and the licence", .action = COMMAND_VERSION},
};
enum { ROWS = sizeof rows / sizeof *rows };

const struct command_option *command_option(size_t i)
{
    return i < ROWS ? &rows[i] : NULL;
}

bool command_offers(const struct command_program *program, const struct command_option *row)
{
    return program->canvases || (!row->draws && !row->separators);
}

size_t command_words(const struct command_program *program, const struct command_option *row, const char *words[COMMAND_MOST_WORDS])
{
    const char *const *list = row->text == COMMAND(job.canvas) ? program->canvases : row->words;
    size_t count = 0;
    for (; list && count < COMMAND_MOST_WORDS && list[count]; count++)
        words[count] = list[count];
    for (const struct command_list *l = program->lists; row->apply == set_list && count < COMMAND_MOST_WORDS && l->name; l++)
        words[count++] = l->name;
    return count;
}

static enum bead_error check_word(const struct command_program *program, const struct command_option *row, const char *value,
                                  struct bead_message *msg)
{
    const char *words[COMMAND_MOST_WORDS];
    char all[160] = "", near[64];
    struct bead_suggest search;
    size_t count = command_words(program, row, words);
    bead_suggest_begin(&search, value);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(value, words[i]) == 0)
            return BEAD_OK;
        bead_list_add(all, sizeof all, ", ", words[i]);
        bead_suggest_try(&search, words[i]);
    }
    return bead_fail(msg, BEAD_ERROR_USAGE, "--%s: unknown value `%s`%s (allowed: %s)", row->name, value,
                     bead_suggest_text(&search, near, sizeof near), all);
}

/* Explains why getopt_long rejected an option. */
static enum bead_error unknown_option(char **argv, int found, struct bead_message *msg)
{
    char near[64];
    if (found == ':')
        for (size_t i = 0; i < ROWS; i++)
            if (rows[i].letter == optopt || 256 + (int)i == optopt)
                return bead_fail(msg, BEAD_ERROR_USAGE, "--%s: needs a value: %s", rows[i].name, rows[i].argument);
    if (optopt >= 256 && optopt < 256 + ROWS)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--%s: takes no value", rows[optopt - 256].name);
    if (optopt)
        return bead_fail(msg, BEAD_ERROR_USAGE, "unknown option `-%c`; see --help", optopt);
    char word[64], home[96];
    struct bead_suggest search;
    snprintf(word, sizeof word, "%.*s", (int)strcspn(argv[optind - 1], "="), argv[optind - 1]);
    if (strncmp(word, "--", 2) == 0 && bead_scene_tables.home(word + 2, home, sizeof home))
        return bead_fail(msg, BEAD_ERROR_USAGE, "unknown option `%s`; it is a key of scenes: --set %s=VALUE", word, home);
    bead_suggest_begin(&search, word);
    char names[ROWS][32];
    for (size_t i = 0; i < ROWS; i++) {
        snprintf(names[i], sizeof names[i], "--%s", rows[i].name);
        bead_suggest_try(&search, names[i]);
    }
    bead_suggest_text(&search, near, sizeof near);
    return bead_fail(msg, BEAD_ERROR_USAGE, "unknown option `%s`%s", word, *near ? near : "; see --help");
}

/* `10..20`, as in sweeps, and `10–20`, as in print, become `10:20`. */
static void put_colons(char *value)
{
    static const char *const dashes[] = {"..", "\xe2\x80\x93"};
    for (size_t i = 0; i < sizeof dashes / sizeof *dashes; i++) {
        char *dash = strstr(value, dashes[i]);
        if (!dash)
            continue;
        const size_t length = strlen(dashes[i]);
        *dash = ':';
        memmove(dash + 1, dash + length, strlen(dash + length) + 1);
    }
}

/* "0.2ms:1ms" as a scene has it: "[0.2ms, 1ms]"; "30:" is "[30, auto]", and of a run of places "30..auto". Values written as in a
 * scene stay so; lists of words, with a single separator, may have just one. To be freed; NULL: out of memory. */
static char *as_list(const char *given, const char *separators, bool run)
{
    BEAD_FREED char *value = strdup(given);
    if (!value)
        return NULL;
    if (strchr(separators, ':'))
        put_colons(value);
    const bool words = *separators && !separators[1];
    char *text = NULL;
    size_t size = 0;
    /* A minus that begins a number, or its exponent, separates nothing: `-5:5`, `1e-3`. */
    const bool minus = strchr(value, ':') || strchr(value, ',') || *value == '-' || strstr(value, "e-") || strstr(value, "E-");
    const char *parts = minus && strchr(separators, '-') ? ":," : separators;
    if (!*parts || *value == '[' || (!words && !value[strcspn(value, parts)]))
        return strdup(given);
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    run = run && !strchr(value, ',');
    fputs(run ? "" : "[", out);
    for (const char *at = value;; at++) {
        const size_t length = strcspn(at, parts);
        fprintf(out, "%.*s", length ? (int)length : 4, length ? at : "auto");
        at += length;
        if (!*at)
            break;
        fputs(run ? ".." : ", ", out);
    }
    fputs(run ? "" : "]", out);
    if (fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}

/* A key of the output that -o names. */
static enum bead_error add_look(struct command *command, const struct command_option *row, const char *value,
                                struct bead_message *msg)
{
    BEAD_FREED char *list = as_list(value, row->separators, row->run);
    char **look = &command->looks[command->job.look_count];
    BEAD_TRY(check_draws(command, row->name, msg));
    if (!list || asprintf(look, "--%s=%s", row->name, list) < 0)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory");
    command->job.look_count++;
    return BEAD_OK;
}

/* Applies the members of the row, then its function. */
static enum bead_error apply_row(struct command *command, const struct command_option *row, const char *value,
                                 struct bead_message *msg)
{
    if (row->text && !*value)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--%s: %s is empty", row->name, row->argument);
    if (row->text)
        *(const char **)(void *)((char *)command + row->text) = value;
    if (row->flag)
        *(bool *)(void *)((char *)command + row->flag) = true;
    if (row->action != COMMAND_RUN)
        command->action = row->action;
    BEAD_TRY(row->draws ? check_draws(command, row->name, msg) : BEAD_OK);
    return row->apply ? row->apply(command, value, msg) : BEAD_OK;
}

static enum bead_error take_input(struct command *command, int argc, char **argv, struct bead_message *msg)
{
    const bool runs = command->action == COMMAND_RUN || command->action == COMMAND_PLAN;
    if (runs && optind < argc && !command->job.input)
        command->job.input = argv[optind++];
    while ((command->action == COMMAND_MERGE || runs) && optind < argc)
        command->parts[command->part_count++] = argv[optind++];
    if (runs) {
        command->job.others = command->parts;
        command->job.other_count = command->part_count;
    }
    if (optind < argc && command->job.input)
        return bead_fail(msg, BEAD_ERROR_USAGE, "one file at a time: `%s` and `%s`", command->job.input, argv[optind]);
    if (optind < argc)
        command->job.input = argv[optind++];
    if (optind < argc)
        return bead_fail(msg, BEAD_ERROR_USAGE, "one file at a time: `%s` and `%s`", command->job.input, argv[optind]);
    if (command->watch && command->action != COMMAND_RUN)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--watch: has no effect here: it is for runs of a scene");
    if (command->crate && command->action != COMMAND_RUN)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--crate: has no effect here: it is for runs of a scene");
    bool needed = command->action == COMMAND_RUN || command->action == COMMAND_PLAN;
    if (needed && (!command->job.input || !*command->job.input))
        return bead_fail(msg, BEAD_ERROR_USAGE, "no scene given; see --help, or --list scenes for ready ones");
    return BEAD_OK;
}

enum bead_error command_parse(struct command *command, int argc, char **argv, struct bead_message *msg)
{
    struct option options[ROWS + 1] = {0};
    char letters[2 * ROWS + 2] = ":"; /* a leading colon: report missing values separately */
    size_t used = 1;
    for (size_t i = 0; i < ROWS; i++) {
        int takes = rows[i].argument ? required_argument : rows[i].apply == set_help ? optional_argument : no_argument;
        options[i] = (struct option){rows[i].name, takes, NULL, 256 + (int)i};
        if (rows[i].letter)
            letters[used++] = rows[i].letter;
        if (rows[i].letter && rows[i].argument)
            letters[used++] = ':';
    }
    opterr = 0;
    for (int found; (found = getopt_long(argc, argv, letters, options, NULL)) != -1;) {
        if (found == '?' || found == ':')
            return unknown_option(argv, found, msg);
        size_t i = found >= 256 ? (size_t)found - 256 : 0;
        while (found < 256 && rows[i].letter != found)
            i++;
        const char *words[COMMAND_MOST_WORDS];
        if (command_words(command->program, &rows[i], words) > 0)
            BEAD_TRY(check_word(command->program, &rows[i], optarg, msg));
        BEAD_TRY(rows[i].separators ? add_look(command, &rows[i], optarg, msg) : apply_row(command, &rows[i], optarg, msg));
        if (command->action >= COMMAND_HELP)
            return BEAD_OK;
    }
    return take_input(command, argc, argv, msg);
}
