/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the tests of schematic drawings: a scene's chains, a drawing in memory, its words. */
#ifndef BEADREEL_TESTS_SCHEMATICS_H
#define BEADREEL_TESTS_SCHEMATICS_H

#include "pictures.h"

/* clang-format off: cmocka wants these first */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
/* clang-format on */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/schematic/schematic.h"
#include "tests/scenes.h"

struct staged {
    struct bead_scene *scene;
    struct bead_chain *chains[64];
    struct bead_run_context context;
};

static inline struct staged *set_stage(const char *text)
{
    struct bead_message msg = {""};
    struct staged *s = calloc(1, sizeof *s);
    assert_non_null(s);
    s->scene = parse(text);
    for (size_t i = 0; i < s->scene->chain_count; i++) {
        if (bead_chain_create(s->scene, i, &s->chains[i], &msg))
            fail_msg("%s", msg.text);
    }
    s->context = (struct bead_run_context){.scene = s->scene,
                                           .chains = (const struct bead_chain *const *)s->chains,
                                           .chain_count = s->scene->chain_count,
                                           .directory = "."};
    return s;
}

static inline void clear_stage(struct staged *s)
{
    for (size_t i = 0; i < s->scene->chain_count; i++)
        bead_chain_destroy(s->chains[i]);
    bead_scene_free(s->scene);
    free(s);
}

struct seen {
    struct {
        double x, y, width, height;
        char text[300];
    } box[512];
    size_t count;
};

static inline void see(void *context, const char *markup, double x, double y, double width, double height)
{
    struct seen *seen = context;
    assert_true(seen->count < 512);
    seen->box[seen->count].x = x;
    seen->box[seen->count].y = y;
    seen->box[seen->count].width = width;
    seen->box[seen->count].height = height;
    snprintf(seen->box[seen->count++].text, 300, "%s", markup);
}

/* Do both say what the same symbol is? */
static inline bool have_one_symbol(const char *one, const char *other)
{
    const char *equals = strstr(one, " = ");
    return equals && strncmp(one, other, (size_t)(equals - one) + 3) == 0;
}

/* The ink of all words, as drawn: none over another, none cut off. Beside each other, a symbol has one value. */
static inline void assert_legible(const struct seen *seen, double width, double height, const char *scene)
{
    for (size_t i = 0; i < seen->count; i++) {
        double x = seen->box[i].x, y = seen->box[i].y, right = x + seen->box[i].width, bottom = y + seen->box[i].height;
        if (x < 0 || y < 0 || right > width || bottom > height)
            fail_msg("'%s' is cut off in %s", seen->box[i].text, scene);
        for (size_t j = 0; j < i; j++) {
            if (x < seen->box[j].x + seen->box[j].width && seen->box[j].x < right && y < seen->box[j].y + seen->box[j].height &&
                seen->box[j].y < bottom)
                fail_msg("'%s' lies over '%s' in %s", seen->box[i].text, seen->box[j].text, scene);
            if (fabs(y - seen->box[j].y) < 0.5 * seen->box[i].height && have_one_symbol(seen->box[i].text, seen->box[j].text))
                fail_msg("'%s' is beside '%s' in %s", seen->box[i].text, seen->box[j].text, scene);
        }
    }
}

/* Draw output `index` of the scene; its words are in `seen`. */
static inline enum bead_error draw(const struct staged *s, size_t index, struct seen *seen, cairo_surface_t **kept)
{
    const struct bead_output *output = &s->scene->outputs[index];
    struct bead_message msg = {""};
    struct bead_page page;
    struct bead_look look;
    assert_int_equal(bead_page_find(output, &page, &msg), BEAD_OK);
    bead_page_look(&page, &output->paper, &look);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, page.width, page.height);
    struct bead_text_watch watch = {see, seen};
    seen->count = 0;
    assert_true(bead_text_watch(surface, &watch));
    cairo_t *cr = cairo_create(surface);
    struct bead_sketch sketch = {.cr = cr, .look = &look};
    enum bead_error err = bead_schematic_draw(output, &s->context, &sketch, page.width, page.height, &msg);
    if (err)
        assert_non_null(strstr(msg.text, "leave no room"));
    else
        assert_legible(seen, page.width, page.height, s->scene->text);
    assert_int_equal(cairo_status(cr), CAIRO_STATUS_SUCCESS);
    bead_sketch_free(&sketch);
    cairo_destroy(cr);
    cairo_surface_flush(surface);
    if (kept)
        *kept = surface;
    else
        cairo_surface_destroy(surface);
    return err;
}

static inline bool wrote(const struct seen *seen, const char *text)
{
    for (size_t i = 0; i < seen->count; i++) {
        if (strstr(seen->box[i].text, text))
            return true;
    }
    return false;
}

#endif
