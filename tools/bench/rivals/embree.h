/*
 * embree.h - single rays and occlusion queries by Embree 3 or 4, and the union of
 * chords in cylinders, as a caller of Embree computes it
 *
 * The Makefile defines CYLINT_EMBREE, the major version.
 */
#ifndef BENCH_EMBREE_H
#define BENCH_EMBREE_H

#include <stddef.h>

#include "cylint.h"

#if CYLINT_EMBREE == 4
#include <embree4/rtcore.h>
typedef struct RTCRayQueryContext embree_context;
#define embree_begin(context) rtcInitRayQueryContext(context)
#else
#include <embree3/rtcore.h>
typedef struct RTCIntersectContext embree_context;
#define embree_begin(context) rtcInitIntersectContext(context)
#endif

/* The functions of Embree 3, with n = 1 or 16: embree_nearest(scene, context,
 * RTCRayHit*), embree_any(scene, context, RTCRay*), and in packets. */
#if CYLINT_EMBREE == 4
#define EMBREE_CALL(call, kind, coherent, scene, user, ...)      \
    do {                                                         \
        struct RTC##kind##Arguments args;                        \
        rtcInit##kind##Arguments(&args);                         \
        args.context = user;                                     \
        args.flags = (coherent) ? RTC_RAY_QUERY_FLAG_COHERENT    \
                                : RTC_RAY_QUERY_FLAG_INCOHERENT; \
        call(__VA_ARGS__, &args);                                \
    } while (0)
#define embree_nearest(scene, c, ray) \
    EMBREE_CALL(rtcIntersect1, Intersect, 0, scene, c, scene, ray)
#define embree_any(scene, c, ray) \
    EMBREE_CALL(rtcOccluded1, Occluded, 0, scene, c, scene, ray)
#define embree_nearest16(valid, scene, c, rays) \
    EMBREE_CALL(rtcIntersect16, Intersect, 1, scene, c, valid, scene, rays)
#else
#define embree_nearest(scene, c, ray) rtcIntersect1(scene, c, ray)
#define embree_any(scene, c, ray) rtcOccluded1(scene, c, ray)
#define embree_nearest16(valid, scene, c, rays)        \
    ((c)->flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT, \
     rtcIntersect16(valid, scene, c, rays))
#endif

/* A device of one thread, which ends the program if Embree fails. */
RTCDevice embree_device(void);

struct embree_chords *embree_chords_new(float (*end)[2][3], float (*radius)[2],
                                        size_t n);
void embree_chords_free(struct embree_chords *scene);

/* The length of the union of a ray's chords; d has length 1. */
double embree_chords_union(const struct embree_chords *scene,
                           const cylint_line *ray);

#endif
