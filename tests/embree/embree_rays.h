/*
 * embree_rays.h - rays for Embree 3 and 4 as words, checked for stray writes
 *
 * Embree lays out n rays member by member: member m of ray i is word m n + i,
 * for n = 1 too; a hit's members follow the ray's.  So one array of words holds
 * single rays and packets of 4, 8 and 16, and every word that a query must not
 * write can be compared with its value before.
 */
#ifndef CYLINT_EMBREE_RAYS_H
#define CYLINT_EMBREE_RAYS_H

#include <string.h>

#include "cylint.h"
#include "cylint_embree.h"
#include "embree/geometry.h"

enum ray_member {
    RAY_ORG = 0, /* x, y, z */
    RAY_TNEAR = 3,
    RAY_DIR = 4, /* x, y, z */
    RAY_TIME = 7,
    RAY_TFAR = 8,
    RAY_MASK,
    RAY_ID,
    RAY_FLAGS,
    HIT_NG = 12, /* x, y, z */
    HIT_U = 15,
    HIT_V,
    HIT_PRIM,
    HIT_GEOM,
    HIT_INST,
#if RTC_VERSION_MAJOR >= 4
    HIT_INST_PRIM,
#endif
    RAY_MEMBERS
};

enum {
    RAYS_MOST = 16,
    RAYS_WORDS = sizeof(struct RTCRayHit16) / 4,
    RAYS_BEYOND = 16 /* words after the last that no query may write */
};

union ray_word {
    float f;
    unsigned u;
};

/* The numbers of rays that Embree traces at once. */
static const int rays_sizes[4] = {1, 4, 8, 16};
#define EACH_SIZE(n) for (int n = 1; n <= 16; n = n == 1 ? 4 : 2 * n)

/* Rays are added one by one; the others are inactive. */
struct rays {
    union ray_word word[RAYS_WORDS + RAYS_BEYOND];
    int valid[RAYS_MOST];
    union ray_word before[RAYS_WORDS + RAYS_BEYOND]; /* before the query */
    int n;
} __attribute__((aligned(64)));

enum { UNTOUCHED = 0x5a };

static inline void rays_begin(struct rays *r, int n)
{
    memset(r, UNTOUCHED, sizeof *r);
    memset(r->valid, 0, sizeof r->valid);
    r->n = n;
}

static inline union ray_word *rays_at(struct rays *r, enum ray_member m, int i)
{
    return &r->word[(int)m * r->n + i];
}

static inline void rays_add(struct rays *r, int i, const float o[3],
                            const float d[3], float tnear, float tfar)
{
    for (int k = 0; k < 3; k++) {
        r->word[(RAY_ORG + k) * r->n + i].f = o[k];
        r->word[(RAY_DIR + k) * r->n + i].f = d[k];
    }
    rays_at(r, RAY_TNEAR, i)->f = tnear;
    rays_at(r, RAY_TFAR, i)->f = tfar;
    rays_at(r, RAY_TIME, i)->f = 0;
    rays_at(r, RAY_MASK, i)->u = 0xffffffffu;
    rays_at(r, RAY_ID, i)->u = (unsigned)i;
    rays_at(r, RAY_FLAGS, i)->u = 0;
    for (int m = HIT_PRIM; m < RAY_MEMBERS; m++)
        r->word[m * r->n + i].u = RTC_INVALID_GEOMETRY_ID;
    r->valid[i] = -1;
}

/* ------------------------------------------------------------- queries -- */

/* Arguments of a query; NULL: the defaults. */
struct rays_query {
    RTCFilterFunctionN filter; /* the context's (3), the arguments' (4) */
    int coherent;
    void *user;        /* for the filter: see rays_user() */
    unsigned instance; /* in which the query runs, from 1; 0: in none */
};

/* Embree passes the context to callbacks and filters, and with it the members
 * that follow: in Embree 4 the filter of CYLINT_EMBREE_CONTEXT_FILTER. */
struct call {
#if RTC_VERSION_MAJOR >= 4
    struct RTCRayQueryContext context;
    RTCFilterFunctionN filter;
#else
    struct RTCIntersectContext context;
#endif
    void *user;
};

/*
 * Whether Embree traces packets of n rays as such on this processor.  Otherwise
 * Embree 3 traces them as a stream: it ignores `valid`, so that only an empty
 * domain makes a ray inactive (remember() writes one), and it copies every
 * member of a hit, so that u, v and Ng of a bare hit are undefined.
 */
static inline int rays_are_native(RTCScene scene, int n)
{
#if RTC_VERSION_MAJOR >= 4
    (void)scene;
    return n > 0;
#else
    RTCDevice device = rtcGetSceneDevice(scene);
    const enum RTCDeviceProperty property =
        n == 16  ? RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED
        : n == 8 ? RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED
                 : RTC_DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED;
    const int native = n == 1 || rtcGetDeviceProperty(device, property) != 0;
    rtcReleaseDevice(device);
    return native;
#endif
}

/* Copies the words before a query. */
static inline void remember(struct rays *r, RTCScene scene)
{
    const int native = rays_are_native(scene, r->n);
    for (int i = 0; i < r->n && !native; i++)
        if (!r->valid[i]) {
            rays_at(r, RAY_TNEAR, i)->f = HUGE_VALF;
            rays_at(r, RAY_TFAR, i)->f = -HUGE_VALF;
        }
    memcpy(r->before, r->word, sizeof r->before);
}

static inline struct call call_of(const struct rays_query *query)
{
    struct call call = {.user = query ? query->user : NULL};
    const RTCFilterFunctionN filter = query ? query->filter : NULL;
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&call.context);
    call.filter = filter;
#else
    rtcInitIntersectContext(&call.context);
    call.context.filter = filter;
    call.context.flags = query && query->coherent
                             ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                             : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
#endif
    if (query && query->instance)
        call.context.instID[0] = query->instance;
    return call;
}

#if RTC_VERSION_MAJOR >= 4
#define SET_ARGUMENTS(TYPE, INIT)                                       \
    struct call call = call_of(query);                                  \
    struct TYPE arguments;                                              \
    INIT(&arguments);                                                   \
    arguments.context = &call.context;                                  \
    arguments.filter = call.filter;                                     \
    arguments.flags = (enum RTCRayQueryFlags)(                          \
        (call.filter ? RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER : 0) | \
        (query && query->coherent ? RTC_RAY_QUERY_FLAG_COHERENT : 0));
#define GIVEN(TYPE) scene, (struct TYPE *)(void *)r->word, &arguments
#else
#define SET_ARGUMENTS(TYPE, INIT) struct call call = call_of(query);
#define GIVEN(TYPE) scene, &call.context, (struct TYPE *)(void *)r->word
#endif

#define TRACE(CALL, TYPE)                  \
    remember(r, scene);                    \
    if (r->n == 1)                         \
        CALL##1(GIVEN(TYPE));              \
    else if (r->n == 4)                    \
        CALL##4(r->valid, GIVEN(TYPE##4)); \
    else if (r->n == 8)                    \
        CALL##8(r->valid, GIVEN(TYPE##8)); \
    else                                   \
        CALL##16(r->valid, GIVEN(TYPE##16));

static inline void rays_intersect(struct rays *r, RTCScene scene,
                                  const struct rays_query *query)
{
    SET_ARGUMENTS(RTCIntersectArguments, rtcInitIntersectArguments)
    TRACE(rtcIntersect, RTCRayHit)
}

static inline void rays_occluded(struct rays *r, RTCScene scene,
                                 const struct rays_query *query)
{
    SET_ARGUMENTS(RTCOccludedArguments, rtcInitOccludedArguments)
    TRACE(rtcOccluded, RTCRay)
}

/* In a filter: the query's `user`. */
static inline void *rays_user(const struct RTCFilterFunctionNArguments *a)
{
    return ((const struct call *)(const void *)a->context)->user;
}

/* ------------------------------------------------------------- answers -- */

/* After a query: whether ray i was hit, or is occluded. */
static inline int rays_hit(struct rays *r, int i)
{
    return rays_at(r, HIT_GEOM, i)->u != RTC_INVALID_GEOMETRY_ID;
}

static inline int rays_shadowed(struct rays *r, int i)
{
    return rays_at(r, RAY_TFAR, i)->f == -HUGE_VALF;
}

/* The number of words that the last query changed and must not change: those of
 * inactive rays, of an active ray's input, beyond the last; after
 * rays_occluded() all but tfar of active rays. */
static inline int rays_strayed(const struct rays *r, int occlusion)
{
    /* a single hit may end with padding, which is written with it */
    const int members =
        r->n == 1 ? (int)sizeof(struct RTCRayHit) / 4 : (int)RAY_MEMBERS;
    int strayed = 0;
    for (int w = 0; w < RAYS_WORDS + RAYS_BEYOND; w++) {
        const int member = w / r->n, i = w % r->n;
        const int output = member == RAY_TFAR ||
                           (!occlusion && member >= HIT_NG && member < members);
        strayed +=
            r->word[w].u != r->before[w].u && !(output && r->valid[i] < 0);
    }
    return strayed;
}

/* Ray i as a line in doubles, with its domain as it was before the query. */
static inline cylint_line rays_line(const struct rays *r, int i)
{
    cylint_line line;
    double o[3], d[3];
    for (int k = 0; k < 3; k++) {
        o[k] = r->before[(RAY_ORG + k) * r->n + i].f;
        d[k] = r->before[(RAY_DIR + k) * r->n + i].f;
    }
    cylint_span(&line, o, d, r->before[RAY_TNEAR * r->n + i].f,
                r->before[RAY_TFAR * r->n + i].f);
    return line;
}

#endif
