/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes a tree as YAML text, with libyaml's emitter: the scene with its overrides, which trajectories store. */
#include <stdio.h>
#include <stdlib.h>
#include <yaml.h>

#include "sim/yaml/yaml_private.h"

/* Add the node and all below it; returns its number in the document, 0: out of memory. The depth of trees is bounded. */
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

/* False: out of memory. */
static bool write_node(const struct bead_node *node, FILE *file)
{
    yaml_emitter_t emitter;
    if (!yaml_emitter_initialize(&emitter))
        return false;
    yaml_emitter_set_output_file(&emitter, file);
    yaml_emitter_set_encoding(&emitter, YAML_UTF8_ENCODING);
    yaml_emitter_set_unicode(&emitter, 1);
    yaml_emitter_set_width(&emitter, -1);
    yaml_document_t document;
    bool good = yaml_document_initialize(&document, NULL, NULL, NULL, 1, 1);
    if (good && !add(&document, node)) {
        yaml_document_delete(&document);
        good = false;
    }
    good = good && yaml_emitter_dump(&emitter, &document) && yaml_emitter_close(&emitter); /* dump deletes the document */
    yaml_emitter_delete(&emitter);
    return good;
}

enum bead_error bead_yaml_emit(const struct bead_yaml *yaml, const struct bead_node *node, char **text, struct bead_message *msg)
{
    size_t length = 0;
    *text = NULL;
    FILE *file = open_memstream(text, &length);
    const bool written = file && write_node(node, file);
    if (file && fclose(file) == 0 && written)
        return BEAD_OK;
    free(*text);
    *text = NULL;
    return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory for its changed text", yaml->name);
}
