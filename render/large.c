#include "render/large.h"

#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>

static const size_t page = 2 << 20;

void *bead_large_take(size_t bytes)
{
    if (bytes < 2 * page || bytes > SIZE_MAX - page)
        return malloc(bytes ? bytes : 1);
    bytes = (bytes + page - 1) / page * page;
    void *memory = aligned_alloc(page, bytes);
    if (memory)
        madvise(memory, bytes, MADV_HUGEPAGE); /* it may refuse: then they are small */
    return memory;
}
