/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory for arrays of megabytes; in the header, for both libraries. */
#ifndef BEADREEL_SIM_BASE_LARGE_H
#define BEADREEL_SIM_BASE_LARGE_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>

/* Not cleared, to be freed; NULL: none left. From 768 kB on they lie in huge pages, where the system has them: a fault each 2 MB.
 */
static inline void *bead_large_take(size_t bytes)
{
    const size_t page = 2 << 20;
    if (bytes < page * 3 / 8 || bytes > SIZE_MAX - page)
        return malloc(bytes ? bytes : 1);
    bytes = (bytes + page - 1) / page * page;
    void *memory = aligned_alloc(page, bytes);
    if (memory)
        madvise(memory, bytes, MADV_HUGEPAGE); /* it may refuse: then they are small */
    return memory;
}

#endif
