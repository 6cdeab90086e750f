/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory: growing arrays and arrays of megabytes (in the header for both libraries), and a check of the memory that is left.
 * Without the check, Linux grants arrays that do not fit, and kills the program when it fills them. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "beadreel/error.h"
#include "sim/base/internal.h"

/* Bytes; smaller arrays are not checked. */
enum { BEAD_MEMORY_SMALL = 64 << 20 };

/* Bytes that this process may still allocate, by the machine's memory and swap and by its own limit (ulimit -v). UINT64_MAX:
 * unknown. */
uint64_t bead_memory_left(void);
/* `what` begins the message: "chain.yaml:3:1: chain: 100 beads". Up to BEAD_MEMORY_SMALL bytes pass unchecked. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_memory_check(uint64_t bytes, const char *what, struct bead_message *msg);
/* Are that many bytes of addresses free? The kernel is asked, so all its limits count (ulimit -v, -d, strict overcommit); nothing
 * is kept. For libraries that crash or hang when one of their allocations fails. */
BEAD_INTERNAL bool bead_memory_room(uint64_t bytes);
/* For Mesa and AV1: 4 GiB, more than any film of 3840 x 2160 takes in all (3.6 GB with AV1, 1 GB with H.264). */
static inline bool bead_memory_ample(void)
{
    return bead_memory_room((uint64_t)4 << 30);
}
/* Make *pointer a cleared array of `count` elements. If there is no memory it is NULL, and the message says so: bead_new(&s->rows,
 * rows, msg, "a table of %zu rows", rows): "out of memory for a table of 12 rows". Errors: MEMORY. */
#define bead_new(pointer, count, msg, ...) bead_allocate((pointer), (count), sizeof **(pointer), (msg), __VA_ARGS__)
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_allocate(void *pointer, size_t count, size_t size, struct bead_message *msg,
                                                       const char *what, ...) BEAD_PRINTF(5, 6);
/* Before the declaration of a pointer: its target is freed when the pointer goes out of scope. */
#define BEAD_FREED __attribute__((cleanup(bead_free_variable)))
static inline void bead_free_variable(void *pointer)
{
    void *memory;
    memcpy(&memory, pointer, sizeof memory);
    free(memory);
}
/* Make room for `count` elements of `size` bytes, and some more, in an array that keeps its contents. False: out of memory. */
static inline bool bead_memory_grow(void **array, size_t *room, size_t count, size_t size)
{
    if (count <= *room)
        return true;
    void *made = reallocarray(*array, count + count / 2 + 16, size);
    if (!made)
        return false;
    *array = made;
    *room = count + count / 2 + 16;
    return true;
}

/* For arrays of megabytes. Not cleared; free with free(). NULL: out of memory. From 768 kB on in huge pages, if the system has
 * them: one page fault for 2 MB. */
static inline void *bead_large_take(size_t bytes)
{
    const size_t page = 2 << 20;
    if (bytes < page * 3 / 8 || bytes > SIZE_MAX - page)
        return malloc(bytes ? bytes : 1);
    bytes = (bytes + page - 1) / page * page;
    void *memory = aligned_alloc(page, bytes);
    if (memory)
        madvise(memory, bytes, MADV_HUGEPAGE); /* if this fails, pages are small */
    return memory;
}
