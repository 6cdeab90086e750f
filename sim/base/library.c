/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opens a library and its functions at run time: for libraries that most runs do not need. */
#include "beadreel/library.h"

#include <dlfcn.h>
#include <string.h>

enum bead_error bead_library_load(const char *const *files, const char *const *names, size_t count, void (**functions)(void),
                                  struct bead_message *msg)
{
    void *library = NULL;
    for (const char *const *file = files; *file && !library; file++)
        library = dlopen(*file, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        const char *why = dlerror();
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "cannot open a library: %s", why ? why : files[0]);
    }
    for (size_t i = 0; i < count; i++) {
        void *address = dlsym(library, names[i]);
        if (!address)
            return bead_fail(msg, BEAD_ERROR_GRAPHICS, "%s has no function %s", files[0], names[i]);
        memcpy(&functions[i], &address, sizeof address); /* ISO C has no cast from data to function */
    }
    return BEAD_OK;
}
