/*
 * embree_dispatch.c - chooses the builds for this processor of the files that
 * are compiled for several instruction sets
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

cylint_traverse_packet *cylint_traverse_packet_used(void)
{
#ifdef CYLINT_BUILDS_X86
    if (has_fma())
        return cylint_traverse_packet_avx2;
#endif
    return cylint_traverse_packet_plain;
}

const cylint_float_filter *cylint_float_filter_used(void)
{
#ifdef CYLINT_BUILDS_X86
    if (has_fma())
        return &cylint_float_filter_fma;
#endif
    return &cylint_float_filter_plain;
}

#ifdef CYLINT_BUILDS_X86
static int has_avx512(void)
{
    return has_fma() && __builtin_cpu_supports("avx512f") &&
           __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq");
}
#endif

cylint_packet_filter *cylint_packet_filter_build(int i)
{
#ifdef CYLINT_BUILDS_X86
    if (has_avx512() && i-- == 0)
        return cylint_packet_filter_avx512;
    if (has_fma() && i-- == 0)
        return cylint_packet_filter_avx2;
#endif
    return i == 0 ? cylint_packet_filter_plain : NULL;
}
