/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Libraries that are opened only when something is made with them, so that a machine may lack them. */
#ifndef BEADREEL_LIBRARY_H
#define BEADREEL_LIBRARY_H

#include <stddef.h>

#include "beadreel/error.h"

BEAD_BEGIN

struct bead_library_info {
    const char *files[4]; /* names for the loader, the first that can be opened is taken; NULL-terminated */
    const char *purpose;  /* one line, with what happens without it */
};

/* Fill functions[i] with the address of names[i], a function or a variable, from the first of `files` (NULL-terminated) that can be
 * opened. The library stays open for the life of the process: the drivers that it loads must not be unloaded. Errors: GRAPHICS
 * (with the loader's words). */
BEAD_API BEAD_CHECK enum bead_error bead_library_load(const char *const *files, const char *const *names, size_t count,
                                                      void (**functions)(void), struct bead_message *msg);

BEAD_END

#endif
