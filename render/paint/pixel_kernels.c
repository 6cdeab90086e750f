/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which instruction set paints, converts and draws curves: the best that this processor has, or the one asked for. */
#include "render/paint/pixel_kernels.h"

#include <stdbool.h>
#include <string.h>

extern const struct bead_pixel_kernels bead_pixel_kernels_portable;

static bool always(void)
{
    return true;
}

#ifdef __x86_64__
extern const struct bead_pixel_kernels bead_pixel_kernels_sse2, bead_pixel_kernels_avx2, bead_pixel_kernels_avx512;

static bool has_avx2(void)
{
    return __builtin_cpu_supports("avx2");
}

static bool has_avx512(void)
{
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
}
#endif

/* Best first. */
static const struct {
    const struct bead_pixel_kernels *kernels;
    bool (*usable)(void);
} sets[] = {
#ifdef __x86_64__
    {&bead_pixel_kernels_avx512, has_avx512},
    {&bead_pixel_kernels_avx2, has_avx2},
    {&bead_pixel_kernels_sse2, always},
#endif
    {&bead_pixel_kernels_portable, always},
};

const struct bead_pixel_kernels *bead_pixel_kernels_find(const char *name)
{
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        if ((!name || strcmp(name, sets[i].kernels->name) == 0) && sets[i].usable())
            return sets[i].kernels;
    }
    return NULL;
}
