/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opens a file in a separate process, and answers requests there: see h5_apart.h. */
#include "sim/hdf5/h5_apart.h"
#include "sim/hdf5/h5_private.h"

#include <errno.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sim/base/file.h"

/* The separate process does the reading: numbers are put 8 bytes apart, texts as they are. */
static struct bead_h5_answer answer(struct bead_h5 *h5, const char *name, struct bead_h5_question q, void *bytes)
{
    struct bead_h5_answer a = {0};
    hid_t object = q.object < 0 ? h5->file : q.object;
    switch (q.what) {
    case BEAD_H5_HAS:
        a.number = bead_h5_has(h5, name);
        break;
    case BEAD_H5_HAS_ATTRIBUTE:
        a.number = bead_h5_has_attribute(h5, name);
        break;
    case BEAD_H5_GROUP:
        a.number = bead_h5_open_group(h5, name);
        break;
    case BEAD_H5_CLOSE:
        bead_h5_close(h5, &object);
        break;
    case BEAD_H5_GET_TEXT:
        bead_h5_get_text(h5, object, name, bytes, q.rows);
        break;
    case BEAD_H5_GET_DOUBLE:
        a.value = bead_h5_get_double(h5, object, name);
        break;
    case BEAD_H5_GET_INT:
        a.number = bead_h5_get_int(h5, object, name, q.low, q.high);
        break;
    case BEAD_H5_NUMBERS:
        bead_h5_read_numbers(h5, name, q.type, bytes, sizeof(double), q.rows);
        break;
    case BEAD_H5_TEXTS:
        bead_h5_read_texts(h5, name, bytes, q.rows);
        break;
    case BEAD_H5_TEXT: {
        char *text = bead_h5_read_text(h5, name, q.rows);
        a.number = text ? (int64_t)strlen(text) : 0;
        if (text)
            memcpy(bytes, text, (size_t)a.number);
        free(text);
        break;
    }
    case BEAD_H5_SERIES:
        a.number = bead_h5_open_series(h5, name, q.columns, q.components, &a.rows);
        break;
    case BEAD_H5_ROWS:
        bead_h5_read_rows(h5, object, q.first, q.rows, q.columns, bytes);
        break;
    case BEAD_H5_TABLE:
        bead_h5_read_table(h5, name, q.type, q.rows, q.columns, bytes);
        break;
    case BEAD_H5_OPEN:
        bead_h5_open_here(h5);
        break;
    }
    return a;
}

static void open_somewhere(struct bead_h5 *h5, uint64_t bytes)
{
    h5->bytes = bytes;
    if (bead_h5_stays_in_process())
        bead_h5_open_here(h5);
    else
        bead_h5_apart_open(h5, answer);
}

void bead_h5_open(struct bead_h5 *h5, const char *path, const char *kind, struct bead_message *msg)
{
    struct stat found;
    *h5 = (struct bead_h5){
        .file = -1, .path = path, .kind = kind, .code = BEAD_ERROR_FORMAT, .msg = msg, .check = {.file = -1, .driver = -1}};
    h5->check.file = bead_h5_look(path);
    if (h5->check.file < 0 || fstat(h5->check.file, &found) != 0) {
        const int error = errno; /* directories and pipes exist, but have no format */
        h5->code = error == EISDIR || error == ENXIO ? BEAD_ERROR_FORMAT : BEAD_ERROR_IO;
        bead_h5_fail_by(h5, "read", error);
        h5->code = BEAD_ERROR_FORMAT;
    } else if (!bead_h5_is_open(h5->check.file))
        bead_h5_fail(h5, false, "not an HDF5 file");
    else if (bead_h5_load_for(h5))
        open_somewhere(h5, (uint64_t)found.st_size);
    if (h5->file < 0)
        bead_h5_check_leave(&h5->check);
}
