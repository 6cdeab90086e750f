/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions on a ring as Fourier series, for derivatives and products in equations on a ring (KdV). */
#include "sim/equation/spectral.h"

#include <stdlib.h>

#include "sim/base/elementary.h"
#include "sim/base/memory.h"

enum bead_error bead_spectral_create(size_t points, struct bead_spectral *s, struct bead_message *msg)
{
    *s = (struct bead_spectral){.points = points, .modes = (points - 1) / 3};
    BEAD_TRY(bead_fourier_create(points, NULL, &s->fourier, msg));
    BEAD_TRY(bead_new(&s->grid, points, msg, "a grid of %zu points", points));
    return bead_new(&s->bins, points / 2 + 1, msg, "a grid of %zu points", points);
}

void bead_spectral_destroy(struct bead_spectral *s)
{
    bead_fourier_destroy(s->fourier);
    free(s->grid);
    free(s->bins);
    *s = (struct bead_spectral){0};
}

void bead_spectral_to_grid(struct bead_spectral *s, const struct bead_complex *c)
{
    memcpy(s->bins, c, (s->modes + 1) * sizeof *c);
    memset(s->bins + s->modes + 1, 0, (s->points / 2 - s->modes) * sizeof *c);
    bead_fourier_backward(s->fourier, s->bins, s->grid);
}

void bead_spectral_to_modes(struct bead_spectral *s, struct bead_complex *c)
{
    double scale = 1 / (double)s->points;
    bead_fourier_forward(s->fourier, s->grid, s->bins);
    for (size_t j = 0; j <= s->modes; j++)
        c[j] = (struct bead_complex){scale * s->bins[j].re, scale * s->bins[j].im};
}

void bead_spectral_at(const struct bead_complex *c, size_t modes, double phase, double value[3])
{
    value[0] = c[0].re;
    value[1] = value[2] = 0;
    for (size_t j = 1; j <= modes; j++) {
        double k = (double)j, co, si;
        bead_turn_to(bead_pair_times((struct bead_pair){phase, 0}, k), &co, &si);
        double re = 2 * (c[j].re * co - c[j].im * si), im = 2 * (c[j].re * si + c[j].im * co);
        value[0] += re;
        value[1] -= k * im;
        value[2] -= k * k * re;
    }
}

size_t bead_spectral_length(size_t n)
{
    for (n += n % 2;; n += 2) {
        size_t rest = n;
        while (rest % 2 == 0)
            rest /= 2;
        while (rest % 3 == 0)
            rest /= 3;
        while (rest % 5 == 0)
            rest /= 5;
        if (rest == 1)
            return n;
    }
}
