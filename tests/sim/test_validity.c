/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The limits of the model of elastic spheres: strikes, compressions and pressures against closed forms, and the reports of runs. */
#include "measures.h"

#include "sessions.h"
#include "sim/chain/contact_walk.h"
#include "sim/chain/validity.h"
#include "tests/problems.h"

/* Spheres of 316 steel, 3/8 inch; their yield strength is 1 GPa, for round numbers. */
#define STEEL_BALL "materials: {ball: {mass: 3.63 g, radius: 4.76 mm, modulus: 193 GPa, poisson: 0.3, yield: 1 GPa}}\n"
#define BALLS(striker, more) \
    STEEL_BALL "chain: {striker: {bead: ball, velocity: " striker "}, beads: [{bead: ball, count: 20}]" more "}\n"

static struct bead_validity of_force(const struct bead_chain *chain, size_t contact, double force)
{
    struct bead_peak peaks[64] = {{0}};
    struct bead_validity v = bead_validity_begin(chain);
    peaks[contact].value = force;
    bead_validity_add_peaks(&v, chain, peaks);
    return v;
}

/* p0 = (6 F E*^2 / (pi^3 R^2))^(1/3) and d = (9 F^2 / (16 R E*^2))^(1/3) (Johnson, equations 4.23 and 4.24). */
static void forces_of_hertz(void **state)
{
    (void)state;
    struct built built = build(BALLS("1 m/s", ", wall: rigid"), "");
    const double e[2] = {193e9 / (1 - 0.09) / 2, 193e9 / (1 - 0.09)}, r[2] = {4.76e-3 / 2, 4.76e-3}, force = 40;
    for (size_t wall = 0; wall < 2; wall++) {
        const struct bead_validity v = of_force(built.chain, wall ? 20 : 7, force);
        const double p0 = cbrt(6 * force * e[wall] * e[wall] / (M_PI * M_PI * M_PI * r[wall] * r[wall]));
        const double d = cbrt(9 * force * force / (16 * r[wall] * e[wall] * e[wall]));
        equal(v.pressure, p0 / 1e9, 1e-12);
        equal(v.compression, d / 4.76e-3, 1e-12);
        assert_int_equal(v.hardest, wall ? 20 : 7);
        assert_int_equal(v.deepest, wall ? 20 : 7);
    }
    equal(of_force(built.chain, 7, force).pressure, 2.5, 0.02); /* in the literature, 40 N is 2.5 GPa */
    equal(bead_validity_begin(built.chain).strike, 1 / sqrt(193e9 * (4 * M_PI / 3 * 4.76e-3 * 4.76e-3 * 4.76e-3) / 3.63e-3), 1e-12);
    release(&built);
}

/* Two free balls: half the energy is that of their relative motion, and at the turn all of it is in the contact. */
static void a_collision_and_its_bound(void **state)
{
    (void)state;
    measure(STEEL_BALL "chain: {striker: {bead: ball, velocity: 2 m/s}, beads: [{bead: ball}]}\n"
                       "simulate: {accuracy: 1e-8, until: 100 us}\noutputs: [{table: m.csv, show: measures}]\n");
    const double a = 4.0 / 3 * (193e9 / (1 - 0.09) / 2) * sqrt(4.76e-3 / 2), reduced = 3.63e-3 / 2;
    const double d = pow(2.5 * (0.5 * reduced * 4) / a, 0.4);
    equal(value_of("compression / radius"), d / 4.76e-3, 1e-5);
    struct built built = build(BALLS("2 m/s", ""), "");
    equal(bead_validity_bound(built.chain).compression / (d / 4.76e-3), pow(2, 0.4), 1e-9);
    release(&built);
}

/* The law scales: v -> 32 v maps d -> 16 d and p0 -> 4 p0, to the bit. */
static void faster_strikes(void **state)
{
    (void)state;
    static const char *const names[] = {"compression / radius", "pressure / yield strength", "strike / bar speed"};
    static const double factor[] = {16, 4, 32};
    double slow[3];
    measure(BALLS("0.5 m/s", "") "simulate: {method: rkn8, step: 1 us, until: 400 us}\n"
                                 "outputs: [{table: m.csv, show: measures, every: 2 us}]\n");
    for (size_t i = 0; i < 3; i++)
        slow[i] = value_of(names[i]);
    measure(BALLS("16 m/s", "") "simulate: {method: rkn8, step: 0.5 us, until: 200 us}\n"
                                "outputs: [{table: m.csv, show: measures, every: 1 us}]\n");
    for (size_t i = 0; i < 3; i++)
        equal(value_of(names[i]) / slow[i], factor[i], 1e-9);
}

/* Light beads turn between two samples: samples and peaks agree. */
static void measures_see_peaks(void **state)
{
    (void)state;
    static const char chain[] = STEEL_BALL "chain: {striker: {bead: ball, velocity: 1 m/s}, precompression: 3 N, wall: brass,\n"
                                           "  beads: [{cell: [ball, ptfe], count: 10}]}\n";
    char text[1024];
    snprintf(text, sizeof text, "%ssimulate: {until: 500 us}\noutputs: [{table: m.csv, show: measures}]\n", chain);
    measure(text);
    struct built built = build(chain, "until: 500 us");
    struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 500e-6, .contact_peaks = true});
    struct bead_outcome outcome;
    struct bead_validity peaks = bead_validity_begin(built.chain);
    run_until(run, 500e-6);
    bead_run_finish(run, 500e-6, &outcome);
    bead_validity_add_peaks(&peaks, built.chain, outcome.contact_peaks);
    const struct bead_validity most = bead_validity_bound(built.chain);
    equal(value_of("compression / radius") / peaks.compression, 1, 1e-3);
    equal(value_of("pressure / yield strength") / peaks.pressure, 1, 1e-3);
    assert_true(peaks.compression < most.compression && peaks.pressure < most.pressure);
    snprintf(text, sizeof text, "contact %zu; beyond the model", peaks.hardest);
    noted("pressure / yield strength", text);
    bead_run_destroy(run);
    release(&built);
}

/* A drive may collect any energy. */
static void drives_have_no_bound(void **state)
{
    (void)state;
    struct built struck = build(BALLS("1 m/s", ""), ""),
                 driven = build(BALLS("1 m/s", ", drive: {force: sine, amplitude: 1 N, frequency: 5 kHz}"), "until: 1 ms");
    const struct bead_validity most = bead_validity_bound(struck.chain), any = bead_validity_bound(driven.chain);
    assert_true(isfinite(most.compression) && isinf(any.compression) && any.strike == most.strike);
    assert_true(bead_validity_fails(&any));
    release(&struck);
    release(&driven);
}

/* Laws that say nothing of elastic spheres have no pressure, springs no compression; walls count as flat. */
static void other_laws(void **state)
{
    (void)state;
    struct built power = build(BALLS("1 m/s", ", law: {power: 2, coefficient: 1e9}"), "");
    struct built spring = build(BALLS("1 m/s", ", law: {fpu-alpha: 1, stiffness: 1e6}"), "");
    assert_true(of_force(power.chain, 3, 10).pressure == 0);
    equal(of_force(power.chain, 3, 10).compression, 1e-4 / 4.76e-3, 1e-12);
    const struct bead_validity v = of_force(spring.chain, 3, 10);
    assert_true(v.pressure == 0 && v.compression == 0 && v.strike == 0);
    release(&power);
    release(&spring);
}

/* ---- what is said ---- */

/* The warnings of a run, which are at most two. */
static void warns(const char *text, const char *first, const char *second)
{
    char path[512];
    write_scene(text, path);
    struct bead_session *session = play_session((struct bead_job){.input = path, .output = directory});
    const char *wanted[] = {first, second};
    for (size_t i = 0; i < 2; i++) {
        const char *warning = bead_session_warning(session, i);
        if (!warning != !wanted[i] || (warning && !strstr(warning, wanted[i])))
            fail_msg("%s: warning `%s` instead of `%s`", text, warning ? warning : "", wanted[i] ? wanted[i] : "");
    }
    assert_null(bead_session_warning(session, 2));
    bead_session_close(session);
}

#define PEAKS "outputs: [{table: p.csv}]\n"
static void runs_warn_once(void **state)
{
    (void)state;
    warns(BALLS("0.1 m/s", "") PEAKS, NULL, NULL);
    warns(BALLS("0.5 m/s", "") PEAKS, NULL, NULL); /* beyond the yield strength, at a point */
    warns(BALLS("5 m/s", "") PEAKS, "scene.yaml:2:8: chain: beyond the model of elastic spheres: the pressure in the centre is",
          NULL);
    warns(BALLS("495 m/s", "") PEAKS, "the striker has 0.101 of the speed of sound", NULL);
    warns("chain: {striker: {velocity: 60 m/s}, beads: [{bead: ptfe, count: 5}]}\n" PEAKS, "the compression is 0.", NULL);
    /* A sweep, whose chains begin alike. */
    warns("sweep: {cells: 2, fixed: 4, magnetism: 0, configurations: 2, striker: {velocity: 500 m/s}}\noutputs: [{table: s.csv}]\n",
          "the striker has 0.1", NULL);
}

static void first_warning(const char *text, char to[500])
{
    char path[512];
    write_scene(text, path);
    struct bead_session *session = play_session((struct bead_job){.input = path, .output = directory});
    const char *warning = bead_session_warning(session, 0);
    snprintf(to, 500, "%s", warning ? strstr(warning, "beyond") : "nothing");
    bead_session_close(session);
}

/* The first chain of a sweep is judged by the forces until its end: what is said of it is what is said of the chain alone. */
static void sweeps_warn_of_their_first_chain(void **state)
{
    (void)state;
    static const char chain[] = BALLS("3.1 m/s", ""), over[] = "sweep: {over: {chain.striker.velocity: [3.1 m/s, 3.2 m/s]}}\n";
    char text[1000], said[2][500], before[500] = "";
    size_t changes = 0;
    for (int until = 2; until < 60; until += 8) {
        for (size_t swept = 0; swept < 2; swept++) {
            snprintf(text, sizeof text, "%s%ssimulate: {until: %d us, accuracy: 1e-6}\n" PEAKS, chain, swept ? over : "", until);
            first_warning(text, said[swept]);
        }
        assert_string_equal(said[0], said[1]);
        changes += strcmp(said[0], before) != 0;
        strcpy(before, said[0]);
    }
    assert_true(changes > 2);
}

/* The states in the table of peaks of a run. */
static size_t marked(const char *striker, size_t *rows)
{
    char text[1024], line[256], path[768];
    snprintf(text, sizeof text,
             STEEL_BALL "chain: {striker: {bead: ball, velocity: %s},"
                        " beads: [{bead: ball, count: 9}, {bead: ptfe, count: 9}]}\n" PEAKS,
             striker);
    write_scene(text, path);
    bead_session_close(play_session((struct bead_job){.input = path, .output = directory}));
    snprintf(path, sizeof path, "%s/p.csv", directory);
    FILE *file = fopen(path, "r");
    size_t found_marks = 0;
    for (*rows = 0; file && fgets(line, sizeof line, file); ++*rows)
        found_marks += strstr(line, "invalid") != NULL;
    fclose(file);
    --*rows;
    return found_marks;
}

/* Rows are marked where contacts are too deep, all of them where the strike is too fast. */
static void rows_are_marked(void **state)
{
    (void)state;
    size_t rows;
    assert_int_equal(marked("1 m/s", &rows), 0);
    const size_t some = marked("100 m/s", &rows);
    assert_true(some > 0 && some < rows);
    assert_int_equal(marked("600 m/s", &rows), rows);
}

/* Plain numbers that can hardly be meant are reported with their line and the unit; they still count. */
static void plain_numbers(void **state)
{
    (void)state;
    static const struct {
        const char *text, *told;
    } cases[] = {
        {"materials: {x: {radius: 5, density: 7800, modulus: 1e9, poisson: 0.3}}\n",
         ":1:25: materials.x.radius: 5 has no unit and is taken as 5 m; is `5 mm` meant?"},
        {"materials: {x: {radius: 5 m, density: 7800, modulus: 1e9, poisson: 0.3}}\n", NULL},
        {"materials: {x: {modulus: 70, poisson: 0.3}}\n",
         ":1:26: materials.x.modulus: 70 has no unit and is taken as 70 Pa; is `70 GPa` meant?"},
        {"materials: {x: {modulus: 7e4, poisson: 0.3}}\n", "is `7e4 MPa` meant?"},
        {"materials: {x: {modulus: 70 Pa, poisson: 0.3}}\n", NULL},
        {"materials: {x: {radius: 0.005, mass: 3.63, modulus: 1e9, poisson: 0.3}}\n",
         "mass: 3.63 has no unit and is taken as 3.63 kg; is `3.63 g` meant?"},
        {"materials: {x: {radius: 0.005, mass: 0.00363, modulus: 1e9, poisson: 0.3}}\n", NULL},
        {"materials: {x: {radius: 0.005, density: 7.8, modulus: 1e9, poisson: 0.3}}\n", "is `7.8 g/cm3` meant?"},
        {"simulate: {until: 2}\n", "simulate.until: 2 has no unit and is taken as 2 s; is `2 ms` meant?"},
        {"simulate: {until: 2 s}\n", NULL},
        {"simulate: {until: 2e-3}\n", NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        struct bead_scene *scene = NULL;
        struct bead_message msg = {""};
        snprintf(text, sizeof text, "%schain: {beads: [{bead: ptfe}]}\n" PEAKS, cases[i].text);
        if (bead_scene_parse("test", text, strlen(text), NULL, &scene, &msg))
            fail_msg("%s", msg.text);
        if (!scene->doubts != !cases[i].told || (scene->doubts && !strstr(scene->doubts, cases[i].told)))
            fail_msg("%s is told: %s", cases[i].text, scene->doubts ? scene->doubts : "nothing");
        bead_scene_free(scene);
    }
    warns("chain: {beads: [{bead: ptfe}], wall: rigid, tilt: 1}\n" PEAKS,
          "chain.tilt: 1 has no unit and is taken as 1 rad; is `1 deg` meant?", "the pressure in the centre is");
}

/* The largest compression of a contact is the one that holds all of the energy, whatever the law and the compression at rest;
 * more where springs could also be pulled. */
static void compressions_hold_the_energy(void **state)
{
    (void)state;
    static const char *const laws[] = {"hertz", "{power: 1, coefficient: 1e6}", "{power: 2.5, coefficient: 1e12}",
                                       "{fpu-alpha: 2000, stiffness: 1e6}"};
    enum { FREE_SPRINGS = 6 };
    for (size_t k = 0; k < 2 * sizeof laws / sizeof *laws; k++) {
        char text[300];
        snprintf(text, sizeof text, "chain: {law: %s, %sbeads: [{bead: large-steel, count: 3}], wall: rigid}\n", laws[k / 2],
                 k % 2 ? "precompression: 120 N, " : "");
        struct built built = build(text, "");
        struct bead_contact_walk w;
        for (bead_contact_walk_start(&w, built.chain, false); bead_contact_walk_next(&w);) {
            assert_true((w.static_compression > 0) == (k % 2));
            for (double energy = 1e-7; energy < 2e-5; energy *= 10) {
                const double bound = bead_contact_bound(&w, energy), held = bead_contact_walk_excess(&w, bound) / energy;
                assert_true(bound > w.static_compression);
                assert_true(held > 1 - 1e-6 && (held < 1 + 1e-6 || k == FREE_SPRINGS));
            }
        }
        release(&built);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(compressions_hold_the_energy),
        cmocka_unit_test(forces_of_hertz),
        cmocka_unit_test(a_collision_and_its_bound),
        cmocka_unit_test(faster_strikes),
        cmocka_unit_test(measures_see_peaks),
        cmocka_unit_test(drives_have_no_bound),
        cmocka_unit_test(other_laws),
        cmocka_unit_test(runs_warn_once),
        cmocka_unit_test(sweeps_warn_of_their_first_chain),
        cmocka_unit_test(rows_are_marked),
        cmocka_unit_test(plain_numbers),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
