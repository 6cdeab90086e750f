/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Words for those who cannot see a picture: they follow from the values, and change with them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "render/view/tale.h"
#include "tests/sweeps.h"

enum { BEADS = 41 };

/* A wave whose front passes bead j at 10 j us: `height` at its front, `tail` beads long. */
struct wave {
    double height[2]; /* N: at the first and at the last bead */
    int tail;         /* beads */
    double static_force;
};

static void tell(const char *chain, const struct wave *wave, double until, char *words, size_t size)
{
    char text[300];
    struct bead_chain *made;
    struct bead_tale *tale;
    snprintf(text, sizeof text, "chain: {%s}\noutputs: [{table: p.csv}]\n", chain);
    struct bead_scene *scene = parse(text);
    assert_int_equal(bead_chain_create(scene, 0, &made, NULL), BEAD_OK);
    const struct bead_chain *chains[] = {made};
    assert_int_equal(bead_tale_create(chains, 1, BEAD_FIELD_FORCE, (struct bead_span){0, SIZE_MAX}, &tale, NULL), BEAD_OK);
    for (size_t k = 0; (double)k * 1e-6 <= until * (1 + 1e-9); k++) {
        double values[BEADS];
        struct bead_sample sample = {.index = k, .time = 1e-6 * (double)k, .active = BEADS};
        const int front = (int)(k / 10);
        for (int j = 0; j < BEADS; j++) {
            const double height = wave->height[0] + (wave->height[1] - wave->height[0]) * j / (BEADS - 1);
            values[j] = wave->static_force + (k > 0 && j <= front && j > front - wave->tail ? height : 0);
        }
        sample.field[BEAD_FIELD_FORCE] = values;
        bead_tale_feed(tale, &sample);
    }
    bead_tale_words(tale, words, size);
    bead_tale_destroy(tale);
    bead_chain_destroy(made);
    bead_scene_free(scene);
}

static void says(const char *chain, struct wave wave, double until, const char *expected)
{
    char words[BEAD_TALE_WORDS];
    tell(chain, &wave, until, words, sizeof words);
    for (char *space; (space = strstr(words, "\u00a0")) != NULL;) { /* between number and unit */
        *space = ' ';
        memmove(space + 1, space + 2, strlen(space + 1));
    }
    assert_string_equal(words, expected);
}

static const char plain[] = "beads: [{bead: large-steel, count: 40}]",
                  random_cells[] =
                      "name: R & S, beads: [{cell: [large-steel, aluminium], count: 20, spins: \"11111111110000000000\"}]";

static void test_a_pulse_that_keeps_its_height(void **state)
{
    (void)state;
    says(plain, (struct wave){{36, 36}, 5, 0}, 5e-4,
         "One pulse of 36 N, 5 beads wide, crosses 41 beads in 400 \u00b5s and keeps its "
         "height.");
    says(plain, (struct wave){{36, 36}, 1, 0}, 5e-4,
         "One pulse of 36 N, 1 bead wide, crosses 41 beads in 400 \u00b5s and keeps its "
         "height.");
}

static void test_a_wave_that_decays_or_spreads(void **state)
{
    (void)state;
    says(random_cells, (struct wave){{40, 10}, 30, 0}, 5e-4,
         "In R & S (M = 0) the front crosses 41 beads in 400 \u00b5s; the largest bead force goes from 36 N near the start to 18 N "
         "near the end, where the wave is spread over 30 beads.");
    says(plain, (struct wave){{36, 36}, 30, 0}, 5e-4,
         "The front crosses 41 beads in 400 \u00b5s; the largest bead force goes from 36 N near the start to 36 N near the end, "
         "where "
         "the wave is spread over 30 beads.");
}

/* A static force is no wave. */
static void test_precompression_counts_in_heights_only(void **state)
{
    (void)state;
    says(plain, (struct wave){{36, 36}, 5, 10}, 5e-4,
         "One pulse of 46 N, 5 beads wide, crosses 41 beads in 400 \u00b5s and keeps "
         "its height.");
}

static void test_a_wave_that_has_not_arrived(void **state)
{
    (void)state;
    says(plain, (struct wave){{36, 36}, 5, 0}, 2e-4,
         "The wave has passed 21 of 41 beads after 200 \u00b5s; its bead force is up to "
         "36 N.");
    says(plain, (struct wave){{0, 0}, 5, 0}, 2e-4, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_pulse_that_keeps_its_height),
        cmocka_unit_test(test_a_wave_that_decays_or_spreads),
        cmocka_unit_test(test_precompression_counts_in_heights_only),
        cmocka_unit_test(test_a_wave_that_has_not_arrived),
    };
    return cmocka_run_group_tests_name("words for pictures", tests, NULL, NULL);
}
