/* From the results of a sweep to statistics. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/sweep_data.h"

enum { RESAMPLES = 1000 };
/* Two magnetisms closer than this are the same: those of chains are ratios of whole numbers. */
static const double same = 1e-9;

static enum bead_error out_of_memory(struct bead_message *msg)
{
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the statistics of a sweep");
}

struct entry {
    double magnetism, value;
    size_t index;
};

static int by_magnetism(const void *a, const void *b)
{
    const struct entry *p = a, *q = b;
    if (fabs(p->magnetism - q->magnetism) > same)
        return p->magnetism < q->magnetism ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

/* Configurations known, by magnetism; *count of them. NULL: out of memory. */
static struct entry *list_entries(const struct bead_sweep *sweep, size_t panel, size_t *count)
{
    size_t all = sweep->panels[panel].shown.configurations;
    struct entry *entries = calloc(all + 1, sizeof *entries);
    *count = 0;
    for (size_t i = 0; entries && i < all; i++) {
        struct bead_sweep_configuration c;
        if (bead_sweep_configuration(sweep, panel, i, &c))
            entries[(*count)++] = (struct entry){c.magnetism, NAN, i};
    }
    if (entries)
        qsort(entries, *count, sizeof *entries, by_magnetism);
    return entries;
}

/* Number of entries from `first` on that are of one magnetism. */
static size_t alike(const struct entry *entries, size_t count, size_t first)
{
    size_t last = first + 1;
    while (last < count && fabs(entries[last].magnetism - entries[first].magnetism) <= same)
        last++;
    return last - first;
}

static enum bead_error fill_rows(struct bead_sweep_statistics *s, const struct entry *entries, size_t count,
                                 struct bead_message *msg)
{
    double *sorted = calloc(count + 1, sizeof *sorted);
    s->rows = calloc(count + 1, sizeof *s->rows);
    if (!sorted || !s->rows) {
        free(sorted);
        return out_of_memory(msg);
    }
    for (size_t first = 0; first < count;) {
        struct bead_sweep_row *row = &s->rows[s->row_count++];
        *row =
            (struct bead_sweep_row){.magnetism = entries[first].magnetism, .first = first, .count = alike(entries, count, first)};
        memcpy(sorted, s->values + first, row->count * sizeof *sorted);
        bead_summary_of(sorted, row->count, &row->summary);
        first += row->count;
    }
    free(sorted);
    return BEAD_OK;
}

/* A sweep need not have both regimes. */
static enum bead_error find_threshold(struct bead_sweep_statistics *s, const char *name, uint64_t seed, struct bead_message *msg)
{
    const struct bead_threshold_info *how = bead_threshold_info_named(name);
    struct bead_group_results *groups = calloc(s->row_count + 1, sizeof *groups);
    struct bead_message why;
    if (!how || !groups) {
        free(groups);
        return how ? out_of_memory(msg) : bead_fail(msg, BEAD_ERROR_USAGE, "there is no threshold `%s`", name);
    }
    for (size_t i = 0; i < s->row_count; i++)
        groups[i] = (struct bead_group_results){s->rows[i].magnetism, s->values + s->rows[i].first, s->rows[i].count};
    enum bead_error err = bead_threshold_fit(groups, s->row_count, how, RESAMPLES, seed, &s->threshold, &why);
    s->has_threshold = !err;
    free(groups);
    return err == BEAD_ERROR_NUMBERS ? BEAD_OK : err ? bead_fail(msg, err, "%s", why.text) : BEAD_OK;
}

enum bead_error bead_sweep_statistics(const struct bead_sweep *sweep, size_t panel, size_t place, const char *threshold,
                                      struct bead_sweep_statistics *s, struct bead_message *msg)
{
    struct bead_sweep_configuration clean, c;
    *s = (struct bead_sweep_statistics){.clean = NAN};
    if (place >= sweep->panels[panel].shown.places || !bead_sweep_configuration(sweep, panel, BEAD_SWEEP_CLEAN, &clean))
        return bead_fail(msg, BEAD_ERROR_NUMBERS, "the chain with all cells up, by which forces are normalised, is not known here");
    s->clean = clean.peaks[place].force;
    if (!(s->clean > 0))
        return bead_fail(msg, BEAD_ERROR_NUMBERS,
                         "the chain with all cells up has no force at `%s` that others could be normalised by",
                         bead_sweep_place(sweep, panel, place));
    size_t count = 0;
    struct entry *entries = list_entries(sweep, panel, &count);
    s->values = calloc(count + 1, sizeof *s->values);
    s->indices = calloc(count + 1, sizeof *s->indices);
    enum bead_error err = entries && s->values && s->indices ? BEAD_OK : out_of_memory(msg);
    for (size_t i = 0; i < count && !err; i++) {
        bead_sweep_configuration(sweep, panel, entries[i].index, &c);
        s->values[i] = c.peaks[place].force / s->clean;
        s->indices[i] = entries[i].index;
    }
    if (!err)
        err = fill_rows(s, entries, count, msg);
    if (!err)
        err = find_threshold(s, threshold, sweep->panels[panel].shown.spec->seed, msg);
    free(entries);
    if (err)
        bead_sweep_statistics_free(s);
    return err;
}

void bead_sweep_statistics_free(struct bead_sweep_statistics *s)
{
    free(s->rows);
    free(s->values);
    free(s->indices);
    *s = (struct bead_sweep_statistics){.clean = NAN};
}

/* ---- decay along the chain ---- */

/* Near the striker the wave has not formed yet; beyond some hundred beads disorder that delocalises it lets it decay as a power. */
enum { NEAR = 10, FAR = 100 };

/* Beads of a random cell. */
static size_t cell_beads(const struct bead_sweep *sweep, size_t panel)
{
    const struct bead_chain_spec *pattern = &sweep->scene->chains[sweep->panels[panel].shown.spec->chain];
    size_t beads = 1;
    for (size_t i = 0; i < pattern->segment_count; i++)
        beads = pattern->segments[i].spins == BEAD_SPINS_RANDOM ? pattern->segments[i].cell_beads : beads;
    return beads;
}

void bead_sweep_smooth(const struct bead_sweep *sweep, size_t panel, const double *values, double *means, size_t *count)
{
    const size_t cell = cell_beads(sweep, panel), random = sweep->panels[panel].shown.spec->last + 1;
    *count = random > cell ? random + 1 - cell : 0;
    for (size_t i = 0; i < *count; i++) {
        double sum = 0;
        for (size_t k = 0; k < cell; k++)
            sum += log(values[i + k]) / (double)cell;
        means[i] = exp(sum);
    }
}

static enum bead_error fit_decay(const struct bead_sweep *sweep, size_t panel, const double *values, struct bead_decay *decay,
                                 struct bead_message *msg)
{
    size_t count, last = NEAR;
    double *means = calloc(sweep->panels[panel].shown.beads, sizeof *means);
    if (!means)
        return out_of_memory(msg);
    bead_sweep_smooth(sweep, panel, values, means, &count);
    while (last + 1 < count && means[last + 1] > means[NEAR] / exp(1))
        last++;
    bead_decay_fit(means, count, NEAR, last, FAR, decay);
    free(means);
    return BEAD_OK;
}

/* Geometric means; the fits leave the fixed cells and the end out. */
static enum bead_error find_decay(const struct bead_sweep *sweep, size_t panel, const struct entry *entries, size_t count,
                                  struct bead_sweep_decay *d, struct bead_message *msg)
{
    const struct bead_sweep_panel *shown = &sweep->panels[panel].shown;
    const size_t beads = shown->beads, random = shown->spec->last + 1;
    d->force = calloc(beads, sizeof *d->force);
    d->energy = calloc(beads, sizeof *d->energy);
    if (!d->force || !d->energy)
        return out_of_memory(msg);
    for (size_t i = 0; i < count; i++) {
        struct bead_sweep_configuration c;
        bead_sweep_configuration(sweep, panel, entries[i].index, &c);
        for (size_t j = 0; j < beads; j++) {
            d->force[j] += log(c.bead_force[j]) / (double)count;
            d->energy[j] += log(c.bead_energy[j]) / (double)count;
        }
        d->participation += bead_participation(c.bead_force + random, beads - random) / (double)count;
    }
    for (size_t j = 0; j < beads; j++) {
        d->force[j] = exp(d->force[j]);
        d->energy[j] = exp(d->energy[j]);
    }
    enum bead_error err = fit_decay(sweep, panel, d->force, &d->of_force, msg);
    return err ? err : fit_decay(sweep, panel, d->energy, &d->of_energy, msg);
}

enum bead_error bead_sweep_decays(const struct bead_sweep *sweep, size_t panel, struct bead_sweep_decay **decays, size_t *count,
                                  struct bead_message *msg)
{
    size_t all = 0;
    *count = 0;
    *decays = NULL;
    if (!sweep->panels[panel].profiles)
        return bead_fail(msg, BEAD_ERROR_NUMBERS, "decay was not measured");
    struct entry *entries = list_entries(sweep, panel, &all);
    *decays = calloc(all + 1, sizeof **decays);
    enum bead_error err = entries && *decays ? BEAD_OK : out_of_memory(msg);
    for (size_t first = 0; first < all && !err;) {
        struct bead_sweep_decay *d = &(*decays)[(*count)++];
        *d = (struct bead_sweep_decay){.magnetism = entries[first].magnetism, .count = alike(entries, all, first)};
        err = find_decay(sweep, panel, entries + first, d->count, d, msg);
        first += d->count;
    }
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
