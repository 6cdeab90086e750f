/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A chain that is an equation: its keys, which of them belong to which equation, and how it starts. */
#include <math.h>
#include <stdlib.h>

#include "sim/base/suggest.h"
#include "sim/equation/equation.h"
#include "sim/scene/scene_private.h"

#define EQUATION(member) offsetof(struct bead_chain_spec, equation.member)

static const char *const ends[] = {"fixed", "periodic", NULL};
static const char *const ways[] = {"rest", "right", "left", NULL};
static const char *const variables[] = {
#define FIELD_NAME(id, name, unit, title, place) name,
    BEAD_FIELDS(FIELD_NAME)
#undef FIELD_NAME
        NULL};

/* ---- start ---- */

#define NUMBER(name, member, from, to, says, sample)                                                                        \
    {                                                                                                                       \
        .key = name, .offset = EQUATION(member), .required = true, .low = from, .high = to, .help = says, .example = sample \
    }
#define AMPLITUDE(says) NUMBER("amplitude", amplitude, -1e6, 1e6, says, "1")
#define WAVES(name, says)                                                                                                        \
    {                                                                                                                            \
        .key = name, .type = BEAD_OPTION_COUNT, .offset = EQUATION(mode), .required = true, .low = 1, .high = 1e6, .help = says, \
        .example = "1"                                                                                                           \
    }

static const struct bead_option mode_rows[] = {
    WAVES("mode", "number of a linear mode of the string"),
    {"amplitude", BEAD_OPTION_NUMBER, EQUATION(amplitude), .initial = "1", .low = -1e6, .high = 1e6, .help = "largest displacement",
     .example = "0.5"},
};

static const struct bead_option pulse_rows[] = {
    NUMBER("pulse", amplitude, -1e6, 1e6, "height: of the strain in strings, else of the unknown", "0.1"),
    {"width", BEAD_OPTION_NUMBER, EQUATION(width), .required = true, .low = 0, .high = 1e6, .open = BEAD_OPEN_LOW,
     .help = "w in height sech^2((x - at) / w)", .example = "5"},
    NUMBER("at", at, -1e9, 1e9, "place of the centre", "50"),
    {"moving", BEAD_OPTION_CHOICE, EQUATION(moving), .initial = "rest", .choices = ways,
     .help = "rest: the pulse parts into two; right, left: it goes one way (strings and shocks)"},
};

static const struct bead_option cosine_rows[] = {
    WAVES("cosine", "number of waves in the domain"),
    AMPLITUDE("amplitude of the cosine"),
};

static const struct bead_option wave_rows[] = {
    WAVES("simple-wave", "number of waves in the domain"),
    AMPLITUDE("amplitude of the strain"),
};

static const struct bead_option soliton_rows[] = {
    {"speed", BEAD_OPTION_NUMBER, offsetof(struct bead_soliton, speed), .required = true, .low = 0, .high = 1e6,
     .open = BEAD_OPEN_LOW, .help = "speed of the soliton, less the drift", .example = "16"},
    {"at", BEAD_OPTION_NUMBER, offsetof(struct bead_soliton, at), .required = true, .low = -1e9, .high = 1e9,
     .help = "place of the centre at time 0", .example = "-8"},
};
const struct bead_options bead_soliton_options = {"chain.start.solitons", "entries of the list", BEAD_OPTIONS(soliton_rows), NULL,
                                                  NULL};

static BEAD_OPTION_READER(read_solitons)
{
    struct bead_equation_spec *spec = &((struct bead_chain_spec *)settings)->equation;
    BEAD_TRY(bead_need_list(reader, at, option->shape, BEAD_SOLITONS, "solitons"));
    for (size_t i = 0; i < at->node->count; i++) {
        struct bead_at element = bead_at_item(at, i);
        spec->soliton_count = i + 1;
        BEAD_TRY(bead_options_read(reader, &element, &bead_soliton_options, &spec->solitons[i]));
    }
    return BEAD_OK;
}

static const struct bead_option solitons_rows[] = {
    {"solitons", BEAD_OPTION_CUSTOM, .required = true, .shape = "a list such as [{speed: 16, at: -8}, {speed: 4, at: 0}]",
     .like = "[chain.start.solitons]", .read = read_solitons, .help = "see chain.start.solitons",
     .example = "[{speed: 16, at: -8}, {speed: 4, at: 0}]"},
};

/* The name of each table is the key that chooses the kind of start. */
static const struct bead_option_family start_family = {"chain.start", "starts with"};
static const struct start {
    enum bead_start_kind kind;
    const char *const *equations; /* that start like this */
    struct bead_options options;
} starts[] = {
    {BEAD_START_MODE,
     (const char *const[]){"fput", NULL},
     {"mode", "at rest, displaced like a mode of the linear string", BEAD_OPTIONS(mode_rows), NULL, &start_family}},
    {BEAD_START_PULSE,
     (const char *const[]){"fput", "kdv", "shock", NULL},
     {"pulse", "one hump", BEAD_OPTIONS(pulse_rows), NULL, &start_family}},
    {BEAD_START_COSINE,
     (const char *const[]){"kdv", "shock", NULL},
     {"cosine", "amplitude cos(2 pi n (x - low) / length)", BEAD_OPTIONS(cosine_rows), NULL, &start_family}},
    {BEAD_START_SIMPLE_WAVE,
     (const char *const[]){"shock", NULL},
     {"simple-wave", "strain amplitude sin(2 pi n (x - low) / length), moving right", BEAD_OPTIONS(wave_rows), NULL,
      &start_family}},
    {BEAD_START_SOLITONS,
     (const char *const[]){"kdv", NULL},
     {"solitons", "a sum of solitary waves of the equation", BEAD_OPTIONS(solitons_rows), NULL, &start_family}},
};
enum { STARTS = sizeof starts / sizeof *starts };

const struct bead_options *bead_start_options(size_t index)
{
    return index < STARTS ? &starts[index].options : NULL;
}

static BEAD_OPTION_READER(read_start)
{
    struct bead_chain_spec *chain = settings;
    struct bead_suggest search;
    char shown[64], near[96], all[160] = "";
    bool map = at->node->kind == BEAD_NODE_MAP;
    bead_suggest_begin(&search, map && at->node->count ? at->node->items[0]->text : "");
    for (size_t i = 0; i < STARTS; i++) {
        if (!bead_is_one_of(chain->system->name, starts[i].equations))
            continue;
        if (map && bead_node_get(at->node, starts[i].options.name, NULL)) {
            chain->equation.start = starts[i].kind;
            return bead_options_read(reader, at, &starts[i].options, chain);
        }
        bead_list_add(all, sizeof all, ", ", starts[i].options.name);
        bead_suggest_try(&search, starts[i].options.name);
    }
    return bead_wrong(reader, at, "is %s; must be a map with one of the keys %s for the equation %s%s",
                      map ? "none of those known here" : bead_node_show(at->node, shown, sizeof shown), all, chain->system->name,
                      bead_suggest_text(&search, near, sizeof near));
}

/* ---- the chain ---- */

static BEAD_OPTION_READER(read_name)
{
    const char *names[BEAD_CHOICES + 1] = {NULL};
    struct bead_chain_spec *chain = settings;
    const struct bead_system *system;
    unsigned found = 0;
    for (size_t i = 0; i < BEAD_CHOICES && (system = bead_system_info(i + 1)); i++) /* row 0: beads */
        names[i] = system->name;
    BEAD_TRY(bead_read_choice(reader, at, names, &found));
    chain->system = bead_system_info(found + 1);
    return BEAD_OK;
}

/* Keys of all equations. */
static const struct bead_option equation_rows[] = {
    {"equation", BEAD_OPTION_CUSTOM, .required = true, .shape = "fput, kdv or shock", .like = "text", .read = read_name,
     .help = "the equation, instead of beads; its numbers have no units", .example = "fput"},
    {"name", BEAD_OPTION_TEXT, offsetof(struct bead_chain_spec, name), .initial = "",
     .help = "name of the chain; required under `chains`", .example = "disordered"},
    {"label", BEAD_OPTION_TEXT, offsetof(struct bead_chain_spec, label), .initial = "",
     .help = "a line about the chain, for pictures", .example = "half of the dimers reversed at random"},
};
static const struct bead_option low_row[] = {
    {"low", BEAD_OPTION_NUMBER, EQUATION(low), .initial = "0", .low = -1e9, .high = 1e9,
     .help = "left end of the domain; in a ring of masses, the place of the first", .example = "-12"},
};
static const struct bead_option start_row[] = {
    {"start", BEAD_OPTION_CUSTOM, .required = true,
     .shape = "a map: {mode: 1, amplitude: 1}, {pulse: 0.1, width: 5, at: 50}, {solitons: [...]}, {cosine: 1, amplitude: 1} or "
              "{simple-wave: 1, amplitude: 1}",
     .like = "chain.start", .read = read_start, .help = "the state at time 0: see chain.start",
     .example = "{pulse: 0.1, width: 5, at: 50}"},
};
/* Keys of equations on a grid. */
static const struct bead_option grid_rows[] = {
    {"points", BEAD_OPTION_COUNT, EQUATION(points), .initial = "auto", .low = 8, .high = 1 << 20, .word = "auto",
     .help = "points of the grid; auto: as many as the accuracy needs; fast without prime factors above 5", .example = "800"},
    {"length", BEAD_OPTION_NUMBER, EQUATION(length), .required = true, .low = 0, .high = 1e9, .open = BEAD_OPEN_LOW,
     .help = "length of the domain, which is periodic", .example = "34"},
};
static const struct bead_option fput_points[] = {
    {"points", BEAD_OPTION_COUNT, EQUATION(points), .required = true, .low = 1, .high = 1e6, .help = "number of moving masses",
     .example = "31"},
};
static const struct bead_option piecewise_rows[] = {
    {"stiffness", BEAD_OPTION_NUMBER, EQUATION(piecewise.stiffness), .required = true, .low = 0, .high = 1e6,
     .help = "stiffness of a spring stretched or compressed by more than `beyond`; by less, it is 1", .example = "1.5"},
    {"beyond", BEAD_OPTION_NUMBER, EQUATION(piecewise.beyond), .required = true, .low = 0, .high = 1e6, .open = BEAD_OPEN_LOW,
     .help = "strain at which the stiffness changes", .example = "0.05"},
};
const struct bead_options bead_piecewise_options = {"chain.piecewise", "springs with another stiffness beyond a strain",
                                                    BEAD_OPTIONS(piecewise_rows), NULL, NULL};

static const struct bead_option fput_rows[] = {
    {"ends", BEAD_OPTION_CHOICE, EQUATION(ends), .initial = "fixed", .choices = ends,
     .help = "fixed: walls on both sides; periodic: a ring"},
    {"alpha", BEAD_OPTION_NUMBER, EQUATION(alpha), .initial = "0.25", .low = -1e6, .high = 1e6,
     .help = "alpha in the tension r + alpha r^2 + beta r^3 of a spring stretched by r; beside `piecewise` 0 unless given",
     .example = "0.5"},
    {"beta", BEAD_OPTION_NUMBER, EQUATION(beta), .initial = "0", .low = -1e6, .high = 1e6, .help = "beta in the same tension",
     .example = "0.1"},
    {"piecewise", BEAD_OPTION_MAP, .map = &bead_piecewise_options,
     .help = "the third force of Fermi, Pasta and Ulam, piecewise linear: see chain.piecewise",
     .example = "{stiffness: 1.5, beyond: 0.05}"},
};
static const struct bead_option kdv_rows[] = {
    {"drift", BEAD_OPTION_NUMBER, EQUATION(drift), .initial = "0", .low = -1e6, .high = 1e6,
     .help = "d in u_t + d u_x + a u u_x + b u_xxx = 0", .example = "1"},
    {"nonlinearity", BEAD_OPTION_NUMBER, EQUATION(nonlinearity), .initial = "6", .low = -1e6, .high = 1e6,
     .help = "a in that equation", .example = "1"},
    {"dispersion", BEAD_OPTION_NUMBER, EQUATION(dispersion), .initial = "1", .low = -1e6, .high = 1e6, .help = "b in that equation",
     .example = "4.84e-4"},
    {"variable", BEAD_OPTION_CHOICE, EQUATION(variable), .initial = "displacement", .choices = variables,
     .help = "the field that shows the unknown"},
};
static const struct bead_option shock_rows[] = {
    {"speed", BEAD_OPTION_NUMBER, EQUATION(speed), .initial = "1", .low = 0, .high = 1e6, .open = BEAD_OPEN_LOW,
     .help = "c in u_tt = c^2 u_xx (1 + e u_x)", .example = "2"},
    {"epsilon", BEAD_OPTION_NUMBER, EQUATION(epsilon), .required = true, .low = -1e6, .high = 1e6, .help = "e in that equation",
     .example = "0.5"},
};

static const struct bead_option_rows
    of_fput[] = {{BEAD_OPTIONS(fput_points)},
                 {BEAD_OPTIONS(low_row)},
                 {BEAD_OPTIONS(fput_rows)},
                 {BEAD_OPTIONS(start_row)},
                 {NULL, 0}},
    of_kdv[] = {{BEAD_OPTIONS(grid_rows)}, {BEAD_OPTIONS(low_row)}, {BEAD_OPTIONS(kdv_rows)}, {BEAD_OPTIONS(start_row)}, {NULL, 0}},
    of_shock[] = {
        {BEAD_OPTIONS(grid_rows)}, {BEAD_OPTIONS(low_row)}, {BEAD_OPTIONS(shock_rows)}, {BEAD_OPTIONS(start_row)}, {NULL, 0}};

/* One an equation. */
static const struct bead_option_family equation_family = {"chain", "chains with the equation"};
static const struct bead_options equations[] = {
    {"fput", "masses on a string of springs", BEAD_OPTIONS(equation_rows), of_fput, &equation_family},
    {"kdv", "the Korteweg-de Vries equation on a ring", BEAD_OPTIONS(equation_rows), of_kdv, &equation_family},
    {"shock", "a wave that steepens, on a ring, until it breaks", BEAD_OPTIONS(equation_rows), of_shock, &equation_family},
};

const struct bead_options *bead_equation_options(size_t index)
{
    return index < sizeof equations / sizeof *equations ? &equations[index] : NULL;
}

static const struct bead_options *options_of(const char *equation)
{
    const struct bead_options *options;
    for (size_t i = 0; (options = bead_equation_options(i)) && strcmp(options->name, equation) != 0;)
        i++;
    return options;
}

enum bead_error bead_scene_read_equation(struct bead_reader *reader, const struct bead_at *at, struct bead_chain_spec *chain)
{
    const struct bead_node *given = bead_node_get(at->node, "equation", NULL);
    struct bead_at where = {at, "equation", 0, given};
    BEAD_TRY(read_name(reader, &where, &equation_rows[0], chain));
    const struct bead_options *options = options_of(chain->system->name);
    if (!options)
        return bead_wrong(reader, &where, "`%s` has no keys that a scene could give", chain->system->name);
    BEAD_TRY(bead_options_read(reader, at, options, chain));
    if (bead_given(at, "piecewise") && !bead_given(at, "alpha"))
        chain->equation.alpha = 0;
    const char *key = "equation", *wrong = chain->system->equation->check(&chain->equation, &key);
    return wrong ? BEAD_WRONG_KEY(reader, at, key, "%s", wrong) : BEAD_OK;
}
