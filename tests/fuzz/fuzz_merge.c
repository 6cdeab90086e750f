/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz target: parts of a sweep. The input is the first of two; the second is as written (FUZZ_PART, see run.sh). Merged parts can
 * be written, and opened. */
#include <stdlib.h>
#include <unistd.h>

#include "beadreel/sweep.h"
#include "tests/fuzz/fuzz.h"

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return fuzz_mutate_h5(data, size, most, seed);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[4096], merged[4096];
    const char *const parts[] = {path, getenv("FUZZ_PART")};
    struct bead_message msg = {""};
    struct bead_sweep *sweep = NULL, *again = NULL;
    snprintf(path, sizeof path, "%s", fuzz_path("part.h5"));
    snprintf(merged, sizeof merged, "%s", fuzz_path("merged.h5"));
    fuzz_must(parts[1] && access(parts[1], R_OK) == 0, "FUZZ_PART is the second part");
    fuzz_write(path, data, size);
    const size_t before = fuzz_open_h5();
    enum bead_error err = bead_sweep_merge(parts, 2, &sweep, &msg);
    fuzz_result(err, &msg, sweep != NULL);
    if (!err) {
        err = bead_sweep_write(sweep, merged, &msg);
        fuzz_result(err, &msg, !err);
        err = bead_sweep_open(merged, NULL, &again, &msg);
        fuzz_must(!err, "what was merged can be opened");
        unlink(merged);
    }
    bead_sweep_close(again);
    bead_sweep_close(sweep);
    fuzz_must(fuzz_open_h5() == before, "nothing stays open in HDF5");
    fuzz_leaks();
    return 0;
}
