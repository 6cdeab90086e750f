/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The instruction sets that inner loops are compiled for: does this processor have one? */
#pragma once

#include <stdbool.h>
#include <string.h>

/* `set`: portable, or of x86-64 sse2, avx2, avx512 (with BW, DQ and VL: all processors but Xeon Phi). */
static inline bool bead_instruction_set_here(const char *set)
{
#ifdef __x86_64__
    if (strcmp(set, "avx512") == 0)
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl");
    if (strcmp(set, "avx2") == 0)
        return __builtin_cpu_supports("avx2");
#endif
    (void)set;
    return true;
}
