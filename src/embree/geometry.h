/*
 * geometry.h - the data of a geometry, beside the caller's shapes, and of the rays
 * that are traced
 */
#ifndef CYLINT_EMBREE_GEOMETRY_H
#define CYLINT_EMBREE_GEOMETRY_H

#include <stddef.h>
#include <stdint.h>

#include "../bvh/traverse.h"
#include "shapes.h"
#include "cylint_embree.h"

/* -------------------------- one interface to Embree 3 and 4 -- */

/* The Makefile defines CYLINT_EMBREE, the major version. */
#if CYLINT_EMBREE == 4
#include <embree4/rtcore.h>
typedef struct RTCRayQueryContext cylint_rtc_context;
#define cylint_rtc_filter_hit rtcInvokeIntersectFilterFromGeometry
#define cylint_rtc_filter_occluded rtcInvokeOccludedFilterFromGeometry
#else
#include <embree3/rtcore.h>
typedef struct RTCIntersectContext cylint_rtc_context;
#define cylint_rtc_filter_hit rtcFilterIntersection
#define cylint_rtc_filter_occluded rtcFilterOcclusion
#endif

/* The ids of instances in hits and contexts: instID and, behind it, instPrimID if
 * there are arrays of instances. */
#ifdef RTC_GEOMETRY_INSTANCE_ARRAY
enum { CYLINT_INSTANCE_BYTES = 2 * 4 * RTC_MAX_INSTANCE_LEVEL_COUNT };
#else
enum { CYLINT_INSTANCE_BYTES = 4 * RTC_MAX_INSTANCE_LEVEL_COUNT };
#endif

static inline const void *cylint_rtc_instance(const cylint_rtc_context *context)
{
    return (const char *)context + offsetof(cylint_rtc_context, instID);
}

#if RTC_VERSION_MAJOR != CYLINT_EMBREE
#error "rtcore.h is of another major version of Embree than CYLINT_EMBREE"
#endif

/* ------------------------------------------------- geometries -- */

/* An array of the caller's; `first`: the number of its first shape.  Of a geometry
 * that is not merged, the geomID is not used. */
typedef struct cylint_embree_array {
    cylint_embree_part part;
    size_t first;
} cylint_embree_array;

/* Traces rays (bits) of a packet through a hierarchy that is not empty.  They go
 * into the same octant: their d have the same signs, of zeros too.  certain: for a
 * ray that certainly hits some shape, records only that it is hit. */
struct cylint_ray_test;
typedef void cylint_packet_trace(struct cylint_ray_test *packet, unsigned rays,
                                 int certain);

/* The user data of the geometry. */
typedef struct cylint_embree_data {
    cylint_memory self;                /* holds this struct */
    cylint_memory_source source;       /* of all memory */
    const cylint_embree_array *arrays; /* behind this struct; at least one */
    size_t n_arrays, n; /* n: the shapes of all; several arrays are merged */
    int is_merged;
    cylint_embree_options options;
    const cylint_traversal *traversal; /* NULL: each shape is a primitive */
    cylint_float_filter *filter[2];    /* for one question, and for several */
    cylint_packet_trace *trace_packet;
    cylint_extent box; /* of all shapes */
    double pad;        /* added to each side of Embree's boxes: box_pad() */
    cylint_bvh bvh;
    /* Leaves name shapes by rank, in the order in which leaves first name
     * them; `shapes` have the same order.  Without leaves, ranks are numbers.
     * The shapes from rank n_in_leaves on are beside the hierarchy. */
    size_t n_in_leaves;
    cylint_embree_shapes shapes[2]; /* at times 0 and 1 */
    cylint_memory order_memory;
    const uint32_t *number, *rank; /* of each rank, of each number, or NULL */
    const uint32_t *array; /* of each rank, of a merged geometry; or NULL */
} cylint_embree_data;

/* The last array whose first number, or geomID, is at most x, or the first. */
static inline size_t cylint_embree_array_at(const cylint_embree_data *data,
                                            int by_geomID, size_t x)
{
    size_t low = 0, half;
    for (size_t n = data->n_arrays; n > 1; n -= half) {
        half = n / 2;
        const cylint_embree_array *at = &data->arrays[low + half];
        low += (by_geomID ? at->part.geomID : at->first) <= x ? half : 0;
    }
    return low;
}

/* ------------------------------------------------------- rays -- */

/* The arguments of both callbacks have the same members; in place of `rayhit` those
 * for occlusion have rays alone. */
typedef struct RTCIntersectFunctionNArguments cylint_embree_call;

/* A ray, and the shape or slice to test it against. */
typedef struct cylint_ray_test {
    cylint_float_filter_question q; /* first: the filter's pointers are ours */
    const cylint_embree_data *data;
    cylint_float_filter *const *filter; /* data's, or those of no_filter */
    const cylint_embree_call *args;
    int any; /* the callback is that for occlusion */
    struct RTCRay *ray;
    struct RTCHit *hit; /* zeros if `any` */
    float last;         /* tfar before the callback */
    unsigned rank;      /* of the shape */
    int found;          /* a hit was recorded */
    /* the last recorded hit: members of `q`, and its shape's rank */
    int last_ball, last_leaves;
    unsigned last_rank;
    /* of a packet: how the ray may hit a leaf, as in cylint_leaf_callback, and
     * a copy of the ray */
    unsigned lanes;
    float least[CYLINT_LEAF_SIZE];
    struct RTCRayHit copy;
} cylint_ray_test;

enum { CYLINT_PACKET_MOST = 16 };

/* Tests rays (bits) of a packet against the lanes that they may hit.  Returns the
 * rays that need no other hit. */
unsigned cylint_packet_test(cylint_ray_test packet[], const cylint_leaf *leaf,
                            unsigned rays);

/* Records a hit of a ray of which nothing else is wanted. */
static inline void cylint_record_any(cylint_ray_test *r)
{
    r->ray->tfar = -HUGE_VALF;
    r->found = 1;
}

/* All builds. */
extern cylint_packet_trace cylint_packet_trace_plain, cylint_packet_trace_avx2;

void cylint_embree_intersect_callback(
    const struct RTCIntersectFunctionNArguments *args);
void cylint_embree_occluded_callback(
    const struct RTCOccludedFunctionNArguments *args);

#endif
