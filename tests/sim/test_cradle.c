/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Beads held in place: springs and pendulums. */
#include "support.h"

#define MATERIAL "materials: {unit: {mass: 1 g, radius: 5 mm, modulus: 1 GPa, poisson: 0.3}}\n"
#define UNIT     "law: {power: 1.5, coefficient: 1e9}, "
static const double mass = 1e-3, gravity = 9.80665;

static struct bead_outcome finish(struct bead_run *run, double end)
{
    struct bead_outcome outcome;
    run_until(run, end);
    bead_run_finish(run, end, &outcome);
    return outcome;
}

/* A bead that touches nothing is a harmonic oscillator: those of a cradle as pendulums, each whatever its mass, and those with
 * springs each at its own frequency. */
static void lone_beads_are_oscillators(void **state)
{
    (void)state;
    const double length = 0.2, v = 0.01, end = 0.4, stiffness = 300;
    struct built b =
        build(MATERIAL "chain: {" UNIT "cradle: {length: 20 cm}, gap: 1 cm, striker: {bead: unit, mass: 7 g}, start: [{bead: 0, "
                       "velocity: -0.01 m/s}, {bead: 2, velocity: 0.01 m/s}], beads: [{bead: unit, count: 2}, {bead: "
                       "unit, spring: 300 N/m}]}\n",
              "until: 0.5 s");
    struct bead_run *run = start_run(&b, (struct bead_run_settings){.end = end});
    run_until(run, end);
    const struct bead_sample at = sample_at(run, end);
    const double w = sqrt(gravity / length), u = v / w * sin(w * end);
    assert_near(at.field[BEAD_FIELD_DISPLACEMENT][0] / u, -1, 1e-10);
    assert_near(at.field[BEAD_FIELD_DISPLACEMENT][2] / u, 1, 1e-10);
    assert_near(at.field[BEAD_FIELD_VELOCITY][2], v * cos(w * end), 1e-10 * v);
    assert_near(at.field[BEAD_FIELD_ENERGY][2] / (0.5 * mass * v * v), 1, 1e-10);
    assert_true(at.field[BEAD_FIELD_VELOCITY][3] == 0); /* at rest it stays so, bit for bit */
    bead_run_destroy(run);
    release(&b);

    struct built held =
        build(MATERIAL "chain: {" UNIT "gap: 1 cm, striker: {bead: unit}, start: [{bead: 2, displacement: 1 mm}], beads: "
                       "[{bead: unit}, {bead: unit, spring: 300 N/m}]}\n",
              "until: 0.5 s");
    run = start_run(&held, (struct bead_run_settings){.end = 0.1});
    assert_near(bead_chain_energy(held.chain), 0.5 * stiffness * 1e-6, 1e-16);
    run_until(run, 0.1);
    assert_near(sample_at(run, 0.1).field[BEAD_FIELD_DISPLACEMENT][2], 1e-3 * cos(sqrt(stiffness / mass) * 0.1), 1e-12);
    bead_run_destroy(run);
    release(&held);
}

/* Two equal pendulums of which one strikes: Hertz's collision is so short that they swap velocities, and meet again after half a
 * period at the same place, again and again. */
static void two_balls_swap_for_ever(void **state)
{
    (void)state;
    struct built b = build(MATERIAL "chain: {" UNIT "cradle: {length: 20 cm}, striker: {bead: unit, velocity: 0.4 m/s}, beads: "
                                    "[{bead: unit}]}\n",
                           "until: 1 s, accuracy: 1e-10");
    const double w = sqrt(gravity / 0.2), turns = 3.25, end = turns * 2 * 3.14159265358979323846 / w;
    struct bead_run *run = start_run(&b, (struct bead_run_settings){.end = end});
    const struct bead_outcome outcome = finish(run, end);
    const struct bead_sample at = sample_at(run, end);
    /* in a head-on collision the common motion of two equal balls is that of one pendulum, exactly */
    const double *u = at.field[BEAD_FIELD_DISPLACEMENT], sum = 0.4 / w * sin(w * end);
    assert_near(u[0] + u[1], sum, 1e-9 * 0.4 / w);
    assert_near(u[1] / sum, 1, 1e-3);
    assert_below(outcome.energy_error, 1e-9);
    bead_run_destroy(run);
    release(&b);
}

/* Energy is kept to 1e-9 through many collisions of five and of twenty balls, and the balls move together in the end: the
 * textbook's one that flies alone is an idea, not Hertz's cradle. */
static void cradles_keep_their_energy(void **state)
{
    (void)state;
    for (int count = 4; count <= 19; count += 15) {
        char text[300];
        snprintf(text, sizeof text,
                 MATERIAL "chain: {" UNIT "cradle: {length: 20 cm}, striker: {bead: unit, velocity: 0.4 m/s}, beads: [{bead: unit, "
                          "count: %d}]}\n",
                 count);
        struct built b = build(text, "until: 2 s, accuracy: 1e-10");
        struct bead_run *run = start_run(&b, (struct bead_run_settings){.end = 2, .budget = true});
        const struct bead_outcome outcome = finish(run, 2);
        assert_below(outcome.energy_error, 1e-9);
        const struct bead_budget *budget = sample_at(run, 2).budget;
        assert_near((budget->kinetic + budget->contacts + budget->gravity) / outcome.energy_start, 1, 1e-9);
        assert_true(budget->springs == 0 && budget->gravity > 0);
        bead_run_destroy(run);
        release(&b);
    }
}

/* Three balls touch: the velocity of each before they swing back is that of a row without pendulums (numbers of an independent
 * program), as a collision takes a thousandth of the period. */
static void three_balls_part_as_without_strings(void **state)
{
    (void)state;
    static const double after[] = {-0.07095, 0.07640, 0.99455};
    struct built b =
        build(MATERIAL "chain: {" UNIT "cradle: {length: 1 km}, striker: {bead: unit, velocity: 1 m/s}, beads: [{bead: unit, "
                       "count: 2}]}\n",
              "until: 2 ms, accuracy: 1e-9");
    struct bead_run *run = start_run(&b, (struct bead_run_settings){.end = 2e-3});
    run_until(run, 1e-3);
    const struct bead_sample at = sample_at(run, 1e-3);
    for (int j = 0; j < 3; j++)
        assert_near(at.field[BEAD_FIELD_VELOCITY][j], after[j], 1e-5);
    bead_run_destroy(run);
    release(&b);
}

/* The order of the method holds where contacts open and close between beads with stiff springs: a tenth of the tolerance brings
 * at least the error's third. */
static void errors_shrink_with_the_tolerance(void **state)
{
    (void)state;
    static const char *const accuracy[] = {"until: 1 ms, accuracy: 1e-7", "until: 1 ms, accuracy: 1e-9"};
    double error[2];
    for (int i = 0; i < 2; i++) {
        struct built b =
            build(MATERIAL "chain: {" UNIT "striker: {bead: unit, velocity: 1 m/s, spring: 1e6 N/m}, beads: [{bead: unit, "
                           "count: 9, spring: 1e6 N/m}]}\n",
                  accuracy[i]);
        struct bead_run *run = start_run(&b, (struct bead_run_settings){.end = 1e-3});
        error[i] = finish(run, 1e-3).energy_error;
        bead_run_destroy(run);
        release(&b);
    }
    assert_below(error[0], 1e-5);
    assert_below(error[1], error[0] / 9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lone_beads_are_oscillators),       cmocka_unit_test(two_balls_swap_for_ever),
        cmocka_unit_test(cradles_keep_their_energy),        cmocka_unit_test(three_balls_part_as_without_strings),
        cmocka_unit_test(errors_shrink_with_the_tolerance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
