/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes of sweeps as YAML: the chain that a sweep means, the scene of one configuration, and what of the text matters to results.
 */
#include "sim/scene/sweep_yaml.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/fingerprint.h"

/* Keys of a chain that stand in the sweep, or else in `chain`. */
static const char *const shared[] = {"striker", "wall", "law", "precompression", "tilt", "damping", "label"};

/* A tree being made; the first failure is kept. */
struct maker {
    struct bead_yaml *yaml;
    struct bead_place place;
    bool failed;
};

static struct bead_node *make(struct maker *m, enum bead_node_kind kind)
{
    struct bead_node *node = m->failed ? NULL : bead_yaml_node(m->yaml, kind, m->place);
    m->failed = m->failed || !node;
    return node;
}

static struct bead_node *text_node(struct maker *m, const char *text, size_t length)
{
    struct bead_node *node = make(m, BEAD_NODE_SCALAR);
    if (node)
        node->text = bead_yaml_text(m->yaml, text, length);
    m->failed = m->failed || !node || !node->text;
    return node;
}

static void put(struct maker *m, struct bead_node *map, const char *key, const struct bead_node *value)
{
    struct bead_node *name = text_node(m, key, strlen(key));
    if (!m->failed)
        name->plain = true;
    /* The tree is written to the end of lists only; a value that is shared stays as it is. */
    m->failed =
        m->failed || !bead_yaml_append(m->yaml, map, name) || !bead_yaml_append(m->yaml, map, (struct bead_node *)(uintptr_t)value);
}

static void put_text(struct maker *m, struct bead_node *map, const char *key, const char *text, size_t length)
{
    struct bead_node *value = text_node(m, text, length);
    if (!m->failed)
        put(m, map, key, value);
}

static struct bead_node *default_cell(struct maker *m)
{
    static const char *const dimer[] = {"large-steel", "aluminium"};
    struct bead_node *cell = make(m, BEAD_NODE_LIST);
    for (size_t i = 0; i < 2 && !m->failed; i++) {
        struct bead_node *bead = text_node(m, dimer[i], strlen(dimer[i]));
        m->failed = m->failed || !bead_yaml_append(m->yaml, cell, bead);
    }
    if (!m->failed)
        cell->flow = true;
    return cell;
}

/* "0", "0.0" and whatever else is a zero; what is no number is refused where the count is read. */
static bool is_zero(const struct bead_node *number)
{
    char *end = NULL;
    return number->kind == BEAD_NODE_SCALAR && strtod(number->text, &end) == 0 && end != number->text && !*end;
}

/* `cells` random cells and `fixed` more. */
static struct bead_node *made_beads(struct maker *m, const struct bead_node *sweep, const char *digits)
{
    const struct bead_node *cell = bead_node_get(sweep, "cell", NULL), *fixed = bead_node_get(sweep, "fixed", NULL);
    const struct bead_node *count[2] = {bead_node_get(sweep, "cells", NULL), fixed};
    struct bead_node *beads = make(m, BEAD_NODE_LIST);
    if (!m->failed && !cell)
        cell = default_cell(m);
    if (!m->failed && !fixed)
        fixed = count[1] = text_node(m, BEAD_SWEEP_FIXED, strlen(BEAD_SWEEP_FIXED));
    for (size_t i = 0; i < 2 && !m->failed; i++) {
        struct bead_node *segment = make(m, BEAD_NODE_MAP);
        if (i == 1 && is_zero(fixed))
            break;
        m->failed = m->failed || !bead_yaml_append(m->yaml, beads, segment);
        if (m->failed)
            break;
        segment->flow = true;
        put(m, segment, "cell", cell);
        put(m, segment, "count", count[i]);
        if (i == 0 && digits)
            put_text(m, segment, "spins", digits, strlen(digits));
        else if (i == 0)
            put_text(m, segment, "spins", "random", 6);
    }
    return beads;
}

static bool is_random(const struct bead_node *segment)
{
    const struct bead_node *spins = bead_node_get(segment, "spins", NULL);
    return spins && spins->kind == BEAD_NODE_SCALAR && strcmp(spins->text, "random") == 0;
}

/* A segment whose spins are no longer random. */
static struct bead_node *settle(struct maker *m, const struct bead_node *segment, const char **digits)
{
    static const char *const left_out[] = {"spins", "magnetism", "seed"};
    const struct bead_node *count = bead_node_get(segment, "count", NULL);
    size_t cells = count && count->kind == BEAD_NODE_SCALAR ? (size_t)strtod(count->text, NULL) : 1;
    struct bead_node *settled = make(m, BEAD_NODE_MAP);
    for (size_t i = 0; i + 1 < segment->count && !m->failed; i += 2) {
        bool kept = true;
        for (size_t k = 0; k < 3; k++)
            kept = kept && strcmp(segment->items[i]->text, left_out[k]) != 0;
        if (kept)
            put(m, settled, segment->items[i]->text, segment->items[i + 1]);
    }
    cells = cells < strlen(*digits) ? cells : strlen(*digits);
    if (m->failed)
        return NULL;
    settled->flow = true;
    put_text(m, settled, "spins", *digits, cells);
    *digits += cells;
    return settled;
}

/* The beads of the scene's own chain with the spins given. */
static const struct bead_node *own_beads(struct maker *m, const struct bead_node *beads, const char *digits)
{
    if (!digits || !beads || beads->kind != BEAD_NODE_LIST)
        return beads;
    struct bead_node *settled = make(m, BEAD_NODE_LIST);
    for (size_t i = 0; i < beads->count && !m->failed; i++) {
        struct bead_node *segment = is_random(beads->items[i]) ? settle(m, beads->items[i], &digits) : beads->items[i];
        m->failed = m->failed || !bead_yaml_append(m->yaml, settled, segment);
    }
    return settled;
}

static struct bead_node *build(struct maker *m, const struct bead_node *root, const struct bead_node *sweep, const char *digits)
{
    const struct bead_node *chain = bead_node_get(root, "chain", NULL), *name = bead_node_get(sweep, "name", NULL);
    struct bead_node *built = make(m, BEAD_NODE_MAP);
    if (!m->failed && name)
        put(m, built, "name", name);
    for (size_t i = 0; i < sizeof shared / sizeof *shared && !m->failed; i++) {
        const struct bead_node *value = bead_node_get(sweep, shared[i], NULL);
        value = value ? value : bead_node_get(chain, shared[i], NULL);
        if (value)
            put(m, built, shared[i], value);
    }
    const struct bead_node *beads = m->failed ? NULL
                                    : bead_node_get(sweep, "cells", NULL)
                                        ? made_beads(m, sweep, digits)
                                        : own_beads(m, bead_node_get(chain, "beads", NULL), digits);
    if (beads && !m->failed)
        put(m, built, "beads", beads);
    return built;
}

enum bead_error bead_sweep_chain_node(struct bead_yaml *yaml, const struct bead_node *root, const struct bead_node *sweep,
                                      const char *digits, struct bead_node **chain, struct bead_message *msg)
{
    struct maker m = {.yaml = yaml, .place = sweep->place};
    *chain = build(&m, root, sweep, digits);
    return m.failed ? bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the chain of a sweep") : BEAD_OK;
}

const struct bead_node *bead_sweep_node(const struct bead_node *root, size_t index)
{
    const struct bead_node *one = bead_node_get(root, "sweep", NULL), *list = bead_node_get(root, "sweeps", NULL);
    if (one)
        return index == 0 ? one : NULL;
    return list && list->kind == BEAD_NODE_LIST && index < list->count ? list->items[index] : NULL;
}

/* A map like `root` without some of its keys. */
static void keep_keys(struct maker *m, const struct bead_node *root, const char *const *left_out, struct bead_node *kept)
{
    for (size_t i = 0; i + 1 < root->count && !m->failed; i += 2) {
        bool keep = true;
        for (const char *const *key = left_out; *key; key++)
            keep = keep && strcmp(root->items[i]->text, *key) != 0;
        if (keep)
            put(m, kept, root->items[i]->text, root->items[i + 1]);
    }
}

static enum bead_error single(struct bead_yaml *yaml, size_t index, const char *digits, const char *outputs, char **text,
                              struct bead_message *msg)
{
    static const char *const replaced[] = {"sweep", "sweeps", "chain", "outputs", NULL};
    struct bead_node *root = bead_yaml_root(yaml), *chain = NULL, *wanted = NULL;
    const struct bead_node *sweep = bead_sweep_node(root, index);
    if (!sweep)
        return bead_fail(msg, BEAD_ERROR_SCENE, "the scene has no sweep number %zu", index);
    struct maker m = {.yaml = yaml, .place = root->place};
    struct bead_node *kept = make(&m, BEAD_NODE_MAP);
    enum bead_error err = bead_sweep_chain_node(yaml, root, sweep, digits, &chain, msg);
    if (!err)
        err = bead_yaml_piece(yaml, outputs, strlen(outputs), root->place, &wanted, msg);
    if (err)
        return err;
    if (!m.failed)
        keep_keys(&m, root, replaced, kept);
    if (!m.failed)
        put(&m, kept, "chain", chain);
    if (!m.failed)
        put(&m, kept, "outputs", wanted);
    if (m.failed)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the scene of one configuration");
    *root = *kept; /* the document is only written from here on */
    return bead_yaml_emit(yaml, text, msg);
}

enum bead_error bead_sweep_single_text(const char *text, size_t index, const char *digits, const char *outputs, char **made,
                                       struct bead_message *msg)
{
    struct bead_yaml *yaml = NULL;
    *made = NULL;
    enum bead_error err = bead_yaml_parse("scene", text, strlen(text), &yaml, msg);
    if (!err)
        err = single(yaml, index, digits, outputs, made, msg);
    bead_yaml_free(yaml);
    return err;
}

enum bead_error bead_sweep_hash_scene(const char *text, uint64_t *hash, struct bead_message *msg)
{
    static const char *const unimportant[] = {"title", "outputs", NULL};
    struct bead_yaml *yaml = NULL;
    char *rest = NULL;
    enum bead_error err = bead_yaml_parse("scene", text, strlen(text), &yaml, msg);
    if (err)
        return err;
    struct bead_node *root = bead_yaml_root(yaml);
    struct maker m = {.yaml = yaml, .place = root->place};
    struct bead_node *kept = make(&m, BEAD_NODE_MAP);
    if (!m.failed)
        keep_keys(&m, root, unimportant, kept);
    if (m.failed) {
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the fingerprint of a scene");
    } else {
        *root = *kept;
        err = bead_yaml_emit(yaml, &rest, msg);
    }
    if (!err)
        *hash = bead_fingerprint(*hash, rest, strlen(rest));
    free(rest);
    bead_yaml_free(yaml);
    return err;
}
