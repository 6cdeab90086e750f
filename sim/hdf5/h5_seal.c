/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes and finds the seal of a file: see h5_seal.h. */
#include "sim/hdf5/h5_seal.h"

#include <endian.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sim/base/memory.h"

static const char mark[8] = "beadseal";
enum { HEAD = 2 * 8, TAIL = 3 * 8 }; /* mark, covered; length, digest, mark */

static uint64_t mixed(uint64_t hash, uint64_t word)
{
    hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
    return hash << 29 | hash >> 35;
}

static uint64_t word_at(const unsigned char *bytes)
{
    uint64_t word;
    memcpy(&word, bytes, sizeof word);
    return le64toh(word);
}

/* 64 bits, never 0. Four lanes, because one multiplication waits for another. Each step is invertible, so a change of one word
 * always shows. */
static uint64_t digest_of(const void *bytes, size_t size)
{
    enum { STRIDE = 4 * sizeof(uint64_t) };
    const unsigned char *at = bytes, *whole = at + size / STRIDE * STRIDE;
    unsigned char rest[STRIDE] = {0};
    uint64_t a = 1, b = 2, c = 3, d = 4;
    for (; at < whole; at += STRIDE) {
        a = mixed(a, word_at(at));
        b = mixed(b, word_at(at + 8));
        c = mixed(c, word_at(at + 16));
        d = mixed(d, word_at(at + 24));
    }
    uint64_t hash = mixed(mixed(mixed(mixed(size, a), b), c), d);
    memcpy(rest, whole, size % STRIDE);
    for (size_t i = 0; i < STRIDE; i += 8)
        hash = mixed(hash, word_at(rest + i));
    return hash ? hash : 1;
}

static size_t blocks_of(uint64_t bytes)
{
    return (size_t)(bytes / BEAD_SEAL_BLOCK + (bytes % BEAD_SEAL_BLOCK > 0));
}

static bool make_room(struct bead_seal *seal, size_t blocks)
{
    if (blocks <= seal->room)
        return true;
    const size_t room = blocks + blocks / 2 + 16;
    uint64_t *grown = realloc(seal->digest, room * sizeof *grown);
    if (!grown)
        return false;
    memset(grown + seal->room, 0, (room - seal->room) * sizeof *grown);
    seal->digest = grown;
    seal->room = room;
    return true;
}

bool bead_seal_note(struct bead_seal *seal, uint64_t address, size_t size, const void *bytes)
{
    const uint64_t end = address + size;
    if (!make_room(seal, blocks_of(end)))
        return false;
    for (uint64_t index = address / BEAD_SEAL_BLOCK, from = index * BEAD_SEAL_BLOCK; from < end; index++, from += BEAD_SEAL_BLOCK)
        seal->digest[index] = from >= address && end - from >= BEAD_SEAL_BLOCK
                                  ? digest_of((const char *)bytes + (from - address), BEAD_SEAL_BLOCK)
                                  : 0;
    return true;
}

ptrdiff_t bead_seal_pread(int file, void *bytes, size_t size, uint64_t address)
{
    size_t got = 0;
    while (got < size) {
        const ssize_t done = pread(file, (char *)bytes + got, size - got, (off_t)(address + got));
        if (done < 0 && errno == EINTR)
            continue;
        if (done < 0)
            return -1;
        if (done == 0)
            break;
        got += (size_t)done;
    }
    return (ptrdiff_t)got;
}

static int pwrite_all(int file, const void *bytes, size_t size, uint64_t address)
{
    for (size_t put = 0; put < size;) {
        const ssize_t done = pwrite(file, (const char *)bytes + put, size - put, (off_t)(address + put));
        if (done <= 0 && (done == 0 || errno != EINTR))
            return done == 0 ? ENOSPC : errno;
        put += done > 0 ? (size_t)done : 0;
    }
    return 0;
}

uint64_t bead_seal_end(const struct bead_seal *seal, size_t index)
{
    const uint64_t end = ((uint64_t)index + 1) * BEAD_SEAL_BLOCK;
    return end < seal->covered ? end : seal->covered;
}

bool bead_seal_fits(const struct bead_seal *seal, size_t index, const void *bytes)
{
    return digest_of(bytes, (size_t)(bead_seal_end(seal, index) - (uint64_t)index * BEAD_SEAL_BLOCK)) == seal->digest[index];
}

/* Returns 0 or an errno. */
static int complete(struct bead_seal *seal, int file)
{
    BEAD_FREED char *bytes = malloc(BEAD_SEAL_BLOCK);
    const size_t blocks = blocks_of(seal->covered);
    if (!bytes || !make_room(seal, blocks))
        return ENOMEM;
    for (size_t i = 0; i < blocks; i++) {
        const uint64_t from = (uint64_t)i * BEAD_SEAL_BLOCK;
        const size_t size = (size_t)(bead_seal_end(seal, i) - from);
        if (seal->digest[i] && size == BEAD_SEAL_BLOCK)
            continue;
        const ptrdiff_t got = bead_seal_pread(file, bytes, size, from);
        if (got < 0)
            return errno;
        memset(bytes + got, 0, size - (size_t)got); /* not reached yet: the file grows to it with the seal */
        seal->digest[i] = digest_of(bytes, size);
    }
    return 0;
}

int bead_seal_write(struct bead_seal *seal, int file, uint64_t covered)
{
    seal->covered = covered;
    const int error = complete(seal, file);
    if (error)
        return error;
    const size_t blocks = blocks_of(covered), size = HEAD + 8 * blocks + TAIL;
    BEAD_FREED char *bytes = malloc(size);
    if (!bytes)
        return ENOMEM;
    uint64_t number = htole64(covered);
    memcpy(bytes, mark, sizeof mark);
    memcpy(bytes + 8, &number, 8);
    for (size_t i = 0; i < blocks; i++) {
        number = htole64(seal->digest[i]);
        memcpy(bytes + HEAD + 8 * i, &number, 8);
    }
    number = htole64(size);
    memcpy(bytes + size - TAIL, &number, 8);
    number = htole64(digest_of(bytes, size - 16));
    memcpy(bytes + size - 16, &number, 8);
    memcpy(bytes + size - 8, mark, sizeof mark);
    return pwrite_all(file, bytes, size, covered);
}

/* A number in the file; 0 where there is none. */
static uint64_t number_at(int file, uint64_t address)
{
    uint64_t number;
    return bead_seal_pread(file, &number, sizeof number, address) == sizeof number ? le64toh(number) : 0;
}

/* Is there a mark, or as much of it as the file still has? */
static bool mark_at(int file, uint64_t address)
{
    char found[sizeof mark];
    const ptrdiff_t got = bead_seal_pread(file, found, sizeof found, address);
    return got > 0 && memcmp(found, mark, (size_t)got) == 0;
}

/* The seal in the last `size` bytes of the file, which has `length`. */
static enum bead_seal_state read_seal(struct bead_seal *seal, int file, uint64_t length, uint64_t size)
{
    if (size < HEAD + TAIL || size > length || size % 8 != 0)
        return BEAD_SEAL_DAMAGED;
    BEAD_FREED char *bytes = malloc(size);
    if (!bytes)
        return BEAD_SEAL_NO_MEMORY;
    const uint64_t covered = length - size;
    uint64_t number[2];
    if (bead_seal_pread(file, bytes, size, covered) != (ptrdiff_t)size)
        return BEAD_SEAL_DAMAGED;
    memcpy(number, bytes + size - 16, 8);
    memcpy(number + 1, bytes + 8, 8);
    const size_t blocks = (size - HEAD - TAIL) / 8;
    if (memcmp(bytes, mark, sizeof mark) != 0 || memcmp(bytes + size - 8, mark, sizeof mark) != 0 || blocks != blocks_of(covered) ||
        le64toh(number[1]) != covered || le64toh(number[0]) != digest_of(bytes, size - 16))
        return BEAD_SEAL_DAMAGED;
    if (!make_room(seal, blocks))
        return BEAD_SEAL_NO_MEMORY;
    for (size_t i = 0; i < blocks; i++) {
        memcpy(number, bytes + HEAD + 8 * i, 8);
        seal->digest[i] = le64toh(*number);
    }
    seal->covered = covered;
    return BEAD_SEAL_THERE;
}

enum bead_seal_state bead_seal_read(struct bead_seal *seal, int file)
{
    enum { END_OF_HDF5 = 40 }; /* where superblocks of version 0 say it */
    struct stat found;
    if (fstat(file, &found) != 0 || found.st_size < HEAD + TAIL)
        return BEAD_SEAL_NONE;
    const uint64_t length = (uint64_t)found.st_size;
    if (mark_at(file, length - 8))
        return read_seal(seal, file, length, number_at(file, length - TAIL));
    return mark_at(file, number_at(file, END_OF_HDF5)) ? BEAD_SEAL_DAMAGED : BEAD_SEAL_NONE;
}

int bead_seal_look(const struct bead_seal *seal, int file, uint64_t *damaged, uint64_t *from, uint64_t *to)
{
    BEAD_FREED char *bytes = malloc(BEAD_SEAL_BLOCK);
    *damaged = 0;
    if (!bytes)
        return ENOMEM;
    for (size_t i = 0; i < blocks_of(seal->covered); i++) {
        const uint64_t start = (uint64_t)i * BEAD_SEAL_BLOCK, end = bead_seal_end(seal, i);
        const ptrdiff_t got = bead_seal_pread(file, bytes, (size_t)(end - start), start);
        if (got < 0)
            return errno;
        if (got == (ptrdiff_t)(end - start) && bead_seal_fits(seal, i, bytes))
            continue;
        if (++*damaged == 1) {
            *from = start;
            *to = end;
        }
    }
    return 0;
}

void bead_seal_free(struct bead_seal *seal)
{
    free(seal->digest);
    *seal = (struct bead_seal){0};
}
