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

/* One peak answers too strongly: it and its neighbours are uncertain, those far away are not. */
static void strong_answers_spread(void **state)
{
    (void)state;
    struct bead_peak peaks[41], comparison[41];
    double u[41];
    for (size_t i = 0; i < 41; i++) {
        peaks[i] = (struct bead_peak){10, 1e-3, false};
        comparison[i] = (struct bead_peak){i == 0 ? 10 * (1 + 1e-3) : 10 * (1 + 1e-6), 1e-3, false};
    }
    comparison[30].value = 10 * (1 + 3e-6); /* a tenth of what the comparison run may be off by */
    const struct bead_uncertainty_of of = {1e-6, 30, false, 0}, damped = {1e-6, 30, true, 0}, step = {0, 2, false, 0};
    const struct bead_uncertain_peaks kinds[2] = {{peaks, comparison, 41, u}, {NULL, NULL, 0, NULL}};
    bead_uncertainty_find(&of, kinds);
    assert_near(u[0], 0.07, 1e-6);
    assert_near(u[1], 0.75 * 0.07, 1e-6);
    assert_near(u[30], 3e-5, 1e-10);
    assert_true(bead_uncertainty_is_doubtful(&of, kinds));
    assert_near(u[40], 1e-5, 1e-12);
    bead_uncertainty_find(&damped, kinds);
    assert_near(u[0], 1e-3, 1e-6);
    assert_near(u[1], 1e-5, 1e-12);
    assert_false(bead_uncertainty_is_doubtful(&damped, kinds));
    bead_uncertainty_find(&step, kinds);
    assert_near(u[0], 1e-2, 1e-9);
    assert_near(u[1], 1e-5, 1e-9);
}

/* A run that missed the end of the pulse has later maxima, which say nothing of the other's. */
static void what_comes_behind_the_end_of_either_is_not_compared(void **state)
{
    (void)state;
    const struct bead_peak peaks[] = {{10, 1e-3, false}, {10, 2e-3, false}};
    const struct bead_peak comparison[] = {{10 * (1 + 1e-6), 1e-3, false}, {20, 3e-3, false}};
    const struct bead_uncertainty_of of = {1e-6, 30, false, 2.5e-3};
    double u[2];
    const struct bead_uncertain_peaks kinds[2] = {{peaks, comparison, 2, u}, {NULL, NULL, 0, NULL}};
    bead_uncertainty_find(&of, kinds);
    assert_near(u[0], 1e-5, 1e-12);
    assert_near(u[1], 1e-5, 1e-12);
}

/* In these chains one way of being unstable drives some peaks, and chance decides how strongly each run excites it: here a run and
 * the first comparison run are off alike, by several times what was asked. A second one is not. */
static void peaks_that_agree_by_chance_are_compared_again(void **state)
{
    (void)state;
    static const struct {
        uint64_t seed;
        double accuracy;
    } cases[] = {{1036, 8e-9}, {1063, 1e-6}, {1225, 1.3e-6}};
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
    const struct CMUnitTest tests[] = {cmocka_unit_test(chains_drawn_at_random), cmocka_unit_test(strong_answers_spread),
                                       cmocka_unit_test(what_comes_behind_the_end_of_either_is_not_compared),
                                       cmocka_unit_test(slow_contacts_count_as_they_are),
                                       cmocka_unit_test(peaks_that_agree_by_chance_are_compared_again)};
    return cmocka_run_group_tests_name("uncertainty", tests, NULL, NULL);
}
