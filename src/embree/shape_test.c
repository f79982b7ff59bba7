/*
 * shape_test.c - a ray at one shape: is it hit, does that come first, who wants it
 */
#include "shape_test.h"

#include <string.h>

#include "../bvh/float_bounds.h"
#include "angle.h"

/* The library's answer; none for a line that it refuses. */
static int ask(const cylint_shape *shape, const cylint_float_filter_ray *l,
               unsigned want, cylint_answer *answer)
{
    cylint_line line;
    if (cylint_span(&line, l->o, l->d, l->tmin, l->tmax) != CYLINT_OK)
        return 0;
    return cylint_intersect(shape, &line, want, answer);
}

/* Behind a hit at t, of which tfar is what is left, lie other roots that are
 * t when rounded to doubles: they count as equal. */
static double tmax_after_hit(float tfar)
{
    return nextafter((double)tfar, HUGE_VAL);
}

/* The shape as the ray finds it; between: room for one that moves. */
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

/* What tfar becomes by a hit at t <= tfar. */
static float rounded_up(double t, float tfar)
{
    const float f = cylint_float_above(t);
    return f < tfar ? f : tfar;
}

/* ------------------------------------------------------ which is first -- */

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

/* The t of the ray's present hit, which tfar shows rounded up.  Where both
 * hits of its shape round to that, u tells them apart; bare hits have none:
 * then it is the first, which without filters is the one that matters, for
 * it is or will be the ray's. */
static double present_t(const query *q)
{
    double t = HUGE_VAL; /* the caller's or a filter's, not ours */
    cylint_shape between;
    cylint_answer answer;
    const cylint_shape *shape =
        shape_at(q->data, q->hit->primID, q->ray->time, &between);
    const int n = ask(shape, &q->line, CYLINT_WANT_T | CYLINT_WANT_Z, &answer);
    for (int i = n - 1; i >= 0; i--)
        if (rounded_up(answer.hit[i].t, q->ray->tfar) == q->ray->tfar &&
            (t >= HUGE_VAL || is_bare(q) ||
             (float)answer.hit[i].z == q->hit->u))
            t = answer.hit[i].t;
    return t;
}

/* Whether the ray's present hit is this geometry's. */
static int hit_is_ours(const query *q)
{
    return q->hit->geomID == q->geomID && q->hit->primID < q->data->n &&
           same_instance(q->hit, q->context);
}

/* Whether hit i of a shape comes before the present one.  tfar is the present
 * t rounded up, so a t that gives a lesser float is less, and only the same
 * float needs the present t again.  Each hit is tried once: a present one of
 * the same shape is its other hit. */
static int comes_first(const query *q, unsigned number,
                       const cylint_answer *answer, int i)
{
    const double t = answer->hit[i].t;
    if (t > (double)q->ray->tfar)
        return 0;
    if (rounded_up(t, q->ray->tfar) < q->ray->tfar || !hit_is_ours(q))
        return 1;
    if (number == q->hit->primID)
        return i == 0;
    const double present = present_t(q);
    return t < present || (t == present && number < q->hit->primID);
}

/* ------------------------------------------------------------ one shape -- */

static cylint_hit_floats floats_of(const cylint_hit *at)
{
    return (cylint_hit_floats){
        (float)at->z,
        cylint_angle_as_float(at->phi),
        {(float)at->normal[0], (float)at->normal[1], (float)at->normal[2]}};
}

static void describe(const cylint_hit_floats *floats, struct RTCHit *hit)
{
    hit->Ng_x = floats->normal[0];
    hit->Ng_y = floats->normal[1];
    hit->Ng_z = floats->normal[2];
    hit->u = floats->z;
    hit->v = floats->phi;
}

static void identify(const query *q, unsigned number, struct RTCHit *hit)
{
    hit->primID = number;
    hit->geomID = q->geomID;
    for (int i = 0; i < RTC_MAX_INSTANCE_LEVEL_COUNT; i++) {
        hit->instID[i] = q->context->instID[i];
#if CYLINT_INSTANCE_ARRAYS
        hit->instPrimID[i] = q->context->instPrimID[i];
#endif
    }
}

#if CYLINT_EMBREE == 4
struct filtering_context {
    cylint_rtc_context context;
    RTCFilterFunctionN filter;
};
#endif

static int passes_filters(const query *q, struct RTCHit *hit)
{
    int valid = -1;
    struct RTCFilterFunctionNArguments filter = {&valid,
                                                 q->data->user,
                                                 q->context,
                                                 (struct RTCRayN *)q->ray,
                                                 (struct RTCHitN *)hit,
                                                 1};
    if (q->nearest)
        cylint_rtc_filter_hit(q->nearest, &filter);
    else
        cylint_rtc_filter_occluded(q->any, &filter);
#if CYLINT_EMBREE == 4
    if (valid && q->data->how & CYLINT_EMBREE_CONTEXT_FILTER) {
        const RTCFilterFunctionN also =
            ((struct filtering_context *)q->context)->filter;
        if (also)
            also(&filter);
    }
#endif
    return valid != 0;
}

/* Offers a hit at t to the filters; takes it if they let it pass.  The hit is
 * written where it will stay, so that nothing waits for it to be read. */
static int take(query *q, unsigned number, float t,
                const cylint_hit_floats *floats)
{
    const float tfar = q->ray->tfar;
    struct RTCHit spare = {0}, *hit = q->nearest ? q->hit : &spare;
    const struct RTCHit old = *hit;
    if (is_seen(q))
        describe(floats, hit);
    identify(q, number, hit);
    q->ray->tfar = t;
    if (has_filters(q) && !passes_filters(q, hit)) {
        q->ray->tfar = tfar;
        *hit = old;
        return 0;
    }
    if (q->nearest)
        q->line.tmax = q->ray->tfar;
    else
        q->ray->tfar = -HUGE_VALF;
    return 1;
}

/* ---- in every digit */

static unsigned wanted(const query *q)
{
    return !is_seen(q) ? CYLINT_WANT_T | CYLINT_WANT_Z
                       : CYLINT_WANT_T | CYLINT_WANT_NORMAL | CYLINT_WANT_Z |
                             CYLINT_WANT_PHI;
}

/* The hits from number `first` on. */
static int try_exactly(query *q, const cylint_shape *shape, unsigned number,
                       int first)
{
    cylint_answer answer;
    if (q->nearest && hit_is_ours(q))
        q->line.tmax = tmax_after_hit(q->ray->tfar);
    const int n = ask(shape, &q->line, wanted(q), &answer);
    for (int i = first; i < n; i++) {
        const cylint_hit *at = &answer.hit[i];
        if (q->block && !cylint_leaf_owns(q->block, q->lane, at->z))
            continue;
        if (q->nearest && !comes_first(q, number, &answer, i))
            return 0;
        const cylint_hit_floats floats = floats_of(at);
        if (take(q, number, rounded_up(at->t, q->ray->tfar), &floats))
            return 1;
    }
    return 0;
}

/* ---- in doubles */

/* Where doubles say that a hit is. */
typedef struct {
    double t, t_error, z, z_error;
} place;

/* Whether the hit is this lane's; 2 where that is uncertain. */
static int owned(const query *q, const place *hit)
{
    if (!q->block)
        return 1;
    const cylint_piece piece = cylint_leaf_piece(q->block, q->lane);
    if (piece.count == 1)
        return 1;
    const int lowest = cylint_piece_at(hit->z - hit->z_error, piece.count);
    const int highest = cylint_piece_at(hit->z + hit->z_error, piece.count);
    return lowest < highest ? 2 : lowest == piece.index;
}

typedef enum {
    UNCERTAIN = -1,
    ANOTHERS, /* lane's, or not taken */
    TAKEN,    /* or to be taken */
    BEHIND    /* tfar, as will be all other hits of the shape */
} turnout;

/* Whether the hit may be taken, at *t. */
static turnout judge(const query *q, const place *hit, float *t)
{
    const int own = owned(q, hit);
    *t = cylint_float_above(hit->t);
    const int certain = cylint_is_float_above(*t, hit->t, hit->t_error);
    if (certain && *t > q->ray->tfar)
        return BEHIND;
    if (own == 0)
        return ANOTHERS;
    return own == 2 || !certain || *t == q->ray->tfar ? UNCERTAIN : TAKEN;
}

static turnout try_hit(query *q, unsigned number,
                       const cylint_float_filter_state *quick,
                       const cylint_float_filter_hit *hit)
{
    cylint_hit_floats floats;
    const place at = {hit->t, hit->t_error, hit->z, hit->z_error};
    float t;
    const turnout is = judge(q, &at, &t);
    if (is != TAKEN)
        return is;
    if (is_seen(q) && !q->data->quick->describe(quick, hit, &floats))
        return UNCERTAIN;
    return take(q, number, t, &floats) ? TAKEN : ANOTHERS;
}

cylint_float_filter_target cylint_ray_test_target(
    const query *q, unsigned rank, cylint_shape *between,
    cylint_float_filter_shape *room)
{
    const unsigned number = number_of(q, rank);
    if (q->block)
        return (cylint_float_filter_target){
            cylint_float_filter_at(&q->data->asked, rank), q->data->asked.small,
            q->data->shapes + number, cylint_leaf_ends(q->block, q->lane)};
    const cylint_shape *whole =
        shape_at(q->data, number, q->ray->time, between);
    cylint_float_filter_shape_of(room, whole);
    return (cylint_float_filter_target){room, 0, whole, whole->ends};
}

int cylint_ray_test_shape(query *q, unsigned rank, int left)
{
    const unsigned number = number_of(q, rank);
    cylint_shape between;
    cylint_float_filter_state quick;
    cylint_float_filter_hit hit;
    cylint_float_filter_shape room;
    const cylint_float_filter_target subject =
        cylint_ray_test_target(q, rank, &between, &room);
    cylint_float_filter_result is =
        q->data->quick->enter(&quick, &subject, &q->line, &hit);
    for (int i = 0, before = 0; i < 2; i++) {
        if (i == 1)
            is = q->data->quick->leave(&quick, &hit);
        if (is == CYLINT_FLOAT_FILTER_MISS)
            continue;
        const turnout hits = is != CYLINT_FLOAT_FILTER_HIT ? UNCERTAIN
                             : i < left                    ? ANOTHERS
                                        : try_hit(q, number, &quick, &hit);
        if (hits == UNCERTAIN)
            return try_exactly(q, subject.whole, number, before);
        if (hits != ANOTHERS)
            return hits == TAKEN;
        before++;
    }
    return 0;
}

int cylint_ray_test_accept(query *q, const cylint_packet_filter_results *a,
                           int i)
{
    const unsigned rank = q->block->number[q->lane], bit = 1u << i;
    if (a->unsure & bit)
        return cylint_ray_test_shape(q, rank, 0);
    if (!(a->hit & bit))
        return a->crosses & bit ? cylint_ray_test_shape(q, rank, 1) : 0;
    const place at = {a->t[i], a->t_error[i], a->z[i], a->z_error[i]};
    float t;
    const turnout is = judge(q, &at, &t);
    if (is == BEHIND)
        return 0;
    if (is == UNCERTAIN || (is == TAKEN && is_seen(q) && !(a->described & bit)))
        return cylint_ray_test_shape(q, rank, 0);
    const cylint_hit_floats floats = {(float)a->float_z[i],
                                      (float)a->phi[i],
                                      {(float)a->normal[0][i],
                                       (float)a->normal[1][i],
                                       (float)a->normal[2][i]}};
    return (is == TAKEN && take(q, number_of(q, rank), t, &floats)) ||
           cylint_ray_test_shape(q, rank, 1);
}

void cylint_embree_complete(struct RTCGeometryTy *geometry,
                            struct RTCRayHit *rayhit)
{
    const cylint_embree_data *data = rtcGetGeometryUserData(geometry);
    const struct RTCRay *ray = &rayhit->ray;
    cylint_float_filter_ray line = line_of(ray);
    cylint_shape between;
    cylint_answer answer;
    if (!(rayhit->hit.primID < data->n))
        return;
    line.tmax = tmax_after_hit(ray->tfar);
    const int n = ask(shape_at(data, rayhit->hit.primID, ray->time, &between),
                      &line, CYLINT_WANT_ALL, &answer);
    for (int i = 0; i < n; i++)
        if (rounded_up(answer.hit[i].t, ray->tfar) == ray->tfar) {
            const cylint_hit_floats floats = floats_of(&answer.hit[i]);
            describe(&floats, &rayhit->hit);
            return;
        }
}
