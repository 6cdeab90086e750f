/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `sweep`, `sweeps`: chains that differ in the spins of their random cells, and the measurements. */
#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/chain/spins.h"
#include "sim/scene/scene_internal.h"
#include "sim/scene/scene_private.h"

enum { SWEEPS = 64, SENSORS = 64, CONFIGURATIONS = 10000000 };

#define SWEEP(member)   offsetof(struct bead_sweep_spec, member)
#define MEASURE(member) offsetof(struct bead_sweep_measures, member)

/* Keys without a reader are read with the chain, or after it. */
static BEAD_OPTION_READER(read_measure);
static BEAD_OPTION_READER(read_sensors);
static BEAD_OPTION_READER(read_places);

static const struct bead_option measure_rows[] = {
    {"peak", BEAD_OPTION_CUSTOM, .shape = "force or none", .like = "force|none",
     .help = "take the largest force of `beads` in the first passage, which ends when the front reaches the end of the chain",
     .example = "force"},
    {"beads", BEAD_OPTION_CUSTOM, MEASURE(beads), .initial = "[3, 5]",
     .shape = "last, or [first, last], counted from the last random bead, with `over` from the striker",
     .like = "last|[2 number|last]", .read = read_places,
     .help = "the beads of which the largest force is taken; with `over`, by default the one in the middle of each chain",
     .example = "[1, 8]"},
    {"sensor", BEAD_OPTION_CUSTOM, .shape = "the name of a sensor, or a list of some", .like = "text|[text]", .read = read_sensors,
     .help = "take the peak force at these sensors instead", .example = "first"},
    {"decay", BEAD_OPTION_FLAG, MEASURE(decay), .initial = "false",
     .help = "also keep, for each bead, the peak force, the energy of the front at that time (of the bead and the four on either "
             "side), and force and energy at the end"},
};
const struct bead_options bead_sweep_measure_options = {"sweep.measure", "what is measured of each chain",
                                                        BEAD_OPTIONS(measure_rows), NULL, NULL};

static const char *const combinings[] = {"grid", "pairs", NULL};

#define OF_CHAIN(name, of, sample, kind)                                                                             \
    {                                                                                                                \
        .key = name, .type = BEAD_OPTION_CUSTOM, .shape = "as in chain", .help = of, .example = sample, .like = kind \
    }
static const struct bead_option rows[] = {
    {"name", BEAD_OPTION_TEXT, SWEEP(name), .initial = "", .help = "name of the sweep; required under `sweeps`", .example = "long"},
    {"cells", BEAD_OPTION_COUNT, SWEEP(asked), .low = 1, .high = 1000000,
     .help = "number of cells with random spins; without it, the random cells of `chain` are drawn anew for each configuration",
     .example = "64"},
    {"fixed", BEAD_OPTION_COUNT, SWEEP(fixed), .initial = BEAD_SWEEP_FIXED, .low = 0, .high = 1000000,
     .help = "how many cells follow, all up", .example = "10"},
    {"cell", BEAD_OPTION_CUSTOM, .shape = "[MATERIAL, MATERIAL, ...]", .like = "[text]",
     .help = "the beads of a cell; without it [large-steel, aluminium]", .example = "[large-steel, ptfe]"},
    {"magnetism", BEAD_OPTION_CUSTOM, .shape = "all, a number, or a list of numbers from 0 to 1", .like = "all|number|[number]",
     .help = "M = |up - down| / all, the nearest that the number of cells allows; all: each that it allows. Without it: all with "
             "`cells`, else as each segment of `chain` has it",
     .example = "[0, 0.5, 1]"},
    {"configurations", BEAD_OPTION_COUNT, SWEEP(configurations), .initial = "20", .low = 1, .high = 1000000,
     .help = "how many chains of each magnetism; one where all spins are the same", .example = "100"},
    {"seed", BEAD_OPTION_SEED, SWEEP(seed), .initial = "0",
     .help = "seed of all spins; the same seed gives the same spins on every machine", .example = "2009"},
    {"spins", BEAD_OPTION_CUSTOM, .shape = "a list such as [\"1101\", \"0110\"], one digit per random cell", .like = "[text]",
     .help = "the configurations, one by one, instead of magnetism", .example = "[\"1101\", \"0110\"]"},
    {"measure", BEAD_OPTION_CUSTOM, .initial = "{}", .shape = "a map", .like = "sweep.measure", .read = read_measure,
     .help = "see sweep.measure", .example = "{sensor: first}"},
    {"over", BEAD_OPTION_CUSTOM,
     .shape = "a map of keys of the scene, with a list of values each, whole numbers such as 1..50, or a range: see sweep.over",
     .like = "any",
     .help =
         "sweeps `chain` over the values of any keys that begin with chain, simulate or materials, instead of spins: one chain for "
         "each combination. Keys that end in `seed` are averaged over, so that every plot and table has means and quartiles of "
         "them. The scene as it is runs, too: its peak is the reference",
     .example = "{chain.striker.velocity: [0.5 m/s, 1 m/s], chain.beads.0.disorder.seed: 1..50}"},
    {"combine", BEAD_OPTION_CHOICE, SWEEP(over.combine), .choices = combinings, .initial = "grid",
     .help =
         "with several keys `over`; grid: every value of one with every value of the others; pairs: the first with the first, the "
         "second with the second, ..."},
    {"whole", BEAD_OPTION_FLAG, SWEEP(whole), .initial = "false",
     .help = "keep all beads to the end of each run; else those too far behind the front to change the measured peaks are dropped, "
             "which is faster"},
    OF_CHAIN("striker", "with `cells`: what strikes the chain; else as in `chain`", "{velocity: 1 m/s}", "chain.striker"),
    OF_CHAIN("wall", "with `cells`: the wall behind the last bead", "brass", "text|chain.wall"),
    OF_CHAIN("law", "with `cells`: the force between two beads", "thesis-appendix", "text|chain.law"),
    OF_CHAIN("precompression", "with `cells`: static force that presses the chain together", "10 N", "number"),
    OF_CHAIN("tilt", "with `cells`: slope of the chain, with its wall at the lower end", "3.5 deg", "number"),
    OF_CHAIN("damping", "with `cells`: forces against the relative motion of touching beads", "{coefficient: 10}", "chain.damping"),
};
const struct bead_options bead_sweep_options = {
    "sweep", "many chains with random spins; `sweeps` is a list of sweeps with a `name` each, shown together", BEAD_OPTIONS(rows),
    NULL, NULL};

static BEAD_OPTION_READER(read_places)
{
    static const struct bead_option place = {
        .type = BEAD_OPTION_COUNT, .low = 1, .high = 1000000, .word = "last", .word_value = 1e9};
    struct bead_sweep_measures *measures = settings;
    double beads[2] = {0, 0};
    BEAD_TRY(bead_read_pair(reader, at, &place, option->shape, beads));
    for (size_t i = 0; i < 2; i++)
        measures->beads[i] = beads[i] > place.high ? BEAD_LAST : (size_t)beads[i];
    return measures->beads[0] <= measures->beads[1]
               ? BEAD_OK
               : bead_wrong(reader, at, "is [%s, %s]; the first must not be greater than the last", at->node->items[0]->text,
                            at->node->items[1]->text);
}

static BEAD_OPTION_READER(read_sensors)
{
    struct bead_sweep_measures *measures = settings;
    bool list = at->node->kind == BEAD_NODE_LIST;
    size_t count = list ? at->node->count : 1;
    if (count == 0 || count > SENSORS)
        return bead_wrong(reader, at, "has %zu names; must have from 1 to %d", count, SENSORS);
    BEAD_TRY(bead_new(&measures->sensors, count, reader->msg, "the sensors of a sweep"));
    measures->sensor_count = count;
    for (size_t i = 0; i < count; i++) {
        struct bead_at element = bead_at_item(at, i);
        BEAD_TRY(bead_read_text(reader, &element, &measures->sensors[i]));
        for (size_t k = 0; k < i; k++) {
            if (strcmp(measures->sensors[k], measures->sensors[i]) == 0)
                return bead_wrong(reader, &element, "`%s` is in the list twice", measures->sensors[i]);
        }
    }
    return BEAD_OK;
}

static BEAD_OPTION_READER(read_measure)
{
    static const char *const peaks[] = {"force", "none", NULL};
    struct bead_sweep_measures *measures = &((struct bead_sweep_spec *)settings)->measures;
    enum bead_error err = bead_options_read(reader, at, &bead_sweep_measure_options, measures);
    struct bead_at peak = bead_at_key(at, "peak");
    unsigned chosen = 0;
    if (!err && bead_given(at, "peak"))
        err = bead_read_choice(reader, &peak, peaks, &chosen);
    measures->peak = chosen == 0;
    if (!err && !measures->peak && !measures->decay)
        err = bead_wrong(reader, &peak, "leaves nothing to measure; must be force, or go with `decay: true`");
    if (!err && measures->sensor_count > 0 && bead_given(at, "beads"))
        err = BEAD_WRONG_KEY(reader, at, "beads", "is given beside `sensor`; give one of them");
    return err;
}

/* ---- what needs the chain ---- */

static enum bead_error check_measure(const struct bead_reader *reader, const struct bead_at *at,
                                     const struct bead_sweep_spec *sweep)
{
    const struct bead_chain_spec *chain = &reader->scene->chains[sweep->chain];
    const struct bead_sweep_measures *measures = &sweep->measures;
    const struct bead_at measure = bead_at_key(at, "measure");
    size_t count = bead_scene_count_beads(chain), total = 0;
    for (size_t i = 0; i < measures->sensor_count; i++) {
        if (!bead_chain_spec_has_sensor(chain, measures->sensors[i]))
            return BEAD_WRONG_KEY(reader, &measure, "sensor", "`%s` is not a sensor of the chain", measures->sensors[i]);
    }
    if (measures->peak && measures->sensor_count == 0 && measures->beads[1] != BEAD_LAST &&
        sweep->last + measures->beads[1] > count)
        return BEAD_WRONG_KEY(reader, &measure, "beads", "reaches to bead %zu; the chain ends with bead %zu",
                              sweep->last + measures->beads[1], count);
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
    static const char *const with_cells[] = {"fixed", "cell", "striker", "wall", "law", "precompression", "tilt", "damping", NULL};
    return sweep->asked > 0
               ? BEAD_OK
               : bead_without(reader, at, with_cells, "belongs to `cells`, which is not given here; without it `chain` is swept");
}

/* The pattern, as a chain of the scene: from the keys here and those of `chain`. */
static enum bead_error read_pattern(struct bead_reader *reader, const struct bead_at *at, struct bead_sweep_spec *sweep)
{
    const struct bead_at *top = at->up;
    while (top->up)
        top = top->up;
    struct bead_at chain = bead_at_key(top, "chain");
    bool has_chain = bead_given(top, "chain");
    if (sweep->asked == 0 && !has_chain)
        return bead_wrong(reader, at, "has neither `cells` nor a `chain` to sweep; give one of them");
    if (sweep->asked == 0)
        return bead_scene_read_chain(reader, &chain, &reader->scene->chains[sweep->chain]);
    if (has_chain && bead_given(&chain, "beads"))
        return BEAD_WRONG_KEY(reader, &chain, "beads", "are given beside `cells` of the sweep; give one of them");
    struct bead_node *pattern = NULL;
    BEAD_TRY(bead_sweep_chain_node(reader->yaml, top->node, at->node, NULL, &pattern, reader->msg));
    struct bead_at built = {at->up, at->key, at->index, pattern};
    return bead_scene_read_chain(reader, &built, &reader->scene->chains[sweep->chain]);
}

/* ---- the configurations ---- */

/* Cells of the pattern: random ones, and others that count for the magnetism. */
struct cells {
    size_t random, given, up; /* given, up: not random */
};

static struct cells count_cells(const struct bead_chain_spec *chain, struct bead_sweep_spec *sweep)
{
    struct cells cells = {0, 0, 0};
    size_t bead = 0;
    for (size_t s = 0; s < chain->segment_count; s++) {
        const struct bead_segment *segment = &chain->segments[s];
        bead += segment->count * segment->cell_beads;
        if (segment->spins == BEAD_SPINS_RANDOM) {
            cells.random += segment->count;
            sweep->last = bead;
        } else if (segment->spins_given && segment->cell_beads > 1) {
            cells.given += segment->count;
            cells.up += segment->spins == BEAD_SPINS_UP ? segment->count : 0;
            for (size_t i = 0; segment->digits && i < segment->count; i++)
                cells.up += segment->digits[i] == '1';
        }
    }
    return cells;
}

static enum bead_error make_groups(const struct bead_reader *reader, struct bead_sweep_spec *sweep, size_t count)
{
    return bead_new(&sweep->groups, count, reader->msg, "a sweep");
}

/* Adds the group with `total` cells up; false: the fixed ones do not allow it. */
static bool add_group(struct bead_sweep_spec *sweep, const struct cells *cells, size_t total)
{
    double all = (double)(cells->random + cells->given);
    if (total < cells->up || total - cells->up > cells->random)
        return false;
    size_t up = total - cells->up;
    bool one_way = up == 0 || up == cells->random;
    sweep->groups[sweep->group_count++] =
        (struct bead_sweep_group){(2 * (double)total - all) / all, up, one_way ? 1 : sweep->configurations};
    return true;
}

static enum bead_error all_groups(const struct bead_reader *reader, struct bead_sweep_spec *sweep, const struct cells *cells)
{
    size_t all = cells->random + cells->given;
    BEAD_TRY(make_groups(reader, sweep, all / 2 + 1));
    for (size_t total = (all + 1) / 2; total <= all; total++)
        add_group(sweep, cells, total);
    return BEAD_OK;
}

static int by_magnetism(const void *a, const void *b)
{
    const struct bead_sweep_group *p = a, *q = b;
    return (p->up > q->up) - (p->up < q->up);
}

static enum bead_error list_groups(const struct bead_reader *reader, const struct bead_at *at, struct bead_sweep_spec *sweep,
                                   const struct cells *cells)
{
    static const struct bead_option number = {.low = 0, .high = 1};
    bool list = at->node->kind == BEAD_NODE_LIST;
    size_t count = list ? at->node->count : 1, all = cells->random + cells->given;
    if (count == 0)
        return bead_wrong(reader, at, "is an empty list; must be all, a number, or a list of numbers from 0 to 1");
    BEAD_TRY(make_groups(reader, sweep, count));
    for (size_t i = 0; i < count; i++) {
        const struct bead_at where = bead_at_item(at, i);
        double magnetism = 0;
        BEAD_TRY(bead_read_number(reader, &where, &number, &magnetism));
        size_t total = bead_spins_up(all, magnetism);
        for (size_t k = 0; k < i; k++) {
            if (sweep->groups[k].up + cells->up == total)
                return bead_wrong(reader, &where, "gives the same magnetism as another of the list, %.6g, with %zu cells",
                                  sweep->groups[k].magnetism, all);
        }
        if (!add_group(sweep, cells, total))
            return bead_wrong(reader, &where, "is out of reach: of %zu cells %zu are fixed, %zu of these up", all, cells->given,
                              cells->up);
    }
    qsort(sweep->groups, sweep->group_count, sizeof *sweep->groups, by_magnetism);
    return BEAD_OK;
}

/* One group of each configuration given. */
static enum bead_error given_groups(const struct bead_reader *reader, const struct bead_at *at, struct bead_sweep_spec *sweep)
{
    if (at->node->kind != BEAD_NODE_LIST || at->node->count == 0)
        return bead_must_be(reader, at, "a list such as [\"1101\", \"0110\"]");
    BEAD_TRY(bead_not_beside(reader, at, "magnetism"));
    BEAD_TRY(make_groups(reader, sweep, at->node->count));
    BEAD_TRY(bead_new(&sweep->spins, at->node->count, reader->msg, "a sweep"));
    for (size_t i = 0; i < at->node->count; i++) {
        struct bead_at element = bead_at_item(at, i);
        const char *digits = NULL;
        BEAD_TRY(bead_read_scalar(reader, &element, "one digit per random cell, 1 up and 0 down", &digits));
        if (strspn(digits, "01") != strlen(digits))
            return bead_must_be(reader, &element, "digits 0 and 1");
        if (strlen(digits) != sweep->cells)
            return bead_wrong(reader, &element, "has %zu digits; must have one for each of the %zu random cells", strlen(digits),
                              sweep->cells);
        size_t up = 0;
        for (size_t k = 0; k < sweep->cells; k++)
            up += digits[k] == '1';
        sweep->groups[sweep->group_count++] = (struct bead_sweep_group){NAN, up, 1};
        if (!(sweep->spins[i] = strdup(digits)))
            return bead_no_memory(reader);
    }
    return BEAD_OK;
}

/* Groups of one magnetism each, from `magnetism` or `spins` and the random cells of the chain, which has been read. */
static enum bead_error read_groups(const struct bead_reader *reader, const struct bead_at *at, struct bead_sweep_spec *sweep)
{
    struct cells cells = count_cells(&reader->scene->chains[sweep->chain], sweep);
    struct bead_at magnetism = bead_at_key(at, "magnetism"), spins = bead_at_key(at, "spins");
    const bool has_magnetism = bead_given(at, "magnetism");
    sweep->cells = cells.random;
    if (cells.random == 0)
        return bead_wrong(reader, at, "finds no `spins: random` to draw in `chain`; give some, or `cells`");
    if (bead_given(at, "spins"))
        return given_groups(reader, &spins, sweep);
    if (!has_magnetism && sweep->asked == 0) {
        BEAD_TRY(make_groups(reader, sweep, 1));
        sweep->groups[sweep->group_count++] = (struct bead_sweep_group){NAN, SIZE_MAX, sweep->configurations};
        sweep->own_magnetism = true;
        return BEAD_OK;
    }
    if (!has_magnetism || (magnetism.node->kind == BEAD_NODE_SCALAR && strcmp(magnetism.node->text, "all") == 0))
        return all_groups(reader, sweep, &cells);
    return list_groups(reader, &magnetism, sweep, &cells);
}

/* One group: a chain for each combination of values. Beads are counted from the striker, as there is no last random cell; by
 * default, the middle one is measured. */
static enum bead_error read_points(struct bead_reader *reader, const struct bead_at *at, struct bead_sweep_spec *sweep)
{
    static const char *const of_spins[] = {"cells", "magnetism", "configurations", "seed", "spins", NULL};
    struct bead_sweep_measures *measures = &sweep->measures;
    const struct bead_at over = bead_at_key(at, "over"), measure = bead_at_key(at, "measure");
    size_t points = 0;
    if (reader->scene->sweep_count > 1)
        return bead_wrong(reader, &over, "belongs to `sweep`, of which a scene has one");
    BEAD_TRY(bead_without(reader, at, of_spins, "belongs to sweeps over spins; with `over` the scene has the spins"));
    BEAD_TRY(bead_scene_read_over(reader, &over, &sweep->over, &points));
    BEAD_TRY(make_groups(reader, sweep, 1));
    sweep->groups[sweep->group_count++] = (struct bead_sweep_group){NAN, SIZE_MAX, points};
    if (measures->decay)
        return BEAD_WRONG_KEY(reader, &measure, "decay", "is one of spins, by magnetism: leave it out with `over`");
    if (measures->sensor_count == 0 && !(bead_given(at, "measure") && bead_given(&measure, "beads")))
        measures->beads[0] = measures->beads[1] = BEAD_MIDDLE;
    return BEAD_OK;
}

/* ---- the sweep ---- */

static enum bead_error read_sweep(struct bead_reader *reader, const struct bead_at *at, size_t index)
{
    struct bead_scene *scene = reader->scene;
    struct bead_sweep_spec *sweep = &scene->sweeps[index];
    sweep->chain = index;
    BEAD_TRY(bead_options_read(reader, at, &bead_sweep_options, sweep));
    BEAD_TRY(check_sweep_keys(reader, at, sweep));
    BEAD_TRY(read_pattern(reader, at, sweep));
    if (!scene->chains[index].system->has_contacts)
        return bead_wrong(reader, at, "needs a chain of beads: an equation has no spins");
    BEAD_TRY(bead_given(at, "over") ? read_points(reader, at, sweep) : read_groups(reader, at, sweep));
    return check_measure(reader, at, sweep);
}

static enum bead_error read_sweeps(struct bead_reader *reader, const struct bead_at *at, bool list)
{
    struct bead_scene *scene = reader->scene;
    size_t count = list ? at->node->count : 1;
    if (bead_given(at->up, "chains"))
        return BEAD_WRONG_KEY(reader, at->up, "chains",
                              "is given beside a sweep, which has one chain: give `chain`, or `sweeps` with `cells`");
    if (count == 0 || count > SWEEPS)
        return bead_wrong(reader, at, "has %zu sweeps; must have from 1 to %d", count, SWEEPS);
    BEAD_TRY(bead_new(&scene->sweeps, count, reader->msg, "%zu sweeps", count));
    scene->sweep_count = count;
    BEAD_TRY(bead_scene_make_chains(reader, count));
    for (size_t i = 0; i < count; i++) {
        struct bead_at element = list ? bead_at_item(at, i) : *at;
        BEAD_TRY(read_sweep(reader, &element, i));
        for (size_t k = 0; k < i; k++) {
            if (strcmp(scene->sweeps[k].name, scene->sweeps[i].name) == 0)
                return BEAD_WRONG_KEY(reader, &element, "name", "`%s` is the name of another sweep; names must differ",
                                      scene->sweeps[i].name);
        }
        if (list && !*scene->sweeps[i].name)
            return BEAD_WRONG_KEY(reader, &element, "name", "is missing: every sweep of a list needs a name");
    }
    return BEAD_OK;
}

BEAD_OPTION_READER(bead_scene_read_sweep)
{
    BEAD_TRY(bead_not_beside(reader, at, "sweeps"));
    return read_sweeps(reader, at, false);
}

BEAD_OPTION_READER(bead_scene_read_sweeps)
{
    if (at->node->kind != BEAD_NODE_LIST)
        return bead_must_be(reader, at, option->shape);
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
        bead_scene_free_over(&sweep->over);
        free(sweep->spins);
        free(sweep->groups);
        free(sweep->name);
        free(sweep->title);
    }
    free(scene->sweeps);
}
