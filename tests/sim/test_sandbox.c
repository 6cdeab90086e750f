/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forbidden calls of a process in the sandbox are refused; a process outside it can make them. */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sim/base/sandbox.h"
#include "support.h"

#include "scratch.h"
#include "tests/missing.h"
#include "tests/torture/fail_alloc.h"

static char written[1100];
static struct sockaddr_un listener = {.sun_family = AF_UNIX};

static bool writes(void)
{
    const int file = open(written, O_WRONLY | O_CREAT, 0600);
    return file >= 0 && write(file, "x", 1) == 1;
}

static bool reads(void)
{
    return open("/proc/self/status", O_RDONLY) >= 0;
}

static bool removes(void)
{
    return rename(written, listener.sun_path) == 0 || errno == ENOENT;
}

static bool connects(void)
{
    const int one = socket(AF_UNIX, SOCK_STREAM, 0);
    return one >= 0 && connect(one, (const struct sockaddr *)&listener, sizeof listener) == 0;
}

static bool asks_the_network(void)
{
    return socket(AF_INET, SOCK_DGRAM, 0) >= 0 || errno == EAFNOSUPPORT;
}

static bool starts_a_process(void)
{
    const pid_t child = fork();
    if (child == 0)
        _exit(0);
    return child > 0;
}

static bool runs_a_program(void)
{
    if (execl("/bin/true", "true", (char *)NULL) < 0)
        return false;
    return true;
}

static bool takes_memory(void)
{
    return mmap(NULL, (size_t)1 << 30, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0) != MAP_FAILED;
}

/* Allowed calls: to take some memory, to read an open file. */
static bool computes(void)
{
    char byte;
    void *some = malloc((size_t)100 << 20);
    const bool done = some && memset(some, 1, 4096) && pread(STDERR_FILENO + 1, &byte, 1, 0) == 1;
    free(some);
    return done;
}

/* In a separate process. Returns 1: done, 0: not; fails the test if the process ends by a signal. */
static int attempt(bool (*act)(void), bool inside)
{
    int status = -1;
    const pid_t child = fork();
    if (child == 0) {
        const int open_file = open("/proc/self/exe", O_RDONLY);
        if (open_file < 0 || dup2(open_file, STDERR_FILENO + 1) < 0)
            _exit(99);
        if (inside)
            bead_sandbox_enter();
        _exit(act() ? 1 : 0);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) <= 1);
    return WEXITSTATUS(status);
}

static void nothing_outside_is_reached(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        bool (*act)(void);
    } attempts[] = {{"write", writes},
                    {"read", reads},
                    {"connect", connects},
                    {"ask the network", asks_the_network},
                    {"start a process", starts_a_process},
                    {"rename", removes}};
    if (!bead_sandbox_is_there())
        skip_without("a kernel with seccomp");
    snprintf(written, sizeof written, "%s/written", directory);
    snprintf(listener.sun_path, sizeof listener.sun_path, "%.80s/socket", directory);
    const int server = socket(AF_UNIX, SOCK_STREAM, 0);
    assert_int_equal(bind(server, (const struct sockaddr *)&listener, sizeof listener), 0);
    assert_int_equal(listen(server, 4), 0);
    for (size_t i = 0; i < sizeof attempts / sizeof *attempts; i++) {
        if (attempt(attempts[i].act, true))
            fail_msg("a process in the sandbox could %s", attempts[i].name);
        assert_int_not_equal(access(written, F_OK), 0);
        if (!attempt(attempts[i].act, false))
            fail_msg("a process outside could not %s", attempts[i].name);
        unlink(written);
    }
    assert_int_equal(attempt(runs_a_program, true), 0);
    assert_int_equal(attempt(computes, true), 1);
    close(server);
    unlink(listener.sun_path);
}

static void memory_is_limited(void **state)
{
    (void)state;
#ifdef FAIL_ALLOC_SANITIZED
    skip_without("a build without sanitizers");
#endif
    assert_int_equal(attempt(takes_memory, true), 0);
    assert_int_equal(attempt(takes_memory, false), 1);
}

/* ---- a whole program ---- */

static int attempt_confined(bool (*act)(void))
{
    int status = -1;
    const pid_t child = fork();
    if (child == 0) {
        bead_sandbox_confine();
        _exit(act() ? 1 : 0);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) <= 1);
    return WEXITSTATUS(status);
}

static void programs_neither_connect_nor_run_others(void **state)
{
    (void)state;
#ifdef FAIL_ALLOC_SANITIZED
    skip_without("a build without sanitizers");
#endif
    if (!bead_sandbox_is_there())
        skip_without("a kernel with seccomp");
    snprintf(written, sizeof written, "%s/written", directory);
    assert_int_equal(attempt_confined(asks_the_network), 0);
    assert_int_equal(attempt_confined(runs_a_program), 0);
    assert_int_equal(attempt_confined(writes), 1); /* its outputs */
    assert_int_equal(unlink(written), 0);
    assert_int_equal(attempt_confined(starts_a_process), 1); /* which reads files in the sandbox */
    assert_int_equal(attempt_confined(takes_memory), 1);
}

/* ---- a process that is asked ---- */

enum { MOST = 1000 };

static void say(const void *context, FILE *answer)
{
    fwrite(context, 1, strlen(context), answer);
}

static void try_to_leave(const void *context, FILE *answer)
{
    (void)context;
    fprintf(answer, "%d%d%d%d", writes(), reads(), connects(), asks_the_network());
}

static void fault(const void *context, FILE *answer)
{
    say(context, answer);
    fflush(answer);
    raise(SIGSEGV);
}

static void leave_early(const void *context, FILE *answer)
{
    say(context, answer);
    fflush(answer);
    _exit(0);
}

static enum bead_error ask(bead_sandbox_work *work, const char *text, char **answer, size_t *length, struct bead_message *msg)
{
    return bead_sandbox_ask("a.png", work, text, MOST, answer, length, msg);
}

static void an_answer_is_whole_or_none(void **state)
{
    (void)state;
    char long_text[MOST + 2], *answer;
    size_t length;
    struct bead_message msg;
    memset(long_text, 'a', sizeof long_text);
    long_text[MOST] = 0;
    assert_int_equal(ask(say, long_text, &answer, &length, &msg), BEAD_OK);
    assert_int_equal(length, MOST);
    assert_string_equal(answer, long_text);
    free(answer);
    assert_int_equal(ask(say, "", &answer, &length, &msg), BEAD_OK);
    assert_int_equal(length, 0);
    free(answer);
    long_text[MOST] = 'a';
    long_text[MOST + 1] = 0;
    assert_int_equal(ask(say, long_text, &answer, &length, &msg), BEAD_ERROR_SCENE);
    assert_null(answer);
    assert_int_equal(ask(fault, "a half", &answer, &length, &msg), BEAD_ERROR_FORMAT);
    assert_null(answer);
    assert_string_equal(msg.text, "a.png: damaged: its reader crashes on it (Segmentation fault)");
    assert_int_equal(ask(leave_early, "a half", &answer, &length, &msg), BEAD_ERROR_IO);
    assert_null(answer);
}

static void who_is_asked_reaches_nothing(void **state)
{
    (void)state;
    char *answer;
    size_t length;
    struct bead_message msg;
    if (!bead_sandbox_is_there())
        skip_without("a kernel with seccomp");
    snprintf(written, sizeof written, "%s/written", directory);
    assert_int_equal(ask(try_to_leave, "", &answer, &length, &msg), BEAD_OK);
    assert_string_equal(answer, "0000");
    free(answer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_outside_is_reached),
        cmocka_unit_test(memory_is_limited),
        cmocka_unit_test(programs_neither_connect_nor_run_others),
        cmocka_unit_test(an_answer_is_whole_or_none),
        cmocka_unit_test(who_is_asked_reaches_nothing),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
