/* Canvas and painter: pixels come back exactly, discs have the right area and place, parts are drawn as wholes, and what cannot be
 * is an error. */
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
#include <sys/stat.h>

#include "beadreel/canvas.h"
#include "render/paint.h"

enum { WIDTH = 160, HEIGHT = 96 };

struct stage {
    struct bead_canvas *canvas;
    struct bead_frame background, frame;
    struct bead_backdrop backdrop;
};

static const struct bead_rect whole = {0, 0, WIDTH, HEIGHT};

static void require(enum bead_error err, const struct bead_message *msg)
{
    if (err)
        fail_msg("%s", msg->text);
}

static void open_stage_with(struct stage *s, const char *backend, bool noisy)
{
    struct bead_message msg = {""};
    *s = (struct stage){.canvas = NULL};
    require(bead_canvas_create(backend, WIDTH, HEIGHT, &s->canvas, &msg), &msg);
    require(bead_frame_create(WIDTH, HEIGHT, &s->background, &msg), &msg);
    require(bead_frame_create(WIDTH, HEIGHT, &s->frame, &msg), &msg);
    uint32_t state = 12345;
    for (size_t i = 0; noisy && i < s->background.stride * HEIGHT; i++)
        s->background.pixels[i] = (uint8_t)((state = state * 1664525u + 1013904223u) >> 24);
    require(bead_backdrop_set(s->canvas, &s->backdrop, &s->background, whole, &msg), &msg);
}

static void open_stage(struct stage *s, bool noisy)
{
    open_stage_with(s, NULL, noisy);
}

static void close_stage(struct stage *s)
{
    bead_backdrop_free(s->canvas, &s->backdrop);
    bead_canvas_destroy(s->canvas);
    bead_frame_free(&s->background);
    bead_frame_free(&s->frame);
}

static void draw(struct stage *s, struct bead_rect rect, const struct bead_ball *balls, size_t ball_count,
                 const struct bead_mark *marks, size_t mark_count)
{
    struct bead_message msg = {""};
    require(bead_paint_begin(s->canvas, &s->backdrop, rect, &msg), &msg);
    bead_paint_balls(s->canvas, balls, ball_count);
    bead_paint_marks(s->canvas, marks, mark_count);
    require(bead_canvas_read(s->canvas, rect, &s->frame, rect.x, rect.y, &msg), &msg);
}

static const uint8_t *pixel(const struct bead_frame *frame, int x, int y)
{
    return frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x;
}

static void test_pixels_come_back(void **state)
{
    (void)state;
    struct stage s;
    open_stage(&s, true);
    draw(&s, whole, NULL, 0, NULL, 0);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++)
            assert_memory_equal(pixel(&s.frame, x, y), pixel(&s.background, x, y), 3);
    }
    close_stage(&s);
}

static void test_a_part_of_the_frame_only(void **state)
{
    (void)state;
    struct stage s;
    struct bead_message msg = {""};
    open_stage(&s, true);
    struct bead_rect part = {20, 10, 30, 40};
    require(bead_paint_begin(s.canvas, &s.backdrop, whole, &msg), &msg);
    require(bead_canvas_read(s.canvas, part, &s.frame, 5, 7, &msg), &msg);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            bool inside = x >= 5 && x < 35 && y >= 7 && y < 47;
            static const uint8_t nothing[3] = {0};
            assert_memory_equal(pixel(&s.frame, x, y), inside ? pixel(&s.background, x + 15, y + 3) : nothing, 3);
        }
    }
    assert_int_equal(bead_canvas_read(s.canvas, part, &s.frame, WIDTH - 10, 0, &msg), BEAD_ERROR_GRAPHICS);
    assert_int_equal(bead_canvas_read(s.canvas, (struct bead_rect){-1, 0, 5, 5}, &s.frame, 0, 0, &msg), BEAD_ERROR_GRAPHICS);
    close_stage(&s);
}

/* Coverage of a ring as wide as its radius: a flat white disc. */
static void measure_disc(struct stage *s, double x, double y, double r, double *area, double *cx, double *cy)
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
static void measure_ball(struct stage *white, struct stage *black, const struct bead_ball *ball, double *area, double *cx,
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
    (void)state;
    struct stage white, black;
    struct bead_message msg = {""};
    open_stage(&black, false);
    open_stage(&white, false);
    memset(white.background.pixels, 255, white.background.stride * HEIGHT);
    require(bead_backdrop_set(white.canvas, &white.backdrop, &white.background, whole, &msg), &msg);
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
            .box = {x - 8, 30.25f, x + 8, 70}, .shape = {5, 1.5f, 3, 4}, .kind = (float)(i % 6), .rgba = {250, 200, 60, 200}};
    }
    return 9;
}

/* The same bits whether drawn at once, in stripes, or again over what was there. */
static void test_parts_are_as_the_whole(void **state)
{
    (void)state;
    struct stage s;
    struct bead_ball balls[9];
    struct bead_mark marks[9];
    struct bead_frame once;
    struct bead_message msg = {""};
    size_t count = make_balls(balls, marks);
    open_stage(&s, true);
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

/* All back ends are open at once, and take turns. */
static void test_back_ends_draw_the_same_pixels(void **state)
{
    (void)state;
    enum { MOST = 4 };
    struct stage stages[MOST];
    struct bead_ball balls[9];
    struct bead_mark marks[9];
    uint64_t first[2] = {0, 0};
    size_t count = make_balls(balls, marks), backends = 0;
    for (const struct bead_canvas_backend *b; (b = bead_canvas_backend_info(backends)); backends++) {
        assert_true(backends < MOST);
        open_stage_with(&stages[backends], b->name, true);
        assert_non_null(strstr(bead_canvas_describe(stages[backends].canvas), b->name));
    }
    assert_true(backends >= 2);
    for (int turn = 0; turn < 2; turn++) {
        for (size_t i = 0; i < backends; i++) {
            draw(&stages[i], whole, balls, turn ? count : count - 1, marks, count);
            uint64_t hash = bead_frame_hash(&stages[i].frame);
            first[turn] = i == 0 ? hash : first[turn];
            assert_true(hash == first[turn]);
        }
    }
    assert_true(first[0] != first[1]);
    for (size_t i = 0; i < backends; i++)
        close_stage(&stages[i]);
}

static void test_failures_are_told(void **state)
{
    (void)state;
    struct bead_canvas *canvas = (struct bead_canvas *)state;
    struct bead_message msg = {""};
    assert_int_equal(bead_canvas_create("etch-a-sketch", 10, 10, &canvas, &msg), BEAD_ERROR_USAGE);
    assert_null(canvas);
    assert_non_null(strstr(msg.text, "osmesa"));
    assert_int_equal(bead_canvas_create(NULL, 0, 10, &canvas, &msg), BEAD_ERROR_GRAPHICS);
    assert_int_equal(bead_canvas_create(NULL, 1000000, 10, &canvas, &msg), BEAD_ERROR_GRAPHICS);
    assert_null(canvas);
    assert_non_null(strstr(msg.text, "too large"));
    bead_canvas_destroy(NULL);
}

/* Without its shaders a canvas can be made, but drawing says what is missing. */
static void test_missing_shaders(void **state)
{
    (void)state;
    struct bead_canvas *canvas;
    struct bead_message msg = {""};
    struct bead_frame frame;
    struct bead_backdrop backdrop = {0, 0};
    char directory[256], *before = getenv("BEADREEL_ASSETS");
    char *kept = before ? strdup(before) : NULL;
    snprintf(directory, sizeof directory, "%s/beadreel-XXXXXX", getenv("TMPDIR") ? getenv("TMPDIR") : "/tmp");
    assert_non_null(mkdtemp(directory));
    require(bead_canvas_create("osmesa", 8, 8, &canvas, &msg), &msg);
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
    enum bead_error err = bead_backdrop_set(canvas, &backdrop, &frame, (struct bead_rect){0, 0, 8, 8}, &msg);
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
    (void)state;
    struct stage s;
    open_stage(&s, false);
    assert_non_null(strstr(bead_canvas_describe(s.canvas), "osmesa"));
    assert_non_null(strstr(bead_canvas_describe(s.canvas), "OpenGL"));
    assert_string_equal(bead_canvas_backend_info(0)->name, "osmesa");
    close_stage(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pixels_come_back),
        cmocka_unit_test(test_a_part_of_the_frame_only),
        cmocka_unit_test(test_area_and_place_of_balls),
        cmocka_unit_test(test_parts_are_as_the_whole),
        cmocka_unit_test(test_back_ends_draw_the_same_pixels),
        cmocka_unit_test(test_failures_are_told),
        cmocka_unit_test(test_missing_shaders),
        cmocka_unit_test(test_says_what_it_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
