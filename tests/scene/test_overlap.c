/*
 * test_overlap.c - floor scene: points of shapes that overlap
 */
#include <math.h>
#include <string.h>

#include "check.h"
#include "cylint_scene.h"
#include "random.h"
#include "shapes/layout.h"

/* The case of cylint_scene(3), section Overlapping shapes. */
static void the_nearest_surface_may_lie_inside_another_shape(void)
{
    const double center[3] = {0, 0, 0}, end[3] = {30, 0, 0}, p[3] = {0, 3, 0};
    cylint_shape shapes[2];
    cylint_closest near;
    CHECK(!cylint_sphere(&shapes[0], center, 10, CYLINT_ENDS_CAPPED) &&
          !cylint_capsule(&shapes[1], center, end, 1, CYLINT_ENDS_CAPPED));
    cylint_scene *scene = cylint_scene_new(shapes, 2, 1, NULL);
    CHECK(cylint_scene_closest(scene, p, HUGE_VAL, 0, &near) == 1 &&
          near.distance == 2);
    CHECK(cylint_contains(&shapes[0], p) == 1 &&
          cylint_distance(&shapes[0], p, 0, &near) == -7);
    CHECK(cylint_scene_closest(scene, p, HUGE_VAL, CYLINT_SIGNED, &near) == 0 &&
          near.distance == -7);
    CHECK(cylint_scene_contains(scene, p, 0) == 1);
    cylint_scene_free(scene);
}

/* Two sectors of one pipe, end to end, so that the cap between them lies inside the
 * union; and a nappe.  Points lie exactly on caps, lateral surfaces and rims. */
static void the_boundary_belongs_to_the_solid(void)
{
    static const double begin[3] = {0, 0, 0}, middle[3] = {0, 0, 4},
                        end[3] = {0, 0, 8}, apex[3] = {20, 0, 0},
                        up[3] = {0, 0, 1};
    static const struct {
        double point[3];
        size_t holding, least;
        double distance;
    } cases[] = {
        {{0, 0, 4}, 2, 0, 0},      /* on the cap between them */
        {{5, 0, 2}, 1, 0, 0},      /* on the lateral surface */
        {{3, 4, 8}, 1, 1, 0},      /* on a rim */
        {{3, 4, 4}, 2, 0, 0},      /* on two rims */
        {{0, 0, 0}, 1, 0, 0},      /* on a cap that is missing */
        {{0, 0, 2}, 1, 0, -2},     /* as near to both caps */
        {{0, 4.5, 5}, 1, 1, -0.5}, /* near the lateral surface */
        {{0, 0, 9}, 0, 1, 1},      /* before a cap that is missing */
        {{0, 8, 12}, 0, 1, 5},     /* before its rim */
        {{20, 0, 0}, 1, 2, 0},     /* on the apex of the nappe */
        {{23, 0, 3}, 1, 2, 0},     /* on its lateral surface */
        {{20, 0, 0x1p900}, 1, 2, -0x1.6a09e667f3bcdp899}, /* far inside it */
        {{20, 0, -2}, 0, 2, 2}};
    for (int ends = CYLINT_ENDS_CAPPED; ends <= CYLINT_ENDS_CAP1; ends++) {
        cylint_shape shapes[3];
        CHECK(
            !cylint_cylinder(&shapes[0], begin, middle, 5, (cylint_ends)ends) &&
            !cylint_cylinder(&shapes[1], middle, end, 5, (cylint_ends)ends) &&
            !cylint_tangent_cone(&shapes[2], apex, up, 1, CYLINT_ENDS_NAPPE));
        cylint_scene *scene = cylint_scene_new(shapes, 3, 1, NULL);
        for (size_t i = 0; scene && i < sizeof cases / sizeof *cases; i++) {
            const double *p = cases[i].point;
            cylint_closest near;
            const size_t least =
                cylint_scene_closest(scene, p, HUGE_VAL, CYLINT_SIGNED, &near);
            if (!CHECK(cylint_scene_contains(scene, p, 0) == cases[i].holding &&
                       least == cases[i].least &&
                       near.distance == cases[i].distance))
                REPORT("case %zu, ends %d: %zu, %g", i, ends, least,
                       near.distance);
        }
        cylint_scene_free(scene);
    }
}

/* Points inside a neuron's soma and branches, of tapered pieces whose inner
 * ends lie in each other: the nearest surface is often such an end. */
static void a_point_of_the_union_has_no_positive_signed_distance(void)
{
    enum { BRANCHES = 12, PIECES = 25, N = BRANCHES * PIECES };
    static cylint_shape shapes[N];
    uint64_t random = 301;
    size_t positive = 0, outside = 0, wrong = 0;
    double from[3] = {0, 0, 0}, r = 4;
    for (int i = 0; i < N; i++) {
        double to[3];
        for (int j = 0; j < 3; j++) {
            from[j] = i % PIECES ? from[j] : 0;
            to[j] = from[j] + (i / PIECES >> j & 1 ? 1 : -1) * 3 *
                                  (random_unit(&random) - 0.2);
        }
        r = i % PIECES ? 0.9 * r : 4;
        CHECK(!cylint_cone(&shapes[i], from, r, to, 0.9 * r,
                           i % 2 ? CYLINT_ENDS_OPEN : CYLINT_ENDS_CAPPED));
        memcpy(from, to, sizeof from);
    }
    cylint_scene *scene = cylint_scene_new(shapes, N, 1, NULL);
    for (int i = 0; scene && i < 400; i++) {
        const cylint_shape *s = &shapes[random_below(&random, N)];
        const double z = random_unit(&random);
        cylint_closest surface, solid;
        double p[3];
        for (int j = 0; j < 3; j++)
            p[j] = cylint_base(s)[j] + z * cylint_axis(s)[j] +
                   0.4 * cylint_r1(s) * (random_unit(&random) - 0.5);
        cylint_scene_closest(scene, p, HUGE_VAL, 0, &surface);
        cylint_scene_closest(scene, p, HUGE_VAL, CYLINT_SIGNED, &solid);
        const size_t holding = cylint_scene_contains(scene, p, 0);
        positive += holding > 0 && surface.distance > 0;
        outside += holding == 0;
        wrong += (holding > 0) != (solid.distance <= 0);
    }
    CHECK(wrong == 0 && positive > 100 && outside < 100);
    cylint_scene_free(scene);
}

int main(void)
{
    RUN(the_nearest_surface_may_lie_inside_another_shape);
    RUN(the_boundary_belongs_to_the_solid);
    RUN(a_point_of_the_union_has_no_positive_signed_distance);
    return check_end();
}
