/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes the decay of waves along the chains of a sweep from its profiles. */
#include <stdlib.h>

#include "sim/base/elementary.h"
#include "sim/base/memory.h"
#include "sim/base/wide.h"
#include "sim/statistics/statistics.h"
#include "sim/sweep/sweep_data.h"
#include "sim/sweep/sweep_internal.h"

/* The wave is still forming up to this bead. */
enum { NEAR = 10, RESAMPLES = 200 };

/* A panel with all its magnetisms. */
struct decay_panel {
    const struct bead_sweep *sweep;
    const struct bead_sweep_panel *shown;
    struct bead_sweep_configuration clean;
    size_t index, random, cell; /* random: beads up to the last random one; cell: beads of a random cell */
    double *logs;               /* [2][configurations][random] */
    double *changes,
        *values; /* [configurations][beads]: differences of the logarithms from those of finer runs; [configurations] */
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

static const double *profile_of(const struct decay_panel *p, size_t row, size_t which)
{
    return p->sweep->panels[p->index].profiles + (PROFILES * row + which) * p->shown->beads;
}

/* Lists the differences of a profile's logarithms from those of finer runs; returns the number of chains that have them. */
static size_t find_changes(const struct decay_panel *p, const struct sweep_entry *entries, size_t count, enum sweep_profile which)
{
    const size_t beads = p->shown->beads;
    size_t used = 0;
    for (size_t i = 0; i < count; i++) {
        const double *run = profile_of(p, entries[i].index + 1, which);
        const double *finer = profile_of(p, entries[i].index + 1, PROFILES_OF_RUN + which);
        if (!(finer[0] > 0))
            continue;
        for (size_t j = 0; j < beads; j++)
            p->changes[used * beads + j] = bead_log(run[j] / finer[j]);
        used++;
    }
    return used;
}

/* Fits are linear in the logarithms, so fits of the differences are the differences of fits. */
static void bound_fits(const struct decay_panel *p, size_t used, const struct bead_decay *of, size_t count,
                       struct bead_decay_uncertainty *u)
{
    const size_t beads = p->shown->beads;
    struct bead_decay change;
    for (size_t i = 0; i < used; i++) {
        bead_decay_fit(p->changes + i * beads, p->random, of->first, of->last, &change);
        p->values[i] = change.rate;
    }
    u->length = bead_sweep_bound(p->values, used, count) * of->length * of->length;
    for (size_t i = 0; i < used; i++) {
        bead_decay_fit(p->changes + i * beads, p->random, of->first, of->last, &change);
        p->values[i] = change.exponent;
    }
    u->exponent = bead_sweep_bound(p->values, used, count);
}

/* Finds the uncertainty of the decay of forces or energies: of `means` that of the worst bead, relative to them, since errors cross
 * zero along a chain; and that of their fits. */
static enum bead_error find_uncertainty(const struct decay_panel *p, const struct sweep_entry *entries, size_t count, bool energy,
                                        const double *means, const struct bead_decay *of, struct bead_decay_uncertainty *u,
                                        struct bead_message *msg)
{
    const size_t beads = p->shown->beads;
    const enum sweep_profile peaks = energy ? PROFILE_ENERGY : PROFILE_FORCE,
                             last = energy ? PROFILE_LAST_ENERGY : PROFILE_LAST_FORCE;
    BEAD_TRY(bead_new(&u->peaks, beads, msg, "the decay of a sweep"));
    size_t used = find_changes(p, entries, count, peaks);
    double worst = 0;
    for (size_t j = 0; j < beads && !isnan(worst); j++) {
        for (size_t i = 0; i < used; i++)
            p->values[i] = p->changes[i * beads + j];
        const double part = bead_sweep_bound(p->values, used, count);
        worst = isnan(part) ? NAN : fmax(worst, part);
    }
    for (size_t j = 0; j < beads; j++)
        u->peaks[j] = worst * means[j];
    const double *clean = profile_of(p, 0, peaks), *finer = profile_of(p, 0, PROFILES_OF_RUN + peaks);
    for (size_t i = 0; i < used; i++) {
        for (size_t j = 0; j < beads; j++)
            p->changes[i * beads + j] -= bead_log(clean[j] / finer[j]);
    }
    bound_fits(p, used, of, count, u);
    for (size_t i = used = 0; i < count; i++) {
        const size_t row = entries[i].index + 1;
        if (profile_of(p, row, PROFILES_OF_RUN + peaks)[0] > 0)
            p->values[used++] = bead_participation(profile_of(p, row, last), beads) -
                                bead_participation(profile_of(p, row, PROFILES_OF_RUN + last), beads);
    }
    u->participation = bead_sweep_bound(p->values, used, count);
    return BEAD_OK;
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
    BEAD_TRY(fit(p, entries, d, msg));
    BEAD_TRY(find_uncertainty(p, entries, d->count, false, d->force, &d->of_force, &d->uncertain[0], msg));
    return find_uncertainty(p, entries, d->count, true, d->energy, &d->of_energy, &d->uncertain[1], msg);
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
    BEAD_FREED struct sweep_entry *entries = NULL;
    BEAD_FREED double *memory = NULL;
    BEAD_TRY(bead_sweep_entries(sweep, panel, &entries, &all, msg));
    BEAD_TRY(bead_new(&memory, (all + 1) * (2 * p.random + p.shown->beads + 1), msg, "the decay of a sweep"));
    p.logs = memory;
    p.changes = p.logs + (all + 1) * 2 * p.random;
    p.values = p.changes + (all + 1) * p.shown->beads;
    enum bead_error err = bead_new(decays, all, msg, "the decay of a sweep");
    for (size_t first = 0; first < all && !err;) {
        struct bead_sweep_decay *d = &(*decays)[(*count)++];
        *d = (struct bead_sweep_decay){.magnetism = entries[first].magnetism, .count = bead_sweep_alike(entries, all, first)};
        err = find_decay(&p, entries + first, d, msg);
        first += d->count;
    }
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
        for (size_t k = 0; k < 2; k++)
            free(decays[i].uncertain[k].peaks);
    }
    free(decays);
}
