/*
 * rtcore.h - declares the part of Embree 4 that libcylint uses
 *
 * The PyPI wheel of Embree 4.4.0 has no headers.
 * These declarations were written from the published interface of Embree 4.3
 * and 4.4 (github.com/RenderKit/embree, doc/ and include/), in its default
 * configuration: one level of instances, instance arrays present.  They hold
 * only the names that the adapter and its tests use; other programs must use
 * Embree's headers.  tests/embree/test_answers.c tests by canaries that
 * the library's structures have this layout.
 */
#ifndef CYLINT_TESTS_EMBREE4_RTCORE_H
#define CYLINT_TESTS_EMBREE4_RTCORE_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

#define RTC_VERSION_MAJOR 4

#define RTC_MAX_INSTANCE_LEVEL_COUNT 1
#define RTC_GEOMETRY_INSTANCE_ARRAY
#define RTC_INVALID_GEOMETRY_ID ((unsigned int)-1)

#define RTC_ALIGN(bytes) __attribute__((aligned(bytes)))
#define RTC_FORCEINLINE static inline __attribute__((unused))

#ifdef __cplusplus
extern "C" {
#endif

/* -------------------------------------------------------------- device -- */

typedef struct RTCDeviceTy *RTCDevice;
typedef struct RTCSceneTy *RTCScene;
typedef struct RTCGeometryTy *RTCGeometry;
typedef struct RTCBufferTy *RTCBuffer;
typedef struct RTCSceneTy *RTCScene; /* again, as in Embree's own headers */

enum RTCDeviceProperty {
    RTC_DEVICE_PROPERTY_VERSION_MAJOR = 1,
    RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED = 64
};

enum RTCError {
    RTC_ERROR_INVALID_ARGUMENT = 2,
    RTC_ERROR_OUT_OF_MEMORY = 4
};

typedef void (*RTCErrorFunction)(void *user, enum RTCError, const char *text);
typedef bool (*RTCMemoryMonitorFunction)(void *user, ssize_t bytes, bool post);

RTCDevice rtcNewDevice(const char *config);
void rtcReleaseDevice(RTCDevice);
ssize_t rtcGetDeviceProperty(RTCDevice, enum RTCDeviceProperty);
void rtcSetDeviceErrorFunction(RTCDevice, RTCErrorFunction, void *user);
void rtcSetDeviceMemoryMonitorFunction(RTCDevice, RTCMemoryMonitorFunction,
                                       void *user);

RTCBuffer rtcNewBuffer(RTCDevice, size_t bytes);
void *rtcGetBufferData(RTCBuffer);
void rtcReleaseBuffer(RTCBuffer);

/* ---------------------------------------------------- rays, hits, boxes -- */

struct RTC_ALIGN(16) RTCBounds {
    float lower_x, lower_y, lower_z, align0;
    float upper_x, upper_y, upper_z, align1;
};

struct RTC_ALIGN(16) RTCRay {
    float org_x, org_y, org_z, tnear;
    float dir_x, dir_y, dir_z, time;
    float tfar;
    unsigned int mask, id, flags;
};

struct RTC_ALIGN(16) RTCHit {
    float Ng_x, Ng_y, Ng_z, u, v;
    unsigned int primID, geomID;
    unsigned int instID[RTC_MAX_INSTANCE_LEVEL_COUNT];
    unsigned int instPrimID[RTC_MAX_INSTANCE_LEVEL_COUNT];
};

struct RTCRayHit {
    struct RTCRay ray;
    struct RTCHit hit;
};

/* Packets hold the members of N rays, or hits, side by side. */
#define CYLINT_TESTS_PACKET(N) \
    struct RTC_ALIGN(4 * N) RTCRay##N { \
        float org_x[N], org_y[N], org_z[N], tnear[N]; \
        float dir_x[N], dir_y[N], dir_z[N], time[N]; \
        float tfar[N]; \
        unsigned int mask[N], id[N], flags[N]; \
    }; \
    struct RTC_ALIGN(4 * N) RTCHit##N { \
        float Ng_x[N], Ng_y[N], Ng_z[N], u[N], v[N]; \
        unsigned int primID[N], geomID[N]; \
        unsigned int instID[RTC_MAX_INSTANCE_LEVEL_COUNT][N]; \
        unsigned int instPrimID[RTC_MAX_INSTANCE_LEVEL_COUNT][N]; \
    }; \
    struct RTCRayHit##N { \
        struct RTCRay##N ray; \
        struct RTCHit##N hit; \
    }
CYLINT_TESTS_PACKET(4);
CYLINT_TESTS_PACKET(8);
CYLINT_TESTS_PACKET(16);
#undef CYLINT_TESTS_PACKET

/* N rays, N known when it runs: member k of ray i is word k N + i; a hit
 * begins at word 12 N. */
struct RTCRayN;
struct RTCHitN;
struct RTCRayHitN;

/* -------------------------------------------------------------- queries -- */

struct RTCRayQueryContext {
    unsigned int instID[RTC_MAX_INSTANCE_LEVEL_COUNT];
    unsigned int instPrimID[RTC_MAX_INSTANCE_LEVEL_COUNT];
};

RTC_FORCEINLINE void rtcInitRayQueryContext(struct RTCRayQueryContext *c)
{
    for (int level = 0; level < RTC_MAX_INSTANCE_LEVEL_COUNT; level++)
        c->instID[level] = c->instPrimID[level] = RTC_INVALID_GEOMETRY_ID;
}

enum RTCRayQueryFlags {
    RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER = 1 << 1,
    RTC_RAY_QUERY_FLAG_INCOHERENT = 0,
    RTC_RAY_QUERY_FLAG_COHERENT = 1 << 16
};

enum RTCFeatureFlags {
    RTC_FEATURE_FLAG_ALL = -1 /* every bit; ISO C wants an int */
};

struct RTCFilterFunctionNArguments {
    int *valid;
    void *geometryUserPtr;
    struct RTCRayQueryContext *context;
    struct RTCRayN *ray;
    struct RTCHitN *hit;
    unsigned int N;
};
typedef void (*RTCFilterFunctionN)(const struct RTCFilterFunctionNArguments *);

struct RTCIntersectFunctionNArguments {
    int *valid;
    void *geometryUserPtr;
    unsigned int primID;
    struct RTCRayQueryContext *context;
    struct RTCRayHitN *rayhit;
    unsigned int N, geomID;
};
typedef void (*RTCIntersectFunctionN)(
    const struct RTCIntersectFunctionNArguments *);

struct RTCOccludedFunctionNArguments {
    int *valid;
    void *geometryUserPtr;
    unsigned int primID;
    struct RTCRayQueryContext *context;
    struct RTCRayN *ray;
    unsigned int N, geomID;
};
typedef void (*RTCOccludedFunctionN)(
    const struct RTCOccludedFunctionNArguments *);

struct RTCIntersectArguments {
    enum RTCRayQueryFlags flags;
    enum RTCFeatureFlags feature_mask;
    struct RTCRayQueryContext *context;
    RTCFilterFunctionN filter;
    RTCIntersectFunctionN intersect;
};

struct RTCOccludedArguments {
    enum RTCRayQueryFlags flags;
    enum RTCFeatureFlags feature_mask;
    struct RTCRayQueryContext *context;
    RTCFilterFunctionN filter;
    RTCOccludedFunctionN occluded;
};

RTC_FORCEINLINE void rtcInitIntersectArguments(struct RTCIntersectArguments *a)
{
    a->flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
    a->feature_mask = RTC_FEATURE_FLAG_ALL;
    a->context = NULL;
    a->filter = NULL;
    a->intersect = NULL;
}

RTC_FORCEINLINE void rtcInitOccludedArguments(struct RTCOccludedArguments *a)
{
    a->flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
    a->feature_mask = RTC_FEATURE_FLAG_ALL;
    a->context = NULL;
    a->filter = NULL;
    a->occluded = NULL;
}

void rtcIntersect1(RTCScene, struct RTCRayHit *,
                   struct RTCIntersectArguments *);
void rtcIntersect4(const int *valid, RTCScene, struct RTCRayHit4 *,
                   struct RTCIntersectArguments *);
void rtcIntersect8(const int *valid, RTCScene, struct RTCRayHit8 *,
                   struct RTCIntersectArguments *);
void rtcIntersect16(const int *valid, RTCScene, struct RTCRayHit16 *,
                    struct RTCIntersectArguments *);
void rtcOccluded1(RTCScene, struct RTCRay *, struct RTCOccludedArguments *);
void rtcOccluded4(const int *valid, RTCScene, struct RTCRay4 *,
                  struct RTCOccludedArguments *);
void rtcOccluded8(const int *valid, RTCScene, struct RTCRay8 *,
                  struct RTCOccludedArguments *);
void rtcOccluded16(const int *valid, RTCScene, struct RTCRay16 *,
                   struct RTCOccludedArguments *);

/* ------------------------------------------------------------- geometry -- */

enum RTCGeometryType {
    RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE = 15,
    RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE = 16,
    RTC_GEOMETRY_TYPE_USER = 120,
    RTC_GEOMETRY_TYPE_INSTANCE = 121
};

enum RTCFormat {
    RTC_FORMAT_UCHAR = 0x1001,
    RTC_FORMAT_UINT = 0x5001,
    RTC_FORMAT_FLOAT4 = 0x9004,
    RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR = 0x9234
};

enum RTCBufferType {
    RTC_BUFFER_TYPE_INDEX = 0,
    RTC_BUFFER_TYPE_VERTEX = 1,
    RTC_BUFFER_TYPE_FLAGS = 32
};

enum RTCBuildQuality {
    RTC_BUILD_QUALITY_HIGH = 2
};

struct RTCBoundsFunctionArguments {
    void *geometryUserPtr;
    unsigned int primID, timeStep;
    struct RTCBounds *bounds_o;
};
typedef void (*RTCBoundsFunction)(const struct RTCBoundsFunctionArguments *);

RTCGeometry rtcNewGeometry(RTCDevice, enum RTCGeometryType);
void rtcReleaseGeometry(RTCGeometry);
void rtcCommitGeometry(RTCGeometry);
void rtcSetGeometryTimeStepCount(RTCGeometry, unsigned int);
void rtcSetGeometryMask(RTCGeometry, unsigned int);
void rtcSetGeometryUserData(RTCGeometry, void *);
void *rtcGetGeometryUserData(RTCGeometry);
void rtcSetGeometryUserPrimitiveCount(RTCGeometry, unsigned int);
void rtcSetGeometryBoundsFunction(RTCGeometry, RTCBoundsFunction, void *user);
void rtcSetGeometryIntersectFunction(RTCGeometry, RTCIntersectFunctionN);
void rtcSetGeometryOccludedFunction(RTCGeometry, RTCOccludedFunctionN);
void rtcSetGeometryIntersectFilterFunction(RTCGeometry, RTCFilterFunctionN);
void rtcSetGeometryOccludedFilterFunction(RTCGeometry, RTCFilterFunctionN);
void rtcInvokeIntersectFilterFromGeometry(
    const struct RTCIntersectFunctionNArguments *,
    const struct RTCFilterFunctionNArguments *);
void rtcInvokeOccludedFilterFromGeometry(
    const struct RTCOccludedFunctionNArguments *,
    const struct RTCFilterFunctionNArguments *);
void rtcSetGeometryInstancedScene(RTCGeometry, RTCScene);
void rtcSetGeometryTransform(RTCGeometry, unsigned int step, enum RTCFormat,
                             const void *matrix);
void *rtcSetNewGeometryBuffer(RTCGeometry, enum RTCBufferType,
                              unsigned int slot, enum RTCFormat,
                              size_t stride, size_t items);

/* ---------------------------------------------------------------- scene -- */

enum RTCSceneFlags {
    RTC_SCENE_FLAG_ROBUST = 4,
    RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS = 8
};

RTCScene rtcNewScene(RTCDevice);
void rtcReleaseScene(RTCScene);
RTCDevice rtcGetSceneDevice(RTCScene);
unsigned int rtcAttachGeometry(RTCScene, RTCGeometry);
void rtcAttachGeometryByID(RTCScene, RTCGeometry, unsigned int geomID);
void rtcDetachGeometry(RTCScene, unsigned int geomID);
void rtcSetSceneFlags(RTCScene, enum RTCSceneFlags);
void rtcSetSceneBuildQuality(RTCScene, enum RTCBuildQuality);
void rtcCommitScene(RTCScene);
void rtcGetSceneBounds(RTCScene, struct RTCBounds *);

#ifdef __cplusplus
}
#endif

#endif
