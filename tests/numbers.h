/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the tests of pictures and films: numbers on axes, read from their words. */
#ifndef BEADREEL_TESTS_NUMBERS_H
#define BEADREEL_TESTS_NUMBERS_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The number that a text is, else NAN. */
static inline double number_of(const char *text)
{
    char plain[64];
    size_t used = 0;
    for (const char *c = text; *c && used + 1 < sizeof plain;) {
        if (!strncmp(c, "\u2212", 3))
            plain[used++] = '-', c += 3;
        else if ((*c >= '0' && *c <= '9') || *c == '.')
            plain[used++] = *c++;
        else if (!strncmp(c, "\u202f", 3))
            c += 3;
        else
            return NAN;
    }
    plain[used] = 0;
    return used ? strtod(plain, NULL) : NAN;
}

/* Linear, logarithmic, or of square roots. */
enum { SCALES = 3 };
static inline double scaled(double value, int scale)
{
    return scale == 0 ? value : scale == 1 ? log10(value) : copysign(sqrt(fabs(value)), value);
}

#endif
