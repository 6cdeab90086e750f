/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers with units as text: SI prefixes, signs, thousands. Axes, headings and messages are written with it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/draw/axis.h"
#include "render/draw/words.h"

#define THIN_SPACE "\u2009"

static const struct prefix {
    int exponent;
    const char *sign;
} prefixes[] = {{12, "T"}, {9, "G"},   {6, "M"},   {3, "k"},   {0, ""},    {-3, "m"}, {-6, "\u00b5"},
                {-9, "n"}, {-12, "p"}, {-15, "f"}, {-18, "a"}, {-21, "z"}, {-24, "y"}};
enum { PREFIXES = sizeof prefixes / sizeof prefixes[0] };

/* The largest usual prefixes of units: kiloseconds are not used. Other units take none. */
static const struct {
    const char *unit;
    int largest;
} units[] = {{"s", 0}, {"m", 0}, {"m/s", 0}, {"g", 3}, {"N", 12}, {"J", 12}, {"Pa", 12}, {"Hz", 12}, {"W", 12}};

double bead_power_of_ten(int exponent)
{
    return pow(10, exponent);
}

int bead_prefix_exponent(double value, const char *si_unit)
{
    size_t u = 0, count = sizeof units / sizeof units[0];
    while (u < count && strcmp(units[u].unit, si_unit) != 0)
        u++;
    if (u == count || value == 0 || !isfinite(value))
        return 0;
    for (int i = 0; i < PREFIXES; i++) {
        if (prefixes[i].exponent <= units[u].largest && fabs(value) >= bead_power_of_ten(prefixes[i].exponent) * (1 - 1e-9))
            return prefixes[i].exponent;
    }
    return prefixes[PREFIXES - 1].exponent;
}

const char *bead_prefix_sign(int exponent)
{
    for (int i = 0; i < PREFIXES; i++) {
        if (prefixes[i].exponent == exponent)
            return prefixes[i].sign;
    }
    return "";
}

/* Appends as much of `text` as fits. */
static void append(char *out, size_t size, const char *text)
{
    size_t used = strlen(out);
    if (used + 1 < size)
        snprintf(out + used, size - used, "%s", text);
}

/* Appends digits with thin spaces between the thousands of the first `whole`. */
static void append_digits(char *out, size_t size, const char *digits, size_t whole)
{
    for (size_t i = 0; i < whole; i++) {
        if (i > 0 && (whole - i) % 3 == 0)
            append(out, size, THIN_SPACE);
        append(out, size, (char[]){digits[i], '\0'});
    }
    append(out, size, digits + whole);
}

void bead_number(double number, int decimals, char *out, size_t size)
{
    char digits[64];
    if (size == 0)
        return;
    out[0] = '\0';
    if (!(fabs(number) < 1e15) || decimals > 15) {
        append(out, size, isnan(number) ? "\u2013" : number < 0 ? "\u2212\u221e" : "\u221e");
        if (isfinite(number))
            snprintf(out, size, "%.3g", number);
        return;
    }
    snprintf(digits, sizeof digits, "%.*f", decimals, fabs(number));
    size_t whole = strcspn(digits, ".");
    if (number < 0 && strtod(digits, NULL) != 0)
        append(out, size, "\u2212");
    append_digits(out, size, digits, whole >= 5 ? whole : 0);
}

/* Decimals that leave `digits` significant ones. */
static int decimals_for(double shown, int digits)
{
    if (shown == 0 || !isfinite(shown))
        return 0;
    int before = (int)floor(log10(fabs(shown)) + 1e-12) + 1;
    return digits > before ? digits - before : 0;
}

void bead_quantity(double value, const char *si_unit, int digits, char *out, size_t size)
{
    char number[64];
    int exponent = bead_prefix_exponent(value, si_unit);
    double shown = value / bead_power_of_ten(exponent);
    int decimals = decimals_for(shown, digits);
    double rounded = round(shown * bead_power_of_ten(decimals)) / bead_power_of_ten(decimals) * bead_power_of_ten(exponent);
    if (isfinite(value) && rounded != 0) { /* 999.96 may have become 1000: takes the next prefix and a digit less */
        exponent = bead_prefix_exponent(rounded, si_unit);
        shown = value / bead_power_of_ten(exponent);
        decimals = decimals_for(rounded / bead_power_of_ten(exponent), digits);
    }
    bead_number(shown, decimals, number, sizeof number);
    snprintf(out, size, "%s%s%s%s", number, *si_unit ? "\u00a0" : "", bead_prefix_sign(exponent), si_unit);
}

/* "10⁹", "2.5·10⁶" */
static void power_of_ten(double mantissa, int exponent, char *out, size_t size)
{
    static const char *const raised[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                         "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    char digits[16], power[32] = "";
    snprintf(digits, sizeof digits, "%d", abs(exponent));
    for (const char *d = digits; *d; d++)
        strcat(power, raised[*d - '0']);
    if (mantissa != 1)
        snprintf(out, size, "%.2g\u00b710%s%s", mantissa, exponent < 0 ? "\u207b" : "", power);
    else
        snprintf(out, size, "10%s%s", exponent < 0 ? "\u207b" : "", power);
}

void bead_round_number(double x, char *out, size_t size)
{
    int exponent = x > 0 && isfinite(x) ? (int)floor(log10(x)) : 0;
    double mantissa = round(10 * x / pow(10, exponent)) / 10;
    if (mantissa >= 10) {
        mantissa /= 10;
        exponent++;
    }
    if (exponent >= 5 || exponent <= -4) {
        power_of_ten(mantissa, exponent, out, size);
        return;
    }
    if (x < 10) {
        snprintf(out, size, "%.2g", x);
        return;
    }
    double unit = pow(10, floor(log10(x)) - 1);
    char digits[40];
    snprintf(digits, sizeof digits, "%.0f", round(x / unit) * unit);
    out[0] = '\0';
    append_digits(out, size, digits, strlen(digits));
}
