/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lays overrides of the command line over a tree before it is read. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "sim/yaml/yaml_private.h"

/* One override being laid. */
struct edit {
    struct bead_yaml *yaml;
    const struct bead_override *override;
    const char *const *naming; /* keys whose values name elements of lists; NULL after the last */
    struct bead_message *msg;
};

static const char *end_of(const char *text)
{
    return text + strcspn(text, "=");
}

/* The column of a part of the path: in `path=value` if the value's column leaves room for the path before it, else 1. */
static size_t column_of(const struct edit *e, const char *at)
{
    const struct bead_override *o = e->override;
    const size_t length = (size_t)(end_of(o->path) - o->path) + 1;
    return o->place.column > length && at > o->path ? o->place.column - length + (size_t)(at - o->path) : 1;
}

static enum bead_error wrong(const struct edit *e, const char *at, const char *format, ...) BEAD_PRINTF(3, 4);
static enum bead_error wrong(const struct edit *e, const char *at, const char *format, ...)
{
    char what[160], path[96];
    va_list values;
    va_start(values, format);
    vsnprintf(what, sizeof what, format, values);
    va_end(values);
    snprintf(path, sizeof path, "%.*s", (int)(end_of(e->override->path) - e->override->path), e->override->path);
    return bead_fail(e->msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: %s: %s", e->yaml->origin, e->override->place.line, column_of(e, at),
                     path, what);
}

static enum bead_error out_of_memory(const struct edit *e)
{
    return bead_fail(e->msg, BEAD_ERROR_MEMORY, "%s: out of memory", e->yaml->name);
}

/* The names of an element of a list: the value of one of the naming keys, or, if that is a list, its elements; NULL after the last.
 */
static const char *element_name(const struct edit *e, const struct bead_node *element, size_t number)
{
    for (const char *const *key = e->naming; *key; key++) {
        const struct bead_node *value = bead_node_get(element, *key, NULL);
        bool list = value && value->kind == BEAD_NODE_LIST;
        if (!value || value->kind == BEAD_NODE_MAP)
            continue;
        if (number >= (list ? value->count : 1))
            return NULL;
        value = list ? value->items[number] : value;
        return value->kind == BEAD_NODE_SCALAR ? value->text : "";
    }
    return NULL;
}

/* Does `path` begin with `name`, followed by a dot or its end? File names contain dots, so names are compared as a whole. */
static bool begins_with(const char *path, const char *end, const char *name)
{
    size_t length = strlen(name);
    return length > 0 && length <= (size_t)(end - path) && memcmp(path, name, length) == 0 &&
           (path + length == end || path[length] == '.');
}

/* Find the slot of the element that `path` names; *used is the length of its name. */
static enum bead_error find_element(const struct edit *e, struct bead_node *list, const char *path, const char *end,
                                    struct bead_node ***slot, size_t *used)
{
    size_t digits = strspn(path, "0123456789");
    *slot = NULL;
    *used = 0;
    for (size_t i = 0; i < list->count; i++) {
        const char *name;
        for (size_t k = 0; (name = element_name(e, list->items[i], k)); k++) {
            if (!begins_with(path, end, name) || strlen(name) <= *used)
                continue;
            *slot = &list->items[i];
            *used = strlen(name);
        }
    }
    if (*slot)
        return BEAD_OK;
    if (digits > 0 && digits < 7 && (path + digits == end || path[digits] == '.')) {
        const size_t index = strtoul(path, NULL, 10);
        if (index >= list->count)
            return wrong(e, path, "the list has no element %zu; it has %zu, counted from 0", index, list->count);
        *slot = &list->items[index];
        *used = digits;
        return BEAD_OK;
    }
    if (*path == '+' && (path + 1 == end || path[1] == '.')) {
        struct bead_node *added = bead_yaml_node(e->yaml, BEAD_NODE_MAP, (struct bead_place){e->override->place.line, 1});
        if (!added || !bead_yaml_append(e->yaml, list, added))
            return out_of_memory(e);
        *slot = &list->items[list->count - 1];
        *used = 1;
        return BEAD_OK;
    }
    if (list->count == 0)
        return wrong(e, path, "the list is empty; `+` appends to it");
    return wrong(e, path, "no element of the list has this name; use an index from 0 to %zu, a name, or the name of its file",
                 list->count - 1);
}

/* Find the slot of the value of the key that `path` begins with; a missing key is added. */
static enum bead_error find_key(const struct edit *e, struct bead_node *map, const char *path, const char *end,
                                struct bead_node ***slot, size_t *used)
{
    const char *dot = memchr(path, '.', (size_t)(end - path));
    *used = (size_t)((dot ? dot : end) - path);
    if (*used == 0)
        return wrong(e, path, "a key is empty; a setting reads key.path=value");
    for (size_t i = 0; i + 1 < map->count; i += 2) {
        if (strlen(map->items[i]->text) == *used && memcmp(map->items[i]->text, path, *used) == 0) {
            *slot = &map->items[i + 1];
            return BEAD_OK;
        }
    }
    const struct bead_place place = {e->override->place.line, column_of(e, path)};
    if (!bead_yaml_put(e->yaml, map, path, *used, bead_yaml_node(e->yaml, BEAD_NODE_MAP, place)))
        return out_of_memory(e);
    *slot = &map->items[map->count - 1];
    return BEAD_OK;
}

/* Follow a path from *slot, which becomes the slot at its end. */
static enum bead_error follow(const struct edit *e, const char *path, struct bead_node ***slot)
{
    const char *end = end_of(path);
    for (size_t depth = 0; path <= end; depth++) {
        struct bead_node *node = **slot = (**slot)->was ? (**slot)->was : **slot;
        size_t used = 0;
        if (depth >= BEAD_YAML_DEPTH)
            return wrong(e, path, "nested too deeply; at most 32 levels are allowed");
        if (node->kind == BEAD_NODE_SCALAR && node->plain && !*node->text)
            node->kind = BEAD_NODE_MAP; /* `simulate:` with nothing after it */
        if (node->kind == BEAD_NODE_SCALAR)
            return wrong(e, path, "the key before it holds a single value, perhaps what was read of a file; set that as a whole");
        BEAD_TRY(node->kind == BEAD_NODE_LIST ? find_element(e, node, path, end, slot, &used)
                                              : find_key(e, node, path, end, slot, &used));
        path += used + 1;
    }
    return BEAD_OK;
}

static enum bead_error lay(const struct edit *e)
{
    const struct bead_override *o = e->override;
    struct bead_node *value = NULL, **slot = &e->yaml->root;
    if (!o->node)
        BEAD_TRY(bead_yaml_piece(e->yaml, o->value, strlen(o->value), o->place, &value, e->msg));
    else if (!(value = bead_yaml_copy(e->yaml, o->node, o->node->place, NULL)))
        return out_of_memory(e);
    if (o->below)
        BEAD_TRY(follow(e, o->below, &slot));
    if (*o->path)
        BEAD_TRY(follow(e, o->path, &slot));
    *slot = value;
    /* Recursion relies on a bounded depth. */
    if (bead_yaml_height(e->yaml->root) > BEAD_YAML_DEPTH)
        return wrong(e, o->path, "nested too deeply; at most 32 levels are allowed");
    return BEAD_OK;
}

enum bead_error bead_yaml_lay(struct bead_yaml *yaml, const struct bead_override *override, const char *const *naming,
                              struct bead_message *msg)
{
    const struct edit e = {yaml, override, naming, msg};
    yaml->origin = bead_yaml_text(yaml, override->origin, (size_t)(end_of(override->origin) - override->origin));
    enum bead_error err = yaml->origin ? lay(&e) : out_of_memory(&e);
    yaml->origin = NULL;
    return err;
}

enum bead_error bead_yaml_find(struct bead_yaml *yaml, const char *path, const char *const *naming, const struct bead_node **node,
                               struct bead_message *msg)
{
    const struct bead_override asked = {.origin = "", .path = path, .place = {1, 1}};
    const struct edit e = {yaml, &asked, naming, msg};
    struct bead_node **slot = &yaml->root;
    yaml->origin = "";
    enum bead_error err = follow(&e, path, &slot);
    yaml->origin = NULL;
    *node = *slot;
    return err;
}
