/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes the decay of waves along the chains of a sweep from its profiles. */
#include <stdlib.h>

#include "sim/base/elementary.h"
#include "sim/base/memory.h"
#include "sim/base/wide.h"
#include "sim/statistics/statistics.h"
#include "sim/sweep/sweep_data.h"
#include "sim/sweep/sweep_internal.h"

/* Up to this bead the wave is still forming. */
enum { NEAR = 10, RESAMPLES = 200 };

/* A panel, for all its magnetisms. */
struct decay_panel {
    const struct bead_sweep *sweep;
    const struct bead_sweep_panel *shown;
    struct bead_sweep_configuration clean;
    size_t index, random, cell; /* random: beads up to the last random one; cell: beads of a random cell */
    double *logs;               /* [2][configurations][random] */
};

static size_t random_cell(const struct bead_sweep *sweep, const struct bead_sweep_panel *shown)
{
    const struct bead_chain_spec *pattern = &bead_sweep_scene(sweep)->chains[shown->spec->chain];
    size_t cell = 1;
    for (size_t i = 0; i < pattern->segment_count; i++)
        cell = pattern->segments[i].spins == BEAD_SPINS_RANDOM ? pattern->segments[i].cell_beads : cell;
    return cell;
}

void bead_sweep_smooth(const struct bead_sweep *sweep, size_t panel, const double *values, double *means, size_t *count)
{
    const struct bead_sweep_panel *shown = &sweep->panels[panel].shown;
    const size_t cell = random_cell(sweep, shown), random = shown->spec->last + 1;
    *count = random > cell ? random + 1 - cell : 0;
    for (size_t i = 0; i < *count; i++) {
        double sum = 0;
        for (size_t k = 0; k < cell; k++)
            sum += bead_log(values[i + k]) / (double)cell;
        means[i] = bead_exp(sum);
    }
}

/* Fits profiles relative to the clean chain at each bead, which removes the differences between the beads of a cell. */
static enum bead_error fit(const struct decay_panel *p, const struct sweep_entry *entries, struct bead_sweep_decay *d,
                           struct bead_message *msg)
{
    double *force = p->logs, *energy = p->logs + d->count * p->random;
    for (size_t i = 0; i < d->count; i++) {
        struct bead_sweep_configuration c;
        bead_sweep_configuration(p->sweep, p->index, entries[i].index, &c);
        for (size_t j = 0; j < p->random; j++) {
            force[i * p->random + j] = bead_log(c.bead_force[j] / p->clean.bead_force[j]);
            energy[i * p->random + j] = bead_log(c.bead_energy[j] / p->clean.bead_energy[j]);
        }
    }
    const struct bead_decay_profiles profiles = {force, energy, d->count, p->random, NEAR, p->cell};
    return bead_decay_of(&profiles, RESAMPLES, p->shown->spec->seed, &d->of_force, &d->of_energy, msg);
}

static enum bead_error find_decay(const struct decay_panel *p, const struct sweep_entry *entries, struct bead_sweep_decay *d,
                                  struct bead_message *msg)
{
    const size_t beads = p->shown->beads;
    BEAD_TRY(bead_new(&d->force, beads, msg, "the decay of a sweep"));
    BEAD_TRY(bead_new(&d->energy, beads, msg, "the decay of a sweep"));
    for (size_t i = 0; i < d->count; i++) {
        struct bead_sweep_configuration c;
        bead_sweep_configuration(p->sweep, p->index, entries[i].index, &c);
        for (size_t j = 0; j < beads; j++) {
            d->force[j] += bead_log(c.bead_force[j]) / (double)d->count;
            d->energy[j] += bead_log(c.bead_energy[j]) / (double)d->count;
        }
        d->force_participation += bead_participation(c.last_force, beads) / (double)d->count;
        d->energy_participation += bead_participation(c.last_energy, beads) / (double)d->count;
    }
    for (size_t j = 0; j < beads; j++) {
        d->force[j] = bead_exp(d->force[j]);
        d->energy[j] = bead_exp(d->energy[j]);
    }
    return fit(p, entries, d, msg);
}

enum bead_error bead_sweep_decays(const struct bead_sweep *sweep, size_t panel, struct bead_sweep_decay **decays, size_t *count,
                                  struct bead_message *msg)
{
    struct decay_panel p = {.sweep = sweep, .shown = &sweep->panels[panel].shown, .index = panel};
    size_t all = 0;
    *count = 0;
    *decays = NULL;
    if (!sweep->panels[panel].profiles)
        return bead_fail(msg, BEAD_ERROR_NUMBERS, "decay was not measured");
    if (!bead_sweep_configuration(sweep, panel, BEAD_SWEEP_CLEAN, &p.clean))
        return bead_fail(msg, BEAD_ERROR_NUMBERS, "the chain with all cells up, by which forces are normalised, is not known here");
    p.random = p.shown->spec->last + 1;
    p.cell = random_cell(sweep, p.shown);
    struct sweep_entry *entries = bead_sweep_entries(sweep, panel, &all);
    *decays = calloc(all + 1, sizeof **decays);
    p.logs = calloc(all + 1, 2 * p.random * sizeof *p.logs);
    enum bead_error err =
        entries && *decays && p.logs ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the decay of a sweep");
    for (size_t first = 0; first < all && !err;) {
        struct bead_sweep_decay *d = &(*decays)[(*count)++];
        *d = (struct bead_sweep_decay){.magnetism = entries[first].magnetism, .count = bead_sweep_alike(entries, all, first)};
        err = find_decay(&p, entries + first, d, msg);
        first += d->count;
    }
    free(p.logs);
    free(entries);
    if (err) {
        bead_sweep_decays_free(*decays, *count);
        *decays = NULL;
    }
    return err;
}

void bead_sweep_decays_free(struct bead_sweep_decay *decays, size_t count)
{
    for (size_t i = 0; decays && i < count; i++) {
        free(decays[i].force);
        free(decays[i].energy);
    }
    free(decays);
}
