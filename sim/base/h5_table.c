/* Tables that are written and read whole: see h5.h. */
#include "sim/base/h5_private.h"

static hid_t stored_type(enum bead_h5_type type)
{
    return type == BEAD_H5_DOUBLE ? H5T_IEEE_F64LE : type == BEAD_H5_INT ? H5T_STD_I64LE : H5T_STD_U8LE;
}

static hid_t memory_type(enum bead_h5_type type)
{
    return type == BEAD_H5_DOUBLE ? H5T_NATIVE_DOUBLE : type == BEAD_H5_INT ? H5T_NATIVE_INT64 : H5T_NATIVE_UINT8;
}

void bead_h5_write_table(struct bead_h5 *h5, hid_t parent, const char *name, const char *units, enum bead_h5_type type, size_t rows,
                         size_t columns, const hid_t scales[2], const void *values)
{
    if (h5->error)
        return;
    BEAD_H5_QUIET;
    const hsize_t size[2] = {rows, columns};
    BEAD_H5_AUTO space = H5Screate_simple(2, size, NULL);
    BEAD_H5_AUTO layout = H5Pcreate(H5P_DATASET_CREATE);
    BEAD_H5_AUTO dataset = -1;
    /* No time stamps: same scene, same bytes. */
    if (space >= 0 && layout >= 0 && H5Pset_obj_track_times(layout, 0) >= 0)
        dataset = H5Dcreate2(parent, name, stored_type(type), space, H5P_DEFAULT, layout, H5P_DEFAULT);
    if (dataset < 0 || H5Dwrite(dataset, memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) {
        bead_h5_fail(h5, true, "cannot write %s", name);
        return;
    }
    if (units)
        bead_h5_put_text(h5, dataset, "units", units);
    for (unsigned axis = 0; axis < 2; axis++) {
        if (scales[axis] >= 0)
            bead_h5_attach(h5, dataset, axis, scales[axis]);
    }
}

void bead_h5_read_table(struct bead_h5 *h5, const char *name, enum bead_h5_type type, size_t rows, size_t columns, void *values)
{
    if (h5->error)
        return;
    BEAD_H5_QUIET;
    BEAD_H5_AUTO dataset = bead_h5_open_dataset(h5, name);
    if (dataset < 0)
        return;
    hsize_t size[2] = {0, 0};
    BEAD_H5_AUTO kind = H5Dget_type(dataset);
    BEAD_H5_AUTO space = H5Dget_space(dataset);
    const H5T_class_t class = type == BEAD_H5_DOUBLE ? H5T_FLOAT : H5T_INTEGER;
    bool fits = kind >= 0 && H5Tget_class(kind) == class && space >= 0 && H5Sget_simple_extent_ndims(space) == 2 &&
                H5Sget_simple_extent_dims(space, size, NULL) == 2 && size[0] == rows && size[1] == columns;
    if (!fits)
        bead_h5_fail(h5, false, "%s must have %zu x %zu values of the right kind", name, rows, columns);
    else if (H5Dread(dataset, memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
        bead_h5_fail(h5, true, "%s cannot be read", name);
}
