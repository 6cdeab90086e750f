/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts in PNG files: of stills before the pixels, by libpng; of animations, written by libav, at the end. */
#include <png.h>
#include <setjmp.h>
#include <string.h>

#include "render/origin/origin_private.h"

/* ---- reading ---- */

struct reader {
    struct origin_span rest; /* the bytes not yet read by libpng */
    jmp_buf jump;
};

static void on_error(png_structp png, png_const_charp)
{
    struct reader *reader = png_get_error_ptr(png);
    longjmp(reader->jump, 1);
}

static void on_warning(png_structp, png_const_charp) {}

static void on_read(png_structp png, png_bytep data, size_t length)
{
    struct reader *reader = png_get_io_ptr(png);
    if (reader->rest.length < length)
        png_error(png, "ends too early");
    memcpy(data, reader->rest.bytes, length);
    reader->rest = origin_part(reader->rest, length, SIZE_MAX);
}

static const char *find(png_structp png, png_infop info, const char *key)
{
    png_textp texts = NULL;
    const int count = png_get_text(png, info, &texts, NULL);
    for (int i = 0; i < count; i++) {
        if (strcmp(texts[i].key, key) == 0 && texts[i].text)
            return texts[i].text;
    }
    return NULL;
}

/* All calls of libpng that may longjmp. Pixels are skipped, and so are the pictures of an animation, which libpng does not know. */
static void read_texts(struct reader *reader, png_structp png, png_infop info, png_infop end, FILE *text)
{
    if (setjmp(reader->jump))
        return;
    png_set_read_fn(png, reader, on_read);
    png_set_benign_errors(png, 1);
    /* The texts of a file with damaged pixels are searched, too. */
    png_set_crc_action(png, PNG_CRC_QUIET_USE, PNG_CRC_QUIET_USE);
    png_read_info(png, info);
    const char *program = find(png, info, "Software"), *scene = find(png, info, "Source");
    if (program && scene) {
        fprintf(text, "%s, scene:\n%s", program, scene);
        return;
    }
    png_start_read_image(png); /* else png_read_end does not skip the rest of a chunk of pixels */
    png_read_end(png, end);
    const char *comment = find(png, end, "Comment");
    if (comment)
        fputs(comment, text);
}

void origin_get_png(struct origin_span file, FILE *text)
{
    struct reader reader = {.rest = file};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL, end = png ? png_create_info_struct(png) : NULL;
    if (info && end)
        read_texts(&reader, png, info, end, text);
    png_destroy_read_struct(&png, &info, &end);
}

/* ---- writing: a chunk iTXt, with UTF-8 text, not compressed, without a language, before the last chunk ---- */

enum { PNG_CHUNK = 12 /* the bytes of one without contents */ };

/* CRC-32 of ISO 3309, as in PNG. */
static uint32_t crc(const char *bytes, size_t length)
{
    uint32_t value = UINT32_MAX;
    for (size_t i = 0; i < length; i++) {
        value ^= (unsigned char)bytes[i];
        for (int bit = 0; bit < 8; bit++)
            value = value >> 1 ^ (value & 1 ? 0xedb88320u : 0);
    }
    return ~value;
}

bool origin_put_png(struct origin_file *file, struct origin_span text)
{
    static const char last[PNG_CHUNK] = "\0\0\0\0IEND\xae\x42\x60\x82", head[] = "iTXtComment\0\0\0\0"; /* with the final zero */
    char found[PNG_CHUNK];
    const off_t at = file->size - PNG_CHUNK;
    if (!origin_read_at(file, at, found, sizeof found) || memcmp(found, last, sizeof last) != 0)
        return false;
    struct origin_block block;
    origin_block_begin(&block);
    if (block.file) {
        origin_put_big(sizeof head - 4 + text.length, 4, block.file);
        fwrite(head, 1, sizeof head, block.file);
        fwrite(text.bytes, 1, text.length, block.file);
        fflush(block.file);
        if (block.bytes)
            origin_put_big(crc(block.bytes + 4, block.length - 4), 4, block.file);
    }
    return origin_insert(file, at, &block);
}
