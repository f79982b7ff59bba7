/*
 * test_memory.c - floor embree: refused allocations leave no memory
 * behind
 *
 * The adapter allocates from the device, whose memory monitor refuses one
 * allocation after the other.
 */
#include <string.h>

#include "check.h"
#include "embree_world.h"

enum { SHAPES = 300, ENOUGH = 1000 };

static void begin(int refuse)
{
    world_memory.requests = 0;
    world_memory.refuse = refuse;
    world_errors();
}

/* Whether an allocation was refused; then the device reported an error. */
static int was_refused(void)
{
    const int refused = world_memory.requests >= world_memory.refuse;
    world_memory.refuse = 0;
    if (refused)
        CHECK(world_errors() > 0 &&
              world_last_error() == RTC_ERROR_OUT_OF_MEMORY);
    else
        CHECK(world_errors() == 0);
    return refused;
}

static void shapes_of_all_kinds(cylint_shape *shapes, uint64_t seed)
{
    world_shapes(&seed, SCENE_MIXED, shapes, SHAPES);
    seed = 77; /* and long ones, which are split */
    world_shapes(&seed, SCENE_FIBRES, shapes, SHAPES / 2);
}

static void refuse_making(unsigned how, const cylint_shape *moved)
{
    cylint_shape shapes[SHAPES];
    cylint_embree_options options = {0};
    int refusals = 0, made = 0;
    options.flags = how;
    options.moved = moved;
    shapes_of_all_kinds(shapes, 1);
    for (int k = 1; k < ENOUGH && !made; k++) {
        const long long bytes = world_memory.bytes;
        cylint_embree_problem problem = {-1, 0};
        RTCGeometry geometry;
        begin(k);
        geometry = cylint_embree_geometry(world_device(), shapes, SHAPES,
                                          &options, &problem);
        if (was_refused()) {
            refusals++;
            CHECK(!geometry && problem.status == CYLINT_EMBREE_EMEMORY);
        } else {
            made = 1;
            CHECK(geometry && problem.status == CYLINT_EMBREE_OK);
        }
        cylint_embree_release(geometry);
        CHECK(world_memory.bytes == bytes);
    }
    CHECK(made && refusals > 0);
}

static void a_failed_making_frees_all_memory(void)
{
    cylint_shape moved[SHAPES];
    shapes_of_all_kinds(moved, 1);
    refuse_making(0, NULL);
    refuse_making(CYLINT_EMBREE_SINGLE, NULL);
    refuse_making(0, moved);
}

static void query_all(struct world *w, uint64_t *state)
{
    for (int i = 0; i < 50; i++) {
        struct rays r;
        float o[3], d[3];
        world_direction(state, o);
        world_direction(state, d);
        rays_begin(&r, 1);
        rays_add(&r, 0, o, d, 0, 1e9f);
        rays_intersect(&r, w->scene, NULL);
        if (!CHECK(world_agrees(w, &r, 0, 1)))
            world_show(w, &r, 0);
    }
}

/* A refused update can be repeated. */
static void a_failed_update_frees_all_memory(void)
{
    cylint_shape shapes[SHAPES];
    uint64_t state = 5;
    for (int how = 0; how < 2; how++) {
        const long long before = world_memory.bytes;
        cylint_embree_options options = {0};
        struct world w;
        int refusals = 0, made = 0;
        options.flags = how ? CYLINT_EMBREE_SINGLE : 0;
        shapes_of_all_kinds(shapes, 2);
        if (!CHECK(world_make(&w, shapes, SHAPES, &options)))
            return;
        for (int k = 1; k < ENOUGH && !made; k++) {
            const long long bytes = world_memory.bytes;
            int status;
            begin(k);
            status = cylint_embree_update(w.geometry, &w.problem);
            CHECK(status == w.problem.status);
            if (was_refused()) {
                refusals++;
                CHECK(status == CYLINT_EMBREE_EMEMORY);
                CHECK(world_memory.bytes == bytes);
            } else {
                made = 1;
                CHECK(status == CYLINT_EMBREE_OK);
            }
        }
        CHECK(made && (how || refusals > 0));
        rtcCommitScene(w.scene);
        query_all(&w, &state);
        world_free(&w);
        CHECK(world_memory.bytes == before);
    }
}

/* If memory for Embree's own hierarchy is refused, Embree calls the error
 * function, and the scene can be committed again. */
static void a_refused_commit_can_be_repeated(void)
{
    cylint_shape shapes[SHAPES];
    const long long before = world_memory.bytes;
    uint64_t state = 6;
    struct world w;
    int refusals = 0, made = 0;
    shapes_of_all_kinds(shapes, 3);
    if (!CHECK(world_make(&w, shapes, SHAPES, NULL)))
        return;
    for (int k = 1; k < ENOUGH && !made; k++) {
        CHECK(cylint_embree_update(w.geometry, NULL) == CYLINT_EMBREE_OK);
        begin(k);
        rtcCommitScene(w.scene);
        if (was_refused())
            refusals++;
        else
            made = 1;
    }
    CHECK(made && refusals > 0);
    query_all(&w, &state);
    world_free(&w);
    CHECK(world_memory.bytes == before);
}

static void a_thousand_geometries_leave_nothing(void)
{
    cylint_shape shapes[SHAPES];
    const long long before = world_memory.bytes;
    shapes_of_all_kinds(shapes, 4);
    for (int i = 0; i < 1000; i++) {
        RTCGeometry g = cylint_embree_geometry(world_device(), shapes,
                                               (size_t)i % 20, NULL, NULL);
        if (CHECK(g != NULL))
            CHECK(cylint_embree_bytes(g) >= (i % 20 ? sizeof shapes[0] : 0));
        cylint_embree_release(g);
    }
    cylint_embree_release(NULL);
    CHECK(world_memory.bytes == before);
    CHECK(world_errors() == 0);
}

/* Neither a commit nor a query reads the arrays that a geometry was made of. */
static void queries_do_not_read_the_callers_shapes(void)
{
    cylint_shape shapes[SHAPES], copy[SHAPES];
    uint64_t state = 7;
    shapes_of_all_kinds(shapes, 5);
    for (int how = 0; how < 3; how++) {
        cylint_embree_options options = {0};
        struct world w;
        options.flags = how == 1 ? CYLINT_EMBREE_SINGLE : 0;
        options.moved = how == 2 ? copy : NULL;
        if (!CHECK(world_make(&w, shapes, SHAPES, NULL)))
            return;
        memcpy(copy, shapes, sizeof copy);
        cylint_embree_release(w.geometry);
        rtcDetachGeometry(w.scene, 0);
        w.geometry = cylint_embree_geometry(world_device(), copy, SHAPES,
                                            &options, NULL);
        memset(copy, 0xa5, sizeof copy);
        rtcAttachGeometry(w.scene, w.geometry);
        rtcCommitScene(w.scene);
        query_all(&w, &state);
        world_free(&w);
    }
}

int main(void)
{
    RUN(queries_do_not_read_the_callers_shapes);
    RUN(a_failed_making_frees_all_memory);
    RUN(a_failed_update_frees_all_memory);
    RUN(a_refused_commit_can_be_repeated);
    RUN(a_thousand_geometries_leave_nothing);
    return check_end();
}
