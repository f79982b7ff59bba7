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

/* A packet of Embree's. */
typedef struct {
    ray_test all; /* what the tests of its rays share */
    unsigned primID, N;
    int *valid;
    void *words;
} packet;

/* Copies ray i out of the packet and starts its test. */
static void load_ray(const packet *p, unsigned i, ray_test *test,
                     struct RTCRay *ray, struct RTCHit *hit)
{
    gather(ray, p->words, RAY_WORDS, p->N, i);
    if (p->all.any)
        *hit = (struct RTCHit){0};
    else
        gather(hit, hits_of(p->words, p->N), HIT_WORDS, p->N, i);
    start_test(test, &p->all, ray, hit);
}

/* Copies a ray that was hit back. */
static void store_ray(const packet *p, unsigned i, const ray_test *test)
{
    scatter(p->words, test->ray, RAY_WORDS, p->N, i);
    if (!test->any)
        scatter(hits_of(p->words, p->N), test->hit, HIT_WORDS, p->N, i);
}

static void trace_one_by_one(const packet *p, unsigned rays)
{
    for (; rays; rays &= rays - 1) {
        const unsigned i = (unsigned)cylint_lowest(rays);
        ray_test test;
        struct RTCRay ray;
        struct RTCHit hit;
        load_ray(p, i, &test, &ray, &hit);
        const int found = cylint_trace_single(&test, p->primID);
        if (found)
            store_ray(p, i, &test);
        set_valid(p->valid, i, found);
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
    cylint_float_filter_question *asked[CYLINT_PACKET_MOST];
    int n;
} batch;

static void add_question(batch b[2], ray_test *r)
{
    set_question(r);
    batch *to = &b[cylint_float_filter_is_round(&r->q)];
    to->asked[to->n++] = &r->q;
}

static void test_batch(const batch *b, const cylint_embree_data *data)
{
    if (b->n > 0)
        (b->n > 1 ? data->filter_many : data->filter_one)(b->asked, b->n);
    for (int i = 0; i < b->n; i++) {
        ray_test *r = (ray_test *)b->asked[i];
        r->found |= cylint_ray_end(r);
    }
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

static void trace_together(const packet *p, unsigned rays)
{
    packet_state s;
    unsigned certain = 0;
    s.n = 0;
    for (; rays; rays &= rays - 1) {
        const unsigned i = (unsigned)cylint_lowest(rays);
        ray_test *test = &s.test[s.n];
        load_ray(p, i, test, &s.ray[s.n], &s.hit[s.n]);
        set_valid(p->valid, i, 0);
        if (!set_line(test))
            continue;
        s.float_ray[s.n] = float_ray(test->ray);
        s.place[s.n++] = i;
    }
    if (s.n > 0)
        certain = p->all.data->traverse_packet(
            &p->all.data->bvh, s.float_ray, s.n,
            p->all.any && !has_filters(&p->all), test_lanes_in_order, &s);
    for (int k = 0; k < s.n; k++) {
        if (certain >> k & 1)
            s.ray[k].tfar = -HUGE_VALF;
        else if (!s.test[k].found)
            continue;
        store_ray(p, s.place[k], &s.test[k]);
        set_valid(p->valid, s.place[k], 1);
    }
}

/* ------------------------------------------------- which rays go together -- */

/* Writes the rays (bits) that go into each octant. */
static void sort_by_octant(unsigned octant[8], unsigned rays,
                           const float *words, unsigned N)
{
    const float *d = words + offsetof(struct RTCRay, dir_x) / 4 * N;
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
                           const float *words, unsigned N)
{
    const float S = bvh->near_distance / 256;
    const float *o = words + cylint_lowest(rays);
    unsigned near = 0;
    for (; rays; rays &= rays - 1) {
        const int i = cylint_lowest(rays);
        const float far = fabsf(words[i] - o[0]) +
                          fabsf(words[N + (unsigned)i] - o[N]) +
                          fabsf(words[2 * N + (unsigned)i] - o[2 * N]);
        near |= (unsigned)(far < S / 8) << i;
    }
    return near;
}

/* Traces rays that go into one octant. */
static void trace_octant(const packet *p, unsigned rays)
{
    unsigned together = 0;
    if (are_enough(rays, p->N))
        together = neighbours(rays, &p->all.data->bvh, p->words, p->N);
    if (!are_enough(together, p->N))
        together = 0;
    if (together)
        trace_together(p, together);
    trace_one_by_one(p, rays & ~together);
}

static void trace_packet(const packet *p)
{
    unsigned rays = 0, octant[8];
    for (unsigned i = 0; i < p->N; i++)
        rays |= (unsigned)(p->valid[i] != 0) << i;
    if (!p->all.data->traversal || !are_enough(rays, p->N)) {
        trace_one_by_one(p, rays);
        return;
    }
    sort_by_octant(octant, rays, p->words, p->N);
    for (int i = 0; i < 8; i++)
        trace_octant(p, octant[i]);
}

/* -------------------------------------------------------------- callbacks -- */

/* The arguments of both callbacks have the same members, but for the rays. */
#define SET_PACKET(p, arguments, rays, is_any)        \
    do {                                              \
        (p)->all.data = (arguments)->geometryUserPtr; \
        (p)->all.args = (arguments);                  \
        (p)->all.any = (is_any);                      \
        (p)->all.context = (arguments)->context;      \
        (p)->all.geomID = (arguments)->geomID;        \
        (p)->primID = (arguments)->primID;            \
        (p)->N = (arguments)->N;                      \
        (p)->valid = (arguments)->valid;              \
        (p)->words = (rays);                          \
    } while (0)

static void trace(packet *p, struct RTCRay *ray, struct RTCHit *hit)
{
    if (p->N > 1) {
        trace_packet(p);
        return;
    }
    p->all.ray = ray;
    p->all.hit = hit;
    p->all.leaf = NULL;
    set_valid(p->valid, 0, cylint_trace_single(&p->all, p->primID));
}

void cylint_embree_intersect_callback(
    const struct RTCIntersectFunctionNArguments *args)
{
    struct RTCRayHit *one = (struct RTCRayHit *)args->rayhit;
    packet p;
    SET_PACKET(&p, args, args->rayhit, 0);
    trace(&p, &one->ray, &one->hit);
}

void cylint_embree_occluded_callback(
    const struct RTCOccludedFunctionNArguments *args)
{
    struct RTCHit none = {0};
    packet p;
    SET_PACKET(&p, args, args->ray, 1);
    trace(&p, (struct RTCRay *)args->ray, &none);
}
