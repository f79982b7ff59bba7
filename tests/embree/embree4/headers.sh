#!/bin/sh
# usage: headers.sh FOLDER    writes headers of Embree 4 to FOLDER/embree4
#
# The wheel of fetch.sh has none.  These are Embree 3's with what the adapter and its
# tests use of the interface of Embree 4.3 and 4.4 in its default configuration
# (github.com/RenderKit/embree, doc/ and include/): one level of instances, instance
# arrays.  With another layout of a structure the tests of rays fail.
from=$(echo '#include <embree3/rtcore.h>' | ${CC:-cc} -M -xc - 2>/dev/null |
    tr ' ' '\n' | sed -n 's|/rtcore\.h$||p')
[ -n "$from" ] || { echo 'no Embree 4: no headers of Embree 3 (make deps)'; exit 77; }
mkdir -p "$1/embree4" || exit 1
for header in config common device buffer ray quaternion geometry scene; do
    sed -E 's/MAJOR 3/MAJOR 4/
        s/INSTANCE_LEVEL_COUNT 1$/&\n#define RTC_GEOMETRY_INSTANCE_ARRAY/
        s/IntersectContext/RayQueryContext/g
        /^  (enum RTCRayQueryContextFlags flags|RTCFilterFunctionN filter);/d
        /^  context->(flags|filter) =/d
        s/context->instID\[l\] =/& context->instPrimID[l] =/
        s/^( *unsigned int )instID([^;]*);/\1instID\2, instPrimID\2;/
        s/rtcFilterIntersection/rtcInvokeIntersectFilterFromGeometry/
        s/rtcFilterOcclusion/rtcInvokeOccludedFilterFromGeometry/
        s/CONTEXT_FILTER_FUNCTION/FILTER_FUNCTION_IN_ARGUMENTS/
        s/(rtc(Intersect|Occluded)[0-9]+\(.*)struct RTCRayQueryContext\* context, (.*)\);/\1\3, struct RTC\2Arguments* args);/
        ' "$from/rtcore_$header.h" > "$1/embree4/rtcore_$header.h" || exit 1
done
cat > "$1/embree4/rtcore.h" << 'END'
#pragma once
#include "rtcore_ray.h"
#include "rtcore_geometry.h"
enum RTCRayQueryFlags {
    RTC_RAY_QUERY_FLAG_INCOHERENT = 0,
    RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER = 1 << 1,
    RTC_RAY_QUERY_FLAG_COHERENT = 1 << 16
};
enum RTCFeatureFlags { RTC_FEATURE_FLAG_ALL = -1 }; /* ISO C requires an int */
#define RTC_ARGUMENTS(Query, query)                               \
    struct RTC##Query##Arguments {                                \
        enum RTCRayQueryFlags flags;                              \
        enum RTCFeatureFlags feature_mask;                        \
        struct RTCRayQueryContext *context;                       \
        RTCFilterFunctionN filter;                                \
        RTC##Query##FunctionN query;                              \
    };                                                            \
    RTC_FORCEINLINE void rtcInit##Query##Arguments(               \
        struct RTC##Query##Arguments *a)                          \
    {                                                             \
        a->flags = RTC_RAY_QUERY_FLAG_INCOHERENT;                 \
        a->feature_mask = RTC_FEATURE_FLAG_ALL;                   \
        a->context = NULL, a->filter = NULL, a->query = NULL;     \
    }
RTC_ARGUMENTS(Intersect, intersect)
RTC_ARGUMENTS(Occluded, occluded)
#include "rtcore_scene.h"
END
