/*
 * bvh_dispatch.c - chooses the build of traverse.c for this processor
 */
#include "traverse.h"

#ifdef CYLINT_COUNT_VISITS
struct cylint_visits cylint_visits;
#endif

#ifdef CYLINT_BUILDS_X86
static int has_fma(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}
#endif

const cylint_traversal *cylint_traversal_used(void)
{
#ifdef CYLINT_BUILDS_X86
    if (has_fma())
        return &cylint_traversal_avx2;
#endif
    return &cylint_traversal_plain;
}
