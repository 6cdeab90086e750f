/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interpolation between steps, the coefficients of the methods, and spins. */
#include "chains.h"

#include "sim/integrate/dense.h"

#include "sim/chain/spins.h"
#include "sim/integrate/dense.h"
#include "sim/integrate/methods.h"

static void septic_is_exact_for_septics(void **state)
{
    (void)state;
    for (int power = 0; power < 8; power++) {
        double at0[4] = {0}, at1[4], factor = 1;
        for (int d = 0; d < 4; d++) {
            at0[d] = power == d ? factor : 0;
            at1[d] = factor;
            factor *= power - d;
            at0[d] = power == d ? tgamma(power + 1) : 0;
        }
        struct bead_polynomial p = bead_polynomial_hermite(at0, at1);
        for (double x = 0; x <= 1; x += 0.125) {
            assert_near(bead_polynomial_value(&p, x), pow(x, power), 1e-13);
            assert_near(bead_polynomial_slope(&p, x), power ? power * pow(x, power - 1) : 0, 1e-12);
        }
    }
}

/* The product of weights over stages and a stage's row. */
static double product(size_t stages, const double *weights, const double *rows, size_t column)
{
    double sum = 0;
    for (size_t i = 0; i < stages; i++)
        sum += weights[i] * rows[i * stages + column];
    return sum;
}

/* Velocities and displacements are integrated alike: those of stages, whose places are exact, and of the end. */
static void damping_is_integrated_as_motion(void **state)
{
    (void)state;
    const struct bead_tableau *t = &bead_tableau_rk8;
    const size_t n = t->stages;
    for (size_t i = 0; i < n; i++) {
        double sum = 0;
        for (size_t j = 0; j < n; j++) {
            sum += t->av[i * n + j];
            assert_true(j < i || t->av[i * n + j] == 0); /* explicit */
            assert_near(t->a[i * n + j], product(n, t->av + i * n, t->av, j), 1e-14);
        }
        assert_near(sum, t->c[i], 1e-15);
        assert_near(t->b[i], product(n, t->bp, t->av, i), 1e-15);
        assert_near(t->b[i], t->bp[i] * (1 - t->c[i]), 1e-15);
    }
}

/* Sum of w c^n over the stages. */
static double moment(const struct bead_tableau *t, const double *w, int n)
{
    double sum = 0;
    for (size_t i = 0; i < t->stages; i++)
        sum += w[i] * pow(t->c[i], n);
    return sum;
}

/* Conditions of order p, after E. Hairer, S. P. Norsett and G. Wanner, Solving ordinary differential equations I, II.14: weights of
 * velocities integrate c^n up to n = p - 1, and no further, those of positions follow from them, places of stages are exact up to
 * second order, and the error is that of a method of order p - 2. */
static void methods_have_their_order(void **state)
{
    (void)state;
    static const struct bead_tableau *const all[] = {&bead_tableau_rkn6, &bead_tableau_rkn8, &bead_tableau_rkn12};
    static const int orders[] = {6, 8, 12};
    for (size_t k = 0; k < 3; k++) {
        const struct bead_tableau *t = all[k];
        for (size_t i = 0; i < t->stages; i++) {
            double sum = 0;
            for (size_t j = 0; j < t->stages; j++) {
                sum += t->a[i * t->stages + j];
                assert_true(j < i || t->a[i * t->stages + j] == 0); /* explicit */
            }
            assert_near(sum, t->c[i] * t->c[i] / 2, 1e-14);
            assert_near(t->b[i], t->bp[i] * (1 - t->c[i]), 1e-15);
        }
        for (int n = 0; n < orders[k]; n++) {
            assert_near(moment(t, t->bp, n), 1.0 / (n + 1), 1e-15);
            assert_true((fabs(moment(t, t->bpe, n)) < 1e-15) == (n < orders[k] - 2));
        }
        assert_true(fabs(moment(t, t->bp, orders[k]) - 1.0 / (orders[k] + 1)) > 1e-9);
    }
}

/* Samples between steps converge as the step's power 8, and are the states themselves at the ends. */
static void samples_between_steps_are_accurate(void **state)
{
    (void)state;
    double error[2];
    for (int i = 0; i < 2; i++) {
        char simulate[64];
        double step = i ? 2e-6 : 4e-6;
        snprintf(simulate, sizeof simulate, "until: 0.3 ms, method: rkn12, step: %g", step);
        struct built built = build(P4_CHAIN, simulate), fine = build(P4_CHAIN, "until: 0.3 ms, method: rkn12, step: 0.5 us");
        struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 0.3e-3});
        struct bead_run *exact = start_run(&fine, (struct bead_run_settings){.end = 0.3e-3});
        error[i] = 0;
        for (double t = 0.2e-3 + 0.25 * step; t < 0.25e-3; t += step) {
            double time = round(t * 2e6) / 2e6; /* a time where the fine run has a state */
            run_until(run, time);
            run_until(exact, time);
            struct bead_sample s = sample_at(run, time), e = sample_at(exact, time);
            for (size_t j = 0; j < built.chain->beads; j++)
                error[i] = fmax(error[i], fabs(s.field[BEAD_FIELD_DISPLACEMENT][j] - e.field[BEAD_FIELD_DISPLACEMENT][j]));
        }
        bead_run_destroy(run);
        bead_run_destroy(exact);
        release(&built);
        release(&fine);
    }
    assert_near(log2(error[0] / error[1]), 8, 0.7);
}

/* The largest differences of displacements or compressions, of velocities, and of these to the slopes of displacements. */
struct differences {
    double place, velocity, slope;
};

/* One bead, or one contact, alone beside the state at x within the step. */
static void compare_one(const struct bead_dense *dense, const struct bead_stepper *s, bool of_contact, size_t index, double x,
                        double place, double velocity, struct differences *worst)
{
    const struct bead_polynomial p = of_contact ? bead_dense_compression(s, index) : bead_dense_bead(s, index);
    double own[2] = {bead_polynomial_value(&p, x), bead_polynomial_slope(&p, x)};
    if (dense->between && of_contact)
        bead_between_correct_compression(dense->between, s, index, x, own);
    else if (dense->between)
        bead_between_correct_bead(dense->between, s, index, x, own);
    worst->place = fmax(worst->place, fabs(own[0] - place));
    worst->velocity = fmax(worst->velocity, fabs(own[1] / s->h - velocity));
}

static void compare_at(struct bead_dense *dense, const struct bead_stepper *s, double x, struct differences *worst)
{
    enum { MOST = 160 };
    static const double nearby = 1e-4;
    const double h = s->h, *still = bead_chain_static_compression(s->chain);
    double u[MOST], v[MOST], before[MOST], after[MOST];
    assert_true(s->beads <= MOST);
    bead_dense_state(dense, s, s->t0 + (x - nearby) * h, before, v);
    bead_dense_state(dense, s, s->t0 + (x + nearby) * h, after, v);
    bead_dense_state(dense, s, s->t0 + x * h, u, v);
    for (size_t j = 0; j < s->active; j++) {
        compare_one(dense, s, false, j, x, u[j], v[j], worst);
        worst->slope = fmax(worst->slope, fabs((after[j] - before[j]) / (2 * nearby * h) - v[j]));
    }
    if (dense->septic && s->active > 8) { /* a part of them */
        const struct bead_part part = {3, s->active - 2};
        double some[MOST] = {0};
        bead_dense_displacement(dense, s, x, part, some);
        bead_between_correct(dense->between, s, x, part, some, NULL);
        for (size_t j = part.from; j < part.to; j++)
            worst->place = fmax(worst->place, fabs(some[j] - u[j]));
    }
    for (size_t k = 0; k + 1 < s->active; k++)
        compare_one(dense, s, true, k, x, still[k] + u[k] - u[k + 1], v[k] - v[k + 1], worst);
}

/* All beads, one bead, and one contact are interpolated alike, also where contacts open and close, to rounding; and velocities are
 * the slopes of displacements, to that of their differences. */
static void parts_are_interpolated_as_the_whole(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        size_t events; /* at least */
    } chains[] = {
        {P3_CHAIN, 100},
        {"chain: {beads: [{cell: [large-steel, aluminium, ptfe], count: 6}], precompression: 2 N, wall: rigid}\n", 30},
        {"chain: {striker: {velocity: 0}, beads: [{bead: large-steel, count: 6, spring: 1e5, gap: 1 um}], drive: {force: sine, "
         "amplitude: 100 N, frequency: 5 kHz}}\n",
         30},
        {"chain: {beads: [{cell: [large-steel, ptfe], count: 6, gap: 1 um}], law: {power: 2, coefficient: 1e9}}\n", 0},
        {"chain: {beads: [{bead: large-steel, count: 9}], wall: rigid, damping: {coefficient: 3, exponent: 1.5}}\n", 0}};
    for (size_t c = 0; c < sizeof chains / sizeof *chains; c++) {
        struct built built = build(chains[c].text, "until: 1 ms");
        struct bead_message msg = {""};
        struct bead_stepper *s;
        struct bead_dense dense;
        struct differences worst = {0};
        size_t events = 0, count = 0;
        const struct bead_method *method = bead_method_row(c == 4 ? "rk8" : "rkn8");
        assert_int_equal(bead_stepper_create(built.chain, method, bead_kernels_find(NULL), false, &s, &msg), BEAD_OK);
        assert_int_equal(bead_dense_create(s, &dense, &msg), BEAD_OK);
        s->event_tolerance = 1e-10;
        for (int step = 0; step < 250; step++, events += count) {
            steps(s, 2e-6, 1);
            for (size_t i = 0; i < 4; i++)
                compare_at(&dense, s, (const double[]){0.03, 0.4, 0.71, 0.98}[i], &worst);
            bead_between_points(dense.between, &count);
        }
        assert_true(events >= chains[c].events);
        assert_below(worst.place, 1e-18);
        assert_below(worst.velocity, 1e-11);
        assert_below(worst.slope, c == 4 ? 1e-7 : 3e-9);
        bead_dense_destroy(&dense);
        bead_stepper_destroy(s);
        release(&built);
    }
}

static void magnetism_is_exact(void **state)
{
    (void)state;
    char digits[1000];
    for (size_t count = 1; count < 60; count++) {
        for (double m = 0; m <= 1; m += 0.05) {
            bead_spins_draw(digits, count, m, 7, 0);
            size_t up = 0;
            for (size_t i = 0; i < count; i++)
                up += digits[i] == '1';
            assert_int_equal(up, bead_spins_up(count, m));
            /* no other number of ups is nearer, and the majority is up */
            double got = (2.0 * (double)up - (double)count) / (double)count, spacing = 2.0 / (double)count;
            assert_true(fabs(got - m) <= spacing / 2 + 1e-12);
            assert_true(2 * up >= count || count % 2 == 1);
        }
    }
}

/* Every cell is as often up as any other; and the draw depends on the seed. */
static void spins_are_uniform(void **state)
{
    (void)state;
    enum { COUNT = 40, DRAWS = 4000 };
    int up[COUNT] = {0}, pairs = 0;
    char digits[COUNT], other[COUNT];
    for (int d = 0; d < DRAWS; d++) {
        bead_spins_draw(digits, COUNT, 0.5, 2009, (uint64_t)d);
        for (int i = 0; i < COUNT; i++)
            up[i] += digits[i] == '1';
        pairs += digits[0] == '1' && digits[1] == '1';
    }
    for (int i = 0; i < COUNT; i++)
        assert_near(up[i] / (double)DRAWS, 0.75, 5 * sqrt(0.75 * 0.25 / DRAWS));
    assert_near(pairs / (double)DRAWS, 30.0 / 40 * 29 / 39, 0.04);
    bead_spins_draw(digits, COUNT, 0, 1, 0);
    bead_spins_draw(other, COUNT, 0, 2, 0);
    assert_memory_not_equal(digits, other, COUNT);
    bead_spins_draw(other, COUNT, 0, 1, 0);
    assert_memory_equal(digits, other, COUNT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(septic_is_exact_for_septics),
        cmocka_unit_test(methods_have_their_order),
        cmocka_unit_test(damping_is_integrated_as_motion),
        cmocka_unit_test(samples_between_steps_are_accurate),
        cmocka_unit_test(parts_are_interpolated_as_the_whole),
        cmocka_unit_test(magnetism_is_exact),
        cmocka_unit_test(spins_are_uniform),
    };
    return cmocka_run_group_tests_name("dense", tests, NULL, NULL);
}
