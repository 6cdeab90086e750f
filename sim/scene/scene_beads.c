/* `beads`: the segments of a chain, left to right. */
#include <stdlib.h>
#include <string.h>

#include "sim/scene/scene_private.h"

static enum bead_error read_bead(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                 void *settings);
static enum bead_error read_cell(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                 void *settings);
static enum bead_error read_spins(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                  void *settings);

static const struct bead_option rows[] = {
    {.key = "bead",
     .type = BEAD_OPTION_CUSTOM,
     .shape = "the name of a material",
     .help = "beads of one material",
     .example = "large-steel",
     .read = read_bead},
    {.key = "cell",
     .type = BEAD_OPTION_CUSTOM,
     .shape = "[MATERIAL, MATERIAL, ...]",
     .help = "beads that repeat as a group: two for dimers, three for trimers, or more",
     .example = "[large-steel, aluminium]",
     .read = read_cell},
    {.key = "count",
     .type = BEAD_OPTION_COUNT,
     .offset = offsetof(struct bead_segment, count),
     .low = 1,
     .high = BEAD_SCENE_BEADS,
     .help = "how many beads or cells; without it 1, or the number of digits of `spins`",
     .example = "64"},
    {.key = "spins",
     .type = BEAD_OPTION_CUSTOM,
     .initial = "up",
     .shape = "up, down, random, or one digit per cell such as \"1101\"",
     .help = "which way round each cell stands: up (1) as written, down (0) reversed",
     .example = "random",
     .read = read_spins},
    {.key = "magnetism",
     .offset = offsetof(struct bead_segment, magnetism),
     .initial = "0",
     .low = 0,
     .high = 1,
     .help = "magnetism of random spins, (up - down) / all, as exactly as the count allows",
     .example = "0.5"},
    {.key = "seed",
     .type = BEAD_OPTION_SEED,
     .offset = offsetof(struct bead_segment, seed),
     .initial = "0",
     .help = "seed of random spins; the same seed gives the same spins on every machine",
     .example = "7"},
    {.key = "sensor",
     .type = BEAD_OPTION_TEXT,
     .offset = offsetof(struct bead_segment, sensor),
     .help = "name of a sensor in this single bead, which records its bead force",
     .example = "first"},
};

const struct bead_options bead_segment_options = {"chain.beads", "entries of the list, from left to right", BEAD_OPTIONS(rows),
                                                  NULL, NULL};

static enum bead_error read_bead(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                 void *settings)
{
    struct bead_segment *segment = settings;
    (void)option;
    segment->cell = calloc(1, sizeof *segment->cell);
    if (!segment->cell)
        return bead_no_memory(reader);
    segment->cell_beads = 1;
    return bead_scene_find_material(reader, at, true, segment->cell);
}

static enum bead_error read_cell(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                 void *settings)
{
    struct bead_segment *segment = settings;
    struct bead_at bead = bead_at_key(at->up, "bead");
    char shown[64];
    if (bead.node != at->up->node)
        return bead_wrong(reader, at, "is given beside `bead`; give one of them");
    if (at->node->kind != BEAD_NODE_LIST || at->node->count == 0)
        return bead_wrong(reader, at, "is %s; must be %s",
                          at->node->kind == BEAD_NODE_LIST ? "an empty list" : bead_node_show(at->node, shown, sizeof shown),
                          option->shape);
    segment->cell = calloc(at->node->count, sizeof *segment->cell);
    if (!segment->cell)
        return bead_no_memory(reader);
    segment->cell_beads = at->node->count;
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; i < at->node->count && !err; i++) {
        struct bead_at element = {at, NULL, i, at->node->items[i]};
        err = bead_scene_find_material(reader, &element, true, &segment->cell[i]);
    }
    return err;
}

static enum bead_error read_spins(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                  void *settings)
{
    static const struct {
        const char *word;
        enum bead_spins spins;
    } words[] = {{"up", BEAD_SPINS_UP}, {"down", BEAD_SPINS_DOWN}, {"random", BEAD_SPINS_RANDOM}};
    struct bead_segment *segment = settings;
    const char *text = NULL;
    char shown[64];
    enum bead_error err = bead_read_scalar(reader, at, option->shape, &text);
    if (err)
        return err;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        if (strcmp(text, words[i].word) == 0) {
            segment->spins = words[i].spins;
            return BEAD_OK;
        }
    }
    if (!*text || strspn(text, "01") != strlen(text))
        return bead_wrong(reader, at, "is %s; must be %s", bead_node_show(at->node, shown, sizeof shown), option->shape);
    segment->spins = BEAD_SPINS_DIGITS;
    segment->digits = strdup(text);
    return segment->digits ? BEAD_OK : bead_no_memory(reader);
}

/* Keys that only make sense together. */
static enum bead_error check_spins(const struct bead_reader *reader, const struct bead_at *at, struct bead_segment *segment)
{
    static const char *const of_random[] = {"magnetism", "seed"};
    struct bead_at where = bead_at_key(at, "spins");
    segment->spins_given = where.node != at->node;
    if (where.node != at->node && segment->cell_beads < 2)
        return bead_wrong(reader, &where, "needs a `cell` of at least two beads: a single bead cannot be turned around");
    for (size_t i = 0; i < 2 && segment->spins != BEAD_SPINS_RANDOM; i++) {
        where = bead_at_key(at, of_random[i]);
        if (where.node != at->node)
            return bead_wrong(reader, &where, "belongs to `spins: random`, which is not given here");
    }
    return BEAD_OK;
}

static enum bead_error check_count(const struct bead_reader *reader, const struct bead_at *at, struct bead_segment *segment)
{
    struct bead_at count = bead_at_key(at, "count"), spins = bead_at_key(at, "spins"), sensor = bead_at_key(at, "sensor");
    size_t digits = segment->digits ? strlen(segment->digits) : 1;
    if (count.node == at->node)
        segment->count = digits;
    else if (segment->digits && digits != segment->count)
        return bead_wrong(reader, &spins, "has %zu digits, but `count` is %zu; must have one digit per cell", digits,
                          segment->count);
    if (segment->count > BEAD_SCENE_BEADS / segment->cell_beads)
        return bead_wrong(reader, &count, "gives more than %d beads, the most that is allowed", BEAD_SCENE_BEADS);
    if (segment->sensor && segment->count * segment->cell_beads != 1)
        return bead_wrong(reader, &sensor, "must be on a single bead: without `cell` and `count`");
    if (segment->sensor && !*segment->sensor)
        return bead_wrong(reader, &sensor, "has no name; must be a word such as `first`");
    return BEAD_OK;
}

static enum bead_error read_segment(struct bead_reader *reader, const struct bead_at *at, struct bead_segment *segment)
{
    segment->place = at->node->place;
    enum bead_error err = bead_options_read(reader, at, &bead_segment_options, segment);
    if (!err && segment->cell_beads == 0)
        err = bead_wrong(reader, at, "has neither `bead` nor `cell`; give one of them");
    if (!err)
        err = check_spins(reader, at, segment);
    return err ? err : check_count(reader, at, segment);
}

static int by_name(const void *a, const void *b)
{
    const struct bead_segment *const *p = a, *const *q = b;
    int order = strcmp((*p)->sensor, (*q)->sensor);
    return order ? order : (*p > *q) - (*p < *q);
}

/* Two sensors of one name could not be told apart. */
static enum bead_error check_sensors(const struct bead_reader *reader, const struct bead_at *at,
                                     const struct bead_chain_spec *chain)
{
    const struct bead_segment **sensors = calloc(chain->segment_count, sizeof(struct bead_segment *));
    size_t count = 0;
    enum bead_error err = BEAD_OK;
    if (!sensors)
        return bead_no_memory(reader);
    for (size_t i = 0; i < chain->segment_count; i++) {
        if (chain->segments[i].sensor)
            sensors[count++] = &chain->segments[i];
    }
    qsort(sensors, count, sizeof *sensors, by_name);
    for (size_t i = 1; i < count && !err; i++) {
        if (strcmp(sensors[i]->sensor, sensors[i - 1]->sensor) != 0)
            continue;
        size_t index = (size_t)(sensors[i] - chain->segments);
        struct bead_at element = {at, NULL, index, at->node->items[index]}, where = bead_at_key(&element, "sensor");
        err = bead_wrong(reader, &where, "`%s` is the name of another sensor of this chain; names must differ", sensors[i]->sensor);
    }
    free(sensors);
    return err;
}

enum bead_error bead_scene_read_segments(struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                         void *settings)
{
    struct bead_chain_spec *chain = settings;
    char shown[64];
    size_t beads = 0;
    if (at->node->kind != BEAD_NODE_LIST)
        return bead_wrong(reader, at, "is %s; must be %s", bead_node_show(at->node, shown, sizeof shown), option->shape);
    if (at->node->count == 0)
        return bead_wrong(reader, at, "is an empty list: at least one bead is needed behind the striker");
    chain->segments = calloc(at->node->count, sizeof *chain->segments);
    if (!chain->segments)
        return bead_no_memory(reader);
    chain->segment_count = at->node->count;
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; i < at->node->count && !err; i++) {
        struct bead_at element = {at, NULL, i, at->node->items[i]};
        err = read_segment(reader, &element, &chain->segments[i]);
        beads += err ? 0 : chain->segments[i].cell_beads * chain->segments[i].count;
        if (!err && beads > BEAD_SCENE_BEADS)
            err = bead_wrong(reader, &element, "makes the chain longer than %d beads, the most that is allowed", BEAD_SCENE_BEADS);
    }
    return err ? err : check_sensors(reader, at, chain);
}

size_t bead_scene_count_beads(const struct bead_chain_spec *chain)
{
    size_t beads = 0;
    for (size_t i = 0; i < chain->segment_count; i++)
        beads += chain->segments[i].cell_beads * chain->segments[i].count;
    return beads;
}
