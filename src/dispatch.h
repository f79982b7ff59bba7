/*
 * dispatch.h - the build in use, of every file that has several
 */
#ifndef CYLINT_DISPATCH_H
#define CYLINT_DISPATCH_H

#include <string.h>

#include "filter/filter.h"

/* Each needs a processor that runs all before it. */
typedef enum {
    CYLINT_BUILD_PLAIN,
    CYLINT_BUILD_AVX2, /* and fused multiply-add */
    CYLINT_BUILD_AVX512,
    CYLINT_BUILDS
} cylint_build;

/* The best that the processor runs, chosen before main() or when the library is
 * loaded, or one that cylint_use_kernels() chose. */
extern cylint_build cylint_build_used CYLINT_HIDDEN;

/* The build in use, of three of an object.  A program links only the builds of what
 * it calls.  OF_KERNELS: the same in the other libraries, to which the variable is
 * hidden. */
#ifdef CYLINT_BUILDS_X86
#define CYLINT_OF_BUILD(plain, avx2, avx512)             \
    (cylint_build_used == CYLINT_BUILD_AVX512 ? (avx512) \
     : cylint_build_used == CYLINT_BUILD_AVX2 ? (avx2)   \
                                              : (plain))
#define CYLINT_OF_KERNELS(plain, avx2, avx512)                 \
    (strcmp(cylint_kernels_in_use(), "avx512") == 0 ? (avx512) \
     : strcmp(cylint_kernels_in_use(), "avx2") == 0 ? (avx2)   \
                                                    : (plain))
#else
#define CYLINT_OF_BUILD(plain, avx2, avx512) (plain)
#define CYLINT_OF_KERNELS(plain, avx2, avx512) (plain)
#endif

/* The same for questions in lanes.  enough: whether there are so many that AVX-512
 * takes less time than AVX2: its vectors cost more, also with empty lanes.
 * Measured: of batches and points a full vector, of chords and distances more than
 * half of one. */
enum { CYLINT_LANES_AVX512 = 8 };
#define CYLINT_OF_LANES(enough, name)            \
    CYLINT_OF_BUILD(&name##_plain, &name##_avx2, \
                    (enough) ? &name##_avx512 : &name##_avx2)

/* The address of NAME_plain or, on processors with a fused multiply-add, of
 * NAME_fma. */
#define CYLINT_OF_FMA(name) \
    CYLINT_OF_BUILD(&name##_plain, &name##_fma, &name##_fma)

/* The kernels for one line and one shape. */
extern const cylint_one_kernels *cylint_one_used CYLINT_HIDDEN;

#endif
