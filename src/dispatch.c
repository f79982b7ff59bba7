/*
 * dispatch.c - which processor is this, and which build of the kernels
 */
#include "kernels.h"

const cylint_kernels *cylint_best_kernels(void)
{
#ifdef CYLINT_HAVE_FMA_KERNELS
    /* both the processor and the system's saved state are checked */
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return &cylint_kernels_fma;
#endif
    return &cylint_kernels_plain;
}
