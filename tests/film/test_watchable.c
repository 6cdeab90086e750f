/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Movies can be watched: nothing large flashes or flickers, and text is sharp after encoding. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "decode.h"
#include "scratch.h"
#include "sessions.h"

enum { FPS = 20, WIDTH = 640, HEIGHT = 360, SMALL = 2, TILES = 6, MOST_FRAMES = DECODED_MOST, MORE = 3 };

/* An output of a ready scene as a movie of another name and quality, so many times smaller, with up to MORE other settings; names
 * that begin with a dot are keys of this output. */
static void film_of(const char *scene, int output, int smaller, const char *name, const char *quality, const char *const more[MORE],
                    struct decoded *movie)
{
    char set[4 + MORE][64], file[400];
    size_t count = 4;
    snprintf(set[0], sizeof set[0], "outputs.%d.movie=%s", output, name);
    snprintf(set[1], sizeof set[1], "outputs.%d.size=[%d, %d]", output, WIDTH / smaller, HEIGHT / smaller);
    snprintf(set[2], sizeof set[2], "outputs.%d.fps=%d", output, FPS);
    snprintf(set[3], sizeof set[3], "outputs.%d.quality=%s", output, quality);
    for (int i = 0; i < MORE && more[i]; i++, count++) {
        if (*more[i] == '.')
            snprintf(set[count], sizeof *set, "outputs.%d%s", output, more[i]);
        else
            snprintf(set[count], sizeof *set, "%s", more[i]);
    }
    const char *settings[4 + MORE], *only[] = {name};
    for (size_t i = 0; i < count; i++)
        settings[i] = set[i];
    play_counts((struct bead_job){
        .input = scene, .output = directory, .settings = settings, .setting_count = count, .only = only, .only_count = 1});
    snprintf(file, sizeof file, "%s/%s", directory, name);
    decode(file, movie);
}

/* The first output. */
static void film(const char *scene, const char *name, const char *quality, const char *const more[MORE], struct decoded *movie)
{
    film_of(scene, 0, 1, name, quality, more, movie);
}

/* Titles of low plots are broken into lines: they reach further than those of high ones, but not out of the frame. */
static void titles_stay_in_the_frame(void **state)
{
    (void)state;
    static struct decoded movie;
    char scene[512];
    write_scene("chains:\n"
                "  - {name: A, beads: [{bead: large-steel, count: 5}], wall: brass}\n"
                "  - {name: B, beads: [{bead: aluminium, count: 5}], wall: brass}\n"
                "outputs: [{movie: low.mov, follow: front, duration: 0.1 s}]\n",
                scene);
    film(scene, "low.mov", "lossless", (const char *const[MORE]){".size=[1280, 720]"}, &movie);
    assert_int_equal(movie.width, 1280);
    int corner[3], rgb[3];
    decoded_rgb(movie.frame[0], 0, 0, corner);
    for (int y = 0; y < movie.height; y++) {
        for (int x = 0; x < 4; x++) {
            decoded_rgb(movie.frame[0], x, y, rgb);
            assert_memory_equal(rgb, corner, sizeof rgb);
        }
    }
    decoded_free(&movie);
}

/* ---- flashes ---- */

static double linear(int level)
{
    double x = level / 255.0;
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

/* Mean relative luminance of each of TILES x TILES parts of the picture, and of all. */
static void find_luminance(const AVFrame *frame, const double table[256], double tile[TILES * TILES + 1])
{
    memset(tile, 0, (TILES * TILES + 1) * sizeof *tile);
    const int width = frame->width, height = frame->height;
    const double part = 1.0 / (width * height);
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            int rgb[3];
            decoded_rgb(frame, x, y, rgb);
            double light = 0.2126 * table[rgb[0]] + 0.7152 * table[rgb[1]] + 0.0722 * table[rgb[2]];
            tile[y * TILES / height * TILES + x * TILES / width] += light * TILES * TILES * part;
            tile[TILES * TILES] += light * part;
        }
    }
}

/* How often the luminance reverses after a change of at least `least`, within one second at most. */
static size_t most_turns(const double *light, const double *time, size_t count, double least)
{
    double turn[MOST_FRAMES], low = light[0], high = light[0]; /* since the last turn */
    size_t turns = 0, most = 0;
    int way = 0;
    for (size_t i = 1; i < count; i++) {
        low = fmin(low, light[i]);
        high = fmax(high, light[i]);
        int now = way <= 0 && light[i] >= low + least ? 1 : way >= 0 && light[i] <= high - least ? -1 : 0;
        if (now == 0)
            continue;
        turn[turns++] = time[i];
        way = now;
        low = high = light[i];
    }
    for (size_t i = 0; i < turns; i++) {
        size_t within = 0;
        for (size_t j = i; j < turns && turn[j] < turn[i] + 1; j++)
            within++;
        most = within > most ? within : most;
    }
    return most;
}

/* The ready films; those that are long are shown faster, or by halves at their own pace, which hides nothing that goes to and fro
 * slowly and makes the rest worse, and with fewer points. They are small: beads have more of a frame then. A wave along one chain
 * lights up a part of such a frame and leaves it within a second, which are two turns. */
static const struct ready_film {
    const char *scene;
    int output;
    const char *more[MORE];
    size_t turns;
} ready_films[] = {
    {"teaching", 0, {".duration=9 s"}, 1},
    {"clean-vs-delocalised", 0, {".duration=6 s"}, 1},
    {"collision", 1, {".duration=12 s"}, 2},
    {"fput", 0, {".duration=12 s", ".until=5000"}, 1},
    {"fput-kdv", 0, {".duration=12 s", "chains.1.points=256"}, 1},
    {"kdv", 0, {".duration=12 s", "chain.points=160"}, 1},
    {"shock", 0, {".duration=6 s", ".until=4", "chain.points=800"}, 1},
    {"zabusky-kruskal", 0, {".duration=6 s", ".until=2.4", "chain.points=160"}, 1},
    {"cradle", 0, {".duration=4 s", ".until=0.7"}, 1},
};
enum { READY_FILMS = sizeof ready_films / sizeof *ready_films };

/* A flash is a change by a tenth of the full range and back, of a thirty-sixth of the picture or more; three a second are allowed
 * by the guidelines for web content, and here there is one at most. Nor is there anything faint that goes to and fro. */
static void check_flashes(const struct ready_film *ready)
{
    struct decoded movie;
    double table[256], *light = calloc((TILES * TILES + 1) * MOST_FRAMES, sizeof *light);
    assert_non_null(light);
    for (int i = 0; i < 256; i++)
        table[i] = linear(i);
    film_of(ready->scene, ready->output, SMALL, "flash.mov", "lossless", ready->more, &movie);
    assert_true(movie.count > 60);
    for (size_t i = 0; i < movie.count; i++) {
        double tile[TILES * TILES + 1];
        find_luminance(movie.frame[i], table, tile);
        for (size_t k = 0; k <= TILES * TILES; k++)
            light[k * MOST_FRAMES + i] = tile[k];
    }
    size_t flashes = 0, faint = 0;
    for (size_t k = 0; k <= TILES * TILES; k++) {
        const double *one = light + k * MOST_FRAMES;
        const size_t strong = most_turns(one, movie.time, movie.count, 0.1), all = most_turns(one, movie.time, movie.count, 0.02);
        flashes = strong > flashes ? strong : flashes;
        faint = all > faint ? all : faint;
    }
    if (getenv("SHOW"))
        printf("%s: turns a second: %zu strong, %zu faint\n", ready->scene, flashes, faint);
    if (flashes > ready->turns)
        fail_msg("%s flashes", ready->scene);
    if (faint > 6)
        fail_msg("%s goes to and fro %zu times a second", ready->scene, faint);
    decoded_free(&movie);
    free(light);
}

static void turns_are_counted(void **state)
{
    (void)state;
    double light[100], time[100];
    for (int i = 0; i < 100; i++) {
        time[i] = i / 20.0;
        light[i] = 0.3 + 0.1 * sin(2 * 3.14159265 * 4 * time[i] + 0.3); /* 4 flashes a second */
    }
    assert_in_range(most_turns(light, time, 100, 0.1), 7, 9);
    assert_int_equal(most_turns(light, time, 100, 0.3), 0);
    for (int i = 0; i < 100; i++)
        light[i] = i < 50 ? 0.1 : 0.5; /* a cut */
    assert_int_equal(most_turns(light, time, 100, 0.1), 1);
    for (int i = 0; i < 100; i++)
        light[i] = 0.01 * i;
    assert_int_equal(most_turns(light, time, 100, 0.1), 1);
}

/* The films of a scene, by the words of its file. */
static size_t count_films(const char *path)
{
    char line[1000];
    size_t films = 0;
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        const char *film = strstr(line, "movie:"), *comment = strchr(line, '#');
        films += film && (!comment || film < comment);
    }
    fclose(file);
    return films;
}

static void every_film_is_checked(void **state)
{
    (void)state;
    struct bead_ready_scene *scenes = NULL;
    size_t count = 0, films = 0;
    char path[1000];
    assert_int_equal(bead_scene_ready(&scenes, &count, NULL), BEAD_OK);
    for (size_t i = 0; i < count; i++) {
        size_t here = 0;
        assert_int_equal(bead_scene_find(scenes[i].name, path, sizeof path, NULL), BEAD_OK);
        for (size_t k = 0; k < READY_FILMS; k++)
            here += strcmp(ready_films[k].scene, scenes[i].name) == 0;
        if (here != count_films(path))
            fail_msg("%s has %zu films, of which %zu are checked", scenes[i].name, count_films(path), here);
        films += here;
    }
    assert_int_equal(films, READY_FILMS);
    bead_scene_ready_free(scenes, count);
}

static void nothing_flashes(void **state)
{
    (void)state;
    for (size_t k = 0; k < READY_FILMS; k++)
        check_flashes(&ready_films[k]);
}

/* ---- text ---- */

/* Mean squared error of the luma within rows from..to, all frames of the movie: BT.709, 16 to 235. */
static double error_of(const struct decoded *coded, const struct decoded *exact, int from, int to, double *contrast)
{
    double sum = 0, darkest = 255, brightest = 0;
    size_t count = 0;
    for (size_t i = 0; i < coded->count; i += 4) {
        size_t same = (size_t)lround(coded->time[i] * FPS); /* drafts have fewer */
        assert_true(same < exact->count);
        for (int y = from; y < to; y++) {
            for (int x = 0; x < WIDTH; x++) {
                int rgb[3];
                decoded_rgb(exact->frame[same], x, y, rgb);
                double luma = 16 + 219 / 255.0 * (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]);
                double found = coded->frame[i]->data[0][(ptrdiff_t)y * coded->frame[i]->linesize[0] + x];
                sum += (luma - found) * (luma - found);
                darkest = fmin(darkest, luma);
                brightest = fmax(brightest, luma);
                count++;
            }
        }
    }
    *contrast = brightest - darkest;
    return sum / (double)count;
}

static void check_text(const char *what, const struct decoded *coded, const struct decoded *exact, int from, int to, double least)
{
    double contrast, error = error_of(coded, exact, from, to, &contrast), psnr = 10 * log10(219 * 219 / error);
    assert_true(contrast > 120); /* there is text */
    if (getenv("SHOW"))
        printf("%s: %.1f dB\n", what, psnr);
    if (psnr < least)
        fail_msg("%s: %.1f dB are less than %g", what, psnr, least);
}

/* Time and words at the top, the caption at the bottom, in 640 x 360, where letters are smallest. */
static void text_is_sharp(void **state)
{
    (void)state;
    static const struct {
        const char *name, *quality;
        double least; /* dB */
    } kinds[] = {
        {"draft.mp4", "draft", 33}, {"standard.mp4", "standard", 36}, {"high.mp4", "high", 40}, {"standard.webm", "standard", 36}};
    struct decoded exact;
    film("teaching", "exact.mov", "lossless", (const char *const[MORE]){".duration=1 s"}, &exact);
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
        struct decoded coded;
        film("teaching", kinds[k].name, kinds[k].quality, (const char *const[MORE]){".duration=1 s"}, &coded);
        assert_true(coded.count == exact.count || strcmp(kinds[k].quality, "draft") == 0);
        check_text(kinds[k].name, &coded, &exact, 5, 45, kinds[k].least);
        check_text(kinds[k].name, &coded, &exact, HEIGHT - 30, HEIGHT - 5, kinds[k].least);
        decoded_free(&coded);
    }
    decoded_free(&exact);
}

/* The bar has its pointed end from the first frame on: values beyond a given range are known before. */
static void the_bar_never_changes(void **state)
{
    (void)state;
    struct decoded movie;
    film("clean-vs-delocalised", "bar.mov", "lossless", (const char *const[MORE]){".duration=0.5 s"}, &movie);
    for (size_t i = 1; i < movie.count; i++) {
        for (int y = HEIGHT * 2 / 3; y < HEIGHT - 4; y++) { /* beside the images, above the line of progress */
            for (int x = WIDTH - 42; x < WIDTH; x++) {
                int before[3], now[3];
                decoded_rgb(movie.frame[i - 1], x, y, before);
                decoded_rgb(movie.frame[i], x, y, now);
                assert_memory_equal(before, now, sizeof now);
            }
        }
    }
    decoded_free(&movie);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turns_are_counted), cmocka_unit_test(every_film_is_checked),    cmocka_unit_test(nothing_flashes),
        cmocka_unit_test(text_is_sharp),     cmocka_unit_test(titles_stay_in_the_frame), cmocka_unit_test(the_bar_never_changes),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
