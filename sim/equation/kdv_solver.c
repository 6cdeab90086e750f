/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Korteweg-de Vries equation on a ring: its start, number of points and steps. kdv.c makes a row of systems.c from it. */
#include "sim/equation/kdv_solver.h"

#include <stdlib.h>

#include "sim/base/number.h"
#include "sim/base/wide.h"

/* ---- starts, and the grid that they and their later shapes need ---- */

double bead_kdv_soliton_amplitude(const struct bead_equation_spec *spec, double speed)
{
    return 3 * speed / spec->nonlinearity;
}

static double wave_number(const struct bead_equation_spec *spec, size_t i)
{
    return sqrt(spec->solitons[i].speed / spec->dispersion);
}

/* ln((k - l) / (k + l))^2: the phase shift of two solitons after one has passed the other. */
static double pair_shift(const struct bead_equation_spec *spec, size_t i, size_t j)
{
    double k = wave_number(spec, i), l = wave_number(spec, j), part = (k - l) / (k + l);
    return bead_log(part * part);
}

static bool speeds_differ(const struct bead_equation_spec *spec)
{
    const double nearly = 1e-3;
    for (size_t i = 0; i < spec->soliton_count; i++) {
        for (size_t j = 0; j < i; j++) {
            double a = spec->solitons[i].speed, b = spec->solitons[j].speed;
            if (fabs(a - b) <= nearly * (a + b))
                return false;
        }
    }
    return true;
}

/* Exponent of the subset: the sum of k_i (x - x_i), less the shifts by solitons to the left, plus those of pairs in the subset. */
static double exponent(const struct bead_equation_spec *spec, unsigned subset, double x, double *slope)
{
    double sum = 0;
    *slope = 0;
    for (size_t i = 0; i < spec->soliton_count; i++) {
        if (!(subset >> i & 1))
            continue;
        double k = wave_number(spec, i);
        *slope += k;
        sum += k * (x - spec->solitons[i].at);
        for (size_t j = 0; j < spec->soliton_count; j++) {
            if (spec->solitons[j].at < spec->solitons[i].at)
                sum -= pair_shift(spec, i, j);
            if (j < i && subset >> j & 1)
                sum += pair_shift(spec, i, j);
        }
    }
    return sum;
}

/* R. Hirota, Phys. Rev. Lett. 27, 1192 (1971): u = (12 b / a) d^2/dx^2 ln F, F the sum over all subsets of the solitons of
 * exp(exponent). As exponents are linear in x, that derivative is the variance of their slopes under these weights. */
static double hirota(const struct bead_equation_spec *spec, double x)
{
    unsigned subsets = 1u << spec->soliton_count;
    double slope, top = 0;
    bead_wide weight = 0, mean = 0, square = 0;
    for (unsigned s = 1; s < subsets; s++)
        top = fmax(top, exponent(spec, s, x, &slope));
    for (unsigned s = 0; s < subsets; s++) {
        bead_wide w = bead_wide_exp(exponent(spec, s, x, &slope) - top);
        bead_wide shift = w * slope;
        weight += w;
        mean += shift;
        square += shift * slope;
    }
    mean /= weight;
    return (double)(12 * spec->dispersion / spec->nonlinearity * (square / weight - mean * mean));
}

/* Solitons of equal speed, or far from each other: their sum. */
static double sum_of_solitons(const struct bead_equation_spec *spec, double x)
{
    double sum = 0;
    for (size_t i = 0; i < spec->soliton_count; i++)
        sum += bead_kdv_soliton_amplitude(spec, spec->solitons[i].speed) *
               bead_sech2(0.5 * wave_number(spec, i) * (x - spec->solitons[i].at));
    return sum;
}

/* u at time 0 and place x of the domain; pulses and solitons with their images in the neighbouring periods. */
static double start_at(const struct bead_equation_spec *spec, double x)
{
    double sum = 0;
    if (spec->start == BEAD_START_COSINE)
        return spec->amplitude * (double)bead_wide_cos(2 * bead_wide_pi * spec->mode * ((x - spec->low) / spec->length));
    bool exact = spec->soliton_count > 1 && speeds_differ(spec);
    for (int image = -1; image <= 1; image++) {
        double there = x + image * spec->length;
        if (spec->start == BEAD_START_PULSE)
            sum += spec->amplitude * bead_sech2((there - spec->at) / spec->width);
        else
            sum += exact ? hirota(spec, there) : sum_of_solitons(spec, there);
    }
    return sum;
}

double bead_kdv_highest(const struct bead_equation_spec *spec)
{
    double sum = 0;
    if (spec->start != BEAD_START_SOLITONS) /* no soliton becomes higher than twice the range of the start */
        return (spec->start == BEAD_START_COSINE ? 3 : 2) * fabs(spec->amplitude);
    for (size_t i = 0; i < spec->soliton_count; i++)
        sum = fmax(sum, fabs(bead_kdv_soliton_amplitude(spec, spec->solitons[i].speed)));
    return sum;
}

double bead_kdv_sharpest(const struct bead_equation_spec *spec)
{
    double range = (spec->start == BEAD_START_COSINE ? 4 : spec->start == BEAD_START_PULSE ? 2 : 0) * fabs(spec->amplitude);
    double own = 0;
    if (spec->start == BEAD_START_PULSE)
        own = 1 / spec->width;
    for (size_t i = 0; i < spec->soliton_count && spec->start == BEAD_START_SOLITONS; i++)
        own = fmax(own, 0.5 * wave_number(spec, i));
    double later = spec->dispersion != 0 ? sqrt(fabs(spec->nonlinearity * range / (12 * spec->dispersion))) : 0;
    return fmax(own, later);
}

size_t bead_kdv_points(const struct bead_equation_spec *spec, double accuracy)
{
    if (spec->points)
        return spec->points;
    /* The spectrum of sech^2(s x) falls as (k / s) exp(-pi k / (2 s)); 5 allows for the other factors. */
    double digits = bead_log(1 / accuracy) + 5;
    double modes = 2 / (double)bead_wide_pi * bead_kdv_sharpest(spec) * digits * spec->length / (2 * (double)bead_wide_pi);
    if (spec->start == BEAD_START_COSINE)
        modes = fmax(modes, 4 * (double)spec->mode);
    double least = 32, most = BEAD_KDV_POINTS_MAX;
    return bead_spectral_length((size_t)fmin(fmax(3 * modes + 1, least), most));
}

/* ---- steps ---- */

/* Steps are compared with two halves once in COMPARE_EVERY. Their lengths are the longest times powers of sqrt(1/2), so that they
 * change rarely. An error grows with time (a wave with a wrong speed runs away), hence the margin. */
enum { COMPARE_EVERY = 16 };
static const double notch = 0.70710678118654752, margin = 3, rounding = 4e-15, last_sliver = 1e-9;
/* Limits beyond which the results mean nothing. */
static const double momentum_limit = 0.01, tail_limit = 0.02, tail_by_accuracy = 1000;

/* N(u) = -(a / 2) i k (u^2)_k */
static void slope(void *context, const struct bead_complex *u, struct bead_complex *out)
{
    struct bead_kdv *kdv = context;
    struct bead_spectral *s = &kdv->spectral;
    double factor = 0.5 * kdv->spec->nonlinearity;
    bead_spectral_to_grid(s, u);
    for (size_t i = 0; i < s->points; i++)
        s->grid[i] *= s->grid[i];
    bead_spectral_to_modes(s, out);
    for (size_t j = 0; j <= s->modes; j++) {
        double k = factor * kdv->wave_number[j];
        out[j] = (struct bead_complex){k * out[j].im, -k * out[j].re};
    }
    kdv->evaluations++;
}

static void rows(const struct bead_kdv *kdv, double h, struct bead_etd_row *to)
{
    bead_etd_rows(kdv->omega, kdv->spectral.modes, h, to);
}

static void move(struct bead_kdv *kdv, const struct bead_etd_row *with, const struct bead_complex *from, struct bead_complex *to)
{
    bead_etd_step(with, kdv->spectral.modes, slope, kdv, &kdv->work, from, to);
}

static void use_step(struct bead_kdv *kdv, double h)
{
    kdv->h = h;
    rows(kdv, h, kdv->rows);
    rows(kdv, 0.5 * h, kdv->half_rows);
}

static double square(struct bead_complex z)
{
    return z.re * z.re + z.im * z.im;
}

/* ---- beginning ---- */

static enum bead_error allocate(struct bead_kdv *kdv, size_t points, struct bead_message *msg)
{
    BEAD_TRY(bead_spectral_create(points, &kdv->spectral, msg));
    size_t n = kdv->spectral.modes + 1, series = 12;
    size_t bytes =
        n * (sizeof(struct bead_pair) + 3 * sizeof(struct bead_etd_row) + series * sizeof(struct bead_complex) + sizeof(double));
    char *memory = kdv->memory = calloc(1, bytes);
    if (!memory)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a grid of %zu points", points);
    kdv->omega = (struct bead_pair *)(void *)memory;
    struct bead_etd_row *row = (struct bead_etd_row *)(void *)(kdv->omega + n);
    kdv->rows = row, kdv->half_rows = row + n, kdv->other_rows = row + 2 * n;
    struct bead_complex *next = (struct bead_complex *)(void *)(row + 3 * n);
    struct bead_complex **const all[] = {&kdv->start.u,       &kdv->start.slope,   &kdv->end.u,         &kdv->end.slope,
                                         &kdv->one,           &kdv->two,           &kdv->work.a,        &kdv->work.b,
                                         &kdv->work.slope[0], &kdv->work.slope[1], &kdv->work.slope[2], &kdv->work.slope[3]};
    for (size_t i = 0; i < series; i++, next += n)
        *all[i] = next;
    kdv->wave_number = (double *)(void *)next;
    return BEAD_OK;
}

/* Set the start; returns the part of the integral of u^2 that is not in the modes kept. */
static double kdv_solver_begin(struct bead_kdv *kdv)
{
    const struct bead_equation_spec *spec = kdv->spec;
    struct bead_spectral *s = &kdv->spectral;
    for (size_t i = 0; i < s->points; i++)
        s->grid[i] = start_at(spec, spec->low + spec->length * (double)i / (double)s->points);
    double whole = 0, kept = 0;
    for (size_t i = 0; i < s->points; i++)
        whole += s->grid[i] * s->grid[i] / (double)s->points;
    bead_spectral_to_modes(s, kdv->end.u);
    for (size_t j = 0; j <= s->modes; j++)
        kept += (j ? 2 : 1) * square(kdv->end.u[j]);
    kdv->mean = kdv->end.u[0].re;
    kdv->end.u[0] = (struct bead_complex){0, 0};
    for (size_t j = 0; j <= s->modes; j++) {
        bead_wide k = 2 * bead_wide_pi * j / spec->length;
        bead_wide drift = spec->drift + (bead_wide)spec->nonlinearity * kdv->mean;
        kdv->wave_number[j] = (double)k;
        kdv->omega[j] = bead_wide_pair(k * (spec->dispersion * k * k - drift));
    }
    slope(kdv, kdv->end.u, kdv->end.slope);
    return whole > 0 ? fabs(1 - kept / whole) : 0;
}

static double sum_of_squares(const struct bead_kdv *kdv)
{
    double sum = 0;
    for (size_t j = 1; j <= kdv->spectral.modes; j++)
        sum += square(kdv->end.u[j]);
    return sum;
}

/* The largest of the highest eighth of the modes, relative to the largest of all. */
static double tail_of(const struct bead_kdv *kdv)
{
    double most = 0, high = 0;
    size_t modes = kdv->spectral.modes, from = modes - modes / 8;
    for (size_t j = 1; j <= modes; j++) {
        double size = square(kdv->end.u[j]);
        most = fmax(most, size);
        high = j >= from ? fmax(high, size) : high;
    }
    return most > 0 ? sqrt(high / most) : 0;
}

/* The errors of all steps together meet the accuracy if each step makes no more than its share, by time. No step is longer than the
 * time in which the nonlinearity could turn the phase of the shortest waves by 1 rad. */
static void choose_step(struct bead_kdv *kdv, const struct bead_motion_settings *settings)
{
    const struct bead_equation_spec *spec = kdv->spec;
    double speed = fabs(spec->nonlinearity) * bead_kdv_highest(spec), run = settings->end;
    double crossing = spec->length / (speed > 0 ? speed : 1), top = kdv->wave_number[kdv->spectral.modes];
    kdv->tolerance = margin * settings->accuracy / (isfinite(run) ? run : 10 * crossing);
    kdv->longest =
        fmin((settings->part > 0 ? settings->part : 1) / (top * (speed > 0 ? speed : 1)), isfinite(run) ? run : INFINITY);
    kdv->fixed = settings->step > 0;
    kdv->end_of_run = settings->end;
    use_step(kdv, kdv->fixed ? settings->step : kdv->longest);
}

static enum bead_error kdv_solver_check(struct bead_kdv *kdv, struct bead_message *msg)
{
    double change = kdv->momentum > 0 ? fabs(sum_of_squares(kdv) / kdv->momentum - 1) : 0;
    if (!(change <= momentum_limit))
        return bead_fail(
            msg, BEAD_ERROR_NUMBERS,
            "at %.6g the integral of u^2 has a relative error of %.3g: steps of %.3g are too long, or a grid of %zu points is too "
            "coarse",
            kdv->end.t, bead_told_error(change), kdv->h, kdv->spectral.points);
    kdv->tail = fmax(kdv->tail, tail_of(kdv));
    if (kdv->tail <= kdv->tail_limit)
        return BEAD_OK;
    return bead_fail(
        msg, BEAD_ERROR_NUMBERS,
        "at %.6g the shortest waves on a grid of %zu points reach %.2g of the longest, more than %.2g: it needs more points",
        kdv->end.t, kdv->spectral.points, kdv->tail, kdv->tail_limit);
}

enum bead_error bead_kdv_create(const struct bead_motion_settings *settings, struct bead_kdv *kdv, struct bead_message *msg)
{
    *kdv = (struct bead_kdv){.spec = settings->spec};
    BEAD_TRY(allocate(kdv, settings->points, msg));
    double lost = kdv_solver_begin(kdv);
    if (!(lost <= momentum_limit))
        return bead_fail(msg, BEAD_ERROR_NUMBERS,
                         "a grid of %zu points is too coarse for the start: it loses %.2g of the integral of u^2", settings->points,
                         lost);
    kdv->momentum = sum_of_squares(kdv);
    kdv->tail_limit = settings->spec->points ? tail_limit : fmin(tail_limit, tail_by_accuracy * settings->accuracy);
    choose_step(kdv, settings);
    return kdv_solver_check(kdv, msg);
}

void bead_kdv_destroy(struct bead_kdv *kdv)
{
    bead_spectral_destroy(&kdv->spectral);
    free(kdv->memory);
    *kdv = (struct bead_kdv){0};
}

/* ---- steps ---- */

static void copy(const struct bead_kdv *kdv, const struct bead_complex *from, struct bead_complex *to)
{
    memcpy(to, from, (kdv->spectral.modes + 1) * sizeof *from);
}

/* The relative error of a step of h from start; leaves its result in `one`. */
static double compare(struct bead_kdv *kdv)
{
    double error = 0, most = 0;
    copy(kdv, kdv->start.slope, kdv->work.slope[0]);
    move(kdv, kdv->rows, kdv->start.u, kdv->one);
    copy(kdv, kdv->start.slope, kdv->work.slope[0]);
    move(kdv, kdv->half_rows, kdv->start.u, kdv->two);
    slope(kdv, kdv->two, kdv->work.slope[0]);
    move(kdv, kdv->half_rows, kdv->two, kdv->two);
    for (size_t j = 1; j <= kdv->spectral.modes; j++) {
        struct bead_complex a = kdv->one[j], b = kdv->two[j];
        error += square((struct bead_complex){a.re - b.re, a.im - b.im});
        most += square(b);
    }
    return most > 0 ? 16. / 15 * sqrt(error / most) : 0;
}

/* Shorten steps until the error is within its bound; lengthen them if the longer step's error would be well below it. */
static void adapt(struct bead_kdv *kdv)
{
    double spare = notch * notch * notch * notch * 0.5;
    for (;;) {
        double error = compare(kdv), allowed = fmax(kdv->tolerance * kdv->h, rounding);
        if (!(error <= allowed) && kdv->h > 1e-12 * kdv->longest) {
            use_step(kdv, kdv->h * notch);
            continue;
        }
        if (error < spare * allowed && kdv->h < 0.9 * kdv->longest)
            use_step(kdv, kdv->h / notch); /* without another comparison: the order tells the error of longer steps */
        return;
    }
}

enum bead_error bead_kdv_step(struct bead_kdv *kdv, struct bead_message *msg)
{
    struct bead_kdv_state old = kdv->start;
    kdv->start = kdv->end;
    kdv->end = old;
    double t = kdv->start.t;
    const struct bead_etd_row *with = kdv->rows;
    if (!kdv->fixed && kdv->steps % COMPARE_EVERY == 0)
        adapt(kdv);
    kdv->end.t = t + kdv->h;
    if (kdv->end.t > kdv->end_of_run - last_sliver * kdv->h) { /* the last step */
        kdv->end.t = kdv->end_of_run;
        rows(kdv, kdv->end.t - t, kdv->other_rows);
        with = kdv->other_rows;
    }
    copy(kdv, kdv->start.slope, kdv->work.slope[0]);
    move(kdv, with, kdv->start.u, kdv->end.u);
    slope(kdv, kdv->end.u, kdv->end.slope);
    kdv->steps++;
    return kdv_solver_check(kdv, msg);
}

const double *bead_kdv_grid(const struct bead_kdv *kdv, const struct bead_complex *modes)
{
    struct bead_spectral scratch = kdv->spectral;
    bead_spectral_to_grid(&scratch, modes);
    for (size_t i = 0; i < scratch.points; i++)
        scratch.grid[i] += kdv->mean;
    return scratch.grid;
}

void bead_kdv_values(struct bead_kdv *kdv, double t)
{
    const struct bead_complex *u = kdv->end.u;
    double h = t - kdv->start.t;
    if (t < kdv->end.t && kdv->steps > 0) {
        bead_etd_rows(kdv->omega, kdv->spectral.modes, h, kdv->other_rows);
        copy(kdv, kdv->start.slope, kdv->work.slope[0]);
        move(kdv, kdv->other_rows, kdv->start.u, kdv->one);
        u = kdv->one;
    }
    bead_kdv_grid(kdv, u);
}
