/* Fuzz target: settings -> plan. A scene is opened with every kind of output and planned; nothing is written. */
#include "tests/fuzz/fuzz.h"

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return fuzz_mutate_text(data, size, most, seed);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *path = fuzz_path("scene.yaml");
    fuzz_write(path, data, size);
    if (fuzz_session(path, "/nonexistent", false))
        fuzz_accept(data, size);
    fuzz_leaks();
    return 0;
}
