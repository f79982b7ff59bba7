/*
 * dispatch.h - the build in use, of every file that has several
 */
#ifndef CYLINT_DISPATCH_H
#define CYLINT_DISPATCH_H

#include "filter/filter.h"

/* Each needs a processor that runs all before it. */
typedef enum {
    CYLINT_BUILD_PLAIN,
    CYLINT_BUILD_AVX2, /* and fused multiply-add */
    CYLINT_BUILD_AVX512,
    CYLINT_BUILDS
} cylint_build;

/* One of three builds of an object.  A program links the builds of what it calls
 * only. */
#ifdef CYLINT_BUILDS_X86
#define CYLINT_OF_BUILD(build, plain, avx2, avx512) \
    ((build) == CYLINT_BUILD_AVX512 ? (avx512)      \
     : (build) == CYLINT_BUILD_AVX2 ? (avx2)        \
                                    : (plain))
#else
#define CYLINT_OF_BUILD(build, plain, avx2, avx512) ((void)(build), (plain))
#endif

/* Reads a variable that another thread may write. */
#ifdef __GNUC__
#define CYLINT_LOAD(x) __atomic_load_n(&(x), __ATOMIC_RELAXED)
#else
#define CYLINT_LOAD(x) (x)
#endif

/* CYLINT_BUILDS: not chosen.  dispatch.c chooses when first called. */
extern cylint_build cylint_build_chosen CYLINT_HIDDEN;
cylint_build cylint_choose_build(void);
static inline cylint_build cylint_build_used(void)
{
    const cylint_build build = CYLINT_LOAD(cylint_build_chosen);
    return build == CYLINT_BUILDS ? cylint_choose_build() : build;
}

/* The address of NAME_plain or, on processors with a fused multiply-add, of
 * NAME_fma. */
#define CYLINT_OF_FMA(name)                                          \
    CYLINT_OF_BUILD(cylint_build_used(), &name##_plain, &name##_fma, \
                    &name##_fma)

/* The kernel for many questions. */
static inline cylint_filter_many *cylint_many_used(void)
{
    return CYLINT_OF_BUILD(cylint_build_used(), cylint_many_plain,
                           cylint_many_avx2, cylint_many_avx512);
}

/* The kernels for one line and one shape.  Before the first use these are
 * functions that choose the build. */
extern const cylint_one_kernels *cylint_one_chosen CYLINT_HIDDEN;
static inline const cylint_one_kernels *cylint_one_used(void)
{
    return CYLINT_LOAD(cylint_one_chosen);
}

#endif
