/*
 * test_packets.c - packets return the answers to the rays alone
 *
 * All, some or none of the rays of a packet go in the same direction through
 * all kinds of scenes.  Every word of every answer is compared with the answer
 * to the ray alone, which other tests compare with the library.
 */
#include <math.h>
#include <string.h>

#include "embree/geometry.h"
#include "embree_compare.h"
#include "environment.h"

enum { SHAPES = 400, PACKETS = 450 /* of each manner, a scene */ };

/* Arrangements of the rays of a packet. */
enum manner {
    EYE,    /* from one point to points that are near each other */
    BEAM,   /* nearly parallel, from different places */
    MIXED,  /* as from an eye, but every third anywhere */
    OCTANT, /* only their signs are the same */
    AFAR,   /* from an eye a hundred to a million sizes away */
    ALONG,  /* parallel to the z axis, with zeros of both signs */
    SPANS,  /* from an eye among the shapes, with ends of domains there */
    ANYHOW,
    MANNERS
};

struct aim {
    double lo[3], size[3];
    double eye[3], at[3], spread;
};

static void point(const struct aim *a, double p[3])
{
    for (int k = 0; k < 3; k++)
        p[k] = a->lo[k] + a->size[k] * between(0, 1);
}

static struct aim draw_aim(const struct scene_shapes *s, enum manner manner)
{
    struct aim a;
    double lo[3], hi[3];
    float away[3];
    const double far = manner == AFAR    ? power(2, 6)
                       : manner == SPANS ? 0
                                         : between(0, 2);
    for (int k = 0; k < 3; k++) {
        a.lo[k] = s->lo[k];
        a.size[k] = s->hi[k] - s->lo[k];
    }
    world_direction(away);
    cylint_bounds(&s->shapes[(size_t)(between(0, 1) * (double)s->n)], lo, hi);
    for (int k = 0; k < 3; k++)
        a.at[k] = (lo[k] + hi[k]) / 2;
    point(&a, a.eye);
    for (int k = 0; k < 3; k++)
        a.eye[k] += far * a.size[k] * away[k];
    a.spread = power(-4, 0);
    return a;
}

/* A ray of the packet, with a random length. */
static void add(const struct aim *a, enum manner manner, struct rays *r, int i)
{
    const int anywhere = manner == ANYHOW || (manner == MIXED && i % 3 == 0);
    double from[3], to[3];
    float o[3], d[3], tnear = 0, tfar = HUGE_VALF;
    point(a, from);
    point(a, to);
    for (int k = 0; k < 3; k++) {
        const double sign = a->at[k] < a->eye[k] ? -1 : 1;
        if (manner == OCTANT)
            to[k] = from[k] + sign * fabs(to[k] - from[k]);
        else if (!anywhere) {
            to[k] = a->at[k] + a->spread * (to[k] - a->at[k]);
            from[k] = manner == ALONG && k < 2
                          ? to[k]
                          : a->eye[k] + (manner == BEAM ? to[k] - a->at[k] : 0);
        }
    }
    const double length = between(0.01, 1.01);
    for (int k = 0; k < 3; k++) {
        o[k] = (float)from[k];
        d[k] = (float)((to[k] - (double)o[k]) * length);
        if (manner == ALONG && k < 2)
            d[k] = chance(0.5) ? 0 : -0.0f;
    }
    if (manner == SPANS) {
        tnear = (float)(between(0, 1) / length);
        tfar = tnear + (float)(between(0, 1) / length);
    }
    rays_add(r, i, o, d, tnear, tfar);
}

static struct rays alone(const struct rays *packet, int i)
{
    struct rays one;
    rays_begin(&one, 1);
    for (int m = 0; m < RAY_MEMBERS; m++)
        one.word[m] = packet->before[m * packet->n + i];
    one.valid[0] = -1;
    return one;
}

/* bare: u, v and Ng are not compared. */
static int same_words(const struct rays *packet, int i, const struct rays *one,
                      int bare)
{
    int same = 1;
    for (int m = 0; m < RAY_MEMBERS; m++)
        if (!(bare && m >= HIT_NG && m <= HIT_V))
            same &= packet->word[m * packet->n + i].u == one->word[m].u;
    return same;
}

/* Traces the packet and its rays alone.  Returns the number of hits. */
static int compare_packet(const struct world *w, struct rays *r, int coherent,
                          unsigned how)
{
    const int bare =
        (how & CYLINT_EMBREE_BARE) && !rays_are_native(w->scene, r->n);
    struct rays_query query = {0};
    int hits = 0;
    query.coherent = coherent;
    for (int occlusion = 0; occlusion < 2; occlusion++) {
        if (occlusion)
            memcpy(r->word, r->before, sizeof r->word);
        (occlusion ? rays_occluded : rays_intersect)(r, w->scene, &query);
        CHECK(rays_strayed(r, occlusion) == 0);
        for (int i = 0; i < r->n; i++) {
            struct rays one;
            if (!r->valid[i])
                continue;
            one = alone(r, i);
            (occlusion ? rays_occluded : rays_intersect)(&one, w->scene, NULL);
            if (!CHECK(same_words(r, i, &one, bare))) {
                REPORT("%d of %d, %s", i, r->n,
                       occlusion ? "occluded" : "nearest");
                world_show(w, r, i);
            }
            hits += occlusion ? rays_shadowed(&one, 0) : rays_hit(&one, 0);
        }
    }
    return hits;
}

static void query_scene(const struct world *w, const struct scene_shapes *s,
                        unsigned how, int turns)
{
    int hits = 0;
    for (int turn = 0; turn < turns; turn++) {
        const enum manner manner = (enum manner)(turn % MANNERS);
        const struct aim a = draw_aim(s, manner);
        const double share = turn % 2 ? 1 : between(0, 1);
        struct rays r;
        rays_begin(&r, rays_sizes[1 + turn / MANNERS % 3]);
        for (int i = 0; i < r.n; i++) {
            add(&a, manner, &r, i);
            r.valid[i] = chance(share) ? -1 : 0; /* it too would hit */
        }
        hits += compare_packet(w, &r, turn / 2 % 2, how);
    }
    if (!CHECK(hits > (strcmp(s->name, "needles") ? turns : 0)))
        REPORT("%d hits of %d packets at %s", hits, turns, s->name);
}

static void query_scenes(unsigned how, RTCFilterFunctionN filter)
{
    for (int i = 0; i < WORLD_SCENES; i++) {
        OWN_SHAPES s = scene_generate(world_scenes[i], SHAPES, 7);
        OWN_WORLD w = world_with(s.shapes, s.n, how);
        world_filter(&w, filter);
        query_scene(&w, &s, how, MANNERS * PACKETS);
    }
}

TEST(packets_return_the_answers_to_rays_alone)
{
    EACH_KERNELS(k)
        query_scenes(0, NULL);
}

TEST(packets_without_filters_return_the_answers_to_rays_alone)
{
    query_scenes(CYLINT_EMBREE_NO_FILTERS, NULL);
}

TEST(bare_packets_return_the_answers_to_rays_alone)
{
    query_scenes(CYLINT_EMBREE_BARE, NULL);
}

/* Depends on shape and t only, not on the order of hits. */
static void reject_some(const struct RTCFilterFunctionNArguments *a)
{
    for (int i = 0; i < (int)a->N; i++) {
        union ray_word t;
        t.f = rays_filter_t(a, i);
        if ((rays_filter_prim(a, i) * 2654435761u + t.u * 40503u) >> 7 & 1)
            a->valid[i] = 0;
    }
}

TEST(filtered_packets_return_the_answers_to_rays_alone)
{
    query_scenes(0, reject_some);
}

/* ------------------------------------------------- rays that are no lines */

/* Calls the callback directly: Embree's results for such rays are undefined. */
static void call(const struct world *w, struct rays *r)
{
    cylint_rtc_context context = {0};
    struct RTCIntersectFunctionNArguments a = {0};
    context.instID[0] = RTC_INVALID_GEOMETRY_ID;
    memcpy(r->before, r->word, sizeof r->before);
    a.valid = r->valid;
    a.geometryUserPtr = rtcGetGeometryUserData(w->geometry);
    a.context = &context;
    a.rayhit = (struct RTCRayHitN *)(void *)r->word;
    a.N = (unsigned)r->n;
    cylint_embree_intersect_callback(&a);
}

TEST(rays_that_are_no_lines_do_not_disturb_others)
{
    int hits = 0;
    OWN_SHAPES s = scene_generate(SCENE_FAT, SHAPES, 3);
    OWN_WORLD w = world_with(s.shapes, s.n, CYLINT_EMBREE_NO_FILTERS);
    for (int turn = 0; turn < 2000; turn++) {
        const struct aim a = draw_aim(&s, EYE);
        const float bad[4] = {NAN, HUGE_VALF, -HUGE_VALF, 0};
        struct rays r;
        int is_bad[RAYS_MOST], valid[RAYS_MOST];
        rays_begin(&r, rays_sizes[1 + turn % 3]);
        for (int i = 0; i < r.n; i++) {
            const double kind = between(0, 8);
            const int k = one_of(3);
            const float x = bad[one_of(4)];
            add(&a, EYE, &r, i);
            is_bad[i] = kind < 4 && (x != 0 || kind >= 2);
            if (kind < 2 && is_bad[i])
                r.word[((kind < 1 ? RAY_ORG : RAY_DIR) + k) * r.n + i].f = x;
            else if (kind < 2)
                continue;
            else if (kind < 3)
                for (int j = 0; j < 3; j++)
                    rays_at(&r, RAY_DIR, j * r.n + i)->f = 0;
            else if (kind < 4)
                rays_at(&r, turn & 1 ? RAY_TNEAR : RAY_TFAR, i)->f =
                    turn & 1 ? HUGE_VALF : -1;
        }
        memcpy(valid, r.valid, sizeof valid);
        call(&w, &r);
        memcpy(r.valid, valid, sizeof valid); /* Embree 4's are answers */
        CHECK(rays_strayed(&r, 0) == 0);
        for (int i = 0; i < r.n; i++) {
            struct rays one = alone(&r, i);
            call(&w, &one);
            CHECK(same_words(&r, i, &one, 0));
            hits += rays_hit(&one, 0);
            CHECK(!(is_bad[i] && rays_hit(&one, 0)));
        }
    }
    CHECK(hits > 2000);
}

/* ------------------------------------------- what Embree's packets skip --- */

/* Cylinders that stand on the plane z = 0 and overlap, made of floats. */
static void stand_on_a_plane(cylint_shape *shapes, int n)
{
    for (int i = 0; i < n; i++) {
        const float x = (float)between(0, 4), y = (float)between(0, 4),
                    z = (float)between(0.25, 1.25);
        const double p0[3] = {x, y, 0}, p1[3] = {x, y, z};
        cylint_cylinder(&shapes[i], p0, p1, (float)between(0.5, 1.5),
                        CYLINT_ENDS_CAPPED);
    }
}

/* Rays that hit the plane z = 0 exactly at `tnear`, a power of two. */
static struct rays rays_that_hit_at(int n, float tnear, float tfar)
{
    struct rays r;
    rays_begin(&r, n);
    for (int i = 0; i < n; i++) {
        const float x = (float)between(0, 4), y = (float)between(0, 4);
        const float o[3] = {x, y, -tnear}, d[3] = {0, 0, 1};
        rays_add(&r, i, o, d, tnear, tfar);
    }
    return r;
}

/* t of the library for the shape that ray i reports; NAN: no hit. */
static double library_t(const struct world *w, struct rays *r, int i)
{
    const cylint_line line = rays_line(r, i);
    cylint_answer answer;
    const unsigned shape = rays_at(r, HIT_PRIM, i)->u;
    return cylint_intersect(&w->shapes[shape], &line, CYLINT_WANT_T, &answer)
               ? answer.hit[0].t
               : NAN;
}

/* The adapter answers a packet of rays with tnear = tfar as the rays alone;
 * through Embree every answer is that or a miss: see cylint_embree.h. */
TEST(a_domain_of_one_point_is_answered_or_skipped)
{
    cylint_shape shapes[64];
    stand_on_a_plane(shapes, 64);
    OWN_WORLD w = world_with(shapes, 64, CYLINT_EMBREE_NO_FILTERS);
    int hits = 0;
    for (int turn = 0; turn < 600; turn++) {
        const float t = turn & 1 ? 0 : 2;
        struct rays r = rays_that_hit_at(rays_sizes[1 + turn % 3], t, t);
        const struct rays_query query = {.coherent = turn / 2 % 2};
        call(&w, &r);
        for (int i = 0; i < r.n; i++) {
            hits += rays_hit(&r, i);
            CHECK(world_agrees(&w, &r, i, 1));
        }
        memcpy(r.word, r.before, sizeof r.word);
        rays_intersect(&r, w.scene, &query);
        CHECK(rays_strayed(&r, 0) == 0);
        for (int i = 0; i < r.n; i++)
            CHECK(!rays_hit(&r, i) || world_agrees(&w, &r, i, 1));
    }
    CHECK(hits > 2000);
}

TEST(of_hits_at_tnear_the_lower_number_is_reported)
{
    cylint_shape shapes[64];
    stand_on_a_plane(shapes, 64);
    EACH_WAY(w, shapes, 64)
        for (int turn = 0; turn < 800; turn++) {
            const float t = turn & 1 ? 0 : 2;
            struct rays r =
                rays_that_hit_at(rays_sizes[turn % 4], t, HUGE_VALF);
            const struct rays_query query = {.coherent = turn / 4 % 2};
            const int exception = way == 1 && r.n > 1;
            rays_intersect(&r, w.scene, &query);
            for (int i = 0; i < r.n; i++)
                CHECK(exception && rays_hit(&r, i)
                          ? library_t(&w, &r, i) == t &&
                                rays_at(&r, RAY_TFAR, i)->f == t
                          : world_agrees(&w, &r, i, 1));
        }
}
