/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads a map of a scene into a structure, key by key, by the rows of an option table. */
#include "sim/options/options.h"
#include "sim/base/text.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>

#include "sim/base/suggest.h"

enum { LONGEST_TEXT = 1000, MOST_FAULTS = 10 };

static void add_path(const struct bead_at *at, char *text, size_t size)
{
    if (!at)
        return;
    add_path(at->up, text, size);
    size_t used = strlen(text);
    if (at->key && *at->key)
        snprintf(text + used, size - used, "%s%s", used ? "." : "", at->key);
    else if (!at->key)
        snprintf(text + used, size - used, "%s%zu", used ? "." : "", at->index);
}

/* Adds an error once, in one line. */
static void add_fault(struct bead_faults *faults, const char *line)
{
    char *text = faults->lines.text, *end = text + strlen(text);
    const size_t room = sizeof faults->lines.text - (size_t)(end - text), length = strlen(line);
    if (strstr(text, line) || faults->count >= MOST_FAULTS || length + 2 > room)
        return;
    if (faults->count++ > 0)
        *end++ = '\n';
    for (size_t i = 0; i <= length; i++)
        end[i] = line[i] && (unsigned char)line[i] < ' ' ? ' ' : line[i];
}

/* A message of one line about the value at a place. */
static void write_line(const struct bead_reader *reader, const struct bead_at *at, const char *what, struct bead_message *line)
{
    char path[256] = "", shown[256];
    add_path(at, path, sizeof path);
    bead_fail(line, BEAD_ERROR_SCENE, "%s:%zu:%zu: %s%s%s", bead_yaml_name(reader->yaml, at->node), at->node->place.line,
              at->node->place.column, bead_text_show(path, shown, sizeof shown), *path ? ": " : "", what);
}

void bead_doubt(const struct bead_reader *reader, const struct bead_at *at, const char *unit, const char *likely)
{
    struct bead_message line;
    char what[200];
    snprintf(what, sizeof what, "%.40s has no unit and is taken as %.40s %s; is `%.40s %s` meant? Give the unit", at->node->text,
             at->node->text, unit, at->node->text, likely);
    if (!reader->doubts)
        return;
    write_line(reader, at, what, &line);
    add_fault(reader->doubts, line.text);
}

enum bead_error bead_wrong(const struct bead_reader *reader, const struct bead_at *at, const char *format, ...)
{
    char what[640];
    va_list values;
    va_start(values, format);
    vsnprintf(what, sizeof what, format, values);
    va_end(values);
    struct bead_message line = {""}, *msg = reader->faults ? &line : reader->msg;
    write_line(reader, at, what, msg);
    if (reader->faults)
        add_fault(reader->faults, line.text);
    return BEAD_ERROR_SCENE;
}

enum bead_error bead_not_beside(const struct bead_reader *reader, const struct bead_at *at, const char *other)
{
    return bead_given(at->up, other) ? bead_wrong(reader, at, "is given beside `%s`; give one of them", other) : BEAD_OK;
}

enum bead_error bead_without(const struct bead_reader *reader, const struct bead_at *at, const char *const *keys, const char *why)
{
    for (; *keys; keys++) {
        if (bead_given(at, *keys))
            return BEAD_WRONG_KEY(reader, at, *keys, "%s", why);
    }
    return BEAD_OK;
}

enum bead_error bead_must_be(const struct bead_reader *reader, const struct bead_at *at, const char *wanted)
{
    const bool empty = at->node->kind == BEAD_NODE_LIST && at->node->count == 0;
    char shown[64];
    return bead_wrong(reader, at, "is %s; must be %s", empty ? "an empty list" : bead_node_show(at->node, shown, sizeof shown),
                      wanted);
}

enum bead_error bead_need_list(const struct bead_reader *reader, const struct bead_at *at, const char *wanted, size_t most,
                               const char *what)
{
    if (at->node->kind != BEAD_NODE_LIST)
        return bead_must_be(reader, at, wanted);
    if (at->node->count == 0 || at->node->count > most)
        return bead_wrong(reader, at, "has %zu %s; must have from 1 to %zu", at->node->count, what, most);
    return BEAD_OK;
}

bool bead_reads_on(const struct bead_reader *reader, enum bead_error err, enum bead_error *kept)
{
    if (err && *kept != BEAD_ERROR_MEMORY)
        *kept = err;
    return !err || (err == BEAD_ERROR_SCENE && reader->faults && reader->faults->count < MOST_FAULTS);
}

enum bead_error bead_no_memory(const struct bead_reader *reader)
{
    return bead_fail(reader->msg, BEAD_ERROR_MEMORY, "%s: out of memory", bead_yaml_name(reader->yaml, NULL));
}

bool bead_given(const struct bead_at *at, const char *key)
{
    return bead_node_get(at->node, key, NULL);
}

struct bead_at bead_at_key(const struct bead_at *at, const char *key)
{
    const struct bead_node *node = bead_node_get(at->node, key, NULL);
    return (struct bead_at){at, key, 0, node ? node : at->node};
}

struct bead_at bead_at_item(const struct bead_at *at, size_t index)
{
    return at->node->kind == BEAD_NODE_LIST ? (struct bead_at){at, NULL, index, at->node->items[index]} : *at;
}

/* ---- single values ---- */

static bool is_scalar(const struct bead_node *node)
{
    return node->kind == BEAD_NODE_SCALAR && !(node->plain && !*node->text);
}

enum bead_error bead_read_scalar(const struct bead_reader *reader, const struct bead_at *at, const char *wanted, const char **text)
{
    if (!is_scalar(at->node))
        return bead_must_be(reader, at, wanted);
    *text = at->node->text;
    return BEAD_OK;
}

static bool in_range(const struct bead_option *option, double value)
{
    if (!bead_option_is_bounded(option))
        return true;
    bool above = option->open & BEAD_OPEN_LOW ? value > option->low : value >= option->low;
    bool below = option->open & BEAD_OPEN_HIGH ? value < option->high : value <= option->high;
    return above && below;
}

static bool is_usual(const struct bead_option *option, double value)
{
    return value == 0 || (fabs(value) >= option->usual[0] && !(option->usual[1] > 0 && fabs(value) > option->usual[1]));
}

/* The unit that a number without one was probably meant in; NULL: as it is. */
static const char *likely_unit(const struct bead_reader *reader, const struct bead_option *option, const char *text, double value)
{
    char with_unit[160], why[200];
    if (!option->likely || !option->unit || is_usual(option, value) || !bead_units_bare(text))
        return NULL;
    for (size_t i = 0; option->likely[i]; i++) {
        snprintf(with_unit, sizeof with_unit, "%s %s", text, option->likely[i]);
        if (bead_units_read(reader->units, with_unit, option->unit, &value, why, sizeof why) == BEAD_OK && is_usual(option, value))
            return option->likely[i];
    }
    return option->likely[0];
}

enum bead_error bead_read_number(const struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                 double *value)
{
    char allowed[200], why[200], hint[80] = "";
    const char *text = NULL;
    struct bead_option plain = *option;
    if (option->of_motion && reader->without_units) {
        plain.unit = NULL;
        option = &plain;
    }
    if (!is_scalar(at->node)) /* words for a message are only made when needed: most values are right */
        return bead_read_scalar(reader, at, bead_option_allowed(option, allowed, sizeof allowed), &text);
    text = at->node->text;
    if (option->word && strcmp(text, option->word) == 0) {
        *value = option->word_value;
        return BEAD_OK;
    }
    double read = 0;
    if (bead_units_read(reader->units, text, option->unit, &read, why, sizeof why) != BEAD_OK)
        return bead_wrong(reader, at, "%s; must be %s", why, bead_option_allowed(option, allowed, sizeof allowed));
    bool whole = option->type != BEAD_OPTION_COUNT || read == floor(read);
    const char *likely = likely_unit(reader, option, text, read);
    if (likely)
        snprintf(hint, sizeof hint, "; did you mean `%.40s %s`?", text, likely);
    if (!whole || !in_range(option, read))
        return bead_wrong(reader, at, "%s is %s; must be %s%s", bead_node_show(at->node, why, 64),
                          whole ? "out of range" : "not whole", bead_option_allowed(option, allowed, sizeof allowed), hint);
    if (likely)
        bead_doubt(reader, at, option->unit, likely);
    *value = read;
    return BEAD_OK;
}

enum bead_error bead_read_count(const struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                size_t *value)
{
    double number = 0;
    BEAD_TRY(bead_read_number(reader, at, option, &number));
    *value = (size_t)number;
    return BEAD_OK;
}

static enum bead_error no_choice(const struct bead_reader *reader, const struct bead_at *at, const char *const *choices)
{
    char all[240] = "", shown[64], near[96];
    struct bead_suggest search;
    bead_suggest_begin(&search, at->node->kind == BEAD_NODE_SCALAR ? at->node->text : "");
    for (unsigned i = 0; choices[i]; i++) {
        bead_suggest_try(&search, choices[i]);
        bead_list_add(all, sizeof all, choices[i + 1] ? ", " : " or ", choices[i]);
    }
    return bead_wrong(reader, at, "is %s; must be %s%s", bead_node_show(at->node, shown, sizeof shown), all,
                      bead_suggest_text(&search, near, sizeof near));
}

enum bead_error bead_read_choice(const struct bead_reader *reader, const struct bead_at *at, const char *const *choices,
                                 unsigned *value)
{
    for (unsigned i = 0; at->node->kind == BEAD_NODE_SCALAR && choices[i]; i++) {
        if (strcmp(at->node->text, choices[i]) == 0) {
            *value = i;
            return BEAD_OK;
        }
    }
    return no_choice(reader, at, choices);
}

/* U+FDD0 to U+FDEF, and the last two code points of every plane. `c` is the first byte of a character of valid UTF-8. */
static bool is_noncharacter(const unsigned char *c)
{
    bool arabic = c[0] == 0xEF && c[1] == 0xB7 && c[2] >= 0x90 && c[2] <= 0xAF;
    bool basic = c[0] == 0xEF && c[1] == 0xBF && c[2] >= 0xBE;
    bool other = c[0] >= 0xF0 && (c[1] & 0x0F) == 0x0F && c[2] == 0xBF && c[3] >= 0xBE;
    return arabic || basic || other;
}

enum bead_error bead_check_text(const struct bead_reader *reader, const struct bead_at *at, const char *text)
{
    if (strlen(text) > LONGEST_TEXT)
        return bead_wrong(reader, at, "is too long: at most %d bytes are allowed", LONGEST_TEXT);
    for (const char *c = text; *c; c++) {
        const size_t obeyed = bead_text_obeyed(c);
        const bool line = strncmp(c, "\xe2\x80\xa8", 3) == 0 || strncmp(c, "\xe2\x80\xa9", 3) == 0;
        if (line || obeyed == 1 || (obeyed == 2 && (unsigned char)*c == 0xC2))
            return bead_wrong(reader, at, "contains a line break or another control character; must be one line of text");
        if (is_noncharacter((const unsigned char *)c))
            return bead_wrong(reader, at, "contains a code point that Unicode reserves as no character, such as U+FFFF");
    }
    if (bead_text_turns(text))
        return bead_wrong(
            reader, at,
            "turns the direction of the text (U+202A to U+202E, U+2066 to U+2068) and not back; end that with U+202C, or "
            "U+2069");
    return BEAD_OK;
}

enum bead_error bead_read_text(const struct bead_reader *reader, const struct bead_at *at, char **text)
{
    const char *read = NULL;
    BEAD_TRY(bead_read_scalar(reader, at, "a text", &read));
    BEAD_TRY(bead_check_text(reader, at, read));
    free(*text);
    *text = strdup(read);
    return *text ? BEAD_OK : bead_no_memory(reader);
}

enum bead_error bead_read_flag(const struct bead_reader *reader, const struct bead_at *at, bool *value)
{
    static const char *const words[] = {"false", "true", "no", "yes", "False", "True", "No", "Yes", "FALSE", "TRUE", "NO", "YES"};
    for (size_t i = 0; at->node->kind == BEAD_NODE_SCALAR && i < sizeof words / sizeof *words; i++) {
        if (strcmp(at->node->text, words[i]) == 0) {
            *value = i % 2 == 1;
            return BEAD_OK;
        }
    }
    return bead_must_be(reader, at, "true or false");
}

/* All 64 bits, which a double would not hold. */
static enum bead_error read_seed(const struct bead_reader *reader, const struct bead_at *at, uint64_t *value)
{
    static const char wanted[] = "a whole number from 0 to 18446744073709551615";
    const char *text = NULL;
    uint64_t read = 0;
    BEAD_TRY(bead_read_scalar(reader, at, wanted, &text));
    bool good = *text != 0;
    for (const char *c = text; *c && good; c++) {
        unsigned digit = (unsigned)(*c - '0');
        good = digit < 10 && !__builtin_mul_overflow(read, 10, &read) && !__builtin_add_overflow(read, digit, &read);
    }
    if (!good)
        return bead_must_be(reader, at, wanted);
    *value = read;
    return BEAD_OK;
}

enum bead_error bead_read_pair(const struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                               const char *wanted, double value[2])
{
    if (option->word && at->node->kind == BEAD_NODE_SCALAR && strcmp(at->node->text, option->word) == 0) {
        value[0] = value[1] = option->word_value;
        return BEAD_OK;
    }
    if (at->node->kind != BEAD_NODE_LIST || at->node->count != 2)
        return bead_must_be(reader, at, wanted);
    for (size_t i = 0; i < 2; i++) {
        struct bead_at element = bead_at_item(at, i);
        BEAD_TRY(bead_read_number(reader, &element, option, &value[i]));
    }
    return BEAD_OK;
}

/* [from, to]. */
static enum bead_error read_extent(const struct bead_reader *reader, const struct bead_at *at, const struct bead_option *option,
                                   double value[2])
{
    char pair[200] = "[a, b], both ";
    bead_option_allowed(option, pair + strlen(pair), sizeof pair - strlen(pair));
    BEAD_TRY(bead_read_pair(reader, at, option, pair, value));
    const char *unit = option->unit && !(option->of_motion && reader->without_units) ? option->unit : "";
    return value[0] >= value[1] ? bead_wrong(reader, at, "is [%g, %g]%s%s; the first must be before the second", value[0], value[1],
                                             *unit ? " " : "", unit)
                                : BEAD_OK;
}

/* ---- rows ---- */

static BEAD_OPTION_READER(read_value)
{
    char *field = (char *)settings + option->offset;
    unsigned choice = 0;
    switch (option->type) {
    case BEAD_OPTION_NUMBER:
        return bead_read_number(reader, at, option, (double *)(void *)field);
    case BEAD_OPTION_PAIR:
        return read_extent(reader, at, option, (double *)(void *)field);
    case BEAD_OPTION_COUNT:
        return bead_read_count(reader, at, option, (size_t *)(void *)field);
    case BEAD_OPTION_SEED:
        return read_seed(reader, at, (uint64_t *)(void *)field);
    case BEAD_OPTION_FLAG:
        return bead_read_flag(reader, at, (bool *)(void *)field);
    case BEAD_OPTION_TEXT:
        return bead_read_text(reader, at, (char **)(void *)field);
    case BEAD_OPTION_CHOICE:
        BEAD_TRY(bead_read_choice(reader, at, option->choices, &choice));
        _Static_assert(sizeof(enum bead_option_type) == sizeof choice, "enums are stored as unsigned");
        memcpy(field, option->values ? &option->values[choice] : &choice, sizeof choice);
        return BEAD_OK;
    case BEAD_OPTION_MAP:
        return bead_options_read(reader, at, option->map, field);
    case BEAD_OPTION_CUSTOM:
        break;
    }
    return option->read ? option->read(reader, at, option, settings) : BEAD_OK;
}

/* Defaults are read like values; those in brackets are parsed first. */
static enum bead_error read_initial(struct bead_reader *reader, const struct bead_at *up, const struct bead_option *option,
                                    void *settings)
{
    struct bead_node word = {.plain = false, .place = up->node->place, .text = option->initial, .origin = up->node->origin};
    struct bead_at at = {up, option->key, 0, &word};
    if (*option->initial == '[' || *option->initial == '{') {
        struct bead_node *parsed = NULL;
        BEAD_TRY(bead_yaml_piece(reader->scratch, option->initial, strlen(option->initial), up->node->place, &parsed, reader->msg));
        parsed->origin = up->node->origin;
        at.node = parsed;
    }
    return read_value(reader, &at, option, settings);
}

/* Other programs' names for keys of ours. */
static const struct called {
    const char *theirs, *ours, *but;
} called[] = {{"diameter", "radius", ", half of it"},
              {"young", "modulus", ""},
              {"youngs_modulus", "modulus", ""},
              {"E", "modulus", ""},
              {"nu", "poisson", ""},
              {"rho", "density", ""},
              {"speed", "velocity", ""},
              {"v0", "velocity", ""},
              {"material", "bead", ""},
              {"n", "count", ""},
              {"number", "count", ""},
              {"width", "size", ": [WIDTH, HEIGHT]"},
              {"height", "size", ": [WIDTH, HEIGHT]"},
              {"dt", "step", ""},
              {"youngs", "modulus", ""},
              {"cmap", "colormap", ""}};

static const struct called *called_here(const char *key, const struct bead_options *options)
{
    for (size_t i = 0; i < sizeof called / sizeof *called; i++) {
        if (strcmp(key, called[i].theirs) == 0 && bead_options_find(options, called[i].ours))
            return &called[i];
    }
    return NULL;
}

static enum bead_error unknown_key(const struct bead_reader *reader, const struct bead_at *at, const struct bead_options *options)
{
    const struct bead_option *row;
    struct bead_suggest search;
    char near[96], word[64], all[480] = "";
    bead_suggest_begin(&search, at->key);
    for (size_t i = 0; (row = bead_options_row(options, i)); i++) {
        bead_list_add(all, sizeof all, ", ", row->key);
        bead_suggest_try(&search, row->key);
    }
    if (*at->key >= '0' && *at->key <= '9')
        return bead_wrong(reader, at,
                          "unknown key; in { } a comma ends a value: numbers have a decimal point, and texts with a comma "
                          "must be in \"quotes\"");
    snprintf(word, sizeof word, "%.*s", (int)strcspn(at->key, " [{"), at->key);
    if (strlen(word) < strlen(at->key) && bead_options_find(options, word))
        return bead_wrong(reader, at, "unknown key; is the colon missing after `%s`?", word);
    if (!at->up->up && reader->tables && reader->tables->home(at->key, near, sizeof near))
        return bead_wrong(reader, at, "unknown key; did you mean `%s`?", near);
    const struct called *here = called_here(at->key, options);
    if (here)
        return bead_wrong(reader, at, "unknown key; did you mean `%s`%s?", here->ours, here->but);
    if (search.best)
        return bead_wrong(reader, at, "unknown key%s", bead_suggest_text(&search, near, sizeof near));
    return bead_wrong(reader, at, "unknown key; known are %s", all);
}

/* A key that the table does not have: is it one of another table of the family? */
static enum bead_error foreign_key(const struct bead_reader *reader, const struct bead_at *at, const struct bead_options *options)
{
    const struct bead_option_family *family = reader->tables ? options->family : NULL;
    const struct bead_options *member;
    const struct bead_option *found = NULL;
    char homes[120] = "";
    for (size_t i = 0; family && (member = reader->tables->table(i)); i++) {
        const struct bead_option *row = member->family == family ? bead_options_find(member, at->key) : NULL;
        found = row ? row : found;
        if (row && member->name)
            bead_list_add(homes, sizeof homes, ", ", member->name);
    }
    if (!found)
        return unknown_key(reader, at, options);
    const char *here = options->name ? options->name : "this";
    if (!homes[0]) /* of tables without a name, which the help names */
        return bead_wrong(reader, at, "is not a key of %s (%s)", here, found->help);
    return bead_wrong(reader, at, "is a key of %s %s, not of %s", family->of, homes, here);
}

/* "until 2 ms" is a map whose colon is missing. */
static enum bead_error no_map(const struct bead_reader *reader, const struct bead_at *at, const struct bead_options *options)
{
    char shown[64], word[64] = "", hint[128] = "";
    if (at->node->kind == BEAD_NODE_SCALAR)
        snprintf(word, sizeof word, "%.*s", (int)strcspn(at->node->text, " "), at->node->text);
    if (*word && bead_options_find(options, word))
        snprintf(hint, sizeof hint, "; is the colon missing after `%s`?", word);
    return bead_wrong(reader, at, "is %s; must be a map of keys and values: %s%s", bead_node_show(at->node, shown, sizeof shown),
                      options->help, hint);
}

static enum bead_error missing_key(const struct bead_reader *reader, const struct bead_at *at, const struct bead_option *row)
{
    return row->example ? bead_wrong(reader, at, "is missing: %s; such as `%s: %s`", row->help, row->key, row->example)
                        : bead_wrong(reader, at, "is missing: %s", row->help);
}

enum bead_error bead_options_read(struct bead_reader *reader, const struct bead_at *at, const struct bead_options *options,
                                  void *settings)
{
    const struct bead_option *row;
    enum bead_error err = BEAD_OK, kept = BEAD_OK;
    if (at->node->kind != BEAD_NODE_MAP)
        return no_map(reader, at, options);
    for (size_t i = 0; i + 1 < at->node->count && bead_reads_on(reader, err, &kept); i += 2) {
        struct bead_at key = {at, at->node->items[i]->text, 0, at->node->items[i]};
        err = bead_options_find(options, key.key) ? BEAD_OK : foreign_key(reader, &key, options);
    }
    const bool misspelt = kept || err; /* that may be the key that seems to be missing */
    for (size_t i = 0; bead_reads_on(reader, err, &kept) && (row = bead_options_row(options, i)); i++) {
        const struct bead_node *value = bead_node_get(at->node, row->key, NULL);
        struct bead_at key = {at, row->key, 0, value ? value : at->node};
        err = BEAD_OK;
        if (value)
            err = read_value(reader, &key, row, settings);
        else if (row->required && !misspelt)
            err = missing_key(reader, &key, row);
        else if (row->initial)
            err = read_initial(reader, at, row, settings);
    }
    return kept;
}
