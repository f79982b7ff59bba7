/*
 * shape_test.h - one ray of Embree's at shapes: what it asks, and what it takes
 *
 * Whether and where a shape is hit is cylint_intersect()'s word, which float_filter.c
 * anticipates where it is certain of it; everything else only chooses which
 * shapes to ask.
 */
#ifndef CYLINT_EMBREE_SHAPE_TEST_H
#define CYLINT_EMBREE_SHAPE_TEST_H

#include <math.h>
#include <stddef.h>

#include "../numbers/compiler.h"
#include "geometry.h"

/* One ray at one primitive; line and lane are set when they are needed. */
typedef struct cylint_ray_test {
    const cylint_embree_data *data;
    const struct RTCIntersectFunctionNArguments *nearest; /* one of them ... */
    const struct RTCOccludedFunctionNArguments *any;      /* ... is NULL */
    cylint_rtc_context *context;
    unsigned geomID;
    struct RTCRay *ray;
    struct RTCHit *hit;           /* of nearest */
    cylint_float_filter_ray line; /* the ray */
    const cylint_leaf *block;     /* NULL: one shape a primitive */
    int lane;
    int met; /* something was, and was taken */
} cylint_ray_test;

typedef cylint_ray_test query;

/* Sets the pointers; clearing all of a query takes longer than a block does. */
static inline void begin(query *q, const cylint_embree_data *data,
                         cylint_rtc_context *context, unsigned geomID)
{
    q->data = data;
    q->nearest = NULL;
    q->any = NULL;
    q->context = context;
    q->geomID = geomID;
    q->ray = NULL;
    q->hit = NULL;
    q->block = NULL;
}

/* Whether cylint_span() will take it.  What it refuses no box refuses. */
static inline int is_line(const struct RTCRay *r)
{
    const float none = 0 * r->org_x + 0 * r->org_y + 0 * r->org_z +
                       0 * r->dir_x + 0 * r->dir_y + 0 * r->dir_z;
    const float any = fabsf(r->dir_x) + fabsf(r->dir_y) + fabsf(r->dir_z);
    return none >= 0 && any > 0 && r->tnear <= r->tfar;
}

static inline cylint_float_filter_ray line_of(const struct RTCRay *ray)
{
    return (cylint_float_filter_ray){{ray->org_x, ray->org_y, ray->org_z},
                                     {ray->dir_x, ray->dir_y, ray->dir_z},
                                     ray->tnear,
                                     HUGE_VAL,
                                     ray->tfar};
}

/* Whether the ray is a line; if so, it is the query's. */
static inline int is_set_out(query *q)
{
    if (!is_line(q->ray))
        return 0;
    q->line = line_of(q->ray);
    q->met = 0;
    return 1;
}

/* A ray's floats lie where traverse.h has them. */
#define SAME(ours, theirs) \
    (offsetof(cylint_float_ray, ours) == offsetof(struct RTCRay, theirs))
typedef char rays_are_alike[SAME(o[0], org_x) && SAME(o[1], org_y) &&
                                    SAME(o[2], org_z) && SAME(tnear, tnear) &&
                                    SAME(d[0], dir_x) && SAME(d[1], dir_y) &&
                                    SAME(d[2], dir_z) && SAME(tfar, tfar)
                                ? 1
                                : -1];
#undef SAME

static inline const cylint_float_ray *floats_of_ray(const struct RTCRay *ray)
{
    return (const cylint_float_ray *)ray;
}

static inline int is_bare(const query *q)
{
    return (q->data->how & CYLINT_EMBREE_BARE) != 0;
}

static inline int has_filters(const query *q)
{
    return !(q->data->how & CYLINT_EMBREE_NO_FILTERS);
}

/* Whether anyone will see u, v and Ng. */
static inline int is_seen(const query *q)
{
    return !is_bare(q) && (q->nearest || has_filters(q));
}

/* The shape's number.  rank: what a block has of it, or the primitive. */
static inline unsigned number_of(const query *q, unsigned rank)
{
    return q->block ? q->data->number[rank] : rank;
}

/* The shape as the ray finds it: of the lane or, in `room`, of the primitive,
 * which may move and is then between two. */
cylint_float_filter_target cylint_ray_test_target(
    const query *q, unsigned rank, cylint_shape *between,
    cylint_float_filter_shape *room);

/* 1 if the ray hits the shape and takes the hit.  Not where it enters the shape
 * if `left`: then it has been asked about that. */
int cylint_ray_test_shape(query *q, unsigned rank, int left);

/* The same of the lane's shape, question i of those that were answered. */
int cylint_ray_test_accept(query *q,
                           const cylint_packet_filter_results *answers, int i);

/* ---------------------------------------------------------------- lanes -- */

/* In line: GCC takes a function that does no more for one without effect, and
 * leaves its calls out. */
CYLINT_INLINE void fetch_shapes(const cylint_embree_data *data,
                                const cylint_leaf *block, unsigned lanes)
{
#ifdef __GNUC__
    for (; lanes; lanes &= lanes - 1)
        __builtin_prefetch(cylint_float_filter_at(
            &data->asked, block->number[cylint_lowest(lanes)]));
#else
    (void)data;
    (void)block;
    (void)lanes;
#endif
}

static inline int nearest_lane(unsigned lanes, const float *least)
{
    int first = cylint_lowest(lanes);
    while ((lanes &= lanes - 1)) {
        const int lane = cylint_lowest(lanes);
        first = least[lane] < least[first] ? lane : first;
    }
    return first;
}

/* Turns to the nearest of the lanes, which it takes out of them; 0: it cannot
 * come first, nor can any other. */
CYLINT_INLINE int turn_to_nearest(query *q, const cylint_leaf *block,
                                  unsigned *lanes, const float *least)
{
    const int lane = nearest_lane(*lanes, least);
    if (least[lane] > q->ray->tfar)
        return 0;
    *lanes &= ~(1u << lane);
    q->block = block;
    q->lane = lane;
    q->line.near = least[lane] > q->ray->tnear ? least[lane] : q->ray->tnear;
    return 1;
}

/* ----------------------------------------------------------------- rays -- */

/* What Embree 4 wants to know. */
static inline void tell(int *valid, unsigned i, int hit)
{
#if CYLINT_EMBREE == 4
    valid[i] = hit ? -1 : 0;
#else
    (void)valid;
    (void)i;
    (void)hit;
#endif
}

#endif
