/*
 * embree_rivals.c - the same shapes as several kinds of Embree scenes
 */
#include "embree_rivals.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double process_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool count_bytes(void *user, ssize_t bytes, bool post)
{
    struct rival *r = user;
    (void)post;
    r->bytes += (double)bytes; /* no lock: one thread builds */
    return true;
}

static void report_error(void *user, enum RTCError code, const char *text)
{
    (void)user;
    fprintf(stderr, "embree: %s (%d)\n", text, (int)code);
    exit(1);
}

static struct rival *begin(const char *config)
{
    struct rival *r = need(sizeof *r);
    *r = (struct rival){.device = rtcNewDevice(config)};
    rtcSetDeviceErrorFunction(r->device, report_error, NULL);
    rtcSetDeviceMemoryMonitorFunction(r->device, count_bytes, r);
    r->scene = rtcNewScene(r->device);
    return r;
}

static struct rival finish(struct rival *r, double started)
{
    rtcCommitScene(r->scene);
    r->build_seconds = process_seconds() - started;
    rtcSetDeviceMemoryMonitorFunction(r->device, NULL, NULL);
    const struct rival made = *r;
    free(r);
    return made;
}

/* Not committed. */
static RTCGeometry curves_of(RTCDevice device, const struct cylinders *c,
                             size_t m)
{
    RTCGeometry g = rtcNewGeometry(
        device, c->form == ROUND_CONES ? RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE
                                       : RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE);
    float *vertex = rtcSetNewGeometryBuffer(
        g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, c->n * (m + 1));
    unsigned *index = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0,
                                              RTC_FORMAT_UINT, 4, c->n * m);
    unsigned char *flags = rtcSetNewGeometryBuffer(
        g, RTC_BUFFER_TYPE_FLAGS, 0, RTC_FORMAT_UCHAR, 1, c->n * m);
    for (size_t i = 0; i < c->n; i++) {
        for (size_t k = 0; k <= m; k++) {
            const double z = (double)k / (double)m;
            for (int j = 0; j < 3; j++)
                *vertex++ = (float)((1 - z) * (double)c->ends[i][0][j] +
                                    z * (double)c->ends[i][1][j]);
            *vertex++ = (float)((1 - z) * (double)c->radius[i][0] +
                                z * (double)c->radius[i][1]);
        }
        for (size_t k = 0; k < m; k++) {
            *index++ = (unsigned)(i * (m + 1) + k);
            *flags++ =
                (unsigned char)((k > 0 ? RTC_CURVE_FLAG_NEIGHBOR_LEFT : 0) |
                                (k + 1 < m ? RTC_CURVE_FLAG_NEIGHBOR_RIGHT
                                           : 0));
        }
    }
    rtcSetGeometryMask(g, 0xFFFFFFFFu);
    return g;
}

struct rival build_curves(const struct cylinders *c, int segments,
                          const char *config)
{
    struct rival *r = begin(config);
    RTCGeometry *g = need(c->parts * sizeof *g);
    for (size_t k = 0; k < c->parts; k++) {
        const struct cylinders part = part_of(c, k);
        g[k] = curves_of(r->device, &part, (size_t)segments);
    }
    const double started = process_seconds();
    for (size_t k = 0; k < c->parts; k++) {
        rtcCommitGeometry(g[k]);
        rtcAttachGeometry(r->scene, g[k]);
    }
    const struct rival made = finish(r, started);
    for (size_t k = 0; k < c->parts; k++)
        rtcReleaseGeometry(g[k]);
    free(g);
    return made;
}

struct rival build_shapes(const struct cylinders *c, unsigned how,
                          const char *config)
{
    struct rival *r = begin(config);
    const cylint_embree_options options = {.flags = how};
    r->ours = need(c->parts * sizeof *r->ours);
    r->parts = c->parts;
    const double started = process_seconds();
    for (size_t k = 0; k < c->parts; k++) {
        const struct cylinders part = part_of(c, k);
        r->ours[k] = cylint_embree_geometry(r->device, part.shapes, part.n,
                                            &options, NULL);
        rtcAttachGeometry(r->scene, r->ours[k]);
    }
    return finish(r, started);
}

void free_rival(struct rival *r)
{
    for (size_t k = 0; k < r->parts; k++)
        cylint_embree_release(r->ours[k]);
    free(r->ours);
    rtcReleaseScene(r->scene);
    rtcReleaseDevice(r->device);
}

long trace_nearest(const struct rival *r, const struct rays *rays, double *t)
{
    cylint_rtc_context context;
    long hits = 0;
    cylint_rtc_init(&context);
    *t = 0;
    for (int i = 0; i < rays->n; i++) {
        struct RTCRayHit at;
        at.ray = rays->ray[i];
        at.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        cylint_rtc_nearest(r->scene, &context, &at);
        if (at.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
            hits++;
            *t += (double)at.ray.tfar;
        }
    }
    return hits;
}

int segments_for(const struct cylinders *c, const struct cylinder_kind *kind)
{
    double ratios = 0;
    const size_t n = c->n < 1000 ? c->n : 1000;
    for (size_t i = 0; i < n; i++) {
        double lo[3], hi[3];
        cylint_bounds(&c->shapes[i], lo, hi);
        const double x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
        const double length = (double)c->radius[i][0] / kind->radius;
        const double area = 2 * 3.14159265358979 * (double)c->radius[i][0] *
                            (length + (double)c->radius[i][0]);
        ratios += sqrt(2 * (x * y + y * z + z * x) / area);
    }
    return (int)fmin(fmax(1, ratios / (double)n + 0.5), kind->most_segments);
}
