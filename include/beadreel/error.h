/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors: a code to act on and a message to show.
 *
 * Functions that can fail return `enum bead_error` (0 is success) and take a `struct bead_message *`
 * that may be NULL. On failure the message says in one line what is wrong and what is allowed; on
 * success it is left alone. Nothing in the libraries prints, exits or aborts. */
#ifndef BEADREEL_ERROR_H
#define BEADREEL_ERROR_H

#include "beadreel/api.h"

BEAD_BEGIN

/* code, text, exit status of the programs */
#define BEAD_ERRORS(X)                                  \
    X(OK, "no error", 0)                                \
    X(USAGE, "wrong command line", 2)                   \
    X(SCENE, "wrong scene", 2)                          \
    X(MEMORY, "out of memory", 1)                       \
    X(IO, "cannot read or write", 1)                    \
    X(FORMAT, "not a file of this kind, or damaged", 1) \
    X(NUMBERS, "the numbers stopped making sense", 1)   \
    X(GRAPHICS, "drawing failed", 1)                    \
    X(CODEC, "encoding failed", 1)                      \
    X(UNSUPPORTED, "not supported", 1)                  \
    X(STOPPED, "stopped by a signal", 1)

enum bead_error {
#define BEAD_ERROR_ENUM(code, text, status) BEAD_ERROR_##code,
    BEAD_ERRORS(BEAD_ERROR_ENUM)
#undef BEAD_ERROR_ENUM
};
#define BEAD_OK BEAD_ERROR_OK

/* Make the call; if it fails, return its error from the calling function, whose allocations must by then have an owner that frees
 * them. */
#define BEAD_TRY(call)                                 \
    do {                                               \
        const enum bead_error bead_try_error = (call); \
        if (bead_try_error)                            \
            return bead_try_error;                     \
    } while (0)

struct bead_message {
    char text[4096]; /* one line; for a wrong scene up to ten, one for each mistake */
};

/* The general text of a code; never NULL. */
BEAD_API const char *bead_error_text(enum bead_error code);
/* The exit status that the programs give for a code. */
BEAD_API int bead_error_status(enum bead_error code);
/* Fill `msg` (may be NULL) and return `code`, so that `return bead_fail(...)` reads well. */
BEAD_API enum bead_error bead_fail(struct bead_message *msg, enum bead_error code, const char *format, ...) BEAD_PRINTF(3, 4);

BEAD_END

#endif
