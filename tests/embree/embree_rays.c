/* embree_rays.c - see embree_rays.h */
#include "embree_rays.h"

#include <string.h>

enum { UNTOUCHED = 0x5a };

void rays_begin(struct rays *r, int n)
{
    memset(r, UNTOUCHED, sizeof *r);
    memset(r->valid, 0, sizeof r->valid);
    r->n = n;
}

union ray_word *rays_at(struct rays *r, enum ray_member m, int i)
{
    return &r->word[(int)m * r->n + i];
}

void rays_add(struct rays *r, int i, const float o[3], const float d[3],
              float tnear, float tfar)
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

int rays_are_native(RTCScene scene, int n)
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

static void remember(struct rays *r, RTCScene scene)
{
    const int native = rays_are_native(scene, r->n);
    for (int i = 0; i < r->n && !native; i++)
        if (!r->valid[i]) {
            rays_at(r, RAY_TNEAR, i)->f = HUGE_VALF;
            rays_at(r, RAY_TFAR, i)->f = -HUGE_VALF;
        }
    memcpy(r->before, r->word, sizeof r->before);
}

static struct call call_of(const struct rays_query *query)
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

#define TRACE(CALL, TYPE, N) \
    CALL##N(r->valid, scene, (struct TYPE##N *)(void *)r->word, &arguments)
#define TRACE_ONE(CALL, TYPE) \
    CALL##1(scene, (struct TYPE *)(void *)r->word, &arguments)

#else

#define SET_ARGUMENTS(TYPE, INIT) struct call call = call_of(query);

#define TRACE(CALL, TYPE, N) \
    CALL##N(r->valid, scene, &call.context, (struct TYPE##N *)(void *)r->word)
#define TRACE_ONE(CALL, TYPE) \
    CALL##1(scene, &call.context, (struct TYPE *)(void *)r->word)

#endif

#define TRACE_ALL(CALL, TYPE)      \
    do {                           \
        remember(r, scene);        \
        switch (r->n) {            \
        case 1:                    \
            TRACE_ONE(CALL, TYPE); \
            break;                 \
        case 4:                    \
            TRACE(CALL, TYPE, 4);  \
            break;                 \
        case 8:                    \
            TRACE(CALL, TYPE, 8);  \
            break;                 \
        default:                   \
            TRACE(CALL, TYPE, 16); \
            break;                 \
        }                          \
    } while (0)

void rays_intersect(struct rays *r, RTCScene scene,
                    const struct rays_query *query)
{
    SET_ARGUMENTS(RTCIntersectArguments, rtcInitIntersectArguments)
    TRACE_ALL(rtcIntersect, RTCRayHit);
}

void rays_occluded(struct rays *r, RTCScene scene,
                   const struct rays_query *query)
{
    SET_ARGUMENTS(RTCOccludedArguments, rtcInitOccludedArguments)
    TRACE_ALL(rtcOccluded, RTCRay);
}

void *rays_user(const struct RTCFilterFunctionNArguments *a)
{
    return ((const struct call *)(const void *)a->context)->user;
}

float rays_filter_t(const struct RTCFilterFunctionNArguments *a, int i)
{
    return ((const float *)(const void *)a->ray)[RAY_TFAR * (int)a->N + i];
}

unsigned rays_filter_prim(const struct RTCFilterFunctionNArguments *a, int i)
{
    return ((const unsigned *)(const void *)
                a->hit)[(HIT_PRIM - HIT_NG) * (int)a->N + i];
}

/* ------------------------------------------------------------- answers -- */

int rays_hit(struct rays *r, int i)
{
    return rays_at(r, HIT_GEOM, i)->u != RTC_INVALID_GEOMETRY_ID;
}

int rays_shadowed(struct rays *r, int i)
{
    return rays_at(r, RAY_TFAR, i)->f < 0;
}

int rays_strayed(const struct rays *r, int occlusion)
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

cylint_line rays_line(const struct rays *r, int i)
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
