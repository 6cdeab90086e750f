/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers as text: see number.h. */
#include "sim/base/number.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* 17 digits identify every double. A text of up to 15 digits is unchanged by reading and printing it, so %.15g is the shortest text
 * if it reads back. Denormal numbers have fewer digits. */
enum { SURE = DBL_DIG, MOST = DBL_DECIMAL_DIG, ROOM = BEAD_NUMBER_ROOM };

/* Add one to the last digit of "d.ddde-dd"; false if it carries past the first. */
static bool bump(char *text)
{
    char *digit = strchr(text, 'e');
    while (digit-- > text) {
        if (*digit < '0' || *digit > '9')
            continue;
        if (*digit < '9') {
            ++*digit;
            return true;
        }
        *digit = '0';
    }
    return false;
}

/* Below a power of two the doubles are twice as dense as above it: the nearest text of 16 digits may lie below it and read back as
 * another double, and the next text up as the power itself. */
static bool next_up(char *text, double value)
{
    int exponent;
    if (fabs(frexp(value, &exponent)) != 0.5)
        return false;
    snprintf(text, ROOM, "%.*e", MOST - 2, value);
    return bump(text) && strtod(text, NULL) == value;
}

static void shortest(char *text, double value)
{
    for (int digits = fabs(value) < DBL_MIN ? 1 : SURE; digits < MOST; digits++) {
        snprintf(text, ROOM, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            return;
    }
    if (!next_up(text, value))
        snprintf(text, ROOM, "%.*g", MOST, value);
}

void bead_number_text(char text[BEAD_NUMBER_ROOM], double value)
{
    if (isnan(value))
        memcpy(text, "nan", sizeof "nan");
    else
        shortest(text, value);
}

void bead_write_number(FILE *file, double value)
{
    char text[BEAD_NUMBER_ROOM];
    bead_number_text(text, value);
    fputs(text, file);
}

/* Where 9.99 is too little, so much more reads as 10.0. What is less than a billionth too little differs by rounding. */
static const double past_ten = 1.005, nearly = 1 - 1e-9;

void bead_write_uncertainty(FILE *file, double value)
{
    char text[ROOM];
    if (!isfinite(value) || value <= 0) {
        bead_write_number(file, value);
        return;
    }
    snprintf(text, ROOM, "%.2e", value);
    if (strtod(text, NULL) < nearly * value && !bump(text))
        snprintf(text, ROOM, "%.2e", past_ten * value);
    fputs(text, file);
}
