/*
 * ray.c - one ray of Embree's: tests shapes against it, and records hits
 */
#include "ray.h"

#include <string.h>

#include "../bvh/float_bounds.h"
#include "angle.h"

/* The domain's end that still includes every root whose t, rounded to a double,
 * is tfar. */
static double tmax_including(float tfar)
{
    return nextafter((double)tfar, HUGE_VAL);
}

/* A shape, and the library's answer to the ray's line; 0 hits for a line that it
 * refuses. */
typedef struct {
    cylint_shape shape;
    cylint_line line;
    cylint_answer answer;
    int n; /* hits */
} exact_hits;

static void intersect(const ray_test *r, size_t rank, unsigned want,
                      exact_hits *x)
{
    const cylint_float_filter_question *q = &r->q;
    if (r->data->moved)
        cylint_embree_moving_shape(r->data->shapes, rank, r->ray->time,
                                   &x->shape);
    else
        cylint_embree_shape(r->data->shapes, rank, &x->shape);
    x->n = cylint_span(&x->line, q->o, q->d, q->tmin, q->tmax) == CYLINT_OK
               ? cylint_intersect(&x->shape, &x->line, want, &x->answer)
               : 0;
}

/* The new tfar of a ray hit at t <= tfar. */
static float rounded_up(double t, float tfar)
{
    const float f = cylint_float_above(t);
    return f < tfar ? f : tfar;
}

/* --------------------------------------------------------- nearest hits -- */

/* The number of the shape of a hit on this geometry, or data->n.  geomID: the
 * geometry's own. */
static size_t number_of_hit(const cylint_embree_data *data,
                            const struct RTCHit *hit, unsigned geomID)
{
    const cylint_embree_array *at = data->arrays;
    if (data->is_merged) {
        at += cylint_embree_array_at(data, 1, hit->geomID);
        geomID = at->geomID;
    }
    return hit->geomID == geomID && hit->primID < at->n
               ? at->first + hit->primID
               : data->n;
}

/* The number of the shape of the ray's present hit, or data->n if that is not on
 * this geometry, in this instance. */
static size_t present_number(const ray_test *r)
{
    const char *instance =
        (const char *)r->hit + offsetof(struct RTCHit, instID);
    return memcmp(instance, cylint_rtc_instance(r->args->context),
                  CYLINT_INSTANCE_BYTES) == 0
               ? number_of_hit(r->data, r->hit, r->args->geomID)
               : r->data->n;
}

/* The index of the ray's present hit, of which tfar is the rounding, among the
 * library's.  If both hits of the shape round to tfar, u distinguishes them.  Bare
 * hits have no u: then it is the first hit, the one that is or will be the ray's
 * without filters.  -1 if the caller or a filter changed tfar. */
static int find_present(const ray_test *r, size_t number, unsigned want,
                        exact_hits *x)
{
    const uint32_t *rank = r->data->rank;
    int found = -1;
    intersect(r, rank ? rank[number] : number, want, x);
    for (int i = x->n - 1; i >= 0; i--) {
        const cylint_hit *at = &x->answer.hit[i];
        if (rounded_up(at->t, r->ray->tfar) == r->ray->tfar &&
            (found < 0 || is_bare(r) || (float)at->z == r->hit->u))
            found = i;
    }
    return found;
}

/* Whether hit i of a shape is nearer than the present one or, at equal t, has
 * the lower number.  tfar is the present t rounded up, so the present t is
 * needed only if t rounds to tfar too.  Each hit is tested once: a present hit
 * on the same shape is its other hit. */
static int is_nearer(const ray_test *r, const cylint_answer *answer, int i)
{
    const unsigned number = number_of(r);
    const double t = answer->hit[i].t;
    if (t > (double)r->ray->tfar)
        return 0;
    if (rounded_up(t, r->ray->tfar) < r->ray->tfar)
        return 1;
    const size_t other = present_number(r);
    if (other == r->data->n)
        return 1;
    if (number == other)
        return i == 0;
    exact_hits x;
    const int present =
        find_present(r, other, CYLINT_WANT_T | CYLINT_WANT_Z, &x);
    if (present < 0)
        return 1;
    const double present_t = x.answer.hit[present].t;
    return t < present_t || (t == present_t && number < other);
}

/* -------------------------------------------------------- recording hits -- */

/* Describes hit i in the question. */
static void describe(ray_test *r, exact_hits *x, int i)
{
    cylint_hit *at = &x->answer.hit[i];
    cylint_describe(&x->shape, &x->line,
                    CYLINT_WANT_NORMAL | CYLINT_WANT_Z | CYLINT_WANT_PHI, at);
    EACH(j, 3)
        r->q.floats[j] = (float)at->normal[j];
    r->q.floats[3] = (float)at->z;
    r->q.floats[4] = cylint_angle_as_float(at->phi);
}

/* Ng, u and v are the first members of a hit. */
static void write_floats(const ray_test *r)
{
    memcpy(r->hit, r->q.floats, sizeof r->q.floats);
}

static void write_ids(const ray_test *r)
{
    struct RTCHit *hit = r->hit;
    hit->primID = number_of(r);
    hit->geomID = r->args->geomID;
    if (r->data->array) {
        const cylint_embree_array *from =
            &r->data->arrays[r->data->array[r->rank]];
        hit->primID -= (unsigned)from->first;
        hit->geomID = from->geomID;
    }
    memcpy((char *)hit + offsetof(struct RTCHit, instID),
           cylint_rtc_instance(r->args->context), CYLINT_INSTANCE_BYTES);
}

/* Of Embree 4, see CYLINT_EMBREE_CONTEXT_FILTER. */
struct context_with_filter {
    cylint_rtc_context context;
    RTCFilterFunctionN filter;
};

/* Calls the filter functions. */
static int filters_accept(const ray_test *r)
{
    int valid = -1;
    struct RTCFilterFunctionNArguments filter = {&valid,
                                                 r->data->user,
                                                 r->args->context,
                                                 (struct RTCRayN *)r->ray,
                                                 (struct RTCHitN *)r->hit,
                                                 1};
    if (r->any)
        cylint_rtc_filter_occluded(
            (const struct RTCOccludedFunctionNArguments *)r->args, &filter);
    else
        cylint_rtc_filter_hit(r->args, &filter);
    if (CYLINT_EMBREE == 4 && valid &&
        r->data->flags & CYLINT_EMBREE_CONTEXT_FILTER) {
        const RTCFilterFunctionN also =
            ((struct context_with_filter *)filter.context)->filter;
        if (also)
            also(&filter);
    }
    return valid != 0;
}

/* Records the hit that the question answers if the filter functions accept it.  The
 * hit is written in its final place, which saves a copy. */
static int record(ray_test *r)
{
    if (r->any && !has_filters(r)) {
        r->ray->tfar = -HUGE_VALF;
        return r->found = 1;
    }
    const float tfar = r->ray->tfar;
    const struct RTCHit old = *r->hit;
    if (r->q.describes)
        write_floats(r);
    write_ids(r);
    r->ray->tfar = r->q.t;
    if (has_filters(r) && !filters_accept(r)) {
        r->ray->tfar = tfar;
        *r->hit = old;
        return 0;
    }
    if (r->any)
        r->ray->tfar = -HUGE_VALF;
    r->q.tmax = r->ray->tfar;
    return r->found = 1;
}

/* ----------------------------------------------------- exact intersections -- */

/* Tests the hits from number `first` on with cylint_intersect(); z decides which
 * piece owns them. */
static void test_exactly(ray_test *r, int first)
{
    const int whole = r->q.count == 1;
    exact_hits x;
    if (!r->any && present_number(r) != r->data->n)
        r->q.tmax = tmax_including(r->ray->tfar);
    intersect(r, r->rank,
              CYLINT_WANT_T | CYLINT_WANT_PART | (whole ? 0 : CYLINT_WANT_Z),
              &x);
    for (int i = first; i < x.n; i++) {
        const cylint_hit *at = &x.answer.hit[i];
        if (!whole && !cylint_leaf_owns(r->leaf, r->lane, at->z))
            continue;
        if (!r->any && !is_nearer(r, &x.answer, i))
            return;
        if (r->q.describes)
            describe(r, &x, i);
        r->q.t = rounded_up(at->t, r->ray->tfar);
        if (record(r))
            return;
    }
}

/* ---------------------------------------------------------------- tracing -- */

CYLINT_INLINE void filter_one(ray_test *r)
{
    cylint_float_filter_question *const one = &r->q;
    r->data->filter[0](&one, 1);
}

void cylint_ray_end(ray_test *r)
{
    while (r->q.is == CYLINT_FLOAT_FILTER_HIT) {
        if (record(r) || r->q.leaves)
            return;
        r->q.exit_only = 1;
        filter_one(r);
    }
    if (r->q.is == CYLINT_FLOAT_FILTER_UNCERTAIN)
        test_exactly(r, r->q.exit_only);
}

/* Tests lanes (bits) of a leaf, nearest first, until no remaining lane can hold
 * the nearest hit. */
static int test_lanes(void *self, const cylint_leaf *leaf, unsigned lanes,
                      const float least[CYLINT_LEAF_SIZE])
{
    ray_test *r = self;
    if (lanes & (lanes - 1))
        prefetch_shapes(r->data, leaf, lanes);
    while (lanes && take_nearest_lane(r, leaf, &lanes, least)) {
        filter_one(r);
        cylint_ray_end(r);
        if (r->found && r->any)
            return 1;
    }
    return 0;
}

static void test_primitive(ray_test *r)
{
    const cylint_embree_shapes *s = r->data->shapes;
    r->rank = r->args->primID;
    set_question(r, s->ends[r->rank], (cylint_shape_piece){0, 1});
    if (r->data->moved)
        cylint_embree_moving_record(s, r->rank, r->ray->time, &r->q.record);
    filter_one(r);
    cylint_ray_end(r);
}

int cylint_trace_single(ray_test *r)
{
    const cylint_traversal *traversal = r->data->traversal;
    if (!traversal) {
        test_primitive(r);
    } else if (traversal->ray(&r->data->bvh, float_ray(r->ray), test_lanes, r,
                              r->any && !has_filters(r))) {
        r->ray->tfar = -HUGE_VALF;
        r->found = 1;
    }
    return r->found;
}

/* ------------------------------------------------------------ completion -- */

void cylint_embree_complete(struct RTCGeometryTy *geometry,
                            struct RTCRayHit *rayhit)
{
    const call args = {.geometryUserPtr = rtcGetGeometryUserData(geometry)};
    const cylint_embree_data *data = args.geometryUserPtr;
    const size_t number = number_of_hit(data, &rayhit->hit, rayhit->hit.geomID);
    ray_test r;
    exact_hits x;
    if (number == data->n)
        return;
    start_test(&r, &args, 0, &rayhit->ray, &rayhit->hit);
    r.q.tmax = tmax_including(rayhit->ray.tfar);
    const int i = find_present(
        &r, number, CYLINT_WANT_T | CYLINT_WANT_Z | CYLINT_WANT_PART, &x);
    if (i >= 0) {
        describe(&r, &x, i);
        write_floats(&r);
    }
}
