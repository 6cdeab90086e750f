#include "render/area.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Rows of sums are beads where the picture has a pixel or more for each, else pixels. */
struct bead_area {
    struct bead_area_setup setup;
    size_t beads, rows;
    double *sums;    /* [along][rows], integral over time of value - rest, averaged over the row; or the value furthest from 0 in
                        row and column, NaN where all was at rest */
    double *covered; /* s, [along] */
    double *rest;    /* [beads], values of beads that had not moved at the first sample */
    double *resting; /* [rows], the same in rows */
    double *before, *now; /* [rows], value - rest (or value) of the last sample and of this */
    size_t lit_before;    /* rows of `before` that may differ from rest */
    double time_before;
    bool started;
};

static double *numbers(size_t count)
{
    return calloc(count ? count : 1, sizeof(double));
}

static bool keeps_largest(const struct bead_area *a)
{
    return a->setup.sampling == BEAD_SAMPLING_MAX;
}

/* The one further from 0; b where a is NaN. */
static double further(double a, double b)
{
    return fabs(b) <= fabs(a) ? a : b;
}

enum bead_error bead_area_create(const struct bead_area_setup *setup, struct bead_area **area, struct bead_message *msg)
{
    struct bead_area *a = *area = calloc(1, sizeof *a);
    if (!a)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for an image");
    a->setup = *setup;
    a->beads = setup->beads.last - setup->beads.first + 1;
    a->rows = a->beads < (size_t)setup->across ? a->beads : (size_t)setup->across;
    bool fits = a->rows < SIZE_MAX / sizeof(double) / (size_t)setup->along;
    a->sums = fits ? numbers(a->rows * (size_t)setup->along) : NULL;
    a->covered = numbers((size_t)setup->along);
    a->rest = numbers(a->beads);
    a->resting = numbers(a->rows);
    a->before = numbers(a->rows);
    a->now = numbers(a->rows);
    if (!a->sums || !a->covered || !a->rest || !a->resting || !a->before || !a->now) {
        bead_area_destroy(a);
        *area = NULL;
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for an image of %d x %d pixels", setup->along, setup->across);
    }
    for (size_t i = 0; keeps_largest(a) && i < a->rows * (size_t)setup->along; i++)
        a->sums[i] = NAN;
    return BEAD_OK;
}

void bead_area_destroy(struct bead_area *area)
{
    if (!area)
        return;
    free(area->sums);
    free(area->covered);
    free(area->rest);
    free(area->resting);
    free(area->before);
    free(area->now);
    free(area);
}

/* Bead i's share of its row, and of the next where it lies across the border; with more beads than rows. */
static size_t shares(const struct bead_area *a, size_t i, double *own, double *next)
{
    double cell = (double)a->rows / (double)a->beads; /* of a row, < 1 */
    size_t row = (size_t)((double)i * cell);
    row = row < a->rows ? row : a->rows - 1;
    double beyond = (double)(i + 1) * cell - (double)(row + 1);
    *next = row + 1 < a->rows && beyond > 0 ? beyond : 0;
    *own = cell - *next;
    return row;
}

/* Values furthest from 0 in rows, as far as beads below `count` reach; returns how many rows that touches. A bead counts whole in
 * every row that it reaches into. */
static size_t largest_in_rows(const struct bead_area *a, const double *values, size_t count, double *rows)
{
    size_t touched = 0;
    for (size_t i = 0; i < a->beads; i++) {
        size_t from = i * a->rows / a->beads, to = ((i + 1) * a->rows - 1) / a->beads;
        if (i >= count && from >= touched)
            break;
        for (size_t row = from; row <= to && (i < count || row < touched); row++) {
            rows[row] = row < touched ? further(rows[row], i < count ? values[i] : a->rest[i]) : values[i];
            touched = row < touched ? touched : row + 1;
        }
    }
    return touched;
}

/* Means over rows of values - rest, of beads below `count`; returns how many rows that touches. */
static size_t into_rows(const struct bead_area *a, const double *values, size_t count, double *rows)
{
    if (keeps_largest(a))
        return largest_in_rows(a, values, count, rows);
    if (a->rows == a->beads) {
        for (size_t i = 0; i < count; i++)
            rows[i] = values[i] - a->rest[i];
        return count;
    }
    double own, next;
    size_t touched = count ? shares(a, count - 1, &own, &next) + 1 : 0;
    touched += touched > 0 && touched < a->rows;
    memset(rows, 0, touched * sizeof *rows);
    for (size_t i = 0; i < count; i++) {
        size_t row = shares(a, i, &own, &next);
        double value = values[i] - a->rest[i];
        rows[row] += own * value;
        if (next > 0)
            rows[row + 1] += next * value;
    }
    return touched;
}

static double edge(const struct bead_area *a, int c)
{
    const double *time = a->setup.time;
    return c == a->setup.along ? time[1] : time[0] + (time[1] - time[0]) * c / a->setup.along;
}

static int column_of(const struct bead_area *a, double time)
{
    double place = (time - a->setup.time[0]) / (a->setup.time[1] - a->setup.time[0]) * a->setup.along;
    return place > 1 ? (int)fmin(place, a->setup.along) - 1 : 0; /* or the one before: rounding must not lose a piece */
}

/* A linear piece is furthest from 0 at one of its ends, here parts of the way from `before` to `now`. */
static void add_largest(const struct bead_area *a, double *largest, double begin, double end, size_t lit)
{
    for (size_t r = 0; r < lit; r++) {
        double change = a->now[r] - a->before[r], last = end < 1 ? a->before[r] + end * change : a->now[r];
        largest[r] = further(largest[r], further(a->before[r] + begin * change, last));
    }
}

/* The integral of one linear piece over column c: weights of its two ends, the same for all rows. */
static void add_piece(struct bead_area *a, int c, double from, double to, double time, size_t lit)
{
    double length = to - from, span = time - a->time_before;
    double late = length * ((from - a->time_before) + (to - a->time_before)) / (2 * span), early = length - late;
    double *sums = a->sums + (size_t)c * a->rows;
    if (keeps_largest(a))
        add_largest(a, sums, (from - a->time_before) / span, (to - a->time_before) / span, lit);
    else
        for (size_t r = 0; r < lit; r++)
            sums[r] += early * a->before[r] + late * a->now[r];
    a->covered[c] += length;
}

static size_t larger(size_t a, size_t b)
{
    return a > b ? a : b;
}

/* Values of beads that have not moved yet: forces of precompressed chains are not 0 there. */
static void remember_rest(struct bead_area *a, const double *values, size_t active)
{
    for (size_t i = active; i < a->beads; i++) {
        double own = 1, next = 0;
        size_t row = a->rows == a->beads ? i : shares(a, i, &own, &next);
        a->rest[i] = values[i];
        if (keeps_largest(a)) {
            for (row = i * a->rows / a->beads; row * a->beads < (i + 1) * a->rows; row++)
                a->resting[row] = further(a->resting[row], values[i]);
            continue;
        }
        a->resting[row] += own * values[i];
        if (next > 0)
            a->resting[row + 1] += next * values[i];
    }
}

/* Rows from..to - 1 as they are while nothing has moved. */
static void set_at_rest(const struct bead_area *a, double *rows, size_t from, size_t to)
{
    for (size_t r = from; r < to; r++)
        rows[r] = keeps_largest(a) ? a->resting[r] : 0;
}

void bead_area_feed(struct bead_area *area, double time, const double *values, size_t active)
{
    struct bead_area *a = area;
    size_t first = a->setup.beads.first, count = active > first ? active - first : 0;
    count = count < a->beads ? count : a->beads;
    values += first;
    if (!a->started)
        remember_rest(a, values, count);
    size_t touched = into_rows(a, values, count, a->now);
    size_t lit = larger(touched, a->lit_before);
    set_at_rest(a, a->now, touched, lit);
    set_at_rest(a, a->before, a->lit_before, lit);
    if (a->started && time > a->time_before) {
        for (int c = column_of(a, a->time_before); c < a->setup.along && edge(a, c) < time; c++) {
            double from = fmax(a->time_before, edge(a, c)), to = fmin(time, edge(a, c + 1));
            if (to > from)
                add_piece(a, c, from, to, time, lit);
        }
    }
    double *spare = a->before;
    a->before = a->now;
    a->now = spare;
    a->lit_before = lit;
    a->time_before = time;
    a->started = true;
}

static double row_mean(const struct bead_area *a, int c, size_t row)
{
    double sum = a->sums[(size_t)c * a->rows + row];
    if (keeps_largest(a))
        return isnan(sum) ? a->resting[row] : sum;
    return a->resting[row] + sum / a->covered[c];
}

bool bead_area_column(const struct bead_area *area, int c, double *means)
{
    const struct bead_area *a = area;
    size_t pixels = (size_t)a->setup.across;
    if (!(a->covered[c] > 0))
        return false;
    if (a->rows == pixels) {
        for (size_t p = 0; p < pixels; p++)
            means[p] = row_mean(a, c, p);
        return true;
    }
    /* Pixels are narrower than beads: one lies in a cell, or across the border of two. In units of 1/pixels of a bead. */
    for (size_t p = 0; p < pixels; p++) {
        size_t from = p * a->beads, to = from + a->beads, bead = from / pixels, border = (bead + 1) * pixels;
        double mean = row_mean(a, c, bead);
        if (to > border) {
            double beyond = (double)(to - border) / (double)a->beads;
            double next = row_mean(a, c, bead + 1);
            mean = keeps_largest(a) ? further(mean, next) : mean + beyond * (next - mean);
        }
        means[p] = mean;
    }
    return true;
}

void bead_area_extremes(const struct bead_area *area, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (int c = 0; c < area->setup.along; c++) {
        for (size_t row = 0; area->covered[c] > 0 && row < area->rows; row++) {
            double mean = row_mean(area, c, row);
            *low = mean < *low ? mean : *low;
            *high = mean > *high ? mean : *high;
        }
    }
}
