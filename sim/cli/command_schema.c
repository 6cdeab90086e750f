/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The JSON Schema of scenes (draft 7), from the tables that read them: with it editors complete keys and find mistakes. */
#include "sim/cli/command_line.h"

#include <string.h>

#include "sim/base/json.h"
#include "sim/kinds/output_kinds.h"
#include "sim/scene/scene_private.h"

/* A number is one, or a text that begins like one and goes on with its unit; many words for YAML 1.1 are texts: 1e-6. */
#define NUMBER_TEXT "[-+.0-9].*"

/* {"KEY": TEXT} inside of an object. */
static void put_only(struct bead_json *json, const char *key, const char *inner, const char *text)
{
    bead_json_open(json, key, '{');
    bead_json_text(json, inner, text);
    bead_json_close(json, "}");
}

/* The definition called `name`. Headings are names of definitions, except for blanks and brackets: "outputs (movie)",
 * outputs:movie. */
static void put_reference(struct bead_json *json, const char *key, const char *name)
{
    char path[120];
    snprintf(path, sizeof path, "#/definitions/%s", name);
    put_only(json, key, "$ref", path);
}

static const char *definition(const struct bead_options *options, char *name, size_t size)
{
    size_t used = 0;
    char heading[100];
    for (const char *c = bead_options_heading(options, heading, sizeof heading); *c && used + 1 < size; c++) {
        if (*c == ' ' && c[1] == '(')
            name[used++] = ':';
        else if (!strchr("()", *c))
            name[used++] = *c == ' ' ? '-' : *c;
    }
    name[used] = '\0';
    return name;
}

/* ---- values ---- */

/* The end of the first of a|b, outside of brackets. */
static size_t first_of(const char *like)
{
    size_t i = 0;
    for (int depth = 0; like[i] && (like[i] != '|' || depth > 0); i++)
        depth += (like[i] == '[' || like[i] == '{') - (like[i] == ']' || like[i] == '}');
    return i;
}

static bool is_definition(const char *name, size_t length)
{
    static const char *const own[] = {"number", "flag", "text", "chain.law", "chain.start", "chain.equation", "outputs.panel"};
    const struct bead_options *options;
    char text[100];
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        if (strlen(own[i]) == length && strncmp(own[i], name, length) == 0)
            return true;
    for (size_t i = 0; (options = bead_scene_section(i)); i++)
        if (strlen(definition(options, text, sizeof text)) == length && strncmp(text, name, length) == 0)
            return true;
    return false;
}

static void put_alternatives(struct bead_json *json, const char *like, size_t length);

/* Limits the number of elements of the list [of] or [2 of]. Returns the length of this prefix. */
static size_t put_item_count(struct bead_json *json, const char *list)
{
    bool pair = strncmp(list, "[2 ", 3) == 0;
    bead_json_number(json, "minItems", pair ? 2 : 1);
    if (pair)
        bead_json_number(json, "maxItems", 2);
    return pair ? 3 : 1;
}

/* One alternative of bead_option.like, as an element of a list. */
static void put_alternative(struct bead_json *json, const char *like, size_t length)
{
    char word[100];
    snprintf(word, sizeof word, "%.*s", (int)length, like);
    if (*like != '[' && *like != '{') {
        if (is_definition(like, length))
            put_reference(json, NULL, word);
        else
            put_only(json, NULL, "const", word);
        return;
    }
    bead_json_open(json, NULL, '{');
    bead_json_text(json, "type", *like == '[' ? "array" : "object");
    size_t from = *like == '[' ? put_item_count(json, like) : 1;
    bead_json_open(json, *like == '[' ? "items" : "additionalProperties", '{');
    put_alternatives(json, like + from, length - from - 1);
    bead_json_close(json, "}}");
}

static void put_alternatives(struct bead_json *json, const char *like, size_t length)
{
    bead_json_open(json, "anyOf", '[');
    for (size_t at = 0; at < length;) {
        size_t end = first_of(like + at);
        end = at + end > length ? length - at : end;
        put_alternative(json, like + at, end);
        at += end + 1;
    }
    bead_json_close(json, "]");
}

/* Limits count for plain numbers, which are in SI units. */
static void put_number(struct bead_json *json, const struct bead_option *row)
{
    char pattern[80];
    snprintf(pattern, sizeof pattern, row->word ? "^(" NUMBER_TEXT "|%s)$" : "^" NUMBER_TEXT "$", row->word);
    const bool whole = row->type == BEAD_OPTION_COUNT || row->type == BEAD_OPTION_SEED;
    bead_json_texts(json, "type", (const char *const[]){whole ? "integer" : "number", "string", NULL});
    bead_json_text(json, "pattern", pattern);
    if (!bead_option_is_bounded(row))
        return;
    bead_json_number(json, row->open & BEAD_OPEN_LOW ? "exclusiveMinimum" : "minimum", row->low);
    bead_json_number(json, row->open & BEAD_OPEN_HIGH ? "exclusiveMaximum" : "maximum", row->high);
}

static void put_pair(struct bead_json *json, const struct bead_option *row)
{
    bead_json_open(json, "anyOf", '[');
    if (row->word)
        put_only(json, NULL, "const", row->word);
    bead_json_open(json, NULL, '{');
    bead_json_text(json, "type", "array");
    bead_json_number(json, "minItems", 2);
    bead_json_number(json, "maxItems", 2);
    bead_json_open(json, "items", '{');
    put_number(json, row);
    bead_json_close(json, "}}]");
}

static void put_value(struct bead_json *json, const struct bead_option *row)
{
    switch (row->type) {
    case BEAD_OPTION_NUMBER:
    case BEAD_OPTION_COUNT:
    case BEAD_OPTION_SEED:
        put_number(json, row);
        break;
    case BEAD_OPTION_PAIR:
        put_pair(json, row);
        break;
    case BEAD_OPTION_FLAG:
        put_alternatives(json, "flag", 4);
        break;
    case BEAD_OPTION_TEXT:
        put_alternatives(json, "text", 4);
        break;
    case BEAD_OPTION_CHOICE:
        bead_json_texts(json, "enum", row->choices);
        break;
    case BEAD_OPTION_MAP:
        put_alternatives(json, row->map->name, strlen(row->map->name));
        break;
    case BEAD_OPTION_CUSTOM:
        if (row->like && strcmp(row->like, "any") != 0)
            put_alternatives(json, row->like, strlen(row->like));
        break;
    }
}

/* ---- tables ---- */

static void put_description(struct bead_json *json, const struct bead_option *row)
{
    char text[1200], allowed[400];
    const char *initial = row->initial ? row->initial : "";
    snprintf(text, sizeof text, "%s (%s%s%s)", row->help, bead_option_allowed(row, allowed, sizeof allowed),
             *initial ? "; default " : "", initial);
    bead_json_text(json, "description", text);
}

static void put_rows(struct bead_json *json, const struct bead_options *options)
{
    const struct bead_option *row;
    bead_json_open(json, "properties", '{');
    for (size_t i = 0; (row = bead_options_row(options, i)); i++) {
        bead_json_open(json, row->key, '{');
        put_description(json, row);
        put_value(json, row);
        bead_json_close(json, "}");
    }
    bead_json_close(json, "}");
}

static void put_required(struct bead_json *json, const struct bead_options *options)
{
    const struct bead_option *row;
    bead_json_open(json, "required", '[');
    for (size_t i = 0; (row = bead_options_row(options, i)); i++)
        if (row->required)
            bead_json_text(json, NULL, row->key);
    bead_json_close(json, "]");
}

static void put_map(struct bead_json *json, const struct bead_options *options)
{
    bead_json_text(json, "description", options->help);
    bead_json_text(json, "type", "object");
    put_rows(json, options);
    put_required(json, options);
    bead_json_flag(json, "additionalProperties", false);
}

static void put_definition(struct bead_json *json, const char *name, const struct bead_options *options)
{
    bead_json_open(json, name, '{');
    put_map(json, options);
    bead_json_close(json, "}");
}

/* ---- maps of several kinds ---- */

static void put_has_key(struct bead_json *json, const char *name, const char *key)
{
    bead_json_open(json, name, '{');
    bead_json_texts(json, "required", (const char *const[]){key, NULL});
    bead_json_close(json, "}");
}

/* Kinds that are recognised by their first key, which no other has. `next` gives the tables; NULL after the last. */
typedef const struct bead_options *(*next_kind)(size_t index);

static void put_kinds(struct bead_json *json, const char *name, next_kind next)
{
    const struct bead_options *options;
    char text[100];
    bead_json_open(json, name, '{');
    bead_json_text(json, "type", "object");
    bead_json_open(json, "anyOf", '[');
    for (size_t i = 0; (options = next(i)); i++)
        put_has_key(json, NULL, bead_options_row(options, 0)->key);
    bead_json_close(json, "]");
    bead_json_open(json, "allOf", '[');
    for (size_t i = 0; (options = next(i)); i++) {
        bead_json_open(json, NULL, '{');
        put_has_key(json, "if", bead_options_row(options, 0)->key);
        put_reference(json, "then", definition(options, text, sizeof text));
        bead_json_close(json, "}");
    }
    bead_json_close(json, "]}");
}

/* Kinds of outputs of scenes that are run once, and of those with sweeps. */
static const struct bead_options *kind_of_output(size_t index)
{
    for (enum bead_output_kind kind = 0; kind < BEAD_OUTPUT_KINDS; kind++)
        if (bead_output_type(kind)->options && index-- == 0)
            return bead_output_type(kind)->options;
    return NULL;
}
static const struct bead_options *kind_of_sweep_output(size_t index)
{
    for (enum bead_output_kind kind = 0; kind < BEAD_OUTPUT_KINDS; kind++)
        if (bead_output_type(kind)->sweep_options && index-- == 0)
            return bead_output_type(kind)->sweep_options;
    return NULL;
}

/* Which equation, its name says. */
static void put_equations(struct bead_json *json)
{
    const struct bead_options *options;
    char text[100];
    bead_json_open(json, "chain.equation", '{');
    put_has_key(json, "if", "equation");
    bead_json_open(json, "then", '{');
    bead_json_open(json, "oneOf", '[');
    for (size_t i = 0; (options = bead_equation_options(i)); i++) {
        bead_json_open(json, NULL, '{');
        bead_json_open(json, "allOf", '[');
        put_reference(json, NULL, definition(options, text, sizeof text));
        bead_json_open(json, NULL, '{');
        bead_json_open(json, "properties", '{');
        put_only(json, "equation", "const", options->name);
        bead_json_close(json, "}}]}");
    }
    bead_json_close(json, "]}");
    bead_json_open(json, "else", '{');
    bead_json_flag(json, "not", true);
    bead_json_close(json, "}}");
}

/* With `show` a panel is a plot. */
static void put_panels(struct bead_json *json)
{
    put_definition(json, "panel.image", &bead_image_panel_options);
    put_definition(json, "panel.plot", &bead_plot_panel_options);
    bead_json_open(json, "outputs.panel", '{');
    put_has_key(json, "if", "show");
    put_reference(json, "then", "panel.plot");
    put_reference(json, "else", "panel.image");
    bead_json_close(json, "}");
}

static void put_values(struct bead_json *json)
{
    static const char *const scalars[] = {"string", "number", "boolean", NULL};
    const struct bead_option number = {.type = BEAD_OPTION_NUMBER};
    bead_json_open(json, "number", '{');
    put_number(json, &number);
    bead_json_close(json, "}");
    put_only(json, "flag", "type", "boolean");
    bead_json_open(json, "text", '{');
    bead_json_texts(json, "type", scalars);
    bead_json_close(json, "}");
}

static void put_definitions(struct bead_json *json)
{
    const struct bead_options *options;
    char name[100];
    bead_json_open(json, "definitions", '{');
    put_values(json);
    for (size_t i = 0; (options = bead_scene_section(i)); i++)
        if (options != &bead_scene_options)
            put_definition(json, definition(options, name, sizeof name), options);
    put_kinds(json, "chain.law", bead_law_options);
    put_kinds(json, "chain.start", bead_start_options);
    put_kinds(json, "outputs", kind_of_output);
    put_kinds(json, "outputs-of-a-sweep", kind_of_sweep_output);
    put_equations(json);
    put_panels(json);
    bead_json_close(json, "}");
}

/* ---- the scene ---- */

static void put_one_of(struct bead_json *json, const char *name, const char *const *keys)
{
    bead_json_open(json, name, '[');
    for (; *keys; keys++)
        put_has_key(json, NULL, *keys);
    bead_json_close(json, "]");
}

static void put_outputs(struct bead_json *json, const char *name, const char *kinds)
{
    bead_json_open(json, name, '{');
    bead_json_open(json, "properties", '{');
    bead_json_open(json, "outputs", '{');
    bead_json_text(json, "type", "array");
    bead_json_number(json, "minItems", 1);
    put_reference(json, "items", kinds);
    bead_json_close(json, "}}}");
}

COMMAND_LISTS(command_list_schema)
{
    static const char *const systems[] = {"chain", "chains", "sweep", "sweeps", NULL};
    struct bead_json json = {.out = out, .lines = true};
    bead_json_open(&json, NULL, '{');
    bead_json_text(&json, "$schema", "http://json-schema.org/draft-07/schema#");
    bead_json_text(&json, "title", "beadreel scene");
    put_map(&json, &bead_scene_options);
    put_one_of(&json, "anyOf", systems);
    bead_json_open(&json, "if", '{');
    put_one_of(&json, "anyOf", systems + 2);
    bead_json_close(&json, "}");
    put_outputs(&json, "then", "outputs-of-a-sweep");
    put_outputs(&json, "else", "outputs");
    put_definitions(&json);
    bead_json_close(&json, "}");
    fputc('\n', out);
    return BEAD_OK;
}
