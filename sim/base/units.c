/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads numbers with units for the scene: the usual units from a table, others from UDUNITS-2. */
#include "sim/base/units.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <udunits2.h>

#include "sim/base/text.h"

/* The usual units, so that UDUNITS-2, which needs 5 ms to read its tables, is rarely needed: value in SI = number * factor *
 * 10^power. */
struct usual {
    const char *unit, *si;
    int power;
    double factor;
    bool prefixed; /* decimal prefixes are allowed */
};
static const struct usual usual[] = {
    {"s", "s", 0, 1, true},
    {"m", "m", 0, 1, true},
    {"m/s", "m/s", 0, 1, true},
    {"g", "kg", -3, 1, true},
    {"Pa", "Pa", 0, 1, true},
    {"N", "N", 0, 1, true},
    {"J", "J", 0, 1, true},
    {"kg/m3", "kg/m3", 0, 1, false},
    {"kg/m^3", "kg/m3", 0, 1, false},
    {"g/cm3", "kg/m3", 3, 1, false},
    {"g/cm^3", "kg/m3", 3, 1, false},
    {"N/m", "N/m", 0, 1, false},
    {"rad", "rad", 0, 1, false},
    {"deg", "rad", 0, 0.017453292519943295, false},
    {"\u00b0", "rad", 0, 0.017453292519943295, false},
    {"1/m", "1/m", 0, 1, false},
    {"%", "1", -2, 1, false},
};
static const struct {
    const char *text;
    int power;
} prefixes[] = {{"", 0}, {"n", -9}, {"u", -6}, {"\u00b5", -6}, {"\u03bc", -6}, {"m", -3}, {"c", -2}, {"k", 3}, {"M", 6}, {"G", 9}};

enum { LONGEST = 128 }; /* of a number with its unit */

struct bead_units {
    locale_t c;        /* a decimal point, whatever the user's language */
    ut_system *system; /* NULL until needed */
    bool failed;       /* UDUNITS-2 has no tables here */
};

struct bead_units *bead_units_create(void)
{
    struct bead_units *units = calloc(1, sizeof *units);
    if (units && !(units->c = newlocale(LC_ALL_MASK, "C", (locale_t)0))) {
        free(units);
        units = NULL;
    }
    return units;
}

void bead_units_free(struct bead_units *units)
{
    if (!units)
        return;
    if (units->system)
        ut_free_system(units->system);
    freelocale(units->c);
    free(units);
}

/* Length of the decimal number that `text` begins with, 0: none. Hexadecimal numbers, inf and nan do not count. */
static size_t number_length(const char *text)
{
    const char *at = text + (*text == '+' || *text == '-');
    size_t before = strspn(at, "0123456789");
    at += before;
    size_t after = *at == '.' ? strspn(at + 1, "0123456789") : 0;
    if (before + after == 0)
        return 0;
    at += *at == '.' ? after + 1 : 0;
    if (*at == 'e' || *at == 'E') {
        size_t sign = at[1] == '+' || at[1] == '-', digits = strspn(at + 1 + sign, "0123456789");
        at += digits ? 1 + sign + digits : 0;
    }
    return (size_t)(at - text);
}

/* The number of `length` characters times 10^power, rounded once. */
static double shifted(const struct bead_units *units, const char *text, size_t length, int power)
{
    char moved[LONGEST + 32];
    size_t mantissa = strcspn(text, "eE");
    mantissa = mantissa < length ? mantissa : length;
    long exponent = mantissa < length ? strtol(text + mantissa + 1, NULL, 10) : 0;
    /* Beyond this the number is 0 or infinite. */
    exponent = exponent > 100000 ? 100000 : exponent < -100000 ? -100000 : exponent;
    snprintf(moved, sizeof moved, "%.*se%ld", (int)mantissa, text, exponent + power);
    return strtod_l(moved, NULL, units->c);
}

/* A usual unit, and its power with the prefix. */
static const struct usual *find_usual(const char *unit, int *power)
{
    for (size_t i = 0; i < sizeof usual / sizeof *usual; i++) {
        for (size_t k = 0; k < (usual[i].prefixed ? sizeof prefixes / sizeof *prefixes : 1); k++) {
            size_t length = strlen(prefixes[k].text);
            *power = usual[i].power + prefixes[k].power;
            if (strncmp(unit, prefixes[k].text, length) == 0 && strcmp(unit + length, usual[i].unit) == 0)
                return &usual[i];
        }
    }
    return NULL;
}

static bool read_tables(struct bead_units *units)
{
    if (!units->system && !units->failed) {
        ut_set_error_message_handler(ut_ignore);
        units->system = ut_read_xml(NULL);
        units->failed = !units->system;
    }
    return units->system != NULL;
}

/* Is a factor a power of ten, within rounding errors? */
static bool is_power_of_ten(double factor, int *power)
{
    *power = factor > 0 ? (int)lrint(log10(factor)) : 0;
    return factor > 0 && fabs(factor / pow(10, *power) - 1) < 1e-13;
}

/* Ask UDUNITS-2 for the factor from `unit` to `si`; false: not convertible. Units with an offset (celsius) or a logarithm are
 * rejected. */
static bool convert(struct bead_units *units, const char *unit, const char *si, double *factor, const char **why)
{
    ut_unit *from = ut_parse(units->system, unit, UT_UTF8), *to = ut_parse(units->system, si, UT_UTF8);
    cv_converter *converter = from && to ? ut_get_converter(from, to) : NULL;
    *why = from ? "is not in a unit of" : "has an unknown unit; must be a unit of";
    bool good = false;
    if (converter) {
        *factor = cv_convert_double(converter, 1);
        good = cv_convert_double(converter, 0) == 0 && cv_convert_double(converter, 2) == 2 * *factor && isfinite(*factor);
        cv_free(converter);
    }
    if (from)
        ut_free(from);
    if (to)
        ut_free(to);
    return good;
}

static enum bead_error wrong(char *why, size_t size, const char *text, const char *what, const char *si)
{
    char shown[64];
    snprintf(why, size, "`%s` %s%s%s", bead_text_show(text, shown, sizeof shown), what, si ? " " : "", si ? si : "");
    return BEAD_ERROR_SCENE;
}

/* A number followed by a unit. */
static enum bead_error read_with_unit(struct bead_units *units, const char *text, size_t length, const char *unit, const char *si,
                                      double *value, char *why, size_t size)
{
    int power = 0;
    const struct usual *known = find_usual(unit, &power);
    const char *what = "is not in a unit of";
    double factor = 1;
    if (!si)
        return wrong(why, size, text, "has a unit, but must be a plain number", NULL);
    if (known && strcmp(known->si, si) == 0) {
        *value = shifted(units, text, length, power) * known->factor;
        return BEAD_OK;
    }
    if (known)
        return wrong(why, size, text, what, si);
    /* UDUNITS-2 would accept "5" as a unit, and dates, too. */
    if ((strchr("0123456789+-.", *unit) && strncmp(unit, "1/", 2) != 0) || strchr(unit, '@'))
        return wrong(why, size, text, "is not a number with a unit of", si);
    if (!read_tables(units))
        return wrong(why, size, text, "has an unknown unit (the tables of UDUNITS-2 cannot be read); must be a unit of", si);
    if (!convert(units, unit, si, &factor, &what))
        return wrong(why, size, text, what, si);
    *value = is_power_of_ten(factor, &power) ? shifted(units, text, length, power) : shifted(units, text, length, 0) * factor;
    return BEAD_OK;
}

bool bead_units_bare(const char *text)
{
    const size_t from = strspn(text, " \t\r\n"), length = number_length(text + from);
    return length > 0 && !text[from + length + strspn(text + from + length, " \t\r\n")];
}

enum bead_error bead_units_read(struct bead_units *units, const char *text, const char *si, double *value, char *why, size_t size)
{
    char trimmed[LONGEST];
    size_t from = strspn(text, " \t\r\n"), to = strlen(text);
    while (to > from && strchr(" \t\r\n", text[to - 1]))
        to--;
    if (to - from >= LONGEST)
        return wrong(why, size, text, "is too long for a number", NULL);
    snprintf(trimmed, sizeof trimmed, "%.*s", (int)(to - from), text + from);
    size_t length = number_length(trimmed);
    if (length == 0)
        return wrong(why, size, text, si ? "is not a number, plain or with a unit of" : "is not a number", si);
    if (trimmed[length] == ',' && strchr("0123456789", trimmed[length + 1]) && trimmed[length + 1])
        return wrong(why, size, text, "has a comma, but numbers have a decimal point", NULL);
    const char *unit = trimmed + length + strspn(trimmed + length, " \t\r\n");
    enum bead_error err = BEAD_OK;
    if (*unit)
        err = read_with_unit(units, trimmed, length, unit, si, value, why, size);
    else
        *value = shifted(units, trimmed, length, 0);
    if (!err && !isfinite(*value))
        err = wrong(why, size, text, "is too large", NULL);
    return err;
}
