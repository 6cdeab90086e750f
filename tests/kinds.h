/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains of all kinds, drawn at random: cells of two to five beads, tapers, disorder, decorations, force laws, precompression,
 * damping, slopes, walls, very slow and very fast strikers, very unlike materials, long chains. For stress. */
#ifndef BEADREEL_TESTS_KINDS_H
#define BEADREEL_TESTS_KINDS_H

#include <stdarg.h>

#include "tests/drawn.h"

enum kind {
    KIND_MIXED,
    KIND_CELLS,
    KIND_TAPER,
    KIND_DISORDER,
    KIND_DECORATED,
    KIND_POWER,
    KIND_FPU,
    KIND_PRESSED,
    KIND_DAMPED,
    KIND_SPEED,
    KIND_CONTRAST,
    KIND_TINY,
    KIND_TILTED,
    KIND_SHORT,
    KIND_LONG,
    KIND_COUNT
};
static const char *const kind_names[KIND_COUNT] = {"mixed",    "cells",     "taper",   "disorder", "decorated",
                                                   "power",    "fpu-alpha", "pressed", "damped",   "speed",
                                                   "contrast", "tiny",      "tilted",  "short",    "long"};

struct kind_text {
    char text[DRAWN_TEXT];
    size_t used;
};

__attribute__((format(printf, 2, 3))) static inline void kind_add(struct kind_text *t, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    t->used += (size_t)vsnprintf(t->text + t->used, sizeof t->text - t->used, format, values);
    va_end(values);
    if (t->used >= sizeof t->text)
        GIVE_UP("a chain's text is too long");
}

static inline void kind_material(struct kind_text *t, struct drawing *d, size_t index, double modulus, double radius)
{
    kind_add(t, "%sm%zu: {density: %.5g, modulus: %.5g GPa, poisson: %.3f, radius: %.5g mm}", index > 0 ? ",\n  " : "", index,
             draw_between(d, 1000, 12000), modulus, 0.05 + 0.4 * draw_part(d), radius);
}

static inline void kind_materials(struct kind_text *t, struct drawing *d, enum kind kind, size_t count)
{
    const double soft = draw_between(d, 0.5, 20), big = draw_between(d, 5, 20);
    kind_add(t, "materials: {");
    for (size_t m = 0; m < count; m++) {
        const double any = draw_between(d, 0.5, 600), radius = draw_between(d, 1, 20);
        kind_material(t, d, m,
                      kind == KIND_CONTRAST ? (m % 2 ? 0.6 : 600)
                      : kind == KIND_TINY   ? soft
                                            : any,
                      kind == KIND_TINY || kind == KIND_DECORATED ? (m % 2 ? big * draw_between(d, 0.02, 0.3) : big) : radius);
    }
    kind_add(t, "}\n");
}

static inline void kind_cell(struct kind_text *t, struct drawing *d, size_t materials, size_t beads)
{
    const size_t length = 2 + draw_below(d, 4);
    kind_add(t, "{cell: [");
    for (size_t i = 0; i < length; i++)
        kind_add(t, "%sm%zu", i > 0 ? ", " : "", i < materials ? i : draw_below(d, materials));
    char spins[48] = "spins: up";
    if (draw_below(d, 3) > 0)
        snprintf(spins, sizeof spins, "spins: random, seed: %zu", draw_below(d, 1000));
    kind_add(t, "], count: %zu, %s}", beads / length + 1, spins);
}

static inline void kind_beads(struct kind_text *t, struct drawing *d, enum kind kind, size_t materials, size_t beads)
{
    static const char *const of[] = {"radius", "mass", "modulus"};
    kind_add(t, ", beads: [");
    if (kind == KIND_TAPER)
        kind_add(t, "{bead: m0, count: %zu, taper: %.3g %%}, {cell: [m0, m%zu], count: %zu, taper: %.3g %%}", beads / 2 + 1,
                 1 + 7 * draw_part(d), materials - 1, beads / 4 + 1, 3 * draw_part(d));
    else if (kind == KIND_DISORDER)
        kind_add(t, "{bead: m0, count: %zu, disorder: {%s: normal %.3g %%, seed: %zu}}", beads, of[draw_below(d, 3)],
                 1 + 29 * draw_part(d), draw_below(d, 1000));
    else if (kind == KIND_DECORATED)
        kind_add(t, "{bead: m0, count: %zu, decorate: m1}", beads / 2 + 1);
    else if (kind == KIND_TINY)
        for (size_t j = 0; j < beads; j++)
            kind_add(t, "%s{bead: m%d}", j > 0 ? ", " : "", draw_below(d, 4) == 0);
    else if (kind == KIND_LONG || kind == KIND_CELLS)
        kind_cell(t, d, materials, beads);
    else
        for (size_t j = 0; j < beads; j++)
            kind_add(t, "%s{bead: m%zu}", j > 0 ? ", " : "", draw_below(d, materials));
    kind_add(t, "]");
}

/* The chain of a kind; returns whether it has damping. */
static inline bool kind_draw(uint64_t seed, enum kind kind, char text[DRAWN_TEXT])
{
    struct drawing d = {seed, 0};
    struct kind_text t = {.used = 0};
    if (kind == KIND_MIXED)
        return draw_chain(seed, 150, text);
    const size_t materials =
        kind == KIND_LONG || kind == KIND_CONTRAST || kind == KIND_TINY || kind == KIND_DECORATED ? 2 : 1 + draw_below(&d, 3);
    const size_t beads = (size_t)(kind == KIND_LONG    ? draw_between(&d, 200, 1000)
                                  : kind == KIND_SHORT ? draw_between(&d, 1, 8)
                                                       : draw_between(&d, 10, 120));
    static const char *const walls[] = {"none", "rigid", "m0", "brass"};
    const size_t wall = draw_below(&d, 4);
    const bool held = kind == KIND_PRESSED || kind == KIND_TILTED || (kind == KIND_FPU && wall == 0);
    kind_materials(&t, &d, kind, materials);
    const double speed = kind == KIND_SPEED ? draw_between(&d, 1e-6, 1000) : draw_between(&d, 0.01, 10);
    kind_add(&t, "chain: {striker: {bead: m%zu, velocity: %.5g m/s}, wall: %s", draw_below(&d, materials), speed,
             held && wall == 0 ? "rigid" : walls[wall]);
    if (kind == KIND_POWER)
        kind_add(&t, ", law: {power: %.3g, coefficient: %.4g}", 1 + 3 * draw_part(&d), draw_between(&d, 1e6, 1e12));
    if (kind == KIND_FPU) /* compressions stay well below 1 / alpha */
        kind_add(&t, ", law: {fpu-alpha: %.3g, stiffness: %.3g}", draw_between(&d, 1, 100), draw_between(&d, 1e7, 1e9));
    if (kind == KIND_PRESSED)
        kind_add(&t, ", precompression: %.4g N", draw_between(&d, 1e-3, 30));
    if (kind == KIND_TILTED)
        kind_add(&t, ", tilt: %.3g deg", 1 + 79 * draw_part(&d));
    if (kind == KIND_DAMPED)
        kind_add(&t, ", damping: {coefficient: %.3g, exponent: %.3g}", draw_between(&d, 0.01, 10), 0.7 + 2.3 * draw_part(&d));
    kind_beads(&t, &d, kind, materials, beads);
    kind_add(&t, "}\n");
    memcpy(text, t.text, t.used + 1);
    return kind == KIND_DAMPED;
}

#endif
