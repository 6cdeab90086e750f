/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The HDF5 driver of h5_disk.h: holds changes of flushed blocks until the next flush, and keeps unwritten bytes, so that HDF5 never
 * sees a failure. */
#include "sim/hdf5/h5_disk.h"

#include <errno.h>
#include <stdlib.h>
#include <unistd.h>

#include "sim/hdf5/h5_private.h"

/* Bytes that are not in the file yet. */
struct kept {
    struct kept *next;
    H5FD_mem_t type;
    haddr_t address;
    size_t size;
    bool head_first; /* set in a flush */
    unsigned char bytes[];
};

struct disk {
    H5FD_t public; /* HDF5 requires it to be first */
    int file;
    haddr_t allocated, end; /* end of the part that HDF5 uses, and of the file */
    haddr_t flushed;        /* end of the part that readers of the flushed file may read */
    bool changed;           /* since the last flush */
    struct bead_h5_disk *caller;
    struct kept *kept, **last; /* in the order of writing */
    struct bead_seal seal;
};

/* Carried by an access list. */
struct info {
    struct bead_h5_disk *caller;
};

static H5FD_t *disk_open(const char *, unsigned flags, hid_t access, haddr_t)
{
    const struct info *info = H5Pget_driver_info(access);
    /* Not found without H5F_ACC_CREAT: HDF5 may first try to open an existing file. */
    if (!(flags & H5F_ACC_CREAT) || !info || info->caller->file < 0)
        return NULL;
    struct disk *disk = calloc(1, sizeof *disk);
    if (!disk)
        return NULL;
    disk->file = info->caller->file;
    disk->caller = info->caller;
    disk->last = &disk->kept;
    info->caller->file = -1;
    return &disk->public;
}

static herr_t disk_query(const H5FD_t *, unsigned long *flags)
{
    if (flags)
        *flags =
            H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
}

static haddr_t disk_get_eoa(const H5FD_t *public, H5FD_mem_t)
{
    return ((const struct disk *)public)->allocated;
}

static herr_t disk_set_eoa(H5FD_t *public, H5FD_mem_t, haddr_t address)
{
    ((struct disk *)public)->allocated = address;
    return 0;
}

static haddr_t disk_get_eof(const H5FD_t *public, H5FD_mem_t)
{
    return ((const struct disk *)public)->end;
}

/* The overlap of [address, address + size) with the kept bytes: the number of bytes, and their offsets in both. */
static size_t overlap(const struct kept *kept, haddr_t address, size_t size, size_t *in_kept, size_t *in_other)
{
    haddr_t from = kept->address > address ? kept->address : address;
    haddr_t to = kept->address + kept->size < address + size ? kept->address + kept->size : address + size;
    *in_kept = (size_t)(from - kept->address);
    *in_other = (size_t)(from - address);
    return from < to ? (size_t)(to - from) : 0;
}

/* Update the kept bytes, so that none is older than the new ones. Returns true if all new bytes are now kept as `type`. */
static bool renew(const struct disk *disk, H5FD_mem_t type, haddr_t address, size_t size, const unsigned char *bytes)
{
    bool whole = false;
    for (struct kept *kept = disk->kept; kept; kept = kept->next) {
        size_t in_kept, in_other, common = overlap(kept, address, size, &in_kept, &in_other);
        if (common > 0)
            memcpy(kept->bytes + in_kept, bytes + in_other, common);
        whole = whole || (common == size && kept->type == type);
    }
    return whole;
}

static herr_t keep(struct disk *disk, H5FD_mem_t type, haddr_t address, size_t size, const void *bytes)
{
    struct kept *kept = malloc(sizeof *kept + size);
    if (!kept)
        return -1;
    kept->next = NULL;
    kept->type = type;
    kept->address = address;
    kept->size = size;
    memcpy(kept->bytes, bytes, size);
    *disk->last = kept;
    disk->last = &kept->next;
    return 0;
}

static void failed(struct disk *disk, int error)
{
    if (!disk->caller->error)
        disk->caller->error = error;
}

/* Earlier writes reach the disk before later ones, through the descriptor that wrote them, to which failures are reported. Some
 * file systems cannot do this. */
static void synchronise(struct disk *disk)
{
    if (!disk->caller->error && fdatasync(disk->file) != 0 && errno != EINVAL && errno != EROFS)
        failed(disk, errno);
}

/* Returns the number of bytes that could not be written. */
static size_t put(struct disk *disk, haddr_t address, size_t size, const unsigned char *bytes)
{
    while (size > 0 && !disk->caller->error) {
        ssize_t done = pwrite(disk->file, bytes, size, (off_t)address);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0) {
            disk->caller->error = done < 0 ? errno : ENOSPC;
            break;
        }
        if (!bead_seal_note(&disk->seal, address, (size_t)done, bytes))
            disk->caller->error = ENOMEM;
        bytes += done;
        address += (haddr_t)done;
        size -= (size_t)done;
    }
    return size;
}

static herr_t disk_write(H5FD_t *public, H5FD_mem_t type, hid_t, haddr_t address, size_t size, const void *bytes)
{
    struct disk *disk = (struct disk *)public;
    if (address + size > disk->end)
        disk->end = address + size;
    disk->changed = true;
    if (renew(disk, type, address, size, bytes))
        return 0;
    const bool held = type == H5FD_MEM_SUPER || (type != H5FD_MEM_DRAW && address < disk->flushed);
    if (held && keep(disk, type, address, size, bytes) == 0)
        return 0;
    /* Without memory to hold it, write it at once, to spare HDF5 the failure. */
    size_t left = put(disk, address, size, bytes);
    return left > 0 ? keep(disk, type, address + (size - left), left, (const unsigned char *)bytes + (size - left)) : 0;
}

static herr_t disk_read(H5FD_t *public, H5FD_mem_t, hid_t, haddr_t address, size_t size, void *bytes)
{
    struct disk *disk = (struct disk *)public;
    size_t got = 0;
    while (got < size) {
        ssize_t done = pread(disk->file, (unsigned char *)bytes + got, size - got, (off_t)(address + got));
        if (done < 0 && errno == EINTR)
            continue;
        if (done < 0 && !disk->caller->error)
            disk->caller->error = errno;
        if (done <= 0)
            break;
        got += (size_t)done;
    }
    memset((unsigned char *)bytes + got, 0, size - got);
    for (const struct kept *kept = disk->kept; kept; kept = kept->next) {
        size_t in_kept, in_other, common = overlap(kept, address, size, &in_kept, &in_other);
        if (common > 0)
            memcpy((unsigned char *)bytes + in_other, kept->bytes + in_kept, common);
    }
    return 0;
}

static herr_t disk_truncate(H5FD_t *public, hid_t, hbool_t)
{
    struct disk *disk = (struct disk *)public;
    if (disk->allocated == disk->end)
        return 0;
    if (!disk->caller->error && ftruncate(disk->file, (off_t)disk->allocated) != 0)
        disk->caller->error = errno;
    disk->end = disk->allocated;
    return 0;
}

static void forget(struct disk *disk)
{
    while (disk->kept) {
        struct kept *next = disk->kept->next;
        free(disk->kept);
        disk->kept = next;
    }
    disk->last = &disk->kept;
}

/* In which step of a flush a kept piece is written. B-trees: roots first, so that a node split in two is never halved before its
 * parent knows both; the level is in byte 5 of nodes. */
static int step_of(const struct kept *kept)
{
    enum { SUPER, HEAP, ROOTS, LEAVES = ROOTS + 255, SYMBOLS, OBJECTS };
    if (kept->type == H5FD_MEM_SUPER)
        return SUPER;
    if (kept->type == H5FD_MEM_LHEAP || kept->type == H5FD_MEM_GHEAP)
        return HEAP;
    if (kept->type != H5FD_MEM_BTREE)
        return OBJECTS;
    return kept->size > 5 && memcmp(kept->bytes, "TREE", 4) == 0 ? LEAVES - kept->bytes[5] : SYMBOLS;
}

/* The first step after `step` that has pieces; -1: none. */
static int next_step(const struct disk *disk, int step)
{
    int next = -1;
    for (const struct kept *kept = disk->kept; kept; kept = kept->next) {
        const int own = step_of(kept);
        if (own > step && (next < 0 || own < next))
            next = own;
    }
    return next;
}

/* Bytes that a disk writes whole or not at all. */
enum { PAGE = 4096 };

static size_t head_of(const struct kept *kept)
{
    const size_t head = PAGE - (size_t)(kept->address % PAGE);
    return head < kept->size ? head : kept->size;
}

/* The entries of a node in bytes 6 and 7 of it; 0: it is none. */
static unsigned entries(const unsigned char node[8])
{
    return memcmp(node, "TREE", 4) == 0 ? node[6] + 256u * node[7] : 0;
}

/* Does it have fewer entries than on the disk? Then it has been split in two. */
static bool shrinks(const struct disk *disk, const struct kept *kept)
{
    unsigned char before[8];
    return kept->size > sizeof before && entries(kept->bytes) > 0 &&
           pread(disk->file, before, sizeof before, (off_t)kept->address) == sizeof before &&
           entries(before) > entries(kept->bytes);
}

/* Writes the part of one step's pieces that comes `first`, or the rest. Returns whether there was any. A piece in two pages might
 * be written halfway. Its end, which may point to new blocks, comes before its head, which says how much of it is in use; if that
 * becomes less, the other way round. */
static bool put_half(struct disk *disk, int step, bool first)
{
    bool any = false;
    for (struct kept *kept = disk->kept; kept; kept = kept->next) {
        const size_t head = head_of(kept);
        if (step_of(kept) != step)
            continue;
        if (first)
            kept->head_first = head == kept->size || shrinks(disk, kept);
        if (first == kept->head_first) {
            put(disk, kept->address, head, kept->bytes);
            any = true;
        } else if (head < kept->size) {
            put(disk, kept->address + head, kept->size - head, kept->bytes + head);
            any = true;
        }
    }
    return any;
}

/* New blocks are in the file already, but nothing refers to them. After and during each of these steps, the file can be read: the
 * superblock gets the new length, indices and groups refer to the new blocks, objects to the new indices and sizes. Each step is on
 * the disk before the next begins, because a disk that loses power may have written the last data first. */
static herr_t disk_flush(H5FD_t *public, hid_t, hbool_t)
{
    struct disk *disk = (struct disk *)public;
    if (!disk->changed || disk->caller->hold)
        return 0;
    for (int step = next_step(disk, -1); step >= 0; step = next_step(disk, step)) {
        synchronise(disk);
        if (put_half(disk, step, true))
            synchronise(disk);
        put_half(disk, step, false);
    }
    if (disk->caller->error)
        return 0; /* all bytes stay in memory, for HDF5 to read */
    forget(disk);
    disk->flushed = disk->allocated;
    disk->changed = false;
    return 0;
}

static herr_t disk_close(H5FD_t *public)
{
    struct disk *disk = (struct disk *)public;
    disk->caller->hold = false;
    disk_flush(public, H5P_DEFAULT, true);
    synchronise(disk);
    if (!disk->caller->error)
        failed(disk, bead_seal_write(&disk->seal, disk->file, disk->allocated));
    synchronise(disk);
    if (close(disk->file) != 0)
        failed(disk, errno);
    bead_seal_free(&disk->seal);
    forget(disk);
    free(disk);
    return 0;
}

static const H5FD_class_t driver = {
#if H5_VERSION_GE(1, 13, 0)
    .version = H5FD_CLASS_VERSION,
    .value = (H5FD_class_value_t)600,
#endif
    .name = "beadreel",
    .maxaddr = ((haddr_t)1 << 62) - 1,
    .fc_degree = H5F_CLOSE_WEAK,
    .fapl_size = sizeof(struct info),
    .open = disk_open,
    .close = disk_close,
    .query = disk_query,
    .get_eoa = disk_get_eoa,
    .set_eoa = disk_set_eoa,
    .get_eof = disk_get_eof,
    .read = disk_read,
    .write = disk_write,
    .flush = disk_flush,
    .truncate = disk_truncate,
    .fl_map = H5FD_FLMAP_DICHOTOMY,
};

herr_t bead_h5_disk_use(hid_t access, struct bead_h5_disk *disk)
{
    struct info info = {disk};
    disk->driver = H5FDregister(&driver);
    return H5Pset_driver(access, disk->driver, &info); /* fails without a driver */
}

void bead_h5_disk_leave(struct bead_h5_disk *disk)
{
    if (disk->driver > 0)
        H5FDunregister(disk->driver);
    disk->driver = -1;
}
