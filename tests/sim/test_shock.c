/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Waves that break: their breaking times against closed forms and characteristics, and the relations that must hold behind the
 * shock. */
#include "tests/motions.h"

#include "sim/chain/chain_internal.h"
#include "sim/equation/shock_law.h"

static const struct bead_system *const shock = &bead_system_shock;

static const struct bead_equation_spec simple_wave = {
    .length = 2 * M_PI, .speed = 1, .epsilon = 0.2, .start = BEAD_START_SIMPLE_WAVE, .mode = 1, .amplitude = 1};

static struct bead_equation_spec standing(double epsilon)
{
    struct bead_equation_spec spec = simple_wave;
    spec.epsilon = epsilon;
    spec.start = BEAD_START_COSINE;
    return spec;
}

static double breaking_time(const struct bead_equation_spec *spec, double until)
{
    struct bead_motion *motion = start_motion(shock, spec, 1e-6, 0, until);
    move_until(shock, motion, until);
    double time = measure(shock, motion, "breaking time");
    shock->equation->destroy(motion);
    return time;
}

/* 2 / (c a k) sqrt((1 + a s) / (1 - s^2)), s = (sqrt(1 - a^2) - 1) / a, a = epsilon times the strain's amplitude. */
static const struct {
    double epsilon, time;
} closed_forms[] = {{0.1, 19.974921462206655}, {0.2, 9.94936153005124}, {0.5, 3.8637033051562732}};

static void simple_waves_break_when_they_should(void **state)
{
    (void)state;
    for (size_t i = 1; i < 3; i++) { /* the first takes as long as all others */
        struct bead_equation_spec spec = simple_wave;
        spec.epsilon = closed_forms[i].epsilon;
        double time = closed_forms[i].time;
        assert_close(breaking_time(&spec, 1.1 * time), time, 1e-6 * time);
    }
    struct bead_equation_spec rising = simple_wave; /* of a negative epsilon the rising front breaks */
    rising.epsilon = -closed_forms[2].epsilon;
    assert_close(breaking_time(&rising, 1.1 * closed_forms[2].time), closed_forms[2].time, 1e-6 * closed_forms[2].time);
}

/* Error of the time that is expected from the start, where the grid is the only approximation. */
static double error_of_breaking(size_t cells)
{
    struct bead_equation_spec spec = simple_wave;
    spec.epsilon = closed_forms[2].epsilon;
    spec.points = cells;
    struct bead_motion *motion = start_motion(shock, &spec, 1e-6, 0, 1);
    double time = measure(shock, motion, "breaking time, extrapolated");
    shock->equation->destroy(motion);
    return fabs(time - closed_forms[2].time);
}

static void breaking_times_converge_with_order_three(void **state)
{
    (void)state;
    double worst[3] = {0};
    for (size_t i = 0; i < 3; i++) { /* the steepest place falls between the cells now here, now there */
        for (size_t more = 0; more < 8; more++)
            worst[i] = fmax(worst[i], error_of_breaking(((size_t)80 << i) + more));
    }
    if (!(log2(worst[0] / worst[1]) > 2.7 && log2(worst[1] / worst[2]) > 2.7))
        fail_msg("errors %.3g %.3g %.3g", worst[0], worst[1], worst[2]);
}

static void the_closed_form_is_told(void **state)
{
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        struct bead_equation_spec spec = simple_wave;
        spec.epsilon = closed_forms[i].epsilon;
        spec.mode = 3;
        spec.speed = 2;
        struct bead_motion *motion = start_motion(shock, &spec, 1e-3, 0, 1);
        assert_close(measure(shock, motion, "breaking time, closed form"), closed_forms[i].time / 6, 1e-5);
        shock->equation->destroy(motion);
    }
}

/* ---- characteristics, by J. Massau's net ----
 *
 * Node (i, j) is where the characteristic going right from x_i meets that going left from x_j: both invariants, and so the speed,
 * are known there exactly, place and time from the two nodes before by the mean speeds. Two neighbours of one family cross where
 * the node of the one comes no later than that of the other. */
enum { NET = 600 };

struct node {
    double x, t, a;
};

static struct node meet(struct node from_left, struct node from_right, double a)
{
    double p = 0.5 * (from_left.a + a), q = 0.5 * (from_right.a + a);
    double t = (from_right.x - from_left.x + p * from_left.t + q * from_right.t) / (p + q);
    return (struct node){from_left.x + p * (t - from_left.t), t, a};
}

static double speed_of(const struct bead_equation_spec *spec, double going_right, double going_left)
{
    return spec->speed * cbrt(1 + 3 * spec->epsilon * 0.5 * (going_left - going_right) / (2 * spec->speed));
}

static double breaking_time_of_net(const struct bead_equation_spec *spec, double until)
{
    static double right[NET], left[NET], gap[2][NET];
    static struct node row[NET], next[NET];
    double dx = spec->length / NET, first = INFINITY;
    bool simple = spec->start == BEAD_START_SIMPLE_WAVE;
    for (size_t i = 0; i < NET; i++) {
        double x = dx * (double)i, r = spec->amplitude * (simple ? sin(x) : cos(x)), g = bead_shock_g(spec, r), v = simple ? -g : 0;
        right[i] = v - g;
        left[i] = v + g;
        row[i] = (struct node){x, 0, bead_shock_speed(spec, r)};
        gap[0][i] = gap[1][i] = dx;
    }
    for (size_t level = 1; row[0].t < until && first > row[0].t - 2; level++) {
        for (size_t i = 0; i < NET; i++) {
            size_t j = (i + level) % NET;
            struct node a = row[i], b = row[(i + 1) % NET];
            b.x += i + 1 == NET ? spec->length : 0;
            next[i] = meet(a, b, speed_of(spec, right[i], left[j]));
            /* Time between neighbours that go right, on the way of one that goes left, and the other way round. */
            double now[2] = {next[i].t - b.t, next[i].t - a.t};
            size_t on[2] = {j, i};
            for (int f = 0; f < 2; f++) {
                double before = gap[f][on[f]];
                if (now[f] <= 0 && before > 0)
                    first = fmin(first, next[i].t - 0.5 * (now[1 - f] > 0 ? now[1 - f] : 0));
                gap[f][on[f]] = now[f];
            }
        }
        memcpy(row, next, sizeof row);
    }
    return first;
}

static void standing_waves_break_when_they_should(void **state)
{
    (void)state;
    for (size_t i = 0; i < 3; i++) { /* the net itself */
        struct bead_equation_spec spec = simple_wave;
        spec.epsilon = closed_forms[i].epsilon;
        assert_close(breaking_time_of_net(&spec, 30), closed_forms[i].time, 0.003 * closed_forms[i].time);
    }
    static const double epsilons[] = {0.2, 0.5};
    for (size_t i = 0; i < 2; i++) {
        struct bead_equation_spec spec = standing(epsilons[i]);
        double time = breaking_time_of_net(&spec, 60);
        assert_close(breaking_time(&spec, 1.1 * time), time, 0.005 * time);
    }
}

/* ---- smooth waves ---- */

/* The simple wave at (x, t): the strain that started at x0 runs at its own speed. */
static double exact_strain(const struct bead_equation_spec *spec, double x, double t)
{
    double x0 = x;
    for (int i = 0; i < 60; i++) {
        double r = sin(x0), a = bead_shock_speed(spec, r), slope = spec->epsilon * spec->speed * spec->speed / (2 * a) * cos(x0);
        x0 -= (x0 + a * t - x) / (1 + slope * t);
    }
    return sin(x0);
}

static double mean_of_cell(const struct bead_equation_spec *spec, size_t cells, size_t i, double t)
{
    static const double node[] = {0, 0.5384693101056831, 0.9061798459386640},
                        weight[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
    double dx = spec->length / (double)cells, middle = dx * ((double)i + 0.5),
           sum = 0.5 * weight[0] * exact_strain(spec, middle, t);
    for (int g = 1; g < 3; g++)
        sum += 0.5 * weight[g] *
               (exact_strain(spec, middle - 0.5 * dx * node[g], t) + exact_strain(spec, middle + 0.5 * dx * node[g], t));
    return sum;
}

static double error_of_wave(size_t cells, double step, double until)
{
    struct bead_equation_spec spec = simple_wave;
    spec.points = cells;
    struct bead_motion *motion = start_motion(shock, &spec, 1e-6, step, until);
    move_until(shock, motion, until);
    double worst = 0, *r = field_at(shock, motion, cells, until, BEAD_FIELD_STRAIN);
    for (size_t i = 0; i < cells; i++)
        worst = fmax(worst, fabs(r[i] - mean_of_cell(&spec, cells, i, until)));
    free(r);
    shock->equation->destroy(motion);
    return worst;
}

static void smooth_waves_converge_with_order_five(void **state)
{
    (void)state;
    double coarse = error_of_wave(64, 0.02, 3), middle = error_of_wave(128, 0.02 * pow(2, -5. / 3), 3),
           fine = error_of_wave(256, 0.02 * pow(2, -10. / 3), 3);
    if (!(log2(coarse / middle) > 4.5 && log2(middle / fine) > 4.5))
        fail_msg("errors %.3g %.3g %.3g: orders %.3g %.3g", coarse, middle, fine, log2(coarse / middle), log2(middle / fine));
}

static void smooth_waves_are_as_exact_as_asked(void **state)
{
    (void)state;
    struct bead_equation_spec spec = simple_wave;
    assert_below(error_of_wave(shock->count(&(struct bead_chain_spec){.equation = spec}, 1e-4), 0, 5), 1e-4);
    assert_below(error_of_wave(shock->count(&(struct bead_chain_spec){.equation = spec}, 1e-6), 0, 5), 1e-6);
}

/* Without epsilon waves only move; the displacement is the integral of the strain, moved by the velocity. */
static void linear_waves_only_move(void **state)
{
    (void)state;
    struct bead_equation_spec spec = simple_wave;
    spec.epsilon = 0;
    spec.points = 256;
    struct bead_motion *motion = start_motion(shock, &spec, 1e-6, 0, 3);
    move_until(shock, motion, 2.5);
    double *u = field_at(shock, motion, 256, 2.5, BEAD_FIELD_DISPLACEMENT),
           *v = field_at(shock, motion, 256, 2.5, BEAD_FIELD_VELOCITY), time;
    for (size_t i = 0; i < 256; i++) {
        double x = 2 * M_PI * ((double)i + 0.5) / 256;
        assert_close(u[i] - u[0], cos(M_PI / 256 - 2.5) - cos(x - 2.5), 2e-6); /* 3 dx^4 / 128, and the times */
        assert_close(v[i], -sin(x - 2.5), 4e-5);                               /* a cell's mean */
    }
    assert_false(has_measure(shock, motion, "breaking time", &time));
    free(u);
    free(v);
    shock->equation->destroy(motion);
}

/* ---- behind the shock ---- */

static void shocks_keep_mass_and_momentum_and_take_energy(void **state)
{
    (void)state;
    struct bead_equation_spec specs[] = {simple_wave, standing(0.2), standing(-0.4)};
    for (size_t i = 0; i < 3; i++) {
        struct bead_motion *motion = start_motion(shock, &specs[i], 1e-5, 0, 40);
        move_until(shock, motion, 40);
        assert_below(fabs(measure(shock, motion, "change of the integral of the strain")), 1e-12);
        assert_below(fabs(measure(shock, motion, "change of the momentum")), 1e-12);
        assert_below(measure(shock, motion, "change of the energy, relative"), -0.1);
        assert_below(measure(shock, motion, "energy out of nothing, relative"), 1e-4);
        assert_below(measure(shock, motion, "largest total variation, relative"), 1.02);
        shock->equation->destroy(motion);
    }
}

/* Total variation of v - g and v + g around the ring, g = 2 c / (3 e) ((1 + e r)^(3/2) - 1). */
static double variation_of(struct bead_motion *motion, const struct bead_equation_spec *spec)
{
    const size_t n = spec->points;
    const double t = shock->equation->time(motion);
    double *r = field_at(shock, motion, n, t, BEAD_FIELD_STRAIN), *v = field_at(shock, motion, n, t, BEAD_FIELD_VELOCITY), sum = 0;
    for (size_t i = 0; i < n; i++) {
        const size_t next = (i + 1) % n;
        const double change =
            2 * spec->speed / (3 * spec->epsilon) * (pow(1 + spec->epsilon * r[next], 1.5) - pow(1 + spec->epsilon * r[i], 1.5));
        sum += fabs(v[next] - v[i] - change) + fabs(v[next] - v[i] + change);
    }
    free(r);
    free(v);
    return sum;
}

/* Waves that meet vary more than each alone; what is told is the most of all steps. */
static void variations_are_those_of_the_invariants(void **state)
{
    (void)state;
    struct bead_equation_spec spec = standing(0.4);
    struct bead_message msg = {""};
    spec.points = 60;
    struct bead_motion *motion = start_motion(shock, &spec, 1e-5, 0, 20);
    const double first = variation_of(motion, &spec);
    double most = first;
    while (shock->equation->time(motion) < 20) {
        assert_int_equal(shock->equation->step(motion, &msg), BEAD_OK);
        most = fmax(most, variation_of(motion, &spec));
    }
    assert_true(most > 1.0001 * first);
    assert_close(measure(shock, motion, "largest total variation, relative"), most / first, 1e-12);
    shock->equation->destroy(motion);
}

/* Where a shock is: the place, between cells, where the strain falls through the mean of both sides, 8 cells away. */
static bool find_shock(const double *r, size_t cells, double dx, double *at, double sides[2])
{
    size_t steepest = 0;
    for (size_t i = 20; i + 20 < cells; i++) {
        if (r[i] - r[i + 1] > r[steepest] - r[steepest + 1])
            steepest = i;
    }
    if (steepest < 20)
        return false;
    sides[0] = r[steepest - 8];
    sides[1] = r[steepest + 8];
    double middle = 0.5 * (sides[0] + sides[1]);
    for (size_t i = steepest - 8; i < steepest + 8; i++) {
        if (r[i] >= middle && r[i + 1] < middle)
            *at = dx * ((double)i + (r[i] - middle) / (r[i] - r[i + 1]));
    }
    return true;
}

/* H. Rankine, P.-H. Hugoniot: its speed squared is the jump of the stress by that of the strain. */
static void shocks_have_their_speed(void **state)
{
    (void)state;
    struct bead_equation_spec spec = simple_wave;
    spec.points = 2000;
    spec.epsilon = 0.5;
    struct bead_motion *motion = start_motion(shock, &spec, 1e-6, 0, 10);
    double dx = spec.length / 2000, from = 6.6, to = 8.6, path = 0, start = 0, at = 0, sides[2] = {0, 0};
    enum { PARTS = 20 };
    for (int i = 0; i <= PARTS; i++) {
        double t = from + (to - from) * i / PARTS;
        move_until(shock, motion, t);
        double *r = field_at(shock, motion, 2000, t, BEAD_FIELD_STRAIN);
        if (!find_shock(r, 2000, dx, &at, sides))
            fail_msg("no shock inside the domain at %g", t);
        double jump = bead_shock_stress(&spec, sides[0]) - bead_shock_stress(&spec, sides[1]);
        path += (i == 0 || i == PARTS ? 0.5 : 1) * (to - from) / PARTS * sqrt(jump / (sides[0] - sides[1]));
        start = i == 0 ? at : start;
        free(r);
    }
    assert_close(at - start, path, 0.002 * path);
    shock->equation->destroy(motion);
}

/* ---- pulses ---- */

static void a_pulse_to_the_left_mirrors_that_to_the_right(void **state)
{
    (void)state;
    struct bead_equation_spec spec = simple_wave;
    spec.start = BEAD_START_PULSE;
    spec.length = 20;
    spec.at = 10;
    spec.width = 0.8;
    spec.points = 400;
    double *r[2];
    for (int way = 0; way < 2; way++) {
        spec.moving = way ? BEAD_MOVING_LEFT : BEAD_MOVING_RIGHT;
        struct bead_motion *motion = start_motion(shock, &spec, 1e-6, 0, 15);
        move_until(shock, motion, 15);
        r[way] = field_at(shock, motion, 400, 15, BEAD_FIELD_STRAIN);
        shock->equation->destroy(motion);
    }
    for (size_t i = 0; i < 400; i++)
        assert_close(r[1][i], r[0][399 - i], 1e-10);
    free(r[0]);
    free(r[1]);
}

/* ---- bad input ---- */

static void strains_without_waves_are_refused(void **state)
{
    (void)state;
    const char *key = "";
    struct bead_equation_spec spec = simple_wave;
    spec.amplitude = 5;
    assert_non_null(shock->equation->check(&spec, &key));
    assert_string_equal(key, "start");
    spec.amplitude = -5;
    assert_non_null(shock->equation->check(&spec, &key));
    spec.start = BEAD_START_PULSE;
    spec.width = 1;
    assert_non_null(shock->equation->check(&spec, &key));
    spec.amplitude = 5; /* of one sign, that which makes waves faster */
    assert_null(shock->equation->check(&spec, &key));
}

static void steps_too_long_are_told(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_motion *motion = NULL;
    struct bead_motion_settings settings = {&simple_wave, 100, "auto", 1e-6, 0.1, 1, 0, 0};
    assert_int_equal(shock->equation->create(&settings, &motion, &msg), BEAD_ERROR_SCENE);
    shock->equation->destroy(motion);
    assert_non_null(strstr(msg.text, "too long"));
}

/* A grid that eats a smooth wave's energy is refused, as by kdv. */
static void a_grid_too_coarse_is_told(void **state)
{
    (void)state;
    static const size_t points[] = {16, 32, 128};
    for (size_t i = 0; i < 3; i++) {
        struct bead_equation_spec spec = simple_wave;
        struct bead_message msg = {""};
        enum bead_error err = BEAD_OK;
        spec.epsilon = 0.5;
        spec.points = points[i];
        struct bead_motion *motion = start_motion(shock, &spec, 1e-6, 0, 8);
        while (!err && shock->equation->time(motion) < 8)
            err = shock->equation->step(motion, &msg);
        assert_int_equal(err, points[i] < 64 ? BEAD_ERROR_NUMBERS : BEAD_OK);
        assert_true(!err || strstr(msg.text, "needs more points"));
        shock->equation->destroy(motion);
    }
}

/* A value of a ring less that of the cubic through `half` neighbours on each side by least squares (A. Savitzky, M. J. E. Golay,
 * Anal. Chem. 36, 1627 (1964)). */
static double off_the_cubic(size_t n, const double *u, size_t at, int half)
{
    double sum = 0;
    for (int k = -half; k <= half; k++)
        sum += 3.0 * (3 * half * half + 3 * half - 1 - 5 * k * k) * u[(at + n + (size_t)(k + half) - (size_t)half) % n];
    return u[at] - sum / ((2 * half - 1) * (2 * half + 1) * (2 * half + 3));
}

/* The manual's statements about the ripples behind a shock: their height, and that the rest of the wave has none. */
static void ripples_behind_a_shock_are_small(void **state)
{
    (void)state;
    enum { POINTS = 512, NEXT_TO_IT = 20 };
    struct bead_equation_spec spec = simple_wave;
    assert_non_null(strstr(shock->help, "20 points behind a shock, up to 0.1 %"));
    spec.epsilon = 0.5;
    spec.points = POINTS;
    struct bead_motion *motion = start_motion(shock, &spec, 1e-6, 0, 14);
    for (int t = 5; t <= 14; t++) {
        move_until(shock, motion, t);
        double *u = field_at(shock, motion, POINTS, t, BEAD_FIELD_STRAIN), least = INFINITY, most = -INFINITY;
        size_t front = 0;
        for (size_t i = 0; i < POINTS; i++) {
            least = fmin(least, u[i]);
            most = fmax(most, u[i]);
            if (u[i] - u[(i + 1) % POINTS] > u[front] - u[(front + 1) % POINTS])
                front = i;
        }
        for (size_t k = 10; k < POINTS - NEXT_TO_IT; k++) {
            double ripple = fabs(off_the_cubic(POINTS, u, (front + POINTS - k) % POINTS, k < NEXT_TO_IT ? 4 : 12));
            assert_below(ripple, (k < NEXT_TO_IT ? 0.001 : 0.0004) * (most - least));
        }
        free(u);
    }
    shock->equation->destroy(motion);
}

/* What headings show is the equation, with its coefficients. */
static void headings_show_the_equation(void **state)
{
    static const struct {
        const char *keys, *says;
    } cases[] = {{"epsilon: 0.5", "u\u209c\u209c = (1 + 0.5 u\u2093) u\u2093\u2093"},
                 {"epsilon: -0.25, speed: 2", "u\u209c\u209c = 4 (1 \u2212 0.25 u\u2093) u\u2093\u2093"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct bead_scene *scene = NULL;
        struct bead_chain *chain = NULL;
        char yaml[300], text[200];
        snprintf(yaml, sizeof yaml,
                 "chain: {equation: shock, %s, length: 6.2832, start: {simple-wave: 1, amplitude: 1}}\nsimulate: {until: 1}\n"
                 "outputs: [{image: a.svg}]\n",
                 cases[i].keys);
        assert_int_equal(bead_scene_parse("test", yaml, strlen(yaml), NULL, &scene, NULL), BEAD_OK);
        assert_int_equal(bead_chain_create(scene, 0, &chain, NULL), BEAD_OK);
        bead_chain_describe(chain, text, sizeof text);
        assert_string_equal(text, cases[i].says);
        bead_chain_destroy(chain);
        bead_scene_free(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(simple_waves_break_when_they_should),
                                       cmocka_unit_test(breaking_times_converge_with_order_three),
                                       cmocka_unit_test(the_closed_form_is_told),
                                       cmocka_unit_test(standing_waves_break_when_they_should),
                                       cmocka_unit_test(smooth_waves_converge_with_order_five),
                                       cmocka_unit_test(smooth_waves_are_as_exact_as_asked),
                                       cmocka_unit_test(linear_waves_only_move),
                                       cmocka_unit_test(shocks_keep_mass_and_momentum_and_take_energy),
                                       cmocka_unit_test(variations_are_those_of_the_invariants),
                                       cmocka_unit_test(shocks_have_their_speed),
                                       cmocka_unit_test(a_pulse_to_the_left_mirrors_that_to_the_right),
                                       cmocka_unit_test(strains_without_waves_are_refused),
                                       cmocka_unit_test(steps_too_long_are_told),
                                       cmocka_unit_test(a_grid_too_coarse_is_told),
                                       cmocka_unit_test(ripples_behind_a_shock_are_small),
                                       cmocka_unit_test(headings_show_the_equation)};
    return cmocka_run_group_tests_name("shock", tests, NULL, NULL);
}
