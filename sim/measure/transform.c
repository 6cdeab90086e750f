/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transforms segments of curves: see transform.h. */
#include "sim/measure/transform.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/elementary.h"
#include "sim/base/memory.h"
#include "sim/base/wide.h"

static const double pi = 3.14159265358979323846;

size_t bead_transform_length(size_t n)
{
    for (size_t rest = 0; n > 1; n--) {
        rest = n;
        for (size_t p = 2; p <= 5; p++) {
            while (rest % p == 0)
                rest /= p;
        }
        if (rest == 1)
            break;
    }
    return n;
}

void bead_transform_free(struct bead_transform *t)
{
    bead_fourier_destroy(t->fourier);
    free(t->window);
    free(t->grid);
    free(t->found);
}

enum bead_error bead_transform_make(struct bead_transform *t, size_t points, enum bead_taper window, struct bead_message *msg)
{
    *t = (struct bead_transform){.points = points, .bins = points / 2 + 1};
    BEAD_TRY(bead_fourier_create(points, NULL, &t->fourier, msg));
    BEAD_TRY(bead_new(&t->window, points, msg, "a spectrum"));
    BEAD_TRY(bead_new(&t->grid, points, msg, "a spectrum"));
    BEAD_TRY(bead_new(&t->found, t->bins, msg, "a spectrum"));
    for (size_t j = 0; j < points; j++) {
        const double s = bead_sin(pi * ((double)j + 0.5) / (double)points);
        t->window[j] = window == BEAD_WINDOW_HANN ? s * s : 1;
        t->sum += t->window[j];
    }
    return BEAD_OK;
}

void bead_transform_segment(struct bead_transform *t, const double *values)
{
    double mean = 0;
    for (size_t j = 0; j < t->points; j++)
        mean += t->window[j] * values[j];
    mean /= t->sum;
    for (size_t j = 0; j < t->points; j++)
        t->grid[j] = t->window[j] * (values[j] - mean);
    bead_fourier_forward(t->fourier, t->grid, t->found);
}

enum bead_error bead_transform_reach(const double *values, size_t count, double every, double *reach, struct bead_message *msg)
{
    const double least = BEAD_TRANSFORM_LEAST * BEAD_TRANSFORM_LEAST;
    struct bead_transform whole;
    double most = 0;
    size_t last = 1;
    enum bead_error err = bead_transform_make(&whole, bead_transform_length(count), BEAD_WINDOW_HANN, msg);
    if (!err) {
        bead_transform_segment(&whole, values);
        for (size_t k = 0; k < whole.bins; k++)
            most = fmax(most, bead_complex_square(whole.found[k]));
        for (size_t k = 1; k < whole.bins; k++)
            last = bead_complex_square(whole.found[k]) > least * most ? k : last;
    }
    *reach = (double)last / ((double)whole.points * every);
    bead_transform_free(&whole);
    return err;
}
