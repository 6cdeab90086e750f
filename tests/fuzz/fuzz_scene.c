/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz target: text -> settings. No plan, for thousands a second. */
#include <stdlib.h>
#include <string.h>

#include "beadreel/scene.h"
#include "tests/fuzz/fuzz.h"

enum { ALIASES = 6, SELDOM = 64 };

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return fuzz_mutate_text(data, size, most, seed);
}

/* Aliases of aliases are copied out, up to the limit of entries: a hundred times the work of other texts, and always the same. */
static bool is_seldom(const uint8_t *data, size_t size)
{
    size_t aliases = 0;
    for (size_t i = 0; i < size; i++)
        aliases += data[i] == '*';
    return aliases > ALIASES && size % SELDOM != 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (is_seldom(data, size))
        return 0;
    struct bead_message msg = {""};
    struct bead_scene *scene = NULL;
    enum bead_error err = bead_scene_parse("fuzz", (const char *)data, size, NULL, &scene, &msg);
    fuzz_result(err, &msg, scene != NULL);
    if (!err)
        fuzz_accept(data, size);
    bead_scene_free(scene);
    fuzz_leaks();
    return 0;
}
