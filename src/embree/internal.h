/*
 * internal.h - what the adapter's files tell each other
 *
 * Which way the calls point: adapter.c -> group.c -> block.c -> trunk.c,
 * group.c -> tree.c, and trace.c -> walk.c, quick.c.
 */
#ifndef CYLINT_EMBREE_INTERNAL_H
#define CYLINT_EMBREE_INTERNAL_H

#include <stdint.h>

#include "api.h"
#include "cylint_embree.h"
#include "group.h"
#include "memory.h"
#include "quick.h"
#include "walk.h"

/* What the geometry's user data points to. */
typedef struct cylint_embree_data {
    cylint_memory self;           /* which holds this very struct */
    RTCDevice device;
    const cylint_shape *shapes;   /* at time 0 */
    const cylint_shape *moved;    /* at time 1, or NULL */
    size_t n;
    struct RTCBounds box;         /* of all */
    double pad;                   /* by which boxes are widened for Embree */
    unsigned how;
    void *user;
    const cylint_walks *walk;     /* NULL: one shape a primitive */
    const cylint_quick_build *quick;
    cylint_group group;
    cylint_memory asked_memory;   /* of what quick.c asks of every shape */
    const cylint_quick_shape *asked;
} cylint_embree_data;

/* Callbacks of the geometry. */
void cylint_embree_trace(const struct RTCIntersectFunctionNArguments *args);
void cylint_embree_shadow(const struct RTCOccludedFunctionNArguments *args);

#endif
