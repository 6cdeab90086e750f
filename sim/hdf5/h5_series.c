/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes growing datasets: see h5.h. The trajectory sink streams its samples through these. */
#include "sim/hdf5/h5_private.h"

/* Columns in a chunk, at most, so that no chunk nears HDF5's limit of 4 GB. */
static const hsize_t widest_chunk = 1 << 20;

/* Also allocate the components that are never written, because jsfive cannot read missing chunks. They extend the file without a
 * write, and take no room on most disks. */
static herr_t reserve_chunks(hid_t layout)
{
    return H5Pset_alloc_time(layout, H5D_ALLOC_TIME_EARLY) < 0 ? -1 : H5Pset_fill_time(layout, H5D_FILL_TIME_NEVER);
}

static hid_t series_layout(bool integer, size_t chunk_rows, size_t columns, int rank)
{
    hsize_t chunk[3] = {chunk_rows ? chunk_rows : 1, columns < widest_chunk ? columns : widest_chunk, 1};
    static const double zero = 0;
    static const int64_t izero = 0;
    hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    herr_t filled =
        integer ? H5Pset_fill_value(layout, H5T_NATIVE_INT64, &izero) : H5Pset_fill_value(layout, H5T_NATIVE_DOUBLE, &zero);
    /* No time stamps: the same scene gives the same bytes. */
    if (filled < 0 || H5Pset_obj_track_times(layout, 0) < 0 || H5Pset_chunk(layout, rank, chunk) < 0 ||
        (rank == 3 && reserve_chunks(layout) < 0))
        bead_h5_release(&layout);
    return layout;
}

hid_t bead_h5_make_series(struct bead_h5 *h5, hid_t parent, const char *name, const char *units, bool integer, size_t chunk_rows,
                          size_t columns, size_t components)
{
    if (h5->error)
        return -1;
    BEAD_H5_QUIET;
    int rank = columns == 0 ? 1 : components > 1 ? 3 : 2;
    hsize_t size[3] = {0, columns, components}, most[3] = {H5S_UNLIMITED, columns, components};
    BEAD_H5_AUTO space = H5Screate_simple(rank, size, most);
    BEAD_H5_AUTO layout = series_layout(integer, chunk_rows, columns, rank);
    BEAD_H5_AUTO links = H5Pcreate(H5P_LINK_CREATE);
    hid_t series = -1;
    if (H5Pset_create_intermediate_group(links, 1) >= 0)
        series = H5Dcreate2(parent, name, integer ? H5T_STD_I64LE : H5T_IEEE_F64LE, space, links, layout, H5P_DEFAULT);
    if (series < 0)
        bead_h5_fail(h5, true, "cannot make %s", name);
    else if (units)
        bead_h5_put_text(h5, series, "units", units);
    return series;
}

/* Make the dataset at least `rows` long. Returns < 0 on failure. */
static herr_t grow(hid_t series, size_t rows)
{
    hsize_t size[3];
    BEAD_H5_AUTO space = H5Dget_space(series);
    if (H5Sget_simple_extent_dims(space, size, NULL) < 1)
        return -1;
    if (size[0] >= rows)
        return 0;
    size[0] = rows;
    return H5Dset_extent(series, size);
}

void bead_h5_write_rows(struct bead_h5 *h5, hid_t series, enum bead_h5_type type, size_t first, size_t rows, size_t columns,
                        size_t component, const void *values)
{
    if (h5->error)
        return;
    BEAD_H5_QUIET;
    hsize_t start[3] = {first, 0, component}, count[3] = {rows, columns, 1};
    herr_t ok = grow(series, first + rows);
    BEAD_H5_AUTO file_space = ok < 0 ? -1 : H5Dget_space(series);
    BEAD_H5_AUTO memory_space = H5Screate_simple(columns ? 2 : 1, count, NULL);
    if (H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start, NULL, count, NULL) < 0 ||
        H5Dwrite(series, bead_h5_memory_type(type), memory_space, file_space, H5P_DEFAULT, values) < 0)
        bead_h5_fail(h5, true, "cannot write samples");
    bead_h5_check_disk(h5);
}

void bead_h5_link(struct bead_h5 *h5, hid_t object, hid_t parent, const char *name)
{
    if (h5->error)
        return;
    BEAD_H5_QUIET;
    if (H5Olink(object, parent, name, H5P_DEFAULT, H5P_DEFAULT) < 0)
        bead_h5_fail(h5, true, "cannot link %s", name);
}
