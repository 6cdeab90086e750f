/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of the measures, given forces that are known in closed form: where the chain repeats itself, means over cells, the end of
 * a pulse. */
#include "support.h"

#include "sim/measure/measure_private.h"

static struct bead_places places_of(const char *beads)
{
    char text[512];
    snprintf(text, sizeof text, "chain: {beads: [%s]}\n", beads);
    struct built built = build(text, "until: 1 us");
    const struct bead_places places = bead_places_find(built.chain);
    release(&built);
    return places;
}

/* The stretch that repeats itself reaches up to the last bead: an end of another kind ends it, however long it was. */
static void the_tail_ends_with_the_chain(void **state)
{
    (void)state;
    struct bead_places p = places_of("{bead: large-steel, count: 60}");
    assert_true(p.regular && p.cell == 1 && p.regular_from == 1 && p.links == 60);
    p = places_of("{bead: large-steel, count: 59}, {bead: aluminium}");
    assert_true(!p.regular && p.cell == 1);
    p = places_of("{cell: [large-steel, aluminium], count: 30}");
    assert_true(p.regular && p.cell == 2 && p.regular_from == 1);
    p = places_of("{cell: [large-steel, aluminium], count: 30}, {bead: aluminium}");
    assert_true(!p.regular);
    p = places_of("{cell: [large-steel, aluminium], count: 30}, {bead: large-steel}");
    assert_true(p.regular && p.cell == 2);
    /* Forty other beads before ten dimers. */
    p = places_of("{bead: brass, count: 40, mass: 4 g, radius: 4.76 mm}, {cell: [large-steel, aluminium], count: 10}");
    assert_true(p.regular && p.cell == 2 && p.regular_from == 41 && p.probe == 44);
}

/* Forces whose means over cells of two fall exactly by exp(-rate), while each cell's two differ, the other way round in every
 * second cell: the mean of one contact and that of the cell before would scatter by a tenth. */
static void decay_is_that_of_the_mean_over_cells(void **state)
{
    (void)state;
    static const double rate = 2.5e-3;
    struct built built = build("chain: {beads: [{cell: [large-steel, aluminium], count: 60}]}\n", "until: 1 us");
    struct bead_message msg = {""};
    struct bead_measures *m;
    assert_int_equal(bead_measures_create(built.chain, &m, &msg), BEAD_OK);
    enum { MARGIN = 5 }; /* contacts left out at the beginning: cells are counted from there */
    for (size_t k = 0; k < bead_chain_contacts(built.chain); k++) {
        const size_t cell = (k + 2 - MARGIN % 2) / 2, first = (k + 2 - MARGIN % 2) % 2 == 0;
        const double differ = (cell % 2 ? 0.1 : -0.1) * (first ? 1 : -1);
        m->pulses->track[k].count = 1;
        m->pulses->track[k].pulse[0] = (struct bead_pulse){10 * exp(-rate * 2 * (double)cell) * (1 + differ), 1e-5 * (double)k};
    }
    const struct bead_decay_found found = bead_decay_find(m, NULL);
    assert_near(found.rate, rate, 1e-13);
    assert_below(found.error, 1e-12);
    assert_true(found.seen && found.first >= MARGIN && (found.first - MARGIN) % 2 == 0);
    bead_measures_destroy(m);
    release(&built);
}

/* A trace at the probe of two bells, `apart` in units of their width. */
static struct bead_pulse_found two_bells(const struct built *built, double second, double apart)
{
    enum { COUNT = 1200 };
    static const double spacing = 1e-7, width = 5e-6;
    struct bead_message msg = {""};
    struct bead_measures *m;
    assert_int_equal(bead_measures_create(built->chain, &m, &msg), BEAD_OK);
    const size_t beads = bead_chain_beads(built->chain), probe = m->places.probe;
    double *zeros = calloc(beads, sizeof *zeros), *force = calloc(beads, sizeof *force);
    struct bead_sample sample = {.active = beads};
    for (int f = 0; f < BEAD_FIELD_STRAIN; f++)
        sample.field[f] = zeros;
    sample.field[BEAD_FIELD_CONTACT_FORCE] = force;
    for (size_t i = 0; i < COUNT; i++) {
        sample.time = spacing * (double)i;
        const double x = sample.time / width - 6;
        force[probe] = 20 * (exp(-x * x) + second * exp(-(x - apart) * (x - apart)));
        force[probe + 1] = force[probe]; /* the trace lasts three times its rise beyond this one's maximum */
        assert_int_equal(bead_measures_feed(m, &sample, &msg), BEAD_OK);
    }
    const struct bead_pulse_found found = bead_trace_read(m);
    bead_measures_destroy(m);
    free(zeros);
    free(force);
    return found;
}

/* Momentum is the integral of the force over the pulse, sqrt(pi) w F for a bell. The pulse lasts to the first minimum below a
 * twentieth of its maximum: with a dip to .3 of it both bells are one pulse, with one to .0004 the first is a pulse of its own. */
static void a_pulse_lasts_to_a_deep_minimum(void **state)
{
    (void)state;
    struct built built = build("chain: {beads: [{bead: large-steel, count: 60}]}\n", "until: 1 us");
    const double bell = sqrt(acos(-1)) * 5e-6 * 20;
    struct bead_pulse_found found = two_bells(&built, 0.4, 2.4);
    assert_near(found.momentum, 1.4 * bell, 1e-6 * bell);
    assert_near(found.force, 20, 0.03 * 20);
    found = two_bells(&built, 0.4, 5.6);
    assert_near(found.momentum, bell, 2e-4 * bell);
    assert_near(found.force, 20, 1e-4 * 20);
    assert_near(found.force_time[0], 2 * 5e-6 * sqrt(log(2)), 1e-4 * 5e-6);
    assert_near(found.force_time[1], 2 * 5e-6 * sqrt(log(100)), 1e-3 * 5e-6);
    release(&built);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_tail_ends_with_the_chain),
                                       cmocka_unit_test(decay_is_that_of_the_mean_over_cells),
                                       cmocka_unit_test(a_pulse_lasts_to_a_deep_minimum)};
    return cmocka_run_group_tests_name("measure_parts", tests, NULL, NULL);
}
