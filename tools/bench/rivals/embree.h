/*
 * embree.h - single rays and occlusion queries by Embree 3 or 4, and the union of
 * chords in cylinders, as a caller of Embree computes it
 *
 * The Makefile defines CYLINT_EMBREE, the major version.
 */
#ifndef BENCH_EMBREE_H
#define BENCH_EMBREE_H

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

struct embree_chords *embree_chords_new(const cylint_shape *cylinders,
                                        size_t n);
void embree_chords_free(struct embree_chords *scene);

/* The length of the union of a ray's chords; d has length 1. */
double embree_chords_union(const struct embree_chords *scene,
                           const cylint_line *ray);

#endif
