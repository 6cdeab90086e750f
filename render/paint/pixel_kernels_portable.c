/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kernels of pixel_kernels_body.h for any processor, in the compiler's vector types. */
#define KERNELS_NAME  "portable"
#define KERNELS_TABLE bead_pixel_kernels_portable
#define KERNELS_PORTABLE
#include "render/paint/pixel_kernels_body.h"
