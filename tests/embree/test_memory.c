/*
 * test_memory.c - refused allocations leave no memory behind
 *
 * The adapter allocates from the device, whose memory monitor refuses one
 * allocation after the other.
 */
#include <string.h>

#include "embree_world.h"

enum { SHAPES = 300, ENOUGH = 1000 };

/* What is made, updated or, if there is a scene, committed while allocations are
 * refused. */
struct subject {
    const cylint_shape *shapes;
    cylint_embree_options options;
    RTCGeometry geometry;
    RTCScene scene;
};

static int make(struct subject *s)
{
    const long long bytes = world_memory.bytes;
    cylint_embree_problem problem = {-1, 0};
    RTCGeometry geometry = cylint_embree_geometry(
        world_device(), s->shapes, SHAPES, &s->options, &problem);
    CHECK((geometry != NULL) == (problem.status == CYLINT_EMBREE_OK));
    if (geometry) {
        const long long held = world_memory.bytes - bytes,
                        counted = (long long)cylint_embree_bytes(geometry);
        CHECK(counted <= held && held <= counted + 6 * 64); /* six buffers */
    }
    cylint_embree_release(geometry);
    CHECK(world_memory.bytes == bytes);
    return problem.status;
}

static int update(struct subject *s)
{
    cylint_embree_problem problem = {-1, 0};
    const int status = cylint_embree_update(s->geometry, &problem);
    CHECK(status == problem.status);
    return status;
}

/* The scene has no status: the errors of the device are checked. */
static int commit(struct subject *s)
{
    rtcCommitScene(s->scene);
    return world_memory.requests < world_memory.refuse ? CYLINT_EMBREE_OK
                                                       : CYLINT_EMBREE_EMEMORY;
}

/* Refuses one allocation of an action after the other, until it succeeds.  If one
 * is refused, the device reports an error, and no memory stays behind, except that
 * of a scene.  Returns the number of refusals. */
static int refuse_each(int (*act)(struct subject *), struct subject *s)
{
    for (int k = 1; k < ENOUGH; k++) {
        if (s->scene)
            CHECK(cylint_embree_update(s->geometry, NULL) == CYLINT_EMBREE_OK);
        const long long bytes = world_memory.bytes;
        world_memory.requests = 0;
        world_memory.refuse = k;
        world_errors();
        const int status = act(s);
        const int refused = world_memory.requests >= k;
        world_memory.refuse = 0;
        CHECK(status == (refused ? CYLINT_EMBREE_EMEMORY : CYLINT_EMBREE_OK));
        CHECK(refused ? world_errors() > 0 &&
                            world_last_error == RTC_ERROR_OUT_OF_MEMORY
                      : world_errors() == 0);
        if (!refused)
            return k - 1;
        CHECK(s->scene || world_memory.bytes == bytes);
    }
    CHECK(0); /* never made */
    return 0;
}

/* Half of them long, so that they are split, and some beside the hierarchy. */
static void shapes_of_all_kinds(cylint_shape *shapes)
{
    world_shapes(SCENE_MIXED, shapes, SHAPES);
    world_shapes(SCENE_FIBRES, shapes, SHAPES / 2);
    world_distant(shapes);
}

TEST(a_failed_making_frees_all_memory)
{
    cylint_shape shapes[SHAPES], moved[SHAPES];
    shapes_of_all_kinds(shapes);
    memcpy(moved, shapes, sizeof moved);
    for (int how = 0; how < 3; how++) {
        struct subject s = {.shapes = shapes};
        s.options.flags = how == 1 ? CYLINT_EMBREE_SINGLE : 0;
        s.options.moved = how == 2 ? moved : NULL;
        CHECK(refuse_each(make, &s) > 0);
    }
}

/* A refused update, or commit, can be repeated.  If memory for Embree's own
 * hierarchy is refused, Embree calls the error function. */
TEST(a_failed_update_or_commit_frees_all_memory)
{
    cylint_shape shapes[SHAPES];
    for (int how = 0; how < 4; how++) {
        const long long before = world_memory.bytes;
        shapes_of_all_kinds(shapes);
        struct world w = world_with(shapes, SHAPES, both_ways[how % 2]);
        struct subject s = {.geometry = w.geometry,
                            .scene = how < 2 ? NULL : w.scene};
        CHECK(refuse_each(s.scene ? commit : update, &s) > 0);
        rtcCommitScene(w.scene);
        check_some_rays(&w);
        world_free(&w);
        CHECK(world_memory.bytes == before);
    }
}

/* Neither a commit nor a query reads the arrays that a geometry was made of. */
TEST(queries_do_not_read_the_callers_shapes)
{
    cylint_shape shapes[SHAPES], copy[SHAPES];
    shapes_of_all_kinds(shapes);
    for (int how = 0; how < 3; how++) {
        const cylint_embree_options options = {
            .flags = how == 1 ? CYLINT_EMBREE_SINGLE : 0,
            .moved = how == 2 ? copy : NULL};
        memcpy(copy, shapes, sizeof copy);
        OWN_WORLD w = world_made(copy, SHAPES, &options);
        w.shapes = shapes;
        cylint_pack_shapes(&w.pack, w.pack_memory, shapes, SHAPES);
        memset(copy, 0xa5, sizeof copy);
        rtcCommitGeometry(w.geometry);
        rtcCommitScene(w.scene);
        check_some_rays(&w);
    }
}
