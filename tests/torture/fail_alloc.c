/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loaded before a program (LD_PRELOAD), or linked into one (fail_alloc.h): its FAIL_AT-th allocation fails, once. Only allocations
 * by the program's own code count, by the address of the caller, since libraries abort by themselves; and only until main returns,
 * since code that a compiler adds at exit, to write counts of coverage, is not the program's. FAIL_AT=0 fails none; FAIL_COUNT
 * names a file for their number. */
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <link.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fail_alloc.h"

enum { CALLERS = 8 }; /* functions on the stack that tell one place from another */

/* What glibc calls its own. */
extern void *__libc_malloc(size_t size), *__libc_calloc(size_t count, size_t size), *__libc_realloc(void *old, size_t size),
    *__libc_memalign(size_t alignment, size_t size);
extern void __libc_free(void *memory);

static uintptr_t code_from, code_to; /* the program's own code */
static atomic_long made, kept;
static atomic_bool ended;
static long fail_at;
static bool *noted;
static long noted_room;
static int (*program)(int, char **, char **);

/* The first object is the program itself. */
static int find_code(struct dl_phdr_info *info, size_t size, void *nothing)
{
    (void)size;
    (void)nothing;
    for (int i = 0; i < info->dlpi_phnum; i++) {
        const ElfW(Phdr) *segment = &info->dlpi_phdr[i];
        if (segment->p_type == PT_LOAD && (segment->p_flags & PF_X)) {
            code_from = info->dlpi_addr + segment->p_vaddr;
            code_to = code_from + segment->p_memsz;
        }
    }
    return 1;
}

__attribute__((constructor)) static void begin(void)
{
    const char *at = getenv("FAIL_AT");
    fail_at = at ? atol(at) : 0;
    dl_iterate_phdr(find_code, NULL);
}

__attribute__((destructor)) static void finish(void)
{
    char text[32];
    const char *path = getenv("FAIL_COUNT");
    int file = path ? open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600) : -1,
        length = snprintf(text, sizeof text, "%ld\n", (long)made);
    if (file >= 0 && (write(file, text, (size_t)length) != length || close(file) != 0))
        _exit(99);
}

void fail_alloc_begin(long at)
{
    made = kept = 0;
    fail_at = at;
}

void fail_alloc_note(bool *known, long room)
{
    fail_alloc_begin(0);
    noted = known;
    noted_room = room;
}

long fail_alloc_end(long *left)
{
    fail_at = 0;
    noted = NULL;
    *left = kept;
    return made;
}

static int run_program(int argc, char **argv, char **environment)
{
    int status = program(argc, argv, environment);
    ended = true;
    return status;
}

/* What calls main. */
int __libc_start_main(int (*main)(int, char **, char **), int argc, char **argv, void (*init)(void), void (*fini)(void),
                      void (*rtld_fini)(void), void *stack_end);
__attribute__((visibility("default"))) int __libc_start_main(int (*main)(int, char **, char **), int argc, char **argv,
                                                             void (*init)(void), void (*fini)(void), void (*rtld_fini)(void),
                                                             void *stack_end)
{
    __auto_type start = (__typeof__(&__libc_start_main))dlsym(RTLD_NEXT, "__libc_start_main");
    program = main;
    return start(run_program, argc, argv, init, fini, rtld_fini, stack_end);
}

#ifndef FAIL_ALLOC_SANITIZED
static bool own(const void *caller)
{
    uintptr_t from = (uintptr_t)caller;
    return from >= code_from && from < code_to && !ended;
}

/* Have there been two allocations by the same functions since the program began? Places whose hashes are equal count as one. */
static bool is_known(void)
{
    static unsigned char times[1 << 16];
    void *by[CALLERS];
    uint64_t hash = 0;
    for (int i = backtrace(by, CALLERS); i-- > 0;)
        hash = (hash ^ (uintptr_t)by[i]) * 0x9E3779B97F4A7C15;
    unsigned char *of_place = &times[hash >> 48];
    return *of_place == 2 || ++*of_place == 0;
}

static int fails(const void *caller)
{
    if (!own(caller))
        return 0;
    if (noted && made < noted_room)
        noted[made] = is_known();
    if (atomic_fetch_add(&made, 1) + 1 != fail_at)
        return 0;
    errno = ENOMEM;
    return 1;
}

/* Memory that the program's own code gets: counted until that code frees it. */
static void *count(void *memory, const void *caller)
{
    if (memory && own(caller))
        atomic_fetch_add(&kept, 1);
    return memory;
}

#define CALLER __builtin_return_address(0)
#define EXPORT __attribute__((visibility("default")))

EXPORT void *malloc(size_t size)
{
    return fails(CALLER) ? NULL : count(__libc_malloc(size), CALLER);
}

EXPORT void *calloc(size_t number, size_t size)
{
    return fails(CALLER) ? NULL : count(__libc_calloc(number, size), CALLER);
}

EXPORT void *realloc(void *old, size_t size)
{
    return fails(CALLER) ? NULL : old ? __libc_realloc(old, size) : count(__libc_malloc(size), CALLER);
}

EXPORT void *reallocarray(void *old, size_t number, size_t size)
{
    size_t bytes;
    if (fails(CALLER))
        return NULL;
    if (__builtin_mul_overflow(number, size, &bytes)) {
        errno = ENOMEM;
        return NULL;
    }
    return old ? __libc_realloc(old, bytes) : count(__libc_malloc(bytes), CALLER);
}

EXPORT void *aligned_alloc(size_t alignment, size_t size)
{
    return fails(CALLER) ? NULL : count(__libc_memalign(alignment, size), CALLER);
}

EXPORT void free(void *memory)
{
    if (memory && own(CALLER))
        atomic_fetch_sub(&kept, 1);
    __libc_free(memory);
}

EXPORT int asprintf(char **text, const char *format, ...)
{
    *text = NULL;
    if (fails(CALLER))
        return -1;
    va_list values;
    va_start(values, format);
    int length = vasprintf(text, format, values);
    va_end(values);
    count(*text, CALLER);
    return length;
}

static char *copy_of(const char *text, size_t length, const void *caller)
{
    char *copy = fails(caller) ? NULL : count(__libc_malloc(length + 1), caller);
    if (copy) {
        memcpy(copy, text, length);
        copy[length] = '\0';
    }
    return copy;
}

EXPORT char *strdup(const char *text)
{
    return copy_of(text, strlen(text), CALLER);
}

EXPORT char *strndup(const char *text, size_t size)
{
    return copy_of(text, strnlen(text, size), CALLER);
}
#endif
