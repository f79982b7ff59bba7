/*
 * embree_chords.c - a user geometry of cylinders that collects chords
 *
 * The callback computes both roots by the quadratic formula in doubles and rejects the
 * hit, so that Embree visits all cylinders.  The query is rtcOccluded1(), which needs no
 * order.  The chords are then sorted by qsort() and merged.
 */
#include "embree_chords.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "embree/api.h"

enum { MOST = 1 << 16 };

struct embree_chords {
    const struct prepared_cylinder *cylinders;
    RTCDevice device;
    RTCScene scene;
    size_t chords;
    double chord[MOST][2];
};

struct query {
    cylint_rtc_context context;
    const cylint_line *ray;
    struct embree_chords *found;
};

static void bound(const struct RTCBoundsFunctionArguments *args)
{
    const struct prepared_cylinder *cylinders = args->geometryUserPtr;
    const struct prepared_cylinder *c = &cylinders[args->primID];
    float *lower = &args->bounds_o->lower_x, *upper = &args->bounds_o->upper_x;
    for (int i = 0; i < 3; i++) {
        const double x = c->p[i], y = x + c->length * c->axis[i];
        const double e = c->r * sqrt(fmax(0, 1 - c->axis[i] * c->axis[i]));
        lower[i] = (float)(fmin(x, y) - e) - FLT_EPSILON;
        upper[i] = (float)(fmax(x, y) + e) + FLT_EPSILON;
    }
}

static double dot(const double x[3], const double y[3])
{
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

static void collect(const struct RTCOccludedFunctionNArguments *args)
{
    const struct query *query = (const struct query *)args->context;
    struct embree_chords *found = query->found;
    const struct prepared_cylinder *c = &found->cylinders[args->primID];
    const double *o = query->ray->o, *d = query->ray->d;
    const double x[3] = {o[0] - c->p[0], o[1] - c->p[1], o[2] - c->p[2]};
    const double xw = dot(x, c->axis), dw = dot(d, c->axis);
    const double A = 1 - dw * dw, B = dot(x, d) - xw * dw;
    const double C = dot(x, x) - xw * xw - c->r * c->r;
    const double discriminant = B * B - A * C;
    if (discriminant <= 0)
        return;
    const double root = sqrt(discriminant), per = 1 / A, cap = 1 / dw;
    double t0 = (-B - root) * per, t1 = (-B + root) * per;
    double z0 = -xw * cap, z1 = (c->length - xw) * cap;
    if (z0 > z1) {
        const double z = z0;
        z0 = z1;
        z1 = z;
    }
    t0 = t0 < z0 ? z0 : t0;
    t0 = t0 < 0 ? 0 : t0;
    t1 = z1 < t1 ? z1 : t1;
    if (t0 < t1 && found->chords < MOST) {
        found->chord[found->chords][0] = t0;
        found->chord[found->chords++][1] = t1;
    }
}

static int compare_chords(const void *x, const void *y)
{
    const double a = *(const double *)x, b = *(const double *)y;
    return (a > b) - (a < b);
}

size_t embree_chords_union(struct embree_chords *scene, const cylint_line *ray,
                           double *sum)
{
    struct query query = {.ray = ray, .found = scene};
    struct RTCRay r = {.org_x = (float)ray->o[0],
                       .org_y = (float)ray->o[1],
                       .org_z = (float)ray->o[2],
                       .dir_x = (float)ray->d[0],
                       .dir_y = (float)ray->d[1],
                       .dir_z = (float)ray->d[2],
                       .tfar = INFINITY,
                       .mask = 0xFFFFFFFFu};
    size_t pieces = 0;
    double end = -1;
    scene->chords = 0;
    cylint_rtc_init(&query.context);
    cylint_rtc_any(scene->scene, &query.context, &r);
    qsort(scene->chord, scene->chords, sizeof *scene->chord, compare_chords);
    for (size_t i = 0; i < scene->chords; i++) {
        const double t0 = scene->chord[i][0], t1 = scene->chord[i][1];
        pieces += t0 > end;
        if (t1 > end) {
            *sum += t1 - (t0 > end ? t0 : end);
            end = t1;
        }
    }
    return pieces;
}

static void report_error(void *user, enum RTCError code, const char *text)
{
    (void)user;
    fprintf(stderr, "embree: %s (%d)\n", text, (int)code);
    exit(1);
}

struct embree_chords *embree_chords_new(
    const struct prepared_cylinder *cylinders, size_t n)
{
    struct embree_chords *made = malloc(sizeof *made);
    if (!made)
        exit(4);
    made->cylinders = cylinders;
    made->device = rtcNewDevice("threads=1");
    rtcSetDeviceErrorFunction(made->device, report_error, NULL);
    made->scene = rtcNewScene(made->device);
    rtcSetSceneBuildQuality(made->scene, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry g = rtcNewGeometry(made->device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(g, (unsigned)n);
    rtcSetGeometryUserData(g, (void *)cylinders);
    rtcSetGeometryBoundsFunction(g, bound, NULL);
    rtcSetGeometryOccludedFunction(g, collect);
    rtcCommitGeometry(g);
    rtcAttachGeometry(made->scene, g);
    rtcReleaseGeometry(g);
    rtcCommitScene(made->scene);
    return made;
}

void embree_chords_free(struct embree_chords *scene)
{
    rtcReleaseScene(scene->scene);
    rtcReleaseDevice(scene->device);
    free(scene);
}
