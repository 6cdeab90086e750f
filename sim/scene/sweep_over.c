/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `over`: the keys of a scene to which a sweep gives other values, one by one. */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "sim/base/memory.h"
#include "sim/scene/scene_private.h"

enum { MOST_KEYS = 8, MOST_VALUES = 100000, MOST_POINTS = 1000000 };

const char *bead_scene_unit_of(const struct bead_reader *reader, const char *text)
{
    static const char *const units[] = {"m/s", "m", "N", "Pa", "s", "kg", "kg/m3", "kg/s", "N/m", "Hz", "1/m", "rad", "1"};
    double value;
    char why[200];
    if (bead_units_read(reader->units, text, NULL, &value, why, sizeof why) == BEAD_OK)
        return "";
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (bead_units_read(reader->units, text, units[i], &value, why, sizeof why) == BEAD_OK)
            return strcmp(units[i], "1") == 0 ? "" : units[i];
    }
    return "";
}

static enum bead_error add_value(const struct bead_reader *reader, struct bead_over_key *key, char *text)
{
    char why[200];
    if (!text)
        return bead_no_memory(reader);
    if (key->count == 0 && !(key->unit = strdup(bead_scene_unit_of(reader, text)))) {
        free(text);
        return bead_no_memory(reader);
    }
    key->text[key->count] = text;
    if (bead_units_read(reader->units, text, *key->unit ? key->unit : "1", &key->value[key->count], why, sizeof why))
        key->value[key->count] = NAN;
    key->count++;
    return BEAD_OK;
}

/* {from: 0.1 m/s, to: 10 m/s, count: 9}: its ends as written, the values between to twelve digits. */
enum spacing { SPACING_EVEN, SPACING_LOG };
struct range {
    const char *ends[2];
    size_t count;
    enum spacing spacing;
};
#define RANGE(member) offsetof(struct range, member)

static BEAD_OPTION_READER(read_end)
{
    if (at->node->kind != BEAD_NODE_SCALAR)
        return bead_must_be(reader, at, option->shape);
    *(const char **)((char *)settings + option->offset) = at->node->text;
    return BEAD_OK;
}

static const char *const spacings[] = {"even", "log", NULL};
static const struct bead_option range_rows[] = {
    {"from", BEAD_OPTION_CUSTOM, RANGE(ends[0]), .required = true, .shape = "a number, with its unit", .like = "number",
     .read = read_end, .help = "the first value", .example = "0.1 m/s"},
    {"to", BEAD_OPTION_CUSTOM, RANGE(ends[1]), .required = true, .shape = "a number, with its unit", .like = "number",
     .read = read_end, .help = "the last value", .example = "10 m/s"},
    {"count", BEAD_OPTION_COUNT, RANGE(count), .required = true, .low = 2, .high = MOST_VALUES,
     .help = "how many values, these two among them", .example = "9"},
    {"spacing", BEAD_OPTION_CHOICE, RANGE(spacing), .choices = spacings, .initial = "even",
     .help = "even: the same difference between any two neighbours; log: the same ratio, of values above 0"},
};
const struct bead_options bead_over_options = {
    "sweep.over", "instead of a list of values: numbers between two ends, as in {from: 0.1 m/s, to: 10 m/s, count: 9}",
    BEAD_OPTIONS(range_rows), NULL, NULL};

/* ratio^part, 0 <= part < 1, by products of roots: the same bits everywhere. */
static double power(double ratio, double part)
{
    double result = 1;
    for (; part > 0; part -= part >= 1) {
        ratio = sqrt(ratio);
        part *= 2;
        result *= part >= 1 ? ratio : 1;
    }
    return result;
}

/* Value `i` as written in scenes; NULL: no memory. */
static char *range_value(const struct range *range, const double ends[2], const char *unit, size_t i)
{
    char *text = NULL;
    if (i == 0 || i + 1 == range->count)
        return strdup(range->ends[i > 0]);
    const double part = (double)i / (double)(range->count - 1), value = range->spacing == SPACING_LOG
                                                                            ? ends[0] * power(ends[1] / ends[0], part)
                                                                            : ends[0] + part * (ends[1] - ends[0]);
    return asprintf(&text, "%.12g%s%s", value, *unit ? " " : "", unit) < 0 ? NULL : text;
}

/* Enough digits to tell neighbours apart, and to write out whole numbers. */
static int digits_apart(const double *value, size_t count)
{
    int digits = 4, whole = 1;
    double least = 1;
    for (size_t i = 0; i + 1 < count; i++)
        least = fmin(least, fabs(value[i + 1] - value[i]) / fmax(fabs(value[i]), fabs(value[i + 1])));
    for (double part = 1e-3; digits < 12 && least < part; part /= 10)
        digits++;
    for (double most = fmax(fabs(value[0]), fabs(value[count - 1])); whole < 12 && most >= 10; most /= 10)
        whole++;
    return digits > whole ? digits : whole;
}

static enum bead_error read_range(struct bead_reader *reader, const struct bead_at *at, struct bead_over_key *key)
{
    struct range range = {{NULL, NULL}, 0, SPACING_EVEN};
    double ends[2];
    char why[200];
    BEAD_TRY(bead_options_read(reader, at, &bead_over_options, &range));
    const char *unit = bead_scene_unit_of(reader, range.ends[0]);
    for (size_t i = 0; i < 2; i++) {
        const char *name = range_rows[i].key;
        if (bead_units_read(reader->units, range.ends[i], *unit ? unit : "1", &ends[i], why, sizeof why))
            return BEAD_WRONG_KEY(reader, at, name, "is `%s`; must be a number%s%s", range.ends[i], *unit ? " with a unit of " : "",
                                  unit);
        if (range.spacing == SPACING_LOG && !(ends[i] > 0))
            return BEAD_WRONG_KEY(reader, at, name, "is %s; must be above 0 with `spacing: log`", range.ends[i]);
    }
    BEAD_TRY(bead_new(&key->text, range.count, reader->msg, "a sweep"));
    BEAD_TRY(bead_new(&key->value, range.count, reader->msg, "a sweep"));
    for (size_t i = 0; i < range.count; i++)
        BEAD_TRY(add_value(reader, key, range_value(&range, ends, unit, i)));
    key->digits = digits_apart(key->value, key->count);
    return BEAD_OK;
}

/* Reads whole numbers such as "1..50". */
static bool read_run(const char *text, long *first, long *last)
{
    const char *dots = strstr(text, "..");
    char *end = NULL;
    if (!dots || !isdigit((unsigned char)text[0]))
        return false;
    *first = strtol(text, &end, 10);
    if (end != dots || !isdigit((unsigned char)dots[2]))
        return false;
    *last = strtol(dots + 2, &end, 10);
    return *end == '\0' && *first <= *last && *last - *first < MOST_VALUES;
}

/* Notes the files that chains of the sweep will read: any text in the values that is the name of a file. */
static enum bead_error note_files(struct bead_reader *reader, const struct bead_node *node)
{
    if (node->kind != BEAD_NODE_SCALAR) {
        for (size_t i = 0; i < node->count; i++)
            BEAD_TRY(note_files(reader, node->items[i]));
        return BEAD_OK;
    }
    BEAD_FREED char *path = bead_yaml_beside(reader->yaml, node, node->text);
    if (!path)
        return bead_no_memory(reader);
    return access(path, F_OK) == 0 ? bead_yaml_note_part(reader->yaml, path, reader->msg) : BEAD_OK;
}

static enum bead_error read_values(struct bead_reader *reader, const struct bead_at *at, struct bead_over_key *key)
{
    static const char shape[] =
        "a list of values, whole numbers such as 1..50, or a map such as {from: 1 m/s, to: 2 m/s, count: 5}";
    if (at->node->kind == BEAD_NODE_MAP)
        return read_range(reader, at, key);
    long first = 0, last = -1;
    const bool run = at->node->kind == BEAD_NODE_SCALAR && read_run(at->node->text, &first, &last);
    if (!run && (at->node->kind != BEAD_NODE_LIST || at->node->count == 0 || at->node->count > MOST_VALUES))
        return bead_must_be(reader, at, shape);
    const size_t count = run ? (size_t)(last - first) + 1 : at->node->count;
    BEAD_TRY(bead_new(&key->text, count, reader->msg, "a sweep"));
    BEAD_TRY(bead_new(&key->value, count, reader->msg, "a sweep"));
    BEAD_TRY(note_files(reader, at->node));
    for (size_t i = 0; i < count; i++) {
        char *text = NULL;
        if (run && asprintf(&text, "%ld", first + (long)i) < 0)
            text = NULL;
        if (!run)
            BEAD_TRY(bead_yaml_emit(reader->yaml, at->node->items[i], &text, reader->msg));
        if (text && !run && strchr(text, '\n'))
            text[strcspn(text, "\n")] = '\0';
        BEAD_TRY(add_value(reader, key, text));
    }
    return BEAD_OK;
}

static enum bead_error read_key(struct bead_reader *reader, const struct bead_at *at, struct bead_over_key *key)
{
    static const char *const roots[] = {"chain.", "simulate.", "materials.", NULL};
    const size_t length = strlen(at->key);
    size_t root = 0;
    while (roots[root] && strncmp(at->key, roots[root], strlen(roots[root])) != 0)
        root++;
    if (!roots[root])
        return bead_wrong(reader, at, "is no key that a sweep can change; must begin with chain, simulate or materials");
    if (!(key->path = strdup(at->key)))
        return bead_no_memory(reader);
    key->seed = length > 5 && strcmp(at->key + length - 5, ".seed") == 0;
    return read_values(reader, at, key);
}

/* All combinations; with `pairs`, as many as each key has values. */
static enum bead_error count_points(const struct bead_reader *reader, const struct bead_at *at, const struct bead_over *over,
                                    size_t *points)
{
    const bool pairs = over->combine == BEAD_COMBINE_PAIRS;
    *points = pairs ? over->keys[0].count : 1;
    for (size_t k = 0; k < over->key_count; k++) {
        const size_t count = over->keys[k].count;
        if (pairs && count != *points)
            return bead_wrong(reader, at, "has %zu values of `%s` but %zu of `%s`; with `combine: pairs` all must have as many",
                              *points, over->keys[0].path, count, over->keys[k].path);
        if (!pairs && count > MOST_POINTS / *points)
            return bead_wrong(reader, at, "makes more than %d chains, the most that is allowed", MOST_POINTS);
        *points *= pairs ? 1 : count;
    }
    return BEAD_OK;
}

enum bead_error bead_scene_read_over(struct bead_reader *reader, const struct bead_at *at, struct bead_over *over, size_t *points)
{
    if (at->node->kind != BEAD_NODE_MAP || at->node->count == 0 || at->node->count > 2 * MOST_KEYS)
        return bead_must_be(reader, at, "a map of one to eight keys such as {chain.striker.velocity: [1 m/s, 2 m/s]}");
    BEAD_TRY(bead_new(&over->keys, at->node->count / 2, reader->msg, "a sweep"));
    for (size_t i = 0; i + 1 < at->node->count; i += 2) {
        const struct bead_at one = {at, at->node->items[i]->text, 0, at->node->items[i + 1]};
        BEAD_TRY(read_key(reader, &one, &over->keys[over->key_count++]));
    }
    return count_points(reader, at, over, points);
}

void bead_scene_free_over(struct bead_over *over)
{
    for (size_t k = 0; k < over->key_count; k++) {
        for (size_t i = 0; i < over->keys[k].count; i++)
            free(over->keys[k].text[i]);
        free(over->keys[k].text);
        free(over->keys[k].value);
        free(over->keys[k].unit);
        free(over->keys[k].path);
    }
    free(over->keys);
}
