/*
 * callbacks.c - the functions that Embree calls with rays
 */
#include "callbacks.h"

#include "packet.h"
#include "single_ray.h"

static void trace(ray_test *r, unsigned primID, int *valid, void *packet,
                  unsigned N)
{
    if (N == 1)
        set_valid(valid, 0, cylint_trace_single(r, primID));
    else
        cylint_trace_packet(r, primID, valid, packet, N);
}

void cylint_embree_intersect_callback(
    const struct RTCIntersectFunctionNArguments *args)
{
    struct RTCRayHit *one = (struct RTCRayHit *)args->rayhit;
    ray_test r;
    initialise(&r, args->geometryUserPtr, args->context, args->geomID);
    r.nearest = args;
    r.ray = &one->ray;
    r.hit = &one->hit;
    trace(&r, args->primID, args->valid, args->rayhit, args->N);
}

void cylint_embree_occluded_callback(
    const struct RTCOccludedFunctionNArguments *args)
{
    ray_test r;
    initialise(&r, args->geometryUserPtr, args->context, args->geomID);
    r.any = args;
    r.ray = (struct RTCRay *)args->ray;
    trace(&r, args->primID, args->valid, args->ray, args->N);
}
