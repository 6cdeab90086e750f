/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes: from text to structures. Every structure has a file of its own, scene_*.c, with its table of keys. */
#include "beadreel/scene.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/fingerprint.h"
#include "sim/scene/scene_output.h"
#include "sim/scene/scene_private.h"
#include "sim/scene/scene_words.h"
#include "sim/scene/sweep_yaml.h"

static enum bead_error read_chain(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                  void *settings);
static enum bead_error read_chains(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                   void *settings);
static enum bead_error read_simulate(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                     void *settings);
static enum bead_error read_outputs(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                    void *settings);

/* In the order of reading: outputs are checked against chains, chains name materials. */
static const struct bead_option rows[] = {
    {.key = "title",
     .type = BEAD_OPTION_TEXT,
     .offset = offsetof(struct bead_scene, title),
     .initial = "",
     .help = "title of the scene",
     .example = "My first wave"},
    {.key = "author",
     .type = BEAD_OPTION_TEXT,
     .offset = offsetof(struct bead_scene, author),
     .initial = "",
     .help = "who made it, for the document information of PDF files",
     .example = "Ada Lovelace"},
    {.key = "materials",
     .type = BEAD_OPTION_CUSTOM,
     .shape = "a map of materials",
     .help = "adds to the ready materials: see materials.NAME",
     .example = "{carbide: {density: 14900 kg/m3, modulus: 668 GPa, poisson: 0.24, radius: 4.76 mm}}",
     .like = "{materials.NAME}",
     .read = bead_scene_read_materials},
    {.key = "chain",
     .type = BEAD_OPTION_CUSTOM,
     .shape = "a map",
     .help = "the chain: see chain",
     .example = "{beads: [{bead: brass, count: 50}]}",
     .like = "chain|chain.equation",
     .read = read_chain},
    {.key = "chains",
     .type = BEAD_OPTION_CUSTOM,
     .shape = "a list of chains, each with a name",
     .help = "several chains, instead of `chain`",
     .example = "[{name: steel, beads: [{bead: large-steel, count: 50}]}, {name: brass, beads: [{bead: brass, count: 50}]}]",
     .like = "[chain|chain.equation]",
     .read = read_chains},
    {.key = "sweep",
     .type = BEAD_OPTION_CUSTOM,
     .shape = "a map",
     .help = "many chains with random spins, instead of one: see sweep",
     .example = "{cells: 64, magnetism: all}",
     .like = "sweep",
     .read = bead_scene_read_sweep},
    {.key = "sweeps",
     .type = BEAD_OPTION_CUSTOM,
     .shape = "a list of sweeps, each with a name",
     .help = "several sweeps, instead of `sweep`",
     .example = "[{name: short, cells: 16}, {name: long, cells: 64}]",
     .like = "[sweep]",
     .read = bead_scene_read_sweeps},
    {.key = "simulate",
     .type = BEAD_OPTION_CUSTOM,
     .initial = "{}",
     .shape = "a map",
     .help = "see simulate",
     .example = "{until: 2 ms, accuracy: 1e-8}",
     .like = "simulate",
     .read = read_simulate},
    {.key = "outputs",
     .type = BEAD_OPTION_CUSTOM,
     .required = true,
     .shape = "a list such as [{image: force.png}]",
     .help = "the files to make, at least one: see outputs",
     .example = "[{image: force.png}, {table: peaks.csv}]",
     .read = read_outputs},
};
const struct bead_options bead_scene_options = {"scene", "keys at the top of the file", BEAD_OPTIONS(rows), NULL, NULL};

static enum bead_error make_chains(const struct bead_reader *reader, size_t count)
{
    reader->scene->chains = calloc(count, sizeof *reader->scene->chains);
    if (!reader->scene->chains)
        return bead_no_memory(reader);
    reader->scene->chain_count = count;
    return BEAD_OK;
}

static enum bead_error read_chain(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                  void *settings)
{
    struct bead_scene *scene = settings;
    (void)option;
    struct bead_at several = bead_at_key(at->up, "chains");
    if (several.node != at->up->node)
        return bead_wrong(reader, at, "is given beside `chains`; give one of them");
    if (bead_sweep_node(at->up->node, 0))
        return BEAD_OK; /* read with the sweep, whose pattern it is */
    enum bead_error err = make_chains(reader, 1);
    return err ? err : bead_scene_read_chain(reader, at, &scene->chains[0]);
}

/* Beads have SI units and equations none: they cannot share the axes of a picture. */
static enum bead_error check_kind(const struct bead_reader *reader, const struct bead_at *at, size_t index)
{
    const struct bead_chain_spec *chains = reader->scene->chains;
    if (!chains[0].equation.name == !chains[index].equation.name)
        return BEAD_OK;
    return bead_wrong(reader, at, "is %s beside %s; all chains of a scene must be one or the other",
                      chains[index].equation.name ? "an equation" : "a chain of beads",
                      chains[index].equation.name ? "chains of beads" : "equations");
}

/* Chains of one scene are told apart by their names. */
static enum bead_error check_name(const struct bead_reader *reader, const struct bead_at *at, size_t index)
{
    const struct bead_chain_spec *chains = reader->scene->chains;
    struct bead_at where = bead_at_key(at, "name");
    if (!*chains[index].name)
        return bead_wrong(reader, &where, "is missing: every chain of a list needs a name");
    for (size_t i = 0; i < index; i++) {
        if (strcmp(chains[i].name, chains[index].name) == 0)
            return bead_wrong(reader, &where, "`%s` is the name of another chain; names must differ", chains[index].name);
    }
    return BEAD_OK;
}

static enum bead_error read_chains(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                   void *settings)
{
    struct bead_scene *scene = settings;
    char shown[64];
    size_t beads = 0, count = at->node->count;
    if (at->node->kind != BEAD_NODE_LIST)
        return bead_wrong(reader, at, "is %s; must be %s", bead_node_show(at->node, shown, sizeof shown), option->shape);
    if (bead_sweep_node(at->up->node, 0))
        return BEAD_OK; /* refused with the sweep */
    if (count == 0 || count > BEAD_SCENE_CHAINS)
        return bead_wrong(reader, at, "has %zu chains; must have from 1 to %d", count, BEAD_SCENE_CHAINS);
    enum bead_error err = make_chains(reader, count), kept = BEAD_OK;
    for (size_t i = 0; bead_reads_on(reader, err, &kept) && i < count; i++) {
        struct bead_at element = {at, NULL, i, at->node->items[i]};
        err = bead_scene_read_chain(reader, &element, &scene->chains[i]);
        if (!err && !kept)
            err = check_name(reader, &element, i);
        if (!err && !kept)
            err = check_kind(reader, &element, i);
        beads += err ? 0 : bead_scene_count_beads(&scene->chains[i]);
        if (!err && beads > BEAD_SCENE_BEADS)
            err = bead_wrong(reader, &element, "makes more than %d beads in all, the most that is allowed", BEAD_SCENE_BEADS);
    }
    return kept;
}

static enum bead_error read_simulate(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                     void *settings)
{
    (void)option, (void)settings;
    return bead_scene_read_simulate(reader, at);
}

/* Without chains, nothing said of outputs would make sense. Where they are wrong, outputs are read as if there were none. */
static enum bead_error read_outputs(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                    void *settings)
{
    struct bead_scene *scene = reader->scene;
    const size_t chains = scene->chain_count;
    (void)option, (void)settings;
    reader->unsound = reader->faults && reader->faults->count > 0;
    if (reader->unsound && bead_sweep_node(at->up->node, 0))
        return BEAD_OK; /* they would show what is wrong */
    if (chains == 0 && !reader->unsound)
        return bead_wrong(reader, at->up, "`chain` is missing: %s", bead_chain_options.help);
    scene->chain_count = reader->unsound ? 0 : chains;
    enum bead_error err = bead_scene_read_outputs(reader, at);
    scene->chain_count = chains;
    return err;
}

/* What every reader needs, and the ready materials. */
static enum bead_error scene_prepare(struct bead_reader *reader)
{
    reader->units = bead_units_create();
    if (!reader->units)
        return bead_no_memory(reader);
    enum bead_error err = bead_yaml_parse("default", "{}", 2, &reader->scratch, reader->msg);
    return err ? err : bead_scene_add_ready_materials(reader);
}

static void scene_finish(struct bead_reader *reader)
{
    bead_units_free(reader->units);
    bead_yaml_free(reader->scratch);
    bead_yaml_free(reader->yaml);
}

enum bead_error bead_scene_materials(struct bead_scene **scene, struct bead_message *msg)
{
    struct bead_reader reader = {.msg = msg};
    *scene = NULL;
    enum bead_error err = bead_yaml_parse("materials", "{}", 2, &reader.yaml, msg);
    if (!err && !(reader.scene = calloc(1, sizeof *reader.scene)))
        err = bead_no_memory(&reader);
    if (!err)
        err = scene_prepare(&reader);
    if (err)
        bead_scene_free(reader.scene);
    else
        *scene = reader.scene;
    scene_finish(&reader);
    return err;
}

/* The text as run: the very bytes, or what the settings made of them. */
static enum bead_error keep_text(const struct bead_reader *reader, const char *text, size_t length, bool changed)
{
    if (changed)
        return bead_yaml_emit(reader->yaml, &reader->scene->text, reader->msg);
    reader->scene->text = strndup(text, length);
    return reader->scene->text ? BEAD_OK : bead_no_memory(reader);
}

/* Of the program, the ready materials and those of the scene, and its text but for what changes no result. */
static enum bead_error find_fingerprint(const struct bead_reader *reader)
{
    struct bead_scene *scene = reader->scene;
    uint64_t hash = bead_fingerprint(BEAD_FINGERPRINT_START, BEADREEL_VERSION, sizeof BEADREEL_VERSION);
    for (size_t i = 0; i < scene->material_count; i++) {
        const struct bead_material *m = &scene->materials[i];
        const double numbers[] = {m->mass, m->radius, m->modulus, m->poisson};
        hash = bead_fingerprint(bead_fingerprint(hash, m->name, strlen(m->name)), numbers, sizeof numbers);
    }
    enum bead_error err = bead_sweep_hash_scene(scene->text, &hash, reader->msg);
    scene->fingerprint = hash;
    return err;
}

/* An energy budget is one that closes to this part of the input; where the scene does not say how exactly to compute, it sees to
 * that. */
static const double accuracy_of_budgets = 1e-10;

static void tighten_accuracy(struct bead_scene *scene, const struct bead_at *root)
{
    struct bead_at simulate = bead_at_key(root, "simulate"), given = bead_at_key(&simulate, "accuracy");
    bool budget = false;
    for (size_t i = 0; i < scene->output_count; i++)
        budget = budget || (scene->outputs[i].kind == BEAD_OUTPUT_TABLE && scene->outputs[i].curves.show == BEAD_SHOW_ENERGY);
    if (budget && given.node == simulate.node)
        scene->simulate.accuracy = accuracy_of_budgets;
}

/* All that is wrong is told at once. */
static enum bead_error read_all(struct bead_reader *reader, const struct bead_at *root)
{
    struct bead_faults faults = {.count = 0};
    reader->faults = &faults;
    enum bead_error err = bead_options_read(reader, root, &bead_scene_options, reader->scene);
    reader->faults = NULL;
    if (err == BEAD_ERROR_SCENE && faults.count > 0 && reader->msg)
        *reader->msg = faults.lines;
    return err;
}

static enum bead_error read_scene(struct bead_reader *reader, const char *text, size_t length, const char *config, bool changed)
{
    const char *name = bead_yaml_name(reader->yaml, NULL);
    struct bead_at root = {NULL, "", 0, bead_yaml_root(reader->yaml)};
    reader->scene = calloc(1, sizeof *reader->scene);
    if (!reader->scene || !(reader->scene->file = strdup(name)))
        return bead_no_memory(reader);
    enum bead_error err = scene_prepare(reader);
    if (!err)
        err = bead_scene_take_own(reader, config, &changed);
    if (!err)
        err = keep_text(reader, text, length, changed);
    if (!err)
        err = read_all(reader, &root);
    if (!err)
        tighten_accuracy(reader->scene, &root);
    if (!err)
        err = bead_scene_find_words(reader);
    return err || reader->scene->sweep_count == 0 ? err : find_fingerprint(reader);
}

static const char config_option[] = "--config=";

/* The user's own settings are not one of the scene's, and are taken when these are known; NULL: there are none. */
static const char *find_config(const char *const *settings, size_t *count)
{
    const char *config = NULL;
    for (size_t i = 0, all = *count; i < all; i++) {
        if (strncmp(settings[i], config_option, sizeof config_option - 1) != 0)
            continue;
        config = settings[i] + sizeof config_option - 1;
        *count -= 1;
    }
    return config;
}

/* Elements of lists are called by their `name` or `sensor`, outputs by their file. */
static enum bead_error apply_settings(const struct bead_reader *reader, const char *const *settings, size_t count)
{
    const char *naming[BEAD_OUTPUT_KINDS + 3] = {"name", "sensor"};
    for (enum bead_output_kind kind = 0; kind < BEAD_OUTPUT_KINDS; kind++)
        naming[2 + kind] = bead_output_key(kind);
    enum bead_error err = BEAD_OK;
    size_t number = 0; /* of those of --set */
    for (size_t i = 0; i < count && !err; i++) {
        number += strncmp(settings[i], "--", 2) != 0;
        if (strncmp(settings[i], config_option, sizeof config_option - 1) != 0)
            err = bead_yaml_set(reader->yaml, settings[i], number, naming, reader->msg);
    }
    return err;
}

enum bead_error bead_scene_parse(const char *name, const char *text, size_t length, const char *const *settings,
                                 size_t setting_count, struct bead_scene **scene, struct bead_message *msg)
{
    struct bead_reader reader = {.msg = msg};
    size_t given = setting_count;
    const char *config = find_config(settings, &given);
    *scene = NULL;
    enum bead_error err = bead_yaml_parse(name, text, length, &reader.yaml, msg);
    if (!err)
        err = apply_settings(&reader, settings, setting_count);
    if (!err)
        err = read_scene(&reader, text, length, config, given > 0);
    if (err)
        bead_scene_free(reader.scene);
    else
        *scene = reader.scene;
    scene_finish(&reader);
    return err;
}

enum bead_error bead_scene_load(const char *path, const char *const *settings, size_t setting_count, struct bead_scene **scene,
                                struct bead_message *msg)
{
    char *text = NULL;
    size_t length = 0;
    *scene = NULL;
    enum bead_error err = bead_text_read(path, &text, &length, msg);
    if (!err)
        err = bead_scene_parse(path, text, length, settings, setting_count, scene, msg);
    free(text);
    return err;
}

static void free_chain(struct bead_chain_spec *chain)
{
    for (size_t i = 0; i < chain->segment_count; i++) {
        free(chain->segments[i].cell);
        free(chain->segments[i].each);
        free(chain->segments[i].digits);
        free(chain->segments[i].sensor);
    }
    free(chain->segments);
    free(chain->equation.name);
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
    free(scene->title);
    free(scene->author);
    free(scene->text);
    free(scene->file);
    free(scene);
}
