/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses the ticks and labels of axes; axis_draw.c draws them. */
#include <math.h>
#include <stdlib.h>

#include "render/colour/colour_table.h"
#include "render/draw/axis.h"
#include "render/draw/words.h"

enum {
    MOST_TICKS = sizeof((struct bead_axis *)0)->ticks / sizeof(struct bead_tick),
    ENOUGH = 7,
    ENOUGH_TO_THE_END = 11,
    ENOUGH_UNEVEN = 9,
    FEW = 4
};

/* Room for labels, in units of the font size. A digit is 0.5 wide in STIX and 0.58 in Lato. */
static const double character = 0.6, between_labels = 1.2, least_between = 0.5, line_apart = 1.9, least_line = 1.4,
                    usual_width = 1.8;

struct room {
    double length, em;
    bool horizontal, tight;
    int most; /* steps, less one */
};

static size_t characters(const char *label)
{
    size_t count = 0;
    for (bool tag = false; *label; label++) {
        tag = tag || *label == '<';
        if (!tag && ((unsigned char)*label & 0xC0) != 0x80)
            count++;
        tag = tag && *label != '>';
    }
    return count;
}

/* Centres of labels must be this far apart, px. */
static double needed(const struct room *room, double width_in_characters)
{
    if (!room->horizontal)
        return room->em * (room->tight ? least_line : line_apart);
    double width = width_in_characters * character;
    return room->em * (room->tight ? width + least_between : fmax(width, usual_width) + between_labels);
}

static void axis_add(struct bead_axis *axis, double shown, int decimals)
{
    if (axis->count == MOST_TICKS)
        return;
    struct bead_tick *tick = &axis->ticks[axis->count++];
    tick->value = shown / axis->factor;
    tick->place = fmin(1, fmax(0, bead_axis_place(axis, tick->value)));
    bead_number(shown, decimals, tick->label, sizeof tick->label);
}

/* mantissa * 10^exponent * k, correctly rounded for negative exponents too. */
static double multiple(double k, int mantissa, int exponent)
{
    return exponent < 0 ? k * mantissa / bead_power_of_ten(-exponent) : k * mantissa * bead_power_of_ten(exponent);
}

static const int mantissas[] = {1, 2, 5}, uneven_mantissas[] = {3, 4, 6, 8};

static bool try_step(struct bead_axis *axis, const struct room *room, int mantissa, int exponent)
{
    double low = axis->low * axis->factor, high = axis->high * axis->factor, slack = 1e-9 * (high - low);
    double step = multiple(1, mantissa, exponent);
    double from = ceil((low - slack) / step), to = floor((high + slack) / step);
    axis->count = 0;
    if (to - from >= room->most)
        return false;
    size_t widest = 0;
    for (double k = from; k <= to; k++) {
        axis_add(axis, multiple(k, mantissa, exponent), exponent < 0 ? -exponent : 0);
        size_t width = characters(axis->ticks[axis->count - 1].label);
        widest = width > widest ? width : widest;
    }
    return room->length * step / (high - low) >= needed(room, (double)widest);
}

/* A short axis may have room for two labels although no round step gives two: "0" and "80" say more than "0" alone. */
static bool uneven_step(struct bead_axis *axis, const struct room *room, int first)
{
    for (int exponent = first; exponent < first + 4; exponent++) {
        for (size_t i = 0; i < sizeof uneven_mantissas / sizeof *uneven_mantissas; i++) {
            if (try_step(axis, room, uneven_mantissas[i], exponent) && axis->count == 2)
                return true;
        }
    }
    return false;
}

/* The smallest step of 1, 2, 5 x 10^n whose labels fit. */
static void round_steps(struct bead_axis *axis, struct room room, bool counts)
{
    int first = (int)floor(log10((axis->high - axis->low) * axis->factor)) - 1;
    for (int pass = 0; pass < 2; pass++) {
        room.tight = pass == 1;
        for (int i = 1; i < 9; i++) { /* of the first there would be ten */
            int exponent = first + i / 3;
            if ((counts && exponent < 0) || !try_step(axis, &room, mantissas[i % 3], exponent))
                continue;
            if (axis->count >= 2 || (room.tight && (counts || uneven_step(axis, &room, first))))
                return;
            if (room.tight) {
                try_step(axis, &room, mantissas[i % 3], exponent);
                return;
            }
            break; /* a single tick says little: allows closer labels */
        }
    }
    if (axis->count > 1)
        axis->count = 0;
}

static bool has_tick(const struct bead_axis *axis, double place)
{
    for (size_t i = 0; i < axis->count; i++) {
        if (fabs(axis->ticks[i].place - place) < 1e-6)
            return true;
    }
    return false;
}

/* The widest steps with at least `least` ticks, one of them at the upper end; `from_low`: and one at the lower. */
static bool steps_to_the_end(struct bead_axis *axis, const struct room *room, bool counts, bool from_low, size_t least)
{
    enum { MANTISSAS = 5 };
    int first = (int)floor(log10((axis->high - axis->low) * axis->factor));
    for (int i = 0; i < 2 * MANTISSAS; i++) {
        int exponent = first - i / MANTISSAS, mantissa = MANTISSAS - i % MANTISSAS;
        bool fits = !(counts && exponent < 0) && try_step(axis, room, mantissa, exponent) && axis->count >= least;
        if (fits && has_tick(axis, 1) && (!from_low || has_tick(axis, 0)))
            return true;
    }
    return false;
}

/* An axis from 0.6 to 1.5 shows both numbers: with smaller steps, or steps of 3 or 4, if these fit. */
static void equal_steps(struct bead_axis *axis, struct room room, bool counts)
{
    round_steps(axis, room, counts);
    if (axis->count < 2 || has_tick(axis, 1))
        return;
    const struct bead_axis found = *axis;
    const bool from_low = has_tick(axis, 0);
    room.most = ENOUGH_TO_THE_END;
    if (!steps_to_the_end(axis, &room, counts, from_low, 4) && !steps_to_the_end(axis, &room, counts, from_low, 3))
        *axis = found;
}

/* The fewest decimals that write mantissa * 10^exponent * k exactly. */
static int decimals_of(double shown, int exponent)
{
    int decimals = exponent < 0 ? -exponent : 0;
    while (decimals > 0 && fabs(remainder(shown, bead_power_of_ten(1 - decimals))) < 1e-6 * bead_power_of_ten(-decimals))
        decimals--;
    return decimals;
}

static double half_width(const struct bead_tick *tick)
{
    return 0.5 * (double)characters(tick->label);
}

/* Keeps the last tick if it fits, in order of position. */
static void keep_if_room(struct bead_axis *axis, const struct room *room)
{
    struct bead_tick last = axis->ticks[axis->count - 1];
    size_t at = --axis->count;
    for (size_t i = 0; i < axis->count; i++) {
        const struct bead_tick *tick = &axis->ticks[i];
        double apart = fabs(tick->place - last.place) * room->length;
        if (apart < needed(room, half_width(tick) + half_width(&last)))
            return;
        if (last.place < tick->place && i < at)
            at = i;
    }
    memmove(&axis->ticks[at + 1], &axis->ticks[at], (axis->count - at) * sizeof *axis->ticks);
    axis->ticks[at] = last;
    axis->count++;
}

/* Uneven axes wider than this are only labelled at 1, 2 ... 9 times powers of ten. */
static const double wide = 5;

static bool has_one_digit(double number)
{
    double mantissa = number == 0 ? 0 : fabs(number) / bead_power_of_ten((int)floor(log10(fabs(number)) + 1e-9));
    return fabs(mantissa - round(mantissa)) < 1e-6;
}

/* Uneven axes over several one-digit numbers have ticks only there, and with square roots, below the highest power of ten, only at
 * 1, 2 and 5 of each: 0, 2, 5, 10, 20, 30, not 14.5. */
static bool only_round(const struct bead_axis *axis)
{
    if (axis->scale == BEAD_SCALE_LOG)
        return axis->high / axis->low > wide;
    return axis->low <= 0 || axis->high / axis->low > wide;
}

/* On nonlinear scales: adds the roundest numbers first, while there is room between the ticks. */
static void roundest_first(struct bead_axis *axis, const struct room *room, bool mirrored)
{
    double low = axis->low * axis->factor, high = axis->high * axis->factor, slack = 1e-9 * (high - low);
    int largest = (int)floor(log10(fmax(fabs(low), fabs(high)) * (1 + 1e-12)));
    const size_t enough = mirrored ? (ENOUGH_UNEVEN + 1) / 2 : ENOUGH_UNEVEN;
    for (int i = 0; i < 9; i++) {
        int mantissa = mantissas[2 - i % 3], exponent = largest - i / 3;
        double step = multiple(1, mantissa, exponent);
        if ((high - low) / step > 2000)
            return;
        const double from = mirrored ? 0 : ceil((low - slack) / step);
        for (double k = from; k <= floor((high + slack) / step) && axis->count < enough; k++) {
            double shown = multiple(k, mantissa, exponent);
            const bool root = axis->scale == BEAD_SCALE_SQRT, below = i >= 3 && fabs(k) > 1; /* 7 between 5 and 10 */
            if ((!root && !(shown > 0)) || (only_round(axis) && (!has_one_digit(shown) || (root && below))))
                continue;
            axis_add(axis, shown, decimals_of(shown, exponent));
            keep_if_room(axis, room);
        }
    }
}

/* A range from -a to a has the ticks of both signs. */
static void mirror(struct bead_axis *axis)
{
    const struct bead_axis half = *axis; /* from 0 */
    axis->count = 0;
    for (size_t i = half.count; i > 1; i--) {
        struct bead_tick *tick = &axis->ticks[axis->count++];
        *tick = (struct bead_tick){-half.ticks[i - 1].value, 1 - half.ticks[i - 1].place, ""};
        snprintf(tick->label, sizeof tick->label, "\u2212%.16s", half.ticks[i - 1].label);
    }
    memcpy(&axis->ticks[axis->count], half.ticks, half.count * sizeof *half.ticks);
    axis->count += half.count;
}

/* Minor ticks in equal round steps between labels, at least this far apart, in units of the font size. */
static const double between_minor = 0.42;

static void minor_between(struct bead_axis *axis, const struct room *room, size_t i)
{
    enum { MOST = sizeof axis->minor / sizeof axis->minor[0] };
    static const int parts[] = {5, 4, 3, 2};
    double low = axis->ticks[i].value, high = axis->ticks[i + 1].value;
    for (size_t p = 0; p < sizeof parts / sizeof parts[0]; p++) {
        double step = (high - low) / parts[p], shown = step * axis->factor;
        double first = bead_axis_place(axis, low + step) - axis->ticks[i].place;
        double last = axis->ticks[i + 1].place - bead_axis_place(axis, high - step);
        double mantissa = shown / bead_power_of_ten((int)floor(log10(shown) + 1e-9));
        bool is_round = fabs(mantissa - 1) < 1e-6 || fabs(mantissa - 2) < 1e-6 || fabs(mantissa - 5) < 1e-6;
        if (!is_round || fmin(first, last) * room->length < between_minor * room->em)
            continue;
        for (int k = 1; k < parts[p] && axis->minor_count < MOST; k++)
            axis->minor[axis->minor_count++] = bead_axis_place(axis, low + k * step);
        return;
    }
}

static void power_label(struct bead_tick *tick, int exponent, bool plain)
{
    char number[16];
    if (plain) {
        bead_number(bead_power_of_ten(exponent), exponent < 0 ? -exponent : 0, tick->label, sizeof tick->label);
        return;
    }
    bead_number(exponent, 0, number, sizeof number);
    snprintf(tick->label, sizeof tick->label, "10<sup>%.10s</sup>", number);
}

/* Minor ticks at 2, 3 ... 9 times each power of ten if every power is labelled and there is room, else at the powers between. */
static void minor_ticks(struct bead_axis *axis, int every, double decade)
{
    static const double least_decade = 22; /* px: the narrowest gap, from 9 to 10, is 1/22 of a decade */
    enum { MOST = sizeof axis->minor / sizeof axis->minor[0] };
    double low = axis->low * axis->factor, high = axis->high * axis->factor;
    bool within = every == 1 && decade >= 1.5 * least_decade;
    int first = within ? 2 : 1, last = within ? 9 : 1;
    if (every == 1 && !within)
        return;
    for (int e = (int)floor(log10(low)); e <= (int)ceil(log10(high)); e++) {
        for (int m = first; m <= last; m++) {
            double value = multiple(1, m, e) / axis->factor;
            if (value >= axis->low && value <= axis->high && axis->minor_count < MOST)
                axis->minor[axis->minor_count++] = bead_axis_place(axis, value);
        }
    }
}

/* Powers of ten define a scale if two of them are on a long axis. */
static bool has_decades(const struct bead_axis *axis)
{
    const double low = axis->low * axis->factor, high = axis->high * axis->factor;
    return axis->scale == BEAD_SCALE_LOG && high / low > 30 && floor(log10(high) + 1e-9) > ceil(log10(low) - 1e-9);
}

/* Powers of ten; every n-th if there are many. */
static void decades(struct bead_axis *axis, const struct room *room)
{
    double low = axis->low * axis->factor, high = axis->high * axis->factor;
    int from = (int)ceil(log10(low) - 1e-9), to = (int)floor(log10(high) + 1e-9);
    bool plain = from >= -3 && to <= 3;
    double apart = room->length / log10(high / low), width = plain ? fmax(1 - from, 1 + to) : 4;
    int every = (int)fmax(1, ceil(needed(room, width) / apart));
    while ((to - from) / every + 1 > MOST_TICKS)
        every++;
    minor_ticks(axis, every, apart);
    from += (to - from) % every; /* with the highest among them */
    for (int e = from; e <= to; e += every) {
        axis_add(axis, bead_power_of_ten(e), 0);
        power_label(&axis->ticks[axis->count - 1], e, plain);
    }
}

double bead_axis_place(const struct bead_axis *axis, double value)
{
    return bead_scale_place(axis->scale, axis->low, axis->high, value);
}

/* From here, two decimals show a number. */
static const double plain_from = 0.0099;

/* Numbers with many digits are shown in multiples of a power of ten; logarithmic axes always show powers. */
static int power_of_numbers(double largest, enum bead_scale scale)
{
    bool plain = scale == BEAD_SCALE_LOG || !isfinite(largest) || largest == 0 || (largest >= plain_from && largest < 99999);
    return plain ? 0 : 3 * (int)floor(log10(largest) / 3 + 1e-9);
}

void bead_axis_make(struct bead_axis *axis, double low, double high, const char *si_unit, enum bead_scale scale, double length,
                    double em, bool horizontal)
{
    double largest = fmax(fabs(low), fabs(high));
    bool counts = strcmp(si_unit, "1") == 0, number = *si_unit == '\0';
    int exponent = number ? 0 : bead_prefix_exponent(largest, si_unit);
    const bool below_prefixes = exponent < 0 && largest < plain_from * bead_power_of_ten(exponent);
    if (number || below_prefixes)
        exponent = power_of_numbers(largest, scale);
    *axis = (struct bead_axis){.low = low, .high = high, .scale = scale, .factor = bead_power_of_ten(-exponent)};
    if ((number || below_prefixes) && exponent != 0)
        snprintf(axis->unit, sizeof axis->unit, "\u00d710<sup>%s%d</sup>%s%s", exponent < 0 ? "\u2212" : "", abs(exponent),
                 number ? "" : "\u00a0", si_unit);
    else if (!number && !counts)
        snprintf(axis->unit, sizeof axis->unit, "%s%s", bead_prefix_sign(exponent), si_unit);
    bool sensible = isfinite(low) && isfinite(high) && high - low > 1e-12 * largest && length > 0 && em > 0;
    if (!sensible || (scale == BEAD_SCALE_LOG && (!(low > 0) || !isfinite(high / low))))
        return;
    struct room room = {length, em, horizontal, false, ENOUGH};
    const bool mirrored = scale == BEAD_SCALE_SQRT && low == -high;
    if (scale == BEAD_SCALE_LINEAR)
        equal_steps(axis, room, counts);
    else if (has_decades(axis))
        decades(axis, &room);
    else
        roundest_first(axis, &room, mirrored);
    if (mirrored)
        mirror(axis);
    const bool between = scale == BEAD_SCALE_SQRT || (scale == BEAD_SCALE_LINEAR && axis->count <= FEW && !counts);
    for (size_t i = 0; between && i + 1 < axis->count; i++)
        minor_between(axis, &room, i);
    if (scale == BEAD_SCALE_LOG && high / low > wide && !has_decades(axis))
        minor_ticks(axis, 1, length / log10(high / low));
}
