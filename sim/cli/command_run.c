/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs or plans a session for the command line: progress on stderr, results on stdout. */
#include "sim/cli/command_line.h"

#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "beadreel/chain.h"
#include "beadreel/sweep.h"
#include "sim/base/clock.h"
#include "sim/base/file.h"
#include "sim/base/suggest.h"
#include "sim/hdf5/h5.h"
#include "sim/session/session_internal.h"
#include "sim/sweep/sweep_internal.h"

enum bead_error command_plan(const struct command *command, const volatile sig_atomic_t *stop, struct bead_message *msg)
{
    struct bead_job job = command->job;
    struct bead_session *session;
    job.stop = stop;
    BEAD_TRY(bead_session_open(&job, &session, msg));
    struct command_held held;
    enum bead_error err = command->json ? command_describe_plan(stdout, session, msg) : command_hold(&held, msg);
    if (!err && !command->json)
        err = command_let_go(&held, stdout, bead_session_plan(session, held.file, msg), msg);
    const char *warning;
    for (size_t i = 0; (warning = bead_session_warning(session, i)); i++)
        command_warn(command->program, warning);
    bead_session_close(session);
    return err;
}

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* Facts about a file: which output of the scene it is, if -o gives it another name, and what made it. */
static void print_origin(const struct bead_result *result)
{
    const char *name = result->name ? base_name(result->name) : "", *makers = result->makers ? result->makers : "";
    const bool other = strncmp(base_name(result->path), name, strlen(name)) != 0; /* unfinished files have one more ending */
    if (other)
        printf("  from the scene's %s", name);
    if (*makers)
        printf("%s%s", other ? ", " : "  ", makers);
    putchar('\n');
}

/* One line a file: name and size, in columns, and where it comes from. */
static void print_results(const struct bead_result *results, size_t count)
{
    char size[32];
    int width = 0;
    for (size_t i = 0; i < count; i++)
        if ((int)strlen(results[i].path) > width && strlen(results[i].path) < 80)
            width = (int)strlen(results[i].path);
    for (size_t i = 0; i < count; i++) {
        command_print(stdout, "%-*s  %8s", width, results[i].path,
                      command_quantity((double)results[i].bytes, "B", size, sizeof size));
        print_origin(&results[i]);
    }
}

/* The largest errors of all chains. Those that the method cannot estimate, or a stopped run did not, are left out. */
static void print_errors(const struct bead_outcome *outcomes, size_t chains)
{
    double error[3] = {NAN, NAN, NAN};
    static const char *const names[3] = {"energy", "embedded", "events"};
    const char *separator = "; errors seen: ";
    for (size_t i = 0; i < chains; i++) {
        error[0] = fmax(error[0], outcomes[i].energy_error); /* fmax: the number, where one is none */
        error[1] = fmax(error[1], outcomes[i].embedded_error);
        error[2] = fmax(error[2], outcomes[i].event_error);
    }
    for (int i = 0; i < 3; i++) {
        if (isfinite(error[i])) {
            printf("%s%s %.1g", separator, names[i], error[i]);
            separator = ", ";
        }
    }
}

/* The least certain peak, if a table of peaks asked for uncertainties. */
static void print_worst(const struct bead_outcome *outcomes, size_t chains)
{
    const struct bead_outcome *worst = NULL;
    for (size_t i = 0; i < chains; i++) {
        const struct bead_outcome *o = &outcomes[i];
        if (o->worst_force > 0 && (!worst || o->worst_uncertainty * worst->worst_force > worst->worst_uncertainty * o->worst_force))
            worst = o;
    }
    double from = INFINITY;
    for (size_t i = 0; i < chains; i++)
        from = outcomes[i].predictable_until > 0 ? fmin(from, outcomes[i].predictable_until) : from;
    if (worst)
        printf("; least certain peak: %s %.0f, %.6g N to %.2g N", isnan(worst->worst_bead) ? "contact" : "bead",
               isnan(worst->worst_bead) ? worst->worst_contact : worst->worst_bead, worst->worst_force, worst->worst_uncertainty);
    if (isfinite(from))
        printf("; not all peaks are predictable from %.4g ms on", 1e3 * from);
}

/* Forces that are not known as well as asked. */
static void print_sweep_errors(const struct bead_sweep *sweep)
{
    double worst = 0;
    for (size_t p = 0; p < bead_sweep_panels(sweep); p++) {
        for (size_t i = 0; i < bead_sweep_panel(sweep, p)->places; i++)
            worst = fmax(worst, bead_sweep_uncertainty(sweep, p, i)); /* fmax ignores NaN */
    }
    const double asked = bead_sweep_scene(sweep)->simulate.accuracy, taken = bead_sweep_accuracy(sweep);
    if (taken > 0)
        printf("; accuracy %.0e: errors of a hundredth of the standard error", taken);
    else if (worst > 1.001 * asked)
        printf("; forces are known to %.2g of themselves, not to the %.2g asked for", worst, asked);
}

/* ": 2581 chains, 83 a second"; if a sweep is resumed, only the chains computed now count. */
static void print_sweep(const struct bead_session *session, double seconds)
{
    size_t known = 0, all = bead_sweep_count(bead_session_sweep(session), &known);
    uint64_t now = bead_session_counts(session)->chains;
    if (now == 0)
        return;
    printf(": %" PRIu64 " chain%s", now, now == 1 ? "" : "s");
    if (now < known)
        printf(" of %zu, %zu there before", all, known - (size_t)now);
    printf(", %.3g a second", (double)now / fmax(seconds, 1e-3));
    print_sweep_errors(bead_session_sweep(session));
}

/* "2 files, 1.8 MB, in 2.1 s: 2 chains to 1.05 ms with rkn8, step 0.36 us" */
static void print_summary(const struct bead_session *session, size_t files, uint64_t bytes, double seconds)
{
    char size[32], time[32], step[32];
    size_t chains = 0;
    const struct bead_outcome *outcomes = bead_session_outcomes(session, &chains);
    printf("%zu file%s, %s, in %.2f s", files, files == 1 ? "" : "s", command_quantity((double)bytes, "B", size, sizeof size),
           seconds);
    if (bead_session_sweep(session))
        print_sweep(session, seconds);
    double end = 0;
    for (size_t i = 0; outcomes && i < chains; i++)
        end = fmax(end, outcomes[i].end);
    if (end > 0) {
        const char *unit = bead_session_time_unit(session);
        printf(": %zu chain%s to %s", chains, chains == 1 ? "" : "s", command_quantity(end, unit, time, sizeof time));
        if (outcomes[0].method)
            printf(" with %s, first step %s", outcomes[0].method, command_quantity(outcomes[0].step, unit, step, sizeof step));
        print_errors(outcomes, chains);
        print_worst(outcomes, chains);
    } else if (chains > 0)
        printf(": drawings only, nothing to compute");
    putchar('\n');
}

static void print_skipped(const struct command *command, const struct bead_session *session)
{
    const char *name = bead_session_skipped(session, 0);
    if (!name)
        return;
    printf("skipped, %s does not make these: %s", command->program->name, name);
    for (size_t i = 1; (name = bead_session_skipped(session, i)); i++)
        printf(", %s", name);
    putchar('\n');
}

static void print_warnings(const struct command *command, const struct bead_session *session)
{
    const char *warning = NULL;
    for (size_t i = 0; (warning = bead_session_warning(session, i)); i++) {
        if (bead_session_verified(session) || bead_session_warning(session, i + 1))
            command_warn(command->program, warning);
    }
}

static void print_text(const struct command *command, const struct bead_session *session, double seconds, bool stopped)
{
    const struct bead_result *results = NULL;
    size_t count = bead_session_results(session, &results);
    uint64_t bytes = 0;
    for (size_t i = 0; i < count; i++)
        bytes += results[i].bytes;
    print_results(results, count);
    if (stopped)
        return;
    print_skipped(command, session);
    print_summary(session, count, bytes, seconds);
    fflush(stdout);
    print_warnings(command, session);
}

/* -o -: with several files it would be unclear which one. */
static enum bead_error check_piped(const struct bead_session *session, struct bead_message *msg)
{
    struct bead_planned planned;
    char names[256] = "";
    size_t count = 0;
    for (size_t i = 0; bead_session_planned(session, i, &planned); i++) {
        if (planned.made && count++ < 8)
            bead_list_add(names, sizeof names, ", ", planned.name);
    }
    return count == 1 ? BEAD_OK
                      : bead_fail(msg, BEAD_ERROR_USAGE, "-o -: is for one file, which --only names, and not for %zu%s%s", count,
                                  count > 0 ? ": " : "", names);
}

/* The first result, byte by byte. */
static enum bead_error give_out(const struct bead_session *session, struct bead_message *msg)
{
    char bytes[65536];
    const struct bead_result *results = NULL;
    FILE *file = bead_session_results(session, &results) > 0 ? fopen(results[0].path, "rb") : NULL;
    if (!file)
        return bead_fail(msg, BEAD_ERROR_IO, "-o -: there is no file to write");
    for (size_t count; (count = fread(bytes, 1, sizeof bytes, file)) > 0;)
        fwrite(bytes, 1, count, stdout); /* whose errors are looked at in the end */
    const bool failed = ferror(file);
    fclose(file);
    return failed ? bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be read", results[0].path) : BEAD_OK;
}

/* Runs it, and prints the results as text where text is wanted. */
static enum bead_error play(const struct command *command, struct bead_session *session, struct command_meter *meter, double began,
                            struct bead_message *msg)
{
    enum bead_error err = bead_session_run(session, msg);
    command_meter_clear(meter);
    if (command->piped) {
        err = err ? err : give_out(session, msg);
        print_warnings(command, session);
    } else if (!command_is_json(command) && (!err || err == BEAD_ERROR_STOPPED))
        print_text(command, session, bead_clock() - began, err != BEAD_OK);
    if (err || bead_session_verified(session))
        return err;
    /* All is written; the last warning says what could not be verified. */
    size_t last = 0;
    while (bead_session_warning(session, last + 1))
        last++;
    return bead_fail(msg, BEAD_ERROR_NUMBERS, "%s", bead_session_warning(session, last));
}

/* Has a sweep that was stopped no file from which the same command could go on? */
static bool is_forgotten(const struct bead_session *session)
{
    struct bead_planned planned;
    bool kept = false;
    for (size_t i = 0; session && bead_session_planned(session, i, &planned); i++)
        kept = kept || (planned.made && strcmp(planned.kind, "sweep") == 0);
    return session && bead_session_sweep(session) && bead_session_counts(session)->chains > 0 && !kept;
}

static enum bead_error open_and_play(const struct command *command, const volatile sig_atomic_t *stop, struct bead_message *msg)
{
    struct command_meter meter;
    struct bead_job job = command->job;
    struct bead_session *session;
    double began = bead_clock();
    const time_t date = time(NULL);
    command_meter_init(&meter, command->progress);
    job.stop = stop;
    job.progress = command_meter_tell;
    job.progress_context = &meter;
    enum bead_error err = bead_session_open(&job, &session, msg);
    command_meter_clear(&meter);
    command_guard(session);
    if (!err && command->piped)
        err = check_piped(session, msg);
    if (!err && command->crate)
        err = command_crate_spare(command, session, msg);
    if (!err)
        err = play(command, session, &meter, began, msg);
    if (!err && command->crate)
        err = command_crate(command, session, date, msg);
    if (err == BEAD_ERROR_STOPPED && *stop)
        bead_fail(msg, err, "stopped by signal %d (%s)%s", (int)*stop, strsignal(*stop),
                  is_forgotten(session) ? "; the same command starts over: no output {sweep: sweep.h5} keeps the chains" : "");
    if (command_is_json(command))
        command_print_result(session, err, command_status(err, *stop), bead_clock() - began, msg);
    command_guard(NULL);
    bead_session_close(session);
    return err;
}

enum bead_error command_run(const struct command *command, const volatile sig_atomic_t *stop, struct bead_message *msg)
{
    char directory[PATH_MAX];
    struct command piped = *command;
    if (!command->job.output || strcmp(command->job.output, "-") != 0)
        return open_and_play(command, stop, msg);
    if (command_is_json(command) || command->watch || command->crate)
        return bead_fail(msg, BEAD_ERROR_USAGE,
                         "-o -: standard output has room for the file only, not for JSON, --watch or --crate");
    if (bead_h5_is(command->job.input))
        return bead_fail(msg, BEAD_ERROR_USAGE, "-o -: is for one file of a scene; of %s name the file to draw: -o picture.png",
                         command->job.input);
    BEAD_TRY(command_make_temporary(directory, msg));
    piped.job.output = directory;
    piped.piped = true;
    const enum bead_error err = open_and_play(&piped, stop, msg);
    command_remove_temporary(directory);
    return err;
}

/* Signals wait until the file is whole, which it soon is. */
static enum bead_error write_merged(const struct bead_sweep *sweep, const char *path, struct bead_message *msg)
{
    sigset_t stopping, before;
    sigemptyset(&stopping);
    sigaddset(&stopping, SIGINT);
    sigaddset(&stopping, SIGTERM);
    sigaddset(&stopping, SIGHUP);
    sigprocmask(SIG_BLOCK, &stopping, &before);
    const enum bead_error err = bead_sweep_write(sweep, path, msg);
    sigprocmask(SIG_SETMASK, &before, NULL);
    return err;
}

enum bead_error command_merge(const struct command *command, struct bead_message *msg)
{
    BEAD_LEFT_TO(bead_sweep_left) struct bead_sweep *sweep = NULL;
    const char *dot = command->job.output ? strrchr(command->job.output, '.') : NULL;
    if (!dot || strcmp(dot, ".h5") != 0)
        return bead_fail(msg, BEAD_ERROR_USAGE, "--merge: name the merged file with -o FILE.h5");
    for (size_t i = 0; i < command->part_count; i++) {
        if (bead_file_same(command->parts[i], command->job.output))
            return bead_fail(msg, BEAD_ERROR_USAGE, "--merge: -o %s would replace one of the parts; give another name",
                             command->job.output);
    }
    BEAD_TRY(bead_sweep_merge(command->parts, command->part_count, &sweep, msg));
    BEAD_TRY(write_merged(sweep, command->job.output, msg));
    const struct bead_result result = {.path = command->job.output, .bytes = bead_file_bytes(command->job.output)};
    print_results(&result, 1);
    return BEAD_OK;
}
