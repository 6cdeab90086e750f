/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of formats, and their shared functions. */
#include "render/origin/origin_private.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/base/sandbox.h"
#include "sim/kinds/output_kinds.h"
#include "sim/yaml/yaml.h"

struct format {
    const char *endings;
    origin_get *get;
    origin_put *put; /* NULL: the writer of the file also writes the text */
};

static const struct format formats[] = {
    {".png, .apng", origin_get_png, origin_put_png},
    {".jpg, .jpeg", origin_get_jpeg, origin_put_jpeg},
    {".tif, .tiff", origin_get_tiff, origin_put_tiff},
    {".webp", origin_get_webp, origin_put_webp},
    {".gif", origin_get_gif, origin_put_gif},
    {".avif", origin_get_boxes, origin_put_boxes},
    {".mp4, .mov", origin_get_boxes, NULL},
    {".mkv, .webm", origin_get_matroska, NULL},
    {".svg", origin_get_svg, NULL},
    {".pdf", origin_get_pdf, NULL},
    {".eps", origin_get_eps, NULL},
    {".html", origin_get_html, NULL},
};

enum { FORMATS = sizeof formats / sizeof *formats };

/* Films with more bytes than this are not read whole into memory; a text has a scene, preceded by words. */
static const size_t most_bytes = (size_t)1 << 31, most_text = 2 * BEAD_YAML_BYTES;

static const struct format *find_format(const char *path)
{
    for (size_t i = 0; i < FORMATS; i++) {
        if (bead_output_ends_like(formats[i].endings, path))
            return &formats[i];
    }
    return NULL;
}

const char *bead_origin_endings(size_t index)
{
    return index < FORMATS ? formats[index].endings : NULL;
}

/* ---- writing ---- */

enum bead_error bead_origin_text(const char *description, const char *scene, char **text, struct bead_message *msg)
{
    const char *words = description ? description : "";
    if (asprintf(text, "%s%s" BEAD_ORIGIN_HEAD "%s", words, *words ? "\n\n" : "", scene ? scene : "") < 0)
        *text = NULL;
    return *text ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the scene in a file");
}

bool bead_origin_is_put(const char *path)
{
    const struct format *format = find_format(path);
    return format && format->put;
}

enum bead_error bead_origin_put(const char *path, int descriptor, const char *text, struct bead_message *msg)
{
    const struct format *format = find_format(path);
    struct stat status;
    errno = 0;
    if (fstat(descriptor, &status) == 0) {
        struct origin_file file = {descriptor, status.st_size};
        if (format->put(&file, (struct origin_span){(const unsigned char *)text, strlen(text)}))
            return BEAD_OK;
    }
    return errno == ENOMEM ? bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", path)
                           : bead_fail(msg, BEAD_ERROR_IO, "%s: its scene cannot be written into it%s%s", path, errno ? ": " : "",
                                       errno ? strerror(errno) : "");
}

static enum bead_error take(struct origin_span text, char **scene, char *version, size_t size, struct bead_message *msg)
{
    struct origin_span said;
    size_t end;
    if (!origin_find_head(text, &said, &end) || text.length - end > BEAD_YAML_BYTES)
        return BEAD_OK;
    snprintf(version, size, "%.*s", (int)said.length, (const char *)said.bytes);
    *scene = strndup((const char *)text.bytes + end, text.length - end);
    return *scene ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a scene");
}

enum bead_error bead_origin_find(const char *path, const void *bytes, size_t length, char **scene, char *version, size_t size,
                                 struct bead_message *msg)
{
    const struct format *format = find_format(path);
    *scene = NULL;
    *version = 0;
    if (!format)
        return BEAD_OK;
    struct origin_block text;
    origin_block_begin(&text);
    if (text.file)
        format->get((struct origin_span){bytes, length}, text.file);
    const bool whole = text.file && fclose(text.file) == 0;
    const BEAD_FREED char *found = text.bytes;
    return whole ? take((struct origin_span){(const unsigned char *)found, text.length}, scene, version, size, msg)
                 : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the text of a file");
}

struct sought {
    const struct format *format;
    struct origin_span file;
};

static void find_text(const void *context, FILE *text)
{
    const struct sought *sought = context;
    sought->format->get(sought->file, text);
}

enum bead_error bead_origin_read(const char *path, char **scene, char *version, size_t size, struct bead_message *msg)
{
    BEAD_FREED char *bytes = NULL, *text = NULL;
    size_t length = 0, count = 0;
    struct sought sought = {.format = find_format(path)};
    *scene = NULL;
    *version = 0;
    if (!sought.format)
        return BEAD_OK;
    BEAD_TRY(bead_file_read(path, most_bytes, &bytes, &length, msg));
    sought.file = (struct origin_span){(const unsigned char *)bytes, length};
    BEAD_TRY(bead_sandbox_ask(path, find_text, &sought, most_text, &text, &count, msg));
    return take((struct origin_span){(const unsigned char *)text, count}, scene, version, size, msg);
}
