/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far energy has spread, for energies at known places: moments, participation and front by hand, exponents of power laws, their
 * standard errors from the correlation. */
#include "support.h"

#include "sim/measure/spreading.h"

enum { BEADS = 401, ORIGIN = 200, TIMES = 300 };

struct spread {
    struct built built;
    struct bead_spreading s;
    double energy[BEADS];
};

static void begin(struct spread *t, const char *more)
{
    char text[300];
    struct bead_message msg = {""};
    snprintf(text, sizeof text, "chain: {beads: [{bead: large-steel, count: 400}]%s}\n", more);
    t->built = build(text, "until: 1 us");
    assert_int_equal(bead_spreading_begin(&t->s, t->built.chain, TIMES, &msg), BEAD_OK);
    memset(t->energy, 0, sizeof t->energy);
}

static void end(struct spread *t)
{
    bead_spreading_free(&t->s);
    release(&t->built);
}

/* The energies at a time; afterwards there are none. */
static void feed(struct spread *t, double time, double numbers[BEAD_SPREADING_NUMBERS])
{
    struct bead_sample sample = {.time = time, .active = BEADS};
    sample.field[BEAD_FIELD_ENERGY] = t->energy;
    bead_spreading_feed(&t->s, &sample, numbers);
    memset(t->energy, 0, sizeof t->energy);
}

static void energies_are_where_they_are(void **state)
{
    (void)state;
    struct spread t;
    double is[BEAD_SPREADING_NUMBERS];
    begin(&t, ", start: [{bead: 200, velocity: 1 m/s}]");
    assert_int_equal(t.s.origin, ORIGIN);
    t.energy[ORIGIN] = 3;
    feed(&t, 0, is);
    assert_true(is[BEAD_SECOND_MOMENT] == 0 && is[BEAD_PARTICIPATION] == 1 && is[BEAD_FRONT] == 0);
    t.energy[ORIGIN - 10] = t.energy[ORIGIN + 10] = 2;
    feed(&t, 1, is);
    assert_true(is[BEAD_SECOND_MOMENT] == 100 && is[BEAD_PARTICIPATION] == 2 && is[BEAD_FRONT] == 10);
    for (int d = -10; d <= 10; d++)
        t.energy[ORIGIN + d] = 1;
    t.energy[ORIGIN + 30] = 2e-5; /* less than a millionth of all, and more */
    t.energy[ORIGIN - 20] = 3e-5;
    feed(&t, 2, is);
    assert_near(is[BEAD_SECOND_MOMENT], (770 + 2e-5 * 900 + 3e-5 * 400) / 21.00005, 1e-12);
    assert_near(is[BEAD_PARTICIPATION], 21.00005 * 21.00005 / (21 + 13e-10), 1e-12);
    assert_true(is[BEAD_FRONT] == 20);
    t.energy[ORIGIN] = 3;
    t.energy[ORIGIN + 1] = 1e-3;
    feed(&t, 3, is);
    assert_near(is[BEAD_SECOND_MOMENT], 1e-3 / 3.001, 1e-15);
    t.energy[ORIGIN + 1] = 1;
    feed(&t, 0, is);
    assert_int_equal(t.s.count, 3); /* nothing has a logarithm at time 0 */
    assert_true(isnan(bead_spreading_exponent(&t.s, BEAD_SECOND_MOMENT).slope));
    end(&t);
}

/* The excited bead is the striker, or the middle one of those that start in motion. */
static void the_origin_is_what_was_excited(void **state)
{
    (void)state;
    static const struct {
        const char *more;
        size_t origin;
    } cases[] = {{"", 0},
                 {", start: [{bead: 7, velocity: 1 m/s}, {bead: 90, velocity: 1 m/s}, {bead: 300, velocity: 1 m/s}], striker: "
                  "{velocity: 0 m/s}",
                  90}};
    for (size_t c = 0; c < 2; c++) {
        struct spread t;
        begin(&t, cases[c].more);
        assert_int_equal(t.s.origin, cases[c].origin);
        end(&t);
    }
}

/* Pairs of beads t apart from the origin, and 2 t + 1 beads with equal energies: powers of t, from 7 % of the last time on. */
static void powers_have_their_exponents(void **state)
{
    (void)state;
    struct spread t;
    double is[BEAD_SPREADING_NUMBERS];
    begin(&t, ", start: [{bead: 200, velocity: 1 m/s}]");
    for (int time = 1; time <= 200; time++) {
        const int apart = time < 14 ? 150 : time; /* before the window anything may be */
        t.energy[ORIGIN - apart] = t.energy[ORIGIN + apart] = 1;
        feed(&t, time, is);
        const struct bead_line gamma = bead_spreading_exponent(&t.s, BEAD_SECOND_MOMENT);
        if (time < 8)
            assert_true(isnan(gamma.slope) && isnan(gamma.error));
    }
    const struct bead_line gamma = bead_spreading_exponent(&t.s, BEAD_SECOND_MOMENT),
                           eta = bead_spreading_exponent(&t.s, BEAD_PARTICIPATION);
    assert_near(gamma.slope, 2, 1e-12);
    assert_near(gamma.offset, 0, 1e-11);
    assert_below(gamma.error, 1e-12);
    assert_near(eta.slope, 0, 1e-12);
    assert_near(eta.offset, log(2), 1e-12);
    end(&t);
}

/* P = 2 t + 1 is no power: the slope's error is slope sqrt((1 / r^2 - 1) / (n - 2)), with the correlation r of the logarithms. */
static void errors_follow_from_the_correlation(void **state)
{
    (void)state;
    struct spread t;
    double is[BEAD_SPREADING_NUMBERS], n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    begin(&t, ", start: [{bead: 200, velocity: 1 m/s}]");
    for (int time = 1; time <= 99; time++) {
        for (int d = -time; d <= time; d++)
            t.energy[ORIGIN + d] = 0.5;
        feed(&t, time, is);
        if (time < 7) /* 7 % of 99 is 6.93 */
            continue;
        const double a = log(time), b = log(2 * time + 1);
        n++;
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
        yy += b * b;
    }
    const double slope = (n * xy - x * y) / (n * xx - x * x), r = (n * xy - x * y) / sqrt((n * xx - x * x) * (n * yy - y * y));
    const struct bead_line eta = bead_spreading_exponent(&t.s, BEAD_PARTICIPATION);
    assert_near(eta.slope, slope, 1e-10);
    assert_near(eta.error, slope * sqrt((1 / (r * r) - 1) / (n - 2)), 1e-7 * eta.error);
    assert_near(eta.offset, (y - slope * x) / n, 1e-10);
    end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energies_are_where_they_are), cmocka_unit_test(the_origin_is_what_was_excited),
        cmocka_unit_test(powers_have_their_exponents), cmocka_unit_test(errors_follow_from_the_correlation)};
    return cmocka_run_group_tests_name("spreading", tests, NULL, NULL);
}
