/*
 * embree_rivals.h - the same cylinders as Embree scenes of several makes
 */
#ifndef BENCH_EMBREE_RIVALS_H
#define BENCH_EMBREE_RIVALS_H

#include "embree_scenes.h"

struct rival {
    RTCDevice device;
    RTCScene scene;
    RTCGeometry geometry; /* ours, or NULL */
    double build_seconds; /* processor time of all threads */
    double bytes;         /* held by Embree and adapter; not the caller's
                              arrays, which all rivals share in place */
};

/* RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE, each cylinder a chain of segments. */
struct rival build_curves(const struct cylinders *c, int segments,
                          const char *device);

/* cylint_embree_geometry(), `how` as there. */
struct rival build_shapes(const struct cylinders *c, unsigned how,
                          const char *device);

void free_rival(struct rival *r);

/* How many segments pay for a kind: the root of the areas of box and cylinder,
 * as the adapter has it for pieces, averaged over directions. */
int segments_for(const struct cylinders *c, const struct cylinder_kind *kind);

#endif
