/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kernels of pixel_kernels_body.h, compiled for AVX2. */
#ifdef __x86_64__
#define KERNELS_NAME  "avx2"
#define KERNELS_TABLE bead_pixel_kernels_avx2
#include "render/paint/pixel_kernels_body.h"
#endif
