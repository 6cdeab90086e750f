/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts that open and close, from the physics: collisions, momentum, scaling, chains that open, contacts that graze. */
#include "chains.h"

/* Beta function: 2 d/v times the integral of (1 - x^{p+1})^{-1/2} is B(1/(p+1), 1/2) 2 d/((p+1) v). */
static double duration(double p, double stiffness, double mass, double velocity)
{
    double q = 1 / (p + 1), d = pow((p + 1) * mass * velocity * velocity / (2 * stiffness), q);
    return 2 * d / velocity * q * tgamma(q) * tgamma(0.5) / tgamma(q + 0.5);
}

/* Two beads part with the velocities of an elastic collision, after the time that quadrature of the energy gives. The first contact
 * happens at t = 0, at the very start of a step. */
static void check_collision(size_t bead, const char *law, double power, double steps_each, double accuracy)
{
    struct setup x;
    describe(&x, 1, bead, bead, 1, NULL, 0.443);
    x.spec.wall = BEAD_WALL_NONE;
    x.spec.law = (struct bead_law_spec){.row = bead_law_find(law), .power = power, .coefficient = 3e9 * pow(1e-6, 1.5 - power)};
    make(&x);
    double m = materials[STEEL].mass, n = materials[bead].mass, v = x.spec.striker_velocity;
    double time = duration(power, x.chain->stiffness[0], m * n / (m + n), v), h = time / steps_each;
    struct bead_stepper *s = run(&x, "rkn8", h, 1.1 * time);
    assert_near(s->end.v[0] / v, (m - n) / (m + n), accuracy);
    assert_near(s->end.v[1] / v, 2 * m / (m + n), accuracy);
    double parted = s->t1 - (s->end.u[1] - s->end.u[0]) / (s->end.v[1] - s->end.v[0]);
    assert_near(parted / time, 1, 3 * accuracy);
    drop(&x, s);
}

static void two_beads_collide_exactly(void **state)
{
    (void)state;
    assert_near(duration(1.5, 1, 1, 1) / pow(1.25, 0.4), 2.9433, 1e-4);
    check_collision(STEEL, "hertz", 1.5, 50.3, 1e-13);
    check_collision(ALUMINIUM, "hertz", 1.5, 61.3, 1e-13);
    check_collision(LIGHT, "hertz", 1.5, 61.7, 1e-13);
}

static void other_powers_collide(void **state)
{
    (void)state;
    check_collision(STEEL, "power", 1.5, 50.3, 1e-13);
    check_collision(ALUMINIUM, "power", 2, 50.3, 1e-12);
    check_collision(STEEL, "power", 5.0 / 3, 50.3, 1e-12);
    check_collision(STEEL, "power", 1.4, 50.3, 1e-12);
    check_collision(STEEL, "power", 1.25, 50.3, 1e-12);
    check_collision(ALUMINIUM, "power", 3, 50.3, 1e-12);
    check_collision(STEEL, "power", 1, 50.3, 1e-11);
    check_collision(STEEL, "power", 1.3717, 50.3, 1e-9);
}

static void momentum_is_kept(void **state)
{
    (void)state;
    struct setup x;
    describe(&x, 2, STEEL, ALUMINIUM, 64, P3_SPINS, 0.443);
    x.spec.wall = BEAD_WALL_NONE;
    make(&x);
    struct bead_stepper *s = make_stepper(&x, "rkn8", NULL, false);
    double momentum = bead_stepper_momentum(s, &s->end);
    steps(s, 3e-6, 1000);
    assert_near(bead_stepper_momentum(s, &s->end) / momentum, 1, 1e-13);
    drop(&x, s);
}

/* v x 32 is t / 2, u x 16: to the bit if steps are halved, except for numbers indistinguishable from zero. */
static void scaling_is_exact(void **state)
{
    (void)state;
    struct setup x, y;
    make_problem(&x, 3, 0.443);
    make_problem(&y, 3, 32 * 0.443);
    struct bead_stepper *a = make_stepper(&x, "rkn8", NULL, false), *b = make_stepper(&y, "rkn8", NULL, false);
    for (int i = 0; i < 600; i++) {
        steps(a, 2.3e-6, 1);
        steps(b, 1.15e-6, 1);
        for (size_t j = 0; j < a->beads; j++) {
            if (fabs(a->end.u[j]) < 1e-250)
                continue;
            assert_true(16 * a->end.u[j] == b->end.u[j]);
            assert_true(32 * a->end.v[j] == b->end.v[j]);
        }
    }
    drop(&x, a);
    drop(&y, b);
}

/* A precompressed chain (also on a slope) hit hard enough to open: errors against a run with finer steps. */
static void check_opening(double tilt)
{
    struct setup x;
    describe(&x, 2, STEEL, ALUMINIUM, 32, P3_SPINS, 0.6);
    x.spec.precompression = 2;
    x.spec.tilt = tilt;
    make(&x);
    struct bead_stepper *fine = run(&x, "rkn8", 0.5e-6, 0.5e-3);
    double before = 0;
    size_t open = 0;
    for (size_t k = 0; k < x.chain->contacts; k++)
        open += x.chain->static_compression[k] + (fine->end.u[k] - fine->end.u[k + 1]) < 0;
    assert_true(open > 3);
    for (double h = 4e-6; h > 0.9e-6; h /= 2) {
        struct bead_stepper *s = run(&x, "rkn8", h, 0.5e-3);
        double error = difference(s, fine) / 0.6;
        if (before > 0)
            assert_below(error, fmax(before / 32, 1e-12));
        before = error;
        drop(NULL, s);
    }
    assert_below(before, 2e-12);
    drop(&x, fine);
}

static void precompressed_chains_open(void **state)
{
    (void)state;
    check_opening(0);
    check_opening(0.3);
}

/* Beads 1 and 2 part with a little force left between them while bead 0 pushes: contact 1 turns at `depth` times its compression,
 * below zero for depth < 0 (it opens and closes in one step). One step against 64 short ones. */
static double turning_error(const char *method, double depth)
{
    const double h = 1e-6, pushed = 2e-6;
    struct setup x;
    describe(&x, 1, STEEL, ALUMINIUM, 4, NULL, 0.443);
    x.cell[0] = ALUMINIUM;
    make(&x);
    double push = x.chain->stiffness[0] * pushed * sqrt(pushed) / materials[ALUMINIUM].mass; /* m/s^2 */
    double rate = 0.5 * push * h, turn = 0.5 * rate * rate / push;                           /* turns in the middle of the step */
    struct bead_stepper *s[2] = {make_stepper(&x, method, NULL, true), make_stepper(&x, "rkn8", NULL, true)};
    for (int i = 0; i < 2; i++) {
        double *u = s[i]->end.u, *v = s[i]->end.v;
        u[0] = pushed;
        u[2] = -turn * (1 + depth);
        u[3] = u[4] = 1e-6; /* out of reach of bead 2 */
        v[0] = 0;
        v[2] = rate;
        bead_stepper_evaluate(s[i], u, v, s[i]->end.f, s[i]->end.a);
        steps(s[i], i ? h / 64 : h, i ? 64 : 1);
    }
    double error = difference(s[0], s[1]) / rate;
    drop(NULL, s[0]);
    drop(&x, s[1]);
    return error;
}

static void grazing_contacts(void **state)
{
    (void)state;
    static const double depths[] = {-0.5, -0.1, -1e-3, 0, 1e-3, 0.1};
    for (size_t i = 0; i < sizeof depths / sizeof *depths; i++) {
        assert_below(turning_error("rkn8", depths[i]), 3e-11);
        assert_true(turning_error("rkn8", depths[i]) < 0.01 * turning_error("rkn8-plain", depths[i]));
    }
}

/* Four hundred contacts that close in one step: more than one patch may hold. */
static void all_contacts_at_once(void **state)
{
    (void)state;
    struct setup x;
    describe(&x, 2, STEEL, ALUMINIUM, 200, NULL, 0.443);
    x.spec.wall = BEAD_WALL_NONE;
    make(&x);
    struct bead_stepper *s = make_stepper(&x, "rkn8", NULL, true);
    for (size_t j = 0; j < x.chain->beads; j++) {
        s->end.u[j] = 1e-9 * (double)j;
        s->end.v[j] = 0.01 * (200 - (double)j + 0.3 * sin((double)j));
    }
    bead_stepper_evaluate(s, s->end.u, s->end.v, s->end.f, s->end.a);
    double energy = bead_stepper_energy(s, &s->end), momentum = bead_stepper_momentum(s, &s->end);
    steps(s, 1e-6, 300);
    assert_near(bead_stepper_energy(s, &s->end) / energy, 1, 1e-9);
    assert_near(bead_stepper_momentum(s, &s->end) / momentum, 1, 1e-10); /* the sum itself loses digits: the beads move both ways */
    drop(&x, s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_beads_collide_exactly), cmocka_unit_test(other_powers_collide),
        cmocka_unit_test(momentum_is_kept),          cmocka_unit_test(scaling_is_exact),
        cmocka_unit_test(precompressed_chains_open), cmocka_unit_test(grazing_contacts),
        cmocka_unit_test(all_contacts_at_once),
    };
    return cmocka_run_group_tests_name("collisions", tests, NULL, NULL);
}
