/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the scene of a PNG file, which stands before its pixels. */
#include "render/draw/picture.h"

#include <errno.h>
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void on_error(png_structp png, png_const_charp)
{
    longjmp(*(jmp_buf *)png_get_error_ptr(png), 1);
}

static void on_warning(png_structp, png_const_charp) {}

static enum bead_error copy(png_structp png, png_infop info, char **source, char *version, size_t size, struct bead_message *msg)
{
    png_textp texts = NULL;
    const int count = png_get_text(png, info, &texts, NULL);
    static const char program[] = "beadreel ";
    for (int i = 0; i < count; i++) {
        if (strcmp(texts[i].key, "Software") == 0 && strncmp(texts[i].text, program, strlen(program)) == 0)
            snprintf(version, size, "%s", texts[i].text + strlen(program));
        if (strcmp(texts[i].key, "Source") != 0 || *source)
            continue;
        *source = strdup(texts[i].text);
        if (!*source)
            return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a scene");
    }
    return BEAD_OK;
}

static enum bead_error read_info(const char *path, FILE *file, png_structp png, png_infop info, jmp_buf *jump, char **source,
                                 char *version, size_t size, struct bead_message *msg)
{
    if (setjmp(*jump))
        return bead_fail(msg, BEAD_ERROR_FORMAT, "%s: not a whole PNG file", path);
    png_init_io(png, file);
    png_read_info(png, info);
    return copy(png, info, source, version, size, msg);
}

enum bead_error bead_png_source(const char *path, char **source, char *version, size_t size, struct bead_message *msg)
{
    *source = NULL;
    *version = 0;
    FILE *file = fopen(path, "rbe");
    if (!file)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: %s", path, strerror(errno));
    jmp_buf jump;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &jump, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    enum bead_error err = info ? read_info(path, file, png, info, &jump, source, version, size, msg)
                               : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a PNG file");
    png_destroy_read_struct(&png, &info, NULL);
    fclose(file);
    return err;
}
