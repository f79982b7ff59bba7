/*
 * test_layout.c - rays, hits and arguments have the declared layout
 *
 * The adapter is not tested: rays with a known pattern around them hit one of
 * Embree's own curves in an instance.  With a wrong declaration, possible for a
 * library without its header (tests/embree/embree4), Embree writes elsewhere.
 */
#include <math.h>
#include <string.h>

#include "check.h"
#include "embree_world.h"

enum { CURVE_ID = 5, INSTANCE_ID = 3 };

static const float nodes[2][4] = {{-1, 0, 0, 0.5f}, {1, 0, 0, 0.5f}};

struct call_counts {
    int calls, bad;
};

/* Arguments as declared, and the context that was given. */
static void count_call(const struct RTCFilterFunctionNArguments *a)
{
    struct call_counts *counts = rays_user(a);
    counts->calls++;
    for (unsigned i = 0; i < a->N; i++)
        if (a->valid[i] == -1)
            counts->bad += rays_filter_prim(a, (int)i) != 0 ||
                           !(rays_filter_t(a, (int)i) > 6) ||
                           a->context->instID[0] != INSTANCE_ID;
}

TEST(a_hit_is_written_where_it_is_declared)
{
    const float matrix[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 8};
    RTCScene inner = world_curve(nodes, 2, CURVE_ID);
    RTCScene scene = world_instance(inner, INSTANCE_ID, 1, matrix);
    EACH_SIZE(n) {
        struct call_counts counts = {0, 0};
        struct rays_query query = {0};
        struct rays r;
        query.filter = count_call;
        query.user = &counts;
        rays_begin(&r, n);
        for (int i = 0; i < n; i += 2) {
            const float o[3] = {0.25f, 0, 1}, d[3] = {0, 0, 1};
            rays_add(&r, i, o, d, 0, HUGE_VALF);
        }
        rays_intersect(&r, scene, &query);
        CHECK(rays_strayed(&r, 0) == 0);
        for (int i = 0; i < n; i += 2) {
            CHECK(rays_hit(&r, i));
            CHECK(rays_at(&r, HIT_GEOM, i)->u == CURVE_ID);
            CHECK(rays_at(&r, HIT_PRIM, i)->u == 0);
            CHECK(rays_at(&r, HIT_INST, i)->u == INSTANCE_ID);
#if RTC_VERSION_MAJOR >= 4
            CHECK(rays_at(&r, HIT_INST_PRIM, i)->u == 0);
#endif
            CHECK(fabsf(rays_at(&r, RAY_TFAR, i)->f - 6.5f) < 1e-4f);
            CHECK(fabsf(rays_at(&r, HIT_U, i)->f - 0.625f) < 1e-4f);
        }
        CHECK(counts.calls > 0 && counts.bad == 0);
        memcpy(r.word, r.before, sizeof r.word);
        rays_occluded(&r, scene, &query);
        CHECK(rays_strayed(&r, 1) == 0);
        for (int i = 0; i < n; i += 2)
            CHECK(rays_shadowed(&r, i));
        CHECK(counts.bad == 0);
    }
    rtcReleaseScene(scene);
    rtcReleaseScene(inner);
}

TEST(a_box_is_written_where_it_is_declared)
{
    struct {
        struct RTCBounds box;
        unsigned beyond[8];
    } at;
    RTCScene scene = world_curve(nodes, 2, CURVE_ID);
    memset(&at, 0x5a, sizeof at);
    rtcGetSceneBounds(scene, &at.box);
    /* it contains the curve and is at most a few half radii larger */
    CHECK(at.box.lower_x <= -1 && at.box.lower_x > -2);
    CHECK(at.box.upper_x >= 1 && at.box.upper_x < 2);
    CHECK(at.box.lower_y <= -0.5f && at.box.lower_y > -1);
    CHECK(at.box.upper_z >= 0.5f && at.box.upper_z < 1);
    for (int i = 0; i < 8; i++)
        CHECK(at.beyond[i] == 0x5a5a5a5au);
    rtcReleaseScene(scene);
}
