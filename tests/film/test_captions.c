/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The words of movies: captions at their times, title cards before the motion, posters. */
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

#include "render/draw/axis.h"
#include "render/draw/looks.h"
#include "render/draw/words.h"
#include "render/movie/film.h"
#include "render/movie/movie_words.h"
#include "tests/decode.h"
#include "tests/pictures.h"
#include "tests/sessions.h"

/* ---- times ---- */

/* 1000 times slower: 1 ms of the motion is 1 s of the film. */
static void captions_come_and_go(void **state)
{
    (void)state;
    struct bead_caption list[] = {{1e-3, NAN, NAN, 0, "until the next"},
                                  {3e-3, 4e-3, NAN, 0, "until its end"},
                                  {5e-3, NAN, 2, 0, "two seconds of the film"},
                                  {8e-3, 20e-3, NAN, 0, "longer than there is time"},
                                  {9e-3, NAN, NAN, 0, "the last"}};
    struct bead_movie_asked movie = {.captions = list, .caption_count = 5};
    const struct bead_film_clock slow = {.slowed = 1000};
    static const struct {
        double time;
        size_t caption;
    } expected[] = {
        {0, SIZE_MAX}, {0.999e-3, SIZE_MAX}, {1e-3, 0},          {2.9e-3, 0}, {3e-3, 1}, {3.9e-3, 1},  {4.1e-3, SIZE_MAX},
        {5e-3, 2},     {6.9e-3, 2},          {7.1e-3, SIZE_MAX}, {8.5e-3, 3}, {9e-3, 4}, {11.4e-3, 4}, {11.6e-3, SIZE_MAX}};
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
        if (bead_captions_find(&movie, &slow, expected[i].time) != expected[i].caption)
            fail_msg("at %g ms there is caption %zu, not %zu", 1e3 * expected[i].time,
                     bead_captions_find(&movie, &slow, expected[i].time), expected[i].caption);
    }
}

/* Nobody reads 90 characters in 2.5 s. */
static void long_captions_stay_longer(void **state)
{
    (void)state;
    char text[91];
    memset(text, 'x', 90);
    text[90] = '\0';
    struct bead_caption list[] = {{0, NAN, NAN, 0, text}};
    struct bead_movie_asked movie = {.captions = list, .caption_count = 1};
    const struct bead_film_clock slow = {.slowed = 1};
    assert_int_equal(bead_captions_find(&movie, &slow, 5.9), 0);
    assert_int_equal(bead_captions_find(&movie, &slow, 6.1), SIZE_MAX);
}

static void long_captions_take_two_lines(void **state)
{
    (void)state;
    struct bead_look look;
    bead_look_screen(&look, 1280, 720, true);
    struct bead_caption list[] = {
        {0, NAN, NAN, 0, "short"},
        {1, NAN, NAN, 0,
         "This one is a good deal longer, says more than anybody wants to know about a chain of beads "
         "and will not fit into one line of a picture that is as small as this"},
        {2, NAN, NAN, 0,
         "<b>What is bold is not broken, however much longer it may be than one line of a picture as small "
         "as this one has room for, and is cut where it ends, as with italics</b>"}};
    struct bead_movie_asked movie = {.captions = list, .caption_count = 1};
    assert_int_equal(bead_captions_lines(&movie, &look, 1280), 1);
    movie.caption_count = 2;
    assert_int_equal(bead_captions_lines(&movie, &look, 1280), 2);
    assert_int_equal(bead_captions_lines(&movie, &look, 4000), 1);
    movie.caption_count = 0;
    assert_int_equal(bead_captions_lines(&movie, &look, 1280), 0);
    movie = (struct bead_movie_asked){.captions = &list[2], .caption_count = 1};
    assert_int_equal(bead_captions_lines(&movie, &look, 1280), 1);
}

/* One line or two, they are in the middle of their strip, nowhere beyond it. */
static void captions_are_in_the_middle(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "Most move together now", "Most have moved together for so long that nobody who looks at them now can say which of all "
                                  "these beads was the first one to be struck, and which the last"};
    enum { WIDE = 1280, HIGH = 200 };
    struct bead_look look;
    bead_look_screen(&look, WIDE, 720, true);
    const struct bead_rect strip = {100, 60, 1080, (int)ceil(2 * bead_caption_height(&look))};
    double tall[2];
    for (size_t k = 0; k < 2; k++) {
        cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDE, HIGH);
        cairo_t *cr = cairo_create(surface);
        bead_caption_draw(cr, &look, texts[k], strip);
        cairo_surface_flush(surface);
        const uint8_t *pixels = cairo_image_surface_get_data(surface);
        int box[4] = {WIDE, HIGH, 0, 0};
        for (int y = 0; y < HIGH; y++)
            for (int x = 0; x < WIDE; x++) {
                if (pixels[y * cairo_image_surface_get_stride(surface) + 4 * x + 1] < 40)
                    continue;
                box[0] = x < box[0] ? x : box[0];
                box[1] = y < box[1] ? y : box[1];
                box[2] = x > box[2] ? x : box[2];
                box[3] = y > box[3] ? y : box[3];
            }
        const double across = 0.5 * (box[0] + box[2] + 1) - (strip.x + 0.5 * strip.width),
                     down = 0.5 * (box[1] + box[3] + 1) - (strip.y + 0.5 * strip.height);
        if (!(fabs(across) < 3 && fabs(down) < 0.2 * look.label && box[1] >= strip.y && box[3] < strip.y + strip.height))
            fail_msg("caption %zu is at %d, %d to %d, %d: off by %g, %g", k, box[0], box[1], box[2], box[3], across, down);
        tall[k] = box[3] - box[1];
        cairo_destroy(cr);
        cairo_surface_destroy(surface);
    }
    assert_true(tall[1] > 1.8 * tall[0]);
}

static void large_numbers_are_powers_of_ten(void **state)
{
    (void)state;
    static const struct {
        double number;
        const char *text;
    } cases[] = {{3571, "3\u2009600"},
                 {60, "60"},
                 {2.04, "2"},
                 {94999, "95\u2009000"},
                 {99999, "10\u2075"},
                 {1e9, "10\u2079"},
                 {2.46e6, "2.5\u00b710\u2076"},
                 {1e12, "10\u00b9\u00b2"},
                 {0.01, "0.01"},
                 {3e-5, "3\u00b710\u207b\u2075"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[64];
        bead_round_number(cases[i].number, text, sizeof text);
        assert_string_equal(text, cases[i].text);
    }
}

/* ---- movies ---- */

#define SMALL "views: [beads, profile], size: [320, 180], fps: 20, duration: 1 s"

static bool same_pixels(const AVFrame *frame, const uint8_t *rgb, int width, int height)
{
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            int one[3];
            decoded_rgb(frame, x, y, one);
            for (int c = 0; c < 3; c++) {
                if (one[c] != rgb[3 * ((size_t)y * (size_t)width + (size_t)x) + (size_t)c])
                    return false;
            }
        }
    }
    return true;
}

static void cards_come_first_and_take_their_time(void **state)
{
    (void)state;
    char path[256];
    struct decoded with, without;
    struct built plain = build_chain("movie: a.mkv, quality: lossless, " SMALL);
    struct built card = build_chain("movie: b.mkv, quality: lossless, card: 2 s, " SMALL);
    draw_output(&plain, pulse_down_the_chain);
    draw_output(&card, pulse_down_the_chain);
    in_directory("a.mkv", path, sizeof path);
    decode(path, &without);
    remove(path);
    in_directory("b.mkv", path, sizeof path);
    decode(path, &with);
    remove(path);
    assert_true(fabs(without.duration - 1) < 0.01 && fabs(with.duration - 3) < 0.01);
    /* The card is as many frames as it takes; what follows are the frames of the other movie, 2 s later. */
    const size_t frames = 40;
    assert_int_equal(with.count, without.count + frames);
    assert_true(fabs(with.time[frames - 1] - (double)(frames - 1) / 20) < 0.002);
    size_t bytes = (size_t)with.frame[0]->linesize[0];
    int corners[2][3]; /* on the same page */
    decoded_rgb(with.frame[0], 1, 1, corners[0]);
    decoded_rgb(without.frame[0], 1, 1, corners[1]);
    assert_memory_equal(corners[0], corners[1], sizeof corners[0]);
    assert_true(corners[0][0] + corners[0][1] + corners[0][2] > 0);
    assert_true(memcmp(with.frame[0]->data[0] + 20 * bytes, without.frame[0]->data[0] + 20 * bytes, 100 * bytes) != 0);
    for (size_t i = 0; i < without.count; i++) {
        assert_true(fabs(with.time[i + frames] - without.time[i] - 2) < 0.002);
        for (size_t y = 0; y < 180; y++)
            assert_memory_equal(with.frame[i + frames]->data[0] + y * bytes, without.frame[i]->data[0] + y * bytes, 320 * 4);
    }
    decoded_free(&with);
    decoded_free(&without);
    release_chain(&plain);
    release_chain(&card);
}

/* The poster is one of the movie's frames: the requested one, or one with something to see. */
static void posters_are_frames(void **state)
{
    (void)state;
    static const char *const wanted[] = {"poster-at: 0.5 ms, ", ""};
    const struct bead_poster nearest = bead_poster_choose(1, 0.1);
    assert_true(bead_poster_reached(&nearest, 0.951) && !bead_poster_reached(&nearest, 0.949));
    for (int k = 0; k < 2; k++) {
        char path[256], text[256];
        struct decoded movie;
        snprintf(text, sizeof text, "movie: a.mkv, quality: lossless, poster: p.png, %s" SMALL, wanted[k]);
        struct built built = build_chain(text);
        draw_output(&built, pulse_down_the_chain);
        in_directory("p.png", path, sizeof path);
        struct png_file poster = read_png(path);
        remove(path);
        in_directory("a.mkv", path, sizeof path);
        decode(path, &movie);
        remove(path);
        assert_true(poster.width == 320 && poster.height == 180);
        size_t found = SIZE_MAX;
        for (size_t i = 0; i < movie.count; i++)
            found = same_pixels(movie.frame[i], poster.rgb, 320, 180) ? i : found;
        assert_true(found != SIZE_MAX && found > 0);
        /* 1 ms in 20 frames: 0.5 ms is half way between frames 9 and 10. */
        assert_true(k == 1 || fabs(movie.time[found] * 20 - 9.5) <= 0.51);
        free(poster.rgb);
        decoded_free(&movie);
        release_chain(&built);
    }
}

/* The same movie, with its poster as the cover beside it. */
static void posters_are_covers(void **state)
{
    (void)state;
    struct decoded with, without;
    char path[256];
    struct built plain = build_chain("movie: a.mp4, " SMALL), poster = build_chain("movie: b.mp4, poster: b.png, " SMALL);
    draw_output(&plain, pulse_down_the_chain);
    draw_output(&poster, pulse_down_the_chain);
    in_directory("a.mp4", path, sizeof path);
    decode(path, &without);
    remove(path);
    in_directory("b.mp4", path, sizeof path);
    decode(path, &with);
    remove(path);
    size_t bytes;
    in_directory("b.png", path, sizeof path);
    free(read_all(path, &bytes));
    remove(path);
    assert_true(without.covers == 0 && with.covers == 1 && with.cover_bytes == bytes);
    assert_true(with.count == without.count && fabs(with.duration - without.duration) < 1e-9 && with.said == without.said);
    for (size_t i = 0; i < with.count; i++) {
        for (int y = 0; y < 180; y++)
            assert_memory_equal(with.frame[i]->data[0] + y * with.frame[i]->linesize[0],
                                without.frame[i]->data[0] + y * without.frame[i]->linesize[0], 320);
    }
    decoded_free(&with);
    decoded_free(&without);
    release_chain(&plain);
    release_chain(&poster);
}

/* A chapter for each caption, and one for the card before them; titles without marks. A subtitle as long as each is seen. */
static void captions_are_chapters(void **state)
{
    (void)state;
    static const char *const names[] = {"a.mp4", "a.mov", "a.mkv", "a.webm"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        char path[256], text[400];
        struct decoded movie;
        snprintf(text, sizeof text,
                 "movie: %s, card: 2 s, captions: [{at: 0 ms, text: A < B & C, until: 0.25 ms}, "
                 "{at: 0.5 ms, text: \"*F*_{max} is\\\\_here\", pause: 1 s}], " SMALL,
                 names[k]);
        struct built built = build_chain(text);
        draw_output(&built, pulse_down_the_chain);
        in_directory(names[k], path, sizeof path);
        decode(path, &movie);
        remove(path);
        assert_int_equal(movie.chapters, 3);
        assert_true(fabs(movie.chapter_start - 2.5) < 0.04);
        assert_string_equal(movie.chapter_title, "Fmax is_here");
        assert_int_equal(movie.count, 80); /* card, motion, pause at 20 frames a second */
        assert_int_equal(movie.subtitles, 2);
        assert_string_equal(movie.subtitle[0], "A < B & C");
        assert_string_equal(movie.subtitle[1], "Fmax is_here");
        const double spans[2][2] = {{2, 2.25}, {2.5, 4}};
        for (int i = 0; i < 4; i++)
            assert_true(fabs(movie.subtitle_span[i / 2][i % 2] - spans[i / 2][i % 2]) < 0.04);
        decoded_free(&movie);
        release_chain(&built);
    }
}

/* The pulse is known: 10 N at one of ten beads after the other. Films of other containers and with captions say the same, but not
 * in subtitles. */
static void words_are_subtitles(void **state)
{
    (void)state;
    static const char *const names[] = {"a.mp4", "a.mov", "a.mkv", "a.webm"}, *const captions[] = {
                                                                                  "", "captions: [{at: 0 ms, text: A}], "};
    char words[1000] = "";
    for (size_t k = 0; k < 2 * sizeof names / sizeof *names; k++) {
        char path[256], text[400];
        struct decoded movie;
        snprintf(text, sizeof text, "movie: %s, card: 2 s, subtitles: words, %s" SMALL, names[k / 2], captions[k % 2]);
        struct built built = build_chain(text);
        draw_output(&built, pulse_down_the_chain);
        in_directory(names[k / 2], path, sizeof path);
        decode(path, &movie);
        remove(path);
        if (k == 0)
            snprintf(words, sizeof words, "%s", movie.description);
        assert_true(strncmp(words, "In Ten one pulse of 10", 22) == 0 && words[22] != '.');
        assert_non_null(strstr(words, "N, 1 bead wide, crosses 10 beads"));
        assert_string_equal(movie.description, words);
        assert_int_equal(movie.subtitles, 1);
        assert_string_equal(movie.subtitle[0], k % 2 ? "A" : words);
        assert_true(movie.subtitle_span[0][0] == 2 && (k % 2 || fabs(movie.subtitle_span[0][1] - 3) < 0.04));
        decoded_free(&movie);
        release_chain(&built);
    }
}

/* Each of two chains is spoken of for half of the film. */
static void words_of_chains_follow_each_other(void **state)
{
    (void)state;
    static const char scene[] = "chains: [{name: A, striker: {bead: large-steel}, beads: [{bead: large-steel, count: 8}]},\n"
                                "         {name: B, striker: {bead: large-steel}, beads: [{bead: large-steel, count: 8}]}]\n"
                                "simulate: {until: 300 us}\n"
                                "outputs: [{movie: two.mkv, subtitles: words, card: 1 s, " SMALL "}]\n";
    char input[256], path[256], output[256];
    struct decoded movie;
    in_directory("two.yaml", input, sizeof input);
    in_directory("two.mkv", path, sizeof path);
    in_directory("", output, sizeof output);
    write_text(input, scene);
    play_counts((struct bead_job){.input = input, .output = output, .canvas = "plain"});
    decode(path, &movie);
    remove(path);
    remove(input);
    assert_int_equal(movie.subtitles, 2);
    for (int i = 0; i < 2; i++) {
        assert_non_null(strstr(movie.subtitle[i], i == 0 ? "In A" : "In B"));
        for (int end = 0; end < 2; end++)
            assert_true(fabs(movie.subtitle_span[i][end] - 1 - 0.5 * (i + end)) < 0.04);
    }
    decoded_free(&movie);
}

/* What has passed when the film begins is not in it. */
static void passed_captions_are_left_out(void **state)
{
    (void)state;
    char path[256];
    struct decoded movie;
    struct built built = build_chain("movie: a.mkv, from: 0.4 ms, captions: [{at: 0 ms, text: Passed}, {at: 0.2 ms, text: Still "
                                     "there}, {at: 0.7 ms, text: Later}], " SMALL);
    draw_output(&built, pulse_down_the_chain);
    in_directory("a.mkv", path, sizeof path);
    decode(path, &movie);
    remove(path);
    assert_int_equal(movie.chapters, 2);
    assert_int_equal(movie.subtitles, 2);
    assert_string_equal(movie.subtitle[0], "Still there");
    assert_true(movie.subtitle_span[0][0] == 0 && fabs(movie.subtitle_span[0][1] - 0.5) < 0.04);
    decoded_free(&movie);
    release_chain(&built);
}

/* At 20 frames a second, 1 ms takes 1 s. */
static void stops_are_frames(void **state)
{
    (void)state;
    char path[256];
    struct decoded movie;
    struct built built =
        build_chain("movie: a.mp4, stops: [0.3 ms, 0.6 ms], slides: talk.html, captions: [{at: 0.1 ms, text: Go}], " SMALL);
    draw_output(&built, pulse_down_the_chain);
    in_directory("a.mp4", path, sizeof path);
    decode(path, &movie);
    remove(path);
    assert_int_equal(movie.chapters, 4);
    in_directory("talk.html", path, sizeof path);
    size_t length;
    char *page = read_all(path, &length);
    remove(path);
    const char *list = strstr(page, "const stops = [");
    assert_non_null(list);
    double stop[2], half;
    assert_int_equal(
        sscanf(list, "const stops = [%lf, %lf], video = document.querySelector('video'), half = %lf;", &stop[0], &stop[1], &half),
        3);
    assert_true(fabs(half - 0.5 / 20) < 1e-9);
    const double motion[2] = {0.3e-3, 0.6e-3}, step = 1e-3 / (double)(movie.count - 1);
    for (int i = 0; i < 2; i++) {
        const size_t frame = (size_t)(stop[i] * 20);
        assert_true(fabs(stop[i] - ((double)frame + 0.5) / 20) < 1e-6); /* amid a frame */
        assert_true((double)frame * step >= motion[i] - 1e-9 && ((double)frame - 1) * step < motion[i]);
        assert_true(fabs(movie.time[frame] - (double)frame / 20) < 1e-3);
    }
    assert_non_null(strstr(page, "data:video/mp4;base64,AAAA")); /* the first box of an mp4 begins with its size */
    assert_null(strstr(page, "http"));
    free(page);
    decoded_free(&movie);
    release_chain(&built);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(passed_captions_are_left_out),
        cmocka_unit_test(captions_come_and_go),
        cmocka_unit_test(long_captions_stay_longer),
        cmocka_unit_test(long_captions_take_two_lines),
        cmocka_unit_test(captions_are_in_the_middle),
        cmocka_unit_test(large_numbers_are_powers_of_ten),
        cmocka_unit_test(cards_come_first_and_take_their_time),
        cmocka_unit_test(posters_are_frames),
        cmocka_unit_test(posters_are_covers),
        cmocka_unit_test(captions_are_chapters),
        cmocka_unit_test(words_are_subtitles),
        cmocka_unit_test(words_of_chains_follow_each_other),
        cmocka_unit_test(stops_are_frames),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
