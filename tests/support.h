/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the tests of the computing half: scenes from text, runs to a time, reference tables. */
#ifndef BEADREEL_TESTS_SUPPORT_H
#define BEADREEL_TESTS_SUPPORT_H

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h> /* wants those above first */
/* clang-format on */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define GIVE_UP fail_msg
#include "sim/integrate/stepper.h"
#include "sim/run/run.h"
#include "tests/problems.h"

/* A run of `built`'s chain, not stepped yet. */
static inline struct bead_run *start_run(const struct built *built, struct bead_run_settings settings)
{
    struct bead_message msg = {""};
    struct bead_run *run = NULL;
    settings.chain = built->chain;
    settings.simulate = settings.simulate ? settings.simulate : &built->scene->simulate;
    settings.kernels = settings.kernels ? settings.kernels : bead_kernels_find(NULL);
    if (bead_run_create(&settings, &run, &msg))
        fail_msg("%s", msg.text);
    return run;
}

static inline void run_until(struct bead_run *run, double time)
{
    struct bead_message msg = {""};
    while (bead_run_time(run) < time) {
        if (bead_run_step(run, &msg))
            fail_msg("%s", msg.text);
    }
}

/* Fields of all beads at a time within the last step. */
static inline struct bead_sample sample_at(struct bead_run *run, double time)
{
    struct bead_sample sample = {0};
    struct bead_message msg = {""};
    unsigned all = (1u << BEAD_FIELD_STRAIN) - 1;
    if (bead_run_sample(run, time, all, (struct bead_span){0, SIZE_MAX - 1}, &sample, &msg))
        fail_msg("%s", msg.text);
    return sample;
}

#define assert_below(value, limit)                                        \
    do {                                                                  \
        double got_ = (value), limit_ = (limit);                          \
        if (!(got_ < limit_))                                             \
            fail_msg("%s is %.6g, not below %.6g", #value, got_, limit_); \
    } while (0)
#define assert_near(value, wanted, tolerance)                                                       \
    do {                                                                                            \
        double got_ = (value), wanted_ = (wanted);                                                  \
        if (!(fabs(got_ - wanted_) <= (tolerance)))                                                 \
            fail_msg("%s is %.15g, not %.15g to %.3g", #value, got_, wanted_, (double)(tolerance)); \
    } while (0)

#endif
