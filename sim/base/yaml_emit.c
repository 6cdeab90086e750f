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

static bool emit_scalar(yaml_emitter_t *emitter, const struct bead_node *node)
{
    yaml_event_t event;
    yaml_scalar_style_t style = node->plain ? YAML_PLAIN_SCALAR_STYLE : YAML_DOUBLE_QUOTED_SCALAR_STYLE;
    return yaml_scalar_event_initialize(&event, NULL, NULL, (const yaml_char_t *)node->text, (int)strlen(node->text), 1, 1,
                                        style) &&
           yaml_emitter_emit(emitter, &event);
}

/* Depth is bounded where trees are made. */
static bool emit_node(yaml_emitter_t *emitter, const struct bead_node *node)
{
    yaml_event_t event;
    bool map = node->kind == BEAD_NODE_MAP;
    if (node->kind == BEAD_NODE_SCALAR)
        return emit_scalar(emitter, node);
    int begun = map ? yaml_mapping_start_event_initialize(&event, NULL, NULL, 1,
                                                          node->flow ? YAML_FLOW_MAPPING_STYLE : YAML_BLOCK_MAPPING_STYLE)
                    : yaml_sequence_start_event_initialize(&event, NULL, NULL, 1,
                                                           node->flow ? YAML_FLOW_SEQUENCE_STYLE : YAML_BLOCK_SEQUENCE_STYLE);
    if (!begun || !yaml_emitter_emit(emitter, &event))
        return false;
    for (size_t i = 0; i < node->count; i++) {
        if (!emit_node(emitter, node->items[i]))
            return false;
    }
    int ended = map ? yaml_mapping_end_event_initialize(&event) : yaml_sequence_end_event_initialize(&event);
    return ended && yaml_emitter_emit(emitter, &event);
}

static bool emit_document(yaml_emitter_t *emitter, const struct bead_node *root)
{
    yaml_event_t event;
    return yaml_stream_start_event_initialize(&event, YAML_UTF8_ENCODING) && yaml_emitter_emit(emitter, &event) &&
           yaml_document_start_event_initialize(&event, NULL, NULL, NULL, 1) && yaml_emitter_emit(emitter, &event) &&
           emit_node(emitter, root) && yaml_document_end_event_initialize(&event, 1) && yaml_emitter_emit(emitter, &event) &&
           yaml_stream_end_event_initialize(&event) && yaml_emitter_emit(emitter, &event) && yaml_emitter_flush(emitter);
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
    bool good = emit_document(&emitter, yaml->root) && buffer.text;
    yaml_emitter_delete(&emitter);
    if (!good) {
        free(buffer.text);
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory for its changed text", yaml->name);
    }
    *text = buffer.text;
    return BEAD_OK;
}
