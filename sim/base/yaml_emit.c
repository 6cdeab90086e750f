/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes a tree as YAML text, through libyaml's emitter: the scene as changed by settings, which trajectories store. */
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

#include "sim/base/yaml_private.h"

struct buffer {
    char *text;
    size_t used, room;
};

static int append(void *data, unsigned char *bytes, size_t size)
{
    struct buffer *buffer = data;
    if (buffer->room - buffer->used <= size) {
        size_t room = 2 * (buffer->used + size) + 256;
        char *text = realloc(buffer->text, room);
        if (!text)
            return 0;
        buffer->text = text;
        buffer->room = room;
    }
    memcpy(buffer->text + buffer->used, bytes, size);
    buffer->used += size;
    buffer->text[buffer->used] = 0;
    return 1;
}

/* The node and all below it; returns its number in the document, 0: no memory. Depth is bounded where trees are made. */
static int add(yaml_document_t *document, const struct bead_node *node)
{
    int made, item[2] = {1, 1};
    if (node->kind == BEAD_NODE_SCALAR)
        return yaml_document_add_scalar(document, NULL, (const yaml_char_t *)node->text, (int)strlen(node->text),
                                        node->plain ? YAML_PLAIN_SCALAR_STYLE : YAML_DOUBLE_QUOTED_SCALAR_STYLE);
    bool map = node->kind == BEAD_NODE_MAP;
    made = map ? yaml_document_add_mapping(document, NULL, node->flow ? YAML_FLOW_MAPPING_STYLE : YAML_BLOCK_MAPPING_STYLE)
               : yaml_document_add_sequence(document, NULL, node->flow ? YAML_FLOW_SEQUENCE_STYLE : YAML_BLOCK_SEQUENCE_STYLE);
    for (size_t i = 0; made && i < node->count; i++) {
        item[i % 2] = add(document, node->items[i]);
        bool added = item[i % 2];
        if (added && map && i % 2 == 1)
            added = yaml_document_append_mapping_pair(document, made, item[0], item[1]);
        else if (added && !map)
            added = yaml_document_append_sequence_item(document, made, item[i % 2]);
        if (!added)
            return 0;
    }
    return made;
}

enum bead_error bead_yaml_emit(const struct bead_yaml *yaml, char **text, struct bead_message *msg)
{
    yaml_emitter_t emitter;
    struct buffer buffer = {0};
    *text = NULL;
    if (!yaml_emitter_initialize(&emitter))
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", yaml->name);
    yaml_emitter_set_output(&emitter, append, &buffer);
    yaml_emitter_set_encoding(&emitter, YAML_UTF8_ENCODING);
    yaml_emitter_set_unicode(&emitter, 1);
    yaml_emitter_set_width(&emitter, -1);
    yaml_document_t document;
    bool good = yaml_document_initialize(&document, NULL, NULL, NULL, 1, 1);
    if (good && !add(&document, yaml->root)) {
        yaml_document_delete(&document);
        good = false;
    }
    good = good && yaml_emitter_dump(&emitter, &document) && yaml_emitter_close(&emitter) && buffer.text; /* dump deletes it */
    yaml_emitter_delete(&emitter);
    if (!good) {
        free(buffer.text);
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory for its changed text", yaml->name);
    }
    *text = buffer.text;
    return BEAD_OK;
}
