/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `materials`: what beads and walls are made of. */
#include <math.h>
#include <stdlib.h>

#include "sim/base/assets.h"
#include "sim/base/memory.h"
#include "sim/base/suggest.h"
#include "sim/base/text.h"
#include "sim/scene/scene_private.h"

/* As written; becomes a bead_material. */
struct written {
    char *label;
    double density, mass, modulus, poisson, radius, yield;
    double colour[3];
    double radius_tolerance, modulus_tolerance;
};

static const struct bead_option tolerance_rows[] = {
    {"radius", BEAD_OPTION_NUMBER, offsetof(struct written, radius_tolerance), .unit = "1", .initial = "0", .low = 0, .high = 1,
     .shape = "from 0 to 100 %",
     .help = "standard deviation of the radius of a bead; its mass follows, with the density of the material", .example = "0.1 %"},
    {"modulus", BEAD_OPTION_NUMBER, offsetof(struct written, modulus_tolerance), .unit = "1", .initial = "0", .low = 0, .high = 1,
     .shape = "from 0 to 100 %", .help = "standard deviation of Young's modulus", .example = "2 %"},
};
const struct bead_options bead_tolerance_options = {"materials.NAME.tolerance",
                                                    "how much beads of one material differ, each on its own; a wall counts as one",
                                                    BEAD_OPTIONS(tolerance_rows), NULL, NULL};

static BEAD_OPTION_READER(read_colour);

static const struct bead_option rows[] = {
    {"modulus", BEAD_OPTION_NUMBER, offsetof(struct written, modulus), .unit = "Pa", BEAD_USUAL_MODULUS, .required = true, .low = 1,
     .high = 1e15, .help = "Young's modulus", .example = "193 GPa"},
    {"poisson", BEAD_OPTION_NUMBER, offsetof(struct written, poisson), .required = true, .low = -1, .high = 0.5,
     .open = BEAD_OPEN_LOW, .help = "Poisson's ratio", .example = "0.3"},
    {"radius", BEAD_OPTION_NUMBER, offsetof(struct written, radius), .unit = "m", BEAD_USUAL_RADIUS, .low = 1e-9, .high = 1e3,
     .help = "radius of a bead; walls need none", .example = "4.76 mm"},
    {"mass", BEAD_OPTION_NUMBER, offsetof(struct written, mass), .unit = "kg", .low = 0, .high = 1e9, .open = BEAD_OPEN_LOW,
     .help = "mass of a bead; give this or density; walls need neither", .example = "3.63 g"},
    {"density", BEAD_OPTION_NUMBER, offsetof(struct written, density), .unit = "kg/m3", .low = 0, .high = 1e6,
     .open = BEAD_OPEN_LOW, .usual = {BEAD_LIGHTEST, BEAD_HEAVIEST}, .likely = BEAD_LIKELY("g/cm3"),
     .help = "density, which gives the mass with the radius", .example = "7800 kg/m3"},
    {"yield", BEAD_OPTION_NUMBER, offsetof(struct written, yield), .unit = "Pa", .low = 0, .high = 1e15, .open = BEAD_OPEN_LOW,
     .help = "yield strength: a run says by how much the pressure between beads exceeds it, and warns where they would be plastic",
     .example = "1 GPa"},
    {"colour", BEAD_OPTION_CUSTOM, .initial = "auto", .shape = "\"#rrggbb\"", .like = "text", .read = read_colour,
     .help = "colour in pictures; auto: each of up to five materials has its own, more are alike", .example = "\"#c08040\""},
    {"label", BEAD_OPTION_TEXT, offsetof(struct written, label), .initial = "",
     .help = "what pictures call it; default: its name, as words: large steel. A wall shows the label up to the first comma",
     .example = "\"steel, 4.76 mm\""},
    {"tolerance", BEAD_OPTION_MAP, .map = &bead_tolerance_options,
     .help = "how much beads of it differ from one another, each on its own: tables of peaks of single runs then have a column "
             "`deviation_N`, the standard deviation of each peak that follows, to first order and three digits, or of the larger "
             "of two maxima if either may be the highest (state `rival`); none with damping. For 100 beads this takes as long as "
             "40 runs, for 500 as 150; see materials.NAME.tolerance",
     .example = "{radius: 0.1 %, modulus: 2 %}"},
};

const struct bead_options bead_material_options = {"materials.NAME", "a material of beads and walls, added to the ready ones",
                                                   BEAD_OPTIONS(rows), NULL, NULL};

/* Colours of a scene's materials, which differ in lightness as well as in hue: grey, plum, sand, green, rust. More materials come
 * from a taper or disorder, and all get the first colour. */
static const unsigned long auto_colours[] = {0x9aa4b2, 0x5d5468, 0xd8c7a8, 0x4a8a78, 0x8f4f45};
enum { AUTO_COLOURS = sizeof auto_colours / sizeof *auto_colours };

static void set_colour(struct written *written, unsigned long rgb)
{
    for (int i = 0; i < 3; i++)
        written->colour[i] = (double)(rgb >> (16 - 8 * i) & 255) / 255;
}

static BEAD_OPTION_READER(read_colour)
{
    struct written *written = settings;
    char shown[64];
    const char *text = NULL;
    BEAD_TRY(bead_read_scalar(reader, at, option->shape, &text));
    if (strcmp(text, "auto") == 0) /* read_one has set it */
        return BEAD_OK;
    if (text[0] != '#' || strspn(text + 1, "0123456789abcdefABCDEF") != 6 || text[7])
        return bead_wrong(reader, at, "is %s; must be %s, with two hexadecimal digits each for red, green and blue",
                          bead_node_show(at->node, shown, sizeof shown), option->shape);
    set_colour(written, strtoul(text + 1, NULL, 16));
    return BEAD_OK;
}

static enum bead_error check_mass(const struct bead_reader *reader, const struct bead_at *at, struct written *w)
{
    const bool mass = bead_given(at, "mass"), density = bead_given(at, "density"), radius = bead_given(at, "radius");
    const char *key = mass ? "mass" : density ? "density" : "radius";
    if (mass && density)
        return BEAD_WRONG_KEY(reader, at, "density", "is given beside `mass`; give one of them");
    if (!radius && (mass || density))
        return BEAD_WRONG_KEY(reader, at, key, "needs `radius`, too");
    if (radius && !mass && !density)
        return BEAD_WRONG_KEY(reader, at, key, "needs `mass` or `density`, too");
    if (!radius)
        w->mass = w->radius = NAN;
    else if (density)
        w->mass = w->density * (4.0 / 3) * 3.14159265358979323846 * w->radius * w->radius * w->radius;
    if (!radius && w->radius_tolerance > 0)
        return BEAD_WRONG_KEY(reader, at, "tolerance", "is for the radius, which this material does not have");
    const double volume = (4.0 / 3) * 3.14159265358979323846 * w->radius * w->radius * w->radius;
    if (mass && w->mass > BEAD_HEAVIEST * volume && bead_units_bare(bead_at_key(at, key).node->text))
        bead_doubt(reader, (const struct bead_at[]){bead_at_key(at, key)}, "kg", "g");
    if (radius && !(w->mass >= 1e-30 && w->mass <= 1e15))
        return BEAD_WRONG_KEY(reader, at, key, "gives a mass of %.3g kg; must be from 1e-30 to 1e15 kg", w->mass);
    return BEAD_OK;
}

/* The material of that name, created if it does not exist. */
static struct bead_material *place_material(struct bead_scene *scene, const char *name)
{
    for (size_t i = 0; i < scene->material_count; i++) {
        if (strcmp(scene->materials[i].name, name) == 0) {
            scene->materials[i].own = true;
            return &scene->materials[i];
        }
    }
    struct bead_material *grown = realloc(scene->materials, (scene->material_count + 1) * sizeof *grown);
    if (!grown)
        return NULL;
    scene->materials = grown;
    grown[scene->material_count] = (struct bead_material){.name = strdup(name), .of = scene->material_count};
    return grown[scene->material_count].name ? &grown[scene->material_count++] : NULL;
}

/* Takes the label, or makes one from the name. */
static enum bead_error add_material(struct bead_reader *reader, const char *name, struct written *written)
{
    char *label = *written->label ? strdup(written->label) : bead_words_of(name);
    struct bead_material *material = label ? place_material(reader->scene, name) : NULL;
    if (!material) {
        free(label);
        return bead_no_memory(reader);
    }
    free(material->label);
    material->label = label;
    material->mass = written->mass;
    material->radius = written->radius;
    material->modulus = written->modulus;
    material->poisson = written->poisson;
    material->yield = written->yield;
    material->radius_tolerance = written->radius_tolerance;
    material->modulus_tolerance = written->modulus_tolerance;
    memcpy(material->colour, written->colour, sizeof written->colour);
    return BEAD_OK;
}

/* Reads a material, whose colour is number `number` if none is given. */
static enum bead_error read_one(struct bead_reader *reader, const struct bead_at *at, size_t number)
{
    struct written written = {0};
    set_colour(&written, auto_colours[number]);
    BEAD_TRY(bead_check_text(reader, at, at->key));
    if (!*at->key || strcmp(at->key, "none") == 0 || strcmp(at->key, "rigid") == 0)
        return bead_wrong(reader, at, "cannot be the name of a material; must not be `none` or `rigid`");
    enum bead_error err = bead_options_read(reader, at, &bead_material_options, &written);
    if (!err)
        err = check_mass(reader, at, &written);
    if (err) {
        written.mass = written.radius = 1e-3;
        written.modulus = 1e9;
    }
    enum bead_error added = written.label && (!err || reader->faults) ? add_material(reader, at->key, &written) : BEAD_OK;
    free(written.label); /* added even if wrong, so that beads of it are not reported, too */
    return err ? err : added;
}

BEAD_OPTION_READER(bead_scene_read_materials)
{
    if (at->node->kind != BEAD_NODE_MAP)
        return bead_must_be(reader, at, option->shape);
    enum bead_error err = BEAD_OK, kept = BEAD_OK;
    for (size_t i = 0; bead_reads_on(reader, err, &kept) && i + 1 < at->node->count; i += 2) {
        struct bead_at one = {at, at->node->items[i]->text, 0, at->node->items[i + 1]};
        err = read_one(reader, &one, at->node->count / 2 > AUTO_COLOURS ? 0 : i / 2);
    }
    return kept;
}

enum bead_error bead_scene_add_ready_materials(struct bead_reader *reader)
{
    static const char file[] = "materials.yaml";
    static const struct bead_option option = {"", BEAD_OPTION_NUMBER, .shape = "a map of materials"};
    char path[4096];
    BEAD_FREED char *text = NULL;
    size_t length = 0;
    BEAD_LEFT_TO(bead_yaml_left) struct bead_yaml *yaml = NULL;
    struct bead_yaml *scene_yaml = reader->yaml;
    BEAD_TRY(bead_asset_path(file, path, sizeof path, reader->msg));
    BEAD_TRY(bead_yaml_note_part(scene_yaml, path, reader->msg));
    BEAD_TRY(bead_asset_read(file, &text, &length, reader->msg));
    BEAD_TRY(bead_yaml_parse(path, text, length, &yaml, reader->msg));
    struct bead_at root = {NULL, "", 0, bead_yaml_root(yaml)};
    reader->yaml = yaml; /* messages show its name */
    enum bead_error err = bead_scene_read_materials(reader, &root, &option, NULL);
    reader->yaml = scene_yaml;
    return err;
}

/* For `steel`, "; did you mean `large-steel` or `small-steel`?": names that contain the word, else the nearest. */
static const char *near_materials(const struct bead_scene *scene, const char *name, char *near, size_t size)
{
    struct bead_suggest search;
    size_t used = 0;
    bead_suggest_begin(&search, name);
    for (size_t i = 0; i < scene->material_count; i++) {
        const char *known = scene->materials[i].name;
        bead_suggest_try(&search, known);
        if (scene->materials[i].of == i && strlen(name) > 2 && strcasestr(known, name) && used + strlen(known) + 20 < size)
            used += (size_t)snprintf(near + used, size - used, "%s`%s`", used ? " or " : "; did you mean ", known);
    }
    if (used == 0)
        return bead_suggest_text(&search, near, size);
    snprintf(near + used, size - used, "?");
    return near;
}

static enum bead_error no_material(const struct bead_reader *reader, const struct bead_at *at, const char *name)
{
    char shown[64], near[160];
    near_materials(reader->scene, name, near, sizeof near);
    return bead_wrong(reader, at, "there is no material `%s`%s", bead_text_show(name, shown, sizeof shown),
                      *near ? near : "; it must be a ready one (see --list materials) or one under `materials`");
}

enum bead_error bead_scene_find_material(const struct bead_reader *reader, const struct bead_at *at, bool bead, size_t *index)
{
    const struct bead_scene *scene = reader->scene;
    const char *name = NULL;
    char shown[64];
    size_t i = 0;
    BEAD_TRY(bead_read_scalar(reader, at, "the name of a material", &name));
    while (i < scene->material_count && strcmp(scene->materials[i].name, name) != 0)
        i++;
    if (i == scene->material_count)
        return no_material(reader, at, name);
    if (bead && !isfinite(scene->materials[i].radius))
        return bead_wrong(reader, at, "`%s` has no radius and no mass, so it is for walls only; give it both under `materials`",
                          bead_text_show(name, shown, sizeof shown));
    *index = i;
    return BEAD_OK;
}

BEAD_OPTION_READER(bead_scene_read_material)
{
    return bead_scene_find_material(reader, at, true, (size_t *)(void *)((char *)settings + option->offset));
}
