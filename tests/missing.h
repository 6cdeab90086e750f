/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tests that need things a machine may lack; after cmocka.h. tests/run.sh counts skipped tests, and lists the things missing. */
#ifndef BEADREEL_TESTS_MISSING_H
#define BEADREEL_TESTS_MISSING_H

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

/* Skips the test for lack of `what`: a program or library, with its Debian package. */
#define skip_without(what)                        \
    do {                                          \
        print_message("# missing: %s\n", (what)); \
        skip();                                   \
    } while (0)

static inline bool has_program(const char *name)
{
    char command[128];
    snprintf(command, sizeof command, "command -v %s >/dev/null 2>&1", name);
    return system(command) == 0;
}

#endif
