/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes the statistics of a sweep from its results: groups of one magnetism, thresholds, plateaus. */
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/run/uncertainty.h"
#include "sim/statistics/statistics.h"
#include "sim/sweep/sweep_data.h"
#include "sim/sweep/sweep_internal.h"

enum { RESAMPLES = 1000 };
/* Magnetisms closer than this are equal: they are ratios of whole numbers. */
static const double same = 1e-9;

static int by_magnetism(const void *a, const void *b)
{
    const struct sweep_entry *p = a, *q = b;
    if (fabs(p->magnetism - q->magnetism) > same)
        return p->magnetism < q->magnetism ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

enum bead_error bead_sweep_entries(const struct bead_sweep *sweep, size_t panel, struct sweep_entry **entries, size_t *count,
                                   struct bead_message *msg)
{
    const size_t all = sweep->panels[panel].shown.configurations;
    *count = 0;
    BEAD_TRY(bead_new(entries, all, msg, "the statistics of a sweep"));
    for (size_t i = 0; i < all; i++) {
        struct bead_sweep_configuration c;
        if (bead_sweep_configuration(sweep, panel, i, &c))
            (*entries)[(*count)++] = (struct sweep_entry){c.magnetism, i};
    }
    qsort(*entries, *count, sizeof **entries, by_magnetism);
    return BEAD_OK;
}

size_t bead_sweep_alike(const struct sweep_entry *entries, size_t count, size_t first)
{
    size_t last = first + 1;
    while (last < count && fabs(entries[last].magnetism - entries[first].magnetism) <= same)
        last++;
    return last - first;
}

static enum bead_error fill_rows(struct bead_sweep_statistics *s, const struct sweep_entry *entries, size_t count,
                                 struct bead_message *msg)
{
    BEAD_FREED double *sorted = NULL;
    BEAD_TRY(bead_new(&sorted, count, msg, "the statistics of a sweep"));
    BEAD_TRY(bead_new(&s->rows, count, msg, "the statistics of a sweep"));
    for (size_t first = 0; first < count;) {
        struct bead_sweep_row *row = &s->rows[s->row_count++];
        *row = (struct bead_sweep_row){
            .magnetism = entries[first].magnetism, .first = first, .count = bead_sweep_alike(entries, count, first)};
        memcpy(sorted, s->values + first, row->count * sizeof *sorted);
        bead_summary_of(sorted, row->count, &row->summary);
        first += row->count;
    }
    return BEAD_OK;
}

/* The way to find a threshold; NULL: the first. */
static const char *name_of(const char *threshold)
{
    return threshold ? threshold : bead_threshold_info(0)->name;
}

/* The results of each magnetism; to be freed with free(). Errors: MEMORY. */
static enum bead_error groups_of(const struct bead_sweep_statistics *s, struct bead_group_results **groups,
                                 struct bead_message *msg)
{
    BEAD_TRY(bead_new(groups, s->row_count, msg, "the statistics of a sweep"));
    for (size_t i = 0; i < s->row_count; i++)
        (*groups)[i] = (struct bead_group_results){s->rows[i].magnetism, s->values + s->rows[i].first, s->rows[i].count};
    return BEAD_OK;
}

/* Fits the threshold, if the sweep has both regimes. */
static enum bead_error find_threshold(struct bead_sweep_statistics *s, const char *name, uint64_t seed, struct bead_message *msg)
{
    const struct bead_threshold_info *how = bead_threshold_info_named(name);
    BEAD_FREED struct bead_group_results *groups = NULL;
    struct bead_message why;
    if (!how)
        return bead_fail(msg, BEAD_ERROR_USAGE, "there is no threshold `%s`", name);
    BEAD_TRY(groups_of(s, &groups, msg));
    enum bead_error err = bead_threshold_fit(groups, s->row_count, how, RESAMPLES, seed, &s->threshold, &why);
    s->has_threshold = !err;
    return err == BEAD_ERROR_NUMBERS ? BEAD_OK : err ? bead_fail(msg, err, "%s", why.text) : BEAD_OK;
}

/* The largest relative uncertainty of all configurations; fmax ignores those not measured. */
static double worst_part(const struct bead_sweep *sweep, size_t panel, size_t place,
                         double (*part_of)(const struct bead_sweep_peak *peak))
{
    double worst = NAN;
    for (size_t i = 0; i < bead_sweep_panel(sweep, panel)->configurations; i++) {
        struct bead_sweep_configuration c;
        if (bead_sweep_configuration(sweep, panel, i, &c))
            worst = fmax(worst, part_of(&c.peaks[place]));
    }
    return worst;
}

static double part_of_force(const struct bead_sweep_peak *peak)
{
    return peak->uncertainty > 0 ? peak->uncertainty / peak->force : NAN;
}

static double part_of_time(const struct bead_sweep_peak *peak)
{
    return peak->time_uncertainty > 0 ? peak->time_uncertainty / peak->time : NAN;
}

double bead_sweep_uncertainty(const struct bead_sweep *sweep, size_t panel, size_t place)
{
    return worst_part(sweep, panel, place, part_of_force);
}

double bead_sweep_clean_uncertainty(const struct bead_sweep *sweep, size_t panel, size_t place)
{
    struct bead_sweep_configuration clean;
    const double own = bead_sweep_configuration(sweep, panel, BEAD_SWEEP_CLEAN, &clean) ? part_of_force(&clean.peaks[place]) : NAN;
    return isnan(own) ? bead_sweep_uncertainty(sweep, panel, place) : own;
}

double bead_sweep_bound(double *differences, size_t known, size_t all)
{
    struct bead_summary sample;
    bead_summary_of(differences, known, &sample);
    return bead_uncertainty_measured(0, sample.mean, 0) + bead_sample_error(&sample, all);
}

enum bead_error bead_sweep_threshold_uncertainty(const struct bead_sweep_statistics *s, const char *threshold, double part,
                                                 double common, double *uncertainty, struct bead_message *msg)
{
    BEAD_FREED struct bead_group_results *groups = NULL;
    *uncertainty = NAN;
    if (!s->has_threshold)
        return BEAD_OK;
    BEAD_TRY(groups_of(s, &groups, msg));
    return bead_threshold_uncertainty(groups, s->row_count, bead_threshold_info_named(name_of(threshold)), part, common,
                                      uncertainty, msg);
}

double bead_sweep_time_uncertainty(const struct bead_sweep *sweep, size_t panel, size_t place)
{
    return worst_part(sweep, panel, place, part_of_time);
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
    BEAD_FREED struct sweep_entry *entries = NULL;
    BEAD_TRY(bead_sweep_entries(sweep, panel, &entries, &count, msg));
    enum bead_error err = bead_new(&s->values, count, msg, "the statistics of a sweep");
    if (!err)
        err = bead_new(&s->indices, count, msg, "the statistics of a sweep");
    for (size_t i = 0; i < count && !err; i++) {
        bead_sweep_configuration(sweep, panel, entries[i].index, &c);
        s->values[i] = c.peaks[place].force / s->clean;
        s->indices[i] = entries[i].index;
    }
    if (!err)
        err = fill_rows(s, entries, count, msg);
    if (!err)
        err = find_threshold(s, name_of(threshold), sweep->panels[panel].shown.spec->seed, msg);
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
