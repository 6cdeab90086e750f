/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks are off by no more than their uncertainties say, or than what was asked; and these say no more than they need. */
#include "support.h"

#include "drawn.h"

static const double asked[] = {1e-4, 1e-6, 1e-8};
enum { ASKED = sizeof asked / sizeof *asked };

/* Some of the chains of tests/stress/stress_uncertainty.c that are quick. */
static void chains_drawn_at_random(void **state)
{
    (void)state;
    static const uint64_t seeds[] = {1, 3, 19, 22, 24, 31, 34, 36, 157};
    for (size_t c = 0; c < sizeof seeds / sizeof *seeds; c++) {
        struct drawn drawn = drawn_make(seeds[c], 150);
        for (size_t i = 0; i < ASKED; i++) {
            const struct kept kept = drawn_ask(&drawn, asked[i]);
            if (!(kept.error <= 1) || !(kept.of_uncertainty <= 1) || !(kept.hidden <= 10))
                fail_msg("chain %d, asked %g: peak %zu is off by %.3g times that, %.3g times its uncertainty; said: up to %.3g",
                         (int)seeds[c], asked[i], kept.index, kept.error, kept.of_uncertainty, kept.hidden);
        }
        drawn_end(&drawn);
    }
}

/* One peak answers too strongly: it and its neighbours are uncertain, those far away as much as peaks that answer as they should
 * may be. */
static void strong_answers_spread(void **state)
{
    (void)state;
    struct bead_peak peaks[81], comparison[81];
    double u[81];
    for (size_t i = 0; i < 81; i++) {
        peaks[i] = (struct bead_peak){10, 1e-3, false, false};
        comparison[i] = (struct bead_peak){i == 0 ? 10 * (1 + 1e-3) : 10 * (1 + 1e-6), 1e-3, false, false};
    }
    const struct bead_uncertainty_of of = {1e-6, 30, false, 0}, damped = {1e-6, 30, true, 0}, step = {0, 2, false, 0};
    const struct bead_uncertain_peaks kinds[2] = {{peaks, comparison, 81, u}, {NULL, NULL, 0, NULL}};
    bead_uncertainty_find(&of, kinds);
    assert_near(u[0], 0.2, 1e-6);
    assert_near(u[1], 0.82 * 0.2, 1e-6);
    assert_near(u[80], 9.5e-5, 1e-9);
    bead_uncertainty_find(&damped, kinds);
    assert_near(u[0], 1e-3, 1e-6);
    assert_near(u[1], 1e-5, 1e-12);
    bead_uncertainty_find(&step, kinds);
    assert_near(u[0], 1e-2, 1e-9);
    assert_near(u[1], 1e-5, 1e-9);
}

/* No peak answers too strongly: each is as uncertain as its own difference says, or a part of the largest of all. */
static void usual_answers_do_not_spread(void **state)
{
    (void)state;
    const struct bead_peak peaks[] = {{10, 1e-3, false, false}, {10, 1e-3, false, false}, {10, 1e-3, false, false}};
    const struct bead_peak comparison[] = {
        {10, 1e-3, false, false}, {10 * (1 + 5e-6), 1e-3, false, false}, {10 * (1 + 3e-6), 1e-3, false, false}};
    const struct bead_uncertainty_of of = {1e-6, 30, false, 0}, fine = {1e-4, 30, false, 0};
    double u[3];
    const struct bead_uncertain_peaks kinds[2] = {{peaks, comparison, 3, u}, {NULL, NULL, 0, NULL}};
    bead_uncertainty_find(&of, kinds);
    assert_near(u[0], 20. / 6 * 1e-5, 1e-9);
    assert_near(u[1], 5e-5, 1e-9);
    assert_near(u[2], 20. / 6 * 1e-5, 1e-9);
    bead_uncertainty_find(&fine, kinds);
    for (size_t i = 0; i < 3; i++)
        assert_near(u[i], 1e-3, 1e-9);
}

/* A run that missed the end of the pulse has later maxima, which say nothing of the other's. */
static void what_comes_behind_the_end_of_either_is_not_compared(void **state)
{
    (void)state;
    const struct bead_peak peaks[] = {{10, 1e-3, false, false}, {10, 2e-3, false, false}};
    const struct bead_peak comparison[] = {{10 * (1 + 1e-6), 1e-3, false, false}, {20, 3e-3, false, false}};
    const struct bead_uncertainty_of of = {1e-6, 30, false, 2.5e-3};
    double u[2];
    const struct bead_uncertain_peaks kinds[2] = {{peaks, comparison, 2, u}, {NULL, NULL, 0, NULL}};
    bead_uncertainty_find(&of, kinds);
    assert_near(u[0], 1e-5, 1e-12);
    assert_near(u[1], 1e-5, 1e-12);
}

/* In these chains one way of being unstable drives some peaks, and chance decides how strongly each run excites it: here a run and
 * its comparison run are off alike at a peak, by several times what was asked. Others of the chain say so. */
static void peaks_that_agree_by_chance_are_known_by_others(void **state)
{
    (void)state;
    static const struct {
        uint64_t seed;
        double accuracy;
    } cases[] = {{1036, 8e-9}, {1225, 1.3e-6}, {1198, 1e-6}, {1324, 1e-5}, {2157, 1e-4}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct drawn drawn = drawn_make(cases[i].seed, 150);
        const struct kept kept = drawn_ask(&drawn, cases[i].accuracy);
        assert_true(kept.error > 1);
        if (!(kept.of_uncertainty <= 1))
            fail_msg("chain %d, asked %g: peak %zu is off by %.3g times that, %.3g times its uncertainty", (int)cases[i].seed,
                     cases[i].accuracy, kept.index, kept.error, kept.of_uncertainty);
        drawn_end(&drawn);
    }
}

/* The force at the last contact has a minimum and a maximum so close to each other that both lie within a step, or do not: the
 * first pulse ends there whatever the steps. */
static void pulses_that_hardly_part_do(void **state)
{
    (void)state;
    struct drawn drawn = drawn_make(7169, 150);
    for (size_t i = 0; i < ASKED; i++) {
        struct peaks got = find_coarse(drawn.text, asked[i], 0);
        assert_near(got.end / drawn.fine.end, 1, asked[i]);
        free(got.peak);
    }
    drawn_end(&drawn);
}

/* Heavy beads that a light striker leaves with a hundredth of its speed: what their contacts owe to openings counts by how fast
 * they are, from the first opening on. Chance decides how much is left, so that several accuracies are asked for. */
static void slow_contacts_count_as_they_are(void **state)
{
    (void)state;
    static const double spiky[] = {7.975e-6, 1.35e-5, 1.66e-5};
    struct drawn drawn = drawn_make(225, 150);
    for (size_t i = 0; i < sizeof spiky / sizeof *spiky; i++) {
        const struct kept kept = drawn_ask(&drawn, spiky[i]);
        if (kept.error > 1)
            fail_msg("asked for %g, peak %zu is off by %g times that", spiky[i], kept.index, kept.error);
    }
    drawn_end(&drawn);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(chains_drawn_at_random),
                                       cmocka_unit_test(strong_answers_spread),
                                       cmocka_unit_test(usual_answers_do_not_spread),
                                       cmocka_unit_test(what_comes_behind_the_end_of_either_is_not_compared),
                                       cmocka_unit_test(slow_contacts_count_as_they_are),
                                       cmocka_unit_test(pulses_that_hardly_part_do),
                                       cmocka_unit_test(peaks_that_agree_by_chance_are_known_by_others)};
    return cmocka_run_group_tests_name("uncertainty", tests, NULL, NULL);
}
