/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a trajectory is laid out: shared by the writing and the reading half.
 *
 *   /h5md                          H5MD 1.1
 *   /time, /step                   of every sample; the same objects stand again in every element below
 *   /particles/chain               all chains, one after the other along the bead axis
 *     box, species, id, mass, radius, bead, spatial
 *     <element>/{value,time,step}  one for each field asked for, see bead_series
 *   /contacts                      the same for contacts: contact, bead, stiffness, static_force
 *   /parameters/vmd_structure      names and radii for VMD
 *   attributes NX_class, default, signal, axes   NeXus: which element is shown first, and how
 *   /parameters/beadreel           what the file is about: attributes, scene, materials, chains, outcome
 */
#ifndef BEADREEL_SIM_OUTPUT_TRAJECTORY_LAYOUT_H
#define BEADREEL_SIM_OUTPUT_TRAJECTORY_LAYOUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/sink.h"

enum { BEAD_TRAJECTORY_PROFILE = 1 }; /* version of the layout */

/* A series [time][column] or, components 3, [time][column][3] with 0 in the last two. */
enum bead_series_id {
    BEAD_SERIES_DISPLACEMENT,
    BEAD_SERIES_POSITION, /* from displacement: H5MD readers want x, y, z */
    BEAD_SERIES_VELOCITY,
    BEAD_SERIES_BEAD_FORCE,
    BEAD_SERIES_NET_FORCE, /* with the bead force: H5MD's force is mass times acceleration */
    BEAD_SERIES_CONTACT_FORCE,
    BEAD_SERIES_ENERGY,
    BEAD_SERIES_STRAIN,
    BEAD_SERIES_COUNT
};

struct bead_series_info {
    enum bead_field field; /* whose presence in the fields asked for makes this series */
    bool stored;           /* the values of the field itself: what is read back */
    bool of_contacts;
    size_t components;
    const char *group, *units, *title;
};
extern const struct bead_series_info bead_series[BEAD_SERIES_COUNT];

/* Where a chain's beads and contacts stand along the axes. */
struct bead_chain_rows {
    size_t first_row, first_bead, beads; /* beads: stored ones */
    size_t first_contact_row, first_contact, contacts;
};
/* Rows of all chains for `span`; totals of beads and contacts. */
void bead_trajectory_rows(const struct bead_chain *const *chains, size_t count, struct bead_span span, struct bead_chain_rows *rows,
                          size_t *beads, size_t *contacts);

/* Numbers of the outcome, one dataset [chain] each in /parameters/beadreel/outcome. */
struct bead_outcome_column {
    const char *name, *units;
    size_t offset; /* of a double in struct bead_outcome */
};
extern const struct bead_outcome_column bead_outcome_columns[];
extern const size_t bead_outcome_column_count;

#define BEAD_PROFILE_GROUP "/parameters/beadreel"

#endif
