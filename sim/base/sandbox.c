/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The filters are lists of calls in the kernel's own language: libseccomp would be one more library that every program links to,
 * for these thirty lines. */
#include "sim/base/sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sim/base/file.h"

/* Sanitizers map the whole address space, and run programs that name the lines of faults. */
#ifndef __has_feature
#define __has_feature(name) 0
#endif
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__ || __has_feature(address_sanitizer) || \
    __has_feature(thread_sanitizer)
enum { SANITIZED = 1 };
#else
enum { SANITIZED = 0 };
#endif

static const rlim_t most_memory = 512u << 20; /* bytes, beyond what the process has */
static const rlim_t most_time = 3600;         /* s of processor time: no file keeps it busy for ever */

#if defined __x86_64__
static const uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined __aarch64__
static const uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
static const uint32_t architecture = 0; /* no filter */
#endif

static const uint16_t allowed[] = {
    SYS_read,          SYS_write,        SYS_pread64,         SYS_lseek,  SYS_fstat,      SYS_newfstatat,
    SYS_close,         SYS_mmap,         SYS_munmap,          SYS_mremap, SYS_mprotect,   SYS_madvise,
    SYS_brk,           SYS_futex,        SYS_getrandom,       SYS_getpid, SYS_gettid,     SYS_tgkill,
    SYS_rt_sigaction,  SYS_rt_sigreturn, SYS_rt_sigprocmask,  SYS_exit,   SYS_exit_group, SYS_sched_yield,
    SYS_clock_gettime, SYS_sigaltstack,  SYS_restart_syscall,
};
enum { ALLOWED = sizeof allowed / sizeof *allowed };

/* Connections and programs; rings, which could ask for these; calls that look into other processes or change the kernel.
 */
static const uint16_t refused[] = {
    SYS_socket,
    SYS_connect,
    SYS_bind,
    SYS_listen,
    SYS_accept4,

    SYS_execve,
    SYS_execveat,
    SYS_io_uring_setup,
    SYS_io_uring_enter,
    SYS_ptrace,
    SYS_process_vm_readv,
    SYS_process_vm_writev,
    SYS_mount,
    SYS_umount2,
    SYS_bpf,
    SYS_perf_event_open,
    SYS_keyctl,
    SYS_userfaultfd,
    SYS_unshare,
    SYS_setns,
    SYS_init_module,
    SYS_finit_module,
    SYS_kexec_load,
};
enum { REFUSED = sizeof refused / sizeof *refused, MOST_CALLS = (int)ALLOWED > (int)REFUSED ? (int)ALLOWED : (int)REFUSED };

bool bead_sandbox_is_there(void)
{
    uint32_t action = SECCOMP_RET_ERRNO;
    return architecture && syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &action) == 0;
}

static const uint32_t does = SECCOMP_RET_ALLOW, fails = SECCOMP_RET_ERRNO | EPERM;

/* The listed calls get one result, all others the other. Those above `first_foreign` are a second set of the same calls, under
 * other numbers (x32). */
static void filter_calls(const uint16_t *calls, size_t count, uint32_t listed, uint32_t others, unsigned flags)
{
    static const uint32_t first_foreign = 0x40000000;
    struct sock_filter filter[5 + MOST_CALLS + 3];
    size_t n = 0;
    filter[n++] = (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, arch));
    filter[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0);
    filter[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS);
    filter[n++] = (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr));
    filter[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, first_foreign, (uint8_t)(count + 2), 0);
    for (size_t i = 0; i < count; i++)
        filter[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, calls[i], (uint8_t)(count - i), 0);
    filter[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, others);
    filter[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, listed);
    filter[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, fails);
    const struct sock_fprog program = {.len = (unsigned short)n, .filter = filter};
    if (architecture)
        syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, flags, &program);
}

/* Landlock: no file below any directory, in case the filter misses a call. The numbers of its rights grow with its version. */
static void lock_files(void)
{
#ifdef SYS_landlock_create_ruleset
    static const int rights[] = {13, 14, 15, 15, 16};
    enum { VERSIONS = sizeof rights / sizeof *rights, ASK_VERSION = 1 };
    const long version = syscall(SYS_landlock_create_ruleset, NULL, 0, ASK_VERSION);
    if (version < 1)
        return;
    const uint64_t handled = (UINT64_C(1) << rights[version < VERSIONS ? version - 1 : VERSIONS - 1]) - 1;
    const int rules = (int)syscall(SYS_landlock_create_ruleset, &handled, sizeof handled, 0);
    if (rules < 0)
        return;
    syscall(SYS_landlock_restrict_self, rules, 0);
    close(rules);
#endif
}

/* Bytes of data in the process; 0: unknown. */
static rlim_t data_bytes(void)
{
    char text[160];
    unsigned long long pages = 0;
    const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    const ssize_t length = file < 0 ? -1 : read(file, text, sizeof text - 1);
    if (file >= 0)
        close(file);
    text[length > 0 ? length : 0] = '\0';
    char *at = text;
    for (int i = 0; i < 6; i++) /* the sixth number is that of pages of data */
        pages = strtoull(at, &at, 10);
    return pages * (rlim_t)sysconf(_SC_PAGESIZE);
}

static void limit(__rlimit_resource_t what, rlim_t most)
{
    struct rlimit now;
    if (getrlimit(what, &now) != 0 || now.rlim_cur <= most)
        return;
    now.rlim_cur = now.rlim_max = most;
    setrlimit(what, &now);
}

void bead_sandbox_enter(void)
{
    const rlim_t data = data_bytes();
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, most_time);
    if (!SANITIZED && data)
        limit(RLIMIT_DATA, data + most_memory);
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
        return;
    lock_files();
    filter_calls(allowed, ALLOWED, does, fails, 0);
}

/* SPEC_ALLOW: else older kernels slow the whole run down, to protect secrets that no run has. */
void bead_sandbox_confine(void)
{
    if (!SANITIZED && prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0)
        filter_calls(refused, REFUSED, fails, does, SECCOMP_FILTER_FLAG_SPEC_ALLOW);
}

/* ---- a process in the sandbox ---- */

static void reset_signals(void)
{
    static const int ignored[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP},
                     faults[] = {SIGSEGV, SIGBUS, SIGABRT, SIGTRAP, SIGFPE, SIGILL, SIGPIPE, SIGXCPU};
    for (size_t i = 0; i < sizeof ignored / sizeof *ignored; i++)
        (void)signal(ignored[i], SIG_IGN);
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++)
        (void)signal(faults[i], SIG_DFL);
}

static bool is_among(int descriptor, const int *descriptors, size_t count)
{
    size_t i = 0;
    while (i < count && descriptors[i] != descriptor)
        i++;
    return i < count;
}

/* Except stderr. Locks of files being written belong to the asking process. */
static void close_others(const int *descriptors, size_t count)
{
    int last = STDERR_FILENO;
    for (size_t i = 0; i < count; i++)
        last = descriptors[i] > last ? descriptors[i] : last;
    for (int at = 0; at < last; at++) {
        if (at != STDERR_FILENO && !is_among(at, descriptors, count))
            close(at);
    }
    closefrom(last + 1);
}

pid_t bead_sandbox_fork(const int *descriptors, size_t count)
{
    const pid_t process = fork();
    if (process == 0) {
        reset_signals();
        close_others(descriptors, count);
        bead_sandbox_enter();
    }
    return process;
}

bool bead_sandbox_end(pid_t process, int *status)
{
    kill(process, SIGKILL);
    while (waitpid(process, status, 0) < 0) {
        if (errno != EINTR)
            return false;
    }
    return true;
}

/* An answer is complete if it ends with this. */
enum { END = 0 };

/* In memory first: fdopen() asks more of the kernel than the sandbox allows. */
static _Noreturn void work_and_end(bead_sandbox_work *work, const void *context, int out)
{
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    if (!file)
        _exit(1);
    work(context, file);
    fputc(END, file);
    if (fclose(file) != 0)
        _exit(1);
    for (ssize_t done = 1; length > 0 && done > 0; text += done, length -= (size_t)done)
        done = write(out, text, length);
    _exit(0);
}

enum bead_error bead_sandbox_ask(const char *path, bead_sandbox_work *work, const void *context, size_t most, char **answer,
                                 size_t *length, struct bead_message *msg)
{
    int ends[2], status = 0;
    *answer = NULL;
    if (pipe2(ends, O_CLOEXEC) != 0)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be read: %s", path, strerror(errno));
    const pid_t process = bead_sandbox_fork(&ends[1], 1);
    const int error = errno;
    if (process == 0)
        work_and_end(work, context, ends[1]);
    close(ends[1]);
    if (process < 0) {
        close(ends[0]);
        return bead_fail(msg, error == ENOMEM ? BEAD_ERROR_MEMORY : BEAD_ERROR_IO,
                         "%s: cannot be read: no process can be started for it: %s", path, strerror(error));
    }
    enum bead_error err = bead_file_read_open(ends[0], path, most + 1, answer, length, msg);
    const bool known = bead_sandbox_end(process, &status);
    if (err || (*length > 0 && (*answer)[--*length] == END))
        return err;
    free(*answer);
    *answer = NULL;
    return known && WIFSIGNALED(status) && WTERMSIG(status) != SIGKILL
               ? bead_fail(msg, BEAD_ERROR_FORMAT, "%s: damaged: its reader crashes on it (%s)", path, strsignal(WTERMSIG(status)))
               : bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be read: the process that reads it has ended", path);
}
