/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Digests of a finished file, block by block: the seal.
 *
 * HDF5 ignores what follows the end that its superblock names, so the seal is there: a mark, `covered` (bytes of the file before
 * the seal), a digest for each block of these, the length of the seal, the digest of all this, a mark again. Numbers are 64 bits,
 * little endian. One flipped bit spoils one mark at most, so that a damaged seal differs from none. A program that changes the file
 * cuts the seal off. Digests show damage; they do not protect against intent. */
#pragma once

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
