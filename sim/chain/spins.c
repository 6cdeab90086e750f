/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws the spins of random cells with counter-based random numbers, so that they depend on seed and configuration only. */
#include "sim/chain/spins.h"

#include <math.h>

#include "sim/base/random.h"

size_t bead_spins_up(size_t count, double magnetism)
{
    size_t up = (size_t)floor(((double)count * (1 + magnetism)) / 2 + 0.5);
    return up > count ? count : up;
}

void bead_spins_draw(char *digits, size_t count, double magnetism, uint64_t seed, uint64_t configuration)
{
    bead_spins_shuffle(digits, count, bead_spins_up(count, magnetism), seed, configuration);
}

void bead_spins_shuffle(char *digits, size_t count, size_t up, uint64_t seed, uint64_t configuration)
{
    for (size_t i = 0; i < count; i++)
        digits[i] = i < up ? '1' : '0';
    for (size_t i = count; i > 1; i--) {
        size_t other = bead_draw_below(seed, configuration, i, i);
        char keep = digits[i - 1];
        digits[i - 1] = digits[other];
        digits[other] = keep;
    }
}

int bead_order_named(const char *name)
{
    static const char *const names[BEAD_ORDERS] = {BEAD_ORDER_DOMAIN, BEAD_ORDER_CORRELATION, BEAD_ORDER_SECOND};
    int i = 0;
    while (i < BEAD_ORDERS && strcmp(names[i], name) != 0)
        i++;
    return i;
}

double bead_spins_order(const char *digits, size_t count, int order)
{
    const size_t apart = order == 0 ? 1 : (size_t)order;
    double sum = 0, domains = 1;
    for (size_t i = apart; i < count; i++) {
        sum += digits[i] == digits[i - apart] ? 1 : -1;
        domains += digits[i] != digits[i - apart];
    }
    if (count == 0 || (order > 0 && count <= apart))
        return NAN;
    return order == 0 ? (double)count / domains : sum / (double)(count - apart);
}
