/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads HDF5 files that are not trusted, trajectories and files of sweeps: see h5.h. */
#include "sim/hdf5/h5_apart.h"
#include "sim/hdf5/h5_private.h"

#include <stdlib.h>

/* Bytes: a chunk of a trajectory has 8 MiB at most, or one row of a million columns. */
static const uint64_t largest_chunk = 8 << 20;

/* Identifiers are those of the process that reads. */
static hid_t identifier(const struct bead_h5 *h5, struct bead_h5_answer answer)
{
    return h5->error ? -1 : answer.number;
}

bool bead_h5_has(struct bead_h5 *h5, const char *name)
{
    if (h5->error)
        return false;
    if (h5->apart)
        return bead_h5_ask(h5, name, (struct bead_h5_question){.what = BEAD_H5_HAS}, NULL).number != 0;
    BEAD_H5_QUIET;
    char path[256];
    BEAD_H5_AUTO access = bead_h5_access(H5P_LINK_ACCESS);
    size_t length = strlen(name);
    if (length >= sizeof path)
        return false;
    /* H5Lexists requires all groups on the way. */
    for (size_t i = 1; i <= length; i++) {
        if (name[i] != '/' && name[i] != '\0')
            continue;
        memcpy(path, name, i);
        path[i] = '\0';
        if (H5Lexists(h5->file, path, access) <= 0)
            return false;
    }
    return H5Oexists_by_name(h5->file, name, access) > 0;
}

bool bead_h5_has_attribute(struct bead_h5 *h5, const char *name)
{
    if (h5->error)
        return false;
    if (h5->apart)
        return bead_h5_ask(h5, name, (struct bead_h5_question){.what = BEAD_H5_HAS_ATTRIBUTE}, NULL).number != 0;
    BEAD_H5_QUIET;
    return H5Aexists(h5->file, name) > 0;
}

static hid_t open_object(struct bead_h5 *h5, const char *name, H5I_type_t kind)
{
    if (!bead_h5_has(h5, name)) {
        bead_h5_fail(h5, false, "not a %s of this program: it has no %s", h5->kind, name);
        return -1;
    }
    BEAD_H5_AUTO access = bead_h5_access(kind == H5I_GROUP ? H5P_GROUP_ACCESS : H5P_DATASET_ACCESS);
    if (kind == H5I_DATASET)
        H5Pset_chunk_cache(access, 0, 0, H5D_CHUNK_CACHE_W0_DEFAULT); /* chunks are read straight into the caller's memory */
    hid_t object = kind == H5I_GROUP ? H5Gopen2(h5->file, name, access) : H5Dopen2(h5->file, name, access);
    if (object < 0)
        bead_h5_fail(h5, false, "not a %s of this program: %s is not a %s", h5->kind, name,
                     kind == H5I_GROUP ? "group" : "dataset");
    return object;
}

hid_t bead_h5_open_group(struct bead_h5 *h5, const char *name)
{
    if (h5->error)
        return -1;
    if (h5->apart)
        return identifier(h5, bead_h5_ask(h5, name, (struct bead_h5_question){.what = BEAD_H5_GROUP}, NULL));
    BEAD_H5_QUIET;
    return open_object(h5, name, H5I_GROUP);
}

/* Little-endian numbers of 8 bytes, bytes, or texts of a fixed length: no other type is written, so none is converted. */
static bool type_is_own(hid_t type)
{
    return H5Tequal(type, H5T_IEEE_F64LE) > 0 || H5Tequal(type, H5T_STD_I64LE) > 0 || H5Tequal(type, H5T_STD_U8LE) > 0 ||
           (H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0);
}

/* Why data do not have this program's layout within their file; NULL: they do. A file that is not trusted could refer to others,
 * unpack to any size, or lead HDF5 astray. */
static const char *strange(const struct bead_h5 *h5, hid_t dataset)
{
    BEAD_H5_AUTO list = H5Dget_create_plist(dataset);
    BEAD_H5_AUTO type = H5Dget_type(dataset);
    BEAD_H5_AUTO space = H5Dget_space(dataset);
    const H5D_layout_t layout = H5Pget_layout(list);
    hsize_t side[H5S_MAX_RANK];
    if (layout == H5D_VIRTUAL || (layout >= 0 && H5Pget_external_count(list) != 0))
        return "is stored in another file";
    if ((layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED) || H5Pget_nfilters(list) != 0)
        return "is compressed, filtered or stored in a way that this program never uses";
    if (!type_is_own(type))
        return "is of a type that this program does not write";
    const hssize_t values = H5Sget_simple_extent_npoints(space);
    const uint64_t size = H5Tget_size(type);
    uint64_t bytes;
    if (values < 0 || size == 0 || __builtin_mul_overflow((uint64_t)values, size, &bytes))
        return "has no size";
    if (layout == H5D_CONTIGUOUS) {
        const haddr_t at = H5Dget_offset(dataset); /* undefined: never written, all 0 */
        return bytes <= h5->bytes && (at == HADDR_UNDEF || at <= h5->bytes - bytes) ? NULL : "does not fit into the file";
    }
    const int rank = H5Pget_chunk(list, H5S_MAX_RANK, side);
    bytes = size;
    for (int i = 0; i < rank; i++)
        if (__builtin_mul_overflow(bytes, side[i], &bytes))
            return "has chunks without bounds";
    return rank > 0 && bytes <= largest_chunk ? NULL : "has larger chunks than this program writes";
}

static hid_t open_dataset(struct bead_h5 *h5, const char *name)
{
    if (h5->error)
        return -1;
    BEAD_H5_QUIET;
    hid_t dataset = open_object(h5, name, H5I_DATASET);
    const char *wrong = dataset < 0 ? NULL : strange(h5, dataset);
    if (wrong) {
        bead_h5_fail(h5, false, "%s %s", name, wrong);
        bead_h5_release(&dataset);
    }
    return dataset;
}

static bool type_is(hid_t type, H5T_class_t class)
{
    return H5Tget_class(type) == class && (class != H5T_STRING || H5Tis_variable_str(type) == 0);
}

/* Number of values of a scalar or one-dimensional space, -1 for others. */
static hssize_t vector_length(hid_t space)
{
    int rank = H5Sget_simple_extent_ndims(space);
    return rank == 0 || rank == 1 ? H5Sget_simple_extent_npoints(space) : -1;
}

/* A memory type for texts like those of `file_type`: HDF5 does not convert between character sets. */
static hid_t text_type_like(hid_t file_type, size_t size)
{
    return bead_h5_text_type(size, H5Tget_cset(file_type));
}

/* `memory` -1: a text of `size` bytes. */
static void get(struct bead_h5 *h5, hid_t object, const char *name, H5T_class_t class, hid_t memory, size_t size, void *value)
{
    if (h5->error)
        return;
    BEAD_H5_QUIET;
    BEAD_H5_AUTO attribute = H5Aexists(object, name) > 0 ? H5Aopen(object, name, H5P_DEFAULT) : -1;
    BEAD_H5_AUTO type = H5Aget_type(attribute);
    BEAD_H5_AUTO space = H5Aget_space(attribute);
    bool fits = type_is(type, class) && type_is_own(type) && H5Tget_size(type) <= 65536 && vector_length(space) == 1;
    BEAD_H5_AUTO text = fits && memory < 0 ? text_type_like(type, size) : -1;
    if (!fits || H5Aread(attribute, memory < 0 ? text : memory, value) < 0)
        bead_h5_fail(h5, false, "the attribute %s is missing or of a wrong kind", name);
}

void bead_h5_get_text(struct bead_h5 *h5, hid_t object, const char *name, char *text, size_t size)
{
    memset(text, 0, size);
    if (h5->apart)
        bead_h5_ask(h5, name, (struct bead_h5_question){.what = BEAD_H5_GET_TEXT, .object = object, .rows = size},
                    &(struct bead_h5_place){text, 1, 1, size});
    else
        get(h5, object, name, H5T_STRING, -1, size, text);
    text[size - 1] = '\0';
}

double bead_h5_get_double(struct bead_h5 *h5, hid_t object, const char *name)
{
    if (h5->error)
        return 0;
    if (h5->apart)
        return bead_h5_ask(h5, name, (struct bead_h5_question){.what = BEAD_H5_GET_DOUBLE, .object = object}, NULL).value;
    double value = 0;
    get(h5, object, name, H5T_FLOAT, H5T_NATIVE_DOUBLE, 0, &value);
    return value;
}

int64_t bead_h5_get_int(struct bead_h5 *h5, hid_t object, const char *name, int64_t low, int64_t high)
{
    if (h5->error)
        return low;
    if (h5->apart) {
        const struct bead_h5_question question = {.what = BEAD_H5_GET_INT, .object = object, .low = low, .high = high};
        const int64_t found = bead_h5_ask(h5, name, question, NULL).number;
        return found >= low && found <= high ? found : low;
    }
    int64_t value = low;
    get(h5, object, name, H5T_INTEGER, H5T_NATIVE_INT64, 0, &value);
    if (!h5->error && (value < low || value > high))
        bead_h5_fail(h5, false, "the attribute %s is %lld, must be %lld to %lld", name, (long long)value, (long long)low,
                     (long long)high);
    return value;
}

/* `memory` -1: texts of `size` bytes each. `apart`: the places in memory. */
static void read_vector(struct bead_h5 *h5, const char *name, H5T_class_t class, hid_t memory, size_t size, hid_t apart,
                        void *values, size_t count)
{
    if (h5->error)
        return;
    BEAD_H5_QUIET;
    BEAD_H5_AUTO dataset = open_dataset(h5, name);
    if (h5->error)
        return;
    BEAD_H5_AUTO type = H5Dget_type(dataset);
    BEAD_H5_AUTO space = H5Dget_space(dataset);
    bool fits = type_is(type, class) && vector_length(space) == (hssize_t)count;
    BEAD_H5_AUTO text = fits && memory < 0 ? text_type_like(type, size) : -1;
    if (!fits)
        bead_h5_fail(h5, false, "%s must have %zu values of the right kind", name, count);
    else if (H5Dread(dataset, memory < 0 ? text : memory, apart, H5S_ALL, H5P_DEFAULT, values) < 0)
        bead_h5_fail(h5, true, "%s cannot be read", name);
}

void bead_h5_read_numbers(struct bead_h5 *h5, const char *name, enum bead_h5_type type, void *first, size_t size, size_t count)
{
    if (h5->error)
        return;
    if (h5->apart) {
        bead_h5_ask(h5, name, (struct bead_h5_question){.what = BEAD_H5_NUMBERS, .type = type, .rows = count},
                    &(struct bead_h5_place){first, sizeof(double), size, count});
        return;
    }
    BEAD_H5_AUTO apart = bead_h5_space_apart(size, count);
    read_vector(h5, name, type == BEAD_H5_DOUBLE ? H5T_FLOAT : H5T_INTEGER, bead_h5_memory_type(type), 0, apart, first, count);
}

void bead_h5_read_texts(struct bead_h5 *h5, const char *name, struct bead_h5_text *texts, size_t count)
{
    if (h5->apart)
        bead_h5_ask(h5, name, (struct bead_h5_question){.what = BEAD_H5_TEXTS, .rows = count},
                    &(struct bead_h5_place){texts, sizeof *texts, sizeof *texts, count});
    else
        read_vector(h5, name, H5T_STRING, -1, sizeof *texts, H5S_ALL, texts, count);
    for (size_t i = 0; i < count; i++)
        texts[i].text[sizeof texts[i].text - 1] = '\0';
}

/* The text found by the separate process; to be freed. */
static char *ask_text(struct bead_h5 *h5, const char *name, size_t limit)
{
    const int64_t length = bead_h5_ask(h5, name, (struct bead_h5_question){.what = BEAD_H5_TEXT, .rows = limit}, NULL).number;
    if (!h5->error && (length < 0 || (uint64_t)length > limit || (uint64_t)length > bead_h5_apart_room(h5)))
        bead_h5_fail(h5, false, "%s cannot be read", name);
    if (h5->error)
        return NULL;
    char *text = calloc(1, (size_t)length + 1);
    if (text)
        memcpy(text, bead_h5_apart_bytes(h5), (size_t)length);
    else
        h5->error = bead_fail(h5->msg, BEAD_ERROR_MEMORY, "%s: no memory for %s", h5->path, name);
    return text;
}

char *bead_h5_read_text(struct bead_h5 *h5, const char *name, size_t limit)
{
    if (h5->error)
        return NULL;
    if (h5->apart)
        return ask_text(h5, name, limit);
    BEAD_H5_QUIET;
    BEAD_H5_AUTO dataset = open_dataset(h5, name);
    if (h5->error)
        return NULL;
    BEAD_H5_AUTO type = H5Dget_type(dataset);
    BEAD_H5_AUTO space = H5Dget_space(dataset);
    size_t size = type_is(type, H5T_STRING) ? H5Tget_size(type) : 0;
    if (size == 0 || size > limit || vector_length(space) != 1) {
        bead_h5_fail(h5, false, "%s must be a text of at most %zu bytes", name, limit);
        return NULL;
    }
    /* Keep the stored length if the text ends with a NUL: HDF5 takes half a megabyte to change the length of a text. */
    BEAD_H5_AUTO memory = text_type_like(type, H5Tget_strpad(type) == H5T_STR_NULLTERM ? size : size + 1);
    char *text = calloc(1, size + 1);
    if (!text) {
        h5->error = bead_fail(h5->msg, BEAD_ERROR_MEMORY, "%s: no memory for %s", h5->path, name);
        return NULL;
    }
    if (H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, text) < 0) {
        bead_h5_fail(h5, true, "%s cannot be read", name);
        free(text);
        return NULL;
    }
    return text;
}

hid_t bead_h5_open_series(struct bead_h5 *h5, const char *name, size_t columns, size_t components, size_t *rows)
{
    if (h5->error)
        return -1;
    if (h5->apart) {
        const struct bead_h5_question question = {.what = BEAD_H5_SERIES, .columns = columns, .components = components};
        const struct bead_h5_answer answer = bead_h5_ask(h5, name, question, NULL);
        *rows = answer.rows;
        return identifier(h5, answer);
    }
    BEAD_H5_QUIET;
    hid_t series = open_dataset(h5, name);
    if (series < 0)
        return -1;
    BEAD_H5_AUTO type = H5Dget_type(series);
    BEAD_H5_AUTO space = H5Dget_space(series);
    hsize_t size[3] = {0, 0, 0};
    int rank = columns == 0 ? 1 : components > 1 ? 3 : 2;
    bool fits = type_is(type, H5T_FLOAT) && H5Sget_simple_extent_ndims(space) == rank &&
                H5Sget_simple_extent_dims(space, size, NULL) == rank;
    fits = fits && (rank < 2 || size[1] == columns) && (rank < 3 || size[2] == components) && size[0] <= SIZE_MAX;
    if (!fits) {
        bead_h5_fail(h5, false, "%s has a wrong type or shape; must be floating-point numbers [times]%s", name,
                     rank == 1   ? ""
                     : rank == 2 ? "[columns]"
                                 : "[beads][3]");
        bead_h5_release(&series);
        return -1;
    }
    *rows = (size_t)size[0];
    return series;
}

/* In pieces that fit. */
static void ask_rows(struct bead_h5 *h5, hid_t series, size_t first, size_t rows, size_t columns, double *values)
{
    const size_t row = columns ? columns : 1, most = bead_h5_apart_room(h5) / sizeof *values / row;
    for (size_t done = 0, count; done < rows && !h5->error; done += count) {
        count = rows - done < most || most == 0 ? rows - done : most;
        bead_h5_ask(h5, NULL,
                    (struct bead_h5_question){
                        .what = BEAD_H5_ROWS, .object = series, .first = first + done, .rows = count, .columns = columns},
                    &(struct bead_h5_place){values + done * row, sizeof *values, sizeof *values, count * row});
    }
}

void bead_h5_read_rows(struct bead_h5 *h5, hid_t series, size_t first, size_t rows, size_t columns, double *values)
{
    if (h5->error)
        return;
    if (h5->apart) {
        ask_rows(h5, series, first, rows, columns, values);
        return;
    }
    BEAD_H5_QUIET;
    hsize_t start[3] = {first, 0, 0}, count[3] = {rows, columns, 1};
    BEAD_H5_AUTO file_space = H5Dget_space(series);
    BEAD_H5_AUTO memory_space = H5Screate_simple(columns ? 2 : 1, count, NULL);
    if (H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start, NULL, count, NULL) < 0 ||
        H5Dread(series, H5T_NATIVE_DOUBLE, memory_space, file_space, H5P_DEFAULT, values) < 0)
        bead_h5_fail(h5, true, "samples from %zu on cannot be read", first);
}

void bead_h5_read_table(struct bead_h5 *h5, const char *name, enum bead_h5_type type, size_t rows, size_t columns, void *values)
{
    if (h5->error)
        return;
    if (h5->apart) {
        const size_t value = type == BEAD_H5_BYTE ? 1 : sizeof(double);
        bead_h5_ask(h5, name, (struct bead_h5_question){.what = BEAD_H5_TABLE, .type = type, .rows = rows, .columns = columns},
                    &(struct bead_h5_place){values, value, value, rows * columns});
        return;
    }
    BEAD_H5_QUIET;
    BEAD_H5_AUTO dataset = open_dataset(h5, name);
    if (dataset < 0)
        return;
    hsize_t size[2] = {0, 0};
    BEAD_H5_AUTO kind = H5Dget_type(dataset);
    BEAD_H5_AUTO space = H5Dget_space(dataset);
    const H5T_class_t class = type == BEAD_H5_DOUBLE ? H5T_FLOAT : H5T_INTEGER;
    bool fits = type_is(kind, class) && H5Sget_simple_extent_ndims(space) == 2 &&
                H5Sget_simple_extent_dims(space, size, NULL) == 2 && size[0] == rows && size[1] == columns;
    if (!fits)
        bead_h5_fail(h5, false, "%s must have %zu x %zu values of the right kind", name, rows, columns);
    else if (H5Dread(dataset, bead_h5_memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
        bead_h5_fail(h5, true, "%s cannot be read", name);
}
