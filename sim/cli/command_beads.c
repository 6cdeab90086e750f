/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The beads of a chain by materials, and its contacts, for --info: how the scene was understood. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/chain.h"
#include "beadreel/law.h"
#include "beadreel/scene.h"
#include "sim/base/json.h"
#include "sim/base/memory.h"
#include "sim/chain/contact_walk.h"
#include "sim/cli/command_line.h"

/* Least and most; begins as zeros. */
struct span {
    double low, high;
};

/* Properties of the beads of one material. */
struct kind {
    size_t count;
    struct span radius, mass, modulus, gap, spring;
};

static void widen(struct span *span, double value, bool first)
{
    span->low = first ? value : fmin(span->low, value);
    span->high = first ? value : fmax(span->high, value);
}

static void add_kind(struct kind *kind, const struct bead_material *material, size_t count)
{
    const bool first = kind->count == 0;
    kind->count += count;
    widen(&kind->radius, material->radius, first);
    widen(&kind->mass, material->mass, first);
    widen(&kind->modulus, material->modulus, first);
    widen(&kind->gap, material->gap, first);
    widen(&kind->spring, material->spring, first);
}

/* Counts beads by material, in the scene's numbering, without the striker; NULL: no memory. To be freed. From the specification: a
 * chain of 1e8 beads is not built just to describe it. */
static struct kind *kinds_of(const struct bead_chain *chain)
{
    const struct bead_material *materials = bead_chain_scene(chain)->materials;
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    struct kind *kinds = calloc(bead_chain_scene(chain)->material_count + 1, sizeof *kinds);
    for (size_t s = 0; kinds && s < spec->segment_count; s++) {
        const struct bead_segment *segment = &spec->segments[s];
        const size_t *indices = segment->each ? segment->each : segment->cell;
        const size_t cells = segment->each ? segment->count : 1, each = segment->each ? 1 : segment->count;
        for (size_t i = 0; i < cells * segment->cell_beads; i++)
            add_kind(&kinds[materials[indices[i]].of], &materials[indices[i]], each);
    }
    return kinds;
}

static struct span stiffness_of(const struct bead_chain *chain)
{
    struct span all = {0};
    struct bead_contact_walk walk;
    for (bead_contact_walk_start(&walk, chain, true); bead_contact_walk_next(&walk);)
        widen(&all, walk.stiffness, walk.k == 0);
    return all;
}

/* "4.76 mm", "1.8 mm to 4.76 mm" */
static void print_span(FILE *out, const char *name, struct span span, double factor, const char *unit)
{
    char low[32], high[32];
    fprintf(out, "%s %s", name, command_quantity(factor * span.low, unit, low, sizeof low));
    if (strcmp(low, command_quantity(factor * span.high, unit, high, sizeof high)) != 0)
        fprintf(out, " to %s", high);
}

void command_print_beads(FILE *out, const struct bead_chain *chain)
{
    const struct bead_scene *scene = bead_chain_scene(chain);
    BEAD_FREED struct kind *kinds = kinds_of(chain);
    for (size_t i = 0; kinds && i < scene->material_count; i++) {
        const struct kind *kind = &kinds[i];
        if (kind->count == 0)
            continue;
        fprintf(out, "  %zu bead%s of %s%s: ", kind->count, kind->count == 1 ? "" : "s", scene->materials[i].name,
                scene->materials[i].own ? " (your own)" : "");
        print_span(out, "radius", kind->radius, 1, "m");
        print_span(out, ", mass", kind->mass, 1e3, "g");
        print_span(out, ", modulus", kind->modulus, 1, "Pa");
        fprintf(out, ", Poisson %.3g", scene->materials[i].poisson);
        if (kind->gap.high > 0)
            print_span(out, ", gaps of", kind->gap, 1, "m");
        if (kind->spring.high > 0)
            print_span(out, ", springs of", kind->spring, 1, "N/m");
        fputc('\n', out);
    }
    const struct span stiffness = stiffness_of(chain);
    const struct bead_law_spec *law = &bead_chain_spec(chain)->law;
    fprintf(out, "  contacts: law %s, coefficient %.4g", law->row->name, stiffness.low);
    if (stiffness.high > stiffness.low)
        fprintf(out, " to %.4g", stiffness.high);
    fprintf(out, " N/m^%.4g\n", law->row->coefficient_power(law));
}

static void write_span(struct bead_json *json, const char *name, struct span span)
{
    bead_json_open(json, name, '[');
    bead_json_number(json, NULL, span.low);
    bead_json_number(json, NULL, span.high);
    bead_json_close(json, "]");
}

void command_write_beads(struct bead_json *json, const struct bead_chain *chain)
{
    const struct bead_scene *scene = bead_chain_scene(chain);
    BEAD_FREED struct kind *kinds = kinds_of(chain);
    bead_json_open(json, "kinds", '[');
    for (size_t i = 0; kinds && i < scene->material_count; i++) {
        if (kinds[i].count == 0)
            continue;
        bead_json_open(json, NULL, '{');
        bead_json_text(json, "material", scene->materials[i].name);
        bead_json_flag(json, "own", scene->materials[i].own);
        bead_json_number(json, "beads", (double)kinds[i].count);
        write_span(json, "radius_m", kinds[i].radius);
        write_span(json, "mass_kg", kinds[i].mass);
        write_span(json, "modulus_Pa", kinds[i].modulus);
        bead_json_number(json, "poisson", scene->materials[i].poisson);
        bead_json_close(json, "}");
    }
    bead_json_close(json, "]");
    const struct bead_law_spec *law = &bead_chain_spec(chain)->law;
    bead_json_text(json, "law", law->row->name);
    write_span(json, "coefficient", stiffness_of(chain)); /* N/m^power */
    bead_json_number(json, "coefficient_power", law->row->coefficient_power(law));
}
