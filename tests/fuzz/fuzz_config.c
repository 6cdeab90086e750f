/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz target: a user's own settings, config.yaml, alone and with a scene that uses all of them. */
#include "beadreel/scene.h"
#include "sim/scene/scene_internal.h"
#include "tests/fuzz/fuzz.h"

static const char scene_text[] = "chain: {beads: [{bead: large-steel, count: 3}]}\n"
                                 "outputs: [{image: a.png}, {plot: b.pdf, show: peaks}, {movie: c.mp4, duration: 1 s}]\n";

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return fuzz_mutate_text(data, size, most, seed);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[4096];
    snprintf(path, sizeof path, "%s", fuzz_path("config.yaml"));
    fuzz_write(path, data, size);
    struct bead_message msg = {""};
    struct bead_config *config = NULL;
    struct bead_scene *scene = NULL;
    enum bead_error err = bead_config_load(path, &config, &msg);
    fuzz_result(err, &msg, config != NULL);
    bead_config_free(config);
    if (!err) {
        fuzz_accept(data, size);
        err = bead_scene_parse("fuzz", scene_text, sizeof scene_text - 1, &(struct bead_overrides){.config = path}, &scene, &msg);
        fuzz_result(err, &msg, scene != NULL);
        bead_scene_free(scene);
    }
    fuzz_leaks();
    return 0;
}
