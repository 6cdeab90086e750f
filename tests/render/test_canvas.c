/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Canvas and painter, for every back end: the backdrop comes back exactly, discs have the right area and place, parts are drawn
 * like wholes, and impossible requests are errors. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dlfcn.h>
#include <limits.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "render/draw/picture.h"
#include "render/paint/canvas.h"
#include "render/paint/paint.h"
#include "tests/missing.h"

enum { WIDTH = 160, HEIGHT = 96 };

struct context {
    struct bead_canvas *canvas;
    struct bead_frame background, frame;
    struct bead_backdrop *backdrop;
};

static const struct bead_rect whole = {0, 0, WIDTH, HEIGHT};

static void require(enum bead_error err, const struct bead_message *msg)
{
    if (err)
        fail_msg("%s", msg->text);
}

static void fill_with_noise(struct bead_frame *frame)
{
    uint32_t state = 12345;
    for (size_t i = 0; i < frame->stride * (size_t)frame->height; i++)
        frame->pixels[i] = (uint8_t)((state = state * 1664525u + 1013904223u) >> 24);
}

/* A canvas, or the test is left out where the machine lacks Mesa's library for it. */
static struct bead_canvas *open_canvas(const char *backend, int width, int height)
{
    struct bead_canvas *canvas;
    struct bead_message msg = {""};
    enum bead_error err = bead_canvas_create(backend, width, height, &canvas, &msg);
    if (err == BEAD_ERROR_GRAPHICS && strcmp(backend, "plain") != 0) {
        print_message("# %s: %s\n", backend, msg.text);
        skip_without(strcmp(backend, "egl") == 0 ? "EGL (libegl1, libegl-mesa0, libgl1-mesa-dri)" : "OSMesa (libosmesa6)");
    }
    require(err, &msg);
    return canvas;
}

static void keep_background(struct context *s)
{
    struct bead_message msg = {""};
    bead_backdrop_destroy(s->canvas, s->backdrop);
    require(bead_backdrop_create(s->canvas, &s->background, whole, &s->backdrop, &msg), &msg);
}

static void open_stage(struct context *s, const char *backend, bool noisy)
{
    struct bead_message msg = {""};
    *s = (struct context){.canvas = open_canvas(backend, WIDTH, HEIGHT)};
    require(bead_frame_create(WIDTH, HEIGHT, &s->background, &msg), &msg);
    require(bead_frame_create(WIDTH, HEIGHT, &s->frame, &msg), &msg);
    if (noisy)
        fill_with_noise(&s->background);
    keep_background(s);
}

static void close_stage(struct context *s)
{
    bead_backdrop_destroy(s->canvas, s->backdrop);
    bead_canvas_destroy(s->canvas);
    bead_frame_free(&s->background);
    bead_frame_free(&s->frame);
}

static void draw(struct context *s, struct bead_rect rect, const struct bead_ball *balls, size_t ball_count,
                 const struct bead_mark *marks, size_t mark_count)
{
    struct bead_message msg = {""};
    require(bead_paint_begin(s->canvas, s->backdrop, &s->frame, rect, &msg), &msg);
    bead_paint_balls(s->canvas, balls, ball_count);
    bead_paint_marks(s->canvas, marks, mark_count);
    require(bead_paint_end(s->canvas, &msg), &msg);
}

static const uint8_t *pixel(const struct bead_frame *frame, int x, int y)
{
    return frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x;
}

static void test_backdrop_comes_back(void **state)
{
    struct context s;
    open_stage(&s, *state, true);
    draw(&s, whole, NULL, 0, NULL, 0);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++)
            assert_memory_equal(pixel(&s.frame, x, y), pixel(&s.background, x, y), 3);
    }
    close_stage(&s);
}

/* A place of the frame, and a rectangle of that: nothing else is touched, however large the things painted. The place's corner is
 * (0, 0). */
static void test_a_part_of_the_frame_only(void **state)
{
    static const struct bead_rect place = {21, 9, 97, 70}, part = {20, 10, 30, 40};
    struct context s;
    struct bead_message msg = {""};
    open_stage(&s, *state, true);
    bead_backdrop_destroy(s.canvas, s.backdrop);
    require(bead_backdrop_create(s.canvas, &s.background, place, &s.backdrop, &msg), &msg);
    const struct bead_ball ball = {35, 30, 8, 0, 100, {200, 120, 40, 255}};
    const struct bead_ball large = {35, 30, 900, -1000, 1000, {200, 120, 40, 255}};
    const struct bead_mark box = {.box = {-500, -500, 500, 500}, .kind = BEAD_MARK_BOX, .rgba = {1, 2, 3, 255}};
    draw(&s, part, &ball, 1, NULL, 0);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            static const uint8_t nothing[3] = {0};
            int px = x - place.x, py = y - place.y;
            bool inside = px >= 20 && px < 50 && py >= 10 && py < 50;
            double distance = hypot(px + 0.5 - ball.x, py + 0.5 - ball.y);
            if (!inside || distance > ball.r + 0.5)
                assert_memory_equal(pixel(&s.frame, x, y), inside ? pixel(&s.background, x, y) : nothing, 3);
            else if (distance < ball.r - 0.5)
                assert_true(pixel(&s.frame, x, y)[2] > pixel(&s.frame, x, y)[1] &&
                            pixel(&s.frame, x, y)[1] > pixel(&s.frame, x, y)[0]);
        }
    }
    memset(s.frame.pixels, 77, s.frame.stride * HEIGHT);
    draw(&s, part, &large, 1, &box, 1);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            static const uint8_t before[3] = {77, 77, 77}, after[3] = {3, 2, 1};
            bool inside = x >= 41 && x < 71 && y >= 19 && y < 59;
            assert_memory_equal(pixel(&s.frame, x, y), inside ? after : before, 3);
        }
    }
    close_stage(&s);
}

static void test_what_lies_outside_is_refused(void **state)
{
    static const struct bead_rect wrong[] = {
        {-1, 0, 5, 5}, {0, -1, 5, 5}, {WIDTH - 10, 0, 30, 40}, {0, 1, 5, HEIGHT}, {2, 2, INT_MAX, 1}};
    struct context s, other;
    struct bead_message msg = {""};
    struct bead_backdrop *backdrop;
    struct bead_frame small;
    open_stage(&s, *state, true);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(bead_paint_begin(s.canvas, s.backdrop, &s.frame, wrong[i], &msg), BEAD_ERROR_GRAPHICS);
        assert_int_equal(bead_backdrop_create(s.canvas, &s.background, wrong[i], &backdrop, &msg), BEAD_ERROR_GRAPHICS);
        assert_null(backdrop);
    }
    require(bead_frame_create(WIDTH, HEIGHT - 1, &small, &msg), &msg);
    assert_int_equal(bead_paint_begin(s.canvas, s.backdrop, &small, (struct bead_rect){0, 0, 5, 5}, &msg), BEAD_ERROR_GRAPHICS);
    other = (struct context){.canvas = open_canvas(*state, 20, 20)};
    require(bead_backdrop_create(other.canvas, &s.background, whole, &other.backdrop, &msg), &msg);
    assert_int_equal(bead_paint_begin(other.canvas, other.backdrop, &s.frame, (struct bead_rect){0, 0, 21, 5}, &msg),
                     BEAD_ERROR_GRAPHICS);
    close_stage(&other);
    bead_frame_free(&small);
    draw(&s, (struct bead_rect){7, 7, 0, -3}, NULL, 0, NULL, 0); /* nothing: fine */
    close_stage(&s);
}

/* Coverage of a ring as wide as its radius: a flat white disc. */
static void measure_disc(struct context *s, double x, double y, double r, double *area, double *cx, double *cy)
{
    struct bead_mark disc = {.box = {(float)(x - r - 1), (float)(y - r - 1), (float)(x + r + 1), (float)(y + r + 1)},
                             .shape = {(float)(0.5 * r), (float)r},
                             .kind = BEAD_MARK_RING,
                             .rgba = {255, 255, 255, 255}};
    draw(s, whole, NULL, 0, &disc, 1);
    double sum[3] = {0};
    for (int py = 0; py < HEIGHT; py++) {
        for (int px = 0; px < WIDTH; px++) {
            double c = pixel(&s->frame, px, py)[1] / 255.0;
            sum[0] += c;
            sum[1] += c * (px + 0.5);
            sum[2] += c * (py + 0.5);
        }
    }
    *area = sum[0];
    *cx = sum[1] / sum[0];
    *cy = sum[2] / sum[0];
}

/* Drawn over white and over black, a ball's coverage is what they differ by. */
static void measure_ball(struct context *white, struct context *black, const struct bead_ball *ball, double *area, double *cx,
                         double *cy)
{
    draw(white, whole, ball, 1, NULL, 0);
    draw(black, whole, ball, 1, NULL, 0);
    double sum[3] = {0};
    for (int py = 0; py < HEIGHT; py++) {
        for (int px = 0; px < WIDTH; px++) {
            double c = 1 - (pixel(&white->frame, px, py)[1] - pixel(&black->frame, px, py)[1]) / 255.0;
            sum[0] += c;
            sum[1] += c * (px + 0.5);
            sum[2] += c * (py + 0.5);
        }
    }
    *area = sum[0];
    *cx = sum[1] / sum[0];
    *cy = sum[2] / sum[0];
}

static void test_area_and_place_of_balls(void **state)
{
    struct context white, black;
    open_stage(&black, *state, false);
    open_stage(&white, *state, false);
    memset(white.background.pixels, 255, white.background.stride * HEIGHT);
    keep_background(&white);
    static const double radii[] = {2, 3.7, 7, 20, 40};
    for (size_t i = 0; i < sizeof radii / sizeof radii[0]; i++) {
        for (int k = 0; k < 8; k++) {
            double r = radii[i], x = 70 + k / 8.0, y = 48 + 3 * k / 64.0, area, cx, cy;
            float soft = (float)sqrt(r * r - 1.0 / 12);
            struct bead_ball ball = {(float)x, (float)y, soft, (float)(x - 60), (float)(x + 60), {200, 120, 40, 255}};
            measure_ball(&white, &black, &ball, &area, &cx, &cy);
            if (fabs(area - M_PI * r * r) > fmax(0.005 * M_PI * r * r, 0.15)) /* 8 bits a pixel leave the second */
                fail_msg("a disc of radius %g px at %g, %g covers %.4f px, not %.4f", r, x, y, area, M_PI * r * r);
            if (fmax(fabs(cx - x), fabs(cy - y)) > (r > 3 ? 0.02 : 0.04))
                fail_msg("a disc of radius %g px at %g, %g has its middle at %.4f, %.4f", r, x, y, cx, cy);
        }
    }
    double area, cx, cy;
    measure_disc(&black, 70.25, 40.5, 20, &area, &cx, &cy);
    assert_true(fabs(cx - 70.25) < 0.02 && fabs(cy - 40.5) < 0.02);
    close_stage(&white);
    close_stage(&black);
}

static size_t make_balls(struct bead_ball *balls, struct bead_mark *marks)
{
    for (size_t i = 0; i < 9; i++) {
        float x = 9.3f + 17.77f * (float)i, r = 10.1f - (float)(i % 3);
        balls[i] = (struct bead_ball){x, 47.5f, r, x - (i % 2 ? 7.5f : 20), x + 20, {(uint8_t)(28 * i), 180, 90, 255}};
        marks[i] = (struct bead_mark){
            .box = {x - 8, 30.25f, x + 8, 70}, .shape = {5, 1.5f, 3, 4}, .kind = (float)(i % 5), .rgba = {250, 200, 60, 200}};
    }
    return 9;
}

/* The same bits whether drawn at once, in stripes, or again over the previous picture. */
/* Mean level of 5 x 5 pixels of a ball of radius 400 px whose shade, under a point lamp, would begin in the middle of the canvas,
 * `way` px further away from the lamp. */
static double shade_at(const struct context *s, double way)
{
    static const double across[2] = {0.54, 0.84}; /* away from the lamp */
    double sum = 0;
    for (int k = 0; k < 25; k++)
        sum += pixel(&s->frame, (int)(WIDTH / 2 + way * across[0]) + k % 5 - 2, (int)(HEIGHT / 2 + way * across[1]) + k / 5 - 2)[1];
    return sum / 25;
}

/* The lamp is no point: where the shade begins there is no line. A point's light, 0.74 of the full, ends there with a slope of 1 /
 * r in units of distance on the ball, which foreshortening makes steeper: half of that kink would be seen. */
static void test_shades_begin_softly(void **state)
{
    const double r = 400, far = 0.746 * r, way = fmin(WIDTH, HEIGHT) / 3.0, level = 200;
    struct context s;
    open_stage(&s, *state, false);
    const struct bead_ball ball = {.x = (float)(WIDTH / 2 - 0.54 * far),
                                   .y = (float)(HEIGHT / 2 - 0.84 * far),
                                   .r = (float)r,
                                   .left = -1000,
                                   .right = 2000,
                                   .rgba = {(uint8_t)level, (uint8_t)level, (uint8_t)level, 255}};
    draw(&s, whole, &ball, 1, NULL, 0);
    const double bend = shade_at(&s, way) - 2 * shade_at(&s, 0) + shade_at(&s, -way), kink = 0.74 * level * way / r;
    if (!(fabs(bend) < 0.5 * kink))
        fail_msg("the slope of the shade jumps: levels bend by %.1f, a point lamp's by %.1f", bend, kink);
    /* The highlight of a bright ball keeps its colour. */
    const struct bead_ball bright = {
        .x = WIDTH / 2, .y = HEIGHT / 2, .r = 0.45f * (float)HEIGHT, .left = -1000, .right = 2000, .rgba = {200, 210, 224, 255}};
    draw(&s, whole, &bright, 1, NULL, 0);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const uint8_t *p = pixel(&s.frame, i % WIDTH, i / WIDTH);
        assert_true(p[0] < 255 && p[1] < 255 && p[2] < 255);
    }
    close_stage(&s);
}

static void test_parts_are_as_the_whole(void **state)
{
    struct context s;
    struct bead_ball balls[9];
    struct bead_mark marks[9];
    struct bead_frame once;
    struct bead_message msg = {""};
    size_t count = make_balls(balls, marks);
    open_stage(&s, *state, true);
    require(bead_frame_create(WIDTH, HEIGHT, &once, &msg), &msg);
    draw(&s, whole, balls, count, marks, count);
    bead_frame_copy(&once, &s.frame, whole);
    memset(s.frame.pixels, 0, s.frame.stride * HEIGHT);
    for (int x = 0; x < WIDTH; x += 13) {
        int width = x + 13 < WIDTH ? 13 : WIDTH - x;
        draw(&s, (struct bead_rect){x, 0, width, 50}, balls, count, marks, count);
        draw(&s, (struct bead_rect){x, 50, width, HEIGHT - 50}, balls, count, marks, count);
    }
    assert_true(bead_frame_hash(&s.frame) == bead_frame_hash(&once));
    bead_frame_free(&once);
    close_stage(&s);
}

/* Both of Mesa's are open at the same time, and alternate. */
static void test_opengl_has_the_same_pixels_everywhere(void **state)
{
    static const char *const names[2] = {"osmesa", "egl"};
    (void)state;
    struct context stages[2];
    struct bead_ball balls[9];
    struct bead_mark marks[9];
    uint64_t first[2] = {0, 0};
    size_t count = make_balls(balls, marks);
    for (int i = 0; i < 2; i++) {
        open_stage(&stages[i], names[i], true);
        assert_non_null(strstr(bead_canvas_describe(stages[i].canvas), names[i]));
    }
    for (int turn = 0; turn < 2; turn++) {
        for (int i = 0; i < 2; i++) {
            draw(&stages[i], whole, balls, turn ? count : count - 1, marks, count);
            uint64_t hash = bead_frame_hash(&stages[i].frame);
            first[turn] = i == 0 ? hash : first[turn];
            assert_true(hash == first[turn]);
        }
    }
    assert_true(first[0] != first[1]);
    for (int i = 0; i < 2; i++)
        close_stage(&stages[i]);
}

static void test_failures_are_told(void **state)
{
    struct bead_canvas *canvas = (struct bead_canvas *)state;
    struct bead_message msg = {""};
    assert_int_equal(bead_canvas_create("etch-a-sketch", 10, 10, &canvas, &msg), BEAD_ERROR_USAGE);
    assert_null(canvas);
    assert_non_null(strstr(msg.text, "osmesa, egl, plain"));
    assert_int_equal(bead_canvas_create(NULL, 0, 10, &canvas, &msg), BEAD_ERROR_GRAPHICS);
    assert_null(canvas);
    bead_canvas_destroy(NULL);
}

static void test_opengl_has_limits(void **state)
{
    struct bead_canvas *canvas = open_canvas(*state, 8, 8);
    struct bead_message msg = {""};
    bead_canvas_destroy(canvas);
    assert_int_equal(bead_canvas_create(*state, 1000000, 10, &canvas, &msg), BEAD_ERROR_GRAPHICS);
    assert_null(canvas);
    assert_non_null(strstr(msg.text, "too large"));
}

/* Without its shaders a canvas can be made, but drawing reports the missing one. */
static void test_missing_shaders(void **state)
{
    struct bead_canvas *canvas = open_canvas(*state, 8, 8);
    struct bead_message msg = {""};
    struct bead_frame frame;
    struct bead_backdrop *backdrop;
    char directory[256], *before = getenv("BEADREEL_ASSETS");
    char *kept = before ? strdup(before) : NULL;
    snprintf(directory, sizeof directory, "%s/beadreel-XXXXXX", getenv("TMPDIR") ? getenv("TMPDIR") : "/tmp");
    assert_non_null(mkdtemp(directory));
    require(bead_frame_create(8, 8, &frame, &msg), &msg);
    assert_int_equal(setenv("BEADREEL_ASSETS", directory, 1), 0);
    char shaders[300], path[320];
    snprintf(shaders, sizeof shaders, "%s/shaders", directory);
    assert_int_equal(mkdir(shaders, 0700), 0);
    snprintf(path, sizeof path, "%s/ball.vert", shaders);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("#version 330 core\nvoid main() { nonsense }\n", file);
    fclose(file);
    enum bead_error err = bead_backdrop_create(canvas, &frame, (struct bead_rect){0, 0, 8, 8}, &backdrop, &msg);
    assert_int_equal(err, BEAD_ERROR_GRAPHICS);
    assert_non_null(strstr(msg.text, "ball.vert does not compile"));
    if (kept)
        setenv("BEADREEL_ASSETS", kept, 1);
    else
        unsetenv("BEADREEL_ASSETS");
    free(kept);
    remove(path);
    remove(shaders);
    remove(directory);
    bead_frame_free(&frame);
    bead_canvas_destroy(canvas);
}

static void test_says_what_it_is(void **state)
{
    struct bead_canvas *canvas = open_canvas(*state, 8, 8);
    assert_non_null(strstr(bead_canvas_describe(canvas), *state));
    assert_true(!strstr(bead_canvas_describe(canvas), "OpenGL") == !strcmp(*state, "plain"));
    bead_canvas_destroy(canvas);
}

/* Who painted, in the words of result lines. */
static void test_says_who_painted(void **state)
{
    static const char *const titles[][2] = {
        {"osmesa", "OSMesa (llvmpipe)"}, {"egl", "EGL (llvmpipe)"}, {"plain", "the plain canvas ("}};
    struct bead_canvas *canvas = open_canvas(*state, 8, 8);
    for (size_t i = 0; i < sizeof titles / sizeof *titles; i++) {
        if (strcmp(*state, titles[i][0]) == 0)
            assert_memory_equal(bead_canvas_painter(canvas), titles[i][1], strlen(titles[i][1]));
    }
    bead_canvas_destroy(canvas);
}

/* Without a name it is the first available one of the table: OSMesa, EGL, plain. */
static void test_the_first_that_works(void **state)
{
    struct bead_canvas *canvas, *named = NULL;
    struct bead_message msg = {""};
    (void)state;
    assert_string_equal(bead_canvas_backend_info(0)->name, "osmesa");
    assert_string_equal(bead_canvas_backend_info(1)->name, "egl");
    assert_string_equal(bead_canvas_backend_info(2)->name, "plain");
    assert_null(bead_canvas_backend_info(3));
    for (size_t i = 0; !named; i++) {
        enum bead_error err = bead_canvas_create(bead_canvas_backend_info(i)->name, 8, 8, &named, &msg);
        assert_true(err == BEAD_OK || err == BEAD_ERROR_GRAPHICS);
    }
    require(bead_canvas_create(NULL, 8, 8, &canvas, &msg), &msg);
    assert_string_equal(bead_canvas_describe(canvas), bead_canvas_describe(named));
    bead_canvas_destroy(canvas);
    bead_canvas_destroy(named);
}

/* If OpenGL is not requested, nothing of it is opened, and the environment does not change. */
static void test_plain_needs_no_opengl(void **state)
{
    static const char *const variables[] = {"LP_NUM_THREADS", "LIBGL_ALWAYS_SOFTWARE"};
    struct context s;
    (void)state;
    for (int i = 0; i < 2; i++)
        unsetenv(variables[i]);
    bead_canvas_prepare("plain");
    open_stage(&s, "plain", true);
    draw(&s, whole, NULL, 0, NULL, 0);
    assert_null(getenv(variables[0]));
    assert_null(getenv(variables[1]));
    assert_null(dlopen("libOSMesa.so.8", RTLD_NOLOAD | RTLD_LAZY));
    assert_null(dlopen("libEGL.so.1", RTLD_NOLOAD | RTLD_LAZY));
    close_stage(&s);
    bead_canvas_prepare("egl");
    assert_string_equal(getenv(variables[0]), sysconf(_SC_NPROCESSORS_ONLN) < 4 ? "0" : "2");
    assert_string_equal(getenv(variables[1]), "1");
}

#define FOR(name, test)                                    \
    {                                                      \
#test "(" name ")", test, NULL, NULL, (void *)name \
    }
#define FOR_EACH(test) FOR("plain", test), FOR("osmesa", test), FOR("egl", test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plain_needs_no_opengl), /* before anything opens it */
        FOR_EACH(test_backdrop_comes_back),
        FOR_EACH(test_a_part_of_the_frame_only),
        FOR_EACH(test_what_lies_outside_is_refused),
        FOR_EACH(test_area_and_place_of_balls),
        FOR_EACH(test_shades_begin_softly),
        FOR_EACH(test_parts_are_as_the_whole),
        cmocka_unit_test(test_opengl_has_the_same_pixels_everywhere),
        cmocka_unit_test(test_failures_are_told),
        FOR("osmesa", test_opengl_has_limits),
        FOR("egl", test_opengl_has_limits),
        FOR("osmesa", test_missing_shaders),
        FOR("egl", test_missing_shaders),
        FOR_EACH(test_says_what_it_is),
        FOR_EACH(test_says_who_painted),
        cmocka_unit_test(test_the_first_that_works),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
