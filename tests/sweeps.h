/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sweeps for tests, computed from the text of a scene. */
#ifndef BEADREEL_TESTS_SWEEPS_H
#define BEADREEL_TESTS_SWEEPS_H

#include "support.h"

#include "beadreel/sweep.h"

static inline struct bead_scene *parse(const char *text)
{
    struct bead_message msg = {""};
    struct bead_scene *scene = NULL;
    if (bead_scene_parse("test.yaml", text, strlen(text), NULL, &scene, &msg))
        fail_msg("%s", msg.text);
    return scene;
}

static inline struct bead_sweep *compute(const struct bead_scene *scene, const struct bead_sweep_settings *settings)
{
    struct bead_sweep_settings with = settings ? *settings : (struct bead_sweep_settings){.threads = 2};
    with.size = sizeof with;
    struct bead_message msg = {""};
    struct bead_sweep *sweep = NULL;
    if (bead_sweep_create(scene, &sweep, &msg) || bead_sweep_run(sweep, &with, NULL, &msg))
        fail_msg("%s", msg.text);
    return sweep;
}

static inline const struct bead_sweep_peak *peak_of(const struct bead_sweep *sweep, size_t index)
{
    struct bead_sweep_configuration found;
    assert_true(bead_sweep_configuration(sweep, 0, index, &found));
    return found.peaks;
}

#define OUTPUT "\noutputs: [{sweep: a.h5}]\n"

#endif
