/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz target: the search for the scene in a stranger's picture, film or page. The first byte chooses its ending. */
#include <stdlib.h>
#include <string.h>

#include "render/origin/origin.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char version[40], path[64], *scene = NULL;
    struct bead_message msg = {""};
    size_t formats = 0;
    while (bead_origin_endings(formats))
        formats++;
    if (size == 0)
        return 0;
    snprintf(path, sizeof path, "file%s", bead_origin_endings(data[0] % formats));
    path[strcspn(path, ",")] = 0;
    uint8_t *file = malloc(size); /* separate, so that the sanitizer sees its end */
    if (!file)
        return 0;
    memcpy(file, data + 1, size - 1);
    enum bead_error err = bead_origin_find(path, file, size - 1, &scene, version, sizeof version, &msg);
    fuzz_must(err == BEAD_OK, "a file without a scene is no error");
    fuzz_must(!scene || *version, "a scene that is found has the version of the program that wrote it");
    free(scene);
    free(file);
    fuzz_leaks();
    return 0;
}
