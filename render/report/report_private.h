/* SPDX-License-Identifier: GPL-3.0-or-later */
/* State of the report of a run. */
#pragma once

#include "beadreel/render.h"
#include "render/colour/colour_range.h"
#include "render/report/report_write.h"
#include "render/view/area.h"
#include "render/view/held.h"
#include "render/view/tale.h"
#include "sim/measure/measure.h"

/* The samples of a chain. */
struct report_chain {
    const struct bead_chain *chain;
    bool beads;                     /* its values are of beads, which move */
    struct bead_span bead;          /* shown; empty spans have last < first */
    struct bead_span value;         /* of the field: beads or contacts */
    size_t beads_shown, values;     /* how many */
    float *field;                   /* [samples][values] */
    float *displacement;            /* [samples][beads_shown]; NULL without beads */
    struct bead_held *held;         /* NULL: the samples themselves are kept */
    size_t fed, kept;               /* samples */
    struct bead_measures *measures; /* NULL: too few samples for them */
    struct bead_measures *check;    /* those of the check run */
    bool unknown;                   /* which ended before the run */
    struct bead_area *area;         /* finds the strike that would hide the wave */
};

struct bead_sink {
    const struct bead_output *output;
    struct bead_run_context context;
    char *path;
    struct bead_grid grid; /* of the samples kept */
    size_t stride;         /* of all samples, each stride-th is kept, */
    size_t each;           /* and each each-th is measured: check runs need them all */
    bool measured, held;   /* kept samples are far apart: each has the largest values since the previous one */
    size_t samples, chain_count;
    struct report_chain *chains;
    struct bead_tale *tale;
    bool peaks;                          /* the report needs them */
    struct bead_colormap maps[2];        /* light, dark */
    struct bead_colour_range range;      /* found at the end */
    const struct bead_outcome *outcomes; /* known at the end */
    double magnify;
    uint64_t bytes;
    char why[96];
};

extern const struct report_page report_run_page;
