/* SPDX-License-Identifier: GPL-3.0-or-later */
/* YAML documents as trees of nodes that know their line and column.
 *
 * Read with libyaml, event by event, so that size, depth and number of nodes are checked before memory is allocated. Aliases are
 * replaced by copies, so that an override changes one place only. Nodes belong to the document. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "beadreel/scene.h"
#include "sim/base/internal.h"

enum {
    BEAD_YAML_BYTES = 4 << 20, /* longest text */
    BEAD_YAML_NODES = 200000,  /* of a document, aliases copied out */
    BEAD_YAML_DEPTH = 32,      /* of nesting */
    BEAD_YAML_PAIRS = 1000,    /* of one map */
    BEAD_YAML_ANCHORS = 1000
};

enum bead_node_kind { BEAD_NODE_SCALAR, BEAD_NODE_LIST, BEAD_NODE_MAP };

struct bead_node {
    enum bead_node_kind kind;
    bool plain;               /* scalar without quotes */
    bool flow;                /* list or map in brackets */
    const char *origin;       /* NULL: the file; else the command line option that set it */
    struct bead_place place;  /* of an override: its number and the column in it */
    const char *text;         /* scalar, without NUL bytes */
    struct bead_node **items; /* list: elements; map: key, value, key, value, ... */
    size_t count;             /* of items: two a pair */
    struct bead_node *was;    /* the node before the contents of its file replaced it, which settings change; NULL: not replaced */
};

struct bead_yaml;

/* Parse the one document of `text`; messages call the file `name`. An empty text is an error.
 * On failure *yaml is NULL. Errors: SCENE (`name:line:column: ...`), MEMORY. */
BEAD_CHECK enum bead_error bead_yaml_parse(const char *name, const char *text, size_t length, struct bead_yaml **yaml,
                                           struct bead_message *msg);
void bead_yaml_free(struct bead_yaml *yaml);
BEAD_LEAVES(bead_yaml_left, struct bead_yaml, bead_yaml_free)
struct bead_node *bead_yaml_root(const struct bead_yaml *yaml);
/* `name` for messages about a node: that of the file, or of the option. */
const char *bead_yaml_name(const struct bead_yaml *yaml, const struct bead_node *node);

/* Parse a piece of text into a node of this document; its place counts from `place`, and its origin is --set unless the document
 * has another one now. */
BEAD_CHECK enum bead_error bead_yaml_piece(struct bead_yaml *yaml, const char *text, size_t length, struct bead_place place,
                                           struct bead_node **node, struct bead_message *msg);
/* Lay one override over the document. Elements of lists are named by index, by `+` (append), or by the value of one of the keys
 * `naming` (NULL after the last). Errors: SCENE (`--set:number:column: ...`), MEMORY. */
BEAD_CHECK enum bead_error bead_yaml_lay(struct bead_yaml *yaml, const struct bead_override *override, const char *const *naming,
                                         struct bead_message *msg);
/* The node at the end of a path like that of an override; an empty map if there is none, which is then a part of the document.
 * Errors: as above. */
BEAD_CHECK enum bead_error bead_yaml_find(struct bead_yaml *yaml, const char *path, const char *const *naming,
                                          const struct bead_node **node, struct bead_message *msg);
/* The path of a file that `node` names, to be freed: names in a document are relative to it, those in options
 * (--set, --output) to the working directory. NULL: no memory. */
char *bead_yaml_beside(const struct bead_yaml *yaml, const struct bead_node *node, const char *file);
/* Note the name of a file whose contents, or results made from it, are parts of the document. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_yaml_note_part(struct bead_yaml *yaml, const char *path, struct bead_message *msg);
/* Note the name, and read the file as bead_file_read does. */
BEAD_CHECK enum bead_error bead_yaml_read_part(struct bead_yaml *yaml, const char *path, size_t most, char **text, size_t *length,
                                               struct bead_message *msg);
/* The files noted so, from 0 on; NULL after the last. */
const char *bead_yaml_part(const struct bead_yaml *yaml, size_t index);
/* A document with a copy of the tree, and the names of its parts. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_yaml_duplicate(const struct bead_yaml *yaml, struct bead_yaml **made, struct bead_message *msg);
/* Write a node of the document as text, to be freed with free(). Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_yaml_emit(const struct bead_yaml *yaml, const struct bead_node *node, char **text,
                                          struct bead_message *msg);

/* Value of a key of a map, NULL if it has none; `key_node` (may be NULL) gets the key's node. */
struct bead_node *bead_node_get(const struct bead_node *map, const char *key, struct bead_node **key_node);
/* "a map", "a list", "`text`" (shortened, in one line): for messages; returns `shown`. */
const char *bead_node_show(const struct bead_node *node, char *shown, size_t size);

/* Make parts of trees; NULL if out of memory, or if the document has the largest number of nodes. */
struct bead_node *bead_yaml_node(struct bead_yaml *yaml, enum bead_node_kind kind, struct bead_place place);
const char *bead_yaml_text(struct bead_yaml *yaml, const char *text, size_t length);
struct bead_node *bead_yaml_scalar(struct bead_yaml *yaml, const char *text, size_t length, struct bead_place place);
/* A deep copy of a node, which may be another document's; its depth is bounded. `origin`: of the copies, owned by the document;
 * NULL: that of each node. */
struct bead_node *bead_yaml_copy(struct bead_yaml *yaml, const struct bead_node *node, struct bead_place place, const char *origin);
/* A key, of `length` bytes, with its value (NULL: false) at the end of a map. */
BEAD_CHECK bool bead_yaml_put(struct bead_yaml *yaml, struct bead_node *map, const char *key, size_t length,
                              struct bead_node *value);
BEAD_CHECK bool bead_yaml_append(struct bead_yaml *yaml, struct bead_node *parent, struct bead_node *item);
