/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `sweep`, `sweeps`: chains that differ in the spins of their random cells, and what is measured of them. */
#include <stdlib.h>
#include <string.h>

#include "sim/chain/spins.h"
#include "sim/scene/scene_private.h"
#include "sim/scene/sweep_yaml.h"

enum { SWEEPS = 64, SENSORS = 64, CONFIGURATIONS = 10000000 };

#define SWEEP(member)   offsetof(struct bead_sweep_spec, member)
#define MEASURE(member) offsetof(struct bead_sweep_measures, member)
#define READER(name)                                                                                                    \
    static enum bead_error name(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option, \
                                void *settings)

/* Keys that are read with the chain, those that need it (read when it is there), and the measures' own. */
READER(skip_key);
READER(read_measure);
READER(read_sensors);
READER(read_places);

static const struct bead_option measure_rows[] = {
    {.key = "peak",
     .type = BEAD_OPTION_CUSTOM,
     .shape = "force or none",
     .help = "take the largest force of `beads` in the first passage, which ends when the front reaches the end of the chain",
     .example = "force",
     .like = "force|none",
     .read = skip_key},
    {.key = "beads",
     .type = BEAD_OPTION_CUSTOM,
     .offset = MEASURE(beads),
     .initial = "[3, 5]",
     .shape = "[first, last], counted from the last random bead",
     .help = "the beads of which the largest force is taken",
     .example = "[1, 8]",
     .like = "[2 number]",
     .read = read_places},
    {.key = "sensor",
     .type = BEAD_OPTION_CUSTOM,
     .shape = "the name of a sensor, or a list of some",
     .help = "take the peak force at these sensors instead",
     .example = "first",
     .like = "text|[text]",
     .read = read_sensors},
    {.key = "decay",
     .type = BEAD_OPTION_FLAG,
     .offset = MEASURE(decay),
     .initial = "false",
     .help = "also keep, for each bead, the peak force, the energy of the front at that time (of the bead and the four on either "
             "side), and force and energy at the end"},
};
const struct bead_options bead_sweep_measure_options = {"sweep.measure", "what is measured of each chain",
                                                        BEAD_OPTIONS(measure_rows), NULL, NULL};

#define OF_CHAIN(name, of, sample, kind)                                                                              \
    {                                                                                                                 \
        .key = name, .type = BEAD_OPTION_CUSTOM, .shape = "as in chain", .help = of, .example = sample, .like = kind, \
        .read = skip_key                                                                                              \
    }
static const struct bead_option rows[] = {
    {.key = "name",
     .type = BEAD_OPTION_TEXT,
     .offset = SWEEP(name),
     .initial = "",
     .help = "name of the sweep; required under `sweeps`",
     .example = "long"},
    {.key = "cells",
     .type = BEAD_OPTION_COUNT,
     .offset = SWEEP(asked),
     .low = 1,
     .high = 1000000,
     .help = "number of cells with random spins; without it, the random cells of `chain` are drawn anew for each configuration",
     .example = "64"},
    {.key = "fixed",
     .type = BEAD_OPTION_COUNT,
     .offset = SWEEP(fixed),
     .initial = BEAD_SWEEP_FIXED,
     .low = 0,
     .high = 1000000,
     .help = "how many cells follow, all up",
     .example = "10"},
    {.key = "cell",
     .type = BEAD_OPTION_CUSTOM,
     .shape = "[MATERIAL, MATERIAL, ...]",
     .help = "the beads of a cell; without it [large-steel, aluminium]",
     .example = "[large-steel, ptfe]",
     .like = "[text]",
     .read = skip_key},
    {.key = "magnetism",
     .type = BEAD_OPTION_CUSTOM,
     .shape = "all, a number, or a list of numbers from 0 to 1",
     .help = "M = (up - down) / all, the nearest that the number of cells allows; all: each that it allows. Without it: all with "
             "`cells`, else as each segment of `chain` has it",
     .example = "[0, 0.5, 1]",
     .like = "all|number|[number]",
     .read = skip_key},
    {.key = "configurations",
     .type = BEAD_OPTION_COUNT,
     .offset = SWEEP(configurations),
     .initial = "20",
     .low = 1,
     .high = 1000000,
     .help = "how many chains of each magnetism; one where all spins are the same",
     .example = "100"},
    {.key = "seed",
     .type = BEAD_OPTION_SEED,
     .offset = SWEEP(seed),
     .initial = "0",
     .help = "seed of all spins; the same seed gives the same spins on every machine",
     .example = "2009"},
    {.key = "spins",
     .type = BEAD_OPTION_CUSTOM,
     .shape = "a list such as [\"1101\", \"0110\"], one digit per random cell",
     .help = "the configurations, one by one, instead of magnetism",
     .example = "[\"1101\", \"0110\"]",
     .like = "[text]",
     .read = skip_key},
    {.key = "measure",
     .type = BEAD_OPTION_CUSTOM,
     .initial = "{}",
     .shape = "a map",
     .help = "see sweep.measure",
     .example = "{sensor: first}",
     .like = "sweep.measure",
     .read = read_measure},
    OF_CHAIN("striker", "with `cells`: what strikes the chain; else as in `chain`", "{velocity: 1 m/s}", "chain.striker"),
    OF_CHAIN("wall", "with `cells`: what stands behind the last bead", "brass", "text"),
    OF_CHAIN("law", "with `cells`: the force between two beads", "thesis-appendix", "text|chain.law"),
    OF_CHAIN("precompression", "with `cells`: static force that presses the chain together", "10 N", "number"),
    OF_CHAIN("tilt", "with `cells`: slope of the chain, with its wall at the lower end", "3.5 deg", "number"),
    OF_CHAIN("damping", "with `cells`: forces against the relative motion of touching beads", "{coefficient: 10}", "chain.damping"),
};
const struct bead_options bead_sweep_options = {
    "sweep", "many chains with random spins; `sweeps` is a list of sweeps with a `name` each, shown together", BEAD_OPTIONS(rows),
    NULL, NULL};

READER(skip_key)
{
    (void)reader, (void)at, (void)option, (void)settings;
    return BEAD_OK;
}

READER(read_places)
{
    static const struct bead_option place = {.type = BEAD_OPTION_COUNT, .low = 1, .high = 1000000};
    struct bead_sweep_measures *measures = settings;
    char shown[64];
    if (at->node->kind != BEAD_NODE_LIST || at->node->count != 2)
        return bead_wrong(reader, at, "is %s; must be %s", bead_node_show(at->node, shown, sizeof shown), option->shape);
    for (size_t i = 0; i < 2; i++) {
        struct bead_at element = {at, NULL, i, at->node->items[i]};
        double number = 0;
        enum bead_error err = bead_read_number(reader, &element, &place, &number);
        if (err)
            return err;
        measures->beads[i] = (size_t)number;
    }
    return measures->beads[0] <= measures->beads[1]
               ? BEAD_OK
               : bead_wrong(reader, at, "is [%zu, %zu]; the first must not be greater than the last", measures->beads[0],
                            measures->beads[1]);
}

READER(read_sensors)
{
    struct bead_sweep_measures *measures = settings;
    (void)option;
    bool list = at->node->kind == BEAD_NODE_LIST;
    size_t count = list ? at->node->count : 1;
    if (count == 0 || count > SENSORS)
        return bead_wrong(reader, at, "has %zu names; must have from 1 to %d", count, SENSORS);
    measures->sensors = calloc(count, sizeof *measures->sensors);
    if (!measures->sensors)
        return bead_no_memory(reader);
    measures->sensor_count = count;
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; i < count && !err; i++) {
        struct bead_at element = {at, NULL, i, list ? at->node->items[i] : at->node};
        err = bead_read_text(reader, list ? &element : at, &measures->sensors[i]);
        for (size_t k = 0; k < i && !err; k++) {
            if (strcmp(measures->sensors[k], measures->sensors[i]) == 0)
                err = bead_wrong(reader, &element, "`%s` is in the list twice", measures->sensors[i]);
        }
    }
    return err;
}

READER(read_measure)
{
    static const char *const peaks[] = {"force", "none", NULL};
    struct bead_sweep_measures *measures = &((struct bead_sweep_spec *)settings)->measures;
    (void)option;
    enum bead_error err = bead_options_read(reader, at, &bead_sweep_measure_options, measures);
    struct bead_at peak = bead_at_key(at, "peak"), beads = bead_at_key(at, "beads");
    unsigned chosen = 0;
    if (!err && peak.node != at->node)
        err = bead_read_choice(reader, &peak, peaks, &chosen);
    measures->peak = chosen == 0;
    if (!err && !measures->peak && !measures->decay)
        err = bead_wrong(reader, &peak, "leaves nothing to measure; must be force, or go with `decay: true`");
    if (!err && measures->sensor_count > 0 && beads.node != at->node)
        err = bead_wrong(reader, &beads, "is given beside `sensor`; give one of them");
    return err;
}

/* ---- what needs the chain ---- */

static bool has_sensor(const struct bead_chain_spec *chain, const char *name)
{
    for (size_t s = 0; s < chain->segment_count; s++) {
        if (chain->segments[s].sensor && strcmp(chain->segments[s].sensor, name) == 0)
            return true;
    }
    return false;
}

static enum bead_error check_measure(const struct bead_reader *reader, const struct bead_at *at,
                                     const struct bead_sweep_spec *sweep)
{
    const struct bead_chain_spec *chain = &reader->scene->chains[sweep->chain];
    const struct bead_sweep_measures *measures = &sweep->measures;
    struct bead_at measure = bead_at_key(at, "measure"), beads = bead_at_key(&measure, "beads"),
                   sensor = bead_at_key(&measure, "sensor");
    size_t count = bead_scene_count_beads(chain), total = 0;
    for (size_t i = 0; i < measures->sensor_count; i++) {
        if (!has_sensor(chain, measures->sensors[i]))
            return bead_wrong(reader, &sensor, "`%s` is not a sensor of the chain", measures->sensors[i]);
    }
    if (measures->peak && measures->sensor_count == 0 && sweep->last + measures->beads[1] > count)
        return bead_wrong(reader, &beads, "reaches to bead %zu; the chain ends with bead %zu", sweep->last + measures->beads[1],
                          count);
    for (size_t g = 0; g < sweep->group_count; g++)
        total += sweep->groups[g].configurations;
    size_t values = measures->decay ? 2 * (count + 1) : 3 * (measures->sensor_count + 1);
    if (total > CONFIGURATIONS || total > 200000000 / (values + sweep->cells))
        return bead_wrong(reader, at, "has %zu configurations of %zu results and %zu spins, which is too much for one sweep", total,
                          values, sweep->cells);
    return BEAD_OK;
}

/* Keys that only make sense together. */
static enum bead_error check_sweep_keys(const struct bead_reader *reader, const struct bead_at *at,
                                        const struct bead_sweep_spec *sweep)
{
    static const char *const with_cells[] = {"fixed", "cell", "striker", "wall", "law", "precompression", "tilt", "damping"};
    for (size_t i = 0; i < sizeof with_cells / sizeof *with_cells && sweep->asked == 0; i++) {
        struct bead_at where = bead_at_key(at, with_cells[i]);
        if (where.node != at->node)
            return bead_wrong(reader, &where, "belongs to `cells`, which is not given here; without it `chain` is swept");
    }
    return BEAD_OK;
}

/* The pattern, as a chain of the scene: from the keys here and those of `chain`. */
static enum bead_error read_pattern(struct bead_reader *reader, const struct bead_at *at, struct bead_sweep_spec *sweep)
{
    const struct bead_at *top = at->up;
    while (top->up)
        top = top->up;
    struct bead_at chain = bead_at_key(top, "chain"), beads = bead_at_key(&chain, "beads");
    bool has_chain = chain.node != top->node;
    if (sweep->asked == 0 && !has_chain)
        return bead_wrong(reader, at, "has neither `cells` nor a `chain` to sweep; give one of them");
    if (sweep->asked == 0)
        return bead_scene_read_chain(reader, &chain, &reader->scene->chains[sweep->chain]);
    if (has_chain && beads.node != chain.node)
        return bead_wrong(reader, &beads, "are given beside `cells` of the sweep; give one of them");
    struct bead_node *pattern = NULL;
    enum bead_error err = bead_sweep_chain_node(reader->yaml, top->node, at->node, NULL, &pattern, reader->msg);
    struct bead_at built = {at->up, at->key, at->index, pattern};
    return err ? err : bead_scene_read_chain(reader, &built, &reader->scene->chains[sweep->chain]);
}

static enum bead_error read_sweep(struct bead_reader *reader, const struct bead_at *at, size_t index)
{
    struct bead_scene *scene = reader->scene;
    struct bead_sweep_spec *sweep = &scene->sweeps[index];
    sweep->place = at->node->place;
    sweep->chain = index;
    enum bead_error err = bead_options_read(reader, at, &bead_sweep_options, sweep);
    if (!err)
        err = check_sweep_keys(reader, at, sweep);
    if (!err)
        err = read_pattern(reader, at, sweep);
    if (!err && scene->chains[index].equation.name)
        err = bead_wrong(reader, at, "needs a chain of beads: an equation has no spins");
    if (!err)
        err = bead_scene_read_groups(reader, at, sweep);
    return err ? err : check_measure(reader, at, sweep);
}

static enum bead_error read_sweeps(struct bead_reader *reader, const struct bead_at *at, bool list)
{
    struct bead_scene *scene = reader->scene;
    struct bead_at chains = bead_at_key(at->up, "chains");
    size_t count = list ? at->node->count : 1;
    if (chains.node != at->up->node)
        return bead_wrong(reader, &chains, "is given beside a sweep, which has one chain: give `chain`, or `sweeps` with `cells`");
    if (count == 0 || count > SWEEPS)
        return bead_wrong(reader, at, "has %zu sweeps; must have from 1 to %d", count, SWEEPS);
    scene->sweeps = calloc(count, sizeof *scene->sweeps);
    scene->chains = calloc(count, sizeof *scene->chains);
    if (!scene->sweeps || !scene->chains)
        return bead_no_memory(reader);
    scene->sweep_count = scene->chain_count = count;
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; i < count && !err; i++) {
        struct bead_at element = {at, NULL, i, list ? at->node->items[i] : at->node}, name = bead_at_key(&element, "name");
        err = read_sweep(reader, list ? &element : at, i);
        for (size_t k = 0; k < i && !err; k++) {
            if (strcmp(scene->sweeps[k].name, scene->sweeps[i].name) == 0)
                err = bead_wrong(reader, &name, "`%s` is the name of another sweep; names must differ", scene->sweeps[i].name);
        }
        if (!err && list && !*scene->sweeps[i].name)
            err = bead_wrong(reader, &name, "is missing: every sweep of a list needs a name");
    }
    return err;
}

enum bead_error bead_scene_read_sweep(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                      void *settings)
{
    struct bead_at several = bead_at_key(at->up, "sweeps");
    (void)option, (void)settings;
    if (several.node != at->up->node)
        return bead_wrong(reader, at, "is given beside `sweeps`; give one of them");
    return read_sweeps(reader, at, false);
}

enum bead_error bead_scene_read_sweeps(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                       void *settings)
{
    char shown[64];
    (void)settings;
    if (at->node->kind != BEAD_NODE_LIST)
        return bead_wrong(reader, at, "is %s; must be %s", bead_node_show(at->node, shown, sizeof shown), option->shape);
    return read_sweeps(reader, at, true);
}

void bead_scene_free_sweeps(struct bead_scene *scene)
{
    for (size_t i = 0; i < scene->sweep_count; i++) {
        struct bead_sweep_spec *sweep = &scene->sweeps[i];
        for (size_t k = 0; sweep->spins && k < sweep->group_count; k++)
            free(sweep->spins[k]);
        for (size_t k = 0; k < sweep->measures.sensor_count; k++)
            free(sweep->measures.sensors[k]);
        free(sweep->measures.sensors);
        free(sweep->spins);
        free(sweep->groups);
        free(sweep->name);
        free(sweep->title);
    }
    free(scene->sweeps);
}
