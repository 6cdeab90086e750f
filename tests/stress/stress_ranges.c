/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains far from the usual: masses, moduli, sizes, speeds, compression, damping, laws. Each is run until the front has passed, at
 * the default accuracy of scenes, and again at a far higher accuracy. */
#include "tests/stress/stress.h"

#define STEEL "modulus: 193 GPa, poisson: 0.3"

/* Values first, first * factor, ... of the number in `chain`. */
struct range {
    const char *name, *chain;
    double first, factor;
    size_t count;
    double momentum; /* change allowed; INFINITY: there is a wall or weight */
    double end;      /* s; INFINITY: until the front has passed */
};

static const struct range ranges[] = {
    {"mass ratio, light mass kg",
     "materials: {light: {mass: %.17g kg, radius: 4.76 mm, " STEEL
     "}}\nchain: {beads: [{cell: [large-steel, light], count: 10}]}\n",
     3.63e-3, 0.1, 7, 1e-10, 1e-3},
    {"heavy beads in a light chain, kg",
     "materials: {heavy: {mass: %.17g kg, radius: 4.76 mm, " STEEL
     "}}\nchain: {beads: [{bead: large-steel, count: 5}, {bead: heavy}, {bead: large-steel, count: 5}]}\n",
     3.63e-2, 10, 6, 1e-10, 1e-3},
    {"light striker under compression, kg",
     "materials: {light: {mass: %.17g kg, radius: 4.76 mm, " STEEL "}}\nchain: {striker: {bead: light, velocity: 1 m/s}, "
     "precompression: 1 N, beads: [{bead: large-steel, count: 20}]}\n",
     3.63e-3, 0.1, 7, INFINITY, 1e-3},
    {"modulus, Pa",
     "materials: {x: {mass: 3.63 g, radius: 4.76 mm, modulus: %.17g, poisson: 0.3}}\n"
     "chain: {striker: {bead: x, velocity: 0.443 m/s}, beads: [{bead: x, count: 20}]}\n",
     1e6, 10, 7, 1e-10, INFINITY},
    {"modulus beside steel, Pa",
     "materials: {x: {mass: 1 g, radius: 4.76 mm, modulus: %.17g, poisson: 0.3}}\n"
     "chain: {beads: [{cell: [large-steel, x], count: 10}]}\n",
     1e6, 10, 7, 1e-10, INFINITY},
    {"radius, m",
     "materials: {x: {density: 8000 kg/m3, radius: %.17g m, " STEEL "}}\n"
     "chain: {striker: {bead: x, velocity: 0.443 m/s}, beads: [{bead: x, count: 20}]}\n",
     1e-6, 10, 7, 1e-10, INFINITY},
    {"radius beside steel, same mass, m",
     "materials: {x: {mass: 3.63 g, radius: %.17g m, " STEEL "}}\n"
     "chain: {beads: [{cell: [large-steel, x], count: 10}]}\n",
     4.76e-6, 10, 7, 1e-10, INFINITY},
    {"radius beside steel, density, m",
     "materials: {x: {density: 8000 kg/m3, radius: %.17g m, " STEEL "}}\n"
     "chain: {beads: [{cell: [large-steel, x], count: 10}]}\n",
     4.76e-5, 10, 4, 1e-10, 1e-3},
    {"speed, m/s",
     "chain: {striker: {bead: large-steel, velocity: %.17g m/s},\n"
     "  beads: [{cell: [large-steel, aluminium], count: 15, spins: random, magnetism: 0, seed: 1}]}\n",
     1e-9, 10, 12, 1e-10, INFINITY},
    {"precompression, N",
     "chain: {precompression: %.17g N, wall: brass, striker: {bead: large-steel, velocity: 0.443 m/s},\n"
     "  beads: [{cell: [large-steel, aluminium], count: 15, spins: random, magnetism: 0, seed: 1}]}\n",
     1e-12, 10, 17, INFINITY, 1e-3},
    {"precompression, slow, N",
     "chain: {precompression: %.17g N, wall: brass, striker: {bead: large-steel, velocity: 1 mm/s},\n"
     "  beads: [{bead: large-steel, count: 30}]}\n",
     1e-12, 100, 9, INFINITY, 1e-3},
    {"weight, tilt in degrees",
     "chain: {tilt: %.17g deg, wall: brass,\n"
     "  beads: [{cell: [large-steel, aluminium], count: 15, spins: random, magnetism: 0, seed: 1}]}\n",
     1e-3, 10, 5, INFINITY, 1e-3},
    {"steel and PTFE, cells", "chain: {beads: [{cell: [small-steel, ptfe], count: %.0f}]}\n", 5, 2, 4, 1e-10, INFINITY},
    {"PTFE, beads", "chain: {beads: [{bead: ptfe, count: %.0f}]}\n", 5, 2, 4, 1e-10, INFINITY},
    {"damping of power 1",
     "chain: {damping: {coefficient: %.17g, exponent: 1}, beads: [{cell: [large-steel, aluminium], count: 8}]}\n", 1e-3, 10, 6,
     1e-10, 2e-3},
    {"damping of power 1.8",
     "chain: {damping: {coefficient: %.17g, exponent: 1.8}, beads: [{cell: [large-steel, aluminium], count: 8}]}\n", 1e-3, 10, 6,
     1e-10, 2e-3},
    {"power law, power", "chain: {law: {power: %.17g, coefficient: 1e8}, beads: [{cell: [large-steel, aluminium], count: 10}]}\n",
     1.25, 1.26, 6, 1e-10, INFINITY},
    {"rigid wall, beads", "chain: {wall: rigid, beads: [{bead: large-steel, count: %.0f}]}\n", 1, 4, 4, INFINITY, 1e-3},
};

static bool has_damping(const struct range *range)
{
    return strstr(range->chain, "damping") != NULL;
}

/* Peaks this small beside the largest are not asked to be as accurate. */
static const double least = 1e-6;

static void try_value(struct stress *stress, const struct range *range, double value)
{
    char text[512], name[64], simulate[64];
    snprintf(text, sizeof text, range->chain, value);
    snprintf(name, sizeof name, "%s: %.4g", range->name, value);
    bool damped = has_damping(range);
    snprintf(simulate, sizeof simulate, "accuracy: 1e-6");
    struct trial trial = try_scene(text, simulate, range->end);
    if (trial.error == BEAD_ERROR_SCENE) {
        stress_row(stress, true, name, "refused: %s", trial.message.text);
        return;
    }
    if (trial.error) {
        stress_row(stress, false, name, "%s", trial.message.text);
        return;
    }
    struct trial finer = try_scene(text, damped ? "accuracy: 1e-8" : "accuracy: 1e-10", range->end);
    double peaks = finer.error ? NAN : peak_difference(&trial, &finer, least);
    bool kept = trial.energy < 1e-5 && !(trial.momentum > range->momentum);
    bool ok = trial.finite && trial.in_time && finer.in_time && kept && peaks <= 1e-6;
    stress_row(stress, ok, name, "step %8.2e s, %6llu steps, energy %7.1e, momentum %7.1e, peaks %7.1e%s%s%s", trial.step,
               (unsigned long long)trial.steps, trial.energy, isinf(range->momentum) ? 0 : trial.momentum, peaks,
               trial.finite ? "" : ", NOT FINITE", trial.in_time && finer.in_time ? "" : ", TOO LONG",
               finer.error ? ", finer: " : "");
    if (finer.error)
        printf("    %s\n", finer.message.text);
    free(trial.peaks);
    free(finer.peaks);
}

int main(void)
{
    struct stress stress = stress_start();
    printf("Chains far from the usual, accuracy 1e-6 asked:\n");
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        double value = ranges[i].first;
        for (size_t j = 0; j < ranges[i].count; j++, value *= ranges[i].factor) {
            if (!stress.quick || j % 4 == 0 || j + 1 == ranges[i].count)
                try_value(&stress, &ranges[i], value);
        }
    }
    return stress_end(&stress);
}
