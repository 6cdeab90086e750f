/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Disks that fail: whichever call does while a trajectory is written, the run ends with its path and the reason, and nothing is
 * left that looks whole. The calls below stand in for the system's. */
#include "trajectory_support.h"

#include <errno.h>
#include <sys/stat.h>
#include <sys/syscall.h>

enum call { NONE, PWRITE, FDATASYNC, FTRUNCATE, CLOSE, FSYNC };
/* The call that fails, how many times it succeeds before, and the reason; how often it was made. */
static struct {
    enum call call;
    int spared, error, calls;
} fault;

static bool fails(enum call call, int file)
{
    struct stat found;
    if (fault.call != call || fstat(file, &found) != 0 || !S_ISREG(found.st_mode) || fault.calls++ != fault.spared)
        return false;
    errno = fault.error;
    return true;
}

ssize_t pwrite(int file, const void *bytes, size_t size, off_t at)
{
    return fails(PWRITE, file) ? -1 : syscall(SYS_pwrite64, file, bytes, size, at);
}

int fdatasync(int file)
{
    return fails(FDATASYNC, file) ? -1 : 0; /* the machine does not fail meanwhile */
}

int fsync(int file)
{
    return fails(FSYNC, file) ? -1 : 0;
}

int ftruncate(int file, off_t length)
{
    return fails(FTRUNCATE, file) ? -1 : (int)syscall(SYS_ftruncate, file, length);
}

int close(int file)
{
    const bool failed = fails(CLOSE, file);
    return (int)syscall(SYS_close, file) != 0 || failed ? -1 : 0;
}

/* A run; its error, and how often the call was made. */
static enum bead_error write_all(enum call call, int spared, int error, bool at_end, struct bead_message *msg, int *calls)
{
    struct stand s;
    struct bead_outcome outcome = made_outcome(0);
    fault.call = NONE;
    fault.calls = 0;
    fault.spared = spared;
    fault.error = error;
    if (!at_end)
        fault.call = call;
    enum bead_error err = try_set_up(&s, ONE_CHAIN, "trajectory: run.h5, every: 1 us", 0.099e-3, msg);
    if (!err)
        err = s.type->begin(s.sink, (struct bead_range){0, 0}, msg);
    for (; !err && s.next < 100; s.next++)
        err = deliver_one(&s, 0, msg);
    fault.call = call;
    if (!err)
        err = s.type->end(s.sink, &outcome, msg);
    fault.call = NONE;
    *calls = fault.calls;
    assert_int_equal(access(s.path, F_OK) == 0, !err);
    if (err && (strncmp(msg->text, s.path, strlen(s.path)) != 0 || !strstr(msg->text, strerror(error))))
        fail_msg("call %d: %s", (int)call, msg->text);
    tear_down(&s, err ? 0 : 1);
    return err;
}

/* Until there is none left that could fail. */
static void each_call_that_fails_is_told(void **state)
{
    (void)state;
    static const enum call calls[] = {PWRITE, FDATASYNC, FTRUNCATE, CLOSE, FSYNC};
    static const bool at_end[] = {false, false, false, true, false}; /* before, only copies of a descriptor are closed */
    for (size_t k = 0; k < sizeof calls / sizeof *calls; k++) {
        int made = 1;
        for (int spared = 0; spared < made; spared++) {
            struct bead_message msg = {""};
            if (write_all(calls[k], spared, EIO, at_end[k], &msg, &made) != BEAD_ERROR_IO && spared < made)
                fail_msg("call %d fails after %d good ones, and nobody notices", (int)calls[k], spared);
        }
        assert_true(made > 0);
    }
}

/* A signal stops no writing; some file systems cannot synchronise. */
static void what_is_no_failure_is_none(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    int made;
    for (int spared = 0; spared < 3; spared++) {
        assert_int_equal(write_all(PWRITE, spared, EINTR, false, &msg, &made), BEAD_OK);
        assert_true(made > spared);
        assert_int_equal(write_all(FDATASYNC, spared, EINVAL, false, &msg, &made), BEAD_OK);
        assert_true(made > spared);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_call_that_fails_is_told),
        cmocka_unit_test(what_is_no_failure_is_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
