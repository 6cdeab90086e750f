/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opens libraries at run time and finds their functions, for libraries that most runs do not need. */
#include "sim/base/library.h"
#include "sim/base/memory.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdlib.h>

static void *open_first(const char *const *files)
{
    void *library = NULL;
    for (; *files && !library; files++)
        library = dlopen(*files, RTLD_NOW | RTLD_LOCAL);
    return library;
}

static size_t count_names(const char *names)
{
    size_t count = 0;
    for (; *names; names += strlen(names) + 1)
        count++;
    return count;
}

/* dlsym also finds the functions of libraries that `library` needs. */
static enum bead_error find_all(void *library, const char *file, const char *names, void **table, struct bead_message *msg)
{
    for (const char *name = names; *name; name += strlen(name) + 1) {
        *table = dlsym(library, name);
        if (!*table++)
            return bead_fail(msg, BEAD_ERROR_GRAPHICS, "%s has no function %s", file, name);
    }
    return BEAD_OK;
}

static enum bead_error load(const struct bead_library_info *libraries, const char *names, void **found, struct bead_message *msg)
{
    void *library = NULL;
    const char *file = NULL;
    for (; libraries->purpose; libraries++) {
        file = libraries->files[0];
        library = open_first(libraries->files);
        const char *why = library ? NULL : dlerror();
        if (!library)
            return bead_fail(msg, BEAD_ERROR_GRAPHICS, "cannot open a library: %s", why ? why : file);
    }
    void **table;
    BEAD_TRY(bead_new(&table, count_names(names), msg, "the functions of %s", file));
    enum bead_error err = find_all(library, file, names, table, msg);
    if (err)
        free(table);
    else
        *found = table;
    return err;
}

enum bead_error bead_library_load(const struct bead_library_info *libraries, const char *names, void **table,
                                  struct bead_message *msg)
{
    static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&one_at_a_time);
    enum bead_error err = *table ? BEAD_OK : load(libraries, names, table, msg);
    pthread_mutex_unlock(&one_at_a_time);
    return err;
}
