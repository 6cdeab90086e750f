/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Settings of the command line: `key.path=value` changes a tree before it is read. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "sim/base/yaml_private.h"

static const char set[] = "--set";

/* One setting being applied. */
struct edit {
    struct bead_yaml *yaml;
    const char *setting; /* the whole, without its option */
    const char *origin;  /* "--set" */
    size_t number;
    const char *const *naming; /* keys by the values of which elements of lists are named; NULL behind the last */
    struct bead_message *msg;
};

/* Of --set the column of the setting, of other options that of their value. */
static size_t column_of(const struct edit *e, const char *at)
{
    const char *value = strchr(e->setting, '=') + 1, *from = strcmp(e->origin, set) == 0 ? e->setting : value;
    return at > from ? (size_t)(at - from) + 1 : 1;
}

static enum bead_error wrong(const struct edit *e, const char *at, const char *format, ...) BEAD_PRINTF(3, 4);
static enum bead_error wrong(const struct edit *e, const char *at, const char *format, ...)
{
    char what[160], path[96];
    va_list values;
    va_start(values, format);
    vsnprintf(what, sizeof what, format, values);
    va_end(values);
    snprintf(path, sizeof path, "%.*s", (int)strcspn(e->setting, "="), e->setting);
    return bead_fail(e->msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: %s: %s", e->origin, e->number, column_of(e, at), path, what);
}

static enum bead_error out_of_memory(const struct edit *e)
{
    return bead_fail(e->msg, BEAD_ERROR_MEMORY, "--set: out of memory");
}

/* Texts by which an element of a list can be named: the value of one of the naming keys, or its elements; NULL behind the last. */
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

/* Does `path` begin with `name`, up to a dot or its end? File names contain dots, so names are tried whole. */
static bool begins_with(const char *path, const char *end, const char *name)
{
    size_t length = strlen(name);
    return length > 0 && length <= (size_t)(end - path) && memcmp(path, name, length) == 0 &&
           (path + length == end || path[length] == '.');
}

/* Place of the element that `path` names; *used is the length of its name. */
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
        size_t index = 0;
        for (size_t i = 0; i < digits; i++)
            index = 10 * index + (size_t)(path[i] - '0');
        if (index >= list->count)
            return wrong(e, path, "there is no element %zu: there are %zu, counted from 0", index, list->count);
        *slot = &list->items[index];
        *used = digits;
        return BEAD_OK;
    }
    if (*path == '+' && (path + 1 == end || path[1] == '.')) {
        struct bead_node *added = bead_yaml_node(e->yaml, BEAD_NODE_MAP, (struct bead_place){e->number, 1});
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

/* Place of the value of the key that `path` begins with; made where the map has no such key. */
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
    struct bead_place place = {e->number, column_of(e, path)};
    struct bead_node *key = bead_yaml_node(e->yaml, BEAD_NODE_SCALAR, place);
    struct bead_node *value = bead_yaml_node(e->yaml, BEAD_NODE_MAP, place);
    if (!key || !value || !(key->text = bead_yaml_text(e->yaml, path, *used)))
        return out_of_memory(e);
    key->plain = true;
    if (!bead_yaml_append(e->yaml, map, key) || !bead_yaml_append(e->yaml, map, value))
        return out_of_memory(e);
    *slot = &map->items[map->count - 1];
    return BEAD_OK;
}

/* Follow the path from the root; *slot is where the value belongs. */
static enum bead_error follow(const struct edit *e, const char *end, struct bead_node ***slot)
{
    const char *path = e->setting;
    for (size_t depth = 0; path <= end; depth++) {
        struct bead_node *node = **slot;
        size_t used = 0;
        if (depth >= BEAD_YAML_DEPTH)
            return wrong(e, path, "nested too deeply: at most 32 levels are allowed");
        if (node->kind == BEAD_NODE_SCALAR && node->plain && !*node->text)
            node->kind = BEAD_NODE_MAP; /* `simulate:` with nothing behind it */
        if (node->kind == BEAD_NODE_SCALAR)
            return wrong(e, path, "the key before it holds a single value; set that as a whole");
        enum bead_error err = node->kind == BEAD_NODE_LIST ? find_element(e, node, path, end, slot, &used)
                                                           : find_key(e, node, path, end, slot, &used);
        if (err)
            return err;
        path += used + 1;
    }
    return BEAD_OK;
}

/* Takes the option off a setting that names one. */
static enum bead_error take_origin(struct edit *e)
{
    const size_t length = strcspn(e->setting, ":=");
    if (strncmp(e->setting, "--", 2) != 0 || e->setting[length] != ':')
        return BEAD_OK;
    e->origin = bead_yaml_text(e->yaml, e->setting, length);
    e->setting += length + 1;
    e->number = 1;
    return e->origin ? BEAD_OK : out_of_memory(e);
}

static enum bead_error apply(const struct edit *e)
{
    const char *equals = strchr(e->setting, '=');
    char shown[64];
    if (!equals || equals == e->setting)
        return bead_fail(e->msg, BEAD_ERROR_SCENE, "--set:%zu:1: `%s` is not of the form key.path=value", e->number,
                         bead_text_show(e->setting, shown, sizeof shown));
    struct bead_node *value = NULL, **slot = &e->yaml->root;
    enum bead_error err = bead_yaml_piece(e->yaml, equals + 1, strlen(equals + 1),
                                          (struct bead_place){e->number, column_of(e, equals + 1)}, &value, e->msg);
    if (!err)
        err = follow(e, equals, &slot);
    if (err)
        return err;
    *slot = value;
    /* The whole keeps within the depth that recursion relies on. */
    if (bead_yaml_height(e->yaml->root) > BEAD_YAML_DEPTH)
        return wrong(e, e->setting, "nested too deeply: at most 32 levels are allowed");
    return BEAD_OK;
}

enum bead_error bead_yaml_set(struct bead_yaml *yaml, const char *setting, size_t number, const char *const *naming,
                              struct bead_message *msg)
{
    struct edit e = {yaml, setting, set, number, naming, msg};
    enum bead_error err = take_origin(&e);
    if (err)
        return err;
    yaml->origin = e.origin;
    err = apply(&e);
    yaml->origin = NULL;
    return err;
}
