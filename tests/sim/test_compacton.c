/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The solitary wave of long waves: found where it is, and compared with that of beads, whose speed is known. */
#include "sim/measure/compacton.h"
#include "support.h"

#define BEADS                                                                     \
    "materials: {one: {radius: 0.5 m, mass: 1 kg, modulus: 1 GPa, poisson: 0}}\n" \
    "chain: {law: {power: 1.5, coefficient: 1}, beads: [{bead: one, count: 120}], striker: {bead: one, velocity: 1 m/s}%s}\n"

static struct built equal_beads(const char *more)
{
    char text[600];
    snprintf(text, sizeof text, BEADS, more);
    return build(text, "until: 140 s, accuracy: 1e-8");
}

/* A wave that is one: its place and height to rounding, and sqrt(4/5) F^(1/6) beads a second, as m = A = 1. */
static void a_wave_is_found_again(void **state)
{
    (void)state;
    struct built b = equal_beads("");
    double values[60];
    for (double at = 30; at < 31; at += 0.13) {
        const struct bead_compacton wave = {at, 7.5, NAN};
        struct bead_compacton found;
        for (int i = 0; i < 60; i++)
            values[i] = bead_compacton_at(&wave, i);
        assert_true(bead_compacton_find(b.chain, values, 60, &found));
        assert_near(found.centre, at, 1e-12);
        assert_near(found.height, 7.5, 1e-12);
        assert_near(found.speed, sqrt(0.8) * pow(7.5, 1. / 6), 1e-12);
    }
    release(&b);
}

/* Crests between others are waves; where no force is, between two or without a neighbour, there is none. */
static void without_a_crest_there_is_none(void **state)
{
    (void)state;
    static const double forces[][3] = {{1, 2, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 0}, {0, 0, 0}};
    struct built b = equal_beads("");
    struct bead_compacton found;
    for (size_t i = 0; i < sizeof forces / sizeof *forces; i++)
        assert_int_equal(bead_compacton_find(b.chain, forces[i], 3, &found), i == 0);
    assert_false(bead_compacton_find(b.chain, forces[0], 2, &found));
    release(&b);
}

/* The wave of beads is .905516 / sqrt(.8) times as fast, and nowhere differs by more than a twenty-fifth of its height (measured:
 * 3.5 %). */
static void it_is_near_that_of_beads(void **state)
{
    (void)state;
    struct built b = equal_beads("");
    struct bead_run *run = start_run(&b, (struct bead_run_settings){.end = 130});
    struct bead_compacton found[2];
    for (int i = 0; i < 2; i++) {
        const double t = 80 + 40 * i;
        run_until(run, t);
        const double *forces = sample_at(run, t).field[BEAD_FIELD_CONTACT_FORCE];
        assert_true(bead_compacton_find(b.chain, forces, 119, &found[i]));
        for (int n = 0; n < 119; n++)
            assert_near(forces[n], bead_compacton_at(&found[i], n), 0.04 * found[i].height);
    }
    /* Empirical: off by 2.5e-3. A height found of three samples depends on where the wave is between beads, by 1.4 % from the one
     * time to the other, and the speed is that of its sixth root: .23 %. Other times have other phases. */
    assert_near((found[1].centre - found[0].centre) / 40 / found[1].speed, 0.905516 / sqrt(0.8), 3e-3);
    bead_run_destroy(run);
    release(&b);
}

/* Waves of pressed chains, and of unequal beads, are others. */
static void others_have_none(void **state)
{
    (void)state;
    struct built pressed = equal_beads(", precompression: 1 N"), equal = equal_beads("");
    assert_true(bead_compacton_is_of(equal.chain));
    assert_false(bead_compacton_of_dimers(equal.chain));
    assert_false(bead_compacton_of_dimers(pressed.chain));
    assert_false(bead_compacton_is_of(pressed.chain));
    release(&equal);
    release(&pressed);
    struct built dimer = build("chain: {beads: [{cell: [large-steel, aluminium], count: 9}]}\n", "until: 1 ms");
    struct built trimer = build("chain: {beads: [{cell: [large-steel, 2 aluminium], count: 9}]}\n", "until: 1 ms");
    assert_false(bead_compacton_is_of(dimer.chain));
    assert_true(bead_compacton_of_dimers(dimer.chain));
    assert_false(bead_compacton_of_dimers(trimer.chain));
    release(&dimer);
    release(&trimer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_wave_is_found_again), cmocka_unit_test(without_a_crest_there_is_none),
                                       cmocka_unit_test(it_is_near_that_of_beads), cmocka_unit_test(others_have_none)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
