/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An HDF5 driver for writing one plain file that never fails, and that can be read whenever its run is killed.
 *
 * HDF5 flushes its metadata by address: a run killed meanwhile leaves indices that point beyond the end in the superblock. So this
 * driver writes new blocks at once and holds changes of flushed blocks. A flush writes these in an order in which each step leaves
 * the state of this flush, or of the previous one, readable, and each step reaches the disk before the next, even if a disk keeps
 * only some pages of a step. The exception is a root of an index whose first hundred bytes lie in two pages, while it is split. A
 * closed file gets the seal of h5_seal.h.
 *
 * When a write fails (on a full disk, say), HDF5 1.10 tries again while it closes its objects, fails again, and crashes at exit
 * over objects that are half closed. So this driver keeps the first error for its caller and the unwritten bytes in memory, and
 * lets HDF5 carry on until the file is closed and given up. */
#pragma once

#include <hdf5.h>
#include <stdbool.h>

/* Shared by the driver and its caller; must outlive the file. */
struct bead_h5_disk {
    int file;  /* open for reading and writing; taken over, and set to -1, when HDF5 opens the file */
    int error; /* errno of the first failure, 0: none */
    bool hold; /* flushed data stay in memory until it is false, because the layout of HDF5 files depends on the times of flushes */
    hid_t driver;
};

/* Make `access` (a file access list) use the driver, which stays until bead_h5_disk_leave. Returns < 0 on failure. */
herr_t bead_h5_disk_use(hid_t access, struct bead_h5_disk *disk);
/* Only after the file is closed: HDF5 still reads the driver's table while it closes the file. */
void bead_h5_disk_leave(struct bead_h5_disk *disk);
