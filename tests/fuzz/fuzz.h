/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the fuzz targets. A target is one file fuzz_NAME.c with libFuzzer's entry; `make fuzz` finds and runs it. */
#ifndef BEADREEL_TESTS_FUZZ_FUZZ_H
#define BEADREEL_TESTS_FUZZ_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "beadreel/error.h"

/* libFuzzer's entries and its mutator. */
int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed);
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);

/* A promise is broken unless `kept`: say which and abort. */
void fuzz_must(bool kept, const char *promise);
/* A failure has a message in one line and a documented status; a success leaves something. */
void fuzz_result(enum bead_error err, const struct bead_message *msg, bool made);

/* At the end of each execution: looks for leaks at every thousandth, as libFuzzer's own look at each takes most of the time. */
void fuzz_leaks(void);

/* Path of a file of this process, named `name`, in $TMPDIR, or /dev/shm; it holds until the next call. */
const char *fuzz_path(const char *name);
void fuzz_write(const char *path, const uint8_t *data, size_t size);
/* /dev/null, open. */
FILE *fuzz_null(void);

/* Open a session of the file `input`, plan it, run it too if asked, close it. Stopped after two seconds, as a user would: what does
 * not stop then is found by libFuzzer's own -timeout. True: it could be opened and planned. */
bool fuzz_session(const char *input, const char *output, bool run);

/* Random numbers below `below`; seeded by the mutators. */
unsigned fuzz_random(unsigned below);
void fuzz_seed(unsigned seed);

/* Mutators: of lines and words of YAML; of objects of an HDF5 file, through its API; return the new size. */
size_t fuzz_mutate_text(uint8_t *data, size_t size, size_t most, unsigned seed);
/* This text was accepted, so that it is worth changing further. */
void fuzz_accept(const uint8_t *data, size_t size);
size_t fuzz_mutate_h5(uint8_t *data, size_t size, size_t most, unsigned seed);
/* How many files and objects HDF5 holds open: forgotten ones make it crash at exit. */
size_t fuzz_open_h5(void);

#endif
