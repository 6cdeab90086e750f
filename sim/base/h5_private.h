/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the reading and writing halves of h5 share. */
#ifndef BEADREEL_SIM_BASE_H5_PRIVATE_H
#define BEADREEL_SIM_BASE_H5_PRIVATE_H

#include "sim/base/h5.h"

struct bead_h5_quiet {
    H5E_auto2_t print;
    void *data;
};
struct bead_h5_quiet bead_h5_quiet_begin(void);
void bead_h5_quiet_end(struct bead_h5_quiet *before);
void bead_h5_release(hid_t *id);

/* HDF5 prints nothing until the end of the block. To clang, what only its cleanup reads is unused. */
#define BEAD_H5_QUIET __attribute__((cleanup(bead_h5_quiet_end), unused)) struct bead_h5_quiet quiet_guard = bead_h5_quiet_begin()
/* An identifier of any kind, closed at the end of the block. */
#define BEAD_H5_AUTO __attribute__((cleanup(bead_h5_release))) hid_t

/* The type of a fixed-length text of `size` bytes with its NUL. */
hid_t bead_h5_text_type(size_t size, H5T_cset_t characters);
/* An access list of `class` that follows no links out of the file; -1 on failure. */
hid_t bead_h5_access(hid_t class);

#endif
