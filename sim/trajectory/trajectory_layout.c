/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of series in a trajectory and of the numbers of its outcome; both the writer and the reader follow it. */
#include "sim/trajectory/trajectory_layout.h"

#include "sim/measure/sink_grid.h"

const struct bead_series_info bead_series[BEAD_SERIES_COUNT] = {
    [BEAD_SERIES_DISPLACEMENT] = {BEAD_FIELD_DISPLACEMENT, true, false, 1, "/particles/chain/displacement", "m",
                                  "displacement from the rest position"},
    [BEAD_SERIES_POSITION] = {BEAD_FIELD_DISPLACEMENT, false, false, 3, "/particles/chain/position", "m", "position of the centre"},
    [BEAD_SERIES_VELOCITY] = {BEAD_FIELD_VELOCITY, true, false, 3, "/particles/chain/velocity", "m s-1", "velocity"},
    [BEAD_SERIES_BEAD_FORCE] = {BEAD_FIELD_FORCE, true, false, 1, "/particles/chain/bead_force", "N",
                                "mean of the forces in the two contacts of the bead"},
    [BEAD_SERIES_NET_FORCE] = {BEAD_FIELD_FORCE, false, false, 3, "/particles/chain/force", "N",
                               "net force: mass times acceleration"},
    [BEAD_SERIES_CONTACT_FORCE] = {BEAD_FIELD_CONTACT_FORCE, true, true, 1, "/contacts/contact_force", "N",
                                   "force in the contact of a bead with its right neighbour"},
    [BEAD_SERIES_COMPRESSION] = {BEAD_FIELD_COMPRESSION, true, true, 1, "/contacts/compression", "m",
                                 "how far a bead and its right neighbour overlap"},
    [BEAD_SERIES_ENERGY] = {BEAD_FIELD_ENERGY, true, false, 1, "/particles/chain/energy", "J",
                            "kinetic energy, half the energy of both contacts, and all of the wall's"},
    [BEAD_SERIES_STRAIN] = {BEAD_FIELD_STRAIN, true, false, 1, "/particles/chain/strain", "1", "strain"},
};

void bead_trajectory_rows(const struct bead_chain *const *chains, size_t count, struct bead_span span, struct bead_chain_rows *rows,
                          size_t *beads, size_t *contacts)
{
    *beads = *contacts = 0;
    for (size_t c = 0; c < count; c++) {
        rows[c].beads = (struct bead_rows){*beads, span.first, bead_span_rows(&span, bead_chain_beads(chains[c]))};
        rows[c].contacts = (struct bead_rows){*contacts, span.first, bead_span_rows(&span, bead_chain_contacts(chains[c]))};
        *beads += rows[c].beads.count;
        *contacts += rows[c].contacts.count;
    }
}

const struct bead_rows *bead_rows_of(const struct bead_chain_rows *rows, bool contacts)
{
    return contacts ? &rows->contacts : &rows->beads;
}

size_t bead_trajectory_chunk_rows(size_t beads, size_t contacts)
{
    const size_t most_rows = 256, most_bytes = 8 << 20;
    const size_t rows = most_bytes / (sizeof(double) * (beads > contacts ? beads : contacts));
    return rows > most_rows ? most_rows : rows < 1 ? 1 : rows;
}

const struct bead_outcome_column bead_outcome_columns[] = {
    {"end", "s", offsetof(struct bead_outcome, end)},
    {"front_arrival", "s", offsetof(struct bead_outcome, front_arrival)},
    {"step", "s", offsetof(struct bead_outcome, step)},
    {"energy_start", "J", offsetof(struct bead_outcome, energy_start)},
    {"energy_end", "J", offsetof(struct bead_outcome, energy_end)},
    {"momentum_start", "kg m s-1", offsetof(struct bead_outcome, momentum_start)},
    {"momentum_end", "kg m s-1", offsetof(struct bead_outcome, momentum_end)},
    {"energy_error", "1", offsetof(struct bead_outcome, energy_error)},
    {"embedded_error", "1", offsetof(struct bead_outcome, embedded_error)},
    {"event_error", "1", offsetof(struct bead_outcome, event_error)},
    {"worst_contact", "1", offsetof(struct bead_outcome, worst_contact)},
    {"worst_bead", "1", offsetof(struct bead_outcome, worst_bead)},
    {"worst_force", "N", offsetof(struct bead_outcome, worst_force)},
    {"worst_uncertainty", "N", offsetof(struct bead_outcome, worst_uncertainty)},
};
const size_t bead_outcome_column_count = sizeof bead_outcome_columns / sizeof *bead_outcome_columns;
