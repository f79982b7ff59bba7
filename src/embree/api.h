/*
 * api.h - one interface to Embree 3 and 4, as far as the adapter uses it
 *
 * The Makefile defines CYLINT_EMBREE, the major version.
 */
#ifndef CYLINT_EMBREE_API_H
#define CYLINT_EMBREE_API_H

#if CYLINT_EMBREE == 4

#include <embree4/rtcore.h>

typedef struct RTCRayQueryContext cylint_rtc_context;

#define cylint_rtc_filter_hit(args, filter) \
    rtcInvokeIntersectFilterFromGeometry(args, filter)
#define cylint_rtc_filter_occluded(args, filter) \
    rtcInvokeOccludedFilterFromGeometry(args, filter)

#else

#include <embree3/rtcore.h>

typedef struct RTCIntersectContext cylint_rtc_context;

#define cylint_rtc_filter_hit(args, filter) rtcFilterIntersection(args, filter)
#define cylint_rtc_filter_occluded(args, filter) \
    rtcFilterOcclusion(args, filter)

#endif

/* Whether hits and contexts have the member instPrimID. */
#ifdef RTC_GEOMETRY_INSTANCE_ARRAY
#define CYLINT_INSTANCE_ARRAYS 1
#else
#define CYLINT_INSTANCE_ARRAYS 0
#endif

#if RTC_VERSION_MAJOR != CYLINT_EMBREE
#error "rtcore.h is of another major version of Embree than CYLINT_EMBREE"
#endif

#endif
