/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opens HDF5 files for reading in this process, looks at their seals, and closes files: see h5.h. */
#include "sim/hdf5/h5_apart.h"
#include "sim/hdf5/h5_private.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "sim/base/file.h"
#include "sim/base/memory.h"

/* Follow no links out of the file, because an untrusted file must not refer to others. */
static herr_t refuse_external(const char *, const char *, const char *, const char *, unsigned *, hid_t, void *)
{
    return -1;
}

hid_t bead_h5_access(hid_t class)
{
    hid_t access = H5Pcreate(class);
    if (access >= 0 && H5Pset_elink_cb(access, refuse_external, NULL) < 0)
        bead_h5_release(&access);
    return access;
}

/* Files up to this size are checked completely when opened; of larger ones, the parts that are read. */
static const uint64_t checked_whole = 64 << 20;

static bool is_part(const char *path)
{
    static const char ending[] = ".part";
    const size_t length = strlen(path);
    return length >= sizeof ending && strcmp(path + length - (sizeof ending - 1), ending) == 0;
}

/* In the first flush, a run writes the head of its file last, some hundredths of a second after making the file. */
static void await_head(int file)
{
    static const struct timespec moment = {.tv_nsec = 10000000};
    static const time_t patience = 2; /* s */
    static const char none[8];
    struct stat found;
    char head[sizeof none] = {0};
    while (fstat(file, &found) == 0 && time(NULL) - found.st_mtime <= patience && pread(file, head, sizeof head, 0) >= 0 &&
           memcmp(head, none, sizeof none) == 0)
        nanosleep(&moment, NULL);
}

/* `run.h5.part` is `run.h5` once its run has finished, perhaps since its reader was called. */
int bead_h5_look(const char *path)
{
    int file = bead_file_look(path);
    if (!is_part(path))
        return file;
    if (file >= 0) {
        await_head(file);
        return file;
    }
    const int error = errno;
    BEAD_FREED char *finished = error == ENOENT ? strndup(path, strrchr(path, '.') - path) : NULL;
    file = finished ? bead_file_look(finished) : -1;
    errno = error;
    return file;
}

static enum bead_error find_seal(struct bead_h5 *h5)
{
    struct bead_h5_check *check = &h5->check;
    const enum bead_seal_state state = bead_seal_read(&check->seal, check->file);
    /* A killed run may have begun its seal. */
    if (state == BEAD_SEAL_DAMAGED && is_part(h5->path))
        return BEAD_OK;
    if (state == BEAD_SEAL_NO_MEMORY)
        return bead_h5_fail_by(h5, "read", ENOMEM);
    return state == BEAD_SEAL_DAMAGED ? bead_h5_fail(h5, false, "damaged: its digests are not those that were written") : BEAD_OK;
}

static enum bead_error look_through(struct bead_h5 *h5)
{
    uint64_t damaged = 0, from = 0, to = 0;
    struct stat found;
    h5->check.file = bead_h5_look(h5->path);
    if (h5->check.file < 0 || fstat(h5->check.file, &found) != 0)
        return bead_h5_fail_by(h5, "read", errno);
    h5->bytes = (uint64_t)found.st_size;
    BEAD_TRY(find_seal(h5));
    const struct bead_seal *seal = &h5->check.seal;
    if (!seal->covered && !bead_h5_is_open(h5->check.file))
        return bead_h5_fail(
            h5, false,
            "not an HDF5 file: only trajectories and the files of sweeps have digests; --reproduce makes tables and "
            "pictures again");
    if (!seal->covered)
        return bead_h5_fail(h5, false, "has no digests: it is unfinished, of an older version, or another program has changed it");
    const int error = bead_seal_look(seal, h5->check.file, &damaged, &from, &to);
    if (error)
        return bead_h5_fail_by(h5, "read", error);
    if (damaged)
        return bead_h5_fail(h5, false,
                            "damaged: %llu of %llu blocks are not those that were written, the first in bytes %llu to %llu",
                            (unsigned long long)damaged, (unsigned long long)((seal->covered - 1) / BEAD_SEAL_BLOCK + 1),
                            (unsigned long long)from, (unsigned long long)to - 1);
    return BEAD_OK;
}

enum bead_error bead_h5_verify(const char *path, uint64_t *bytes, struct bead_message *msg)
{
    struct bead_h5 h5 = {.file = -1, .path = path, .code = BEAD_ERROR_FORMAT, .msg = msg, .check = {.file = -1}};
    const enum bead_error err = look_through(&h5);
    *bytes = h5.bytes;
    if (h5.check.file >= 0)
        close(h5.check.file);
    bead_seal_free(&h5.check.seal);
    return err;
}

enum bead_error bead_h5_open_here(struct bead_h5 *h5)
{
    BEAD_TRY(find_seal(h5));
    uint64_t damaged = 0;
    if (h5->check.seal.covered && h5->check.seal.covered <= checked_whole &&
        bead_seal_look(&h5->check.seal, h5->check.file, &damaged, &h5->check.from, &h5->check.to) == 0 && damaged) {
        h5->check.damaged = true;
        return bead_h5_fail(h5, false, "damaged");
    }
    BEAD_H5_QUIET;
    BEAD_H5_AUTO access_list = H5Pcreate(H5P_FILE_ACCESS);
    /* Closing the file closes all objects in it. A run that is still writing holds a lock; flushed data may be read. No filter is
     * needed, so none is searched for in other files. */
    if (access_list < 0 || H5PLset_loading_state(0) < 0 || H5Pset_fclose_degree(access_list, H5F_CLOSE_STRONG) < 0 ||
        bead_h5_check_use(access_list, &h5->check) < 0)
        return bead_h5_fail(h5, true, "cannot be opened");
    h5->file =
        H5Fopen("/", H5F_ACC_RDONLY, access_list); /* the driver has the file; of a relative name the directory is looked for */
    return h5->file < 0 ? bead_h5_fail(h5, true, "damaged, or cut off") : BEAD_OK;
}

/* Like H5Fis_hdf5, but without opening the library: the signature is at the beginning, or at 512 bytes times a power of two. */
bool bead_h5_is_open(int file)
{
    static const char signature[8] = "\211HDF\r\n\032\n";
    char bytes[sizeof signature];
    off_t at = 0;
    bool found = false, more = file >= 0;
    while (!found && more) {
        more = pread(file, bytes, sizeof bytes, at) == (ssize_t)sizeof bytes;
        found = more && memcmp(bytes, signature, sizeof bytes) == 0;
        more = more && __builtin_mul_overflow(at ? at : 256, 2, &at) == 0;
    }
    return found;
}

bool bead_h5_is(const char *path)
{
    const int file = bead_h5_look(path);
    const bool found = bead_h5_is_open(file);
    if (file >= 0)
        close(file);
    return found;
}

void bead_h5_shut(struct bead_h5 *h5)
{
    bead_h5_apart_close(h5);
    if (h5->file < 0)
        return;
    BEAD_H5_QUIET;
    if (H5Fclose(h5->file) < 0)
        bead_h5_fail(h5, true, "cannot be closed properly");
    h5->file = -1;
    bead_h5_disk_leave(&h5->disk);
    bead_h5_check_leave(&h5->check);
    bead_h5_check_disk(h5);
}

void bead_h5_close(struct bead_h5 *h5, hid_t *object)
{
    if (*object < 0)
        return;
    if (h5->apart) {
        bead_h5_ask(h5, NULL, (struct bead_h5_question){.what = BEAD_H5_CLOSE, .object = *object}, NULL);
        *object = -1;
        return;
    }
    BEAD_H5_QUIET;
    if (H5Idec_ref(*object) < 0)
        bead_h5_fail(h5, true, "cannot be written");
    *object = -1;
}
