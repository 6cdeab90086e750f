/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Allocates cleared arrays, and finds the memory that is left before large ones are allocated. */
#include "sim/base/memory.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <sys/resource.h>
#include <unistd.h>

/* Memory available without ending other programs: free and cached memory, and free swap. */
static uint64_t machine_left(void)
{
    FILE *file = fopen("/proc/meminfo", "re");
    if (!file)
        return UINT64_MAX;
    char line[128];
    uint64_t kilobytes, sum = 0;
    bool found = false;
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "MemAvailable: %" SCNu64, &kilobytes) == 1)
            found = true;
        else if (sscanf(line, "SwapFree: %" SCNu64, &kilobytes) != 1)
            continue;
        sum += kilobytes * 1024;
    }
    fclose(file);
    return found ? sum : UINT64_MAX;
}

static uint64_t limit_left(void)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return UINT64_MAX;
    uint64_t pages = 0;
    FILE *file = fopen("/proc/self/statm", "re");
    if (file && fscanf(file, "%" SCNu64, &pages) != 1)
        pages = 0;
    if (file)
        fclose(file);
    uint64_t used = pages * (uint64_t)sysconf(_SC_PAGESIZE);
    return limit.rlim_cur > used ? limit.rlim_cur - used : 0;
}

uint64_t bead_memory_left(void)
{
    uint64_t machine = machine_left(), limit = limit_left();
    return machine < limit ? machine : limit;
}

enum bead_error bead_memory_check(uint64_t bytes, const char *what, struct bead_message *msg)
{
    if (bytes <= BEAD_MEMORY_SMALL)
        return BEAD_OK;
    uint64_t left = bead_memory_left();
    if (bytes <= left)
        return BEAD_OK;
    return bead_fail(msg, BEAD_ERROR_MEMORY, "%s need %.3g GB of memory; %.3g GB are free", what, 1e-9 * (double)bytes,
                     1e-9 * (double)left);
}

bool bead_memory_room(uint64_t bytes)
{
    void *room = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    return room != MAP_FAILED && munmap(room, bytes) == 0;
}

enum bead_error bead_allocate(void *pointer, size_t count, size_t size, struct bead_message *msg, const char *what, ...)
{
    char words[200];
    va_list arguments;
    void *made = calloc(count, size);
    memcpy(pointer, &made, sizeof made);
    if (made)
        return BEAD_OK; /* cppcheck-suppress memleak ; it is the caller's */
    va_start(arguments, what);
    vsnprintf(words, sizeof words, what, arguments);
    va_end(arguments);
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for %s", words);
}
