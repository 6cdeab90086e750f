/* Fuzz target: text -> settings. No plan, so thousands a second. */
#include <stdlib.h>
#include <string.h>

#include "beadreel/scene.h"
#include "tests/fuzz/fuzz.h"

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return fuzz_mutate_text(data, size, most, seed);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct bead_message msg = {""};
    struct bead_scene *scene = NULL;
    enum bead_error err = bead_scene_parse("fuzz", (const char *)data, size, NULL, 0, &scene, &msg);
    fuzz_result(err, &msg, scene != NULL);
    bead_scene_free(scene);
    return 0;
}
