/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files that appear whole or not at all: written as `name.part`, renamed to `name` when they are finished.
 *
 *   bead_file_join(directory, output->path, &path, msg);
 *   bead_file_part_name(path, &part, msg);
 *   ... write `part`, close it ...
 *   bead_file_commit(part, path, msg);     or   bead_file_discard(part);
 *   free(part); free(path);
 *
 * or, where one function writes it all, bead_file_write(path, fill, context, &bytes, msg).
 *
 * Messages of IO errors begin with the path. */
#pragma once

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "beadreel/sink.h"
#include "sim/base/internal.h"

/* Does `path` stay in the current directory, that is, is it relative and without `..`? */
BEAD_INTERNAL bool bead_file_is_inside(const char *path);
/* Does `path`, which is inside, stay below `directory` even if its directories are symbolic links? Missing files do. */
BEAD_INTERNAL bool bead_file_stays_beneath(const char *directory, const char *path);
/* Name of the unfinished file: `path` and ".part"; of names that the file system would find too long then, the beginning, a
 * fingerprint of the name, and ".part". *part belongs to the caller (free). Errors: MEMORY. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_file_part_name(const char *path, char **part, struct bead_message *msg);
/* Open `part` for reading and writing as it is, or new: a descriptor that the caller closes; -1 on failure. Never through a
 * symbolic link, and only a regular file with just this name, so that nothing else is overwritten and a FIFO does not block.
 * `created` (may be NULL): it did not exist. Errors: IO. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_file_open(const char *part, int *descriptor, bool *created, struct bead_message *msg);
/* Open `part` for writing, emptied; opened as above. On failure *file is NULL and no new file is left. Errors: IO. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_file_create(const char *part, FILE **file, struct bead_message *msg);
/* Bring `file` to the disk and close it, reporting any write error since it was opened (a full disk, say). Closes it in any case.
 * Errors: IO. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_file_close(FILE *file, const char *part, struct bead_message *msg);
/* The closed file `part` becomes `path`, for good: fsync, rename, fsync of the directory. Only a file or a symbolic link is
 * replaced. On failure `part` is removed. Errors: IO. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_file_commit(const char *part, const char *path, struct bead_message *msg);
/* A lock on an unfinished file, which is open: flock, or, on file systems without it, a file beside it that only one run can
 * make. */
struct bead_file_lock {
    int descriptor; /* of the unfinished file, for reading and writing; -1: none */
    bool created;   /* it did not exist */
    char *beside;   /* name of the file beside it; NULL: none is needed */
};

/* Open `part` as bead_file_open does, and lock it as the unfinished file of `path`. The claim of a run that was killed on this
 * machine is taken over. On failure nothing is held. Errors: USAGE (another run is writing it), IO, MEMORY. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_file_lock(const char *part, const char *path, struct bead_file_lock *lock,
                                                        struct bead_message *msg);
/* Close the unfinished file and give up the lock. */
BEAD_INTERNAL void bead_file_unlock(struct bead_file_lock *lock);

/* A claim on a file that a run is going to write: its unfinished file is locked until the claim is released, so that if two runs
 * have the same output, the second is refused before it has touched anything.
 *
 *   bead_file_claim(path, &claim, msg);    ... write and commit `path` as above ...    bead_file_release(claim, false); */
struct bead_claim;

/* Errors: USAGE (another run is writing it), IO, MEMORY. On failure *claim is NULL and nothing has changed. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_file_claim(const char *path, struct bead_claim **claim, struct bead_message *msg);
/* Unlocks. If this claim created an unfinished file and it still has that name, removes it unless `keep`. NULL is allowed. */
BEAD_INTERNAL void bead_file_release(struct bead_claim *claim, bool keep);
/* The file that replaces the lock on file systems without locks; NULL: they have locks, or claim is NULL. */
BEAD_INTERNAL const char *bead_file_claimed_by(const struct bead_claim *claim);
/* Removes the unfinished file and the file that replaces a lock, as bead_file_release does; safe in signal handlers. NULL is
 * allowed. */
BEAD_INTERNAL void bead_file_abandon(const struct bead_claim *claim);

/* Remove `part`, if it exists; NULL is allowed. */
BEAD_INTERNAL void bead_file_discard(const char *part);
/* Creates a directory and its parents; NULL or "": nothing to do. Errors: IO. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_file_make_directory(const char *directory, struct bead_message *msg);
/* Creates the directory of the file `path` and its parents. Errors: IO. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_file_make_parents(const char *path, struct bead_message *msg);
/* Do both exist, and are they the same file? */
BEAD_INTERNAL bool bead_file_same(const char *a, const char *b);
/* Free bytes on the file system of `path`; infinite if unknown. */
BEAD_INTERNAL double bead_file_room(const char *path);
/* Size of the file in bytes; 0: there is none. */
BEAD_INTERNAL uint64_t bead_file_bytes(const char *path);

/* Open a regular file for reading; anything else is not even opened, because opening a pipe would wake its writer. -1: errno says
 * why, ENXIO: it is not a regular file. */
BEAD_INTERNAL int bead_file_look(const char *path);
/* The reason for an errno of bead_file_look. */
BEAD_INTERNAL const char *bead_file_reason(int error);
/* The whole of a regular file of at most `most` bytes. *bytes end with an extra NUL, and are to be freed; NULL on failure. Errors:
 * IO, SCENE (too long), MEMORY. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_file_read(const char *path, size_t most, char **bytes, size_t *length,
                                                        struct bead_message *msg);
/* As above for files that the user names: also a pipe, a terminal or, as `-`, standard input. Further errors: STOPPED (a signal
 * came while it was waited for). */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_file_read_input(const char *path, size_t most, char **bytes, size_t *length,
                                                              struct bead_message *msg);
/* As above for an open file, which it closes; -1: errno says why it is not open. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_file_read_open(int file, const char *path, size_t most, char **bytes, size_t *length,
                                                             struct bead_message *msg);
