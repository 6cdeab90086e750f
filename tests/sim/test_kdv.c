/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Korteweg-de Vries equation: solitons and their collisions against exact solutions, the recurrence of Zabusky and Kruskal. */
#include "tests/motions.h"

#include "sim/base/wide.h"
#include "sim/equation/etd.h"
#include "sim/equation/kdv_solver.h"

static const struct bead_system *const kdv = &bead_system_kdv;

static const struct bead_equation_spec one_soliton = {.variable = BEAD_FIELD_DISPLACEMENT,
                                                      .low = -20,
                                                      .length = 40,
                                                      .nonlinearity = 6,
                                                      .dispersion = 1,
                                                      .start = BEAD_START_SOLITONS,
                                                      .solitons = {{4, 0}},
                                                      .soliton_count = 1};

/* N. J. Zabusky, M. D. Kruskal, Phys. Rev. Lett. 15, 240 (1965). */
static const struct bead_equation_spec zabusky_kruskal = {.variable = BEAD_FIELD_DISPLACEMENT,
                                                          .length = 2,
                                                          .nonlinearity = 1,
                                                          .dispersion = 0.022 * 0.022,
                                                          .start = BEAD_START_COSINE,
                                                          .mode = 1,
                                                          .amplitude = 1};

/* The thesis's Eq. 4 with mu^2 = 6, c = 4. */
static double soliton(double x, double t)
{
    double d = x - 4 * t - 40 * round((x - 4 * t) / 40), c = cosh(d);
    return 2 / (c * c);
}

static double error_of_soliton(struct bead_motion *motion, size_t points, double t)
{
    double worst = 0, *u = field_at(kdv, motion, points, t, BEAD_FIELD_DISPLACEMENT);
    for (size_t i = 0; i < points; i++)
        worst = fmax(worst, fabs(u[i] - soliton(-20 + 40 * (double)i / (double)points, t)));
    free(u);
    return worst;
}

/* Over the whole time, samples within steps included. */
static double worst_error_of_soliton(double accuracy, double end)
{
    double worst = 0;
    size_t points = kdv->count(&(struct bead_chain_spec){.equation = one_soliton}, accuracy);
    struct bead_motion *motion = start_motion(kdv, &one_soliton, accuracy, 0, end);
    for (int i = 0; i <= 97; i++) {
        double t = end * i / 97;
        move_until(kdv, motion, t);
        worst = fmax(worst, error_of_soliton(motion, points, t));
    }
    kdv->equation->destroy(motion);
    return worst;
}

static void a_soliton_keeps_its_shape(void **state)
{
    (void)state;
    assert_below(worst_error_of_soliton(1e-6, 2), 2e-6);
    assert_below(worst_error_of_soliton(4e-9, 2), 1e-8);
    assert_below(worst_error_of_soliton(1e-4, 2), 2e-4);
}

/* So does a pulse of its height and width. What is narrower may come: a pulse may be narrow itself, or its solitons may, up to
 * twice as high: of 2 a, with 6 and 1, they have sqrt(a) for 1 / width. */
static void a_pulse_of_its_shape_is_a_soliton(void **state)
{
    (void)state;
    struct bead_equation_spec pulse = one_soliton;
    pulse.start = BEAD_START_PULSE;
    pulse.soliton_count = 0;
    pulse.amplitude = 2;
    pulse.width = 1;
    const size_t points = kdv->count(&(struct bead_chain_spec){.equation = pulse}, 1e-8);
    struct bead_motion *motion = start_motion(kdv, &pulse, 1e-8, 0, 1);
    assert_below(error_of_soliton(motion, points, 0), 1e-13);
    move_until(kdv, motion, 1);
    assert_below(error_of_soliton(motion, points, 1), 1e-7);
    kdv->equation->destroy(motion);
    assert_close(bead_kdv_sharpest(&pulse), sqrt(2), 1e-15);
    pulse.width = 1. / 3;
    assert_close(bead_kdv_sharpest(&pulse), 3, 1e-15);
    pulse.amplitude = -18;
    assert_close(bead_kdv_sharpest(&pulse), sqrt(18), 1e-15);
}

static void a_soliton_has_its_integrals(void **state)
{
    (void)state;
    struct bead_motion *motion = start_motion(kdv, &one_soliton, 1e-9, 0, 2);
    move_until(kdv, motion, 2);
    assert_close(measure(kdv, motion, "mass"), 4, 1e-12);
    assert_close(measure(kdv, motion, "momentum"), 16. / 3, 1e-8);
    assert_close(measure(kdv, motion, "hamiltonian"), 32. / 5, 1e-8); /* the integral of u^3 - u_x^2 / 2 */
    assert_true(measure(kdv, motion, "change of the mass") == 0);
    assert_below(fabs(measure(kdv, motion, "change of the momentum, relative")), 1e-9);
    assert_below(fabs(measure(kdv, motion, "change of the hamiltonian, relative")), 1e-9);
    assert_close(measure(kdv, motion, "soliton 1: place"), 8, 1e-8);
    assert_close(measure(kdv, motion, "soliton 1: amplitude"), 2, 1e-8);
    assert_below(fabs(measure(kdv, motion, "soliton 1: shift from free motion")), 1e-8);
    kdv->equation->destroy(motion);
}

/* Half of the height is where cosh^2 = 2. */
static void a_soliton_has_its_width(void **state)
{
    (void)state;
    struct bead_equation_spec spec = one_soliton;
    spec.points = 4096;
    struct bead_motion *motion = start_motion(kdv, &spec, 1e-6, 1e-4, 2e-4);
    double *u = field_at(kdv, motion, 4096, 0, BEAD_FIELD_DISPLACEMENT), cell = 40. / 4096, ends[2] = {0, 0};
    for (size_t i = 1; i < 4096; i++) {
        double x = -20 + cell * ((double)i - 1 + (1 - u[i - 1]) / (u[i] - u[i - 1]));
        if (u[i - 1] < 1 && u[i] >= 1)
            ends[0] = x;
        else if (u[i - 1] >= 1 && u[i] < 1)
            ends[1] = x;
    }
    assert_close(ends[1] - ends[0], 1.76275, 2e-5);
    free(u);
    kdv->equation->destroy(motion);
}

/* G. B. Whitham, Linear and Nonlinear Waves (1974), section 17.2: the fast one gains ln 9 / sqrt(16), the slow loses ln 9 /
 * sqrt(4). */
static void solitons_collide_and_only_shift(void **state)
{
    (void)state;
    struct bead_equation_spec spec = one_soliton;
    spec.solitons[0] = (struct bead_soliton){16, -10};
    spec.solitons[1] = (struct bead_soliton){4, 0};
    spec.soliton_count = 2;
    struct bead_motion *motion = start_motion(kdv, &spec, 1e-6, 0, 1.6);
    double shift, middle = (10 - 0.75 * log(3)) / 12; /* when their mean ways meet */
    move_until(kdv, motion, 0.3);
    assert_below(fabs(measure(kdv, motion, "soliton 1: shift from free motion")), 1e-4);
    move_until(kdv, motion, 1.6);
    assert_close(measure(kdv, motion, "soliton 1: shift from free motion"), log(3) / 2, 1e-4);
    assert_close(measure(kdv, motion, "soliton 2: shift from free motion"), -log(3), 1e-4);
    assert_close(measure(kdv, motion, "soliton 1: amplitude"), 8, 1e-4);
    assert_close(measure(kdv, motion, "soliton 2: amplitude"), 2, 1e-4);
    kdv->equation->destroy(motion);
    /* In the middle of the collision there is one crest, and it is no soliton. */
    motion = start_motion(kdv, &spec, 1e-6, 0, middle);
    move_until(kdv, motion, middle);
    assert_false(has_measure(kdv, motion, "soliton 1: place", &shift));
    kdv->equation->destroy(motion);
}

/* Two of the same height are two crests, told apart by where they come from, also when a faster one has overtaken both. */
static void solitons_of_equal_speed_are_told_apart(void **state)
{
    (void)state;
    struct bead_equation_spec spec = one_soliton;
    spec.solitons[0] = (struct bead_soliton){4, -8};
    spec.solitons[1] = (struct bead_soliton){4, 8};
    spec.soliton_count = 2;
    struct bead_motion *motion = start_motion(kdv, &spec, 1e-6, 0, 0.5);
    move_until(kdv, motion, 0.5);
    assert_close(measure(kdv, motion, "soliton 1: place"), -6, 1e-4);
    assert_close(measure(kdv, motion, "soliton 2: place"), 10, 1e-4);
    for (int i = 1; i <= 2; i++)
        assert_below(fabs(measure(kdv, motion, i == 1 ? "soliton 1: shift from free motion" : "soliton 2: shift from free motion")),
                     1e-4);
    kdv->equation->destroy(motion);
    spec.solitons[2] = (struct bead_soliton){16, -16};
    spec.soliton_count = 3;
    motion = start_motion(kdv, &spec, 1e-5, 0, 3.5);
    move_until(kdv, motion, 3.5); /* the fast one comes round, but not to a second meeting */
    assert_close(measure(kdv, motion, "soliton 1: shift from free motion"), -log(3), 1e-2);
    assert_close(measure(kdv, motion, "soliton 2: shift from free motion"), -log(3), 1e-2);
    assert_close(measure(kdv, motion, "soliton 3: shift from free motion"), log(3), 1e-2);
    kdv->equation->destroy(motion);
}

/* Started in the middle of the collision, by Hirota's formula, they part as those that met. */
static void solitons_start_where_they_overlap(void **state)
{
    (void)state;
    struct bead_equation_spec spec = one_soliton;
    spec.solitons[0] = (struct bead_soliton){16, -0.5};
    spec.solitons[1] = (struct bead_soliton){4, 0};
    spec.soliton_count = 2;
    struct bead_motion *motion = start_motion(kdv, &spec, 1e-6, 0, 1);
    move_until(kdv, motion, 1);
    assert_close(measure(kdv, motion, "soliton 1: shift from free motion"), log(3) / 2, 1e-4);
    assert_close(measure(kdv, motion, "soliton 2: shift from free motion"), -log(3), 1e-4);
    kdv->equation->destroy(motion);
}

/* They go left and down with other signs of the equation, and a drift carries them along. */
static void signs_and_drift(void **state)
{
    (void)state;
    struct bead_equation_spec spec = one_soliton;
    spec.nonlinearity = -6;
    spec.drift = -7;
    struct bead_motion *motion = start_motion(kdv, &spec, 1e-7, 0, 1);
    move_until(kdv, motion, 1);
    assert_close(measure(kdv, motion, "soliton 1: place"), -3, 1e-6);
    assert_close(measure(kdv, motion, "soliton 1: amplitude"), -2, 1e-6);
    kdv->equation->destroy(motion);
}

static void zabusky_and_kruskal_see_eight_solitons(void **state)
{
    (void)state;
    struct bead_motion *motion = start_motion(kdv, &zabusky_kruskal, 1e-6, 0, 3.6 / M_PI);
    move_until(kdv, motion, 3.6 / M_PI);
    assert_true(measure(kdv, motion, "crests at the end") == 8);
    kdv->equation->destroy(motion);
}

/* A cosine of one period has its crest at the first point of the grid. */
static void a_cosine_has_one_crest(void **state)
{
    (void)state;
    struct bead_motion *motion = start_motion(kdv, &zabusky_kruskal, 1e-6, 0, 1e-6);
    move_until(kdv, motion, 1e-6);
    assert_true(measure(kdv, motion, "crests at the end") == 1);
    kdv->equation->destroy(motion);
}

static void zabusky_and_kruskal_see_the_start_again(void **state)
{
    (void)state;
    struct bead_motion *motion = start_motion(kdv, &zabusky_kruskal, 1e-6, 0, 31 / M_PI);
    move_until(kdv, motion, 31 / M_PI);
    assert_close(measure(kdv, motion, "recurrence time") * M_PI, 29.96, 0.02);
    assert_close(measure(kdv, motion, "amplitude at recurrence, relative"), 0.926, 1e-3);
    assert_below(fabs(measure(kdv, motion, "change of the momentum, relative")), 1e-7);
    kdv->equation->destroy(motion);
}

/* The recurrence is that of the equation, not of grid or step. */
static void recurrence_is_as_exact_as_asked(void **state)
{
    (void)state;
    static const double accuracies[] = {1e-4, 1e-7};
    double *u[2], worst = 0;
    struct bead_equation_spec spec = zabusky_kruskal;
    spec.points = 432;
    for (size_t i = 0; i < 2; i++) {
        struct bead_motion *motion = start_motion(kdv, &spec, accuracies[i], 0, 10 / M_PI);
        move_until(kdv, motion, 10 / M_PI);
        u[i] = field_at(kdv, motion, spec.points, 10 / M_PI, BEAD_FIELD_DISPLACEMENT);
        kdv->equation->destroy(motion);
    }
    for (size_t i = 0; i < spec.points; i++)
        worst = fmax(worst, fabs(u[0][i] - u[1][i]));
    assert_below(worst, 2.5e-4); /* u is up to 2.5 high */
    free(u[0]);
    free(u[1]);
}

static void errors_fall_with_the_fourth_power_of_the_step(void **state)
{
    (void)state;
    struct bead_equation_spec spec = one_soliton;
    spec.points = 512;
    double error[3];
    for (int i = 0; i < 3; i++) {
        struct bead_motion *motion = start_motion(kdv, &spec, 1e-6, 0.004 / (1 << i), 1);
        move_until(kdv, motion, 1);
        error[i] = error_of_soliton(motion, spec.points, 1);
        kdv->equation->destroy(motion);
    }
    for (int i = 0; i < 2; i++) {
        double order = log2(error[i] / error[i + 1]);
        if (!(order > 3.8 && order < 4.6))
            fail_msg("errors %.3g %.3g: order %.3g", error[i], error[i + 1], order);
    }
}

/* By the same number of points more the error falls by the same factor: 32 points are 10.67 modes, exp(-pi^2 / 40 10.67) = 0.07. */
static void errors_fall_exponentially_with_the_points(void **state)
{
    (void)state;
    struct bead_equation_spec spec = one_soliton;
    double before = 0;
    for (spec.points = 160; spec.points <= 288; spec.points += 32) {
        struct bead_motion *motion = start_motion(kdv, &spec, 1e-6, 2.5e-4, 0.5);
        move_until(kdv, motion, 0.5);
        double error = error_of_soliton(motion, spec.points, 0.5);
        if (before > 0)
            assert_below(error, before * 0.15);
        before = error;
        kdv->equation->destroy(motion);
    }
}

/* Samples between steps are as exact as those at their ends, and change nothing. */
static void samples_are_as_exact_as_steps(void **state)
{
    (void)state;
    struct bead_equation_spec spec = one_soliton;
    spec.points = 384;
    struct bead_motion *sampled = start_motion(kdv, &spec, 1e-6, 2e-3, 0.2), *plain = start_motion(kdv, &spec, 1e-6, 2e-3, 0.2);
    size_t count;
    while (kdv->equation->time(sampled) < 0.2) {
        double from = kdv->equation->time(sampled);
        move_until(kdv, sampled, from + 1e-9);
        move_until(kdv, plain, from + 1e-9);
        double to = kdv->equation->time(sampled), limit = error_of_soliton(sampled, spec.points, to) + 1e-10;
        for (int i = 0; i < 4; i++)
            assert_below(error_of_soliton(sampled, spec.points, from + (to - from) * i / 4), 2 * limit);
    }
    assert_memory_equal(kdv->equation->state(sampled, &count), kdv->equation->state(plain, &count), 2 * 128 * sizeof(double));
    kdv->equation->destroy(sampled);
    kdv->equation->destroy(plain);
}

/* With no nonlinearity a wave keeps its form and has the speed drift - b k^2, for any step. */
static void linear_waves_are_exact(void **state)
{
    (void)state;
    struct bead_equation_spec spec = zabusky_kruskal;
    spec.nonlinearity = 0;
    spec.dispersion = 0.01;
    spec.drift = 0.3;
    spec.mode = 3;
    struct bead_motion *motion = start_motion(kdv, &spec, 1e-6, 0, 5);
    size_t points = kdv->count(&(struct bead_chain_spec){.equation = spec}, 1e-6);
    move_until(kdv, motion, 5);
    double *u = field_at(kdv, motion, points, 5, BEAD_FIELD_DISPLACEMENT), k = 3 * M_PI;
    for (size_t i = 0; i < points; i++)
        assert_close(u[i], cos(k * (2 * (double)i / (double)points - (0.3 - 0.01 * k * k) * 5)), 1e-12);
    free(u);
    kdv->equation->destroy(motion);
}

static void a_grid_too_coarse_is_told(void **state)
{
    (void)state;
    struct bead_equation_spec spec = zabusky_kruskal;
    spec.points = 64;
    struct bead_message msg = {""};
    struct bead_motion *motion = start_motion(kdv, &spec, 1e-6, 0, 3);
    enum bead_error err = BEAD_OK;
    while (!err && kdv->equation->time(motion) < 3)
        err = kdv->equation->step(motion, &msg);
    assert_int_equal(err, BEAD_ERROR_NUMBERS);
    assert_non_null(strstr(msg.text, "needs more points"));
    kdv->equation->destroy(motion);
}

/* Where the accuracy allows longer steps than the nonlinearity does, those of check runs are shorter by their part. */
static void check_runs_have_other_steps(void **state)
{
    (void)state;
    static const double parts[] = {0, 1, 0.5, 0.25};
    double step[4];
    for (int k = 0; k < 4; k++) {
        struct bead_motion_settings settings = {&one_soliton, 512, "auto", 1, 0, 1, 0, parts[k]};
        struct bead_motion *motion = NULL;
        struct bead_message msg = {""};
        struct bead_pace pace;
        if (kdv->equation->create(&settings, &motion, &msg))
            fail_msg("%s", msg.text);
        kdv->equation->pace(motion, &pace);
        step[k] = pace.step;
        kdv->equation->destroy(motion);
    }
    assert_true(step[0] == step[1] && fabs(step[2] / step[1] - 0.5) < 1e-12 && fabs(step[3] / step[1] - 0.25) < 1e-12);
}

/* A soliton only moves: its steps find one length, and do not go up and down from then on, whatever the accuracy. */
static void steps_of_a_soliton_settle(void **state)
{
    (void)state;
    for (double accuracy = 1e-3; accuracy > 3e-4; accuracy *= 0.9) {
        struct bead_motion_settings settings = {&one_soliton, 256, "auto", accuracy, 0, 20, 0, 0};
        struct bead_motion *motion = NULL;
        struct bead_message msg = {""};
        double before = 0, length = 0;
        int turns = 0, way = 0;
        if (kdv->equation->create(&settings, &motion, &msg))
            fail_msg("%s", msg.text);
        for (int i = 0; i < 100; i++) {
            if (kdv->equation->step(motion, &msg))
                fail_msg("%s", msg.text);
            const double now = kdv->equation->time(motion), step = now - before;
            const int to = i == 0 || fabs(step / length - 1) < 0.01 ? 0 : step > length ? 1 : -1;
            turns += to != 0 && way != 0 && to != way;
            way = to ? to : way;
            before = now, length = step;
        }
        assert_int_equal(turns, 0);
        kdv->equation->destroy(motion);
    }
}

static void a_grid_too_coarse_for_the_start_is_told(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_motion *motion = NULL;
    struct bead_motion_settings settings = {&one_soliton, 40, "auto", 1e-6, 0, 1, 0, 0};
    assert_int_equal(kdv->equation->create(&settings, &motion, &msg), BEAD_ERROR_NUMBERS);
    kdv->equation->destroy(motion);
    assert_non_null(strstr(msg.text, "too coarse for the start"));
    struct bead_equation_spec spec = zabusky_kruskal;
    const char *key = "";
    spec.points = 8;
    spec.mode = 7; /* on these points it looks like one wave */
    assert_non_null(kdv->equation->check(&spec, &key));
    assert_string_equal(key, "points");
}

static void steps_too_long_are_told(void **state)
{
    (void)state;
    struct bead_equation_spec spec = one_soliton;
    spec.points = 512;
    struct bead_message msg = {""};
    struct bead_motion *motion = start_motion(kdv, &spec, 1e-6, 0.1, 10);
    enum bead_error err = BEAD_OK;
    while (!err && kdv->equation->time(motion) < 10)
        err = kdv->equation->step(motion, &msg);
    assert_int_equal(err, BEAD_ERROR_NUMBERS);
    assert_non_null(strstr(msg.text, "too long"));
    kdv->equation->destroy(motion);
}

static void wrong_settings_are_told(void **state)
{
    (void)state;
    const char *key = "";
    struct bead_equation_spec spec = one_soliton;
    spec.dispersion = -1;
    assert_non_null(kdv->equation->check(&spec, &key));
    assert_string_equal(key, "dispersion");
    spec = one_soliton;
    spec.nonlinearity = 0;
    assert_non_null(kdv->equation->check(&spec, &key));
    assert_string_equal(key, "nonlinearity");
    spec = one_soliton;
    spec.solitons[0].at = 21;
    assert_non_null(kdv->equation->check(&spec, &key));
    assert_string_equal(key, "start");
    spec = zabusky_kruskal;
    spec.dispersion = 0;
    assert_non_null(kdv->equation->check(&spec, &key));
}

static struct bead_turn times(struct bead_turn a, bead_wide re, bead_wide im)
{
    return bead_turn_on(a, (struct bead_turn){re, im});
}

/* exp(z), z = i angle, without its first n terms, over z^n: phi_n times n!, by its series, or by the formula where that is exact.
 */
static struct bead_turn rest_of_exp(bead_wide angle, int n)
{
    struct bead_turn sum = {0, 0}, power = {1, 0};
    if (bead_wide_abs(angle) < 5) {
        bead_wide factorial = 1;
        for (int k = 2; k <= n; k++)
            factorial *= k;
        for (int k = 0; k < 80; k++, power = times(power, 0, angle)) {
            sum.re += power.re / factorial;
            sum.im += power.im / factorial;
            factorial *= k + n + 1;
        }
        return sum;
    }
    sum = bead_turn_by(angle);
    for (int k = 0; k < n; k++) {
        sum.re -= power.re;
        sum.im -= power.im;
        power = times(power, 0, angle / (k + 1));
    }
    for (int k = 0; k < n; k++)
        sum = times(sum, 0, -1 / angle);
    return sum;
}

/* As M. Hochbruck and A. Ostermann, Acta Numerica 19, 209 (2010), write them: with phi_1, phi_2 and phi_3. */
static void exact_row(bead_wide angle, bead_wide h, bead_wide to[12])
{
    const struct bead_turn whole = bead_turn_by(angle), half = bead_turn_by(angle / 2), q = rest_of_exp(angle / 2, 1);
    const struct bead_turn one = rest_of_exp(angle, 1), two = rest_of_exp(angle, 2), three = rest_of_exp(angle, 3);
    const struct bead_turn all[] = {
        whole,
        half,
        times(q, h / 2, 0),
        times((struct bead_turn){one.re - 3 * two.re + 4 * three.re, one.im - 3 * two.im + 4 * three.im}, h, 0),
        times((struct bead_turn){2 * two.re - 4 * three.re, 2 * two.im - 4 * three.im}, h, 0),
        times((struct bead_turn){4 * three.re - two.re, 4 * three.im - two.im}, h, 0)};
    for (size_t i = 0; i < 6; i++) {
        to[2 * i] = all[i].re;
        to[2 * i + 1] = all[i].im;
    }
}

/* The coefficients of steps are exact to rounding: for waves that turn by less than a millionth of a radian and by hundreds. */
static void coefficients_are_exact(void **state)
{
    (void)state;
    enum { MODES = 300, STEPS = 13 };
    static struct bead_pair omega[MODES + 1];
    static struct bead_etd_row row[MODES + 1];
    for (size_t j = 0; j <= MODES; j++) {
        const bead_wide k = bead_wide_pi * j, w = k * (4.84e-4 * k * k - 0.3);
        omega[j] = (struct bead_pair){(double)w, (double)(w - (double)w)};
    }
    double h = 1e-9;
    for (int n = 0; n < STEPS; n++, h *= 3) {
        bead_etd_rows(omega, MODES, h, row);
        for (size_t j = 0; j <= MODES; j++) {
            const double *a = (const double *)&row[j]; /* only numbers */
            bead_wide exact[12];
            exact_row(((bead_wide)omega[j].high + omega[j].low) * h, h, exact);
            for (size_t i = 0; i < sizeof *row / sizeof *a; i++) /* two turns; the others are times */
                assert_near(a[i] / (i < 4 ? 1 : h), (double)(exact[i] / (i < 4 ? 1 : h)), 1.5e-15);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_soliton_keeps_its_shape),
                                       cmocka_unit_test(a_pulse_of_its_shape_is_a_soliton),
                                       cmocka_unit_test(a_soliton_has_its_integrals),
                                       cmocka_unit_test(a_soliton_has_its_width),
                                       cmocka_unit_test(solitons_collide_and_only_shift),
                                       cmocka_unit_test(solitons_of_equal_speed_are_told_apart),
                                       cmocka_unit_test(solitons_start_where_they_overlap),
                                       cmocka_unit_test(signs_and_drift),
                                       cmocka_unit_test(a_cosine_has_one_crest),
                                       cmocka_unit_test(zabusky_and_kruskal_see_eight_solitons),
                                       cmocka_unit_test(zabusky_and_kruskal_see_the_start_again),
                                       cmocka_unit_test(recurrence_is_as_exact_as_asked),
                                       cmocka_unit_test(errors_fall_with_the_fourth_power_of_the_step),
                                       cmocka_unit_test(errors_fall_exponentially_with_the_points),
                                       cmocka_unit_test(samples_are_as_exact_as_steps),
                                       cmocka_unit_test(coefficients_are_exact),
                                       cmocka_unit_test(linear_waves_are_exact),
                                       cmocka_unit_test(a_grid_too_coarse_is_told),
                                       cmocka_unit_test(a_grid_too_coarse_for_the_start_is_told),
                                       cmocka_unit_test(check_runs_have_other_steps),
                                       cmocka_unit_test(steps_of_a_soliton_settle),
                                       cmocka_unit_test(steps_too_long_are_told),
                                       cmocka_unit_test(wrong_settings_are_told)};
    return cmocka_run_group_tests_name("kdv", tests, NULL, NULL);
}
