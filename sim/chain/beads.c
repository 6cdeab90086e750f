/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The system `beads`: a striker and beads that push each other. */
#include "beadreel/law.h"
#include "sim/chain/system.h"

/* No strain: springs have a length, contacts do not. */
static const enum bead_field fields[] = {BEAD_FIELD_FORCE,    BEAD_FIELD_CONTACT_FORCE, BEAD_FIELD_COMPRESSION,
                                         BEAD_FIELD_VELOCITY, BEAD_FIELD_DISPLACEMENT,  BEAD_FIELD_ENERGY,
                                         BEAD_FIELD_COUNT};

static bool field_signed(const struct bead_chain_spec *spec, enum bead_field field)
{
    return field == BEAD_FIELD_VELOCITY || field == BEAD_FIELD_DISPLACEMENT ||
           (field != BEAD_FIELD_ENERGY && !spec->law.row->one_sided); /* forces and compressions of springs that pull */
}

static void describe(const struct bead_chain_spec *, char *text, size_t size)
{
    if (size > 0)
        text[0] = '\0';
}

static size_t count(const struct bead_chain_spec *spec, double)
{
    size_t beads = 1;
    for (size_t s = 0; s < spec->segment_count; s++)
        beads += spec->segments[s].cell_beads * spec->segments[s].count;
    return beads;
}

/* The axis is that of their numbers. */
static void places(const struct bead_chain_spec *, size_t, double *first, double *spacing)
{
    *first = 0;
    *spacing = 1;
}

const struct bead_system bead_system_beads = {
    .name = "beads",
    .help = "beads that push each other where they touch",
    .label = "",
    .points = "beads",
    .axis = "bead",
    .axis_unit = "1",
    .time_unit = "s",
    .has_contacts = true,
    .has_striker = true,
    .has_masses = true,
    .fields = fields,
    .field = bead_field_info,
    .field_signed = field_signed,
    .describe = describe,
    .count = count,
    .places = places,
};
