/*
 * test_filter.c - filters get each hit once
 *
 * A filter here rejects by a rule on shape and t.  Each hit that it gets must
 * be a hit of the library with all its members, and the result must be the
 * nearest hit that the rule accepts.
 */
#include <math.h>
#include <string.h>

#include "embree_world.h"

typedef enum rule { ACCEPT, REJECT, EXITS, HALF, RULES } rule;

/* The rules of the filters in one query, and the hits that they got. */
struct record {
    const struct world *w;
    rule geometry, context; /* ACCEPT where there is no such filter */
    unsigned instance;      /* in the context, or none */
    struct rays *r;
    /* by the geometry's, the context's: the hits of each ray and shape, and all */
    char got[2][RAYS_MOST][SOME][2];
    int offers[2];
    int occlusion;
    int repeats; /* Embree may trace a ray several times */
    int bad;     /* wrong arguments */
};

static int user_word; /* its address is the user pointer */

static int passes(rule rule, unsigned prim, float t, int leaving)
{
    union ray_word word;
    word.f = t;
    switch (rule) {
    case ACCEPT:
        return 1;
    case REJECT:
        return 0;
    case EXITS:
        return leaving;
    default:
        return (prim * 2654435761u + word.u * 40503u) >> 7 & 1;
    }
}

/* The index of the library's hit with these members that the filter has not got, or
 * -1. */
static int new_hit(const struct record *q, int which, int ray, unsigned prim,
                   float t, float u, cylint_answer *answer)
{
    const cylint_line line = rays_line(q->r, ray);
    int number = -1;
    const int n = prim < q->w->n ? cylint_intersect(&q->w->shapes[prim], &line,
                                                    CYLINT_WANT_ALL, answer)
                                 : 0;
    for (int i = 0; i < n; i++)
        if (world_float_above(answer->hit[i].t) == t &&
            (q->repeats || !q->got[which][ray][prim][i]) &&
            (number < 0 || q->w->bare || (float)answer->hit[i].z == u))
            number = i;
    return number;
}

/* Whether u, v and Ng are right; a bare hit keeps the values before, unless
 * Embree traces a stream. */
static int described(const struct record *q, const union ray_word *hit, int ray,
                     const cylint_hit *at)
{
    int good = 1;
    if (!q->w->bare)
        return world_describes(hit, at);
    if (!q->occlusion && !rays_are_native(q->w->scene, q->r->n))
        return 1;
    for (int m = HIT_NG; m <= HIT_V; m++)
        good &= hit[m - HIT_NG].u ==
                (q->occlusion ? 0 : q->r->before[m * q->r->n + ray].u);
    return good;
}

static void filter(struct record *q, int which,
                   const struct RTCFilterFunctionNArguments *a)
{
    union ray_word hit[RAY_MEMBERS - HIT_NG], ray[HIT_NG];
    cylint_answer answer;
    if (which == 1 && a->valid[0] == 0)
        return; /* Embree 3 calls it after a rejection by the geometry's too */
    if (a->N != 1 || a->valid[0] != -1 || a->geometryUserPtr != &user_word) {
        q->bad++;
        return;
    }
    memcpy(hit, a->hit, sizeof hit);
    memcpy(ray, a->ray, sizeof ray);
    const int at = (int)ray[RAY_ID].u;
    const unsigned prim = hit[HIT_PRIM - HIT_NG].u;
    const float t = ray[RAY_TFAR].f;
    const int number =
        new_hit(q, which, at, prim, t, hit[HIT_U - HIT_NG].f, &answer);
    q->offers[which]++;
    if (number < 0) {
        q->bad++;
        return;
    }
    q->got[which][at][prim][number] = 1;
    q->bad += !described(q, hit, at, &answer.hit[number]);
    q->bad += hit[HIT_GEOM - HIT_NG].u != 0;
    q->bad += hit[HIT_INST - HIT_NG].u != q->instance;
    if (!passes(which ? q->context : q->geometry, prim, t,
                answer.hit[number].side == CYLINT_SIDE_LEAVING))
        a->valid[0] = 0;
}

static void geometry_filter(const struct RTCFilterFunctionNArguments *a)
{
    filter(rays_user(a), 0, a);
}

static void context_filter(const struct RTCFilterFunctionNArguments *a)
{
    filter(rays_user(a), 1, a);
}

/* The shape of the nearest hit that both rules accept, or n.  Adds the number of
 * all hits. */
static size_t expected(const struct record *q, int ray, double *t, int *hits)
{
    const cylint_line line = rays_line(q->r, ray);
    size_t nearest = q->w->n;
    *t = HUGE_VAL;
    for (size_t i = 0; i < q->w->n; i++) {
        cylint_answer answer;
        *hits +=
            cylint_intersect(&q->w->shapes[i], &line, CYLINT_WANT_ALL, &answer);
        for (int k = 0; k < answer.n; k++) {
            const float f = world_float_above(answer.hit[k].t);
            const int leaving = answer.hit[k].side == CYLINT_SIDE_LEAVING;
            if (answer.hit[k].t < *t &&
                passes(q->geometry, (unsigned)i, f, leaving) &&
                passes(q->context, (unsigned)i, f, leaving)) {
                nearest = i;
                *t = answer.hit[k].t;
            }
        }
    }
    return nearest;
}

static void check_answers(struct record *q)
{
    int hits = 0;
    for (int i = 0; i < q->r->n; i++) {
        double t;
        if (!q->r->valid[i])
            continue;
        const size_t prim = expected(q, i, &t, &hits);
        const int hit = prim < q->w->n;
        const union ray_word tfar = *rays_at(q->r, RAY_TFAR, i);
        if (!CHECK(q->occlusion ? rays_shadowed(q->r, i) == hit
                   : hit        ? rays_hit(q->r, i) &&
                               rays_at(q->r, HIT_PRIM, i)->u == prim &&
                               rays_at(q->r, HIT_INST, i)->u == q->instance &&
                               tfar.f == world_float_above(t)
                         : !rays_hit(q->r, i) &&
                               tfar.u ==
                                   q->r->before[RAY_TFAR * q->r->n + i].u)) {
            REPORT("rules %d %d: shape %lu at t %a is the nearest to pass",
                   q->geometry, q->context, (unsigned long)prim, t);
            world_show(q->w, q->r, i);
        }
    }
    if (q->geometry == REJECT)
        CHECK((q->offers[0] == hits || (q->repeats && q->offers[0] > hits)) &&
              q->offers[1] == 0);
    else if (q->context == REJECT)
        CHECK(q->offers[0] > 0 ? q->offers[1] <= q->offers[0]
              : q->repeats     ? q->offers[1] >= hits
                               : q->offers[1] == hits);
}

/* An application may instance scenes itself: hits then have the number in the
 * context.  (Both versions of Embree tested allow one level.) */
static void query_packets(struct world *w, rule geometry, rule context, int n,
                          int occlusion)
{
    static struct record q;
    struct rays r;
    struct rays_query query = {0};
    memset(&q, 0, sizeof q);
    q.w = w, q.r = &r;
    q.geometry = geometry, q.context = context;
    q.occlusion = occlusion;
    query.user = &q;
    query.instance = chance(0.5) ? 9 : 0;
    q.instance = query.instance ? query.instance : RTC_INVALID_GEOMETRY_ID;
    query.filter = context == ACCEPT ? NULL : context_filter;
    query.coherent = chance(0.3);
    q.repeats = query.coherent && occlusion && n > 1;
    aim_all(&r, n);
    for (int i = 0; i < n; i++) {
        rays_at(&r, RAY_TNEAR, i)->f = chance(0.5) ? 0 : (float)power(-3, 3);
        r.valid[i] = n == 1 || chance(0.8) ? -1 : 0;
    }
    if (occlusion)
        rays_occluded(&r, w->scene, &query);
    else
        rays_intersect(&r, w->scene, &query);
    CHECK(q.bad == 0);
    CHECK(rays_strayed(&r, occlusion) == 0);
    check_answers(&q);
}

static void with_filters(unsigned how, int kind)
{
    cylint_shape shapes[SOME];
    const cylint_embree_options options = {
        .flags = how | CYLINT_EMBREE_CONTEXT_FILTER, .user = &user_word};
    world_shapes(kind, shapes, SOME);
    OWN_WORLD w = world_made(shapes, SOME, &options);
    for (int geometry = ACCEPT; geometry < RULES; geometry++) {
        world_filter(&w, geometry == ACCEPT ? NULL : geometry_filter);
        for (int context = ACCEPT; context < RULES; context++)
            for (int i = 0; i < 40; i++)
                query_packets(&w, (rule)geometry, (rule)context,
                              rays_sizes[i / 2 % 4], i & 1);
    }
}

TEST(filters_get_each_hit_once_from_leaves)
{
    for (int kind = SCENE_THIN; kind <= SCENE_MIXED; kind++)
        with_filters(0, kind);
}

TEST(filters_get_each_hit_once_from_single_primitives)
{
    with_filters(CYLINT_EMBREE_SINGLE, SCENE_FIBRES);
    with_filters(CYLINT_EMBREE_SINGLE, SCENE_MIXED);
}

TEST(filters_get_bare_hits_without_description)
{
    with_filters(CYLINT_EMBREE_BARE, SCENE_MIXED);
}

/* Rejects the hit where the ray enters the shape of this number. */
static unsigned rejected;

static void reject_entry(const struct RTCFilterFunctionNArguments *a)
{
    union ray_word hit[RAY_MEMBERS - HIT_NG];
    memcpy(hit, a->hit, sizeof hit);
    if (hit[HIT_PRIM - HIT_NG].u == rejected && hit[HIT_U - HIT_NG].f < 0.5f)
        a->valid[0] = 0;
}

/* All hits of two plates round to one float.  The ray enters the other one before
 * it leaves the one of which the entry is rejected. */
TEST(hits_of_one_float_are_in_the_order_of_their_doubles)
{
    const double first[2] = {8 + 0x1p-40, 8 + 0x2p-40}, thick = 0x2p-40;
    const float o[3] = {0, 0, 0}, d[3] = {0, 0, 1};
    for (rejected = 0; rejected < 2; rejected++) {
        cylint_shape plate[2];
        for (unsigned i = 0; i < 2; i++) {
            const double z = first[i != rejected];
            cylint_cylinder(&plate[i], (double[]){0, 0, z},
                            (double[]){0, 0, z + thick}, 1, CYLINT_ENDS_CAPPED);
        }
        EACH_WAY(w, plate, 2) {
            world_filter(&w, reject_entry);
            struct rays r = equal_rays(w.scene, 1, o, d, 0, HUGE_VALF);
            CHECK(rays_hit(&r, 0) && rays_at(&r, HIT_PRIM, 0)->u == !rejected &&
                  rays_at(&r, HIT_U, 0)->f == 0);
        }
    }
}

static void reject_front(const struct RTCFilterFunctionNArguments *a)
{
    union ray_word hit[RAY_MEMBERS - HIT_NG];
    memcpy(hit, a->hit, sizeof hit);
    if (hit[HIT_PRIM - HIT_NG].u == rejected && hit[2].f < 0)
        a->valid[0] = 0;
}

/* Both hits of two equal balls round to one float. */
TEST(of_equal_balls_the_entry_comes_before_the_exit_of_the_other)
{
    const float o[3] = {0, 0, 0}, d[3] = {0, 0, 1};
    const double center[3] = {0, 0, 8 + 0x1p-21};
    cylint_shape ball[2];
    for (int i = 0; i < 2; i++)
        cylint_sphere(&ball[i], center, 0x1p-22, CYLINT_ENDS_CAPPED);
    for (rejected = 0; rejected < 2; rejected++)
        EACH_WAY(w, ball, 2) {
            world_filter(&w, reject_front);
            struct rays r = equal_rays(w.scene, 1, o, d, 0, HUGE_VALF);
            CHECK(rays_hit(&r, 0) && rays_at(&r, HIT_PRIM, 0)->u == !rejected &&
                  rays_at(&r, HIT_NG + 2, 0)->f < 0);
        }
}

/* What the filter below writes to tfar, and whether it accepts. */
static float written;
static int accepts;

static void writing_filter(const struct RTCFilterFunctionNArguments *a)
{
    union ray_word *ray = (union ray_word *)(void *)a->ray;
    ray[RAY_TFAR].f = written;
    a->valid[0] = accepts ? -1 : 0;
}

/* A ball that is hit at 2 and 4. */
TEST(a_tfar_that_a_filter_writes_stays_if_it_accepts_the_hit)
{
    static const float values[] = {1.5f, 3, 9};
    const float o[3] = {0, 0, 0}, d[3] = {1, 0, 0};
    const cylint_shape ball = shape_of("sphere 3 0 0  1");
    OWN_WORLD w = world_with(&ball, 1, 0);
    world_filter(&w, writing_filter);
    for (int i = 0; i < 6; i++)
        EACH_SIZE(n) {
            written = values[i / 2];
            accepts = i % 2;
            struct rays r = equal_rays(w.scene, n, o, d, 0, 8);
            CHECK(rays_hit(&r, n - 1) == accepts);
            CHECK(rays_at(&r, RAY_TFAR, n - 1)->f == (accepts ? written : 8));
        }
}

/* After a ball of which the filter writes 3, a disc at 3 is hit, and one at the
 * double above 3 is not. */
TEST(a_tfar_that_a_filter_wrote_ends_the_domain)
{
    static const char *const disc[2] = {
        "cylinder 3.0000000000000004 0 0  4 0 0  1",
        "cylinder 3 0 0  4 0 0  1"};
    const float o[3] = {0, 0, 0}, d[3] = {1, 0, 0};
    written = 3;
    accepts = 1;
    for (unsigned i = 0; i < 2; i++) {
        const cylint_shape shape[2] = {shape_of("sphere 2 0 0  0.5"),
                                       shape_of(disc[i])};
        OWN_WORLD w = world_with(shape, 2, 0);
        world_filter(&w, writing_filter);
        EACH_SIZE(n) {
            struct rays r = equal_rays(w.scene, n, o, d, 0, 8);
            CHECK(rays_hit(&r, n - 1) && rays_at(&r, HIT_PRIM, n - 1)->u == i);
        }
    }
}

static void reject(const struct RTCFilterFunctionNArguments *a)
{
    a->valid[0] = 0;
}

/* The test of a leaf is certain that the ray hits the cylinder. */
TEST(an_occlusion_filter_rejects_a_hit_that_is_certain)
{
    const float o[3] = {-9, 0, 0}, d[3] = {1, 0, 0};
    const cylint_shape shape = shape_of("cylinder 0 -1 0  0 1 0  1");
    OWN_WORLD w = world_with(&shape, 1, 0);
    world_filter(&w, reject);
    EACH_SIZE(n) {
        struct rays r;
        rays_begin(&r, n);
        for (int i = 0; i < n; i++)
            rays_add(&r, i, o, d, 0, HUGE_VALF);
        rays_occluded(&r, w.scene, NULL);
        for (int i = 0; i < n; i++)
            CHECK(!rays_shadowed(&r, i));
    }
}

TEST(each_query_has_its_own_filter)
{
    const float o[3] = {0, 0, 0}, d[3] = {1, 0, 0};
    const cylint_shape ball = shape_of("sphere 3 0 0  1");
    OWN_WORLD w = world_with(&ball, 1, 0);
    for (int occlusion = 0; occlusion < 2; occlusion++) {
        rtcSetGeometryIntersectFilterFunction(w.geometry,
                                              occlusion ? NULL : reject);
        rtcSetGeometryOccludedFilterFunction(w.geometry,
                                             occlusion ? reject : NULL);
        rtcCommitGeometry(w.geometry);
        rtcCommitScene(w.scene);
        EACH_SIZE(n) {
            struct rays r = equal_rays(w.scene, n, o, d, 0, 8);
            CHECK(rays_hit(&r, n - 1) == occlusion);
            memcpy(r.word, r.before, sizeof r.word);
            rays_occluded(&r, w.scene, NULL);
            CHECK(rays_shadowed(&r, n - 1) == !occlusion);
        }
    }
}
