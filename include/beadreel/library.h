/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Libraries that are opened only when something is made with them, so that a machine may lack them. */
#ifndef BEADREEL_LIBRARY_H
#define BEADREEL_LIBRARY_H

#include <stddef.h>

#include "beadreel/error.h"

BEAD_BEGIN

/* Fill functions[i] with the address of names[i], from the first of `files` (NULL-terminated) that can be opened. The library stays
 * open for the life of the process: the drivers that it loads must not be unloaded. Errors: GRAPHICS (with the loader's words). */
BEAD_API BEAD_CHECK enum bead_error bead_library_load(const char *const *files, const char *const *names, size_t count,
                                                      void (**functions)(void), struct bead_message *msg);

BEAD_END

#endif
