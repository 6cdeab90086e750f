/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sweeps: forces, defects and decay, against other programs' results. */
#include "support.h"

#include "beadreel/sweep.h"
#include "sim/statistics/statistics.h"
#include "sim/sweep/sweep_internal.h"
#include "sweeps.h"

/* Forces that an independent program found (velocity-extended Forest-Ruth, steps of 20 ns), N to 8 digits and us. */
static const struct known {
    const char *text, *spins;
    double force, time;
    size_t bead;
} known[] = {
    {"20", "11111111111111111111", 36.05083850, 841.69700, 44},
    {"20", "11111111111111111110", 29.29725970, 834.47251, 44},
    {"20", "11000011101100110001", 22.69194659, 860.15264, 44},
    {"32", "11110111111111111110111111111111", 27.72518483, 1318.75505, 68},
    {"32", "01101010011100101101101100100010", 13.29868335, 1382.48926, 67},
};

static void forces_are_those_of_another_program(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        char text[256];
        snprintf(text, sizeof text, "sweep: {cells: %s, spins: [\"%s\"]}" OUTPUT, known[i].text, known[i].spins);
        struct bead_scene *scene = parse(text);
        struct bead_sweep *sweep = compute(scene, NULL);
        assert_near(peak_of(sweep, 0)->force, known[i].force, 1e-6 * known[i].force);
        assert_near(peak_of(sweep, 0)->time, 1e-6 * known[i].time, 1e-9);
        assert_int_equal(peak_of(sweep, 0)->bead, known[i].bead);
        bead_sweep_close(sweep);
        bead_scene_free(scene);
    }
}

/* Sensors of the experiment: 68 beads, dimers 2..19 free; forces at both, N, and their times, us. */
static void forces_at_sensors(void **state)
{
    (void)state;
    static const char text[] = "chain:\n"
                               "  beads:\n"
                               "    - {cell: [large-steel, aluminium], spins: up}\n"
                               "    - {cell: [large-steel, aluminium], count: 18, spins: random}\n"
                               "    - {bead: small-steel, sensor: first}\n"
                               "    - {cell: [large-steel, aluminium], spins: up}\n"
                               "    - {cell: [large-steel, aluminium], count: 3}\n"
                               "    - {bead: small-steel, sensor: second}\n"
                               "    - {cell: [large-steel, aluminium], count: 10}\n"
                               "  wall: brass\n"
                               "sweep:\n"
                               "  spins: [\"111111111110111111\", \"111110111011011100\", \"011110001000110001\"]\n"
                               "  measure: {peak: force, sensor: [first, second]}" OUTPUT;
    static const double wanted[3][4] = {{29.725809, 734.082, 29.274391, 898.910},
                                        {24.453513, 749.709, 23.736214, 911.775},
                                        {20.860941, 746.862, 19.284343, 925.099}};
    static const double magnetism[3] = {0.9, 0.5, 0};
    struct bead_scene *scene = parse(text);
    struct bead_sweep *sweep = compute(scene, NULL);
    assert_int_equal(bead_sweep_panel(sweep, 0)->places, 2);
    assert_string_equal(bead_sweep_place(sweep, 0, 1), "second");
    assert_near(peak_of(sweep, BEAD_SWEEP_CLEAN)[0].force, 34.504943, 1e-6 * 34.5);
    for (size_t i = 0; i < 3; i++) {
        struct bead_sweep_configuration found;
        assert_true(bead_sweep_configuration(sweep, 0, i, &found));
        assert_near(found.magnetism, magnetism[i], 1e-12);
        for (size_t place = 0; place < 2; place++) {
            assert_near(found.peaks[place].force, wanted[i][2 * place], 1e-6 * 30);
            assert_near(found.peaks[place].time, 1e-6 * wanted[i][2 * place + 1], 1e-9);
        }
    }
    bead_sweep_close(sweep);
    bead_scene_free(scene);
}

/* One reversed dimer: force ratio .87369, energy ratio, F^(5/3), .7985. Those are of one wave before and behind it; here they are
 * of the clean chain's wave at the same bead, which also loses force on its way, 5e-4 of it between dimers 20 and 60, so that ours
 * are that much higher: .87427. Beads 3 to 5, and the length of the chain, change nothing; nearer to the striker than dimer 10 the
 * wave has not formed, and the ratio is from .83 to .88. */
static void one_defect_transmits(void **state)
{
    (void)state;
    static const size_t places[] = {10, 14, 20, 30, 50};
    enum { PLACES = sizeof places / sizeof *places };
    char text[1024], spins[65];
    size_t used = (size_t)snprintf(text, sizeof text, "sweep: {cells: 64, spins: [");
    for (size_t i = 0; i < PLACES; i++) {
        memset(spins, '1', 64);
        spins[places[i]] = '0';
        spins[64] = 0;
        used += (size_t)snprintf(text + used, sizeof text - used, "%s\"%s\"", i ? ", " : "", spins);
    }
    snprintf(text + used, sizeof text - used, "]}" OUTPUT);
    struct bead_scene *scene = parse(text);
    struct bead_sweep *sweep = compute(scene, NULL);
    for (size_t i = 0; i < PLACES; i++) {
        double ratio = peak_of(sweep, i)->force / peak_of(sweep, BEAD_SWEEP_CLEAN)->force;
        assert_near(ratio, 0.87369, 0.001);
        assert_near(pow(ratio, 5.0 / 3), 0.7985, 0.001);
        assert_near(ratio, 0.87427, 3e-4);
    }
    bead_sweep_close(sweep);
    bead_scene_free(scene);
}

/* Lengths that another program found with more and longer chains: 103 beads at M = 0, 338 at .9; energy goes as F^(5/3). In the
 * clean chain the front keeps its energy. */
static void waves_decay(void **state)
{
    (void)state;
    struct bead_scene *scene = parse("sweep: {cells: 120, configurations: 25, seed: 5, magnetism: [0, 0.9],\n"
                                     "        measure: {peak: none, decay: true}}" OUTPUT);
    struct bead_sweep *sweep = compute(scene, NULL);
    struct bead_message msg = {""};
    struct bead_sweep_decay *decays = NULL;
    struct bead_sweep_configuration clean;
    size_t count = 0;
    assert_int_equal(bead_sweep_decays(sweep, 0, &decays, &count, &msg), BEAD_OK);
    assert_int_equal(count, 2);
    assert_near(decays[0].of_force.length, 103, 12);
    assert_near(decays[1].of_force.length, 338, 80);
    for (size_t i = 0; i < count; i++) {
        const struct bead_decay *force = &decays[i].of_force, *energy = &decays[i].of_energy;
        assert_near(energy->length / force->length, 0.6, 0.03);
        assert_true(force->length_error > 0 && force->length_error < 0.15 * force->length);
        assert_int_equal(force->last, energy->last);
    }
    /* Behind a delocalised wave most of the chain moves; a clean pulse is a few beads. */
    assert_true(bead_sweep_configuration(sweep, 0, BEAD_SWEEP_CLEAN, &clean));
    const size_t beads = bead_sweep_panel(sweep, 0)->beads;
    assert_true(bead_participation(clean.last_energy, beads) < 4);
    assert_true(decays[0].energy_participation > 15 && decays[0].force_participation > decays[0].energy_participation);
    const double striker = 0.5 * 3.63e-3 * 0.443 * 0.443;
    for (size_t j = 100; j < 240; j++)
        assert_near(clean.bead_energy[j], 0.9382 * striker, 1e-3 * striker);
    bead_sweep_decays_free(decays, count);
    bead_sweep_close(sweep);
    bead_scene_free(scene);
}

/* The decays of a sweep of 12 chains of a magnetism, half of which are run twice, at an accuracy. */
static void decays_at(const char *accuracy, struct bead_sweep **sweep, struct bead_scene **scene, struct bead_sweep_decay **decays)
{
    struct bead_message msg = {""};
    char text[256];
    size_t count;
    snprintf(text, sizeof text,
             "sweep: {cells: 60, configurations: 12, seed: 6, magnetism: [0.9, 0], measure: {decay: true}}\n"
             "simulate: {accuracy: %s}" OUTPUT,
             accuracy);
    *scene = parse(text);
    *sweep = compute(*scene, NULL);
    assert_int_equal(bead_sweep_decays(*sweep, 0, decays, &count, &msg), BEAD_OK);
    assert_int_equal(count, 2);
}

/* Errors of a number are within its uncertainty, apart from `rounding`, and that is small. */
static void is_known(double rough, double fine, double said, double most)
{
    if (!(fabs(rough - fine) <= said + 1e-9 * fabs(fine)))
        fail_msg("%.12g is off by %.3g, and says %.3g", rough, rough - fine, said);
    if (!(said > 0 && said < most * fabs(fine)))
        fail_msg("%.12g says %.3g", rough, said);
}

static void decay_knows_its_errors(void **state)
{
    (void)state;
    struct bead_sweep *sweep[2];
    struct bead_scene *scene[2];
    struct bead_sweep_decay *decays[2];
    decays_at("1e-4", &sweep[0], &scene[0], &decays[0]);
    decays_at("1e-9", &sweep[1], &scene[1], &decays[1]);
    for (size_t i = 0; i < 2; i++) {
        const struct bead_sweep_decay *rough = &decays[0][i], *fine = &decays[1][i];
        const struct bead_decay_uncertainty *said = rough->uncertain;
        is_known(rough->of_force.length, fine->of_force.length, said[0].length, 1e-3);
        is_known(rough->of_energy.length, fine->of_energy.length, said[1].length, 1e-3);
        is_known(rough->force_participation, fine->force_participation, said[0].participation, 0.02);
        is_known(rough->energy_participation, fine->energy_participation, said[1].participation, 0.02);
        for (size_t j = 0; j < bead_sweep_panel(sweep[0], 0)->beads; j++) {
            is_known(rough->force[j], fine->force[j], said[0].peaks[j], 1e-3);
            is_known(rough->energy[j], fine->energy[j], said[1].peaks[j], 1e-3);
        }
    }
    for (size_t k = 0; k < 2; k++) {
        bead_sweep_decays_free(decays[k], 2);
        bead_sweep_close(sweep[k]);
        bead_scene_free(scene[k]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_are_those_of_another_program),
        cmocka_unit_test(forces_at_sensors),
        cmocka_unit_test(one_defect_transmits),
        cmocka_unit_test(waves_decay),
        cmocka_unit_test(decay_knows_its_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
