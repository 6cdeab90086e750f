/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Libraries that are opened only when they are used, so that a machine may lack them and no other run waits for them: linked, HDF5
 * alone would make a small table take 17 million instructions instead of 3, and libav 90. */
#pragma once

#include "beadreel/error.h"
#include "sim/base/internal.h"

struct bead_library_info {
    const char *files[4]; /* names for the loader, the first that can be opened is taken; NULL-terminated */
    const char *purpose;  /* one line, with what happens without it */
    const char *package;  /* the package to install if it is absent */
};

/* Open the libraries, up to one without a purpose, of which the last needs the others, and make *table the addresses of `names`,
 * functions or variables: texts one after the other, an empty one at the end. If there is a table already, nothing happens; any
 * number of threads may call it. Both stay for the life of the process: the drivers that libraries load must not be unloaded.
 * Errors: GRAPHICS (with the loader's words), MEMORY. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_library_load(const struct bead_library_info *libraries, const char *names,
                                                           void **table, struct bead_message *msg);
