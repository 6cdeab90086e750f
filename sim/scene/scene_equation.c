/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A chain that is an equation: its keys, which of them belong to which equation, and how it starts. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/suggest.h"
#include "sim/equation/equation.h"
#include "sim/scene/scene_private.h"

#define EQUATION(member) offsetof(struct bead_equation_spec, member)

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
    {.key = "amplitude",
     .offset = EQUATION(amplitude),
     .initial = "1",
     .low = -1e6,
     .high = 1e6,
     .help = "largest displacement",
     .example = "0.5"},
};
const struct bead_options bead_start_mode_options = {"chain.start (mode)", "at rest, displaced like a mode of the linear string",
                                                     BEAD_OPTIONS(mode_rows), NULL, NULL};

static const struct bead_option pulse_rows[] = {
    NUMBER("pulse", amplitude, -1e6, 1e6, "height: of the strain in strings, else of the unknown", "0.1"),
    {.key = "width",
     .offset = EQUATION(width),
     .required = true,
     .low = 0,
     .high = 1e6,
     .open = BEAD_OPEN_LOW,
     .help = "w in height sech^2((x - at) / w)",
     .example = "5"},
    NUMBER("at", at, -1e9, 1e9, "place of the centre", "50"),
    {.key = "moving",
     .type = BEAD_OPTION_CHOICE,
     .offset = EQUATION(moving),
     .initial = "rest",
     .choices = ways,
     .help = "rest: the pulse parts into two; right, left: it goes one way (strings and shocks)"},
};
const struct bead_options bead_start_pulse_options = {"chain.start (pulse)", "one hump", BEAD_OPTIONS(pulse_rows), NULL, NULL};

static const struct bead_option cosine_rows[] = {
    WAVES("cosine", "number of waves in the domain"),
    AMPLITUDE("amplitude of the cosine"),
};
const struct bead_options bead_start_cosine_options = {"chain.start (cosine)", "amplitude cos(2 pi n (x - low) / length)",
                                                       BEAD_OPTIONS(cosine_rows), NULL, NULL};

static const struct bead_option wave_rows[] = {
    WAVES("simple-wave", "number of waves in the domain"),
    AMPLITUDE("amplitude of the strain"),
};
const struct bead_options bead_start_wave_options = {"chain.start (simple-wave)",
                                                     "strain amplitude sin(2 pi n (x - low) / length), moving right",
                                                     BEAD_OPTIONS(wave_rows), NULL, NULL};

static const struct bead_option soliton_rows[] = {
    {.key = "speed",
     .offset = offsetof(struct bead_soliton, speed),
     .required = true,
     .low = 0,
     .high = 1e6,
     .open = BEAD_OPEN_LOW,
     .help = "speed of the soliton, less the drift",
     .example = "16"},
    {.key = "at",
     .offset = offsetof(struct bead_soliton, at),
     .required = true,
     .low = -1e9,
     .high = 1e9,
     .help = "place of the centre at time 0",
     .example = "-8"},
};
const struct bead_options bead_soliton_options = {"chain.start.solitons", "entries of the list", BEAD_OPTIONS(soliton_rows), NULL,
                                                  NULL};

static enum bead_error read_solitons(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                     void *settings)
{
    struct bead_equation_spec *spec = settings;
    char shown[64];
    if (at->node->kind != BEAD_NODE_LIST)
        return bead_wrong(reader, at, "is %s; must be %s", bead_node_show(at->node, shown, sizeof shown), option->shape);
    if (at->node->count == 0 || at->node->count > BEAD_SOLITONS)
        return bead_wrong(reader, at, "has %zu solitons; must have from 1 to %d", at->node->count, BEAD_SOLITONS);
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; i < at->node->count && !err; i++) {
        struct bead_at element = {at, NULL, i, at->node->items[i]};
        err = bead_options_read(reader, &element, &bead_soliton_options, &spec->solitons[i]);
        spec->soliton_count = i + 1;
    }
    return err;
}

static const struct bead_option solitons_rows[] = {
    {.key = "solitons",
     .type = BEAD_OPTION_CUSTOM,
     .required = true,
     .shape = "a list such as [{speed: 16, at: -8}, {speed: 4, at: 0}]",
     .help = "see chain.start.solitons",
     .example = "[{speed: 16, at: -8}, {speed: 4, at: 0}]",
     .like = "[chain.start.solitons]",
     .read = read_solitons},
};
const struct bead_options bead_start_solitons_options = {"chain.start (solitons)", "a sum of solitary waves of the equation",
                                                         BEAD_OPTIONS(solitons_rows), NULL, NULL};

static const struct start {
    const char *word;
    enum bead_start_kind kind;
    const char *const *equations; /* that start like this */
    const struct bead_options *options;
} starts[] = {{"mode", BEAD_START_MODE, (const char *const[]){"fput", NULL}, &bead_start_mode_options},
              {"pulse", BEAD_START_PULSE, (const char *const[]){"fput", "kdv", "shock", NULL}, &bead_start_pulse_options},
              {"solitons", BEAD_START_SOLITONS, (const char *const[]){"kdv", NULL}, &bead_start_solitons_options},
              {"cosine", BEAD_START_COSINE, (const char *const[]){"kdv", "shock", NULL}, &bead_start_cosine_options},
              {"simple-wave", BEAD_START_SIMPLE_WAVE, (const char *const[]){"shock", NULL}, &bead_start_wave_options}};
enum { STARTS = sizeof starts / sizeof *starts };

static bool starts_like(const char *equation, const struct start *start)
{
    const char *const *name = start->equations;
    while (*name && strcmp(*name, equation) != 0)
        name++;
    return *name;
}

static enum bead_error read_start(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                  void *settings)
{
    struct bead_equation_spec *spec = settings;
    struct bead_suggest search;
    char shown[64], near[96], all[160] = "";
    bool map = at->node->kind == BEAD_NODE_MAP;
    (void)option;
    bead_suggest_begin(&search, map && at->node->count ? at->node->items[0]->text : "");
    for (size_t i = 0; i < STARTS; i++) {
        size_t used = strlen(all);
        if (!starts_like(spec->name, &starts[i]))
            continue;
        if (map && bead_node_get(at->node, starts[i].word, NULL)) {
            spec->start = starts[i].kind;
            return bead_options_read(reader, at, starts[i].options, spec);
        }
        snprintf(all + used, sizeof all - used, "%s%s", used ? ", " : "", starts[i].word);
        bead_suggest_try(&search, starts[i].word);
    }
    return bead_wrong(reader, at, "is %s; must be a map with one of the keys %s for the equation %s%s",
                      map ? "none of those known here" : bead_node_show(at->node, shown, sizeof shown), all, spec->name,
                      bead_suggest_text(&search, near, sizeof near));
}

/* ---- the chain ---- */

static enum bead_error read_name(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                 void *settings)
{
    struct bead_equation_spec *spec = settings;
    struct bead_suggest search;
    const char *text = NULL;
    char all[120] = "", shown[64], near[96];
    enum bead_error err = bead_read_scalar(reader, at, option->shape, &text);
    if (err)
        return err;
    bead_suggest_begin(&search, text);
    for (size_t i = 0; bead_equation_info(i); i++) {
        const char *name = bead_equation_info(i)->system.name;
        size_t used = strlen(all);
        snprintf(all + used, sizeof all - used, "%s%s", used ? ", " : "", name);
        bead_suggest_try(&search, name);
    }
    const struct bead_equation *equation = bead_equation_find(text);
    if (!equation)
        return bead_wrong(reader, at, "is %s; must be one of %s%s", bead_node_show(at->node, shown, sizeof shown), all,
                          bead_suggest_text(&search, near, sizeof near));
    spec->system = &equation->system;
    spec->name = strdup(text);
    return spec->name ? BEAD_OK : bead_no_memory(reader);
}

/* Name and label are the chain's own, the rest the equation's: read by the caller. */
static enum bead_error pass_over(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                 void *settings)
{
    (void)reader, (void)at, (void)option, (void)settings;
    return BEAD_OK;
}

/* Of all equations. */
static const struct bead_option equation_rows[] = {
    {.key = "equation",
     .type = BEAD_OPTION_CUSTOM,
     .required = true,
     .shape = "fput, kdv or shock",
     .help = "the equation, instead of beads; its numbers have no units",
     .example = "fput",
     .like = "text",
     .read = read_name},
    {.key = "name",
     .type = BEAD_OPTION_CUSTOM,
     .shape = "a text",
     .help = "name of the chain; required under `chains`",
     .example = "disordered",
     .like = "text",
     .read = pass_over},
    {.key = "label",
     .type = BEAD_OPTION_CUSTOM,
     .shape = "a text",
     .help = "a line about the chain, for pictures",
     .example = "half of the dimers reversed at random",
     .like = "text",
     .read = pass_over},
};
static const struct bead_option low_row[] = {
    {.key = "low",
     .offset = EQUATION(low),
     .initial = "0",
     .low = -1e9,
     .high = 1e9,
     .help = "left end of the domain; in a ring of masses, the place of the first",
     .example = "-12"},
};
static const struct bead_option start_row[] = {
    {.key = "start",
     .type = BEAD_OPTION_CUSTOM,
     .required = true,
     .shape = "a map: {mode: 1, amplitude: 1}, {pulse: 0.1, width: 5, at: 50}, {solitons: [...]}, {cosine: 1, amplitude: 1} or "
              "{simple-wave: 1, amplitude: 1}",
     .help = "the state at time 0: see chain.start",
     .example = "{pulse: 0.1, width: 5, at: 50}",
     .like = "chain.start",
     .read = read_start},
};
/* Of those on a grid. */
static const struct bead_option grid_rows[] = {
    {.key = "points",
     .type = BEAD_OPTION_COUNT,
     .offset = EQUATION(points),
     .initial = "auto",
     .low = 8,
     .high = 1 << 20,
     .word = "auto",
     .help = "points of the grid; auto: as many as the accuracy needs; fast without prime factors above 5",
     .example = "800"},
    {.key = "length",
     .offset = EQUATION(length),
     .required = true,
     .low = 0,
     .high = 1e9,
     .open = BEAD_OPEN_LOW,
     .help = "length of the domain, which is periodic",
     .example = "34"},
};
static const struct bead_option fput_points[] = {
    {.key = "points",
     .type = BEAD_OPTION_COUNT,
     .offset = EQUATION(points),
     .required = true,
     .low = 1,
     .high = 1e6,
     .help = "number of moving masses",
     .example = "31"},
};
static const struct bead_option fput_rows[] = {
    {.key = "ends",
     .type = BEAD_OPTION_CHOICE,
     .offset = EQUATION(ends),
     .initial = "fixed",
     .choices = ends,
     .help = "fixed: walls on both sides; periodic: a ring"},
    {.key = "alpha",
     .offset = EQUATION(alpha),
     .initial = "0.25",
     .low = -1e6,
     .high = 1e6,
     .help = "alpha in the tension r + alpha r^2 + beta r^3 of a spring stretched by r",
     .example = "0.5"},
    {.key = "beta",
     .offset = EQUATION(beta),
     .initial = "0",
     .low = -1e6,
     .high = 1e6,
     .help = "beta in the same tension",
     .example = "0.1"},
};
static const struct bead_option kdv_rows[] = {
    {.key = "drift",
     .offset = EQUATION(drift),
     .initial = "0",
     .low = -1e6,
     .high = 1e6,
     .help = "d in u_t + d u_x + a u u_x + b u_xxx = 0",
     .example = "1"},
    {.key = "nonlinearity",
     .offset = EQUATION(nonlinearity),
     .initial = "6",
     .low = -1e6,
     .high = 1e6,
     .help = "a in that equation",
     .example = "1"},
    {.key = "dispersion",
     .offset = EQUATION(dispersion),
     .initial = "1",
     .low = -1e6,
     .high = 1e6,
     .help = "b in that equation",
     .example = "4.84e-4"},
    {.key = "variable",
     .type = BEAD_OPTION_CHOICE,
     .offset = EQUATION(variable),
     .initial = "displacement",
     .choices = variables,
     .help = "the field as which the unknown is shown"},
};
static const struct bead_option shock_rows[] = {
    {.key = "speed",
     .offset = EQUATION(speed),
     .initial = "1",
     .low = 0,
     .high = 1e6,
     .open = BEAD_OPEN_LOW,
     .help = "c in u_tt = c^2 u_xx (1 + e u_x)",
     .example = "2"},
    {.key = "epsilon",
     .offset = EQUATION(epsilon),
     .required = true,
     .low = -1e6,
     .high = 1e6,
     .help = "e in that equation",
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
static const struct bead_options equations[] = {
    {"fput", "masses on a string of springs", BEAD_OPTIONS(equation_rows), of_fput, &bead_equation_family},
    {"kdv", "the Korteweg-de Vries equation on a ring", BEAD_OPTIONS(equation_rows), of_kdv, &bead_equation_family},
    {"shock", "a wave that steepens, on a ring, until it breaks", BEAD_OPTIONS(equation_rows), of_shock, &bead_equation_family},
};

static const struct bead_options *equation_at(size_t index)
{
    return index < sizeof equations / sizeof *equations ? &equations[index] : NULL;
}
const struct bead_option_family bead_equation_family = {"chain", "chains with the equation", equation_at};

static const struct bead_options *options_of(const char *equation)
{
    const struct bead_options *options;
    for (size_t i = 0; (options = equation_at(i)) && strcmp(options->name, equation) != 0;)
        i++;
    return options;
}

static const struct bead_option naming_rows[] = {
    {.key = "name", .type = BEAD_OPTION_TEXT, .offset = offsetof(struct bead_chain_spec, name), .initial = ""},
    {.key = "label", .type = BEAD_OPTION_TEXT, .offset = offsetof(struct bead_chain_spec, label), .initial = ""},
};

/* Name and label of the same map. */
static enum bead_error read_naming(struct bead_reader *reader, const struct bead_at *at, struct bead_chain_spec *chain)
{
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; i < 2 && !err; i++) {
        char **text = (char **)(void *)((char *)chain + naming_rows[i].offset);
        struct bead_at where = bead_at_key(at, naming_rows[i].key);
        if (where.node != at->node)
            err = bead_read_text(reader, &where, text);
        else if (!(*text = strdup("")))
            err = bead_no_memory(reader);
    }
    return err;
}

enum bead_error bead_scene_read_equation(struct bead_reader *reader, const struct bead_at *at, struct bead_chain_spec *chain)
{
    struct bead_equation_spec *spec = &chain->equation;
    const struct bead_node *given = bead_node_get(at->node, "equation", NULL);
    struct bead_at where = {at, "equation", 0, given};
    enum bead_error err = read_naming(reader, at, chain);
    if (!err)
        err = read_name(reader, &where, &equation_rows[0], spec);
    if (err)
        return err;
    const struct bead_options *options = options_of(spec->name);
    if (!options)
        return bead_wrong(reader, &where, "`%s` has no keys that a scene could give", spec->name);
    free(spec->name); /* read again with the rest */
    spec->name = NULL;
    err = bead_options_read(reader, at, options, spec);
    if (err)
        return err;
    const char *key = "equation", *wrong = bead_equation_find(spec->name)->check(spec, &key);
    where = bead_at_key(at, key);
    return wrong ? bead_wrong(reader, &where, "%s", wrong) : BEAD_OK;
}

size_t bead_scene_last_bead(const struct bead_scene *scene, size_t chain)
{
    const struct bead_chain_spec *spec = &scene->chains[chain];
    if (!spec->equation.name)
        return bead_scene_count_beads(spec);
    return spec->equation.system->points(&spec->equation, scene->simulate.accuracy) - 1;
}
