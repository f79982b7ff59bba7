/*
 * test_packets.c - what the adapter's callback does with packets for which Embree
 * promises nothing, and what Embree's packets skip
 */
#include <math.h>
#include <string.h>

#include "embree/geometry.h"
#include "embree_world.h"

/* ------------------------------------------------- rays that are no lines */

/* Calls both callbacks directly: Embree's results for such rays are undefined.
 * Checks all answers, and returns the number of hits. */
static int call(const struct world *w, struct rays *r)
{
    cylint_rtc_context context = {0};
    cylint_embree_call a = {0};
    int valid[RAYS_MOST], hits = 0;
    context.instID[0] = RTC_INVALID_GEOMETRY_ID;
    memcpy(r->before, r->word, sizeof r->before);
    memcpy(valid, r->valid, sizeof valid);
    a.valid = r->valid;
    a.geometryUserPtr = rtcGetGeometryUserData(w->geometry);
    a.context = &context;
    a.rayhit = (struct RTCRayHitN *)(void *)r->word;
    a.N = (unsigned)r->n;
    cylint_embree_occluded_callback((const void *)&a);
    memcpy(r->valid, valid, sizeof valid); /* answers, with Embree 4 */
    check_shadows_of(w, r);
    memcpy(r->word, r->before, sizeof r->before);
    cylint_embree_intersect_callback(&a);
    memcpy(r->valid, valid, sizeof valid);
    check_answers_of(w, r);
    for (int i = 0; i < r->n; i++)
        hits += rays_hit(r, i);
    return hits;
}

/* Makes one ray in two no line: a direction of zeros, an empty domain, or a number
 * that is not finite. */
static void spoil(struct rays *r, int i)
{
    static const float bad[3] = {NAN, HUGE_VALF, -HUGE_VALF};
    const int member = one_of(2 * RAY_TFAR);
    if (member == RAY_TIME)
        for (int k = 0; k < 3; k++)
            rays_at(r, RAY_DIR, k * r->n + i)->f = 0;
    else if (member <= RAY_TFAR)
        rays_at(r, (enum ray_member)member, i)->f =
            member == RAY_TNEAR  ? HUGE_VALF
            : member == RAY_TFAR ? -1
                                 : bad[one_of(3)];
}

TEST(rays_that_are_no_lines_do_not_disturb_others)
{
    int hits = 0;
    cylint_shape shapes[SOME];
    world_shapes(SCENE_FAT, shapes, SOME);
    OWN_WORLD w = world_with(shapes, SOME, CYLINT_EMBREE_NO_FILTERS);
    for (int turn = 0; turn < 2000; turn++) {
        struct rays r;
        aim_all(&r, rays_sizes[turn % 4]);
        for (int i = 0; i < r.n; i++)
            spoil(&r, i);
        hits += call(&w, &r);
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
        hits += call(&w, &r);
        memcpy(r.word, r.before, sizeof r.word);
        rays_intersect(&r, w.scene, &query);
        CHECK(rays_strayed(&r, 0) == 0);
        for (int i = 0; i < r.n; i++)
            CHECK(!rays_hit(&r, i) || world_agrees(&w, &r, i));
    }
    CHECK(hits > 2000);
}

/* Rays from within a cylinder, past its axis.  Every second one ends inside. */
TEST(rays_that_end_inside_a_shape_are_not_occluded_beside_others)
{
    const cylint_shape shape = shape_of("cylinder 0 0 -4  0 0 4  2");
    const float o[3] = {-1, 0.25f, 0.5f}, d[3] = {1, 0, 0};
    OWN_WORLD w = world_with(&shape, 1, CYLINT_EMBREE_NO_FILTERS);
    EACH_SIZE(n) {
        struct rays r;
        rays_begin(&r, n);
        for (int i = 0; i < n; i++)
            rays_add(&r, i, o, d, 0, i % 2 ? 2 : HUGE_VALF);
        rays_occluded(&r, w.scene, NULL);
        check_shadows_of(&w, &r);
    }
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
                          ? rays_at(&r, RAY_TFAR, i)->f == t &&
                                world_hits_at(&w, &r, i,
                                              rays_at(&r, HIT_PRIM, i)->u, t)
                          : world_agrees(&w, &r, i));
        }
}
