/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Beads that differ from their material: see scene_private.h. Each different value makes another material of the same name. */
#include "sim/base/memory.h"
#include "sim/scene/scene_private.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/elementary.h"
#include "sim/base/random.h"
#include "sim/base/wide.h"

/* Beads of a scene that differ one by one: each has a material. */
enum { MOST_VARIED = 100000 };

const struct bead_variation bead_variation_none = {
    .value = {NAN, NAN, NAN, NAN, NAN}, .ratio = NAN, .ends = {NAN, NAN}, .alike = 1};

/* `draws`: number of the stream of random numbers; 1003 is that of materials. */
static const struct {
    const char *key, *unit;
    size_t offset;
    double low, high;
    unsigned draws;
} varied[BEAD_VARIED_COUNT] = {[BEAD_VARIED_RADIUS] = {"radius", "m", offsetof(struct bead_material, radius), 1e-9, 1e3, 1000},
                               [BEAD_VARIED_MASS] = {"mass", "kg", offsetof(struct bead_material, mass), 1e-30, 1e15, 1001},
                               [BEAD_VARIED_MODULUS] = {"modulus", "Pa", offsetof(struct bead_material, modulus), 1, 1e15, 1002},
                               [BEAD_VARIED_GAP] = {"gap", "m", offsetof(struct bead_material, gap), 0, 1e3, 1004},
                               [BEAD_VARIED_SPRING] = {"spring", "N/m", offsetof(struct bead_material, spring), 0, 1e30, 1005}};
enum { MATERIAL_DRAWS = 1003, SHUFFLE_DRAWS = 1006 };

static double *value_of(struct bead_material *material, enum bead_varied what)
{
    return (double *)(void *)((char *)material + varied[what].offset);
}

/* ---- materials in lists ---- */

/* The number of beads that "2 ptfe" means; *name then points after the number. A material may have such a name itself. */
static size_t parts_of(const struct bead_reader *reader, const char *text, const char **name)
{
    const size_t digits = strspn(text, "0123456789");
    *name = text;
    for (size_t i = 0; i < reader->scene->material_count; i++) {
        if (strcmp(reader->scene->materials[i].name, text) == 0)
            return 1;
    }
    if (digits == 0 || digits > 6 || text[digits] != ' ')
        return 1;
    *name = text + digits + strspn(text + digits, " ");
    return strtoul(text, NULL, 10);
}

static enum bead_error read_parts(const struct bead_reader *reader, const struct bead_at *at, size_t **materials, size_t *count)
{
    const char *text = NULL, *name = NULL;
    size_t material = 0;
    BEAD_TRY(bead_read_scalar(reader, at, "the name of a material", &text));
    const size_t parts = parts_of(reader, text, &name);
    struct bead_node node = *at->node;
    struct bead_at named = *at;
    node.text = name;
    named.node = &node;
    if (parts == 0)
        return bead_wrong(reader, at, "is none of them; the number must be 1 or more");
    if (*count + parts > BEAD_YAML_NODES)
        return bead_wrong(reader, at, "makes %zu beads of a cell; at most %d are allowed", *count + parts, BEAD_YAML_NODES);
    BEAD_TRY(bead_scene_find_material(reader, &named, true, &material));
    size_t *grown = realloc(*materials, (*count + parts) * sizeof *grown);
    if (!grown)
        return bead_no_memory(reader);
    *materials = grown;
    for (size_t i = 0; i < parts; i++)
        grown[(*count)++] = material;
    return BEAD_OK;
}

enum bead_error bead_scene_read_cell(struct bead_reader *reader, const struct bead_at *at, size_t **materials, size_t *count)
{
    if (at->node->kind != BEAD_NODE_LIST || at->node->count == 0)
        return bead_must_be(reader, at, "[MATERIAL, MATERIAL, ...]");
    for (size_t i = 0; i < at->node->count; i++) {
        struct bead_at element = bead_at_item(at, i);
        BEAD_TRY(read_parts(reader, &element, materials, count));
    }
    return BEAD_OK;
}

/* ---- taper ---- */

static const struct bead_option taper_rows[] = {
    {"from", BEAD_OPTION_NUMBER, offsetof(struct bead_variation, ends[0]), .unit = "m", .initial = "auto", .low = 1e-9, .high = 1e3,
     .word = "auto", .word_value = NAN, .help = "radius of the first bead; auto: that of its material", .example = "4.76 mm"},
    {"to", BEAD_OPTION_NUMBER, offsetof(struct bead_variation, ends[1]), .unit = "m", .required = true, .low = 1e-9, .high = 1e3,
     .help = "radius of the last bead; those between differ by the same factor", .example = "1.8 mm"},
};
const struct bead_options bead_taper_options = {"chain.beads.taper", "radii from end to end; masses follow with the densities",
                                                BEAD_OPTIONS(taper_rows), NULL, NULL};

BEAD_OPTION_READER(bead_scene_read_taper)
{
    struct bead_variation *v = (void *)((char *)settings + option->offset);
    struct bead_option part = *option;
    if (at->node->kind == BEAD_NODE_MAP)
        return bead_options_read(reader, at, &bead_taper_options, v);
    part.type = BEAD_OPTION_NUMBER;
    BEAD_TRY(bead_read_number(reader, at, &part, &v->ratio));
    v->ratio = 1 - v->ratio;
    return BEAD_OK;
}

/* ---- disorder ---- */

/* Reads a factor, or else a value with its unit. */
static bool read_end(const struct bead_reader *reader, const char *text, size_t what, bool *absolute, double *value)
{
    const char *unit = varied[what].unit;
    char why[200];
    *absolute = bead_units_read(reader->units, text, "1", value, why, sizeof why) != BEAD_OK;
    return (!*absolute || bead_units_read(reader->units, text, unit, value, why, sizeof why) == BEAD_OK) &&
           (*value > 0 || (*value == 0 && varied[what].low == 0));
}

/* "uniform 0.3..1", "uniform 2 mm..4 mm", "normal 5 %" */
static BEAD_OPTION_READER(read_distribution)
{
    static const double widest = 0.3;
    struct bead_distribution *d = (void *)((char *)settings + option->offset);
    const size_t what = (option->offset - offsetof(struct bead_variation, random)) / sizeof *d;
    const char *text = NULL;
    char low[64] = "";
    bool absolute[2] = {false, false};
    BEAD_TRY(bead_read_scalar(reader, at, option->shape, &text));
    const char *dots = strstr(text, "..");
    if (strncmp(text, "normal ", 7) == 0) {
        *d = (struct bead_distribution){.kind = BEAD_NORMAL};
        bool good = read_end(reader, text + 7, what, &absolute[0], &d->high) && !absolute[0] && d->high <= widest;
        return good ? BEAD_OK : bead_must_be(reader, at, option->shape);
    }
    if (strncmp(text, "uniform ", 8) != 0 || !dots || strstr(dots + 2, "..") || (size_t)(dots - text - 8) >= sizeof low)
        return bead_must_be(reader, at, option->shape);
    snprintf(low, sizeof low, "%.*s", (int)(dots - text - 8), text + 8);
    *d = (struct bead_distribution){.kind = BEAD_UNIFORM};
    bool good = read_end(reader, low, what, &absolute[0], &d->low) && read_end(reader, dots + 2, what, &absolute[1], &d->high);
    if (absolute[1] && !absolute[0]) { /* "2..4 mm": the unit is for both */
        const size_t used = strlen(low);
        snprintf(low + used, sizeof low - used, "%s", dots + 2 + strspn(dots + 2, " +-.0123456789eE"));
        good = good && read_end(reader, low, what, &absolute[0], &d->low);
    }
    d->absolute = absolute[0];
    return good && absolute[0] == absolute[1] && d->low <= d->high ? BEAD_OK : bead_must_be(reader, at, option->shape);
}

static BEAD_OPTION_READER(read_materials)
{
    struct bead_variation *v = settings;
    return bead_scene_read_cell(reader, at, &v->materials, &v->material_count);
}

#define RANDOM_ROW(name, index, words, with_unit)                                                                       \
    {                                                                                                                   \
        .key = name, .type = BEAD_OPTION_CUSTOM, .offset = offsetof(struct bead_variation, random[index]),              \
        .shape = "uniform LOW..HIGH (factors such as 0.3..1, or values with their unit), or normal WIDTH (up to 30 %)", \
        .help = words, .example = with_unit, .like = "text", .read = read_distribution                                  \
    }
static const struct bead_option disorder_rows[] = {
    RANDOM_ROW("radius", BEAD_VARIED_RADIUS,
               "random radii; masses follow with the densities. normal: cut off at three standard deviations", "uniform 0.3..1"),
    RANDOM_ROW("mass", BEAD_VARIED_MASS, "random masses at the same radius", "normal 5 %"),
    RANDOM_ROW("modulus", BEAD_VARIED_MODULUS, "random Young's moduli", "uniform 100 GPa..193 GPa"),
    RANDOM_ROW("gap", BEAD_VARIED_GAP, "random gaps before the beads", "uniform 0..10 um"),
    RANDOM_ROW("spring", BEAD_VARIED_SPRING, "random springs that hold the beads at their places", "uniform 0..300 N/m"),
    {"material", BEAD_OPTION_CUSTOM, .shape = "[MATERIAL, MATERIAL, ...]", .like = "[text]", .read = read_materials,
     .help = "each bead is one of these at random, instead of its own; `3 ptfe` has three chances",
     .example = "[large-steel, 3 ptfe]"},
    {"shuffle", BEAD_OPTION_FLAG, offsetof(struct bead_variation, shuffle), .initial = "false",
     .help = "the beads of each `cell` are in random order, each order as likely as the others: trimers in six ways, where `spins` "
             "has two"},
    {"alike", BEAD_OPTION_COUNT, offsetof(struct bead_variation, alike), .initial = "1", .low = 1, .high = BEAD_SCENE_BEADS,
     .help = "how many beads in a row share each draw: with 2 and two materials, dimers of two equal beads", .example = "2"},
    {"seed", BEAD_OPTION_SEED, offsetof(struct bead_variation, seed), .initial = "0",
     .help = "seed; the same seed gives the same beads on every machine", .example = "7"},
};
const struct bead_options bead_disorder_options = {"chain.beads.disorder", "beads that differ at random, each on its own",
                                                   BEAD_OPTIONS(disorder_rows), NULL, NULL};

/* In (0, 1); `what` and `turn` tell draws of a bead apart. */
static double draw(const struct bead_variation *v, size_t bead, unsigned what, unsigned turn)
{
    return ((double)(bead_draw(v->seed, varied[what].draws, 64 * (uint64_t)bead + turn) >> 11) + 0.5) * 0x1p-53;
}

static double draw_value(const struct bead_variation *v, size_t bead, enum bead_varied what, double value)
{
    const struct bead_distribution *d = &v->random[what];
    double z = 4;
    if (d->kind == BEAD_ALWAYS)
        return value;
    if (d->kind == BEAD_UNIFORM)
        return (d->absolute ? 1 : value) * (d->low + (d->high - d->low) * draw(v, bead, what, 0));
    for (unsigned turn = 0; fabs(z) > 3 && turn < 32; turn++) /* Box and Muller */
        z = sqrt(-2 * bead_log(draw(v, bead, what, 2 * turn))) * bead_sin(6.283185307179586 * draw(v, bead, what, 2 * turn + 1));
    return value * (1 + d->high * (fabs(z) > 3 ? 0 : z));
}

/* ---- beads ---- */

/* A copy of a material with other values. */
static enum bead_error derive(const struct bead_reader *reader, const struct bead_at *at, size_t base,
                              const double value[BEAD_VARIED_COUNT], size_t *made)
{
    struct bead_scene *scene = reader->scene;
    bool same = true;
    for (size_t i = 0; i < BEAD_VARIED_COUNT; i++) {
        same = same && value[i] == *value_of(&scene->materials[base], (enum bead_varied)i);
        if (!(value[i] >= varied[i].low && value[i] <= varied[i].high))
            return bead_wrong(reader, at, "gives a bead a %s of %.3g %s; must be from %g to %g %s", varied[i].key, value[i],
                              varied[i].unit, varied[i].low, varied[i].high, varied[i].unit);
    }
    *made = base;
    if (same)
        return BEAD_OK;
    struct bead_material *grown = realloc(scene->materials, (scene->material_count + 1) * sizeof *grown);
    if (!grown)
        return bead_no_memory(reader);
    scene->materials = grown;
    struct bead_material *material = &grown[scene->material_count];
    *material = grown[base];
    material->name = strdup(grown[base].name);
    material->label = strdup(grown[base].label);
    for (size_t i = 0; i < BEAD_VARIED_COUNT; i++)
        *value_of(material, (enum bead_varied)i) = value[i];
    *made = scene->material_count++;
    return material->name && material->label ? BEAD_OK : bead_no_memory(reader);
}

/* Gives a material's values another radius, at its density. */
static void resize(double value[BEAD_VARIED_COUNT], double radius)
{
    const double factor = radius / value[BEAD_VARIED_RADIUS];
    value[BEAD_VARIED_MASS] *= factor * factor * factor;
    value[BEAD_VARIED_RADIUS] = radius;
}

static void take_values(const struct bead_reader *reader, size_t material, double value[BEAD_VARIED_COUNT])
{
    for (size_t i = 0; i < BEAD_VARIED_COUNT; i++)
        value[i] = *value_of(&reader->scene->materials[material], (enum bead_varied)i);
}

enum bead_error bead_scene_vary_alike(const struct bead_reader *reader, const struct bead_at *at, const struct bead_variation *v,
                                      struct bead_segment *segments, size_t count)
{
    bool any = false;
    for (size_t i = 0; i < BEAD_VARIED_COUNT; i++)
        any = any || !isnan(v->value[i]);
    if (!any)
        return BEAD_OK;
    for (size_t s = 0; s < count; s++) {
        size_t *of = segments[s].each ? segments[s].each : segments[s].cell;
        const size_t beads = segments[s].cell_beads * (segments[s].each ? segments[s].count : 1);
        for (size_t i = 0; i < beads; i++) {
            double value[BEAD_VARIED_COUNT];
            take_values(reader, of[i], value);
            if (!isnan(v->value[BEAD_VARIED_RADIUS]))
                resize(value, v->value[BEAD_VARIED_RADIUS]);
            for (size_t k = BEAD_VARIED_MASS; k < BEAD_VARIED_COUNT; k++)
                value[k] = isnan(v->value[k]) ? value[k] : v->value[k];
            BEAD_TRY(derive(reader, at, of[i], value, &of[i]));
        }
    }
    return BEAD_OK;
}

static double tapered(const struct bead_variation *v, size_t k, size_t beads, double first, double radius)
{
    if (!isnan(v->ratio))
        return radius * bead_pow(v->ratio, (double)k);
    if (isnan(v->ends[1]))
        return radius;
    const double from = isnan(v->ends[0]) ? first : v->ends[0];
    return beads < 2 ? from : from * bead_pow(v->ends[1] / from, (double)k / (double)(beads - 1));
}

static enum bead_error vary_bead(const struct bead_reader *reader, const struct bead_at *at, const struct bead_variation *v,
                                 size_t k, size_t beads, double first, size_t *material)
{
    double value[BEAD_VARIED_COUNT];
    const size_t drawer = k / v->alike;
    if (v->material_count > 0)
        *material = v->materials[bead_draw_below(v->seed, MATERIAL_DRAWS, drawer, v->material_count)];
    take_values(reader, *material, value);
    const double radius = tapered(v, k, beads, first, value[BEAD_VARIED_RADIUS]);
    if (!isnan(v->ratio) && !(radius >= varied[BEAD_VARIED_RADIUS].low && radius <= varied[BEAD_VARIED_RADIUS].high))
        return bead_wrong(reader, at,
                          "taper: each bead is %.3g %% smaller than the one before; bead %zu would have a radius of %.3g m",
                          100 * (1 - v->ratio), k, radius);
    if (radius != value[BEAD_VARIED_RADIUS])
        resize(value, radius);
    const double drawn = draw_value(v, drawer, BEAD_VARIED_RADIUS, radius);
    if (drawn != radius)
        resize(value, drawn);
    for (size_t i = BEAD_VARIED_MASS; i < BEAD_VARIED_COUNT; i++)
        value[i] = draw_value(v, drawer, (enum bead_varied)i, value[i]);
    return derive(reader, at, *material, value, material);
}

/* Makes room for the material of each bead, at first that in the cell. */
static enum bead_error spread(const struct bead_reader *reader, struct bead_segment *segment)
{
    const size_t beads = segment->cell_beads * segment->count;
    if (segment->each)
        return BEAD_OK;
    BEAD_TRY(bead_new(&segment->each, beads, reader->msg, "%zu beads", beads));
    for (size_t i = 0; i < beads; i++)
        segment->each[i] = segment->cell[i % segment->cell_beads];
    return BEAD_OK;
}

/* Puts the beads of each cell of a segment in random order; `k`: the number of its first bead. */
static void shuffle(const struct bead_variation *v, size_t k, struct bead_segment *segment)
{
    for (size_t cell = 0; cell < segment->count; cell++) {
        size_t *of = segment->each + cell * segment->cell_beads;
        for (size_t i = segment->cell_beads; i > 1; i--) {
            const size_t other = bead_draw_below(v->seed, SHUFFLE_DRAWS, k + cell * segment->cell_beads + i, i), keep = of[i - 1];
            of[i - 1] = of[other];
            of[other] = keep;
        }
    }
}

enum bead_error bead_scene_vary_each(const struct bead_reader *reader, const struct bead_at *at, const struct bead_variation *v,
                                     struct bead_segment *segments, size_t count)
{
    bool any = !isnan(v->ratio) || !isnan(v->ends[1]) || v->material_count > 0 || v->shuffle;
    size_t beads = 0, k = 0;
    for (size_t i = 0; i < BEAD_VARIED_COUNT; i++)
        any = any || v->random[i].kind != BEAD_ALWAYS;
    if (!any || count == 0)
        return BEAD_OK;
    for (size_t s = 0; s < count; s++)
        beads += segments[s].cell_beads * segments[s].count;
    if (beads + reader->scene->material_count > MOST_VARIED)
        return bead_wrong(reader, at, "makes %zu beads that differ; a scene may have %d", beads, MOST_VARIED);
    const double first = reader->scene->materials[segments[0].each ? segments[0].each[0] : segments[0].cell[0]].radius;
    for (size_t s = 0; s < count; s++) {
        BEAD_TRY(spread(reader, &segments[s]));
        if (v->shuffle)
            shuffle(v, k, &segments[s]);
        for (size_t i = 0; i < segments[s].cell_beads * segments[s].count; i++)
            BEAD_TRY(vary_bead(reader, at, v, k++, beads, first, &segments[s].each[i]));
    }
    return BEAD_OK;
}
