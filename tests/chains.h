/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains made without scenes, and steppers on them. */
#ifndef BEADREEL_TESTS_CHAINS_H
#define BEADREEL_TESTS_CHAINS_H

#include "tests/support.h"

#include "beadreel/law.h"
#include "sim/chain/system.h"
#include "sim/integrate/events.h"

enum { STEEL, ALUMINIUM, BRASS, LIGHT };
static struct bead_material materials[] = {
    [STEEL] = {.name = "steel", .mass = 3.63e-3, .radius = 4.76e-3, .modulus = 193e9, .poisson = 0.30},
    [ALUMINIUM] = {.name = "aluminium", .mass = 1.26e-3, .radius = 4.76e-3, .modulus = 72.4e9, .poisson = 0.33},
    [BRASS] = {.name = "brass", .mass = NAN, .radius = NAN, .modulus = 90.2e9, .poisson = 0.34},
    [LIGHT] = {.name = "light", .mass = 0.123e-3, .radius = 2.38e-3, .modulus = 1.46e9, .poisson = 0.46},
};

struct setup {
    struct bead_scene scene;
    struct bead_chain_spec spec;
    struct bead_segment segment;
    size_t cell[2];
    struct bead_chain *chain;
};

/* `count` cells of one or two beads behind a steel striker. */
static inline void describe(struct setup *x, size_t cell_beads, size_t first, size_t second, size_t count, const char *spins,
                            double velocity)
{
    *x = (struct setup){.cell = {first, second}};
    x->segment = (struct bead_segment){.cell_beads = cell_beads,
                                       .count = count,
                                       .spins = spins ? BEAD_SPINS_DIGITS : BEAD_SPINS_UP,
                                       .digits = (char *)(uintptr_t)spins};
    x->spec = (struct bead_chain_spec){.system = &bead_system_beads,
                                       .striker_material = STEEL,
                                       .striker_velocity = velocity,
                                       .segment_count = 1,
                                       .wall = BEAD_WALL_MATERIAL,
                                       .wall_material = BRASS,
                                       .law = {.row = bead_law_find("hertz")}};
    x->scene =
        (struct bead_scene){.file = (char *)(uintptr_t) "test", .materials = materials, .material_count = 4, .chain_count = 1};
}

static inline void make(struct setup *x)
{
    struct bead_message msg = {""};
    x->segment.cell = x->cell;
    x->spec.segments = &x->segment;
    x->scene.chains = &x->spec;
    if (bead_chain_create(&x->scene, 0, &x->chain, &msg))
        fail_msg("%s", msg.text);
}

/* The problems that references exist for. */
static inline void make_problem(struct setup *x, int problem, double velocity)
{
    if (problem == 1)
        describe(x, 1, STEEL, STEEL, 50, NULL, velocity);
    else if (problem == 2)
        describe(x, 2, STEEL, ALUMINIUM, 34, NULL, velocity);
    else
        describe(x, 2, STEEL, ALUMINIUM, 64, P3_SPINS, velocity);
    make(x);
}

static inline struct bead_stepper *make_stepper(const struct setup *x, const char *method, const char *kernels, bool full)
{
    struct bead_message msg = {""};
    struct bead_stepper *stepper;
    const struct bead_kernels *set = bead_kernels_find(kernels);
    if (!set)
        return NULL;
    if (bead_stepper_create(x->chain, bead_method_row(method), set, full, &stepper, &msg))
        fail_msg("%s", msg.text);
    return stepper;
}

static inline void steps(struct bead_stepper *s, double h, size_t count)
{
    for (size_t i = 0; i < count; i++)
        bead_stepper_advance_by(s, h, s->t1 + h);
}

static inline struct bead_stepper *run(const struct setup *x, const char *method, double h, double until)
{
    struct bead_stepper *s = make_stepper(x, method, NULL, false);
    steps(s, h, (size_t)llround(until / h));
    return s;
}

static inline void drop(struct setup *x, struct bead_stepper *s)
{
    bead_stepper_destroy(s);
    if (x)
        bead_chain_destroy(x->chain);
}

/* Largest deviation of a velocity from a reference table (time, bead, displacement, velocity), in units of the striker's. */
static inline double velocity_error(const struct bead_stepper *s, const struct table *reference, double time)
{
    double worst = 0;
    for (size_t r = 0; r < reference->rows; r++) {
        const double *row = reference->value + r * reference->columns;
        if (fabs(row[0] - time) < 1e-9)
            worst = fmax(worst, fabs(s->end.v[(size_t)row[1]] - row[3]));
    }
    assert_true(worst > 0);
    return worst / s->chain->spec->striker_velocity;
}

static inline double difference(const struct bead_stepper *a, const struct bead_stepper *b)
{
    double worst = 0;
    for (size_t j = 0; j < a->beads; j++)
        worst = fmax(worst, fabs(a->end.v[j] - b->end.v[j]));
    return worst;
}

#endif
