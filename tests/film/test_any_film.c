/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The times of any film, drawn by seed: of its samples, stored or computed, its frames and stops; the order of its chapters; what
 * it says of its chains. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "render/movie/film.h"
#include "render/movie/movie_words.h"

/* Prepares the film of a scene with its chain up to `end`, of stored samples or NULL; returns its scene and chain, to be freed. */
static struct bead_film prepared(const char *text, double end, const struct bead_grid *native, struct bead_scene **scene,
                                 struct bead_chain **chain)
{
    struct bead_film film;
    struct bead_message msg = {""};
    if (bead_scene_parse("test", text, strlen(text), NULL, scene, &msg) || bead_chain_create(*scene, 0, chain, &msg))
        fail_msg("%s", msg.text);
    struct bead_run_context context = {
        .scene = *scene, .chains = (const struct bead_chain *const *)chain, .chain_count = 1, .end = end, .resolution = 1e-6};
    if (native)
        context.native = *native;
    if (bead_film_prepare(&(*scene)->outputs[0], &context, &film, &msg))
        fail_msg("%s", msg.text);
    return film;
}

static uint64_t random_state = 20261;

static double any(double low, double high)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(random_state >> 40) / 0x1p24;
}

static bool is_whole(double x)
{
    return fabs(x - round(x)) < 1e-3;
}

/* Stored samples: from the last one before the film, or at its beginning, to the first one behind it, as far as there are any. */
static void assert_stored(const struct bead_movie_times *t, const struct bead_grid *native)
{
    const struct bead_grid *g = &t->grid;
    const double every = native->every, slack = 1e-3 * every, end = native->end;
    assert_true(g->every == every && !g->widens && is_whole((g->start - native->start) / every) &&
                is_whole((g->end - native->start) / every));
    assert_true(g->start >= native->start && g->start <= fmax(t->time[0], native->start) + slack);
    assert_true(g->start > t->time[0] - every + slack || fabs(g->start - native->start) < slack);
    assert_true(g->end <= end + slack && g->end >= fmin(t->time[1], end) - slack && g->end < t->time[1] + every - slack);
}

/* Computed samples: at each frame, or so many times as often that none is further away than what views that average need. */
static void assert_computed(const struct bead_film *film, bool finely)
{
    const struct bead_movie_times *t = &film->times;
    const double parts = t->step / t->grid.every, most = film->context.resolution;
    assert_true(t->grid.start == t->time[0] && t->grid.end == t->time[1] && !t->grid.widens && is_whole(parts));
    assert_true(finely ? t->grid.every < most * (1 + 1e-6) && (parts < 1.5 || t->step / (parts - 1) > most * (1 - 1e-6))
                       : parts < 1.5);
}

/* Drafts, and files of few pictures a second, have one for each group of frames, and the last; all of the card. */
static void assert_pictures(const struct bead_movie_times *t)
{
    size_t pictures = 0, since = 0;
    for (size_t i = 0; i < t->frames; i++) {
        const bool draws = bead_movie_draws(t, i);
        pictures += draws;
        since = draws ? 0 : since + 1;
        assert_true(since < t->group && (draws || i > t->card));
    }
    assert_true(since == 0 && pictures == bead_movie_pictures(t));
}

/* The motion goes on from frame to frame, from its first time to its last, by a step or more; what is found at a time is the frame
 * that shows it first. */
static void assert_frames(const struct bead_film *film)
{
    const struct bead_movie_times *t = &film->times;
    const double fps = film->output->movie.fps, slack = 1e-6 * (t->time[1] - t->time[0]);
    const size_t last = t->frames - 1;
    const bool pauses = film->output->movie.caption_count > 0;
    double before = t->time[0];
    assert_true(bead_movie_time(t, 0) == t->time[0] && bead_movie_time(t, (double)t->card) == t->time[0]);
    assert_true(bead_movie_time(t, (double)last) == t->time[1] && bead_movie_time(t, (double)last - 0.5) < t->time[1]);
    for (size_t i = t->card + 1; i < t->frames; i++) {
        const double time = bead_movie_time(t, (double)i);
        assert_true(time >= before && (pauses || time - before > t->step - slack));
        assert_true(t->film.count || fabs(time - before - t->step) < slack);
        if (time > before && i < last)
            assert_true(fabs(bead_movie_stop_time(t, time - slack, fps) * fps - (double)i) < 0.01 ||
                        bead_movie_film_time(t, time - slack, fps) * fps < (double)i - 1);
        before = time;
    }
    assert_true(bead_movie_stop_time(t, t->time[1] + 1, fps) * fps <= (double)last + 0.01);
    assert_true(fabs(bead_movie_film_time(t, t->time[0] - 1, fps) * fps - (double)t->card) < 0.01);
}

/* Stored or computed, of the whole run or a part, with any speed. */
static void times_of_any_film(void **state)
{
    (void)state;
    static const struct {
        const char *keys;
        bool finely;
    } films[] = {{"views: [stage]", false},
                 {"views: [spacetime]", true},
                 {"views: [stage], sound: contact 3", true},
                 {"views: [stage, profile]", true}};
    static const char *const speeds[] = {"", "card: {for: 0.3 s, text: All}, ",
                                         "speed: [{at: 0 ms, factor: 1/4000}, {at: 0.4 ms, factor: 1/1000}], ",
                                         "captions: [{at: 0.35 ms, pause: 0.3 s, text: here}], "};
    static const char *const files[] = {"film.mp4", "film.mp4, quality: draft", "film.gif"};
    for (size_t i = 0; i < 160; i++) {
        char text[600], time[2][20] = {"auto", "auto"};
        struct bead_scene *scene;
        struct bead_chain *chain;
        struct bead_grid native = {.start = round(any(0, 90)) * 1e-6, .every = round(any(1, 30)) * 1e-6, .end = NAN};
        native.end = native.start + floor(any(700e-6, 800e-6) / native.every) * native.every;
        for (int k = 0; k < 2; k++) {
            if (any(0, 4) > 1)
                snprintf(time[k], sizeof time[k], "%.1f us", k ? any(450, 690) : any(0, 300));
        }
        snprintf(text, sizeof text,
                 "simulate: {until: 0.9 ms}\n"
                 "chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 40}]}\n"
                 "outputs: [{movie: %s, %s%s%s, fps: %d, time: [%s, %s]}]\n",
                 files[i / 16 % (i / 4 % 4 == 2 ? 2 : 3)], speeds[i % 4], i % 4 < 2 ? "duration: 1 s, " : "", films[i / 4 % 4].keys,
                 10 + (int)any(0, 50), time[0], time[1]);
        const struct bead_film film = prepared(text, native.end, i % 3 ? &native : NULL, &scene, &chain);
        struct bead_needs needs;
        bead_film_needs(&film, "a film", &needs);
        assert_true(needs.beads.first == 0 && needs.beads.last == bead_chain_beads(chain) - 1);
        assert_true(needs.until == film.times.time[1] && needs.grid.start == film.times.grid.start &&
                    needs.grid.every == film.times.grid.every && needs.grid.end == film.times.grid.end);
        if (i % 3)
            assert_stored(&film.times, &native);
        else
            assert_computed(&film, films[i / 4 % 4].finely);
        assert_frames(&film);
        assert_pictures(&film.times);
        bead_chain_destroy(chain);
        bead_scene_free(scene);
    }
}

/* Chapters begin at captions and stops, each once and in order, the first one with the film; those that begin together have the
 * name of the caption. */
static void chapters_are_in_order(void **state)
{
    (void)state;
    static const struct {
        const char *captions, *stops, *titles;
    } films[] = {
        {"{at: 0 us, text: a}", "100 us, 200 us", "a, Stop 1, Stop 2"},
        {"{at: 100 us, text: a}, {at: 300 us, text: b}, {at: 500 us, text: c}", "200 us, 400 us, 600 us",
         "Film, a, Stop 1, b, Stop 2, c, Stop 3"},
        {"{at: 200 us, text: a}, {at: 300 us, text: b}", "50 us, 100 us, 200 us, 250 us", "Film, Stop 1, Stop 2, a, Stop 4, b"},
        {"{at: 300 us, text: a}, {at: 400 us, text: b}", "0 us, 300 us", "Film, a, b"}};
    for (size_t i = 0; i < sizeof films / sizeof *films; i++) {
        char text[600], titles[300] = "";
        struct bead_scene *scene;
        struct bead_chain *chain;
        struct bead_movie_notes notes = {.chapter_count = 0};
        snprintf(text, sizeof text,
                 "title: Film\nsimulate: {until: 0.9 ms}\nchain: {beads: [{bead: large-steel, count: 4}]}\n"
                 "outputs: [{movie: film.mp4, duration: 0.9 s, fps: 100, captions: [%s], stops: [%s]}]\n",
                 films[i].captions, films[i].stops);
        const struct bead_film film = prepared(text, 0.9e-3, NULL, &scene, &chain);
        assert_int_equal(bead_movie_notes_make(&film, &notes, NULL), BEAD_OK);
        for (size_t k = 0; k < notes.chapter_count; k++) {
            const struct bead_movie_chapter *c = &notes.chapters[k];
            assert_true(k ? c->start > c[-1].start : c->start == 0);
            snprintf(titles + strlen(titles), sizeof titles - strlen(titles), "%s%s", k ? ", " : "", c->title);
        }
        assert_string_equal(titles, films[i].titles);
        bead_movie_notes_free(&notes);
        bead_chain_destroy(chain);
        bead_scene_free(scene);
    }
}

/* What is said of some chains does not depend on their order, and of one chain twice it is what is said of it. */
static void facts_hold_for_all_chains(void **state)
{
    (void)state;
    static const char *const scenes[] = {
        "chains:\n  - {name: a, striker: {velocity: 1 m/s}, beads: [{bead: ptfe, count: 9}]}\n"
        "  - {name: b, striker: {velocity: 2 m/s}, beads: [{bead: ptfe, count: 9}]}\n"
        "  - {name: c, striker: {velocity: 1 m/s}, beads: [{cell: [ptfe, glass], count: 3}, {bead: ptfe, count: 5}]}\n"
        "  - {name: d, beads: [{bead: large-steel, count: 9}]}\noutputs: [{movie: a.mp4}]\n",
        "simulate: {until: 1}\nchains:\n"
        "  - {name: a, label: x, equation: fput, points: 63, alpha: 0.5, start: {pulse: 0.05, width: 8, at: 20}}\n"
        "  - {name: b, label: x, equation: fput, points: 31, alpha: 0.5, start: {pulse: 0.05, width: 8, at: 20}}\n"
        "  - {name: c, label: x, equation: kdv, length: 2, dispersion: 0.25, variable: strain, start: {pulse: 1, width: 0.2, at: "
        "1}}\n"
        "  - {name: d, label: x, equation: kdv, length: 2, dispersion: 0.5, variable: strain, start: {pulse: 1, width: 0.2, at: "
        "1}}\n"
        "outputs: [{movie: a.mp4, field: strain, views: [profile]}]\n"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct bead_message msg = {""};
        struct bead_scene *scene;
        struct bead_chain *chains[4];
        if (bead_scene_parse("test", scenes[i], strlen(scenes[i]), NULL, &scene, &msg))
            fail_msg("%s", msg.text);
        for (size_t c = 0; c < 4; c++)
            assert_int_equal(bead_chain_create(scene, c, &chains[c], &msg), BEAD_OK);
        for (size_t k = 0; k < 32; k++) {
            const struct bead_chain *order[2][2] = {{chains[k % 4], chains[k / 4 % 4]}, {chains[k / 4 % 4], chains[k % 4]}};
            char said[3][500];
            for (size_t n = 0; n < 3; n++)
                bead_facts_chain(&(struct bead_facts){.keyed = k / 16, .chains = order[n % 2], .chain_count = n < 2 ? 2 : 1},
                                 said[n], sizeof said[n]);
            assert_string_equal(said[0], said[1]);
            if (k % 4 == k / 4 % 4)
                assert_string_equal(said[0], said[2]);
        }
        for (size_t c = 0; c < 4; c++)
            bead_chain_destroy(chains[c]);
        bead_scene_free(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(times_of_any_film), cmocka_unit_test(chapters_are_in_order),
                                       cmocka_unit_test(facts_hold_for_all_chains)};
    return cmocka_run_group_tests_name("any film", tests, NULL, NULL);
}
