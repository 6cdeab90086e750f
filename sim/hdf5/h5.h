/* SPDX-License-Identifier: GPL-3.0-or-later */
/* HDF5 with every call checked and the first error kept.
 *
 * A `struct bead_h5` keeps the first failure: all later calls on it do nothing and return -1, so that a series of calls needs one
 * check at its end. Close returned identifiers with bead_h5_close; all others are closed here. HDF5 prints no errors during a
 * call. */
#pragma once

#include <hdf5.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "sim/base/library.h"
#include "sim/hdf5/h5_check.h"
#include "sim/hdf5/h5_disk.h"

struct bead_h5 {
    hid_t file;                  /* -1: not open in this process */
    const char *path;            /* for messages; borrowed */
    const char *kind;            /* the kind it is read as, for messages: "sweep", "trajectory" */
    enum bead_error code;        /* of failures: IO when writing, FORMAT when reading */
    struct bead_h5_disk disk;    /* of a file being written */
    struct bead_h5_check check;  /* of one being read */
    uint64_t bytes;              /* of that, when it was opened */
    struct bead_h5_apart *apart; /* the process that reads it; NULL: this one */
    enum bead_error error;       /* the first failure */
    struct bead_message *msg;    /* for its text; may be NULL; set it whenever a part that keeps a bead_h5 is called */
};

/* Keep the first failure and its message: "path: ...", with HDF5's reason if `cause`. Returns the error. */
enum bead_error bead_h5_fail(struct bead_h5 *h5, bool cause, const char *format, ...) BEAD_PRINTF(3, 4);

/* Open HDF5's libraries, for a caller that will need them later; making or opening a file also does so. May be called from any
 * thread. Errors: UNSUPPORTED (missing, with the package to install). */
BEAD_CHECK enum bead_error bead_h5_load(struct bead_message *msg);
extern const struct bead_library_info bead_h5_libraries[];
/* For programs, before all other calls: HDF5 will not clean up at exit, when it would complain on stderr about objects of damaged
 * files that it could not close. */
void bead_h5_no_exit_handler(void);

/* For tests that look into HDF5, and for fuzzing: files are read in this process, not in a separate one. */
void bead_h5_stay_in_process(void);

/* Make a new file, or open one for reading. `path` must outlive the bead_h5, which must not move while the file is open. */
void bead_h5_create(struct bead_h5 *h5, const char *path, struct bead_message *msg);
void bead_h5_open(struct bead_h5 *h5, const char *path, const char *kind, struct bead_message *msg);
/* Is the finished file at `path`, bit for bit, as written? *bytes gets its length. Errors: IO, MEMORY, FORMAT (it is not, or has no
 * digests). */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_h5_verify(const char *path, uint64_t *bytes, struct bead_message *msg);
/* Close the file, if open; a failure to write the rest is kept. */
void bead_h5_shut(struct bead_h5 *h5);
/* Flush HDF5; with `write`, so that the file on the disk is that of now, which waits for the disk. */
void bead_h5_flush(struct bead_h5 *h5, bool write);
/* Close a group or dataset; -1 does nothing. Sets it to -1. */
void bead_h5_close(struct bead_h5 *h5, hid_t *object);
/* Has the file at `path` the signature of HDF5 files? */
bool bead_h5_is(const char *path);

/* Writing: names are paths from `parent`; missing groups on the way are made. */
hid_t bead_h5_make_group(struct bead_h5 *h5, hid_t parent, const char *name);
void bead_h5_put_text(struct bead_h5 *h5, hid_t object, const char *name, const char *text); /* attributes */
void bead_h5_put_texts(struct bead_h5 *h5, hid_t object, const char *name, const char *const *texts, size_t count);
void bead_h5_put_double(struct bead_h5 *h5, hid_t object, const char *name, double value);
void bead_h5_put_ints(struct bead_h5 *h5, hid_t object, const char *name, const int64_t *values,
                      size_t count); /* count 0: scalar */

/* Kinds of numbers in files and memory: doubles, 64-bit integers, or bytes. */
enum bead_h5_type { BEAD_H5_DOUBLE, BEAD_H5_INT, BEAD_H5_BYTE };

/* One-dimensional datasets written once, of numbers (no bytes) or texts that are `size` bytes apart: members of structures, or an
 * array. `units` may be NULL. `scale`: -1, or the dimension scale of the axis. A text that is NULL is empty. */
void bead_h5_write_numbers(struct bead_h5 *h5, hid_t parent, const char *name, const char *units, hid_t scale,
                           enum bead_h5_type type, const void *first, size_t size, size_t count);
void bead_h5_write_texts(struct bead_h5 *h5, hid_t parent, const char *name, const char *const *first, size_t size, size_t count);
void bead_h5_write_text(struct bead_h5 *h5, hid_t parent, const char *name, const char *text); /* a scalar dataset */
/* Overwrite a scalar integer attribute. */
void bead_h5_set_int(struct bead_h5 *h5, hid_t object, const char *name, int64_t value);

/* Tables [rows][columns] written and read whole. rows > 0, columns > 0; `units` may be NULL;
 * scales of both axes, -1: none. */
void bead_h5_write_table(struct bead_h5 *h5, hid_t parent, const char *name, const char *units, enum bead_h5_type type, size_t rows,
                         size_t columns, const hid_t scales[2], const void *values);
void bead_h5_read_table(struct bead_h5 *h5, const char *name, enum bead_h5_type type, size_t rows, size_t columns, void *values);

/* Growing datasets of doubles or 64-bit integers, [time][columns] or [time][columns][components]; columns 0: [time]. Each component
 * has its own chunks: those never written are read as 0, and take room on disks without holes in files. */
hid_t bead_h5_make_series(struct bead_h5 *h5, hid_t parent, const char *name, const char *units, bool integer, size_t chunk_rows,
                          size_t columns, size_t components);
/* Write rows first..first+rows-1 of one component; the dataset grows to hold them. `values` is [rows][columns]. */
void bead_h5_write_rows(struct bead_h5 *h5, hid_t series, enum bead_h5_type type, size_t first, size_t rows, size_t columns,
                        size_t component, const void *values);

/* Dimension scales: make a dataset the scale `name`; likewise the dataset at `path`, which is returned open; attach a scale to an
 * axis. */
void bead_h5_make_scale(struct bead_h5 *h5, hid_t dataset, const char *name);
hid_t bead_h5_open_scale(struct bead_h5 *h5, hid_t parent, const char *path, const char *name);
void bead_h5_attach(struct bead_h5 *h5, hid_t dataset, unsigned axis, hid_t scale);
/* A second name for an object. */
void bead_h5_link(struct bead_h5 *h5, hid_t object, hid_t parent, const char *name);

/* Reading files that are not trusted: a missing object, or a wrong type or shape, fails with the name in the message. */
bool bead_h5_has(struct bead_h5 *h5, const char *name); /* path from the root */
hid_t bead_h5_open_group(struct bead_h5 *h5, const char *name);
bool bead_h5_has_attribute(struct bead_h5 *h5, const char *name);                                   /* of the file */
void bead_h5_get_text(struct bead_h5 *h5, hid_t object, const char *name, char *text, size_t size); /* attributes */
double bead_h5_get_double(struct bead_h5 *h5, hid_t object, const char *name);
int64_t bead_h5_get_int(struct bead_h5 *h5, hid_t object, const char *name, int64_t low, int64_t high);
/* Datasets with exactly `count` values; numbers (no bytes) are stored `size` bytes apart. */
void bead_h5_read_numbers(struct bead_h5 *h5, const char *name, enum bead_h5_type type, void *first, size_t size, size_t count);
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
