/* Estimates the uncertainty of peaks from two runs, see uncertainty.h. */
#include "sim/run/uncertainty.h"

#include <math.h>
#include <stdbool.h>

/* Differences up to this many times what was asked are those of peaks as they should be: a comparison run at ten times the
 * tolerance is as accurate as it was asked to be. They count twice, so that errors of both runs that happen to be alike do no harm;
 * larger ones three times. */
static const double usual = 10, twice = 2, thrice = 3;
/* A relative difference that is larger than both has stopped growing in proportion to the errors: that much, and that many times
 * what was asked. Such differences count ten times: nobody knows what the next one would be. */
static const double chaotic = 5e-3, chaotic_times = 100, chaos = 10;
/* They spoil the peaks of so many contacts on either side, this part of the way on from one to the next. */
enum { NEAR = 12 };
static const double next = 0.75;
/* Steps given by hand: a difference is the error of the longer steps. Rounding leaves this part of a peak. */
static const double rounding = 1e-14;

/* Difference of the two runs, relative to the peak. */
static double difference(const struct bead_peak *a, const struct bead_peak *b)
{
    const double largest = fmax(fabs(a->value), fabs(b->value));
    return largest > 0 ? fabs(a->value - b->value) / fabs(a->value > 0 ? a->value : largest) : 0;
}

/* The relative uncertainty that a peak's own difference means, in units of what was asked. */
static double response(double times)
{
    return fmax(fmax(1, fmin(twice * times, usual)), thrice * times - twice * usual);
}

/* The largest difference of chaotic peaks near peak i. */
static double chaos_near(const struct bead_peak *peaks, const struct bead_peak *comparison, size_t count, size_t i, double limit)
{
    double most = 0;
    for (size_t j = i > NEAR ? i - NEAR : 0; j < count && j <= i + NEAR; j++) {
        const double d = difference(&peaks[j], &comparison[j]);
        if (d > limit)
            most = fmax(most, d * pow(next, fabs((double)i - (double)j)));
    }
    return most;
}

void bead_uncertainty_find(const struct bead_uncertainty_of *of, const struct bead_peak *peaks, const struct bead_peak *comparison,
                           size_t count, double *uncertainty)
{
    /* What a comparison run at ten times the tolerance would differ by. */
    const double scale = of->accuracy > 0 && of->tolerance_factor > 1 ? 10 / of->tolerance_factor : 1;
    const double limit = fmax(chaotic, chaotic_times * of->accuracy);
    bool any = false;
    for (size_t i = 0; i < count; i++)
        any = any || difference(&peaks[i], &comparison[i]) > limit;
    for (size_t i = 0; i < count; i++) {
        const double d = scale * difference(&peaks[i], &comparison[i]);
        double part = of->accuracy > 0 ? of->accuracy * response(d / of->accuracy) : fmax(d, rounding);
        if (any)
            part = fmax(part, fmin(chaos * chaos_near(peaks, comparison, count, i, limit), fmax(1, d)));
        uncertainty[i] = part * fabs(peaks[i].value);
    }
}
