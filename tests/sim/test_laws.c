/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pair forces: every row of the table is whole and agrees with itself, and a row that no other file knows works like any. */
#include "chains.h"

#include "sim/run/method_choice.h"

static const struct bead_law_spec numbers = {.power = 1.7, .coefficient = 3e9, .alpha = -40, .stiffness = 2e5};

/* What a row lacks; NULL: it is whole. */
static const char *lacks(const struct bead_law *law)
{
    if (!law->name || !law->description)
        return "name or description";
    if (!law->energy || !law->force || !law->stiffness || !law->compression || !law->energy_compression)
        return "a function of the force";
    if (!law->coefficient || !law->coefficient_power)
        return "coefficient";
    if (law->hertz && !(law->one_sided && law->exponent && law->exponent(&numbers) == 1.5))
        return "what Hertz's force is known by";
    return law->as_printed && !law->hertz ? "a force that the thesis's program has" : NULL;
}

static void rows_are_whole(void **state)
{
    (void)state;
    const struct bead_law *law;
    for (size_t i = 0; (law = bead_law_info(i)); i++) {
        if (lacks(law))
            fail_msg("%s lacks %s", law->name, lacks(law));
        assert_ptr_equal(bead_law_find(law->name), law);
    }
    assert_null(bead_law_find("herz"));
    struct bead_law some = *bead_law_find("hertz");
    some.coefficient = NULL;
    assert_string_equal(lacks(&some), "coefficient");
    some = *bead_law_find("hertz");
    some.exponent = NULL;
    assert_string_equal(lacks(&some), "what Hertz's force is known by");
    some = *bead_law_find("power");
    some.hertz = true;
    assert_string_equal(lacks(&some), "what Hertz's force is known by");
}

/* Force and stiffness are the derivatives of energy and force, the inverses invert, and the exponent is that of the force. */
static void check_row(const struct bead_law *law)
{
    const double a = 3e9, d = 1e-6, e = 1e-9;
    const struct bead_law_spec *s = &numbers;
    assert_near((law->energy(a, s, d + e) - law->energy(a, s, d - e)) / (2 * e) / law->force(a, s, d), 1, 1e-6);
    assert_near((law->force(a, s, d + e) - law->force(a, s, d - e)) / (2 * e) / law->stiffness(a, s, d), 1, 1e-6);
    assert_near(law->compression(a, s, law->force(a, s, d)) / d, 1, 1e-12);
    assert_true(law->energy_compression(a, s, law->energy(a, s, d)) > (1 - 1e-12) * d);
    assert_true(law->one_sided == (law->force(a, s, -d) == 0));
    /* Nothing presses, or there is no contact: no compression. */
    assert_true(law->compression(a, s, 0) == 0 && law->energy_compression(a, s, 0) == 0);
    assert_true(law->compression(0, s, 1) == 0 && law->energy_compression(0, s, 1) == 0);
    if (law->exponent)
        assert_near(log2(law->force(a, s, 2 * d) / law->force(a, s, d)), law->exponent(s), 1e-12);
}

static void rows_agree_with_themselves(void **state)
{
    (void)state;
    const struct bead_law *law;
    for (size_t i = 0; (law = bead_law_info(i)); i++)
        check_row(law);
}

/* The law k d (1 - alpha d) has a largest force, k / (4 alpha): more cannot be held, and no chain is made. */
static void a_force_beyond_the_law_is_refused(void **state)
{
    (void)state;
    const struct bead_law *law = bead_law_find("fpu-alpha");
    const struct bead_law_spec spec = {.alpha = 1000};
    assert_near(law->compression(1e7, &spec, 2499) * 1000, 0.5, 0.02);
    assert_true(isnan(law->compression(1e7, &spec, 2501)));
    static const char text[] =
        "chain: {beads: [{bead: ptfe, count: 3}], law: {fpu-alpha: 1000, stiffness: 1e7}, precompression: 2501 N}\n"
        "outputs: [{table: a.csv}]\n";
    struct bead_message msg = {""};
    struct bead_scene *scene = NULL;
    struct bead_chain *chain = (void *)&msg; /* no chain: it must be cleared */
    assert_int_equal(bead_scene_parse("test", text, strlen(text), NULL, 0, &scene, &msg), BEAD_OK);
    assert_int_equal(bead_chain_create(scene, 0, &chain, &msg), BEAD_ERROR_SCENE);
    assert_non_null(strstr(msg.text, "test:1:8: chain: a contact's stiffness is not"));
    assert_null(chain);
    assert_int_equal(bead_chain_create(scene, 1, &chain, &msg), BEAD_ERROR_USAGE);
    assert_non_null(strstr(msg.text, "chain 1: the scene has 1"));
    bead_scene_free(scene);
}

/* ---- a linear spring, which the program does not have ---- */

static double spring_energy(double a, const struct bead_law_spec *spec, double d)
{
    (void)spec;
    return d > 0 ? 0.5 * a * (d * d) : 0;
}

static double spring_force(double a, const struct bead_law_spec *spec, double d)
{
    (void)spec;
    return d > 0 ? a * d : 0;
}

static double spring_stiffness(double a, const struct bead_law_spec *spec, double d)
{
    (void)spec;
    return d > 0 ? a : 0;
}

static double spring_compression(double a, const struct bead_law_spec *spec, double f)
{
    (void)spec;
    return f > 0 && a > 0 ? f / a : 0;
}

static double spring_energy_compression(double a, const struct bead_law_spec *spec, double e)
{
    (void)spec;
    return e > 0 && a > 0 ? sqrt(2 * e / a) : 0;
}

static double spring_coefficient(const struct bead_law_spec *spec, const struct bead_material *left,
                                 const struct bead_material *right, bool wall)
{
    (void)left;
    (void)right;
    (void)wall;
    return spec->stiffness;
}

static double one(const struct bead_law_spec *spec)
{
    (void)spec;
    return 1;
}

static struct bead_law spring = {.name = "spring",
                                 .description = "k d, one-sided",
                                 .one_sided = true,
                                 .exponent = one,
                                 .coefficient = spring_coefficient,
                                 .coefficient_power = one,
                                 .energy = spring_energy,
                                 .force = spring_force,
                                 .stiffness = spring_stiffness,
                                 .compression = spring_compression,
                                 .energy_compression = spring_energy_compression};

/* 32 dimers with a wall; waves come back, and contacts open. */
static struct bead_stepper *struck(struct setup *x, const struct bead_law *law, double precompression, const char *method, double h)
{
    describe(x, 2, STEEL, ALUMINIUM, 32, P3_SPINS, 0.443);
    x->spec.law = (struct bead_law_spec){.row = law, .power = 1, .coefficient = 2e6, .stiffness = 2e6};
    x->spec.precompression = precompression;
    make(x);
    return run(x, method, h, 1e-3);
}

static double between(const struct bead_law *one_law, const char *method, double h, const struct bead_law *other, double other_h,
                      double precompression)
{
    struct setup x, y;
    struct bead_stepper *a = struck(&x, one_law, precompression, method, h),
                        *b = struck(&y, other, precompression, "rkn8", other_h);
    double most = difference(a, b) / 0.443;
    drop(&x, a);
    drop(&y, b);
    return most;
}

static void a_new_row_is_the_power_that_it_is(void **state)
{
    (void)state;
    const struct bead_law *power = bead_law_find("power");
    check_row(&spring);
    assert_null(lacks(&spring));
    assert_below(between(&spring, "rkn8", 4e-6, power, 4e-6, 0), 1e-10);
    assert_below(between(&spring, "rkn8", 4e-6, power, 4e-6, 5), 1e-10);
    assert_below(between(&spring, "rkn8", 2e-6, power, 1e-6, 0), 1e-9);
}

static struct bead_method_choice choose(struct setup *x, const char *method, enum bead_error *err, struct bead_message *msg)
{
    struct bead_method_choice choice = {0};
    x->scene.simulate.method = (char *)(uintptr_t)method;
    x->scene.simulate.accuracy = 1e-6;
    *err = bead_choose_method(x->chain, &x->chain->scene->simulate, &choice, msg);
    return choice;
}

/* Nothing is known of how its force begins: its contact events are left alone, and nobody takes it for Hertz's. */
static void a_row_without_exponent_has_no_events(void **state)
{
    (void)state;
    struct bead_law plain = spring;
    struct bead_message msg = {""};
    enum bead_error err;
    struct setup x;
    plain.exponent = NULL;
    struct bead_stepper *s = struck(&x, &plain, 0, "rkn8", 4e-6);
    assert_null(s->events);
    assert_string_equal(choose(&x, "auto", &err, &msg).method->info.name, "rkn8-plain");
    assert_int_equal(err, BEAD_OK);
    choose(&x, "rkn8", &err, &msg);
    assert_int_equal(err, BEAD_ERROR_SCENE);
    assert_non_null(strstr(msg.text, "`spring`"));
    choose(&x, "euler", &err, &msg);
    assert_int_equal(err, BEAD_ERROR_SCENE);
    assert_non_null(strstr(msg.text, "there is no method `euler`"));
    x.spec.damping_coefficient = 1;
    choose(&x, "rkn8-plain", &err, &msg);
    assert_int_equal(err, BEAD_ERROR_SCENE);
    assert_non_null(strstr(msg.text, "is for forces without damping"));
    drop(&x, s);
    const double coarse = between(&plain, "rkn8-plain", 2e-6, &spring, 1e-6, 0);
    const double fine = between(&plain, "rkn8-plain", 0.25e-6, &spring, 1e-6, 0);
    assert_below(coarse, 1e-2);
    assert_below(fine, coarse / 8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_whole),
        cmocka_unit_test(rows_agree_with_themselves),
        cmocka_unit_test(a_force_beyond_the_law_is_refused),
        cmocka_unit_test(a_new_row_is_the_power_that_it_is),
        cmocka_unit_test(a_row_without_exponent_has_no_events),
    };
    return cmocka_run_group_tests_name("laws", tests, NULL, NULL);
}
