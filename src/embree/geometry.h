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

/* The shapes that hits name by this geomID; `first`: the number of the first. */
typedef struct cylint_embree_merged {
    const cylint_shape *shapes;
    size_t first, n;
    unsigned geomID;
} cylint_embree_merged;

/* The user data of the geometry. */
typedef struct cylint_embree_data {
    cylint_memory self;          /* holds this struct */
    cylint_memory_source source; /* of all memory */
    const cylint_shape *from[2]; /* the caller's arrays, at times 0 and 1; the
                                    second is NULL if the shapes do not move */
    size_t n;
    double pad;     /* added to each side of Embree's boxes: box_pad() */
    unsigned flags; /* CYLINT_EMBREE_SINGLE, ... */
    void *user;     /* for filter functions */
    int threads;    /* to build the hierarchy */
    const cylint_traversal *traversal; /* NULL: each shape is a primitive */
    cylint_float_filter *filter_one, *filter_many;
    cylint_traverse_packet *traverse_packet;
    cylint_bvh bvh; /* its box only, if each shape is a primitive */
    /* Leaves name shapes by rank, in the order in which leaves first name
     * them; `shapes` have the same order.  Without leaves, ranks are numbers. */
    cylint_embree_shapes shapes[2]; /* at times 0 and 1 */
    cylint_memory order_memory;
    const uint32_t *number, *rank; /* of each rank, of each number, or NULL */
    /* The parts of a merged geometry, in the order of their geomIDs, and that of
     * each rank; the members of `from` are NULL. */
    const cylint_embree_merged *parts;
    size_t n_parts;
    const uint32_t *part;
} cylint_embree_data;

/* The last part whose first number, or geomID, is at most x; 0 if there is none. */
static inline size_t cylint_embree_part_at(const cylint_embree_data *data,
                                           int by_geomID, size_t x)
{
    size_t low = 0, high = data->n_parts;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        const cylint_embree_merged *part = &data->parts[middle];
        if ((by_geomID ? part->geomID : part->first) <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static inline int cylint_embree_moves(const cylint_embree_data *data)
{
    return data->from[1] != NULL;
}

void cylint_embree_intersect_callback(
    const struct RTCIntersectFunctionNArguments *args);
void cylint_embree_occluded_callback(
    const struct RTCOccludedFunctionNArguments *args);

#endif
