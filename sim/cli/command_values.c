/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of options as a scene has them. */
#include <stdlib.h>
#include <string.h>

#include "sim/cli/command_line.h"

char *command_listed(const char *value, const char *separators)
{
    const bool words = *separators && !separators[1];
    char *text = NULL;
    size_t size = 0;
    if (!*separators || *value == '[' || (!words && !value[strcspn(value, separators)]))
        return strdup(value);
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    fputc('[', out);
    for (const char *at = value;; at++) {
        const size_t length = strcspn(at, separators);
        fprintf(out, "%.*s", length ? (int)length : 4, length ? at : "auto");
        at += length;
        if (!*at)
            break;
        fputs(", ", out);
    }
    fputc(']', out);
    if (fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}
