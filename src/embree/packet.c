/*
 * packet.c - rays of packets: together, where they go together, or alone
 *
 * They are copied out, asked, and copied back where they hit.
 */
#include "packet.h"

#include <string.h>

#include "packet_traverse.h"
#include "single_ray.h"

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

/* Ray i of the packet, alone. */
static int trace_of_packet(query *q, unsigned primID, void *packet, unsigned N,
                           unsigned i)
{
    struct RTCRay ray;
    struct RTCHit hit;
    gather(&ray, packet, RAY_WORDS, N, i);
    if (q->nearest)
        gather(&hit, hits_of(packet, N), HIT_WORDS, N, i);
    q->ray = &ray;
    if (q->nearest)
        q->hit = &hit;
    if (!cylint_trace_single(q, primID))
        return 0;
    scatter(packet, &ray, RAY_WORDS, N, i);
    if (q->nearest)
        scatter(hits_of(packet, N), &hit, HIT_WORDS, N, i);
    return 1;
}

/* ------------------------------------------------------------- together -- */

/* The rays of a packet that are asked together. */
typedef struct {
    query query[CYLINT_PACKET_MOST];
    struct RTCRay ray[CYLINT_PACKET_MOST];
    struct RTCHit hit[CYLINT_PACKET_MOST];
    const cylint_float_ray *floats[CYLINT_PACKET_MOST]; /* of the rays */
    unsigned at[CYLINT_PACKET_MOST];                    /* in the packet */
    int n;
} bundle;

/* Questions of several rays, one of each. */
typedef struct {
    cylint_float_filter_target subject[CYLINT_PACKET_MOST];
    const cylint_float_filter_ray *line[CYLINT_PACKET_MOST];
    query *asks[CYLINT_PACKET_MOST];
    int n;
} inquiry;

static void add(inquiry *r, query *q)
{
    r->subject[r->n] =
        cylint_ray_test_target(q, q->block->number[q->lane], NULL, NULL);
    r->line[r->n] = &q->line;
    r->asks[r->n++] = q;
}

static void ask_all_at_once(const inquiry *r)
{
    cylint_packet_filter_results answers;
    const query *first = r->asks[0];
    if (r->n == 1) {
        query *q = r->asks[0];
        q->met |= cylint_ray_test_shape(q, q->block->number[q->lane], 0);
        return;
    }
    first->data->many(r->subject, r->line, r->n, is_seen(first), &answers);
    for (int i = 0; i < r->n; i++)
        r->asks[i]->met |= cylint_ray_test_accept(r->asks[i], &answers, i);
}

/* As try_lanes(), for rays side by side: the nearest lanes first of all. */
static unsigned try_met(void *self, const cylint_packet_leaf *met)
{
    bundle *b = self;
    unsigned rays = met->rays, enough = 0, left[CYLINT_PACKET_MOST];
    for (unsigned of = rays; of; of &= of - 1) {
        const int k = cylint_lowest(of);
        left[k] = met->lanes[k];
        fetch_shapes(b->query[0].data, met->leaf, left[k]);
    }
    while (rays) {
        inquiry r;
        r.n = 0;
        for (unsigned of = rays; of; of &= of - 1) {
            const int k = cylint_lowest(of);
            if (left[k] && turn_to_nearest(&b->query[k], met->leaf, &left[k],
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
    begin(each, q->data, q->context, q->geomID);
    each->nearest = q->nearest;
    each->any = q->any;
    each->ray = ray;
    if (!is_set_out(each))
        return;
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
        certain = cylint_traverse_packet_used()(&q->data->group, b.floats, b.n,
                                                q->any && !has_filters(q),
                                                try_met, &b);
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
static unsigned neighbours(unsigned rays, const cylint_bvh *group,
                           const float *packet, unsigned N)
{
    const float S = group->near_distance / 256; /* its longest side */
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

void cylint_trace_packet(query *q, unsigned primID, int *valid, void *packet,
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
