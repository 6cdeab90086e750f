/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The trajectory sink's insides: trajectory_write.c writes the samples, trajectory_profile.c all else in the file, and
 * trajectory_xdmf.c the XDMF file. */
#pragma once

#include "sim/hdf5/h5.h"
#include "sim/trajectory/trajectory_layout.h"

struct bead_series {
    hid_t value; /* -1: not asked for */
    size_t columns;
    double *buffer; /* [chunk_rows][columns] */
};

struct bead_sink {
    struct bead_run_context context;
    const struct bead_output *output;
    struct bead_grid grid;
    unsigned fields;              /* asked for */
    struct bead_chain_rows *rows; /* [chains] */
    size_t beads, contacts;       /* lengths of the axes */
    char *path, *part;
    char *xdmf; /* name of the XDMF file; NULL: none */
    uint64_t xdmf_bytes;
    char why[256];
    struct bead_h5 h5;
    hid_t time, step, bead_scale, contact_scale, spatial_scale;
    struct bead_series series[BEAD_SERIES_COUNT];
    double *uncertainty;      /* [series][chains], the largest so far, of samples of fields; NULL: not asked for */
    double *shift;            /* [chunk_rows][beads] m: y of the positions; NULL for a single chain */
    double *times;            /* [chunk_rows] s */
    int64_t *steps;           /* [chunk_rows] numbers of the samples */
    size_t chunk_rows;        /* samples in a chunk */
    size_t chunk_first;       /* number of the first sample in the buffers */
    size_t filled;            /* complete samples in the buffers */
    size_t written;           /* of these, in the file */
    size_t next_chain;        /* chain of the next sample */
    double flushed;           /* s, clock: when */
    double flush_after;       /* seconds from then to the next */
    struct bead_claim *claim; /* NULL if the caller has claimed the file */
    bool open, closed, finished;
};

/* Do the fields asked for include this series? */
bool bead_trajectory_wants(const struct bead_sink *sink, enum bead_series_id id);
/* Write all but the samples into the new file: attributes, constant arrays, scales, the empty series. Failures stay in sink->h5.
 */
void bead_trajectory_lay_out(struct bead_sink *sink);
/* Write the outcome. `outcomes` may be NULL. */
void bead_trajectory_write_outcome(struct bead_sink *sink, const struct bead_outcome *outcomes, bool complete);

/* When the trajectory is complete: write the XDMF file beside it, through which ParaView and VTK read the HDF5 file. Errors:
 * MEMORY, IO. */
BEAD_CHECK enum bead_error bead_trajectory_write_xdmf(struct bead_sink *sink, struct bead_message *msg);
