/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers and units as people write them. */
#pragma once

#include <stddef.h>

/* Power of ten, a multiple of 3, of the prefix that brings |value| into 1..1000 in `si_unit`, as far as the unit takes prefixes. */
int bead_prefix_exponent(double value, const char *si_unit);
/* "µ" for -6, "" for 0. */
const char *bead_prefix_sign(int exponent);
/* A number with a true minus sign and, from five digits on, thin spaces between thousands. */
void bead_number(double number, int decimals, char *out, size_t size);
/* "3 600" from 3571: two significant digits, thousands apart; powers of ten from 1e5 on, "2.5·10⁶". */
void bead_round_number(double x, char *out, size_t size);
/* 10^exponent; shown values are SI values divided by it, exactly rounded for negative exponents too. */
double bead_power_of_ten(int exponent);
