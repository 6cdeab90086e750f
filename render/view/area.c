/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Areas: add each sample to sums of pixels, and read columns back. Used by the space-time view, bare images and contact sheets. */
#include <math.h>
#include <stdlib.h>

#include "render/colour/colour_range.h"
#include "render/view/area.h"
#include "render/view/area_kernels.h"
#include "sim/base/memory.h"

/* Spreads a bead over rows if they are fewer than the beads. For means: its share of its own row and of the next. For values
 * furthest from 0: the first and the last row that it touches. */
struct share {
    double own, next;
    size_t row, last;
};

/* A row of sums is one bead if the picture has at least a pixel for each, else one pixel. */
struct bead_area {
    struct bead_area_setup setup;
    size_t beads, rows;
    double *memory; /* of all arrays of doubles except `sums` */
    double *sums; /* [columns][rows], integral over time of value - rest, averaged over the row; or the value furthest from 0 in row
                   * and column, NaN if all were at rest; finished columns hold the values of their pixels */
    double *covered;      /* s, [columns]; a column's sums have no values where it is 0 */
    double *rest;         /* [beads], values of beads that had not moved at the first sample */
    double *resting;      /* [rows], the same in rows */
    double *before, *now; /* [rows], value - rest (or value) of the last sample and of this */
    double *low, *high;   /* [rows], of finished columns */
    double *shown;        /* [rows], scratch: the column being read */
    struct share *shares; /* [beads], with fewer rows */
    unsigned *level;      /* [places], with fewer rows; else NULL */
    double *beyond;       /* [rows], part of the pixel across a row's upper border that lies beyond it */
    double *levels;       /* [levels], scratch: values of the column being read */
    size_t lit_before;    /* rows of `before` that may differ from rest */
    double time_before;
    int done; /* columns before this one are finished */
    bool started;
};

static bool keeps_largest(const struct bead_area *a)
{
    return a->setup.sampling == BEAD_SAMPLING_MAX;
}

static double *area_column(const struct bead_area *a, int c)
{
    return a->sums + (size_t)c * a->rows;
}

static struct share area_share_of(const struct bead_area *a, size_t i)
{
    if (keeps_largest(a))
        return (struct share){0, 0, i * a->rows / a->beads, ((i + 1) * a->rows - 1) / a->beads};
    double cell = (double)a->rows / (double)a->beads; /* of a row, < 1 */
    size_t row = (size_t)((double)i * cell);
    row = row < a->rows ? row : a->rows - 1;
    double beyond = (double)(i + 1) * cell - (double)(row + 1), next = row + 1 < a->rows && beyond > 0 ? beyond : 0;
    return (struct share){cell - next, next, row, next > 0 ? row + 1 : row};
}

/* Called with the first sample: if pictures are only planned, arrays of beads are not touched, and take no memory. */
static void find_shares(struct bead_area *a)
{
    for (size_t i = 0; a->shares && i < a->beads; i++)
        a->shares[i] = area_share_of(a, i);
}

/* A pixel narrower than a bead lies within one cell or across the border of two. Lengths are in units of 1/pixels of a bead. */
static void find_levels(struct bead_area *a)
{
    size_t pixels = (size_t)a->setup.places;
    for (size_t p = 0; p < pixels; p++) {
        size_t from = p * a->beads, to = from + a->beads, bead = from / pixels, border = (bead + 1) * pixels;
        a->level[p] = (unsigned)(to > border ? a->rows + bead : bead);
        if (to > border)
            a->beyond[bead] = (double)(to - border) / (double)a->beads;
    }
}

/* False: no memory. */
static bool area_allocate(struct bead_area *a)
{
    size_t columns = (size_t)a->setup.columns, places = (size_t)a->setup.places;
    bool fits = a->rows < SIZE_MAX / sizeof(double) / columns;
    a->sums = fits ? bead_large_take(a->rows * columns * sizeof(double)) : NULL;
    a->shares = a->rows < a->beads ? calloc(a->beads, sizeof *a->shares) : NULL;
    a->level = a->rows < places ? calloc(places, sizeof *a->level) : NULL;
    a->memory = calloc(columns + a->beads + 7 * a->rows + bead_area_levels(a), sizeof *a->memory);
    if (!a->sums || !a->memory || (!a->shares && a->rows < a->beads) || (!a->level && a->rows < places))
        return false;
    a->covered = a->memory;
    a->rest = a->covered + columns;
    a->resting = a->rest + a->beads;
    a->before = a->resting + a->rows;
    a->now = a->before + a->rows;
    a->low = a->now + a->rows;
    a->high = a->low + a->rows;
    a->shown = a->high + a->rows;
    a->beyond = a->shown + a->rows;
    a->levels = a->beyond + a->rows;
    return true;
}

enum bead_error bead_area_create(const struct bead_area_setup *setup, struct bead_area **area, struct bead_message *msg)
{
    BEAD_TRY(bead_new(area, 1, msg, "an image"));
    struct bead_area *a = *area;
    a->setup = *setup;
    a->beads = setup->beads.last - setup->beads.first + 1;
    a->rows = a->beads < (size_t)setup->places ? a->beads : (size_t)setup->places;
    if (!area_allocate(a)) {
        bead_area_destroy(a);
        *area = NULL;
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for an image of %d x %d pixels", setup->columns, setup->places);
    }
    if (a->level)
        find_levels(a);
    for (size_t r = 0; r < a->rows; r++) {
        a->low[r] = INFINITY;
        a->high[r] = -INFINITY;
    }
    return BEAD_OK;
}

/* Like find_levels; lengths are in pixels. */
void bead_area_divide(struct bead_area *a, const double *borders)
{
    const size_t pixels = (size_t)a->setup.places;
    const double scale = (double)pixels / (borders[a->beads] - borders[0]);
    for (size_t p = 0, bead = 0; a->level && p < pixels; p++) {
        const double from = (double)p, to = from + 1;
        while ((borders[bead + 1] - borders[0]) * scale <= from)
            bead++;
        const double beyond = to - (borders[bead + 1] - borders[0]) * scale;
        const bool across = beyond > 1e-9;
        a->level[p] = (unsigned)(across ? a->rows + bead : bead);
        if (across)
            a->beyond[bead] = beyond;
    }
}

void bead_area_destroy(struct bead_area *area)
{
    if (!area)
        return;
    free(area->sums);
    free(area->memory);
    free(area->shares);
    free(area->level);
    free(area);
}

/* Values furthest from 0, in rows, for the beads below `count`. A bead counts fully in every row that it touches. Returns the
 * number of rows touched. */
static size_t largest_in_rows(const struct bead_area *a, const double *values, size_t count, double *rows)
{
    size_t touched = 0;
    for (size_t i = 0; i < a->beads; i++) {
        const struct share *s = &a->shares[i];
        if (i >= count && s->row >= touched)
            break;
        for (size_t row = s->row; row <= s->last && (i < count || row < touched); row++) {
            rows[row] = row < touched ? bead_further(rows[row], i < count ? values[i] : a->rest[i]) : values[i];
            touched = row < touched ? touched : row + 1;
        }
    }
    return touched;
}

/* Means over rows of values - rest. */
static size_t means_in_rows(const struct bead_area *a, const double *values, size_t count, double *rows)
{
    size_t touched = count ? a->shares[count - 1].row + 1 : 0;
    touched += touched > 0 && touched < a->rows;
    memset(rows, 0, touched * sizeof *rows);
    for (size_t i = 0; i < count; i++) {
        const struct share *s = &a->shares[i];
        double value = values[i] - a->rest[i];
        rows[s->row] += s->own * value;
        rows[s->last] += s->next * value; /* 0 of its own row again, where it has no other */
    }
    return touched;
}

/* Values of the beads below `count`, in rows; returns the number of rows touched. */
static size_t into_rows(const struct bead_area *a, const double *values, size_t count, double *rows)
{
    if (a->shares)
        return (keeps_largest(a) ? largest_in_rows : means_in_rows)(a, values, count, rows);
    if (keeps_largest(a))
        memcpy(rows, values, count * sizeof *rows);
    else
        bead_area_subtract(count, values, a->rest, rows);
    return count;
}

static double edge(const struct bead_area *a, int c)
{
    const double *time = a->setup.time;
    return c == a->setup.columns ? time[1] : time[0] + (time[1] - time[0]) * c / a->setup.columns;
}

static int column_of(const struct bead_area *a, double time)
{
    double place = (time - a->setup.time[0]) / (a->setup.time[1] - a->setup.time[0]) * a->setup.columns;
    return place > 1 ? (int)fmin(place, a->setup.columns) - 1 : 0; /* or one before, so that rounding loses no piece */
}

static void clear(const struct bead_area *a, double *sums)
{
    if (!keeps_largest(a))
        memset(sums, 0, a->rows * sizeof *sums);
    for (size_t r = 0; keeps_largest(a) && r < a->rows; r++)
        sums[r] = NAN;
}

/* Adds the integral of one linear piece over column c. All rows weight its two ends equally. */
static void add_piece(struct bead_area *a, int c, double from, double to, double time, size_t lit)
{
    double length = to - from, span = time - a->time_before, *sums = area_column(a, c);
    double late = length * ((from - a->time_before) + (to - a->time_before)) / (2 * span), early = length - late;
    if (!(a->covered[c] > 0))
        clear(a, sums);
    if (keeps_largest(a))
        bead_area_add_largest(lit, (from - a->time_before) / span, (to - a->time_before) / span, a->before, a->now, sums);
    else
        bead_area_add(lit, early, late, a->before, a->now, sums);
    a->covered[c] += length;
}

/* The values of column c in rows; samples must have touched it. */
static void show_column(const struct bead_area *a, int c, double *rows)
{
    if (keeps_largest(a))
        bead_area_largest(a->rows, a->resting, area_column(a, c), rows);
    else
        bead_area_means(a->rows, a->covered[c], a->resting, area_column(a, c), rows);
}

/* Turns sums into values of pixels while the column is still in the cache. */
static void area_finish(struct bead_area *a, int c)
{
    if (!(a->covered[c] > 0))
        return;
    show_column(a, c, area_column(a, c));
    bead_area_spread(a->rows, area_column(a, c), a->low, a->high);
}

/* Stores the values of beads that have not moved yet; in a precompressed chain their forces are not 0. */
static void remember_rest(struct bead_area *a, const double *values, size_t active)
{
    for (size_t i = active; i < a->beads; i++) {
        const struct share s = a->shares ? a->shares[i] : (struct share){1, 0, i, i};
        a->rest[i] = values[i];
        for (size_t row = s.row; row <= s.last; row++)
            a->resting[row] = keeps_largest(a) ? bead_further(a->resting[row], values[i])
                                               : a->resting[row] + (row == s.row ? s.own : s.next) * values[i];
    }
}

/* Gives rows from..to - 1 their values at rest. */
static void set_at_rest(const struct bead_area *a, double *rows, size_t from, size_t to)
{
    for (size_t r = from; r < to; r++)
        rows[r] = keeps_largest(a) ? a->resting[r] : 0;
}

void bead_area_feed(struct bead_area *a, double time, const double *values, size_t active)
{
    size_t first = a->setup.beads.first, count = active > first ? active - first : 0;
    count = count < a->beads ? count : a->beads;
    values += first;
    if (!a->started) {
        find_shares(a);
        remember_rest(a, values, count);
    }
    size_t touched = into_rows(a, values, count, a->now);
    size_t lit = touched > a->lit_before ? touched : a->lit_before;
    set_at_rest(a, a->now, touched, lit);
    set_at_rest(a, a->before, a->lit_before, lit);
    if (a->started && time > a->time_before) {
        for (int c = column_of(a, a->time_before); c < a->setup.columns && edge(a, c) < time; c++) {
            double from = fmax(a->time_before, edge(a, c)), to = fmin(time, edge(a, c + 1));
            if (to > from)
                add_piece(a, c, from, to, time, lit);
        }
    }
    while (a->done < a->setup.columns && edge(a, a->done + 1) <= time)
        area_finish(a, a->done++);
    double *spare = a->before;
    a->before = a->now;
    a->now = spare;
    a->lit_before = lit;
    a->time_before = time;
    a->started = true;
}

/* The values of a column in rows: in place if it is finished, else in scratch memory. */
static const double *rows_of(const struct bead_area *a, int c)
{
    if (c < a->done)
        return area_column(a, c);
    show_column(a, c, a->shown);
    return a->shown;
}

size_t bead_area_levels(const struct bead_area *area)
{
    return area->rows < (size_t)area->setup.places ? 2 * area->rows - 1 : area->rows;
}

const unsigned *bead_area_level(const struct bead_area *area)
{
    return area->level;
}

bool bead_area_column_levels(const struct bead_area *a, int c, double *values)
{
    if (!(a->covered[c] > 0))
        return false;
    const double *rows = rows_of(a, c);
    memcpy(values, rows, a->rows * sizeof *values);
    if (a->level && keeps_largest(a))
        bead_area_borders_largest(a->rows - 1, rows, values + a->rows);
    else if (a->level)
        bead_area_borders(a->rows - 1, a->beyond, rows, values + a->rows);
    return true;
}

bool bead_area_column(const struct bead_area *a, int c, double *means)
{
    if (!a->level)
        return bead_area_column_levels(a, c, means);
    bool touched = bead_area_column_levels(a, c, a->levels);
    for (size_t p = 0; touched && p < (size_t)a->setup.places; p++)
        means[p] = a->levels[a->level[p]];
    return touched;
}

static void area_extend(size_t n, const double *lows, const double *highs, double *low, double *high)
{
    for (size_t i = 0; i < n; i++) {
        *low = lows[i] < *low ? lows[i] : *low;
        *high = highs[i] > *high ? highs[i] : *high;
    }
}

void bead_area_extremes(const struct bead_area *a, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    area_extend(a->rows, a->low, a->high, low, high);
    for (int c = a->done; c < a->setup.columns; c++) {
        const double *rows = a->covered[c] > 0 ? rows_of(a, c) : NULL;
        if (rows)
            area_extend(a->rows, rows, rows, low, high);
    }
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double bead_area_quantile(double *values, size_t count, double part)
{
    qsort(values, count, sizeof *values, by_size);
    return count > 0 ? values[(size_t)(part * (double)(count - 1))] : INFINITY;
}

/* Marks rows whose values are never on both sides of this one, or equal to it. */
static void find_apart(const struct bead_area *a, double rest, bool *apart)
{
    const double slack = 1e-9 * fabs(rest);
    for (size_t r = 0; r < a->rows; r++) {
        double low = INFINITY, high = -INFINITY;
        for (int c = 0; c < a->setup.columns; c++) {
            const double *rows = a->covered[c] > 0 ? rows_of(a, c) : NULL;
            low = rows ? fmin(low, rows[r]) : low;
            high = rows ? fmax(high, rows[r]) : high;
        }
        apart[r] = low > rest + slack || high < rest - slack;
    }
}

/* Finds the largest distance from a value in each touched column and in each row; returns the number of such columns. */
static size_t find_most(const struct bead_area *a, double rest, const bool *apart, double *of_column, double *of_row)
{
    size_t count = 0;
    for (int c = 0; c < a->setup.columns; c++) {
        const double *rows = a->covered[c] > 0 ? rows_of(a, c) : NULL;
        double most = 0;
        for (size_t r = 0; rows && r < a->rows; r++) {
            const double size = apart[r] ? 0 : fabs(rows[r] - rest);
            most = size > most ? size : most;
            of_row[r] = size > of_row[r] ? size : of_row[r];
        }
        if (rows)
            of_column[count++] = most;
    }
    return count;
}

double bead_area_typical(const struct bead_area *area, double rest, double *largest)
{
    static const double of_time = 0.95, of_chain = 0.9;
    BEAD_FREED double *of_column = calloc((size_t)area->setup.columns, sizeof *of_column),
                      *of_row = calloc(area->rows, sizeof *of_row);
    BEAD_FREED bool *apart = calloc(area->rows, sizeof *apart);
    *largest = 0;
    if (!of_column || !of_row || !apart)
        return INFINITY;
    if (rest != 0)
        find_apart(area, rest, apart);
    const size_t columns = find_most(area, rest, apart, of_column, of_row);
    const double typical = fmax(bead_area_quantile(of_column, columns, of_time), bead_area_quantile(of_row, area->rows, of_chain));
    *largest = of_row[area->rows - 1]; /* sorted */
    return typical;
}

void bead_area_widen(const struct bead_area *area, struct bead_shown_values *all)
{
    double low, high, away;
    bead_area_extremes(area, &low, &high);
    all->least = fmin(all->least, low);
    all->largest = fmax(all->largest, high);
    all->typical = fmax(all->typical, bead_area_typical(area, 0, &away));
    if (all->rest != 0) {
        all->usually_away = fmax(all->usually_away, bead_area_typical(area, all->rest, &away));
        all->away = fmax(all->away, away);
    }
}

size_t bead_area_places(const struct bead_area *area)
{
    return (size_t)area->setup.places;
}
