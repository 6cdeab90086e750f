/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads HDF5 files in a separate process, in a sandbox: a file that leads HDF5 astray ends only that process, and an attacker who
 * takes it over with a file has nothing to write to.
 *
 * The functions that read (h5_read.c) ask that process if it exists; there, the same functions read (h5_serve.c). Questions,
 * answers and data are in memory that both share; a byte through a socket passes the turn. */
#pragma once

#include "sim/hdf5/h5.h"

enum bead_h5_what {
    BEAD_H5_HAS,
    BEAD_H5_HAS_ATTRIBUTE,
    BEAD_H5_GROUP,
    BEAD_H5_CLOSE,
    BEAD_H5_GET_TEXT,
    BEAD_H5_GET_DOUBLE,
    BEAD_H5_GET_INT,
    BEAD_H5_NUMBERS,
    BEAD_H5_TEXTS,
    BEAD_H5_TEXT,
    BEAD_H5_SERIES,
    BEAD_H5_ROWS,
    BEAD_H5_TABLE,
    BEAD_H5_OPEN, /* before the first question */
};

/* The function to call, and its parameters. */
struct bead_h5_question {
    enum bead_h5_what what;
    hid_t object;
    enum bead_h5_type type;
    size_t first, rows, columns, components; /* also `size`, `limit` and `count`, as rows */
    int64_t low, high;
};

struct bead_h5_answer {
    int64_t number; /* also an identifier, a truth value, a length */
    double value;
    size_t rows;
};

/* The destination of a read: `count` things of `size` bytes, `stride` bytes apart. */
struct bead_h5_place {
    void *first;
    size_t size, stride, count;
};

/* Answers in the process apart; what is read goes to `bytes`. */
typedef struct bead_h5_answer (*bead_h5_answerer)(struct bead_h5 *h5, const char *name, struct bead_h5_question question,
                                                  void *bytes);

/* Start the process and open the file there; on failure h5->error is set. */
void bead_h5_apart_open(struct bead_h5 *h5, bead_h5_answerer answer);
void bead_h5_apart_close(struct bead_h5 *h5);
/* Ask; on failure h5->error is set and the answer is 0. `name` and `place` may be NULL. */
struct bead_h5_answer bead_h5_ask(struct bead_h5 *h5, const char *name, struct bead_h5_question question,
                                  const struct bead_h5_place *place);
/* Bytes that one answer can have. */
size_t bead_h5_apart_room(const struct bead_h5 *h5);
/* The bytes of the last answer. */
const char *bead_h5_apart_bytes(const struct bead_h5 *h5);
