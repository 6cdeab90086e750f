/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The filter is a list of what is allowed, in the kernel's own language: libseccomp would be one more library that every program
 * links to, for these thirty lines. */
#include "sim/base/sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

/* Sanitizers map the whole address space. */
#ifndef __has_feature
#define __has_feature(name) 0
#endif
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__ || __has_feature(address_sanitizer) || \
    __has_feature(thread_sanitizer)
enum { LIMITS_MEMORY = 0 };
#else
enum { LIMITS_MEMORY = 1 };
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

bool bead_sandbox_is_there(void)
{
    uint32_t action = SECCOMP_RET_ERRNO;
    return architecture && syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &action) == 0;
}

/* Everything else fails with EPERM. */
static void filter_calls(void)
{
    struct sock_filter filter[4 + ALLOWED + 2];
    size_t n = 0;
    filter[n++] = (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, arch));
    filter[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0);
    filter[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS);
    filter[n++] = (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr));
    for (size_t i = 0; i < ALLOWED; i++)
        filter[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, allowed[i], (uint8_t)(ALLOWED - i), 0);
    filter[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM);
    filter[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
    const struct sock_fprog program = {.len = (unsigned short)n, .filter = filter};
    if (architecture)
        syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, 0, &program);
}

/* Landlock: no file below any directory, for whatever the filter would miss. The numbers of its rights grow with its version. */
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
    if (LIMITS_MEMORY && data)
        limit(RLIMIT_DATA, data + most_memory);
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
        return;
    lock_files();
    filter_calls();
}
