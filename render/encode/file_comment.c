/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inserts a comment before the last byte of a GIF file, or before the last chunk of a PNG file. encoder.c calls it before it closes
 * the part. */
#include "render/encode/file_comment.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { GIF_BLOCK = 255, PNG_END_BYTES = 12 };

/* The comment and the end that was there. */
struct insert {
    uint8_t *bytes;
    size_t used;
};

static void insert_put(struct insert *to, const void *bytes, size_t count)
{
    memcpy(to->bytes + to->used, bytes, count);
    to->used += count;
}

static void put_number(struct insert *to, uint32_t number)
{
    const uint8_t bytes[] = {(uint8_t)(number >> 24), (uint8_t)(number >> 16), (uint8_t)(number >> 8), (uint8_t)number};
    insert_put(to, bytes, sizeof bytes);
}

/* Overwrites the last `end_bytes` of the file, which must be `end`, by `insert`, which ends in them too. */
static enum bead_error write_insert(int descriptor, const struct insert *insert, const void *end, size_t end_bytes,
                                    struct bead_message *msg)
{
    struct stat status;
    uint8_t found[PNG_END_BYTES];
    bool good = fstat(descriptor, &status) == 0 && status.st_size >= (off_t)end_bytes;
    off_t at = good ? status.st_size - (off_t)end_bytes : 0;
    good = good && pread(descriptor, found, end_bytes, at) == (ssize_t)end_bytes && memcmp(found, end, end_bytes) == 0;
    good = good && pwrite(descriptor, insert->bytes, insert->used, at) == (ssize_t)insert->used;
    return good ? BEAD_OK : bead_fail(msg, BEAD_ERROR_IO, "the comment of a movie cannot be written");
}

/* Blocks of at most 255 bytes, each after its length, and an empty one. */
enum bead_error bead_comment_gif(int descriptor, const char *text, struct bead_message *msg)
{
    static const uint8_t begin[] = {0x21, 0xfe}, end[] = {0x3b};
    size_t length = strlen(text);
    struct insert insert = {.bytes = malloc(length + length / GIF_BLOCK + 8)};
    if (!insert.bytes)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a comment");
    insert_put(&insert, begin, sizeof begin);
    for (size_t at = 0; at < length; at += GIF_BLOCK) {
        uint8_t count = (uint8_t)(length - at < GIF_BLOCK ? length - at : GIF_BLOCK);
        insert_put(&insert, &count, 1);
        insert_put(&insert, text + at, count);
    }
    insert_put(&insert, "", 1);
    insert_put(&insert, end, sizeof end);
    enum bead_error err = write_insert(descriptor, &insert, end, sizeof end, msg);
    free(insert.bytes);
    return err;
}

/* As the PNG specification has it, annex D. */
static uint32_t check_sum(const uint8_t *bytes, size_t count)
{
    uint32_t sum = 0xffffffffu;
    for (size_t i = 0; i < count; i++) {
        sum ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            sum = sum & 1 ? 0xedb88320u ^ sum >> 1 : sum >> 1;
    }
    return sum ^ 0xffffffffu;
}

/* A chunk iTXt, whose text is UTF-8: not compressed, of no language. */
enum bead_error bead_comment_png(int descriptor, const char *text, struct bead_message *msg)
{
    static const uint8_t end[PNG_END_BYTES] = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
    static const char head[] = "iTXtComment\0\0\0\0"; /* and its last zero */
    size_t length = strlen(text), name = 4;
    struct insert insert = {.bytes = malloc(length + sizeof head + 8 + sizeof end)};
    if (!insert.bytes)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a comment");
    put_number(&insert, (uint32_t)(sizeof head - name + length));
    insert_put(&insert, head, sizeof head);
    insert_put(&insert, text, length);
    put_number(&insert, check_sum(insert.bytes + 4, insert.used - 4));
    insert_put(&insert, end, sizeof end);
    enum bead_error err = write_insert(descriptor, &insert, end, sizeof end, msg);
    free(insert.bytes);
    return err;
}
