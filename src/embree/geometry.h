/*
 * geometry.h - the data of a geometry, beside the caller's shapes
 */
#ifndef CYLINT_EMBREE_GEOMETRY_H
#define CYLINT_EMBREE_GEOMETRY_H

#include <stdint.h>

#include "../bvh/bvh.h"
#include "float_filter.h"
#include "packet_traverse.h"
#include "api.h"
#include "cylint_embree.h"
#include "device_memory.h"

/* The user data of the geometry. */
typedef struct cylint_embree_data {
    cylint_memory self;          /* holds this struct */
    cylint_memory_source source; /* of all memory */
    const cylint_shape *shapes;  /* at time 0 */
    const cylint_shape *moved;   /* at time 1, or NULL */
    size_t n;
    cylint_extent box; /* of all shapes */
    double pad;        /* added to each side of Embree's boxes: box_pad.h */
    unsigned flags;    /* CYLINT_EMBREE_SINGLE, ... */
    void *user;        /* for filter functions */
    int threads;       /* to build the hierarchy */
    const cylint_traversal *traversal; /* NULL: each shape is a primitive */
    cylint_float_filter *filter_one, *filter_many;
    cylint_traverse_packet *traverse_packet;
    cylint_bvh bvh;
    /* Leaves name shapes by rank, in the order in which leaves first name
     * them; the filter's shapes have the same order. */
    cylint_memory filter_memory, number_memory;
    cylint_float_filter_shapes filter_shapes;
    const uint32_t *number; /* of the shape with that rank */
} cylint_embree_data;

void cylint_embree_intersect_callback(
    const struct RTCIntersectFunctionNArguments *args);
void cylint_embree_occluded_callback(
    const struct RTCOccludedFunctionNArguments *args);

#endif
