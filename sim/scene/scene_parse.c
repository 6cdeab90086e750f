/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes from text to structures: the document with its settings, a user's own files, the tables; and the end of a scene. */
#include "beadreel/law.h"
#include "sim/base/file.h"
#include "sim/base/text.h"

#include <stdlib.h>
#include <unistd.h>

#include "sim/base/fingerprint.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"
#include "sim/kinds/output_kinds.h"
#include "sim/kinds/outputs.h"
#include "sim/scene/scene_internal.h"
#include "sim/scene/scene_private.h"

/* Units, the tree for defaults, and the ready materials. */
static enum bead_error scene_prepare(struct bead_reader *reader)
{
    reader->units = bead_units_create();
    if (!reader->units)
        return bead_no_memory(reader);
    BEAD_TRY(bead_yaml_parse("default", "{}", 2, &reader->scratch, reader->msg));
    return bead_scene_add_ready_materials(reader);
}

/* On success, the scene is the caller's. */
static enum bead_error scene_finish(struct bead_reader *reader, enum bead_error err, struct bead_scene **scene)
{
    bead_units_free(reader->units);
    bead_yaml_free(reader->scratch);
    if (err)
        bead_scene_free(reader->scene);
    else
        *scene = reader->scene;
    return err;
}

/* An empty scene with the tree of its text, or with a copy of another one's. */
static enum bead_error scene_begin(struct bead_reader *reader, const char *name, const char *text, size_t length,
                                   const struct bead_yaml *tree)
{
    reader->scene = calloc(1, sizeof *reader->scene);
    if (!reader->scene || !(reader->scene->file = strdup(name)))
        return bead_fail(reader->msg, BEAD_ERROR_MEMORY, "%s: out of memory", name);
    enum bead_error err = tree ? bead_yaml_duplicate(tree, &reader->scene->tree, reader->msg)
                               : bead_yaml_parse(name, text, length, &reader->scene->tree, reader->msg);
    reader->yaml = reader->scene->tree;
    return err;
}

enum bead_error bead_scene_materials(struct bead_scene **scene, struct bead_message *msg)
{
    struct bead_reader reader = {.tables = &bead_scene_tables, .msg = msg};
    *scene = NULL;
    enum bead_error err = scene_begin(&reader, "materials", "{}", 2, NULL);
    if (!err)
        err = scene_prepare(&reader);
    return scene_finish(&reader, err, scene);
}

/* The text as run: the bytes of the file, or the text with the user's settings. */
static enum bead_error keep_text(const struct bead_reader *reader, const char *text, size_t length, bool changed)
{
    if (changed)
        return bead_yaml_emit(reader->yaml, bead_yaml_root(reader->yaml), &reader->scene->text, reader->msg);
    reader->scene->text = strndup(text, length);
    return reader->scene->text ? BEAD_OK : bead_no_memory(reader);
}

/* A hash of the version, all materials, and the scene's text without keys that do not change results. */
static enum bead_error find_fingerprint(const struct bead_reader *reader)
{
    struct bead_scene *scene = reader->scene;
    uint64_t hash = bead_fingerprint(BEAD_FINGERPRINT_START, BEADREEL_VERSION, sizeof BEADREEL_VERSION);
    for (size_t i = 0; i < scene->material_count; i++) {
        const struct bead_material *m = &scene->materials[i];
        const double numbers[] = {m->mass, m->radius, m->modulus, m->poisson};
        hash = bead_fingerprint(bead_fingerprint(hash, m->name, strlen(m->name)), numbers, sizeof numbers);
    }
    BEAD_TRY(bead_sweep_hash_scene(scene->tree, &hash, reader->msg));
    scene->fingerprint = hash;
    return BEAD_OK;
}

/* Reports all errors at once. */
static enum bead_error read_all(struct bead_reader *reader, const struct bead_at *root)
{
    struct bead_faults faults = {.count = 0}, doubts = {.count = 0};
    reader->faults = &faults;
    reader->doubts = &doubts;
    enum bead_error err = bead_options_read(reader, root, &bead_scene_options, reader->scene);
    reader->faults = reader->doubts = NULL;
    if (!err && doubts.count > 0 && !(reader->scene->doubts = strdup(doubts.lines.text)))
        err = bead_no_memory(reader);
    if (err == BEAD_ERROR_SCENE && faults.count > 0 && reader->msg)
        *reader->msg = faults.lines;
    return err;
}

static enum bead_error read_scene(struct bead_reader *reader, const char *text, size_t length, const char *config, bool changed)
{
    struct bead_at root = {NULL, "", 0, bead_yaml_root(reader->yaml)};
    BEAD_TRY(scene_prepare(reader));
    BEAD_TRY(bead_scene_take_own(reader, config, &changed));
    BEAD_TRY(keep_text(reader, text, length, changed));
    BEAD_TRY(read_all(reader, &root));
    BEAD_TRY(bead_scene_find_words(reader));
    return reader->scene->sweep_count > 0 ? find_fingerprint(reader) : BEAD_OK;
}

static enum bead_error lay(const struct bead_reader *reader, const struct bead_override *override)
{
    const char *naming[BEAD_NAMINGS];
    bead_scene_naming(naming);
    return bead_yaml_lay(reader->yaml, override, naming, reader->msg);
}

static enum bead_error lay_setting(const struct bead_reader *reader, const char *setting, size_t number)
{
    const char *equals = strchr(setting, '=');
    char shown[64];
    if (!equals || equals == setting)
        return bead_fail(reader->msg, BEAD_ERROR_SCENE, "--set:%zu:1: `%s` is not of the form key.path=value", number,
                         bead_text_show(setting, shown, sizeof shown));
    const struct bead_override override = {
        .origin = "--set", .path = setting, .place = {number, (size_t)(equals - setting) + 2}, .value = equals + 1};
    return lay(reader, &override);
}

/* Takes the additions of the program, and checks that laws are complete and have different names. */
static enum bead_error take_own(const struct bead_reader *reader, const struct bead_own *own)
{
    if (!own)
        return BEAD_OK;
    reader->scene->own = *own;
    for (const struct bead_law *const *law = own->laws; law && *law; law++) {
        BEAD_TRY(bead_law_check(*law, reader->msg));
        if (bead_law_find((*law)->name))
            return bead_fail(reader->msg, BEAD_ERROR_USAGE, "law `%s`: the library has one of this name", (*law)->name);
    }
    return bead_output_check_own(own, reader->msg);
}

static enum bead_error make_scene(const char *name, const char *text, size_t length, const struct bead_yaml *tree,
                                  const struct bead_own *own, const struct bead_overrides *overrides, struct bead_scene **scene,
                                  struct bead_message *msg)
{
    const struct bead_overrides none = {.count = 0}, *o = overrides ? overrides : &none;
    struct bead_reader reader = {.tables = &bead_scene_tables, .msg = msg, .shown = o->shown, .shown_count = o->shown_count};
    *scene = NULL;
    enum bead_error err = scene_begin(&reader, name, text, length, tree);
    if (!err)
        err = take_own(&reader, o->own ? o->own : own);
    for (size_t i = 0; i < o->count && !err; i++)
        err = lay(&reader, &o->all[i]);
    for (size_t i = 0; i < o->setting_count && !err; i++)
        err = lay_setting(&reader, o->settings[i], i + 1);
    if (!err)
        err = read_scene(&reader, text, length, o->config, o->count + o->setting_count > 0);
    return scene_finish(&reader, err, scene);
}

enum bead_error bead_scene_parse(const char *name, const char *text, size_t length, const struct bead_overrides *overrides,
                                 struct bead_scene **scene, struct bead_message *msg)
{
    return make_scene(name, text, length, NULL, NULL, overrides, scene, msg);
}

enum bead_error bead_scene_change(const struct bead_scene *before, const struct bead_overrides *overrides,
                                  struct bead_scene **scene, struct bead_message *msg)
{
    return make_scene(before->file, before->text, strlen(before->text), before->tree, &before->own, overrides, scene, msg);
}

/* Results are not scenes, and a parser's message about their bytes would not help. */
static enum bead_error check_ending(const char *path, struct bead_message *msg)
{
    if (bead_output_ends_like(bead_output_endings(BEAD_OUTPUT_TRAJECTORY), path))
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s: not an HDF5 file, or damaged at its beginning", path);
    for (enum bead_output_kind kind = 0; kind < BEAD_OUTPUT_KINDS; kind++) {
        if (bead_output_ends_like(bead_output_endings(kind), path))
            return bead_fail(msg, BEAD_ERROR_SCENE, "%s: is a result, not a scene; if beadreel made it, --reproduce does so again",
                             path);
    }
    return BEAD_OK;
}

enum bead_error bead_scene_load(const char *path, const struct bead_overrides *overrides, struct bead_scene **scene,
                                struct bead_message *msg)
{
    BEAD_FREED char *text = NULL;
    size_t length = 0;
    *scene = NULL;
    if (access(path, R_OK) == 0)
        BEAD_TRY(check_ending(path, msg));
    BEAD_TRY(bead_file_read_input(path, BEAD_YAML_BYTES, &text, &length, msg));
    return bead_scene_parse(overrides && overrides->name ? overrides->name : path, text, length, overrides, scene, msg);
}

static void free_chain(struct bead_chain_spec *chain)
{
    for (size_t i = 0; i < chain->segment_count; i++)
        bead_scene_free_segment(&chain->segments[i]);
    free(chain->segments);
    free(chain->starts);
    free(chain->drive.points);
    free(chain->name);
    free(chain->title);
    free(chain->label);
}

void bead_scene_free(struct bead_scene *scene)
{
    if (!scene)
        return;
    for (size_t i = 0; i < scene->material_count; i++) {
        free(scene->materials[i].name);
        free(scene->materials[i].label);
    }
    for (size_t i = 0; i < scene->chain_count; i++)
        free_chain(&scene->chains[i]);
    bead_scene_free_sweeps(scene);
    for (size_t i = 0; i < scene->output_count; i++)
        bead_output_free(&scene->outputs[i]);
    free(scene->materials);
    free(scene->chains);
    free(scene->outputs);
    free(scene->simulate.method);
    bead_scene_free_fit(&scene->fit);
    free(scene->doubts);
    free(scene->title);
    free(scene->author);
    free(scene->text);
    free(scene->file);
    bead_yaml_free(scene->tree);
    free(scene);
}
