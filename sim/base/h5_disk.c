/* The HDF5 driver of h5_disk.h: keeps what could not be written, so that HDF5 itself never sees a failure. */
#include "sim/base/h5_disk.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

/* Bytes that could not be written. */
struct lost {
    struct lost *next;
    haddr_t address;
    size_t size;
    unsigned char bytes[];
};

struct disk {
    H5FD_t public; /* HDF5 wants it first */
    int file;
    haddr_t allocated, end; /* end of what HDF5 uses, and of the file */
    struct bead_h5_disk *caller;
    struct lost *lost, **last; /* in the order of writing */
};

/* What an access list carries. */
struct info {
    struct bead_h5_disk *caller;
};

static H5FD_t *disk_open(const char *name, unsigned flags, hid_t access, haddr_t most)
{
    (void)name, (void)most;
    const struct info *info = H5Pget_driver_info(access);
    /* HDF5 may look first whether the file is there already: it is new. */
    if (!(flags & H5F_ACC_CREAT) || !info || info->caller->file < 0)
        return NULL;
    struct disk *disk = calloc(1, sizeof *disk);
    if (!disk)
        return NULL;
    disk->file = info->caller->file;
    disk->caller = info->caller;
    disk->last = &disk->lost;
    info->caller->file = -1;
    return &disk->public;
}

static herr_t disk_close(H5FD_t *public)
{
    struct disk *disk = (struct disk *)public;
    if (close(disk->file) != 0 && !disk->caller->error)
        disk->caller->error = errno;
    while (disk->lost) {
        struct lost *next = disk->lost->next;
        free(disk->lost);
        disk->lost = next;
    }
    free(disk);
    return 0;
}

static herr_t disk_query(const H5FD_t *public, unsigned long *flags)
{
    (void)public;
    if (flags)
        *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
                 H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
}

static haddr_t disk_get_eoa(const H5FD_t *public, H5FD_mem_t type)
{
    (void)type;
    return ((const struct disk *)public)->allocated;
}

static herr_t disk_set_eoa(H5FD_t *public, H5FD_mem_t type, haddr_t address)
{
    (void)type;
    ((struct disk *)public)->allocated = address;
    return 0;
}

static haddr_t disk_get_eof(const H5FD_t *public, H5FD_mem_t type)
{
    (void)type;
    return ((const struct disk *)public)->end;
}

static herr_t keep(struct disk *disk, haddr_t address, size_t size, const void *bytes)
{
    struct lost *lost = malloc(sizeof *lost + size);
    if (!lost)
        return -1;
    lost->next = NULL;
    lost->address = address;
    lost->size = size;
    memcpy(lost->bytes, bytes, size);
    *disk->last = lost;
    disk->last = &lost->next;
    return 0;
}

static herr_t disk_write(H5FD_t *public, H5FD_mem_t type, hid_t transfer, haddr_t address, size_t size, const void *bytes)
{
    (void)type, (void)transfer;
    struct disk *disk = (struct disk *)public;
    if (address + size > disk->end)
        disk->end = address + size;
    const unsigned char *from = bytes;
    while (size > 0 && !disk->caller->error) {
        ssize_t done = pwrite(disk->file, from, size, (off_t)address);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0) {
            disk->caller->error = done < 0 ? errno : ENOSPC;
            break;
        }
        from += done;
        address += (haddr_t)done;
        size -= (size_t)done;
    }
    return size > 0 ? keep(disk, address, size, from) : 0;
}

static herr_t disk_read(H5FD_t *public, H5FD_mem_t type, hid_t transfer, haddr_t address, size_t size, void *bytes)
{
    (void)type, (void)transfer;
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
    for (const struct lost *lost = disk->lost; lost; lost = lost->next) {
        haddr_t from = lost->address > address ? lost->address : address;
        haddr_t to = lost->address + lost->size < address + size ? lost->address + lost->size : address + size;
        if (from < to)
            memcpy((unsigned char *)bytes + (from - address), lost->bytes + (from - lost->address), (size_t)(to - from));
    }
    return 0;
}

static herr_t disk_truncate(H5FD_t *public, hid_t transfer, hbool_t closing)
{
    (void)transfer, (void)closing;
    struct disk *disk = (struct disk *)public;
    if (disk->allocated == disk->end)
        return 0;
    if (!disk->caller->error && ftruncate(disk->file, (off_t)disk->allocated) != 0)
        disk->caller->error = errno;
    disk->end = disk->allocated;
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
    .truncate = disk_truncate,
    .fl_map = H5FD_FLMAP_DICHOTOMY,
};

herr_t bead_h5_disk_use(hid_t access, struct bead_h5_disk *disk)
{
    struct info info = {disk};
    disk->driver = H5FDregister(&driver);
    return disk->driver < 0 ? -1 : H5Pset_driver(access, disk->driver, &info);
}

void bead_h5_disk_leave(struct bead_h5_disk *disk)
{
    if (disk->driver > 0)
        H5FDunregister(disk->driver);
    disk->driver = -1;
}
