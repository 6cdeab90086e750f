/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The past kept by profiles: a pulse that fluctuates from bead to bead is even over cells. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "render/view/held.h"
#include "render/view/profile_hold.h"
#include "sim/chain/chain_internal.h"

enum { BEADS = 61, COUNT = 60 };

static struct bead_chain *chain_of(const char *cell, struct bead_scene **scene)
{
    char text[300];
    struct bead_message msg = {""};
    struct bead_chain *chain;
    snprintf(
        text, sizeof text,
        "chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{cell: %s, count: 30}]}\noutputs: [{table: p.csv}]\n",
        cell);
    if (bead_scene_parse("test", text, strlen(text), NULL, scene, &msg))
        fail_msg("%s", msg.text);
    assert_int_equal(bead_chain_create(*scene, 0, &chain, &msg), BEAD_OK);
    return chain;
}

/* A pulse whose crest is at `at` contacts: 36 N at even contacts, 26 N at odd ones. */
static void pulse(double at, double *values)
{
    for (int i = 0; i < COUNT; i++)
        values[i] = (i % 2 ? 26 : 36) * exp(-pow((i - at) / 1.2, 2));
}

static void test_dimers_are_even(void **state)
{
    (void)state;
    struct bead_scene *scene;
    struct bead_chain *chain = chain_of("[large-steel, aluminium]", &scene);
    struct bead_hold *hold;
    double values[COUNT], raw[2] = {INFINITY, 0}, cell[2] = {INFINITY, 0};
    double step =
        bead_chain_passage(chain, bead_chain_energy(chain)) / BEADS / 10; /* ten samples a contact, as fast as it may be */
    assert_int_equal(bead_hold_create(chain, (struct bead_span){0, COUNT - 1}, &hold, NULL), BEAD_OK);
    for (int k = 0; k < 400; k++) {
        double now = 0, passing = 0;
        pulse(5 + 0.1 * k, values);
        bead_hold_feed(hold, k * step, values);
        for (size_t i = 0; i < COUNT; i++) {
            now = fmax(now, values[i]);
            passing = fmax(passing, bead_hold_passing(hold, i));
        }
        if (k < 40)
            continue;
        raw[0] = fmin(raw[0], now), raw[1] = fmax(raw[1], now);
        cell[0] = fmin(cell[0], passing), cell[1] = fmax(cell[1], passing);
    }
    assert_true(raw[1] > 1.2 * raw[0]);
    assert_true(cell[0] > 0.99 * 36 && cell[1] <= 36);
    for (size_t i = 8; i < 40; i++) /* the envelope has no zigzag */
        assert_float_equal(bead_hold_largest(hold, i), 36, 0.4);
    assert_true(bead_hold_largest(hold, 55) < 1);
    bead_hold_destroy(hold);
    bead_chain_destroy(chain);
    bead_scene_free(scene);
}

/* Of single beads each keeps its own. */
static void test_beads_keep_their_own(void **state)
{
    (void)state;
    struct bead_scene *scene;
    struct bead_chain *chain = chain_of("[large-steel]", &scene);
    struct bead_hold *hold;
    double values[30] = {[3] = 5, [4] = 2}, none[30] = {0};
    assert_int_equal(bead_hold_create(chain, (struct bead_span){0, 29}, &hold, NULL), BEAD_OK);
    bead_hold_feed(hold, 0, values);
    bead_hold_feed(hold, 1, none); /* much later */
    assert_true(bead_hold_largest(hold, 3) == 5 && bead_hold_largest(hold, 4) == 2 && bead_hold_largest(hold, 5) == 0);
    assert_true(bead_hold_passing(hold, 3) == 0);
    /* Of samples that are too many to be kept, as well: twice the passage of a contact is remembered, give or take two samples
     * kept. */
    const double lasting = 2 * bead_chain_passage(chain, bead_chain_energy(chain)) / (double)bead_chain_contacts(chain);
    for (int k = 0; k <= 400; k++) {
        bead_hold_feed(hold, 2 + 0.005 * k * lasting, k == 0 ? values : none);
        if (k < 180 || k > 220)
            assert_true(bead_hold_passing(hold, 3) == (k < 180 ? 5 : 0));
    }
    bead_hold_destroy(hold);
    bead_chain_destroy(chain);
    bead_scene_free(scene);
}

static double any(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 40) / 0x1p24;
}

/* Of samples at any times, close or not: what passes is the largest value of a cell in the time that is remembered, give or take
 * two of the 32 samples kept; what has been, that of all times. */
static void test_any_samples_are_remembered(void **state)
{
    (void)state;
    enum { SHOWN = 12, FED = 600 };
    static const char *const cells[] = {"[large-steel]", "[large-steel, aluminium]", "[large-steel, aluminium, aluminium]"};
    static double values[FED][SHOWN], time[FED];
    uint64_t random = 7;
    for (size_t cell = 1; cell <= 3; cell++) {
        struct bead_scene *scene;
        struct bead_chain *chain = chain_of(cells[cell - 1], &scene);
        struct bead_hold *hold;
        const double lasting =
            2 * bead_chain_passage(chain, bead_chain_energy(chain)) / (double)bead_chain_contacts(chain) * (double)cell;
        assert_int_equal(bead_hold_create(chain, (struct bead_span){3, 3 + SHOWN - 1}, &hold, NULL), BEAD_OK);
        for (size_t k = 0; k < FED; k++) {
            time[k] = (k ? time[k - 1] : 0) + lasting * pow(any(&random), 2) * (k / 100 % 2 ? 0.01 : 0.3);
            for (size_t i = 0; i < SHOWN; i++)
                values[k][i] = pow(any(&random), 20);
            bead_hold_feed(hold, time[k], values[k]);
            for (size_t i = 0; i < SHOWN; i++) {
                double most[3] = {0}; /* of too short a time, of too long a one, of all */
                for (size_t j = 0; j <= k; j++) {
                    const size_t from = i > (cell - 1) / 2 ? i - (cell - 1) / 2 : 0;
                    for (size_t b = from; b < from + cell && b < SHOWN; b++) {
                        for (int w = 0; w < 3; w++) {
                            const double window = w == 2 ? INFINITY : lasting * (w ? 1 + 2.0 / 31 : 1 - 2.0 / 31);
                            most[w] = time[k] - time[j] <= window ? fmax(most[w], values[j][b]) : most[w];
                        }
                    }
                }
                const double passing = bead_hold_passing(hold, i);
                assert_true(passing >= most[0] && passing <= most[1] && bead_hold_largest(hold, i) == most[2]);
            }
        }
        bead_hold_destroy(hold);
        bead_chain_destroy(chain);
        bead_scene_free(scene);
    }
}

/* What films take of the samples between two frames: of forces the largest, with their signs, of what swings the last; of nothing
 * new, nothing. Only the beads in sight. */
static void test_frames_hold_the_largest(void **state)
{
    (void)state;
    enum { FIRST = 2, LAST = 5, ALL = BEADS + 2 };
    static const unsigned fields =
        BEAD_FIELD_BIT(BEAD_FIELD_FORCE) | BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE) | BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY);
    for (int open = 0; open < 2; open++) { /* to a bead, or to the end, whichever that is */
        struct bead_scene *scene;
        struct bead_chain *chain = chain_of("[large-steel]", &scene);
        const size_t beads = bead_chain_beads(chain), contacts = bead_chain_contacts(chain);
        struct bead_held *held;
        double force[ALL], velocity[ALL];
        assert_int_equal(bead_held_create(chain, fields, (struct bead_span){FIRST, open ? SIZE_MAX : LAST}, &held, NULL), BEAD_OK);
        assert_null(bead_held_take(held));
        for (int k = 0; k < 3; k++) {
            for (int i = 0; i < ALL; i++) {
                force[i] = k == 0 ? i : k == 1 ? (i == 3 ? -10 : 0) : 0;
                velocity[i] = k == 0 ? -i : 1;
            }
            const struct bead_sample sample = {.index = 7 + (size_t)k,
                                               .time = 0.5 * k,
                                               .active = beads,
                                               .field = {[BEAD_FIELD_FORCE] = force,
                                                         [BEAD_FIELD_CONTACT_FORCE] = force,
                                                         [BEAD_FIELD_VELOCITY] = velocity,
                                                         [BEAD_FIELD_ENERGY] = force}};
            bead_held_feed(held, &sample);
            if (k == 0)
                continue;
            const struct bead_sample *taken = bead_held_take(held);
            assert_true(taken && taken->index == 7 + (size_t)k && taken->time == 0.5 * k && taken->active == beads);
            assert_null(taken->field[BEAD_FIELD_ENERGY]);
            assert_null(taken->field[BEAD_FIELD_DISPLACEMENT]);
            for (size_t i = FIRST; i < (open ? beads : LAST + 1); i++) {
                const double largest = k == 2 ? 0 : i == 3 ? -10 : (double)i;
                assert_true(taken->field[BEAD_FIELD_FORCE][i] == largest && taken->field[BEAD_FIELD_VELOCITY][i] == 1);
                if (i < contacts)
                    assert_true(taken->field[BEAD_FIELD_CONTACT_FORCE][i] == largest);
            }
            assert_null(bead_held_take(held));
        }
        bead_held_destroy(held);
        assert_true(bead_held_is_needed(chain, fields, 5, 1) && !bead_held_is_needed(chain, fields, 4, 1));
        assert_false(bead_held_is_needed(chain, BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY), 5, 1));
        bead_chain_destroy(chain);
        bead_scene_free(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_dimers_are_even), cmocka_unit_test(test_beads_keep_their_own),
                                       cmocka_unit_test(test_any_samples_are_remembered),
                                       cmocka_unit_test(test_frames_hold_the_largest)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
