/*
 * embree_dispatch.c - the builds for this processor of what is compiled for
 * several instruction sets
 */
#include "float_filter.h"
#include "packet_filter.h"
#include "packet_traverse.h"

#ifdef CYLINT_BUILDS_X86
static int has_fma(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}
#endif

cylint_walk_packet *cylint_packet_used(void)
{
#ifdef CYLINT_BUILDS_X86
    if (has_fma())
        return cylint_packet_avx2;
#endif
    return cylint_packet_plain;
}

const cylint_quick_build *cylint_quick_used(void)
{
#ifdef CYLINT_BUILDS_X86
    if (has_fma())
        return &cylint_quick_fma;
#endif
    return &cylint_quick_plain;
}

#ifdef CYLINT_BUILDS_X86
static int has_avx512(void)
{
    return has_fma() && __builtin_cpu_supports("avx512f") &&
           __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq");
}
#endif

cylint_quick_many *cylint_quick_many_build(int i)
{
#ifdef CYLINT_BUILDS_X86
    if (has_avx512() && i-- == 0)
        return cylint_quick_many_avx512;
    if (has_fma() && i-- == 0)
        return cylint_quick_many_avx2;
#endif
    return i == 0 ? cylint_quick_many_plain : NULL;
}
