/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The keys at the top of a scene. Every structure has a file of its own, scene_*.c, with its table of keys. */

#include <math.h>

#include "sim/kinds/outputs.h"
#include "sim/scene/scene_internal.h"
#include "sim/scene/scene_private.h"

static BEAD_OPTION_READER(read_chain);
static BEAD_OPTION_READER(read_chains);
static BEAD_OPTION_READER(read_simulate);
static BEAD_OPTION_READER(read_outputs);

/* Read in this order: chains name materials, and outputs are checked against chains. */
static const struct bead_option rows[] = {
    {"title", BEAD_OPTION_TEXT, offsetof(struct bead_scene, title), .initial = "", .help = "title of the scene",
     .example = "My first wave"},
    {"author", BEAD_OPTION_TEXT, offsetof(struct bead_scene, author), .initial = "",
     .help = "who made it, for the document information of PDF files, and for trajectories", .example = "Ada Lovelace"},
    {"materials", BEAD_OPTION_CUSTOM, .shape = "a map of materials", .like = "{materials.NAME}", .read = bead_scene_read_materials,
     .help = "adds to the ready materials: see materials.NAME",
     .example = "{carbide: {density: 14900 kg/m3, modulus: 668 GPa, poisson: 0.24, radius: 4.76 mm}}"},
    {"chain", BEAD_OPTION_CUSTOM, .shape = "a map", .like = "chain|chain.equation", .read = read_chain,
     .help = "the chain: see chain", .example = "{beads: [{bead: brass, count: 50}]}"},
    {"chains", BEAD_OPTION_CUSTOM, .shape = "a list of chains, each with a name", .like = "[chain|chain.equation]",
     .read = read_chains, .help = "several chains, instead of `chain`",
     .example = "[{name: steel, beads: [{bead: large-steel, count: 50}]}, {name: brass, beads: [{bead: brass, count: 50}]}]"},
    {"sweep", BEAD_OPTION_CUSTOM, .shape = "a map", .like = "sweep", .read = bead_scene_read_sweep,
     .help = "many chains with random spins, instead of one: see sweep", .example = "{cells: 64, magnetism: all}"},
    {"sweeps", BEAD_OPTION_CUSTOM, .shape = "a list of sweeps, each with a name", .like = "[sweep]", .read = bead_scene_read_sweeps,
     .help = "several sweeps, instead of `sweep`", .example = "[{name: short, cells: 16}, {name: long, cells: 64}]"},
    {"simulate", BEAD_OPTION_CUSTOM, .initial = "{}", .shape = "a map", .like = "simulate", .read = read_simulate,
     .help = "see simulate", .example = "{until: 2 ms, accuracy: 1e-8}"},
    {"outputs", BEAD_OPTION_CUSTOM, .required = true, .shape = "a list such as [{image: force.png}]", .read = read_outputs,
     .help = "the files to make, at least one: see outputs", .example = "[{image: force.png}, {table: peaks.csv}]"},
    {"fit", BEAD_OPTION_CUSTOM, .shape = "a list of keys of the scene", .like = "[text]", .read = bead_scene_read_fit,
     .help = "keys whose values are fitted by least squares, starting from those given, so that the first chain runs as measured "
             "in the first plot with `measured`, before anything else is made; `table: FILE, show: fit` lists them with standard "
             "errors, which assume that the errors of measured values are random, independent and equally large",
     .example = "[chain.striker.velocity]"},
};
const struct bead_options bead_scene_options = {"scene", "keys at the top of the file", BEAD_OPTIONS(rows), NULL, NULL};

static BEAD_OPTION_READER(read_chain)
{
    struct bead_scene *scene = settings;
    BEAD_TRY(bead_not_beside(reader, at, "chains"));
    if (bead_sweep_node(at->up->node, 0))
        return BEAD_OK; /* the pattern of the sweep, and read with it */
    BEAD_TRY(bead_scene_make_chains(reader, 1));
    return bead_scene_read_chain(reader, at, &scene->chains[0]);
}

/* Beads have SI units, equations have none: they cannot share the axes of a picture. */
static enum bead_error check_kind(const struct bead_reader *reader, const struct bead_at *at, size_t index)
{
    const struct bead_chain_spec *chains = reader->scene->chains;
    const bool beads = !chains[index].system->equation;
    if (beads == !chains[0].system->equation)
        return BEAD_OK;
    return bead_wrong(reader, at, "is %s beside %s; all chains of a scene must be one or the other",
                      beads ? "a chain of beads" : "an equation", beads ? "equations" : "chains of beads");
}

/* Chains of one scene must have different names. */
static enum bead_error check_name(const struct bead_reader *reader, const struct bead_at *at, size_t index)
{
    const struct bead_chain_spec *chains = reader->scene->chains;
    if (!*chains[index].name)
        return BEAD_WRONG_KEY(reader, at, "name", "is missing: every chain of a list needs a name");
    for (size_t i = 0; i < index; i++) {
        if (strcmp(chains[i].name, chains[index].name) == 0)
            return BEAD_WRONG_KEY(reader, at, "name", "`%s` is the name of another chain; names must differ", chains[index].name);
    }
    return BEAD_OK;
}

static BEAD_OPTION_READER(read_chains)
{
    struct bead_scene *scene = settings;
    size_t beads = 0, count = at->node->count;
    if (at->node->kind == BEAD_NODE_LIST && bead_sweep_node(at->up->node, 0))
        return BEAD_OK; /* refused with the sweep */
    BEAD_TRY(bead_need_list(reader, at, option->shape, BEAD_SCENE_CHAINS, "chains"));
    enum bead_error err = bead_scene_make_chains(reader, count), kept = BEAD_OK;
    for (size_t i = 0; bead_reads_on(reader, err, &kept) && i < count; i++) {
        struct bead_at element = bead_at_item(at, i);
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

static BEAD_OPTION_READER(read_simulate)
{
    const struct bead_scene *scene = reader->scene;
    reader->without_units = !*bead_scene_system(scene)->time_unit;
    BEAD_TRY(bead_scene_read_simulate(reader, at));
    for (size_t i = 0; i < scene->chain_count && isnan(scene->simulate.until); i++) {
        if (scene->chains[i].start_count > 0)
            return BEAD_WRONG_KEY(reader, at, "until",
                                  "is missing: where `start` says what moves, no front says when the run is over");
        if (scene->chains[i].drive.amplitude > 0)
            return BEAD_WRONG_KEY(reader, at, "until", "is missing: a driven chain moves for ever");
        if (bead_scene_has_springs(scene, &scene->chains[i]))
            return BEAD_WRONG_KEY(reader, at, "until", "is missing: a chain held by springs, or a cradle, swings for ever");
    }
    return BEAD_OK;
}

/* Outputs are checked against chains. If the chains are wrong, they are read as if there were no chains; if they show several runs,
 * as if the scene had all their chains. */
static BEAD_OPTION_READER(read_outputs)
{
    struct bead_scene *scene = reader->scene;
    struct bead_chain_spec *own = scene->chains;
    const size_t chains = scene->chain_count;
    reader->unsound = reader->faults && reader->faults->count > 0;
    if (reader->unsound && bead_sweep_node(at->up->node, 0))
        return BEAD_OK; /* they would show what is wrong */
    if (chains == 0 && !reader->unsound)
        return bead_wrong(reader, at->up, "`chain` is missing: %s", bead_chain_options.help);
    scene->chains = reader->shown ? reader->shown : own;
    scene->chain_count = reader->unsound ? 0 : reader->shown ? reader->shown_count : chains;
    reader->without_units = !*bead_scene_system(scene)->time_unit;
    enum bead_error err = bead_scene_read_outputs(reader, at);
    scene->chains = own;
    scene->chain_count = chains;
    return err;
}
