/*
 * embree_dispatch.c - the builds in use of the files that are compiled for
 * several instruction sets
 */
#include "../bvh/kernels_used.h"
#include "float_filter.h"
#include "packet_traverse.h"

cylint_traverse_packet *cylint_traverse_packet_used(void)
{
    return CYLINT_OF_KERNELS(cylint_traverse_packet_plain,
                             cylint_traverse_packet_avx2,
                             cylint_traverse_packet_avx2);
}

cylint_float_filter *cylint_float_filter_used(int many)
{
    return many ? CYLINT_OF_KERNELS(cylint_float_filter_plain,
                                    cylint_float_filter_avx2,
                                    cylint_float_filter_avx512)
                : CYLINT_OF_KERNELS(cylint_float_filter_plain,
                                    cylint_float_filter_fma,
                                    cylint_float_filter_fma);
}
