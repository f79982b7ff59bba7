/*
 * packet.c - the callbacks: one ray, or the rays of a packet
 *
 * Rays are copied out of the packet, traced together if they begin near each
 * other and go into the same octant, else one by one, and copied back if they
 * are hit.
 */
#include "ray.h"

#include <string.h>

/* The members of a ray and of a hit, 4 bytes each.  A packet of N rays stores
 * each member N times, those of hits behind those of rays. */
enum {
    RAY_WORDS = sizeof(struct RTCRay) / 4,
    HIT_WORDS = (offsetof(struct RTCHit, instID) + CYLINT_INSTANCE_BYTES) / 4
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

/* Of a ray in a packet: an occlusion query has no hits. */
static unsigned words_of(int any)
{
    return any ? RAY_WORDS : RAY_WORDS + HIT_WORDS;
}

typedef cylint_float_filter_question question;

/* The rays of a packet that are traced together. */
typedef struct {
    ray_test test[CYLINT_PACKET_MOST];
    struct RTCRayHit ray[CYLINT_PACKET_MOST];
    unsigned place[CYLINT_PACKET_MOST]; /* in the packet */
    int n;
} packet_state;

/* Copies ray i out of the packet, and starts its test if it is a line. */
static void load_ray(packet_state *s, const call *a, int any, unsigned i)
{
    struct RTCRayHit *one = &s->ray[s->n];
    one->hit = (struct RTCHit){0};
    gather(one, a->rayhit, words_of(any), a->N, i);
    if (start_test(&s->test[s->n], a, any, &one->ray, &one->hit))
        s->place[s->n++] = i;
}

/* Copies a ray that was hit back. */
static void store_ray(const packet_state *s, const call *a, int any, int k)
{
    scatter(a->rayhit, &s->ray[k], words_of(any), a->N, s->place[k]);
    set_valid(a->valid, s->place[k], 1);
}

/* ------------------------------------------------------------- together -- */

/* At most one question for each ray; all of round shapes or none of them. */
static void test_batch(question *const asked[], int n,
                       const cylint_embree_data *data)
{
    if (n > 0)
        data->filter[n > 1](asked, n);
    for (int i = 0; i < n; i++)
        cylint_ray_end((ray_test *)asked[i]);
}

/* Tests the lanes of all rays in turns, the nearest lane of each ray first.
 * Returns the rays (bits) that need no other hit. */
static unsigned test_lanes_in_order(void *self, const cylint_packet_leaf *hit)
{
    packet_state *p = self;
    unsigned rays = hit->rays, stopped = 0, left[CYLINT_PACKET_MOST];
    EACH_RAY(k, rays)
    {
        left[k] = hit->lanes[k];
        prefetch_shapes(p->test[0].data, hit->leaf, left[k]);
    }
    while (rays) {
        question *asked[2][CYLINT_PACKET_MOST]; /* not round, and round */
        int n[2] = {0, 0};
        EACH_RAY(k, rays)
        {
            question *q = &p->test[k].q;
            if (left[k] && take_nearest_lane(&p->test[k], hit->leaf, &left[k],
                                             hit->least[k])) {
                const int is_round = cylint_float_filter_is_round(q);
                asked[is_round][n[is_round]++] = q;
            } else {
                rays &= ~(1u << k);
            }
        }
        test_batch(asked[0], n[0], p->test[0].data);
        test_batch(asked[1], n[1], p->test[0].data);
        if (p->test[0].any)
            EACH_RAY(k, rays)
        stopped |= (unsigned)(p->test[k].found != 0) << k;
        rays &= ~stopped;
    }
    return stopped;
}

/* Traces rays (bits) together; they go into one octant. */
static void trace_rays(const call *a, int any, unsigned rays)
{
    const cylint_embree_data *data = a->geometryUserPtr;
    packet_state s;
    unsigned certain = 0;
    s.n = 0;
    EACH_RAY(i, rays)
    {
        set_valid(a->valid, (unsigned)i, 0);
        load_ray(&s, a, any, (unsigned)i);
    }
    if (s.n == 1)
        cylint_trace_single(&s.test[0]);
    else if (s.n > 1)
        certain = data->traverse_packet(&data->bvh, s.ray, s.n,
                                        any && !has_filters(&s.test[0]),
                                        test_lanes_in_order, &s);
    for (int k = 0; k < s.n; k++) {
        if (certain >> k & 1)
            s.ray[k].ray.tfar = -HUGE_VALF;
        if (certain >> k & 1 || s.test[k].found)
            store_ray(&s, a, any, k);
    }
}

/* ------------------------------------------------- which rays go together -- */

/* The rays that go into the octant of the first one and begin near it, within 1/8
 * of the longest side S of the shapes' box. */
static unsigned companions(const call *a, unsigned rays)
{
    enum { DIR = offsetof(struct RTCRay, dir_x) / 4 };
    const cylint_embree_data *data = a->geometryUserPtr;
    const float S = data->bvh.near_distance / 256;
    const float *words = (const float *)a->rayhit,
                *first = words + cylint_lowest(rays);
    unsigned found = 0;
    EACH_RAY(i, rays)
    {
        int is = 1;
        float far = 0;
        for (unsigned k = 0; k < 3; k++) {
            const unsigned o = k * a->N, d = (DIR + k) * a->N;
            far += fabsf(words[o + (unsigned)i] - first[o]);
            is &= !signbit(words[d + (unsigned)i]) == !signbit(first[d]);
        }
        found |= (unsigned)(is && far < S / 8) << i;
    }
    return found;
}

/* Fewer rays often share an octant by chance. */
static int are_enough(unsigned rays, unsigned N)
{
    unsigned n = 0;
    for (; rays; rays &= rays - 1)
        n++;
    return n > N / 4 + 1;
}

static void trace_packet(const call *a, int any)
{
    const cylint_embree_data *data = a->geometryUserPtr;
    unsigned rays = 0;
    for (unsigned i = 0; i < a->N; i++)
        rays |= (unsigned)(a->valid[i] != 0) << i;
    while (rays) {
        unsigned group = 0;
        if (data->traversal && are_enough(rays, a->N))
            group = companions(a, rays);
        if (!are_enough(group, a->N))
            group = 1u << cylint_lowest(rays);
        trace_rays(a, any, group);
        rays &= ~group;
    }
}

/* -------------------------------------------------------------- callbacks -- */

static void trace(const call *a, int any, struct RTCRay *ray,
                  struct RTCHit *hit)
{
    ray_test one;
    if (a->N > 1)
        trace_packet(a, any);
    else
        set_valid(a->valid, 0,
                  start_test(&one, a, any, ray, hit) &&
                      cylint_trace_single(&one));
}

void cylint_embree_intersect_callback(
    const struct RTCIntersectFunctionNArguments *args)
{
    struct RTCRayHit *one = (struct RTCRayHit *)args->rayhit;
    trace(args, 0, &one->ray, &one->hit);
}

void cylint_embree_occluded_callback(
    const struct RTCOccludedFunctionNArguments *args)
{
    struct RTCHit none = {0};
    trace((const call *)args, 1, (struct RTCRay *)args->ray, &none);
}
