/*
 * embree_rivals.h - the same shapes as several kinds of Embree scenes
 */
#ifndef BENCH_EMBREE_RIVALS_H
#define BENCH_EMBREE_RIVALS_H

#include "embree_scenes.h"

struct rival {
    RTCDevice device;
    RTCScene scene;
    RTCGeometry *ours; /* the adapter's geometries, NULL of curves */
    size_t parts;
    double build_seconds; /* processor time of all threads */
    double bytes;         /* memory of Embree and the adapter, without the
                              caller's arrays, which all rivals share */
};

/* Cone curves (RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE), of rounded cones round
 * curves (RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE): each shape is a chain of
 * segments.  A geometry for each part. */
struct rival build_curves(const struct cylinders *c, int segments,
                          const char *device);

/* Geometries of cylint_embree_geometry() with the option `how`. */
struct rival build_shapes(const struct cylinders *c, unsigned how,
                          const char *device);

void free_rival(struct rival *r);

/* Traces all rays to their nearest hits, one by one.  Returns the number of hits;
 * *t becomes the sum of their t. */
long trace_nearest(const struct rival *r, const struct rays *rays, double *t);

/* The number of segments per cylinder that suits a kind: the square root of
 * the ratio of box area to cylinder area, averaged over the cylinders.  The
 * adapter computes its pieces by the same rule. */
int segments_for(const struct cylinders *c, const struct cylinder_kind *kind);

#endif
