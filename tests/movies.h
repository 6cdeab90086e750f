/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the tests of movies: a temporary directory, frames, and the available formats. */
#ifndef BEADREEL_TESTS_MOVIES_H
#define BEADREEL_TESTS_MOVIES_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "beadreel/movie.h"
#include "render/encode/movie_internal.h"
#include "sim/base/file.h"

enum { WIDTH = 98, HEIGHT = 66, FPS = 50 };

static char directory[] = "/tmp/beadreel-movie-XXXXXX";

static inline const char *place(const char *name)
{
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    return path;
}

static inline struct bead_movie_settings settings(enum bead_quality quality)
{
    return (struct bead_movie_settings){
        .size = sizeof(struct bead_movie_settings), .width = WIDTH, .height = HEIGHT, .fps = FPS, .quality = quality};
}

static inline void put(struct bead_frame *frame, int x, int y, int r, int g, int b)
{
    uint8_t *p = frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x;
    p[0] = (uint8_t)b;
    p[1] = (uint8_t)g;
    p[2] = (uint8_t)r;
}

/* A ramp that stays and a disc that has moved on by frame `index`; 25 colours, so that every format is exact or nearly. */
static inline struct bead_rect draw(struct bead_frame *frame, int index)
{
    struct bead_rect disc = {0, 20, frame->width, 30};
    for (int y = index ? disc.y : 0; y < (index ? disc.y + disc.height : frame->height); y++) {
        for (int x = 0; x < frame->width; x++) {
            int dx = x - 10 - 4 * index, dy = y - 35, ramp = 60 + x / 8 * 10;
            if (dx * dx + dy * dy < 100)
                put(frame, x, y, 20 * (index % 8), 160, 255 - 20 * (index % 8));
            else
                put(frame, x, y, ramp, ramp, ramp - 10);
        }
    }
    return disc;
}

/* Add `count` frames; those whose bit is set in `still` do not change. Returns pictures encoded. */
static inline uint64_t write_movie(const char *path, const struct bead_movie_settings *wanted, int count, uint64_t still)
{
    struct bead_movie *movie;
    struct bead_frame frame;
    struct bead_message msg = {""};
    assert_int_equal(bead_frame_create(wanted->width, wanted->height, &frame, NULL), BEAD_OK);
    if (bead_movie_open(path, wanted, &movie, &msg))
        fail_msg("%s", msg.text);
    for (int i = 0; i < count; i++) {
        struct bead_changes changes = {.count = 0};
        if (!(still >> i & 1))
            changes = (struct bead_changes){1, {draw(&frame, i)}};
        assert_int_equal(bead_movie_add(movie, &frame, &changes, &msg), BEAD_OK);
    }
    uint64_t encoded = bead_movie_encoded(movie), bytes = 0;
    assert_int_equal(bead_movie_frames(movie), count);
    if (bead_movie_close(movie, &bytes, &msg))
        fail_msg("%s", msg.text);
    assert_int_equal(bytes, bead_file_bytes(path));
    assert_true(bytes > 0);
    bead_frame_free(&frame);
    return encoded;
}

static inline bool left_behind(const char *path)
{
    char part[160];
    snprintf(part, sizeof part, "%s.part", path);
    return access(path, F_OK) == 0 || access(part, F_OK) == 0;
}

struct expected {
    const char *name;
    enum bead_quality quality;
    const char *codec;
    double psnr; /* dB, at least; 0: exact */
};

static const struct expected all[] = {
    {"draft.mp4", BEAD_QUALITY_DRAFT, "h264", 33},       {"standard.mp4", BEAD_QUALITY_STANDARD, "h264", 35},
    {"high.mp4", BEAD_QUALITY_HIGH, "h264", 40},         {"lossless.mp4", BEAD_QUALITY_LOSSLESS, "h264", 0},
    {"standard.mkv", BEAD_QUALITY_STANDARD, "h264", 35}, {"lossless.mkv", BEAD_QUALITY_LOSSLESS, "ffv1", 0},
    {"draft.webm", BEAD_QUALITY_DRAFT, "vp9", 33},       {"standard.webm", BEAD_QUALITY_STANDARD, "vp9", 35},
    {"high.webm", BEAD_QUALITY_HIGH, "vp9", 38},         {"lossless.webm", BEAD_QUALITY_LOSSLESS, "vp9", 0},
    {"standard.gif", BEAD_QUALITY_STANDARD, "gif", 0},   {"standard.apng", BEAD_QUALITY_STANDARD, "apng", 0},
    {"draft.png", BEAD_QUALITY_DRAFT, "apng", 0},        {"lossless.PNG", BEAD_QUALITY_LOSSLESS, "apng", 0},
    {"lossless.mov", BEAD_QUALITY_LOSSLESS, "png", 0},   {"draft.avif", BEAD_QUALITY_DRAFT, "av1", 33},
    {"standard.avif", BEAD_QUALITY_STANDARD, "av1", 35}, {"lossless.avif", BEAD_QUALITY_LOSSLESS, "av1", 0},
    {"av1.mp4", BEAD_QUALITY_STANDARD, "av1", 35},       {"av1-high.webm", BEAD_QUALITY_HIGH, "av1", 40},
    {"av1.mkv", BEAD_QUALITY_LOSSLESS, "av1", 0},
};
enum { ALL = sizeof all / sizeof *all };

static inline struct bead_movie_settings settings_of(const struct expected *expected)
{
    struct bead_movie_settings wanted = settings(expected->quality);
    wanted.codec = strncmp(expected->name, "av1", 3) == 0 ? BEAD_CODEC_AV1 : BEAD_CODEC_AUTO;
    return wanted;
}

static inline int make_directory(void **state)
{
    (void)state;
    return mkdtemp(directory) ? 0 : -1;
}

static inline int remove_directory(void **state)
{
    (void)state;
    return rmdir(directory); /* fails where a test left anything behind */
}

#endif
