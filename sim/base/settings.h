/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Structures of settings that callers fill in (api.h): copied up to the last member that the caller's header had. */
#pragma once

#include <stddef.h>
#include <string.h>

#include "beadreel/error.h"

/* Size of the shortest structure accepted: up to its member `last`. */
#define BEAD_SETTINGS_UP_TO(type, last) (offsetof(type, last) + sizeof(((type *)0)->last))

/* Copy `given` into `own`, which has `size` bytes; the rest is 0, the default. Both begin with their size. Errors: USAGE. */
BEAD_CHECK static inline enum bead_error bead_settings_take(void *own, size_t size, size_t least, const void *given,
                                                            const char *name, struct bead_message *msg)
{
    size_t taken;
    memcpy(&taken, given, sizeof taken);
    if (taken < least || taken > size || taken % sizeof(void *) != 0)
        return bead_fail(msg, BEAD_ERROR_USAGE,
                         "struct %s: its size is given as %zu; this library (%s) accepts %zu, and smaller sizes from %zu on; "
                         "begin with BEAD_DEFAULT",
                         name, taken, bead_version(), size, least);
    memset(own, 0, size);
    memcpy(own, given, taken);
    memcpy(own, &size, sizeof size);
    return BEAD_OK;
}
