/*
 * single_ray.c - traces one ray through the shapes of a geometry
 */
#include "single_ray.h"

/* Tests the lanes that the ray may hit, nearest first, until no remaining lane
 * can hold the nearest hit. */
static int test_lanes_in_order(void *self, const cylint_leaf *leaf,
                               unsigned lanes,
                               const float least[CYLINT_LEAF_SIZE])
{
    ray_test *r = self;
    prefetch_shapes(r->data, leaf, lanes);
    while (lanes && select_nearest_lane(r, leaf, &lanes, least)) {
        r->found |= cylint_ray_test_lane(r);
        if (r->found && r->any)
            return 1;
    }
    return 0;
}

int cylint_trace_single(ray_test *r, unsigned primID)
{
    const cylint_traversal *traversal = r->data->traversal;
    if (!set_line(r))
        return 0;
    if (!traversal)
        return cylint_ray_test_shape(r, primID, 0);
    const cylint_float_ray *ray = float_ray(r->ray);
    if (r->any && !has_filters(r)) {
        if (traversal->occluded(&r->data->bvh, ray, test_lanes_in_order, r)) {
            r->ray->tfar = -HUGE_VALF;
            return 1;
        }
    } else {
        traversal->ray(&r->data->bvh, ray, test_lanes_in_order, r);
    }
    return r->found;
}
