/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pair forces: every row of the table is complete and consistent, and a row that no other file knows works like any other. */
#include "chains.h"

#include "sim/chain/chain_internal.h"
#include "sim/chain/law_beginning.h"
#include "sim/run/method_choice.h"
#include "sim/scene/scene_internal.h"
#include "sim/scene/scene_private.h"

static const struct bead_law_spec numbers = {.power = 1.7, .coefficient = 3e9, .alpha = -40, .stiffness = 2e5};

/* A law as a scene has it: with the examples of its keys, where it has keys. */
static void example_text(const struct bead_law *law, char *text, size_t size)
{
    const struct bead_options *options;
    for (size_t i = 0; (options = bead_law_options(i)) && strcmp(options->name, law->name) != 0;)
        i++;
    if (!options) {
        snprintf(text, size, "%s", law->name);
        return;
    }
    size_t length = 0;
    for (size_t r = 0; r < options->count; r++)
        length += (size_t)snprintf(text + length, size - length, "%s%s: %s", r > 0 ? ", " : "{", options->rows[r].key,
                                   options->rows[r].example);
    snprintf(text + length, size - length, "}");
}

/* Numbers for a row that nobody has to think of here. */
static struct bead_law_spec example_of(const struct bead_law *law)
{
    struct bead_message msg = {""};
    struct bead_scene *scene = NULL;
    char text[512], scene_text[640];
    example_text(law, text, sizeof text);
    snprintf(scene_text, sizeof scene_text, "chain: {beads: [{bead: brass}], law: %s}\noutputs: [{table: a.csv}]\n", text);
    if (bead_scene_parse("examples", scene_text, strlen(scene_text), NULL, &scene, &msg))
        fail_msg("%s: %s", text, msg.text);
    const struct bead_law_spec spec = scene->chains[0].law;
    bead_scene_free(scene);
    assert_ptr_equal(spec.row, law);
    return spec;
}

/* The member that a row lacks; NULL: it is complete. */
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
static void check_row(const struct bead_law *law, const struct bead_law_spec *s, double a)
{
    const double d = 1e-6, e = 1e-10;
    assert_near((law->energy(a, s, d + e) - law->energy(a, s, d - e)) / (2 * e) / law->force(a, s, d), 1, 1e-6);
    assert_near((law->force(a, s, d + e) - law->force(a, s, d - e)) / (2 * e) / law->stiffness(a, s, d), 1, 1e-6);
    assert_near(law->compression(a, s, law->force(a, s, d)) / d, 1, 1e-12);
    /* A bound, which is exact where the force is a power, and else twice the compression of the linear part. */
    const double bound = law->energy_compression(a, s, law->energy(a, s, d));
    assert_true(bound > (1 - 1e-12) * d && bound <= (law->exponent ? 1 + 1e-12 : 2.001) * d);
    assert_true(law->one_sided == (law->force(a, s, -d) == 0));
    /* Nothing presses, or there is no contact: no compression. */
    assert_true(law->compression(a, s, 0) == 0 && law->energy_compression(a, s, 0) == 0);
    assert_true(law->compression(0, s, 1) == 0 && law->energy_compression(0, s, 1) == 0);
    if (law->exponent)
        assert_near(log2(law->force(a, s, 2 * d) / law->force(a, s, d)), law->exponent(s), 1e-12);
}

/* Derivatives of a coefficient by radii and moduli, over itself, beside differences: between spheres, at a wall, at a rigid one. */
static void check_rates(const struct bead_law *law)
{
    const struct bead_law_spec spec = example_of(law);
    static const double part = 1e-5;
    for (int n = 0; law->coefficient_rates && n < 3; n++) {
        struct bead_material pair[2] = {materials[STEEL], materials[LIGHT]};
        const struct bead_material *right = n < 2 ? &pair[1] : NULL;
        const struct bead_coefficient_rates rates = law->coefficient_rates(&pair[0], right, n > 0);
        for (int i = 0; i < 4; i++) {
            double *value = i < 2 ? &pair[i].radius : &pair[i - 2].modulus, is = *value, found[2];
            for (int k = 0; k < 2; k++) {
                *value = is * (k ? 1 + part : 1 - part);
                found[k] = law->coefficient(&spec, &pair[0], right, n > 0);
            }
            *value = is;
            const double rate = i < 2 ? rates.radius[i] : rates.modulus[i - 2];
            assert_near(is * rate, log(found[1] / found[0]) / (2 * part), 1e-9);
        }
    }
}

static void rows_agree_with_themselves(void **state)
{
    (void)state;
    const struct bead_law *law;
    for (size_t i = 0; (law = bead_law_info(i)); i++) {
        const struct bead_law_spec spec = example_of(law);
        const double a = law->coefficient(&spec, &materials[STEEL], &materials[ALUMINIUM], false);
        assert_true(a > 0 && isfinite(a));
        check_row(law, &spec, a);
        check_rates(law);
    }
    /* Where the examples are weak at a compression as small as that of the check. */
    static const char *const stronger[] = {"power", "fpu-alpha"};
    for (size_t i = 0; i < 2; i++)
        check_row(bead_law_find(stronger[i]), &numbers, 3e9);
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
    assert_int_equal(bead_scene_parse("test", text, strlen(text), NULL, &scene, &msg), BEAD_OK);
    assert_int_equal(bead_chain_create(scene, 0, &chain, &msg), BEAD_ERROR_SCENE);
    assert_non_null(strstr(msg.text, "test:1:8: chain: a contact's stiffness is not"));
    assert_null(chain);
    static const char *const whole[] = {"title=x", "chain={beads: [{bead: ptfe, count: 3}], precompression: 2501 N, "
                                                   "law: {fpu-alpha: 1000, stiffness: 1e7}}"};
    struct bead_scene *set = NULL;
    assert_int_equal(bead_scene_change(scene, &(struct bead_overrides){.settings = whole, .setting_count = 2}, &set, &msg),
                     BEAD_OK);
    assert_int_equal(bead_chain_create(set, 0, &chain, &msg), BEAD_ERROR_SCENE);
    assert_non_null(strstr(msg.text, "--set:2:7: chain: a contact's stiffness is not"));
    bead_scene_free(set);
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
    check_row(&spring, &numbers, 3e9);
    assert_null(lacks(&spring));
    assert_below(between(&spring, "rkn8", 4e-6, power, 4e-6, 0), 1e-10);
    assert_below(between(&spring, "rkn8", 4e-6, power, 4e-6, 5), 1e-10);
    assert_below(between(&spring, "rkn8", 2e-6, power, 1e-6, 0), 1e-9);
}

/* ---- laws that are no powers: A (e^{b d} - 1), which begins as A b d, and A e^{-1 / (b d)}, which begins as no power ---- */

static const double growth = 2e5; /* b, /m */

static double exponential_energy(double a, const struct bead_law_spec *spec, double d)
{
    (void)spec;
    return d > 0 ? a * (expm1(growth * d) / growth - d) : 0;
}

static double exponential_force(double a, const struct bead_law_spec *spec, double d)
{
    (void)spec;
    return d > 0 ? a * (exp(growth * d) - 1) : 0;
}

static double exponential_stiffness(double a, const struct bead_law_spec *spec, double d)
{
    (void)spec;
    return d > 0 ? a * growth * exp(growth * d) : 0;
}

static double exponential_compression(double a, const struct bead_law_spec *spec, double f)
{
    (void)spec;
    return f > 0 && a > 0 ? log1p(f / a) / growth : 0;
}

/* That of the spring that it begins as: a bound. */
static double exponential_energy_compression(double a, const struct bead_law_spec *spec, double e)
{
    return spring_energy_compression(growth * a, spec, e);
}

static const struct bead_law exponential = {.name = "exponential",
                                            .description = "A (e^{b d} - 1), one-sided",
                                            .one_sided = true,
                                            .coefficient = spring_coefficient,
                                            .coefficient_power = one,
                                            .energy = exponential_energy,
                                            .force = exponential_force,
                                            .stiffness = exponential_stiffness,
                                            .compression = exponential_compression,
                                            .energy_compression = exponential_energy_compression};

static double flat_force(double a, const struct bead_law_spec *spec, double d)
{
    (void)spec;
    return d > 0 ? a * exp(-1 / (growth * d)) : 0;
}

static double flat_stiffness(double a, const struct bead_law_spec *spec, double d)
{
    return d > 0 ? flat_force(a, spec, d) / (growth * d * d) : 0;
}

static void begin(struct setup *x, const struct bead_law *law, double stiffness)
{
    describe(x, 2, STEEL, ALUMINIUM, 32, P3_SPINS, 0.443);
    x->spec.law = (struct bead_law_spec){.row = law, .stiffness = stiffness, .power = 1.7, .coefficient = stiffness};
    make(x);
}

static void beginnings_are_found(void **state)
{
    (void)state;
    struct bead_law unsaid = spring, power = *bead_law_find("power"), hertz = *bead_law_find("hertz"), flat = spring;
    flat.force = flat_force;
    flat.stiffness = flat_stiffness;
    unsaid.exponent = power.exponent = hertz.exponent = flat.exponent = NULL;
    const struct {
        const struct bead_law *law;
        double stiffness, exponent;
    } cases[] = {{&unsaid, 2e6, 1},     {&power, 3e9, 1.7}, {&hertz, 1, 1.5},
                 {&exponential, 10, 1}, {&flat, 2e6, NAN},  {bead_law_find("fpu-alpha"), 2e6, NAN}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct setup x;
        begin(&x, cases[i].law, cases[i].stiffness);
        const double p = bead_chain_exponent(x.chain);
        if (isnan(cases[i].exponent) ? !isnan(p) : !(fabs(p - cases[i].exponent) < 1e-6))
            fail_msg("law `%s`, number %zu, begins as the power %.9g, not %g", cases[i].law->name, i, p, cases[i].exponent);
        drop(&x, NULL);
    }
}

/* A row that does not say how its force begins works like one that does. */
static void a_row_without_exponent_has_events(void **state)
{
    (void)state;
    struct bead_law unsaid = spring;
    unsaid.exponent = NULL;
    assert_below(between(&unsaid, "rkn8", 4e-6, &spring, 4e-6, 0), 1e-9);
    assert_below(between(&unsaid, "rkn8", 4e-6, &spring, 4e-6, 5), 1e-9);
}

/* Largest error of a contact's first peak, relative to it, with the requested steps. */
static double peaks_off(const struct bead_law *law, double stiffness, double accuracy)
{
    const double end = 0.5e-3;
    struct bead_outcome outcome[2];
    struct bead_run *run[2];
    struct setup x[2];
    double most = 0;
    for (int i = 0; i < 2; i++) {
        begin(&x[i], law, stiffness);
        const struct built built = {&x[i].scene, x[i].chain};
        struct bead_simulate simulate = {
            .method = (char *)(uintptr_t)(i ? "rkn8" : "auto"), .step = i ? 0.1e-6 : 0, .accuracy = accuracy};
        run[i] = start_run(&built, (struct bead_run_settings){.simulate = &simulate, .end = end, .contact_peaks = true});
        run_until(run[i], end);
        bead_run_finish(run[i], end, &outcome[i]);
    }
    for (size_t k = 0; k < x[0].chain->contacts; k++) {
        const struct bead_peak *a = &outcome[0].contact_peaks[k], *b = &outcome[1].contact_peaks[k];
        if (b->value > 1 && !b->open)
            most = fmax(most, fabs(a->value / b->value - 1));
    }
    for (int i = 0; i < 2; i++) {
        bead_run_destroy(run[i]);
        drop(&x[i], NULL);
    }
    assert_true(most > 0);
    return most;
}

/* No row of a table of peaks has less than the requested accuracy; so errors within that are within the row's uncertainty. */
static void peaks_of_other_laws_are_as_asked(void **state)
{
    (void)state;
    static const double asked[] = {1e-4, 1e-6, 1e-8};
    for (size_t i = 0; i < sizeof asked / sizeof *asked; i++) {
        const double off = peaks_off(&exponential, 10, asked[i]);
        print_message("asked %g: %.2g\n", asked[i], off / asked[i]);
        assert_below(off, asked[i]);
    }
}

static struct bead_method_choice choose(struct setup *x, const char *method, enum bead_error *err, struct bead_message *msg)
{
    struct bead_method_choice choice = {0};
    x->scene.simulate.method = (char *)(uintptr_t)method;
    x->scene.simulate.accuracy = 1e-6;
    *err = bead_choose_method(x->chain, &x->chain->scene->simulate, &choice, msg);
    return choice;
}

/* The beginning of its force is unknown: its contact events are left alone, and it is not taken for Hertz's. */
static void a_row_that_begins_as_no_power_has_no_events(void **state)
{
    (void)state;
    struct bead_law flat = spring;
    struct bead_message msg = {""};
    enum bead_error err;
    struct setup x;
    flat.exponent = NULL;
    flat.force = flat_force;
    flat.stiffness = flat_stiffness;
    begin(&x, &flat, 2e6);
    struct bead_stepper *s = make_stepper(&x, "rkn8", NULL, false);
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
}

/* A program's own laws are found by their names, in scenes and in results made from these; incomplete ones are refused, and so are
 * names that the library has. */
static void own_laws_are_found_by_name(void **state)
{
    (void)state;
    static const char text[] = "chain: {beads: [{bead: brass}], law: mine}\noutputs: [{table: a.csv}]\n";
    struct bead_law mine = *bead_law_find("hertz");
    const struct bead_law *const laws[] = {&mine, NULL};
    const struct bead_own own = {.laws = laws};
    const struct bead_overrides with = {.own = &own};
    struct bead_message msg = {""};
    struct bead_scene *scene, *changed;
    mine.name = "mine";
    assert_int_equal(bead_scene_parse("own", text, sizeof text - 1, NULL, &scene, &msg), BEAD_ERROR_SCENE);
    assert_int_equal(bead_scene_parse("own", text, sizeof text - 1, &with, &scene, &msg), BEAD_OK);
    assert_ptr_equal(scene->chains[0].law.row, &mine);
    static const char typo[] = "chain: {beads: [{bead: brass}], law: mien}\noutputs: [{table: a.csv}]\n";
    assert_int_equal(bead_scene_parse("own", typo, sizeof typo - 1, &with, &changed, &msg), BEAD_ERROR_SCENE);
    assert_non_null(strstr(msg.text, "did you mean `mine`?"));
    static const char *const faster[] = {"chain.striker.velocity=1 m/s"};
    const struct bead_overrides change = {.settings = faster, .setting_count = 1};
    assert_int_equal(bead_scene_change(scene, &change, &changed, &msg), BEAD_OK);
    assert_ptr_equal(changed->chains[0].law.row, &mine);
    bead_scene_free(changed);
    bead_scene_free(scene);
    mine.stiffness = NULL;
    assert_int_equal(bead_scene_parse("own", text, sizeof text - 1, &with, &scene, &msg), BEAD_ERROR_USAGE);
    assert_string_equal(msg.text, "law `mine`: its `stiffness` is missing");
    mine = *bead_law_find("hertz");
    assert_int_equal(bead_scene_parse("own", text, sizeof text - 1, &with, &scene, &msg), BEAD_ERROR_USAGE);
    assert_non_null(strstr(msg.text, "`hertz`: the library has one"));
    assert_null(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(own_laws_are_found_by_name),
        cmocka_unit_test(rows_are_whole),
        cmocka_unit_test(rows_agree_with_themselves),
        cmocka_unit_test(a_force_beyond_the_law_is_refused),
        cmocka_unit_test(a_new_row_is_the_power_that_it_is),
        cmocka_unit_test(beginnings_are_found),
        cmocka_unit_test(a_row_without_exponent_has_events),
        cmocka_unit_test(peaks_of_other_laws_are_as_asked),
        cmocka_unit_test(a_row_that_begins_as_no_power_has_no_events),
    };
    return cmocka_run_group_tests_name("laws", tests, NULL, NULL);
}
