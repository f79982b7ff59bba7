/*
 * trace.c - Embree's callbacks: rays to candidates to hits
 *
 * Rays of packets are copied out, asked, and copied back where they hit.  All
 * blocks are one primitive, through which walk.h leads, and packet.h several
 * rays together.
 * Whether and where a shape is hit is cylint_intersect()'s word, which quick.c
 * anticipates where it is certain of it; everything else only chooses which
 * shapes to ask.
 */
#include <stddef.h>
#include <string.h>

#include "../each.h"
#include "../scene/packet.h"
#include "../scene/bounds.h"
#include "internal.h"
#include "../scene/turn.h"

/* One ray at one primitive; line and lane are set when they are needed. */
typedef struct query {
    const cylint_embree_data *data;
    const struct RTCIntersectFunctionNArguments *nearest; /* one of them ... */
    const struct RTCOccludedFunctionNArguments *any;      /* ... is NULL */
    cylint_rtc_context *context;
    unsigned geomID;
    struct RTCRay *ray;
    struct RTCHit *hit; /* of nearest */
    cylint_quick_line line; /* the ray */
    const cylint_block *block; /* NULL: one shape a primitive */
    int lane;
    int met;                   /* something was, and was taken */
} query;

static cylint_quick_line line_of(const struct RTCRay *ray)
{
    return (cylint_quick_line){{ray->org_x, ray->org_y, ray->org_z},
                               {ray->dir_x, ray->dir_y, ray->dir_z},
                               ray->tnear, HUGE_VAL, ray->tfar};
}

/* The library's answer; none for a line that it refuses. */
static int ask(const cylint_shape *shape, const cylint_quick_line *l,
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
    const cylint_shape *shape = shape_at(q->data, q->hit->primID,
                                         q->ray->time, &between);
    const int n = ask(shape, &q->line, CYLINT_WANT_T | CYLINT_WANT_Z, &answer);
    for (int i = n - 1; i >= 0; i--)
        if (rounded_up(answer.hit[i].t, q->ray->tfar) == q->ray->tfar &&
            (t >= HUGE_VAL || q->data->how & CYLINT_EMBREE_BARE ||
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

static cylint_quick_floats floats_of(const cylint_hit *at)
{
    return (cylint_quick_floats){
        (float)at->z, cylint_turn(at->phi),
        {(float)at->normal[0], (float)at->normal[1], (float)at->normal[2]}};
}

static void describe(const cylint_quick_floats *floats, struct RTCHit *hit)
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
    struct RTCFilterFunctionNArguments filter = {
        &valid, q->data->user, q->context, (struct RTCRayN *)q->ray,
        (struct RTCHitN *)hit, 1};
    if (q->nearest)
        cylint_rtc_filter_hit(q->nearest, &filter);
    else
        cylint_rtc_filter_shadow(q->any, &filter);
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

static int is_bare(const query *q)
{
    return (q->data->how & CYLINT_EMBREE_BARE) != 0;
}

static int has_filters(const query *q)
{
    return !(q->data->how & CYLINT_EMBREE_NO_FILTERS);
}

/* Whether anyone will see u, v and Ng. */
static int is_seen(const query *q)
{
    return !is_bare(q) && (q->nearest || has_filters(q));
}

/* Offers a hit at t to the filters; takes it if they let it pass.  The hit is
 * written where it will stay, so that nothing waits for it to be read. */
static int take(query *q, unsigned number, float t,
                const cylint_quick_floats *floats)
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
    return !is_seen(q) ? CYLINT_WANT_T | CYLINT_WANT_Z :
           CYLINT_WANT_T | CYLINT_WANT_NORMAL | CYLINT_WANT_Z |
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
        if (q->block && !cylint_block_owns(q->block, q->lane, at->z))
            continue;
        if (q->nearest && !comes_first(q, number, &answer, i))
            return 0;
        const cylint_quick_floats floats = floats_of(at);
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
    const cylint_piece piece = cylint_block_piece(q->block, q->lane);
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

static turnout try_hit(query *q, unsigned number, const cylint_quick *quick,
                       const cylint_quick_hit *hit)
{
    cylint_quick_floats floats;
    const place at = {hit->t, hit->t_error, hit->z, hit->z_error};
    float t;
    const turnout is = judge(q, &at, &t);
    if (is != TAKEN)
        return is;
    if (is_seen(q) && !q->data->quick->describe(quick, hit, &floats))
        return UNCERTAIN;
    return take(q, number, t, &floats) ? TAKEN : ANOTHERS;
}

/* The shape's number.  rank: what a block has of it, or the primitive. */
static unsigned number_of(const query *q, unsigned rank)
{
    return q->block ? q->data->number[rank] : rank;
}

/* The shape as the ray finds it, in `room` if need be. */
static cylint_quick_subject subject_of(const query *q, unsigned rank,
                                       cylint_shape *between,
                                       cylint_quick_shape *room)
{
    const unsigned number = number_of(q, rank);
    if (q->block)
        return (cylint_quick_subject){
            cylint_quick_at(&q->data->asked, rank), q->data->asked.small,
            q->data->shapes + number, cylint_block_ends(q->block, q->lane)};
    const cylint_shape *whole = shape_at(q->data, number, q->ray->time,
                                         between);
    cylint_quick_shape_of(room, whole);
    return (cylint_quick_subject){room, 0, whole, whole->ends};
}

/* 1 if the ray hits the shape and takes the hit.  Not where it enters the shape
 * if `left`: then it has been asked about that. */
static int try_shape(query *q, unsigned rank, int left)
{
    const unsigned number = number_of(q, rank);
    cylint_shape between;
    cylint_quick quick;
    cylint_quick_hit hit;
    cylint_quick_shape room;
    const cylint_quick_subject subject = subject_of(q, rank, &between, &room);
    cylint_quick_verdict is = q->data->quick->enter(&quick, &subject, &q->line,
                                                      &hit);
    for (int i = 0, before = 0; i < 2; i++) {
        if (i == 1)
            is = q->data->quick->leave(&quick, &hit);
        if (is == CYLINT_QUICK_MISS)
            continue;
        const turnout hits = is != CYLINT_QUICK_HIT ? UNCERTAIN
                           : i < left ? ANOTHERS
                           : try_hit(q, number, &quick, &hit);
        if (hits == UNCERTAIN)
            return try_exactly(q, subject.whole, number, before);
        if (hits != ANOTHERS)
            return hits == TAKEN;
        before++;
    }
    return 0;
}

/* In line: GCC takes a function that does no more for one without effect, and
 * leaves its calls out. */
CYLINT_INLINE void fetch_shapes(const cylint_embree_data *data,
                                const cylint_block *block, unsigned lanes)
{
#ifdef __GNUC__
    for (; lanes; lanes &= lanes - 1)
        __builtin_prefetch(cylint_quick_at(
            &data->asked, block->number[cylint_lowest(lanes)]));
#else
    (void)data;
    (void)block;
    (void)lanes;
#endif
}

static int nearest_lane(unsigned lanes, const float *least)
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
CYLINT_INLINE int turn_to_nearest(query *q, const cylint_block *block,
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

/* The lanes the ray may meet, nearest first, until none can come first. */
static int try_lanes(void *self, const cylint_block *block, unsigned lanes,
                     const float least[CYLINT_BLOCK])
{
    query *q = self;
    fetch_shapes(q->data, block, lanes);
    while (lanes && turn_to_nearest(q, block, &lanes, least)) {
        q->met |= try_shape(q, block->number[q->lane], 0);
        if (q->met && q->any)
            return 1;
    }
    return 0;
}

/* The pointers; clearing all of a query takes longer than a block does. */
static void begin(query *q, const cylint_embree_data *data,
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

/* --------------------------------------------------------------- packets -- */

/* Words of a ray and of a hit, of which packets of N store N each, those of
 * hits, where there are any, behind those of rays. */
enum {
    RAY_WORDS = sizeof(struct RTCRay) / 4,
    HIT_WORDS = 7 + RTC_MAX_INSTANCE_LEVEL_COUNT * (1 + CYLINT_INSTANCE_ARRAYS)
};

static void gather(void *one, const void *packet, unsigned words, unsigned N,
                   unsigned i)
{
    for (unsigned k = 0; k < words; k++)
        memcpy((char *)one + 4 * k, (const char *)packet + 4 * (k * N + i), 4);
}

static void scatter(void *packet, const void *one, unsigned words, unsigned N,
                    unsigned i)
{
    for (unsigned k = 0; k < words; k++)
        memcpy((char *)packet + 4 * (k * N + i), (const char *)one + 4 * k, 4);
}

static void *hits_of(const void *packet, unsigned N)
{
    return (char *)packet + 4 * RAY_WORDS * N;
}

/* What Embree 4 wants to know. */
static void tell(int *valid, unsigned i, int hit)
{
#if CYLINT_EMBREE == 4
    valid[i] = hit ? -1 : 0;
#else
    (void)valid;
    (void)i;
    (void)hit;
#endif
}

/* Whether cylint_span() will take it.  What it refuses no box refuses. */
static int is_line(const struct RTCRay *r)
{
    const float none = 0 * r->org_x + 0 * r->org_y + 0 * r->org_z +
                       0 * r->dir_x + 0 * r->dir_y + 0 * r->dir_z;
    const float any = fabsf(r->dir_x) + fabsf(r->dir_y) + fabsf(r->dir_z);
    return none >= 0 && any > 0 && r->tnear <= r->tfar;
}

/* A ray's floats lie where walk.h has them. */
#define SAME(ours, theirs) \
    (offsetof(cylint_float_ray, ours) == offsetof(struct RTCRay, theirs))
typedef char rays_are_alike[
    SAME(o[0], org_x) && SAME(o[1], org_y) && SAME(o[2], org_z) &&
    SAME(tnear, tnear) && SAME(d[0], dir_x) && SAME(d[1], dir_y) &&
    SAME(d[2], dir_z) && SAME(tfar, tfar) ? 1 : -1];
#undef SAME

static const cylint_float_ray *floats_of_ray(const struct RTCRay *ray)
{
    return (const cylint_float_ray *)ray;
}

static int trace_one(query *q, unsigned primID)
{
    if (!is_line(q->ray))
        return 0;
    q->line = line_of(q->ray);
    if (!q->data->walk)
        return try_shape(q, primID, 0);
    q->met = 0;
    const cylint_float_ray *ray = floats_of_ray(q->ray);
    if (q->any && !has_filters(q)) {
        if (q->data->walk->shadow(&q->data->group, ray, try_lanes, q)) {
            q->ray->tfar = -HUGE_VALF;
            return 1;
        }
    } else {
        q->data->walk->ray(&q->data->group, ray, try_lanes, q);
    }
    return q->met;
}

/* Ray i of the packet, alone. */
static int trace_of_packet(query *q, unsigned primID, void *packet,
                           unsigned N, unsigned i)
{
    struct RTCRay ray;
    struct RTCHit hit;
    gather(&ray, packet, RAY_WORDS, N, i);
    if (q->nearest)
        gather(&hit, hits_of(packet, N), HIT_WORDS, N, i);
    q->ray = &ray;
    if (q->nearest)
        q->hit = &hit;
    if (!trace_one(q, primID))
        return 0;
    scatter(packet, &ray, RAY_WORDS, N, i);
    if (q->nearest)
        scatter(hits_of(packet, N), &hit, HIT_WORDS, N, i);
    return 1;
}

/* -------------------------------------------------------------- together -- */

/* The rays of a packet that are asked together. */
typedef struct {
    query query[CYLINT_PACKET];
    struct RTCRay ray[CYLINT_PACKET];
    struct RTCHit hit[CYLINT_PACKET];
    const cylint_float_ray *floats[CYLINT_PACKET]; /* of the rays */
    unsigned at[CYLINT_PACKET];                    /* in the packet */
    int n;
} bundle;

/* Questions of several rays, one of each. */
typedef struct {
    cylint_quick_subject subject[CYLINT_PACKET];
    const cylint_quick_line *line[CYLINT_PACKET];
    query *asks[CYLINT_PACKET];
    int n;
} inquiry;

static void add(inquiry *r, query *q)
{
    r->subject[r->n] = subject_of(q, q->block->number[q->lane], NULL, NULL);
    r->line[r->n] = &q->line;
    r->asks[r->n++] = q;
}

/* Question i was answered.  1 if its ray takes the hit. */
static int heed(const cylint_quick_answers *a, int i, query *q)
{
    const unsigned rank = q->block->number[q->lane], bit = 1u << i;
    if (a->unsure & bit)
        return try_shape(q, rank, 0);
    if (!(a->hit & bit))
        return a->crosses & bit ? try_shape(q, rank, 1) : 0;
    const place at = {a->t[i], a->t_error[i], a->z[i], a->z_error[i]};
    float t;
    const turnout is = judge(q, &at, &t);
    if (is == BEHIND)
        return 0;
    if (is == UNCERTAIN ||
        (is == TAKEN && is_seen(q) && !(a->described & bit)))
        return try_shape(q, rank, 0);
    const cylint_quick_floats floats = {
        (float)a->float_z[i], (float)a->phi[i],
        {(float)a->normal[0][i], (float)a->normal[1][i],
         (float)a->normal[2][i]}};
    return (is == TAKEN && take(q, number_of(q, rank), t, &floats)) ||
           try_shape(q, rank, 1);
}

static void ask_all_at_once(const inquiry *r)
{
    cylint_quick_answers answers;
    const query *first = r->asks[0];
    if (r->n == 1) {
        query *q = r->asks[0];
        q->met |= try_shape(q, q->block->number[q->lane], 0);
        return;
    }
    first->data->many(r->subject, r->line, r->n, is_seen(first), &answers);
    for (int i = 0; i < r->n; i++)
        r->asks[i]->met |= heed(&answers, i, r->asks[i]);
}

/* As try_lanes(), for rays side by side: the nearest lanes first of all. */
static unsigned try_met(void *self, const cylint_met *met)
{
    bundle *b = self;
    unsigned rays = met->rays, enough = 0, left[CYLINT_PACKET];
    for (unsigned of = rays; of; of &= of - 1) {
        const int k = cylint_lowest(of);
        left[k] = met->lanes[k];
        fetch_shapes(b->query[0].data, met->block, left[k]);
    }
    while (rays) {
        inquiry r;
        r.n = 0;
        for (unsigned of = rays; of; of &= of - 1) {
            const int k = cylint_lowest(of);
            if (left[k] && turn_to_nearest(&b->query[k], met->block, &left[k],
                                           met->least[k]))
                add(&r, &b->query[k]);
            else
                rays &= ~(1u << k);
        }
        if (r.n > 0)
            ask_all_at_once(&r);
        if (b->query[0].any)
            for (unsigned of = rays; of; of &= of - 1) {
                const int k = cylint_lowest(of);
                enough |= (unsigned)(b->query[k].met != 0) << k;
            }
        rays &= ~enough;
    }
    return enough;
}

/* Ray i of the packet, if it is a line. */
static void join(bundle *b, const query *q, const void *packet, unsigned N,
                 unsigned i)
{
    struct RTCRay *ray = &b->ray[b->n];
    query *each = &b->query[b->n];
    gather(ray, packet, RAY_WORDS, N, i);
    if (!is_line(ray))
        return;
    begin(each, q->data, q->context, q->geomID);
    each->nearest = q->nearest;
    each->any = q->any;
    each->ray = ray;
    each->line = line_of(ray);
    each->met = 0;
    if (q->nearest) {
        each->hit = &b->hit[b->n];
        gather(each->hit, hits_of(packet, N), HIT_WORDS, N, i);
    }
    b->floats[b->n] = floats_of_ray(ray);
    b->at[b->n++] = i;
}

/* The k-th of them goes back. */
static void part(const bundle *b, int k, void *packet, unsigned N)
{
    scatter(packet, &b->ray[k], RAY_WORDS, N, b->at[k]);
    if (b->query[k].nearest)
        scatter(hits_of(packet, N), &b->hit[k], HIT_WORDS, N, b->at[k]);
}

static void trace_together(const query *q, unsigned rays, int *valid,
                           void *packet, unsigned N)
{
    bundle b;
    unsigned certain = 0;
    b.n = 0;
    for (; rays; rays &= rays - 1) {
        const unsigned i = (unsigned)cylint_lowest(rays);
        join(&b, q, packet, N, i);
        tell(valid, i, 0);
    }
    if (b.n > 0)
        certain = cylint_packet_used()(&q->data->group, b.floats, b.n,
                                       q->any && !has_filters(q), try_met, &b);
    for (int k = 0; k < b.n; k++) {
        if (certain >> k & 1)
            b.ray[k].tfar = -HUGE_VALF;
        else if (!b.query[k].met)
            continue;
        part(&b, k, packet, N);
        tell(valid, b.at[k], 1);
    }
}

/* The rays of a packet, as bits, by the octant they go into. */
static void sort_by_octant(unsigned octant[8], unsigned rays,
                           const float *packet, unsigned N)
{
    const float *d = packet + offsetof(struct RTCRay, dir_x) / 4 * N;
    memset(octant, 0, 8 * sizeof *octant);
    for (; rays; rays &= rays - 1) {
        const unsigned i = (unsigned)cylint_lowest(rays);
        octant[(d[i] < 0) | (d[N + i] < 0) << 1 | (d[2 * N + i] < 0) << 2] |=
            1u << i;
    }
}

static unsigned how_many(unsigned rays)
{
    unsigned n = 0;
    for (; rays; rays &= rays - 1)
        n++;
    return n;
}

/* Fewer are often in one octant though all go anyhow. */
static int are_enough(unsigned rays, unsigned N)
{
    return how_many(rays) > N / 4 + 1;
}

/* Those that begin within an eighth of the shapes' box of the first one. */
static unsigned neighbours(unsigned rays, const cylint_group *group,
                           const float *packet, unsigned N)
{
    const float S = group->near_by / 256; /* its longest side */
    const float *o = packet + cylint_lowest(rays);
    unsigned near = 0;
    for (; rays; rays &= rays - 1) {
        const int i = cylint_lowest(rays);
        const float far = fabsf(packet[i] - o[0]) +
                          fabsf(packet[N + (unsigned)i] - o[N]) +
                          fabsf(packet[2 * N + (unsigned)i] - o[2 * N]);
        near |= (unsigned)(far < S / 8) << i;
    }
    return near;
}

static void trace_alone(query *q, unsigned primID, unsigned rays, int *valid,
                        void *packet, unsigned N)
{
    for (; rays; rays &= rays - 1) {
        const unsigned i = (unsigned)cylint_lowest(rays);
        tell(valid, i, trace_of_packet(q, primID, packet, N, i));
    }
}

/* Rays that go into one octant. */
static void trace_octant(query *q, unsigned primID, unsigned rays, int *valid,
                         void *packet, unsigned N)
{
    unsigned together = 0;
    if (are_enough(rays, N))
        together = neighbours(rays, &q->data->group, packet, N);
    if (!are_enough(together, N))
        together = 0;
    if (together)
        trace_together(q, together, valid, packet, N);
    trace_alone(q, primID, rays & ~together, valid, packet, N);
}

static void trace_packet(query *q, unsigned primID, int *valid, void *packet,
                         unsigned N)
{
    unsigned rays = 0, octant[8];
    for (unsigned i = 0; i < N; i++)
        rays |= (unsigned)(valid[i] != 0) << i;
    if (!q->data->walk || !are_enough(rays, N)) {
        trace_alone(q, primID, rays, valid, packet, N);
        return;
    }
    sort_by_octant(octant, rays, packet, N);
    for (int i = 0; i < 8; i++)
        trace_octant(q, primID, octant[i], valid, packet, N);
}

static void trace(query *q, unsigned primID, int *valid, void *packet,
                  unsigned N)
{
    if (N == 1)
        tell(valid, 0, trace_one(q, primID));
    else
        trace_packet(q, primID, valid, packet, N);
}

void cylint_embree_trace(const struct RTCIntersectFunctionNArguments *args)
{
    struct RTCRayHit *one = (struct RTCRayHit *)args->rayhit;
    query q;
    begin(&q, args->geometryUserPtr, args->context, args->geomID);
    q.nearest = args;
    q.ray = &one->ray;
    q.hit = &one->hit;
    trace(&q, args->primID, args->valid, args->rayhit, args->N);
}

void cylint_embree_shadow(const struct RTCOccludedFunctionNArguments *args)
{
    query q;
    begin(&q, args->geometryUserPtr, args->context, args->geomID);
    q.any = args;
    q.ray = (struct RTCRay *)args->ray;
    trace(&q, args->primID, args->valid, args->ray, args->N);
}

void cylint_embree_complete(struct RTCGeometryTy *geometry,
                            struct RTCRayHit *rayhit)
{
    const cylint_embree_data *data = rtcGetGeometryUserData(geometry);
    const struct RTCRay *ray = &rayhit->ray;
    cylint_quick_line line = line_of(ray);
    cylint_shape between;
    cylint_answer answer;
    if (!(rayhit->hit.primID < data->n))
        return;
    line.tmax = tmax_after_hit(ray->tfar);
    const int n = ask(shape_at(data, rayhit->hit.primID, ray->time, &between),
                      &line, CYLINT_WANT_ALL, &answer);
    for (int i = 0; i < n; i++)
        if (rounded_up(answer.hit[i].t, ray->tfar) == ray->tfar) {
            const cylint_quick_floats floats = floats_of(&answer.hit[i]);
            describe(&floats, &rayhit->hit);
            return;
        }
}
