/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The HDF5 driver of h5_check.h. */
#include "sim/hdf5/h5_check.h"

#include <errno.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sim/hdf5/h5_private.h"

enum { SLOTS = 8 };

struct reader {
    H5FD_t public; /* HDF5 requires it to be first */
    int file;
    haddr_t allocated;
    struct bead_h5_check *caller;
    struct slot {
        size_t index; /* of the block that it holds; SIZE_MAX: none */
        unsigned char *bytes;
    } slots[SLOTS];
    unsigned next; /* slot to be filled */
};

/* Carried by an access list. */
struct info {
    struct bead_h5_check *caller;
};

static H5FD_t *check_open(const char *, unsigned, hid_t access, haddr_t)
{
    const struct info *info = H5Pget_driver_info(access);
    if (!info || info->caller->file < 0)
        return NULL;
    struct reader *reader = calloc(1, sizeof *reader);
    if (!reader) {
        info->caller->error = ENOMEM;
        return NULL;
    }
    for (size_t i = 0; i < SLOTS; i++)
        reader->slots[i].index = SIZE_MAX;
    reader->file = info->caller->file;
    reader->caller = info->caller;
    info->caller->file = -1;
    return &reader->public;
}

static herr_t check_query(const H5FD_t *, unsigned long *flags)
{
    if (flags)
        *flags = H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
}

static haddr_t check_get_eof(const H5FD_t *public, H5FD_mem_t)
{
    const struct reader *reader = (const struct reader *)public;
    struct stat found;
    if (reader->caller->seal.covered)
        return reader->caller->seal.covered;
    return fstat(reader->file, &found) == 0 ? (haddr_t)found.st_size : 0;
}

static haddr_t check_get_eoa(const H5FD_t *public, H5FD_mem_t type)
{
    const haddr_t end = check_get_eof(public, type), allocated = ((const struct reader *)public)->allocated;
    return allocated > end ? allocated : end;
}

static herr_t check_set_eoa(H5FD_t *public, H5FD_mem_t, haddr_t address)
{
    ((struct reader *)public)->allocated = address;
    return 0;
}

static bool fits(struct reader *reader, size_t index, const unsigned char *bytes)
{
    struct bead_h5_check *check = reader->caller;
    if (bead_seal_fits(&check->seal, index, bytes))
        return true;
    if (!check->damaged) {
        check->from = (uint64_t)index * BEAD_SEAL_BLOCK;
        check->to = bead_seal_end(&check->seal, index);
    }
    check->damaged = true;
    return false;
}

static bool read_exactly(const struct reader *reader, void *bytes, size_t size, uint64_t address)
{
    return bead_seal_pread(reader->file, bytes, size, address) == (ptrdiff_t)size;
}

/* A block, checked; NULL: damaged, or it cannot be read. */
static const unsigned char *block(struct reader *reader, size_t index)
{
    for (size_t i = 0; i < SLOTS; i++)
        if (reader->slots[i].index == index)
            return reader->slots[i].bytes;
    struct slot *slot = &reader->slots[reader->next++ % SLOTS];
    const uint64_t from = (uint64_t)index * BEAD_SEAL_BLOCK;
    slot->index = SIZE_MAX;
    if (!slot->bytes && !(slot->bytes = malloc(BEAD_SEAL_BLOCK))) {
        reader->caller->error = ENOMEM;
        return NULL;
    }
    if (!read_exactly(reader, slot->bytes, (size_t)(bead_seal_end(&reader->caller->seal, index) - from), from) ||
        !fits(reader, index, slot->bytes))
        return NULL;
    slot->index = index;
    return slot->bytes;
}

static herr_t check_read(H5FD_t *public, H5FD_mem_t, hid_t, haddr_t address, size_t size, void *bytes)
{
    struct reader *reader = (struct reader *)public;
    const struct bead_seal *seal = &reader->caller->seal;
    unsigned char *to = bytes;
    if (!seal->covered)
        return read_exactly(reader, bytes, size, address) ? 0 : -1;
    if (size > seal->covered || address > seal->covered - size)
        return -1;
    while (size > 0) {
        const size_t index = (size_t)(address / BEAD_SEAL_BLOCK), skipped = (size_t)(address % BEAD_SEAL_BLOCK);
        const size_t there = (size_t)(bead_seal_end(seal, index) - address), part = there < size ? there : size;
        if (skipped == 0 && part == there) { /* the whole block, straight to its destination */
            if (!read_exactly(reader, to, part, address) || !fits(reader, index, to))
                return -1;
        } else {
            const unsigned char *found = block(reader, index);
            if (!found)
                return -1;
            memcpy(to, found + skipped, part);
        }
        to += part;
        address += part;
        size -= part;
    }
    return 0;
}

static herr_t check_write(H5FD_t *, H5FD_mem_t, hid_t, haddr_t, size_t, const void *)
{
    return -1;
}

static herr_t check_close(H5FD_t *public)
{
    struct reader *reader = (struct reader *)public;
    for (size_t i = 0; i < SLOTS; i++)
        free(reader->slots[i].bytes);
    close(reader->file);
    free(reader);
    return 0;
}

static const H5FD_class_t driver = {
#if H5_VERSION_GE(1, 13, 0)
    .version = H5FD_CLASS_VERSION,
    .value = (H5FD_class_value_t)601,
#endif
    .name = "beadcheck",
    .maxaddr = ((haddr_t)1 << 62) - 1,
    .fc_degree = H5F_CLOSE_STRONG,
    .fapl_size = sizeof(struct info),
    .open = check_open,
    .close = check_close,
    .query = check_query,
    .get_eoa = check_get_eoa,
    .set_eoa = check_set_eoa,
    .get_eof = check_get_eof,
    .read = check_read,
    .write = check_write,
    .fl_map = H5FD_FLMAP_DICHOTOMY,
};

herr_t bead_h5_check_use(hid_t access, struct bead_h5_check *check)
{
    struct info info = {check};
    check->driver = H5FDregister(&driver);
    return H5Pset_driver(access, check->driver, &info); /* fails without a driver */
}

void bead_h5_check_leave(struct bead_h5_check *check)
{
    if (check->driver > 0)
        H5FDunregister(check->driver);
    check->driver = -1;
    if (check->file >= 0)
        close(check->file);
    check->file = -1;
    bead_seal_free(&check->seal);
}
