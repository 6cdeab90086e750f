/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mutator of HDF5 files: changes objects, sizes, types, values and attributes through the HDF5 API, because changed bytes are
 * mostly rejected at once. The file is an image in memory. Calls that fail leave the file unchanged, which is harmless here. */
#include <hdf5.h>
#include <hdf5_hl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/fuzz/fuzz.h"

enum { NAME = 256, OBJECTS = 512, DEPTH = 8, VALUES = 4096 };

static char names[OBJECTS][NAME];
static size_t name_count;

/* Paths of all objects below the group `path`. */
static void collect(hid_t file, const char *path, int depth)
{
    H5G_info_t info;
    if (depth > DEPTH || H5Gget_info_by_name(file, path, &info, H5P_DEFAULT) < 0)
        return;
    for (hsize_t i = 0; i < info.nlinks && name_count < OBJECTS; i++) {
        char link[128], whole[NAME];
        if (H5Lget_name_by_idx(file, path, H5_INDEX_NAME, H5_ITER_INC, i, link, sizeof link, H5P_DEFAULT) < 0)
            continue;
        if ((size_t)snprintf(whole, sizeof whole, "%s%s%s", path, path[1] ? "/" : "", link) >= sizeof whole)
            continue;
        hid_t object = H5Oopen(file, whole, H5P_DEFAULT);
        if (object < 0)
            continue;
        memcpy(names[name_count++], whole, sizeof whole);
        if (H5Iget_type(object) == H5I_GROUP)
            collect(file, whole, depth + 1);
        H5Oclose(object);
    }
}

static double odd_value(void)
{
    static const double odd[] = {0, -1, 1, 2, 1e308, -1e308, 1e-320, 4294967296.0, 9.3e18, -9.3e18, 0.5, 1e9};
    unsigned which = fuzz_random(sizeof odd / sizeof *odd + 2);
    return which == 0 ? (double)NAN : which == 1 ? (double)INFINITY : odd[which - 2];
}

static hid_t odd_type(void)
{
    switch (fuzz_random(6)) {
    case 0:
        return H5T_STD_I8LE;
    case 1:
        return H5T_IEEE_F32LE;
    case 2:
        return H5T_IEEE_F64BE;
    case 3:
        return H5T_STD_U64LE;
    case 4:
        return H5T_STD_I32BE;
    default:
        return H5T_IEEE_F64LE;
    }
}

/* A space near that of `object` (a dataset or an attribute's space), or far from it. */
static hid_t odd_space(hid_t old, hsize_t *points)
{
    hsize_t size[H5S_MAX_RANK] = {1, 1, 1, 1};
    int rank = H5Sget_simple_extent_ndims(old);
    if (rank > 0)
        H5Sget_simple_extent_dims(old, size, NULL);
    switch (fuzz_random(6)) {
    case 0:
        rank = (int)fuzz_random(5);
        break;
    case 1:
        return *points = 0, H5Screate(H5S_NULL);
    default:
        if (rank > 0) {
            hsize_t *one = &size[fuzz_random((unsigned)rank)];
            const hsize_t near[] = {0, 1, *one + 1, *one / 2, *one > 0 ? *one - 1 : 0, 1 << 12};
            *one = near[fuzz_random(6)];
        }
    }
    *points = 1;
    for (int i = 0; i < rank; i++)
        *points = *points > VALUES ? *points : *points * size[i];
    return rank > 0 ? H5Screate_simple(rank, size, NULL) : H5Screate(H5S_SCALAR);
}

static void write_text(hid_t parent, const char *name, bool attribute)
{
    static const char *const texts[] = {"", "x", "sqrt\n\x1b[31m", "\xff\xfe", "beadreel", "1.1", "outputs: []"};
    const char *text = texts[fuzz_random(sizeof texts / sizeof *texts)];
    hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, strlen(text) + 1);
    hid_t made = attribute ? H5Acreate2(parent, name, type, space, H5P_DEFAULT, H5P_DEFAULT)
                           : H5Dcreate2(parent, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (made >= 0) {
        (void)(attribute ? H5Awrite(made, type, text) : H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text));
        (void)(attribute ? H5Aclose(made) : H5Dclose(made));
    }
    H5Sclose(space);
    H5Tclose(type);
}

/* Numbers of another type and shape under `name`, one of them odd. */
static void write_numbers(hid_t parent, const char *name, hid_t old, const double *values, bool attribute)
{
    static double copy[VALUES];
    hsize_t points = 0;
    hid_t type = odd_type(), space = odd_space(old, &points);
    if (points <= VALUES) {
        memcpy(copy, values, sizeof copy);
        if (points > 0 && fuzz_random(2))
            copy[fuzz_random((unsigned)points)] = odd_value();
        hid_t made = attribute ? H5Acreate2(parent, name, type, space, H5P_DEFAULT, H5P_DEFAULT)
                               : H5Dcreate2(parent, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        if (made >= 0) {
            (void)(attribute ? H5Awrite(made, H5T_NATIVE_DOUBLE, copy)
                             : H5Dwrite(made, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, copy));
            (void)(attribute ? H5Aclose(made) : H5Dclose(made));
        }
    }
    H5Sclose(space);
}

static void change_attribute(hid_t object)
{
    static const double zeros[VALUES];
    char name[NAME];
    int count = H5Aget_num_attrs(object);
    hid_t attribute =
        count > 0 ? H5Aopen_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, fuzz_random((unsigned)count), H5P_DEFAULT, H5P_DEFAULT)
                  : H5I_INVALID_HID;
    if (attribute < 0)
        return;
    H5Aget_name(attribute, sizeof name, name);
    hid_t space = H5Aget_space(attribute);
    H5Aclose(attribute);
    H5Adelete(object, name);
    unsigned kind = fuzz_random(3);
    if (kind == 1)
        write_text(object, name, true);
    else if (kind == 2)
        write_numbers(object, name, space, zeros, true);
    H5Sclose(space);
}

/* One number of a dataset becomes an odd one. */
static void change_value(hid_t set, double *values, hsize_t points)
{
    if (points == 0 || points > VALUES)
        return;
    values[fuzz_random((unsigned)points)] = odd_value();
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
}

/* One side of a dataset that may grow: chunks are allocated at once, so no further than the disk can take. */
static void change_extent(hid_t set, hid_t space)
{
    static const hsize_t sizes[] = {0, 1, 2, 17, 1000, 20000};
    hsize_t size[H5S_MAX_RANK];
    int rank = H5Sget_simple_extent_dims(space, size, NULL);
    if (rank > 0) {
        size[fuzz_random((unsigned)rank)] = sizes[fuzz_random(6)];
        H5Dset_extent(set, size);
    }
}

static void change_dataset(hid_t file, const char *name)
{
    static double values[VALUES];
    hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
    if (set < 0)
        return;
    hid_t space = H5Dget_space(set);
    hssize_t points = H5Sget_simple_extent_npoints(space);
    memset(values, 0, sizeof values);
    if (points > 0 && points <= VALUES)
        H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    unsigned kind = fuzz_random(8);
    if (kind < 3)
        change_value(set, values, points > 0 ? (hsize_t)points : 0);
    else if (kind == 3)
        change_extent(set, space);
    H5Dclose(set);
    if (kind > 3)
        H5Ldelete(file, name, H5P_DEFAULT);
    if (kind == 5)
        write_text(file, name, false);
    else if (kind > 5)
        write_numbers(file, name, space, values, false);
    H5Sclose(space);
}

static void change_group(hid_t file, const char *name)
{
    static const double zeros[VALUES];
    if (!name[1])
        return;
    unsigned kind = fuzz_random(4);
    H5Ldelete(file, name, H5P_DEFAULT);
    if (kind == 1)
        H5Lcreate_soft(fuzz_random(2) ? "/" : names[fuzz_random((unsigned)name_count)], file, name, H5P_DEFAULT, H5P_DEFAULT);
    else if (kind == 2)
        H5Lcreate_external("/etc/passwd", "/x", file, name, H5P_DEFAULT, H5P_DEFAULT);
    else if (kind == 3) {
        hid_t space = H5Screate(H5S_SCALAR);
        write_numbers(file, name, space, zeros, false);
        H5Sclose(space);
    }
}

static void change_object(hid_t file)
{
    const char *name = fuzz_random(16) == 0 || name_count == 0 ? "/" : names[fuzz_random((unsigned)name_count)];
    hid_t object = H5Oopen(file, name, H5P_DEFAULT);
    if (object < 0)
        return;
    bool group = H5Iget_type(object) == H5I_GROUP, attribute = fuzz_random(3) == 0;
    if (attribute)
        change_attribute(object);
    H5Oclose(object);
    if (!attribute && group)
        change_group(file, name);
    else if (!attribute)
        change_dataset(file, name);
}

/* Files with changed bytes end with this mark, which HDF5 ignores: its functions that change files crash on damaged ones, so only
 * more bytes are changed in these. */
static const char mark[] = "bytes";
enum { MARK = sizeof mark - 1 };

static bool is_marked(const uint8_t *data, size_t size)
{
    return size >= MARK && memcmp(data + size - MARK, mark, MARK) == 0;
}

static size_t mutate_bytes(uint8_t *data, size_t size, size_t most)
{
    if (most < MARK)
        return LLVMFuzzerMutate(data, size, most);
    size = is_marked(data, size) ? size - MARK : size;
    size = LLVMFuzzerMutate(data, size < most - MARK ? size : most - MARK, most - MARK);
    memcpy(data + size, mark, MARK);
    return size + MARK;
}

size_t fuzz_mutate_h5(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    fuzz_seed(seed);
    /* HDF5 crashes at exit over files that it could not write back: those of the mutator, not of the program. */
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    bool bytes = fuzz_random(16) == 0 || size == 0 || is_marked(data, size);
    hid_t file = bytes ? H5I_INVALID_HID : H5LTopen_file_image(data, size, H5LT_FILE_IMAGE_OPEN_RW);
    if (file < 0)
        return mutate_bytes(data, size, most);
    name_count = 0;
    collect(file, "/", 0);
    for (unsigned rounds = 1 + fuzz_random(3); rounds > 0; rounds--)
        change_object(file);
    H5Fflush(file, H5F_SCOPE_LOCAL);
    ssize_t whole = H5Fget_file_image(file, NULL, 0);
    if (whole > 0 && (size_t)whole <= most)
        size = (size_t)H5Fget_file_image(file, data, most);
    H5Fclose(file);
    return size;
}

size_t fuzz_open_h5(void)
{
    ssize_t open = H5Fget_obj_count((hid_t)H5F_OBJ_ALL, H5F_OBJ_ALL);
    return open > 0 ? (size_t)open : 0;
}
