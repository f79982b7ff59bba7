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

/* A ray, and the lane or primitive to test it against. */
typedef struct cylint_ray_test {
    const cylint_embree_data *data;
    const struct RTCIntersectFunctionNArguments *nearest; /* one of these ... */
    const struct RTCOccludedFunctionNArguments *any;      /* ... is NULL */
    cylint_rtc_context *context;
    unsigned geomID;
    struct RTCRay *ray;
    struct RTCHit *hit;           /* of `nearest` */
    cylint_float_filter_ray line; /* the ray in doubles; set by set_line() */
    const cylint_leaf *leaf;      /* NULL: each shape is a primitive */
    int lane;
    unsigned rank; /* of the shape */
    int found;     /* a hit was recorded */
} cylint_ray_test;

typedef cylint_ray_test ray_test;

/* Sets the pointers only: clearing the whole struct takes longer than testing a
 * leaf. */
static inline void initialise(ray_test *r, const cylint_embree_data *data,
                              cylint_rtc_context *context, unsigned geomID)
{
    r->data = data;
    r->nearest = NULL;
    r->any = NULL;
    r->context = context;
    r->geomID = geomID;
    r->ray = NULL;
    r->hit = NULL;
    r->leaf = NULL;
}

static inline cylint_float_filter_ray line_of(const struct RTCRay *ray)
{
    return (cylint_float_filter_ray){{ray->org_x, ray->org_y, ray->org_z},
                                     {ray->dir_x, ray->dir_y, ray->dir_z},
                                     ray->tnear,
                                     HUGE_VAL,
                                     ray->tfar};
}

/* Sets the line from the ray.  Returns whether cylint_span() accepts it.  The
 * box tests do not reject all rays that it refuses.  Sums of six floats do not
 * overflow doubles. */
static inline int set_line(ray_test *r)
{
    r->line = line_of(r->ray);
    r->found = 0;
    const double *o = r->line.o, *d = r->line.d;
    const double any = fabs(d[0]) + fabs(d[1]) + fabs(d[2]);
    const double all = any + fabs(o[0]) + fabs(o[1]) + fabs(o[2]);
    return (any > 0) & (all < HUGE_VAL) & (r->ray->tnear <= r->ray->tfar);
}

/* cylint_float_ray has the layout of the first members of RTCRay. */
#define SAME(ours, theirs) \
    (offsetof(cylint_float_ray, ours) == offsetof(struct RTCRay, theirs))
typedef char same_layout[SAME(o[0], org_x) && SAME(o[1], org_y) &&
                                 SAME(o[2], org_z) && SAME(tnear, tnear) &&
                                 SAME(d[0], dir_x) && SAME(d[1], dir_y) &&
                                 SAME(d[2], dir_z) && SAME(tfar, tfar)
                             ? 1
                             : -1];
#undef SAME

static inline const cylint_float_ray *float_ray(const struct RTCRay *ray)
{
    return (const cylint_float_ray *)ray;
}

static inline int is_bare(const ray_test *r)
{
    return (r->data->flags & CYLINT_EMBREE_BARE) != 0;
}

static inline int has_filters(const ray_test *r)
{
    return !(r->data->flags & CYLINT_EMBREE_NO_FILTERS);
}

/* Whether u, v and Ng of a hit are read by the caller or a filter. */
static inline int needs_description(const ray_test *r)
{
    return !is_bare(r) && (r->nearest || has_filters(r));
}

/* The number of the shape that is tested. */
static inline unsigned number_of(const ray_test *r)
{
    return r->leaf ? r->data->number[r->rank] : r->rank;
}

/* The question whether the ray hits the piece of the lane. */
CYLINT_INLINE cylint_float_filter_question question_of(const ray_test *r)
{
    const cylint_float_filter_shapes *records = &r->data->shapes[0].records;
    const cylint_shape_piece piece = cylint_leaf_piece(r->leaf, r->lane);
    return (cylint_float_filter_question){
        .shape = cylint_float_filter_at(records, r->rank),
        .line = &r->line,
        .tfar = r->ray->tfar,
        .small = records->small,
        .ends = cylint_leaf_ends(r->leaf, r->lane),
        .index = piece.index,
        .count = piece.count,
        .describes = needs_description(r)};
}

/* Records the hit of an answer, if it is nearer than the present one and the
 * filters accept it, or else a later hit of the shape; cylint_intersect() decides
 * what is uncertain.  Writes the question and the answer again.  Returns 1 if a
 * hit was recorded. */
int cylint_ray_end(ray_test *r, cylint_float_filter_question *asked,
                   cylint_float_filter_answer *answer);

/* Traces the ray alone.  Returns 1 if a hit was recorded. */
int cylint_trace_single(ray_test *r, unsigned primID);

/* ---------------------------------------------------------------- lanes -- */

CYLINT_INLINE void prefetch_shapes(const cylint_embree_data *data,
                                   const cylint_leaf *leaf, unsigned lanes)
{
    for (; lanes; lanes &= lanes - 1)
        CYLINT_PREFETCH(cylint_float_filter_at(
            &data->shapes[0].records, leaf->number[cylint_lowest(lanes)]));
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

/* Selects the nearest lane and removes it from *lanes.  Returns 0 if no lane can
 * hold the nearest hit. */
CYLINT_INLINE int select_nearest_lane(ray_test *r, const cylint_leaf *leaf,
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
    r->line.near = least[lane] > r->ray->tnear ? least[lane] : r->ray->tnear;
    return 1;
}

/* ----------------------------------------------------------------- rays -- */

/* Embree 4 expects in valid[] whether the ray was hit. */
static inline void set_valid(int *valid, unsigned i, int hit)
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
