/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains of 1 bead to 1e6 beads: exact answers where they exist, cost and memory for each bead, and bits that must not depend on
 * the window, the instruction set, or (except for powers of two) the speed. */
#include <sys/resource.h>

#include "tests/stress/stress.h"

#define UNIFORM "chain: {beads: [{bead: large-steel, count: %zu}]}\n"
#define RANDOM  "chain: {beads: [{cell: [large-steel, aluminium], count: %zu, spins: random, magnetism: 0, seed: 5}]}\n"

/* Two beads that part again have exchanged momentum like billiard balls. */
static void two_beads(struct stress *stress, const char *other)
{
    char text[256], name[64];
    struct bead_message msg = {""};
    struct bead_run *run;
    struct bead_sample sample = {0};
    snprintf(text, sizeof text, "chain: {beads: [{bead: %s}]}\n", other);
    snprintf(name, sizeof name, "2 beads, steel on %s", other);
    struct built built = build(text, "accuracy: 1e-10");
    const double end = 1e-3, *m = built.chain->mass, v = built.chain->spec->striker_velocity;
    struct bead_run_settings settings = {
        .chain = built.chain, .simulate = &built.scene->simulate, .kernels = bead_kernels_find(NULL), .end = end};
    enum bead_error err = bead_run_create(&settings, &run, &msg);
    while (!err && bead_run_time(run) < end)
        err = bead_run_step(run, &msg);
    if (!err)
        err = bead_run_sample(run, end, BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY), (struct bead_span){0, SIZE_MAX - 1}, &sample, &msg);
    if (err)
        GIVE_UP("%s", msg.text);
    const double *got = sample.field[BEAD_FIELD_VELOCITY];
    double first = fabs(got[0] - v * (m[0] - m[1]) / (m[0] + m[1])) / v, second = fabs(got[1] - 2 * v * m[0] / (m[0] + m[1])) / v;
    stress_row(stress, fmax(first, second) < 1e-10, name, "velocities after the collision off by %.1e and %.1e", first, second);
    bead_run_destroy(run);
    release(&built);
}

static void short_chain(struct stress *stress, size_t beads)
{
    char text[256], name[64];
    snprintf(text, sizeof text, UNIFORM, beads - 1);
    snprintf(name, sizeof name, "%zu beads", beads);
    struct trial trial = try_scene(text, "accuracy: 1e-10", 2e-3);
    if (trial.error)
        GIVE_UP("%s", trial.message.text);
    stress_row(stress, trial.finite && trial.energy < 1e-10 && trial.momentum < 1e-12, name, "energy %.1e, momentum %.1e",
               trial.energy, trial.momentum);
    free(trial.peaks);
}

static double memory_now(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) ? 0 : 1024.0 * (double)usage.ru_maxrss;
}

/* Every bead computed in a few steps; then with the window, which must give the same bits. */
static void long_chain(struct stress *stress, size_t beads, double end)
{
    char text[256], name[64];
    snprintf(text, sizeof text, RANDOM, beads / 2);
    snprintf(name, sizeof name, "%.0e beads, %g us", (double)beads, end * 1e6);
    double before = memory_now();
    struct built built = build(text, "accuracy: 1e-6");
    struct trial window = try_chain(built.chain, (struct bead_run_settings){.end = end});
    struct trial full = try_chain(built.chain, (struct bead_run_settings){.end = end, .full_window = true});
    release(&built);
    if (window.error || full.error)
        GIVE_UP("%s", window.error ? window.message.text : full.message.text);
    double memory = (memory_now() - before) / (double)beads, cost = full.cpu / (double)full.steps / (double)beads;
    bool ok = full.finite && full.energy < 1e-5 && full.momentum < 1e-10 && full.hash == window.hash && memory < 1000;
    stress_row(stress, ok, name, "%6.1f ns and %4.0f bytes a bead; window %6.1f times faster, %s bits; energy %.1e, momentum %.1e",
               cost * 1e9, memory, full.cpu / window.cpu, full.hash == window.hash ? "same" : "OTHER", full.energy, full.momentum);
    free(window.peaks);
    free(full.peaks);
}

/* v times 32 with half the step is the same motion, all numbers being multiplied by powers of two. */
static void scaling(struct stress *stress, const char *method)
{
    const double scale_peaks = 64; /* force: scale^(6/5) */
    double step = 0x1p-19, end = 0x1p-9;
    char text[256], simulate[128], name[64];
    struct trial trial[2];
    for (int i = 0; i < 2; i++) {
        snprintf(text, sizeof text,
                 "chain: {striker: {bead: large-steel, velocity: %g}, beads: [{cell: [large-steel, aluminium],\n"
                 "  spins: \"" P3_SPINS "\"}]}\n",
                 i ? 8.0 : 0.25);
        snprintf(simulate, sizeof simulate, "method: %s, step: %.17g", method, i ? step / 2 : step);
        trial[i] = try_scene(text, simulate, i ? end / 2 : end);
        if (trial[i].error)
            GIVE_UP("%s", trial[i].message.text);
    }
    size_t different = 0, compared = 0;
    for (size_t k = 0; k < trial[0].contacts; k++) {
        compared += trial[0].peaks[k] > 0;
        different += trial[0].peaks[k] > 0 && trial[1].peaks[k] != scale_peaks * trial[0].peaks[k];
    }
    snprintf(name, sizeof name, "32 times the speed, %s", method);
    stress_row(stress, different == 0 && compared > 0, name, "%zu of %zu peaks differ from 64 times the others", different,
               compared);
    free(trial[0].peaks);
    free(trial[1].peaks);
}

static void instruction_sets(struct stress *stress)
{
    static const char *const sets[] = {"portable", "sse2", "avx2", "avx512"};
    struct built built = build(P3_CHAIN, "accuracy: 1e-6");
    uint64_t first = 0;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        const struct bead_kernels *kernels = bead_kernels_find(sets[i]);
        if (!kernels)
            continue;
        struct trial trial = try_chain(built.chain, (struct bead_run_settings){.end = 3e-3, .kernels = kernels});
        first = first ? first : trial.hash;
        stress_row(stress, !trial.error && trial.hash == first, sets[i], "hash of all states of P3 %016llx",
                   (unsigned long long)trial.hash);
        free(trial.peaks);
    }
    release(&built);
}

int main(void)
{
    struct stress stress = stress_start();
    printf("Sizes, and bits that must not change:\n");
    two_beads(&stress, "large-steel");
    two_beads(&stress, "aluminium");
    two_beads(&stress, "ptfe");
    short_chain(&stress, 3);
    short_chain(&stress, 4);
    long_chain(&stress, 1000, stress.quick ? 1e-3 : 10e-3);
    long_chain(&stress, 10000, stress.quick ? 0.1e-3 : 1e-3);
    long_chain(&stress, 100000, stress.quick ? 0.05e-3 : 0.2e-3);
    if (!stress.quick)
        long_chain(&stress, 1000000, 0.1e-3);
    for (size_t i = 0; bead_method_info(i); i++)
        scaling(&stress, bead_method_info(i)->name);
    instruction_sets(&stress);
    return stress_end(&stress);
}
