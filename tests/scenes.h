/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the tests of scenes: parsing a text, and refusing one with the expected message. */
#ifndef BEADREEL_TESTS_SCENES_H
#define BEADREEL_TESTS_SCENES_H

/* clang-format off: cmocka wants these first */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */
#include <dirent.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/chain.h"
#include "beadreel/scene.h"
#include "sim/base/assets.h"
#include "sim/scene/scene_private.h"

#define BEADS   "chain: {beads: [{bead: large-steel}]}\n"
#define OUTPUTS "outputs: [{table: peaks.csv}]\n"

static inline struct bead_scene *parse_with(const char *text, const char *const *settings, size_t count)
{
    struct bead_message msg = {""};
    struct bead_scene *scene = NULL;
    if (bead_scene_parse("test", text, strlen(text), &(struct bead_overrides){.settings = settings, .setting_count = count}, &scene,
                         &msg))
        fail_msg("%s", msg.text);
    return scene;
}

static inline struct bead_scene *parse(const char *text)
{
    return parse_with(text, NULL, 0);
}

/* A line for each thing that is wrong, at most ten, all with their places. */
static inline bool is_list_of_faults(const char *message)
{
    size_t lines = 0;
    for (const char *line = message; line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL) {
        const size_t length = strcspn(line, "\n");
        const char *place = memchr(line, ':', length);
        if (length == 0 || !place || (message[length] && (place[1] < '0' || place[1] > '9')) || ++lines > 10)
            return false;
    }
    return lines > 0;
}

/* The scene is refused, with a message that contains `expected`; nothing is left behind. */
static inline void refuse_with(const char *text, const char *const *settings, size_t count, const char *expected)
{
    struct bead_message msg = {""};
    struct bead_scene *scene = (struct bead_scene *)&msg;
    enum bead_error err = bead_scene_parse("test", text, strlen(text),
                                           &(struct bead_overrides){.settings = settings, .setting_count = count}, &scene, &msg);
    assert_int_equal(err, BEAD_ERROR_SCENE);
    assert_null(scene);
    if (!strstr(msg.text, expected))
        fail_msg("'%s' is not in '%s'", expected, msg.text);
    assert_true(is_list_of_faults(msg.text));
}

static inline void refuse(const char *text, const char *expected)
{
    refuse_with(text, NULL, 0, expected);
}

static inline struct bead_scene *load_ready(const char *name)
{
    char path[4096];
    struct bead_message msg = {""};
    struct bead_scene *scene = NULL;
    if (bead_scene_find(name, path, sizeof path, &msg) || bead_scene_load(path, NULL, &scene, &msg))
        fail_msg("%s", msg.text);
    return scene;
}

static inline const struct bead_material *material_of(const struct bead_scene *scene, const char *name)
{
    for (size_t i = 0; i < scene->material_count; i++) {
        if (strcmp(scene->materials[i].name, name) == 0)
            return &scene->materials[i];
    }
    fail_msg("no material %s", name);
    return NULL;
}

#endif
