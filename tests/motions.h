/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equations run without scenes: calls their tables like a run. */
#ifndef BEADREEL_TESTS_MOTIONS_H
#define BEADREEL_TESTS_MOTIONS_H

#include "tests/support.h"

#include "sim/equation/equation.h"

static inline struct bead_motion *start_motion(const struct bead_system *system, const struct bead_equation_spec *spec,
                                               double accuracy, double step, double end)
{
    struct bead_message msg = {""};
    struct bead_motion *motion = NULL;
    const struct bead_chain_spec chain = {.system = system, .equation = *spec};
    const char *key = "", *wrong = system->equation->check(spec, &key);
    if (wrong)
        fail_msg("%s %s", key, wrong);
    struct bead_motion_settings settings = {spec, system->count(&chain, accuracy), "auto", accuracy, step, end, 0, 0};
    if (system->equation->create(&settings, &motion, &msg))
        fail_msg("%s", msg.text);
    return motion;
}

#define assert_close(value, wanted, limit)                                             \
    do {                                                                               \
        double got_ = (value), wanted_ = (wanted), limit_ = (limit);                   \
        if (!(fabs(got_ - wanted_) <= limit_))                                         \
            fail_msg("%s is %.10g, not %.10g to %.3g", #value, got_, wanted_, limit_); \
    } while (0)

/* Steps of a motion until `time`; they may pass it. */
static inline void move_until(const struct bead_system *system, struct bead_motion *motion, double time)
{
    struct bead_message msg = {""};
    while (system->equation->time(motion) < time) {
        if (system->equation->step(motion, &msg))
            fail_msg("%s", msg.text);
    }
}

/* One field at a time of the last step; to be freed. */
static inline double *field_at(const struct bead_system *system, struct bead_motion *motion, size_t points, double t,
                               enum bead_field field)
{
    struct bead_message msg = {""};
    double *value[BEAD_FIELD_COUNT] = {NULL};
    value[field] = calloc(points, sizeof(double));
    assert_non_null(value[field]);
    if (system->equation->sample(motion, t, BEAD_FIELD_BIT(field), value, &msg))
        fail_msg("%s", msg.text);
    return value[field];
}

static inline bool has_measure(const struct bead_system *system, const struct bead_motion *motion, const char *name, double *value)
{
    struct bead_measure all[64] = {0};
    size_t count = system->equation->measures(motion, all, 64);
    assert_true(count <= 64);
    for (size_t i = 0; i < count; i++)
        assert_true(all[i].name[0] != '\0');
    for (size_t i = 0; i < count; i++) {
        if (strcmp(all[i].name, name) == 0) {
            *value = all[i].value;
            return true;
        }
    }
    return false;
}

static inline double measure(const struct bead_system *system, const struct bead_motion *motion, const char *name)
{
    double value = 0;
    if (!has_measure(system, motion, name, &value))
        fail_msg("no measure `%s`", name);
    return value;
}

#endif
