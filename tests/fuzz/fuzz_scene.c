/* libFuzzer entry for scenes: text, then (behind a byte 0) one setting.
 *   clang -g -O1 -fsanitize=fuzzer,address,undefined -D_GNU_SOURCE -std=c17 -Iinclude -I. tests/fuzz/fuzz_scene.c \
 *       build-asan/libbeadsim.a $(pkg-config --libs hdf5 yaml-0.1 udunits) -lhdf5_hl -lm -pthread -o fuzz_scene
 *   BEADREEL_ASSETS=assets ./fuzz_scene -max_len=4096 corpus assets/scenes tests/bad */
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/scene.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const uint8_t *zero = memchr(data, 0, size);
    size_t length = zero ? (size_t)(zero - data) : size;
    char *text = strndup((const char *)data, length), *setting = zero ? strndup((const char *)zero + 1, size - length - 1) : NULL;
    const char *const settings[] = {setting};
    struct bead_message msg;
    struct bead_scene *scene = NULL;
    if (text && (!zero || setting)) {
        enum bead_error err = bead_scene_parse("fuzz", text, length, settings, zero != NULL, &scene, &msg);
        if (!err != (scene != NULL))
            abort();
        if (!err && zero) {
            /* The text as run parses to a scene, too. */
            struct bead_scene *again = NULL;
            if (bead_scene_parse("again", scene->text, strlen(scene->text), NULL, 0, &again, &msg))
                abort();
            bead_scene_free(again);
        }
        bead_scene_free(scene);
    }
    free(text);
    free(setting);
    return 0;
}
