/*
 * test_hit.c - floor roots: members of a hit from exact numbers
 *
 * cylint_intersect() needs this stage only where the others are not certain.  Here
 * it is called directly, in every floating-point environment.
 */
#include <string.h>

#include "check.h"
#include "environment.h"
#include "families.h"
#include "intersect.h"
#include "roots/roots.h"

static cylint_query query;

/* The subnormal number n 2^-1074, from its bits. */
static double units(int n)
{
    return cylint_from_bits((uint64_t)n);
}

static int has_bits(double got, double want)
{
    return cylint_bits(got) == cylint_bits(want);
}

/* A line's hit at one of its roots. */
static cylint_hit hit_of(const cylint_shape *shape, const double o[3],
                         const double d[3], cylint_root root, int part)
{
    cylint_line line;
    cylint_hit hit;
    memset(&hit, 0, sizeof hit);
    CHECK(cylint_whole_line(&line, o, d) == CYLINT_OK);
    cylint_query_open(&query, shape, &line);
    cylint_describe_hit(&query, root, part, 0, CYLINT_WANT_ALL, &hit);
    return hit;
}

static void upright(cylint_shape *s, double radius)
{
    static const double p0[3] = {0, 0, 0}, p1[3] = {0, 0, 4};
    CHECK(cylint_cylinder(s, p0, p1, radius, CYLINT_ENDS_CAPPED) == CYLINT_OK);
}

/* At t = 1 the line has x = 1 + d[0]. */
static void a_coordinate_between_two_doubles_is_even(struct environment there)
{
    static const struct {
        double step, x;
    } row[] = {{0x1p-53, 1},
               {0x1.0000000000001p-53, 0x1.0000000000001p0},
               {0x1.fffffffffffffp-54, 1},
               {0x1.8p-52, 0x1.0000000000002p0},
               {0x1.7ffffffffffffp-52, 0x1.0000000000001p0}};
    cylint_shape s;
    environment_set(there);
    upright(&s, 2);
    for (int i = 0; i < 5; i++)
        for (int sign = -1; sign <= 1; sign += 2) {
            const double o[3] = {sign, 0, -1};
            const double d[3] = {sign * row[i].step, 0, 1};
            const cylint_hit hit =
                hit_of(&s, o, d, ROOT_CAP0, CYLINT_PART_CAP0);
            CHECK(has_bits(hit.point[0], sign * row[i].x));
            CHECK(has_bits(hit.point[1], 0) && has_bits(hit.point[2], 0));
        }
    environment_reset();
}

/* At t = 1 the line meets x = -1, at z = (1 + d[2]) / 4. */
static void a_height_between_two_doubles_is_even(struct environment there)
{
    static const struct {
        double step, z;
    } row[] = {{0x1p-53, 0x1p-2},
               {0x1.0000000000001p-53, 0x1.0000000000001p-2},
               {0x1.8p-52, 0x1.0000000000002p-2}};
    cylint_shape s;
    environment_set(there);
    upright(&s, 1);
    for (int i = 0; i < 3; i++) {
        const double o[3] = {-2, 0, 1}, d[3] = {1, 0, row[i].step};
        const cylint_hit hit =
            hit_of(&s, o, d, ROOT_ENTRY, CYLINT_PART_LATERAL);
        CHECK(has_bits(hit.z, row[i].z));
        CHECK(has_bits(hit.phi, 0.75) && has_bits(hit.normal[0], -1));
    }
    environment_reset();
}

/* Of a ball of radius 4 the normal is a quarter of the point. */
static void a_subnormal_component_of_a_normal_is_rounded_once(
    struct environment there)
{
    static const int row[][2] = {{1, 0}, {3, 1}, {5, 1}, {7, 2}, {9, 2}};
    static const double c[3] = {0, 0, 0}, d[3] = {1, 0, 0};
    cylint_shape s;
    CHECK(cylint_sphere(&s, c, 4, CYLINT_ENDS_CAPPED) == CYLINT_OK);
    environment_set(there);
    for (int i = 0; i < 5; i++) {
        const double o[3] = {-5, units(row[i][0]), -units(row[i][0])};
        const cylint_hit hit =
            hit_of(&s, o, d, ROOT_ENTRY, CYLINT_PART_LATERAL);
        const double n = units(row[i][1]);
        CHECK(has_bits(hit.normal[0], -1) && has_bits(hit.normal[1], n));
        CHECK(has_bits(hit.normal[2], row[i][1] ? -n : 0));
    }
    environment_reset();
}

/* phi is 0 at -y and 1/4 at x. */
static void an_angle_is_rounded_once_and_below_a_turn(struct environment there)
{
    static const double below_1 = 0x1.fffffffffffffp-1;
    const struct {
        double x, phi[2]; /* at -y and at y */
    } row[] = {
        {0, {0, 0.5}},
        {units(20), {units(3), 0.5}}, /* 3.18 units */
        {units(16), {units(3), 0.5}}, /* 2.55 units */
        {units(3), {0, 0.5}},         /* 0.48 units */
        {-units(20), {below_1, 0.5}},
        {0x1p-300, {0x1.45f306dc9c883p-303, 0.5}},
        {-0x1p-70, {below_1, 0.5}},
    };
    static const double d[3] = {0, 1, 0};
    cylint_shape s;
    environment_set(there);
    upright(&s, 1);
    for (int i = 0; i < 7; i++) {
        const double o[3] = {row[i].x, -2, 1};
        const cylint_hit in = hit_of(&s, o, d, ROOT_ENTRY, CYLINT_PART_LATERAL);
        const cylint_hit out = hit_of(&s, o, d, ROOT_EXIT, CYLINT_PART_LATERAL);
        CHECK(has_bits(in.phi, row[i].phi[0]));
        CHECK(has_bits(out.phi, row[i].phi[1]));
    }
    environment_reset();
}

static void ties_of_coordinates(void)
{
    everywhere(a_coordinate_between_two_doubles_is_even);
}

static void ties_of_heights(void)
{
    everywhere(a_height_between_two_doubles_is_even);
}

static void subnormal_normals(void)
{
    everywhere(a_subnormal_component_of_a_normal_is_rounded_once);
}

static void angles(void)
{
    everywhere(an_angle_is_rounded_once_and_below_a_turn);
}

static void all_paths_have_the_bits_of_the_exact_stage(void)
{
    enum { CASES = 200 };
    for (int family = 0; family < family_count(); family++)
        for (uint64_t i = 0; i < CASES; i++) {
            struct family_case c;
            cylint_answer got, want;
            family_case(24, family, i, &c);
            memset(&got, 0, sizeof got);
            memset(&want, 0, sizeof want);
            cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &got);
            cylint_intersect_by_signs(&c.shape, &c.line, CYLINT_WANT_ALL,
                                      &want);
            if (!CHECK(got.n == want.n &&
                       memcmp(got.hit, want.hit, sizeof got.hit) == 0))
                family_report(&c);
        }
}

int main(void)
{
    RUN(ties_of_coordinates);
    RUN(ties_of_heights);
    RUN(subnormal_normals);
    RUN(angles);
    RUN(all_paths_have_the_bits_of_the_exact_stage);
    return check_end();
}
