/*
 * walks.c - the walk for this processor
 */
#include "walk.h"

#ifdef CYLINT_COUNT_VISITS
struct cylint_visits cylint_visits;
#endif

const cylint_walks *cylint_walks_used(void)
{
#ifdef CYLINT_BUILDS_X86
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return &cylint_walks_avx2;
#endif
    return &cylint_walks_plain;
}
