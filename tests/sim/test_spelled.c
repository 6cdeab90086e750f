/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene may be written in other words: reversed cells of the other spin, beads one by one, other units, defaults spelled out, the
 * digits that random spins have. All tables are the same to the last byte. */
#include "support.h"

#include <sys/stat.h>

#include "sessions.h"
#include "tests/scratch.h"

#define STRUCK "striker: {bead: large-steel, velocity: 0.443 m/s}, "
#define OF_BEADS                                                                                                                 \
    ", until: 5e-4 s",                                                                                                           \
    {                                                                                                                            \
        "peaks", "bead-peaks", "measures", "energy", "energy, parts: place", "profiles, at: [5e-5 s]", "sensors, beads: [2, 5]", \
            "spreading", "sensitivities"                                                                                         \
    }
#define OF_DRIVEN                                                                                                                \
    ", until: 3e-4 s",                                                                                                           \
    {                                                                                                                            \
        "peaks", "measures, every: 1 us", "energy, every: 1 us", "profiles, at: [5e-5 s]", "sensors, beads: [2, 5], every: 1 us" \
    }
#define OF_SWEEP                                               \
    "",                                                        \
    {                                                          \
        "statistics", "configurations", "sensors, every: 5 us" \
    }
static const struct {
    const char *one, *other; /* its chain, and what follows */
    const char *simulate;    /* more than nothing: part of `simulate` */
    const char *shows[10];
} pairs[] = {
    {"chain: {" STRUCK "beads: [{cell: [large-steel, aluminium], spins: '1101001'}, {bead: small-steel, count: 3}]}",
     "chain: {" STRUCK "beads: [{cell: [aluminium, large-steel], spins: '0010110'}, {bead: small-steel, count: 3}]}", OF_BEADS},
    {"chain: {" STRUCK "beads: [{cell: [large-steel, ptfe, aluminium], spins: '110100', gap: 0}], wall: brass}",
     "chain: {" STRUCK "beads: [{cell: [aluminium, ptfe, large-steel], spins: '001011'}], wall: brass}", OF_BEADS},
    {"chain: {" STRUCK "beads: [{cell: [large-steel, aluminium], spins: random, seed: 11, count: 9}]}", NULL, OF_BEADS},
    {"chain: {" STRUCK "beads: [{bead: large-steel, count: 4}, {bead: aluminium, count: 3}], precompression: 2 N}",
     "chain: {" STRUCK "beads: [{bead: large-steel, count: 1}, {bead: large-steel}, {bead: large-steel, count: 2}, {bead: "
     "aluminium}, {bead: aluminium, count: 2}], precompression: 2000 mN}",
     OF_BEADS},
    {"chain: {beads: [{bead: large-steel, count: 8}]}",
     "chain: {striker: {bead: large-steel, velocity: 443 mm/s}, beads: [{bead: large-steel, count: 8}], law: hertz, wall: none, "
     "gap: 0 m, tilt: 0 deg}",
     OF_BEADS},
    {"materials: {m: {mass: 2 g, radius: 5 mm, modulus: 50 GPa, poisson: 0.25}}\nchain: {" STRUCK "beads: [{bead: m, count: 8}]}",
     "materials: {m: {mass: 0.002 kg, radius: 0.005 m, modulus: 5e4 MPa, poisson: 0.25, label: M}}\nchain: {" STRUCK
     "beads: [{bead: m, count: 8}]}",
     OF_BEADS},
    {"chain: {" STRUCK "beads: [{cell: [large-steel, aluminium], spins: random, count: 5}, {bead: aluminium, sensor: s}]}\n"
     "sweep: {over: {chain.beads.0.seed: 1..3}}",
     "chain: {" STRUCK "beads: [{cell: [large-steel, aluminium], spins: random, count: 5}, {bead: aluminium, sensor: s}]}\n"
     "sweep: {over: {chain.beads.0.seed: [1, 2, 3]}}",
     OF_SWEEP},
    {"chain: {" STRUCK "gap: 1 um, wall: rigid, beads: [{bead: large-steel, count: 5, spring: 1e5 N/m}]}",
     "chain: {" STRUCK "wall: rigid, beads: [{bead: large-steel, spring: 1e2 N/mm}, {bead: large-steel, count: 4, gap: 1e-3 mm, "
     "spring: 1e5}]}",
     OF_DRIVEN},
    {"chain: {" STRUCK "tilt: 90 deg, wall: brass, damping: {coefficient: 2}, beads: [{cell: [2 ptfe, aluminium], count: 3}]}",
     "chain: {" STRUCK "tilt: 1.5707963267948966 rad, wall: brass, damping: {coefficient: 2, exponent: 1.8, compression: 0}, "
     "beads: [{cell: [ptfe, ptfe, aluminium], count: 3}]}",
     OF_DRIVEN},
    {"chain: {" STRUCK "beads: [{bead: large-steel, mass: 2 g, modulus: 100 GPa, count: 6}]}",
     "materials: {m: {mass: 2 g, radius: 4.76 mm, modulus: 1e5 MPa, poisson: 0.3, yield: 1.04 GPa}}\nchain: {" STRUCK
     "beads: [{bead: m, count: 6}]}",
     OF_BEADS},
    {"chain: {drive: {force: noise, amplitude: 2 N, frequency: 5 kHz}, precompression: 20 N, beads: [{bead: aluminium, count: 6}]}",
     "chain: {drive: {bead: 0, force: noise, amplitude: 2000 mN, frequency: 5000 Hz, ramp: 0 s, seed: 0}, precompression: 20 N, "
     "beads: [{bead: aluminium, count: 6}]}",
     OF_DRIVEN},
    {"chain: {start: [{bead: [2, 4], velocity: 0.1 m/s}, {bead: last, displacement: 1 um}], beads: [{bead: aluminium, count: 6}]}",
     "chain: {striker: {velocity: 0}, start: [{bead: 2, velocity: 10 cm/s}, {bead: 3, velocity: 0.1}, {bead: 4, velocity: 0.1 "
     "m/s}, {bead: 6, displacement: 1000 nm}], beads: [{bead: aluminium, count: 6}]}",
     OF_DRIVEN},
    {"chain: {equation: fput, points: 16, alpha: 0.25, start: {mode: 1}}",
     "chain: {equation: fput, points: 16, alpha: 0.25, beta: 0, ends: fixed, start: {mode: 1, amplitude: 1}}",
     ", until: 40",
     {"measures, every: 0.5", "modes, every: 0.5", "profiles, at: [3.3]", "sensors, beads: [3], every: 0.7"}},
};

/* The chain of `text` with the spins that are drawn for it. */
static const char *with_digits(const char *text)
{
    static char spelled[1000];
    const char *random = strstr(text, "random, seed: 11");
    char line[1000];
    snprintf(line, sizeof line, "%s\n", text);
    struct built built = build(line, "");
    snprintf(spelled, sizeof spelled, "%.*s'%s'}]}", (int)(random - text), text, bead_chain_spins(built.chain));
    release(&built);
    return spelled;
}

static void play(size_t pair, bool other)
{
    char text[3000], path[600], out[600];
    const char *chain = !other ? pairs[pair].one : pairs[pair].other ? pairs[pair].other : with_digits(pairs[pair].one);
    size_t used = (size_t)snprintf(text, sizeof text, "%s\nsimulate: {%s%s}\noutputs:\n", chain,
                                   other ? "accuracy: 1.0e-6, method: auto" : "accuracy: 1e-6", pairs[pair].simulate);
    for (size_t i = 0; i < sizeof pairs->shows / sizeof *pairs->shows && pairs[pair].shows[i]; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "  - {table: %zu.csv, show: %s}\n", i, pairs[pair].shows[i]);
    snprintf(path, sizeof path, "%s/scene.yaml", directory);
    snprintf(out, sizeof out, "%s/%d", directory, other);
    mkdir(out, 0777);
    write_text(path, text);
    play_counts((struct bead_job){.input = path, .output = out, .threads = 1});
}

static size_t read_table_of(bool other, size_t output, char *text, size_t size)
{
    char path[600];
    snprintf(path, sizeof path, "%s/%d/%zu.csv", directory, other, output);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    const size_t length = fread(text, 1, size - 1, file);
    text[length] = '\0';
    fclose(file);
    return length;
}

static void scenes_mean_the_same_in_other_words(void **)
{
    static char text[2][1 << 16];
    for (size_t p = 0; p < sizeof pairs / sizeof *pairs; p++) {
        for (int other = 0; other < 2; other++)
            play(p, other);
        for (size_t i = 0; i < sizeof pairs->shows / sizeof *pairs->shows && pairs[p].shows[i]; i++) {
            for (int other = 0; other < 2; other++)
                assert_true(read_table_of(other, i, text[other], sizeof text[other]) > 100);
            size_t at = 0;
            while (text[0][at] && text[0][at] == text[1][at])
                at++;
            if (text[0][at] || text[1][at])
                fail_msg("pair %zu, %s: %.60s, or %.60s", p, pairs[p].shows[i], text[0] + at, text[1] + at);
        }
    }
}

#define RANDOM "chain: {" STRUCK "beads: [{cell: [large-steel, aluminium], spins: random, count: 20}]}\n"
#define SWEPT  RANDOM "sweep: {over: {chain.beads.0.seed: 1..2}}\n"
static const struct {
    const char *scene, *show, *column;
} limited[] = {
    {RANDOM, "spectrum, beads: [2, 5]", "frequency_Hz"},
    {RANDOM, "spectrogram, beads: [2], segment: 1e-4 s", "frequency_Hz"},
    {RANDOM, "dispersion, field: velocity", "found_Hz"},
    {"chain: {drive: {force: noise, amplitude: 2 N, frequency: 50 kHz}, precompression: 20 N, beads: [{bead: aluminium, count: "
     "8}]}\n",
     "transfer, beads: [4]", "frequency_Hz"},
    {SWEPT, "spectrum, beads: [2]", "frequency_Hz"},
    {SWEPT, "dispersion, field: velocity", "found_Hz"},
};

/* The value of a column, in the line that has as many fields before it. */
static double value_in(const char *header, const char *column, const char *line)
{
    const size_t length = strlen(column);
    for (; *header && (strncmp(header, column, length) != 0 || (header[length] != ',' && header[length] != '\n')); line++) {
        header += strcspn(header, ",\n") + 1;
        line += strcspn(line, ",\n");
    }
    return *header && *line != ',' ? strtod(line, NULL) : NAN;
}

/* Between some frequencies a table has the lines of the whole that are between them. */
static void limits_leave_lines_out(void **)
{
    static char text[2][1 << 18];
    const double low = 5e3, high = 2e4;
    for (size_t n = 0; n < sizeof limited / sizeof *limited; n++) {
        char scene[1000], path[600];
        snprintf(scene, sizeof scene,
                 "%ssimulate: {until: 4e-4 s}\noutputs: [{table: 0.csv, show: %s, every: 2 us}, {table: 1.csv, show: "
                 "%s, every: 2 us, frequencies: [5 kHz, 20 kHz]}]\n",
                 limited[n].scene, limited[n].show, limited[n].show);
        snprintf(path, sizeof path, "%s/scene.yaml", directory);
        write_text(path, scene);
        snprintf(scene, sizeof scene, "%s/0", directory);
        mkdir(scene, 0777);
        play_counts((struct bead_job){.input = path, .output = scene, .threads = 1});
        for (int part = 0; part < 2; part++)
            read_table_of(0, (size_t)part, text[part], sizeof text[part]);
        size_t kept = 0, left = 0;
        const char *next = text[1] + strcspn(text[1], "\n") + 1;
        for (const char *line = text[0] + strcspn(text[0], "\n") + 1; *line; line += strcspn(line, "\n") + 1) {
            const double value = value_in(text[0], limited[n].column, line);
            if (value < low || value > high) {
                left++;
                continue;
            }
            const size_t length = strcspn(line, "\n") + 1;
            if (strncmp(line, next, length) != 0)
                fail_msg("%s: %.60s instead of %.60s", limited[n].show, next, line);
            next += length;
            kept++;
        }
        assert_true(!*next && kept > 3 && left > 3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(scenes_mean_the_same_in_other_words),
                                       cmocka_unit_test(limits_leave_lines_out)};
    return cmocka_run_group_tests_name("spelled", tests, make_directory, remove_directory);
}
