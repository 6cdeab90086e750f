/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transparent pictures and movies: read back in every format and laid over a background, they look like opaque ones. */
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "beadreel/movie.h"
#include "render/draw/axis.h"
#include "render/draw/looks.h"
#include "tests/decode.h"
#include "tests/pictures.h"

enum { WIDTH = 96, HEIGHT = 64 };

/* ---- formats ---- */

/* A picture that fades in from left to right, colours from top to bottom; a disc, wholly transparent, moves on. */
static void paint(struct bead_frame *frame, int index, uint8_t (*straight)[4])
{
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        int x = i % WIDTH, y = i / WIDTH, dx = x - 20 - 5 * index, dy = y - 32;
        int alpha = dx * dx + dy * dy < 150 ? 0 : x < 8 ? 0 : x > WIDTH - 8 ? 255 : 255 * (x - 8) / (WIDTH - 16);
        const int rgb[3] = {200, 40 + 3 * y, 230 - 3 * y};
        uint8_t *p = frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x;
        for (int c = 0; c < 3; c++) {
            p[2 - c] = (uint8_t)((rgb[c] * alpha + 127) / 255);
            straight[i][c] = (uint8_t)rgb[c];
        }
        p[3] = straight[i][3] = (uint8_t)alpha;
    }
}

static void write_frames(const char *path, enum bead_quality quality, int count, uint8_t (*straight)[WIDTH * HEIGHT][4])
{
    struct bead_movie_settings wanted = {
        .size = sizeof wanted, .width = WIDTH, .height = HEIGHT, .fps = 25, .quality = quality, .alpha = true};
    struct bead_frame frame;
    struct bead_movie *movie;
    struct bead_message msg = {""};
    assert_int_equal(bead_frame_create(WIDTH, HEIGHT, &frame, &msg), BEAD_OK);
    frame.alpha = true;
    if (bead_movie_open(path, &wanted, &movie, &msg))
        fail_msg("%s", msg.text);
    for (int i = 0; i < count; i++) {
        paint(&frame, i, straight[i]);
        assert_int_equal(bead_movie_add(movie, &frame, NULL, &msg), BEAD_OK);
    }
    if (bead_movie_close(movie, NULL, &msg))
        fail_msg("%s", msg.text);
    bead_frame_free(&frame);
}

static int sample(const AVFrame *frame, int plane, int x, int y, int bytes)
{
    const uint8_t *at = frame->data[plane] + (ptrdiff_t)y * frame->linesize[plane] + (ptrdiff_t)bytes * x;
    return bytes == 2 ? at[0] | at[1] << 8 : at[0];
}

/* Red, green, blue, alpha, 0..255. */
static void read_pixel(const AVFrame *frame, int x, int y, double rgba[4])
{
    if (frame->format == AV_PIX_FMT_RGBA) {
        for (int c = 0; c < 4; c++)
            rgba[c] = frame->data[0][(ptrdiff_t)y * frame->linesize[0] + 4 * x + c];
        return;
    }
    bool deep = frame->format == AV_PIX_FMT_YUVA444P12; /* as ProRes 4444 is decoded */
    assert_true(deep || frame->format == AV_PIX_FMT_YUVA420P);
    int bytes = deep ? 2 : 1, half = deep ? 1 : 2;
    double unit = deep ? 16 : 1, luma = (sample(frame, 0, x, y, bytes) / unit - 16) * 255 / 219;
    double u = (sample(frame, 1, x / half, y / half, bytes) / unit - 128) * 255 / 224,
           v = (sample(frame, 2, x / half, y / half, bytes) / unit - 128) * 255 / 224;
    rgba[0] = luma + 1.5748 * v;
    rgba[1] = luma - 0.1873 * u - 0.4681 * v;
    rgba[2] = luma + 1.8556 * u;
    rgba[3] = sample(frame, 3, x, y, bytes) / (deep ? 4095.0 / 255 : 1);
}

static const struct clear_format {
    const char *name;
    enum bead_quality quality;
    const char *codec;
    double alpha, colour; /* mean differences allowed; colours count as much as they cover */
} formats[] = {{"a.apng", BEAD_QUALITY_STANDARD, "apng", 0, 0.33}, {"a.mov", BEAD_QUALITY_LOSSLESS, "png", 0, 0.33},
               {"a.mov", BEAD_QUALITY_DRAFT, "prores", 0.02, 0.7}, {"a.mov", BEAD_QUALITY_STANDARD, "prores", 0.02, 0.5},
               {"a.mov", BEAD_QUALITY_HIGH, "prores", 0.02, 0.4},  {"a.webm", BEAD_QUALITY_DRAFT, "vp9", 0.8, 2},
               {"a.webm", BEAD_QUALITY_STANDARD, "vp9", 0.4, 1.7}, {"a.webm", BEAD_QUALITY_HIGH, "vp9", 0.25, 1.7}};

static void alpha_is_read_back(void **state)
{
    (void)state;
    enum { COUNT = 6 };
    static uint8_t straight[COUNT][WIDTH * HEIGHT][4];
    for (size_t f = 0; f < sizeof formats / sizeof formats[0]; f++) {
        char path[256];
        struct decoded movie;
        in_directory(formats[f].name, path, sizeof path);
        write_frames(path, formats[f].quality, COUNT, straight);
        decode(path, &movie);
        remove(path);
        assert_string_equal(movie.codec, formats[f].codec);
        assert_int_equal(movie.count, COUNT);
        double alpha = 0, colour = 0, covered = 0;
        for (int i = 0; i < COUNT * WIDTH * HEIGHT; i++) {
            int place = i % (WIDTH * HEIGHT);
            const uint8_t *painted = straight[i / (WIDTH * HEIGHT)][place];
            double rgba[4];
            read_pixel(movie.frame[i / (WIDTH * HEIGHT)], place % WIDTH, place / WIDTH, rgba);
            alpha += fabs(rgba[3] - painted[3]);
            for (int c = 0; c < 3; c++)
                colour += painted[3] * fabs(rgba[c] - painted[c]) / 3;
            covered += painted[3];
        }
        if (!(alpha / (COUNT * WIDTH * HEIGHT) <= formats[f].alpha && colour / covered <= formats[f].colour))
            fail_msg("%s of quality %d: alpha differs by %g, colours by %g", formats[f].name, formats[f].quality,
                     alpha / (COUNT * WIDTH * HEIGHT), colour / covered);
        decoded_free(&movie);
    }
}

/* ---- pictures ---- */

struct rgba_file {
    png_image head;
    uint8_t *pixels;
};

static struct rgba_file read_rgba(const char *path)
{
    struct rgba_file file = {.head = {.version = PNG_IMAGE_VERSION}};
    assert_true(png_image_begin_read_from_file(&file.head, path));
    assert_int_equal(file.head.format & PNG_FORMAT_FLAG_ALPHA, strstr(path, "clear") ? PNG_FORMAT_FLAG_ALPHA : 0);
    file.head.format = PNG_FORMAT_RGBA;
    file.pixels = malloc(PNG_IMAGE_SIZE(file.head));
    assert_non_null(file.pixels);
    assert_true(png_image_finish_read(&file.head, NULL, file.pixels, 0, NULL));
    return file;
}

/* Anything painted over a colour is as in the opaque picture, over the colour of the page or of a panel; except glows, which add
 * light. */
static void compare(const char *what, const uint8_t *clear, const uint8_t *opaque, size_t count, const struct bead_look *look)
{
    const struct bead_rgb *grounds[2] = {&look->background, &look->panel};
    size_t empty = 0, full = 0, wrong = 0;
    for (size_t i = 0; i < count; i++) {
        double best = INFINITY;
        for (int g = 0; g < 2; g++) {
            const double ground[3] = {grounds[g]->r, grounds[g]->g, grounds[g]->b};
            double worst = 0, alpha = clear[4 * i + 3] / 255.0;
            for (size_t c = 0; c < 3; c++)
                worst = fmax(worst, fabs(alpha * clear[4 * i + c] + (1 - alpha) * 255 * ground[c] - opaque[4 * i + c]));
            best = fmin(best, worst);
        }
        wrong += best > 3;
        empty += clear[4 * i + 3] == 0;
        full += clear[4 * i + 3] == 255;
    }
    if (empty < count / 10 || full < count / 100 || wrong > count / 2000)
        fail_msg("%s: of %zu pixels %zu are transparent, %zu opaque, %zu of another colour", what, count, empty, full, wrong);
}

static void pictures_cover_what_they_show(void **state)
{
    (void)state;
    static const struct {
        const char *keys;
        bool dark;
    } cases[] = {{"views: [beads, profile, spacetime], at: 0.5 ms, size: [480, 320]", false},
                 {"views: [beads, profile, spacetime], at: 0.5 ms, size: [480, 320], style: movie", true},
                 {"size: [480, 320]", false}};
    static const char *const backgrounds[] = {"none", "theme"}, *const names[] = {"clear.png", "opaque.png"};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct rgba_file files[2];
        for (int k = 0; k < 2; k++) {
            char text[256], path[256];
            snprintf(text, sizeof text, "image: %s, background: %s, %s", names[k], backgrounds[k], cases[i].keys);
            struct built built = build_chain(text);
            draw_output(&built, pulse_down_the_chain);
            in_directory(names[k], path, sizeof path);
            files[k] = read_rgba(path);
            remove(path);
            release_chain(&built);
        }
        struct bead_look look;
        bead_look_screen(&look, 480, 320, cases[i].dark);
        compare(cases[i].keys, files[0].pixels, files[1].pixels, 480 * 320, &look);
        free(files[0].pixels);
        free(files[1].pixels);
    }
}

static void take_rgba(const AVFrame *frame, uint8_t *rgba)
{
    for (int i = 0; i < 480 * 270; i++) {
        int rgb[3] = {0};
        if (frame->format == AV_PIX_FMT_RGBA) {
            memcpy(rgba + 4 * i, frame->data[0] + (ptrdiff_t)(i / 480) * frame->linesize[0] + (ptrdiff_t)4 * (i % 480), 4);
            continue;
        }
        decoded_rgb(frame, i % 480, i / 480, rgb);
        for (int c = 0; c < 3; c++)
            rgba[4 * i + c] = (uint8_t)rgb[c];
    }
}

/* Stages: test_stage. */
static void films_cover_what_they_show(void **state)
{
    (void)state;
    static uint8_t pixels[2][480 * 270 * 4];
    static const char *const themes[] = {"light", "dark"}, *const backgrounds[] = {"none", "theme"};
    for (int dark = 0; dark < 2; dark++) {
        struct decoded films[2];
        for (int k = 0; k < 2; k++) {
            char text[400], path[256];
            snprintf(text, sizeof text,
                     "movie: a.apng, views: [beads, profile, spacetime], background: %s, theme: %s, size: [480, 270], fps: 10, "
                     "duration: 1 s, card: 0.2 s, captions: [{at: 0.2 ms, text: A caption}]",
                     backgrounds[k], themes[dark]);
            struct built built = build_chain(text);
            draw_output(&built, pulse_down_the_chain);
            in_directory("a.apng", path, sizeof path);
            decode(path, &films[k]);
            remove(path);
            release_chain(&built);
        }
        struct bead_look look;
        bead_look_film(&look, 480, 270, dark, false);
        assert_int_equal(films[0].count, films[1].count);
        for (size_t f = 2; f < films[0].count; f += 3) {
            for (int k = 0; k < 2; k++)
                take_rgba(films[k].frame[f], pixels[k]);
            compare(themes[dark], pixels[0], pixels[1], 480 * 270, &look);
        }
        decoded_free(&films[0]);
        decoded_free(&films[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(alpha_is_read_back),
        cmocka_unit_test(pictures_cover_what_they_show),
        cmocka_unit_test(films_cover_what_they_show),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
