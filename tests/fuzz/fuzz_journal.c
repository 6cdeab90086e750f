/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz target: journals of sweeps, the `.part` from which a killed sweep continues. Three quarters of the inputs get correct
 * checksums, so that the code behind these is reached. */
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/sweep.h"
#include "sim/base/fingerprint.h"
#include "sim/sweep/sweep_internal.h"
#include "tests/fuzz/fuzz.h"

/* Words of a journal: head (magic 2, format, version, fingerprint, jobs, part, parts, check), records (label, results, check). */
enum { HEAD_WORDS = 9, FINGERPRINT = 4, HEAD_CHECK = 8, JOB_BITS = 40 };

/* The sweep of the seeds (seeds.sh). */
static const char text[] =
    "sweep: {cells: 4, fixed: 4, magnetism: [0, 0.5], configurations: 4, measure: {decay: true, beads: [1, 2]}}\n"
    "simulate: {step: 1 us}\n"
    "outputs: [{sweep: sweep.h5}]\n";

static void sign(uint8_t *data, size_t size)
{
    uint64_t words[1 << 10];
    size_t count = size / sizeof *words;
    if (count < HEAD_WORDS || count > sizeof words / sizeof *words)
        return;
    memcpy(words, data, count * sizeof *words);
    words[HEAD_CHECK] = bead_fingerprint(BEAD_FINGERPRINT_START, words, HEAD_CHECK * sizeof *words);
    for (size_t at = HEAD_WORDS, length; at < count; at += length) {
        length = (size_t)(words[at] >> JOB_BITS);
        if (length < 2 || length > count - at)
            break;
        words[at + length - 1] = bead_fingerprint(words[FINGERPRINT], words + at, (length - 1) * sizeof *words);
    }
    memcpy(data, words, count * sizeof *words);
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    size = LLVMFuzzerMutate(data, size, most);
    fuzz_seed(seed);
    if (fuzz_random(4) > 0)
        sign(data, size);
    return size;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const volatile sig_atomic_t stop = 1; /* the journal is read, nothing is computed */
    static struct bead_scene *scene;
    struct bead_message msg = {""};
    if (!scene && bead_scene_parse("sweep", text, sizeof text - 1, NULL, &scene, &msg) != BEAD_OK) {
        fprintf(stderr, "%s\n", msg.text);
        exit(1);
    }
    const char *path = fuzz_path("sweep.h5.part");
    fuzz_write(path, data, size);
    struct bead_sweep_progress progress;
    (void)bead_sweep_journal_look(path, &progress);
    struct bead_sweep *sweep = NULL;
    enum bead_error err = bead_sweep_create(scene, &sweep, &msg);
    fuzz_result(err, &msg, sweep != NULL);
    const struct bead_sweep_settings settings = {.size = sizeof settings, .threads = 1, .journal = path, .stop = &stop};
    err = bead_sweep_run(sweep, &settings, NULL, &msg);
    fuzz_result(err, &msg, !err);
    size_t known = 0, all = bead_sweep_count(sweep, &known);
    fuzz_must(known <= all, "no more configurations are known than there are");
    bead_sweep_close(sweep);
    fuzz_leaks();
    return 0;
}
