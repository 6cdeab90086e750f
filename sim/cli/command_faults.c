/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Removes unfinished files if a fault in a library ends the program; provides the room that libraries need. */
#include <malloc.h>
#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include "sim/cli/command_line.h"
#include "sim/session/session_internal.h"

/* The run whose files a fault would leave unfinished. */
static struct bead_session *volatile running;

void command_guard(struct bead_session *session)
{
    running = session;
}

/* A library gives up: GLib, for example, aborts if it cannot start a thread. */
static void on_fault(int number, siginfo_t *info, void *)
{
    static const char said[] =
        "stopped by a fault in a library, perhaps for lack of memory or threads; no unfinished file is left\n";
    static volatile sig_atomic_t faults;
    if (__atomic_add_fetch(&faults, 1, __ATOMIC_RELAXED) > 1)
        pause();                    /* the first thread ends the program */
    if (info->si_code != SI_USER) { /* else another process has sent the signal: the program ends as if killed */
        if (running)
            bead_session_abandon(running);
        (void)!write(STDERR_FILENO, said, sizeof said - 1);
        if (number == SIGTRAP) /* GLib has printed the reason */
            _exit(1);
    }
    (void)signal(number, SIG_DFL);
    (void)raise(number);
}

/* The C library sets 64 MiB of addresses aside for each thread that allocates (HEAP_MAX_SIZE of glibc); if they are few, as on
 * clusters that count them, threads share one heap. */
static void save_addresses(void)
{
    struct rlimit addresses = {.rlim_cur = RLIM_INFINITY};
    getrlimit(RLIMIT_AS, &addresses);
    if (addresses.rlim_cur != RLIM_INFINITY)
        (void)mallopt(M_ARENA_MAX, 1);
}

/* Libraries expect a stack of the usual size: a smaller one of main is raised as far as allowed, and threads get the usual size
 * anyway.
 */
void command_take_room(void)
{
    save_addresses();
    static const size_t usual = 8 << 20;
    struct rlimit stack = {.rlim_cur = RLIM_INFINITY};
    pthread_attr_t attributes;
    getrlimit(RLIMIT_STACK, &stack);
    if (stack.rlim_cur >= usual)
        return;
    stack.rlim_cur = stack.rlim_max < usual ? stack.rlim_max : usual;
    (void)setrlimit(RLIMIT_STACK, &stack);
    if (pthread_attr_init(&attributes) != 0)
        return;
    if (pthread_attr_setstacksize(&attributes, usual) == 0)
        (void)pthread_setattr_default_np(&attributes);
    pthread_attr_destroy(&attributes);
}

/* If the stack overflows, a handler needs another one; a sanitizer has its own. */
static void take_other_stack(void)
{
    static char room[64 << 10];
    stack_t before = {.ss_flags = 0};
    sigaltstack(NULL, &before);
    if (before.ss_flags & SS_DISABLE)
        sigaltstack(&(stack_t){.ss_sp = room, .ss_size = sizeof room}, NULL);
}

/* Signals that a debugger or sanitizer handles are left to it. */
void command_catch_faults(void)
{
    static const int faults[] = {SIGTRAP, SIGABRT, SIGSEGV, SIGBUS};
    struct sigaction fault = {.sa_sigaction = on_fault, .sa_flags = SA_NODEFER | SA_SIGINFO | SA_ONSTACK}, before;
    sigemptyset(&fault.sa_mask);
    take_other_stack();
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        sigaction(faults[i], NULL, &before);
        if (before.sa_handler == SIG_DFL)
            sigaction(faults[i], &fault, NULL);
    }
}
