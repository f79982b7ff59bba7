/*
 * kernels_used.h - the builds of this library that belong to the kernels in use
 *
 * cylint_use_kernels() chooses for all libraries.
 */
#ifndef CYLINT_BVH_KERNELS_USED_H
#define CYLINT_BVH_KERNELS_USED_H

#include <string.h>

#include "cylint.h"

/* One of three builds of an object.  The names of the kernels are those of
 * dispatch.c. */
#ifdef CYLINT_BUILDS_X86
#define CYLINT_OF_KERNELS(plain, avx2, avx512)                 \
    (strcmp(cylint_kernels_in_use(), "avx512") == 0 ? (avx512) \
     : strcmp(cylint_kernels_in_use(), "avx2") == 0 ? (avx2)   \
                                                    : (plain))
#else
#define CYLINT_OF_KERNELS(plain, avx2, avx512) (plain)
#endif

#endif
