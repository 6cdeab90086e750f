/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz target: trajectory files. Every sample is read, and one in eight is drawn. */
#include <unistd.h>

#include "beadreel/trajectory.h"
#include "tests/fuzz/fuzz.h"

enum { SAMPLES = 200 };

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return fuzz_mutate_h5(data, size, most, seed);
}

static void read_all(struct bead_trajectory *t)
{
    struct bead_message msg = {""};
    size_t chains = 0;
    (void)bead_trajectory_chains(t, &chains);
    size_t count = bead_grid_count(bead_trajectory_grid(t));
    for (size_t c = 0; c < chains; c++) {
        struct bead_outcome outcome;
        enum bead_error err = bead_trajectory_outcome(t, c, &outcome, &msg);
        fuzz_result(err, &msg, !err);
        for (size_t i = 0; !err && i < count && i < SAMPLES; i++) {
            struct bead_sample sample;
            err = bead_trajectory_read(t, i, c, bead_trajectory_fields(t), &sample, &msg);
            fuzz_result(err, &msg, !err);
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[4096];
    snprintf(path, sizeof path, "%s", fuzz_path("run.h5"));
    fuzz_write(path, data, size);
    size_t before = fuzz_open_h5();
    struct bead_message msg = {""};
    struct bead_trajectory *t = NULL;
    enum bead_error err = bead_trajectory_open(path, NULL, &t, &msg);
    fuzz_result(err, &msg, t != NULL);
    if (!err)
        read_all(t);
    bead_trajectory_close(t);
    if (!err && size % 8 == 0) {
        fuzz_session(path, fuzz_path("run.png"), true);
        unlink(fuzz_path("run.png"));
    }
    fuzz_must(fuzz_open_h5() == before, "nothing stays open in HDF5");
    fuzz_leaks();
    return 0;
}
