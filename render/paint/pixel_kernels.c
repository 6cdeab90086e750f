/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses the instruction set for loops over pixels: the best of this processor, or the one asked for. */
#include "render/paint/pixel_kernels.h"

#include "sim/base/instruction_set.h"

extern const struct bead_pixel_kernels bead_pixel_kernels_portable;
#ifdef __x86_64__
extern const struct bead_pixel_kernels bead_pixel_kernels_sse2, bead_pixel_kernels_avx2, bead_pixel_kernels_avx512;
#endif

/* Best first. */
static const struct bead_pixel_kernels *const sets[] = {
#ifdef __x86_64__
    &bead_pixel_kernels_avx512,
    &bead_pixel_kernels_avx2,
    &bead_pixel_kernels_sse2,
#endif
    &bead_pixel_kernels_portable,
};

const struct bead_pixel_kernels *bead_pixel_kernels_find(const char *name)
{
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        if ((!name || strcmp(name, sets[i]->name) == 0) && bead_instruction_set_here(sets[i]->name))
            return sets[i];
    }
    return NULL;
}
