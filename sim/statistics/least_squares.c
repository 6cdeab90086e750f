/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The search for least squares: see least_squares.h. */
#include "sim/statistics/least_squares.h"

#include <math.h>

#include "sim/base/memory.h"
#include "sim/base/thread_pool.h"

enum { MOST_ROUNDS = 50, MOST_GUESSES = 40 };
static const double change = 1e-3;     /* of the residuals, by the steps of differences */
static const double least_gain = 1e-8; /* steps end where they are so short in standard errors, squared */

struct search {
    struct bead_least_squares *fit;
    double *r, *trial;   /* [points] */
    double *x, *step;    /* [parameters]: those of the trial; of differences */
    double *sides;       /* [2 parameters][points] */
    double *matrix, *l;  /* [parameters][parameters]: J'J, and its factor */
    double *slope, *way; /* [parameters]: J'r, and the step */
};

static double dot(const double *a, const double *b, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += a[i] * b[i];
    return sum;
}

/* ---- derivatives ---- */

static enum bead_error find_side(void *context, size_t index, bool, struct bead_message *msg)
{
    const struct search *s = context;
    const struct bead_least_squares *f = s->fit;
    const size_t k = index / 2;
    BEAD_FREED double *x;
    BEAD_TRY(bead_new(&x, f->parameters, msg, "a fit"));
    memcpy(x, f->x, f->parameters * sizeof *x);
    x[k] += index % 2 ? s->step[k] : -s->step[k];
    return f->residuals(f->context, x, s->sides + index * f->points, msg);
}

/* A step that changes the residuals by about as much as it should, from 1e-3 of the value, or from nothing. */
static enum bead_error guess_step(void *context, size_t k, bool, struct bead_message *msg)
{
    const struct search *s = context;
    const struct bead_least_squares *f = s->fit;
    double *side = s->sides + 2 * k * f->points;
    s->step[k] = f->x[k] != 0 ? change * fabs(f->x[k]) : 1e-12;
    for (size_t i = 0; i < MOST_GUESSES; i++) {
        double moved = 0;
        BEAD_TRY(find_side(context, 2 * k, false, msg));
        for (size_t p = 0; p < f->points; p++)
            moved += (side[p] - s->r[p]) * (side[p] - s->r[p]);
        moved = sqrt(moved) / (change * f->size);
        if (moved > 0.1 && moved < 10)
            return BEAD_OK;
        s->step[k] *= moved > 0.1 ? 1 / moved : 10;
        if (moved < 0.1 && f->x[k] != 0 && s->step[k] > fabs(f->x[k]))
            break;
    }
    return bead_fail(msg, BEAD_ERROR_NUMBERS, "fit: %s changes nothing that was measured", f->names[k]);
}

/* J'J and J'r; the next steps. */
static enum bead_error derive(struct search *s, struct bead_message *msg)
{
    const struct bead_least_squares *f = s->fit;
    const size_t n = f->parameters;
    BEAD_TRY(bead_thread_pool_run(2 * n, f->threads, find_side, s, msg));
    for (size_t k = 0; k < n; k++) {
        double *low = s->sides + 2 * k * f->points, *high = low + f->points;
        for (size_t p = 0; p < f->points; p++)
            low[p] = (high[p] - low[p]) / (2 * s->step[k]);
        for (size_t i = 0; i <= k; i++)
            s->matrix[i * n + k] = s->matrix[k * n + i] = dot(low, s->sides + 2 * i * f->points, f->points);
        s->slope[k] = dot(low, s->r, f->points);
        if (s->matrix[k * n + k] > 0)
            s->step[k] = change * f->size / sqrt(s->matrix[k * n + k]);
    }
    return BEAD_OK;
}

/* ---- steps ---- */

/* The factor of (J'J + damping diagonal), scaled to a diagonal of 1. The first parameter that does what those before it do is an
 * error. */
static enum bead_error factor(struct search *s, double damping, struct bead_message *msg)
{
    const size_t n = s->fit->parameters;
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k <= i; k++) {
            const double scale = sqrt(s->matrix[i * n + i] * s->matrix[k * n + k]);
            const double rest = s->matrix[i * n + k] / scale + (i == k ? damping : 0) - dot(s->l + i * n, s->l + k * n, k);
            if (i == k && !(rest > 1e-12))
                return bead_fail(msg, BEAD_ERROR_NUMBERS, "fit: the measured values cannot tell %s from the other parameters",
                                 s->fit->names[i]);
            s->l[i * n + k] = i == k ? sqrt(rest) : rest / s->l[k * n + k];
        }
    }
    return BEAD_OK;
}

/* Solves for `way`, which holds the right-hand side. */
static void solve(struct search *s)
{
    const size_t n = s->fit->parameters;
    double *y = s->way;
    for (size_t i = 0; i < n; i++)
        y[i] = (y[i] / sqrt(s->matrix[i * n + i]) - dot(s->l + i * n, y, i)) / s->l[i * n + i];
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; k++)
            y[i] -= s->l[k * n + i] * y[k];
        y[i] /= s->l[i * n + i];
    }
    for (size_t i = 0; i < n; i++)
        y[i] /= sqrt(s->matrix[i * n + i]);
}

/* Tries a step; *gain: how much smaller the sum of squares is. */
static enum bead_error try_step(struct search *s, double damping, double *gain, struct bead_message *msg)
{
    struct bead_least_squares *f = s->fit;
    struct bead_message why = {""};
    *gain = -INFINITY;
    BEAD_TRY(factor(s, damping, msg));
    for (size_t k = 0; k < f->parameters; k++)
        s->way[k] = -s->slope[k];
    solve(s);
    for (size_t k = 0; k < f->parameters; k++)
        s->x[k] = f->x[k] + s->way[k];
    const enum bead_error err = f->residuals(f->context, s->x, s->trial, &why);
    if (err == BEAD_ERROR_SCENE || err == BEAD_ERROR_NUMBERS)
        return BEAD_OK;
    *gain = dot(s->r, s->r, f->points) - dot(s->trial, s->trial, f->points);
    return err ? bead_fail(msg, err, "%s", why.text) : BEAD_OK;
}

static enum bead_error descend(struct search *s, struct bead_message *msg)
{
    struct bead_least_squares *f = s->fit;
    double damping = 1e-3, gain = 0;
    for (f->rounds = 1; f->rounds <= MOST_ROUNDS; f->rounds++) {
        BEAD_TRY(derive(s, msg));
        const double noise = dot(s->r, s->r, f->points) / (double)(f->points - f->parameters);
        for (gain = -1; !(gain > 0) && damping<1e8; damping *= gain> 0 ? 0.1 : 10) {
            BEAD_TRY(try_step(s, damping, &gain, msg));
            if (gain >= 0) {
                memcpy(f->x, s->x, f->parameters * sizeof *s->x);
                memcpy(s->r, s->trial, f->points * sizeof *s->r);
            }
            if (fabs(dot(s->way, s->slope, f->parameters)) <= least_gain * noise)
                return BEAD_OK;
        }
        if (!(gain > 0)) /* the minimum, as exactly as runs are */
            return BEAD_OK;
    }
    return bead_fail(msg, BEAD_ERROR_NUMBERS, "fit: no minimum within %d rounds: start closer to it", MOST_ROUNDS);
}

/* Square roots of the diagonal of rms^2 (J'J)^-1. */
static enum bead_error find_errors(struct search *s, struct bead_message *msg)
{
    struct bead_least_squares *f = s->fit;
    f->rms = sqrt(dot(s->r, s->r, f->points) / (double)(f->points - f->parameters));
    BEAD_TRY(derive(s, msg));
    BEAD_TRY(factor(s, 0, msg));
    for (size_t k = 0; k < f->parameters; k++) {
        memset(s->way, 0, f->parameters * sizeof *s->way);
        s->way[k] = 1;
        solve(s);
        f->error[k] = f->rms * sqrt(s->way[k]);
    }
    return BEAD_OK;
}

enum bead_error bead_least_squares(struct bead_least_squares *f, struct bead_message *msg)
{
    const size_t n = f->parameters, points = f->points;
    BEAD_FREED double *memory = NULL;
    if (points <= n)
        return bead_fail(msg, BEAD_ERROR_NUMBERS, "fit: %zu points are too few for %zu parameters", points, n);
    BEAD_TRY(bead_new(&memory, 2 * (n + 1) * points + 2 * n * (n + 2), msg, "a fit"));
    struct search s = {.fit = f, .r = memory};
    s.trial = s.r + points;
    s.sides = s.trial + points;
    s.matrix = s.sides + 2 * n * points;
    s.l = s.matrix + n * n;
    s.x = s.l + n * n;
    s.step = s.x + n;
    s.slope = s.step + n;
    s.way = s.slope + n;
    BEAD_TRY(f->residuals(f->context, f->x, s.r, msg));
    BEAD_TRY(bead_thread_pool_run(n, f->threads, guess_step, &s, msg));
    BEAD_TRY(descend(&s, msg));
    return find_errors(&s, msg);
}
