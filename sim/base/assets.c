/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds ready scenes, materials and colour maps: in BEADREEL_ASSETS, beside the program, or where they were installed. */
#include "sim/base/assets.h"

#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "sim/base/file.h"
#include "sim/base/suggest.h"

enum { MOST_BYTES = 16 << 20 };

/* Directory of the running program, "" if unknown. */
static void program_directory(char *directory, size_t size)
{
    ssize_t length = readlink("/proc/self/exe", directory, size - 1);
    directory[length > 0 ? length : 0] = 0;
    char *slash = strrchr(directory, '/');
    if (slash)
        *slash = 0;
}

/* The directory `number` to search; false after the last. "": there is none on this machine. */
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
        bead_list_add(tried, sizeof tried, ", ", directory);
    }
    return bead_fail(msg, BEAD_ERROR_IO, "asset `%s` not found in %s; set BEADREEL_ASSETS to the directory of the assets", name,
                     tried);
}

enum bead_error bead_asset_read(const char *name, char **text, size_t *length, struct bead_message *msg)
{
    char path[PATH_MAX];
    *text = NULL;
    *length = 0;
    BEAD_TRY(bead_asset_path(name, path, sizeof path, msg));
    return bead_file_read(path, MOST_BYTES, text, length, msg);
}
