/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of systems: every row is complete and its traits agree with each other; the fields of equations agree, too. */
#include "tests/motions.h"

#include "beadreel/law.h"

static bool moves(const struct bead_equation *e)
{
    return e->check && e->create && e->destroy && e->pace && e->time && e->step && e->sample && e->evaluations && e->state &&
           e->energy && e->measures;
}

/* Traits that no system has one without the other. */
static const char *contradicts(const struct bead_system *system)
{
    if (system->has_contacts == !!system->equation)
        return "contacts or an equation, one of the two";
    if (system->equation && (!moves(system->equation) || !system->label[0]))
        return "a function of the equation, or its label";
    if (system->has_contacts && !(system->has_masses && system->time_unit[0]))
        return "masses and units of its contacts";
    return system->has_striker && !system->has_contacts ? "contacts for the striker" : NULL;
}

/* The member that a row lacks; NULL: it is complete. */
static const char *lacks(const struct bead_system *system)
{
    if (!system->name || !system->help || !system->label)
        return "name, help or label";
    if (!system->points || !system->axis || !system->axis_unit || !system->time_unit)
        return "words or units";
    if (!system->field || !system->field_signed || !system->describe || !system->count || !system->places)
        return "a function";
    if (!system->modes != !system->mode_title)
        return "modes or their title";
    return contradicts(system);
}

/* Its fields have names and titles; those that its modes need are among them. */
static void check_fields(const struct bead_system *system)
{
    unsigned known = 0;
    for (const enum bead_field *field = system->fields; field && *field < BEAD_FIELD_COUNT; field++) {
        const struct bead_field_info *info = system->field(*field);
        assert_string_equal(info->name, bead_field_info(*field)->name);
        assert_true(info->title[0] && !info->unit[0] == !system->time_unit[0]);
        known |= BEAD_FIELD_BIT(*field);
    }
    assert_int_equal(system->mode_fields & ~known, 0);
}

/* Motion has two directions, forces and energies one sign; a compression, too, where contacts open. */
static void signs_are_those_of_fields(void **state)
{
    (void)state;
    static const struct {
        const char *law;
        enum bead_field field;
        bool is;
    } cases[] = {{"hertz", BEAD_FIELD_VELOCITY, true},     {"hertz", BEAD_FIELD_DISPLACEMENT, true},
                 {"hertz", BEAD_FIELD_FORCE, false},       {"hertz", BEAD_FIELD_CONTACT_FORCE, false},
                 {"hertz", BEAD_FIELD_COMPRESSION, false}, {"hertz", BEAD_FIELD_ENERGY, false},
                 {"power", BEAD_FIELD_COMPRESSION, false}, {"fpu-alpha", BEAD_FIELD_COMPRESSION, true},
                 {"fpu-alpha", BEAD_FIELD_ENERGY, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct bead_chain_spec spec = {.system = &bead_system_beads, .law = {.row = bead_law_find(cases[i].law)}};
        assert_int_equal(spec.system->field_signed(&spec, cases[i].field), cases[i].is);
    }
}

static void rows_are_whole(void **state)
{
    (void)state;
    const struct bead_system *system;
    for (size_t i = 0; (system = bead_system_info(i)); i++) {
        if (lacks(system))
            fail_msg("%s lacks %s", system->name, lacks(system));
        check_fields(system);
        for (size_t k = 0; k < i; k++)
            assert_string_not_equal(bead_system_info(k)->name, system->name);
    }
    assert_ptr_equal(bead_system_info(0), &bead_system_beads);
}

static void rows_that_are_not_are_refused(void **state)
{
    (void)state;
    struct bead_system some = bead_system_kdv;
    some.points = NULL;
    assert_string_equal(lacks(&some), "words or units");
    some = bead_system_kdv;
    some.count = NULL;
    assert_string_equal(lacks(&some), "a function");
    some = bead_system_kdv;
    some.mode_title = NULL;
    assert_string_equal(lacks(&some), "modes or their title");
    some = bead_system_kdv;
    some.equation = NULL;
    assert_string_equal(lacks(&some), "contacts or an equation, one of the two");
    some = bead_system_fput;
    struct bead_equation halts = *some.equation;
    halts.step = NULL;
    some.equation = &halts;
    assert_string_equal(lacks(&some), "a function of the equation, or its label");
    some = bead_system_beads;
    some.time_unit = "";
    assert_string_equal(lacks(&some), "masses and units of its contacts");
}

/* Each mass has its kinetic energy and half of the energy r^2/2 + alpha r^3/3 + beta r^4/4 of both springs, and the mean of their
 * strains. In a ring they add up to the energy of the string, between walls to all but half of the outer springs. */
static void strings_have_their_energies(void **state)
{
    (void)state;
    enum { N = 9 };
    static const struct bead_system *const fput = &bead_system_fput;
    for (int ring = 0; ring < 2; ring++) {
        const struct bead_equation_spec spec = {.points = N,
                                                .ends = ring ? BEAD_ENDS_PERIODIC : BEAD_ENDS_FIXED,
                                                .alpha = 0.25,
                                                .beta = 0.5,
                                                .start = BEAD_START_MODE,
                                                .mode = 1,
                                                .amplitude = 1};
        struct bead_motion *motion = start_motion(fput, &spec, 1e-10, 0, 7);
        const double first = fput->equation->energy(motion);
        move_until(fput, motion, 7);
        double *u = field_at(fput, motion, N, 7, BEAD_FIELD_DISPLACEMENT), *v = field_at(fput, motion, N, 7, BEAD_FIELD_VELOCITY);
        double *e = field_at(fput, motion, N, 7, BEAD_FIELD_ENERGY), *strain = field_at(fput, motion, N, 7, BEAD_FIELD_STRAIN);
        double of_spring[N + 1], r[N + 1], all = 0, sum = 0;
        for (int k = 0; k <= N; k++) { /* spring k is left of mass k */
            r[k] = (k < N ? u[k] : ring ? u[0] : 0) - (k > 0 ? u[k - 1] : ring ? u[N - 1] : 0);
            of_spring[k] = r[k] * r[k] * (1. / 2 + 0.25 * r[k] / 3 + 0.5 * r[k] * r[k] / 4);
            all += ring && k == N ? 0 : of_spring[k];
        }
        for (int j = 0; j < N; j++) {
            assert_near(strain[j], (r[j] + r[j + 1]) / 2, 1e-14);
            assert_near(e[j], v[j] * v[j] / 2 + (of_spring[j] + of_spring[j + 1]) / 2, 1e-14);
            all += v[j] * v[j] / 2;
            sum += e[j];
        }
        assert_near(all, first, 1e-8 * first);
        assert_near(fput->equation->energy(motion), all, 1e-13);
        assert_near(sum + (ring ? 0 : (of_spring[0] + of_spring[N]) / 2), all, 1e-13);
        fput->equation->destroy(motion);
        free(u), free(v), free(e), free(strain);
    }
}

/* Springs of a string that starts with a pulse, however narrow, have its strain in their middle, less what the ends, or the ring,
 * take back of all; also the last. */
static void pulses_are_the_strains_asked_for(void **state)
{
    (void)state;
    enum { N = 11 };
    static const struct bead_system *const fput = &bead_system_fput;
    for (int n = 0; n < 4; n++) {
        const bool ring = n % 2;
        const size_t springs = ring ? N : N + 1;
        const struct bead_equation_spec spec = {.points = N,
                                                .ends = ring ? BEAD_ENDS_PERIODIC : BEAD_ENDS_FIXED,
                                                .alpha = 0.25,
                                                .start = BEAD_START_PULSE,
                                                .amplitude = 0.1,
                                                .width = n < 2 ? 0.3 : 2,
                                                .at = 4.3};
        struct bead_motion *motion = start_motion(fput, &spec, 1e-10, 0, 1);
        double *u = field_at(fput, motion, N, 0, BEAD_FIELD_DISPLACEMENT), asked[N + 1], mean = 0;
        for (size_t k = 0; k < springs; k++) { /* left of mass k, which a ring begins with, and a wall has at 1 */
            asked[k] = 0;
            for (int image = -1; image <= 1; image++) {
                const double x = ((double)k - 0.5 + (ring ? 0 : 1) - spec.at + image * N) / spec.width;
                asked[k] += ring || image == 0 ? 0.1 / (cosh(x) * cosh(x)) : 0;
            }
            mean += asked[k] / (double)springs;
        }
        for (size_t k = 0; k < springs; k++) {
            const double left = k > 0 ? u[k - 1] : ring ? u[N - 1] : 0, right = k < N ? u[k] : 0;
            assert_near(right - left, asked[k] - mean, 1e-15);
        }
        fput->equation->destroy(motion);
        free(u);
    }
}

/* Of a smooth wave: the energy of each cell is v^2/2 + c^2 (r^2/2 + epsilon r^3/6), their sum that of the start, and the strain is
 * the slope of the displacement. */
static void waves_have_their_energies(void **state)
{
    (void)state;
    enum { N = 200 };
    static const struct bead_system *const shock = &bead_system_shock;
    static const double dx = 10. / N, end = 0.3;
    const struct bead_equation_spec spec = {
        .points = N, .length = 10, .speed = 2, .epsilon = 0.5, .start = BEAD_START_COSINE, .mode = 2, .amplitude = 0.1};
    struct bead_motion *motion = start_motion(shock, &spec, 1e-6, 0, end);
    const double first = shock->equation->energy(motion);
    move_until(shock, motion, end);
    double *r = field_at(shock, motion, N, end, BEAD_FIELD_STRAIN), *v = field_at(shock, motion, N, end, BEAD_FIELD_VELOCITY);
    double *e = field_at(shock, motion, N, end, BEAD_FIELD_ENERGY), *u = field_at(shock, motion, N, end, BEAD_FIELD_DISPLACEMENT);
    double all = 0, most = 0;
    for (int i = 0; i < N; i++) {
        const int a = (i + N - 2) % N, b = (i + N - 1) % N, c = (i + 1) % N, d = (i + 2) % N;
        assert_near(e[i], v[i] * v[i] / 2 + 4 * r[i] * r[i] * (1. / 2 + 0.5 * r[i] / 6), 1e-15);
        assert_near((8 * (u[c] - u[b]) - (u[d] - u[a])) / (12 * dx), r[i], 1e-4);
        most = fmax(most, fabs(r[i]));
        all += dx * e[i];
    }
    assert_true(most > 0.05);
    assert_near(all, first, 1e-5 * first);
    shock->equation->destroy(motion);
    free(u), free(v), free(e), free(r);
}

/* Cells that are shown have the means of finer ones, whose faces lie elsewhere: of a cosine, known exactly. */
static void shown_cells_have_their_means(void **state)
{
    (void)state;
    enum { CELLS = 96, SHOWN = 40 };
    static const struct bead_system *const shock = &bead_system_shock;
    const struct bead_equation_spec spec = {
        .points = CELLS, .length = 2 * M_PI, .speed = 1, .epsilon = 0.5, .start = BEAD_START_COSINE, .mode = 1, .amplitude = 0.1};
    struct bead_message msg = {""};
    struct bead_motion *motion;
    const struct bead_motion_settings settings = {&spec, CELLS, "auto", 1e-6, 0, 1, SHOWN, 0};
    assert_int_equal(shock->equation->create(&settings, &motion, &msg), BEAD_OK);
    double *r = field_at(shock, motion, SHOWN, 0, BEAD_FIELD_STRAIN), *fine = NULL, most = 0;
    struct bead_motion *all = start_motion(shock, &spec, 1e-6, 0, 1);
    fine = field_at(shock, all, CELLS, 0, BEAD_FIELD_STRAIN);
    for (int i = 0; i < CELLS; i++)
        assert_near(fine[i], 0.1 * (sin(2 * M_PI * (i + 1) / CELLS) - sin(2 * M_PI * i / CELLS)) / (2 * M_PI / CELLS), 1e-13);
    for (int i = 0; i < SHOWN; i++)
        most = fmax(most, fabs(r[i] - 0.1 * (sin(2 * M_PI * (i + 1) / SHOWN) - sin(2 * M_PI * i / SHOWN)) / (2 * M_PI / SHOWN)));
    assert_below(most, 1e-9);
    shock->equation->destroy(motion);
    shock->equation->destroy(all);
    free(r), free(fine);
}

/* Of a cubic known by its values and slopes at both ends of a step, one of which rises and the other falls, the extremum is where
 * the quadratic formula has it. */
static void extrema_of_steps_are_those_of_cubics(void **state)
{
    (void)state;
    for (int k = 0; k < 60; k++) {
        const double h = 0.1 * (1 + k % 7), a = 0.3 * k - 5, b = (k % 2 ? 1 : -1) * (0.2 + 0.1 * (k % 11)), d = 0.05 * (k % 13 - 6);
        const double c =
            -(b + 3 * d * h * h) / (2 * h) - (b > 0 ? 0.7 : -0.7) * (1 + k % 3); /* so that the other end has the other sign */
        const double slope = b + 2 * c * h + 3 * d * h * h, end = a + h * (b + h * (c + h * d));
        double part;
        assert_true(b * slope < 0);
        const double found = bead_step_extremum(h, a, b, end, slope, &part);
        const double root = d == 0 ? -b / (2 * c) : b / (-c - copysign(sqrt(c * c - 3 * b * d), c));
        const double at = d == 0 || (root > 0 && root < h) ? root : (-c - copysign(sqrt(c * c - 3 * b * d), c)) / (3 * d);
        assert_true(fabs(part - at / h) < 1e-9 && fabs(found - (a + at * (b + at * (c + at * d)))) < 1e-9);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(extrema_of_steps_are_those_of_cubics),
        cmocka_unit_test(rows_are_whole),
        cmocka_unit_test(signs_are_those_of_fields),
        cmocka_unit_test(rows_that_are_not_are_refused),
        cmocka_unit_test(strings_have_their_energies),
        cmocka_unit_test(pulses_are_the_strains_asked_for),
        cmocka_unit_test(waves_have_their_energies),
        cmocka_unit_test(shown_cells_have_their_means),
    };
    return cmocka_run_group_tests_name("systems", tests, NULL, NULL);
}
