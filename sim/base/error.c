/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Error codes, their texts and exit statuses, from the one list in error.h; and messages. */
#include "beadreel/error.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

static const struct {
    const char *text;
    int status;
} rows[] = {
#define BEAD_ERROR_ROW(code, text, status) {text, status},
    BEAD_ERRORS(BEAD_ERROR_ROW)
#undef BEAD_ERROR_ROW
};

static const size_t row_count = sizeof rows / sizeof *rows;

const char *bead_error_text(enum bead_error code)
{
    return (size_t)code < row_count ? rows[code].text : "unknown error";
}

int bead_error_status(enum bead_error code)
{
    return (size_t)code < row_count ? rows[code].status : 1;
}

enum bead_error bead_fail(struct bead_message *msg, enum bead_error code, const char *format, ...)
{
    if (msg) {
        va_list values;
        va_start(values, format);
        vsnprintf(msg->text, sizeof msg->text, format, values);
        va_end(values);
    }
    return code;
}

const char *bead_version(void)
{
    return BEADREEL_VERSION;
}
