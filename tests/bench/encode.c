/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Time of encoding synthetic frames of a bead movie: beads that move, a growing space-time image, a large still part.
 *   encode [BUILD [extension [quality]]]     files are made in a temporary directory and removed, unless KEEP=DIR is set */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "beadreel/movie.h"
#include "render/encode/movie_internal.h"

enum { WIDTH = 1920, HEIGHT = 1080, FRAMES = 60, BEADS = 64 };
enum { BEAD_TOP = 120, BEAD_HEIGHT = 40, IMAGE_TOP = 400, IMAGE_HEIGHT = 600, LEFT = 80, RIGHT = WIDTH - 80 };

static const char *const qualities[] = {"draft", "standard", "high", "lossless"};

static void put(struct bead_frame *frame, int x, int y, double r, double g, double b)
{
    uint8_t *p = frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x;
    p[0] = (uint8_t)(255 * b);
    p[1] = (uint8_t)(255 * g);
    p[2] = (uint8_t)(255 * r);
}

static double pulse(double bead, double frame)
{
    double d = bead - frame * (BEADS - 8.0) / FRAMES - 4;
    return exp(-d * d / 6) + 0.3 * exp(-(d + 9) * (d + 9) / 20);
}

static void draw_still(struct bead_frame *frame)
{
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            int line = y == IMAGE_TOP - 1 || x == LEFT - 1 || (y % 60 == 0 && x < LEFT && x > LEFT - 12);
            put(frame, x, y, line ? 0.1 : 0.98, line ? 0.1 : 0.98, line ? 0.1 : 0.97);
        }
    }
}

static void draw_beads(struct bead_frame *frame, int index)
{
    double pitch = (RIGHT - LEFT) / (double)BEADS;
    for (int y = BEAD_TOP; y < BEAD_TOP + BEAD_HEIGHT; y++) {
        for (int x = LEFT; x < RIGHT; x++) {
            double at = (x - LEFT - 6 * pulse((x - LEFT) / pitch, index)) / pitch, bead = floor(at);
            double dx = (at - bead - 0.5) * pitch, dy = y - BEAD_TOP - BEAD_HEIGHT / 2.0,
                   r = sqrt(dx * dx + dy * dy) / (pitch / 2.1);
            double cover = r < 0.95 ? 1 : r > 1.05 ? 0 : (1.05 - r) * 10, c = fmin(1, pulse(bead, index));
            double light = 0.55 + 0.45 * sqrt(fmax(0, 1 - r * r));
            put(frame, x, y, 0.98 - cover * (0.98 - light * (0.27 + 0.7 * c)), 0.98 - cover * (0.98 - light * (0.1 + 0.8 * c)),
                0.97 - cover * (0.97 - light * (0.4 + 0.1 * sin(3 * c))));
        }
    }
}

static int image_row(int index)
{
    return IMAGE_TOP + index * IMAGE_HEIGHT / FRAMES;
}

static void draw_image(struct bead_frame *frame, int index)
{
    for (int y = image_row(index); y < image_row(index + 1); y++) {
        for (int x = LEFT; x < RIGHT; x++) {
            double when = (y - IMAGE_TOP) * (double)FRAMES / IMAGE_HEIGHT,
                   c = fmin(1, pulse((x - LEFT) * BEADS / (double)(RIGHT - LEFT), when));
            put(frame, x, y, 0.27 + 0.7 * c, 0.01 + 0.9 * c, 0.33 + 0.2 * sin(3 * c));
        }
    }
}

static double cpu(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static enum bead_error encode(const char *path, enum bead_quality quality, double *milliseconds, uint64_t *bytes,
                              struct bead_message *msg)
{
    struct bead_movie_settings settings = {
        .size = sizeof settings, .width = WIDTH, .height = HEIGHT, .fps = 60, .quality = quality};
    struct bead_movie *movie;
    struct bead_frame frame;
    enum bead_error err = bead_frame_create(WIDTH, HEIGHT, &frame, msg);
    if (err)
        return err;
    *milliseconds = 0;
    err = bead_movie_open(path, &settings, &movie, msg);
    if (!err)
        draw_still(&frame);
    for (int i = 0; !err && i < FRAMES; i++) {
        struct bead_changes changes = {
            2, {{LEFT, BEAD_TOP, RIGHT - LEFT, BEAD_HEIGHT}, {LEFT, image_row(i), RIGHT - LEFT, image_row(i + 1) - image_row(i)}}};
        draw_beads(&frame, i);
        draw_image(&frame, i);
        double start = cpu();
        err = bead_movie_add(movie, &frame, &changes, msg);
        *milliseconds += cpu() - start;
    }
    double start = cpu();
    if (!err)
        err = bead_movie_close(movie, bytes, msg);
    else
        bead_movie_abort(movie);
    *milliseconds += cpu() - start;
    bead_frame_free(&frame);
    return err;
}

int main(int argc, char **argv)
{
    const char *keep = getenv("KEEP");
    char directory[64] = "/tmp/encode-XXXXXX";
    if (!keep && !mkdtemp(directory))
        return 1;
    printf("%d frames of %d x %d\n%-6s %-9s %9s %9s\n", FRAMES, WIDTH, HEIGHT, "codec", "quality", "ms/frame", "kB/frame");
    int status = 0;
    const struct bead_codec_info *info;
    for (size_t i = 0; (info = bead_movie_codec(i)); i++) {
        for (int q = 0; q < 4; q++) {
            if ((argc > 2 && strcmp(argv[2], info->extension) != 0) || (argc > 3 && strcmp(argv[3], qualities[q]) != 0))
                continue;
            char path[256];
            snprintf(path, sizeof path, "%s/%s.%s", keep ? keep : directory, qualities[q], info->extension);
            struct bead_message msg;
            double milliseconds;
            uint64_t bytes;
            if (encode(path, (enum bead_quality)q, &milliseconds, &bytes, &msg)) {
                fprintf(stderr, "%s\n", msg.text);
                status = 1;
                continue;
            }
            printf("%-6s %-9s %9.2f %9.2f\n", info->extension, qualities[q], milliseconds / FRAMES, (double)bytes / 1e3 / FRAMES);
            fflush(stdout);
            if (!keep)
                unlink(path);
        }
    }
    if (!keep)
        rmdir(directory);
    return status;
}
