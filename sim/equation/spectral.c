/* Fourier series through FFTW, see spectral.h, for kdv_solver.c. */
#include "sim/equation/spectral.h"

#include <fftw3.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/library.h"

/* FFTW's planner, unlike its transforms, keeps tables that all threads share. */
static pthread_mutex_t planner = PTHREAD_MUTEX_INITIALIZER;

/* Plans by estimate, not by the clock, and no vector code: the same sums on every machine. */
static const unsigned same_everywhere = FFTW_ESTIMATE | FFTW_NO_SIMD;

enum { FUNCTIONS = 7 };

/* Opened when first needed: programs start a millisecond earlier without it. */
struct bead_fftw {
    union {
        struct {
            double *(*alloc_real)(size_t);
            fftw_complex *(*alloc_complex)(size_t);
            void (*free)(void *);
            fftw_plan (*plan_to_grid)(int, fftw_complex *, double *, unsigned);
            fftw_plan (*plan_to_modes)(int, double *, fftw_complex *, unsigned);
            void (*destroy_plan)(fftw_plan);
            void (*execute)(const fftw_plan);
        };
        void (*loaded[FUNCTIONS])(void);
    };
};

static enum bead_error load(struct bead_fftw *fftw, struct bead_message *msg)
{
    static const char *const names[FUNCTIONS] = {"fftw_alloc_real",      "fftw_alloc_complex",   "fftw_free",
                                                 "fftw_plan_dft_c2r_1d", "fftw_plan_dft_r2c_1d", "fftw_destroy_plan",
                                                 "fftw_execute"};
    static const char *const files[] = {"libfftw3.so.3", NULL};
    struct bead_message why;
    if (bead_library_load(files, names, FUNCTIONS, fftw->loaded, &why))
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "Fourier transforms need FFTW 3: %s", why.text);
    return BEAD_OK;
}

enum bead_error bead_spectral_create(size_t points, struct bead_spectral *s, struct bead_message *msg)
{
    *s = (struct bead_spectral){.points = points, .modes = (points - 1) / 3};
    struct bead_fftw *f = s->fftw = calloc(1, sizeof *f);
    enum bead_error err = f ? load(f, msg) : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for Fourier transforms");
    if (err) {
        free(f);
        *s = (struct bead_spectral){0};
        return err;
    }
    s->grid = f->alloc_real(points);
    s->bins = (struct bead_complex *)f->alloc_complex(points / 2 + 1);
    if (s->grid && s->bins) {
        pthread_mutex_lock(&planner);
        s->to_grid = f->plan_to_grid((int)points, (fftw_complex *)s->bins, s->grid, same_everywhere);
        s->to_modes = f->plan_to_modes((int)points, s->grid, (fftw_complex *)s->bins, same_everywhere);
        pthread_mutex_unlock(&planner);
    }
    if (s->to_grid && s->to_modes)
        return BEAD_OK;
    bead_spectral_destroy(s);
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for Fourier transforms of %zu points", points);
}

void bead_spectral_destroy(struct bead_spectral *s)
{
    const struct bead_fftw *f = s->fftw;
    if (!f)
        return;
    pthread_mutex_lock(&planner);
    if (s->to_grid)
        f->destroy_plan(s->to_grid);
    if (s->to_modes)
        f->destroy_plan(s->to_modes);
    pthread_mutex_unlock(&planner);
    f->free(s->grid);
    f->free(s->bins);
    free(s->fftw);
    *s = (struct bead_spectral){0};
}

void bead_spectral_to_grid(struct bead_spectral *s, const struct bead_complex *c)
{
    memcpy(s->bins, c, (s->modes + 1) * sizeof *c);
    memset(s->bins + s->modes + 1, 0, (s->points / 2 - s->modes) * sizeof *c);
    s->fftw->execute(s->to_grid);
}

void bead_spectral_to_modes(struct bead_spectral *s, struct bead_complex *c)
{
    double scale = 1 / (double)s->points;
    s->fftw->execute(s->to_modes);
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
