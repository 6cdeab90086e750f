/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts in JPEG, GIF, TIFF and WebP, whose encoders do not write any. */
#include <stdlib.h>

#include "render/origin/origin_private.h"

/* ---- JPEG (ITU-T T.81, B.1.1.4): segments, each 0xff, its kind, and its length with the two bytes of this ---- */

enum { JPEG_START = 2, JPEG_APP0 = 0xe0, JPEG_APP15 = 0xef, JPEG_SCAN = 0xda, JPEG_COMMENT = 0xfe, JPEG_MOST = 65533 };

void origin_get_jpeg(struct origin_span file, FILE *text)
{
    size_t at = JPEG_START;
    while (origin_big(file, at, 1) == 0xff && origin_big(file, at + 1, 1) != JPEG_SCAN) {
        const size_t length = origin_big(file, at + 2, 2);
        if (length < 2)
            return;
        const struct origin_span part = origin_part(file, at + 4, length - 2);
        if (origin_big(file, at + 1, 1) == JPEG_COMMENT)
            fwrite(part.bytes, 1, part.length, text);
        at += 2 + length;
    }
}

/* Follows the segments of applications, since JFIF's must be the first; a long text has several. */
bool origin_put_jpeg(struct origin_file *file, struct origin_span text)
{
    unsigned char head[4];
    off_t at = JPEG_START;
    bool good;
    while ((good = origin_read_at(file, at, head, sizeof head) && head[0] == 0xff) && head[1] >= JPEG_APP0 && head[1] <= JPEG_APP15)
        at += 2 + (head[2] << 8 | head[3]);
    if (!good)
        return false;
    struct origin_block block;
    origin_block_begin(&block);
    for (size_t done = 0; block.file && done < text.length;) {
        const struct origin_span part = origin_part(text, done, JPEG_MOST);
        origin_put_big(0xff00 | JPEG_COMMENT, 2, block.file);
        origin_put_big(part.length + 2, 2, block.file);
        fwrite(part.bytes, 1, part.length, block.file);
        done += part.length;
    }
    return origin_insert(file, at, &block);
}

/* ---- GIF 89a: blocks of at most 255 bytes, each preceded by its length; the last one is empty ---- */

enum { GIF_HEAD = 13, GIF_EXTENSION = 0x21, GIF_COMMENT = 0xfe, GIF_IMAGE = 0x2c, GIF_END = 0x3b, GIF_BLOCK = 255 };

/* The number of bytes of the colours announced by these flags. */
static size_t gif_colours(uint64_t flags)
{
    return flags & 0x80 ? (size_t)3 << ((flags & 7) + 1) : 0;
}

void origin_get_gif(struct origin_span file, FILE *text)
{
    size_t at = GIF_HEAD + gif_colours(origin_big(file, 10, 1));
    while (origin_begins(file, "GIF8", 4) && at < file.length) {
        const uint64_t kind = file.bytes[at];
        const bool comment = kind == GIF_EXTENSION && origin_big(file, at + 1, 1) == GIF_COMMENT;
        if (kind != GIF_EXTENSION && kind != GIF_IMAGE)
            return;
        at += kind == GIF_EXTENSION ? 2 : 11 + gif_colours(origin_big(file, at + 9, 1));
        for (size_t length; (length = origin_big(file, at, 1)) > 0; at += 1 + length) {
            const struct origin_span part = origin_part(file, at + 1, length);
            if (comment)
                fwrite(part.bytes, 1, part.length, text);
        }
        at++;
    }
}

bool origin_put_gif(struct origin_file *file, struct origin_span text)
{
    unsigned char end;
    if (!origin_read_at(file, file->size - 1, &end, 1) || end != GIF_END)
        return false;
    struct origin_block block;
    origin_block_begin(&block);
    if (block.file) {
        origin_put_big(GIF_EXTENSION << 8 | GIF_COMMENT, 2, block.file);
        for (size_t at = 0; at < text.length; at += GIF_BLOCK) {
            const struct origin_span part = origin_part(text, at, GIF_BLOCK);
            fputc((int)part.length, block.file);
            fwrite(part.bytes, 1, part.length, block.file);
        }
        fputc(0, block.file);
    }
    return origin_insert(file, file->size - 1, &block);
}

/* ---- TIFF 6.0, as it is written here, with the low byte first: a list of 12 bytes for each value, sorted by their tags ---- */

enum { TIFF_DESCRIPTION = 270, TIFF_TEXT = 2, TIFF_ENTRY = 12, TIFF_MOST = 64 };
static const char tiff_begin[] = {'I', 'I', 42, 0};

void origin_get_tiff(struct origin_span file, FILE *text)
{
    const size_t list = origin_little(file, 4, 4), count = origin_little(file, list, 2);
    for (size_t i = 0; origin_begins(file, tiff_begin, sizeof tiff_begin) && i < count; i++) {
        const size_t entry = list + 2 + i * TIFF_ENTRY, length = origin_little(file, entry + 4, 4);
        if (origin_little(file, entry, 2) != TIFF_DESCRIPTION || origin_little(file, entry + 2, 2) != TIFF_TEXT || length == 0)
            continue;
        origin_offer(origin_part(file, origin_little(file, entry + 8, 4), length - 1), text);
        return;
    }
}

static void put_tiff_text(struct origin_span text, off_t at, FILE *file)
{
    origin_put_little(TIFF_DESCRIPTION, 2, file);
    origin_put_little(TIFF_TEXT, 2, file);
    origin_put_little(text.length + 1, 4, file);
    origin_put_little((uint64_t)at, 4, file);
}

/* Appends the text, and a new list that includes it. The old list stays in place. */
bool origin_put_tiff(struct origin_file *file, struct origin_span text)
{
    unsigned char head[8], list[2 + TIFF_ENTRY * TIFF_MOST];
    const struct origin_span begin = {head, sizeof head};
    if (!origin_read_at(file, 0, head, sizeof head) || !origin_begins(begin, tiff_begin, sizeof tiff_begin))
        return false;
    const off_t old = (off_t)origin_little(begin, 4, 4), at = file->size + file->size % 2;
    if (!origin_read_at(file, old, list, 2))
        return false;
    const size_t count = origin_little((struct origin_span){list, 2}, 0, 2);
    if (count > TIFF_MOST || !origin_read_at(file, old, list, 2 + count * TIFF_ENTRY))
        return false;
    struct origin_block block;
    origin_block_begin(&block);
    const off_t made = at + (off_t)(text.length + 1 + (text.length + 1) % 2);
    if (block.file) {
        origin_put_little(0, (int)(at - file->size), block.file);
        fwrite(text.bytes, 1, text.length, block.file);
        origin_put_little(0, (int)(1 + (text.length + 1) % 2), block.file);
        origin_put_little(count + 1, 2, block.file);
        bool put = false;
        for (size_t i = 0; i < count; i++) {
            const unsigned char *entry = list + 2 + i * TIFF_ENTRY;
            if (!put && origin_little((struct origin_span){entry, 2}, 0, 2) > TIFF_DESCRIPTION) {
                put_tiff_text(text, at, block.file);
                put = true;
            }
            fwrite(entry, 1, TIFF_ENTRY, block.file);
        }
        if (!put)
            put_tiff_text(text, at, block.file);
        origin_put_little(0, 4, block.file); /* no further picture */
    }
    const unsigned char place[] = {(unsigned char)made, (unsigned char)(made >> 8), (unsigned char)(made >> 16),
                                   (unsigned char)(made >> 24)};
    return made <= UINT32_MAX && origin_insert(file, file->size, &block) && origin_write_at(file, 4, place, sizeof place);
}

/* ---- WebP (RFC 9649): chunks of even lengths. Only the extended kind, which begins with VP8X, has texts. ---- */

enum { WEBP_HEAD = 12, CHUNK_HEAD = 8, WEBP_XMP = 4, WEBP_ALPHA = 16, WEBP_FLAGS = WEBP_HEAD + CHUNK_HEAD };

void origin_get_webp(struct origin_span file, FILE *text)
{
    size_t at = WEBP_HEAD;
    while (origin_begins(file, "RIFF", 4) && at + CHUNK_HEAD < file.length) {
        const size_t length = origin_little(file, at + 4, 4);
        if (origin_begins(origin_part(file, at, 4), "XMP ", 4)) {
            origin_get_xmp(origin_part(file, at + CHUNK_HEAD, length), text);
            return;
        }
        at += CHUNK_HEAD + length + length % 2;
    }
}

/* Makes a lossless still one of the extended kind. Its bits are width - 1 and height - 1, 14 of each, and a flag for alpha. */
static bool extend_webp(struct origin_file *file)
{
    unsigned char head[CHUNK_HEAD + 5];
    const struct origin_span chunk = {head, sizeof head};
    if (!origin_read_at(file, WEBP_HEAD, head, sizeof head))
        return false;
    if (origin_begins(chunk, "VP8X", 4))
        return true;
    const uint64_t bits = origin_little(chunk, CHUNK_HEAD + 1, 4);
    if (!origin_begins(chunk, "VP8L", 4) || head[CHUNK_HEAD] != 0x2f)
        return false;
    struct origin_block block;
    origin_block_begin(&block);
    if (block.file) {
        fputs("VP8X", block.file);
        origin_put_little(10, 4, block.file);
        origin_put_little(bits >> 28 & 1 ? WEBP_ALPHA : 0, 4, block.file);
        origin_put_little(bits & 0x3fff, 3, block.file);
        origin_put_little(bits >> 14 & 0x3fff, 3, block.file);
    }
    return origin_insert(file, WEBP_HEAD, &block);
}

bool origin_put_webp(struct origin_file *file, struct origin_span text)
{
    unsigned char head[WEBP_FLAGS + 1];
    struct origin_block packet, block;
    if (file->size % 2 != 0 || !extend_webp(file) || !origin_read_at(file, 0, head, sizeof head)) /* chunks begin at even places */
        return false;
    const bool whole = origin_make_xmp(text, &packet);
    origin_block_begin(&block);
    if (whole && block.file) {
        fputs("XMP ", block.file);
        origin_put_little(packet.length, 4, block.file);
        fwrite(packet.bytes, 1, packet.length, block.file);
        origin_put_little(0, (int)(packet.length % 2), block.file);
    }
    free(packet.bytes);
    if (!origin_insert(file, file->size, &block) || !whole)
        return false;
    const uint64_t size = (uint64_t)file->size - CHUNK_HEAD;
    for (int i = 0; i < 4; i++)
        head[4 + i] = (unsigned char)(size >> 8 * i);
    head[WEBP_FLAGS] |= WEBP_XMP;
    return size <= UINT32_MAX && origin_write_at(file, 0, head, sizeof head);
}
