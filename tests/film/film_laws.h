/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Films drawn frame by frame in tests, of made-up samples, and laws of their frames: nothing trails, words are apart and on the
 * frame, numbers are where their axes have them, lines are twice as large in a frame of twice the size. */
#ifndef BEADREEL_TESTS_FILM_LAWS_H
#define BEADREEL_TESTS_FILM_LAWS_H

#include <math.h>

#include "render/movie/composer_private.h"
#include "strokes.h"
#include "tests/numbers.h"
#include "tests/scenes.h"
#include "tests/texts.h"

enum { CHAINS = 4, ROOM = 64, FRAMES = 9 };
static int film_size[2] = {480, 270};
static const double span = 1.2e-3;

struct film {
    struct bead_scene *scene;
    struct bead_chain *chains[CHAINS];
    struct bead_composer *composer;
    struct texts texts;
    struct bead_text_watch watch;
};

static const struct bead_film_clock slow = {.slowed = 4000};

static void require(enum bead_error err, const struct bead_message *msg)
{
    if (err)
        fail_msg("%s", msg->text);
}

/* `scale`: of the frame. False, with the words in msg: the frame has no room. */
static bool try_film(struct film *f, const char *chains, const char *output, int scale, struct bead_message *msg)
{
    char text[4000];
    snprintf(text, sizeof text, "title: A film\nsimulate: {until: 1.2 ms}\n%s\noutputs: [{movie: m.mp4, size: [%d, %d], %s}]\n",
             chains, scale * film_size[0], scale * film_size[1], output);
    *f = (struct film){.scene = parse(text), .watch = {texts_note, &f->texts}};
    for (size_t i = 0; i < f->scene->chain_count; i++)
        require(bead_chain_create(f->scene, i, &f->chains[i], msg), msg);
    const struct bead_composer_setup setup = {.output = &f->scene->outputs[0],
                                              .chains = (const struct bead_chain *const *)f->chains,
                                              .chain_count = f->scene->chain_count,
                                              .title = f->scene->title,
                                              .width = scale * film_size[0],
                                              .height = scale * film_size[1],
                                              .time = {0, span},
                                              .step = 2e-6,
                                              .range = {.high = 45},
                                              .scene = f->scene,
                                              .canvas = "plain",
                                              .film = &slow,
                                              .watch = &f->watch,
                                              .tolerance_factor = 1};
    return bead_composer_create(&setup, &f->composer, msg) == BEAD_OK && bead_composer_open(f->composer, msg) == BEAD_OK;
}

static void open_film(struct film *f, const char *chains, const char *output, int scale)
{
    struct bead_message msg = {""};
    if (!try_film(f, chains, output, scale, &msg))
        fail_msg("%s", msg.text);
}

static void close_film(struct film *f)
{
    if (f->composer) {
        bead_composer_close(f->composer);
        bead_composer_destroy(f->composer);
    }
    for (size_t i = 0; i < f->scene->chain_count; i++)
        bead_chain_destroy(f->chains[i]);
    bead_scene_free(f->scene);
}

static double ahead = 0.4; /* beads a frame, of the first chain */

/* A pulse in each chain, the first one ahead, that leaves its beads pushed on. */
static double feed(struct film *f, int frame)
{
    const double time = span * frame / FRAMES;
    for (size_t c = 0; c < f->scene->chain_count; c++) {
        struct bead_message msg = {""};
        double u[ROOM], force[ROOM], speed[ROOM];
        const size_t beads = bead_chain_beads(f->chains[c]);
        struct bead_sample sample = {.chain = c, .time = time, .active = beads, .comparison_active = beads};
        for (int i = 0; i < ROOM; i++) {
            const double x = i - (2.3 - ahead * (double)c) * frame;
            u[i] = 1e-5 / (1 + exp(x));
            force[i] = 40 * exp(-x * x);
            speed[i] = 0.3 * exp(-x * x);
        }
        for (size_t k = 0; k < BEAD_FIELD_COUNT; k++)
            sample.field[k] = sample.comparison[k] = force;
        sample.field[BEAD_FIELD_DISPLACEMENT] = sample.comparison[BEAD_FIELD_DISPLACEMENT] = u;
        sample.field[BEAD_FIELD_VELOCITY] = sample.comparison[BEAD_FIELD_VELOCITY] = speed;
        require(bead_composer_feed(f->composer, &sample, &msg), &msg);
    }
    return time;
}

static void draw(struct film *f, double time, struct bead_changes *changes)
{
    struct bead_message msg = {""};
    require(bead_composer_draw(f->composer, time, changes, &msg), &msg);
}

static void assert_same(const struct bead_frame *a, const struct bead_frame *b, int frame, const char *what)
{
    for (int y = 0; y < film_size[1]; y++) {
        const uint8_t *row = a->pixels + (size_t)y * a->stride, *other = b->pixels + (size_t)y * b->stride;
        for (int i = 0; memcmp(row, other, 4 * (size_t)film_size[0]) != 0 && i < 4 * film_size[0]; i++) {
            if (i % 4 < 3 && abs(row[i] - other[i]) > 1)
                fail_msg("frame %d, %s: %d at %d, %d is also %d", frame, what, row[i], i / 4, y, other[i]);
        }
    }
}

/* The same frame without those before. */
static void assert_anew(const struct film *on, const char *chains, const char *output, int frame)
{
    static struct film f;
    struct bead_message msg = {""};
    open_film(&f, chains, output, 1);
    for (int k = 0; k < frame; k++)
        require(bead_composer_pass(f.composer, feed(&f, k), &msg), &msg);
    draw(&f, feed(&f, frame), &(struct bead_changes){0});
    assert_same(bead_composer_frame(on->composer), bead_composer_frame(f.composer), frame, output);
    close_film(&f);
}

static void assert_nothing_trails(const char *chains, const char *output)
{
    static struct film f;
    struct bead_frame copy;
    struct bead_message msg = {""};
    open_film(&f, chains, output, 1);
    require(bead_frame_create(film_size[0], film_size[1], &copy, &msg), &msg);
    for (int k = 0; k < FRAMES; k++) {
        struct bead_changes changes = {0};
        const struct bead_frame *frame = bead_composer_frame(f.composer);
        draw(&f, feed(&f, k), &changes);
        if (k == 0)
            bead_frame_copy(&copy, frame, (struct bead_rect){0, 0, film_size[0], film_size[1]});
        for (size_t i = 0; i < changes.count; i++) {
            const struct bead_rect *r = &changes.rect[i];
            assert_true(r->x >= 0 && r->y >= 0 && r->x + r->width <= film_size[0] && r->y + r->height <= film_size[1]);
            bead_frame_copy(&copy, frame, *r);
        }
        assert_same(frame, &copy, k, "without what was not told");
        if (k % 4 == 3)
            assert_anew(&f, chains, output, k);
    }
    bead_frame_free(&copy);
    close_film(&f);
}
/* ---- laws of a frame ---- */

static bool is_twice(double a, double b, double slack)
{
    return fabs(2 * a - b) <= slack;
}

enum { LINES_MOST = 4000 };
struct lines {
    size_t count;
    struct stroke line[LINES_MOST];
};

static void take_lines(struct lines *to)
{
    strokes.on = false;
    assert_true(strokes.count < LINES_MOST);
    to->count = 0;
    for (size_t i = 0; i < strokes.count; i++) {
        if (!strokes.list[i].filled)
            to->line[to->count++] = strokes.list[i];
    }
}

/* Are all lines twice as large? Else what is not goes to `why`. */
static bool same_lines(const struct lines lines[2], double slack, char why[300])
{
    snprintf(why, 300, "%zu lines are also %zu", lines[0].count, lines[1].count);
    bool same = lines[0].count == lines[1].count;
    for (size_t i = 0; same && i < lines[0].count; i++) {
        const struct stroke *a = &lines[0].line[i], *b = &lines[1].line[i];
        same = a->dashes == b->dashes;
        for (int k = 0; k < 2; k++)
            same = same && is_twice(a->low[k], b->low[k], slack) && is_twice(a->high[k], b->high[k], slack);
        snprintf(why, 300, "the line of %zu points at %g to %g, %g to %g is also one of %zu at %g to %g, %g to %g", a->count,
                 a->low[0], a->high[0], a->low[1], a->high[1], b->count, b->low[0], b->high[0], b->low[1], b->high[1]);
    }
    return same;
}

/* Words are on the frame, and none is on another; stars and braces of markup are no words. */
static void words_are_apart(const struct texts *texts, int width, int height, const char *what)
{
    /* Of its line, what letters lack above and below: empirical, of the font of these films. */
    const double air = 0.14;
    for (size_t i = 0; i < texts->count; i++) {
        const struct text *a = &texts->text[i];
        bool good = !strstr(a->markup, "*") && !strstr(a->markup, "_{") && a->x >= -1 && a->x + a->width <= width + 1 &&
                    a->y + air * a->height >= 0 && a->y + (1 - air) * a->height <= height;
        for (size_t j = 0; j < i; j++) {
            const struct text *b = &texts->text[j];
            good = good &&
                   !(a->x < b->x + b->width && b->x < a->x + a->width && a->y + air * a->height < b->y + (1 - air) * b->height &&
                     b->y + air * b->height < a->y + (1 - air) * a->height);
        }
        if (!good)
            fail_msg("%s: '%s' at %g, %g is beyond the frame, or on another", what, a->markup, a->x, a->y);
    }
}

static double middle_of(const struct text *t, int along)
{
    return along ? t->y + t->height / 2 : t->x + t->width / 2;
}

/* Are two numbers of one axis? Those below a plot are level; those on the left end at one place. */
static bool is_of_axis(const struct text *a, const struct text *b, int along)
{
    return along ? fabs(a->x + a->width - b->x - b->width) < 2 && fabs(a->y - b->y) > 1
                 : fabs(a->y - b->y) < 1 && a->height == b->height && fabs(a->x - b->x) > 1;
}

/* Numbers that follow each other along an axis are where one scale says. */
static size_t numbers_are_in_place(const struct texts *texts, const char *what)
{
    size_t axes = 0;
    for (int along = 0; along < 2; along++) {
        for (size_t from = 0, to; from < texts->count; from = to) {
            const struct text *t = texts->text;
            for (to = from + 1; to < texts->count && !isnan(number_of(t[from].markup)) && !isnan(number_of(t[to].markup)) &&
                                is_of_axis(&t[to - 1], &t[to], along) &&
                                (number_of(t[to].markup) > number_of(t[to - 1].markup)) ==
                                    (number_of(t[from + 1].markup) > number_of(t[from].markup));)
                to++;
            double least = to - from > 2 ? INFINITY : 0;
            for (int scale = 0; scale < SCALES && to - from > 2; scale++) {
                double off = 0;
                const double first = scaled(number_of(t[from].markup), scale), last = scaled(number_of(t[to - 1].markup), scale),
                             begin = middle_of(&t[from], along), end = middle_of(&t[to - 1], along);
                for (size_t i = from + 1; i + 1 < to; i++)
                    off = fmax(off, fabs(begin + (scaled(number_of(t[i].markup), scale) - first) / (last - first) * (end - begin) -
                                         middle_of(&t[i], along)));
                least = isfinite(off) && isfinite(first) && off < least ? off : least;
            }
            axes += to - from > 2;
            if (!(least < 3))
                fail_msg("%s: numbers from '%s' to '%s' are %g px beside their places", what, t[from].markup, t[to - 1].markup,
                         least);
        }
    }
    return axes;
}

#endif
