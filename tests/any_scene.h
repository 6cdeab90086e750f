/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes drawn at random: short chains of all kinds, some of one bead, and tables of all that they can show, with any of their
 * keys. */
#ifndef BEADREEL_TESTS_ANY_SCENE_H
#define BEADREEL_TESTS_ANY_SCENE_H

#include "tests/kinds.h"

enum { ANY_OUTPUTS = 8, ANY_SAMPLES = 60 };

/* The beads that curves of places need, and from which sample on, if they say so. */
struct any_places {
    bool are, timed;
    size_t low, high, from, to;
};

/* Beads are numbered from 0, the striker, to `beads`. */
struct any_scene {
    struct kind_text chain; /* and what else comes before the outputs */
    size_t chains;
    size_t beads; /* of the shortest chain */
    double every; /* s, without rounding; the run has ANY_SAMPLES times as much */
    char output[ANY_OUTPUTS][200];
    struct any_places places[ANY_OUTPUTS];
    bool of_run[ANY_OUTPUTS]; /* what samples do not tell: peaks and their like */
};

static inline void any_segments(struct kind_text *t, struct drawing *d, bool gaps, size_t *beads)
{
    static const char *const of[] = {"large-steel", "aluminium", "brass", "ptfe", "m"}, *const more[] = {
                                                                                            "",
                                                                                            "",
                                                                                            "",
                                                                                            ", mass: 2 g",
                                                                                            ", modulus: 60 GPa",
                                                                                            ", taper: 3 %",
                                                                                            ", disorder: {radius: normal 2 %}",
                                                                                            ", spring: 2e4 N/m",
                                                                                            ", gap: 20 nm"};
    const size_t count = 1 + draw_below(d, 3);
    kind_add(t, ", beads: [");
    for (size_t s = 0; s < count; s++) {
        const size_t cells = 1 + draw_below(d, 4), first = draw_below(d, 5);
        const bool pair = draw_below(d, 2);
        kind_add(t, "%s{", s > 0 ? ", " : "");
        if (pair)
            kind_add(t, "cell: [%s, %s], spins: %s", of[first], of[(first + 1) % 5], draw_below(d, 2) ? "random" : "up");
        else
            kind_add(t, "bead: %s", of[first]);
        kind_add(t, ", count: %zu%s}", cells, more[draw_below(d, sizeof more / sizeof *more - !gaps)]);
        *beads += cells * (pair ? 2 : 1);
    }
    kind_add(t, ", {bead: %s, sensor: end}]", of[draw_below(d, 5)]);
    *beads += 1;
}

/* One chain in braces. */
static inline size_t any_chain(struct kind_text *t, struct drawing *d, size_t number)
{
    static const char *const walls[] = {"none", "rigid", "brass", "absorbing"},
                             *const forces[] = {"",
                                                "precompression: 2 N, ",
                                                "precompression: 2 N, ",
                                                "damping: {coefficient: 2, exponent: 1.5}, ",
                                                "tilt: 40 deg, ",
                                                "precompression: 20 N, drive: {force: noise, amplitude: 2 N, frequency: 20 kHz}, ",
                                                "precompression: 20 N, drive: {force: sine, amplitude: 2 N, frequency: 20 kHz}, ",
                                                "law: {power: 2.5, coefficient: 1e10}, ",
                                                "law: {fpu-alpha: 20, stiffness: 1e7}, ",
                                                "cradle: {length: 10 cm}, ",
                                                "start: [{bead: 1, velocity: -0.2 m/s}], "};
    size_t beads = 0;
    kind_add(t, "{name: %c, ", (int)('A' + number));
    if (draw_below(d, 4) > 0)
        kind_add(t, "striker: {bead: %s, velocity: %.4g m/s}, ", draw_below(d, 2) ? "m" : "small-steel", draw_between(d, 0.01, 5));
    const char *const force = forces[draw_below(d, sizeof forces / sizeof *forces)];
    kind_add(t, "%swall: %s", force, walls[*force == 't' ? 1 : draw_below(d, 4)]);
    any_segments(t, d, !strstr(force, "precompression"), &beads);
    kind_add(t, "}");
    return beads;
}

static inline void any_chains(struct any_scene *scene, struct drawing *d)
{
    static const char *const methods[] = {", accuracy: 1e-6", ", accuracy: 1e-6, verify: true", ", accuracy: 1e-9",
                                          ", accuracy: 1e-6, method: rk4, step: 0.2 us", ", accuracy: 1e-7, method: rk8"};
    struct kind_text *t = &scene->chain;
    const size_t chains = scene->chains = draw_below(d, 3) == 0 ? 2 : 1;
    scene->beads = SIZE_MAX;
    scene->every = 0x1p-21 * (double)(1 + draw_below(d, 4));
    kind_add(t, "materials: {m: {density: %.4g, modulus: %.4g GPa, poisson: 0.25, radius: %.4g mm}}\nchains:\n",
             draw_between(d, 1000, 9000), draw_between(d, 2, 200), draw_between(d, 2, 9));
    for (size_t c = 0; c < chains; c++) {
        kind_add(t, "  - ");
        const size_t beads = any_chain(t, d, c);
        scene->beads = beads < scene->beads ? beads : scene->beads;
        kind_add(t, "\n");
    }
    kind_add(t, "simulate: {until: %.17g s%s}\n", ANY_SAMPLES * scene->every,
             methods[draw_below(d, sizeof methods / sizeof *methods)]);
}

/* What an output shows, and which keys it may have. */
enum any_key {
    EVERY = 1,
    TIME = 2,
    BEADS = 4,
    CONTACTS = 8,
    FIELD = 16,
    AT = 32,
    ONE = 64,
    OF_RUN = 128,
    PARTS = 256,
    SEGMENT = 512
};
/* Digits of sensitivities that are not known depend on which others are found on the same way back. */
static const struct {
    const char *show;
    unsigned keys;
} any_shows[] = {{"sensors", EVERY | TIME | BEADS | FIELD},
                 {"sensors", EVERY | TIME | CONTACTS},
                 {"sensors", EVERY},
                 {"peaks", CONTACTS | OF_RUN},
                 {"bead-peaks", BEADS | OF_RUN},
                 {"measures", EVERY},
                 {"profiles", AT | FIELD},
                 {"chain", 0},
                 {"energy", EVERY | TIME | PARTS | OF_RUN},
                 {"extremes", EVERY | TIME | FIELD},
                 {"spreading", EVERY},
                 {"bands", 0},
                 {"eigenmodes", 0},
                 {"sensitivities, contacts: [0]", OF_RUN},
                 {"spectrum", EVERY | BEADS | FIELD},
                 {"spectrum", EVERY | CONTACTS | SEGMENT},
                 {"spectrogram", EVERY | BEADS | ONE | SEGMENT},
                 {"transfer", EVERY | BEADS | FIELD},
                 {"dispersion", EVERY | FIELD}};

/* Samples `from` to `to` of every `by`: within the run, and as often as not up to its ends. */
static inline void any_time(struct drawing *d, size_t by, size_t *from, size_t *to)
{
    const size_t last = ANY_SAMPLES / by;
    *from = by * (draw_below(d, 2) ? 0 : draw_below(d, last));
    *to = draw_below(d, 2) ? last * by : *from + by * (1 + draw_below(d, last - *from / by));
}

static inline void any_output(struct any_scene *scene, struct drawing *d, size_t o)
{
    static const char *const fields[] = {"force", "velocity", "displacement", "energy"};
    const size_t n = draw_below(d, sizeof any_shows / sizeof *any_shows);
    const unsigned keys = any_shows[n].keys;
    const size_t by = 1 + draw_below(d, 3);
    char *text = scene->output[o], *const end = text + sizeof scene->output[o];
    size_t from, to;
#define ADD(...) text += snprintf(text, (size_t)(end - text), __VA_ARGS__)
    ADD("show: %s", any_shows[n].show);
    if (keys & EVERY)
        ADD(", every: %.17g s", (double)by * scene->every);
    any_time(d, by, &from, &to);
    const bool timed = (keys & TIME) && draw_below(d, 2), open = draw_below(d, 2);
    if (timed)
        ADD(", time: [%.17g s, ", (double)from * scene->every);
    if (timed && open)
        ADD("auto]");
    else if (timed)
        ADD("%.17g s]", (double)to * scene->every);
    for (unsigned key = BEADS; key <= CONTACTS; key *= 2) {
        const size_t most = scene->beads - (key == CONTACTS), one = draw_below(d, most + 1), other = draw_below(d, 2) ? 0 : most;
        if ((keys & key) && (keys & TIME))
            scene->places[o] = (struct any_places){true,
                                                   timed,
                                                   one < other ? one : other,
                                                   (one > other ? one : other) + (key == CONTACTS),
                                                   from,
                                                   open ? ANY_SAMPLES : to};
        if ((keys & key) && (keys & ONE))
            ADD(", beads: [%zu]", one);
        else if (keys & key)
            ADD(one != other ? ", %s: [%zu, %zu]" : ", %s: [%zu]", key == BEADS ? "beads" : "contacts", one, other);
    }
    if (keys & FIELD)
        ADD(", field: %s", fields[draw_below(d, 4)]);
    if (keys & AT)
        ADD(", at: [%.17g s, %.17g s]", (double)from * scene->every, (double)to * scene->every);
    if ((keys & PARTS) && draw_below(d, 2))
        ADD(", parts: place");
    if (keys & SEGMENT)
        ADD(", segment: %.17g s", 18 * (double)by * scene->every);
#undef ADD
    scene->of_run[o] = keys & OF_RUN;
}

static inline struct any_scene any_draw(uint64_t seed)
{
    struct any_scene scene = {.chain.used = 0};
    struct drawing d = {seed, 0};
    any_chains(&scene, &d);
    for (size_t o = 0; o < ANY_OUTPUTS; o++)
        any_output(&scene, &d, o);
    return scene;
}

#endif
