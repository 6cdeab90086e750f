/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The trajectory sink's insides, for its two files: trajectory_write.c (samples) and trajectory_profile.c (all that
 * stands beside them). */
#ifndef BEADREEL_SIM_OUTPUT_TRAJECTORY_SINK_H
#define BEADREEL_SIM_OUTPUT_TRAJECTORY_SINK_H

#include <time.h>

#include "sim/base/h5.h"
#include "sim/output/trajectory_layout.h"

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
    char *xdmf; /* file beside it; NULL: none */
    uint64_t xdmf_bytes;
    char why[128];
    struct bead_h5 h5;
    hid_t time, step, bead_scale, contact_scale, spatial_scale;
    struct bead_series series[BEAD_SERIES_COUNT];
    double *shift;      /* [chunk_rows][beads] m: y of the positions; NULL with one chain */
    double *times;      /* [chunk_rows] s */
    int64_t *steps;     /* [chunk_rows] numbers of the samples */
    size_t chunk_rows;  /* samples a chunk */
    size_t chunk_first; /* number of the sample that the buffers begin with */
    size_t filled;      /* samples complete in the buffers */
    size_t written;     /* of these, in the file */
    size_t next_chain;  /* the next sample comes from */
    struct timespec flushed;
    struct bead_claim *claim; /* where the caller has none */
    bool open, closed, finished;
};

/* Whether the fields asked for make this series. */
bool bead_trajectory_wants(const struct bead_sink *sink, enum bead_series_id id);
/* Everything but the samples, after the file was made: attributes, constant arrays, scales, the empty series.
 * Failures stay in sink->h5. */
void bead_trajectory_lay_out(struct bead_sink *sink);
/* What is known at the end. `outcomes` may be NULL. */
void bead_trajectory_write_outcome(struct bead_sink *sink, const struct bead_outcome *outcomes, bool complete);

#endif
