/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What runs draw on pages of PDF, as numbers in points: texts with the boxes of their ink, strokes and fills. A program that
 * includes this has its own versions of the functions that draw, as of `strokes.h`. */
#ifndef BEADREEL_TESTS_DRAWN_H
#define BEADREEL_TESTS_DRAWN_H

#include <pango/pangocairo.h>

#include "strokes.h"

#include <stdio.h>

#include "sessions.h"
#include "tests/pictures.h"

enum { WORDS_MOST = 3000, DRAWN_PAGES_MOST = 32 };

/* Boxes of the ink of a page; all is in the order in which it is drawn. */
struct drawn {
    size_t marks, texts, pages;
    struct mark {
        size_t page;
        bool filled;
        double width, low[2], high[2]; /* within its clip */
        double first[2], last[2];
    } mark[STROKES_MOST];
    struct words {
        size_t page;
        double x, y, low[2], high[2], centre[2]; /* of its logical box, a line high */
        bool upwards;
        char text[120];
    } text[WORDS_MOST];
    struct {
        double width, height;
    } page[DRAWN_PAGES_MOST];
};
static struct drawn *drawn_now;
static size_t drawn_page[STROKES_MOST]; /* of each stroke */

static void drawn_note(cairo_t *cr, const char *text, const PangoRectangle *ink, const PangoRectangle *box)
{
    struct drawn *d = drawn_now;
    if (!d || cairo_surface_get_type(cairo_get_target(cr)) != CAIRO_SURFACE_TYPE_PDF)
        return;
    assert_true(d->texts < WORDS_MOST);
    struct words *words = &d->text[d->texts++];
    *words = (struct words){.page = d->pages, .low = {INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY}};
    double x, y, unit = 1, turned = 0, per = 1.0 / PANGO_SCALE;
    cairo_get_current_point(cr, &x, &y);
    cairo_user_to_device_distance(cr, &unit, &turned);
    words->upwards = fabs(turned) > fabs(unit);
    for (int k = 0; k < 4 && ink->width > 0; k++) {
        double at[2] = {x + per * (ink->x + (k & 1 ? ink->width : 0)), y + per * (ink->y + (k & 2 ? ink->height : 0))};
        cairo_user_to_device(cr, &at[0], &at[1]);
        for (int i = 0; i < 2; i++)
            words->low[i] = fmin(words->low[i], at[i]), words->high[i] = fmax(words->high[i], at[i]);
    }
    words->x = x, words->y = y;
    words->centre[0] = x + per * (box->x + box->width / 2.0), words->centre[1] = y + per * (box->y + box->height / 2.0);
    cairo_user_to_device(cr, &words->centre[0], &words->centre[1]);
    cairo_user_to_device(cr, &words->x, &words->y);
    snprintf(words->text, sizeof words->text, "%s", text);
}

void pango_cairo_show_layout(cairo_t *cr, PangoLayout *layout)
{
    static void (*next)(cairo_t *, PangoLayout *);
    if (!next)
        *(void **)&next = dlsym(RTLD_NEXT, "pango_cairo_show_layout");
    PangoRectangle ink, logical;
    pango_layout_get_extents(layout, &ink, &logical);
    drawn_note(cr, pango_layout_get_text(layout), &ink, &logical);
    next(cr, layout);
}

void pango_cairo_show_layout_line(cairo_t *cr, PangoLayoutLine *line)
{
    static void (*next)(cairo_t *, PangoLayoutLine *);
    if (!next)
        *(void **)&next = dlsym(RTLD_NEXT, "pango_cairo_show_layout_line");
    PangoRectangle ink, logical;
    pango_layout_line_get_extents(line, &ink, &logical);
    drawn_note(cr, pango_layout_get_text(line->layout) + line->start_index, &ink, &logical);
    next(cr, line);
}

/* Tags of pages, for readers that do not see them, end in the order in which they began, before their page does. */
enum { TAGS_MOST = 8 };
static char drawn_tags[TAGS_MOST][32];
static size_t drawn_open;

void cairo_tag_begin(cairo_t *cr, const char *name, const char *attributes)
{
    static void (*next)(cairo_t *, const char *, const char *);
    if (!next)
        *(void **)&next = dlsym(RTLD_NEXT, "cairo_tag_begin");
    assert_true(drawn_open < TAGS_MOST);
    snprintf(drawn_tags[drawn_open++], sizeof *drawn_tags, "%s", name);
    next(cr, name, attributes);
}

void cairo_tag_end(cairo_t *cr, const char *name)
{
    static void (*next)(cairo_t *, const char *);
    if (!next)
        *(void **)&next = dlsym(RTLD_NEXT, "cairo_tag_end");
    assert_true(drawn_open > 0 && strcmp(drawn_tags[drawn_open - 1], name) == 0);
    drawn_open--;
    next(cr, name);
}

/* A page ends. */
void cairo_surface_finish(cairo_surface_t *surface)
{
    static void (*next)(cairo_surface_t *);
    if (!next)
        *(void **)&next = dlsym(RTLD_NEXT, "cairo_surface_finish");
    if (drawn_now && cairo_surface_get_type(surface) == CAIRO_SURFACE_TYPE_PDF) {
        static size_t taken;
        assert_int_equal(drawn_open, 0);
        taken = drawn_now->pages ? taken : 0;
        while (taken < strokes.count)
            drawn_page[taken++] = drawn_now->pages;
        drawn_now->pages++;
        assert_true(drawn_now->pages < DRAWN_PAGES_MOST);
    }
    next(surface);
}

static void drawn_take(struct drawn *d)
{
    for (size_t i = 0; i < strokes.count; i++) {
        const struct stroke *s = &strokes.list[i];
        if (s->surface != CAIRO_SURFACE_TYPE_PDF)
            continue;
        struct mark *m = &d->mark[d->marks++];
        *m = (struct mark){.page = drawn_page[i],
                           .filled = s->filled,
                           .width = s->filled ? 0 : s->width,
                           .first = {s->at[0].x, s->at[0].y},
                           .last = {s->at[s->count - 1].x, s->at[s->count - 1].y}};
        for (int k = 0; k < 2; k++)
            m->low[k] = fmax(s->low[k], s->clip_low[k]), m->high[k] = fmin(s->high[k], s->clip_high[k]);
    }
}

static void drawn_play(struct bead_job job, struct drawn *d)
{
    *d = (struct drawn){.marks = 0};
    drawn_now = d;
    strokes_begin();
    play_counts(job);
    strokes.on = false;
    drawn_now = NULL;
    drawn_take(d);
}

/* Runs a scene with all its outputs. */
static void drawn_run(const char *scene, struct drawn *d)
{
    char path[512], out[512];
    in_directory("scene.yaml", path, sizeof path);
    in_directory("", out, sizeof out);
    write_text(path, scene);
    drawn_play((struct bead_job){.input = path, .output = out, .threads = 1}, d);
}

/* Runs chains, or a sweep, for outputs on paper, up to NULL or `most`, each with "%s" for its file; `more`: keys of all. */
static inline void drawn_run_all(const char *chains, const char *const outputs[], size_t most, const char *more, struct drawn *d)
{
    char text[6000];
    int used = snprintf(text, sizeof text, "%soutputs:\n", chains);
    for (size_t i = 0; i < most && outputs[i]; i++) {
        char keys[1000], file[32];
        snprintf(file, sizeof file, "%zu.pdf", i);
        snprintf(keys, sizeof keys, outputs[i], file);
        used += snprintf(text + used, sizeof text - (size_t)used, "  - {%s, style: paper, %s}\n", keys, more);
    }
    drawn_run(text, d);
}

#endif
