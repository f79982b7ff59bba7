/*
 * api.h - one interface to Embree 3 and 4, as far as the adapter uses it
 *
 * The Makefile defines CYLINT_EMBREE, the major version.
 */
#ifndef CYLINT_EMBREE_API_H
#define CYLINT_EMBREE_API_H

#include <stddef.h>

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

/* The ids of instances in hits and contexts: instID and, behind it, instPrimID if
 * there are arrays of instances. */
#ifdef RTC_GEOMETRY_INSTANCE_ARRAY
enum { CYLINT_INSTANCE_BYTES = 2 * 4 * RTC_MAX_INSTANCE_LEVEL_COUNT };
#else
enum { CYLINT_INSTANCE_BYTES = 4 * RTC_MAX_INSTANCE_LEVEL_COUNT };
#endif

static inline const void *cylint_rtc_instance(const cylint_rtc_context *context)
{
    return (const char *)context + offsetof(cylint_rtc_context, instID);
}

#if RTC_VERSION_MAJOR != CYLINT_EMBREE
#error "rtcore.h is of another major version of Embree than CYLINT_EMBREE"
#endif

#endif
