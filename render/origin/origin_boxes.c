/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts in files of nested boxes: MP4, MOV and AVIF (ISO/IEC 14496-12), WebM and Matroska (RFC 8794). */
#include <stdlib.h>
#include <string.h>

#include "render/origin/origin_private.h"

/* Boxes of a stranger's file may be nested as deep as it is long. */
enum { DEEPEST = 8 };

/* ---- MP4, MOV and AVIF: a length of 32 bits, which includes itself, a name of four letters, the contents ---- */

enum { BOX_HEAD = 8, BOX_UUID = 16, DATA_HEAD = 8 };

/* XMP (ISO 16684-3) has this in place of a name. */
static const unsigned char xmp_uuid[BOX_UUID] = {0xbe, 0x7a, 0xcf, 0xcb, 0x97, 0xa9, 0x42, 0xe8,
                                                 0x9c, 0x71, 0x99, 0x94, 0x91, 0xe3, 0xaf, 0xac};

/* Takes the first box of a span; its contents and name. False: there is none. */
static bool next_box(struct origin_span *span, struct origin_span *contents, char name[4])
{
    uint64_t head = BOX_HEAD, length = origin_big(*span, 0, 4);
    if (span->length < BOX_HEAD)
        return false;
    memcpy(name, span->bytes + 4, 4);
    if (length == 1) {
        length = origin_big(*span, BOX_HEAD, 8);
        head += 8;
    } else if (length == 0)
        length = span->length;
    if (length < head || length > span->length)
        return false;
    *contents = origin_part(*span, head, length - head);
    *span = origin_part(*span, length, SIZE_MAX);
    return true;
}

/* The boxes that lead to texts: moov/udta/meta/ilst/(c)cmt/data in MP4, moov/meta/ilst/1/data in MOV. Those of `ilst` have the
 * names of their kinds, or numbers. Returns the number of bytes to skip before the boxes within; -1: no text there. */
static int way_into(const char name[4], bool in_list)
{
    static const struct {
        char name[5];
        int skip;
    } ways[] = {{"moov", 0}, {"udta", 0}, {"meta", 4}, {"ilst", 0}};
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        if (memcmp(ways[i].name, name, 4) == 0)
            return ways[i].skip;
    }
    return in_list ? 0 : -1;
}

static bool offer_boxes(struct origin_span span, bool in_list, int depth, FILE *text)
{
    struct origin_span contents;
    char name[4];
    while (next_box(&span, &contents, name)) {
        const int skip = depth < DEEPEST ? way_into(name, in_list) : -1;
        const bool packet = depth == 0 && memcmp(name, "uuid", 4) == 0 && contents.length > BOX_UUID &&
                            memcmp(contents.bytes, xmp_uuid, BOX_UUID) == 0;
        if (packet)
            origin_get_xmp(origin_part(contents, BOX_UUID, SIZE_MAX), text);
        if (packet || (memcmp(name, "data", 4) == 0 && origin_offer(origin_part(contents, DATA_HEAD, SIZE_MAX), text)) ||
            (skip >= 0 &&
             offer_boxes(origin_part(contents, (size_t)skip, SIZE_MAX), memcmp(name, "ilst", 4) == 0, depth + 1, text)))
            return true;
    }
    return false;
}

void origin_get_boxes(struct origin_span file, FILE *text)
{
    offer_boxes(file, false, 0, text);
}

/* Appends the last box: readers of AVIF skip unknown boxes. */
bool origin_put_boxes(struct origin_file *file, struct origin_span text)
{
    struct origin_block packet, block;
    const bool whole = origin_make_xmp(text, &packet);
    origin_block_begin(&block);
    if (whole && block.file) {
        origin_put_big(BOX_HEAD + BOX_UUID + packet.length, 4, block.file);
        fputs("uuid", block.file);
        fwrite(xmp_uuid, 1, BOX_UUID, block.file);
        fwrite(packet.bytes, 1, packet.length, block.file);
    }
    free(packet.bytes);
    return origin_insert(file, file->size, &block) && whole;
}

/* ---- Matroska: elements. The first byte of an identifier tells its length by its leading zeros, that of a length likewise. ----
 */

enum { SEGMENT = 0x18538067, TAGS = 0x1254c367, TAG = 0x7373, SIMPLE_TAG = 0x67c8, TAG_STRING = 0x4487 };

/* Takes a number of at most `most` bytes from the span. False: there is none. */
static bool take_number(struct origin_span *span, size_t most, bool with_mark, uint64_t *number)
{
    size_t bytes = 1;
    while (bytes <= most && span->length > 0 && !(span->bytes[0] >> (8 - bytes) & 1))
        bytes++;
    if (bytes > most || bytes > span->length)
        return false;
    *number = origin_big(*span, 0, bytes);
    if (!with_mark)
        *number &= ~((uint64_t)1 << 7 * bytes);
    *span = origin_part(*span, bytes, SIZE_MAX);
    return true;
}

static bool offer_elements(struct origin_span span, int depth, FILE *text)
{
    uint64_t name, length;
    while (take_number(&span, 4, true, &name) && take_number(&span, 8, false, &length)) {
        const struct origin_span contents = origin_part(span, 0, length); /* an unknown length is longer than any */
        const bool leads = name == SEGMENT || name == TAGS || name == TAG || name == SIMPLE_TAG;
        if ((leads && depth < DEEPEST && offer_elements(contents, depth + 1, text)) ||
            (name == TAG_STRING && origin_offer(contents, text)))
            return true;
        span = origin_part(span, length, SIZE_MAX);
    }
    return false;
}

void origin_get_matroska(struct origin_span file, FILE *text)
{
    offer_elements(file, 0, text);
}
