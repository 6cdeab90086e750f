/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `chain`: its beads, its striker, and its forces. */
#include <math.h>
#include <stdlib.h>

#include "beadreel/law.h"
#include "sim/base/memory.h"
#include "sim/base/suggest.h"
#include "sim/chain/chain_internal.h"
#include "sim/scene/scene_private.h"

#define CHAIN(member) offsetof(struct bead_chain_spec, member)

static const struct bead_option wall_rows[] = {
    {"absorbing", BEAD_OPTION_NUMBER, CHAIN(impedance), .unit = "kg/s", .required = true, .low = 0, .high = 1e12,
     .help = "impedance Z of a dashpot instead of a wall: it holds the last bead with Z times its velocity. Of the energy of long "
             "waves in a chain of impedance Z0 it reflects ((Z - Z0) / (Z + Z0))^2. `wall: absorbing` takes Z0",
     .example = "20 kg/s"},
};
const struct bead_options bead_wall_options = {"chain.wall", "an absorbing end of a given impedance", BEAD_OPTIONS(wall_rows), NULL,
                                               NULL};

static BEAD_OPTION_READER(read_wall)
{
    struct bead_chain_spec *chain = settings;
    const char *text = NULL;
    chain->wall = BEAD_WALL_NONE;
    chain->impedance = NAN;
    chain->absorbs = at->node->kind == BEAD_NODE_MAP;
    if (chain->absorbs)
        return bead_options_read(reader, at, &bead_wall_options, chain);
    BEAD_TRY(bead_read_scalar(reader, at, option->shape, &text));
    chain->absorbs = strcmp(text, "absorbing") == 0;
    if (chain->absorbs)
        return BEAD_OK;
    chain->impedance = 0;
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
        search.best = NULL; /* the right word, written the wrong way */
    return bead_wrong(reader, at, "is %s; must be %s%s", bead_node_show(at->node, shown, sizeof shown), option->shape,
                      bead_suggest_text(&search, near, sizeof near));
}

/* As written. */
struct striker {
    size_t material;
    double velocity;
    struct bead_variation variation;
};
#define STRIKER(member) offsetof(struct striker, member)
#define VARIED(...)     BEAD_VARIED_ROW(STRIKER(variation), __VA_ARGS__)

static const struct bead_option striker_rows[] = {
    {"bead", BEAD_OPTION_CUSTOM, STRIKER(material), .initial = "large-steel", .shape = "the name of a material", .like = "text",
     .read = bead_scene_read_material, .help = "material of the striker", .example = "small-steel"},
    {"velocity", BEAD_OPTION_NUMBER, STRIKER(velocity), .unit = "m/s", .initial = "0.443 m/s", .low = 0, .high = 1e4,
     .help = "velocity of the striker when it touches the first bead, at time 0; where `start` says what moves, 0 if not given",
     .example = "1 m/s"},
    VARIED(BEAD_VARIED_RADIUS, "radius", "m", 1e-9, 1e3, 0, "its radius, instead of that of the material", "3 mm",
           BEAD_USUAL_RADIUS),
    VARIED(BEAD_VARIED_MASS, "mass", "kg", 0, 1e9, BEAD_OPEN_LOW, "its mass, instead of that of the material", "2 g"),
    VARIED(BEAD_VARIED_MODULUS, "modulus", "Pa", 1, 1e15, 0, "its Young's modulus, instead of that of the material", "70 GPa",
           BEAD_USUAL_MODULUS),
    VARIED(BEAD_VARIED_SPRING, "spring", "N/m", 0, 1e30, 0, "stiffness of a spring that holds it where it touches the first bead",
           "300 N/m"),
};
const struct bead_options bead_striker_options = {"chain.striker", "the bead that strikes the chain", BEAD_OPTIONS(striker_rows),
                                                  NULL, NULL};

static BEAD_OPTION_READER(read_striker)
{
    struct bead_chain_spec *chain = settings;
    struct striker striker = {.variation = bead_variation_none};
    struct bead_segment segment = {.cell = &chain->striker_material, .cell_beads = 1, .count = 1};
    enum bead_error err = bead_options_read(reader, at, &bead_striker_options, &striker);
    chain->striker_material = striker.material;
    chain->striker_velocity = striker.velocity;
    return err ? err : bead_scene_vary_alike(reader, at, &striker.variation, &segment, 1);
}

/* ---- what starts otherwise than at rest ---- */

/* An entry, as written. */
struct starting {
    size_t beads[2];
    double velocity, displacement;
    const struct bead_chain_spec *chain;
};
#define STARTING(member) offsetof(struct starting, member)

static BEAD_OPTION_READER(read_starting_beads)
{
    struct starting *starting = settings;
    const size_t beads = bead_scene_count_beads(starting->chain); /* 0: they are wrong, and reported */
    const double last = beads > 0 ? (double)beads : BEAD_SCENE_BEADS;
    const struct bead_option bead = {.type = BEAD_OPTION_COUNT, .low = 0, .high = last, .word = "last", .word_value = last};
    if (at->node->kind == BEAD_NODE_MAP || (at->node->kind == BEAD_NODE_LIST && at->node->count != 2))
        return bead_must_be(reader, at, option->shape);
    for (size_t i = 0; i < 2; i++) {
        const struct bead_at end = at->node->kind == BEAD_NODE_LIST ? bead_at_item(at, i) : *at;
        BEAD_TRY(bead_read_count(reader, &end, &bead, &starting->beads[i]));
    }
    return starting->beads[0] > starting->beads[1]
               ? bead_wrong(reader, at, "is [%zu, %zu]; the first must not be greater than the last", starting->beads[0],
                            starting->beads[1])
               : BEAD_OK;
}

static const struct bead_option starting_rows[] = {
    {"bead", BEAD_OPTION_CUSTOM, .required = true, .shape = "a number, last, or [first, last]; 0 is the striker",
     .like = "number|last|[2 number|last]", .read = read_starting_beads, .help = "which bead, or which beads", .example = "last"},
    {"velocity", BEAD_OPTION_NUMBER, STARTING(velocity), .unit = "m/s", .initial = "0 m/s", .low = -1e4, .high = 1e4,
     .help = "velocity at time 0; negative: away from the wall, to the left", .example = "-0.443 m/s"},
    {"displacement", BEAD_OPTION_NUMBER, STARTING(displacement), .unit = "m", .initial = "0 m", .low = -1e3, .high = 1e3,
     .help = "displacement at time 0; positive: to the right", .example = "2 um"},
};
const struct bead_options bead_starting_options = {
    "chain.starts", "entries of `start`: beads that move, or are displaced, at time 0", BEAD_OPTIONS(starting_rows), NULL, NULL};

/* Beads that do not start at rest. */
enum { MOST_STARTS = 100000 };

static int by_bead(const void *a, const void *b)
{
    const struct bead_start *p = a, *q = b;
    return (p->bead > q->bead) - (p->bead < q->bead);
}

static enum bead_error add_starts(const struct bead_reader *reader, const struct bead_at *at, const struct starting *from,
                                  struct bead_chain_spec *chain)
{
    const size_t count = from->beads[1] - from->beads[0] + 1;
    if (count + chain->start_count > MOST_STARTS)
        return bead_wrong(reader, at, "is given for more than %d beads, the most that is allowed", MOST_STARTS);
    struct bead_start *grown = realloc(chain->starts, (chain->start_count + count) * sizeof *grown);
    if (!grown)
        return bead_no_memory(reader);
    chain->starts = grown;
    for (size_t i = 0; i < count; i++)
        grown[chain->start_count++] = (struct bead_start){from->beads[0] + i, from->velocity, from->displacement};
    return BEAD_OK;
}

/* The striker's velocity is stored once: an entry for bead 0 gives it. */
static enum bead_error settle_starts(const struct bead_reader *reader, const struct bead_at *at, struct bead_chain_spec *chain)
{
    const struct bead_at map = *at->up, striker = bead_at_key(&map, "striker");
    const bool given = bead_given(&map, "striker") && bead_given(&striker, "velocity");
    qsort(chain->starts, chain->start_count, sizeof *chain->starts, by_bead);
    for (size_t i = 1; i < chain->start_count; i++) {
        if (chain->starts[i].bead == chain->starts[i - 1].bead)
            return bead_wrong(reader, at, "has bead %zu twice", chain->starts[i].bead);
    }
    chain->striker_velocity = given ? chain->striker_velocity : 0;
    if (chain->starts[0].bead > 0)
        return BEAD_OK;
    if (given && chain->starts[0].velocity != 0)
        return bead_wrong(reader, at, "gives the velocity of bead 0, the striker, as does `striker`; give one of them");
    chain->striker_velocity = given ? chain->striker_velocity : chain->starts[0].velocity;
    chain->starts[0].velocity = 0;
    return BEAD_OK;
}

static BEAD_OPTION_READER(read_starts)
{
    struct bead_chain_spec *chain = settings;
    BEAD_TRY(bead_need_list(reader, at, option->shape, MOST_STARTS, "entries"));
    for (size_t i = 0; i < at->node->count; i++) {
        const struct bead_at entry = bead_at_item(at, i);
        struct starting starting = {.chain = chain};
        BEAD_TRY(bead_options_read(reader, &entry, &bead_starting_options, &starting));
        BEAD_TRY(add_starts(reader, &entry, &starting, chain));
    }
    return settle_starts(reader, at, chain);
}

static const struct bead_option damping_rows[] = {
    {"coefficient", BEAD_OPTION_NUMBER, CHAIN(damping_coefficient), .initial = "0", .low = 0, .high = 1e12,
     .help =
         "gamma in the force gamma |D|^exponent of each closed contact, where D is the speed of compression; in N (s/m)^exponent, "
         "over m^compression",
     .example = "10"},
    {"exponent", BEAD_OPTION_NUMBER, CHAIN(damping_exponent), .initial = "1.8", .low = 0, .high = 10,
     .open = BEAD_OPEN_LOW | BEAD_OPEN_HIGH,
     .help = "exponent of the speed of compression; below 1 steps are shorter wherever a contact turns", .example = "1"},
    {"compression", BEAD_OPTION_NUMBER, CHAIN(damping_compression), .initial = "0", .low = 0, .high = 10,
     .help = "exponent c of the compression d by which the force is multiplied: gamma d^c |D|^exponent. 0.5 with exponent 1 is the "
             "viscoelastic contact of Kuwabara and Kono (1987)",
     .example = "0.5"},
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

static const struct bead_option cradle_rows[] = {
    {"length", BEAD_OPTION_NUMBER, CHAIN(cradle), .unit = "m", .required = true, .low = 0, .high = 1e6, .open = BEAD_OPEN_LOW,
     .help = "length L of the pendulums: gravity pulls a bead of mass m back by m g / L times its displacement, which holds for "
             "small angles",
     .example = "20 cm"},
};
const struct bead_options bead_cradle_options = {"chain.cradle", "all beads, and the striker, hang as pendulums: Newton's cradle",
                                                 BEAD_OPTIONS(cradle_rows), NULL, NULL};

static const struct bead_option chain_rows[] = {
    {"name", BEAD_OPTION_TEXT, CHAIN(name), .initial = "", .help = "name of the chain; required under `chains`",
     .example = "disordered"},
    {"label", BEAD_OPTION_TEXT, CHAIN(label), .initial = "", .help = "a line about the chain, for pictures",
     .example = "half of the dimers reversed at random"},
    {"striker", BEAD_OPTION_CUSTOM, .initial = "{}", .shape = "a map", .like = "chain.striker", .read = read_striker,
     .help = "see chain.striker", .example = "{bead: large-steel, velocity: 0.443 m/s}"},
    {"beads", BEAD_OPTION_CUSTOM, .required = true, .shape = "a list such as [{bead: large-steel, count: 50}]",
     .like = "[chain.beads]", .read = bead_scene_read_segments,
     .help = "the beads behind the striker, from left to right: see chain.beads",
     .example = "[{cell: [large-steel, aluminium], count: 32}, {bead: small-steel}]"},
    {"start", BEAD_OPTION_CUSTOM, .shape = "a list such as [{bead: last, velocity: -0.443 m/s}]", .like = "[chain.starts]",
     .read = read_starts,
     .help = "beads that do not start at rest, so that there are several strikers, or strikes from both sides; needs "
             "simulate.until: see chain.starts",
     .example = "[{bead: 0, velocity: 1 m/s}, {bead: last, velocity: -1 m/s}]"},
    {"drive", BEAD_OPTION_CUSTOM, .shape = "a map such as {force: sine, amplitude: 1 N, frequency: 5 kHz}", .like = "chain.drive",
     .read = bead_scene_read_drive,
     .help = "a bead that is driven; unless the striker has a velocity, nothing else moves at first; needs simulate.until: see "
             "chain.drive",
     .example = "{bead: 0, displacement: sine, amplitude: 0.1 um, frequency: 5 kHz, ramp: 1 ms}"},
    {"wall", BEAD_OPTION_CUSTOM, .initial = "none", .shape = "none, rigid, absorbing or a material", .like = "text|chain.wall",
     .read = read_wall,
     .help = "the wall behind the last bead; absorbing: a dashpot with the impedance of the chain, sqrt(k m), through which long "
             "waves leave; without precompression it reflects 3 % of their energy: see `reflected energy` in --list measures",
     .example = "brass"},
    {"law", BEAD_OPTION_CUSTOM, .initial = "hertz",
     .shape = "a law of --list laws: its name, or a map of its settings such as {power: 2.5, coefficient: 1e9}",
     .like = "text|chain.law", .read = read_law, .help = "the force between two beads",
     .example = "{power: 2.5, coefficient: 1e9}"},
    {"precompression", BEAD_OPTION_NUMBER, CHAIN(precompression), .unit = "N", .initial = "0 N", .low = 0, .high = 1e12,
     .help = "static force that presses the chain together", .example = "10 N"},
    {"gap", BEAD_OPTION_NUMBER, CHAIN(gap), .unit = "m", .initial = "0 m", .low = 0, .high = 1e3,
     .help = "free space between every two beads, to which the gaps of single ones in chain.beads add, and random ones in "
             "chain.beads.disorder; the striker touches the first at time 0",
     .example = "10 um"},
    {"tilt", BEAD_OPTION_NUMBER, CHAIN(tilt), .unit = "rad", .usual = {0, 0.785}, .likely = BEAD_LIKELY("deg"), .initial = "0 deg",
     .low = 0, .high = 1.5707963267948968, .shape = "from 0 to 90 deg (1.5708 rad)",
     .help = "slope of the chain, with its wall at the lower end; 90 deg: it stands on the wall", .example = "3.5 deg"},
    {"cradle", BEAD_OPTION_MAP, .map = &bead_cradle_options, .help = "beads that hang; needs simulate.until: see chain.cradle",
     .example = "{length: 20 cm}"},
    {"damping", BEAD_OPTION_MAP, .initial = "{}", .map = &bead_damping_options, .help = "see chain.damping",
     .example = "{coefficient: 10, exponent: 1.8}"},
};
const struct bead_options bead_chain_options = {
    "chain", "a chain of beads; `chains` is a list of chains with a `name` each, run and shown together", BEAD_OPTIONS(chain_rows),
    NULL, NULL};

/* Beads with gaps between them are not pressed together, and do not pull at each other. */
static enum bead_error check_gaps(const struct bead_reader *reader, const struct bead_at *at, const struct bead_chain_spec *chain)
{
    const char *key = chain->precompression > 0 ? "precompression" : chain->tilt > 0 ? "tilt" : "law";
    if ((chain->precompression == 0 && chain->tilt == 0 && chain->law.row->one_sided) ||
        !(chain->gap > 0 || bead_scene_has_any(reader->scene, chain, offsetof(struct bead_material, gap))))
        return BEAD_OK;
    return BEAD_WRONG_KEY(reader, at, key, "%s, but there are gaps between beads: give one or the other",
                          *key == 'l' ? "pulls as well as pushes" : "presses the chain together");
}

enum bead_error bead_scene_make_chains(const struct bead_reader *reader, size_t count)
{
    BEAD_TRY(bead_new(&reader->scene->chains, count, reader->msg, "%zu chains", count));
    reader->scene->chain_count = count;
    for (size_t i = 0; i < count; i++)
        reader->scene->chains[i].system = &bead_system_beads;
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
    return check_gaps(reader, at, chain);
}
