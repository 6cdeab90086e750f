/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz target: files of sweeps. Those that can be opened are planned, and one in four is written as a table. */
#include <unistd.h>

#include "beadreel/sweep.h"
#include "sim/statistics/statistics.h"
#include "sim/sweep/sweep_internal.h"
#include "tests/fuzz/fuzz.h"

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return fuzz_mutate_h5(data, size, most, seed);
}

static void look(const struct bead_sweep *sweep)
{
    struct bead_message msg = {""};
    size_t known = 0, all = bead_sweep_count(sweep, &known);
    fuzz_must(known <= all, "no more configurations are known than there are");
    for (size_t p = 0; p < bead_sweep_panels(sweep); p++) {
        for (size_t place = 0; place < bead_sweep_panel(sweep, p)->places; place++) {
            struct bead_sweep_statistics statistics;
            enum bead_error err = bead_sweep_statistics(sweep, p, place, bead_threshold_info(0)->name, &statistics, &msg);
            fuzz_result(err, &msg, !err);
            if (!err)
                bead_sweep_statistics_free(&statistics);
        }
        struct bead_sweep_decay *decays = NULL;
        size_t count = 0;
        if (bead_sweep_decays(sweep, p, &decays, &count, &msg) == BEAD_OK)
            bead_sweep_decays_free(decays, count);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[4096];
    snprintf(path, sizeof path, "%s", fuzz_path("sweep.h5"));
    fuzz_write(path, data, size);
    size_t before = fuzz_open_h5();
    struct bead_message msg = {""};
    struct bead_sweep *sweep = NULL;
    enum bead_error err = bead_sweep_open(path, NULL, &sweep, &msg);
    fuzz_result(err, &msg, sweep != NULL);
    if (!err)
        look(sweep);
    bead_sweep_close(sweep);
    if (!err) {
        char table[4096];
        snprintf(table, sizeof table, "%s", fuzz_path("sweep.csv"));
        fuzz_session(path, table, size % 4 == 0);
        unlink(table);
    }
    fuzz_must(fuzz_open_h5() == before, "nothing stays open in HDF5");
    fuzz_leaks();
    return 0;
}
