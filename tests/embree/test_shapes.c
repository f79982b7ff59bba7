/*
 * test_shapes.c - shapes of a geometry move, change, have a box, or are refused
 * with their number
 */
#include <fenv.h>
#include <math.h>
#include <string.h>

#include "embree_world.h"
#include "shapes/layout.h"

/* --------------------------------------------------------------- motion -- */

/* Traces SOME shapes that move, with packets and rays of four times that a
 * function draws, beside the library's shapes of those times.  Returns the number
 * of hits. */
static int trace_moving(const cylint_shape *shapes, const cylint_shape *moved,
                        void (*draw)(struct rays *, int n))
{
    static const float times[4] = {0, 0.25f, 0.5f, 1};
    cylint_shape now[SOME];
    OWN_WORLD w =
        world_made(shapes, SOME, &(cylint_embree_options){.moved = moved});
    struct world at = w; /* its shapes are those of the time */
    int hits = 0;
    at.shapes = now;
    for (int turn = 0; turn < 4; turn++) {
        for (int i = 0; i < SOME; i++)
            CHECK(cylint_embree_between(&shapes[i], &moved[i], times[turn],
                                        &now[i]) == CYLINT_OK);
        cylint_pack_shapes(&at.pack, w.pack_memory, now, SOME);
        for (int i = 0; i < 500; i++) {
            struct rays r;
            draw(&r, rays_sizes[i % 4]);
            for (int k = 0; k < r.n; k++)
                rays_at(&r, RAY_TIME, k)->f = times[turn];
            hits += check_both_queries(&at, &r, NULL);
        }
    }
    return hits;
}

TEST(moving_shapes_are_hit_where_they_are_at_the_rays_time)
{
    cylint_shape shapes[SOME], moved[SOME];
    world_shapes(SCENE_MIXED, shapes, SOME);
    for (int i = 0; i < SOME; i++)
        moved[i] = any_shape(shapes[i].kind, (cylint_ends)shapes[i].ends);
    CHECK(trace_moving(shapes, moved, aim_all) > 100);
}

/* Round cones that are two balls about one centre at time 0: of these the larger
 * one is hit. */
TEST(a_ball_that_becomes_a_round_cone_is_hit_where_it_is)
{
    cylint_shape shapes[SOME], moved[SOME];
    for (int i = 0; i < SOME; i++) {
        const double radius[3] = {0.25, 0.5, 0.25};
        double c[3], top[3];
        float d[3];
        world_direction(d);
        for (int k = 0; k < 3; k++) {
            c[k] = cbrt(SOME) * between(-0.5, 0.5);
            top[k] = c[k] + 2 * (double)d[k];
        }
        CHECK(!cylint_round_cone(&shapes[i], c, radius[i % 2], c,
                                 radius[i % 2 + 1], CYLINT_ENDS_CAPPED) &&
              !cylint_round_cone(&moved[i], c, 0.5, top, radius[i % 2 + 1],
                                 CYLINT_ENDS_CAPPED));
    }
    CHECK(trace_moving(shapes, moved, aim_all) > 100);
}

static void draw_upward(struct rays *r, int n)
{
    const float o[3] = {0.0625f, 0.125f, -8}, d[3] = {0, 0, 1};
    rays_begin(r, n);
    for (int i = 0; i < n; i++)
        rays_add(r, i, o, d, 0, HUGE_VALF);
}

/* At time 1/2 all hits are equal. */
TEST(of_equal_hits_of_moving_shapes_the_lowest_number_is_reported)
{
    cylint_shape shapes[SOME], moved[SOME];
    for (int i = 0; i < SOME; i++) {
        const double z = i % 7 - 3, r = 1 + 0.125 * (i * 17 % 40);
        cylint_cylinder(&shapes[i], (double[]){0, 0, z},
                        (double[]){0, 0, z + 4}, r, CYLINT_ENDS_CAPPED);
        cylint_cylinder(&moved[i], (double[]){0, 0, -z},
                        (double[]){0, 0, 4 - z}, r, CYLINT_ENDS_CAPPED);
    }
    CHECK(trace_moving(shapes, moved, draw_upward) > 2000);
}

/* Embree flushes the distance to zero when it builds: the box must have room. */
TEST(a_move_by_a_subnormal_distance_is_followed)
{
    const cylint_shape other = shape_of("sphere 0 -0x1p-125 0  0x1p-130");
    const cylint_shape shapes[2] = {shape_of("sphere 0 0x1p-125 0  0x1p-130"),
                                    other};
    const cylint_shape moved[2] = {shape_of("sphere 0 0x1.4p-125 0  0x1p-130"),
                                   other};
    const float o[3] = {-0x1p-125f, 0x1.4p-125f, 0}, d[3] = {0x1p-20f, 0, 0};
    const cylint_embree_options options = {.moved = moved};
    OWN_WORLD w = world_made(shapes, 2, &options);
    EACH_SIZE(n) {
        struct rays ray;
        rays_begin(&ray, n);
        rays_add(&ray, n - 1, o, d, 0, HUGE_VALF);
        rays_at(&ray, RAY_TIME, n - 1)->f = 1;
        rays_intersect(&ray, w.scene, NULL);
        CHECK(rays_hit(&ray, n - 1));
    }
}

static void check_halfway(cylint_shape a, cylint_shape b, cylint_shape expected)
{
    cylint_shape between;
    const cylint_shape *const at[3] = {&a, &expected, &b};
    for (int i = 0; i < 3; i++) {
        memset(&between, 0, sizeof between); /* members that no kind has */
        CHECK(cylint_embree_between(&a, &b, i / 2., &between) == CYLINT_OK);
        CHECK(memcmp(&between, at[i], sizeof between) == 0);
    }
}

/* The numbers given to the constructors change linearly: the third shape is halfway
 * between the others. */
TEST(between_moves_the_constructors_numbers)
{
    static const char *const moves[][3] = {
        {"cylinder 0 0 0  0 0 2  1 ends=open",
         "cylinder 1 2 4  8 2 4  2 ends=open",
         "cylinder 0.5 1 2  4 1 3  1.5 ends=open"},
        {"cone 0 0 0 1  0 0 2 0 ends=cap0", "cone 1 2 4 3  8 2 4 0.5 ends=cap0",
         "cone 0.5 1 2 2  4 1 3 0.25 ends=cap0"},
        {"ecylinder 0 0 0  1 0 0  0 3 0  0 0 2",
         "ecylinder 1 2 4  1 0 0  0 3 0  0 1 5",
         "ecylinder 0.5 1 2  1 0 0  0 3 0  0 0.5 3.5"},
        {"econe 0 0 0  1 0 0  0 3 0  0 0 2  0.75",
         "econe 1 2 4  1 0 0  0 3 0  0 1 5  0.25",
         "econe 0.5 1 2  1 0 0  0 3 0  0 0.5 3.5  0.5"},
        {"capsule 0 0 0  0 0 2  1 ends=open",
         "rcone 1 2 4 2  8 2 4 1 ends=open",
         "rcone 0.5 1 2 1.5  4 1 3 1 ends=open"},
        {"sphere 0 0 0  1", "sphere 1 2 4  3", "sphere 0.5 1 2  2"},
        /* the second ball holds the other at time 0: the ends are exchanged */
        {"rcone 0 0 0 1  0 0 2 99", "rcone 1 2 4 0.5  8 2 4 0.25",
         "rcone 0.5 1 2 0.75  4 1 3 49.625"}};
    static const double v[3][3] = {{0, 0, 0}, {1, 2, 4}, {0.5, 1, 2}},
                        u[3][3] = {{0, 0, 2}, {8, 2, 4}, {4, 1, 3}};
    static const double tangent[3] = {1, 0.25, 0.625};
    cylint_shape cone[3], half;
    for (size_t i = 0; i < sizeof moves / sizeof *moves; i++)
        check_halfway(shape_of(moves[i][0]), shape_of(moves[i][1]),
                      shape_of(moves[i][2]));
    memset(cone, 0, sizeof cone);
    for (int i = 0; i < 3; i++)
        CHECK(!cylint_tangent_cone(&cone[i], v[i], u[i], tangent[i],
                                   CYLINT_ENDS_CAPPED));
    check_halfway(cone[0], cone[1], cone[2]);
    const cylint_shape ball = shape_of("sphere 0 0 0  1");
    CHECK(cylint_embree_between(&ball, &ball, 0.5, &half) == CYLINT_OK &&
          cylint_surface(&half) == CYLINT_PART_LATERAL);
    /* an axis that vanishes at time 1/2 */
    const cylint_shape there = shape_of("cylinder 0 0 0  0 0 2  1"),
                       back = shape_of("cylinder 0 0 2  0 0 0  1");
    CHECK(cylint_embree_between(&there, &back, 0.5, &half) == CYLINT_EAXIS);
    CHECK(half.kind == CYLINT_KIND_NONE);
}

/* --------------------------------------------------------------- update -- */

TEST(an_update_reads_the_changed_shapes)
{
    cylint_shape shapes[SOME];
    for (int how = 0; how < 2; how++) {
        cylint_embree_problem problem;
        world_shapes(SCENE_THIN, shapes, SOME);
        OWN_WORLD w = world_with(shapes, SOME, both_ways[how]);
        check_some_rays(&w);
        const long long bytes = world_memory.bytes;
        for (int kind = SCENE_THIN; kind <= SCENE_MIXED; kind++) {
            world_shapes(kind, shapes, SOME);
            CHECK(world_update(&w) == CYLINT_EMBREE_OK);
            check_some_rays(&w);
        }
        /* a later scene needs no more memory than the first */
        world_shapes(SCENE_THIN, shapes, SOME);
        for (int i = 0; i < 50; i++)
            CHECK(world_update(&w) == CYLINT_EMBREE_OK);
        CHECK(world_memory.bytes < 2 * bytes);
        /* a shape that is refused, and then one that is not */
        const cylint_shape kept = shapes[17];
        cylint_cylinder(&shapes[17], cylint_base(&kept), cylint_base(&kept), 1,
                        CYLINT_ENDS_CAPPED);
        world_errors();
        CHECK(cylint_embree_update(w.geometry, &problem) ==
              CYLINT_EMBREE_ESHAPE);
        CHECK(world_refused(&problem, CYLINT_EMBREE_ESHAPE, 17));
        shapes[17] = kept;
        CHECK(world_update(&w) == CYLINT_EMBREE_OK);
        check_some_rays(&w);
    }
}

/* --------------------------------------------------------------- bounds -- */

/* Embree's box contains the shapes; it is wider only by the padding that the
 * header states and a rounding to float. */
TEST(the_scenes_box_is_the_padded_box_of_the_shapes)
{
    static const double per_size[2] = {0x1p-9, 0x1p-19}; /* of both_ways */
    for (int kind = SCENE_THIN; kind <= SCENE_MIXED; kind++)
        for (int n = 1; n <= SOME; n += 33) {
            OWN_SHAPES s =
                scene_generate(kind, (size_t)n, random_bits(&stream));
            double largest = 0;
            for (int k = 0; k < 3; k++)
                largest = fmax(largest, fmax(-s.lo[k], s.hi[k]));
            EACH_WAY(w, s.shapes, s.n) {
                const double pad =
                    longest_side(&s) * per_size[way] + 0x1p-23 * largest;
                const double more = 0x1.1p0 * pad;
                struct RTCBounds box;
                const float *lower = &box.lower_x, *upper = &box.upper_x;
                rtcGetSceneBounds(w.scene, &box);
                for (int k = 0; k < 3; k++) {
                    const float least = world_float_above(more - s.lo[k]);
                    const float most = world_float_above(more + s.hi[k]);
                    CHECK(lower[k] <= s.lo[k] - pad &&
                          lower[k] >= -nextafterf(least, HUGE_VALF));
                    CHECK(upper[k] >= s.hi[k] + pad &&
                          upper[k] <= nextafterf(most, HUGE_VALF));
                }
            }
        }
}

TEST(a_geometry_without_shapes_is_never_hit)
{
    const float o[3] = {0, 0, 0}, d[3] = {0, 0, 1};
    EACH_WAY(w, NULL, 0) {
        struct RTCBounds box;
        EACH_SIZE(n)
            traced(&w, n, o, d, 0, HUGE_VALF);
        rtcGetSceneBounds(w.scene, &box);
        CHECK(box.lower_x > box.upper_x);
        CHECK(cylint_embree_update(w.geometry, NULL) == CYLINT_EMBREE_OK);
    }
    CHECK(world_errors() == 0);
}

/* -------------------------------------------------------------- refusal -- */

enum { ROW = 30 };

/* Checks that no geometry is made of ROW shapes, for the reason of this number. */
static void refused(const cylint_shape *shapes, unsigned flags,
                    const cylint_shape *moved, int status, size_t number)
{
    const cylint_embree_options options = {.flags = flags, .moved = moved};
    cylint_embree_problem problem = {0, 0};
    const long long bytes = world_memory.bytes;
    CHECK(!cylint_embree_geometry(world_device(), shapes, ROW, &options, NULL));
    world_errors();
    CHECK(!cylint_embree_geometry(world_device(), shapes, ROW, &options,
                                  &problem));
    CHECK(world_refused(&problem, status, number));
    CHECK(world_memory.bytes == bytes);
}

TEST(shapes_that_embree_would_drop_are_refused_by_number)
{
    static const struct {
        size_t first;
        const char *shape;
    } bad[] = {{0, "cylinder 0 0 0  0 0 nan  1"},
               {7, "cylinder 0 0 0  0 0 0  1"},
               {8, "cylinder 0 0 0  0 0 1  1 ends=infinite"},
               {9, "acone 0 0 0  0 0 1  30 ends=nappe"},
               {10, "halfspace 0 0 0  0 0 1"},
               {15, "cylinder 0 0 0  0 0 1.9e18  1"},
               {16, "cylinder 0 0 0  0 0 1  1e300"}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct family_case c;
        CHECK(family_parse_any(bad[i].shape, &c));
        CHECK((c.shape_status == CYLINT_OK) == (i > 1));
        cylint_shape shapes[ROW]; /* two are bad */
        world_shapes(SCENE_FAT, shapes, ROW);
        shapes[bad[i].first] = shapes[ROW - 1] = c.shape;
        for (int how = 0; how < 2; how++)
            refused(shapes, both_ways[how], NULL, CYLINT_EMBREE_ESHAPE,
                    bad[i].first);
    }
    /* a shape within the limit is hit */
    const cylint_shape shape = shape_of("cylinder 0 0 0  0 0 1.8e18  1e17");
    EACH_WAY(w, &shape, 1) {
        const float o[3] = {0, 1e16f, -1e18f}, d[3] = {0, 0, 1};
        struct rays r = traced(&w, 1, o, d, 0, HUGE_VALF);
        CHECK(rays_hit(&r, 0));
    }
}

TEST(impossible_motion_is_refused_by_number)
{
    cylint_shape shapes[ROW], moved[ROW];
    const cylint_embree_options options = {.moved = moved};
    cylint_embree_problem problem;
    const double p[3] = {0, 0, 0};
    world_shapes(SCENE_FAT, shapes, ROW);
    shapes[11] = shape_of("cylinder 0 0 0  1 0 0  1");
    shapes[13] = shape_of("rcone 0 0 0 3  0 0 1 1"); /* one ball */
    memcpy(moved, shapes, sizeof moved);
    moved[11] = shape_of("cylinder 0 0 0  1 0 0  1 ends=open"); /* other ends */
    moved[12] = shape_of("ecylinder 0 0 0  1 0 0  0 1 0  0 0 1");
    moved[13] = shape_of("sphere 0 0 0  3");
    for (size_t i = 11; i <= 13; i++) {
        refused(shapes, 0, moved, CYLINT_EMBREE_EMOTION, i);
        moved[i] = shapes[i];
    }
    moved[13] = shape_of("capsule 0 0 0  0 0 1  1");
    RTCGeometry possible =
        cylint_embree_geometry(world_device(), shapes, ROW, &options, &problem);
    CHECK(possible && problem.status == CYLINT_EMBREE_OK);
    cylint_embree_release(possible);
    cylint_cylinder(&moved[13], p, p, 1, CYLINT_ENDS_CAPPED);
    refused(shapes, 0, moved, CYLINT_EMBREE_ESHAPE, 13);
}

#ifdef WRAPPED

#include "started_threads.h"

/* More shapes than a thread takes at once: see CYLINT_THREADS_LEAST_SHAPES. */
TEST(the_default_is_one_thread)
{
    enum { MANY = 21000 };
    static cylint_shape shapes[MANY];
    world_shapes(SCENE_FIBRES, shapes, MANY);
    threads_started = 0;
    OWN_WORLD w = world_with(shapes, MANY, 0);
    CHECK(world_update(&w) == CYLINT_EMBREE_OK);
    CHECK(threads_started == 0);
}

/* What the device does not have: the version of the adapter, or geometries. */
static enum { NOTHING, VERSION, GEOMETRIES } lacks;

ssize_t __real_rtcGetDeviceProperty(RTCDevice, enum RTCDeviceProperty);
ssize_t __wrap_rtcGetDeviceProperty(RTCDevice, enum RTCDeviceProperty);
RTCGeometry __real_rtcNewGeometry(RTCDevice, enum RTCGeometryType);
RTCGeometry __wrap_rtcNewGeometry(RTCDevice, enum RTCGeometryType);

ssize_t __wrap_rtcGetDeviceProperty(RTCDevice device,
                                    enum RTCDeviceProperty property)
{
    return lacks == VERSION && property == RTC_DEVICE_PROPERTY_VERSION_MAJOR
               ? 7 - RTC_VERSION_MAJOR
               : __real_rtcGetDeviceProperty(device, property);
}

RTCGeometry __wrap_rtcNewGeometry(RTCDevice device, enum RTCGeometryType type)
{
    return lacks == GEOMETRIES ? NULL : __real_rtcNewGeometry(device, type);
}

TEST(a_device_of_another_version_or_without_geometries_has_its_status)
{
    static const int status[] = {CYLINT_EMBREE_OK, CYLINT_EMBREE_EVERSION,
                                 CYLINT_EMBREE_EDEVICE};
    const cylint_shape ball = shape_of("sphere 0 0 0  1");
    RTCDevice device = world_device();
    for (int i = 0; i < 3; i++) {
        cylint_embree_problem problem = {-1, 0};
        lacks = i;
        RTCGeometry made =
            cylint_embree_geometry(device, &ball, 1, NULL, &problem);
        CHECK(problem.status == status[i] && (made != NULL) == (i == NOTHING));
        cylint_embree_release(made);
    }
    lacks = NOTHING;
}

#endif

/* Enough shapes for five threads to make and update the geometry. */
TEST(five_threads_make_a_geometry_that_answers_the_same)
{
    enum { MANY = 21000 };
    static cylint_shape shapes[MANY];
    const long long bytes = world_memory.bytes;
    const cylint_embree_options options = {.threads = 5};
    world_shapes(SCENE_FIBRES, shapes, MANY);
    struct world one = world_with(shapes, MANY, 0);
    struct world five = world_made(shapes, MANY, &options);
    CHECK(cylint_embree_bytes(one.geometry) ==
          cylint_embree_bytes(five.geometry));
    CHECK(world_update(&five) == CYLINT_EMBREE_OK);
    check_some_rays(&five);
    world_free(&one);
    world_free(&five);
    CHECK(world_memory.bytes == bytes);
}

/* An axis along a coordinate, and one of which two coordinates nearly are equal. */
TEST(answers_do_not_depend_on_the_rounding_mode)
{
    static const int modes[3] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    const cylint_shape shapes[2] = {
        shape_of("cylinder 0 0 0  0 0 2  1"),
        shape_of("cylinder -0x1p-54 0x1p-53 0  1 -1 5  1")};
    EACH_WAY(w, shapes, 2)
        for (int m = 0; m < 3; m++) {
            fesetround(modes[m]); /* also that of the expected floats */
            check_some_rays(&w);
            fesetround(FE_TONEAREST);
        }
}

TEST(every_status_has_its_text)
{
    static const char *const texts[] = {
        [CYLINT_EMBREE_OK] = "no error",
        [CYLINT_EMBREE_ESHAPE] = ("a shape is invalid, unbounded, or has a "
                                  "coordinate of 1.844e18 or more"),
        [CYLINT_EMBREE_EMOTION] =
            "the two states of a shape differ in kind or ends",
        [CYLINT_EMBREE_EMEMORY] = "out of memory",
        [CYLINT_EMBREE_EDEVICE] = "the Embree device made no geometry",
        [CYLINT_EMBREE_EVERSION] = "the device is of another version of Embree",
        [CYLINT_EMBREE_EPART] = "the geometry numbers of merged parts are "
                                "invalid or do not ascend"};
    check_texts(cylint_embree_strerror, texts, sizeof texts / sizeof *texts);
    CHECK(cylint_embree_version() == RTC_VERSION_MAJOR);
}
