/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opens libraries at run time and finds their functions, for libraries that most runs do not need. */
#include "sim/base/library.h"
#include "sim/base/memory.h"

#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Is it, or a library that it needs, missing on this machine? The loader has no code for this, only words, in the language of
 * strerror. */
static bool is_absent(const char *why)
{
    return strstr(why, strerror(ENOENT)) != NULL;
}

/* If several libraries fail, the message names one that exists. */
static enum bead_error open_first(const struct bead_library_info *info, void **library, struct bead_message *msg)
{
    char why[512] = "";
    *library = NULL;
    for (const char *const *file = info->files; *file && !*library; file++) {
        *library = dlopen(*file, RTLD_NOW | RTLD_LOCAL);
        const char *said = *library ? NULL : dlerror();
        if (said && (!*why || is_absent(why)))
            snprintf(why, sizeof why, "%s", said);
    }
    if (*library)
        return BEAD_OK;
    const bool absent = is_absent(why);
    return bead_fail(msg, BEAD_ERROR_GRAPHICS, "cannot open a library: %s%s%s%s", why, absent ? " (install " : "",
                     absent ? info->package : "", absent ? ")" : "");
}

static size_t count_names(const char *names)
{
    size_t count = 0;
    for (; *names; names += strlen(names) + 1)
        count++;
    return count;
}

/* dlsym also finds the functions of libraries that `library` needs. */
static enum bead_error find_all(void *library, const struct bead_library_info *info, const char *names, void **table,
                                struct bead_message *msg)
{
    for (const char *name = names; *name; name += strlen(name) + 1) {
        *table = dlsym(library, name);
        if (!*table++)
            return bead_fail(msg, BEAD_ERROR_GRAPHICS, "%s has no function %s (install %s)", info->files[0], name, info->package);
    }
    return BEAD_OK;
}

static enum bead_error load(const struct bead_library_info *libraries, const char *names, void **found, struct bead_message *msg)
{
    void *library = NULL;
    const struct bead_library_info *last = libraries;
    for (; libraries->purpose; libraries++) {
        last = libraries;
        BEAD_TRY(open_first(last, &library, msg));
    }
    void **table;
    BEAD_TRY(bead_new(&table, count_names(names), msg, "the functions of %s", last->files[0]));
    enum bead_error err = find_all(library, last, names, table, msg);
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
