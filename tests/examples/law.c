/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A custom force law, that of Toda's lattice, A (e^(B d) - 1): in a chain made in C, and in a scene that uses its name. Build: cc
 * law.c $(pkg-config --cflags --libs beadsim) -lm */
#include <beadreel/chain.h>
#include <beadreel/law.h>
#include <beadreel/play.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

struct toda {
    double a, b; /* N, 1/m */
};

static const struct toda *numbers(const struct bead_law_spec *spec)
{
    return spec->row->context;
}

static double coefficient(const struct bead_law_spec *spec, const struct bead_material *left, const struct bead_material *right,
                          bool wall)
{
    (void)left, (void)right, (void)wall;
    return numbers(spec)->a;
}

static double power(const struct bead_law_spec *spec)
{
    (void)spec;
    return 0; /* A is in N */
}

static double energy(double a, const struct bead_law_spec *spec, double d)
{
    return a * (expm1(numbers(spec)->b * d) / numbers(spec)->b - d);
}

static double force(double a, const struct bead_law_spec *spec, double d)
{
    return a * expm1(numbers(spec)->b * d);
}

static double stiffness(double a, const struct bead_law_spec *spec, double d)
{
    return a * numbers(spec)->b * exp(numbers(spec)->b * d);
}

static double compression(double a, const struct bead_law_spec *spec, double f)
{
    return log1p(f / a) / numbers(spec)->b;
}

static double energy_compression(double a, const struct bead_law_spec *spec, double e)
{
    return sqrt(2 * e / (a * numbers(spec)->b)); /* at least as much as energy e allows */
}

static const struct toda lattice = {.a = 1, .b = 1};
static const struct bead_law toda = {.name = "toda",
                                     .description = "A (e^(B d) - 1), two-sided (Toda 1967)",
                                     .context = &lattice,
                                     .coefficient = coefficient,
                                     .coefficient_power = power,
                                     .energy = energy,
                                     .force = force,
                                     .stiffness = stiffness,
                                     .compression = compression,
                                     .energy_compression = energy_compression};

/* Peaks of the contacts far from the striker. */
static enum bead_error play(const struct bead_chain *chain, const char *what, struct bead_message *msg)
{
    struct bead_player_settings settings = {.size = sizeof settings, .chain = chain, .until = 110, .contact_peaks = true};
    const struct bead_outcome *outcome;
    struct bead_player *player;

    enum bead_error err = bead_player_create(&settings, &player, msg);
    if (!err)
        err = bead_player_until(player, INFINITY, msg);
    if (!err)
        err = bead_player_finish(player, &outcome, msg);
    for (size_t k = 100; !err && k <= 120; k += 20)
        printf("%s: contact %zu: %.9f N at %.9f s\n", what, k, outcome->contact_peaks[k].value, outcome->contact_peaks[k].time);
    bead_player_destroy(player);
    return err;
}

/* 150 masses of 1 kg, struck with 2 m/s. */
static enum bead_error play_made(struct bead_message *msg)
{
    const struct bead_properties mass = {.radius = 1, .mass = 1, .modulus = 1, .poisson = 0};
    const struct bead_chain_settings settings = {
        .size = sizeof settings, .beads = &mass, .count = 1, .repeat = 150, .velocity = 2, .law = {.row = &toda}};
    struct bead_chain *chain;
    enum bead_error err = bead_chain_make(&settings, &chain, msg);
    if (!err)
        err = play(chain, "made", msg);
    bead_chain_destroy(chain);
    return err;
}

static enum bead_error play_scene(struct bead_message *msg)
{
    static const char text[] = "materials: {unit: {radius: 1 m, mass: 1 kg, modulus: 1 Pa, poisson: 0}}\n"
                               "chain: {striker: {bead: unit, velocity: 2 m/s}, beads: [{bead: unit, count: 150}], law: toda}\n"
                               "outputs: [{table: peaks.csv}]\n"; /* not made here */
    const struct bead_law *const laws[] = {&toda, NULL};
    const struct bead_own own = {.laws = laws};
    struct bead_scene *scene;
    struct bead_chain *chain = NULL;
    enum bead_error err = bead_scene_parse("toda.yaml", text, strlen(text), &(struct bead_overrides){.own = &own}, &scene, msg);
    if (!err)
        err = bead_chain_create(scene, 0, &chain, msg);
    if (!err)
        err = play(chain, "scene", msg);
    bead_chain_destroy(chain);
    bead_scene_free(scene);
    return err;
}

int main(void)
{
    struct bead_message msg;
    enum bead_error err = play_made(&msg);
    if (!err)
        err = play_scene(&msg);
    if (err)
        fprintf(stderr, "%s\n", msg.text);
    return bead_error_status(err);
}
