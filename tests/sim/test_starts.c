/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains in which beads other than the striker move at first, and chains with gaps. */
#include "support.h"

/* The mean contact force of each pulse is unimodal: the time of its largest value after `from`, by a parabola through samples. */
struct top {
    double time, force;
};

/* Largest force of contact `k` from `from` to `until`. */
static struct top top_of(const struct built *built, size_t k, double from, double until)
{
    const double every = (until - from) / 4000;
    struct bead_run *run = start_run(built, (struct bead_run_settings){.end = until});
    double before[2] = {0, 0};
    struct top top = {NAN, 0};
    for (double t = from; t < until; t += every) {
        run_until(run, fmin(t, until));
        const double force = sample_at(run, t).field[BEAD_FIELD_CONTACT_FORCE][k];
        if (before[1] > top.force && before[1] >= force && before[1] >= before[0]) {
            const double bend = before[0] - 2 * before[1] + force, slope = 0.5 * (before[0] - force);
            top = (struct top){t - every + every * slope / bend, before[1] - 0.5 * slope * slope / bend};
        }
        before[0] = before[1];
        before[1] = force;
    }
    bead_run_destroy(run);
    return top;
}

/* Spheres of mass 1 g; contacts A d^1.5 with A = 1e9. Times are in units of (m^2 / (A^2 v))^(1/5), forces of (A^2 m^3 v^6)^(1/5).
 */
#define MATERIAL "materials: {unit: {mass: 1 g, radius: 5 mm, modulus: 1 GPa, poisson: 0.3}}\n"
#define UNIT     "law: {power: 1.5, coefficient: 1e9}, "
static const double unit_time = 1.5848931924611134e-05, mass = 1e-3;

/* Two equal solitary waves pass each other. The reference, a program of fourth order with steps of .005 and .01 that shares nothing
 * with this one, has in units of the incident wave: 2.2383756 in the contact where they meet, which is that at a rigid wall;
 * .9982193 of the force left 20 contacts behind it, and this wave earlier by .4168154 units of time. */
static void solitary_waves_pass(void **state)
{
    (void)state;
    static const double shift = -0.4168153, left = 0.998219293, meeting = 2.23837563;
    struct built one =
        build(MATERIAL "chain: {" UNIT "striker: {bead: unit, velocity: 1 m/s}, beads: [{bead: unit, count: 119}]}\n",
              "until: 2 ms, accuracy: 1e-10");
    struct built two = build(MATERIAL "chain: {" UNIT "striker: {bead: unit, velocity: 1 m/s}, beads: [{bead: unit, count: 119}], "
                                      "start: [{bead: last, velocity: -1 m/s}]}\n",
                             "until: 2 ms, accuracy: 1e-10");
    const struct top alone = top_of(&one, 80, 90 * unit_time, 103 * unit_time);
    const struct top passed = top_of(&two, 80, 90 * unit_time, 103 * unit_time);
    const struct top middle = top_of(&two, 59, 65 * unit_time, 78 * unit_time);
    assert_near((passed.time - alone.time) / unit_time, shift, 1e-5);
    assert_near(passed.force / alone.force, left, 1e-7);
    assert_near(middle.force / alone.force, meeting, 1e-6);
    release(&one);
    release(&two);
}

/* What two strikes bring in, the chain keeps: momentum to rounding, also of unequal ones. */
static void momentum_of_two_strikes_is_kept(void **state)
{
    (void)state;
    struct built b = build(MATERIAL "chain: {" UNIT "beads: [{bead: unit, count: 60}], striker: {bead: unit, mass: 3 g}, "
                                    "start: [{bead: 0, velocity: 0.7 m/s}, {bead: last, velocity: -1 m/s}, {bead: [20, 22], "
                                    "velocity: 0.1 m/s, displacement: 1 um}]}\n",
                           "until: 1 ms");
    struct bead_run *run = start_run(&b, (struct bead_run_settings){.end = 1e-3});
    struct bead_outcome outcome;
    run_until(run, 1e-3);
    bead_run_finish(run, 1e-3, &outcome);
    const double start = 3 * mass * 0.7 - mass + 3 * mass * 0.1;
    assert_near(outcome.momentum_start, start, 1e-18);
    assert_near(outcome.momentum_end, start, 1e-15 * mass * 60);
    /* one contact is compressed by 1 um, the other two that are displaced alike store nothing */
    const double energy = 0.5 * mass * (3 * 0.49 + 1 + 3 * 0.01) + 0.4 * 1e9 * pow(1e-6, 2.5);
    assert_near(outcome.energy_start / energy, 1, 1e-14);
    assert_near(bead_chain_energy(b.chain) / energy, 1, 1e-14);
    assert_below(outcome.energy_error, 1e-6);
    bead_run_destroy(run);
    release(&b);
}

/* A strike from the right is one from the left in the mirror, bit for bit in what does not depend on the order of sums. */
static void strikes_from_both_sides_are_alike(void **state)
{
    (void)state;
    struct built left = build(
        MATERIAL "chain: {" UNIT "striker: {bead: unit}, beads: [{bead: unit, count: 30}], start: [{bead: 0, velocity: 1 m/s}]}\n",
        "until: 0.4 ms, accuracy: 1e-9");
    struct built right =
        build(MATERIAL "chain: {" UNIT
                       "striker: {bead: unit}, beads: [{bead: unit, count: 30}], start: [{bead: last, velocity: -1 m/s}]}\n",
              "until: 0.4 ms, accuracy: 1e-9");
    struct bead_run *a = start_run(&left, (struct bead_run_settings){.end = 4e-4});
    struct bead_run *b = start_run(&right, (struct bead_run_settings){.end = 4e-4});
    run_until(a, 3e-4);
    run_until(b, 3e-4);
    const struct bead_sample here = sample_at(a, 3e-4), there = sample_at(b, 3e-4);
    for (size_t j = 0; j < 31; j++)
        assert_near(here.field[BEAD_FIELD_VELOCITY][j], -there.field[BEAD_FIELD_VELOCITY][30 - j], 1e-8);
    bead_run_destroy(a);
    bead_run_destroy(b);
    release(&left);
    release(&right);
}

/* Centres of different beads are the sum of their radii apart; positions do not include the effect of a precompression. */
static void unlike_beads_touch(void **state)
{
    (void)state;
    static const char text[] = "materials:\n"
                               "  small: {mass: 1 g, radius: 2 mm, modulus: 1 GPa, poisson: 0.3}\n"
                               "  large: {mass: 8 g, radius: 5 mm, modulus: 1 GPa, poisson: 0.3}\n"
                               "chain: {" UNIT "%sbeads: [{cell: [large, small, small], count: 4}]}\n";
    char loose_text[512], tight_text[512];
    snprintf(loose_text, sizeof loose_text, text, "");
    snprintf(tight_text, sizeof tight_text, text, "wall: rigid, precompression: 27 N, ");
    struct built loose = build(loose_text, "until: 1 us"), tight = build(tight_text, "until: 1 us");
    const double *x = bead_chain_position(loose.chain), *pressed = bead_chain_position(tight.chain);
    const double radius[3] = {5e-3, 2e-3, 2e-3};
    for (size_t j = 2; j < bead_chain_beads(loose.chain); j++) { /* 0 is the striker */
        const double apart = radius[(j - 2) % 3] + radius[(j - 1) % 3];
        assert_near(x[j] - x[j - 1], apart, 1e-15);
        assert_near(pressed[j] - pressed[j - 1], apart, 1e-15);
    }
    release(&loose);
    release(&tight);
}

/* Equal beads that are further apart than they are compressed hand the velocity on, one collision at a time: each takes a time that
 * quadrature gives, the flight between has its own. */
static void gaps_make_collisions_of_a_wave(void **state)
{
    (void)state;
    const double gap = 100e-6, v = 1, reduced = 0.5 * mass;
    const double deepest = pow(5 * reduced * v * v / (4 * 1e9), 0.4), contact = 2.9432750 * deepest / v;
    struct built b = build(MATERIAL "chain: {" UNIT "gap: 100 um, striker: {bead: unit, velocity: 1 m/s}, "
                                    "beads: [{bead: unit, count: 10}]}\n",
                           "until: 2 ms, accuracy: 1e-9");
    assert_near(bead_chain_position(b.chain)[10], 9 * (10e-3 + gap), 1e-15);
    struct bead_run *run = start_run(&b, (struct bead_run_settings){.end = 2e-3, .contact_peaks = true});
    struct bead_outcome outcome;
    run_until(run, 2e-3);
    bead_run_finish(run, 2e-3, &outcome);
    for (size_t k = 0; k < 10; k++) {
        assert_near(outcome.contact_peaks[k].value / (1e9 * pow(deepest, 1.5)), 1, 1e-7);
        /* both move on while they touch: the struck bead starts its flight from where the contact has opened */
        const double moved = 0.5 * v * contact, flight = (gap - moved) / v;
        assert_near(outcome.contact_peaks[k].time, contact / 2 + (double)k * (contact + flight), 1e-10);
    }
    const struct bead_sample end = sample_at(run, 2e-3);
    for (size_t j = 0; j < 10; j++)
        assert_near(end.field[BEAD_FIELD_VELOCITY][j], 0, 1e-7);
    assert_near(end.field[BEAD_FIELD_VELOCITY][10], v, 1e-7);
    bead_run_destroy(run);
    release(&b);
}

/* One gap, random gaps: where they are; the same seed gives the same. */
static void gaps_are_where_they_are_said_to_be(void **state)
{
    (void)state;
    struct built one =
        build("chain: {beads: [{bead: brass, radius: 5 mm, count: 4}, {bead: brass, radius: 5 mm, gap: 3 um}]}\n", "");
    const double *d = bead_chain_static_compression(one.chain);
    for (size_t k = 0; k < 4; k++)
        assert_true(d[k] == 0);
    assert_near(d[4], -3e-6, 1e-20);
    struct built random =
        build("chain: {beads: [{bead: large-steel, count: 200, disorder: {gap: uniform 0..10 um, seed: 4}}]}\n", "");
    double sum = 0, least = 1, most = 0;
    d = bead_chain_static_compression(random.chain);
    assert_true(d[0] == 0); /* the striker touches */
    for (size_t k = 1; k < 200; k++) {
        sum -= d[k];
        least = fmin(least, -d[k]);
        most = fmax(most, -d[k]);
    }
    assert_true(least >= 0 && most <= 10e-6 && most > 9e-6 && least < 1e-6);
    assert_near(sum / 199, 5e-6, 3 * 10e-6 / sqrt(12 * 199.0));
    release(&one);
    release(&random);
}

/* A chain that rests on its wall: each contact carries the beads above it, but not yet the striker. */
static void a_standing_chain_carries_its_weight(void **state)
{
    (void)state;
    struct built b = build(MATERIAL "chain: {tilt: 90 deg, wall: rigid, beads: [{bead: unit, count: 6}]}\n", "");
    for (size_t k = 0; k < 7; k++)
        assert_near(bead_chain_static_force(b.chain)[k], (double)k * mass * 9.80665, 1e-12);
    release(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solitary_waves_pass),
        cmocka_unit_test(momentum_of_two_strikes_is_kept),
        cmocka_unit_test(strikes_from_both_sides_are_alike),
        cmocka_unit_test(unlike_beads_touch),
        cmocka_unit_test(gaps_make_collisions_of_a_wave),
        cmocka_unit_test(gaps_are_where_they_are_said_to_be),
        cmocka_unit_test(a_standing_chain_carries_its_weight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
