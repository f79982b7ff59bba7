/*
 * embree.h - single rays and occlusion queries by Embree 3 or 4, and the union of
 * chords in cylinders, as a caller of Embree computes it
 *
 * The Makefile defines CYLINT_EMBREE, the major version.
 */
#ifndef BENCH_EMBREE_H
#define BENCH_EMBREE_H

#include <math.h>
#include <stddef.h>

#include "cylint.h"

/* The nearest hit, whether there is one, and 16 nearest hits of neighbours. */
#if CYLINT_EMBREE == 4
#include <embree4/rtcore.h>
extern struct RTCIntersectArguments embree_coherent;
#define embree_nearest(scene, ray) rtcIntersect1(scene, ray, NULL)
#define embree_any(scene, ray) rtcOccluded1(scene, ray, NULL)
#define embree_nearest16(valid, scene, rays) \
    rtcIntersect16(valid, scene, rays, &embree_coherent)
#else
#include <embree3/rtcore.h>
extern struct RTCIntersectContext embree_single, embree_coherent;
#define embree_nearest(scene, ray) rtcIntersect1(scene, &embree_single, ray)
#define embree_any(scene, ray) rtcOccluded1(scene, &embree_single, ray)
#define embree_nearest16(valid, scene, rays) \
    rtcIntersect16(valid, scene, &embree_coherent, rays)
#endif

/* A device of one thread, which ends the program if Embree fails. */
RTCDevice embree_device(void);

/* A ray of floats, as the line's are. */
static inline struct RTCRay embree_ray(const cylint_line *line)
{
    const double *o = line->o, *d = line->d;
    return (struct RTCRay){.org_x = (float)o[0],
                           .org_y = (float)o[1],
                           .org_z = (float)o[2],
                           .dir_x = (float)d[0],
                           .dir_y = (float)d[1],
                           .dir_z = (float)d[2],
                           .tfar = HUGE_VALF,
                           .mask = 0xFFFFFFFFu};
}

struct embree_chords *embree_chords_new(const cylint_shape *cylinders,
                                        size_t n);
void embree_chords_free(struct embree_chords *scene);

/* The length of the union of a ray's chords; d has length 1. */
double embree_chords_union(const struct embree_chords *scene,
                           const cylint_line *ray);

#endif
