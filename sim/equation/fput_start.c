/* How a string starts: from one of its modes, or with a pulse of strain. */
#include <math.h>

#include "sim/equation/fput_string.h"

/* Functions in long double, rounded: the C library's own ones in double differ in the last bit between processors. */
static double sine(long double x)
{
    return (double)sinl(x);
}

static double sech2(double x)
{
    return fabs(x) < 300 ? (double)(1 / (coshl(x) * coshl(x))) : 0;
}

static const long double pi = 3.141592653589793238462643383279503L;

/* u_j = amplitude sin(pi k (j + 1) / (n + 1)), j from 0: the left wall stands where mass -1 would. */
static void start_mode(const struct bead_string *s, double *u)
{
    bool fixed = s->spec->ends == BEAD_ENDS_FIXED;
    size_t n = s->masses, half = fixed ? n + 1 : n;
    for (size_t j = 0; j < n; j++) {
        size_t turn = s->spec->mode * (fixed ? j + 1 : 2 * j) % (2 * half); /* in units of half / pi */
        u[j] = s->spec->amplitude * sine(pi * (long double)turn / (long double)half);
    }
}

/* The strain asked for at place x (in units of springs, from mass 0). A ring has images of it. */
static double strain_at(const struct bead_string *s, double x)
{
    const struct bead_equation_spec *e = s->spec;
    double sum = 0, around = e->ends == BEAD_ENDS_PERIODIC ? (double)s->masses : 0;
    for (int image = -1; image <= 1; image++) {
        if (image == 0 || around > 0)
            sum += sech2((x + bead_string_first(e) - e->at + image * around) / e->width);
    }
    return e->amplitude * sum;
}

/* Velocity behind a front of strain r in a simple wave going right: minus the integral of the speed of sound
 * sqrt(1 + 2 alpha r + 3 beta r^2) from 0 to r; Simpson's rule. */
static double simple_wave(const struct bead_equation_spec *e, double r)
{
    enum { PIECES = 32 };
    double sum = 0;
    for (int i = 0; i <= PIECES; i++) {
        double x = r * i / PIECES, c2 = 1 + x * (2 * e->alpha + 3 * e->beta * x);
        sum += (i == 0 || i == PIECES ? 1 : i % 2 ? 4 : 2) * sqrt(fmax(c2, 0));
    }
    return -sum * r / (3 * PIECES);
}

/* Springs stand half-way between masses, so strains do; a wave going right has v(x, t) = -r(x, t) to first order in r exactly,
 * whatever its length, where r is taken at the masses. The ends are as far apart as all strains together ask for. */
static void start_pulse(struct bead_string *s, double *u, double *v)
{
    static const double direction[] = {[BEAD_MOVING_REST] = 0, [BEAD_MOVING_RIGHT] = 1, [BEAD_MOVING_LEFT] = -1};
    double sum = 0, place = 0;
    for (size_t j = 0; j < s->springs; j++)
        sum += strain_at(s, (double)j - 0.5);
    s->stretch = sum / (double)s->springs;
    for (size_t j = 0; j < s->masses; j++) {
        place += strain_at(s, (double)j - 0.5) - s->stretch;
        u[j] = place;
        v[j] = s->spec->moving == BEAD_MOVING_REST ? 0 : direction[s->spec->moving] * simple_wave(s->spec, strain_at(s, (double)j));
    }
}

void bead_string_start(struct bead_string *s, double *u, double *v)
{
    s->stretch = 0;
    for (size_t j = 0; j < s->masses; j++)
        u[j] = v[j] = 0;
    if (s->spec->start == BEAD_START_MODE)
        start_mode(s, u);
    else
        start_pulse(s, u, v);
}
