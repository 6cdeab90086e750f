/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The result of a command: the exit status, the message on stderr, and for programs (--json) the result of a run as one JSON object
 * on stdout, whose keys the man page documents. */
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/chain.h"
#include "beadreel/sweep.h"
#include "sim/base/json.h"
#include "sim/base/memory.h"
#include "sim/base/text.h"
#include "sim/cli/command_line.h"
#include "sim/run/uncertainty.h"
#include "sim/session/session_internal.h"

int command_status(enum bead_error err, int signal)
{
    return err == BEAD_ERROR_STOPPED && signal ? 128 + signal : bead_error_status(err);
}

/* Prints text that may come from anybody, without control characters; starts each further line with `line` (NULL: there is only
 * one line). */
static void show(FILE *out, const char *text, const char *line)
{
    for (size_t obeyed; *text; text += obeyed ? obeyed : 1) {
        obeyed = bead_text_obeyed(text);
        if (line && *text == '\n')
            fprintf(out, "\n%s", line);
        else
            fputc(obeyed ? ' ' : *text, out);
    }
}

void command_print(FILE *out, const char *format, ...)
{
    BEAD_FREED char *text = NULL;
    va_list arguments;
    va_start(arguments, format);
    if (vasprintf(&text, format, arguments) < 0)
        text = NULL;
    va_end(arguments);
    if (text)
        show(out, text, "");
}

enum bead_error command_hold(struct command_held *held, struct bead_message *msg)
{
    *held = (struct command_held){.text = NULL};
    held->file = open_memstream(&held->text, &held->size);
    return held->file ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory");
}

enum bead_error command_let_go(struct command_held *held, FILE *out, enum bead_error err, struct bead_message *msg)
{
    if (fclose(held->file) == 0)
        show(out, held->text, "");
    else if (!err)
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory");
    free(held->text);
    return err;
}

/* One line, or, with `lines`, one for each line of the text. */
static void tell(const struct command_program *program, const char *word, const char *text, bool lines)
{
    char begin[64];
    snprintf(begin, sizeof begin, "%s: %s", program->name, word);
    fputs(begin, stderr);
    show(stderr, text, lines ? begin : NULL);
    fputc('\n', stderr);
}

void command_complain(const struct command_program *program, enum bead_error err, const struct bead_message *msg)
{
    tell(program, "", msg->text[0] ? msg->text : bead_error_text(err), err == BEAD_ERROR_SCENE);
}

void command_warn(const struct command_program *program, const char *warning)
{
    tell(program, "warning: ", warning, true);
}

bool command_is_json(const struct command *command)
{
    return command->json || command->progress == COMMAND_PROGRESS_JSON;
}

/* "scene.yaml:3:5: what is wrong" in parts; in a message without a place only the text. */
static void write_error(struct bead_json *json, const char *text)
{
    unsigned place[2];
    int length = 0;
    char file[sizeof((struct bead_message *)0)->text] = "";
    const char *colon = strchr(text, ':');
    while (colon && (sscanf(colon, ":%9u:%9u: %n", &place[0], &place[1], &length) != 2 || length == 0))
        colon = strchr(colon + 1, ':'); /* one in the file's name, or in the words */
    if (colon)
        snprintf(file, sizeof file, "%.*s", (int)(colon - text), text);
    bead_json_open(json, NULL, '{');
    bead_json_text(json, "file", colon ? file : NULL);
    bead_json_number(json, "line", colon ? place[0] : NAN);
    bead_json_number(json, "column", colon ? place[1] : NAN);
    bead_json_text(json, "message", colon ? colon + length : text);
    bead_json_close(json, "}");
}

/* One a line of the message. */
static void write_errors(struct bead_json *json, const char *text)
{
    bead_json_open(json, "errors", '[');
    while (*text) {
        char line[sizeof((struct bead_message *)0)->text];
        const size_t length = strcspn(text, "\n");
        snprintf(line, sizeof line, "%.*s", (int)length, text);
        write_error(json, line);
        text += length + (text[length] == '\n');
    }
    bead_json_close(json, "]");
}

/* The least certain peak, as in the last line of text output. */
static void write_worst(struct bead_json *json, const struct bead_outcome *o)
{
    if (!(o->worst_force > 0)) {
        bead_json_null(json, "worst_peak");
        return;
    }
    const bool bead = !isnan(o->worst_bead);
    bead_json_open(json, "worst_peak", '{');
    bead_json_number(json, bead ? "bead" : "contact", bead ? o->worst_bead : o->worst_contact);
    bead_json_number(json, "force_N", o->worst_force);
    bead_json_number(json, "uncertainty_N", o->worst_uncertainty);
    bead_json_close(json, "}");
}

void command_write_runs(struct bead_json *json, const struct bead_chain *const *chains, const struct bead_outcome *outcomes,
                        size_t count)
{
    bead_json_open(json, "runs", '[');
    for (size_t i = 0; i < count; i++) {
        const struct bead_outcome *o = &outcomes[i];
        bead_json_open(json, NULL, '{');
        bead_json_text(json, "chain", bead_chain_name(chains[i]));
        bead_json_text(json, "method", o->method);
        bead_json_number(json, "step_s", o->step);
        bead_json_number(json, "steps", (double)o->steps);
        bead_json_number(json, "end_s", o->end);
        bead_json_number(json, "front_arrival_s", o->front_arrival);
        bead_json_number(json, "front_arrival_s_uncertainty",
                         o->check ? bead_uncertainty_measured(0, o->front_arrival, o->check->front_arrival) : NAN);
        bead_json_number(json, "energy_error", o->energy_error);
        bead_json_number(json, "embedded_error", o->embedded_error);
        bead_json_number(json, "event_error", o->event_error);
        write_worst(json, o);
        bead_json_close(json, "}");
    }
    bead_json_close(json, "]");
}

static void write_outputs(struct bead_json *json, const struct bead_session *session)
{
    const struct bead_result *results = NULL;
    const size_t count = session ? bead_session_results(session, &results) : 0;
    bead_json_open(json, "outputs", '[');
    for (size_t i = 0; i < count; i++) {
        bead_json_open(json, NULL, '{');
        bead_json_text(json, "name", results[i].name);
        bead_json_text(json, "path", results[i].path);
        bead_json_text(json, "kind", results[i].kind);
        bead_json_number(json, "bytes", (double)results[i].bytes);
        bead_json_close(json, "}");
    }
    bead_json_close(json, "]");
}

static void write_sweep(struct bead_json *json, const struct bead_session *session)
{
    const struct bead_sweep *sweep = session ? bead_session_sweep(session) : NULL;
    if (!sweep) {
        bead_json_null(json, "sweep");
        return;
    }
    size_t known = 0, all = bead_sweep_count(sweep, &known);
    bead_json_open(json, "sweep", '{');
    bead_json_number(json, "computed", (double)bead_session_counts(session)->chains);
    bead_json_number(json, "known", (double)known);
    bead_json_number(json, "chains", (double)all);
    bead_json_close(json, "}");
}

static void write_texts(struct bead_json *json, const char *key, const struct bead_session *session,
                        const char *(*text)(const struct bead_session *session, size_t index))
{
    const char *found;
    bead_json_open(json, key, '[');
    for (size_t i = 0; session && (found = text(session, i)); i++)
        bead_json_text(json, NULL, found);
    bead_json_close(json, "]");
}

void command_print_result(const struct bead_session *session, enum bead_error err, int status, double seconds,
                          const struct bead_message *msg)
{
    struct bead_json json = {.out = stdout};
    size_t chains = 0, count = 0;
    const struct bead_outcome *outcomes = session ? bead_session_outcomes(session, &count) : NULL;
    bead_json_open(&json, NULL, '{');
    bead_json_text(&json, "status", !err ? "done" : err == BEAD_ERROR_STOPPED ? "stopped" : "failed");
    bead_json_number(&json, "exit", status);
    bead_json_number(&json, "seconds", round(1e3 * seconds) / 1e3);
    write_outputs(&json, session);
    write_texts(&json, "skipped", session, bead_session_skipped);
    command_write_runs(&json, session ? bead_session_chains(session, &chains) : NULL, outcomes, count);
    write_sweep(&json, session);
    write_texts(&json, "warnings", session, bead_session_warning);
    write_errors(&json, !err ? "" : *msg->text ? msg->text : bead_error_text(err));
    bead_json_close(&json, "}");
    fputc('\n', stdout);
}
