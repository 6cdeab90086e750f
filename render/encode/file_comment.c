/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inserts a comment before the last byte of a GIF file, or before the last chunk of a PNG file. */
#include "render/encode/libav.h"
#include "render/encode/movie_private.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { GIF_BLOCK = 255, PNG_END_BYTES = 12 };

/* The comment and the end of the file. */
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

/* Overwrite the last `end_bytes` of the file, which must be `end`, with `insert`, which also ends with them. */
static enum bead_error write_insert(int descriptor, const struct insert *insert, const void *end, size_t end_bytes,
                                    struct bead_message *msg)
{
    struct stat status;
    uint8_t found[PNG_END_BYTES];
    bool good = fstat(descriptor, &status) == 0 && status.st_size >= (off_t)end_bytes;
    off_t at = good ? status.st_size - (off_t)end_bytes : 0;
    good = good && pread(descriptor, found, end_bytes, at) == (ssize_t)end_bytes && memcmp(found, end, end_bytes) == 0;
    good = good && pwrite(descriptor, insert->bytes, insert->used, at) == (ssize_t)insert->used;
    return good ? BEAD_OK : bead_fail(msg, BEAD_ERROR_IO, "cannot write the comment of a movie");
}

/* Blocks of at most 255 bytes, each preceded by its length; the last one is empty. */
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

/* A chunk iTXt, with UTF-8 text: not compressed, without a language. */
enum bead_error bead_comment_png(int descriptor, const char *text, struct bead_message *msg)
{
    static const uint8_t end[PNG_END_BYTES] = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
    static const char head[] = "iTXtComment\0\0\0\0"; /* with the final zero */
    size_t length = strlen(text), name = 4;
    struct insert insert = {.bytes = malloc(length + sizeof head + 8 + sizeof end)};
    if (!insert.bytes)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a comment");
    put_number(&insert, (uint32_t)(sizeof head - name + length));
    insert_put(&insert, head, sizeof head);
    insert_put(&insert, text, length);
    put_number(&insert, ~av_crc(av_crc_get_table(AV_CRC_32_IEEE_LE), UINT32_MAX, insert.bytes + 4, insert.used - 4));
    insert_put(&insert, end, sizeof end);
    enum bead_error err = write_insert(descriptor, &insert, end, sizeof end, msg);
    free(insert.bytes);
    return err;
}
