/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Trees of nodes: memory, look-ups, and their text in messages. Parser, editor and scene reader share these. */
#include <stdlib.h>

#include "sim/base/file.h"
#include "sim/base/text.h"
#include "sim/yaml/yaml_private.h"

enum { CHUNK = 16384 };

/* Nodes live as long as their document, so memory is taken from chunks and freed all at once. */
void *bead_yaml_take(struct bead_yaml *yaml, size_t size)
{
    size = (size + 15) & ~(size_t)15;
    if (!yaml->chunks || yaml->chunks->size - yaml->chunks->used < size) {
        size_t room = size > CHUNK ? size : CHUNK;
        struct bead_yaml_chunk *chunk = malloc(sizeof *chunk + room);
        if (!chunk)
            return NULL;
        *chunk = (struct bead_yaml_chunk){yaml->chunks, room, 0};
        yaml->chunks = chunk;
    }
    void *taken = yaml->chunks->bytes + yaml->chunks->used;
    yaml->chunks->used += size;
    return memset(taken, 0, size);
}

struct bead_node *bead_yaml_node(struct bead_yaml *yaml, enum bead_node_kind kind, struct bead_place place)
{
    if (yaml->nodes >= BEAD_YAML_NODES)
        return NULL;
    struct bead_node *node = bead_yaml_take(yaml, sizeof *node);
    if (!node)
        return NULL;
    yaml->nodes++;
    node->kind = kind;
    node->place = place;
    node->origin = yaml->origin;
    return node;
}

const char *bead_yaml_text(struct bead_yaml *yaml, const char *text, size_t length)
{
    char *copy = bead_yaml_take(yaml, length + 1);
    if (copy)
        memcpy(copy, text, length);
    return copy;
}

bool bead_yaml_append(struct bead_yaml *yaml, struct bead_node *parent, struct bead_node *item)
{
    size_t count = parent->count;
    /* The room doubles at each power of two, from 4 on. */
    if (count == 0 || (count >= 4 && (count & (count - 1)) == 0)) {
        size_t room = count < 4 ? 4 : 2 * count;
        struct bead_node **items = bead_yaml_take(yaml, room * sizeof(struct bead_node *));
        if (!items)
            return false;
        if (count)
            memcpy(items, parent->items, count * sizeof *items);
        parent->items = items;
    }
    parent->items[parent->count++] = item;
    return true;
}

struct bead_node *bead_yaml_scalar(struct bead_yaml *yaml, const char *text, size_t length, struct bead_place place)
{
    struct bead_node *node = bead_yaml_node(yaml, BEAD_NODE_SCALAR, place);
    return node && (node->text = bead_yaml_text(yaml, text, length)) ? node : NULL;
}

bool bead_yaml_put(struct bead_yaml *yaml, struct bead_node *map, const char *key, size_t length, struct bead_node *value)
{
    struct bead_node *name = value ? bead_yaml_scalar(yaml, key, length, value->place) : NULL;
    if (!name)
        return false;
    name->plain = true;
    name->origin = value->origin;
    return bead_yaml_append(yaml, map, name) && bead_yaml_append(yaml, map, value);
}

void bead_yaml_free(struct bead_yaml *yaml)
{
    if (!yaml)
        return;
    for (struct bead_yaml_chunk *chunk = yaml->chunks, *next; chunk; chunk = next) {
        next = chunk->next;
        free(chunk);
    }
    free(yaml->name);
    free(yaml);
}

struct bead_node *bead_yaml_root(const struct bead_yaml *yaml)
{
    return yaml->root;
}

const char *bead_yaml_name(const struct bead_yaml *yaml, const struct bead_node *node)
{
    return node && node->origin ? node->origin : yaml->name;
}

struct bead_node *bead_node_get(const struct bead_node *map, const char *key, struct bead_node **key_node)
{
    if (!map || map->kind != BEAD_NODE_MAP)
        return NULL;
    for (size_t i = 0; i + 1 < map->count; i += 2) {
        if (strcmp(map->items[i]->text, key) == 0) {
            if (key_node)
                *key_node = map->items[i];
            return map->items[i + 1];
        }
    }
    return NULL;
}

const char *bead_node_show(const struct bead_node *node, char *shown, size_t size)
{
    if (node->kind != BEAD_NODE_SCALAR)
        return node->kind == BEAD_NODE_LIST ? "a list" : "a map";
    if (node->plain && !*node->text)
        return "nothing";
    shown[0] = '`';
    bead_text_show(node->text, shown + 1, size - 2);
    strcat(shown, "`");
    return shown;
}

size_t bead_yaml_height(const struct bead_node *node)
{
    size_t most = 0;
    for (size_t i = 0; i < node->count; i++) {
        size_t height = bead_yaml_height(node->items[i]);
        most = height > most ? height : most;
    }
    return most + 1;
}

struct bead_node *bead_yaml_copy(struct bead_yaml *yaml, const struct bead_node *node, struct bead_place place, const char *origin)
{
    struct bead_node *made = bead_yaml_node(yaml, node->kind, place);
    if (!made || (node->text && !(made->text = bead_yaml_text(yaml, node->text, strlen(node->text)))))
        return NULL;
    made->plain = node->plain;
    made->flow = node->flow;
    made->origin = origin || !node->origin ? origin : bead_yaml_text(yaml, node->origin, strlen(node->origin));
    if (node->origin && !made->origin)
        return NULL;
    if (node->was && !(made->was = bead_yaml_copy(yaml, node->was, node->was->place, origin)))
        return NULL;
    for (size_t i = 0; i < node->count; i++) {
        struct bead_node *item = bead_yaml_copy(yaml, node->items[i], node->items[i]->place, origin);
        if (!item || !bead_yaml_append(yaml, made, item))
            return NULL;
    }
    return made;
}

char *bead_yaml_beside(const struct bead_yaml *yaml, const struct bead_node *node, const char *file)
{
    const char *name = bead_yaml_name(yaml, NULL), *slash = strrchr(name, '/');
    const bool option = node->origin && *node->origin == '-', beside = !option && *file != '/' && slash;
    char *path = NULL;
    return asprintf(&path, "%.*s%s", beside ? (int)(slash - name) + 1 : 0, name, file) < 0 ? NULL : path;
}

const char *bead_yaml_part(const struct bead_yaml *yaml, size_t index)
{
    return yaml->files && index < yaml->files->count ? yaml->files->items[index]->text : NULL;
}

enum bead_error bead_yaml_note_part(struct bead_yaml *yaml, const char *path, struct bead_message *msg)
{
    static const struct bead_place nowhere = {0, 0};
    const char *noted;
    for (size_t i = 0; (noted = bead_yaml_part(yaml, i)); i++) {
        if (strcmp(noted, path) == 0)
            return BEAD_OK;
    }
    if (!yaml->files)
        yaml->files = bead_yaml_node(yaml, BEAD_NODE_LIST, nowhere);
    struct bead_node *name = yaml->files ? bead_yaml_scalar(yaml, path, strlen(path), nowhere) : NULL;
    return name && bead_yaml_append(yaml, yaml->files, name) ? BEAD_OK
                                                             : bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", path);
}

enum bead_error bead_yaml_read_part(struct bead_yaml *yaml, const char *path, size_t most, char **text, size_t *length,
                                    struct bead_message *msg)
{
    BEAD_TRY(bead_yaml_note_part(yaml, path, msg));
    return bead_file_read(path, most, text, length, msg);
}

enum bead_error bead_yaml_duplicate(const struct bead_yaml *yaml, struct bead_yaml **made, struct bead_message *msg)
{
    struct bead_yaml *copy = *made = calloc(1, sizeof *copy);
    if (copy && (copy->name = strdup(yaml->name)) && (copy->root = bead_yaml_copy(copy, yaml->root, yaml->root->place, NULL)) &&
        (!yaml->files || (copy->files = bead_yaml_copy(copy, yaml->files, yaml->files->place, NULL))))
        return BEAD_OK;
    bead_yaml_free(copy);
    *made = NULL;
    return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", yaml->name);
}
