/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Waves of drives from files: their points become a part of the scene's text, so that the text stored in trajectories is complete.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/base/number.h"
#include "sim/scene/scene_private.h"

enum { MOST_BYTES = 1 << 24 };

struct wave_file {
    char *name, *columns[2];
    double time;
};

#define WAVE(member) offsetof(struct wave_file, member)

static BEAD_OPTION_READER(read_columns)
{
    struct wave_file *file = settings;
    char shown[64];
    if (at->node->kind != BEAD_NODE_LIST || at->node->count != 2)
        return bead_wrong(reader, at, "is %s; must be two names or numbers of columns",
                          bead_node_show(at->node, shown, sizeof shown));
    for (size_t i = 0; i < 2; i++) {
        const struct bead_at item = bead_at_item(at, i);
        BEAD_TRY(bead_read_text(reader, &item, &file->columns[i]));
    }
    return BEAD_OK;
}

static const struct bead_option file_rows[] = {
    {"file", BEAD_OPTION_TEXT, WAVE(name), .required = true,
     .help = "comma-separated values, seen from the directory of the scene; what is read becomes a part of the scene",
     .example = "scope.csv"},
    {"columns", BEAD_OPTION_CUSTOM, .shape = "two names or numbers of columns", .like = "[2 text|number]", .read = read_columns,
     .help = "the columns of time and value; [1, 2] unless given", .example = "[time, force]"},
    {"time", BEAD_OPTION_NUMBER, WAVE(time), .unit = "s", .initial = "1 s", .low = 0, .high = 1e6, .open = BEAD_OPEN_LOW,
     .help = "what 1 is in the column of time", .example = "1 us"},
};
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

/* SIZE_MAX: the header has no such column. */
static size_t column_of(const char *header, const char *name)
{
    size_t length;
    const char *field;
    char *end = NULL;
    const unsigned long number = strtoul(name, &end, 10);
    if (*name && !*end)
        return number > 0 ? number - 1 : SIZE_MAX;
    for (size_t i = 0; (field = field_of(header, i, &length)); i++) {
        if (length == strlen(name) && strncmp(field, name, length) == 0)
            return i;
    }
    return SIZE_MAX;
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

/* The first line may have names instead of numbers; lines without anything, and those that begin with #, count for nothing. */
static enum bead_error write_points(const struct bead_reader *reader, const struct bead_at *at, const struct wave_file *file,
                                    const char *text, FILE *out)
{
    size_t columns[2], number = 1, points = 0;
    for (size_t i = 0; i < 2; i++) {
        columns[i] = file->columns[i] ? column_of(text, file->columns[i]) : i;
        if (columns[i] == SIZE_MAX)
            return bead_wrong(reader, at, "%s has no column `%s`", file->name, file->columns[i]);
    }
    for (const char *line = text; line && *line; line = strchr(line, '\n'), line += line != NULL, number++) {
        double time, value;
        if (*line == '#' || *line == '\n' || *line == '\r')
            continue;
        if (number_in(line, columns[0], &time) && number_in(line, columns[1], &value)) {
            fputs(points++ ? ", " : "", out);
            bead_write_number(out, time * file->time);
            fputc(' ', out);
            bead_write_number(out, value);
        } else if (number > 1)
            return bead_wrong(reader, at, "%s: line %zu has no two numbers in these columns", file->name, number);
    }
    return BEAD_OK;
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

static enum bead_error inline_file(struct bead_reader *reader, const struct bead_at *at, const struct wave_file *file)
{
    struct bead_node *node = (struct bead_node *)(uintptr_t)at->node; /* of the document that is changed here */
    const char *scene = bead_yaml_name(reader->yaml, NULL), *slash = strrchr(scene, '/');
    const bool beside = !node->origin && *file->name != '/' && slash;
    struct bead_message why = {""};
    BEAD_FREED char *path = NULL, *text = NULL, *points = NULL;
    size_t length = 0;
    if (asprintf(&path, "%.*s%s", beside ? (int)(slash - scene) + 1 : 0, scene, file->name) < 0) {
        path = NULL;
        return bead_no_memory(reader);
    }
    enum bead_error err = bead_file_read(path, MOST_BYTES, &text, &length, &why);
    if (err)
        return err == BEAD_ERROR_MEMORY ? bead_no_memory(reader) : bead_wrong(reader, at, "%s", why.text);
    BEAD_TRY(points_text(reader, at, file, text, &points));
    if (!(node->text = bead_yaml_text(reader->yaml, points, strlen(points))))
        return bead_no_memory(reader);
    node->kind = BEAD_NODE_SCALAR;
    node->count = 0;
    node->plain = false;
    return BEAD_OK;
}

static enum bead_error take_wave(struct bead_reader *reader, const struct bead_at *at)
{
    struct wave_file file = {0};
    enum bead_error err = bead_options_read(reader, at, &bead_drive_file_options, &file);
    if (!err)
        err = inline_file(reader, at, &file);
    free(file.name);
    free(file.columns[0]);
    free(file.columns[1]);
    return err;
}

enum bead_error bead_scene_take_waves(struct bead_reader *reader, const struct bead_at *at, bool *changed)
{
    const struct bead_node *node = at->node;
    const bool drive = at->key && strcmp(at->key, "drive") == 0;
    for (size_t i = 0; node->kind == BEAD_NODE_LIST && i < node->count; i++)
        BEAD_TRY(bead_scene_take_waves(reader, &(struct bead_at){at, NULL, i, node->items[i]}, changed));
    for (size_t i = 0; node->kind == BEAD_NODE_MAP && i + 1 < node->count; i += 2) {
        const struct bead_at value = {at, node->items[i]->text, 0, node->items[i + 1]};
        if (!drive || value.node->kind != BEAD_NODE_MAP) {
            BEAD_TRY(bead_scene_take_waves(reader, &value, changed));
            continue;
        }
        BEAD_TRY(take_wave(reader, &value));
        *changed = true;
    }
    return BEAD_OK;
}
