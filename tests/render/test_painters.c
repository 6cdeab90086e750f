/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The painter of this program against OpenGL's, pixel by pixel; its instruction sets against each other. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pictures.h"
#include "render/paint/canvas.h"
#include "render/paint/paint.h"
#include "render/paint/pixel_kernels.h"
#include "sessions.h"
#include "tests/missing.h"
#include "tests/painting.h"

enum { WIDTH = 701, HEIGHT = 203, BALLS = 60, MARKS = 24 };

/* Where the painted rectangle lies in the frame: not at the beginning of a vector. */
static const struct bead_rect place = {37, 11, 620, 180};

struct drawing {
    const char *name;
    size_t balls, marks;
    struct bead_ball ball[BALLS];
    struct bead_mark mark[MARKS];
    bool ways; /* the marks are */
};

static void colour(uint32_t *seed, uint8_t rgba[4])
{
    for (int c = 0; c < 4; c++)
        rgba[c] = (uint8_t)random_bits(seed);
}

static struct bead_ball *add_ball(struct drawing *d, uint32_t *seed, double x, double y, double r)
{
    struct bead_ball *b = &d->ball[d->balls++];
    *b = (struct bead_ball){.x = (float)x, .y = (float)y, .r = (float)r, .left = (float)(x - r - 2), .right = (float)(x + r + 2)};
    colour(seed, b->rgba);
    return b;
}

/* A chain as the view has it: neighbours overlap a little and meet in planes. */
static void make_row(struct drawing *d, double r, uint32_t seed)
{
    d->name = "a row";
    double x = -0.4 * r;
    for (int i = 0; d->balls < BALLS && x - r < place.width; i++) {
        double own = sqrt(r * r - 1.0 / 12), gap = (double)(random_bits(&seed) % 100) / 100 - 0.7;
        struct bead_ball *b = add_ball(d, &seed, round(64 * x) / 64, 0.5 * place.height, own);
        if (i > 0 && b->x < b[-1].x + b[-1].r + b->r)
            b[-1].right = b->left = b[-1].x + (b->x - b[-1].x) * b[-1].r / (b[-1].r + b->r);
        x += 2 * r + 0.1 * r * gap;
    }
}

static void make_single(struct drawing *d, double least, double most, uint32_t seed)
{
    d->name = "single balls";
    for (int i = 0; i < 40; i++) {
        double r = least * pow(most / least, random_bits(&seed) / 16777216.0);
        struct bead_ball *b = add_ball(d, &seed, random_place(&seed, -0.2 * r, place.width + 0.2 * r),
                                       random_place(&seed, -0.2 * r, place.height + 0.2 * r), r);
        if (i % 3 == 1)
            b->left = random_place(&seed, b->x - r, b->x);
        if (i % 3 == 2)
            b->right = random_place(&seed, b->x, b->x + r);
    }
}

static void make_marks(struct drawing *d, enum bead_mark_kind kind, uint32_t seed)
{
    static const char *const names[] = {"boxes", "hatches", "rings", "arrows", "glows"};
    d->name = names[kind];
    for (int i = 0; i < MARKS; i++) {
        struct bead_mark *m = &d->mark[d->marks++];
        float x = random_place(&seed, 0, 560), y = random_place(&seed, -10, 150), wide = random_place(&seed, 6, 240),
              high = random_place(&seed, 6, 120), small = fminf(wide, high);
        *m = (struct bead_mark){.box = {x, y, x + wide, y + high}, .kind = (float)kind};
        colour(&seed, m->rgba);
        m->shape[0] = kind == BEAD_MARK_RING ? 0.4f * small : 6 + 0.1f * small;
        m->shape[1] = kind == BEAD_MARK_RING ? 1.2f + 0.05f * small : 0;
    }
}

/* From a part of the box's upper edge to all of its lower one; the kernels alone paint these. */
static struct drawing make_ways(uint32_t seed)
{
    struct drawing d = {.balls = 0};
    make_marks(&d, BEAD_MARK_BOX, seed);
    d.name = "ways to a lens";
    d.ways = true;
    for (size_t i = 0; i < d.marks; i++) {
        struct bead_mark *m = &d.mark[i];
        float wide = m->box[2] - m->box[0];
        m->shape[0] = m->box[0] + 0.4f * wide;
        m->shape[1] = m->shape[0] + fmaxf(4, 0.2f * wide);
        m->shape[2] = m->box[0] + 1;
        m->shape[3] = m->box[2] - 1;
    }
    return d;
}

struct context {
    struct bead_canvas *canvas;
    struct bead_backdrop *backdrop;
    struct bead_frame background, frame;
};

/* Flat, or noise of all levels (-1). */
static void fill(struct bead_frame *frame, int level)
{
    uint32_t seed = 4711;
    for (size_t i = 0; i < frame->stride * (size_t)frame->height; i++)
        frame->pixels[i] = level < 0 ? (uint8_t)random_bits(&seed) : (uint8_t)level;
}

static void open_stage(struct context *s, struct bead_canvas *canvas, int level)
{
    struct bead_message msg = {""};
    *s = (struct context){.canvas = canvas};
    require(bead_frame_create(WIDTH, HEIGHT, &s->background, &msg), &msg);
    require(bead_frame_create(WIDTH, HEIGHT, &s->frame, &msg), &msg);
    fill(&s->background, level);
    require(bead_backdrop_create(s->canvas, &s->background, place, &s->backdrop, &msg), &msg);
}

static void close_stage(struct context *s)
{
    bead_backdrop_destroy(s->canvas, s->backdrop);
    bead_frame_free(&s->background);
    bead_frame_free(&s->frame);
}

static void draw(struct context *s, const struct drawing *d)
{
    struct bead_message msg = {""};
    const struct bead_rect all = {0, 0, place.width, place.height};
    require(bead_paint_begin(s->canvas, s->backdrop, &s->frame, all, &msg), &msg);
    bead_paint_balls(s->canvas, d->ball, d->balls);
    bead_paint_marks(s->canvas, d->mark, d->marks);
    require(bead_paint_end(s->canvas, &msg), &msg);
}

struct difference {
    size_t levels, differing;
    int worst, x, y;
};

static void compare_levels(int a, int b, int x, int y, struct difference *diff)
{
    int by = abs(a - b);
    diff->levels++;
    diff->differing += by > 0;
    if (by > diff->worst)
        *diff = (struct difference){diff->levels, diff->differing, by, x, y};
}

static void compare(const struct bead_frame *a, const struct bead_frame *b, struct difference *diff)
{
    for (int y = 0; y < a->height; y++) {
        for (int x = 0; x < a->width; x++) {
            size_t at = (size_t)y * a->stride + 4 * (size_t)x;
            for (size_t c = 0; c < 3; c++)
                compare_levels(a->pixels[at + c], b->pixels[at + c], x, y, diff);
        }
    }
}

/* Nearly all are equal, and none is far off. */
static void assert_close(const struct difference *diff, const char *what)
{
    if (diff->worst > 1)
        fail_msg("%s: %d levels of difference at %d, %d", what, diff->worst, diff->x, diff->y);
    if ((double)diff->differing > 5e-5 * (double)diff->levels)
        fail_msg("%s: %zu of %zu levels differ", what, diff->differing, diff->levels);
}

static struct drawing make_drawing(int number)
{
    static const double rows[] = {1.6, 4.3, 13.7, 41, 89}, singles[][2] = {{0.2, 1.5}, {1, 12}, {10, 120}, {500, 3000}};
    struct drawing d = {.balls = 0};
    if (number < 5)
        make_row(&d, rows[number], (uint32_t)number + 1);
    else if (number < 9)
        make_single(&d, singles[number - 5][0], singles[number - 5][1], (uint32_t)number);
    else
        make_marks(&d, (enum bead_mark_kind)(number - 9), (uint32_t)number);
    return d;
}
enum { DRAWINGS = 14 };

/* Over dark, light and noise. */
static const int levels[] = {14, 250, -1};
enum { LEVELS = sizeof levels / sizeof levels[0] };

static void test_as_opengl(void **state)
{
    struct bead_canvas *own, *gl;
    struct bead_message msg = {""};
    (void)state;
    if (bead_canvas_create("osmesa", place.width, place.height, &gl, &msg)) {
        print_message("# %s\n", msg.text);
        skip_without("OSMesa (libosmesa6)");
    }
    require(bead_canvas_create("plain", place.width, place.height, &own, &msg), &msg);
    for (int number = 0; number < DRAWINGS; number++) {
        const struct drawing d = make_drawing(number);
        struct difference diff = {0};
        for (int l = 0; l < LEVELS; l++) {
            struct context a, b;
            open_stage(&a, own, levels[l]);
            open_stage(&b, gl, levels[l]);
            draw(&a, &d);
            draw(&b, &d);
            compare(&a.frame, &b.frame, &diff);
            close_stage(&a);
            close_stage(&b);
        }
        assert_close(&diff, d.name);
    }
    bead_canvas_destroy(own);
    bead_canvas_destroy(gl);
}

/* ---- whole pictures ---- */

static const char scene[] = "chains:\n"
                            "  - name: long\n"
                            "    striker: {bead: large-steel, velocity: 0.443 m/s}\n"
                            "    beads:\n"
                            "      - {cell: [large-steel, aluminium], count: 29, spins: random, magnetism: 0.3, seed: 3}\n"
                            "      - {bead: small-steel, sensor: first}\n"
                            "    wall: brass\n"
                            "  - name: short\n"
                            "    striker: {bead: large-steel, velocity: 0.443 m/s}\n"
                            "    beads: [{cell: [large-steel, aluminium], count: 4}, {bead: small-steel, sensor: second}]\n"
                            "    wall: rigid\n"
                            "simulate: {until: 0.5 ms}\n"
                            "outputs:\n"
                            "  - {image: one.png, views: [beads], at: 0.25 ms, size: [1280, 420], theme: dark}\n"
                            "  - {image: two.png, views: [beads, profile], at: 0.45 ms, size: [900, 500], theme: light}\n"
                            "  - {image: three.png, views: [beads], at: 0.09 ms, size: [1000, 240], theme: light}\n"
                            "  - {image: four.png, views: [beads], at: 0.12 ms, size: [500, 140], theme: dark}\n";
enum { PICTURES = 4 };

static void make_pictures(const char *path, const char *canvas, struct png_file pictures[PICTURES])
{
    char directory[512];
    const struct bead_result *results;
    in_directory("", directory, sizeof directory);
    struct bead_session *session = play_session((struct bead_job){.input = path, .output = directory, .canvas = canvas});
    assert_int_equal(bead_session_results(session, &results), PICTURES);
    for (size_t i = 0; i < PICTURES; i++) {
        pictures[i] = read_png(results[i].path);
        assert_int_equal(unlink(results[i].path), 0);
    }
    bead_session_close(session);
}

/* Row, lens, way to it, rings of sensors, arrow, glow, walls, as a scene makes them, dark and light. */
static void test_pictures_as_opengl(void **state)
{
    struct bead_canvas *gl;
    struct bead_message msg = {""};
    struct png_file own[PICTURES], other[PICTURES];
    char path[512];
    (void)state;
    if (bead_canvas_create("osmesa", 8, 8, &gl, &msg)) {
        print_message("# %s\n", msg.text);
        skip_without("OSMesa (libosmesa6)");
    }
    bead_canvas_destroy(gl);
    in_directory("scene.yaml", path, sizeof path);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(scene, file);
    assert_int_equal(fclose(file), 0);
    make_pictures(path, NULL, own);
    make_pictures(path, "osmesa", other);
    assert_int_equal(unlink(path), 0);
    for (int i = 0; i < PICTURES; i++) {
        struct difference diff = {0};
        assert_true(own[i].width == other[i].width && own[i].height == other[i].height);
        for (int at = 0; at < 3 * own[i].width * own[i].height; at++)
            compare_levels(own[i].rgb[at], other[i].rgb[at], at / 3 % own[i].width, at / 3 / own[i].width, &diff);
        assert_close(&diff, "a picture");
        free(own[i].rgb);
        free(other[i].rgb);
    }
}

/* ---- instruction sets ---- */

/* What no view should ask for. */
static struct drawing make_wild(void)
{
    static const float odd[] = {NAN, INFINITY, -INFINITY, 0, -5, 1e30f, -1e30f, 3e9f, 1e-30f};
    enum { ODD = sizeof odd / sizeof odd[0] };
    struct drawing d = {.name = "wild numbers"};
    for (int i = 0; i < 5 * ODD; i++) {
        float *field[5] = {&d.ball[i].x, &d.ball[i].y, &d.ball[i].r, &d.ball[i].left, &d.ball[i].right};
        d.ball[i] = (struct bead_ball){(float)(7 * i), 40, 20, 0, 600, {200, 100, 50, 255}};
        *field[i % 5] = odd[i / 5];
    }
    d.balls = 5 * ODD;
    for (int i = 0; i < MARKS; i++) {
        d.mark[i] = (struct bead_mark){
            .box = {(float)(20 * i), 100, (float)(20 * i) + 50, 160}, .shape = {6, 2, 3, 4}, .kind = (float)(i % 5)};
        memset(d.mark[i].rgba, 200, 4);
        *(i % 2 ? &d.mark[i].box[i / 2 % 4] : &d.mark[i].shape[i / 2 % 4]) = odd[i % ODD];
    }
    d.marks = MARKS;
    return d;
}

static void draw_with(const struct bead_pixel_kernels *kernels, struct bead_frame *frame, const struct drawing *d, int level)
{
    const struct bead_ground ground = {
        .pixels = frame->pixels, .stride = frame->stride, .origin = {place.x, place.y}, .clip = {3, 1, place.width - 8, 175}};
    fill(frame, level);
    kernels->balls(&ground, d->ball, d->balls);
    if (!d->ways)
        kernels->marks(&ground, d->mark, d->marks);
    for (size_t i = 0; i < (d->ways ? d->marks : 0); i++)
        kernels->zoom(&ground, &d->mark[i]);
}

/* Nothing outside of the clip has changed, in the padding of rows neither. */
static void assert_clipped(const struct bead_frame *frame, const struct bead_frame *before)
{
    const size_t left = 4 * (size_t)(place.x + 3), right = left + 4 * (size_t)(place.width - 8);
    for (int y = 0; y < frame->height; y++) {
        const uint8_t *now = frame->pixels + (size_t)y * frame->stride, *was = before->pixels + (size_t)y * frame->stride;
        bool inside = y >= place.y + 1 && y < place.y + 1 + 175;
        assert_memory_equal(now, was, inside ? left : frame->stride);
        assert_memory_equal(now + right, was + right, inside ? frame->stride - right : 0);
    }
}

static void test_instruction_sets_give_the_same_pixels(void **state)
{
    static const char *const names[] = {"sse2", "avx2", "avx512"};
    const struct bead_pixel_kernels *least = bead_pixel_kernels_find("portable");
    struct bead_frame one, other, before;
    struct bead_message msg = {""};
    (void)state;
    assert_non_null(least);
    assert_null(bead_pixel_kernels_find("abacus"));
    require(bead_frame_create(WIDTH, HEIGHT, &one, &msg), &msg);
    require(bead_frame_create(WIDTH, HEIGHT, &other, &msg), &msg);
    require(bead_frame_create(WIDTH, HEIGHT, &before, &msg), &msg);
    for (int number = 0; number <= DRAWINGS + 2; number++) {
        struct drawing d = number < DRAWINGS ? make_drawing(number) : number == DRAWINGS ? make_ways(7) : make_wild();
        d.ways = number == DRAWINGS || number == DRAWINGS + 2; /* also wild ones */
        const int level = levels[number % LEVELS];
        fill(&before, level);
        draw_with(least, &one, &d, level);
        assert_clipped(&one, &before);
        assert_memory_not_equal(one.pixels, before.pixels, one.stride * HEIGHT);
        for (int i = 0; i < 3; i++) {
            const struct bead_pixel_kernels *kernels = bead_pixel_kernels_find(names[i]);
            if (!kernels)
                continue; /* this machine has none */
            assert_string_equal(kernels->name, names[i]);
            draw_with(kernels, &other, &d, level);
            assert_memory_equal(one.pixels, other.pixels, one.stride * HEIGHT);
        }
    }
    bead_frame_free(&one);
    bead_frame_free(&other);
    bead_frame_free(&before);
}

/* Frames narrower than a vector, and painters that begin anywhere in them. */
static void test_narrow_frames(void **state)
{
    static const char *const names[] = {"portable", "sse2", "avx2", "avx512"};
    struct bead_message msg = {""};
    (void)state;
    for (int width = 1; width < 36; width++) {
        struct bead_frame frames[4];
        const int x = width / 3;
        const struct bead_ball ball = {2.3f, 1.5f, 6, -30, 30, {90, 200, 30, 255}};
        const struct bead_mark mark = {.box = {-3, -3, 40, 9}, .kind = BEAD_MARK_GLOW, .rgba = {255, 255, 255, 200}};
        for (int i = 0; i < 4; i++) {
            const struct bead_pixel_kernels *kernels = bead_pixel_kernels_find(names[i]);
            require(bead_frame_create(width, 3, &frames[i], &msg), &msg);
            const struct bead_ground ground = {frames[i].pixels, frames[i].stride, {x, 0}, {0, 0, width - x, 3}};
            if (kernels) { /* else this machine has none */
                kernels->balls(&ground, &ball, 1);
                kernels->marks(&ground, &mark, 1);
                assert_memory_equal(frames[0].pixels, frames[i].pixels, 3 * frames[i].stride);
            }
        }
        assert_true(frames[0].pixels[4 * x + 1] > frames[0].pixels[4 * x]);
        for (int i = 0; i < 4; i++)
            bead_frame_free(&frames[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_as_opengl),
        cmocka_unit_test(test_pictures_as_opengl),
        cmocka_unit_test(test_instruction_sets_give_the_same_pixels),
        cmocka_unit_test(test_narrow_frames),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
