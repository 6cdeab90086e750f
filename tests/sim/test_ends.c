/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Output ends with the chain: no value is written after it, and every value before is written. */
#include "chains.h"

#include "sim/adjoint/record.h"
#include "sim/chain/chain_data.h"
#include "sim/equation/fput_string.h"

enum { MOST = 64 };
static const double guard = -12345.678;

static void fill(double *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        values[i] = guard;
}

static size_t written(const double *values, size_t count)
{
    size_t last = 0;
    for (size_t i = 0; i < count; i++)
        last = values[i] != guard ? i + 1 : last;
    return last;
}

/* A wall takes the last bead's force, a free end none: F = A d^(3/2) between them, and a bead feels the mean of both sides. */
static void derived_forces_end_with_the_last_bead(void **state)
{
    (void)state;
    static const char *const chains[] = {"chain: {beads: [{bead: large-steel, count: 6}], wall: rigid}\n",
                                         "chain: {beads: [{bead: large-steel, count: 6}]}\n"};
    for (size_t c = 0; c < 2; c++) {
        struct built built = build(chains[c], "until: 1 us");
        double u[7], contact[MOST], bead[MOST];
        const double *stiffness = bead_chain_stiffness(built.chain);
        assert_int_equal(bead_chain_beads(built.chain), 7);
        for (size_t k = 0; k < 7; k++)
            u[k] = 1e-6 * (double)(7 - k);
        fill(contact, MOST);
        fill(bead, MOST);
        bead_derive_forces(built.chain, u, contact, bead);
        assert_int_equal(written(contact, MOST), 7);
        assert_int_equal(written(bead, MOST), 7);
        for (size_t k = 0; k < 6; k++)
            assert_near(contact[k], stiffness[k] * 1e-9, 1e-12 * stiffness[k] * 1e-9);
        assert_near(contact[6], c == 0 ? stiffness[6] * 1e-9 : 0, 1e-12 * stiffness[5] * 1e-9);
        assert_near(bead[0], 0.5 * contact[0], 1e-15);
        assert_near(bead[6], 0.5 * (contact[5] + contact[6]), 1e-15);
        release(&built);
    }
}

/* u_j = A sin(pi k (j + 1) / (n + 1)) between fixed ends, at rest. */
static void strings_start_with_their_masses(void **state)
{
    (void)state;
    enum { MASSES = 9 };
    const struct bead_equation_spec spec = {
        .points = MASSES, .ends = BEAD_ENDS_FIXED, .start = BEAD_START_MODE, .mode = 2, .amplitude = 0.5};
    struct bead_string string = {.spec = &spec, .masses = MASSES, .springs = MASSES + 1, .stretch = 1};
    double u[MOST], v[MOST];
    fill(u, MOST);
    fill(v, MOST);
    bead_string_start(&string, u, v);
    assert_int_equal(written(u, MOST), MASSES);
    assert_int_equal(written(v, MOST), MASSES);
    for (size_t j = 0; j < MASSES; j++) {
        assert_near(u[j], 0.5 * sin(acos(-1) * 2 * (double)(j + 1) / (MASSES + 1)), 1e-15);
        assert_true(v[j] == 0);
    }
}

/* Back at its first step from its last one, a stepper is as it was then: beads that the wave had not reached are at rest again. */
static void records_bring_back_rest(void **state)
{
    (void)state;
    struct setup x;
    struct bead_message msg = {""};
    struct bead_record record = {0};
    make_problem(&x, 1, 0.44);
    struct bead_stepper *s = make_stepper(&x, "rkn8", "portable", false);
    const size_t beads = bead_chain_beads(x.chain);
    double *first = calloc(3 * beads, sizeof *first);
    size_t steps = 0, active = 0;
    for (; steps < 300; steps++) {
        bead_stepper_advance_by(s, 0.5e-6, 0.5e-6 * (double)(steps + 1));
        assert_int_equal(bead_record_add(&record, s, &msg), BEAD_OK);
        if (steps > 0)
            continue;
        active = s->active;
        memcpy(first, s->end.u, beads * sizeof *first);
        memcpy(first + beads, s->end.v, beads * sizeof *first);
        memcpy(first + 2 * beads, s->end.a, beads * sizeof *first);
    }
    const size_t reached = s->active;
    assert_true(reached >= active + 8);
    bead_record_load(&record, 0, s);
    assert_memory_equal(s->end.u, first, reached * sizeof *first);
    assert_memory_equal(s->end.v, first + beads, reached * sizeof *first);
    assert_memory_equal(s->end.a, first + 2 * beads, reached * sizeof *first);
    for (size_t k = active; k < reached; k++)
        assert_true(s->start.u[k] == 0 && s->start.v[k] == 0 && s->start.a[k] == 0);
    bead_record_free(&record);
    free(first);
    bead_stepper_destroy(s);
    bead_chain_destroy(x.chain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(derived_forces_end_with_the_last_bead),
                                       cmocka_unit_test(strings_start_with_their_masses),
                                       cmocka_unit_test(records_bring_back_rest)};
    return cmocka_run_group_tests_name("ends", tests, NULL, NULL);
}
