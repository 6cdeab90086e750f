/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of h5 share: guards, and HDF5 itself, which is opened when the first of its files is written or read. It brings
 * forty libraries, which a table need not wait for.
 *
 * What is used of HDF5 is listed here; below, its own names stand for what bead_h5_load has found. A name that is only in one of
 * both places does not compile, or does not link. */
#ifndef BEADREEL_SIM_BASE_H5_PRIVATE_H
#define BEADREEL_SIM_BASE_H5_PRIVATE_H

#include <hdf5.h>
#include <hdf5_hl.h>
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

#include "sim/base/h5.h"

#if H5_VERSION_GE(1, 10, 7) && !(H5_VERS_MAJOR == 1 && H5_VERS_MINOR == 12 && H5_VERS_RELEASE == 0)
#define BEAD_H5_HAS_LOCKING
#define BEAD_H5_LOCKING_SYMBOLS(X) X(H5Pset_file_locking)
#else
#define BEAD_H5_LOCKING_SYMBOLS(X)
#endif

/* Functions, and identifiers (..._g). */
#define BEAD_H5_CORE_SYMBOLS(X)         \
    X(H5Acreate2)                       \
    X(H5Aexists)                        \
    X(H5Aget_space)                     \
    X(H5Aget_type)                      \
    X(H5Aopen)                          \
    X(H5Aread)                          \
    X(H5Awrite)                         \
    X(H5Dcreate2)                       \
    X(H5Dget_create_plist)              \
    X(H5Dget_space)                     \
    X(H5Dget_type)                      \
    X(H5Dopen2)                         \
    X(H5Dread)                          \
    X(H5Dset_extent)                    \
    X(H5Dwrite)                         \
    X(H5Eget_auto2)                     \
    X(H5Eset_auto2)                     \
    X(H5Ewalk2)                         \
    X(H5FDregister)                     \
    X(H5FDunregister)                   \
    X(H5Fclose)                         \
    X(H5Fcreate)                        \
    X(H5Fflush)                         \
    X(H5Fopen)                          \
    X(H5Gcreate2)                       \
    X(H5Gopen2)                         \
    X(H5Idec_ref)                       \
    X(H5Lexists)                        \
    X(H5Oexists_by_name)                \
    X(H5Olink)                          \
    X(H5P_CLS_DATASET_ACCESS_ID_g)      \
    X(H5P_CLS_DATASET_CREATE_ID_g)      \
    X(H5P_CLS_FILE_ACCESS_ID_g)         \
    X(H5P_CLS_GROUP_ACCESS_ID_g)        \
    X(H5P_CLS_LINK_ACCESS_ID_g)         \
    X(H5P_CLS_LINK_CREATE_ID_g)         \
    X(H5Pcreate)                        \
    X(H5Pget_driver_info)               \
    X(H5Pget_external_count)            \
    X(H5Pget_layout)                    \
    X(H5Pget_nfilters)                  \
    X(H5Pset_alloc_time)                \
    X(H5Pset_chunk)                     \
    X(H5Pset_chunk_cache)               \
    X(H5Pset_create_intermediate_group) \
    X(H5Pset_driver)                    \
    X(H5Pset_elink_cb)                  \
    X(H5Pset_fclose_degree)             \
    X(H5Pset_fill_time)                 \
    X(H5Pset_fill_value)                \
    X(H5Pset_obj_track_times)           \
    X(H5Screate)                        \
    X(H5Screate_simple)                 \
    X(H5Sget_simple_extent_dims)        \
    X(H5Sget_simple_extent_ndims)       \
    X(H5Sget_simple_extent_npoints)     \
    X(H5Sselect_hyperslab)              \
    X(H5T_C_S1_g)                       \
    X(H5T_IEEE_F64LE_g)                 \
    X(H5T_NATIVE_DOUBLE_g)              \
    X(H5T_NATIVE_INT64_g)               \
    X(H5T_NATIVE_UINT8_g)               \
    X(H5T_STD_I64LE_g)                  \
    X(H5T_STD_U8LE_g)                   \
    X(H5Tcopy)                          \
    X(H5Tget_class)                     \
    X(H5Tget_cset)                      \
    X(H5Tget_size)                      \
    X(H5Tget_strpad)                    \
    X(H5Tis_variable_str)               \
    X(H5Tset_cset)                      \
    X(H5Tset_size)                      \
    X(H5check_version)                  \
    X(H5dont_atexit)                    \
    X(H5open)                           \
    BEAD_H5_LOCKING_SYMBOLS(X)

/* Dimension scales are in a library of their own. */
#define BEAD_H5_SCALE_SYMBOLS(X) X(H5DSattach_scale) X(H5DSset_scale)

struct bead_h5_symbols {
#define BEAD_H5_MEMBER(name) __typeof__(&name) name;
    BEAD_H5_CORE_SYMBOLS(BEAD_H5_MEMBER)
    BEAD_H5_SCALE_SYMBOLS(BEAD_H5_MEMBER)
#undef BEAD_H5_MEMBER
};

/* NULL pointers until bead_h5_load has succeeded, which opening and making a file begin with. */
const struct bead_h5_symbols *bead_h5_symbols(void);

#define H5Acreate2                       (*bead_h5_symbols()->H5Acreate2)
#define H5Aexists                        (*bead_h5_symbols()->H5Aexists)
#define H5Aget_space                     (*bead_h5_symbols()->H5Aget_space)
#define H5Aget_type                      (*bead_h5_symbols()->H5Aget_type)
#define H5Aopen                          (*bead_h5_symbols()->H5Aopen)
#define H5Aread                          (*bead_h5_symbols()->H5Aread)
#define H5Awrite                         (*bead_h5_symbols()->H5Awrite)
#define H5Dcreate2                       (*bead_h5_symbols()->H5Dcreate2)
#define H5Dget_create_plist              (*bead_h5_symbols()->H5Dget_create_plist)
#define H5Dget_space                     (*bead_h5_symbols()->H5Dget_space)
#define H5Dget_type                      (*bead_h5_symbols()->H5Dget_type)
#define H5Dopen2                         (*bead_h5_symbols()->H5Dopen2)
#define H5Dread                          (*bead_h5_symbols()->H5Dread)
#define H5Dset_extent                    (*bead_h5_symbols()->H5Dset_extent)
#define H5Dwrite                         (*bead_h5_symbols()->H5Dwrite)
#define H5Eget_auto2                     (*bead_h5_symbols()->H5Eget_auto2)
#define H5Eset_auto2                     (*bead_h5_symbols()->H5Eset_auto2)
#define H5Ewalk2                         (*bead_h5_symbols()->H5Ewalk2)
#define H5FDregister                     (*bead_h5_symbols()->H5FDregister)
#define H5FDunregister                   (*bead_h5_symbols()->H5FDunregister)
#define H5Fclose                         (*bead_h5_symbols()->H5Fclose)
#define H5Fcreate                        (*bead_h5_symbols()->H5Fcreate)
#define H5Fflush                         (*bead_h5_symbols()->H5Fflush)
#define H5Fopen                          (*bead_h5_symbols()->H5Fopen)
#define H5Gcreate2                       (*bead_h5_symbols()->H5Gcreate2)
#define H5Gopen2                         (*bead_h5_symbols()->H5Gopen2)
#define H5Idec_ref                       (*bead_h5_symbols()->H5Idec_ref)
#define H5Lexists                        (*bead_h5_symbols()->H5Lexists)
#define H5Oexists_by_name                (*bead_h5_symbols()->H5Oexists_by_name)
#define H5Olink                          (*bead_h5_symbols()->H5Olink)
#define H5P_CLS_DATASET_ACCESS_ID_g      (*bead_h5_symbols()->H5P_CLS_DATASET_ACCESS_ID_g)
#define H5P_CLS_DATASET_CREATE_ID_g      (*bead_h5_symbols()->H5P_CLS_DATASET_CREATE_ID_g)
#define H5P_CLS_FILE_ACCESS_ID_g         (*bead_h5_symbols()->H5P_CLS_FILE_ACCESS_ID_g)
#define H5P_CLS_GROUP_ACCESS_ID_g        (*bead_h5_symbols()->H5P_CLS_GROUP_ACCESS_ID_g)
#define H5P_CLS_LINK_ACCESS_ID_g         (*bead_h5_symbols()->H5P_CLS_LINK_ACCESS_ID_g)
#define H5P_CLS_LINK_CREATE_ID_g         (*bead_h5_symbols()->H5P_CLS_LINK_CREATE_ID_g)
#define H5Pcreate                        (*bead_h5_symbols()->H5Pcreate)
#define H5Pget_driver_info               (*bead_h5_symbols()->H5Pget_driver_info)
#define H5Pget_external_count            (*bead_h5_symbols()->H5Pget_external_count)
#define H5Pget_layout                    (*bead_h5_symbols()->H5Pget_layout)
#define H5Pget_nfilters                  (*bead_h5_symbols()->H5Pget_nfilters)
#define H5Pset_alloc_time                (*bead_h5_symbols()->H5Pset_alloc_time)
#define H5Pset_chunk                     (*bead_h5_symbols()->H5Pset_chunk)
#define H5Pset_chunk_cache               (*bead_h5_symbols()->H5Pset_chunk_cache)
#define H5Pset_create_intermediate_group (*bead_h5_symbols()->H5Pset_create_intermediate_group)
#define H5Pset_driver                    (*bead_h5_symbols()->H5Pset_driver)
#define H5Pset_elink_cb                  (*bead_h5_symbols()->H5Pset_elink_cb)
#define H5Pset_fclose_degree             (*bead_h5_symbols()->H5Pset_fclose_degree)
#define H5Pset_fill_time                 (*bead_h5_symbols()->H5Pset_fill_time)
#define H5Pset_fill_value                (*bead_h5_symbols()->H5Pset_fill_value)
#define H5Pset_obj_track_times           (*bead_h5_symbols()->H5Pset_obj_track_times)
#define H5Screate                        (*bead_h5_symbols()->H5Screate)
#define H5Screate_simple                 (*bead_h5_symbols()->H5Screate_simple)
#define H5Sget_simple_extent_dims        (*bead_h5_symbols()->H5Sget_simple_extent_dims)
#define H5Sget_simple_extent_ndims       (*bead_h5_symbols()->H5Sget_simple_extent_ndims)
#define H5Sget_simple_extent_npoints     (*bead_h5_symbols()->H5Sget_simple_extent_npoints)
#define H5Sselect_hyperslab              (*bead_h5_symbols()->H5Sselect_hyperslab)
#define H5T_C_S1_g                       (*bead_h5_symbols()->H5T_C_S1_g)
#define H5T_IEEE_F64LE_g                 (*bead_h5_symbols()->H5T_IEEE_F64LE_g)
#define H5T_NATIVE_DOUBLE_g              (*bead_h5_symbols()->H5T_NATIVE_DOUBLE_g)
#define H5T_NATIVE_INT64_g               (*bead_h5_symbols()->H5T_NATIVE_INT64_g)
#define H5T_NATIVE_UINT8_g               (*bead_h5_symbols()->H5T_NATIVE_UINT8_g)
#define H5T_STD_I64LE_g                  (*bead_h5_symbols()->H5T_STD_I64LE_g)
#define H5T_STD_U8LE_g                   (*bead_h5_symbols()->H5T_STD_U8LE_g)
#define H5Tcopy                          (*bead_h5_symbols()->H5Tcopy)
#define H5Tget_class                     (*bead_h5_symbols()->H5Tget_class)
#define H5Tget_cset                      (*bead_h5_symbols()->H5Tget_cset)
#define H5Tget_size                      (*bead_h5_symbols()->H5Tget_size)
#define H5Tget_strpad                    (*bead_h5_symbols()->H5Tget_strpad)
#define H5Tis_variable_str               (*bead_h5_symbols()->H5Tis_variable_str)
#define H5Tset_cset                      (*bead_h5_symbols()->H5Tset_cset)
#define H5Tset_size                      (*bead_h5_symbols()->H5Tset_size)
#define H5check_version                  (*bead_h5_symbols()->H5check_version)
#define H5dont_atexit                    (*bead_h5_symbols()->H5dont_atexit)
#define H5open                           (*bead_h5_symbols()->H5open)
#define H5DSattach_scale                 (*bead_h5_symbols()->H5DSattach_scale)
#define H5DSset_scale                    (*bead_h5_symbols()->H5DSset_scale)
#define H5Pset_file_locking              (*bead_h5_symbols()->H5Pset_file_locking)

struct bead_h5_quiet {
    H5E_auto2_t print;
    void *data;
};
struct bead_h5_quiet bead_h5_quiet_begin(void);
void bead_h5_quiet_end(struct bead_h5_quiet *before);
void bead_h5_release(hid_t *id);

/* HDF5 prints nothing until the end of the block. To clang, what only its cleanup reads is unused. */
#define BEAD_H5_QUIET __attribute__((cleanup(bead_h5_quiet_end), unused)) struct bead_h5_quiet quiet_guard = bead_h5_quiet_begin()
/* An identifier of any kind, closed at the end of the block. */
#define BEAD_H5_AUTO __attribute__((cleanup(bead_h5_release))) hid_t

/* The type of a fixed-length text of `size` bytes with its NUL. */
hid_t bead_h5_text_type(size_t size, H5T_cset_t characters);
/* An access list of `class` that follows no links out of the file; -1 on failure. */
hid_t bead_h5_access(hid_t class);

#endif
