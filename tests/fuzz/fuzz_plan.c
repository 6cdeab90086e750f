/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz target: settings -> plan. A scene is opened with every kind of output and planned; nothing is written. */
#include "beadreel/scene.h"
#include "tests/fuzz/fuzz.h"

enum { SPINS = 100000, SELDOM = 64 };

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return fuzz_mutate_text(data, size, most, seed);
}

/* All spins are drawn for a plan: seconds, and always the same, for the largest ones. */
static bool is_large(const struct bead_scene *scene)
{
    size_t spins = 0;
    for (size_t c = 0; c < scene->chain_count; c++) {
        for (size_t s = 0; s < scene->chains[c].segment_count; s++)
            spins += scene->chains[c].segments[s].spins == BEAD_SPINS_RANDOM ? scene->chains[c].segments[s].count : 0;
    }
    for (size_t s = 0; s < scene->sweep_count; s++) {
        for (size_t g = 0; g < scene->sweeps[s].group_count; g++)
            spins += scene->sweeps[s].groups[g].configurations * scene->sweeps[s].cells;
    }
    return spins > SPINS;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct bead_message msg = {""};
    struct bead_scene *scene = NULL;
    enum bead_error err = bead_scene_parse("fuzz", (const char *)data, size, NULL, &scene, &msg);
    bool skipped = !err && is_large(scene) && size % SELDOM != 0;
    bead_scene_free(scene);
    if (err || skipped) /* what cannot be read has no plan, and is the matter of fuzz_scene */
        return 0;
    const char *path = fuzz_path("scene.yaml");
    fuzz_write(path, data, size);
    if (fuzz_session(path, "/nonexistent", false))
        fuzz_accept(data, size);
    fuzz_leaks();
    return 0;
}
