/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `chain`: what stands in a row, how it is struck, and the forces in it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/law.h"
#include "sim/base/suggest.h"
#include "sim/chain/system.h"
#include "sim/scene/scene_private.h"

#define CHAIN(member) offsetof(struct bead_chain_spec, member)

static enum bead_error read_striker(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                    void *settings)
{
    (void)option;
    return bead_options_read(reader, at, &bead_striker_options, settings);
}

static enum bead_error read_damping(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                    void *settings)
{
    (void)option;
    return bead_options_read(reader, at, &bead_damping_options, settings);
}

static enum bead_error read_wall(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                 void *settings)
{
    struct bead_chain_spec *chain = settings;
    const char *text = NULL;
    enum bead_error err = bead_read_scalar(reader, at, option->shape, &text);
    if (err)
        return err;
    chain->wall = strcmp(text, "none") == 0 ? BEAD_WALL_NONE : strcmp(text, "rigid") == 0 ? BEAD_WALL_RIGID : BEAD_WALL_MATERIAL;
    return chain->wall == BEAD_WALL_MATERIAL ? bead_scene_find_material(reader, at, false, &chain->wall_material) : BEAD_OK;
}

/* The table of a law with settings: a map with the law's name as its first key. NULL: the law is a word alone. */
static const struct bead_options *law_options(const char *name)
{
    const struct bead_options *options;
    for (size_t i = 0; (options = bead_law_family.member(i)) && strcmp(options->name, name) != 0;)
        i++;
    return options;
}

static enum bead_error read_law(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                void *settings)
{
    struct bead_chain_spec *chain = settings;
    struct bead_suggest search;
    char shown[64], near[96];
    bool map = at->node->kind == BEAD_NODE_MAP, word = at->node->kind == BEAD_NODE_SCALAR;
    bead_suggest_begin(&search, word ? at->node->text : map && at->node->count ? at->node->items[0]->text : "");
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
    {.key = "bead",
     .type = BEAD_OPTION_CUSTOM,
     .offset = CHAIN(striker_material),
     .initial = "large-steel",
     .shape = "the name of a material",
     .help = "material of the striker",
     .example = "small-steel",
     .like = "text",
     .read = bead_scene_read_material},
    {.key = "velocity",
     .offset = CHAIN(striker_velocity),
     .unit = "m/s",
     .initial = "0.443 m/s",
     .low = 0,
     .high = 1e4,
     .help = "velocity of the striker when it touches the first bead, at time 0",
     .example = "1 m/s"},
};
const struct bead_options bead_striker_options = {"chain.striker", "the bead that strikes the chain", BEAD_OPTIONS(striker_rows),
                                                  NULL, NULL};

static const struct bead_option damping_rows[] = {
    {.key = "coefficient",
     .offset = CHAIN(damping_coefficient),
     .initial = "0",
     .low = 0,
     .high = 1e12,
     .help =
         "gamma in the force gamma |D|^exponent of each closed contact, where D is the speed of compression; in N (s/m)^exponent",
     .example = "10"},
    {.key = "exponent",
     .offset = CHAIN(damping_exponent),
     .initial = "1.8",
     .low = 0,
     .high = 10,
     .open = BEAD_OPEN_LOW | BEAD_OPEN_HIGH,
     .help = "exponent of the speed of compression; below 1 many more steps are taken for the same accuracy",
     .example = "1"},
};
const struct bead_options bead_damping_options = {"chain.damping", "forces against the relative motion of touching beads",
                                                  BEAD_OPTIONS(damping_rows), NULL, NULL};

#define LAW(member) offsetof(struct bead_law_spec, member)
static const struct bead_option power_rows[] = {
    {.key = "power",
     .offset = LAW(power),
     .required = true,
     .low = 1,
     .high = 10,
     .help = "exponent of the compression",
     .example = "2.5"},
    {.key = "coefficient",
     .offset = LAW(coefficient),
     .required = true,
     .low = 0,
     .high = 1e30,
     .open = BEAD_OPEN_LOW,
     .help = "force of each contact at a compression of 1 m, in N/m^power",
     .example = "1e9"},
};
static const struct bead_option fpu_rows[] = {
    {.key = "fpu-alpha",
     .offset = LAW(alpha),
     .unit = "1/m",
     .required = true,
     .low = -1e12,
     .high = 1e12,
     .help = "alpha in the force k d (1 - alpha d) of each spring",
     .example = "0.25"},
    {.key = "stiffness",
     .offset = LAW(stiffness),
     .unit = "N/m",
     .initial = "1 N/m",
     .low = 0,
     .high = 1e30,
     .open = BEAD_OPEN_LOW,
     .help = "k in that force",
     .example = "1000 N/m"},
};

/* The laws that have settings, by their names (--list laws). */
static const struct bead_options laws[] = {
    {"power", "force = coefficient * compression^power, one-sided", BEAD_OPTIONS(power_rows), NULL, &bead_law_family},
    {"fpu-alpha", "springs of Fermi, Pasta, Ulam and Tsingou, two-sided", BEAD_OPTIONS(fpu_rows), NULL, &bead_law_family},
};

static const struct bead_options *law_at(size_t index)
{
    return index < sizeof laws / sizeof *laws ? &laws[index] : NULL;
}
const struct bead_option_family bead_law_family = {"chain.law", "laws", law_at};

static const struct bead_option chain_rows[] = {
    {.key = "name",
     .type = BEAD_OPTION_TEXT,
     .offset = CHAIN(name),
     .initial = "",
     .help = "name of the chain; required under `chains`",
     .example = "disordered"},
    {.key = "label",
     .type = BEAD_OPTION_TEXT,
     .offset = CHAIN(label),
     .initial = "",
     .help = "a line about the chain, for pictures",
     .example = "half of the dimers reversed at random"},
    {.key = "striker",
     .type = BEAD_OPTION_CUSTOM,
     .initial = "{}",
     .shape = "a map",
     .help = "see chain.striker",
     .example = "{bead: large-steel, velocity: 0.443 m/s}",
     .like = "chain.striker",
     .read = read_striker},
    {.key = "beads",
     .type = BEAD_OPTION_CUSTOM,
     .required = true,
     .shape = "a list such as [{bead: large-steel, count: 50}]",
     .help = "the beads behind the striker, from left to right: see chain.beads",
     .example = "[{cell: [large-steel, aluminium], count: 32}, {bead: small-steel}]",
     .like = "[chain.beads]",
     .read = bead_scene_read_segments},
    {.key = "wall",
     .type = BEAD_OPTION_CUSTOM,
     .initial = "none",
     .shape = "none, rigid or a material",
     .help = "what stands behind the last bead",
     .example = "brass",
     .like = "text",
     .read = read_wall},
    {.key = "law",
     .type = BEAD_OPTION_CUSTOM,
     .initial = "hertz",
     .shape = "hertz, thesis-appendix, {power: P, coefficient: A} or {fpu-alpha: ALPHA, stiffness: K}",
     .help = "the force between two beads",
     .example = "{power: 2.5, coefficient: 1e9}",
     .like = "text|chain.law",
     .read = read_law},
    {.key = "precompression",
     .offset = CHAIN(precompression),
     .unit = "N",
     .initial = "0 N",
     .low = 0,
     .high = 1e12,
     .help = "static force that presses the chain together",
     .example = "10 N"},
    {.key = "tilt",
     .offset = CHAIN(tilt),
     .unit = "rad",
     .initial = "0 deg",
     .low = 0,
     .high = 1.5707963267948966,
     .open = BEAD_OPEN_HIGH,
     .shape = "from 0 to below 90 deg (1.5708 rad)",
     .help = "slope of the chain, with its wall at the lower end",
     .example = "3.5 deg"},
    {.key = "damping",
     .type = BEAD_OPTION_CUSTOM,
     .initial = "{}",
     .shape = "a map",
     .help = "see chain.damping",
     .example = "{coefficient: 10, exponent: 1.8}",
     .like = "chain.damping",
     .read = read_damping},
};
const struct bead_options bead_chain_options = {
    "chain", "a chain of beads; `chains` is a list of chains with a `name` each, run and shown together", BEAD_OPTIONS(chain_rows),
    NULL, NULL};

enum bead_error bead_scene_read_chain(struct bead_reader *reader, const struct bead_at *at, struct bead_chain_spec *chain)
{
    chain->place = at->node->place;
    if (at->node->kind == BEAD_NODE_MAP && bead_node_get(at->node, "equation", NULL))
        return bead_scene_read_equation(reader, at, chain);
    enum bead_error err = bead_options_read(reader, at, &bead_chain_options, chain);
    if (err)
        return err;
    struct bead_at tilt = bead_at_key(at, "tilt");
    if (chain->tilt > 0 && chain->wall == BEAD_WALL_NONE)
        return bead_wrong(reader, &tilt, "needs a wall that holds the lower end: give `wall`");
    return BEAD_OK;
}

unsigned bead_scene_fields(const struct bead_scene *scene)
{
    unsigned fields = BEAD_FIELD_BIT(BEAD_FIELD_COUNT) - 1;
    for (size_t i = 0; i < scene->chain_count; i++)
        fields &= bead_system_fields(&scene->chains[i].equation);
    return fields;
}

bool bead_scene_has_sensors(const struct bead_scene *scene)
{
    for (size_t c = 0; c < scene->chain_count; c++) {
        for (size_t s = 0; s < scene->chains[c].segment_count; s++) {
            if (scene->chains[c].segments[s].sensor)
                return true;
        }
    }
    return false;
}
