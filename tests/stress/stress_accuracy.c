/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks are as accurate as requested: the disordered chains of up to 256 dimers, and chains of other seeds, magnetisms, materials
 * and shapes. Peaks that are not predictable (tests/asked.h) do not count; the table has their number. */
#include "tests/stress/stress.h"

#include "tests/asked.h"

#define DIMERS(a, b, cells, magnetism, seed) \
    "chain: {beads: [{cell: [" a ", " b "], count: " cells ", spins: random, magnetism: " magnetism ", seed: " seed "}]}\n"

static const double asked[] = {1e-4, 1e-6, 1e-8, 1e-10};
enum { ASKED = sizeof asked / sizeof *asked };

static const struct {
    const char *name, *chain;
    double end, step; /* s; end 0: until the front has passed */
} cases[] = {
    {"100 dimers", DIMERS("large-steel", "aluminium", "100", "0", "1"), 0, 0.2e-6},
    {"100 dimers, magnetism 0.4", DIMERS("large-steel", "aluminium", "100", "0.4", "2"), 0, 0.2e-6},
    {"100 dimers, magnetism 0.8", DIMERS("large-steel", "aluminium", "100", "0.8", "3"), 0, 0.2e-6},
    {"250 dimers, 12 ms", DIMERS("large-steel", "aluminium", "250", "0", "7"), 12e-3, 0.1e-6},
    {"250 dimers, 12 ms, magnetism 0.2", DIMERS("large-steel", "aluminium", "250", "0.2", "22"), 12e-3, 0.1e-6},
    {"steel, PTFE, in order", "chain: {beads: [{cell: [large-steel, ptfe], count: 35}]}\n", 0, 0.4e-6},
    {"60 steel, PTFE", DIMERS("large-steel", "ptfe", "60", "0", "3"), 0, 0.4e-6},
    {"60 steel, nylon", DIMERS("large-steel", "nylon", "60", "0", "5"), 0, 0.3e-6},
    {"60 brass, nylon", DIMERS("brass", "nylon", "60", "0.2", "6"), 0, 0.3e-6},
    {"80 brass, aluminium", DIMERS("brass", "aluminium", "80", "0", "7"), 0, 0.2e-6},
    {"80 glass, steel", DIMERS("glass", "large-steel", "80", "0", "13"), 0, 0.2e-6},
    {"60 lead, tungsten carbide", DIMERS("lead", "tungsten-carbide", "60", "0", "9"), 0, 0.3e-6},
    {"40 trimers with small steel", DIMERS("large-steel, aluminium", "small-steel", "40", "0", "10"), 0, 0.2e-6},
    {"40 trimers with PTFE", DIMERS("large-steel, ptfe", "brass", "40", "0", "11"), 0, 0.3e-6},
    {"40 trimers with nylon", DIMERS("large-steel, aluminium", "nylon", "40", "0", "12"), 0, 0.2e-6},
    {"128 beads of steel", "chain: {beads: [{bead: large-steel, count: 128}]}\n", 0, 0.2e-6},
    {"large, then small beads", "chain: {beads: [{bead: large-steel, count: 30}, {bead: small-steel, count: 60}]}\n", 0, 0.2e-6},
    {"small, then large beads", "chain: {beads: [{bead: small-steel, count: 40}, {bead: large-steel, count: 30}]}\n", 0, 0.2e-6},
    {"wall, 10 m/s",
     "chain: {striker: {bead: large-steel, velocity: 10 m/s}, wall: brass,\n"
     "  beads: [{cell: [large-steel, aluminium], count: 80, spins: random, magnetism: 0, seed: 14}]}\n",
     0, 0.1e-6},
    {"wall, 1 mm/s",
     "chain: {striker: {bead: large-steel, velocity: 1 mm/s}, wall: brass,\n"
     "  beads: [{cell: [large-steel, aluminium], count: 80, spins: random, magnetism: 0, seed: 15}]}\n",
     0, 0.4e-6},
};

static void row(struct stress *stress, const char *name, const char *chain, double end, double step)
{
    struct asking asking = asking_start(chain, end, step, true);
    char text[256] = "";
    bool ok = true;
    for (size_t i = 0, used = 0; i < ASKED; i++) {
        struct answer answer = ask(&asking, asked[i]);
        ok = ok && answer.known < 0.2 && answer.worst < 1 && (double)answer.chaotic < 0.2 * (double)answer.peaks;
        used += (size_t)snprintf(text + used, sizeof text - used, "  %5.0e: %6.1e (%zu of %zu not predictable)", asked[i],
                                 answer.worst * asked[i], answer.chaotic, answer.peaks);
    }
    stress_row(stress, ok, name, "%s", text);
    asking_end(&asking);
}

static void disordered(struct stress *stress)
{
    char text[1024], name[64];
    size_t dimers = 0, number = 0;
    FILE *file = fopen("tests/reference/fig7_cases.csv", "r");
    if (!file)
        GIVE_UP("cannot read tests/reference/fig7_cases.csv");
    while (read_disordered(file, stress->quick ? 50 : 256, text, sizeof text, &dimers)) {
        snprintf(name, sizeof name, "disordered chain %zu: %zu dimers", ++number, dimers);
        row(stress, name, text, 0, dimers > 128 ? 0.1e-6 : 0.2e-6);
    }
    fclose(file);
}

int main(void)
{
    struct stress stress = stress_start();
    printf("Largest error of peaks of contacts and beads, for accuracies asked:\n");
    disordered(&stress);
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c += stress.quick ? 5 : 1)
        row(&stress, cases[c].name, cases[c].chain, cases[c].end, cases[c].step);
    return stress_end(&stress);
}
