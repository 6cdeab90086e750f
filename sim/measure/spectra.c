/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collects the curves of a run and transforms them: see spectra.h. */
#include "sim/measure/spectra.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/elementary.h"
#include "sim/base/memory.h"
#include "sim/base/wide.h"
#include "sim/measure/places.h"
#include "sim/measure/sink_grid.h"
#include "sim/measure/transform.h"

static const double pi = 3.14159265358979323846;
/* Samples in each period of the highest band. */
static const double fine = 2.5;
/* Segments of a spectrogram begin 1/STEPS of their length apart. */
enum { STEPS = 8, MOST_VALUES = 1 << 26, FEWEST = 16 };
/* Half of the power of Hann's window is within this part of its length, and half the power of a line within that many steps. */
static const double half_time = 0.364, half_line = 1.44;
/* There is no transfer where the drive is below this part of its largest amplitude. */
static const double driven = 1e-3;

struct curves {
    struct bead_place_shown *places;
    size_t count, taken;
    double *values; /* [places][samples] */
    struct bead_medium *media;
    size_t media_count, cell; /* cell: beads, of a dispersion */
};

struct bead_spectra {
    const struct bead_output *output;
    struct bead_run_context context;
    struct bead_grid grid;
    size_t samples;
    struct curves *chains;
    char why[128];
};

void bead_spectra_destroy(struct bead_spectra *s)
{
    if (!s)
        return;
    for (size_t c = 0; s->chains && c < s->context.chain_count; c++) {
        bead_media_free(s->chains[c].media, s->chains[c].media_count);
        free(s->chains[c].places);
        free(s->chains[c].values);
    }
    free(s->chains);
    free(s);
}

/* ---- what is collected ---- */

/* All beads, or the contacts between them, of the first cell that the chain repeats, or of the whole chain. */
static enum bead_error place_cells(struct bead_spectra *s, size_t c, struct bead_message *msg)
{
    const struct bead_chain *chain = s->context.chains[c];
    struct curves *curves = &s->chains[c];
    const bool contacts = bead_field_info(s->output->shown.field)->of_contacts;
    size_t first = 0, count = contacts ? bead_chain_contacts(chain) : bead_chain_beads(chain);
    BEAD_TRY(bead_media_find(chain, &curves->media, &curves->media_count, msg));
    curves->cell = 1;
    if (curves->media_count > 0) {
        first = curves->media[0].first;
        count = curves->media[0].last - first + !contacts;
        curves->cell = curves->media[0].cell.count;
    }
    curves->count = bead_transform_length(count / curves->cell) * curves->cell;
    BEAD_TRY(bead_new(&curves->places, curves->count, msg, "a dispersion"));
    for (size_t i = 0; i < curves->count; i++)
        curves->places[i] = (struct bead_place_shown){.index = first + i, .field = s->output->shown.field};
    return BEAD_OK;
}

/* The reference of a transfer: the driven bead, or its contact, the right one if it exists. */
static struct bead_place_shown driven_place(const struct bead_spectra *s, const struct bead_chain *chain)
{
    const struct bead_drive *drive = &bead_chain_spec(chain)->drive;
    struct bead_place_shown place = {.index = drive->amplitude > 0 ? drive->bead : 0};
    place.field = bead_place_shown(s->output, chain, 0).field;
    if (bead_field_info(place.field)->of_contacts && place.index >= bead_chain_contacts(chain))
        place.index = bead_chain_contacts(chain) - 1;
    return place;
}

/* Lists the places of the curves; for a transfer, followed by the driven place. */
static enum bead_error place_listed(struct bead_spectra *s, size_t c, struct bead_message *msg)
{
    const struct bead_chain *chain = s->context.chains[c];
    struct curves *curves = &s->chains[c];
    const size_t count = bead_places_count(s->output, chain);
    BEAD_TRY(bead_new(&curves->places, count + 1, msg, "a spectrum"));
    for (curves->count = 0; curves->count < count; curves->count++)
        curves->places[curves->count] = bead_place_shown(s->output, chain, curves->count);
    if (s->output->curves.show == BEAD_SHOW_TRANSFER && count > 0)
        curves->places[curves->count++] = driven_place(s, chain);
    return BEAD_OK;
}

/* Chooses the times asked for; a dispersion is sampled for its highest band. */
static enum bead_error choose_grid(struct bead_spectra *s, struct bead_message *msg)
{
    struct bead_output asked = *s->output;
    double highest = 0;
    for (size_t c = 0; c < s->context.chain_count; c++) {
        for (size_t i = 0; i < s->chains[c].media_count; i++) {
            double ends[2];
            bead_band(&s->chains[c].media[i], s->chains[c].media[i].cell.count - 1, ends);
            highest = fmax(highest, ends[1]);
        }
    }
    if (highest > 0 && !(asked.shown.every > 0))
        asked.shown.every = bead_round_down(1 / (fine * highest));
    BEAD_TRY(bead_sink_grid(&asked, &s->context, &s->grid, msg));
    s->samples = bead_grid_count(&s->grid);
    return BEAD_OK;
}

/* Samples of a segment; without one that is asked for, all. */
static size_t segment_samples(const struct bead_spectra *s, size_t samples)
{
    const double asked = s->output->curves.segment;
    return isfinite(asked) ? (size_t)fmin(1e15, round(asked / s->grid.every)) : samples;
}

static enum bead_error check_segment(const struct bead_spectra *s, size_t wanted, size_t samples, struct bead_message *msg)
{
    return wanted >= FEWEST && wanted <= samples
               ? BEAD_OK
               : bead_output_wrong(s->output, msg,
                                   "segment: has %zu of %zu samples, every %g; must have %d or more, and no more than there are",
                                   wanted, samples, s->grid.every, FEWEST);
}

static enum bead_error reserve(struct bead_spectra *s, struct bead_message *msg)
{
    size_t places = 0;
    char every[32];
    for (size_t c = 0; c < s->context.chain_count; c++)
        places += s->chains[c].count;
    if (places == 0)
        return bead_output_wrong(s->output, msg, "show: there is no sensor to show; give a bead one, or say which `beads`");
    if (s->output->curves.show != BEAD_SHOW_SENSORS)
        BEAD_TRY(check_segment(s, segment_samples(s, s->samples), s->samples, msg));
    if (s->samples > MOST_VALUES / places)
        return bead_output_wrong(s->output, msg, "every: %g gives %zu samples of %zu curves; at most %d numbers are transformed",
                                 s->grid.every, s->samples, places, MOST_VALUES);
    for (size_t c = 0; c < s->context.chain_count; c++)
        BEAD_TRY(bead_new(&s->chains[c].values, s->chains[c].count * s->samples, msg, "spectra"));
    bead_time_text(s->grid.every, bead_chain_time_unit(s->context.chains[0]), every, sizeof every);
    snprintf(s->why, sizeof s->why, "spectra of %zu samples of %zu curve%s, every %s", s->samples, places, places == 1 ? "" : "s",
             every);
    return BEAD_OK;
}

enum bead_error bead_spectra_create(const struct bead_output *output, const struct bead_run_context *context,
                                    struct bead_spectra **made, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    struct bead_spectra *s;
    *made = NULL;
    BEAD_TRY(bead_new(&s, 1, msg, "spectra"));
    s->output = output;
    s->context = *context;
    err = bead_new(&s->chains, context->chain_count, msg, "spectra");
    for (size_t c = 0; c < context->chain_count && !err; c++)
        err = output->curves.show == BEAD_SHOW_DISPERSION ? place_cells(s, c, msg) : place_listed(s, c, msg);
    if (!err)
        err = choose_grid(s, msg);
    if (!err)
        err = reserve(s, msg);
    if (err)
        bead_spectra_destroy(s);
    else
        *made = s;
    return err;
}

struct bead_needs bead_spectra_needs(const struct bead_spectra *s)
{
    struct bead_needs needs = {.beads = {SIZE_MAX, 0}, .grid = s->grid, .until = s->grid.end, .why = s->why};
    for (size_t c = 0; c < s->context.chain_count; c++) {
        for (size_t p = 0; p < s->chains[c].count; p++)
            bead_place_needs(&s->chains[c].places[p], &needs);
    }
    return needs;
}

/* Samples may come more often than requested, for other panels of a figure. */
enum bead_error bead_spectra_feed(struct bead_spectra *s, const struct bead_sample *sample, struct bead_message *msg)
{
    struct curves *curves = &s->chains[sample->chain];
    if (curves->taken >= s->samples || sample->time < s->grid.start + ((double)curves->taken - 1e-6) * s->grid.every)
        return BEAD_OK;
    for (size_t p = 0; p < curves->count; p++) {
        const double *values = sample->field[curves->places[p].field];
        if (!values)
            return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "the samples have no %s",
                             bead_field_info(curves->places[p].field)->title);
        curves->values[p * s->samples + curves->taken] = values[curves->places[p].index];
    }
    curves->taken++;
    return BEAD_OK;
}

/* ---- transforms ---- */

/* The data of one chain to be transformed. */
struct work {
    const struct bead_spectra *s;
    const struct curves *curves;
    struct bead_transform time;
    size_t segments, hop, rows;
    struct bead_spectral *found;
};

static const double *segment_of(const struct work *w, size_t place, size_t segment)
{
    return w->curves->values + place * w->s->samples + segment * w->hop;
}

/* Turns squares added up over `count` segments into amplitudes. */
static void to_amplitudes(const struct work *w, size_t column, size_t count, double scale)
{
    double *values = w->found->values + column * w->rows;
    for (size_t k = 0; k < w->rows; k++)
        values[k] = scale * sqrt(2 * bead_transform_twice(&w->time, k) * values[k] / (double)count) / w->time.sum;
}

/* Adds the squares of curve `place` in segment `segment` to a column. */
static void add_squares(struct work *w, size_t place, size_t segment, size_t column)
{
    bead_transform_segment(&w->time, segment_of(w, place, segment));
    for (size_t k = 0; k < w->rows; k++)
        w->found->values[column * w->rows + k] += bead_complex_square(w->time.found[k]);
}

static enum bead_error find_spectrum(struct work *w, struct bead_message *)
{
    for (size_t p = 0; p < w->found->columns; p++) {
        for (size_t i = 0; i < w->segments; i++)
            add_squares(w, p, i, p);
        to_amplitudes(w, p, w->segments, 1);
    }
    return BEAD_OK;
}

static enum bead_error find_spectrogram(struct work *w, struct bead_message *)
{
    for (size_t i = 0; i < w->segments; i++) {
        add_squares(w, 0, i, i);
        to_amplitudes(w, i, 1, 1);
    }
    return BEAD_OK;
}

/* |sum conj(X0) X| / sum |X0|^2: motion that does not come from the drive averages out. */
static enum bead_error find_transfer(struct work *w, struct bead_message *msg)
{
    const size_t rows = w->rows, places = w->found->columns;
    BEAD_FREED struct bead_complex *drive = NULL, *cross = NULL;
    BEAD_FREED double *power = NULL;
    double most = 0;
    BEAD_TRY(bead_new(&drive, rows, msg, "a transfer"));
    BEAD_TRY(bead_new(&cross, rows * places, msg, "a transfer"));
    BEAD_TRY(bead_new(&power, rows, msg, "a transfer"));
    for (size_t i = 0; i < w->segments; i++) {
        bead_transform_segment(&w->time, segment_of(w, places, i));
        memcpy(drive, w->time.found, rows * sizeof *drive);
        for (size_t k = 0; k < rows; k++)
            power[k] += bead_complex_square(drive[k]);
        for (size_t p = 0; p < places; p++) {
            bead_transform_segment(&w->time, segment_of(w, p, i));
            for (size_t k = 0; k < rows; k++) {
                const struct bead_complex other = {drive[k].re, -drive[k].im}, z = bead_complex_times(other, w->time.found[k]);
                cross[p * rows + k].re += z.re;
                cross[p * rows + k].im += z.im;
            }
        }
    }
    for (size_t k = 0; k < rows; k++)
        most = fmax(most, power[k]);
    for (size_t i = 0; i < places * rows; i++)
        w->found->values[i] =
            power[i % rows] > driven * driven * most ? sqrt(bead_complex_square(cross[i])) / power[i % rows] : NAN;
    return BEAD_OK;
}

/* Adds up waves in both directions, and the beads of a cell: a wave A cos(k n - w t) of all of them has the square A^2 times their
 * number. */
static void add_waves(struct work *w, struct bead_transform *space, const struct bead_complex *bins)
{
    for (size_t k = 0; k < w->rows; k++) {
        for (int part = 0; part < 2; part++) {
            for (size_t j = 0; j < space->points; j++)
                space->grid[j] = space->window[j] * (part ? bins[j * w->rows + k].im : bins[j * w->rows + k].re);
            bead_fourier_forward(space->fourier, space->grid, space->found);
            for (size_t q = 0; q < space->bins; q++)
                w->found->values[q * w->rows + k] += bead_transform_twice(space, q) * bead_complex_square(space->found[q]);
        }
    }
}

static enum bead_error add_cells(struct work *w, struct bead_transform *space, struct bead_message *msg)
{
    BEAD_FREED struct bead_complex *bins = NULL;
    BEAD_TRY(bead_new(&bins, space->points * w->rows, msg, "a dispersion"));
    for (size_t i = 0; i < w->segments * w->curves->cell; i++) {
        for (size_t j = 0; j < space->points; j++) {
            bead_transform_segment(&w->time, segment_of(w, j * w->curves->cell + i % w->curves->cell, i / w->curves->cell));
            memcpy(bins + j * w->rows, w->time.found, w->rows * sizeof *bins);
        }
        add_waves(w, space, bins);
    }
    for (size_t q = 0; q < space->bins; q++)
        to_amplitudes(w, q, w->segments, 1 / space->sum);
    return BEAD_OK;
}

static enum bead_error find_dispersion(struct work *w, struct bead_message *msg)
{
    struct bead_transform space;
    enum bead_error err = bead_transform_make(&space, w->curves->count / w->curves->cell, w->s->output->curves.window, msg);
    if (!err)
        err = add_cells(w, &space, msg);
    bead_transform_free(&space);
    return err;
}

/* The width, Hz, of the frequencies from 0, or the first asked for, to the last one shown: tables have all. */
static enum bead_error find_width(struct work *w, double *width, struct bead_message *msg)
{
    const double *asked = w->s->output->curves.frequencies, nyquist = 0.5 / w->s->grid.every;
    double high = isnan(asked[1]) ? nyquist : fmin(asked[1], nyquist);
    if (isnan(asked[1]) && w->s->output->kind != BEAD_OUTPUT_TABLE)
        BEAD_TRY(bead_transform_reach(w->curves->values, w->curves->taken, w->s->grid.every, &high, msg));
    *width = high - (asked[0] < high ? asked[0] : 0);
    return BEAD_OK;
}

/* With segments of length L, of a time T and a width B of frequencies, half powers resolve T/(0.364 L) times and B L/1.44
 * frequencies: equally many of both if L = 2.0 sqrt(T/B). A line that crosses all frequencies in this time is then as narrow as it
 * can be. */
static enum bead_error balance(struct work *w, size_t *samples, struct bead_message *msg)
{
    const size_t taken = w->curves->taken, half = taken / 2;
    double width = 0;
    BEAD_TRY(find_width(w, &width, msg));
    const double length = sqrt(half_line / half_time * (double)taken / (width * w->s->grid.every));
    *samples = length < (double)half ? (size_t)length : half;
    *samples = *samples < FEWEST ? FEWEST : *samples;
    return BEAD_OK;
}

static enum bead_error choose_segments(struct work *w, size_t *points, struct bead_message *msg)
{
    const struct bead_spectra *s = w->s;
    const bool film = s->output->curves.show == BEAD_SHOW_SPECTROGRAM;
    const size_t taken = w->curves->taken;
    size_t wanted = segment_samples(s, taken);
    if (film && !isfinite(s->output->curves.segment) && taken >= FEWEST)
        BEAD_TRY(balance(w, &wanted, msg));
    BEAD_TRY(check_segment(s, wanted, taken, msg));
    *points = bead_transform_length(wanted);
    w->hop = film ? (*points + STEPS - 1) / STEPS : (*points + 1) / 2;
    w->segments = (taken - *points) / w->hop + 1;
    return BEAD_OK;
}

static size_t columns_of(const struct work *w)
{
    switch (w->s->output->curves.show) {
    case BEAD_SHOW_SPECTROGRAM:
        return w->segments;
    case BEAD_SHOW_TRANSFER:
        return w->curves->count - 1;
    case BEAD_SHOW_DISPERSION:
        return w->curves->count / w->curves->cell / 2 + 1;
    default:
        return w->curves->count;
    }
}

/* Copies the curves themselves. */
static enum bead_error copy_curves(const struct bead_spectra *s, const struct curves *curves, struct bead_spectral *found,
                                   struct bead_message *msg)
{
    *found = (struct bead_spectral){.columns = curves->count, .rows = curves->taken, .step = s->grid.every, .first = s->grid.start};
    BEAD_TRY(bead_new(&found->values, curves->count * curves->taken, msg, "curves"));
    for (size_t p = 0; p < curves->count; p++)
        memcpy(found->values + p * curves->taken, curves->values + p * s->samples, curves->taken * sizeof *found->values);
    return BEAD_OK;
}

enum bead_error bead_spectra_of(const struct bead_spectra *s, size_t chain, struct bead_spectral *found, struct bead_message *msg)
{
    struct work w = {.s = s, .curves = &s->chains[chain], .found = found};
    const enum bead_show show = s->output->curves.show;
    size_t points = 0;
    *found = (struct bead_spectral){0};
    if (w.curves->count == 0)
        return BEAD_OK;
    if (show == BEAD_SHOW_SENSORS)
        return copy_curves(s, w.curves, found, msg);
    BEAD_TRY(choose_segments(&w, &points, msg));
    enum bead_error err = bead_transform_make(&w.time, points, s->output->curves.window, msg);
    w.rows = w.time.bins;
    *found = (struct bead_spectral){.columns = columns_of(&w),
                                    .rows = w.rows,
                                    .step = 1 / ((double)points * s->grid.every),
                                    .first = s->grid.start + 0.5 * (double)points * s->grid.every,
                                    .between = (double)w.hop * s->grid.every};
    if (show == BEAD_SHOW_DISPERSION) {
        found->first = 0;
        found->between = 2 / (double)(w.curves->count / w.curves->cell);
    }
    if (!err)
        err = bead_new(&found->values, found->columns * found->rows, msg, "spectra");
    if (!err)
        err = show == BEAD_SHOW_DISPERSION    ? find_dispersion(&w, msg)
              : show == BEAD_SHOW_TRANSFER    ? find_transfer(&w, msg)
              : show == BEAD_SHOW_SPECTROGRAM ? find_spectrogram(&w, msg)
                                              : find_spectrum(&w, msg);
    bead_transform_free(&w.time);
    return err;
}

const struct bead_medium *bead_spectra_medium(const struct bead_spectra *s, size_t chain)
{
    return s->chains[chain].media_count > 0 ? &s->chains[chain].media[0] : NULL;
}

/* ---- lines ---- */

/* Frequency of a band at a column. */
static double band_at(const struct bead_spectral *d, const struct bead_medium *medium, size_t column, size_t band)
{
    const double q = fmin(1, d->first + (double)column * d->between);
    return bead_jacobi_frequency(&medium->cell, band, bead_sin((0.5 - q) * pi));
}

struct bead_spectral_line bead_spectral_line(const struct bead_spectral *d, const struct bead_medium *medium, size_t column,
                                             size_t band)
{
    const double *a = d->values + column * d->rows, top = (double)(d->rows - 1) * d->step;
    struct bead_spectral_line line = {NAN, NAN, 0};
    double low = 0, high = top;
    if (medium) {
        line.exact = band_at(d, medium, column, band);
        low = band > 0 ? (band_at(d, medium, column, band - 1) + line.exact) / 2 : 0;
        high = band + 1 < medium->cell.count ? fmin(top, (band_at(d, medium, column, band + 1) + line.exact) / 2) : top;
    }
    size_t best = 0;
    for (size_t k = (size_t)ceil(low / d->step); k <= (size_t)(high / d->step) && k < d->rows; k++) {
        if (a[k] > line.amplitude) {
            line.amplitude = a[k];
            best = k;
        }
    }
    if (line.amplitude > 0)
        line.found = (double)best * d->step;
    /* Row 0 has only rounding errors: the mean is subtracted. */
    if (best > 1 && best + 1 < d->rows && a[best - 1] > 0 && a[best + 1] > 0) {
        const double left = bead_log(a[best - 1]), middle = bead_log(a[best]), right = bead_log(a[best + 1]),
                     bend = left - 2 * middle + right;
        line.found += bend < 0 ? d->step * fmax(-0.5, fmin(0.5, 0.5 * (left - right) / bend)) : 0;
    }
    return line;
}
