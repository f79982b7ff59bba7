/*
 * test_merge.c - a merged geometry answers as its shapes in one geometry do, with
 * the numbers of the parts
 */
#include <string.h>

#include "embree_world.h"

enum { SHAPES = 300, MOST_PARTS = 120 };

static cylint_embree_part parts[MOST_PARTS];
static size_t n_parts;

/* Cuts the shapes into parts of 0 to 6. */
static void cut(const cylint_shape *shapes)
{
    size_t first = 0;
    for (n_parts = 0; first < SHAPES; n_parts++) {
        const size_t most = SHAPES - first, n = n_parts % 7;
        parts[n_parts] = (cylint_embree_part){
            shapes + first, n < most ? n : most, (unsigned)(3 * n_parts + 5)};
        first += parts[n_parts].n;
    }
}

/* The number over all parts, or SHAPES. */
static unsigned number_of(unsigned geomID, unsigned primID)
{
    unsigned first = 0;
    for (size_t i = 0; i < n_parts; first += (unsigned)parts[i++].n)
        if (parts[i].geomID == geomID)
            return primID < parts[i].n ? first + primID : SHAPES;
    return SHAPES;
}

/* A scene with the merged shapes alone, as the geometry of this number. */
static void merge(struct world *w, const cylint_embree_options *options)
{
    rtcReleaseScene(w->scene);
    cylint_embree_release(w->geometry);
    cylint_embree_problem problem;
    w->geometry =
        cylint_embree_merge(world_device(), parts, n_parts, options, &problem);
    CHECK(w->geometry && problem.status == CYLINT_EMBREE_OK);
    w->scene = rtcNewScene(world_device());
    rtcAttachGeometryByID(w->scene, w->geometry, 1);
    rtcCommitScene(w->scene);
}

/* Replaces the numbers of hits of a merged geometry by those that one geometry,
 * number 0, would have written. */
static void as_of_one(struct rays *r)
{
    for (int i = 0; i < r->n; i++)
        if (r->valid[i] && rays_hit(r, i)) {
            rays_at(r, HIT_PRIM, i)->u = number_of(rays_at(r, HIT_GEOM, i)->u,
                                                   rays_at(r, HIT_PRIM, i)->u);
            rays_at(r, HIT_GEOM, i)->u = 0;
        }
}

static void draw_rays(struct rays *r)
{
    rays_begin(r, rays_sizes[one_of(4)]);
    for (int i = 0; i < r->n; i++) {
        float o[3], d[3];
        world_direction(o);
        world_direction(d);
        for (int k = 0; k < 3; k++) /* on a lattice: hits at equal t */
            o[k] = floorf(8 * o[k]) / 4;
        if (one_of(3) == 0)
            memcpy(d, (float[]){0, 0, 1}, sizeof d);
        rays_add(r, i, o, d, 0, 1e9f);
        rays_at(r, RAY_TIME, i)->f = 0.5f;
    }
}

/* Rejects the hits of every third shape. */
static void reject_some(const struct RTCFilterFunctionNArguments *args)
{
    const unsigned *hit = (const unsigned *)args->hit;
    const unsigned geomID = hit[HIT_GEOM - HIT_NG],
                   primID = hit[HIT_PRIM - HIT_NG];
    const unsigned number = geomID == 0 ? primID : number_of(geomID, primID);
    if (number % 3 == 0)
        args->valid[0] = 0;
    CHECK(number < SHAPES);
}

static void compare(struct world *one, struct world *merged, int bare)
{
    int hits = 0;
    for (int n = 0; n < 2000; n++) {
        struct rays r, s;
        draw_rays(&r);
        s = r;
        rays_intersect(&r, one->scene, NULL);
        rays_intersect(&s, merged->scene, NULL);
        if (bare && r.n == 1) {
            cylint_embree_complete(one->geometry, (void *)r.word);
            cylint_embree_complete(merged->geometry, (void *)s.word);
        }
        hits += rays_hit(&r, 0);
        as_of_one(&s);
        if (bare && !rays_are_native(one->scene, r.n)) /* undefined */
            memcpy(rays_at(&s, HIT_NG, 0), rays_at(&r, HIT_NG, 0),
                   (HIT_PRIM - HIT_NG) * sizeof s.word[0] * (size_t)r.n);
        CHECK(memcmp(r.word, s.word, sizeof r.word) == 0);
        draw_rays(&r);
        s = r;
        rays_occluded(&r, one->scene, NULL);
        rays_occluded(&s, merged->scene, NULL);
        CHECK(memcmp(r.word, s.word, sizeof r.word) == 0);
    }
    CHECK(hits > 100);
}

TEST(hits_have_the_numbers_of_the_parts)
{
    static const unsigned flags[] = {0, CYLINT_EMBREE_BARE,
                                     CYLINT_EMBREE_NO_FILTERS, 0};
    static const cylint_shape none[SHAPES];
    for (int i = 0; i < 4; i++) {
        cylint_embree_options options = {.flags = flags[i], .threads = 2};
        cylint_shape shapes[SHAPES];
        world_shapes(i % 2 ? SCENE_LATTICE : SCENE_MIXED, shapes, SHAPES);
        if (i == 2)
            world_distant(shapes);
        cut(shapes);
        OWN_WORLD one = world_made(shapes, SHAPES, &options);
        OWN_WORLD merged = world_made(shapes, SHAPES, &options);
        options.flags |= CYLINT_EMBREE_SINGLE; /* these have no effect */
        options.moved = none;
        merge(&merged, &options);
        if (i == 3) {
            world_filter(&one, reject_some);
            world_filter(&merged, reject_some);
        }
        compare(&one, &merged, i == 1);
        world_shapes(SCENE_MIXED, shapes, SHAPES);
        CHECK(world_update(&one) == CYLINT_EMBREE_OK &&
              world_update(&merged) == CYLINT_EMBREE_OK);
        compare(&one, &merged, i == 1);
        CHECK(cylint_embree_bytes(merged.geometry) ==
              cylint_embree_bytes(one.geometry) + 32 * (n_parts - 1) +
                  4 * SHAPES);
    }
}

/* Whether a hit at 2 on the first ball is completed if this member is changed. */
static int is_completed(const struct world *w, enum ray_member m, unsigned to)
{
    const float o[3] = {0, 0, 0}, d[3] = {1, 0, 0};
    struct rays r = equal_rays(w->scene, 1, o, d, 0, HUGE_VALF);
    CHECK(rays_hit(&r, 0) && rays_at(&r, RAY_TFAR, 0)->f == 2);
    if (m != RAY_MEMBERS)
        rays_at(&r, m, 0)->u = to;
    memcpy(r.before, r.word, sizeof r.before);
    cylint_embree_complete(w->geometry, (void *)r.word);
    return memcmp(r.word, r.before, sizeof r.word) != 0;
}

/* Not a ray without a hit, a hit on another geometry, or one of another tfar. */
TEST(only_hits_on_the_geometry_are_completed)
{
    const cylint_embree_options options = {.flags = CYLINT_EMBREE_BARE};
    const union ray_word changed = {.f = 2.5f};
    cylint_shape shapes[SHAPES];
    for (int i = 0; i < SHAPES; i++)
        shapes[i] = shape_of("sphere 3 0 0  1");
    parts[0] = (cylint_embree_part){shapes, SHAPES, 5};
    n_parts = 1;
    OWN_WORLD w = world_made(shapes, SHAPES, &options);
    merge(&w, &options);
    CHECK(is_completed(&w, RAY_MEMBERS, 0));
    CHECK(!is_completed(&w, HIT_GEOM, RTC_INVALID_GEOMETRY_ID));
    CHECK(!is_completed(&w, HIT_GEOM, 6));
    CHECK(!is_completed(&w, HIT_PRIM, SHAPES));
    CHECK(!is_completed(&w, RAY_TFAR, changed.u));
}

TEST(parts_whose_numbers_do_not_ascend_are_refused)
{
    const long long bytes = world_memory.bytes;
    cylint_shape shapes[SHAPES];
    cylint_embree_problem problem;
    world_shapes(SCENE_MIXED, shapes, SHAPES);
    cut(shapes);
    parts[9].geomID = parts[8].geomID;
    world_errors();
    CHECK(!cylint_embree_merge(world_device(), parts, n_parts, NULL, &problem));
    CHECK(world_refused(&problem, CYLINT_EMBREE_EPART, 9));
    cut(shapes);
    parts[n_parts - 1].geomID = RTC_INVALID_GEOMETRY_ID;
    CHECK(!cylint_embree_merge(world_device(), parts, n_parts, NULL, &problem));
    CHECK(world_refused(&problem, CYLINT_EMBREE_EPART, n_parts - 1));
    cut(shapes);
    memset(&shapes[77], 0, sizeof shapes[77]);
    CHECK(!cylint_embree_merge(world_device(), parts, n_parts, NULL, &problem));
    CHECK(world_refused(&problem, CYLINT_EMBREE_ESHAPE, 77));
    RTCGeometry none =
        cylint_embree_merge(world_device(), NULL, 0, NULL, &problem);
    CHECK(none && problem.status == CYLINT_EMBREE_OK);
    cylint_embree_release(none);
    CHECK(world_memory.bytes == bytes);
}
