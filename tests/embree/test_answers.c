/*
 * test_answers.c - the adapter answers float rays as the library does
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "bvh/float_bounds.h"
#include "embree_world.h"
#include "environment.h"
#include "shapes/layout.h"

/* ------------------------------------------------------- single answers -- */

/* A ray that begins at the floats of cylint_embree(3), Rays that leave a hit. */
static cylint_line leaving(const cylint_hit *hit)
{
    double o[3], d[3], most = 0, dn = 0;
    cylint_line line;
    random_direction(d);
    for (int k = 0; k < 3; k++) {
        most = cylint_larger(most, fabs(hit->point[k]));
        dn += d[k] * hit->normal[k];
    }
    for (int k = 0; k < 3; k++) {
        const volatile float f =
            (float)(hit->point[k] +
                    (double)FLT_EPSILON * most * hit->normal[k]);
        o[k] = f;
        d[k] = (float)(dn < 0 ? -d[k] : d[k]);
    }
    CHECK(cylint_ray(&line, o, d) == CYLINT_OK);
    return line;
}

TEST(a_ray_that_leaves_a_hit_at_the_floats_of_the_manual_misses_the_shape)
{
    int hits = 0;
    for (int i = 0; i < 20000; i++) {
        const cylint_shape shape =
            any_shape(CYLINT_KIND_CYLINDER + i % 8, (cylint_ends)(i / 8 % 4));
        double lo[3], hi[3], o[3], d[3];
        cylint_line line;
        cylint_answer answer;
        cylint_bounds(&shape, lo, hi);
        random_direction(d);
        for (int k = 0; k < 3; k++)
            o[k] = between(lo[k], hi[k]);
        cylint_whole_line(&line, o, d);
        cylint_intersect(&shape, &line, CYLINT_WANT_ALL, &answer);
        hits += answer.n;
        for (int k = 0; k < answer.n; k++) {
            const cylint_line ray = leaving(&answer.hit[k]);
            CHECK(cylint_contains(&shape, ray.o) < 0 &&
                  !cylint_occluded(&shape, &ray));
        }
    }
    CHECK(hits > 20000);
}

/* Ends of the domain, on the hit itself and one float beside it. */
TEST(the_domain_holds_its_ends)
{
    const cylint_shape shape = shape_of("cylinder 0 0 0  0 0 1  1");
    const float o[3] = {-4, 0.25f, 0.5f}, d[3] = {3, 0, 0};
    EACH_WAY(w, &shape, 1) {
        struct rays r = traced(&w, 1, o, d, 0, HUGE_VALF);
        float t[2];
        const cylint_line line = rays_line(&r, 0);
        cylint_answer answer;
        int hits = 0;
        CHECK(cylint_intersect(&shape, &line, CYLINT_WANT_T, &answer) == 2);
        for (int k = 0; k < 2; k++)
            t[k] = (float)answer.hit[k].t;
        for (int a = -2; a <= 2; a++)
            for (int b = -2; b <= 2; b++)
                for (int which = 0; which < 3; which++) {
                    const float from = cylint_float_after(t[which == 2], a),
                                to = cylint_float_after(t[which > 0], b);
                    if (from > to)
                        continue;
                    r = traced(&w, 1, o, d, from, to);
                    hits += rays_hit(&r, 0);
                }
        CHECK(hits > 0);
    }
}

/* 0 and -0 are one end, and so is a subnormal number that is flushed to zero. */
TEST(a_domain_of_zeros_has_its_ends)
{
    const cylint_shape shape = shape_of("cylinder 0 0 0  0 0 1  1");
    const float o[3] = {0.25f, 0.5f, 0}, d[3] = {0, 0, 1};
    const float tnear[3] = {0, -0.0f, FLT_MIN / 2};
    const int modes = can_treat_subnormals(FLUSH | ZERO) ? 3 : 2;
    EACH_WAY(w, &shape, 1)
        for (int i = 0; i < 2 * modes; i++) {
            treat_subnormals(i / 2 == 2 ? FLUSH | ZERO : 0);
            struct rays r =
                equal_rays(w.scene, 1, o, d, tnear[i / 2], i % 2 ? -0.0f : 0);
            treat_subnormals(0);
            CHECK(rays_hit(&r, 0) && rays_at(&r, RAY_TFAR, 0)->f == 0);
        }
}

/* t and tfar are subnormal, and t is exact: the least float that is not below t nor
 * subnormal is beyond tfar. */
TEST(a_domain_that_ends_at_a_subnormal_number_has_its_hit)
{
    const cylint_shape shape = shape_of("cylinder 0 0 0  0 0 0.3  1");
    const float o[3] = {0.25f, 0, -0x1p-140f}, d[3] = {0, 0, 1};
    EACH_WAY(w, &shape, 1) {
        struct rays r = traced(&w, 1, o, d, 0, 0x1p-137f);
        CHECK(rays_hit(&r, 0) && rays_at(&r, RAY_TFAR, 0)->f == 0x1p-137f);
        r = traced(&w, 1, o, d, 0, 0x1p-141f);
        CHECK(!rays_hit(&r, 0));
    }
}

/* Tangents in the faces of Embree's boxes, where 0 / 0 decides nothing. */
TEST(a_ray_within_a_face_of_the_box_is_not_lost)
{
    const cylint_shape shape = shape_of("cylinder -1 0 2  1 0 2  1");
    EACH_WAY(w, &shape, 1) {
        int hits = 0;
        EACH_SIZE(n)
            for (int face = 0; face < 6; face++)
                for (int sign = 0; sign < 8; sign++) {
                    const int across = face / 2,
                              along = (across + 1 + sign % 2) % 3;
                    const float zero = sign & 4 ? -0.0f : 0.0f;
                    float o[3] = {0, 0, 2}, d[3];
                    o[across] += face % 2 ? 1.0f : -1.0f;
                    for (int k = 0; k < 3; k++)
                        d[k] = zero;
                    d[along] = sign & 2 ? 1.0f : -1.0f;
                    o[along] -= 3 * d[along];
                    struct rays r = traced(&w, n, o, d, 0, HUGE_VALF);
                    hits += rays_hit(&r, n / 2);
                }
        CHECK(hits == 4 * 6 * 8);
    }
}

/* Products of the hierarchy's boxes and 1 / d overflow floats. */
TEST(a_ray_along_an_axis_with_a_long_way_is_not_lost)
{
    enum { SIDE = 8, MANY = SIDE * SIDE };
    cylint_shape shapes[MANY];
    for (int i = 0; i < MANY; i++) {
        const double x = ldexp(i % SIDE, 49), y = ldexp(i / SIDE, 49);
        const double p0[3] = {x, y, 0}, p1[3] = {x, y, 0x1p49};
        cylint_cylinder(&shapes[i], p0, p1, 0x1p47, CYLINT_ENDS_CAPPED);
    }
    EACH_WAY(w, shapes, MANY) {
        for (int i = 0; i < 4 * MANY; i++) {
            const float zero = i & 1 ? 0.0f : -0.0f;
            const float d[3] = {zero, zero, i & 2 ? 0x1p-23f : 1};
            const float o[3] = {ldexpf((float)(i / 4 % SIDE), 49),
                                ldexpf((float)(i / 4 / SIDE), 49), -0x1p49f};
            EACH_SIZE(n) {
                struct rays r = traced(&w, n, o, d, 0, HUGE_VALF);
                CHECK(rays_hit(&r, 0));
            }
        }
    }
}

/* ---------------------------------------------------------------- masks -- */

static int is_visible(struct world *w, unsigned mask)
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

TEST(masks_select_the_visible_geometries)
{
    const cylint_shape shape = shape_of("cylinder 0 0 0  1 1 1  0.5");
    struct world w;
    if (!rtcGetDeviceProperty(world_device(),
                              RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED)) {
        printf("note: this Embree was built without ray masks\n");
        return;
    }
    w = world_with(&shape, 1, 0);
    for (int bit = 0; bit < 32; bit++)
        CHECK(is_visible(&w, 1u << bit));
    CHECK(!is_visible(&w, 0));
    rtcSetGeometryMask(w.geometry, 6);
    rtcCommitGeometry(w.geometry);
    rtcCommitScene(w.scene);
    CHECK(!is_visible(&w, 1) && is_visible(&w, 2) && is_visible(&w, 4) &&
          !is_visible(&w, ~6u));
    world_free(&w);
}

/* ----------------------------------------------------------------- ties -- */

enum { CAPS = 20 };

/* Cylinders whose axes are up to `spread` beside the z axis, with a cap at z from
 * `first` to first + 2 steps. */
static void draw_caps(cylint_shape shapes[CAPS], double spread, int first,
                      double step)
{
    for (int i = 0; i < CAPS; i++) {
        const double x = between(-spread, spread), y = between(-spread, spread);
        const double p0[3] = {x, y, (first + one_of(3)) * step};
        const double p1[3] = {x, y, between(0.2, 3)};
        cylint_cylinder(&shapes[i], p0, p1, between(1, 4),
                        one_of(2) ? CYLINT_ENDS_CAPPED : CYLINT_ENDS_CAP0);
    }
}

/* Of shapes hit at the same t the lowest number is reported, whichever leaf
 * they are in; of shapes whose t differ by less than a float's last place the
 * nearer one. */
TEST(equal_and_nearly_equal_hits_are_distinguished)
{
    cylint_shape shapes[CAPS];
    const float o[3] = {0.25f, 0.5f, -1}, d[3] = {0, 0, 1};
    for (int turn = 0; turn < 120; turn++) {
        draw_caps(shapes, 0.2, 1, turn % 2 ? 0x1p-51 : 0);
        EACH_WAY(w, shapes, CAPS)
            EACH_SIZE(n)
                traced(&w, n, o, d, 0, HUGE_VALF);
    }
}

/* Of caps at z = 0 and 2^-60, t is the same double, 1.  Where the domain ends at 1,
 * only the first are hit; a primitive does not distinguish such a tfar from that of
 * a hit on another one. */
TEST(a_root_beyond_tfar_is_no_hit_though_its_double_is_tfar)
{
    cylint_shape shapes[CAPS];
    const float o[3] = {0.25f, 0.5f, -1}, d[3] = {0, 0, 1};
    for (int turn = 0; turn < 300; turn++) {
        draw_caps(shapes, 0.2, 0, 0x1p-60);
        EACH_WAY(w, shapes, CAPS)
            EACH_SIZE(n) {
                if (way == 0)
                    traced(&w, n, o, d, 0, 1);
                traced(&w, n, o, d, 0, HUGE_VALF);
            }
    }
}

/* The ray enters and leaves a needle at one double t, in two slices; which of them
 * it reaches first depends on the direction of the axis. */
TEST(of_two_hits_of_a_shape_at_one_double_the_entry_is_reported)
{
    const double ends[2][3] = {{0x1p20 - 512, -512, 0x1p20},
                               {0x1p20 + 512, 512, 0x1p20}};
    const float o[3] = {0, 0, 0}, d[3] = {1, 0, 1};
    for (int end = 0; end < 2; end++) {
        cylint_shape needle;
        CHECK(cylint_cylinder(&needle, ends[end], ends[!end], 0x1p-36,
                              CYLINT_ENDS_CAPPED) == CYLINT_OK);
        EACH_WAY(w, &needle, 1)
            EACH_SIZE(n)
                traced(&w, n, o, d, 0, HUGE_VALF);
    }
}

/* Branches of round cones from one ball, away from rays that enter or leave it; or
 * from balls a few doubles apart. */
TEST(a_ball_in_common_is_hit_on_the_lowest_number)
{
    cylint_shape shapes[CAPS];
    for (int turn = 0; turn < 300; turn++) {
        double joint[3] = {0, 0, one_of(3) / 3.0};
        const float x = (float)between(-0.5, 0.5),
                    y = (float)between(-0.5, 0.5);
        for (int i = 0; i < CAPS; i++) {
            const double tip[3] = {between(-1, 1), between(-1, 1),
                                   between(-9, -4)};
            const double r = i % 4 ? between(0.2, 0.9) : 1;
            joint[2] += turn % 2 ? (one_of(3) - 1) * 0x1p-50 : 0;
            if (one_of(2))
                cylint_round_cone(&shapes[i], joint, 1, tip, r,
                                  (cylint_ends)(i % 3));
            else
                cylint_round_cone(&shapes[i], tip, r, joint, 1,
                                  (cylint_ends)(i % 3));
        }
        cylint_sphere(&shapes[one_of(CAPS)], joint, 1, CYLINT_ENDS_CAPPED);
        EACH_WAY(w, shapes, CAPS)
            EACH_SIZE(n) {
                traced(&w, n, (float[]){x, y, 8}, (float[]){0, y / 8, -1}, 0,
                       HUGE_VALF);
                traced(&w, n, (float[]){x, y, 0.125f}, (float[]){0, x, 1}, 0,
                       HUGE_VALF);
            }
    }
}

/* Embree tests the primitives of several geometries in turns. */
TEST(hits_on_another_geometry_do_not_hide_lower_numbers_or_nearer_hits)
{
    cylint_shape shapes[CAPS], others[CAPS];
    const float o[3] = {0.25f, 0.5f, -1}, d[3] = {0, 0, 1};
    for (int turn = 0; turn < 300; turn++) {
        draw_caps(shapes, 3, 1, turn % 3 ? 0x1p-51 : 0);
        memcpy(others, shapes, sizeof others);
        if (turn % 3)
            draw_caps(others, 3, 1, 0x1p-20);
        OWN_WORLD w = world_with(shapes, CAPS, CYLINT_EMBREE_SINGLE);
        OWN_WORLD other = world_with(others, CAPS, both_ways[turn % 2]);
        rtcAttachGeometry(w.scene, other.geometry);
        rtcCommitScene(w.scene);
        EACH_SIZE(n)
            traced(&w, n, o, d, 0, HUGE_VALF);
    }
}

TEST(a_hit_has_the_number_that_its_geometry_has_in_the_scene)
{
    const float o[3] = {0, 0, 0}, d[3] = {1, 0, 0};
    const cylint_shape ball = shape_of("sphere 3 0 0  1");
    EACH_WAY(w, &ball, 1) {
        RTCScene scene = world_new_scene();
        rtcAttachGeometryByID(scene, w.geometry, 7);
        rtcCommitScene(scene);
        EACH_SIZE(n) {
            struct rays r = equal_rays(scene, n, o, d, 0, HUGE_VALF);
            CHECK(rays_at(&r, HIT_GEOM, n - 1)->u == 7);
        }
        rtcReleaseScene(scene);
    }
}

/* An angle a little less than a whole turn: v is still below 1. */
TEST(v_is_below_a_whole_turn)
{
    const cylint_shape shape = shape_of("cylinder 0 0 0  0 0 1  1");
    EACH_WAY(w, &shape, 1) {
        for (int k = 24; k < 48; k += 4) {
            const float o[3] = {-ldexpf(1, -k), -4, 0.5f}, d[3] = {0, 1, 0};
            struct rays r = traced(&w, 1, o, d, 0, HUGE_VALF);
            CHECK(rays_at(&r, HIT_V, 0)->f > 0.99f &&
                  rays_at(&r, HIT_V, 0)->f < 1);
        }
    }
}

/* ------------------------------------------------------------ instances -- */

/* Columns of a matrix of few digits, so that Embree's inverse is exact, and three
 * times the same for time 1: at time 1/2 all is twice as large as at time 0. */
static void draw_matrices(float m[8][3])
{
    const float scale = ldexpf(1, whole_between(-6, 6));
    const int turn = one_of(3);
    memset(m, 0, 8 * sizeof *m);
    for (int c = 0; c < 3; c++) {
        m[c][(c + turn) % 3] = chance(0.5) ? scale : -scale;
        m[3][c] = scale / 8 * (float)whole_between(-64, 64);
    }
    m[0][(1 + turn) % 3] = scale * (float)whole_between(-1, 1); /* skewed */
    for (int k = 0; k < 12; k++)
        m[4 + k / 3][k % 3] = 3 * m[k / 3][k % 3];
}

/* Adds a random ray, as it is in the instance, to `in`, and transformed to `r`. */
static void add_transformed(struct rays *in, struct rays *r, int i, int moves,
                            float m[8][3])
{
    float o[3], d[3], p[3], q[3];
    for (int k = 0; k < 3; k++) {
        o[k] = (float)whole_between(-512, 512) / 128;
        d[k] = (float)whole_between(1, 64) / (o[k] < 0 ? 64 : -64);
    }
    for (int k = 0; k < 3; k++) {
        p[k] = o[0] * m[0][k] + o[1] * m[1][k] + o[2] * m[2][k] + m[3][k];
        q[k] = d[0] * m[0][k] + d[1] * m[1][k] + d[2] * m[2][k];
        p[k] *= moves ? 2.0f : 1.0f;
        q[k] *= moves ? 2.0f : 1.0f;
    }
    rays_add(in, i, o, d, 0, HUGE_VALF);
    rays_add(r, i, p, q, 0, HUGE_VALF);
    rays_at(r, RAY_TIME, i)->f = moves ? 0.5f : 0;
}

/* Whether ray i, in instance 7, hit.  in: the ray in the instance. */
static int agrees_inside(const struct world *w, struct rays *r, struct rays *in,
                         int i)
{
    const unsigned none = RTC_INVALID_GEOMETRY_ID;
    const int hit = rays_hit(r, i);
    CHECK(rays_at(r, HIT_INST, i)->u == (hit ? 7 : none));
    CHECK(rays_at(r, HIT_GEOM, i)->u == (hit ? 0 : none));
#if RTC_VERSION_MAJOR >= 4
    CHECK(rays_at(r, HIT_INST_PRIM, i)->u == (hit ? 0 : none));
#endif
    for (int m = RAY_TFAR; m < RAY_MEMBERS; m++)
        *rays_at(in, (enum ray_member)m, i) =
            *rays_at(r, (enum ray_member)m, i);
    if (!CHECK(world_agrees(w, in, i)))
        world_show(w, in, i);
    return hit;
}

/* Skewed, scaled and moving instances: the transformed ray counts. */
TEST(instances_answer_for_the_transformed_ray)
{
    cylint_shape shapes[SOME];
    world_shapes(SCENE_MIXED, shapes, SOME);
    EACH_WAY(w, shapes, SOME) {
        int hits = 0;
        for (int turn = 0; turn < 40; turn++) {
            const int moves = turn % 2;
            float m[8][3];
            draw_matrices(m);
            RTCScene outer = world_instance(w.scene, 7, 1 + moves, *m);
            for (int i = 0; i < 60; i++) {
                struct rays r, in;
                rays_begin(&r, rays_sizes[i % 4]);
                rays_begin(&in, r.n);
                for (int at = 0; at < r.n; at++)
                    if (r.n == 1 || chance(0.7))
                        add_transformed(&in, &r, at, moves, m);
                memcpy(in.before, in.word, sizeof in.word);
                rays_intersect(&r, outer, NULL);
                CHECK(rays_strayed(&r, 0) == 0);
                for (int at = 0; at < r.n; at++)
                    if (r.valid[at])
                        hits += agrees_inside(&w, &r, &in, at);
            }
            rtcReleaseScene(outer);
        }
        CHECK(hits > 100);
    }
}

static int offers;

static void count_offer(const struct RTCFilterFunctionNArguments *args)
{
    (void)args;
    offers++;
}

static const float unmoved[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

/* The second of two instances in one place has no nearer hit. */
TEST(a_hit_on_another_instance_stays_at_equal_t)
{
    cylint_shape shapes[SOME];
    world_shapes(SCENE_LATTICE, shapes, SOME);
    EACH_WAY(w, shapes, SOME) {
        int hits = 0;
        world_filter(&w, count_offer);
        RTCScene one = world_instance(w.scene, 7, 1, unmoved),
                 two = world_instance(w.scene, 7, 1, unmoved);
        rtcAttachGeometryByID(two, rtcGetGeometry(two, 7), 8);
        rtcCommitScene(two);
        for (int i = 0; i < 200; i++) {
            struct rays r, same;
            aim_all(&r, rays_sizes[i % 4]);
            same = r;
            offers = 0;
            rays_intersect(&r, one, NULL);
            const int expected = offers;
            offers = 0;
            rays_intersect(&same, two, NULL);
            CHECK(offers == expected);
            hits += expected > 0;
        }
        CHECK(hits > 50);
        rtcReleaseScene(one);
        rtcReleaseScene(two);
    }
}

/* A ray to a cap at 1 + 2^-60, of which the double is 1.  A ray of an occlusion
 * query has no hit; the adapter's own, all zeros, is not one on shape 0. */
TEST(in_instance_0_a_root_beyond_tfar_occludes_nothing)
{
    const float o[3] = {0.25f, 0.5f, -1}, d[3] = {0, 0, 1};
    const cylint_shape shape = shape_of("cylinder 0 0 0x1p-60  0 0 1  1");
    EACH_WAY(w, &shape, 1) {
        RTCScene outer = world_instance(w.scene, 0, 1, unmoved);
        for (int beyond = 0; beyond < 2; beyond++)
            EACH_SIZE(n) {
                struct rays r;
                rays_begin(&r, n);
                for (int i = 0; i < n; i++)
                    rays_add(&r, i, o, d, 0, beyond ? 1 : 1 + FLT_EPSILON);
                rays_occluded(&r, outer, NULL);
                for (int i = 0; i < n; i++)
                    CHECK(rays_shadowed(&r, i) == !beyond);
            }
        rtcReleaseScene(outer);
    }
}

/* ------------------------------------------------------ Embree's curves -- */

/* A cone curve from (0, 0, 0) by (0, 0, 2) to (2, 0, 2). */
static const float bend[3][4] = {
    {0, 0, 0, 0.5f}, {0, 0, 2, 0.5f}, {2, 0, 2, 0.5f}};

TEST(a_cone_curve_has_no_caps_where_its_segments_join)
{
    static const float rays[][2][3] = {{{-0.25f, 0.125f, 5}, {0, 0, -1}},
                                       {{1, 0.125f, 5}, {0, 0, -1}},
                                       {{5, 0.125f, 2}, {-1, 0, 0}},
                                       {{0.125f, 0.125f, -5}, {0, 0, 1}},
                                       {{5, 5, 5}, {0, 0, -1}}};
    static const cylint_ends ends[2] = {CYLINT_ENDS_CAP0, CYLINT_ENDS_CAP1};
    cylint_shape open[2], capped[2];
    for (int i = 0; i < 2; i++) {
        const float *a = bend[i], *b = bend[i + 1];
        const double p0[3] = {a[0], a[1], a[2]}, p1[3] = {b[0], b[1], b[2]};
        CHECK(!cylint_cone(&open[i], p0, a[3], p1, b[3], ends[i]));
        CHECK(!cylint_cone(&capped[i], p0, a[3], p1, b[3], CYLINT_ENDS_CAPPED));
    }
    RTCScene curve = world_curve(bend, 3, 0);
    OWN_WORLD with = world_made(capped, 2, NULL);
    OWN_WORLD without = world_made(open, 2, NULL);
    for (size_t i = 0; i < sizeof rays / sizeof *rays; i++) {
        const RTCScene scenes[3] = {curve, without.scene, with.scene};
        struct rays r[3];
        float t[3];
        for (int k = 0; k < 3; k++) {
            r[k] =
                equal_rays(scenes[k], 1, rays[i][0], rays[i][1], 0, HUGE_VALF);
            t[k] = rays_at(&r[k], RAY_TFAR, 0)->f;
        }
        CHECK(rays_at(&r[0], HIT_PRIM, 0)->u == rays_at(&r[1], HIT_PRIM, 0)->u);
        CHECK(!rays_hit(&r[0], 0) || fabsf(t[0] - t[1]) < 1e-4f);
        CHECK(i > 0 || (t[1] == 5 && t[2] == 3));
    }
    rtcReleaseScene(curve);
}
