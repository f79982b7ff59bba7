/*
 * test_embree_answers.c - the adapter answers float rays as the library does
 *
 * Every question is asked of Embree and of the library, with the ray's floats
 * taken for doubles, and the answers are compared bit for bit.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "check.h"
#include "embree_world.h"

static const unsigned both_ways[2] = {0, CYLINT_EMBREE_SINGLE};

static cylint_embree_options options_for(unsigned how)
{
    cylint_embree_options options = {0};
    options.how = how;
    return options;
}

static struct world made(const cylint_shape *shapes, size_t n, unsigned how)
{
    const cylint_embree_options options = options_for(how);
    struct world w;
    if (!CHECK(world_make(&w, shapes, n, &options))) {
        REPORT("%s, shape %lu", cylint_embree_strerror(w.problem.status),
               (unsigned long)w.problem.shape);
        exit(1); /* there is nothing to ask */
    }
    return w;
}

enum { SOME = 200 };

/* A ray to a point among SOME shapes, from as far as three times their cube,
 * direction of any length in 1e-3 to 1e3; some begin inside. */
static void aim(uint64_t *state, struct rays *r, int i)
{
    float o[3], d[3];
    const double side = cbrt(SOME), far = 3 * world_uniform(state);
    const double length = pow(10, 6 * world_uniform(state) - 3);
    world_direction(state, d);
    for (int k = 0; k < 3; k++) {
        o[k] = (float)(side * (world_uniform(state) - 0.5 - far * d[k]));
        d[k] = (float)(length * d[k]);
    }
    rays_add(r, i, o, d, 0, HUGE_VALF);
}

/* A ray at a shape: from away to a point within 1.2 radii of its axis. */
static void aim_at(uint64_t *state, const cylint_shape *shape,
                   struct rays *r, int i)
{
    double lo[3], hi[3];
    float o[3], d[3], away[3];
    cylint_bounds(shape, lo, hi);
    world_direction(state, away);
    for (int k = 0; k < 3; k++) {
        const double target = lo[k] + (hi[k] - lo[k]) * world_uniform(state);
        o[k] = (float)(target + 2 * (away[k] + world_uniform(state)));
        d[k] = (float)(target - o[k]);
    }
    rays_add(r, i, o, d, 0, HUGE_VALF);
}

static int shadow_expected(const struct world *w, const struct rays *r, int i)
{
    const cylint_line line = rays_line(r, i);
    return cylint_count(&w->pack, &line, 1) != 0;
}

static void agrees(const struct world *w, struct rays *r)
{
    for (int i = 0; i < r->n; i++)
        if (r->valid[i] && !CHECK(world_agrees(w, r, i, 1)))
            world_show(w, r, i);
    CHECK(rays_strayed(r, 0) == 0);
}

/* ------------------------------------------------------- single answers -- */

static void every_kind_with_all_caps_answers_as_the_library(void)
{
    uint64_t state = 1;
    const double c[3] = {0.5, 0.25, -0.5};
    for (int how = 0; how < 2; how++)
    for (int kind = CYLINT_KIND_CYLINDER; kind <= CYLINT_KIND_ECONE; kind++)
    for (int ends = CYLINT_CAPPED; ends <= CYLINT_CAP_1; ends++) {
        int hits = 0, parts[3] = {0, 0, 0};
        cylint_shape shape;
        struct world w;
        struct rays r;
        world_shape(&state, kind, (cylint_ends)ends, c, 1, 0.4, &shape);
        w = made(&shape, 1, both_ways[how]);
        for (int i = 0; i < 300; i++) {
            cylint_hit hit;
            cylint_line line;
            rays_begin(&r, 1);
            aim_at(&state, &shape, &r, 0);
            rays_intersect(&r, w.scene, NULL);
            agrees(&w, &r);
            line = rays_line(&r, 0);
            if (cylint_nearest(&w.pack, &line, CYLINT_WANT_PART, &hit) == 0) {
                hits++;
                parts[hit.part]++;
            }
        }
        /* the questions were worth asking */
        CHECK(hits > 60 && hits < 300 && parts[CYLINT_LATERAL]);
        CHECK((parts[CYLINT_CAP1] > 0) ==
              (ends == CYLINT_CAPPED || ends == CYLINT_CAP_1) ||
              shape.r1 == 0);
        world_free(&w);
    }
}

static void packets_answer_and_leave_other_lanes_alone(void)
{
    static const int sizes[4] = {1, 4, 8, 16};
    cylint_shape shapes[SOME];
    uint64_t state = 2;
    world_shapes(&state, SCENE_MIXED, shapes, SOME);
    for (int how = 0; how < 2; how++) {
        struct world w = made(shapes, SOME, both_ways[how]);
        int hits = 0, asked = 0;
        for (int turn = 0; turn < 800; turn++) {
            struct rays r;
            struct rays_query query = {0};
            query.coherent = turn & 1;
            rays_begin(&r, sizes[turn % 4]);
            for (int i = 0; i < r.n; i++) {
                aim(&state, &r, i); /* inactive rays would hit, too */
                r.valid[i] = r.n == 1 || world_uniform(&state) < 0.7 ? -1 : 0;
            }
            rays_intersect(&r, w.scene, &query);
            agrees(&w, &r);
            for (int i = 0; i < r.n; i++) {
                asked += r.valid[i] != 0;
                hits += r.valid[i] && rays_hit(&r, i);
            }
            memcpy(r.word, r.before, sizeof r.word);
            rays_occluded(&r, w.scene, &query);
            for (int i = 0; i < r.n; i++)
                if (r.valid[i] && !CHECK(rays_shadowed(&r, i) ==
                                         shadow_expected(&w, &r, i)))
                    world_show(&w, &r, i);
            CHECK(rays_strayed(&r, 1) == 0);
        }
        if (!CHECK(hits > asked / 10 && hits < asked))
            REPORT("%d hits of %d", hits, asked);
        world_free(&w);
    }
}

static void a_ray_that_starts_inside_hits_where_it_leaves(void)
{
    const double p0[3] = {0, 0, 0}, p1[3] = {0, 0, 4};
    const float o[3] = {0, 0, 1}, d[3] = {0, 0, 0.5f};
    cylint_shape shape;
    cylint_cylinder(&shape, p0, p1, 1, CYLINT_CAPPED);
    for (int how = 0; how < 2; how++) {
        struct world w = made(&shape, 1, both_ways[how]);
        struct rays r;
        rays_begin(&r, 1);
        rays_add(&r, 0, o, d, 0, HUGE_VALF);
        rays_intersect(&r, w.scene, NULL);
        agrees(&w, &r);
        CHECK(rays_hit(&r, 0) && rays_at(&r, RAY_TFAR, 0)->f == 6);
        CHECK(rays_at(&r, HIT_U, 0)->f == 1);
        world_free(&w);
    }
}

/* Ends of the domain, on the hit itself and one float beside it. */
static void the_domain_holds_its_ends(void)
{
    const double p0[3] = {0, 0, 0}, p1[3] = {0, 0, 1};
    const float o[3] = {-4, 0.25f, 0.5f}, d[3] = {3, 0, 0};
    cylint_shape shape;
    cylint_cylinder(&shape, p0, p1, 1, CYLINT_CAPPED);
    for (int how = 0; how < 2; how++) {
        struct world w = made(&shape, 1, both_ways[how]);
        struct rays r;
        float t[2];
        cylint_line line;
        cylint_answer answer;
        int hits = 0;
        rays_begin(&r, 1);
        rays_add(&r, 0, o, d, 0, HUGE_VALF);
        rays_intersect(&r, w.scene, NULL);
        line = rays_line(&r, 0);
        CHECK(cylint_intersect(&shape, &line, CYLINT_WANT_T, &answer) == 2);
        for (int k = 0; k < 2; k++)
            t[k] = (float)answer.hit[k].t;
        for (int a = -2; a <= 2; a++)
        for (int b = -2; b <= 2; b++)
        for (int which = 0; which < 3; which++) {
            float from = t[which == 2], to = t[which > 0];
            for (int k = 0; k < abs(a); k++)
                from = nextafterf(from, a < 0 ? 0 : HUGE_VALF);
            for (int k = 0; k < abs(b); k++)
                to = nextafterf(to, b < 0 ? 0 : HUGE_VALF);
            if (from > to)
                continue;
            rays_begin(&r, 1);
            rays_add(&r, 0, o, d, from, to);
            rays_intersect(&r, w.scene, NULL);
            agrees(&w, &r);
            hits += rays_hit(&r, 0);
        }
        CHECK(hits > 0);
        world_free(&w);
    }
}

/* Where 0 / d tells Embree's boxes nothing: tangents in their faces. */
static void a_ray_within_a_face_of_the_box_is_not_lost(void)
{
    const double p0[3] = {-1, 0, 2}, p1[3] = {1, 0, 2};
    cylint_shape shape;
    cylint_cylinder(&shape, p0, p1, 1, CYLINT_CAPPED);
    for (int how = 0; how < 2; how++) {
        struct world w = made(&shape, 1, both_ways[how]);
        int hits = 0;
        for (int n = 1; n <= 16; n = n == 1 ? 4 : 2 * n)
        for (int face = 0; face < 6; face++)
        for (int way = 0; way < 8; way++) {
            const int across = face / 2, along = (across + 1 + way % 2) % 3;
            const float zero = way & 4 ? -0.0f : 0.0f;
            float o[3] = {0, 0, 2}, d[3];
            struct rays r;
            o[across] += face % 2 ? 1.0f : -1.0f;
            for (int k = 0; k < 3; k++)
                d[k] = zero;
            d[along] = way & 2 ? 1.0f : -1.0f;
            o[along] -= 3 * d[along];
            rays_begin(&r, n);
            rays_add(&r, n / 2, o, d, 0, HUGE_VALF);
            rays_intersect(&r, w.scene, NULL);
            agrees(&w, &r);
            hits += rays_hit(&r, n / 2);
        }
        CHECK(hits == 4 * 6 * 8);
        world_free(&w);
    }
}

/* The library refuses such a line, so nothing is hit.  (Rays that are not
 * finite are kept from Embree: it answers them as it likes, or aborts.) */
static void a_ray_without_direction_hits_nothing(void)
{
    const double p0[3] = {0, 0, -1}, p1[3] = {0, 0, 1};
    const float o[3] = {0, 0, 0}, none[3] = {0, 0, 0}, fine[3] = {0, 0, 1};
    cylint_shape shape;
    cylint_cylinder(&shape, p0, p1, 1, CYLINT_CAPPED);
    for (int how = 0; how < 2; how++) {
        struct world w = made(&shape, 1, both_ways[how]);
        for (int n = 1; n <= 16; n = n == 1 ? 4 : 2 * n) {
            struct rays r;
            rays_begin(&r, n);
            for (int i = 0; i < n; i++)
                rays_add(&r, i, o, i % 2 ? fine : none, 0, HUGE_VALF);
            rays_intersect(&r, w.scene, NULL);
            agrees(&w, &r);
            CHECK(n == 1 || rays_hit(&r, 1));
        }
        world_free(&w);
    }
}

/* ---------------------------------------------------------------- masks -- */

static int seen(struct world *w, unsigned mask)
{
    const float o[3] = {0.5f, 0.5f, -3}, d[3] = {0, 0, 1};
    struct rays r;
    int hit;
    rays_begin(&r, 4);
    rays_add(&r, 2, o, d, 0, HUGE_VALF);
    rays_at(&r, RAY_MASK, 2)->u = mask;
    rays_intersect(&r, w->scene, NULL);
    hit = rays_hit(&r, 2);
    CHECK(rays_strayed(&r, 0) == 0);
    memcpy(r.word, r.before, sizeof r.word);
    rays_occluded(&r, w->scene, NULL);
    CHECK(rays_shadowed(&r, 2) == hit);
    return hit;
}

static void masks_choose_who_is_seen(void)
{
    const double p0[3] = {0, 0, 0}, p1[3] = {1, 1, 1};
    cylint_shape shape;
    struct world w;
    if (!rtcGetDeviceProperty(world_device(),
                              RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED)) {
        printf("note: this Embree was built without ray masks\n");
        return;
    }
    cylint_cylinder(&shape, p0, p1, 0.5, CYLINT_CAPPED);
    w = made(&shape, 1, 0);
    for (int bit = 0; bit < 32; bit++)
        CHECK(seen(&w, 1u << bit));
    CHECK(!seen(&w, 0));
    rtcSetGeometryMask(w.geometry, 6);
    rtcCommitGeometry(w.geometry);
    rtcCommitScene(w.scene);
    CHECK(!seen(&w, 1) && seen(&w, 2) && seen(&w, 4) && !seen(&w, ~6u));
    world_free(&w);
}

/* ----------------------------------------------------------------- ties -- */

/* Of shapes that are hit at the same t the lowest number answers, however
 * they were grouped; of shapes whose t differ by less than a float's last
 * place the nearer one. */
static void equal_and_nearly_equal_hits_are_told_apart(void)
{
    enum { MANY = 40 };
    cylint_shape shapes[MANY];
    const float o[3] = {0.0625f, 0.125f, -8}, d[3] = {0, 0, 1};
    uint64_t state = 3;
    for (int how = 0; how < 2; how++)
    for (int turn = 0; turn < 60; turn++) {
        struct world w;
        struct rays r;
        for (int i = 0; i < MANY; i++) {
            /* caps toward the ray, from 0 to a few doubles apart, and solids
             * of different sizes, so that they are grouped in some order */
            double p0[3] = {0, 0, 0}, p1[3] = {0, 0, 0};
            p0[2] = turn < 30 ? 0 : floor(4 * world_uniform(&state)) * 0x1p-50;
            p1[2] = 1 + floor(8 * world_uniform(&state));
            cylint_cylinder(&shapes[i], p0, p1, 0.5 + world_uniform(&state),
                            turn % 3 ? CYLINT_CAPPED : CYLINT_CAP_0);
        }
        w = made(shapes, MANY, both_ways[how]);
        for (int n = 1; n <= 16; n = n == 1 ? 4 : 2 * n) {
            rays_begin(&r, n);
            for (int i = 0; i < n; i++)
                rays_add(&r, i, o, d, 0, HUGE_VALF);
            rays_intersect(&r, w.scene, NULL);
            agrees(&w, &r);
        }
        world_free(&w);
    }
}

/* The same while all move along the ray: at time 1/2 the caps meet it. */
static void equal_hits_of_moving_shapes_are_told_apart(void)
{
    enum { MANY = 40 };
    cylint_shape shapes[MANY], moved[MANY], now[MANY];
    const float o[3] = {0.0625f, 0.125f, -8}, d[3] = {0, 0, 1};
    cylint_embree_options options = {0};
    struct world w, at;
    for (int i = 0; i < MANY; i++) {
        const double away = i % 7 - 3, p0[3] = {0, 0, away},
            p1[3] = {0, 0, away + 4}, q0[3] = {0, 0, -away},
            q1[3] = {0, 0, 4 - away};
        const double r = 1 + 0.125 * (i * 17 % MANY);
        cylint_cylinder(&shapes[i], p0, p1, r, CYLINT_CAPPED);
        cylint_cylinder(&moved[i], q0, q1, r, CYLINT_CAPPED);
        CHECK(!cylint_embree_between(&shapes[i], &moved[i], 0.5, &now[i]));
    }
    options.moved = moved;
    if (!CHECK(world_make(&w, shapes, MANY, &options)))
        return;
    at = w;
    cylint_pack_shapes(&at.pack, w.room, now, MANY);
    at.shapes = now;
    for (int n = 1; n <= 16; n = n == 1 ? 4 : 2 * n) {
        struct rays r;
        rays_begin(&r, n);
        for (int i = 0; i < n; i++) {
            rays_add(&r, i, o, d, 0, HUGE_VALF);
            rays_at(&r, RAY_TIME, i)->f = 0.5f;
        }
        rays_intersect(&r, w.scene, NULL);
        agrees(&at, &r);
        CHECK(rays_at(&r, HIT_PRIM, 0)->u == 0);
    }
    world_free(&w);
}

/* An angle a little less than a whole turn: v is below 1 even so. */
static void a_whole_turn_is_not_reached(void)
{
    const double p0[3] = {0, 0, 0}, p1[3] = {0, 0, 1};
    cylint_shape shape;
    cylint_cylinder(&shape, p0, p1, 1, CYLINT_CAPPED);
    for (int how = 0; how < 2; how++) {
        struct world w = made(&shape, 1, both_ways[how]);
        for (int k = 24; k < 48; k += 4) {
            const float o[3] = {-ldexpf(1, -k), -4, 0.5f}, d[3] = {0, 1, 0};
            struct rays r;
            rays_begin(&r, 1);
            rays_add(&r, 0, o, d, 0, HUGE_VALF);
            rays_intersect(&r, w.scene, NULL);
            agrees(&w, &r);
            CHECK(rays_at(&r, HIT_V, 0)->f > 0.99f &&
                  rays_at(&r, HIT_V, 0)->f < 1);
        }
        world_free(&w);
    }
}

/* ------------------------------------------------------------ instances -- */

/* A geometry that nothing hits, but that sees the one active ray as it is
 * inside an instance. */
static struct rays local;

static void spy_bounds(const struct RTCBoundsFunctionArguments *a)
{
    const struct RTCBounds everything = {-1e6f, -1e6f, -1e6f, 0,
                                         1e6f, 1e6f, 1e6f, 0};
    *a->bounds_o = everything;
}

static void spy_ray(const struct RTCIntersectFunctionNArguments *a)
{
    const union ray_word *word = (const union ray_word *)(void *)a->rayhit;
    for (int i = 0; i < (int)a->N; i++)
        for (int m = 0; a->valid[i] && m < HIT_NG; m++)
            local.before[m] = word[m * (int)a->N + i];
}

static void spy_shadow(const struct RTCOccludedFunctionNArguments *a)
{
    (void)a;
}

static void add_spy(RTCScene scene)
{
    RTCGeometry spy = rtcNewGeometry(world_device(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(spy, 1);
    rtcSetGeometryBoundsFunction(spy, spy_bounds, NULL);
    rtcSetGeometryIntersectFunction(spy, spy_ray);
    rtcSetGeometryOccludedFunction(spy, spy_shadow);
    rtcSetGeometryMask(spy, 0xffffffffu);
    rtcCommitGeometry(spy);
    rtcAttachGeometry(scene, spy);
    rtcReleaseGeometry(spy);
}

static RTCScene scene_with_instance(RTCScene of, unsigned id, uint64_t *state)
{
    RTCScene outer = rtcNewScene(world_device());
    RTCGeometry instance = rtcNewGeometry(world_device(),
                                          RTC_GEOMETRY_TYPE_INSTANCE);
    const double scale = pow(10, 4 * world_uniform(state) - 2);
    float matrix[12];
    for (int c = 0; c < 4; c++)
        world_direction(state, matrix + 3 * c);
    for (int k = 0; k < 9; k++)
        matrix[k] = (float)(scale * matrix[k]);
    rtcSetGeometryInstancedScene(instance, of);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                            matrix);
    rtcSetGeometryMask(instance, 0xffffffffu);
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(outer, instance, id);
    rtcReleaseGeometry(instance);
    rtcCommitScene(outer);
    return outer;
}

/* Skewed and scaled: what counts is the ray as Embree transforms it. */
static void instances_answer_for_the_transformed_ray(void)
{
    cylint_shape shapes[SOME];
    uint64_t state = 4;
    world_shapes(&state, SCENE_MIXED, shapes, SOME);
    for (int how = 0; how < 2; how++) {
        struct world w = made(shapes, SOME, both_ways[how]);
        int hits = 0;
        add_spy(w.scene);
        rtcCommitScene(w.scene);
        for (int turn = 0; turn < 40; turn++) {
            RTCScene outer = scene_with_instance(w.scene, 7, &state);
            struct RTCBounds box;
            rtcGetSceneBounds(w.scene, &box);
            for (int i = 0; i < 60; i++) {
                static const int sizes[4] = {1, 4, 8, 16};
                const int n = sizes[i % 4], at = i % n;
                struct rays r;
                float o[3], d[3];
                world_direction(&state, o);
                world_direction(&state, d);
                for (int k = 0; k < 3; k++)
                    o[k] *= 4;
                rays_begin(&r, n);
                rays_add(&r, at, o, d, 0, HUGE_VALF);
                rays_intersect(&r, outer, NULL);
                CHECK(rays_strayed(&r, 0) == 0);
                if (rays_hit(&r, at)) {
                    hits++;
                    CHECK(rays_at(&r, HIT_INST, at)->u == 7);
                    CHECK(rays_at(&r, HIT_GEOM, at)->u == 0);
#if RTC_VERSION_MAJOR >= 4
                    CHECK(rays_at(&r, HIT_INST_PRIM, at)->u == 0);
#endif
                } else {
                    CHECK(rays_at(&r, HIT_INST, at)->u ==
                          RTC_INVALID_GEOMETRY_ID);
                }
                /* the answer, on the ray that the spy saw */
                local.n = 1;
                for (int m = HIT_NG; m < RAY_MEMBERS; m++)
                    local.word[m] = *rays_at(&r, (enum ray_member)m, at);
                local.word[RAY_TFAR] = *rays_at(&r, RAY_TFAR, at);
                local.before[RAY_TFAR].f = HUGE_VALF;
                if (!CHECK(world_agrees(&w, &local, 0, 1)))
                    world_show(&w, &local, 0);
            }
            rtcReleaseScene(outer);
        }
        CHECK(hits > 100);
        world_free(&w);
    }
}

/* As where an application instances scenes of its own accord: what stands in
 * the context is the hit's.  (Both Embrees tested allow one level.) */
static void the_contexts_instance_is_the_hits(void)
{
    cylint_shape shapes[SOME];
    uint64_t state = 13;
    struct rays_query query = {0};
    struct world w;
    int hits = 0;
    world_shapes(&state, SCENE_LATTICE, shapes, SOME);
    w = made(shapes, SOME, 0);
    query.instance = 9;
    for (int i = 0; i < 400; i++) {
        static const int sizes[4] = {1, 4, 8, 16};
        struct rays r;
        rays_begin(&r, sizes[i % 4]);
        for (int k = 0; k < r.n; k++)
            aim(&state, &r, k);
        rays_intersect(&r, w.scene, &query);
        agrees(&w, &r);
        for (int k = 0; k < r.n; k++) {
            hits += rays_hit(&r, k);
            CHECK(rays_at(&r, HIT_INST, k)->u ==
                  (rays_hit(&r, k) ? 9 : RTC_INVALID_GEOMETRY_ID));
        }
    }
    CHECK(hits > 100);
    world_free(&w);
}

/* --------------------------------------------------------------- motion -- */

static void moving_shapes_are_where_they_are_at_the_rays_time(void)
{
    static const float times[4] = {0, 0.25f, 0.5f, 1};
    cylint_shape shapes[SOME], moved[SOME], now[SOME];
    cylint_embree_options options = {0};
    struct world w, at;
    uint64_t state = 5;
    int hits = 0;
    world_shapes(&state, SCENE_MIXED, shapes, SOME);
    for (int i = 0; i < SOME; i++) {
        double c[3];
        for (int k = 0; k < 3; k++)
            c[k] = world_uniform(&state);
        world_shape(&state, shapes[i].kind, (cylint_ends)shapes[i].ends, c,
                    0.3, 0.05, &moved[i]);
    }
    options.moved = moved;
    if (!CHECK(world_make(&w, shapes, SOME, &options)))
        return;
    at = w;
    at.room = malloc(cylint_pack_bytes(SOME));
    for (int turn = 0; turn < 4; turn++) {
        for (int i = 0; i < SOME; i++)
            CHECK(cylint_embree_between(&shapes[i], &moved[i], times[turn],
                                        &now[i]) == CYLINT_OK);
        cylint_pack_shapes(&at.pack, at.room, now, SOME);
        at.shapes = now;
        for (int i = 0; i < 500; i++) {
            static const int sizes[4] = {1, 4, 8, 16};
            struct rays r;
            rays_begin(&r, sizes[i % 4]);
            for (int k = 0; k < r.n; k++) {
                aim(&state, &r, k);
                rays_at(&r, RAY_TIME, k)->f = times[turn];
            }
            rays_intersect(&r, w.scene, NULL);
            agrees(&at, &r);
            hits += rays_hit(&r, 0);
            memcpy(r.word, r.before, sizeof r.word);
            rays_occluded(&r, w.scene, NULL);
            for (int k = 0; k < r.n; k++)
                if (!CHECK(rays_shadowed(&r, k) == shadow_expected(&at, &r, k)))
                    world_show(&at, &r, k);
        }
    }
    CHECK(hits > 100);
    free(at.room);
    world_free(&w);
}

/* The numbers given to the constructors are what moves. */
static void between_moves_the_constructors_numbers(void)
{
    const double p[2][3] = {{0, 0, 0}, {1, 2, 4}}, q[2][3] = {{0, 0, 2},
                                                              {8, 2, 4}};
    double pm[3], qm[3], km = 0.5 * (0.75 + 0.25), x[3] = {1, 0, 0},
        y[3] = {0, 3, 0}, z[3] = {0, 1, 5};
    cylint_shape a, b, half, expected;
    for (int k = 0; k < 3; k++) {
        pm[k] = 0.5 * (p[0][k] + p[1][k]);
        qm[k] = 0.5 * (q[0][k] + q[1][k]);
    }
#define HALF(MAKE_A, MAKE_B, MAKE_EXPECTED) \
    CHECK(!(MAKE_A) && !(MAKE_B) && !(MAKE_EXPECTED)); \
    memset(&half, 0, sizeof half); \
    CHECK(cylint_embree_between(&a, &b, 0.5, &half) == CYLINT_OK); \
    CHECK(memcmp(&half, &expected, sizeof half) == 0); \
    CHECK(cylint_embree_between(&a, &b, 0, &half) == CYLINT_OK); \
    CHECK(memcmp(&half, &a, sizeof half) == 0); \
    CHECK(cylint_embree_between(&a, &b, 1, &half) == CYLINT_OK); \
    CHECK(memcmp(&half, &b, sizeof half) == 0)
    memset(&a, 0, sizeof a);
    memset(&b, 0, sizeof b);
    memset(&expected, 0, sizeof expected);
    HALF(cylint_cylinder(&a, p[0], q[0], 1, CYLINT_OPEN),
         cylint_cylinder(&b, p[1], q[1], 2, CYLINT_OPEN),
         cylint_cylinder(&expected, pm, qm, 1.5, CYLINT_OPEN));
    HALF(cylint_cone(&a, p[0], 1, q[0], 0, CYLINT_CAP_0),
         cylint_cone(&b, p[1], 3, q[1], 0.5, CYLINT_CAP_0),
         cylint_cone(&expected, pm, 2, qm, 0.25, CYLINT_CAP_0));
    HALF(cylint_tangent_cone(&a, p[0], q[0], 1, CYLINT_CAPPED),
         cylint_tangent_cone(&b, p[1], q[1], 0.25, CYLINT_CAPPED),
         cylint_tangent_cone(&expected, pm, qm, 0.625, CYLINT_CAPPED));
    HALF(cylint_elliptic_cylinder(&a, p[0], x, y, q[0], CYLINT_CAPPED),
         cylint_elliptic_cylinder(&b, p[1], x, y, z, CYLINT_CAPPED),
         (z[1] = 0.5, z[2] = 3.5,
          cylint_elliptic_cylinder(&expected, pm, x, y, z, CYLINT_CAPPED)));
    z[1] = 1, z[2] = 5;
    HALF(cylint_elliptic_cone(&a, p[0], x, y, q[0], 0.75, CYLINT_CAPPED),
         cylint_elliptic_cone(&b, p[1], x, y, z, 0.25, CYLINT_CAPPED),
         (z[1] = 0.5, z[2] = 3.5, cylint_elliptic_cone(&expected, pm, x, y,
                                             z, km, CYLINT_CAPPED)));
#undef HALF
    /* an axis that vanishes half way */
    cylint_cylinder(&a, p[0], q[0], 1, CYLINT_CAPPED);
    cylint_cylinder(&b, q[0], p[0], 1, CYLINT_CAPPED);
    CHECK(cylint_embree_between(&a, &b, 0.5, &half) == CYLINT_EAXIS);
    CHECK(half.kind == CYLINT_KIND_NONE);
}

/* --------------------------------------------------------------- update -- */

static void ask_some(struct world *w, uint64_t *state)
{
    for (int i = 0; i < 100; i++) {
        struct rays r;
        rays_begin(&r, 4);
        for (int k = 0; k < 4; k++)
            aim(state, &r, k);
        rays_intersect(&r, w->scene, NULL);
        agrees(w, &r);
    }
}

static void an_update_takes_over_what_was_changed(void)
{
    cylint_shape shapes[SOME], kept;
    uint64_t state = 6;
    for (int how = 0; how < 2; how++) {
        struct world w;
        long long bytes;
        world_shapes(&state, SCENE_THIN, shapes, SOME);
        w = made(shapes, SOME, both_ways[how]);
        ask_some(&w, &state);
        bytes = world_memory.bytes;
        for (int kind = SCENE_THIN; kind <= SCENE_MIXED; kind++) {
            world_shapes(&state, kind, shapes, SOME);
            CHECK(cylint_embree_update(w.geometry, &w.problem) ==
                  CYLINT_EMBREE_OK);
            rtcCommitScene(w.scene);
            cylint_pack_shapes(&w.pack, w.room, shapes, SOME);
            ask_some(&w, &state);
        }
        /* what a first scene took is enough for the last */
        world_shapes(&state, SCENE_THIN, shapes, SOME);
        for (int i = 0; i < 50; i++)
            CHECK(cylint_embree_update(w.geometry, NULL) == CYLINT_EMBREE_OK);
        rtcCommitScene(w.scene);
        CHECK(world_memory.bytes < 2 * bytes);
        /* a shape that cannot be taken over, and then one that can */
        kept = shapes[17];
        cylint_cylinder(&shapes[17], kept.base, kept.base, 1, CYLINT_CAPPED);
        world_errors();
        CHECK(cylint_embree_update(w.geometry, &w.problem) ==
              CYLINT_EMBREE_ESHAPE);
        CHECK(w.problem.status == CYLINT_EMBREE_ESHAPE &&
              w.problem.shape == 17);
        CHECK(world_errors() == 1 &&
              world_last_error() == RTC_ERROR_INVALID_ARGUMENT);
        shapes[17] = kept;
        CHECK(cylint_embree_update(w.geometry, &w.problem) ==
              CYLINT_EMBREE_OK);
        rtcCommitScene(w.scene);
        cylint_pack_shapes(&w.pack, w.room, shapes, SOME);
        ask_some(&w, &state);
        world_free(&w);
    }
}

/* --------------------------------------------------------------- bounds -- */

/* Embree's box of the shapes holds them, and is wider only by what the header
 * says and a rounding to float. */
static void the_scenes_box_is_that_of_the_shapes_and_a_little(void)
{
    cylint_shape shapes[SOME];
    uint64_t state = 7;
    for (int how = 0; how < 2; how++)
    for (int kind = SCENE_THIN; kind <= SCENE_MIXED; kind++)
    for (int n = 1; n <= SOME; n += 33) {
        double lo[3], hi[3], least[3], most[3];
        double size = 0, most_of_all = 0;
        struct RTCBounds box;
        const float *lower = &box.lower_x, *upper = &box.upper_x;
        struct world w;
        world_shapes(&state, kind, shapes, (size_t)n);
        w = made(shapes, (size_t)n, both_ways[how]);
        for (int i = 0; i < n; i++) {
            cylint_bounds(&shapes[i], lo, hi);
            for (int k = 0; k < 3; k++) {
                least[k] = i && least[k] < lo[k] ? least[k] : lo[k];
                most[k] = i && most[k] > hi[k] ? most[k] : hi[k];
            }
        }
        for (int k = 0; k < 3; k++) {
            size = fmax(size, most[k] - least[k]);
            most_of_all = fmax(most_of_all, fmax(-least[k], most[k]));
        }
        rtcGetSceneBounds(w.scene, &box);
        for (int k = 0; k < 3; k++) {
            const double pad = size * 0x1.1p-19 + 0x1.1p-23 * most_of_all;
            CHECK(lower[k] < least[k] && lower[k] >=
                  -nextafterf(world_float_above(pad - least[k]), HUGE_VALF));
            CHECK(upper[k] > most[k] && upper[k] <=
                  nextafterf(world_float_above(pad + most[k]), HUGE_VALF));
        }
        world_free(&w);
    }
}

static void no_shapes_are_a_scene_that_nothing_hits(void)
{
    const float o[3] = {0, 0, 0}, d[3] = {0, 0, 1};
    for (int how = 0; how < 2; how++) {
        struct world w = made(NULL, 0, both_ways[how]);
        struct RTCBounds box;
        for (int n = 1; n <= 16; n = n == 1 ? 4 : 2 * n) {
            struct rays r;
            rays_begin(&r, n);
            rays_add(&r, 0, o, d, 0, HUGE_VALF);
            rays_intersect(&r, w.scene, NULL);
            agrees(&w, &r);
        }
        rtcGetSceneBounds(w.scene, &box);
        CHECK(box.lower_x > box.upper_x);
        CHECK(cylint_embree_update(w.geometry, NULL) == CYLINT_EMBREE_OK);
        world_free(&w);
    }
    CHECK(world_errors() == 0);
}

/* -------------------------------------------------------------- refusal -- */

enum { ROW = 30 };

/* Makes a geometry of ROW shapes, of which `first` and the last are bad. */
static void refused(const cylint_shape *bad, size_t first, int status)
{
    cylint_shape shapes[ROW];
    uint64_t state = 8;
    world_shapes(&state, SCENE_FAT, shapes, ROW);
    shapes[first] = shapes[ROW - 1] = *bad;
    for (int how = 0; how < 2; how++) {
        const cylint_embree_options options = options_for(both_ways[how]);
        cylint_embree_problem problem = {0, 0};
        const long long bytes = world_memory.bytes;
        world_errors();
        CHECK(!cylint_embree_geometry(world_device(), shapes, ROW, &options,
                                      &problem));
        CHECK(problem.status == status && problem.shape == first);
        CHECK(world_errors() == 1 &&
              world_last_error() == RTC_ERROR_INVALID_ARGUMENT);
        CHECK(world_memory.bytes == bytes);
        CHECK(!cylint_embree_geometry(world_device(), shapes, ROW, &options,
                                      NULL));
        world_errors();
    }
}

static void what_embree_would_drop_is_refused_by_number(void)
{
    const double p0[3] = {0, 0, 0}, p1[3] = {0, 0, 1};
    double far[3] = {0, 0, 1.9e18}, near[3] = {0, 0, 1.8e18},
        nan[3] = {0, 0, NAN};
    cylint_shape shape;
    CHECK(cylint_cylinder(&shape, p0, nan, 1, CYLINT_CAPPED));
    refused(&shape, 0, CYLINT_EMBREE_ESHAPE);
    CHECK(cylint_cylinder(&shape, p0, p0, 1, CYLINT_CAPPED));
    refused(&shape, 7, CYLINT_EMBREE_ESHAPE);
    CHECK(!cylint_cylinder(&shape, p0, p1, 1, CYLINT_INFINITE));
    refused(&shape, 8, CYLINT_EMBREE_ESHAPE);
    CHECK(!cylint_angle_cone(&shape, p0, p1, 30, CYLINT_NAPPE));
    refused(&shape, 9, CYLINT_EMBREE_ESHAPE);
    CHECK(!cylint_cylinder(&shape, p0, far, 1, CYLINT_CAPPED));
    refused(&shape, 15, CYLINT_EMBREE_ESHAPE);
    CHECK(!cylint_cylinder(&shape, p0, p1, 1e300, CYLINT_CAPPED));
    refused(&shape, 16, CYLINT_EMBREE_ESHAPE);
    /* and within the limit it is found */
    CHECK(!cylint_cylinder(&shape, p0, near, 1e17, CYLINT_CAPPED));
    for (int how = 0; how < 2; how++) {
        const float o[3] = {0, 1e16f, -1e18f}, d[3] = {0, 0, 1};
        struct world w = made(&shape, 1, both_ways[how]);
        struct rays r;
        rays_begin(&r, 1);
        rays_add(&r, 0, o, d, 0, HUGE_VALF);
        rays_intersect(&r, w.scene, NULL);
        agrees(&w, &r);
        CHECK(rays_hit(&r, 0));
        world_free(&w);
    }
}

static void motion_that_makes_no_sense_is_refused_by_number(void)
{
    cylint_shape shapes[ROW], moved[ROW];
    cylint_embree_options options = {0};
    cylint_embree_problem problem;
    const long long bytes = world_memory.bytes;
    const double p0[3] = {0, 0, 0}, p1[3] = {1, 0, 0}, p2[3] = {0, 1, 0},
        p3[3] = {0, 0, 1};
    uint64_t state = 9;
    world_shapes(&state, SCENE_FAT, shapes, ROW);
    memcpy(moved, shapes, sizeof moved);
    options.moved = moved;
    cylint_cylinder(&moved[11], p0, p1, 1, CYLINT_OPEN); /* other ends */
    cylint_elliptic_cylinder(&moved[12], p0, p1, p2, p3, CYLINT_CAPPED);
    for (int i = 11; i <= 12; i++) {
        world_errors();
        CHECK(!cylint_embree_geometry(world_device(), shapes, ROW, &options,
                                      &problem));
        CHECK(problem.status == CYLINT_EMBREE_EMOTION &&
              problem.shape == (size_t)i);
        CHECK(world_errors() == 1 &&
              world_last_error() == RTC_ERROR_INVALID_ARGUMENT);
        moved[i] = shapes[i];
    }
    cylint_cylinder(&moved[13], p0, p0, 1, CYLINT_CAPPED);
    CHECK(!cylint_embree_geometry(world_device(), shapes, ROW, &options,
                                  &problem));
    CHECK(problem.status == CYLINT_EMBREE_ESHAPE && problem.shape == 13);
    CHECK(world_memory.bytes == bytes);
    world_errors();
}

static void every_status_has_its_text(void)
{
    for (int s = CYLINT_EMBREE_OK; s <= CYLINT_EMBREE_EVERSION; s++)
        for (int t = CYLINT_EMBREE_OK; t < s; t++)
            CHECK(strcmp(cylint_embree_strerror(s),
                         cylint_embree_strerror(t)) != 0);
    CHECK(cylint_embree_strerror(-1) && cylint_embree_strerror(99));
    CHECK(cylint_embree_version() == RTC_VERSION_MAJOR);
}

/* ------------------------------------------------------------ bare hits -- */

static void bare_hits_are_completed_later(void)
{
    cylint_shape shapes[SOME];
    uint64_t state = 10;
    int hits = 0;
    world_shapes(&state, SCENE_MIXED, shapes, SOME);
    for (int how = 0; how < 2; how++) {
        struct world w = made(shapes, SOME,
                              both_ways[how] | CYLINT_EMBREE_BARE);
        for (int i = 0; i < 500; i++) {
            struct rays r;
            rays_begin(&r, 1);
            aim(&state, &r, 0);
            rays_intersect(&r, w.scene, NULL);
            for (int m = HIT_NG; m <= HIT_V; m++)
                CHECK(r.word[m].u == r.before[m].u);
            if (!CHECK(world_agrees(&w, &r, 0, 0)))
                world_show(&w, &r, 0);
            if (!rays_hit(&r, 0))
                continue;
            cylint_embree_complete(w.geometry,
                                   (struct RTCRayHit *)(void *)r.word);
            agrees(&w, &r);
            hits++;
        }
        world_free(&w);
    }
    CHECK(hits > 100);
}

int main(void)
{
    RUN(every_kind_with_all_caps_answers_as_the_library);
    RUN(packets_answer_and_leave_other_lanes_alone);
    RUN(a_ray_that_starts_inside_hits_where_it_leaves);
    RUN(the_domain_holds_its_ends);
    RUN(a_ray_within_a_face_of_the_box_is_not_lost);
    RUN(a_ray_without_direction_hits_nothing);
    RUN(masks_choose_who_is_seen);
    RUN(equal_and_nearly_equal_hits_are_told_apart);
    RUN(equal_hits_of_moving_shapes_are_told_apart);
    RUN(a_whole_turn_is_not_reached);
    RUN(instances_answer_for_the_transformed_ray);
    RUN(the_contexts_instance_is_the_hits);
    RUN(moving_shapes_are_where_they_are_at_the_rays_time);
    RUN(between_moves_the_constructors_numbers);
    RUN(an_update_takes_over_what_was_changed);
    RUN(the_scenes_box_is_that_of_the_shapes_and_a_little);
    RUN(no_shapes_are_a_scene_that_nothing_hits);
    RUN(what_embree_would_drop_is_refused_by_number);
    RUN(motion_that_makes_no_sense_is_refused_by_number);
    RUN(every_status_has_its_text);
    RUN(bare_hits_are_completed_later);
    return check_end();
}
