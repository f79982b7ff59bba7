/*
 * bvh_dispatch.c - chooses the builds of traverse.c and traverse_point.c for this
 * processor
 */
#include "traverse.h"
#include "traverse_point.h"

#ifdef CYLINT_COUNT_VISITS
struct cylint_visits cylint_visits;
#endif

#ifdef CYLINT_BUILDS_X86
static int has_fma(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}

/* Its vectors have 256 bits too, but there are 32 of them. */
static int has_avx512(void)
{
    return has_fma() && __builtin_cpu_supports("avx512f") &&
           __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq");
}
#endif

const cylint_traversal *cylint_traversal_used(void)
{
#ifdef CYLINT_BUILDS_X86
    if (has_avx512())
        return &cylint_traversal_avx512;
    if (has_fma())
        return &cylint_traversal_avx2;
#endif
    return &cylint_traversal_plain;
}

cylint_traverse_point *cylint_traverse_point_used(void)
{
#ifdef CYLINT_BUILDS_X86
    if (has_avx512())
        return cylint_traverse_point_avx512;
    if (has_fma())
        return cylint_traverse_point_avx2;
#endif
    return cylint_traverse_point_plain;
}
