/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An HDF5 driver for reading: from a sealed file (h5_seal.h), HDF5 only gets blocks that are as written.
 *
 * A file that is being written grows after HDF5 has asked for its length; this driver always says how long it is now. */
#pragma once

#include <hdf5.h>

#include "sim/hdf5/h5_seal.h"

/* Shared by the driver and its caller; must outlive the file. */
struct bead_h5_check {
    int file; /* open for reading; taken over, and set to -1, when HDF5 opens the file */
    struct bead_seal seal;
    int error; /* errno of a failure of the driver itself */
    bool damaged;
    uint64_t from, to; /* the first block that is */
    hid_t driver;
};

/* Make `access` (a file access list) use the driver, which stays until bead_h5_check_leave. Returns < 0 on failure. */
herr_t bead_h5_check_use(hid_t access, struct bead_h5_check *check);
/* Only after the file is closed. */
void bead_h5_check_leave(struct bead_h5_check *check);
