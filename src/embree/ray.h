/*
 * ray.h - one ray of Embree's: tests shapes against it, and records hits
 *
 * cylint_intersect() decides whether and where a shape is hit; the float filter
 * decides the same for most questions, with certainty and faster.
 */
#ifndef CYLINT_EMBREE_RAY_H
#define CYLINT_EMBREE_RAY_H

#include <math.h>
#include <stddef.h>

#include "../numbers/compiler.h"
#include "geometry.h"

/* The arguments of both callbacks have the same members; in place of `rayhit` those
 * for occlusion have rays alone. */
typedef struct RTCIntersectFunctionNArguments call;

#define SAME(ours, theirs)                                    \
    (offsetof(struct RTCIntersectFunctionNArguments, ours) == \
     offsetof(struct RTCOccludedFunctionNArguments, theirs))
typedef char same_arguments
    [SAME(valid, valid) && SAME(geometryUserPtr, geometryUserPtr) &&
             SAME(primID, primID) && SAME(context, context) &&
             SAME(rayhit, ray) && SAME(N, N) && SAME(geomID, geomID)
         ? 1
         : -1];
#undef SAME

/* A ray, and the lane or primitive to test it against. */
typedef struct cylint_ray_test {
    cylint_float_filter_question q; /* first: the filter's pointers are ours */
    const cylint_embree_data *data;
    const call *args;
    int any; /* the callback is that for occlusion */
    struct RTCRay *ray;
    struct RTCHit *hit;      /* zeros if `any` */
    const cylint_leaf *leaf; /* NULL: each shape is a primitive */
    int lane;
    unsigned rank; /* of the shape */
    int found;     /* a hit was recorded */
} cylint_ray_test;

typedef cylint_ray_test ray_test;

static inline int is_bare(const ray_test *r)
{
    return (r->data->flags & CYLINT_EMBREE_BARE) != 0;
}

static inline int has_filters(const ray_test *r)
{
    return !(r->data->flags & CYLINT_EMBREE_NO_FILTERS);
}

/* Sets what all questions about the ray share.  Returns whether cylint_span()
 * accepts it.  The box tests do not reject all rays that it refuses.  Sums of six
 * floats do not overflow doubles.  Clearing the whole struct would take longer than
 * testing a leaf. */
static inline int start_test(ray_test *r, const call *args, int any,
                             struct RTCRay *ray, struct RTCHit *hit)
{
    const cylint_float_ray *from = float_ray(ray);
    double direction = 0, all = 0;
    r->data = args->geometryUserPtr;
    r->args = args;
    r->any = any;
    r->ray = ray;
    r->hit = hit;
    r->leaf = NULL;
    EACH(j, 3) {
        r->q.o[j] = from->o[j];
        r->q.d[j] = from->d[j];
        direction += fabs(r->q.d[j]);
        all += fabs(r->q.o[j]);
    }
    r->q.tmin = from->tnear;
    r->q.near = HUGE_VAL;
    r->q.tmax = from->tfar;
    /* whether the caller or a filter reads u, v and Ng */
    r->q.describes = !is_bare(r) && (!any || has_filters(r));
    r->found = 0;
    return (direction > 0) & (all + direction < HUGE_VAL) &
           (from->tnear <= from->tfar);
}

/* The number of the shape that is tested. */
static inline unsigned number_of(const ray_test *r)
{
    return r->leaf ? r->data->number[r->rank] : r->rank;
}

/* Sets the question whether the ray hits a piece of the shape. */
CYLINT_INLINE void set_question(ray_test *r, int ends, cylint_shape_piece piece)
{
    cylint_embree_record(&r->data->shapes[0], r->rank, &r->q.record);
    r->q.tfar = r->ray->tfar;
    r->q.ends = ends;
    r->q.index = piece.index;
    r->q.count = piece.count;
    r->q.exit_only = 0;
}

/* Records the hit that the filter answers, if it is nearer than the present one
 * and the filter functions accept it, or else a later hit of the shape;
 * cylint_intersect() decides what is uncertain. */
void cylint_ray_end(ray_test *r);

/* Traces the ray alone.  Returns `found`. */
int cylint_trace_single(ray_test *r);

/* ---------------------------------------------------------------- lanes -- */

CYLINT_INLINE void prefetch_shapes(const cylint_embree_data *data,
                                   const cylint_leaf *leaf, unsigned lanes)
{
    for (; lanes; lanes &= lanes - 1)
        CYLINT_PREFETCH(cylint_embree_record_at(
            &data->shapes[0], leaf->number[cylint_lowest(lanes)]));
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

/* Removes the nearest lane from *lanes and sets the question about it.  Returns 0
 * if no lane can hold the nearest hit. */
CYLINT_INLINE int take_nearest_lane(ray_test *r, const cylint_leaf *leaf,
                                    unsigned *lanes, const float *least)
{
    const int lane = nearest_lane(*lanes, least);
    if (least[lane] > r->ray->tfar)
        return 0;
    *lanes &= ~(1u << lane);
    r->leaf = leaf;
    r->lane = lane;
    r->rank = leaf->number[lane];
    CYLINT_PREFETCH(r->data->number + r->rank);
    r->q.near = least[lane] > r->ray->tnear ? least[lane] : r->ray->tnear;
    set_question(r, cylint_leaf_ends(leaf, lane),
                 cylint_leaf_piece(leaf, lane));
    return 1;
}

/* Embree 4 expects in valid[] whether the ray was hit. */
static inline void set_valid(int *valid, unsigned i, int hit)
{
    if (CYLINT_EMBREE == 4)
        valid[i] = hit ? -1 : 0;
}

#endif
