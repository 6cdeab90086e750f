/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Absorbing ends: what they reflect. */
#include "measures.h"

#include "sim/chain/chain_data.h"
#include "tests/support.h"

enum { BEADS = 120, WAVES = 200, WIDTH = 8 };

/* A packet of waves of a linear chain that runs to the right, of masses of 1 kg and springs of 1 N/m, and the part of its energy
 * that a dashpot Z reflects by the closed form in sim/chain/absorbing_end.c. */
static double write_packet(double phase, double z, char *text, size_t size)
{
    double reflected = 0, energy = 0;
    size_t at = 0;
    for (int j = 0; j <= BEADS; j++) {
        double u = 0, v = 0;
        for (int i = -WAVES; i <= WAVES; i++) {
            const double q = phase + 5. * i / WAVES / WIDTH, omega = 2 * sin(q / 2), a = exp(-12.5 * i * i / WAVES / WAVES);
            const double place = q * (j - BEADS / 2);
            u += a * cos(place) * 1e-4;
            v += a * omega * sin(place) * 1e-4;
            reflected += j > 0 ? 0 : a * a * omega * omega * (1 + z * z - 2 * z * cos(q / 2)) / (1 + z * z + 2 * z * cos(q / 2));
            energy += j > 0 ? 0 : a * a * omega * omega;
        }
        at += (size_t)snprintf(text + at, size - at, "{bead: %d, displacement: %.17g, velocity: %.17g}%s", j, u, v,
                               j < BEADS ? ", " : "");
        assert_true(at < size);
    }
    return reflected / energy;
}

static void packets_leave_but_for_their_reflected_part(void **state)
{
    (void)state;
    static char starts[BEADS * 100], scene[BEADS * 100 + 1000];
    static const struct {
        double phase, z; /* 0: not given */
        const char *end;
    } cases[] = {{0.8, 1, "absorbing"}, {1.6, 1, "absorbing"}, {0.8, 2, "{absorbing: 2 kg/s}"}, {1.2, 0, "{absorbing: 0 N s/m}"}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        const double expected = write_packet(cases[c].phase, cases[c].z, starts, sizeof starts);
        snprintf(scene, sizeof scene,
                 "materials: {unit: {mass: 1 kg, radius: 0.5 m, modulus: 1 GPa, poisson: 0}}\nchain: {law: {power: 1, coefficient: "
                 "1}, precompression: 1 N, striker: {bead: unit}, beads: [{bead: unit, count: %d}], wall: %s, start: "
                 "[%s]}\nsimulate: {until: %.17g, accuracy: 1e-4}\noutputs: [{table: m.csv, show: measures, uncertainty: false}]\n",
                 BEADS, cases[c].end, starts, (BEADS / 2 + 5 * WIDTH) / cos(cases[c].phase / 2));
        measure(scene);
        near("reflected energy", expected, 1e-4 + 1e-3 * expected);
    }
}

#define STRUCK(end, speed) \
    UNIT "  striker: {bead: unit, velocity: " speed "}\n  beads: [{bead: unit, count: 59}]\n  wall: " end "\n"
#define UNTIL(time) "simulate: {until: " time ", accuracy: 1e-5}\noutputs: [{table: m.csv, show: measures, uncertainty: false}]\n"

/* As an independent program has it, for all speeds. */
#define REFLECTED 0.02911439

static void solitary_waves_come_back_by_three_per_cent(void **state)
{
    (void)state;
    measure(STRUCK("absorbing", "1 m/s") UNTIL("112 s"));
    near("reflected energy", REFLECTED, 1e-6);
    measure(STRUCK("absorbing", "32 m/s") UNTIL("56 s"));
    near("reflected energy", REFLECTED, 1e-6);
    measure(STRUCK("none", "1 m/s") UNTIL("112 s"));
    none("reflected energy");
}

/* Long before the wave reaches the end, another method has the same, although contacts open. */
static void contacts_open_as_without_it(void **state)
{
    (void)state;
    double velocity[2], time[2];
    static const char *const ends[] = {"none", "absorbing"};
    for (int i = 0; i < 2; i++) {
        char scene[600];
        snprintf(
            scene, sizeof scene,
            UNIT_OF(
                "  light: {mass: 0.3 kg, radius: 0.5 m, modulus: 1 GPa, poisson: 0}\n") "  striker: {bead: light, velocity: "
                                                                                        "1 m/s}\n  beads: [{bead: unit, count: "
                                                                                        "30}]\n  wall: %s\nsimulate: {until: 10, "
                                                                                        "accuracy: 1e-8}\noutputs: [{table: "
                                                                                        "m.csv, show: measures, uncertainty: "
                                                                                        "false}]\n",
            ends[i]);
        measure(scene);
        velocity[i] = value_of("striker's velocity");
        time[i] = value_of("striker's contact time");
    }
    assert_true(velocity[0] < -0.1);
    equal(velocity[1], velocity[0], 1e-7);
    equal(time[1], time[0], 1e-7);
}

/* Springs of equal contacts between two kinds of beads: long waves see the mean mass. */
static void cells_have_the_impedance_of_long_waves(void **state)
{
    (void)state;
    struct built b = build("materials: {a: {mass: 1 kg, radius: 1 m, modulus: 1 GPa, poisson: 0}, b: {mass: 3 kg, radius: 1 m, "
                           "modulus: 1 GPa, poisson: 0}}\nchain: {law: {power: 2, coefficient: 25}, precompression: 4 N, striker: "
                           "{bead: a}, beads: [{cell: [a, b], count: 9}, {bead: a}], wall: absorbing}\n",
                           "until: 1 s");
    equal(b.chain->end.coefficient, sqrt(20 * 2), 1e-12); /* 25 d^2 = 4: k = 50 d = 20 */
    equal(b.chain->end.exponent, 1, 0);
    release(&b);
    /* Hertz's contact of steel and aluminium: k = 3/2 A^(2/3) F^(1/3). That of the striker, steel on steel, does not count. */
    b = build("chain: {precompression: 20 N, beads: [{cell: [large-steel, aluminium], count: 3}], wall: absorbing}\n",
              "until: 1 s");
    equal(b.chain->end.coefficient, 155.9864, 1e-4);
    release(&b);
}

/* A pulse of 50 beads in a chain of dimers, from a driven end: matched, and with other impedances as lines of that of long waves.
 */
static void long_pulses_see_the_mean_of_the_cell(void **state)
{
    (void)state;
    static const double z = 155.9864; /* sqrt(k (m + M) / 2), k = 3/2 A^(2/3) F^(1/3) with Hertz's A of both kinds */
    static const struct {
        const char *end;
        double impedance, tolerance;
    } cases[] = {{"absorbing", z, 2e-4}, {"{absorbing: 50 kg/s}", 50, 2e-3}, {"{absorbing: 300 kg/s}", 300, 2e-3}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        char scene[700];
        snprintf(scene, sizeof scene,
                 "chain:\n  striker: {velocity: 0 m/s}\n  beads: [{cell: [large-steel, aluminium], count: 100}]\n  precompression: "
                 "20 N\n  wall: %s\n  drive: {bead: 0, force: '0 0, 0.4e-3 1, 0.8e-3 0', amplitude: 0.1 N}\nsimulate: {until: 4.4 "
                 "ms, accuracy: 1e-5}\noutputs: [{table: m.csv, show: measures, uncertainty: false}]\n",
                 cases[c].end);
        measure(scene);
        const double ratio = cases[c].impedance / z, part = (1 - ratio) / (1 + ratio);
        near("reflected energy", part * part, cases[c].tolerance);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(packets_leave_but_for_their_reflected_part), cmocka_unit_test(solitary_waves_come_back_by_three_per_cent),
        cmocka_unit_test(contacts_open_as_without_it), cmocka_unit_test(long_pulses_see_the_mean_of_the_cell),
        cmocka_unit_test(cells_have_the_impedance_of_long_waves)};
    return cmocka_run_group_tests_name("absorbing", tests, make_directory, remove_directory);
}
