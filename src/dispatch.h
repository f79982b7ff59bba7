/*
 * dispatch.h - the builds of the filter that are in use
 */
#ifndef CYLINT_DISPATCH_H
#define CYLINT_DISPATCH_H

#include "filter/filter.h"

typedef struct {
    const char *name;
    const cylint_one_kernels *one;
    cylint_filter_many *many;
} cylint_kernels;

/* Reads a variable that another thread may write. */
#ifdef __GNUC__
#define CYLINT_LOAD(x) __atomic_load_n(&(x), __ATOMIC_RELAXED)
#else
#define CYLINT_LOAD(x) (x)
#endif

/* dispatch.c chooses when first called. */
extern const cylint_kernels *cylint_kernels_chosen CYLINT_HIDDEN;
const cylint_kernels *cylint_choose_kernels(void);
static inline const cylint_kernels *cylint_kernels_if_chosen(void)
{
    return CYLINT_LOAD(cylint_kernels_chosen);
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
    return CYLINT_LOAD(cylint_one_chosen);
}

#endif
