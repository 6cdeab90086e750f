/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts that open and close: the accuracy that their correction restores, and the states that it must not touch. */
#include "chains.h"

#include "sim/integrate/events_patch.h"
#include "sim/run/peaks.h"

/* Every step halved gains at least 2^5, down to rounding: without the correction it is 2^2.5. */
static void the_order_is_restored(void **state)
{
    (void)state;
    struct table reference = read_table("p3_states.csv", 4);
    struct setup x;
    make_problem(&x, 3, 0.443);
    double before = 0;
    for (double h = 4e-6; h > 0.9e-6; h /= 2) {
        struct bead_stepper *s = run(&x, "rkn8", h, 0.6e-3);
        double error = velocity_error(s, &reference, 0.6e-3);
        if (before > 0)
            assert_below(error, before / 32);
        before = error;
        drop(NULL, s);
    }
    assert_below(before, 1e-12);
    struct bead_stepper *plain = run(&x, "rkn8-plain", 1e-6, 0.6e-3);
    assert_true(velocity_error(plain, &reference, 0.6e-3) > 1e4 * before);
    drop(&x, plain);
    free(reference.value);
}

static void peaks_and_energy(void **state)
{
    (void)state;
    static const struct {
        int problem;
        double until, peaks;
        const char *reference;
    } cases[] = {{1, 0.8e-3, 1e-10, "p1_peaks.csv"}, {2, 1.5e-3, 1e-10, "p2_peaks.csv"}, {3, 3e-3, 1e-10, "p3_peaks.csv"}};
    for (size_t i = 0; i < 3; i++) {
        struct table reference = read_table(cases[i].reference, 3);
        struct setup x;
        make_problem(&x, cases[i].problem, 0.443);
        struct bead_stepper *s = make_stepper(&x, "rkn8", NULL, false);
        struct bead_peaks *peaks;
        struct bead_message msg = {""};
        assert_int_equal(bead_peaks_create(s, false, (struct bead_span){0, SIZE_MAX}, &peaks, &msg), BEAD_OK);
        double energy = bead_stepper_energy(s, &s->end), drift = 0;
        while (s->t1 < cases[i].until - 1e-6) {
            steps(s, 2e-6, 1);
            bead_peaks_step(peaks, s, INFINITY, INFINITY);
            drift = fmax(drift, fabs(bead_stepper_energy(s, &s->end) / energy - 1));
        }
        assert_below(peak_error(bead_peaks_found(peaks), &reference), cases[i].peaks);
        assert_below(drift, i == 0 ? 3e-11 : 1e-11);
        bead_peaks_destroy(peaks);
        drop(&x, s);
        free(reference.value);
    }
}

/* Bead forces, means of two contacts', have their maxima where one of the contacts may have a kink. */
static void peaks_of_beads(void **state)
{
    (void)state;
    struct setup x;
    make_problem(&x, 3, 0.443);
    struct bead_stepper *s[2];
    struct bead_peaks *peaks[2];
    for (int i = 0; i < 2; i++) {
        struct bead_message msg = {""};
        s[i] = make_stepper(&x, "rkn8", NULL, false);
        assert_int_equal(bead_peaks_create(s[i], true, (struct bead_span){0, SIZE_MAX}, &peaks[i], &msg), BEAD_OK);
        while (s[i]->t1 < 0.9e-3 - 1e-7) {
            steps(s[i], i ? 0.5e-6 : 4e-6, 1);
            bead_peaks_step(peaks[i], s[i], 0.9e-3, 0.9e-3);
        }
    }
    for (size_t j = 0; j < 40; j++) {
        const struct bead_peak *coarse = bead_peaks_found(peaks[0]) + j, *fine = bead_peaks_found(peaks[1]) + j;
        assert_near(coarse->value / fine->value, 1, 3e-8);
        assert_near(coarse->time, fine->time, 1e-10);
    }
    for (int i = 0; i < 2; i++) {
        bead_peaks_destroy(peaks[i]);
        drop(i ? &x : NULL, s[i]);
    }
}

/* Neither the window nor the instruction set changes a bit; with tolerances that leave most events to kinks, or to patches. */
static void bits_are_the_same(void **state)
{
    (void)state;
    static const char *const sets[] = {"portable", "sse2", "avx2", "avx512"};
    static const double tolerances[] = {1e-7, 1e-12};
    struct setup x;
    make_problem(&x, 3, 0.443);
    for (size_t t = 0; t < 2; t++) {
        struct bead_stepper *one = make_stepper(&x, "rkn8", NULL, false);
        one->event_tolerance = tolerances[t];
        steps(one, 4e-6, 225);
        for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
            struct bead_stepper *other = make_stepper(&x, "rkn8", sets[i], true);
            if (!other)
                continue;
            other->event_tolerance = tolerances[t];
            steps(other, 4e-6, 225);
            assert_memory_equal(one->end.u, other->end.u, x.chain->beads * sizeof(double));
            assert_memory_equal(one->end.v, other->end.v, x.chain->beads * sizeof(double));
            assert_memory_equal(one->end.f, other->end.f, x.chain->beads * sizeof(double));
            drop(NULL, other);
        }
        drop(NULL, one);
    }
    drop(&x, NULL);
}

/* A long chain goes through the stages in tiles, a short one does not. With the same beads, all moving, they agree to the bit,
 * except for the effect of the short one's end on its neighbours. */
static void tiles_change_no_bit_of(struct bead_chain_spec changed)
{
    enum { CELLS = 8000, PART = 1000, STEPS = 12, REACH = 10 * STEPS };
    struct setup x[2];
    struct bead_stepper *s[2];
    for (int i = 0; i < 2; i++) {
        describe(&x[i], 2, STEEL, ALUMINIUM, i ? PART : CELLS, NULL, 0.443);
        x[i].spec.wall = BEAD_WALL_NONE;
        x[i].spec.law = changed.law.row ? changed.law : x[i].spec.law;
        x[i].spec.precompression = changed.precompression;
        make(&x[i]);
        s[i] = make_stepper(&x[i], "rkn8", NULL, true);
        s[i]->event_tolerance = 1e-8;
        for (size_t j = 0; j < s[i]->beads; j++)
            s[i]->end.v[j] = 0.1 * sin(1.7 * (double)j);
        bead_stepper_evaluate(s[i], s[i]->end.u, s[i]->end.v, s[i]->end.f, s[i]->end.a);
        steps(s[i], 4e-6, STEPS);
    }
    assert_memory_equal(s[0]->end.u, s[1]->end.u, (2 * PART - REACH) * sizeof(double));
    assert_memory_equal(s[0]->end.v, s[1]->end.v, (2 * PART - REACH) * sizeof(double));
    assert_memory_equal(s[0]->end.a, s[1]->end.a, (2 * PART - REACH) * sizeof(double));
    for (int i = 0; i < 2; i++)
        drop(&x[i], s[i]);
}

static void tiles_change_no_bit(void **state)
{
    (void)state;
    tiles_change_no_bit_of((struct bead_chain_spec){0});
    tiles_change_no_bit_of((struct bead_chain_spec){.precompression = 1});
    tiles_change_no_bit_of((struct bead_chain_spec){.law = {.row = bead_law_find("power"), .power = 2, .coefficient = 1e9}});
}

/* Velocities of P3 at 0.6 ms. */
static double error_with(const char *method, double tolerance)
{
    struct table reference = read_table("p3_states.csv", 4);
    struct setup x;
    make_problem(&x, 3, 0.443);
    struct bead_stepper *s = make_stepper(&x, method, NULL, false);
    s->event_tolerance = tolerance;
    steps(s, 4e-6, 150);
    double error = velocity_error(s, &reference, 0.6e-3);
    drop(&x, s);
    free(reference.value);
    return error;
}

/* Where kinks are enough for the tolerance they leave a hundredth of what contacts that open or close would do. */
static void kinks_are_put_right(void **state)
{
    (void)state;
    double plain = error_with("rkn8-plain", 0), kinks = error_with("rkn8", 1e-7), patches = error_with("rkn8", 1e-13);
    print_message("velocity errors: %.1e plain, %.1e kinks, %.1e patches\n", plain, kinks, patches);
    assert_below(kinks, 0.01 * plain);
    assert_below(patches, 0.7 * kinks);
}

/* What contact k can do to a velocity in units of h A/m, one contact at a time and without shortcuts; see events_patch.h. */
static double loss_outside(double d, double r, double reach)
{
    const double x = d / r, near = 1 + x / BEAD_EFFECT_DECAY, far = 1 + 0.5 * x;
    return r > 0 && d < reach * r ? r * sqrt(r) * BEAD_EFFECT_OUTSIDE / (pow(near, 3) * pow(far, 4)) : 0;
}

static double loss(double d0, double r0, double d1, double r1, double reach)
{
    const double rate = fmax(fabs(r0), fabs(r1)), inside = BEAD_EFFECT_INSIDE * rate * sqrt(rate), dip = fmax(reach, 0.5);
    if ((d0 > 0) != (d1 > 0))
        return inside;
    if (d0 <= 0)
        return r0 > 0 && r1 < 0 && d0 + r0 > 0 && d1 - r1 > 0 ? inside : 0;
    if (r0 < 0 && r1 > 0)
        return d0 < -dip * r0 || d1 < dip * r1 ? inside : 0;
    return fmax(loss_outside(d0, r0, reach), loss_outside(d1, -r1, reach));
}

enum { CONTACTS = 1003, ROOM = 16, LENGTH = CONTACTS + 2 * ROOM };

/* All combinations of closed and open, towards and away, near and far; the last beads are at rest. */
static void fill(double *x, size_t seed, double scale)
{
    for (size_t i = 0; i < ROOM + CONTACTS; i++)
        x[i] = scale * sin(12.9898 * (double)(i * 4 + seed)) * exp(4 * sin(78.233 * (double)(i * 4 + seed)));
}

/* Every instruction set flags the contacts that the simple rules above flag. */
static void the_right_contacts_are_flagged(void **state)
{
    (void)state;
    static const char *const sets[] = {"portable", "sse2", "avx2", "avx512"};
    static double still[LENGTH], state_of[4][LENGTH], hardness[LENGTH], found[5][LENGTH];
    static size_t contact[LENGTH];
    const struct bead_patch_rule rule = {.power = 2, .hertz = true};
    const struct bead_event_limits limits = {&rule, hardness + ROOM, BEAD_EFFECT_OUTSIDE, BEAD_EFFECT_DECAY, 0.7, 1e-9, 0};
    const struct bead_patch_source source = {.u0 = state_of[0] + ROOM,
                                             .v0 = state_of[1] + ROOM,
                                             .u1 = state_of[2] + ROOM,
                                             .v1 = state_of[3] + ROOM,
                                             .static_compression = still + ROOM,
                                             .h = 1e-6};
    for (size_t i = 0; i < 4; i++)
        fill(state_of[i], i, i % 2 ? 1 : 1e-6);
    for (size_t i = 0; i < LENGTH; i++)
        hardness[i] = 1e9 * (1 + (double)(i % 7));
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        const struct bead_kernels *kernels = bead_kernels_find(sets[i]);
        if (!kernels)
            continue;
        struct bead_event_flags flags = {found[0] + ROOM, found[1] + ROOM, found[2] + ROOM, found[3] + ROOM, contact, found[4]};
        const size_t count = kernels->flag_events(CONTACTS, &source, &limits, &flags);
        size_t n = 0;
        for (size_t k = 0; k < CONTACTS; k++) {
            const double d0 = source.u0[k] - source.u0[k + 1], r0 = source.h * (source.v0[k] - source.v0[k + 1]);
            const double d1 = source.u1[k] - source.u1[k + 1], r1 = source.h * (source.v1[k] - source.v1[k + 1]);
            const double effect = loss(d0, r0, d1, r1, limits.reach) * source.h * limits.hardness[k];
            if (!(effect > limits.tolerance))
                continue;
            assert_true(n < count);
            assert_int_equal(contact[n], k);
            assert_near(found[4][n] / effect, 1, 1e-13);
            n++;
        }
        assert_int_equal(n, count);
        assert_true(count > CONTACTS / 10 && count < CONTACTS * 9 / 10);
    }
}

/* Branch points of a contact with known compression: d = sign (s - a)(s - b). */
static size_t branches(double a, double b, double sign, struct bead_patch_branch *branch)
{
    const double c[6] = {sign * a * b, -sign * (a + b), sign}, end[2] = {sign * (1 - a) * (1 - b), sign * (2 - a - b)};
    return bead_patch_branches(c, end, 1, branch);
}

static void branch_points_are_found(void **state)
{
    (void)state;
    struct bead_patch_branch b[BEAD_BRANCHES_MAX];
    /* opens and closes in one step */
    assert_int_equal(branches(0.3, 0.8, 1, b), 2);
    assert_near(b[0].s, 0.3, 1e-6);
    assert_near(b[1].s, 0.8, 1e-6);
    assert_true(b[0].before && !b[0].after && !b[1].before && b[1].after);
    /* closes and opens in one step, even within a hundredth of it */
    assert_int_equal(branches(0.503, 0.513, -1, b), 2);
    assert_near(b[0].s, 0.503, 1e-6);
    assert_near(b[1].s, 0.513, 1e-6);
    assert_true(!b[0].before && b[0].after && b[1].before && !b[1].after);
    /* has closed before the step and opens in it; closes in it and opens behind it */
    assert_int_equal(branches(-0.2, 0.6, -1, b), 2);
    assert_near(b[0].s, -0.2, 1e-6);
    assert_near(b[1].s, 0.6, 1e-6);
    assert_int_equal(branches(0.4, 1.25, -1, b), 2);
    assert_near(b[0].s, 0.4, 1e-6);
    assert_near(b[1].s, 1.25, 1e-6);
    /* impact: touches at the start */
    assert_true(branches(0, 3, -1, b) >= 1);
    assert_near(b[0].s, 0, 1e-12);
    assert_true(b[0].after && !b[0].before);
    /* stays open */
    assert_int_equal(branches(0.5, 0.5, -1, b), 0);
}

/* Value and slope of a quintic. */
static double quintic(const double c[6], double x, double *slope)
{
    double value = *slope = 0;
    for (int i = 5; i >= 0; i--) {
        *slope = *slope * x + value;
        value = value * x + c[i];
    }
    return value;
}

/* Where a quintic, or its slope, changes its sign within the step, by small steps; at most `most` places, and those that are closer
 * than 1/5 to each other or to an end are too many. */
static size_t changes(const double c[6], bool of_slope, double *at, size_t most)
{
    enum { STEPS = 1000 };
    size_t count = 0;
    double slope, before = 0, last = 0;
    for (int i = 0; i <= STEPS; i++) {
        const double x = (double)i / STEPS, value = quintic(c, x, &slope), now = of_slope ? slope : value;
        if (i > 0 && (now > 0) != (before > 0)) {
            if (count == most || x - last < 0.2 || x > 0.8)
                return most + 1;
            at[count++] = last = x - now / (now - before) / STEPS;
        }
        before = now;
    }
    return count;
}

/* Contacts of any smooth motion that open, close, or nearly open, do so where small steps find it. */
static void branch_points_of_any_motion(void **state)
{
    (void)state;
    size_t seen[3] = {0}; /* with so many zeros; 0: a minimum */
    for (int n = 0; n < 5000; n++) {
        double c[6], end[2], at[2], turn[1];
        for (int i = 0; i < 6; i++)
            c[i] = sin(12.9898 * (6 * n + i) + 4 * sin(78.233 * (6 * n + i)));
        c[0] *= 0.2;
        end[0] = quintic(c, 1, &end[1]);
        const bool closed = c[0] > 0, turns = closed == (end[0] > 0),
                   inwards = closed ? c[1] < 0 && end[1] > 0 : c[1] > 0 && end[1] < 0;
        const size_t zeros = changes(c, false, at, 2), extrema = changes(c, true, turn, 1);
        if (zeros > 2 || (turns ? extrema != 1 || !inwards || (zeros == 0 && !closed) : extrema > 0))
            continue;
        struct bead_patch_branch found[BEAD_BRANCHES_MAX], inside[BEAD_BRANCHES_MAX];
        size_t count = 0;
        for (size_t i = 0, all = bead_patch_branches(c, end, 1e-3, found); i < all; i++) {
            if (found[i].s > 0 && found[i].s < 1)
                inside[count++] = found[i];
        }
        assert_int_equal(count, zeros == 0 && turns ? 1 : zeros);
        for (size_t i = 0; i < count; i++) {
            assert_near(inside[i].s, zeros ? at[i] : turn[0], 1e-5);
            assert_true(inside[i].before == (closed == (i == 0)) && inside[i].after == (zeros ? !inside[i].before : true));
        }
        seen[zeros]++;
    }
    assert_true(seen[0] > 50 && seen[1] > 50 && seen[2] > 50);
}

/* Contacts at rest, touching or open, cost nothing and stay exactly at rest. */
static void rest_is_untouched(void **state)
{
    (void)state;
    struct setup x;
    make_problem(&x, 3, 0);
    struct bead_stepper *s = run(&x, "rkn8", 2e-6, 0.1e-3);
    for (size_t j = 0; j < x.chain->beads; j++)
        assert_true(s->end.u[j] == 0 && s->end.v[j] == 0 && s->end.f[j] == 0);
    drop(&x, s);
}

/* The last Picard sweep's change is of the size of the errors that a third sweep would take away: small, and falling with the step.
 */
static void picard_changes_are_reported(void **state)
{
    (void)state;
    struct setup x;
    make_problem(&x, 3, 0.443);
    double worst[2] = {0};
    for (int i = 0; i < 2; i++) {
        struct bead_stepper *s = make_stepper(&x, "rkn8", NULL, false);
        for (size_t n = 0; n < (i ? 300 : 150); n++) {
            steps(s, i ? 2e-6 : 4e-6, 1);
            worst[i] = fmax(worst[i], s->event_change);
        }
        drop(NULL, s);
    }
    assert_true(worst[1] > 0);
    assert_below(worst[0], 1e-5 * 0.443);
    assert_below(worst[1], worst[0] / 16);
    drop(&x, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_order_is_restored),
        cmocka_unit_test(peaks_and_energy),
        cmocka_unit_test(peaks_of_beads),
        cmocka_unit_test(tiles_change_no_bit),
        cmocka_unit_test(kinks_are_put_right),
        cmocka_unit_test(the_right_contacts_are_flagged),
        cmocka_unit_test(bits_are_the_same),
        cmocka_unit_test(branch_points_are_found),
        cmocka_unit_test(rest_is_untouched),
        cmocka_unit_test(branch_points_of_any_motion),
        cmocka_unit_test(picard_changes_are_reported),
    };
    return cmocka_run_group_tests_name("events", tests, NULL, NULL);
}
