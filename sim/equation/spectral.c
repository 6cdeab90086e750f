/* Fourier transforms by FFTW. The equations on a ring (KdV) take derivatives and products with them. */
#include "sim/equation/spectral.h"

#include <fftw3.h>
#include <math.h>
#include <pthread.h>
#include <string.h>

/* FFTW's planner, unlike its transforms, keeps tables that all threads share. */
static pthread_mutex_t planner = PTHREAD_MUTEX_INITIALIZER;

/* Plans by estimate, not by the clock, and no vector code: the same sums on every machine. */
static const unsigned same_everywhere = FFTW_ESTIMATE | FFTW_NO_SIMD;

enum bead_error bead_spectral_create(size_t points, struct bead_spectral *s, struct bead_message *msg)
{
    *s = (struct bead_spectral){.points = points, .modes = (points - 1) / 3};
    s->grid = fftw_alloc_real(points);
    s->bins = (struct bead_complex *)fftw_alloc_complex(points / 2 + 1);
    if (s->grid && s->bins) {
        pthread_mutex_lock(&planner);
        s->to_grid = fftw_plan_dft_c2r_1d((int)points, (fftw_complex *)s->bins, s->grid, same_everywhere);
        s->to_modes = fftw_plan_dft_r2c_1d((int)points, s->grid, (fftw_complex *)s->bins, same_everywhere);
        pthread_mutex_unlock(&planner);
    }
    if (s->to_grid && s->to_modes)
        return BEAD_OK;
    bead_spectral_destroy(s);
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for Fourier transforms of %zu points", points);
}

void bead_spectral_destroy(struct bead_spectral *s)
{
    pthread_mutex_lock(&planner);
    if (s->to_grid)
        fftw_destroy_plan(s->to_grid);
    if (s->to_modes)
        fftw_destroy_plan(s->to_modes);
    pthread_mutex_unlock(&planner);
    fftw_free(s->grid);
    fftw_free(s->bins);
    *s = (struct bead_spectral){0};
}

void bead_spectral_to_grid(struct bead_spectral *s, const struct bead_complex *c)
{
    memcpy(s->bins, c, (s->modes + 1) * sizeof *c);
    memset(s->bins + s->modes + 1, 0, (s->points / 2 - s->modes) * sizeof *c);
    fftw_execute(s->to_grid);
}

void bead_spectral_to_modes(struct bead_spectral *s, struct bead_complex *c)
{
    double scale = 1 / (double)s->points;
    fftw_execute(s->to_modes);
    for (size_t j = 0; j <= s->modes; j++)
        c[j] = (struct bead_complex){scale * s->bins[j].re, scale * s->bins[j].im};
}

void bead_spectral_at(const struct bead_complex *c, size_t modes, double phase, double value[3])
{
    value[0] = c[0].re;
    value[1] = value[2] = 0;
    for (size_t j = 1; j <= modes; j++) {
        double k = (double)j, co = (double)cosl(k * (long double)phase), si = (double)sinl(k * (long double)phase);
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
