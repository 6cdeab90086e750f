#define KERNELS_NAME        "avx2"
#define KERNELS_DESCRIPTION "x86-64-v3"
#define KERNELS_TABLE       bead_kernels_avx2
extern const struct bead_kernels bead_kernels_avx2;
#include "sim/kernels_body.h"
