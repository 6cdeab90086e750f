/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures of single runs, from tables, against known values of solitary waves in granular chains. Those marked (x) are exact; the
 * others were measured with an independent program and converged. */
#include "measures.h"

#include "beadreel/trajectory.h"

/* ---- one pulse in a uniform chain ---- */

static void travelling_wave(void **state)
{
    (void)state;
    measure(UNIT
            "  striker: {bead: unit, velocity: 1 m/s}\n  beads: [{bead: unit, count: 120}]\nsimulate: {accuracy: 1e-10}\n" TABLE);
    double c = value_of("front speed"), force = value_of("peak contact force"), v = value_of("peak velocity");
    equal(c / pow(force, 1.0 / 6), 0.905516, 6e-7);
    equal(c / pow(v, 0.2), 0.907470, 6e-7);
    /* At c = 1. */
    equal(force / pow(c, 6), 1.813944, 1e-6);
    equal(v / pow(c, 5), 1.624944, 1e-6);
    equal(value_of("peak compression") / pow(c, 4), 1.487359, 1e-6);
    equal(value_of("pulse energy") / (v * v), 1.06932, 6e-6);
    equal(value_of("pulse momentum") / v, 1.66997, 6e-6);
    near("kinetic / potential", 1.25, 1e-9); /* (x) */
    near("front speed in beads", c, 1e-12);
    near("local front speed", c, 1e-7);
    near("force width", 1.412, 5e-4);
    near("velocity width", 1.579, 5e-4);
    near("compression 1 bead ahead", 0.39259, 6e-6);
    near("compression 2 beads ahead", 0.019564, 6e-7);
    near("compression 3 beads ahead", 6.589e-5, 6e-9);
    near("compression 4 beads ahead", 4.69e-9, 6e-12);
    none("magnetism");
    none("force at wall");
    none("force past defect");
    none("second pulse");
}

/* The width at 1 % must be that of a front with the compressions 1, .39259, .019564, 6.589e-5 at beads 0 to 3: ln d is smooth. */
static void width_at_the_foot(void **state)
{
    (void)state;
    static const double ratio[] = {1, 0.39259, 0.019564, 6.589e-5};
    double difference[4], x[2] = {1, 2};
    for (int i = 0; i < 4; i++)
        difference[i] = log(ratio[i]);
    for (int order = 1; order < 4; order++)
        for (int i = 3; i >= order; i--)
            difference[i] = (difference[i] - difference[i - 1]) / order;
    while (x[1] - x[0] > 1e-9) {
        double at = 0.5 * (x[0] + x[1]);
        double d = difference[0] + at * (difference[1] + (at - 1) * (difference[2] + (at - 2) * difference[3]));
        x[1.5 * d < log(0.01)] = at;
    }
    near("force width at 1 %", 2 * x[0], 5e-3);
}

/* v -> s v maps F -> s^{6/5} F, t -> s^{-1/5} t (x). */
static void scaling(void **state)
{
    (void)state;
    double slow[2][64];
    for (int i = 0; i < 2; i++) {
        measure(
            i == 0 ? UNIT
                "  striker: {bead: unit, velocity: 1 m/s}\n  beads: [{bead: unit, count: 60}]\nsimulate: {accuracy: 1e-9}\n" TABLE
                   : UNIT "  striker: {bead: unit, velocity: 32 m/s}\n  beads: [{bead: unit, count: 60}]\nsimulate: {accuracy: "
                          "1e-9}\n" TABLE);
        static const char *const names[] = {
            "front speed",  "peak contact force",       "peak velocity", "force width", "velocity width",
            "pulse energy", "participation of energies"};
        for (int n = 0; n < 7; n++)
            slow[i][n] = value_of(names[n]);
    }
    static const double factor[] = {2, 64, 32, 1, 1, 1024, 1};
    for (int n = 0; n < 7; n++)
        equal(slow[1][n] / slow[0][n] / factor[n], 1, n == 6 ? 1e-3 : 1e-6);
}

static void equal_striker(void **state)
{
    (void)state;
    measure(UNIT
            "  striker: {bead: unit, velocity: 1 m/s}\n  beads: [{bead: unit, count: 150}]\nsimulate: {accuracy: 1e-9}\n" TABLE);
    near("peak contact force", 0.63955, 6e-6);
    near("peak bead force", 0.7073 * 0.63955, 4e-5);
    near("peak velocity", 0.68163, 6e-6);
    near("pulse part of energy", 0.99366, 6e-6);
    near("striker's velocity", -0.0711, 5e-5);
}

/* Cells of one to eight beads, of which the last is heavier by a billionth, are measured bead by bead; all have the wave of equal
 * beads, whose maxima and widths are those of any bead. */
static void cells_of_like_beads(void **state)
{
    (void)state;
    static const char *const names[] = {"peak contact force", "peak bead force",     "peak velocity",       "peak compression",
                                        "pulse energy",       "pulse momentum",      "kinetic / potential", "force width",
                                        "velocity width",     "front speed in beads"};
    enum { NAMES = sizeof names / sizeof *names, BEADS = 8 };
    double like[NAMES] = {0};
    for (int cell = 1; cell <= BEADS; cell++) {
        char scene[600], beads[60] = "like";
        if (cell > 1)
            snprintf(beads, sizeof beads, "%d unit, like", cell - 1);
        snprintf(
            scene, sizeof scene,
            UNIT_OF(
                "  like: {mass: 1.000000001 kg, radius: 0.5 m, modulus: 1 GPa, poisson: 0}\n") "  striker: {bead: unit, velocity: "
                                                                                               "1 m/s}\n  beads: [{cell: [%s], "
                                                                                               "count: %d}]\n" TABLE,
            beads, 72 / cell);
        measure(scene);
        for (int n = 0; n < NAMES; n++) {
            like[n] = cell == 1 ? value_of(names[n]) : like[n];
            equal(value_of(names[n]) / like[n], 1, 2e-4);
        }
    }
}

static void steel(void **state)
{
    (void)state;
    measure("chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 150}]}\n"
            "simulate: {accuracy: 1e-9}\n" TABLE);
    near("front speed", 543.393, 1e-3);
    equal(value_of("front speed") / pow(value_of("peak contact force"), 1.0 / 6), 272.3646, 2e-4);
    equal(value_of("peak velocity") / 0.4, 0.68163, 6e-6);
    measure("chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{cell: [large-steel, aluminium], count: 100}]}\n"
            "simulate: {accuracy: 1e-9}\n" TABLE);
    near("front speed", 498.079, 0.02); /* the pulse radiates: 0.04 m/s slower every 100 dimers */
    near("magnetism", 1, 0);
}

/* ---- strikers of other masses: trains of pulses ---- */

static void trains(void **state)
{
    (void)state;
    static const struct {
        const char *mass, *beads;
        double first, followers[4], tolerance;
    } cases[] = {
        {"2 kg", "220", 0.950, {0.142, 0.022, NAN, NAN}, 6e-4},
        {"5 kg", "300", 1.377, {0.460, 0.227, 0.115, 0.060}, 6e-4},
        {"0.5 kg", "80", 0.388, {NAN, NAN, NAN, NAN}, 6e-4},
    };
    static const char *const names[] = {"second pulse", "third pulse", "fourth pulse", "fifth pulse"};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char scene[1024];
        snprintf(
            scene, sizeof scene,
            UNIT_OF("  hammer: {mass: %s, radius: 0.5 m, modulus: 1 GPa, poisson: 0}\n") "  striker: {bead: hammer, velocity: 1 "
                                                                                         "m/s}\n  beads: [{bead: unit, count: "
                                                                                         "%s}]\n" TABLE,
            cases[i].mass, cases[i].beads);
        measure(scene);
        near("peak contact force", cases[i].first, cases[i].tolerance);
        for (int n = 0; n < 4; n++) {
            if (!isnan(cases[i].followers[n]))
                near(names[n], cases[i].followers[n], cases[i].tolerance);
        }
        if (isnan(cases[i].followers[0]))
            none("second pulse");
    }
    near("striker's velocity", -0.363, 6e-4);
}

/* A wall sends the first pulse back; the second is still told, as far as it came until then. */
static void trains_before_walls(void **state)
{
    (void)state;
    measure(UNIT_OF(
        "  hammer: {mass: 2 kg, radius: 0.5 m, modulus: 1 GPa, poisson: 0}\n") "  striker: {bead: hammer, velocity: 1 m/s}\n"
                                                                               "  wall: rigid\n  beads: [{bead: unit, count: "
                                                                               "220}]\n" TABLE);
    near("peak contact force", 0.950, 6e-4);
    near("second pulse", 0.142, 6e-4);
    near("third pulse", 0.022, 6e-4);
}

/* ---- walls ---- */

static void walls(void **state)
{
    (void)state;
    measure(
        "chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 100}], wall: large-steel}\n"
        "simulate: {until: 3 ms}\n" TABLE);
    near("force at wall", 1.9439, 6e-5);
    near("reflected force", 0.9983, 6e-5);
    measure("chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 100}], wall: rigid}\n"
            "simulate: {until: 3 ms}\n" TABLE);
    near("force at wall", 2.2384, 6e-5);
    near("reflected force", 0.9982, 6e-5);
}

/* ---- two beads ---- */

static void two_beads(void **state)
{
    (void)state;
    measure(UNIT
            "  striker: {bead: unit, velocity: 1 m/s}\n  beads: [{bead: unit}]\nsimulate: {until: 5 s, accuracy: 1e-9}\n" TABLE);
    double largest = pow(5 * 0.5 / 4, 0.4); /* (5 m* v^2 / (4 A))^{2/5}, m* = 1/2 (x) */
    near("striker's compression", largest, 1e-6);
    double duration = 0.8 * sqrt(acos(-1)) * tgamma(0.4) / tgamma(0.9); /* 2 int_0^1 dx / sqrt(1 - x^(5/2)) (x) */
    near("striker's contact time", duration * largest, 1e-9);
    near("striker's velocity", 0, 1e-7);
}

/* ---- tables ---- */

static void two_chains(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    char path[512], name[] = "run.h5";
    write_scene("chains:\n  - {name: steel, beads: [{bead: large-steel, count: 40}]}\n"
                "  - {name: glass, beads: [{bead: glass, count: 40}], wall: brass}\n"
                "simulate: {until: 0.9 ms}\n"
                "outputs: [{table: m.csv, show: measures}, {trajectory: run.h5, every: 1 us}]\n",
                path);
    if (!play(path, directory, &msg))
        fail_msg("%s", msg.text);
    read_measures("m.csv", "steel");
    double speed = value_of("front speed");
    none("force at wall");
    read_measures("m.csv", "glass");
    assert_true(value_of("force at wall") > 1.5);
    assert_true(fabs(value_of("front speed") / speed - 1) > 0.02);

    /* The same from the trajectory's samples, which are fewer. */
    char again[768];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    snprintf(again, sizeof again, "%s/m.csv", directory);
    if (!play(path, again, &msg))
        fail_msg("%s", msg.text);
    read_measures("m.csv", "steel");
    near("front speed", speed, 1e-4 * speed);
}

static void every_measure_is_described(void **state)
{
    (void)state;
    size_t count = 0;
    const struct bead_measure_info *info;
    for (; (info = bead_measure_info(count)); count++) {
        assert_true(strlen(info->name) > 0 && strlen(info->name) < sizeof found[0].name && strlen(info->help) > 0);
        assert_null(strpbrk(info->name, ",\"\n"));
        for (size_t i = 0; i < count; i++)
            assert_string_not_equal(info->name, bead_measure_info(i)->name);
    }
    assert_true(count > 20);
}

/* Wherever samples fall, measures differ by no more than they say: a pulse that does not end, a maximum just after the wall's, a
 * collision that a run begins with, and whose bead's force is largest as the contact opens, and dashpots whose forces have branch
 * points at their maxima. */
static void samples_may_fall_anywhere(void **state)
{
    (void)state;
    static const char *const chains[] = {
        "materials: {a: {density: 1390.3, modulus: 1.3371 GPa, poisson: 0.065, radius: 3.8031 mm}, b: {density: 1265.9, modulus: "
        "4.2676 GPa, poisson: 0.374, radius: 4.0524 mm}, c: {density: 3989.8, modulus: 19.336 GPa, poisson: 0.286, radius: 7.4042 "
        "mm}}\n"
        "chain: {striker: {bead: b, velocity: 0.10993}, wall: a, beads: [{cell: [c, c, b, a, c, a, b, c, b, c, b, a, c, a, 4 c, b, "
        "2 c, 3 a, c, b, a, c, 2 a, b, c, a]}]}\nsimulate: {accuracy: 1e-8, until: 7 ms}\n",
        "materials: {a: {density: 4611.2, modulus: 159.71 GPa, poisson: 0.316, radius: 13.012 mm}, b: {density: 10028, modulus: "
        "12.003 GPa, poisson: 0.396, radius: 5.7958 mm}}\nchain: {striker: {bead: a, velocity: 0.11712}, wall: rigid, beads: "
        "[{cell: [a, "
        "b], count: 6, spins: random, seed: 530}]}\nsimulate: {accuracy: 1e-8, until: 1.48085682 ms}\n",
        "materials: {a: {density: 2056, modulus: 433.62 GPa, poisson: 0.075, radius: 2.4653 mm}}\n"
        "chain: {striker: {bead: a, velocity: 0.38266}, wall: rigid, beads: [{bead: a}]}\n"
        "simulate: {accuracy: 1e-8, until: 8.15364423 us}\n",
        ("chain: {beads: [{cell: [large-steel, aluminium], count: 10}], damping: {coefficient: 2, exponent: 1.3}}\n"
         "simulate: {accuracy: 1e-6, until: 0.6 ms}\n"),
    };
    static const double every[] = {5e-6 / 16, 5e-6 / 16, 5e-7 / 16, 1e-7};
    for (size_t i = 0; i < sizeof chains / sizeof *chains; i++) {
        char scene[1024];
        struct bead_measure sparse[256];
        double known[256];
        snprintf(scene, sizeof scene, "%s" TABLE, chains[i]);
        measure(scene);
        const size_t count = found_count;
        assert_true(count > 10);
        memcpy(sparse, found, sizeof sparse);
        memcpy(known, uncertainties, sizeof known);
        snprintf(scene, sizeof scene, "%soutputs: [{table: m.csv, show: measures, every: %.9g}]\n", chains[i], every[i]);
        measure(scene);
        for (size_t n = 0; n < count; n++)
            near(sparse[n].name, sparse[n].value, known[n] + uncertainty_of(sparse[n].name) + 1e-9 * fabs(sparse[n].value));
    }
}

/* Nothing moves, or hardly anything is there: no row makes no sense. */
static void tiny_chains(void **state)
{
    (void)state;
    static const char *const chains[] = {
        "beads: [{bead: ptfe}]",
        "beads: [{bead: ptfe, count: 2}], wall: rigid",
        "beads: [{cell: [glass, lead, ptfe]}], precompression: 1 N",
        "beads: [{bead: ptfe, count: 7}], wall: brass, tilt: 3 deg, damping: {coefficient: 3}",
        "beads: [{bead: glass, count: 30}], law: {fpu-alpha: 1000, stiffness: 1e7}",
    };
    for (size_t i = 0; i < sizeof chains / sizeof *chains; i++) {
        char scene[512];
        snprintf(scene, sizeof scene, "chain: {%s}\nsimulate: {until: 1 ms}\n" TABLE, chains[i]);
        measure(scene);
        assert_true(found_count > 0);
        for (size_t n = 0; n < found_count; n++)
            assert_true(isfinite(found[n].value));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(travelling_wave),
        cmocka_unit_test(width_at_the_foot), /* of the table before */
        cmocka_unit_test(scaling),
        cmocka_unit_test(equal_striker),
        cmocka_unit_test(cells_of_like_beads),
        cmocka_unit_test(steel),
        cmocka_unit_test(trains),
        cmocka_unit_test(trains_before_walls),
        cmocka_unit_test(walls),
        cmocka_unit_test(two_beads),
        cmocka_unit_test(two_chains),
        cmocka_unit_test(every_measure_is_described),
        cmocka_unit_test(samples_may_fall_anywhere),
        cmocka_unit_test(tiny_chains),
    };
    return cmocka_run_group_tests_name("measure", tests, make_directory, remove_directory);
}
