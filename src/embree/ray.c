/*
 * ray.c - the callbacks: trace one ray, or the rays of a packet
 *
 * cylint_intersect() decides whether and where a shape is hit; the float filter
 * decides the same for most questions, with certainty and faster.
 */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "../bvh/float_bounds.h"
#include "../numbers/compiler.h"
#include "../numbers/environment.h"
#include "geometry.h"

/* The layout that geometry.h states. */
#define CALL(x, y)                      \
    (offsetof(cylint_embree_call, x) == \
     offsetof(struct RTCOccludedFunctionNArguments, y))
typedef char
    same_layouts[CALL(valid, valid) && CALL(geometryUserPtr, geometryUserPtr) &&
                         CALL(primID, primID) && CALL(context, context) &&
                         CALL(rayhit, ray) && CALL(N, N) && CALL(geomID, geomID)
                     ? 1
                     : -1];
#undef CALL

typedef cylint_embree_call call;
typedef cylint_ray_test ray_test;

static inline int has_flag(const ray_test *r, unsigned flag)
{
    return (r->data->options.flags & flag) != 0;
}

/* The filter where the bounds of data's do not hold: not in rounding to nearest. */
static void decide_nothing(cylint_float_filter_question *const of[], int n)
{
    for (int i = 0; i < n; i++)
        of[i]->is = CYLINT_FLOAT_FILTER_UNDECIDED;
}

static cylint_float_filter *const no_filter[2] = {decide_nothing,
                                                  decide_nothing};

/* Sets what all questions about the ray share.  Returns whether cylint_span()
 * accepts it.  The box tests do not reject all rays that it refuses.  Sums of six
 * floats do not overflow doubles.  Clearing the whole struct would take longer than
 * testing a leaf. */
static inline int start_test(ray_test *r, const call *args, int any,
                             struct RTCRay *ray, struct RTCHit *hit)
{
    const double o[3] = {ray->org_x, ray->org_y, ray->org_z},
                 d[3] = {ray->dir_x, ray->dir_y, ray->dir_z};
    double direction = 0, all = 0;
    r->data = args->geometryUserPtr;
    r->filter = cylint_rounds_to_nearest() ? r->data->filter : no_filter;
    r->args = args;
    r->any = any;
    r->ray = ray;
    r->hit = hit;
    EACH(j, 3) {
        r->q.line.o[j] = o[j];
        r->q.line.d[j] = d[j];
        direction += fabs(d[j]);
        all += fabs(o[j]);
    }
    r->q.line.tmin = ray->tnear;
    r->q.line.tmax = ray->tfar;
    /* whether the caller or a filter reads u, v and Ng */
    r->q.describes = !has_flag(r, CYLINT_EMBREE_BARE) &&
                     (!any || !has_flag(r, CYLINT_EMBREE_NO_FILTERS));
    r->last = ray->tfar;
    r->found = 0;
    r->last_ball = -1;
    return (direction > 0) & (all + direction < HUGE_VAL) &
           (ray->tnear <= ray->tfar);
}

/* The number of the shape of this rank. */
static inline unsigned number_of_rank(const ray_test *r, unsigned rank)
{
    return r->data->number ? r->data->number[rank] : rank;
}

/* Sets the question whether the ray hits a slice of the shape. */
CYLINT_INLINE void set_question(ray_test *r, int ends, cylint_slice slice)
{
    cylint_embree_record(&r->data->shapes[0], r->rank, &r->q.record);
    r->q.ends = ends;
    r->q.slice = slice;
    r->q.exit_only = 0;
}

/* ------------------------------------------------------- exact answers -- */

/* A shape, and the library's answer to the ray's line up to tfar.  A line that it
 * refuses has no hits. */
typedef struct {
    cylint_shape shape;
    cylint_line line;
    cylint_answer answer;
} exact_hits;

/* ties: every root whose t, rounded to a double, is tfar counts. */
static void intersect(const ray_test *r, size_t rank, int ties, exact_hits *x)
{
    const unsigned want = CYLINT_WANT_T | CYLINT_WANT_Z | CYLINT_WANT_PART;
    const cylint_float_filter_question *q = &r->q;
    const double tfar = r->ray->tfar;
    const double tmax = ties ? nextafter(tfar, HUGE_VAL) : tfar;
    cylint_embree_shape(r->data->shapes, rank, r->ray->time, &x->shape);
    cylint_span(&x->line, q->line.o, q->line.d, q->line.tmin, tmax);
    cylint_intersect(&x->shape, &x->line, want, &x->answer);
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
        geomID = at->part.geomID;
    }
    return hit->geomID == geomID && hit->primID < at->part.n
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

/* Describes hit i, of which z is known, in the question. */
static void describe(ray_test *r, exact_hits *x, int i)
{
    cylint_hit *at = &x->answer.hit[i];
    cylint_describe(&x->shape, &x->line, CYLINT_WANT_NORMAL | CYLINT_WANT_PHI,
                    at);
    EACH(j, 3)
        r->q.floats[j] = (float)at->normal[j];
    r->q.floats[3] = (float)at->z;
    const float v = (float)at->phi;
    r->q.floats[4] = v < 1 ? v : 1 - FLT_EPSILON / 2; /* below 1 */
}

/* Whether the ray's hit has the description of hit i, which is left in the
 * question.  lint: equal bits are meant. */
static int is_described(ray_test *r, exact_hits *x, int i)
{
    describe(r, x, i);
    return memcmp(r->hit, r->q.floats, sizeof r->q.floats) == 0;
}

/* The index of the ray's present hit, of which tfar is the rounding, among the
 * library's.  If both hits of the shape round to tfar, Ng, u and v distinguish
 * them.  Bare hits have none: then it is the first hit, the one that is or will be
 * the ray's without filters.  -1 if the caller or a filter changed tfar. */
static int find_present(ray_test *r, size_t number, exact_hits *x)
{
    const uint32_t *rank = r->data->rank;
    int found = -1;
    intersect(r, rank ? rank[number] : number, 1, x);
    for (int i = x->answer.n - 1; i >= 0; i--)
        if (rounded_up(x->answer.hit[i].t, r->ray->tfar) == r->ray->tfar &&
            (found < 0 || has_flag(r, CYLINT_EMBREE_BARE) ||
             is_described(r, x, i)))
            found = i;
    return found;
}

/* Whether hit i of a shape is nearer than the present one or, at equal t, has
 * the lower number.  tfar is the present t rounded up, so the present t is
 * needed only if t rounds to tfar too.  Each hit is tested once: a present hit
 * on the same shape is its other hit. */
static int is_nearer(ray_test *r, const cylint_answer *answer, int i)
{
    const unsigned number = number_of_rank(r, r->rank);
    const double t = answer->hit[i].t;
    if (t > (double)r->ray->tfar)
        return 0;
    if (rounded_up(t, r->ray->tfar) < r->ray->tfar)
        return 1;
    const size_t other = present_number(r);
    if (other == r->data->n) /* none, or on another geometry, which stays */
        return r->hit->geomID == RTC_INVALID_GEOMETRY_ID;
    if (number == other)
        return i == 0;
    exact_hits x;
    const int present = find_present(r, other, &x);
    if (present < 0)
        return 1;
    const double present_t = x.answer.hit[present].t;
    return t < present_t || (t == present_t && number < other);
}

/* -------------------------------------------------------- recording hits -- */

static void write_ids(const ray_test *r)
{
    const uint32_t *array = r->data->array;
    const cylint_embree_array *at =
        r->data->arrays + (array ? array[r->rank] : 0);
    r->hit->primID = number_of_rank(r, r->rank) - (unsigned)at->first;
    r->hit->geomID = array ? at->part.geomID : r->args->geomID;
    memcpy((char *)r->hit + offsetof(struct RTCHit, instID),
           cylint_rtc_instance(r->args->context), CYLINT_INSTANCE_BYTES);
}

/* A context of Embree 4 with CYLINT_EMBREE_CONTEXT_FILTER. */
struct context_with_filter {
    cylint_rtc_context context;
    RTCFilterFunctionN filter;
};

/* Calls the filter functions. */
static int filters_accept(const ray_test *r)
{
    int valid = -1;
    struct RTCFilterFunctionNArguments filter = {&valid,
                                                 r->data->options.user,
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
        r->data->options.flags & CYLINT_EMBREE_CONTEXT_FILTER) {
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
    const float tfar = r->ray->tfar;
    const struct RTCHit old = *r->hit;
    if (r->q.describes) /* Ng, u and v, the first members of a hit */
        memcpy(r->hit, r->q.floats, sizeof r->q.floats);
    write_ids(r);
    r->ray->tfar = r->q.t;
    if (!has_flag(r, CYLINT_EMBREE_NO_FILTERS) && !filters_accept(r)) {
        r->ray->tfar = tfar;
        *r->hit = old;
        return 0;
    }
    if (r->any)
        r->ray->tfar = -HUGE_VALF;
    r->q.line.tmax = r->ray->tfar;
    r->last_ball = r->q.ball;
    r->last_rank = r->rank;
    r->last_leaves = r->q.leaves;
    return r->found = 1;
}

/* -------------------------------------------------------- testing shapes -- */

/* Tests with cylint_intersect() the hits that the filter has not tested; z decides
 * which slice owns them.  If a hit has reduced tfar, the domain holds every root
 * whose double is tfar; of primitives another callback may have reduced it. */
ASIDE void test_exactly(ray_test *r)
{
    const cylint_slice slice = r->q.slice;
    const int ties =
        !r->any && (r->data->traversal ? r->ray->tfar < r->last
                                       : present_number(r) != r->data->n);
    exact_hits x;
    intersect(r, r->rank, ties, &x);
    for (int i = r->q.exit_only; i < x.answer.n; i++) {
        const cylint_hit *at = &x.answer.hit[i];
        if (cylint_slice_at(at->z, slice.count) != slice.index)
            continue;
        if (!r->any && !is_nearer(r, &x.answer, i))
            return;
        if (r->q.describes)
            describe(r, &x, i);
        r->q.t = rounded_up(at->t, r->ray->tfar);
        r->q.ball = -1;
        if (record(r))
            return;
    }
}

CYLINT_INLINE void filter_one(ray_test *r)
{
    cylint_float_filter_question *const one = &r->q;
    r->filter[0](&one, 1);
}

/* Whether the hit that the filter answers is the last recorded one, on a ball that
 * the shapes have in common, as those of a chain of round cones do: a ray enters
 * and leaves a ball once.  lint: equal bits are meant. */
static int repeats_hit(const ray_test *r)
{
    cylint_record last;
    if (r->last_ball < 0 || r->last_leaves != r->q.leaves)
        return 0;
    cylint_embree_record(&r->data->shapes[0], r->last_rank, &last);
    return memcmp(&last.p0[0] + 4 * r->last_ball,
                  &r->q.record.p0[0] + 4 * r->q.ball, 4 * sizeof(double)) == 0;
}

/* Records the hit that the filter answers, if it is nearer than the present one
 * and the filter functions accept it, or else a later hit of the shape;
 * cylint_intersect() decides what is uncertain. */
static void end_test(ray_test *r)
{
    while (r->q.is == CYLINT_FLOAT_FILTER_HIT) {
        if (r->q.t == r->ray->tfar) {
            if (!repeats_hit(r))
                break;
            if (number_of_rank(r, r->last_rank) < number_of_rank(r, r->rank))
                return;
        }
        if (record(r) || r->q.leaves)
            return;
        r->q.exit_only = 1;
        filter_one(r);
    }
    if (r->q.is != CYLINT_FLOAT_FILTER_MISS)
        test_exactly(r);
}

CYLINT_INLINE void prefetch_records(const cylint_embree_data *data,
                                    const cylint_leaf *leaf, unsigned lanes)
{
    EACH_BIT(lane, lanes)
        CYLINT_PREFETCH(
            cylint_embree_record_at(&data->shapes[0], leaf->number[lane]));
}

/* Removes the nearest lane from *lanes and sets the question about it.  Returns 0
 * if no lane can hold the nearest hit. */
CYLINT_INLINE int take_nearest_lane(ray_test *r, const cylint_leaf *leaf,
                                    unsigned *lanes, const float *least)
{
    const int lane = cylint_nearest_lane(*lanes, least);
    if (least[lane] > r->ray->tfar)
        return 0;
    *lanes &= ~(1u << lane);
    r->rank = leaf->number[lane];
    CYLINT_PREFETCH(r->data->number + r->rank);
    r->q.near = least[lane] > r->ray->tnear ? least[lane] : r->ray->tnear;
    set_question(r, cylint_leaf_ends(leaf, lane),
                 cylint_leaf_slice(leaf, lane));
    return 1;
}

/* --------------------------------------------------------------- one ray -- */

/* Tests lanes (bits) of a leaf, nearest first, until no remaining lane can hold
 * the nearest hit. */
static int test_leaf(void *self, const cylint_leaf *leaf, unsigned lanes,
                     const float least[CYLINT_LEAF_SIZE])
{
    ray_test *r = self;
    if (lanes & (lanes - 1))
        prefetch_records(r->data, leaf, lanes);
    while (lanes && take_nearest_lane(r, leaf, &lanes, least)) {
        filter_one(r);
        end_test(r);
        if (r->found && r->any)
            return 1;
    }
    return 0;
}

static void test_shape(ray_test *r, unsigned rank)
{
    const cylint_embree_shapes *s = r->data->shapes;
    double along = 0, dd = 0;
    r->rank = rank;
    set_question(r, s->tag[r->rank] / CYLINT_TAG_ENDS, (cylint_slice){0, 1});
    if (r->data->options.moved)
        cylint_embree_moving_record(s, r->rank, r->ray->time, &r->q.record);
    EACH(j, 3) {
        along += (r->q.record.p0[j] - r->q.line.o[j]) * r->q.line.d[j];
        dd += r->q.line.d[j] * r->q.line.d[j];
    }
    r->q.near = (double)(float)(along / dd);
    filter_one(r);
    end_test(r);
}

/* Tests the shapes beside the hierarchy, or the shape that is the primitive.
 * Returns whether the ray needs no other test. */
CYLINT_INLINE int test_others(ray_test *r)
{
    const cylint_embree_data *data = r->data;
    const int is_one = !data->traversal;
    size_t rank = is_one ? r->args->primID : data->n_in_leaves;
    for (const size_t end = is_one ? rank + 1 : data->n; rank < end; rank++) {
        test_shape(r, (unsigned)rank);
        if (r->found && r->any)
            return 1;
    }
    return is_one;
}

CYLINT_INLINE void trace_single(ray_test *r)
{
    if (r->data->traversal->line(&r->data->bvh, &r->q.line, test_leaf, r,
                                 r->any &&
                                     has_flag(r, CYLINT_EMBREE_NO_FILTERS)))
        cylint_record_any(r);
}

/* --------------------------------------------------------------- packets -- */

/* Rays are copied out of the packet, traced together if they begin near each
 * other and go into the same octant, else one by one, and copied back if they
 * are hit. */

/* Embree 4 expects in valid[] whether the ray was hit. */
static inline void set_valid(int *valid, unsigned i, int hit)
{
    if (CYLINT_EMBREE == 4)
        valid[i] = hit ? -1 : 0;
}

/* The members of a ray and of a hit, 4 bytes each.  A packet of N rays stores
 * each member N times, those of hits behind those of rays. */
enum {
    RAY_WORDS = sizeof(struct RTCRay) / 4,
    HIT_WORDS = (offsetof(struct RTCHit, instID) + CYLINT_INSTANCE_BYTES) / 4
};

/* Copies words that are step_from and step_to words apart. */
static void copy_words(void *to, unsigned step_to, const void *from,
                       unsigned step_from, unsigned words)
{
    for (unsigned k = 0; k < words; k++)
        memcpy((char *)to + 4 * k * step_to,
               (const char *)from + 4 * k * step_from, 4);
}

/* Tests the lanes of all rays in turns, the nearest lane of each ray first. */
unsigned cylint_packet_test(ray_test packet[], const cylint_leaf *leaf,
                            unsigned rays)
{
    const ray_test *first = &packet[cylint_lowest(rays)];
    unsigned stopped = 0;
    EACH_BIT(k, rays)
        prefetch_records(first->data, leaf, packet[k].lanes);
    while (rays) {
        cylint_float_filter_question *question[CYLINT_PACKET_MOST];
        int n = 0;
        EACH_BIT(k, rays) {
            ray_test *const r = &packet[k];
            const int stops = r->any && r->found;
            stopped |= (unsigned)stops << k;
            if (!stops && r->lanes &&
                take_nearest_lane(r, leaf, &r->lanes, r->least))
                question[n++] = &r->q;
            else
                rays &= ~(1u << k);
        }
        first->filter[n > 1](question, n);
        for (int i = 0; i < n; i++)
            end_test((ray_test *)question[i]);
    }
    return stopped;
}

/* Of the rays those that go into the octant of the first one and begin near it,
 * within 1/8 of the longest side S of the hierarchy's box, if they are enough, or
 * else none: fewer often share an octant by chance. */
static unsigned near_first(const ray_test packet[], unsigned rays, unsigned N)
{
    unsigned near = 0, n = 0;
    if (!rays)
        return 0;
    const ray_test *first = &packet[cylint_lowest(rays)];
    const double S = first->data->bvh.longest;
    EACH_BIT(k, rays) {
        const ray_test *r = &packet[k];
        double far = 0;
        int is = 1;
        EACH(j, 3) {
            far += fabs(r->q.line.o[j] - first->q.line.o[j]);
            is &= !signbit(r->q.line.d[j]) == !signbit(first->q.line.d[j]);
        }
        is &= far < S / 8;
        near |= (unsigned)is << k;
        n += (unsigned)is;
    }
    return n > N / 4 + 1 ? near : 0;
}

/* An occlusion query has no hits. */
static void trace_packet(const call *a, int any)
{
    const cylint_embree_data *data = a->geometryUserPtr;
    const int certain = any && data->options.flags & CYLINT_EMBREE_NO_FILTERS;
    const unsigned n = any ? RAY_WORDS : RAY_WORDS + HIT_WORDS;
    float *const words = (float *)a->rayhit;
    unsigned all = 0, open = 0, together;
    ray_test packet[CYLINT_PACKET_MOST];
    for (unsigned i = 0; i < a->N; i++) {
        struct RTCRayHit *one = &packet[i].copy;
        if (!a->valid[i])
            continue;
        one->hit = (struct RTCHit){0};
        copy_words(one, 1, words + i, a->N, n);
        set_valid(a->valid, i, 0);
        if (!start_test(&packet[i], a, any, &one->ray, &one->hit))
            continue;
        all |= 1u << i;
        if (!test_others(&packet[i]))
            open |= 1u << i;
    }
    for (; (together = near_first(packet, open, a->N)); open &= ~together)
        data->trace_packet(packet, together, certain);
    EACH_BIT(i, open)
        trace_single(&packet[i]);
    EACH_BIT(i, all)
        if (packet[i].found) {
            copy_words(words + i, a->N, &packet[i].copy, 1, n);
            set_valid(a->valid, (unsigned)i, 1);
        }
}

/* ---------------------------------------------- callbacks, completion -- */

CYLINT_INLINE void trace(const call *a, int any)
{
    struct RTCRayHit *one = (void *)a->rayhit; /* or the ray alone */
    struct RTCHit none = {0};
    ray_test r;
    if (a->N > 1) {
        trace_packet(a, any);
        return;
    }
    const int is_line =
        start_test(&r, a, any, &one->ray, any ? &none : &one->hit);
    if (is_line && !test_others(&r))
        trace_single(&r);
    set_valid(a->valid, 0, r.found);
}

void cylint_embree_intersect_callback(
    const struct RTCIntersectFunctionNArguments *args)
{
    trace(args, 0);
}

void cylint_embree_occluded_callback(
    const struct RTCOccludedFunctionNArguments *args)
{
    trace((const call *)args, 1);
}

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
    const int i = find_present(&r, number, &x);
    if (i >= 0) {
        describe(&r, &x, i);
        memcpy(&rayhit->hit, r.q.floats, sizeof r.q.floats);
    }
}
