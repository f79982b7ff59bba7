/*
 * callbacks.c - what Embree calls: rays one by one and in packets
 */
#include "callbacks.h"

#include "packet.h"
#include "single_ray.h"

static void trace(query *q, unsigned primID, int *valid, void *packet,
                  unsigned N)
{
    if (N == 1)
        tell(valid, 0, cylint_trace_single(q, primID));
    else
        cylint_trace_packet(q, primID, valid, packet, N);
}

void cylint_embree_intersect_callback(
    const struct RTCIntersectFunctionNArguments *args)
{
    struct RTCRayHit *one = (struct RTCRayHit *)args->rayhit;
    query q;
    begin(&q, args->geometryUserPtr, args->context, args->geomID);
    q.nearest = args;
    q.ray = &one->ray;
    q.hit = &one->hit;
    trace(&q, args->primID, args->valid, args->rayhit, args->N);
}

void cylint_embree_occluded_callback(
    const struct RTCOccludedFunctionNArguments *args)
{
    query q;
    begin(&q, args->geometryUserPtr, args->context, args->geomID);
    q.any = args;
    q.ray = (struct RTCRay *)args->ray;
    trace(&q, args->primID, args->valid, args->ray, args->N);
}
