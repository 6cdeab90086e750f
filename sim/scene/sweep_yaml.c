/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes of sweeps as trees: the chain of a sweep, the scene of one configuration, and a hash of the keys that matter to
 * results. */
#include "sim/scene/scene_internal.h"

#include <stdlib.h>

#include "sim/base/fingerprint.h"
#include "sim/base/memory.h"
#include "sim/base/suggest.h"

/* Keys of a chain that are taken from the sweep, or else from `chain`. */
static const char *const shared[] = {"striker", "start",  "wall",  "law",     "precompression", "gap",
                                     "tilt",    "cradle", "drive", "damping", "label"};

/* A tree being made. The first failure is kept, and nothing happens after it. */
struct maker {
    struct bead_yaml *yaml;
    struct bead_place place;
    bool failed;
};

static struct bead_node *make(struct maker *m, enum bead_node_kind kind, bool flow)
{
    struct bead_node *node = m->failed ? NULL : bead_yaml_node(m->yaml, kind, m->place);
    m->failed = !node;
    if (node)
        node->flow = flow;
    return node;
}

static struct bead_node *word(struct maker *m, const char *text, size_t length)
{
    struct bead_node *node = m->failed ? NULL : bead_yaml_scalar(m->yaml, text, length, m->place);
    m->failed = !node;
    return node;
}

/* The tree only grows at the ends of lists and maps; shared values stay as they are. */
static void add(struct maker *m, struct bead_node *list, const struct bead_node *item)
{
    m->failed = m->failed || !bead_yaml_append(m->yaml, list, (struct bead_node *)(uintptr_t)item);
}

/* Leaves out a key whose value is NULL. */
static void put(struct maker *m, struct bead_node *map, const char *key, const struct bead_node *value)
{
    if (value)
        m->failed = m->failed || !bead_yaml_put(m->yaml, map, key, strlen(key), (struct bead_node *)(uintptr_t)value);
}

/* Copies a map without some of its keys. */
static void put_rest(struct maker *m, struct bead_node *made, const struct bead_node *map, const char *const *left_out)
{
    for (size_t i = 0; i + 1 < map->count; i += 2) {
        if (!bead_is_one_of(map->items[i]->text, left_out))
            put(m, made, map->items[i]->text, map->items[i + 1]);
    }
}

static const struct bead_node *default_cell(struct maker *m)
{
    struct bead_node *cell = make(m, BEAD_NODE_LIST, true);
    add(m, cell, word(m, "large-steel", strlen("large-steel")));
    add(m, cell, word(m, "aluminium", strlen("aluminium")));
    return cell;
}

/* "0", "0.0" or any other zero; text that is not a number is refused when the count is read. */
static bool is_zero(const struct bead_node *number)
{
    char *end = NULL;
    return number && number->kind == BEAD_NODE_SCALAR && strtod(number->text, &end) == 0 && end != number->text && !*end;
}

/* Makes `cells` random cells and `fixed` more. */
static struct bead_node *made_beads(struct maker *m, const struct bead_node *sweep, const char *digits)
{
    const struct bead_node *cell = bead_node_get(sweep, "cell", NULL), *fixed = bead_node_get(sweep, "fixed", NULL);
    const char *spins = digits ? digits : "random";
    struct bead_node *beads = make(m, BEAD_NODE_LIST, false), *random = make(m, BEAD_NODE_MAP, true),
                     *rest = make(m, BEAD_NODE_MAP, true);
    cell = cell ? cell : default_cell(m);
    put(m, random, "cell", cell);
    put(m, random, "count", bead_node_get(sweep, "cells", NULL));
    put(m, random, "spins", word(m, spins, strlen(spins)));
    add(m, beads, random);
    if (is_zero(fixed))
        return beads;
    put(m, rest, "cell", cell);
    put(m, rest, "count", fixed ? fixed : word(m, BEAD_SWEEP_FIXED, strlen(BEAD_SWEEP_FIXED)));
    add(m, beads, rest);
    return beads;
}

static bool is_random(const struct bead_node *segment)
{
    const struct bead_node *spins = bead_node_get(segment, "spins", NULL);
    return spins && spins->kind == BEAD_NODE_SCALAR && strcmp(spins->text, "random") == 0;
}

/* Makes a segment with given spins. */
static const struct bead_node *settle(struct maker *m, const struct bead_node *segment, const char **digits)
{
    static const char *const left_out[] = {"spins", "magnetism", "seed", NULL};
    const struct bead_node *count = bead_node_get(segment, "count", NULL);
    size_t cells = count && count->kind == BEAD_NODE_SCALAR ? (size_t)strtod(count->text, NULL) : 1;
    struct bead_node *settled = make(m, BEAD_NODE_MAP, true);
    cells = cells < strlen(*digits) ? cells : strlen(*digits);
    put_rest(m, settled, segment, left_out);
    put(m, settled, "spins", word(m, *digits, cells));
    *digits += cells;
    return settled;
}

/* Makes the beads of the scene's own chain with the spins given. */
static const struct bead_node *own_beads(struct maker *m, const struct bead_node *beads, const char *digits)
{
    if (!digits || !beads || beads->kind != BEAD_NODE_LIST)
        return beads;
    struct bead_node *settled = make(m, BEAD_NODE_LIST, false);
    for (size_t i = 0; i < beads->count; i++)
        add(m, settled, is_random(beads->items[i]) ? settle(m, beads->items[i], &digits) : beads->items[i]);
    return settled;
}

enum bead_error bead_sweep_chain_node(struct bead_yaml *yaml, const struct bead_node *root, const struct bead_node *sweep,
                                      const char *digits, struct bead_node **chain, struct bead_message *msg)
{
    const struct bead_node *own = bead_node_get(root, "chain", NULL);
    struct maker m = {.yaml = yaml, .place = sweep->place};
    *chain = make(&m, BEAD_NODE_MAP, false);
    put(&m, *chain, "name", bead_node_get(sweep, "name", NULL));
    for (size_t i = 0; i < sizeof shared / sizeof *shared; i++) {
        const struct bead_node *value = bead_node_get(sweep, shared[i], NULL);
        put(&m, *chain, shared[i], value ? value : bead_node_get(own, shared[i], NULL));
    }
    const bool cells = bead_node_get(sweep, "cells", NULL);
    put(&m, *chain, "beads", cells ? made_beads(&m, sweep, digits) : own_beads(&m, bead_node_get(own, "beads", NULL), digits));
    return m.failed ? bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the chain of a sweep") : BEAD_OK;
}

const struct bead_node *bead_sweep_node(const struct bead_node *root, size_t index)
{
    const struct bead_node *one = bead_node_get(root, "sweep", NULL), *list = bead_node_get(root, "sweeps", NULL);
    if (one)
        return index == 0 ? one : NULL;
    return list && list->kind == BEAD_NODE_LIST && index < list->count ? list->items[index] : NULL;
}

enum bead_error bead_sweep_single_node(struct bead_yaml *yaml, size_t index, const char *digits, struct bead_node **scene,
                                       struct bead_message *msg)
{
    static const char *const replaced[] = {"sweep", "sweeps", "chain", "outputs", NULL};
    const struct bead_node *root = bead_yaml_root(yaml), *sweep = bead_sweep_node(root, index);
    struct bead_node *chain = NULL;
    if (!sweep)
        return bead_fail(msg, BEAD_ERROR_SCENE, "the scene has no sweep number %zu", index);
    struct maker m = {.yaml = yaml, .place = root->place};
    BEAD_TRY(bead_sweep_chain_node(yaml, root, sweep, digits, &chain, msg));
    *scene = make(&m, BEAD_NODE_MAP, false);
    put_rest(&m, *scene, root, replaced);
    put(&m, *scene, "chain", chain);
    return m.failed ? bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the scene of one configuration") : BEAD_OK;
}

enum bead_error bead_sweep_hash_scene(struct bead_yaml *yaml, uint64_t *hash, struct bead_message *msg)
{
    static const char *const unimportant[] = {"title", "outputs", NULL};
    const struct bead_node *root = bead_yaml_root(yaml);
    struct maker m = {.yaml = yaml, .place = root->place};
    struct bead_node *kept = make(&m, BEAD_NODE_MAP, false);
    BEAD_FREED char *rest = NULL;
    put_rest(&m, kept, root, unimportant);
    if (m.failed)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the fingerprint of a scene");
    BEAD_TRY(bead_yaml_emit(yaml, kept, &rest, msg));
    *hash = bead_fingerprint(*hash, rest, strlen(rest));
    return BEAD_OK;
}
