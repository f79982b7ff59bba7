/*
 * scene_curves.c - wrong answers of Embree's own cone curves to the same lines
 *
 * Not a test: figures beside those of scene/test_queries.c, where no line is wrong.
 * Capped cylinders, frusta and rays have float coordinates, so that curves and
 * shapes are the same.  A ray is wrong if it hits a shape and no curve, or a
 * curve and no shape.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cylint_scene.h"
#include "shapes/layout.h"
#include "embree_rays.h"
#include "scenes.h"

enum { SHAPES = 2000, RAYS = 4000 };

/* Rounds the data of a circular shape to floats.  Returns 0 for others. */
static int as_floats(cylint_shape *s, float *vertex)
{
    if (s->kind != CYLINT_KIND_CYLINDER && s->kind != CYLINT_KIND_CONE)
        return 0;
    const double p[2][3] = {{(float)cylint_base(s)[0], (float)cylint_base(s)[1],
                             (float)cylint_base(s)[2]},
                            {(float)cylint_top(s)[0], (float)cylint_top(s)[1],
                             (float)cylint_top(s)[2]}};
    const double r[2] = {(float)cylint_r0(s), (float)cylint_r1(s)};
    for (int end = 0; end < 2; end++) {
        for (int j = 0; j < 3; j++)
            vertex[4 * end + j] = (float)p[end][j];
        vertex[4 * end + 3] = (float)r[end];
    }
    return cylint_cone(s, p[0], r[0], p[1], r[1], CYLINT_ENDS_CAPPED) ==
           CYLINT_OK;
}

static RTCScene curves_of(RTCDevice device, struct scene_shapes *s)
{
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE);
    float *vertex = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0,
                                            RTC_FORMAT_FLOAT4, 16, 2 * s->n);
    unsigned *index = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0,
                                              RTC_FORMAT_UINT, 4, s->n);
    RTCScene scene = rtcNewScene(device);
    size_t n = 0;
    for (size_t i = 0; i < s->n; i++) {
        s->shapes[n] = s->shapes[i];
        index[n] = (unsigned)(2 * n);
        n += (size_t)as_floats(&s->shapes[n], vertex + 8 * n);
    }
    for (size_t i = n; i < s->n; i++)
        index[i] = 0; /* the first again */
    s->n = n;
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcCommitGeometry(g);
    rtcAttachGeometry(scene, g);
    rtcReleaseGeometry(g);
    rtcCommitScene(scene);
    return scene;
}

/* Makes a ray of floats, and the line of the same floats; unit: with a unit
 * direction.  Returns whether that is a line. */
static int add_ray(struct rays *r, cylint_line *line, int unit)
{
    const double length =
        sqrt(line->d[0] * line->d[0] + line->d[1] * line->d[1] +
             line->d[2] * line->d[2]);
    double o[3], d[3];
    float of[3], df[3];
    for (int j = 0; j < 3; j++) {
        o[j] = of[j] = (float)line->o[j];
        d[j] = df[j] = (float)(line->d[j] * (unit ? 1 / length : 1));
    }
    rays_begin(r, 1);
    rays_add(r, 0, of, df, 0, HUGE_VALF);
    return cylint_ray(line, o, d) == CYLINT_OK;
}

static void compare(RTCScene curves, const cylint_scene *exact,
                    const struct scene_shapes *s, enum scene_lines kind,
                    int unit)
{
    size_t hits = 0, missed = 0, false_hits = 0, rays_traced = 0;
    for (size_t i = 0; i < RAYS; i++) {
        cylint_line line;
        struct rays r;
        if (scene_line(s, kind, 1, i, &line) != CYLINT_OK ||
            !add_ray(&r, &line, unit))
            continue;
        rays_occluded(&r, curves, NULL);
        const int hit = cylint_scene_count(exact, &line, 1) > 0;
        const int curve_hit = rays_shadowed(&r, 0);
        rays_traced++;
        hits += (size_t)hit;
        missed += (size_t)(hit && !curve_hit);
        false_hits += (size_t)(!hit && curve_hit);
    }
    printf("%-8s %-9s %-9s %6zu rays, %6zu hit a shape; the curves miss %5.2f "
           "%% of these and report %zu false hits\n",
           s->name, scene_lines_name[kind], unit ? "unit d" : "d as is",
           rays_traced, hits, hits ? 100.0 * (double)missed / (double)hits : 0,
           false_hits);
}

int main(void)
{
    static const enum scene_lines kinds[] = {LINES_CAMERA,  LINES_RANDOM,
                                             LINES_GRAZING, LINES_AXIS,
                                             LINES_SHADOW,  LINES_FAR};
    struct scene_shapes s;
    for (int scene = 0; scene < 4 && scene_generate(scene, SHAPES, 1, &s);
         scene++) {
        RTCDevice device = rtcNewDevice("threads=1");
        RTCScene curves = curves_of(device, &s);
        cylint_scene *exact = cylint_scene_new(s.shapes, s.n, 1, NULL);
        if (!exact)
            return 1;
        for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++)
            for (int unit = 1; unit >= 0; unit--)
                compare(curves, exact, &s, kinds[k], unit);
        cylint_scene_free(exact);
        rtcReleaseScene(curves);
        rtcReleaseDevice(device);
        scene_release(&s);
    }
    return 0;
}
