/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The frame of both programs: parse the command line, act on it, report the error and the exit status. */
#include "sim/cli/command_line.h"

#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/scene.h"
#include "sim/base/memory.h"
#include "sim/base/sandbox.h"
#include "sim/base/stop.h"
#include "sim/base/suggest.h"
#include "sim/hdf5/h5.h"
#include "sim/options/options.h"
#include "sim/scene/scene_internal.h"

/* The table of options in words: --help, man pages, completion of shells. */

/* Help text of a row; --list names what this program can list. */
static const char *row_help(const struct command_program *program, const struct command_option *row, char *text, size_t size)
{
    const char *gap = strstr(row->help, "%s");
    if (!gap)
        return row->help;
    const char *words[COMMAND_MOST_WORDS];
    char names[160] = "";
    const size_t count = command_words(program, row, words);
    for (size_t i = 0; i < count; i++)
        bead_list_add(names, sizeof names, i + 1 < count ? ", " : " or ", words[i]);
    snprintf(text, size, "%.*s%s%s", (int)(gap - row->help), row->help, names, gap + 2);
    return text;
}

/* Prints help after an option, in aligned lines. */
static void print_wrapped(const char *text, FILE *out)
{
    enum { INDENT = 26, WIDTH = 132 - INDENT };
    while (strlen(text) > WIDTH) {
        int length = WIDTH;
        while (length > 0 && text[length] != ' ')
            length--;
        if (length == 0)
            break;
        fprintf(out, "%.*s\n%*s", length, text, INDENT, "");
        text += length + 1;
    }
    fprintf(out, "%s\n", text);
}

/* The options for the file -o, in one paragraph. */
static void print_looks(FILE *out)
{
    char text[512] = "";
    const struct command_option *row;
    for (size_t i = 0; (row = command_option(i)); i++) {
        const size_t used = strlen(text);
        if (row->separators)
            snprintf(text + used, sizeof text - used, "%s--%s %s", used ? ", " : "", row->name, row->argument);
    }
    fputs("  of the file -o:         ", out);
    print_wrapped(text, out);
}

static void command_print_help(const struct command_program *program, FILE *out)
{
    char text[256], left[64];
    fprintf(out, "%s - %s\n%s\nOptions:\n", program->name, program->purpose, program->usage);
    const struct command_option *row;
    for (size_t i = 0; (row = command_option(i)); i++) {
        char letter[8] = "    ";
        if (!command_offers(program, row) || row->separators)
            continue;
        if (row->letter)
            snprintf(letter, sizeof letter, "-%c, ", row->letter);
        snprintf(left, sizeof left, "%s--%s%s%s", letter, row->name, row->argument ? " " : "", row->argument ? row->argument : "");
        fprintf(out, "  %-22s  ", left);
        print_wrapped(row_help(program, row, text, sizeof text), out);
    }
    if (program->canvases)
        print_looks(out);
    fprintf(out,
            "\n%sExit status: 0: done; 1: the run failed; 2: the command line or the scene is wrong; 128+N: stopped by signal N.\n",
            program->examples);
}

/* The options as a man page has them. */
static void command_print_man(const struct command_program *program, FILE *out)
{
    char text[256];
    const struct command_option *row;
    for (size_t i = 0; (row = command_option(i)); i++) {
        if (!command_offers(program, row))
            continue;
        fputs(".TP\n", out);
        if (row->letter)
            fprintf(out, "\\fB\\-%c\\fR, ", row->letter);
        fprintf(out, "\\fB\\-\\-%s\\fR", row->name);
        if (row->argument)
            fprintf(out, " \\fI%s\\fR", row->argument);
        fputc('\n', out);
        for (const char *c = row_help(program, row, text, sizeof text); *c; c++)
            fputs(*c == '-' ? "\\-" : *c == '\'' ? "\\(aq" : (char[]){*c, 0}, out);
        fputc('\n', out);
    }
}

/* Values that an option for a key of the output takes: the choices of that key, or the names in --list colormaps and views. */
static void print_likely(const struct command_program *program, const struct command_option *row, FILE *out)
{
    for (const char *const *choice = row->key ? row->key->choices : NULL; choice && *choice; choice++)
        fprintf(out, " %s", *choice);
    for (const struct command_list *l = program->lists; row->separators && !row->key && l->name; l++) {
        struct bead_message msg;
        BEAD_FREED char *text = NULL;
        size_t length = 0;
        FILE *list = strncmp(l->name, row->name, strlen(row->name)) == 0 ? open_memstream(&text, &length) : NULL;
        if (!list)
            continue;
        const bool listed = l->print(list, &msg) == BEAD_OK;
        if (fclose(list) == 0 && listed) {
            for (const char *line = text; *line; line += strcspn(line, "\n") + 1)
                fprintf(out, " %.*s", (int)strcspn(line, " \n"), line);
        }
    }
}

/* For the completion of shells: a line for each option, "--name -n", its argument where it has one, the values it may have; a tab;
 * help. */
static void command_print_words(const struct command_program *program, FILE *out)
{
    const char *words[COMMAND_MOST_WORDS];
    char text[256];
    const struct command_option *row;
    for (size_t i = 0; (row = command_option(i)); i++) {
        if (!command_offers(program, row))
            continue;
        fprintf(out, "--%s %c%c %s", row->name, row->letter ? '-' : '.', row->letter ? row->letter : '.',
                row->argument ? row->argument : ".");
        const size_t count = command_words(program, row, words);
        for (size_t w = 0; w < count; w++)
            fprintf(out, " %s", words[w]);
        print_likely(program, row, out);
        fprintf(out, "\t%s\n", row_help(program, row, text, sizeof text));
    }
}

/* Texts from the table of options: --help, the options of the man page, a line per option for completions, --version. */
static void command_print_version(const struct command_program *program, FILE *out)
{
    fprintf(out, "%s " BEADREEL_VERSION "\nLicence GPL-3.0-or-later: free software, without any warranty.\n", program->name);
}

/* Set by the handler, read by sessions. */
static volatile sig_atomic_t stop_signal;

static void on_signal(int number)
{
    bead_stop_ask(&stop_signal, number);
}

/* The first signal ends the run in good order; a second of the same kind kills the program, but not that of a limit of CPU time,
 * which comes every second. */
static void catch_signals(void)
{
    static const int stopping[] = {SIGINT, SIGTERM, SIGHUP, SIGXCPU};
    static const int errors_of_write[] = {SIGPIPE, SIGXFSZ}; /* a closed pipe, a file-size limit: write() says so */
    struct sigaction stop = {.sa_handler = on_signal};
    struct sigaction ignore = {.sa_handler = SIG_IGN}, before;
    sigemptyset(&stop.sa_mask);
    sigemptyset(&ignore.sa_mask);
    command_catch_faults();
    sigaction(SIGHUP, NULL, &before);
    const bool no_hangup = before.sa_handler == SIG_IGN; /* nohup */
    for (size_t i = 0; i < sizeof stopping / sizeof *stopping; i++) {
        stop.sa_flags = SA_RESTART | (stopping[i] == SIGXCPU ? 0 : (int)SA_RESETHAND);
        if (!(stopping[i] == SIGHUP && no_hangup))
            sigaction(stopping[i], &stop, NULL);
    }
    for (size_t i = 0; i < sizeof errors_of_write / sizeof *errors_of_write; i++)
        sigaction(errors_of_write[i], &ignore, NULL);
}

/* HDF5 files, and others that may have a scene in them, are read in a sandbox: if the kernel has none, the user should know.
 */
static void warn_of_files(const struct command *command)
{
    bool reads = command->action == COMMAND_REPRODUCE || (command->job.input && bead_h5_is(command->job.input));
    for (size_t i = 0; i < command->part_count; i++)
        reads = reads || bead_h5_is(command->parts[i]);
    if (reads && !bead_sandbox_is_there())
        command_warn(command->program,
                     "this kernel has no seccomp: such files are read in a process of their own, but in no sandbox; "
                     "read only files that you trust");
}

static enum bead_error act(const struct command *command, struct bead_message *msg)
{
    warn_of_files(command);
    switch (command->action) {
    case COMMAND_HELP:
        command_print_help(command->program, stdout);
        return BEAD_OK;
    case COMMAND_MAN:
        command_print_man(command->program, stdout);
        return BEAD_OK;
    case COMMAND_MAN_KEYS:
        bead_scene_help_man(stdout);
        return BEAD_OK;
    case COMMAND_WORDS:
        command_print_words(command->program, stdout);
        return BEAD_OK;
    case COMMAND_VERSION:
        command_print_version(command->program, stdout);
        return BEAD_OK;
    case COMMAND_LIST:
        if (command->job.input && command->list->print == command_list_keys)
            return bead_scene_help_of(command->job.input, stdout, msg);
        return command->list->print(stdout, msg);
    case COMMAND_INFO:
        return command_info(command, stdout, msg);
    case COMMAND_VERIFY:
        return command_verify(command, msg);
    case COMMAND_MERGE:
        return command_merge(command, msg);
    case COMMAND_NEW:
        return command_new(command, msg);
    case COMMAND_PLAN:
        return command_plan(command, &stop_signal, msg);
    case COMMAND_REPRODUCE:
    case COMMAND_RUN:
        break;
    }
    catch_signals();
    if (command->action == COMMAND_REPRODUCE)
        return command_reproduce(command, &stop_signal, msg);
    return (command->watch ? command_watch : command_run)(command, &stop_signal, msg);
}

/* All output must have been written. A reader that has gone, like `head`, has read enough: like other programs, this one then ends
 * silently, by SIGPIPE. */
static enum bead_error finish_output(struct bead_message *msg)
{
    struct pollfd out = {.fd = STDOUT_FILENO, .events = POLLOUT};
    errno = 0;
    if (!fflush(stdout) && !ferror(stdout))
        return BEAD_OK;
    const int reason = errno; /* 0: an earlier write failed */
    if (poll(&out, 1, 0) > 0 && out.revents & (POLLERR | POLLHUP)) {
        signal(SIGPIPE, SIG_DFL);
        raise(SIGPIPE);
    }
    return bead_fail(msg, BEAD_ERROR_IO, "cannot write to standard output%s%s", reason ? ": " : "", reason ? strerror(reason) : "");
}

int command_main(const struct command_program *program, int argc, char **argv)
{
    struct bead_message msg = {""};
    struct command command = {.program = program};
    enum bead_error err = BEAD_OK;
    command_take_room();
    bead_sandbox_confine();    /* scenes may be a stranger's, too */
    bead_h5_no_exit_handler(); /* all files are closed before the end */
    command.settings = calloc((size_t)argc + 1, sizeof *command.settings);
    command.only = calloc((size_t)argc + 1, sizeof *command.only);
    command.parts = calloc((size_t)argc + 1, sizeof *command.parts);
    command.looks = calloc((size_t)argc + 1, sizeof *command.looks);
    BEAD_DEFAULT(&command.job);
    command.job.settings = command.settings;
    command.job.only = command.only;
    command.job.looks = (const char *const *)command.looks;
    command.job.sinks = program->sinks;
    if (!err && (!command.settings || !command.only || !command.parts || !command.looks))
        err = bead_fail(&msg, BEAD_ERROR_MEMORY, "out of memory");
    if (!err)
        err = command_parse(&command, argc, argv, &msg);
    if (!err)
        err = command_load_config(&command, &msg);
    const bool acted = !err;
    if (acted)
        err = act(&command, &msg);
    if (err && command_is_json(&command) && !(acted && command.action == COMMAND_RUN)) /* which has printed it */
        command_print_result(NULL, err, command_status(err, 0), 0, &msg);
    if (!err)
        err = finish_output(&msg);
    bead_config_free(command.config);
    free(command.settings);
    free(command.only);
    free(command.parts);
    for (size_t i = 0; command.looks && i < command.job.look_count; i++)
        free(command.looks[i]);
    free(command.looks);
    if (err)
        command_complain(program, err, &msg);
    return command_status(err, stop_signal);
}
