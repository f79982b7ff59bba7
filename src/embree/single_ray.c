/*
 * single_ray.c - rays one by one
 *
 * All blocks are one primitive, through which traverse.h leads.
 */
#include "single_ray.h"

/* The lanes the ray may meet, nearest first, until none can come first. */
static int try_lanes(void *self, const cylint_leaf *block, unsigned lanes,
                     const float least[CYLINT_LEAF_SIZE])
{
    query *q = self;
    fetch_shapes(q->data, block, lanes);
    while (lanes && turn_to_nearest(q, block, &lanes, least)) {
        q->met |= cylint_ray_test_shape(q, block->number[q->lane], 0);
        if (q->met && q->any)
            return 1;
    }
    return 0;
}

int cylint_trace_single(query *q, unsigned primID)
{
    if (!is_set_out(q))
        return 0;
    if (!q->data->walk)
        return cylint_ray_test_shape(q, primID, 0);
    const cylint_float_ray *ray = floats_of_ray(q->ray);
    if (q->any && !has_filters(q)) {
        if (q->data->walk->occluded(&q->data->group, ray, try_lanes, q)) {
            q->ray->tfar = -HUGE_VALF;
            return 1;
        }
    } else {
        q->data->walk->ray(&q->data->group, ray, try_lanes, q);
    }
    return q->met;
}
