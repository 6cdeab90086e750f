/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes a chain from a caller's arrays, as if a scene had defined it, so that the rest need not distinguish them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "sim/base/settings.h"
#include "sim/chain/chain_data.h"
#include "sim/chain/system.h"

static const size_t most_beads = 100000000;

/* A scene with only the chain, in one piece of memory. Materials: the beads, the striker, the wall. */
struct own {
    struct bead_scene scene;
    struct bead_chain_spec spec;
    struct bead_segment segment;
    char name[128], nothing[1], method[8];
    struct bead_material materials[];
};

static enum bead_error wrong(const struct bead_chain_settings *given, struct bead_message *msg, const char *member, double value,
                             const char *allowed)
{
    return bead_fail(msg, BEAD_ERROR_USAGE, "%s: %s: %.6g; must be %s", given->name ? given->name : "chain", member, value,
                     allowed);
}

static bool is_positive(double x)
{
    return x > 0 && isfinite(x);
}

static bool is_not_negative(double x)
{
    return x >= 0 && isfinite(x);
}

static enum bead_error check_elastic(const struct bead_chain_settings *given, const struct bead_properties *p, const char *what,
                                     size_t index, struct bead_message *msg)
{
    char member[64];
    snprintf(member, sizeof member, "%s[%zu].%s", what, index, is_positive(p->modulus) ? "poisson" : "modulus");
    if (!is_positive(p->modulus))
        return wrong(given, msg, member, p->modulus, "a positive number of Pa");
    return p->poisson > -1 && p->poisson <= 0.5 ? BEAD_OK : wrong(given, msg, member, p->poisson, "above -1 and at most 0.5");
}

static enum bead_error check_bead(const struct bead_chain_settings *given, const struct bead_properties *p, const char *what,
                                  size_t index, struct bead_message *msg)
{
    char member[64];
    const bool radius = is_positive(p->radius);
    snprintf(member, sizeof member, "%s[%zu].%s", what, index, radius ? "mass" : "radius");
    if (!radius)
        return wrong(given, msg, member, p->radius, "a positive number of m");
    if ((p->mass == 0) == (p->density == 0) || !is_positive(p->mass + p->density))
        return wrong(given, msg, member, p->mass, "a positive number of kg, or 0 where the density is given instead");
    return check_elastic(given, p, what, index, msg);
}

static enum bead_error check_numbers(const struct bead_chain_settings *given, struct bead_message *msg)
{
    if (!is_not_negative(given->velocity))
        return wrong(given, msg, "velocity", given->velocity, "0 m/s or more");
    if (!is_not_negative(given->precompression))
        return wrong(given, msg, "precompression", given->precompression, "0 N or more");
    if (!(given->tilt >= 0 && given->tilt <= 1.5707963267948968))
        return wrong(given, msg, "tilt", given->tilt, "from 0 to 1.5708 rad");
    if (given->tilt > 0 && given->wall == BEAD_WALL_NONE)
        return wrong(given, msg, "tilt", given->tilt, "0 where no wall holds the lower end");
    if (!is_not_negative(given->damping_coefficient))
        return wrong(given, msg, "damping_coefficient", given->damping_coefficient, "0 or more");
    if (!is_not_negative(given->damping_exponent) || given->damping_exponent >= 10)
        return wrong(given, msg, "damping_exponent", given->damping_exponent, "from 0 to below 10");
    return (unsigned)given->wall > BEAD_WALL_MATERIAL ? wrong(given, msg, "wall", (double)given->wall, "a bead_wall") : BEAD_OK;
}

static bool is_given(const struct bead_properties *p)
{
    return p->radius != 0 || p->density != 0 || p->mass != 0 || p->modulus != 0 || p->poisson != 0;
}

static enum bead_error check(const struct bead_chain_settings *given, struct bead_message *msg)
{
    size_t beads;
    if (!given->beads || given->count == 0)
        return wrong(given, msg, "count", (double)given->count, "1 or more, with `beads` of that length");
    if (__builtin_mul_overflow(given->count, given->repeat > 0 ? given->repeat : 1, &beads) || beads > most_beads)
        return wrong(given, msg, "repeat", (double)given->repeat, "such that there are no more than 1e8 beads");
    BEAD_TRY(check_numbers(given, msg));
    for (size_t i = 0; i < given->count; i++)
        BEAD_TRY(check_bead(given, &given->beads[i], "beads", i, msg));
    if (is_given(&given->striker))
        BEAD_TRY(check_bead(given, &given->striker, "striker", 0, msg));
    if (given->wall == BEAD_WALL_MATERIAL)
        BEAD_TRY(check_elastic(given, &given->wall_material, "wall_material", 0, msg));
    if (given->law.row)
        BEAD_TRY(bead_law_check(given->law.row, msg));
    return BEAD_OK;
}

static struct bead_material material_of(struct own *own, const struct bead_properties *p, size_t index)
{
    const double volume = 4 * M_PI / 3 * p->radius * p->radius * p->radius;
    return (struct bead_material){.name = own->nothing,
                                  .label = own->nothing,
                                  .mass = p->mass > 0 ? p->mass : p->density * volume,
                                  .radius = p->radius,
                                  .modulus = p->modulus,
                                  .poisson = p->poisson,
                                  .colour = {0.6, 0.6, 0.6},
                                  .of = index};
}

static void fill_materials(struct own *own, const struct bead_chain_settings *given)
{
    const size_t n = given->count;
    for (size_t i = 0; i < n; i++) {
        own->segment.cell[i] = i;
        own->materials[i] = material_of(own, &given->beads[i], i);
    }
    own->materials[n] = material_of(own, is_given(&given->striker) ? &given->striker : given->beads, n);
    own->materials[n + 1] = material_of(own, &given->wall_material, n + 1);
}

static void fill(struct own *own, const struct bead_chain_settings *given)
{
    const size_t n = given->count;
    snprintf(own->name, sizeof own->name, "%s", given->name ? given->name : "chain");
    snprintf(own->method, sizeof own->method, "auto");
    own->segment = (struct bead_segment){.cell = (size_t *)(own->materials + n + 2),
                                         .cell_beads = n,
                                         .count = given->repeat > 0 ? given->repeat : 1,
                                         .spins = BEAD_SPINS_UP};
    fill_materials(own, given);
    own->spec = (struct bead_chain_spec){.system = &bead_system_beads,
                                         .name = own->nothing,
                                         .title = own->nothing,
                                         .label = own->nothing,
                                         .striker_material = n,
                                         .striker_velocity = given->velocity,
                                         .segments = &own->segment,
                                         .segment_count = 1,
                                         .wall = given->wall,
                                         .wall_material = n + 1,
                                         .law = given->law,
                                         .precompression = given->precompression,
                                         .tilt = given->tilt,
                                         .damping_coefficient = given->damping_coefficient,
                                         .damping_exponent = given->damping_exponent > 0 ? given->damping_exponent : 1.8};
    if (!own->spec.law.row)
        own->spec.law.row = bead_law_find("hertz");
    own->scene = (struct bead_scene){.file = own->name,
                                     .text = own->nothing,
                                     .title = own->nothing,
                                     .author = own->nothing,
                                     .materials = own->materials,
                                     .material_count = n + 2,
                                     .chains = &own->spec,
                                     .chain_count = 1,
                                     .simulate = {.until = NAN, .accuracy = 1e-6, .method = own->method}};
}

enum bead_error bead_chain_make(const struct bead_chain_settings *settings, struct bead_chain **chain, struct bead_message *msg)
{
    struct bead_chain_settings given;
    *chain = NULL;
    enum bead_error err = bead_settings_take(&given, sizeof given, BEAD_SETTINGS_UP_TO(struct bead_chain_settings, name), settings,
                                             "bead_chain_settings", msg);
    if (!err)
        err = check(&given, msg);
    if (err)
        return err;
    struct own *own = calloc(1, sizeof *own + (given.count + 2) * sizeof *own->materials + given.count * sizeof *own->segment.cell);
    if (!own)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the materials of %zu beads", given.count);
    fill(own, &given);
    err = bead_chain_create_of(&own->scene, &own->spec, chain, msg);
    if (err)
        free(own);
    else
        (*chain)->own = own;
    return err;
}
