/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kernels of kernels_body.h, compiled for AVX2. */
#ifdef __x86_64__
#define KERNELS_NAME        "avx2"
#define KERNELS_DESCRIPTION "x86-64-v3"
#define KERNELS_TABLE       bead_kernels_avx2
extern const struct bead_kernels bead_kernels_avx2;
#include "sim/integrate/kernels_body.h"

void bead_correct_few_kinks(const struct bead_patch_source *source, const struct bead_kink_method *method, size_t count,
                            struct bead_event_flags *flags, double tolerance, struct bead_kinks *kinks)
{
    correct_kinks(source, method, count, flags, tolerance, kinks);
}

void bead_integrate_few(const struct bead_patch_piece *piece, const struct bead_patch_rule *rule, size_t sweeps,
                        struct bead_patch *patch)
{
    integrate_piece(piece, rule, sweeps, patch);
}
#endif
