/* SPDX-License-Identifier: GPL-3.0-or-later */
/* HDF5 with every call checked and the first error kept.
 *
 * A `struct bead_h5` remembers the first failure: all later calls on it do nothing and return -1, so that a row of
 * calls is checked once at its end. Identifiers made here are closed here, but for those returned: close these with
 * bead_h5_close. HDF5's own printing of errors is switched off while a call runs. */
#ifndef BEADREEL_SIM_BASE_H5_H
#define BEADREEL_SIM_BASE_H5_H

#include <hdf5.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/library.h"
#include "sim/base/h5_disk.h"

struct bead_h5 {
    hid_t file;               /* -1: not open */
    const char *path;         /* for messages; borrowed */
    const char *kind;         /* "sweep"; NULL: trajectory */
    enum bead_error code;     /* of failures: IO when writing, FORMAT when reading */
    struct bead_h5_disk disk; /* of a file being written */
    enum bead_error error;    /* the first failure */
    struct bead_message *msg; /* where it is told; may be NULL; set it at every entry of a part that keeps a bead_h5 */
};

/* Keep the first failure and its message: "path: ..." and what HDF5 says about it where `cause`. Returns the error. */
enum bead_error bead_h5_fail(struct bead_h5 *h5, bool cause, const char *format, ...) BEAD_PRINTF(3, 4);

/* Open HDF5's libraries, for a caller who will need them later; making and opening a file does so, too. Any number of threads may
 * call it. Errors: UNSUPPORTED (missing, with the package to install). */
BEAD_CHECK enum bead_error bead_h5_load(struct bead_message *msg);
/* The row of a library for lists of what is opened at run time; NULL past the last. */
const struct bead_library_info *bead_h5_library_info(size_t index);
/* For programs, before anything else: when HDF5 is loaded it is told not to clean up at exit. It may keep objects of a damaged file
 * open, and would complain of them on stderr. */
void bead_h5_no_exit_handler(void);

/* Make a new file, or open one for reading. `path` must outlive the bead_h5, which must stay where it is while the file is open. */
void bead_h5_create(struct bead_h5 *h5, const char *path, struct bead_message *msg);
void bead_h5_open(struct bead_h5 *h5, const char *path, struct bead_message *msg);
/* Close the file, where open; a failure to write the rest counts. */
void bead_h5_shut(struct bead_h5 *h5);
/* Hand what was written to the operating system. */
void bead_h5_flush(struct bead_h5 *h5);
/* Close a group or dataset; -1 does nothing. Sets it to -1. */
void bead_h5_close(struct bead_h5 *h5, hid_t *object);
/* True where the file at `path` begins as HDF5 files do. */
bool bead_h5_is(const char *path);

/* Writing: names are paths from `parent`; groups on the way are made. */
hid_t bead_h5_make_group(struct bead_h5 *h5, hid_t parent, const char *name);
void bead_h5_put_text(struct bead_h5 *h5, hid_t object, const char *name, const char *text); /* attributes */
void bead_h5_put_texts(struct bead_h5 *h5, hid_t object, const char *name, const char *const *texts, size_t count);
void bead_h5_put_double(struct bead_h5 *h5, hid_t object, const char *name, double value);
void bead_h5_put_ints(struct bead_h5 *h5, hid_t object, const char *name, const int64_t *values,
                      size_t count); /* count 0: scalar */

/* One-dimensional datasets written once; `units` may be NULL. `scale`: -1, or the dimension scale of the axis. */
void bead_h5_write_doubles(struct bead_h5 *h5, hid_t parent, const char *name, const char *units, hid_t scale, const double *values,
                           size_t count);
void bead_h5_write_ints(struct bead_h5 *h5, hid_t parent, const char *name, hid_t scale, const int64_t *values, size_t count);
void bead_h5_write_texts(struct bead_h5 *h5, hid_t parent, const char *name, hid_t scale, const char *const *texts, size_t count);
void bead_h5_write_text(struct bead_h5 *h5, hid_t parent, const char *name, const char *text); /* a scalar dataset */
/* Overwrite a scalar integer attribute. */
void bead_h5_set_int(struct bead_h5 *h5, hid_t object, const char *name, int64_t value);

/* Kinds of numbers in files and memory: doubles, 64-bit integers, or bytes. */
enum bead_h5_type { BEAD_H5_DOUBLE, BEAD_H5_INT, BEAD_H5_BYTE };

/* Tables [rows][columns] written and read whole. rows > 0, columns > 0; `units` may be NULL;
 * scales of both axes, -1: none. */
void bead_h5_write_table(struct bead_h5 *h5, hid_t parent, const char *name, const char *units, enum bead_h5_type type, size_t rows,
                         size_t columns, const hid_t scales[2], const void *values);
void bead_h5_read_table(struct bead_h5 *h5, const char *name, enum bead_h5_type type, size_t rows, size_t columns, void *values);

/* Growing datasets [time][columns], or [time][columns][components] of which each component has its own chunks:
 * components never written are read as 0 and cost room on disks that know no holes in files. columns 0: [time] alone. Type double,
 * or 64-bit integer. */
hid_t bead_h5_make_series(struct bead_h5 *h5, hid_t parent, const char *name, const char *units, bool integer, size_t chunk_rows,
                          size_t columns, size_t components);
/* Write rows first..first+rows-1 of one component; the dataset grows to hold them. `values` is [rows][columns]. */
void bead_h5_write_rows(struct bead_h5 *h5, hid_t series, enum bead_h5_type type, size_t first, size_t rows, size_t columns,
                        size_t component, const void *values);

/* Dimension scales: make a dataset the scale `name`; the same with the dataset at `path`, which is returned open; make it the scale
 * of an axis. */
void bead_h5_make_scale(struct bead_h5 *h5, hid_t dataset, const char *name);
hid_t bead_h5_open_scale(struct bead_h5 *h5, hid_t parent, const char *path, const char *name);
void bead_h5_attach(struct bead_h5 *h5, hid_t dataset, unsigned axis, hid_t scale);
/* A second name for an object. */
void bead_h5_link(struct bead_h5 *h5, hid_t object, hid_t parent, const char *name);

/* Reading files that are not trusted: what is missing, or of another type or shape, fails with the name in the message. */
bool bead_h5_has(struct bead_h5 *h5, const char *name); /* path from the root; every step of it is there */
hid_t bead_h5_open_group(struct bead_h5 *h5, const char *name);
hid_t bead_h5_open_dataset(struct bead_h5 *h5, const char *name);
bool bead_h5_has_attribute(struct bead_h5 *h5, const char *name);                                   /* of the file */
void bead_h5_get_text(struct bead_h5 *h5, hid_t object, const char *name, char *text, size_t size); /* attributes */
double bead_h5_get_double(struct bead_h5 *h5, hid_t object, const char *name);
int64_t bead_h5_get_int(struct bead_h5 *h5, hid_t object, const char *name, int64_t low, int64_t high);
/* Datasets with exactly `count` values, into `values`. */
void bead_h5_read_doubles(struct bead_h5 *h5, const char *name, double *values, size_t count);
void bead_h5_read_ints(struct bead_h5 *h5, const char *name, int64_t *values, size_t count);
struct bead_h5_text {
    char text[64]; /* longer ones are cut */
};
void bead_h5_read_texts(struct bead_h5 *h5, const char *name, struct bead_h5_text *texts, size_t count);
/* A scalar text dataset of at most `limit` bytes; to be freed by the caller. NULL on failure. */
char *bead_h5_read_text(struct bead_h5 *h5, const char *name, size_t limit);
/* A dataset of doubles [time][columns] (components 1) or [time][columns][components]; *rows gets the length of time. */
hid_t bead_h5_open_series(struct bead_h5 *h5, const char *name, size_t columns, size_t components, size_t *rows);
void bead_h5_read_rows(struct bead_h5 *h5, hid_t series, size_t first, size_t rows, size_t columns,
                       double *values); /* component 0 */

#endif
