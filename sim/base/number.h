/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers as text: the fewest digits that read back as the same double. */
#pragma once

#include <math.h>
#include <stdio.h>

enum { BEAD_NUMBER_ROOM = 40 };

/* In the style of %g: "1e-06", "0.1", "nan", "-inf". The decimal point is that of the current locale. */
void bead_number_text(char text[BEAD_NUMBER_ROOM], double value);
void bead_write_number(FILE *file, double value);
/* An error of a number, which is known roughly only: three digits, rounded up. */
void bead_write_uncertainty(FILE *file, double value);
/* An error to tell in a message: infinite where numbers have overflowed and are none. */
static inline double bead_told_error(double error)
{
    return isnan(error) ? INFINITY : error;
}
