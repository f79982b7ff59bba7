/*
 * trace.c - Embree's callbacks, and rays one by one
 *
 * All blocks are one primitive, through which walk.h leads.
 */
#include "query.h"

/* The lanes the ray may meet, nearest first, until none can come first. */
static int try_lanes(void *self, const cylint_block *block, unsigned lanes,
                     const float least[CYLINT_BLOCK])
{
    query *q = self;
    fetch_shapes(q->data, block, lanes);
    while (lanes && turn_to_nearest(q, block, &lanes, least)) {
        q->met |= cylint_query_try(q, block->number[q->lane], 0);
        if (q->met && q->any)
            return 1;
    }
    return 0;
}

int cylint_trace_one(query *q, unsigned primID)
{
    if (!is_set_out(q))
        return 0;
    if (!q->data->walk)
        return cylint_query_try(q, primID, 0);
    const cylint_float_ray *ray = floats_of_ray(q->ray);
    if (q->any && !has_filters(q)) {
        if (q->data->walk->shadow(&q->data->group, ray, try_lanes, q)) {
            q->ray->tfar = -HUGE_VALF;
            return 1;
        }
    } else {
        q->data->walk->ray(&q->data->group, ray, try_lanes, q);
    }
    return q->met;
}

static void trace(query *q, unsigned primID, int *valid, void *packet,
                  unsigned N)
{
    if (N == 1)
        tell(valid, 0, cylint_trace_one(q, primID));
    else
        cylint_trace_packet(q, primID, valid, packet, N);
}

void cylint_embree_trace(const struct RTCIntersectFunctionNArguments *args)
{
    struct RTCRayHit *one = (struct RTCRayHit *)args->rayhit;
    query q;
    begin(&q, args->geometryUserPtr, args->context, args->geomID);
    q.nearest = args;
    q.ray = &one->ray;
    q.hit = &one->hit;
    trace(&q, args->primID, args->valid, args->rayhit, args->N);
}

void cylint_embree_shadow(const struct RTCOccludedFunctionNArguments *args)
{
    query q;
    begin(&q, args->geometryUserPtr, args->context, args->geomID);
    q.any = args;
    q.ray = (struct RTCRay *)args->ray;
    trace(&q, args->primID, args->valid, args->ray, args->N);
}
