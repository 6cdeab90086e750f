/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `chain`: its beads, its striker, and its forces. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/law.h"
#include "sim/base/suggest.h"
#include "sim/chain/system.h"
#include "sim/scene/scene_private.h"

#define CHAIN(member) offsetof(struct bead_chain_spec, member)

static BEAD_OPTION_READER(read_wall)
{
    struct bead_chain_spec *chain = settings;
    const char *text = NULL;
    BEAD_TRY(bead_read_scalar(reader, at, option->shape, &text));
    chain->wall = strcmp(text, "none") == 0 ? BEAD_WALL_NONE : strcmp(text, "rigid") == 0 ? BEAD_WALL_RIGID : BEAD_WALL_MATERIAL;
    return chain->wall == BEAD_WALL_MATERIAL ? bead_scene_find_material(reader, at, false, &chain->wall_material) : BEAD_OK;
}

/* The table of a law with settings: a map with the law's name as its first key. NULL: the law is a word alone. */
static const struct bead_options *law_options(const char *name)
{
    const struct bead_options *options;
    for (size_t i = 0; (options = bead_law_options(i)) && strcmp(options->name, name) != 0;)
        i++;
    return options;
}

static BEAD_OPTION_READER(read_law)
{
    struct bead_chain_spec *chain = settings;
    struct bead_suggest search;
    char shown[64], near[96];
    bool map = at->node->kind == BEAD_NODE_MAP, word = at->node->kind == BEAD_NODE_SCALAR;
    bead_suggest_begin(&search, word ? at->node->text : map && at->node->count ? at->node->items[0]->text : "");
    for (const struct bead_law *const *own = reader->scene->own.laws; word && own && *own; own++) {
        chain->law.row = *own;
        if (strcmp(at->node->text, (*own)->name) == 0)
            return BEAD_OK;
        bead_suggest_try(&search, (*own)->name);
    }
    for (size_t i = 0; (chain->law.row = bead_law_info(i)); i++) {
        const char *name = chain->law.row->name;
        const struct bead_options *options = law_options(name);
        if (map && options && bead_node_get(at->node, name, NULL))
            return bead_options_read(reader, at, options, &chain->law);
        if (word && !options && strcmp(at->node->text, name) == 0)
            return BEAD_OK;
        bead_suggest_try(&search, name);
    }
    if (search.best && strcmp(search.best, search.word) == 0)
        search.best = NULL; /* the right word, the wrong way */
    return bead_wrong(reader, at, "is %s; must be %s%s", bead_node_show(at->node, shown, sizeof shown), option->shape,
                      bead_suggest_text(&search, near, sizeof near));
}

static const struct bead_option striker_rows[] = {
    {"bead", BEAD_OPTION_CUSTOM, CHAIN(striker_material), .initial = "large-steel", .shape = "the name of a material",
     .like = "text", .read = bead_scene_read_material, .help = "material of the striker", .example = "small-steel"},
    {"velocity", BEAD_OPTION_NUMBER, CHAIN(striker_velocity), .unit = "m/s", .initial = "0.443 m/s", .low = 0, .high = 1e4,
     .help = "velocity of the striker when it touches the first bead, at time 0", .example = "1 m/s"},
};
const struct bead_options bead_striker_options = {"chain.striker", "the bead that strikes the chain", BEAD_OPTIONS(striker_rows),
                                                  NULL, NULL};

static const struct bead_option damping_rows[] = {
    {"coefficient", BEAD_OPTION_NUMBER, CHAIN(damping_coefficient), .initial = "0", .low = 0, .high = 1e12,
     .help =
         "gamma in the force gamma |D|^exponent of each closed contact, where D is the speed of compression; in N (s/m)^exponent",
     .example = "10"},
    {"exponent", BEAD_OPTION_NUMBER, CHAIN(damping_exponent), .initial = "1.8", .low = 0, .high = 10,
     .open = BEAD_OPEN_LOW | BEAD_OPEN_HIGH,
     .help = "exponent of the speed of compression; below 1 many more steps are taken for the same accuracy", .example = "1"},
};
const struct bead_options bead_damping_options = {"chain.damping", "forces against the relative motion of touching beads",
                                                  BEAD_OPTIONS(damping_rows), NULL, NULL};

#define LAW(member) offsetof(struct bead_law_spec, member)
static const struct bead_option power_rows[] = {
    {"power", BEAD_OPTION_NUMBER, LAW(power), .required = true, .low = 1, .high = 10, .help = "exponent of the compression",
     .example = "2.5"},
    {"coefficient", BEAD_OPTION_NUMBER, LAW(coefficient), .required = true, .low = 0, .high = 1e30, .open = BEAD_OPEN_LOW,
     .help = "force of each contact at a compression of 1 m, in N/m^power", .example = "1e9"},
};
static const struct bead_option fpu_rows[] = {
    {"fpu-alpha", BEAD_OPTION_NUMBER, LAW(alpha), .unit = "1/m", .required = true, .low = -1e12, .high = 1e12,
     .help = "alpha in the force k d (1 - alpha d) of each spring", .example = "0.25"},
    {"stiffness", BEAD_OPTION_NUMBER, LAW(stiffness), .unit = "N/m", .initial = "1 N/m", .low = 0, .high = 1e30,
     .open = BEAD_OPEN_LOW, .help = "k in that force", .example = "1000 N/m"},
};

/* The laws that have settings, by their names (--list laws). */
static const struct bead_option_family law_family = {"chain.law", "laws"};
static const struct bead_options laws[] = {
    {"power", "force = coefficient * compression^power, one-sided", BEAD_OPTIONS(power_rows), NULL, &law_family},
    {"fpu-alpha", "springs of Fermi, Pasta, Ulam and Tsingou, two-sided", BEAD_OPTIONS(fpu_rows), NULL, &law_family},
};

const struct bead_options *bead_law_options(size_t index)
{
    return index < sizeof laws / sizeof *laws ? &laws[index] : NULL;
}

static const struct bead_option chain_rows[] = {
    {"name", BEAD_OPTION_TEXT, CHAIN(name), .initial = "", .help = "name of the chain; required under `chains`",
     .example = "disordered"},
    {"label", BEAD_OPTION_TEXT, CHAIN(label), .initial = "", .help = "a line about the chain, for pictures",
     .example = "half of the dimers reversed at random"},
    {"striker", BEAD_OPTION_MAP, .initial = "{}", .map = &bead_striker_options, .help = "see chain.striker",
     .example = "{bead: large-steel, velocity: 0.443 m/s}"},
    {"beads", BEAD_OPTION_CUSTOM, .required = true, .shape = "a list such as [{bead: large-steel, count: 50}]",
     .like = "[chain.beads]", .read = bead_scene_read_segments,
     .help = "the beads behind the striker, from left to right: see chain.beads",
     .example = "[{cell: [large-steel, aluminium], count: 32}, {bead: small-steel}]"},
    {"wall", BEAD_OPTION_CUSTOM, .initial = "none", .shape = "none, rigid or a material", .like = "text", .read = read_wall,
     .help = "the wall behind the last bead", .example = "brass"},
    {"law", BEAD_OPTION_CUSTOM, .initial = "hertz",
     .shape = "hertz, thesis-appendix, {power: P, coefficient: A} or {fpu-alpha: ALPHA, stiffness: K}", .like = "text|chain.law",
     .read = read_law, .help = "the force between two beads", .example = "{power: 2.5, coefficient: 1e9}"},
    {"precompression", BEAD_OPTION_NUMBER, CHAIN(precompression), .unit = "N", .initial = "0 N", .low = 0, .high = 1e12,
     .help = "static force that presses the chain together", .example = "10 N"},
    {"tilt", BEAD_OPTION_NUMBER, CHAIN(tilt), .unit = "rad", .initial = "0 deg", .low = 0, .high = 1.5707963267948966,
     .open = BEAD_OPEN_HIGH, .shape = "from 0 to below 90 deg (1.5708 rad)",
     .help = "slope of the chain, with its wall at the lower end", .example = "3.5 deg"},
    {"damping", BEAD_OPTION_MAP, .initial = "{}", .map = &bead_damping_options, .help = "see chain.damping",
     .example = "{coefficient: 10, exponent: 1.8}"},
};
const struct bead_options bead_chain_options = {
    "chain", "a chain of beads; `chains` is a list of chains with a `name` each, run and shown together", BEAD_OPTIONS(chain_rows),
    NULL, NULL};

enum bead_error bead_scene_make_chains(const struct bead_reader *reader, size_t count)
{
    struct bead_chain_spec *chains = reader->scene->chains = calloc(count, sizeof *chains);
    if (!chains)
        return bead_no_memory(reader);
    reader->scene->chain_count = count;
    for (size_t i = 0; i < count; i++)
        chains[i].system = &bead_system_beads;
    return BEAD_OK;
}

enum bead_error bead_scene_read_chain(struct bead_reader *reader, const struct bead_at *at, struct bead_chain_spec *chain)
{
    chain->node = at->node;
    if (at->node->kind == BEAD_NODE_MAP && bead_node_get(at->node, "equation", NULL))
        return bead_scene_read_equation(reader, at, chain);
    BEAD_TRY(bead_options_read(reader, at, &bead_chain_options, chain));
    if (chain->tilt > 0 && chain->wall == BEAD_WALL_NONE)
        return BEAD_WRONG_KEY(reader, at, "tilt", "needs a wall that holds the lower end: give `wall`");
    return BEAD_OK;
}
