/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `beads`: the segments of a chain, left to right. */
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/scene/scene_internal.h"
#include "sim/scene/scene_private.h"

static BEAD_OPTION_READER(read_bead);
static BEAD_OPTION_READER(read_cell);
static BEAD_OPTION_READER(read_spins);
static BEAD_OPTION_READER(read_group);

/* Entries, with groups repeated. */
enum { MOST_ENTRIES = 40000 };

/* One entry, as written. */
struct written {
    struct bead_segment segment;
    struct bead_variation variation;
    size_t decoration; /* material; SIZE_MAX: none */
    size_t repeat;
    struct bead_chain_spec *chain;
    size_t first; /* its first segment in the chain */
};
#define SEGMENT(member) offsetof(struct written, segment.member)
#define VARIED(...)     BEAD_VARIED_ROW(offsetof(struct written, variation), __VA_ARGS__)

static const struct bead_option rows[] = {
    {"bead", BEAD_OPTION_CUSTOM, .shape = "the name of a material", .like = "text", .read = read_bead,
     .help = "beads of one material", .example = "large-steel"},
    {"cell", BEAD_OPTION_CUSTOM, .shape = "[MATERIAL, MATERIAL, ...]", .like = "[text]", .read = read_cell,
     .help = "beads that repeat as a group: two for dimers, three for trimers, or more; `2 ptfe` is two beads of ptfe",
     .example = "[large-steel, 2 ptfe]"},
    {"count", BEAD_OPTION_COUNT, SEGMENT(count), .low = 1, .high = BEAD_SCENE_BEADS,
     .help = "how many beads or cells; without it 1, or the number of digits of `spins`", .example = "64"},
    {"spins", BEAD_OPTION_CUSTOM, .initial = "up", .shape = "up, down, random, or one digit per cell such as \"1101\"",
     .like = "text", .read = read_spins, .help = "orientation of each cell: up (1) as written, down (0) reversed",
     .example = "random"},
    {"magnetism", BEAD_OPTION_NUMBER, SEGMENT(magnetism), .initial = "0", .low = 0, .high = 1,
     .help = "magnetism of random spins, |up - down| / all, as exactly as the count allows", .example = "0.5"},
    {"seed", BEAD_OPTION_SEED, SEGMENT(seed), .initial = "0",
     .help = "seed of random spins; the same seed gives the same spins on every machine", .example = "7"},
    {"sensor", BEAD_OPTION_TEXT, SEGMENT(sensor), .help = "name of a sensor in this single bead, which records its bead force",
     .example = "first"},
    VARIED(BEAD_VARIED_RADIUS, "radius", "m", 1e-9, 1e3, 0,
           "radius of these beads, instead of that of the material; the mass follows with the density", "3 mm", BEAD_USUAL_RADIUS),
    VARIED(BEAD_VARIED_MASS, "mass", "kg", 0, 1e9, BEAD_OPEN_LOW, "mass of each of these beads, instead of that of the material",
           "2 g"),
    VARIED(BEAD_VARIED_MODULUS, "modulus", "Pa", 1, 1e15, 0, "Young's modulus of these beads, instead of that of the material",
           "70 GPa", BEAD_USUAL_MODULUS),
    VARIED(BEAD_VARIED_GAP, "gap", "m", 0, 1e3, 0,
           "free space to the left of each of these beads, besides the gap of the chain; the first of the chain has none, because "
           "the striker touches it at time 0. For random gaps see chain.beads.disorder",
           "10 um"),
    VARIED(BEAD_VARIED_SPRING, "spring", "N/m", 0, 1e30, 0,
           "stiffness of a spring that holds each of these beads at its place: force against its displacement. For pendulums see "
           "chain.cradle",
           "300 N/m"),
    {"taper", BEAD_OPTION_CUSTOM, offsetof(struct written, variation), .unit = "1", .low = -1, .high = 1, .open = BEAD_OPEN_HIGH,
     .shape = "from -100 % to below 100 %, or {from: RADIUS, to: RADIUS}", .like = "number|chain.beads.taper",
     .read = bead_scene_read_taper,
     .help = "each bead is smaller than the one before by this part of its radius (larger, if negative), or the radii go from end "
             "to end by the same factor: see chain.beads.taper",
     .example = "5 %"},
    {"disorder", BEAD_OPTION_MAP, offsetof(struct written, variation), .map = &bead_disorder_options,
     .help = "beads that differ at random: see chain.beads.disorder", .example = "{radius: uniform 0.3..1, seed: 7}"},
    {"decorate", BEAD_OPTION_CUSTOM, offsetof(struct written, decoration), .shape = "the name of a material", .like = "text",
     .read = bead_scene_read_material, .help = "a bead of this between every two of `bead`; taper and disorder leave it as it is",
     .example = "small-steel"},
    {"repeat", BEAD_OPTION_COUNT, offsetof(struct written, repeat), .low = 1, .high = BEAD_SCENE_BEADS,
     .help = "how many times the entries `of` follow each other; random spins are the same each time", .example = "3"},
    {"of", BEAD_OPTION_CUSTOM, .shape = "a list of entries", .like = "[chain.beads]", .read = read_group,
     .help = "a group: entries as in `beads`, instead of `bead` or `cell`; radius, mass, modulus, gap, spring, taper and disorder "
             "apply to the whole",
     .example = "[{bead: brass, count: 5}, {cell: [large-steel, ptfe], count: 2}]"},
};

const struct bead_options bead_segment_options = {"chain.beads", "entries of the list, from left to right", BEAD_OPTIONS(rows),
                                                  NULL, NULL};

static BEAD_OPTION_READER(read_bead)
{
    struct bead_segment *segment = &((struct written *)settings)->segment;
    BEAD_TRY(bead_new(&segment->cell, 1, reader->msg, "a bead"));
    segment->cell_beads = 1;
    return bead_scene_find_material(reader, at, true, segment->cell);
}

static BEAD_OPTION_READER(read_cell)
{
    struct bead_segment *segment = &((struct written *)settings)->segment;
    BEAD_TRY(bead_not_beside(reader, at, "bead"));
    return bead_scene_read_cell(reader, at, &segment->cell, &segment->cell_beads);
}

static BEAD_OPTION_READER(read_spins)
{
    static const struct {
        const char *word;
        enum bead_spins spins;
    } words[] = {{"up", BEAD_SPINS_UP}, {"down", BEAD_SPINS_DOWN}, {"random", BEAD_SPINS_RANDOM}};
    struct bead_segment *segment = &((struct written *)settings)->segment;
    const char *text = NULL;
    BEAD_TRY(bead_read_scalar(reader, at, option->shape, &text));
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        if (strcmp(text, words[i].word) == 0) {
            segment->spins = words[i].spins;
            return BEAD_OK;
        }
    }
    if (!*text || strspn(text, "01") != strlen(text))
        return bead_must_be(reader, at, option->shape);
    segment->spins = BEAD_SPINS_DIGITS;
    segment->digits = strdup(text);
    return segment->digits ? BEAD_OK : bead_no_memory(reader);
}

/* Keys that only make sense together. */
static enum bead_error check_spins(const struct bead_reader *reader, const struct bead_at *at, struct bead_segment *segment)
{
    static const char *const of_random[] = {"magnetism", "seed", NULL};
    segment->spins_given = bead_given(at, "spins");
    if (segment->spins_given && segment->cell_beads < 2)
        return BEAD_WRONG_KEY(reader, at, "spins", "needs a `cell` of at least two beads: a single bead cannot be turned around");
    return segment->spins == BEAD_SPINS_RANDOM
               ? BEAD_OK
               : bead_without(reader, at, of_random, "belongs to `spins: random`, which is not given here");
}

static enum bead_error check_count(const struct bead_reader *reader, const struct bead_at *at, struct bead_segment *segment)
{
    size_t digits = segment->digits ? strlen(segment->digits) : 1;
    if (!bead_given(at, "count"))
        segment->count = digits;
    else if (segment->digits && digits != segment->count)
        return BEAD_WRONG_KEY(reader, at, "spins", "has %zu digits, but `count` is %zu; must have one digit per cell", digits,
                              segment->count);
    if (segment->count > BEAD_SCENE_BEADS / segment->cell_beads)
        return BEAD_WRONG_KEY(reader, at, "count", "gives more than %d beads, the most that is allowed", BEAD_SCENE_BEADS);
    if (segment->sensor && segment->count * segment->cell_beads != 1)
        return BEAD_WRONG_KEY(reader, at, "sensor", "must be on a single bead: without `cell` and `count`");
    if (segment->sensor && !*segment->sensor)
        return BEAD_WRONG_KEY(reader, at, "sensor", "has no name; must be a word such as `first`");
    return BEAD_OK;
}

/* ---- entries ---- */

/* Appends a segment to the chain, which owns it from now on. Room doubles at each power of two. */
static enum bead_error push(const struct bead_reader *reader, struct bead_chain_spec *chain, const struct bead_segment *segment)
{
    const size_t count = chain->segment_count;
    if ((count & (count - 1)) == 0) {
        struct bead_segment *grown = realloc(chain->segments, (count ? 2 * count : 1) * sizeof *grown);
        if (!grown)
            return bead_no_memory(reader);
        chain->segments = grown;
    }
    chain->segments[chain->segment_count++] = *segment;
    return BEAD_OK;
}

void bead_scene_free_segment(struct bead_segment *segment)
{
    free(segment->cell);
    free(segment->each);
    free(segment->digits);
    free(segment->sensor);
}

static size_t *copy_materials(const size_t *materials, size_t count)
{
    size_t *copy = materials ? calloc(count, sizeof *copy) : NULL;
    if (copy)
        memcpy(copy, materials, count * sizeof *copy);
    return copy;
}

/* Appends a copy of a segment to the chain. */
static enum bead_error push_copy(const struct bead_reader *reader, struct bead_chain_spec *chain, size_t index)
{
    const struct bead_segment *from = &chain->segments[index];
    struct bead_segment made = *from;
    made.cell = copy_materials(from->cell, from->cell_beads);
    made.each = copy_materials(from->each, from->cell_beads * from->count);
    made.digits = from->digits ? strdup(from->digits) : NULL;
    made.sensor = from->sensor ? strdup(from->sensor) : NULL;
    const bool good = made.cell && !from->each == !made.each && !from->digits == !made.digits && !from->sensor == !made.sensor;
    enum bead_error err = good ? push(reader, chain, &made) : bead_no_memory(reader);
    if (err)
        bead_scene_free_segment(&made);
    return err;
}

/* Puts beads of a material between those of the last segment: cells of two, and a last bead. */
static enum bead_error decorate(const struct bead_reader *reader, const struct bead_at *at, struct written *w)
{
    struct bead_segment *all = &w->chain->segments[w->chain->segment_count - 1];
    const size_t beads = all->count;
    if (w->decoration == SIZE_MAX)
        return BEAD_OK;
    if (all->cell_beads != 1 || beads < 2)
        return BEAD_WRONG_KEY(reader, at, "decorate", "needs two or more of a `bead`, between which it can be placed");
    BEAD_TRY(push_copy(reader, w->chain, w->chain->segment_count - 1));
    all = &w->chain->segments[w->chain->segment_count - 2];
    struct bead_segment *last = all + 1;
    size_t *cell = calloc(2, sizeof *cell), *each = all->each ? calloc(2 * beads, sizeof *each) : NULL;
    if (!cell || !each != !all->each) {
        free(cell);
        free(each);
        return bead_no_memory(reader);
    }
    cell[0] = all->cell[0];
    cell[1] = w->decoration;
    last->cell[0] = all->each ? all->each[beads - 1] : all->cell[0];
    for (size_t i = 0; each && i < 2 * (beads - 1); i++)
        each[i] = i % 2 ? w->decoration : all->each[i / 2];
    free(all->cell);
    free(all->each);
    free(last->each);
    all->cell = cell;
    all->each = each;
    all->cell_beads = 2;
    all->count = beads - 1;
    last->each = NULL;
    last->count = 1;
    return BEAD_OK;
}

static enum bead_error check_length(const struct bead_reader *reader, const struct bead_at *at, const struct bead_chain_spec *chain,
                                    size_t times)
{
    const size_t beads = bead_scene_count_beads(chain);
    if (beads > BEAD_SCENE_BEADS / times)
        return bead_wrong(reader, at, "makes the chain longer than %d beads, the most that is allowed", BEAD_SCENE_BEADS);
    if (chain->segment_count > MOST_ENTRIES / times)
        return bead_wrong(reader, at, "makes %zu entries of `beads` in all; at most %d are allowed", times * chain->segment_count,
                          MOST_ENTRIES);
    return BEAD_OK;
}

/* Keys of single entries must not be given beside `of`, nor those of groups without it. */
static enum bead_error check_group(const struct bead_reader *reader, const struct bead_at *at, bool group)
{
    static const char *const of_single[] = {"bead", "cell", "count", "spins", "magnetism", "seed", "sensor", "decorate", NULL},
                             *const of_groups[] = {"repeat", NULL};
    return group ? bead_without(reader, at, of_single, "is given beside `of`; it belongs in the entries there")
                 : bead_without(reader, at, of_groups, "belongs to `of`, a list of entries; for equal beads or cells give `count`");
}

static enum bead_error read_list(struct bead_reader *reader, const struct bead_at *at, struct bead_chain_spec *chain,
                                 const char *shape);

static BEAD_OPTION_READER(read_group)
{
    struct written *w = settings;
    return read_list(reader, at, w->chain, option->shape);
}

/* Sweeps give spins only to entries of `beads`, not of groups. */
static enum bead_error check_random(const struct bead_reader *reader, const struct bead_at *at, const struct written *w)
{
    for (size_t i = w->first; i < w->chain->segment_count && bead_sweep_node(bead_yaml_root(reader->yaml), 0); i++) {
        if (w->chain->segments[i].spins == BEAD_SPINS_RANDOM)
            return bead_wrong(reader, at, "holds random cells, which in a sweep must be entries of `beads` itself");
    }
    return BEAD_OK;
}

/* Repeats the group `repeat` times. */
static enum bead_error repeat(const struct bead_reader *reader, const struct bead_at *at, struct written *w)
{
    const size_t each = w->chain->segment_count - w->first;
    struct bead_at where = bead_at_key(at, "repeat");
    BEAD_TRY(check_random(reader, at, w));
    BEAD_TRY(check_length(reader, &where, w->chain, w->repeat));
    for (size_t i = each; i < w->repeat * each; i++)
        BEAD_TRY(push_copy(reader, w->chain, w->first + i - each));
    return BEAD_OK;
}

/* Applies the keys of an entry to its segments, which belong to the chain. */
static enum bead_error finish_entry(struct bead_reader *reader, const struct bead_at *at, struct written *w, bool group)
{
    struct bead_chain_spec *chain = w->chain;
    BEAD_TRY(bead_scene_vary_alike(reader, at, &w->variation, &chain->segments[w->first], chain->segment_count - w->first));
    if (group)
        BEAD_TRY(repeat(reader, at, w));
    BEAD_TRY(bead_scene_vary_each(reader, at, &w->variation, &chain->segments[w->first], chain->segment_count - w->first));
    if (!group)
        BEAD_TRY(decorate(reader, at, w));
    return check_length(reader, at, chain, 1);
}

static enum bead_error read_entry(struct bead_reader *reader, const struct bead_at *at, struct bead_chain_spec *chain)
{
    struct written w = {.segment.place = at->node->place,
                        .variation = bead_variation_none,
                        .decoration = SIZE_MAX,
                        .repeat = 1,
                        .chain = chain,
                        .first = chain->segment_count};
    const bool group = at->node->kind == BEAD_NODE_MAP && bead_node_get(at->node, "of", NULL);
    enum bead_error err = bead_options_read(reader, at, &bead_segment_options, &w);
    if (!err)
        err = check_group(reader, at, group);
    if (!err && !group && w.segment.cell_beads == 0)
        err = bead_wrong(reader, at, "has neither `bead` nor `cell`; give one of them");
    if (!err && !group)
        err = check_spins(reader, at, &w.segment);
    if (!err && !group)
        err = check_count(reader, at, &w.segment);
    if (!err && !group)
        err = push(reader, chain, &w.segment);
    if (err || group)
        bead_scene_free_segment(&w.segment);
    if (!err)
        err = finish_entry(reader, at, &w, group);
    free(w.variation.materials);
    return err;
}

static enum bead_error read_list(struct bead_reader *reader, const struct bead_at *at, struct bead_chain_spec *chain,
                                 const char *shape)
{
    if (at->node->kind != BEAD_NODE_LIST)
        return bead_must_be(reader, at, shape);
    if (at->node->count == 0)
        return bead_wrong(reader, at, "is an empty list: at least one bead is needed%s", at->up->up ? " behind the striker" : "");
    enum bead_error err = BEAD_OK, kept = BEAD_OK;
    for (size_t i = 0; bead_reads_on(reader, err, &kept) && i < at->node->count; i++) {
        struct bead_at element = bead_at_item(at, i);
        err = read_entry(reader, &element, chain);
    }
    return kept;
}

static int by_name(const void *a, const void *b)
{
    const struct bead_segment *const *p = a, *const *q = b;
    int order = strcmp((*p)->sensor, (*q)->sensor);
    return order ? order : (*p > *q) - (*p < *q);
}

/* The segment's entry in the list, or the list itself if the entry is in a group. */
static struct bead_at entry_of(const struct bead_at *at, const struct bead_segment *segment)
{
    for (size_t i = 0; i < at->node->count; i++) {
        const struct bead_node *entry = at->node->items[i];
        if (entry->place.line == segment->place.line && entry->place.column == segment->place.column)
            return (struct bead_at){at, NULL, i, entry};
    }
    return *at;
}

/* Sensors of one chain must have different names. */
static enum bead_error check_sensors(const struct bead_reader *reader, const struct bead_at *at,
                                     const struct bead_chain_spec *chain)
{
    BEAD_FREED const struct bead_segment **sensors = NULL;
    size_t count = 0;
    BEAD_TRY(bead_new(&sensors, chain->segment_count, reader->msg, "sensors"));
    for (size_t i = 0; i < chain->segment_count; i++) {
        if (chain->segments[i].sensor)
            sensors[count++] = &chain->segments[i];
    }
    qsort(sensors, count, sizeof *sensors, by_name);
    for (size_t i = 1; i < count; i++) {
        if (strcmp(sensors[i]->sensor, sensors[i - 1]->sensor) != 0)
            continue;
        struct bead_at entry = entry_of(at, sensors[i]);
        return BEAD_WRONG_KEY(reader, &entry, "sensor", "`%s` is the name of another sensor of this chain; names must differ",
                              sensors[i]->sensor);
    }
    return BEAD_OK;
}

BEAD_OPTION_READER(bead_scene_read_segments)
{
    struct bead_chain_spec *chain = settings;
    BEAD_TRY(read_list(reader, at, chain, option->shape));
    return check_sensors(reader, at, chain);
}
