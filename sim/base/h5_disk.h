/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An HDF5 driver for writing one plain file that never fails, and that can be read whenever its run is killed.
 *
 * A flush of HDF5's own writes its metadata by address: a run killed in between leaves indices that point beyond the end in the
 * superblock. So this driver writes new blocks at once, and holds changes of those that were flushed; a flush then writes these in
 * an order of which each step leaves a file as it was at this flush or at the one before.
 *
 * When a write fails (a full disk, say), HDF5 1.10 tries again while it closes what is open, fails again, and crashes at
 * exit over the objects it then holds half closed. So this driver keeps the first error for its caller, keeps what
 * could not be written in memory, and lets HDF5 go on until its file is closed, and given up. */
#ifndef BEADREEL_SIM_BASE_H5_DISK_H
#define BEADREEL_SIM_BASE_H5_DISK_H

#include <hdf5.h>

/* What the driver shares with its caller; must outlive the file. */
struct bead_h5_disk {
    int file;  /* open for reading and writing; taken over (and set to -1) when HDF5 opens its file */
    int error; /* errno of the first failure, 0: none */
    hid_t driver;
};

/* Make `access` (a file access list) use the driver, which stays until bead_h5_disk_leave. Returns < 0 on failure. */
herr_t bead_h5_disk_use(hid_t access, struct bead_h5_disk *disk);
/* After the file is closed, and not before: HDF5 reads the driver's table once more when it has let go of it. */
void bead_h5_disk_leave(struct bead_h5_disk *disk);

#endif
