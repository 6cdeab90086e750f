#include "sim/equation/kdv_start.h"

#include <math.h>
#include <stdbool.h>

#include "sim/equation/spectral.h"

static const long double pi = 3.141592653589793238462643383279503L;

static double sech2(double x)
{
    long double c = coshl((long double)x);
    return (double)(1 / (c * c));
}

double bead_kdv_soliton_amplitude(const struct bead_equation_spec *spec, double speed)
{
    return 3 * speed / spec->nonlinearity;
}

static double wave_number(const struct bead_equation_spec *spec, size_t i)
{
    return sqrt(spec->solitons[i].speed / spec->dispersion);
}

/* ln((k - l) / (k + l))^2: what a pair is apart in phase when one has passed the other. */
static double pair_shift(const struct bead_equation_spec *spec, size_t i, size_t j)
{
    double k = wave_number(spec, i), l = wave_number(spec, j), part = (k - l) / (k + l);
    return (double)logl((long double)(part * part));
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

/* Exponent of the subset: the sum of k_i (x - x_i), less what solitons to the left shift them, and of the pairs. */
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
    long double weight = 0, mean = 0, square = 0;
    for (unsigned s = 1; s < subsets; s++)
        top = fmax(top, exponent(spec, s, x, &slope));
    for (unsigned s = 0; s < subsets; s++) {
        long double w = expl((long double)(exponent(spec, s, x, &slope) - top));
        long double shift = w * slope;
        weight += w;
        mean += shift;
        square += shift * slope;
    }
    mean /= weight;
    return (double)(12 * spec->dispersion / spec->nonlinearity * (square / weight - mean * mean));
}

/* As many times the same speed, or solitons far from each other: their sum. */
static double sum_of_solitons(const struct bead_equation_spec *spec, double x)
{
    double sum = 0;
    for (size_t i = 0; i < spec->soliton_count; i++)
        sum += bead_kdv_soliton_amplitude(spec, spec->solitons[i].speed) *
               sech2(0.5 * wave_number(spec, i) * (x - spec->solitons[i].at));
    return sum;
}

double bead_kdv_start(const struct bead_equation_spec *spec, double x)
{
    double sum = 0;
    if (spec->start == BEAD_START_COSINE)
        return spec->amplitude * (double)cosl(2 * pi * (long double)spec->mode * (long double)((x - spec->low) / spec->length));
    bool exact = spec->soliton_count > 1 && speeds_differ(spec);
    for (int image = -1; image <= 1; image++) {
        double there = x + image * spec->length;
        if (spec->start == BEAD_START_PULSE)
            sum += spec->amplitude * sech2((there - spec->at) / spec->width);
        else
            sum += exact ? hirota(spec, there) : sum_of_solitons(spec, there);
    }
    return sum;
}

double bead_kdv_highest(const struct bead_equation_spec *spec)
{
    double sum = 0;
    if (spec->start != BEAD_START_SOLITONS) /* no soliton is higher than twice the range of the start */
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
    /* The spectrum of sech^2(s x) falls as (k / s) exp(-pi k / (2 s)); as much again of digits for its other factors. */
    double digits = (double)logl(1 / (long double)accuracy) + 5;
    double modes = 2 / (double)pi * bead_kdv_sharpest(spec) * digits * spec->length / (2 * (double)pi);
    if (spec->start == BEAD_START_COSINE)
        modes = fmax(modes, 4 * (double)spec->mode);
    double least = 32, most = BEAD_KDV_POINTS_MAX;
    return bead_spectral_length((size_t)fmin(fmax(3 * modes + 1, least), most));
}
