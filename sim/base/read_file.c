/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads whole files, of a bounded length. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/file.h"

static enum bead_error read_open(FILE *file, const char *path, size_t most, char *bytes, size_t *length, struct bead_message *msg)
{
    errno = 0;
    *length = fread(bytes, 1, most + 1, file);
    if (ferror(file))
        return bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be read: %s", path, strerror(errno));
    if (*length > most)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s: is too long; at most %zu MiB are allowed", path, most >> 20);
    bytes[*length] = '\0';
    return BEAD_OK;
}

enum bead_error bead_file_read(const char *path, size_t most, char **bytes, size_t *length, struct bead_message *msg)
{
    *bytes = NULL;
    *length = 0;
    FILE *file = fopen(path, "rbe");
    if (!file)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be read: %s", path, strerror(errno));
    char *read = malloc(most + 1);
    enum bead_error err =
        read ? read_open(file, path, most, read, length, msg) : bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", path);
    fclose(file);
    if (err) {
        free(read);
        return err;
    }
    char *shorter = realloc(read, *length + 1);
    if (shorter)
        read = shorter;
    *bytes = read;
    return BEAD_OK;
}
