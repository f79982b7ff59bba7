/*
 * geometry.h - the data of a geometry, beside the caller's shapes
 */
#ifndef CYLINT_EMBREE_GEOMETRY_H
#define CYLINT_EMBREE_GEOMETRY_H

#include <stdint.h>

#include "../bvh/bvh.h"
#include "shapes.h"
#include "packet_traverse.h"
#include "api.h"
#include "cylint_embree.h"

/* An array of the caller's; `first`: the number of its first shape.  Of a merged
 * geometry, hits name its shapes by this geomID. */
typedef struct cylint_embree_array {
    const cylint_shape *shapes;
    size_t first, n;
    unsigned geomID;
} cylint_embree_array;

/* The user data of the geometry. */
typedef struct cylint_embree_data {
    cylint_memory self;                /* holds this struct */
    cylint_memory_source source;       /* of all memory */
    const cylint_embree_array *arrays; /* behind this struct; at least one */
    size_t n_arrays, n; /* n: the shapes of all; several arrays are merged */
    int is_merged;
    const cylint_shape *moved; /* at time 1; NULL: the shapes do not move */
    double pad;     /* added to each side of Embree's boxes: box_pad() */
    unsigned flags; /* CYLINT_EMBREE_SINGLE, ... */
    void *user;     /* for filter functions */
    int threads;    /* to build the hierarchy */
    const cylint_traversal *traversal; /* NULL: each shape is a primitive */
    cylint_float_filter *filter[2];    /* for one question, and for several */
    cylint_traverse_packet *traverse_packet;
    cylint_bvh bvh; /* its box only, if each shape is a primitive */
    /* Leaves name shapes by rank, in the order in which leaves first name
     * them; `shapes` have the same order.  Without leaves, ranks are numbers. */
    cylint_embree_shapes shapes[2]; /* at times 0 and 1 */
    cylint_memory order_memory;
    const uint32_t *number, *rank; /* of each rank, of each number, or NULL */
    const uint32_t *array; /* of each rank, of a merged geometry; or NULL */
} cylint_embree_data;

/* The last array whose first number, or geomID, is at most x, or the first. */
static inline size_t cylint_embree_array_at(const cylint_embree_data *data,
                                            int by_geomID, size_t x)
{
    size_t low = 0, high = data->n_arrays;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        const cylint_embree_array *at = &data->arrays[middle];
        if ((by_geomID ? at->geomID : at->first) <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

void cylint_embree_intersect_callback(
    const struct RTCIntersectFunctionNArguments *args);
void cylint_embree_occluded_callback(
    const struct RTCOccludedFunctionNArguments *args);

#endif
