/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Waves from files, for drives and measured data: their points become a part of the scene's text, so that the text stored in
 * trajectories is complete. */
#include <math.h>
#include <stdlib.h>

#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/base/number.h"
#include "sim/base/suggest.h"
#include "sim/kinds/outputs.h"
#include "sim/kinds/waves.h"

enum { MOST_BYTES = 1 << 24, MOST_POINTS = 100000, MOST_MEASURED = 64 };

struct wave_file {
    char *name, *columns[2];
    double time, start;
};

static void forget(struct wave_file *file)
{
    free(file->name);
    free(file->columns[0]);
    free(file->columns[1]);
}

#define WAVE(member) offsetof(struct wave_file, member)

static BEAD_OPTION_READER(read_columns)
{
    struct wave_file *file = settings;
    char shown[64];
    if (at->node->kind != BEAD_NODE_LIST)
        return bead_wrong(reader, at, "is %s; must be two names or numbers of columns",
                          bead_node_show(at->node, shown, sizeof shown));
    if (at->node->count != 2)
        return bead_wrong(reader, at,
                          "has %zu entries; must be two names or numbers of columns, that of time and that of the value",
                          at->node->count);
    for (size_t i = 0; i < 2; i++) {
        const struct bead_at item = bead_at_item(at, i);
        BEAD_TRY(bead_read_text(reader, &item, &file->columns[i]));
    }
    return BEAD_OK;
}

static const struct bead_option file_rows[] = {
    {"file", BEAD_OPTION_TEXT, WAVE(name),
     .help = "comma-separated values, relative to the directory of the scene, as an oscilloscope saves them: lines before the "
             "names of the columns, and before the first numbers, are skipped; what is read becomes part of the scene",
     .example = "scope.csv"},
    {"columns", BEAD_OPTION_CUSTOM, .shape = "two names or numbers of columns", .like = "[2 text|number]", .read = read_columns,
     .help = "the columns of time and value; [1, 2] unless given", .example = "[time, force]"},
    {"time", BEAD_OPTION_NUMBER, WAVE(time), .unit = "s", .initial = "1 s", .low = 0, .high = 1e6, .open = BEAD_OPEN_LOW,
     .help = "what 1 means in the column of time", .example = "1 us"},
};
static const struct bead_option measured_rows[] = {
    {"gain", BEAD_OPTION_CUSTOM, .shape = "a number in the unit of `field`", .like = "number",
     .help = "what 1 means in the column of values", .example = "25 N"},
    {"offset", BEAD_OPTION_CUSTOM, .shape = "a number in the unit of `field`", .like = "number",
     .help = "what 0 means in the column of values", .example = "-0.3 N"},
    {"start", BEAD_OPTION_NUMBER, WAVE(start), .unit = "s", .initial = "0 s", .low = -1e6, .high = 1e6,
     .help = "the time of the motion, from the strike on, at which the column of time is 0", .example = "12 us"},
    {"points", BEAD_OPTION_CUSTOM, .shape = "`time value, ...`", .like = "text",
     .help = "what was read from a file: runs keep this instead of its name", .example = "0 0, 1e-6 0.25"},
};
static const struct bead_option_rows measured_shared[] = {{BEAD_OPTIONS(file_rows)}, {NULL, 0}};
const struct bead_options bead_measured_options = {"outputs.measured", "a measured curve", BEAD_OPTIONS(measured_rows),
                                                   measured_shared, NULL};
const struct bead_options bead_drive_file_options = {"chain.drive.file", "a wave from a file", BEAD_OPTIONS(file_rows), NULL, NULL};

/* ---- rows ---- */

static const char between[] = ",;\t";

/* Field `index` (from 0) of a line; its length. NULL: there is none. */
static const char *field_of(const char *line, size_t index, size_t *length)
{
    for (; index > 0; index--) {
        line += strcspn(line, ",;\t\n");
        if (!*line || *line == '\n')
            return NULL;
        line++;
    }
    *length = strcspn(line, ",;\t\r\n");
    return line;
}

/* Is the field equal to this name? Ignores blanks and quotation marks around it. */
static bool is_named(const char *field, size_t length, const char *name)
{
    static const char around[] = " \"";
    const char *first = field + strspn(field, around), *behind = first + strlen(name);
    return strncmp(first, name, strlen(name)) == 0 && behind + strspn(behind, around) == field + length;
}

/* SIZE_MAX: the line has no such column; NULL: column `index`. */
static size_t column_of(const char *line, const char *name, size_t index)
{
    size_t length;
    const char *field;
    char *end = NULL;
    if (!name)
        return index;
    const unsigned long number = strtoul(name, &end, 10);
    if (*name && !*end)
        return number > 0 ? number - 1 : SIZE_MAX;
    for (size_t i = 0; (field = field_of(line, i, &length)); i++) {
        if (is_named(field, length, name))
            return i;
    }
    return SIZE_MAX;
}

static const char *next_line(const char *line)
{
    const char *end = strchr(line, '\n');
    return end ? end + 1 : "";
}

/* The first line that has both columns; NULL: there is none, and `missing` is the column that no line has together with the
 * other. */
static const char *find_columns(const struct wave_file *file, const char *text, size_t columns[2], const char **missing)
{
    *missing = NULL;
    for (const char *line = text; *line; line = next_line(line)) {
        for (size_t i = 0; i < 2; i++)
            columns[i] = column_of(line, file->columns[i], i);
        if (columns[0] != SIZE_MAX && columns[1] != SIZE_MAX)
            return line;
        if (!*missing || columns[0] != SIZE_MAX || columns[1] != SIZE_MAX)
            *missing = file->columns[columns[0] == SIZE_MAX ? 0 : 1];
    }
    return NULL;
}

static bool number_in(const char *line, size_t column, double *number)
{
    size_t length;
    char *end = NULL;
    const char *field = field_of(line, column, &length);
    if (!field || length == 0)
        return false;
    *number = strtod(field, &end);
    return end != field && (*end == '\0' || strchr(" \r\n", *end) || strchr(between, *end)) && isfinite(*number);
}

/* Instruments write their settings first, then the names of columns, and some of them units: numbers begin where both columns have
 * one. After that, empty lines and lines that begin with # are ignored. */
static enum bead_error write_points(const struct bead_reader *reader, const struct bead_at *at, const struct wave_file *file,
                                    const char *text, FILE *out)
{
    size_t columns[2], number = 1, points = 0;
    const char *missing, *line = text, *header = find_columns(file, text, columns, &missing);
    if (!header)
        return missing ? bead_wrong(reader, at, "%s has no column `%s`", file->name, missing)
                       : bead_wrong(reader, at, "%s is empty", file->name);
    for (; line < header; line = next_line(line))
        number++;
    for (; *line; line = next_line(line), number++) {
        double time, value;
        if (strchr("#\n\r", *line))
            continue;
        if (number_in(line, columns[0], &time) && number_in(line, columns[1], &value)) {
            fputs(points++ ? ", " : "", out);
            bead_write_number(out, time * file->time);
            fputc(' ', out);
            bead_write_number(out, value);
        } else if (points > 0)
            return bead_wrong(reader, at, "%s: line %zu has no two numbers in these columns", file->name, number);
    }
    return points > 0 ? BEAD_OK : bead_wrong(reader, at, "%s: no line has two numbers in these columns", file->name);
}

static enum bead_error points_text(const struct bead_reader *reader, const struct bead_at *at, const struct wave_file *file,
                                   const char *text, char **points)
{
    size_t size;
    FILE *out = open_memstream(points, &size);
    if (!out)
        return bead_no_memory(reader);
    enum bead_error err = write_points(reader, at, file, text, out);
    return fclose(out) == 0 || err ? err : bead_no_memory(reader);
}

/* Reads the file and, as text, its points, which are the caller's. */
static enum bead_error file_points(const struct bead_reader *reader, const struct bead_at *at, const struct wave_file *file,
                                   char **points)
{
    struct bead_message why = {""};
    if (!file->name)
        return BEAD_WRONG_KEY(reader, at, "file", "is missing");
    BEAD_FREED char *path = bead_yaml_beside(reader->yaml, bead_node_get(at->node, "file", NULL), file->name), *text = NULL;
    size_t length = 0;
    if (!path)
        return bead_no_memory(reader);
    enum bead_error err = bead_yaml_read_part(reader->yaml, path, MOST_BYTES, &text, &length, &why);
    if (err)
        return err == BEAD_ERROR_MEMORY ? bead_no_memory(reader) : bead_wrong(reader, at, "%s", why.text);
    return points_text(reader, at, file, text, points);
}

static enum bead_error take_points(struct bead_reader *reader, const struct bead_at *at, const struct bead_options *options,
                                   const char **points)
{
    BEAD_LEFT_TO(forget) struct wave_file file = {0};
    BEAD_FREED char *text = NULL;
    BEAD_TRY(bead_options_read(reader, at, options, &file));
    BEAD_TRY(file_points(reader, at, &file, &text));
    *points = bead_yaml_text(reader->yaml, text, strlen(text));
    return *points ? BEAD_OK : bead_no_memory(reader);
}

/* Settings, which may be applied to the scene again, may name another file, or read the file in another way. */
static enum bead_error keep(const struct bead_reader *reader, struct bead_node *node)
{
    node->was = bead_yaml_copy(reader->yaml, node, node->place, NULL);
    return node->was ? BEAD_OK : bead_no_memory(reader);
}

/* The map becomes its points. */
static enum bead_error take_wave(struct bead_reader *reader, const struct bead_at *at)
{
    struct bead_node *node = (struct bead_node *)(uintptr_t)at->node; /* of the document that is changed here */
    BEAD_TRY(keep(reader, node));
    BEAD_TRY(take_points(reader, at, &bead_drive_file_options, &node->text));
    node->kind = BEAD_NODE_SCALAR;
    node->count = 0;
    node->plain = false;
    return BEAD_OK;
}

/* Replaces the keys of the map's file by its points; a name alone is a file's. */
static enum bead_error take_measured(struct bead_reader *reader, const struct bead_at *at, bool *changed)
{
    struct bead_node *node = (struct bead_node *)(uintptr_t)at->node;
    const char *points = NULL;
    size_t kept = 0;
    for (size_t i = 0; node->kind == BEAD_NODE_LIST && i < node->count; i++)
        BEAD_TRY(take_measured(reader, &(struct bead_at){at, NULL, i, node->items[i]}, changed));
    if (node->kind == BEAD_NODE_SCALAR) {
        struct bead_node *name = bead_yaml_scalar(reader->yaml, node->text, strlen(node->text), node->place);
        node->kind = BEAD_NODE_MAP;
        if (!name || !bead_yaml_put(reader->yaml, node, "file", 4, name))
            return bead_no_memory(reader);
        name->origin = node->origin;
    }
    if (node->kind == BEAD_NODE_LIST || bead_given(at, "points"))
        return BEAD_OK;
    BEAD_TRY(keep(reader, node));
    BEAD_TRY(take_points(reader, at, &bead_measured_options, &points));
    for (size_t i = 0; i < node->count; i += 2) {
        if (bead_options_find(&bead_drive_file_options, node->items[i]->text))
            continue;
        node->items[kept++] = node->items[i];
        node->items[kept++] = node->items[i + 1];
    }
    node->count = kept;
    *changed = true;
    struct bead_node *text = bead_yaml_scalar(reader->yaml, points, strlen(points), node->place);
    return bead_yaml_put(reader->yaml, node, "points", 6, text) ? BEAD_OK : bead_no_memory(reader);
}

enum bead_error bead_scene_take_waves(struct bead_reader *reader, const struct bead_at *at, bool *changed)
{
    static const char *const waves[] = {"displacement", "force", NULL};
    const struct bead_node *node = at->node;
    const bool drive = at->key && strcmp(at->key, "drive") == 0;
    for (size_t i = 0; node->kind == BEAD_NODE_LIST && i < node->count; i++)
        BEAD_TRY(bead_scene_take_waves(reader, &(struct bead_at){at, NULL, i, node->items[i]}, changed));
    for (size_t i = 0; node->kind == BEAD_NODE_MAP && i + 1 < node->count; i += 2) {
        const struct bead_at value = {at, node->items[i]->text, 0, node->items[i + 1]};
        if (strcmp(value.key, "measured") == 0) {
            BEAD_TRY(take_measured(reader, &value, changed));
            continue;
        }
        if (!drive || value.node->kind != BEAD_NODE_MAP || !bead_is_one_of(value.key, waves)) {
            BEAD_TRY(bead_scene_take_waves(reader, &value, changed));
            continue;
        }
        BEAD_TRY(take_wave(reader, &value));
        *changed = true;
    }
    return BEAD_OK;
}

/* ---- points as text ---- */

static bool read_two(const char **text, struct bead_wave_point *p)
{
    char *end = NULL, *last = NULL;
    p->time = strtod(*text, &end);
    p->value = strtod(end, &last);
    const bool good = end != *text && last != end && isfinite(p->time) && isfinite(p->value);
    *text = last + strspn(last, " ");
    return good;
}

/* "0 0, 1e-6 0.25, ...": seconds and values. */
enum bead_error bead_wave_points_read(const struct bead_reader *reader, const struct bead_at *at, const char *shape,
                                      struct bead_wave_point **points, size_t *count)
{
    const char *text;
    BEAD_TRY(bead_read_scalar(reader, at, shape, &text));
    size_t most = 1;
    for (const char *c = text; *c; c++)
        most += *c == ',';
    if (most < 2 || most > MOST_POINTS)
        return bead_wrong(reader, at, "has %zu points; must be %s, of 2 to %d", most, shape, MOST_POINTS);
    BEAD_TRY(bead_new(points, most, reader->msg, "a wave"));
    while (*count < most) {
        struct bead_wave_point *p = &(*points)[*count];
        if (!read_two(&text, p) || *text != (*count + 1 < most ? ',' : '\0'))
            return bead_wrong(reader, at, "point %zu is not `time value`; must be %s", *count + 1, shape);
        if ((*count)++ > 0 && !(p->time > p[-1].time))
            return bead_wrong(reader, at, "point %zu, at %g s, is not later than the one before", *count, p->time);
        text++;
    }
    return BEAD_OK;
}

/* ---- what was measured ---- */

/* By the conversion of its map: value = offset + gain times the column, time = start + the column's time. */
static enum bead_error read_measured(struct bead_reader *reader, const struct bead_at *at, const char *unit,
                                     struct bead_measured *measured)
{
    const struct bead_option number = {.type = BEAD_OPTION_NUMBER, .unit = unit, .low = -1e12, .high = 1e12};
    const struct bead_at gain_at = bead_at_key(at, "gain"), offset_at = bead_at_key(at, "offset"),
                         points = bead_at_key(at, "points");
    BEAD_LEFT_TO(forget) struct wave_file file = {0};
    double gain = 1, offset = 0;
    BEAD_TRY(bead_options_read(reader, at, &bead_measured_options, &file));
    if (file.name || !bead_given(at, "points"))
        return BEAD_WRONG_KEY(reader, at, "file", file.name ? "is given beside `points`" : "is missing");
    if (bead_given(at, "gain"))
        BEAD_TRY(bead_read_number(reader, &gain_at, &number, &gain));
    if (bead_given(at, "offset"))
        BEAD_TRY(bead_read_number(reader, &offset_at, &number, &offset));
    BEAD_TRY(bead_wave_points_read(reader, &points, "`time value, ...`", &measured->points, &measured->count));
    for (size_t i = 0; i < measured->count; i++) {
        measured->points[i].time += file.start;
        measured->points[i].value = offset + gain * measured->points[i].value;
    }
    return BEAD_OK;
}

BEAD_OPTION_READER(bead_output_read_measured)
{
    struct bead_output *output = settings;
    struct bead_curves_asked *curves = &output->curves;
    const bool list = at->node->kind == BEAD_NODE_LIST;
    const size_t count = list ? at->node->count : 1;
    if (count == 0 || count > MOST_MEASURED)
        return bead_must_be(reader, at, option->shape);
    if (output->plot.normalise != BEAD_NORMALISE_NONE)
        return bead_wrong(reader, at, "is in the unit of the field: leave `normalise` out");
    BEAD_TRY(bead_new(&curves->measured, count, reader->msg, "an output"));
    while (curves->measured_count < count) {
        const struct bead_at item = bead_at_item(at, curves->measured_count);
        struct bead_measured *measured = &curves->measured[curves->measured_count++];
        BEAD_TRY(read_measured(reader, &item, bead_field_info(output->shown.field)->unit, measured));
    }
    return BEAD_OK;
}
