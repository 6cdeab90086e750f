/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Films whose speed changes: their lengths, the times they show, pauses; and their frames. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "render/movie/film_clock.h"

static const double whole[2] = {0, 2e-3};

static void even_time_has_no_pieces(void **state)
{
    (void)state;
    struct bead_film_clock clock;
    struct bead_movie_asked movie = {.duration = 10};
    bead_film_clock_make(&movie, whole, movie.duration, &clock);
    assert_int_equal(clock.count, 0);
    assert_float_equal(clock.slowed, 5000, 1e-9);
    assert_float_equal(bead_film_after(&clock, 1e-3, 2), 1.4e-3, 1e-12);
}

/* 1/4000 at the beginning, 1/500 after 1 ms: 1 ms takes the integral of 1 / factor, (4000 - 500) / ln 8 ms; then 1 ms takes 0.5 s.
 */
static void the_curve_is_integrated(void **state)
{
    (void)state;
    struct bead_film_clock clock;
    struct bead_speed speeds[] = {{0, 1.0 / 4000}, {1e-3, 1.0 / 500}};
    struct bead_movie_asked movie = {.duration = 10, .speeds = speeds, .speed_count = 2};
    bead_film_clock_make(&movie, whole, movie.duration, &clock);
    double first = 3.5 / log(8), factors[2];
    assert_float_equal(bead_film_length(&clock), first + 0.5, 1e-9);
    assert_float_equal(bead_film_time(&clock, 1e-3), first, 1e-9);
    assert_float_equal(bead_film_motion(&clock, first + 0.25), 1.5e-3, 1e-12);
    assert_float_equal(bead_film_motion(&clock, 0), 0, 0);
    assert_float_equal(bead_film_motion(&clock, 1e-4), 1e-4 / 4000, 1e-10);
    bead_film_factors(&clock, factors);
    assert_float_equal(factors[0], 1.0 / 4000, 1e-15);
    assert_float_equal(factors[1], 1.0 / 500, 1e-15);
    double before = -1;
    for (int i = 0; i <= 1000; i++) {
        double film = bead_film_length(&clock) * i / 1000, motion = bead_film_motion(&clock, film);
        assert_true(motion > before && motion <= whole[1] * (1 + 1e-12));
        assert_float_equal(bead_film_time(&clock, motion), film, 1e-6);
        before = motion;
    }
}

/* The speed that is said is the one that is seen: the motion's growth with the film's time. */
static void speeds_are_those_of_the_motion(void **state)
{
    (void)state;
    struct bead_film_clock clock;
    struct bead_speed speeds[] = {{0, 1.0 / 4000}, {0.7e-3, 1.0 / 500}, {1.2e-3, 1.0 / 500}, {1.6e-3, 1.0 / 2000}};
    struct bead_caption captions[] = {{.at = 0.4e-3, .pause = 1.5, .until = NAN, .lasting = NAN}};
    struct bead_movie_asked movie = {.duration = 10, .speeds = speeds, .speed_count = 4, .captions = captions, .caption_count = 1};
    bead_film_clock_make(&movie, whole, movie.duration, &clock);
    size_t standing = 0;
    for (int i = 1; i < 200; i++) {
        const double film = bead_film_length(&clock) * i / 200, d = 1e-5, before = bead_film_motion(&clock, film - d),
                     after = bead_film_motion(&clock, film + d), factor = bead_film_factor(&clock, bead_film_motion(&clock, film));
        assert_true(fabs((after - before) / (2 * d) - factor) < 2e-4 * factor + 1e-15);
        standing += factor == 0;
    }
    assert_true(fabs((double)standing - 1.5 / bead_film_length(&clock) * 200) < 1.5);
}

/* The least and the greatest factor, of films of seconds, too. */
static void factors_are_those_asked_for(void **state)
{
    (void)state;
    const double lasting[2] = {1, 9};
    struct bead_speed speeds[] = {{0, 0.25}, {3, 0.5}, {6, 0.125}, {8, 0.25}};
    for (size_t count = 1; count <= 4; count++) {
        struct bead_film_clock clock;
        double factors[2], least = INFINITY, most = 0;
        struct bead_movie_asked movie = {.duration = 10, .speeds = speeds, .speed_count = count};
        bead_film_clock_make(&movie, lasting, movie.duration, &clock);
        bead_film_factors(&clock, factors);
        for (double motion = 1; motion <= 9; motion += 0.25) {
            least = fmin(least, bead_film_factor(&clock, motion));
            most = fmax(most, bead_film_factor(&clock, motion));
        }
        assert_float_equal(factors[0], least, 1e-12);
        assert_float_equal(factors[1], most, 1e-12);
    }
}

/* A pause adds to the film; what begins there lasts beyond it. */
static void the_motion_stands_in_a_pause(void **state)
{
    (void)state;
    struct bead_film_clock clock;
    struct bead_caption captions[] = {{.at = 0, .pause = 1, .until = NAN, .lasting = NAN},
                                      {.at = 0.5e-3, .pause = 2, .until = NAN, .lasting = NAN},
                                      {.at = 1e-3, .pause = 0, .until = NAN, .lasting = NAN}};
    struct bead_movie_asked movie = {.duration = 10, .captions = captions, .caption_count = 3};
    bead_film_clock_make(&movie, whole, movie.duration, &clock);
    assert_float_equal(bead_film_length(&clock), 13, 1e-9);
    assert_float_equal(bead_film_motion(&clock, 0.99), 0, 0);
    assert_float_equal(bead_film_motion(&clock, 2), 0.2e-3, 1e-12);
    assert_float_equal(bead_film_time(&clock, 0.5e-3), 3.5, 1e-9);
    assert_float_equal(bead_film_motion(&clock, 3.6), 0.5e-3, 1e-15);
    assert_float_equal(bead_film_motion(&clock, 5.4), 0.5e-3, 1e-15);
    assert_float_equal(bead_film_motion(&clock, 6.5), 0.7e-3, 1e-12);
    assert_float_equal(bead_film_after(&clock, 0.5e-3, 3), 0.7e-3, 1e-12);
    assert_float_equal(bead_film_motion(&clock, 13), 2e-3, 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(even_time_has_no_pieces),        cmocka_unit_test(the_curve_is_integrated),
        cmocka_unit_test(speeds_are_those_of_the_motion), cmocka_unit_test(factors_are_those_asked_for),
        cmocka_unit_test(the_motion_stands_in_a_pause),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
