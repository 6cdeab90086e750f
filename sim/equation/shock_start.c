#include "sim/equation/shock_law.h"

static const long double pi = 3.141592653589793238462643383279503L;

static double strain(const struct bead_equation_spec *spec, double x)
{
    long double phase = 2 * pi * (long double)spec->mode * (long double)((x - spec->low) / spec->length);
    if (spec->start == BEAD_START_COSINE)
        return spec->amplitude * (double)cosl(phase);
    if (spec->start == BEAD_START_SIMPLE_WAVE)
        return spec->amplitude * (double)sinl(phase);
    long double sum = 0;
    for (int image = -1; image <= 1; image++) { /* pulses of the neighbouring periods */
        long double c = coshl((long double)((x + image * spec->length - spec->at) / spec->width));
        sum += 1 / (c * c);
    }
    return spec->amplitude * (double)sum;
}

static int direction(const struct bead_equation_spec *spec)
{
    if (spec->start == BEAD_START_SIMPLE_WAVE)
        return 1;
    if (spec->start == BEAD_START_COSINE || spec->moving == BEAD_MOVING_REST)
        return 0;
    return spec->moving == BEAD_MOVING_RIGHT ? 1 : -1;
}

void bead_shock_start(const struct bead_equation_spec *spec, size_t cells, double *r, double *v)
{
    /* Gauss's rule of three points: exact to the sixth order, one more than the solver. */
    static const double node[] = {-0.38729833462074170, 0, 0.38729833462074170}, weight[] = {5. / 18, 8. / 18, 5. / 18};
    double dx = spec->length / (double)cells;
    for (size_t i = 0; i < cells; i++) {
        r[i] = v[i] = 0;
        for (int g = 0; g < 3; g++) {
            double here = strain(spec, spec->low + dx * ((double)i + 0.5 + node[g]));
            r[i] += weight[g] * here;
            v[i] -= direction(spec) * weight[g] * bead_shock_g(spec, here);
        }
    }
}

double bead_shock_smooth(const struct bead_equation_spec *spec, double dx)
{
    const double never_zero = 1e-60;
    double length = spec->start == BEAD_START_PULSE ? spec->width : spec->length / (2 * (double)pi * (double)spec->mode);
    double difference = spec->speed * spec->amplitude * (dx / length) * (dx / length);
    return difference * difference + never_zero;
}
