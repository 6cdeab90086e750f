/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of h5: guards, and HDF5 itself, which is opened with the first of its files, as it loads forty libraries that
 * tables do not need. */
#pragma once

#include <hdf5.h>
#include <hdf5_hl.h>
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

#include "sim/hdf5/h5.h"

/* Calls of HDF5 go through this table (late.awk). NULL until bead_h5_load has succeeded; opening and making a file call that first.
 */
extern void *bead_hdf5;

struct bead_h5_quiet {
    H5E_auto2_t print;
    void *data;
};
struct bead_h5_quiet bead_h5_quiet_begin(void);
void bead_h5_quiet_end(struct bead_h5_quiet *before);
void bead_h5_release(hid_t *id);

/* HDF5 prints nothing until the end of the block. `unused`, because clang ignores the use by the cleanup. */
#define BEAD_H5_QUIET __attribute__((cleanup(bead_h5_quiet_end), unused)) struct bead_h5_quiet quiet_guard = bead_h5_quiet_begin()
/* An identifier of any kind, closed at the end of the block. Those below 0, of what could not be made, need no check of their own:
 * each call of HDF5 that is given one fails. */
#define BEAD_H5_AUTO __attribute__((cleanup(bead_h5_release))) hid_t

/* Reports a failed system call that left `error` in errno. `done`: "read" or "written". */
enum bead_error bead_h5_fail_by(struct bead_h5 *h5, const char *done, int error);
/* False if HDF5 is missing. */
bool bead_h5_load_for(struct bead_h5 *h5);
/* Open the file that h5->check has open, in this process. */
enum bead_error bead_h5_open_here(struct bead_h5 *h5);
bool bead_h5_stays_in_process(void);
/* Opens a file for reading as bead_file_look does. Waits for the head of an unfinished file made a moment ago, and finds one
 * finished meanwhile under its name. */
int bead_h5_look(const char *path);
/* bead_h5_is of an open file; -1: no. */
bool bead_h5_is_open(int file);
/* Report a failed write, which the driver hides from HDF5. */
void bead_h5_check_disk(struct bead_h5 *h5);
/* The type of numbers in memory. */
hid_t bead_h5_memory_type(enum bead_h5_type type);
/* The space in memory of `count` numbers that are `size` bytes apart; -1 on failure. */
hid_t bead_h5_space_apart(size_t size, size_t count);
/* The type of a fixed-length text of `size` bytes with its NUL. */
hid_t bead_h5_text_type(size_t size, H5T_cset_t characters);
/* An access list of `class` that follows no links out of the file; -1 on failure. */
hid_t bead_h5_access(hid_t class);
