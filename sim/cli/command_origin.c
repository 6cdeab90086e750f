/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the scene in a file that was made of it. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/cli/command_line.h"
#include "sim/hdf5/h5.h"
#include "sim/yaml/yaml.h"

/* Films, PDF and SVG files say "beadreel 0.1.0, scene:", and the scene from the next line on. */
static const char program[] = "beadreel ", mark[] = ", scene:\n", html_mark[] = "<code id=\"scene-text\">";
static const size_t most_bytes = (size_t)1 << 31;

static unsigned long big_endian(const unsigned char *bytes, int count)
{
    unsigned long value = 0;
    for (int i = 0; i < count; i++)
        value = value << 8 | bytes[i];
    return value;
}

/* Returns the length of the text at `text`, from what precedes it: the atom `data` of MP4 files, the element TagString of
 * Matroska's. 0: by neither. */
static size_t told_length(const unsigned char *bytes, const unsigned char *text)
{
    const ptrdiff_t before = text - bytes;
    if (before >= 16 && memcmp(text - 12, "data", 4) == 0)
        return big_endian(text - 16, 4) - 16;
    for (int n = 1; n <= 8 && before >= n + 2; n++) {
        const unsigned char *size = text - n;
        if (size[-2] == 0x44 && size[-1] == 0x87 && size[0] >> (8 - n) == 1)
            return big_endian(size, n) & ~(1ul << (7 * n));
    }
    return 0;
}

/* In place: XML's and HTML's names of characters become these. */
static void unescape(char *text)
{
    static const struct {
        const char *name;
        char character;
    } names[] = {{"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&#39;", '\''}, {"&apos;", '\''}, {"&amp;", '&'}};
    char *to = text;
    while (*text) {
        size_t length = 1;
        *to = *text;
        for (size_t i = 0; *text == '&' && length == 1 && i < sizeof names / sizeof *names; i++) {
            if (strncmp(text, names[i].name, strlen(names[i].name)) == 0) {
                *to = names[i].character;
                length = strlen(names[i].name);
            }
        }
        to++;
        text += length;
    }
    *to = 0;
}

static enum bead_error keep(const char *begin, size_t length, bool escaped, struct command_origin *origin, struct bead_message *msg)
{
    origin->scene = strndup(begin, length);
    if (!origin->scene)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a scene");
    if (escaped)
        unescape(origin->scene);
    return BEAD_OK;
}

static enum bead_error find_in_bytes(const char *bytes, size_t length, struct command_origin *origin, struct bead_message *msg)
{
    const char *limit = bytes + length, *found = memmem(bytes, length, html_mark, strlen(html_mark));
    if (found) {
        const char *begin = found + strlen(html_mark), *end = memmem(begin, (size_t)(limit - begin), "</code>", 7);
        return end ? keep(begin, (size_t)(end - begin), true, origin, msg) : BEAD_OK;
    }
    for (const char *at = bytes; (found = memmem(at, (size_t)(limit - at), mark, strlen(mark))); at = found + 1) {
        const char *name = found;
        while (name > bytes && found - name < 40 && (name == found || !isspace((unsigned char)name[-1])))
            name--;
        const char *text = name - strlen(program), *begin = found + strlen(mark), *end = NULL;
        if (text < bytes || memcmp(text, program, strlen(program)) != 0)
            continue;
        const size_t whole = told_length((const unsigned char *)bytes, (const unsigned char *)text);
        const bool xml = whole == 0 && (end = memmem(begin, (size_t)(limit - begin), "</metadata>", 11));
        if (whole > (size_t)(begin - text) && whole <= (size_t)(limit - text))
            end = text + whole;
        else if (!end)
            end = memmem(begin, (size_t)(limit - begin), "\nendstream", 10);
        if (!end)
            continue;
        snprintf(origin->version, sizeof origin->version, "%.*s", (int)(found - name), name);
        return keep(begin, (size_t)(end - begin), xml, origin, msg);
    }
    return BEAD_OK;
}

static enum bead_error find_in_h5(const char *path, struct command_origin *origin, struct bead_message *msg)
{
    static const char profile[] = "/parameters/beadreel";
    struct bead_h5 h5;
    char said[64] = "";
    bead_h5_open(&h5, path, "result", msg);
    const bool trajectory = !h5.error && bead_h5_has(&h5, profile);
    hid_t group = trajectory ? bead_h5_open_group(&h5, profile) : -1;
    if (trajectory) {
        bead_h5_get_text(&h5, group, "file", origin->file, sizeof origin->file);
        bead_h5_get_text(&h5, group, "program", said, sizeof said);
    }
    if (!h5.error)
        origin->scene = bead_h5_read_text(&h5, trajectory ? "/parameters/beadreel/scene" : "/scene", BEAD_YAML_BYTES + 1);
    if (strncmp(said, program, strlen(program)) == 0)
        snprintf(origin->version, sizeof origin->version, "%.31s", said + strlen(program));
    bead_h5_close(&h5, &group);
    bead_h5_shut(&h5);
    return h5.error;
}

enum bead_error command_find_origin(const struct command *command, const char *path, struct command_origin *origin,
                                    struct bead_message *msg)
{
    const char *dot = strrchr(path, '.');
    *origin = (struct command_origin){.scene = NULL};
    if (dot && strcasecmp(dot, ".h5") == 0)
        return find_in_h5(path, origin, msg);
    if (dot && strcasecmp(dot, ".png") == 0)
        return command->program->source_of_png
                   ? command->program->source_of_png(path, &origin->scene, origin->version, sizeof origin->version, msg)
                   : BEAD_OK;
    BEAD_FREED char *bytes = NULL;
    size_t length = 0;
    BEAD_TRY(bead_file_read(path, most_bytes, &bytes, &length, msg));
    return find_in_bytes(bytes, length, origin, msg);
}
