/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arithmetic with 113 bits, IEEE binary128: it gives the same bits on every processor and with every C library. `long double` does
 * not (it has 64 bits on x86-64), nor do the functions of double (they depend on fused multiply-adds). In software: about 20 ns for
 * an operation, 1 us for a function. */
#pragma once

#include <math.h>

#include "sim/base/elementary.h"

#if LDBL_MANT_DIG == 113
typedef long double bead_wide;
#define BEAD_WIDE_NAME(function) function##l
#else
typedef __float128 bead_wide;
#define BEAD_WIDE_NAME(function) function##f128
/* From the C library (glibc >= 2.26), whose header declares them for GCC only. */
bead_wide sinf128(bead_wide x);
bead_wide cosf128(bead_wide x);
bead_wide expf128(bead_wide x);
bead_wide erfcf128(bead_wide x);
bead_wide logf128(bead_wide x);
bead_wide cbrtf128(bead_wide x);
bead_wide powf128(bead_wide x, bead_wide y);
#endif

#define bead_wide_sin BEAD_WIDE_NAME(sin)
#define bead_wide_cos BEAD_WIDE_NAME(cos)
#define bead_wide_exp BEAD_WIDE_NAME(exp)

static const bead_wide bead_wide_pi =
    (bead_wide)0x1.921fb54442d18p1 + (bead_wide)0x1.1a62633145c07p-53 - (bead_wide)0x1.f1976b7ed8fbcp-109;

static inline bead_wide bead_wide_abs(bead_wide x)
{
    return x < 0 ? -x : x;
}

static inline struct bead_pair bead_wide_pair(bead_wide x)
{
    return (struct bead_pair){(double)x, (double)(x - (double)x)};
}

/* Functions of double, rounded correctly except for one case in 2^50. sim/base/elementary.h has quicker ones. */
static inline double bead_sin(double x)
{
    return (double)bead_wide_sin(x);
}

static inline double bead_exp(double x)
{
    return (double)bead_wide_exp(x);
}

static inline double bead_erfc(double x)
{
    return (double)BEAD_WIDE_NAME(erfc)(x);
}

static inline double bead_pow(double x, double y)
{
    return (double)BEAD_WIDE_NAME(pow)(x, y);
}

/* 1 / cosh(x)^2 */
static inline double bead_sech2(double x)
{
    const bead_wide e = bead_wide_exp(-2 * bead_wide_abs(x));
    return (double)(4 * e / ((1 + e) * (1 + e)));
}

/* A point on the unit circle. */
struct bead_turn {
    bead_wide re, im;
};

static inline struct bead_turn bead_turn_by(bead_wide angle)
{
    return (struct bead_turn){bead_wide_cos(angle), bead_wide_sin(angle)};
}

static inline struct bead_turn bead_turn_on(struct bead_turn a, struct bead_turn b)
{
    return (struct bead_turn){a.re * b.re - a.im * b.im, a.im * b.re + a.re * b.im};
}
