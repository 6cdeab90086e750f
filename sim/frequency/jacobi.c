/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eigenvalues by bisection, and vectors. */
#include "sim/frequency/jacobi.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"

static const double turn = 2 * 3.14159265358979323846;

enum bead_error bead_jacobi_create(const double *masses, const double *springs, const double *held, size_t count, bool open,
                                   struct bead_jacobi *matrix, struct bead_message *msg)
{
    *matrix = (struct bead_jacobi){.count = count};
    BEAD_TRY(bead_new(&matrix->diagonal, 2 * count, msg, "%zu modes", count));
    matrix->beside = matrix->diagonal + count;
    for (size_t j = 0; j < count; j++) {
        const size_t next = (j + 1) % count;
        const double before = j > 0 || !open ? springs[(j + count - 1) % count] : 0;
        matrix->diagonal[j] = (before + springs[j] + (held ? held[j] : 0)) / masses[j];
        matrix->beside[j] = open && next == 0 ? 0 : -springs[j] / sqrt(masses[j] * masses[next]);
    }
    for (size_t j = 0; j < count; j++) {
        const double beside = fabs(matrix->beside[j]) + fabs(matrix->beside[(j + count - 1) % count]);
        matrix->bound = fmax(matrix->bound, matrix->diagonal[j] + beside); /* Gershgorin */
    }
    return BEAD_OK;
}

void bead_jacobi_free(struct bead_jacobi *matrix)
{
    free(matrix->diagonal);
    *matrix = (struct bead_jacobi){0};
}

/* A pivot of 0 counts as a tiny one above. */
static double pivot(const struct bead_jacobi *m, double value)
{
    const double least = DBL_EPSILON * DBL_EPSILON * m->bound;
    return fabs(value) < least ? least : value;
}

/* The number of eigenvalues below `value`. Eliminating row by row fills the last one: its element over the next row is `fill` times
 * the phase. */
static size_t count_below(const struct bead_jacobi *m, double value, double cosine)
{
    const size_t n = m->count;
    double d = m->diagonal[0] - value, fill = m->beside[n - 1], last = m->diagonal[n - 1] - value;
    size_t below = 0;
    if (n == 1)
        return d + 2 * fill * cosine < 0;
    for (size_t j = 0; j + 2 < n; j++) {
        d = pivot(m, d);
        below += d < 0;
        last -= fill * fill / d;
        fill = -fill * m->beside[j] / d;
        d = m->diagonal[j + 1] - value - m->beside[j] * m->beside[j] / d;
    }
    d = pivot(m, d);
    below += d < 0;
    const double both = m->beside[n - 2];
    last -= (both * both + fill * fill + 2 * both * fill * cosine) / d;
    return below + (last < 0);
}

double bead_jacobi_frequency(const struct bead_jacobi *m, size_t index, double cosine)
{
    const double noise = 4 * (double)m->count * DBL_EPSILON * m->bound;
    double low = -noise, high = m->bound + noise;
    for (;;) {
        const double middle = low + 0.5 * (high - low);
        if (middle <= low || middle >= high || high - low < 0.25 * DBL_EPSILON * high)
            return middle > noise ? sqrt(middle) / turn : 0;
        if (count_below(m, middle, cosine) > index)
            high = middle;
        else
            low = middle;
    }
}

void bead_jacobi_vector(const struct bead_jacobi *m, double frequency, double *vector, double *work)
{
    const size_t n = m->count;
    const double value = (turn * frequency) * (turn * frequency);
    double *down = work, *up = work + n, least = INFINITY, length = 0;
    size_t meet = 0;
    down[0] = pivot(m, m->diagonal[0] - value);
    for (size_t j = 1; j < n; j++)
        down[j] = pivot(m, m->diagonal[j] - value - m->beside[j - 1] * m->beside[j - 1] / down[j - 1]);
    up[n - 1] = pivot(m, m->diagonal[n - 1] - value);
    for (size_t j = n - 1; j-- > 0;)
        up[j] = pivot(m, m->diagonal[j] - value - m->beside[j] * m->beside[j] / up[j + 1]);
    for (size_t j = 0; j < n; j++) {
        const double residual = fabs(down[j] + up[j] - (m->diagonal[j] - value));
        meet = residual < least ? j : meet;
        least = fmin(least, residual);
    }
    vector[meet] = 1;
    for (size_t j = meet; j-- > 0;)
        vector[j] = -m->beside[j] / down[j] * vector[j + 1];
    for (size_t j = meet + 1; j < n; j++)
        vector[j] = -m->beside[j - 1] / up[j] * vector[j - 1];
    for (size_t j = 0; j < n; j++)
        length += vector[j] * vector[j];
    for (size_t j = 0; j < n; j++)
        vector[j] /= sqrt(length);
}
