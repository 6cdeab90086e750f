/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Allocations that fail on request, within a program that is linked with fail_alloc.c. */
#ifndef BEADREEL_TESTS_FAIL_ALLOC_H
#define BEADREEL_TESTS_FAIL_ALLOC_H

#include <stdbool.h>

/* Address sanitizers have their own allocators; gcc and clang report them differently. */
#if defined __SANITIZE_ADDRESS__
#define FAIL_ALLOC_SANITIZED
#elif defined __has_feature
#if __has_feature(address_sanitizer)
#define FAIL_ALLOC_SANITIZED
#endif
#endif

/* From now on the `at`-th allocation of the program's own code fails, once; 0: none. */
void fail_alloc_begin(long at);

/* None fails, but until the end known[k - 1] becomes whether two others of the same functions, since the program began, came before
 * the k-th. */
void fail_alloc_note(bool *known, long room);

/* Fail no more. Returns the number of allocations since the beginning; *kept: how many of them are not freed. */
long fail_alloc_end(long *kept);

#endif
