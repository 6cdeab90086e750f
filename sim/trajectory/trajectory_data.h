/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The insides of an open trajectory, shared by trajectory_open.c and trajectory_read.c. */
#pragma once

#include "beadreel/trajectory.h"
#include "sim/hdf5/h5.h"
#include "sim/trajectory/trajectory_layout.h"

/* A stored series and the samples read ahead. */
struct bead_source {
    hid_t value; /* -1: not stored */
    size_t columns;
    double *block;   /* [block_rows][columns] */
    size_t first;    /* first sample in the block */
    size_t held;     /* samples in the block */
    double *scratch; /* all beads of one chain: 0 where not stored */
};

struct bead_trajectory {
    struct bead_h5 h5;
    char *path;
    struct bead_scene *scene;
    struct bead_chain **chains;
    size_t chain_count;
    struct bead_chain_rows *rows; /* [chains] */
    size_t beads, contacts;       /* lengths of the axes */
    struct bead_span span;
    struct bead_grid grid;
    size_t samples;
    unsigned fields;  /* stored */
    unsigned derived; /* computed from displacements */
    double *forces;   /* derived ones: contact forces, bead forces, compressions, with room for the longest chain each */
    bool complete;
    double end;
    struct bead_source sources[BEAD_SERIES_COUNT];
    size_t block_rows;
    struct bead_outcome *outcomes; /* [chains] */
    double *bounds;                /* [chains][BEAD_FIELD_COUNT]: how far samples may be off, NaN: unknown; NULL: it does not say */
    struct bead_h5_text *methods;  /* [chains] */
};

enum bead_error bead_trajectory_no_memory(struct bead_trajectory *trajectory);
/* Beads of the longest chain, at least 1. */
size_t bead_trajectory_longest(const struct bead_trajectory *trajectory);

/* Opening in two steps, for callers whose overrides depend on the stored scene: first the file and its scene as stored, then the
 * rest, for the scene as `changed` (taken in any case; NULL: as stored), which may have the stored chain number `only` alone
 * (SIZE_MAX: it has all). For a sweep's file, *trajectory is NULL without an error.
 * If either step fails, close the trajectory. Errors: as bead_trajectory_open. */
BEAD_CHECK enum bead_error bead_trajectory_begin(const char *path, const struct bead_own *own, struct bead_trajectory **trajectory,
                                                 struct bead_message *msg);
BEAD_CHECK enum bead_error bead_trajectory_settle(struct bead_trajectory *trajectory, struct bead_scene *changed, size_t only,
                                                  struct bead_message *msg);
/* True if the file looks like HDF5, whatever it is called. */
bool bead_trajectory_is(const char *path);
