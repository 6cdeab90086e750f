/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parses YAML text into trees of nodes, from libyaml's events; the scene reader starts here. */
#include "sim/yaml/yaml.h"

#include <stdlib.h>
#include <yaml.h>

#include "sim/base/text.h"
#include "sim/yaml/yaml_private.h"

/* The state of a parse. */
struct builder {
    struct bead_yaml *yaml;
    yaml_parser_t *parser;
    const char *text;
    size_t length;
    struct bead_place origin; /* of a piece: the place of its first character; 0: a whole document */
    struct bead_message *msg;
    size_t depth;
    struct bead_node *open[BEAD_YAML_DEPTH];
    struct bead_node *root;
    size_t anchor_count;
    struct {
        const char *name; /* owned by the document */
        const struct bead_node *node;
    } * anchors;
};

static struct bead_place place_of(const struct builder *b, yaml_mark_t mark)
{
    struct bead_place place = {mark.line + 1, mark.column + 1};
    if (b->origin.line) {
        place.line = b->origin.line;
        place.column = mark.line == 0 ? b->origin.column + mark.column : mark.column + 1;
    }
    return place;
}

static const char *file_name(const struct builder *b)
{
    return b->yaml->origin ? b->yaml->origin : b->yaml->name;
}

static enum bead_error wrong(const struct builder *b, yaml_mark_t mark, const char *what)
{
    struct bead_place place = place_of(b, mark);
    return bead_fail(b->msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: %s", file_name(b), place.line, place.column, what);
}

static enum bead_error out_of_memory(const struct builder *b)
{
    return bead_fail(b->msg, BEAD_ERROR_MEMORY, "%s: out of memory", file_name(b));
}

/* A node could not be made: too many, or no memory. */
static enum bead_error no_node(const struct builder *b, yaml_mark_t mark)
{
    if (b->yaml->nodes >= BEAD_YAML_NODES)
        return wrong(b, mark, "there are too many entries; at most 200000 are allowed, counting aliases as copies");
    return out_of_memory(b);
}

/* The usual cause of an error of libyaml. */
static const char *hint(const char *problem)
{
    static const char quotes[] = "; a text with a colon, comma or bracket in it must be in \"quotes\"";
    static const struct {
        const char *problem, *hint;
    } hints[] = {
        {"found character that cannot start any token",
         "; lines are indented with spaces, not tabs, and @, % or ` begin only texts in \"quotes\""},
        {"did not find expected ',' or '}'", quotes},
        {"did not find expected ',' or ']'", quotes},
        {"invalid leading UTF-8 octet", "; a scene is a text in UTF-8, which a picture or a film is not"},
        {"mapping values are not allowed in this context",
         "; is a colon missing in the line before? A text with a colon in it must be in \"quotes\""},
        {"could not find expected ':'", "; a key ends with a colon and a space: is one missing here, or in the line before?"},
    };
    for (size_t i = 0; problem && i < sizeof hints / sizeof hints[0]; i++) {
        if (strcmp(problem, hints[i].problem) == 0)
            return hints[i].hint;
    }
    return "";
}

/* An error of libyaml. Its reader gives a byte offset only, so lines are counted here. */
static enum bead_error parser_wrong(const struct builder *b)
{
    const yaml_parser_t *parser = b->parser;
    if (parser->error == YAML_MEMORY_ERROR)
        return out_of_memory(b);
    yaml_mark_t mark = parser->problem_mark;
    if (parser->error == YAML_READER_ERROR) {
        mark = (yaml_mark_t){0};
        for (size_t i = 0; i < parser->problem_offset && i < b->length; i++) {
            mark.column = b->text[i] == '\n' ? 0 : mark.column + (((unsigned char)b->text[i] & 0xc0) != 0x80);
            mark.line += b->text[i] == '\n';
        }
    }
    char what[256];
    snprintf(what, sizeof what, "not YAML: %s%s%s%s", parser->context ? parser->context : "", parser->context ? ", " : "",
             parser->problem ? parser->problem : "unreadable", hint(parser->problem));
    return wrong(b, mark, what);
}

static enum bead_error check_key(const struct builder *b, const struct bead_node *map, const struct bead_node *key,
                                 yaml_mark_t mark)
{
    char shown[64], what[160];
    if (key->kind != BEAD_NODE_SCALAR)
        return wrong(b, mark, "a key must be a word, not a list or a map");
    if (map->count / 2 >= BEAD_YAML_PAIRS)
        return wrong(b, mark, "there are too many keys in one map; at most 1000 are allowed");
    if (!bead_node_get(map, key->text, NULL))
        return BEAD_OK;
    snprintf(what, sizeof what, "%s: is given twice; give it once", bead_text_show(key->text, shown, sizeof shown));
    return wrong(b, mark, what);
}

/* Add a finished or opened node to its parent. */
static enum bead_error place_node(struct builder *b, struct bead_node *node, yaml_mark_t mark)
{
    if (b->depth == 0) {
        b->root = node;
        return BEAD_OK;
    }
    struct bead_node *parent = b->open[b->depth - 1];
    if (parent->kind == BEAD_NODE_MAP && parent->count % 2 == 0) {
        BEAD_TRY(check_key(b, parent, node, mark));
    }
    return bead_yaml_append(b->yaml, parent, node) ? BEAD_OK : out_of_memory(b);
}

static enum bead_error remember(struct builder *b, const yaml_char_t *anchor, const struct bead_node *node, yaml_mark_t mark)
{
    if (!anchor)
        return BEAD_OK;
    if (b->anchor_count >= BEAD_YAML_ANCHORS)
        return wrong(b, mark, "there are too many anchors; at most 1000 are allowed");
    if (!b->anchors && !(b->anchors = bead_yaml_take(b->yaml, BEAD_YAML_ANCHORS * sizeof *b->anchors)))
        return out_of_memory(b);
    const char *name = bead_yaml_text(b->yaml, (const char *)anchor, strlen((const char *)anchor));
    if (!name)
        return out_of_memory(b);
    b->anchors[b->anchor_count].name = name;
    b->anchors[b->anchor_count++].node = node;
    return BEAD_OK;
}

static enum bead_error take_alias(struct builder *b, const yaml_event_t *event)
{
    const struct bead_node *target = NULL;
    for (size_t i = b->anchor_count; i-- > 0 && !target;)
        target = strcmp(b->anchors[i].name, (const char *)event->data.alias.anchor) == 0 ? b->anchors[i].node : NULL;
    if (!target)
        return wrong(b, event->start_mark, "this alias has no anchor before it");
    for (size_t i = 0; i < b->depth; i++) {
        if (b->open[i] == target)
            return wrong(b, event->start_mark, "this alias contains itself");
    }
    if (b->depth + bead_yaml_height(target) > BEAD_YAML_DEPTH)
        return wrong(b, event->start_mark, "nested too deeply; at most 32 levels are allowed");
    struct bead_node *node = bead_yaml_copy(b->yaml, target, place_of(b, event->start_mark), NULL);
    return node ? place_node(b, node, event->start_mark) : no_node(b, event->start_mark);
}

static enum bead_error take_scalar(struct builder *b, const yaml_event_t *event)
{
    struct bead_node *node = bead_yaml_node(b->yaml, BEAD_NODE_SCALAR, place_of(b, event->start_mark));
    if (!node)
        return no_node(b, event->start_mark);
    const char *value = (const char *)event->data.scalar.value;
    if (memchr(value, 0, event->data.scalar.length))
        return wrong(b, event->start_mark, "a text must not contain the character NUL");
    node->plain = event->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
    node->text = bead_yaml_text(b->yaml, value, event->data.scalar.length);
    if (!node->text)
        return out_of_memory(b);
    BEAD_TRY(remember(b, event->data.scalar.anchor, node, event->start_mark));
    return place_node(b, node, event->start_mark);
}

static enum bead_error open_node(struct builder *b, const yaml_event_t *event, enum bead_node_kind kind)
{
    if (b->depth >= BEAD_YAML_DEPTH)
        return wrong(b, event->start_mark, "nested too deeply; at most 32 levels are allowed");
    struct bead_node *node = bead_yaml_node(b->yaml, kind, place_of(b, event->start_mark));
    if (!node)
        return no_node(b, event->start_mark);
    bool map = kind == BEAD_NODE_MAP;
    node->flow = map ? event->data.mapping_start.style == YAML_FLOW_MAPPING_STYLE
                     : event->data.sequence_start.style == YAML_FLOW_SEQUENCE_STYLE;
    const yaml_char_t *anchor = map ? event->data.mapping_start.anchor : event->data.sequence_start.anchor;
    BEAD_TRY(remember(b, anchor, node, event->start_mark));
    BEAD_TRY(place_node(b, node, event->start_mark));
    b->open[b->depth++] = node;
    return BEAD_OK;
}

static enum bead_error take_event(struct builder *b, const yaml_event_t *event)
{
    switch (event->type) {
    case YAML_DOCUMENT_START_EVENT:
        return b->root ? wrong(b, event->start_mark, "only one document is allowed; a second one begins after `---`") : BEAD_OK;
    case YAML_ALIAS_EVENT:
        return take_alias(b, event);
    case YAML_SCALAR_EVENT:
        return take_scalar(b, event);
    case YAML_SEQUENCE_START_EVENT:
        return open_node(b, event, BEAD_NODE_LIST);
    case YAML_MAPPING_START_EVENT:
        return open_node(b, event, BEAD_NODE_MAP);
    case YAML_SEQUENCE_END_EVENT:
    case YAML_MAPPING_END_EVENT:
        b->depth--;
        return BEAD_OK;
    default:
        return BEAD_OK;
    }
}

static enum bead_error take_events(struct builder *b)
{
    enum bead_error err = BEAD_OK;
    for (bool ended = false; !ended && !err;) {
        yaml_event_t event;
        if (!yaml_parser_parse(b->parser, &event))
            return parser_wrong(b);
        err = take_event(b, &event);
        ended = event.type == YAML_STREAM_END_EVENT;
        yaml_event_delete(&event);
    }
    return err;
}

/* Parse `text` into nodes of `yaml`; *root is NULL if it holds no node. */
static enum bead_error build(struct bead_yaml *yaml, const char *text, size_t length, struct bead_place origin,
                             struct bead_node **root, struct bead_message *msg)
{
    yaml_parser_t parser;
    struct builder b = {.yaml = yaml, .parser = &parser, .text = text, .length = length, .origin = origin, .msg = msg};
    if (length > BEAD_YAML_BYTES)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s: is too long; at most 4 MiB are allowed", file_name(&b));
    if (!yaml_parser_initialize(&parser))
        return out_of_memory(&b);
    yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, length);
    enum bead_error err = take_events(&b);
    yaml_parser_delete(&parser);
    *root = b.root;
    return err;
}

enum bead_error bead_yaml_parse(const char *name, const char *text, size_t length, struct bead_yaml **yaml,
                                struct bead_message *msg)
{
    *yaml = NULL;
    struct bead_yaml *made = calloc(1, sizeof *made);
    char *copied = strdup(name);
    if (!made || !copied) {
        free(made);
        free(copied);
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", name);
    }
    made->name = copied;
    enum bead_error err = build(made, text, length, (struct bead_place){0, 0}, &made->root, msg);
    if (!err && !made->root)
        err = bead_fail(msg, BEAD_ERROR_SCENE, "%s:1:1: is empty: at least `chain` and `outputs` are needed", name);
    if (err)
        bead_yaml_free(made);
    else
        *yaml = made;
    return err;
}

enum bead_error bead_yaml_piece(struct bead_yaml *yaml, const char *text, size_t length, struct bead_place place,
                                struct bead_node **node, struct bead_message *msg)
{
    const char *before = yaml->origin;
    yaml->origin = before ? before : "--set";
    enum bead_error err = build(yaml, text, length, place, node, msg);
    if (!err && !*node && (*node = bead_yaml_node(yaml, BEAD_NODE_SCALAR, place))) {
        /* An empty text, or one that YAML takes for a comment: a colour such as #aabbcc. */
        (*node)->text = bead_yaml_text(yaml, text, length);
        (*node)->plain = length == 0;
    }
    yaml->origin = before;
    if (!err && (!*node || ((*node)->kind == BEAD_NODE_SCALAR && !(*node)->text)))
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "--set: out of memory");
    return err;
}
