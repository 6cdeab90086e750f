/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bytes of files: numbers, inserted blocks, and texts about how a file was made. */
#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "render/origin/origin_private.h"
#include "sim/base/memory.h"

static const char program[] = "beadreel ", mark[] = ", scene:\n";

void origin_block_begin(struct origin_block *block)
{
    *block = (struct origin_block){.bytes = NULL};
    block->file = open_memstream(&block->bytes, &block->length);
}

void origin_put_big(uint64_t number, int bytes, FILE *file)
{
    while (bytes-- > 0)
        fputc((int)(number >> 8 * bytes & 255), file);
}

void origin_put_little(uint64_t number, int bytes, FILE *file)
{
    for (; bytes-- > 0; number >>= 8)
        fputc((int)(number & 255), file);
}

bool origin_read_at(const struct origin_file *file, off_t at, void *bytes, size_t count)
{
    return at >= 0 && at <= file->size && (off_t)count <= file->size - at &&
           pread(file->descriptor, bytes, count, at) == (ssize_t)count;
}

bool origin_write_at(const struct origin_file *file, off_t at, const void *bytes, size_t count)
{
    return pwrite(file->descriptor, bytes, count, at) == (ssize_t)count;
}

/* Moves the rest of the file on. The rest is kept in memory, so insert blocks near the end of long files. */
bool origin_insert(struct origin_file *file, off_t at, struct origin_block *block)
{
    const size_t rest = (size_t)(file->size - at);
    const bool whole = block->file && fclose(block->file) == 0;
    BEAD_FREED char *made = block->bytes, *tail = malloc(rest + 1);
    if (!whole || !tail) {
        errno = ENOMEM;
        return false;
    }
    if (!origin_read_at(file, at, tail, rest) || !origin_write_at(file, at, made, block->length) ||
        !origin_write_at(file, at + (off_t)block->length, tail, rest))
        return false;
    file->size += (off_t)block->length;
    return true;
}

/* ---- reading ---- */

struct origin_span origin_part(struct origin_span span, size_t at, size_t length)
{
    at = at < span.length ? at : span.length;
    const size_t left = span.length - at;
    return (struct origin_span){span.bytes + at, length < left ? length : left};
}

bool origin_begins(struct origin_span span, const char *bytes, size_t length)
{
    return span.length >= length && memcmp(span.bytes, bytes, length) == 0;
}

uint64_t origin_big(struct origin_span span, size_t at, size_t bytes)
{
    const struct origin_span part = origin_part(span, at, bytes);
    uint64_t value = 0;
    for (size_t i = 0; i < bytes && part.length == bytes; i++)
        value = value << 8 | part.bytes[i];
    return value;
}

uint64_t origin_little(struct origin_span span, size_t at, size_t bytes)
{
    const struct origin_span part = origin_part(span, at, bytes);
    uint64_t value = 0;
    for (size_t i = bytes; i-- > 0 && part.length == bytes;)
        value = value << 8 | part.bytes[i];
    return value;
}

/* The head in a text, with the version between its two parts: where it begins and ends. False: there is none. */
bool origin_find_head(struct origin_span text, struct origin_span *version, size_t *end)
{
    enum { LONGEST_VERSION = 31 };
    const char *begin = (const char *)text.bytes, *limit = begin + text.length, *found = begin;
    while (found && (found = memmem(found, (size_t)(limit - found), program, strlen(program)))) {
        const char *name = found += strlen(program);
        while (found < limit && found - name <= LONGEST_VERSION && isgraph((unsigned char)*found) && *found != ',')
            found++;
        if (found == name || (size_t)(limit - found) < strlen(mark) || memcmp(found, mark, strlen(mark)) != 0)
            continue;
        *version = (struct origin_span){(const unsigned char *)name, (size_t)(found - name)};
        *end = (size_t)(found - begin) + strlen(mark);
        return true;
    }
    return false;
}

bool origin_offer(struct origin_span span, FILE *text)
{
    struct origin_span version;
    size_t end;
    const bool good = origin_find_head(span, &version, &end);
    if (good)
        fwrite(span.bytes, 1, span.length, text);
    return good;
}
