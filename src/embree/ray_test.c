/*
 * ray_test.c - tests one ray of Embree's against one shape, records the hit
 */
#include "ray_test.h"

#include <string.h>

#include "../bvh/float_bounds.h"
#include "angle.h"

/* The library's answer and its line; 0 hits for a line that it refuses. */
static int intersect(const cylint_shape *shape,
                     const cylint_float_filter_ray *l, unsigned want,
                     cylint_line *line, cylint_answer *answer)
{
    if (cylint_span(line, l->o, l->d, l->tmin, l->tmax) != CYLINT_OK)
        return 0;
    return cylint_intersect(shape, line, want, answer);
}

/* The domain's end that still includes every root whose t, rounded to a double,
 * is tfar. */
static double tmax_including(float tfar)
{
    return nextafter((double)tfar, HUGE_VAL);
}

/* The shape, or, if it moves, the shape at this time, written to *between. */
static const cylint_shape *shape_at(const cylint_embree_data *data,
                                    unsigned number, float time,
                                    cylint_shape *between)
{
    if (!data->moved)
        return data->shapes + number;
    cylint_embree_between(data->shapes + number, data->moved + number, time,
                          between);
    return between;
}

/* The new tfar of a ray hit at t <= tfar. */
static float rounded_up(double t, float tfar)
{
    const float f = cylint_float_above(t);
    return f < tfar ? f : tfar;
}

/* --------------------------------------------------------- nearest hits -- */

static int same_instance(const struct RTCHit *hit,
                         const cylint_rtc_context *context)
{
    int same = 1;
    for (int i = 0; i < RTC_MAX_INSTANCE_LEVEL_COUNT; i++) {
        same &= hit->instID[i] == context->instID[i];
#if CYLINT_INSTANCE_ARRAYS
        same &= hit->instPrimID[i] == context->instPrimID[i];
#endif
    }
    return same;
}

/* The t of the ray's present hit, of which tfar is the rounding.  If both hits
 * of the shape round to tfar, u distinguishes them.  Bare hits have no u: then
 * it is the first hit, the one that is or will be the ray's without filters.
 * Returns HUGE_VAL if the caller or a filter changed tfar. */
static double present_t(const ray_test *r)
{
    double t = HUGE_VAL;
    cylint_shape between;
    cylint_line line;
    cylint_answer answer;
    const cylint_shape *shape =
        shape_at(r->data, r->hit->primID, r->ray->time, &between);
    const int n = intersect(shape, &r->line, CYLINT_WANT_T | CYLINT_WANT_Z,
                            &line, &answer);
    for (int i = n - 1; i >= 0; i--)
        if (rounded_up(answer.hit[i].t, r->ray->tfar) == r->ray->tfar &&
            (t >= HUGE_VAL || is_bare(r) ||
             (float)answer.hit[i].z == r->hit->u))
            t = answer.hit[i].t;
    return t;
}

/* Whether the ray's present hit is on this geometry. */
static int has_own_hit(const ray_test *r)
{
    return r->hit->geomID == r->geomID && r->hit->primID < r->data->n &&
           same_instance(r->hit, r->context);
}

/* Whether hit i of a shape is nearer than the present one or, at equal t, has
 * the lower number.  tfar is the present t rounded up, so the present t is
 * needed only if t rounds to tfar too.  Each hit is tested once: a present hit
 * on the same shape is its other hit. */
static int is_nearer(const ray_test *r, unsigned number,
                     const cylint_answer *answer, int i)
{
    const double t = answer->hit[i].t;
    if (t > (double)r->ray->tfar)
        return 0;
    if (rounded_up(t, r->ray->tfar) < r->ray->tfar || !has_own_hit(r))
        return 1;
    if (number == r->hit->primID)
        return i == 0;
    const double present = present_t(r);
    return t < present || (t == present && number < r->hit->primID);
}

/* -------------------------------------------------------- recording hits -- */

static cylint_hit_floats floats_of(const cylint_hit *at)
{
    return (cylint_hit_floats){
        (float)at->z,
        cylint_angle_as_float(at->phi),
        {(float)at->normal[0], (float)at->normal[1], (float)at->normal[2]}};
}

static void write_floats(const cylint_hit_floats *floats, struct RTCHit *hit)
{
    hit->Ng_x = floats->normal[0];
    hit->Ng_y = floats->normal[1];
    hit->Ng_z = floats->normal[2];
    hit->u = floats->z;
    hit->v = floats->phi;
}

static void write_ids(const ray_test *r, unsigned number, struct RTCHit *hit)
{
    hit->primID = number;
    hit->geomID = r->geomID;
    for (int i = 0; i < RTC_MAX_INSTANCE_LEVEL_COUNT; i++) {
        hit->instID[i] = r->context->instID[i];
#if CYLINT_INSTANCE_ARRAYS
        hit->instPrimID[i] = r->context->instPrimID[i];
#endif
    }
}

#if CYLINT_EMBREE == 4
struct context_with_filter {
    cylint_rtc_context context;
    RTCFilterFunctionN filter;
};
#endif

/* Calls the filter functions. */
static int filters_accept(const ray_test *r, struct RTCHit *hit)
{
    int valid = -1;
    struct RTCFilterFunctionNArguments filter = {&valid,
                                                 r->data->user,
                                                 r->context,
                                                 (struct RTCRayN *)r->ray,
                                                 (struct RTCHitN *)hit,
                                                 1};
    if (r->nearest)
        cylint_rtc_filter_hit(r->nearest, &filter);
    else
        cylint_rtc_filter_occluded(r->any, &filter);
#if CYLINT_EMBREE == 4
    if (valid && r->data->flags & CYLINT_EMBREE_CONTEXT_FILTER) {
        const RTCFilterFunctionN also =
            ((struct context_with_filter *)r->context)->filter;
        if (also)
            also(&filter);
    }
#endif
    return valid != 0;
}

/* Records a nearest hit at t if the filter functions accept it.  The hit is
 * written in its final place, which saves a copy. */
static int record_nearest(ray_test *r, unsigned number, float t,
                          const cylint_hit_floats *floats)
{
    const float tfar = r->ray->tfar;
    const struct RTCHit old = *r->hit;
    if (!is_bare(r))
        write_floats(floats, r->hit);
    write_ids(r, number, r->hit);
    r->ray->tfar = t;
    if (has_filters(r) && !filters_accept(r, r->hit)) {
        r->ray->tfar = tfar;
        *r->hit = old;
        return 0;
    }
    r->line.tmax = r->ray->tfar;
    return 1;
}

/* The same for a hit of an occlusion query. */
static int record_any(ray_test *r, unsigned number, float t,
                      const cylint_hit_floats *floats)
{
    const float tfar = r->ray->tfar;
    if (has_filters(r)) {
        struct RTCHit hit = {0};
        if (!is_bare(r))
            write_floats(floats, &hit);
        write_ids(r, number, &hit);
        r->ray->tfar = t;
        if (!filters_accept(r, &hit)) {
            r->ray->tfar = tfar;
            return 0;
        }
    }
    r->ray->tfar = -HUGE_VALF;
    return 1;
}

static int record(ray_test *r, unsigned number, float t,
                  const cylint_hit_floats *floats)
{
    return r->nearest ? record_nearest(r, number, t, floats)
                      : record_any(r, number, t, floats);
}

/* ----------------------------------------------------- exact intersections -- */

static unsigned wanted(const ray_test *r)
{
    return !needs_description(r) ? CYLINT_WANT_T | CYLINT_WANT_Z
                                 : CYLINT_WANT_T | CYLINT_WANT_NORMAL |
                                       CYLINT_WANT_Z | CYLINT_WANT_PHI;
}

/* Describes a hit that intersect() found. */
static cylint_hit_floats describe(const cylint_shape *shape,
                                  const cylint_line *line, unsigned want,
                                  const cylint_hit *at)
{
    cylint_hit hit = *at;
    cylint_describe(shape, line, want, &hit);
    return floats_of(&hit);
}

/* Tests the hits from number `first` on with cylint_intersect().  Hits of a
 * whole shape are described when they are accepted, those of a piece at once,
 * because z decides which piece owns them. */
static int test_exactly(ray_test *r, const cylint_shape *shape, unsigned number,
                        int first)
{
    cylint_line line;
    cylint_answer answer;
    const int whole =
        !r->leaf || cylint_leaf_piece(r->leaf, r->lane).count == 1;
    if (r->nearest && has_own_hit(r))
        r->line.tmax = tmax_including(r->ray->tfar);
    const int n = intersect(
        shape, &r->line, whole ? CYLINT_WANT_T | CYLINT_WANT_PART : wanted(r),
        &line, &answer);
    for (int i = first; i < n; i++) {
        const cylint_hit *at = &answer.hit[i];
        cylint_hit_floats floats = {0};
        if (!whole && !cylint_leaf_owns(r->leaf, r->lane, at->z))
            continue;
        if (r->nearest && !is_nearer(r, number, &answer, i))
            return 0;
        if (needs_description(r))
            floats =
                whole ? describe(shape, &line, wanted(r), at) : floats_of(at);
        if (record(r, number, rounded_up(at->t, r->ray->tfar), &floats))
            return 1;
    }
    return 0;
}

/* ----------------------------------------------------------- float filter -- */

/* A hit as the filter computes it. */
typedef struct {
    double t, t_error, z, z_error;
} bounded_hit;

typedef enum { NOT_OWNED, OWNED, OWNER_UNKNOWN } ownership;

/* Whether the lane's piece contains the hit. */
static ownership owner_of(const ray_test *r, const bounded_hit *hit)
{
    if (!r->leaf)
        return OWNED;
    const cylint_shape_piece piece = cylint_leaf_piece(r->leaf, r->lane);
    if (piece.count == 1)
        return OWNED;
    const int lowest = cylint_piece_at(hit->z - hit->z_error, piece.count);
    const int highest = cylint_piece_at(hit->z + hit->z_error, piece.count);
    return lowest < highest        ? OWNER_UNKNOWN
           : lowest == piece.index ? OWNED
                                   : NOT_OWNED;
}

typedef enum {
    UNCERTAIN = -1,
    REJECTED, /* the hit belongs to another lane, or a filter rejects it */
    ACCEPTED, /* it is the ray's hit, or will be once described */
    TOO_FAR   /* it is behind tfar, and so are later hits of the shape */
} outcome;

/* Classifies a hit; *t becomes the new tfar. */
static outcome classify(const ray_test *r, const bounded_hit *hit, float *t)
{
    const ownership owner = owner_of(r, hit);
    *t = cylint_float_above(hit->t);
    const int certain = cylint_is_float_above(*t, hit->t, hit->t_error);
    if (certain && *t > r->ray->tfar)
        return TOO_FAR;
    if (owner == NOT_OWNED)
        return REJECTED;
    return owner == OWNER_UNKNOWN || !certain || *t == r->ray->tfar ? UNCERTAIN
                                                                    : ACCEPTED;
}

static outcome test_hit(ray_test *r, unsigned number,
                        const cylint_float_filter_state *state,
                        const cylint_float_filter_hit *hit)
{
    cylint_hit_floats floats;
    const bounded_hit at = {hit->t, hit->t_error, hit->z, hit->z_error};
    float t;
    const outcome result = classify(r, &at, &t);
    if (result != ACCEPTED)
        return result;
    if (needs_description(r) && !r->data->filter->describe(state, hit, &floats))
        return UNCERTAIN;
    return record(r, number, t, &floats) ? ACCEPTED : REJECTED;
}

cylint_float_filter_target cylint_ray_test_target(
    const ray_test *r, unsigned rank, cylint_shape *between,
    cylint_float_filter_shape *made)
{
    const unsigned number = number_of(r, rank);
    if (r->leaf)
        return (cylint_float_filter_target){
            cylint_float_filter_at(&r->data->filter_shapes, rank),
            r->data->filter_shapes.small, r->data->shapes + number,
            cylint_leaf_ends(r->leaf, r->lane)};
    const cylint_shape *whole =
        shape_at(r->data, number, r->ray->time, between);
    cylint_float_filter_shape_of(made, whole);
    return (cylint_float_filter_target){made, 0, whole, whole->ends};
}

/* Returns 0 if cylint_ray_test_shape() must decide; else writes whether a hit
 * was recorded. */
static int test_nearest(ray_test *r, unsigned rank, int *hit)
{
    cylint_float_filter_nearest at;
    const unsigned number = r->data->number[rank];
    const cylint_float_filter_target target = {
        cylint_float_filter_at(&r->data->filter_shapes, rank),
        r->data->filter_shapes.small, r->data->shapes + number,
        cylint_leaf_ends(r->leaf, r->lane)};
    const cylint_shape_piece piece = cylint_leaf_piece(r->leaf, r->lane);
    const cylint_float_filter_limits limits = {
        r->ray->tfar, piece.index, piece.count, needs_description(r)};
    const cylint_float_filter_result is =
        r->data->filter->nearest(&target, &r->line, &limits, &at);
    if (is == CYLINT_FLOAT_FILTER_UNCERTAIN)
        return 0;
    *hit = 0;
    if (is == CYLINT_FLOAT_FILTER_HIT) {
        *hit = record(r, number, at.t, &at.floats);
        if (!*hit && !at.leaves)
            *hit = cylint_ray_test_shape(r, rank, 1);
    }
    return 1;
}

static inline int test_lane(ray_test *r)
{
    const unsigned rank = r->leaf->number[r->lane];
    int hit;
    if (!test_nearest(r, rank, &hit))
        hit = cylint_ray_test_shape(r, rank, 0);
    return hit;
}

int cylint_ray_test_lane(ray_test *r)
{
    return test_lane(r);
}

int cylint_ray_test_lanes(ray_test *r, const cylint_leaf *leaf, unsigned lanes,
                          const float least[CYLINT_LEAF_SIZE])
{
    if (lanes & (lanes - 1))
        prefetch_shapes(r->data, leaf, lanes);
    while (lanes && select_nearest_lane(r, leaf, &lanes, least)) {
        const int hit = test_lane(r);
        r->found |= hit;
        if (hit && r->any)
            return 1;
    }
    return 0;
}

int cylint_ray_test_shape(ray_test *r, unsigned rank, int skip_entry)
{
    const unsigned number = number_of(r, rank);
    const cylint_float_filter *filter = r->data->filter;
    cylint_shape between;
    cylint_float_filter_state state;
    cylint_float_filter_hit hit;
    cylint_float_filter_shape made;
    const cylint_float_filter_target target =
        cylint_ray_test_target(r, rank, &between, &made);
    cylint_float_filter_result is =
        filter->test_entry(&state, &target, &r->line, &hit);
    for (int i = 0, hits = 0; i < 2; i++) {
        if (i == 1)
            is = filter->test_exit(&state, &hit);
        if (is == CYLINT_FLOAT_FILTER_MISS)
            continue;
        const outcome result = is != CYLINT_FLOAT_FILTER_HIT ? UNCERTAIN
                               : i < skip_entry
                                   ? REJECTED
                                   : test_hit(r, number, &state, &hit);
        if (result == UNCERTAIN)
            return test_exactly(r, target.whole, number, hits);
        if (result != REJECTED)
            return result == ACCEPTED;
        hits++;
    }
    return 0;
}

int cylint_ray_test_accept(ray_test *r, const cylint_packet_filter_results *a,
                           int i)
{
    const unsigned rank = r->leaf->number[r->lane], bit = 1u << i;
    if (a->uncertain & bit)
        return cylint_ray_test_shape(r, rank, 0);
    if (!(a->hit & bit))
        return a->crosses & bit ? cylint_ray_test_shape(r, rank, 1) : 0;
    const bounded_hit at = {a->t[i], a->t_error[i], a->z[i], a->z_error[i]};
    float t;
    const outcome result = classify(r, &at, &t);
    if (result == TOO_FAR)
        return 0;
    if (result == UNCERTAIN ||
        (result == ACCEPTED && needs_description(r) && !(a->described & bit)))
        return cylint_ray_test_shape(r, rank, 0);
    const cylint_hit_floats floats = {(float)a->float_z[i],
                                      (float)a->phi[i],
                                      {(float)a->normal[0][i],
                                       (float)a->normal[1][i],
                                       (float)a->normal[2][i]}};
    return (result == ACCEPTED && record(r, number_of(r, rank), t, &floats)) ||
           cylint_ray_test_shape(r, rank, 1);
}

void cylint_embree_complete(struct RTCGeometryTy *geometry,
                            struct RTCRayHit *rayhit)
{
    const cylint_embree_data *data = rtcGetGeometryUserData(geometry);
    const struct RTCRay *ray = &rayhit->ray;
    cylint_float_filter_ray l = line_of(ray);
    cylint_shape between;
    cylint_line line;
    cylint_answer answer;
    if (!(rayhit->hit.primID < data->n))
        return;
    l.tmax = tmax_including(ray->tfar);
    const cylint_shape *shape =
        shape_at(data, rayhit->hit.primID, ray->time, &between);
    const int n =
        intersect(shape, &l, CYLINT_WANT_T | CYLINT_WANT_PART, &line, &answer);
    for (int i = 0; i < n; i++)
        if (rounded_up(answer.hit[i].t, ray->tfar) == ray->tfar) {
            const cylint_hit_floats floats =
                describe(shape, &line, CYLINT_WANT_ALL, &answer.hit[i]);
            write_floats(&floats, &rayhit->hit);
            return;
        }
}
