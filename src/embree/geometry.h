/*
 * geometry.h - what a geometry holds beside the shapes of the caller
 */
#ifndef CYLINT_EMBREE_GEOMETRY_H
#define CYLINT_EMBREE_GEOMETRY_H

#include <stdint.h>

#include "../bvh/bvh.h"
#include "packet_filter.h"
#include "../bvh/traverse.h"
#include "api.h"
#include "cylint_embree.h"
#include "device_memory.h"

/* What the geometry's user data points to. */
typedef struct cylint_embree_data {
    cylint_memory self;          /* which holds this very struct */
    cylint_memory_source source; /* of this and what is below */
    const cylint_shape *shapes;  /* at time 0 */
    const cylint_shape *moved;   /* at time 1, or NULL */
    size_t n;
    cylint_extent box; /* of all */
    double pad;        /* by which boxes are widened for Embree */
    unsigned how;
    void *user;
    int threads;                  /* to group the shapes */
    const cylint_traversal *walk; /* NULL: one shape a primitive */
    const cylint_float_filter *quick;
    cylint_packet_filter *many;
    cylint_bvh group;
    cylint_memory asked_memory; /* of what float_filter.c asks of shapes, by
                                     their ranks in the blocks of the group */
    cylint_memory number_memory;
    const uint32_t *number; /* of the shape, by its rank */
    cylint_float_filter_shapes asked;
} cylint_embree_data;

#endif
