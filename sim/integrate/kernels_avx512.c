/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kernels of kernels_body.h, compiled for AVX-512. */
#ifdef __x86_64__
#define KERNELS_NAME        "avx512"
#define KERNELS_DESCRIPTION "x86-64-v4"
#define KERNELS_TABLE       bead_kernels_avx512
#define KERNELS_OF_FEW
extern const struct bead_kernels bead_kernels_avx512;
#include "sim/integrate/kernels_body.h"
#endif
