/*
 * dispatch.h - the builds of the filter that are in use
 */
#ifndef CYLINT_DISPATCH_H
#define CYLINT_DISPATCH_H

#include "filter/filter.h"

typedef struct {
    const char *name;
    const cylint_one_kernels *one;
    cylint_filter_next *many;
} cylint_kernels;

/* dispatch.c chooses when first called. */
extern const cylint_kernels *cylint_kernels_chosen CYLINT_HIDDEN;
const cylint_kernels *cylint_choose_kernels(void);
static inline const cylint_kernels *cylint_kernels_if_chosen(void)
{
#ifdef __GNUC__
    return __atomic_load_n(&cylint_kernels_chosen, __ATOMIC_RELAXED);
#else
    return cylint_kernels_chosen;
#endif
}

static inline const cylint_kernels *cylint_kernels_used(void)
{
    const cylint_kernels *kernels = cylint_kernels_if_chosen();
    return kernels ? kernels : cylint_choose_kernels();
}

/* The kernels for one line and one shape.  Before the first use these are
 * functions that choose the build. */
extern const cylint_one_kernels *cylint_one_chosen CYLINT_HIDDEN;
static inline const cylint_one_kernels *cylint_one_used(void)
{
#ifdef __GNUC__
    return __atomic_load_n(&cylint_one_chosen, __ATOMIC_RELAXED);
#else
    return cylint_one_chosen;
#endif
}

#endif
