/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The derivatives of peak forces, against central differences of accurate runs, exact scaling, and the closed form of a collision.
 */
#include "support.h"

#include "beadreel/session.h"
#include "sim/adjoint/record.h"
#include "sim/run/sensitivity.h"

/* ---- chains whose beads are each of a material of their own ---- */

enum { LONGEST = 48 };
struct kind {
    const char *name, *more; /* keys of the chain */
    size_t beads, contact;
    double until; /* s */
    void (*bead)(size_t index, struct bead_material *material);
    double allowed;    /* of the largest derivative of a kind */
    bool of_stiffness; /* the law knows what beads are made of */
};

static void steel(size_t index, struct bead_material *m)
{
    (void)index;
    *m = (struct bead_material){.modulus = 193e9, .poisson = 0.3, .radius = 4.76e-3, .mass = 3.63e-3};
}

/* Large and small steel beads in pairs, turned round at random. */
static void flipped(size_t index, struct bead_material *m)
{
    static const char turned[] = "0110100010111001011010";
    steel(index, m);
    if (index > 0 && index % 2 == (turned[(index + 1) / 2] == '1')) {
        m->radius = 2.38e-3;
        m->mass = 0.45e-3;
    }
}

/* A number from 0 to 1 of a list that has no order. */
static double scattered(size_t index)
{
    const double x = 0.6180339887498949 * (double)(index * index + 3 * index + 1);
    return x - floor(x);
}

static void unlike(size_t index, struct bead_material *m)
{
    m->radius = 2e-3 + 4e-3 * scattered(index);
    m->modulus = pow(10, 9.5 + 2 * scattered(index + 100));
    m->mass = 4.19 * pow(m->radius, 3) * (2000 + 6000 * scattered(index + 200));
    m->poisson = 0.2 + 0.2 * scattered(index + 300);
}

static const struct kind kinds[] = {
    {"steel", "", 20, 12, 0.4e-3, steel, 1e-7, true},
    {"dimers", "", 40, 30, 0.6e-3, flipped, 1e-7, true},
    {"rigid wall", "wall: rigid, ", 20, 20, 0.5e-3, flipped, 1e-7, true},
    {"echo of a rigid wall", "wall: rigid, ", 20, 12, 0.5e-3, flipped, 5e-7, true},
    {"precompressed on a tilt", "wall: brass, precompression: 10 N, tilt: 3.5 deg, ", 20, 12, 0.6e-3, steel, 2e-8, true},
    {"steep", "wall: brass, tilt: 30 deg, ", 20, 12, 0.4e-3, steel, 1e-7, true},
    {"steep to a rigid wall", "wall: rigid, tilt: 45 deg, ", 30, 25, 0.6e-3, steel, 3e-8, true},
    {"unlike", "", 16, 10, 1e-3, unlike, 1e-7, true},
    {"gaps", "gap: 50 um, wall: brass, ", 6, 5, 2e-3, flipped, 5e-5, true},
    {"as printed", "law: thesis-appendix, ", 12, 8, 0.2e-3, flipped, 1e-7, true},
    {"springs", "law: {fpu-alpha: 100, stiffness: 1 MN/m}, ", 12, 8, 1.5e-3, steel, 3e-8, false},
    {"one-sided springs", "law: {power: 1, coefficient: 1e6}, ", 12, 8, 1.5e-3, steel, 3e-5, false},
    {"power", "law: {power: 2.5, coefficient: 1e13}, ", 12, 8, 1e-3, steel, 1e-7, false},
};

static struct bead_scene *scene_of(const struct kind *kind)
{
    char text[16384];
    struct bead_message msg = {""};
    struct bead_scene *scene = NULL;
    size_t used = (size_t)snprintf(text, sizeof text, "materials:\n");
    for (size_t i = 0; i <= kind->beads; i++) {
        struct bead_material m;
        kind->bead(i, &m);
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "  b%zu: {modulus: %.17g, poisson: %.17g, radius: %.17g, mass: %.17g}\n", i, m.modulus, m.poisson,
                                 m.radius, m.mass);
    }
    used += (size_t)snprintf(text + used, sizeof text - used, "chain: {striker: {bead: b0, velocity: 0.443 m/s}, %sbeads: [",
                             kind->more);
    for (size_t i = 1; i <= kind->beads; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s{bead: b%zu}", i > 1 ? ", " : "", i);
    snprintf(text + used, sizeof text - used, "]}\nsimulate: {until: %.17g}\noutputs: [{table: p.csv}]\n", kind->until);
    if (bead_scene_parse("test", text, strlen(text), NULL, &scene, &msg))
        fail_msg("%s: %s", kind->name, msg.text);
    return scene;
}

static struct bead_material *material_of(const struct bead_scene *scene, size_t bead)
{
    char name[16];
    size_t i = 0;
    snprintf(name, sizeof name, "b%zu", bead);
    while (strcmp(scene->materials[i].name, name) != 0)
        i++;
    return &scene->materials[i];
}

static struct bead_chain *chain_of(const struct bead_scene *scene)
{
    struct bead_message msg = {""};
    struct bead_chain *chain = NULL;
    if (bead_chain_create(scene, 0, &chain, &msg))
        fail_msg("%s", msg.text);
    return chain;
}

/* The peak of a contact, or a bead, of the scene as it is now. */
static struct bead_peak peak_of(const struct bead_scene *scene, bool of_bead, size_t index, double accuracy)
{
    struct bead_message msg = {""};
    struct built built = {NULL, chain_of(scene)};
    struct bead_simulate simulate = scene->simulate;
    const struct bead_span span = {index, index};
    struct bead_outcome outcome;
    simulate.accuracy = accuracy;
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.simulate = &simulate,
                                                                        .kernels = bead_kernels_find(NULL),
                                                                        .end = simulate.until,
                                                                        .contact_peaks = !of_bead,
                                                                        .bead_peaks = of_bead,
                                                                        .peak_span = &span});
    while (bead_run_time(run) < simulate.until) {
        if (bead_run_step(run, &msg))
            fail_msg("%s", msg.text);
    }
    bead_run_finish(run, simulate.until, &outcome);
    const struct bead_peak peak = (of_bead ? outcome.bead_peaks : outcome.contact_peaks)[index];
    bead_run_destroy(run);
    bead_chain_destroy(built.chain);
    return peak;
}

/* Central difference of fourth order of the peak by a number of the scene. */
static double difference_by(const struct bead_scene *scene, bool of_bead, size_t index, double *number)
{
    static const double step = 1e-4, at[4] = {-2, -1, 1, 2};
    const double x = *number;
    double f[4];
    for (int i = 0; i < 4; i++) {
        *number = x * (1 + at[i] * step);
        f[i] = peak_of(scene, of_bead, index, 1e-12).value;
    }
    *number = x;
    return (8 * (f[2] - f[1]) - (f[3] - f[0])) / (12 * step * x);
}

/* The program's derivatives. */
static struct bead_sensitivity sensitivity_of(const struct bead_scene *scene, bool of_bead, size_t index)
{
    struct bead_message msg = {""};
    struct bead_chain *chain = chain_of(scene);
    const struct bead_peak peak = peak_of(scene, of_bead, index, 1e-6);
    const struct bead_sensitivity_run run = {.chain = chain, .kernels = bead_kernels_find(NULL), .accuracy = 1e-6};
    const struct bead_sensitive of = {.of_bead = of_bead, .index = index, .peak = &peak};
    struct bead_sensitivity found;
    if (bead_sensitivities_find(&run, &of, 1, &found, &msg))
        fail_msg("%s", msg.text);
    bead_chain_destroy(chain);
    return found;
}

/* Derivatives of one kind: the largest error, and the largest of them. */
struct compared {
    double error, largest;
};

static void compare(struct compared *c, double found, double expected)
{
    c->error = fmax(c->error, fabs(found - expected));
    c->largest = fmax(c->largest, fabs(expected));
}

static void check_kind(const struct kind *kind, bool of_bead, size_t every)
{
    static const char *const names[] = {"mass", "radius", "modulus"};
    struct bead_scene *scene = scene_of(kind);
    struct bead_sensitivity s = sensitivity_of(scene, of_bead, kind->contact);
    struct compared compared[3] = {{0, 0}};
    for (size_t j = kind->contact % every; j <= kind->beads; j += every) {
        struct bead_material *m = material_of(scene, j);
        double *const numbers[3] = {&m->mass, &m->radius, &m->modulus};
        const double found[3] = {s.mass[j], s.radius[j], s.modulus[j]};
        for (size_t i = 0; i < 3; i++)
            compare(&compared[i], found[i], difference_by(scene, of_bead, kind->contact, numbers[i]));
    }
    for (size_t i = 0; i < 3; i++) {
        if ((i == 0 || kind->of_stiffness) != (compared[i].largest > 0) || compared[i].error > kind->allowed * compared[i].largest)
            fail_msg("%s: derivatives by the %s are off by %.3g of the largest, %.3g", kind->name, names[i],
                     compared[i].error / compared[i].largest, compared[i].largest);
    }
    const double velocity = difference_by(scene, of_bead, kind->contact, &scene->chains[0].striker_velocity);
    if (!(fabs(s.velocity / velocity - 1) < kind->allowed))
        fail_msg("%s: the derivative by the striker's velocity is %.12g instead of %.12g", kind->name, s.velocity, velocity);
    bead_sensitivity_free(&s);
    bead_scene_free(scene);
}

static void central_differences(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        check_kind(&kinds[i], false, kinds[i].beads > 20 ? 5 : 2);
}

/* The mean of two contacts. */
static void central_differences_of_a_bead(void **state)
{
    (void)state;
    check_kind(&kinds[1], true, 7);
}

/* ---- exact results ---- */

/* Without precompression and weight F goes as A^{2/5} m^{3/5} v^{6/5}, A as E R^{1/2}. */
static void derivatives_add_up(void **state)
{
    (void)state;
    static const size_t contacts[] = {0, 1, 5, 9, 15};
    const struct kind kind = {"unlike", "wall: rigid, ", 30, 0, 3e-3, unlike, 0, true};
    struct bead_scene *scene = scene_of(&kind);
    for (size_t c = 0; c < sizeof contacts / sizeof *contacts; c++) {
        const double force = peak_of(scene, false, contacts[c], 1e-11).value;
        struct bead_sensitivity s = sensitivity_of(scene, false, contacts[c]);
        double mass = 0, radius = 0, modulus = 0, swing = 1; /* of terms that cancel */
        for (size_t j = 0; j <= kind.beads; j++) {
            const struct bead_material *m = material_of(scene, j);
            mass += m->mass * s.mass[j] / force;
            radius += m->radius * s.radius[j] / force;
            modulus += m->modulus * s.modulus[j] / force;
            swing += fabs(m->mass * s.mass[j]) / force;
        }
        assert_near(mass, 0.6, 5e-8 * swing);
        assert_near(modulus, 0.4, 5e-8 * swing);
        assert_near(radius, 0.2, 2.5e-8 * swing);
        assert_near(scene->chains[0].striker_velocity * s.velocity / force, 1.2, 2.5e-8 * swing);
        bead_sensitivity_free(&s);
    }
    bead_scene_free(scene);
}

/* Two beads: F = A^{2/5} (5/4 m v^2)^{3/5}, 1/m = 1/m0 + 1/m1. And the standard deviation of that. */
static void collision(void **state)
{
    (void)state;
    const struct kind kind = {"collision", "", 1, 0, 0.2e-3, unlike, 0, true};
    struct bead_message msg = {""};
    struct bead_scene *scene = scene_of(&kind);
    struct bead_sensitivity s = sensitivity_of(scene, false, 0);
    struct bead_chain *chain = chain_of(scene);
    const struct bead_peak peak = peak_of(scene, false, 0, 1e-11);
    const struct bead_material *m[2] = {material_of(scene, 0), material_of(scene, 1)};
    double flat[2], sum = 0, deviation = 0;
    for (int j = 0; j < 2; j++)
        flat[j] = (1 - m[j]->poisson * m[j]->poisson) / m[j]->modulus;
    for (int j = 0; j < 2; j++) {
        struct bead_material *one = material_of(scene, (size_t)j), *other = material_of(scene, (size_t)(1 - j));
        const double by_mass = 0.6 * other->mass / (one->mass * (one->mass + other->mass));
        const double by_radius = 0.4 * 0.5 * other->radius / (one->radius * (one->radius + other->radius));
        const double by_modulus = 0.4 * flat[j] / (flat[0] + flat[1]) / one->modulus;
        assert_near(s.mass[j] / peak.value / by_mass, 1, 1e-7);
        assert_near(s.radius[j] / peak.value / by_radius, 1, 1e-7);
        assert_near(s.modulus[j] / peak.value / by_modulus, 1, 1e-7);
        one->radius_tolerance = 0.001 * (1 + j);
        one->modulus_tolerance = 0.02;
        sum += pow(one->radius_tolerance * (one->radius * by_radius + 3 * one->mass * by_mass), 2) +
               pow(0.02 * one->modulus * by_modulus, 2);
    }
    const struct bead_sensitivity_run run = {.chain = chain, .kernels = bead_kernels_find(NULL), .accuracy = 1e-6};
    if (bead_deviations_find(&run, &(struct bead_sensitive){.peak = &peak}, 1, &deviation, (bool[1]){false}, &msg))
        fail_msg("%s", msg.text);
    assert_near(deviation / (peak.value * sqrt(sum)), 1, 1e-5);
    assert_near(s.velocity * scene->chains[0].striker_velocity / peak.value, 1.2, 1e-7);
    bead_sensitivity_free(&s);
    bead_chain_destroy(chain);
    bead_scene_free(scene);
}

/* Without sensors it is the last contact whose peak the run has seen pass, or the last of all. */
static void the_contact_meant_is_the_last_with_a_peak(void **state)
{
    (void)state;
    struct built b = build("chain: {beads: [{bead: brass, count: 9}], wall: brass}\n", "until: 1 us");
    struct bead_peak peaks[16] = {{0}};
    size_t list[16];
    const size_t contacts = bead_chain_contacts(b.chain);
    assert_int_equal(bead_sensitive_contacts(b.chain, peaks, list), 1);
    assert_int_equal(list[0], contacts - 1);
    for (size_t k = 0; k < 6; k++) {
        peaks[k].time = 1e-6;
        peaks[k].open = k != 3;
    }
    assert_int_equal(bead_sensitive_contacts(b.chain, peaks, list), 1);
    assert_int_equal(list[0], 3);
    peaks[3].open = true;
    assert_int_equal(bead_sensitive_contacts(b.chain, peaks, list), 1);
    assert_int_equal(list[0], contacts - 1);
    release(&b);
}

/* Beads that have not been reached by a step are at rest in it, whichever steps were looked at before. */
static void recorded_steps_are_at_rest_ahead(void **state)
{
    (void)state;
    enum { BEADS = 16, STEPS = 3 };
    double values[6][BEADS];
    struct bead_message msg = {""};
    struct bead_record record = {0};
    struct bead_stepper s = {.start = {.u = values[0], .v = values[1], .a = values[2]},
                             .end = {.u = values[3], .v = values[4], .a = values[5]}};
    for (size_t step = 0; step < STEPS; step++) {
        s.active = 5 * (step + 1);
        s.t0 = (double)step;
        s.t1 = (double)step + 1;
        for (size_t i = 0; i < 6; i++)
            for (size_t j = 0; j < BEADS; j++)
                values[i][j] = j < s.active ? (double)(100 * (step + i / 3) + 10 * (i % 3) + j + 1) : 0;
        assert_int_equal(bead_record_add(&record, &s, &msg), BEAD_OK);
    }
    assert_int_equal(record.steps, STEPS);
    for (size_t step = STEPS; step-- > 0;) {
        bead_record_load(&record, step, &s);
        assert_true(s.active == 5 * (step + 1) && s.t0 == (double)step && s.t1 == (double)step + 1 && s.h == 1);
        for (size_t i = 0; i < 6; i++)
            for (size_t j = 0; j < BEADS; j++) {
                const size_t known = i < 3 && step > 0 ? 5 * step : s.active; /* the start is the end of the step before */
                assert_true(values[i][j] == (j < known ? (double)(100 * (step + i / 3) + 10 * (i % 3) + j + 1) : 0));
            }
    }
    bead_record_free(&record);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(recorded_steps_are_at_rest_ahead),
                                       cmocka_unit_test(central_differences),
                                       cmocka_unit_test(central_differences_of_a_bead),
                                       cmocka_unit_test(derivatives_add_up),
                                       cmocka_unit_test(collision),
                                       cmocka_unit_test(the_contact_meant_is_the_last_with_a_peak)};
    return cmocka_run_group_tests_name("sensitivity", tests, NULL, NULL);
}
