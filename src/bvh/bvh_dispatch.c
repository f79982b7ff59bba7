/*
 * bvh_dispatch.c - the builds of traverse.c and traverse_point.c in use
 */
#include "kernels_used.h"
#include "traverse.h"
#include "traverse_point.h"

const cylint_traversal *cylint_traversal_used(void)
{
    return CYLINT_OF_KERNELS(&cylint_traversal_plain, &cylint_traversal_avx2,
                             &cylint_traversal_avx512);
}

cylint_traverse_point *cylint_traverse_point_used(void)
{
    return CYLINT_OF_KERNELS(cylint_traverse_point_plain,
                             cylint_traverse_point_avx2,
                             cylint_traverse_point_avx512);
}
