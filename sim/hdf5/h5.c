/* SPDX-License-Identifier: GPL-3.0-or-later */
/* HDF5 files, errors and attributes: see h5.h. h5_series.c writes growing datasets, h5_open.c opens files, h5_read.c
 * reads. */
#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/hdf5/h5_private.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

struct bead_h5_quiet bead_h5_quiet_begin(void)
{
    struct bead_h5_quiet before = {NULL, NULL};
    H5Eget_auto2(H5E_DEFAULT, &before.print, &before.data);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    return before;
}

void bead_h5_quiet_end(struct bead_h5_quiet *before)
{
    H5Eset_auto2(H5E_DEFAULT, before->print, before->data);
}

void bead_h5_release(hid_t *id)
{
    if (*id >= 0)
        H5Idec_ref(*id);
    *id = -1;
}

/* The innermost record of HDF5's error stack names the cause. */
static herr_t first_cause(unsigned n, const H5E_error2_t *record, void *text)
{
    if (n == 0)
        snprintf(text, 200, "%s", record->desc ? record->desc : "");
    return 0;
}

enum bead_error bead_h5_fail(struct bead_h5 *h5, bool cause, const char *format, ...)
{
    if (h5->error)
        return h5->error;
    char text[400], reason[200] = "";
    va_list values;
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    const bool no_memory = h5->check.error == ENOMEM;
    if (no_memory)
        snprintf(text, sizeof text, "no memory to read it");
    else if (h5->check.damaged)
        snprintf(text, sizeof text, "damaged: bytes %llu to %llu are not those that were written",
                 (unsigned long long)h5->check.from, (unsigned long long)h5->check.to - 1);
    else if (cause)
        H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, first_cause, reason);
    reason[strcspn(reason, "\n")] = '\0';
    h5->error = bead_fail(h5->msg, no_memory ? BEAD_ERROR_MEMORY : h5->code, "%s: %s%s%s%s", h5->path, text, *reason ? " (" : "",
                          reason, *reason ? ")" : "");
    return h5->error;
}

enum bead_error bead_h5_fail_by(struct bead_h5 *h5, const char *done, int error)
{
    if (error == ENOMEM)
        h5->code = BEAD_ERROR_MEMORY; /* the first error stays */
    return bead_h5_fail(h5, false, "cannot be %s: %s", done, bead_file_reason(error));
}

/* A group's names (120 bytes and more) and its table of them (328) are sorted and linked within: half of the old with half of the
 * new is unreadable. No block up to the second size lies in two pages, which might be written separately. */
static const hsize_t group_block = 100, page_part = 512;

/* Open the new file and empty it; false on failure. */
static bool take_file(struct bead_h5 *h5)
{
    h5->error = bead_file_open(h5->path, &h5->disk.file, NULL, h5->msg);
    if (!h5->error && ftruncate(h5->disk.file, 0) != 0)
        bead_h5_fail_by(h5, "written", errno);
    return !h5->error;
}

/* HDF5 crashes where the cache of a file cannot be allocated: it has a table of 65536 pointers, and half a dozen lists.
 * Chosen, sixteen times the table; with it no run of 60 at the limit of addresses at which two of five did crashed. */
static const uint64_t cache_room = 8 << 20;

bool bead_h5_load_for(struct bead_h5 *h5)
{
    struct bead_message why;
    enum bead_error err = bead_h5_load(&why);
    if (!err && !bead_memory_room(cache_room))
        err = bead_fail(&why, BEAD_ERROR_MEMORY, "too few addresses are free for HDF5 (ulimit -v)");
    if (err)
        h5->error = bead_fail(h5->msg, err, "%s: %s", h5->path, why.text);
    return !err;
}

void bead_h5_create(struct bead_h5 *h5, const char *path, struct bead_message *msg)
{
    *h5 =
        (struct bead_h5){.file = -1, .path = path, .code = BEAD_ERROR_IO, .msg = msg, .disk = {.file = -1}, .check = {.file = -1}};
    if (!bead_h5_load_for(h5))
        return;
    BEAD_H5_QUIET;
    BEAD_H5_AUTO access_list = H5Pcreate(H5P_FILE_ACCESS);
    if (take_file(h5)) {
        if (access_list >= 0 && H5Pset_alignment(access_list, group_block, page_part) >= 0 &&
            bead_h5_disk_use(access_list, &h5->disk) >= 0)
            h5->file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, access_list);
        if (h5->file < 0) {
            bead_h5_fail(h5, true, "cannot be made an HDF5 file");
            unlink(path);
        }
    }
    if (h5->disk.file >= 0)
        close(h5->disk.file);
    if (h5->file < 0)
        bead_h5_disk_leave(&h5->disk);
}

void bead_h5_check_disk(struct bead_h5 *h5)
{
    if (h5->disk.error)
        bead_h5_fail_by(h5, "written", h5->disk.error);
}

void bead_h5_flush(struct bead_h5 *h5, bool write)
{
    if (h5->error)
        return;
    h5->disk.hold = !write;
    BEAD_H5_QUIET;
    if (H5Fflush(h5->file, H5F_SCOPE_GLOBAL) < 0)
        bead_h5_fail(h5, true, "cannot be flushed");
    bead_h5_check_disk(h5);
}

hid_t bead_h5_text_type(size_t size, H5T_cset_t characters)
{
    hid_t type = H5Tcopy(H5T_C_S1);
    if (H5Tset_size(type, size) < 0 || H5Tset_cset(type, characters) < 0)
        bead_h5_release(&type);
    return type;
}

/* The type of texts of `width` bytes each, `size` bytes in all: ASCII if possible, because Octave's `load` stops at the first
 * UTF-8. */
static hid_t type_of_texts(const char *texts, size_t size, size_t width)
{
    H5T_cset_t characters = H5T_CSET_ASCII;
    for (size_t i = 0; i < size && characters == H5T_CSET_ASCII; i++)
        if ((unsigned char)texts[i] > 127)
            characters = H5T_CSET_UTF8;
    return bead_h5_text_type(width, characters);
}

hid_t bead_h5_make_group(struct bead_h5 *h5, hid_t parent, const char *name)
{
    if (h5->error)
        return -1;
    BEAD_H5_QUIET;
    BEAD_H5_AUTO links = H5Pcreate(H5P_LINK_CREATE);
    hid_t group = H5Pset_create_intermediate_group(links, 1) < 0 ? -1 : H5Gcreate2(parent, name, links, H5P_DEFAULT, H5P_DEFAULT);
    if (group < 0)
        bead_h5_fail(h5, true, "cannot make %s", name);
    return group;
}

static hid_t vector_space(size_t count)
{
    hsize_t length = count;
    return count ? H5Screate_simple(1, &length, NULL) : H5Screate(H5S_SCALAR);
}

static void put(struct bead_h5 *h5, hid_t object, const char *name, hid_t type, hid_t memory, size_t count, const void *values)
{
    BEAD_H5_QUIET;
    BEAD_H5_AUTO space = vector_space(count);
    BEAD_H5_AUTO attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    if (H5Awrite(attribute, memory, values) < 0)
        bead_h5_fail(h5, true, "cannot write the attribute %s", name);
}

void bead_h5_put_text(struct bead_h5 *h5, hid_t object, const char *name, const char *text)
{
    if (h5->error)
        return;
    size_t size = strlen(text) + 1;
    BEAD_H5_AUTO type = type_of_texts(text, size, size);
    put(h5, object, name, type, type, 0, text);
}

static const char *text_at(const char *const *first, size_t size, size_t index)
{
    const char *text = *(const char *const *)(const void *)((const char *)first + index * size);
    return text ? text : "";
}

/* All texts in one block, each in `width` bytes; to be freed. */
static char *pack_texts(struct bead_h5 *h5, const char *const *first, size_t size, size_t count, size_t *width)
{
    *width = 1;
    for (size_t i = 0; i < count; i++)
        if (strlen(text_at(first, size, i)) + 1 > *width)
            *width = strlen(text_at(first, size, i)) + 1;
    char *block = calloc(count ? count : 1, *width);
    if (!block)
        h5->error = bead_fail(h5->msg, BEAD_ERROR_MEMORY, "%s: no memory for %zu names", h5->path, count);
    for (size_t i = 0; block && i < count; i++)
        memcpy(block + i * *width, text_at(first, size, i), strlen(text_at(first, size, i)));
    return block;
}

void bead_h5_put_texts(struct bead_h5 *h5, hid_t object, const char *name, const char *const *texts, size_t count)
{
    if (h5->error)
        return;
    size_t width;
    char *block = pack_texts(h5, texts, sizeof *texts, count, &width);
    BEAD_H5_AUTO type = block ? type_of_texts(block, count * width, width) : -1;
    if (block)
        put(h5, object, name, type, type, count, block);
    free(block);
}

void bead_h5_put_double(struct bead_h5 *h5, hid_t object, const char *name, double value)
{
    if (h5->error)
        return;
    put(h5, object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 0, &value);
}

void bead_h5_put_ints(struct bead_h5 *h5, hid_t object, const char *name, const int64_t *values, size_t count)
{
    if (h5->error)
        return;
    put(h5, object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, count, values);
}

void bead_h5_set_int(struct bead_h5 *h5, hid_t object, const char *name, int64_t value)
{
    if (h5->error)
        return;
    BEAD_H5_QUIET;
    BEAD_H5_AUTO attribute = H5Aopen(object, name, H5P_DEFAULT);
    if (H5Awrite(attribute, H5T_NATIVE_INT64, &value) < 0)
        bead_h5_fail(h5, true, "cannot write the attribute %s", name);
}

void bead_h5_make_scale(struct bead_h5 *h5, hid_t dataset, const char *name)
{
    if (h5->error)
        return;
    BEAD_H5_QUIET;
    if (H5DSset_scale(dataset, name) < 0)
        bead_h5_fail(h5, true, "cannot make a scale of %s", name);
}

hid_t bead_h5_open_scale(struct bead_h5 *h5, hid_t parent, const char *path, const char *name)
{
    if (h5->error)
        return -1;
    BEAD_H5_QUIET;
    hid_t scale = H5Dopen2(parent, path, H5P_DEFAULT);
    if (scale >= 0)
        bead_h5_make_scale(h5, scale, name);
    else
        bead_h5_fail(h5, true, "cannot make a scale of %s", path);
    return scale;
}

void bead_h5_attach(struct bead_h5 *h5, hid_t dataset, unsigned axis, hid_t scale)
{
    if (h5->error)
        return;
    BEAD_H5_QUIET;
    if (H5DSattach_scale(dataset, scale, axis) < 0)
        bead_h5_fail(h5, true, "cannot attach a scale");
}

static hid_t stored_type(enum bead_h5_type type)
{
    return type == BEAD_H5_DOUBLE ? H5T_IEEE_F64LE : type == BEAD_H5_INT ? H5T_STD_I64LE : H5T_STD_U8LE;
}

hid_t bead_h5_memory_type(enum bead_h5_type type)
{
    return type == BEAD_H5_DOUBLE ? H5T_NATIVE_DOUBLE : type == BEAD_H5_INT ? H5T_NATIVE_INT64 : H5T_NATIVE_UINT8;
}

hid_t bead_h5_space_apart(size_t size, size_t count)
{
    const hsize_t start = 0, apart = size / sizeof(double), numbers = count ? count : 1, all = (numbers - 1) * apart + 1;
    hid_t space = H5Screate_simple(1, &all, NULL);
    if (H5Sselect_hyperslab(space, H5S_SELECT_SET, &start, &apart, &numbers, NULL) < 0)
        bead_h5_release(&space);
    return space;
}

/* A dataset that is written once; of rank 0 it is a scalar. */
struct once {
    const char *units;         /* NULL: none */
    hid_t scales[2];           /* of the axes; -1: none */
    hid_t type, memory, apart; /* in the file, in memory, and the places there */
    int rank;
    hsize_t size[2];
};

static void write_once(struct bead_h5 *h5, hid_t parent, const char *name, const struct once *once, const void *values)
{
    BEAD_H5_QUIET;
    BEAD_H5_AUTO space = once->rank ? H5Screate_simple(once->rank, once->size, NULL) : H5Screate(H5S_SCALAR);
    BEAD_H5_AUTO links = H5Pcreate(H5P_LINK_CREATE);
    BEAD_H5_AUTO layout = H5Pcreate(H5P_DATASET_CREATE);
    BEAD_H5_AUTO dataset = -1;
    /* No time stamps: the same scene gives the same bytes. */
    if (H5Pset_obj_track_times(layout, 0) >= 0 && H5Pset_create_intermediate_group(links, 1) >= 0)
        dataset = H5Dcreate2(parent, name, once->type, space, links, layout, H5P_DEFAULT);
    if (H5Dwrite(dataset, once->memory, once->apart, H5S_ALL, H5P_DEFAULT, values) < 0) {
        bead_h5_fail(h5, true, "cannot write %s", name);
        return;
    }
    if (once->units)
        bead_h5_put_text(h5, dataset, "units", once->units);
    for (unsigned axis = 0; axis < 2; axis++) {
        if (once->scales[axis] >= 0)
            bead_h5_attach(h5, dataset, axis, once->scales[axis]);
    }
}

/* Texts of `width` bytes each; count 0: one, as a scalar. */
static void write_block(struct bead_h5 *h5, hid_t parent, const char *name, const char *block, size_t width, size_t count)
{
    BEAD_H5_AUTO type = type_of_texts(block, (count ? count : 1) * width, width);
    write_once(h5, parent, name, &(struct once){NULL, {-1, -1}, type, type, H5S_ALL, count > 0, {count}}, block);
}

void bead_h5_write_numbers(struct bead_h5 *h5, hid_t parent, const char *name, const char *units, hid_t scale,
                           enum bead_h5_type type, const void *first, size_t size, size_t count)
{
    if (h5->error)
        return;
    BEAD_H5_AUTO apart = bead_h5_space_apart(size, count);
    const struct once once = {units, {scale, -1}, stored_type(type), bead_h5_memory_type(type), apart, count > 0, {count}};
    write_once(h5, parent, name, &once, first);
}

void bead_h5_write_table(struct bead_h5 *h5, hid_t parent, const char *name, const char *units, enum bead_h5_type type, size_t rows,
                         size_t columns, const hid_t scales[2], const void *values)
{
    if (h5->error)
        return;
    const struct once once = {units, {scales[0], scales[1]}, stored_type(type), bead_h5_memory_type(type), H5S_ALL,
                              2,     {rows, columns}};
    write_once(h5, parent, name, &once, values);
}

void bead_h5_write_texts(struct bead_h5 *h5, hid_t parent, const char *name, const char *const *first, size_t size, size_t count)
{
    if (h5->error)
        return;
    size_t width;
    char *block = pack_texts(h5, first, size, count, &width);
    if (block)
        write_block(h5, parent, name, block, width, count);
    free(block);
}

void bead_h5_write_text(struct bead_h5 *h5, hid_t parent, const char *name, const char *text)
{
    if (!h5->error)
        write_block(h5, parent, name, text, strlen(text) + 1, 0);
}
