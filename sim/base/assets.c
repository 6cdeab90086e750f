/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds ready scenes, materials and colour maps: in BEADREEL_ASSETS, beside the program, or where they were installed. */
#include "beadreel/assets.h"

#include <errno.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_BYTES = 16 << 20 };

/* Directory of the running program, "" where it cannot be known. */
static void program_directory(char *directory, size_t size)
{
    ssize_t length = readlink("/proc/self/exe", directory, size - 1);
    directory[length > 0 ? length : 0] = 0;
    char *slash = strrchr(directory, '/');
    if (slash)
        *slash = 0;
}

/* Place `number` to look in; false behind the last. A place that does not exist on this machine is "". */
static bool place(size_t number, char *directory, size_t size)
{
    static const char *const beside[] = {"assets", "../assets", "../share/beadreel"};
    enum { BESIDE = sizeof beside / sizeof *beside };
    char program[PATH_MAX];
    const char *set = getenv("BEADREEL_ASSETS");
    int length = 0;
    if (number == 0)
        length = snprintf(directory, size, "%s", set ? set : "");
    else if (number <= BESIDE) {
        program_directory(program, sizeof program);
        length = *program ? snprintf(directory, size, "%s/%s", program, beside[number - 1]) : 0;
    } else if (number == BESIDE + 1)
        length = snprintf(directory, size, "%s", BEAD_DATADIR);
    else
        return false;
    if (length <= 0 || (size_t)length >= size)
        directory[0] = 0;
    return true;
}

enum bead_error bead_asset_path(const char *name, char *path, size_t size, struct bead_message *msg)
{
    char directory[PATH_MAX], tried[640] = "";
    for (size_t i = 0; place(i, directory, sizeof directory); i++) {
        if (!*directory)
            continue;
        int length = snprintf(path, size, "%s/%s", directory, name);
        if (length > 0 && (size_t)length < size && access(path, R_OK) == 0)
            return BEAD_OK;
        size_t used = strlen(tried), more = strlen(directory);
        if (used + more + 3 <= sizeof tried) {
            strcat(tried, used ? ", " : "");
            strcat(tried, directory);
        }
    }
    return bead_fail(msg, BEAD_ERROR_IO, "asset `%s` not found in %s; set BEADREEL_ASSETS to the directory of the assets", name,
                     tried);
}

enum bead_error bead_asset_read(const char *name, char **text, size_t *length, struct bead_message *msg)
{
    char path[PATH_MAX];
    *text = NULL;
    *length = 0;
    enum bead_error err = bead_asset_path(name, path, sizeof path, msg);
    if (err)
        return err;
    FILE *file = fopen(path, "rb");
    if (!file)
        return bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be read: %s", path, strerror(errno));
    size_t room = 0, used = 0, got = 1;
    char *read = NULL;
    while (got > 0 && used < MOST_BYTES) {
        if (room - used < 2) {
            char *grown = realloc(read, room = 2 * room + 16384);
            if (!grown) {
                free(read);
                fclose(file);
                return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory", path);
            }
            read = grown;
        }
        got = fread(read + used, 1, room - used - 1, file);
        used += got;
    }
    if (ferror(file) || used >= MOST_BYTES)
        err = bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be read, or is longer than 16 MiB", path);
    fclose(file);
    if (err) {
        free(read);
        return err;
    }
    read[used] = 0;
    *text = read;
    *length = used;
    return BEAD_OK;
}
