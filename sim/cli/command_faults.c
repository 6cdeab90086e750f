/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Faults within libraries end the program: nothing half-written stays then. */
#include <signal.h>
#include <unistd.h>

#include "sim/cli/command_line.h"
#include "sim/session/session_internal.h"

/* The run that a fault would end. */
static struct bead_session *volatile running;

void command_guard(struct bead_session *session)
{
    running = session;
}

/* A library has given up: GLib aborts where it can make no thread. Nothing half-written stays. */
static void on_fault(int number, siginfo_t *info, void *)
{
    static const char said[] =
        "ended by a fault within a library, for want of memory or threads perhaps; no unfinished file is left\n";
    static volatile sig_atomic_t faults;
    if (__atomic_add_fetch(&faults, 1, __ATOMIC_RELAXED) > 1)
        pause();                    /* the first thread ends the program */
    if (info->si_code != SI_USER) { /* else another process has sent it: no fault, and the program ends as if killed */
        if (running)
            bead_session_abandon(running);
        (void)!write(STDERR_FILENO, said, sizeof said - 1);
        if (number == SIGTRAP) /* GLib has said why */
            _exit(1);
    }
    (void)signal(number, SIG_DFL);
    (void)raise(number);
}

/* Where no debugger or sanitizer has its own way. */
bool command_catch_faults(void)
{
    static const int faults[] = {SIGTRAP, SIGABRT, SIGSEGV, SIGBUS};
    struct sigaction fault = {.sa_sigaction = on_fault, .sa_flags = SA_NODEFER | SA_SIGINFO}, before;
    sigemptyset(&fault.sa_mask);
    bool caught = true;
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++)
        caught = caught && sigaction(faults[i], NULL, &before) == 0 &&
                 (before.sa_handler != SIG_DFL || sigaction(faults[i], &fault, NULL) == 0);
    return caught;
}
