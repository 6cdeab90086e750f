/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which frames of a movie are drawn: all of them, except in drafts. */
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
#include "render/movie/film.h"
#include "scratch.h"
#include "sessions.h"

static void pictures_are_counted(void **state)
{
    (void)state;
    for (size_t card = 0; card < 4; card++) {
        for (size_t group = 1; group < 6; group++) {
            for (size_t motion = 2; motion < 40; motion++) {
                const struct bead_movie_times times = {
                    .time = {1, 2}, .step = 1 / (double)(motion - 1), .card = card, .frames = card + motion, .group = group};
                size_t drawn = 0, longest = 0, last = 0;
                for (size_t i = 0; i < times.frames; i++) {
                    if (!bead_movie_draws(&times, i))
                        continue;
                    drawn++;
                    longest = i - last > longest ? i - last : longest;
                    last = i;
                }
                assert_true(bead_movie_draws(&times, 0) && bead_movie_draws(&times, card) && last == times.frames - 1);
                assert_int_equal(drawn, bead_movie_pictures(&times));
                assert_true(longest <= (group > 1 ? group : 1));
                assert_true(bead_movie_time(&times, card) == 1 && bead_movie_time(&times, last) == 2);
            }
        }
    }
}

/* The same film, with no impact between frames; animated PNG has the same pixels at all qualities. */
static void film(const char *quality, const char *fps, struct decoded *movie)
{
    char scene[512], text[600], path[512];
    snprintf(text, sizeof text,
             "chain: {beads: [{bead: large-steel, count: 9}], striker: {bead: large-steel, velocity: 0.4 m/s}}\n"
             "simulate: {until: 0.05 ms}\n"
             "outputs: [{movie: film.apng, size: [320, 180], quality: %s, fps: %s, duration: 0.5 s}]\n",
             quality, fps);
    write_scene(text, scene);
    play_counts((struct bead_job){.input = scene, .output = directory});
    snprintf(path, sizeof path, "%s/film.apng", directory);
    decode(path, movie);
}

static void assert_same(const AVFrame *a, const AVFrame *b)
{
    for (int y = 0; y < a->height; y++)
        assert_memory_equal(a->data[0] + (ptrdiff_t)y * a->linesize[0], b->data[0] + (ptrdiff_t)y * b->linesize[0],
                            3 * (size_t)a->width);
}

/* At 60 frames a second every second picture, and the last; at 30 all of them; the same pixels at the same times. */
static void drafts_show_pictures_for_longer(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double fps;
        size_t frames, drawn, group;
    } rates[] = {{"60", 60, 30, 16, 2}, {"30", 30, 15, 15, 1}, {"24", 24, 12, 12, 1}, {"75", 75, 38, 14, 3}};
    for (size_t r = 0; r < sizeof rates / sizeof rates[0]; r++) {
        static struct decoded all, draft;
        film("standard", rates[r].name, &all);
        film("draft", rates[r].name, &draft);
        assert_int_equal(all.count, rates[r].frames);
        assert_int_equal(draft.count, rates[r].drawn);
        for (size_t i = 0; i < draft.count; i++) {
            size_t frame = (size_t)(draft.time[i] * rates[r].fps + 0.5);
            assert_true(fabs(draft.time[i] - (double)frame / rates[r].fps) < 1e-3);
            assert_true(i == 0 || draft.time[i] - draft.time[i - 1] < ((double)rates[r].group + 0.5) / rates[r].fps);
            assert_same(draft.frame[i], all.frame[frame]);
        }
        assert_true(fabs(draft.duration - all.duration) < 1e-3);
        decoded_free(&all);
        decoded_free(&draft);
    }
}

/* The pictures in a GIF are as many as the plan says. */
static void plans_count_what_is_in_a_gif(void **state)
{
    (void)state;
    static const struct {
        int fps;
        size_t frames, kept;
    } gifs[] = {{25, 25, 25}, {40, 40, 40},   {50, 50, 50},   {51, 51, 26},
                {60, 60, 30}, {100, 100, 50}, {120, 120, 40}, {240, 240, 48}};
    for (size_t i = 0; i < sizeof gifs / sizeof gifs[0]; i++) {
        char scene[512], text[600], path[512], plan[4096] = "", said[160];
        static struct decoded movie;
        snprintf(text, sizeof text,
                 "chain: {beads: [{bead: large-steel, count: 9}]}\nsimulate: {until: 0.3 ms}\n"
                 "outputs: [{movie: film.gif, size: [160, 120], fps: %d, duration: 1 s}]\n",
                 gifs[i].fps);
        write_scene(text, scene);
        struct bead_session *session = play_session((struct bead_job){.input = scene, .output = directory});
        FILE *out = fmemopen(plan, sizeof plan, "w");
        assert_non_null(out);
        assert_int_equal(bead_session_plan(session, out, NULL), BEAD_OK);
        fclose(out);
        bead_session_close(session);
        snprintf(path, sizeof path, "%s/film.gif", directory);
        decode(path, &movie);
        assert_int_equal(movie.count, gifs[i].kept);
        decoded_free(&movie);
        if (gifs[i].kept < gifs[i].frames)
            snprintf(said, sizeof said, ": %zu frames (%zu of them in the file: gif has at most 50 a second) of", gifs[i].frames,
                     gifs[i].kept);
        else
            snprintf(said, sizeof said, ": %zu frames of", gifs[i].frames);
        if (!strstr(plan, said))
            fail_msg("%s: not in the plan: %s", said, plan);
    }
}

/* Prepares the film of a scene with its chain up to `end`; returns its scene and chain, to be freed. */
static struct bead_film prepared(const char *text, double end, struct bead_scene **scene, struct bead_chain **chain)
{
    struct bead_film film;
    struct bead_message msg = {""};
    if (bead_scene_parse("test", text, strlen(text), NULL, scene, &msg) || bead_chain_create(*scene, 0, chain, &msg))
        fail_msg("%s", msg.text);
    const struct bead_run_context context = {
        .scene = *scene, .chains = (const struct bead_chain *const *)chain, .chain_count = 1, .end = end, .resolution = 1e-6};
    if (bead_film_prepare(&(*scene)->outputs[0], &context, &film, &msg))
        fail_msg("%s", msg.text);
    return film;
}

/* A wave is in sight for two seconds: it passes at most eight beads, half of a stage, in one. Arrivals at the last contact are
 * those of runs. */
static void waves_stay_in_sight(void **state)
{
    (void)state;
    static const struct {
        const char *beads;
        double contacts, arrival; /* s */
    } chains[] = {{"[{cell: [large-steel, aluminium], count: 64}]", 128, 2.362e-3},
                  {"[{cell: [large-steel, aluminium], count: 64, spins: random, magnetism: 0, seed: 2009}]", 128, 2.621e-3}};
    for (size_t i = 0; i < sizeof chains / sizeof *chains; i++) {
        char text[300];
        struct bead_scene *scene;
        struct bead_chain *chain;
        snprintf(text, sizeof text,
                 "chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: %s}\noutputs: [{movie: film.mp4}]\n",
                 chains[i].beads);
        const struct bead_film film = prepared(text, 2.8e-3, &scene, &chain);
        double lasting = (double)film.times.frames / scene->outputs[0].movie.fps, pace = chains[i].contacts / chains[i].arrival;
        double beads = pace * 2.8e-3 / lasting;
        if (!(beads <= 8 && beads > 4))
            fail_msg("chain %zu: the wave passes %.1f beads in a second", i, beads);
        bead_chain_destroy(chain);
        bead_scene_free(scene);
    }
}

/* A strobe takes a sample in each of its periods, whatever the number of frames. */
static void strobes_have_their_own_samples(void **state)
{
    (void)state;
    struct bead_scene *scene;
    struct bead_chain *chain;
    const struct bead_film film =
        prepared("simulate: {until: 1000}\nchain: {equation: fput, points: 31, alpha: 0.25, start: {mode: 1, amplitude: 1}}\n"
                 "outputs: [{movie: film.mp4, views: [profile], strobe: 64, duration: 5 s}]\n",
                 1000, &scene, &chain);
    assert_true(film.times.grid.every == 64 && film.times.grid.start == 0 && film.times.grid.end >= 1000 - 64 &&
                !film.times.grid.widens);
    assert_int_equal(film.times.frames, 300);
    bead_chain_destroy(chain);
    bead_scene_free(scene);
}

/* Seconds between the samples of a film of these views with so many frames in its second, of beads with gaps of so many
 * micrometres. */
static double spacing(const char *views, int fps, int gap)
{
    char text[400];
    struct bead_scene *scene;
    struct bead_chain *chain;
    snprintf(text, sizeof text,
             "simulate: {until: 0.9 ms}\nchain: {gap: %d um, beads: [{bead: large-steel, count: 40}]}\n"
             "outputs: [{movie: film.mp4, views: %s, duration: 1 s, fps: %d}]\n",
             gap, views, fps);
    const struct bead_film film = prepared(text, 0.9e-3, &scene, &chain);
    bead_chain_destroy(chain);
    bead_scene_free(scene);
    return film.times.grid.every;
}

/* The largest values so far include those between frames, and so do impacts: a film of few frames needs more samples for them. */
static void few_frames_miss_no_peaks(void **state)
{
    (void)state;
    const double near = spacing("[stage]", 240, 0);
    assert_float_equal(near, 0.9e-3 / 239, 1e-12);
    assert_true(spacing("[stage, profile]", 240, 0) < 0.3 * near);
    assert_float_equal(spacing("[stage]", 10, 0), 1e-4, 1e-12); /* the wave is in the chain for longer, in some frame */
    assert_true(spacing("[stage]", 2, 0) < 4.0004e-6);
    assert_true(spacing("[stage]", 10, 20) < 4.0004e-6);              /* beads fly for longer than they push */
    assert_true(spacing("[beads], field: velocity", 2, 20) > 0.8e-3); /* nothing comes and goes */
}

/* ---- impacts between frames ---- */

enum { IMPACT_FRAMES = 48 };
static const double cradle_time = 2.4, cradle_length = 0.2; /* s, m */

/* A film, 24 frames a second, of two balls that swing, without anything written on it. */
static void film_of_impacts(const char *keys, struct decoded *movie)
{
    char scene[512], text[600], path[512];
    snprintf(text, sizeof text,
             "chain: {cradle: {length: %g m}, striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel}]}\n"
             "simulate: {until: %g s}\n"
             "outputs: [{movie: impacts.%s, size: [160, 90], axes: false, fps: 24, duration: 2 s}]\n",
             cradle_length, cradle_time, keys);
    write_scene(text, scene);
    play_counts((struct bead_job){.input = scene, .output = directory});
    snprintf(path, sizeof path, "%s/impacts.%.*s", directory, (int)strcspn(keys, ","), keys);
    decode(path, movie);
}

/* So many bytes of a frame are brighter than in another by more than dither is. */
static size_t brighter(const AVFrame *frame, const AVFrame *than)
{
    size_t count = 0;
    for (int y = 0; y < frame->height; y++) {
        for (int x = 0; x < 3 * frame->width; x++)
            count +=
                frame->data[0][(ptrdiff_t)y * frame->linesize[0] + x] > than->data[0][(ptrdiff_t)y * than->linesize[0] + x] + 8;
    }
    return count;
}

/* Has an impact begun since the frame before this one? Small swings take 2 pi sqrt(l / g), and the balls meet twice in each. */
static bool struck_before(size_t frame)
{
    const double half = 3.14159265358979 * sqrt(cradle_length / 9.80665), step = cradle_time / (IMPACT_FRAMES - 1);
    const double last = floor(step * (double)frame / half) * half;
    return frame > 0 && last >= step * ((double)frame - 1);
}

/* The balls touch for a tenth of a millisecond, less than a hundredth of the time between frames, but each impact is seen, and
 * nothing else is: in the light of the stage and in the curve. */
static void impacts_are_seen(void **state)
{
    (void)state;
    static const char *const views[][2] = {{"apng, views: [stage]", "apng, views: [stage], light: none"},
                                           {"apng, views: [profile]", NULL}};
    for (size_t v = 0; v < 2; v++) {
        static struct decoded movie, dark;
        size_t seen = 0;
        film_of_impacts(views[v][0], &movie);
        if (views[v][1])
            film_of_impacts(views[v][1], &dark);
        assert_int_equal(movie.count, IMPACT_FRAMES);
        for (size_t i = 0; i < movie.count; i++) {
            const bool lit = brighter(movie.frame[i], views[v][1] ? dark.frame[i] : movie.frame[0]) > 20;
            if (lit != struck_before(i))
                fail_msg("%s: frame %zu: %s", views[v][0], i, lit ? "light without an impact" : "an impact is not seen");
            seen += lit;
        }
        assert_int_equal(seen, 6);
        decoded_free(&movie);
        if (views[v][1])
            decoded_free(&dark);
    }
}

/* The image, with time downwards, has a stripe at each impact, almost as bright as the largest force is; the mean over the 27 ms of
 * a pixel would be dark. */
static void images_show_impacts(void **state)
{
    (void)state;
    static struct decoded movie;
    film_of_impacts("apng, views: [spacetime]", &movie);
    const AVFrame *end = movie.frame[movie.count - 1];
    const double half = 3.14159265358979 * sqrt(cradle_length / 9.80665), turns = cradle_time / end->height / half;
    size_t stripes = 0;
    for (int y = 0; y < end->height; y++) {
        const bool impact = y == 0 || floor(turns * (y + 1)) > floor(turns * y);
        const uint8_t red = end->data[0][(ptrdiff_t)y * end->linesize[0] + 3 * (end->width / 2)];
        if (impact != (red > 200))
            fail_msg("row %d: red is %d %s", y, red, impact ? "at an impact" : "between impacts");
        stripes += impact;
    }
    assert_int_equal(stripes, 6);
    decoded_free(&movie);
}

/* The frame that shows most has an impact in it. A still has finer edges than the film. */
static void posters_show_an_impact(void **state)
{
    (void)state;
    static struct decoded movie, peak;
    film_of_impacts("apng, views: [stage]", &movie);
    char scene[512], path[512];
    snprintf(scene, sizeof scene, "%s/scene.yaml", directory);
    snprintf(path, sizeof path, "%s/peak.png", directory);
    play_counts((struct bead_job){.input = scene, .output = path, .frame = "peak"});
    decode(path, &peak);
    size_t like = 0, least = SIZE_MAX;
    for (size_t i = 0; i < movie.count; i++) {
        const size_t unlike = brighter(movie.frame[i], peak.frame[0]) + brighter(peak.frame[0], movie.frame[i]);
        like = unlike < least ? i : like;
        least = unlike < least ? unlike : least;
    }
    assert_true(struck_before(like));
    decoded_free(&movie);
    decoded_free(&peak);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_are_counted),
        cmocka_unit_test(drafts_show_pictures_for_longer),
        cmocka_unit_test(waves_stay_in_sight),
        cmocka_unit_test(strobes_have_their_own_samples),
        cmocka_unit_test(plans_count_what_is_in_a_gif),
        cmocka_unit_test(few_frames_miss_no_peaks),
        cmocka_unit_test(impacts_are_seen),
        cmocka_unit_test(images_show_impacts),
        cmocka_unit_test(posters_show_an_impact),
    };
    return cmocka_run_group_tests_name("movie_times", tests, make_directory, remove_directory);
}
