/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statistics of many chains: summaries, thresholds, decay, participation. */
#include "support.h"

#include "sim/statistics/statistics.h"

static void summaries(void **state)
{
    (void)state;
    double values[] = {4, 1, 3, 2, 10};
    struct bead_summary s;
    bead_summary_of(values, 5, &s);
    assert_near(s.mean, 4, 1e-15);
    assert_near(s.median, 3, 0);
    assert_near(s.quartile[0], 2, 0);
    assert_near(s.quartile[1], 4, 0);
    assert_near(s.deviation, sqrt(12.5), 1e-14);
    assert_near(s.standard_error, sqrt(2.5), 1e-14);
    /* Of equal steps, quantiles are where a rule would have them. */
    for (size_t n = 2; n <= 5; n++) {
        for (size_t i = 0; i < n; i++)
            values[i] = 2 * (double)(n - 1 - i);
        bead_summary_of(values, n, &s);
        const double length = 2 * (double)(n - 1);
        assert_true(s.low == 0 && s.high == length && s.median == length / 2);
        assert_true(s.quartile[0] == length / 4 && s.quartile[1] == 3 * length / 4);
    }
    values[0] = 1;
    bead_summary_of(values, 1, &s);
    assert_true(s.mean == 1 && s.median == 1 && isnan(s.standard_error));
    bead_summary_of(values, 0, &s);
    assert_true(isnan(s.mean) && isnan(s.median));
}

/* An exponential to its length, a power law beyond. */
static double known_decay(size_t place)
{
    double x = (double)place;
    return place <= 103 ? -x / 103 : -1 - 0.61 * log(x / 103);
}

/* Each of five values is off by at most its own part: where the sorted ends of all values lie. */
static void quantiles_know_their_errors(void **state)
{
    (void)state;
    const double values[] = {4, 2, 10, 1, 3}, off[] = {0.25, 3, 1, 0.5, 0.125}, unknown[] = {0.25, 3, NAN, 0.5, 0.125};
    double room[5];
    struct bead_summary u;
    bead_summary_uncertainty(values, off, 5, room, &u);
    assert_true(u.mean == 4.875 / 5);
    assert_true(u.low == 2);           /* 2 less 3 instead of 1 */
    assert_true(u.high == 1);          /* 10 and 1 */
    assert_true(u.median == 1.25);     /* 1.5, 3.125, 4.25, 5, 11 instead of 1, 2, 3, 4, 10 */
    assert_true(u.quartile[0] == 1.5); /* -1, .5, 2.875, 3.75, 9 */
    assert_true(u.quartile[1] == 1);
    bead_summary_uncertainty(values, unknown, 5, room, &u);
    assert_true(isnan(u.mean) && isnan(u.low) && isnan(u.median) && isnan(u.quartile[0]));
}

static void decay_of_known_laws(void **state)
{
    (void)state;
    double logs[900];
    struct bead_decay decay;
    for (size_t i = 0; i < 900; i++)
        logs[i] = known_decay(i);
    assert_int_equal(bead_decay_reach(logs, 900, 10, 1), 103);
    assert_int_equal(bead_decay_reach(logs, 80, 10, 1), 79);
    bead_decay_fit(logs, 900, 10, 103, &decay);
    assert_near(decay.length, 103, 1e-9);
    assert_near(decay.exponent, -0.61, 1e-12);
    assert_near(decay.length_offset, 0, 1e-12);
    assert_near(decay.exponent_offset, -1 + 0.61 * log(103), 1e-12);
    assert_true(decay.first == 10 && decay.last == 103 && isnan(decay.length_error) && isnan(decay.exponent_error));
    logs[50] = -INFINITY; /* left out */
    bead_decay_fit(logs, 900, 10, 103, &decay);
    assert_near(decay.length, 103, 1e-9);
    bead_decay_fit(logs, 800, 10, 103, &decay); /* not to eight times as far */
    assert_true(isnan(decay.exponent));
    memset(logs, 0, sizeof logs);
    bead_decay_fit(logs, 900, 10, 899, &decay);
    assert_true(isinf(decay.length));
}

/* Rows of slopes spread evenly by 10 % about the mean: the rate's error is the deviation of a mean, and the energy's range is that
 * of the force. */
static void errors_of_decay(void **state)
{
    (void)state;
    enum { ROWS = 50, PLACES = 300 };
    static double force[ROWS][PLACES], energy[ROWS][PLACES];
    struct bead_message msg = {""};
    struct bead_decay of_force, of_energy, again;
    double squares = 0;
    for (size_t i = 0; i < ROWS; i++) {
        double off = 0.2 * ((double)i / (ROWS - 1) - 0.5);
        squares += off * off;
        for (size_t p = 0; p < PLACES; p++) {
            force[i][p] = -(1 + off) * (double)p / 103;
            energy[i][p] = 5.0 / 3 * force[i][p];
        }
    }
    struct bead_decay_profiles profiles = {force[0], energy[0], ROWS, PLACES, 10, 2};
    assert_int_equal(bead_decay_of(&profiles, 1000, 3, &of_force, &of_energy, &msg), BEAD_OK);
    double error = 103 * sqrt(squares) / ROWS;
    assert_near(of_force.length, 103, 1e-9);
    assert_near(of_force.length_error, error, 0.1 * error);
    assert_near(of_energy.length, 0.6 * of_force.length, 1e-9);
    assert_near(of_energy.length_error, 0.6 * of_force.length_error, 1e-9);
    assert_true(of_force.last == 103 && of_energy.last == 103); /* the mean of places 103 and 104 */
    assert_int_equal(bead_decay_of(&profiles, 1000, 3, &again, &of_energy, &msg), BEAD_OK);
    assert_memory_equal(&again, &of_force, sizeof again);
    profiles.rows = 1;
    assert_int_equal(bead_decay_of(&profiles, 1000, 3, &of_force, &of_energy, &msg), BEAD_OK);
    assert_true(isnan(of_force.length_error) && isfinite(of_force.length));
}

static void participation(void **state)
{
    (void)state;
    const double one[] = {0, 5, 0}, equal[] = {1e-200, 1e-200, 1e-200, 1e-200}, none[] = {0, 0}, uneven[] = {3, 1};
    assert_near(bead_participation(one, 3), 1, 0);
    assert_near(bead_participation(equal, 4), 4, 1e-12);
    assert_near(bead_participation(uneven, 2), 1.6, 1e-12);
    assert_true(isnan(bead_participation(none, 2)));
}

/* Means of 400 configurations of 50 dimers by M = 0, .04, ..., 1, from another program, whose threshold is .584 +- .017. */
static const double means_of_50[] = {.328177, .329039, .329979, .325338, .330017, .329453, .333387, .329042, .335009,
                                     .339408, .347098, .353277, .361271, .373536, .384636, .398498, .423863, .446375,
                                     .474002, .514129, .554851, .613890, .680233, .764354, .870346, 1};

static void threshold_of_known_means(void **state)
{
    (void)state;
    enum { COUNT = sizeof means_of_50 / sizeof *means_of_50 };
    struct bead_group_results groups[COUNT];
    struct bead_threshold t;
    struct bead_message msg = {""};
    for (size_t i = 0; i < COUNT; i++)
        groups[i] = (struct bead_group_results){(double)i / 25, &means_of_50[i], 1};
    assert_int_equal(bead_threshold_fit(groups, COUNT, bead_threshold_info_named("law"), 10, 1, &t, &msg), BEAD_OK);
    assert_near(t.plateau, 0.329, 0.0005);
    assert_near(t.critical, 0.584, 0.002);
    assert_true(t.critical_error == 0 && t.low > 0.8 && t.high == 0.96); /* of one value each, bootstrap draws the same */
    assert_int_equal(bead_threshold_fit(groups, COUNT, bead_threshold_info_named("half"), 0, 1, &t, &msg), BEAD_OK);
    assert_near(t.critical, 0.872, 0.002);
    /* Without a plateau, or without what rises above it, there is no threshold. */
    assert_int_equal(bead_threshold_fit(groups + 10, COUNT - 10, bead_threshold_info_named("law"), 0, 1, &t, &msg),
                     BEAD_ERROR_NUMBERS);
    assert_int_equal(bead_threshold_fit(groups, 4, bead_threshold_info_named("law"), 0, 1, &t, &msg), BEAD_ERROR_NUMBERS);
    assert_null(bead_threshold_info_named("lore"));
}

enum { MOVING = 6 };
static const double moving[MOVING] = {0.33, 0.35, 0.36, 0.44, 0.62, 0.85}, moving_at[MOVING] = {0, 0.1, 0.4, 0.7, 0.88, 0.96};

/* M_c, if mean g is larger by off[g] of itself. */
static double critical_if(const char *way, const double off[MOVING])
{
    struct bead_group_results groups[MOVING];
    struct bead_threshold t;
    struct bead_message msg = {""};
    double moved[MOVING];
    for (size_t g = 0; g < MOVING; g++) {
        moved[g] = moving[g] * (1 + off[g]);
        groups[g] = (struct bead_group_results){moving_at[g], &moved[g], 1};
    }
    assert_int_equal(bead_threshold_fit(groups, MOVING, bead_threshold_info_named(way), 0, 1, &t, &msg), BEAD_OK);
    assert_true(t.critical > 0.1 && t.critical < 1);
    return t.critical;
}

/* The furthest that M_c moves if each mean is off by `part`, either way, and all by `common`: of all signs that there are. */
static double furthest(const char *way, double part, double common)
{
    const double exact = critical_if(way, (double[MOVING]){0});
    double most = 0;
    for (unsigned signs = 0; signs < 2u << MOVING; signs++) {
        double off[MOVING];
        for (size_t g = 0; g < MOVING; g++)
            off[g] = (signs >> g & 1 ? part : -part) + (signs >> MOVING ? common : -common);
        most = fmax(most, fabs(critical_if(way, off) - exact));
    }
    return most;
}

/* To first order: with 1e-4 that is one part in a hundred at most. */
static void threshold_moves_with_the_means(void **state)
{
    (void)state;
    struct bead_group_results groups[MOVING];
    for (size_t g = 0; g < MOVING; g++)
        groups[g] = (struct bead_group_results){moving_at[g], &moving[g], 1};
    const struct bead_threshold_info *way;
    for (size_t i = 0; (way = bead_threshold_info(i)); i++) {
        for (int common = 0; common < 2; common++) {
            struct bead_message msg = {""};
            double uncertainty;
            assert_int_equal(bead_threshold_uncertainty(groups, MOVING, way, 1e-4, 3e-4 * common, &uncertainty, &msg), BEAD_OK);
            assert_near(uncertainty / furthest(way->name, 1e-4, 3e-4 * common), 1, 0.01);
        }
    }
    double none;
    struct bead_message msg = {""};
    assert_int_equal(bead_threshold_uncertainty(groups + 3, MOVING - 3, bead_threshold_info(0), 1e-4, 0, &none, &msg), BEAD_OK);
    assert_true(isnan(none));
}

/* The bootstrap's deviation of the plateau is that of a mean. */
static void bootstrap_errors(void **state)
{
    (void)state;
    enum { EACH = 100 };
    static double low[EACH], high[EACH], one[1] = {1};
    for (size_t i = 0; i < EACH; i++) {
        low[i] = 0.3 + 0.02 * ((double)i / EACH - 0.495);
        high[i] = 0.7 + 0.02 * ((double)i / EACH - 0.495);
    }
    const struct bead_group_results groups[] = {{0, low, EACH}, {0.9, high, EACH}, {1, one, 1}};
    struct bead_threshold t, again;
    struct bead_message msg = {""};
    assert_int_equal(bead_threshold_fit(groups, 3, bead_threshold_info_named("law"), 2000, 5, &t, &msg), BEAD_OK);
    double error = 0.02 / sqrt(12) / sqrt(EACH);
    assert_near(t.plateau_error, error, 0.1 * error);
    assert_near(t.rate_error, error / 0.7 / 0.19, 0.1 * error / 0.7 / 0.19);
    assert_int_equal(bead_threshold_fit(groups, 3, bead_threshold_info_named("law"), 2000, 5, &again, &msg), BEAD_OK);
    assert_memory_equal(&t, &again, sizeof t);
}

/* Student's tails have closed forms for four degrees of freedom: t is left by 1 - sin a (1 + cos^2 a / 2), tan a = t / 2. Of a
 * sample of half of all, the standard error counts by sqrt(1/2); one of all is exact, and one number of several says nothing. */
static void means_are_known_from_samples(void **state)
{
    (void)state;
    double values[] = {1, 2, 4, 7, 11};
    struct bead_summary s, one;
    bead_summary_of(values, 5, &s);
    bead_summary_of(values, 1, &one);
    const double t = bead_sample_error(&s, 1000000000) / s.standard_error, a = atan(t / 2);
    assert_near(1 - sin(a) * (1 + 0.5 * cos(a) * cos(a)), 0.0013, 0.0003);
    assert_near(bead_sample_error(&s, 10), t * s.standard_error * sqrt(0.5), 1e-6 * t);
    assert_true(bead_sample_error(&s, 5) == 0 && bead_sample_error(&one, 1) == 0);
    assert_true(isnan(bead_sample_error(&one, 2)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(means_are_known_from_samples),
        cmocka_unit_test(summaries),
        cmocka_unit_test(quantiles_know_their_errors),
        cmocka_unit_test(decay_of_known_laws),
        cmocka_unit_test(errors_of_decay),
        cmocka_unit_test(participation),
        cmocka_unit_test(threshold_of_known_means),
        cmocka_unit_test(threshold_moves_with_the_means),
        cmocka_unit_test(bootstrap_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
