/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kernels of kernels_body.h for any processor, in the compiler's vector types. */
#define KERNELS_NAME        "portable"
#define KERNELS_DESCRIPTION "any processor"
#define KERNELS_TABLE       bead_kernels_portable
#define KERNELS_PORTABLE
extern const struct bead_kernels bead_kernels_portable;
#include "sim/integrate/kernels_body.h"
