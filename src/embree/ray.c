/*
 * ray.c - one ray of Embree's: tests shapes against it, and records hits
 */
#include "ray.h"

#include <string.h>

#include "../bvh/float_bounds.h"
#include "angle.h"
#include "motion.h"

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

/* Makes the shape of that rank; if it moves, at the ray's time. */
static void make_shape(const cylint_embree_data *data, size_t rank, float time,
                       cylint_shape *shape)
{
    cylint_shape at[2];
    if (!cylint_embree_moves(data)) {
        cylint_embree_shape(&data->shapes[0], rank, shape);
        return;
    }
    cylint_embree_shape(&data->shapes[0], rank, &at[0]);
    cylint_embree_shape(&data->shapes[1], rank, &at[1]);
    cylint_embree_between(&at[0], &at[1], time, shape);
}

static size_t rank_of(const cylint_embree_data *data, size_t number)
{
    return data->rank ? data->rank[number] : number;
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

/* The number of the shape of a hit on this geometry, or data->n.  geomID: the
 * geometry's own. */
static size_t number_of_hit(const cylint_embree_data *data,
                            const struct RTCHit *hit, unsigned geomID)
{
    if (!data->parts)
        return hit->geomID == geomID && hit->primID < data->n ? hit->primID
                                                              : data->n;
    if (data->n_parts == 0)
        return data->n;
    const cylint_embree_merged *part =
        &data->parts[cylint_embree_part_at(data, 1, hit->geomID)];
    return part->geomID == hit->geomID && hit->primID < part->n
               ? part->first + hit->primID
               : data->n;
}

/* The number of the shape of the ray's present hit, or data->n if that is not on
 * this geometry. */
static size_t present_number(const ray_test *r)
{
    return same_instance(r->hit, r->context)
               ? number_of_hit(r->data, r->hit, r->geomID)
               : r->data->n;
}

/* The t of the ray's present hit, of which tfar is the rounding.  If both hits
 * of the shape round to tfar, u distinguishes them.  Bare hits have no u: then
 * it is the first hit, the one that is or will be the ray's without filters.
 * Returns HUGE_VAL if the caller or a filter changed tfar. */
static double present_t(const ray_test *r, size_t number)
{
    double t = HUGE_VAL;
    cylint_shape shape;
    cylint_line line;
    cylint_answer answer;
    make_shape(r->data, rank_of(r->data, number), r->ray->time, &shape);
    const int n = intersect(&shape, &r->line, CYLINT_WANT_T | CYLINT_WANT_Z,
                            &line, &answer);
    for (int i = n - 1; i >= 0; i--)
        if (rounded_up(answer.hit[i].t, r->ray->tfar) == r->ray->tfar &&
            (t >= HUGE_VAL || is_bare(r) ||
             (float)answer.hit[i].z == r->hit->u))
            t = answer.hit[i].t;
    return t;
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
    if (rounded_up(t, r->ray->tfar) < r->ray->tfar)
        return 1;
    const size_t other = present_number(r);
    if (other == r->data->n)
        return 1;
    if (number == other)
        return i == 0;
    const double present = present_t(r, other);
    return t < present || (t == present && number < other);
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
    if (r->data->parts) {
        const cylint_embree_merged *part =
            &r->data->parts[r->data->part[r->rank]];
        hit->primID -= (unsigned)part->first;
        hit->geomID = part->geomID;
    }
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
static int test_exactly(ray_test *r, int first)
{
    cylint_line line;
    cylint_answer answer;
    cylint_shape shape;
    const unsigned number = number_of(r);
    make_shape(r->data, r->rank, r->ray->time, &shape);
    const int whole =
        !r->leaf || cylint_leaf_piece(r->leaf, r->lane).count == 1;
    if (r->nearest && present_number(r) != r->data->n)
        r->line.tmax = tmax_including(r->ray->tfar);
    const int n = intersect(
        &shape, &r->line, whole ? CYLINT_WANT_T | CYLINT_WANT_PART : wanted(r),
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
                whole ? describe(&shape, &line, wanted(r), at) : floats_of(at);
        if (record(r, number, rounded_up(at->t, r->ray->tfar), &floats))
            return 1;
    }
    return 0;
}

/* ---------------------------------------------------------------- tracing -- */

int cylint_ray_end(ray_test *r, cylint_float_filter_question *asked,
                   cylint_float_filter_answer *answer)
{
    for (;;) {
        if (answer->is == CYLINT_FLOAT_FILTER_UNCERTAIN)
            return test_exactly(r, asked->exit_only);
        if (answer->is == CYLINT_FLOAT_FILTER_MISS)
            return 0;
        if (record(r, number_of(r), answer->t, &answer->floats))
            return 1;
        if (answer->leaves)
            return 0;
        asked->exit_only = 1;
        r->data->filter_one(asked, 1, answer);
    }
}

CYLINT_INLINE int test_shape(ray_test *r, cylint_float_filter_question *asked)
{
    cylint_float_filter_answer answer;
    r->data->filter_one(asked, 1, &answer);
    return cylint_ray_end(r, asked, &answer);
}

/* Tests lanes (bits) of a leaf, nearest first, until no remaining lane can hold
 * the nearest hit. */
static int test_lanes(void *self, const cylint_leaf *leaf, unsigned lanes,
                      const float least[CYLINT_LEAF_SIZE])
{
    ray_test *r = self;
    if (lanes & (lanes - 1))
        prefetch_shapes(r->data, leaf, lanes);
    while (lanes && select_nearest_lane(r, leaf, &lanes, least)) {
        cylint_float_filter_question asked = question_of(r);
        const int hit = test_shape(r, &asked);
        r->found |= hit;
        if (hit && r->any)
            return 1;
    }
    return 0;
}

static int test_primitive(ray_test *r, unsigned primID)
{
    const cylint_embree_shapes *s = r->data->shapes;
    cylint_float_filter_shape between;
    r->rank = primID;
    cylint_float_filter_question asked = {
        .shape = cylint_float_filter_at(&s->records, primID),
        .line = &r->line,
        .tfar = r->ray->tfar,
        .small = s->records.small,
        .ends = s->ends[primID],
        .count = 1,
        .describes = needs_description(r)};
    if (cylint_embree_moves(r->data)) {
        const cylint_float_filter_shape at_0 = cylint_embree_record(s, primID),
                                        at_1 =
                                            cylint_embree_record(s + 1, primID);
        cylint_embree_record_between(&at_0, &at_1, r->ray->time, &between);
        asked.shape = &between;
        asked.small = 0;
    }
    return test_shape(r, &asked);
}

int cylint_trace_single(ray_test *r, unsigned primID)
{
    const cylint_traversal *traversal = r->data->traversal;
    if (!set_line(r))
        return 0;
    if (!traversal)
        return test_primitive(r, primID);
    if (traversal->ray(&r->data->bvh, float_ray(r->ray), test_lanes, r,
                       r->any && !has_filters(r))) {
        r->ray->tfar = -HUGE_VALF;
        return 1;
    }
    return r->found;
}

/* ------------------------------------------------------------ completion -- */

void cylint_embree_complete(struct RTCGeometryTy *geometry,
                            struct RTCRayHit *rayhit)
{
    const cylint_embree_data *data = rtcGetGeometryUserData(geometry);
    const struct RTCRay *ray = &rayhit->ray;
    cylint_float_filter_ray l = line_of(ray);
    cylint_shape shape;
    cylint_line line;
    cylint_answer answer;
    const size_t number = number_of_hit(data, &rayhit->hit, rayhit->hit.geomID);
    if (number == data->n)
        return;
    l.tmax = tmax_including(ray->tfar);
    make_shape(data, rank_of(data, number), ray->time, &shape);
    const int n =
        intersect(&shape, &l, CYLINT_WANT_T | CYLINT_WANT_PART, &line, &answer);
    for (int i = 0; i < n; i++)
        if (rounded_up(answer.hit[i].t, ray->tfar) == ray->tfar) {
            const cylint_hit_floats floats =
                describe(&shape, &line, CYLINT_WANT_ALL, &answer.hit[i]);
            write_floats(&floats, &rayhit->hit);
            return;
        }
}
