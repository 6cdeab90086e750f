/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The layout of a trajectory, shared by the writing and the reading half.
 *
 *   /h5md                          H5MD 1.1
 *   /time, /step                   of every sample; linked into every element below
 *   /particles/chain               all chains, one after the other along the bead axis
 *     box, species, id, mass, radius, bead, spatial
 *     <element>/{value,time,step}  one for each field asked for, see bead_series
 *   /contacts                      likewise for contacts: contact, bead, stiffness, static_force
 *   /parameters/vmd_structure      names and radii for VMD
 *   attributes NX_class, default, signal, axes   NeXus: the element to show first, and its axes
 *   /parameters/beadreel           the run: attributes, scene, materials, chains, outcome
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/sink.h"

enum { BEAD_TRAJECTORY_PROFILE = 1 }; /* version of the layout */

/* A series [time][column] or, components 3, [time][column][3] with 0 in the last two. */
enum bead_series_id {
    BEAD_SERIES_DISPLACEMENT,
    BEAD_SERIES_POSITION, /* from the displacement: H5MD readers want x, y, z */
    BEAD_SERIES_VELOCITY,
    BEAD_SERIES_BEAD_FORCE,
    BEAD_SERIES_NET_FORCE, /* with the bead force: H5MD's force is mass times acceleration */
    BEAD_SERIES_CONTACT_FORCE,
    BEAD_SERIES_COMPRESSION,
    BEAD_SERIES_ENERGY,
    BEAD_SERIES_STRAIN,
    BEAD_SERIES_COUNT
};

struct bead_series_info {
    enum bead_field field; /* the series is written if this is among the fields asked for */
    bool stored;           /* the values of the field itself, which are read back */
    bool of_contacts;
    size_t components;
    const char *group, *units, *title;
};
extern const struct bead_series_info bead_series[BEAD_SERIES_COUNT];
/* The fields of contacts. */
#define BEAD_TRAJECTORY_CONTACTS (BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE) | BEAD_FIELD_BIT(BEAD_FIELD_COMPRESSION))

/* The places of a chain's beads and contacts along the axes. */
struct bead_rows {
    size_t row;          /* the first of the chain's on the axis */
    size_t first, count; /* stored beads or contacts: number of the first within the chain */
};
struct bead_chain_rows {
    struct bead_rows beads, contacts;
};
const struct bead_rows *bead_rows_of(const struct bead_chain_rows *rows, bool contacts);
/* The rows of all chains for `span`, and the totals of beads and contacts. */
void bead_trajectory_rows(const struct bead_chain *const *chains, size_t count, struct bead_span span, struct bead_chain_rows *rows,
                          size_t *beads, size_t *contacts);
/* Samples to write or read at once, at most 8 MiB of a series. */
size_t bead_trajectory_chunk_rows(size_t beads, size_t contacts);

/* The numbers of the outcome: each is a dataset [chain] in /parameters/beadreel/outcome. */
struct bead_outcome_column {
    const char *name, *units;
    size_t offset; /* of a double in struct bead_outcome */
};
extern const struct bead_outcome_column bead_outcome_columns[];
extern const size_t bead_outcome_column_count;

#define BEAD_PROFILE_GROUP "/parameters/beadreel"
