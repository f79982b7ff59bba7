/*
 * embree_chords.c - a user geometry of cylinders that collects chords
 *
 * The callback computes both roots by the quadratic formula in doubles and
 * rejects the hit, so that Embree visits all cylinders.  The query is
 * rtcOccluded1(), which needs no order.  The chords are then sorted by qsort()
 * and merged.
 */
#include "embree.h"

#include <float.h>

#include "inputs.h"
#include "shapes/layout.h"

enum { MOST = 1 << 16 };

/* 64 bytes, the length of a cache line. */
struct prepared {
    double p[3], axis[3], length, r;
};

struct embree_chords {
    struct prepared *cylinders;
    RTCDevice device;
    RTCScene scene;
};

/* The query, and what it finds. */
static struct {
    const cylint_line *ray;
    size_t n;
    double chord[MOST][2];
} found;

#if CYLINT_EMBREE == 4
struct RTCIntersectArguments embree_coherent;
#else
struct RTCIntersectContext embree_single, embree_coherent;
#endif

static void bound(const struct RTCBoundsFunctionArguments *args)
{
    const struct prepared *cylinders = args->geometryUserPtr;
    const struct prepared *c = &cylinders[args->primID];
    float *lower = &args->bounds_o->lower_x, *upper = &args->bounds_o->upper_x;
    for (int i = 0; i < 3; i++) {
        const double x = c->p[i], y = x + c->length * c->axis[i];
        const double e = c->r * sqrt(fmax(0, 1 - c->axis[i] * c->axis[i]));
        lower[i] = (float)(fmin(x, y) - e) - FLT_EPSILON;
        upper[i] = (float)(fmax(x, y) + e) + FLT_EPSILON;
    }
}

static void collect(const struct RTCOccludedFunctionNArguments *args)
{
    const struct prepared *cylinders = args->geometryUserPtr;
    const struct prepared *c = &cylinders[args->primID];
    const double *o = found.ray->o, *d = found.ray->d;
    const double x[3] = {o[0] - c->p[0], o[1] - c->p[1], o[2] - c->p[2]};
    const double xw = dot3(x, c->axis), dw = dot3(d, c->axis);
    const double A = 1 - dw * dw, B = dot3(x, d) - xw * dw;
    const double C = dot3(x, x) - xw * xw - c->r * c->r;
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
    if (t0 < t1 && found.n < MOST) {
        found.chord[found.n][0] = t0;
        found.chord[found.n++][1] = t1;
    }
}

double embree_chords_union(const struct embree_chords *scene,
                           const cylint_line *ray)
{
    struct RTCRay r = embree_ray(ray);
    double end = -1, sum = 0;
    found.ray = ray;
    found.n = 0;
    embree_any(scene->scene, &r);
    qsort(found.chord, found.n, sizeof *found.chord, compare_doubles);
    for (size_t i = 0; i < found.n; i++) {
        const double t0 = found.chord[i][0], t1 = found.chord[i][1];
        if (t1 > end) {
            sum += t1 - (t0 > end ? t0 : end);
            end = t1;
        }
    }
    return sum;
}

static void report_error(void *user, enum RTCError code, const char *text)
{
    (void)user, (void)code;
    require(0, text);
}

RTCDevice embree_device(void)
{
    RTCDevice device = rtcNewDevice("threads=1");
    rtcSetDeviceErrorFunction(device, report_error, NULL);
#if CYLINT_EMBREE == 4
    rtcInitIntersectArguments(&embree_coherent);
    embree_coherent.flags = RTC_RAY_QUERY_FLAG_COHERENT;
#else
    rtcInitIntersectContext(&embree_single);
    rtcInitIntersectContext(&embree_coherent);
    embree_coherent.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
#endif
    return device;
}

struct embree_chords *embree_chords_new(const cylint_shape *cylinders, size_t n)
{
    struct embree_chords *made = allocate(sizeof *made);
    made->cylinders = allocate(n * sizeof *made->cylinders);
    for (size_t i = 0; i < n; i++) {
        struct prepared *c = &made->cylinders[i];
        copy3(c->p, cylint_base(&cylinders[i]));
        copy3(c->axis, cylint_axis(&cylinders[i]));
        c->length = length3(c->axis);
        unit3(c->axis, c->axis);
        c->r = cylint_r0(&cylinders[i]);
    }
    made->device = embree_device();
    made->scene = rtcNewScene(made->device);
    rtcSetSceneBuildQuality(made->scene, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry g = rtcNewGeometry(made->device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(g, (unsigned)n);
    rtcSetGeometryUserData(g, made->cylinders);
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
    free(scene->cylinders);
    free(scene);
}
