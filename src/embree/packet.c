/*
 * packet.c - the callbacks: one ray, or the rays of a packet
 *
 * Rays are copied out of the packet, traced together if they begin near each
 * other and go into the same octant, else one by one, and copied back if they
 * are hit.
 */
#include "ray.h"

#include <string.h>

#include "packet_traverse.h"

/* The members of a ray and of a hit, 4 bytes each.  A packet of N rays stores
 * each member N times, those of hits behind those of rays. */
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

/* Traces ray i of the packet. */
static int trace_ray(ray_test *r, unsigned primID, void *packet, unsigned N,
                     unsigned i)
{
    struct RTCRay ray;
    struct RTCHit hit;
    gather(&ray, packet, RAY_WORDS, N, i);
    if (r->nearest)
        gather(&hit, hits_of(packet, N), HIT_WORDS, N, i);
    r->ray = &ray;
    if (r->nearest)
        r->hit = &hit;
    if (!cylint_trace_single(r, primID))
        return 0;
    scatter(packet, &ray, RAY_WORDS, N, i);
    if (r->nearest)
        scatter(hits_of(packet, N), &hit, HIT_WORDS, N, i);
    return 1;
}

static void trace_one_by_one(ray_test *r, unsigned primID, unsigned rays,
                             int *valid, void *packet, unsigned N)
{
    for (; rays; rays &= rays - 1) {
        const unsigned i = (unsigned)cylint_lowest(rays);
        set_valid(valid, i, trace_ray(r, primID, packet, N, i));
    }
}

/* ------------------------------------------------------------- together -- */

/* The rays of a packet that are traced together. */
typedef struct {
    ray_test test[CYLINT_PACKET_MOST];
    struct RTCRay ray[CYLINT_PACKET_MOST];
    struct RTCHit hit[CYLINT_PACKET_MOST];
    const cylint_float_ray *float_ray[CYLINT_PACKET_MOST];
    unsigned place[CYLINT_PACKET_MOST]; /* in the packet */
    int n;
} packet_state;

/* Questions for the filter, at most one for each ray; all of round shapes or none
 * of them. */
typedef struct {
    cylint_float_filter_question asked[CYLINT_PACKET_MOST];
    ray_test *test[CYLINT_PACKET_MOST];
    int n;
} batch;

static void add_question(batch b[2], ray_test *r)
{
    const cylint_float_filter_question q = question_of(r);
    batch *to = &b[cylint_float_filter_is_round(&q)];
    to->asked[to->n] = q;
    to->test[to->n++] = r;
}

static void test_batch(batch *b, const cylint_embree_data *data)
{
    cylint_float_filter_answer answer[CYLINT_PACKET_MOST];
    if (b->n == 0)
        return;
    (b->n > 1 ? data->filter_many : data->filter_one)(b->asked, b->n, answer);
    for (int i = 0; i < b->n; i++)
        b->test[i]->found |=
            cylint_ray_end(b->test[i], &b->asked[i], &answer[i]);
}

/* Tests the lanes of all rays in turns, the nearest lane of each ray first.
 * Returns the rays (bits) that need no other hit. */
static unsigned test_lanes_in_order(void *self, const cylint_packet_leaf *hit)
{
    packet_state *p = self;
    unsigned rays = hit->rays, stopped = 0, left[CYLINT_PACKET_MOST];
    for (unsigned of = rays; of; of &= of - 1) {
        const int k = cylint_lowest(of);
        left[k] = hit->lanes[k];
        prefetch_shapes(p->test[0].data, hit->leaf, left[k]);
    }
    while (rays) {
        batch b[2];
        b[0].n = b[1].n = 0;
        for (unsigned of = rays; of; of &= of - 1) {
            const int k = cylint_lowest(of);
            if (left[k] && select_nearest_lane(&p->test[k], hit->leaf, &left[k],
                                               hit->least[k]))
                add_question(b, &p->test[k]);
            else
                rays &= ~(1u << k);
        }
        test_batch(&b[0], p->test[0].data);
        test_batch(&b[1], p->test[0].data);
        if (p->test[0].any)
            for (unsigned of = rays; of; of &= of - 1) {
                const int k = cylint_lowest(of);
                stopped |= (unsigned)(p->test[k].found != 0) << k;
            }
        rays &= ~stopped;
    }
    return stopped;
}

/* Copies ray i out of the packet, if it is a line. */
static void load_ray(packet_state *p, const ray_test *all, const void *packet,
                     unsigned N, unsigned i)
{
    struct RTCRay *ray = &p->ray[p->n];
    ray_test *one = &p->test[p->n];
    gather(ray, packet, RAY_WORDS, N, i);
    initialise(one, all->data, all->context, all->geomID);
    one->nearest = all->nearest;
    one->any = all->any;
    one->ray = ray;
    if (!set_line(one))
        return;
    if (all->nearest) {
        one->hit = &p->hit[p->n];
        gather(one->hit, hits_of(packet, N), HIT_WORDS, N, i);
    }
    p->float_ray[p->n] = float_ray(ray);
    p->place[p->n++] = i;
}

/* Copies the k-th loaded ray back. */
static void store_ray(const packet_state *p, int k, void *packet, unsigned N)
{
    scatter(packet, &p->ray[k], RAY_WORDS, N, p->place[k]);
    if (p->test[k].nearest)
        scatter(hits_of(packet, N), &p->hit[k], HIT_WORDS, N, p->place[k]);
}

static void trace_together(const ray_test *r, unsigned rays, int *valid,
                           void *packet, unsigned N)
{
    packet_state p;
    unsigned certain = 0;
    p.n = 0;
    for (; rays; rays &= rays - 1) {
        const unsigned i = (unsigned)cylint_lowest(rays);
        load_ray(&p, r, packet, N, i);
        set_valid(valid, i, 0);
    }
    if (p.n > 0)
        certain = r->data->traverse_packet(&r->data->bvh, p.float_ray, p.n,
                                           r->any && !has_filters(r),
                                           test_lanes_in_order, &p);
    for (int k = 0; k < p.n; k++) {
        if (certain >> k & 1)
            p.ray[k].tfar = -HUGE_VALF;
        else if (!p.test[k].found)
            continue;
        store_ray(&p, k, packet, N);
        set_valid(valid, p.place[k], 1);
    }
}

/* ------------------------------------------------- which rays go together -- */

/* Writes the rays (bits) that go into each octant. */
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

static unsigned count_rays(unsigned rays)
{
    unsigned n = 0;
    for (; rays; rays &= rays - 1)
        n++;
    return n;
}

/* Fewer rays often share an octant by chance. */
static int are_enough(unsigned rays, unsigned N)
{
    return count_rays(rays) > N / 4 + 1;
}

/* The rays that begin near the first one, within 1/8 of the longest side S of
 * the shapes' box. */
static unsigned neighbours(unsigned rays, const cylint_bvh *bvh,
                           const float *packet, unsigned N)
{
    const float S = bvh->near_distance / 256;
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

/* Traces rays that go into one octant. */
static void trace_octant(ray_test *r, unsigned primID, unsigned rays,
                         int *valid, void *packet, unsigned N)
{
    unsigned together = 0;
    if (are_enough(rays, N))
        together = neighbours(rays, &r->data->bvh, packet, N);
    if (!are_enough(together, N))
        together = 0;
    if (together)
        trace_together(r, together, valid, packet, N);
    trace_one_by_one(r, primID, rays & ~together, valid, packet, N);
}

/* r: a ray test with the data, context and arguments that all rays share. */
static void trace_packet(ray_test *r, unsigned primID, int *valid, void *packet,
                         unsigned N)
{
    unsigned rays = 0, octant[8];
    for (unsigned i = 0; i < N; i++)
        rays |= (unsigned)(valid[i] != 0) << i;
    if (!r->data->traversal || !are_enough(rays, N)) {
        trace_one_by_one(r, primID, rays, valid, packet, N);
        return;
    }
    sort_by_octant(octant, rays, packet, N);
    for (int i = 0; i < 8; i++)
        trace_octant(r, primID, octant[i], valid, packet, N);
}

/* -------------------------------------------------------------- callbacks -- */

static void trace(ray_test *r, unsigned primID, int *valid, void *packet,
                  unsigned N)
{
    if (N == 1)
        set_valid(valid, 0, cylint_trace_single(r, primID));
    else
        trace_packet(r, primID, valid, packet, N);
}

void cylint_embree_intersect_callback(
    const struct RTCIntersectFunctionNArguments *args)
{
    struct RTCRayHit *one = (struct RTCRayHit *)args->rayhit;
    ray_test r;
    initialise(&r, args->geometryUserPtr, args->context, args->geomID);
    r.nearest = args;
    r.ray = &one->ray;
    r.hit = &one->hit;
    trace(&r, args->primID, args->valid, args->rayhit, args->N);
}

void cylint_embree_occluded_callback(
    const struct RTCOccludedFunctionNArguments *args)
{
    ray_test r;
    initialise(&r, args->geometryUserPtr, args->context, args->geomID);
    r.any = args;
    r.ray = (struct RTCRay *)args->ray;
    trace(&r, args->primID, args->valid, args->ray, args->N);
}
