/*
 * single_ray.c - traces one ray through the shapes of a geometry
 */
#include "single_ray.h"

static int test_lanes(void *self, const cylint_leaf *leaf, unsigned lanes,
                      const float least[CYLINT_LEAF_SIZE])
{
    return cylint_ray_test_lanes(self, leaf, lanes, least);
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
        if (traversal->occluded(&r->data->bvh, ray, test_lanes, r)) {
            r->ray->tfar = -HUGE_VALF;
            return 1;
        }
    } else {
        traversal->ray(&r->data->bvh, ray, test_lanes, r);
    }
    return r->found;
}
