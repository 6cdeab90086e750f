/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strings of Fermi, Pasta, Ulam and Tsingou: exact linear waves, recurrence times of converged runs, conserved quantities,
 * solitary pulses. */
#include "scenes.h"

#include "sim/equation/equation.h"

#define close_to(value, wanted, within) check_close(value, wanted, within, #value, __LINE__)
static void check_close(double value, double wanted, double within, const char *what, int line)
{
    if (!(fabs(value - wanted) <= within))
        fail_msg("line %d: %s is %.12g, must be %.12g +- %.2g", line, what, value, wanted, within);
}

static const double pi = 3.14159265358979323846;
static const struct bead_system *const fput = &bead_system_fput;

static struct bead_motion *begin(const struct bead_equation_spec *spec, const char *method, double accuracy, double step,
                                 double end)
{
    struct bead_motion_settings settings = {spec, spec->points, method, accuracy, step, end, 0, 0};
    struct bead_motion *motion = NULL;
    struct bead_message msg = {""};
    if (fput->equation->create(&settings, &motion, &msg))
        fail_msg("%s", msg.text);
    return motion;
}

static void run(struct bead_motion *motion, double t)
{
    struct bead_message msg = {""};
    while (fput->equation->time(motion) < t)
        if (fput->equation->step(motion, &msg))
            fail_msg("%s", msg.text);
}

static double measured(const struct bead_motion *motion, const char *name)
{
    struct bead_measure found[32];
    size_t count = fput->equation->measures(motion, found, 32);
    for (size_t i = 0; i < count; i++)
        if (strcmp(found[i].name, name) == 0)
            return found[i].value;
    fail_msg("no measure `%s`", name);
    return NAN;
}

static struct bead_equation_spec string_of(size_t masses, double alpha, size_t mode)
{
    return (struct bead_equation_spec){.points = masses, .alpha = alpha, .start = BEAD_START_MODE, .mode = mode, .amplitude = 1};
}

/* Of the fastest wave of a linear string, whose motion is known. */
static double error_of(const char *method, double accuracy, double end)
{
    struct bead_equation_spec spec = string_of(31, 0, 31);
    struct bead_motion *m = begin(&spec, method, accuracy, 0, end);
    double w = 2 * sin(pi * 31 / 64), worst = 0;
    size_t count = 0;
    run(m, end);
    const double *state = fput->equation->state(m, &count);
    assert_int_equal(count, 62);
    for (size_t j = 0; j < 31; j++) {
        double s = sin(pi * 31 * (double)(j + 1) / 32);
        worst = fmax(worst, fabs(state[j] - s * cos(w * end)));
        worst = fmax(worst, fabs(state[31 + j] + s * w * sin(w * end)) / w);
    }
    fput->equation->destroy(m);
    return worst;
}

static void every_method_keeps_the_accuracy_asked(void **state)
{
    (void)state;
    for (const char *const *name = fput->equation->methods; *name; name++) {
        bool low = strcmp(*name, "verlet") == 0;
        for (double accuracy = 1e-4; accuracy > (low ? 1e-5 : 1e-9); accuracy /= 100) {
            double error = error_of(*name, accuracy, 100);
            if (!(error < accuracy) || (!(error > 1e-2 * accuracy) && strcmp(*name, "rkn12") != 0))
                fail_msg("%s: asked %g, got %g", *name, accuracy, error);
        }
    }
}

/* Least and largest differences of neighbours, walls with them, at the end of each step. */
static void run_with_strains(struct bead_motion *m, size_t masses, double end, double strain[2])
{
    size_t count = 0;
    for (double t = 0; t < end;) {
        const double *u = fput->equation->state(m, &count);
        for (size_t j = 0; j <= masses; j++) {
            const double r = (j < masses ? u[j] : 0) - (j > 0 ? u[j - 1] : 0);
            strain[0] = fmin(strain[0], r);
            strain[1] = fmax(strain[1], r);
        }
        run(m, nextafter(t, INFINITY));
        t = fput->equation->time(m);
    }
}

/* Masses as drawn keep apart where they are nearest, and reach over more than half of their distance. The negative of a motion is
 * one of -alpha. */
static void masses_have_room(size_t masses, double alpha, double nearest)
{
    char text[200];
    snprintf(text, sizeof text,
             "chain: {equation: fput, points: %zu, alpha: %g, start: {mode: 1, amplitude: 1}}\nsimulate: {until: 1}\n"
             "outputs: [{table: profiles.csv, show: measures}]\n",
             masses, alpha);
    struct bead_scene *scene = parse(text);
    struct bead_chain *chain = NULL;
    assert_int_equal(bead_chain_create(scene, 0, &chain, NULL), BEAD_OK);
    const double diameter = 2 * bead_chain_radius(chain)[0], free = 1 - nearest - diameter;
    if (!(free > 0 && free < 0.2 && diameter > 0.6))
        fail_msg("%zu masses, alpha %g: %g wide, %g apart", masses, alpha, diameter, free);
    bead_chain_destroy(chain);
    bead_scene_free(scene);
}

/* Converged runs of Eq. 5 with alpha = 1/4 from the first mode of amplitude 1. */
static void the_first_mode_returns_when_it_should(void **state)
{
    static const struct {
        size_t masses;
        double end, time, periods, part, lowest, lowest_time;
    } known[] = {{31, 10000, 9376.4, 146.45, .98127, .0883, 6276},
                 {32, 11000, 10130.26, 153.43, NAN, NAN, NAN},
                 {63, 55000, 53449, 417.53, NAN, NAN, NAN}};
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        struct bead_equation_spec spec = string_of(known[i].masses, 0.25, 1);
        struct bead_motion *m = begin(&spec, "auto", 1e-6, 0, known[i].end);
        double strain[2] = {0};
        if (i == 0) {
            run_with_strains(m, known[i].masses, known[i].end, strain);
            masses_have_room(known[i].masses, 0.25, -strain[0]);
            masses_have_room(known[i].masses, -0.25, strain[1]);
        }
        run(m, known[i].end);
        close_to(measured(m, "recurrence time in periods"), known[i].periods, 0.01);
        close_to(measured(m, "recurrence time"), known[i].time, 0.5);
        assert_true(measured(m, "largest error of the energy, relative") < 1e-12);
        if (!isnan(known[i].part)) {
            close_to(measured(m, "energy of the mode at recurrence, relative"), known[i].part, 1e-5);
            close_to(measured(m, "smallest energy of the mode, relative"), known[i].lowest, 1e-4);
            close_to(measured(m, "time of the smallest energy"), known[i].lowest_time, 2);
        }
        fput->equation->destroy(m);
    }
}

/* The 157 periods often quoted: velocity Verlet with the time step of 1955, dt^2 = 1/8. */
static void the_step_of_1955_delays_the_return(void **state)
{
    (void)state;
    struct bead_equation_spec spec = string_of(31, 0.25, 1);
    struct bead_motion *m = begin(&spec, "verlet", 1e-6, 0.35355339059327379, 10500);
    run(m, 10500);
    close_to(measured(m, "recurrence time in periods"), 156.85, 0.1);
    fput->equation->destroy(m);
}

static double sum_of_modes(const struct bead_equation_spec *spec, struct bead_motion *m, double t, double *energy, size_t count)
{
    double u[64], v[64], total = 0;
    double *const to[BEAD_FIELD_COUNT] = {[BEAD_FIELD_DISPLACEMENT] = u, [BEAD_FIELD_VELOCITY] = v};
    const double *const from[BEAD_FIELD_COUNT] = {[BEAD_FIELD_DISPLACEMENT] = u, [BEAD_FIELD_VELOCITY] = v};
    struct bead_message msg;
    assert_int_equal(fput->equation->sample(m, t, fput->mode_fields, to, &msg), BEAD_OK);
    fput->modes(&(struct bead_chain_spec){.equation = *spec}, spec->points, from, count, energy);
    for (size_t k = 0; k < count; k++)
        total += energy[k];
    return total;
}

static void modes_of_linear_strings_keep_their_energies(void **state)
{
    (void)state;
    for (int ring = 0; ring < 2; ring++) {
        struct bead_equation_spec spec = string_of(12, 0, 3);
        spec.ends = ring ? BEAD_ENDS_PERIODIC : BEAD_ENDS_FIXED;
        struct bead_motion *m = begin(&spec, "auto", 1e-9, 0, 77.7);
        double energy[12], total = 12. / 4 * 4 * pow(sin(pi * 3 / 12), 2); /* a quarter of N omega^2 amplitude^2 */
        if (!ring)
            total = 13. / 4 * 4 * pow(sin(pi * 3 / 26), 2);
        run(m, 77.7);
        for (double t = 77.5; t < 77.7; t += 0.07) { /* between steps as well */
            close_to(sum_of_modes(&spec, m, fmax(t, fput->equation->time(m) - 0.01), energy, ring ? 6 : 12), total, 1e-8);
            close_to(energy[2], total, 1e-8);
        }
        close_to(fput->equation->energy(m), total, 1e-9);
        fput->equation->destroy(m);
    }
}

/* All modes together have the energy of the quadratic terms, whatever the state. */
static void modes_share_the_energy(void **state)
{
    (void)state;
    for (int ring = 0; ring < 2; ring++) {
        struct bead_equation_spec spec = string_of(31, 0.25, 1);
        spec.ends = ring ? BEAD_ENDS_PERIODIC : BEAD_ENDS_FIXED;
        struct bead_motion *m = begin(&spec, "auto", 1e-6, 0, 3000);
        double energy[31], quadratic = 0, v2 = 0;
        size_t count = 0;
        run(m, 3000);
        double sum = sum_of_modes(&spec, m, 3000, energy, ring ? 15 : 31);
        const double *u = fput->equation->state(m, &count), *v = u + 31;
        for (size_t j = 0; j <= 31; j++) {
            double left = j > 0 ? u[j - 1] : ring ? u[30] : 0, right = j < 31 ? u[j] : 0;
            quadratic += ring && j == 31 ? 0 : 0.5 * (right - left) * (right - left);
            v2 += j < 31 ? 0.5 * v[j] * v[j] : 0;
        }
        close_to(sum, quadratic + v2, 1e-12);
        assert_true(energy[1] > 1e-3 * sum); /* the second mode has its part by now */
        fput->equation->destroy(m);
    }
}

static size_t highest(const double *x, size_t count)
{
    size_t best = 0;
    for (size_t i = 0; i < count; i++)
        best = x[i] > x[best] ? i : best;
    return best;
}

/* A weak pulse of strain is a soliton of r_t + r_x + alpha r r_x + r_xxx / 24 = 0: amplitude sech^2(x / w), w^2 = 1 / (2 alpha
 * amplitude), speed 1 + alpha amplitude / 3; on a ring it comes by again. */
static void a_pulse_is_a_soliton_of_its_kdv_limit(void **state)
{
    enum { N = 400 };
    static double strain[N];
    const double amplitude = 0.04, alpha = 0.5, end = 1000;
    struct bead_equation_spec spec = {.points = N, .alpha = alpha, .ends = BEAD_ENDS_PERIODIC, .at = 100};
    double *const to[BEAD_FIELD_COUNT] = {[BEAD_FIELD_STRAIN] = strain};
    struct bead_message msg;
    (void)state;
    spec.start = BEAD_START_PULSE;
    spec.amplitude = amplitude;
    spec.width = sqrt(1 / (2 * alpha * amplitude));
    for (int way = 0; way < 2; way++) {
        spec.moving = way ? BEAD_MOVING_LEFT : BEAD_MOVING_RIGHT;
        struct bead_motion *m = begin(&spec, "auto", 1e-8, 0, end);
        run(m, end);
        assert_int_equal(fput->equation->sample(m, end, BEAD_FIELD_BIT(BEAD_FIELD_STRAIN), to, &msg), BEAD_OK);
        size_t top = highest(strain, N);
        double curvature = strain[top - 1] - 2 * strain[top] + strain[top + 1];
        double place = (double)top - 0.5 * (strain[top + 1] - strain[top - 1]) / curvature;
        double gone = way ? 100 - place : place - 100; /* less two or three rounds */
        double excess = fmod(gone + 4 * N, N) - fmod(end, N);
        close_to(excess, end * alpha * amplitude / 3, 0.05 * end * alpha * amplitude / 3);
        close_to(strain[top], amplitude, 1.5 * alpha * amplitude * amplitude); /* the next order */
        for (size_t j = 0; j < N; j++) {                                       /* nothing is left behind */
            double apart = fabs(remainder((double)j - place, N)), wave = amplitude / pow(cosh(apart / spec.width), 2);
            close_to(strain[j], wave, 2 * alpha * amplitude * amplitude);
        }
        close_to(measured(m, "change of the momentum"), 0, 1e-12);
        assert_true(measured(m, "largest error of the energy, relative") < 1e-9);
        fput->equation->destroy(m);
    }
}

/* Strain at the masses' places of a pulse after the time `end`, computed with one equation or the other. */
static void strain_after(const struct bead_system *system, const struct bead_equation_spec *spec, size_t points, double end,
                         double *strain)
{
    struct bead_motion_settings settings = {spec, points, "auto", 1e-8, 0, end, 0, 0};
    struct bead_motion *m = NULL;
    struct bead_message msg = {""};
    double *const to[BEAD_FIELD_COUNT] = {[BEAD_FIELD_STRAIN] = strain};
    if (system->equation->create(&settings, &m, &msg))
        fail_msg("%s", msg.text);
    while (system->equation->time(m) < end)
        assert_int_equal(system->equation->step(m, &msg), BEAD_OK);
    assert_int_equal(system->equation->sample(m, end, BEAD_FIELD_BIT(BEAD_FIELD_STRAIN), to, &msg), BEAD_OK);
    system->equation->destroy(m);
}

/* Largest difference between a string and r_t + r_x + alpha r r_x + r_xxx / 24 = 0, in parts of the pulse. With the amplitude e,
 * lengths go as e^-1/2 and times as e^-3/2: then the two differ by terms of the order of e. */
static double from_limit(double e)
{
    enum { N = 512 };
    static double string[N], limit[2 * N];
    const double end = 10 / (e * sqrt(e)), width = 4 / sqrt(e);
    struct bead_equation_spec spec = {.points = N, .alpha = 0.5, .ends = BEAD_ENDS_PERIODIC, .at = 200};
    spec.start = BEAD_START_PULSE;
    spec.moving = BEAD_MOVING_RIGHT;
    spec.amplitude = e;
    spec.width = width;
    strain_after(&bead_system_fput, &spec, N, end, string);
    spec = (struct bead_equation_spec){.points = 2 * N, .length = N, .drift = 1, .nonlinearity = 0.5};
    spec.dispersion = 1. / 24;
    spec.variable = BEAD_FIELD_STRAIN;
    spec.start = BEAD_START_PULSE;
    spec.amplitude = e;
    spec.width = width;
    spec.at = 200;
    strain_after(&bead_system_kdv, &spec, 2 * N, end, limit);
    double worst = 0;
    for (size_t j = 0; j < N; j++)
        worst = fmax(worst, fabs(string[j] - limit[2 * j]));
    return worst / e;
}

static void long_waves_obey_their_kdv_equation(void **state)
{
    (void)state;
    double weak = from_limit(0.02), strong = from_limit(0.04);
    if (!(weak < 0.05 && strong < 0.1 && strong > 1.7 * weak && strong < 2.3 * weak))
        fail_msg("string and limit differ by %g of an amplitude of 0.02, by %g of 0.04", weak, strong);
}

/* At rest it parts into two halves that run apart. */
static void a_pulse_at_rest_parts_in_two(void **state)
{
    enum { N = 201 };
    static double strain[N];
    double *const to[BEAD_FIELD_COUNT] = {[BEAD_FIELD_STRAIN] = strain};
    struct bead_equation_spec spec = {.points = N, .at = 101, .start = BEAD_START_PULSE, .amplitude = 1, .width = 12};
    struct bead_message msg;
    (void)state;
    struct bead_motion *m = begin(&spec, "auto", 1e-8, 0, 60);
    run(m, 60);
    assert_int_equal(fput->equation->sample(m, 60, BEAD_FIELD_BIT(BEAD_FIELD_STRAIN), to, &msg), BEAD_OK);
    close_to(strain[40], 0.5, 0.01);
    close_to(strain[160], 0.5, 0.01);
    for (size_t j = 0; j < N / 2; j++)
        close_to(strain[j], strain[N - 1 - j], 1e-10);
    fput->equation->destroy(m);
}

/* ---- the piecewise linear force ---- */

static struct bead_equation_spec kinked(size_t masses, double stiffness, double beyond, size_t mode)
{
    struct bead_equation_spec spec = string_of(masses, 0, mode);
    spec.piecewise = (struct bead_piecewise){stiffness, beyond};
    return spec;
}

/* One mass between two springs, let go at u = 1: u'' = -2 u within b, -2 (k u - (k - 1) b) beyond. Arcs of sines, or of a parabola
 * for k = 0, which meet at u = b: time from u = 1 to b, and the speed there. */
struct arcs {
    double k, b, time, speed;
};

static struct arcs arcs_of(double k, double b)
{
    if (k == 0)
        return (struct arcs){k, b, sqrt((1 - b) / b), 2 * b * sqrt((1 - b) / b)};
    double centre = (k - 1) * b / k, high = 1 - centre, w = sqrt(2 * k);
    return (struct arcs){k, b, acos((b - centre) / high) / w, w * sqrt(high * high - (b - centre) * (b - centre))};
}

static double quarter_of(const struct arcs *a)
{
    return a->time + atan(a->b * sqrt(2) / a->speed) / sqrt(2);
}

static double place_at(const struct arcs *a, double t)
{
    double quarter = quarter_of(a), in = fabs(remainder(t, 4 * quarter)); /* from a turning point, at 0 to 2 quarters */
    double sign = in > quarter ? -1 : 1, centre = a->k > 0 ? (a->k - 1) * a->b / a->k : 0;
    in = in > quarter ? 2 * quarter - in : in;
    if (in > a->time)
        return sign * hypot(a->b, a->speed / sqrt(2)) * sin(sqrt(2) * (quarter - in));
    return sign * (a->k > 0 ? centre + (1 - centre) * cos(sqrt(2 * a->k) * in) : 1 - a->b * in * in);
}

static double place_sampled(struct bead_motion *m, double t)
{
    double u = 0;
    double *const to[BEAD_FIELD_COUNT] = {[BEAD_FIELD_DISPLACEMENT] = &u};
    struct bead_message msg;
    assert_int_equal(fput->equation->sample(m, t, BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT), to, &msg), BEAD_OK);
    return u;
}

static void a_mass_moves_on_arcs_of_sines(void **state)
{
    (void)state;
    for (const char *const *name = fput->equation->methods; *name; name++) {
        bool low = strcmp(*name, "verlet") == 0;
        for (int i = 0; i < 7; i++) {
            struct arcs arcs =
                arcs_of((double[]){0, 0.5, 1.1, 3, 40, 2, 0.3}[i], (double[]){0.3, 0.7, 0.5, 0.2, 0.9, 0.999999, 1e-3}[i]);
            double accuracy = low ? 1e-4 : 1e-8, end = 10 * 4 * quarter_of(&arcs);
            struct bead_equation_spec spec = kinked(1, arcs.k, arcs.b, 1);
            struct bead_motion *m = begin(&spec, *name, accuracy, 0, end);
            for (int k = 1; k <= 200; k++) { /* between steps */
                double t = fmin(k * (end / 200), end);
                run(m, t);
                check_close(place_sampled(m, t), place_at(&arcs, t), accuracy, *name, i);
            }
            fput->equation->destroy(m);
        }
    }
}

/* The kinks do not cost a method its order. */
static double energy_lost(const char *method, double step)
{
    struct bead_equation_spec spec = kinked(31, 1.7, 0.03, 1);
    struct bead_motion *m = begin(&spec, method, 1e-6, step, 200);
    run(m, 200);
    double error = measured(m, "largest error of the energy, relative");
    fput->equation->destroy(m);
    return error;
}

static void methods_keep_their_order_at_kinks(void **state)
{
    static const struct {
        const char *method;
        double step;
        int order;
    } rows[] = {{"rk4", 0.2, 4}, {"rkn6", 0.4, 6}, {"rkn8", 0.5, 8}};
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        double coarse = energy_lost(rows[i].method, rows[i].step), fine = energy_lost(rows[i].method, rows[i].step / 2);
        if (!(log2(coarse / fine) > rows[i].order - 0.5))
            fail_msg("%s: %g and %g are of order %.2f", rows[i].method, coarse, fine, log2(coarse / fine));
    }
}

/* Below the kinks the string is linear, and with the stiffness 1 it is so everywhere. */
static void without_kinks_the_string_is_linear(void **state)
{
    (void)state;
    for (int way = 0; way < 2; way++) {
        struct bead_equation_spec spec = kinked(31, way ? 1 : 0.4, way ? 0.01 : 2.1, 31);
        double w = 2 * sin(pi * 31 / 64), end = 100;
        struct bead_motion *m = begin(&spec, "auto", 1e-8, 0, end);
        size_t count = 0;
        run(m, end);
        const double *at = fput->equation->state(m, &count);
        for (size_t j = 0; j < 31; j++)
            close_to(at[j], sin(pi * 31 * (double)(j + 1) / 32) * cos(w * end), 1e-8);
        fput->equation->destroy(m);
    }
}

/* A pulse that goes one way leaves nothing behind, also where its speed has a step; its mirror image goes like it. */
static void a_pulse_beyond_the_kink_goes_one_way(void **state)
{
    enum { N = 601 };
    static double strain[2][N];
    (void)state;
    for (int way = 0; way < 2; way++) {
        struct bead_equation_spec spec = kinked(N, 1.2, 0.3, 1);
        double *const to[BEAD_FIELD_COUNT] = {[BEAD_FIELD_STRAIN] = strain[way]};
        struct bead_message msg;
        spec.start = BEAD_START_PULSE;
        spec.amplitude = 1;
        spec.width = 40;
        spec.at = 301;
        spec.moving = way ? BEAD_MOVING_LEFT : BEAD_MOVING_RIGHT;
        struct bead_motion *m = begin(&spec, "auto", 1e-7, 0, 100);
        run(m, 100);
        assert_int_equal(fput->equation->sample(m, 100, BEAD_FIELD_BIT(BEAD_FIELD_STRAIN), to, &msg), BEAD_OK);
        close_to(strain[way][way ? 400 : 200], 0, 1 / (spec.width * spec.width)); /* where it would be; dispersion leaves this */
        assert_true(measured(m, "largest error of the energy, relative") < 1e-8);
        fput->equation->destroy(m);
    }
    for (size_t j = 0; j < N; j++)
        close_to(strain[0][j], strain[1][N - 1 - j], 1e-6);
}

/* A string that is pulled beyond what it bears ends with a message, not with numbers. */
static void a_torn_string_is_an_error(void **state)
{
    (void)state;
    struct bead_equation_spec spec = string_of(31, 0.25, 1);
    struct bead_message msg = {""};
    spec.amplitude = 60;
    struct bead_motion *m = begin(&spec, "auto", 1e-6, 0, 1000);
    enum bead_error err = BEAD_OK;
    while (!err && fput->equation->time(m) < 1000)
        err = fput->equation->step(m, &msg);
    assert_int_equal(err, BEAD_ERROR_NUMBERS);
    assert_non_null(strstr(msg.text, "torn"));
    fput->equation->destroy(m);
}

/* Where the accuracy allows longer steps than the samples between them do, those of check runs are shorter by their part. */
static void check_runs_have_other_steps(void **state)
{
    (void)state;
    static const double parts[] = {0, 1, 0.5, 0.25};
    const struct bead_equation_spec spec = string_of(16, 0.25, 1);
    double step[4];
    for (int k = 0; k < 4; k++) {
        const struct bead_motion_settings settings = {&spec, spec.points, "auto", 1e-3, 0, 1, 0, parts[k]};
        struct bead_motion *motion = NULL;
        struct bead_message msg = {""};
        struct bead_pace pace;
        if (fput->equation->create(&settings, &motion, &msg))
            fail_msg("%s", msg.text);
        fput->equation->pace(motion, &pace);
        step[k] = pace.step;
        fput->equation->destroy(motion);
    }
    assert_true(step[0] == step[1] && fabs(step[2] / step[1] - 0.5) < 1e-12 && fabs(step[3] / step[1] - 0.25) < 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_keeps_the_accuracy_asked),
        cmocka_unit_test(the_first_mode_returns_when_it_should),
        cmocka_unit_test(the_step_of_1955_delays_the_return),
        cmocka_unit_test(modes_of_linear_strings_keep_their_energies),
        cmocka_unit_test(modes_share_the_energy),
        cmocka_unit_test(a_pulse_is_a_soliton_of_its_kdv_limit),
        cmocka_unit_test(long_waves_obey_their_kdv_equation),
        cmocka_unit_test(a_pulse_at_rest_parts_in_two),
        cmocka_unit_test(a_mass_moves_on_arcs_of_sines),
        cmocka_unit_test(methods_keep_their_order_at_kinks),
        cmocka_unit_test(without_kinks_the_string_is_linear),
        cmocka_unit_test(a_pulse_beyond_the_kink_goes_one_way),
        cmocka_unit_test(a_torn_string_is_an_error),
        cmocka_unit_test(check_runs_have_other_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
