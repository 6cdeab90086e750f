/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kernels of kernels_body.h, compiled for SSE2, which every x86-64 processor has. */
#ifdef __x86_64__
#define KERNELS_NAME        "sse2"
#define KERNELS_DESCRIPTION "any x86-64"
#define KERNELS_TABLE       bead_kernels_sse2
extern const struct bead_kernels bead_kernels_sse2;
#include "sim/integrate/kernels_body.h"
#endif
