/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files that can be trusted: digests and drivers. First the digests of a finished file, block by block: the seal.
 *
 * HDF5 ignores what follows the end that its superblock names, so the seal is there: a mark, `covered` (bytes of the file before
 * the seal), a digest for each block of these, the length of the seal, the digest of all this, a mark again. Numbers are 64 bits,
 * little endian. One flipped bit spoils one mark at most, so that a damaged seal differs from none. A program that changes the file
 * cuts the seal off. Digests show damage; they do not protect against intent. */
#pragma once

#include <hdf5.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { BEAD_SEAL_BLOCK = 1 << 16 }; /* bytes in a block; fewer in the last one */

struct bead_seal {
    uint64_t covered; /* bytes; 0: there is no seal */
    uint64_t *digest; /* [blocks of `covered`]; when writing, 0: not known */
    size_t room;      /* of `digest` */
};

/* Note that these bytes were written: blocks within them are known, blocks they only touch are not. False: no memory. */
bool bead_seal_note(struct bead_seal *seal, uint64_t address, size_t size, const void *bytes);
/* Read unknown blocks, and append the seal to the open file, whose length is `covered`. Returns 0 or an errno. */
int bead_seal_write(struct bead_seal *seal, int file, uint64_t covered);

enum bead_seal_state { BEAD_SEAL_NONE, BEAD_SEAL_THERE, BEAD_SEAL_DAMAGED, BEAD_SEAL_NO_MEMORY };
/* Find the seal of an open file. */
enum bead_seal_state bead_seal_read(struct bead_seal *seal, int file);
/* Returns the end of block `index`. */
uint64_t bead_seal_end(const struct bead_seal *seal, size_t index);
/* Are these the bytes of block `index`? */
bool bead_seal_fits(const struct bead_seal *seal, size_t index, const void *bytes);
/* Look through the whole file: how many blocks are damaged, and where the first one is. Returns 0 or an errno. */
int bead_seal_look(const struct bead_seal *seal, int file, uint64_t *damaged, uint64_t *from, uint64_t *to);
void bead_seal_free(struct bead_seal *seal);
/* Read `size` bytes, or as many as there are; returns their number, -1 on failure. */
ptrdiff_t bead_seal_pread(int file, void *bytes, size_t size, uint64_t address);

/* An HDF5 driver for reading: from a sealed file (h5_seal.h), HDF5 only gets blocks that are as written.
 *
 * A file that is being written grows after HDF5 has asked for its length; this driver always says how long it is now. */

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
