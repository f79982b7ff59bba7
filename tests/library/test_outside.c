/*
 * test_outside.c - rays that leave a surface
 *
 * From every hit of the families cylint_outside() makes a point outside and a
 * point inside.  cylint_contains() must agree, and rays from the point outside
 * that point away from a convex solid must miss it; every ray from the point
 * inside a bounded solid must hit it once.  CYLINT_CASES is the number of cases
 * of each family.
 */
#include <math.h>
#include <string.h>

#include "check.h"
#include "draw.h"
#include "families.h"
#include "shapes/shape_facts.h"
#include "ulps.h"

enum { CASES = 300, RAYS = 8 /* from each point */ };

/* Of points outside, and of points inside. */
static struct tally {
    long points, none, rays;
    double moved; /* at most, in units in the last place of a coordinate */
} tally[2];

static int is_convex(const cylint_shape *s)
{
    return s->ends != CYLINT_ENDS_INFINITE || !cylint_is_tapered(s->kind);
}

/* In units in the last place of the largest coordinate. */
static double move_of(const cylint_hit *hit, const double p[3])
{
    double most = 0, size = 0;
    for (int i = 0; i < 3; i++) {
        most = fmax(most, fabs(p[i] - hit->point[i]));
        size = fmax(size, fabs(hit->point[i]));
    }
    return most / ulp(size);
}

/* The number of hits of a ray that starts at p. */
static int hits_from(const cylint_shape *s, const double p[3],
                     const double d[3])
{
    cylint_line ray;
    cylint_answer a;
    cylint_ray(&ray, p, d);
    return cylint_intersect(s, &ray, CYLINT_WANT_COUNT, &a);
}

/* A ray of which the number of hits is known: 0 or 1. */
static void check_ray(const struct family_case *c, const cylint_shape *whole,
                      const double p[3], const double d[3], int hits)
{
    tally[hits].rays++;
    if (!CHECK(hits_from(whole, p, d) == hits)) {
        REPORT_CASE(c);
        REPORT("ray %a %a %a  %a %a %a", p[0], p[1], p[2], d[0], d[1], d[2]);
    }
}

/* Rays that leave a convex solid, all parts of which are there; or, without a
 * hit, that stay in a bounded one. */
static void check_rays(const struct family_case *c, const cylint_shape *whole,
                       const cylint_hit *hit, const double p[3])
{
    for (int k = 0; k < RAYS; k++) {
        double d[3];
        random_direction(d);
        const double sign = hit && dot3(d, hit->normal) < 0 ? -1 : 1;
        for (int i = 0; i < 3; i++)
            d[i] *= sign;
        check_ray(c, whole, p, d, !hit);
    }
}

/* A length that the section of an elliptic kind of factor 1 has in each direction,
 * nearly. */
static double thickness(const cylint_shape *s)
{
    const double of_a = length3(cylint_a(s)), of_b = length3(cylint_b(s));
    double a[3], b[3], sine[3];
    for (int i = 0; i < 3; i++) {
        a[i] = cylint_a(s)[i] / of_a;
        b[i] = cylint_b(s)[i] / of_b;
    }
    cross3(sine, a, b);
    return length3(sine) * fmin(of_a, of_b);
}

/* Whether the section at the hit is large beside the steps of the doubles.  At
 * an apex, and where a few doubles span the shape, the normal does not say which
 * rays point away. */
static int is_smooth(const cylint_shape *s, const cylint_hit *hit)
{
    if (cylint_is_plane(s->kind))
        return 1;
    const double unit = cylint_is_elliptic(s->kind)
                            ? thickness(s)
                            : cylint_radius_unit(s, length3(cylint_axis(s)));
    const double z =
        cylint_is_round(s->kind) ? fmin(fmax(hit->z, 0), 1) : hit->z;
    const double r = s->kind == CYLINT_KIND_SPHERE
                         ? cylint_r0(s)
                         : cylint_r0(s) + (cylint_r1(s) - cylint_r0(s)) * z;
    double size = 0;
    for (int i = 0; i < 3; i++)
        size = fmax(size, fabs(hit->point[i]));
    return fabs(r) * unit > 1e9 * ulp(size);
}

/* Whether a point that is a member of the hit becomes the same point. */
static int same_in_hit(const cylint_shape *s, const cylint_hit *hit, int side)
{
    cylint_hit in_point = *hit, in_normal = *hit;
    double p[3];
    const int found = cylint_outside(s, hit, side, p);
    return cylint_outside(s, &in_point, side, in_point.point) == found &&
           cylint_outside(s, &in_normal, side, in_normal.normal) == found &&
           memcmp(p, in_point.point, sizeof p) == 0 &&
           memcmp(p, in_normal.normal, sizeof p) == 0;
}

/* The square of a distance that is less than 2^e, divided by 4^e. */
static double squared(const double p[3], const double q[3], int e)
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += pow(ldexp(p[i] - q[i], -e), 2);
    return sum;
}

/* Whether no point on the side is nearer to the hit's than p, of those that are a
 * step towards the side in some coordinates. */
static int is_nearest(const cylint_shape *s, const cylint_hit *hit, int side,
                      const double p[3])
{
    double most = 0;
    for (int i = 0; i < 3; i++)
        most = fmax(most, fabs(p[i] - hit->point[i]));
    const int e = most > 0 ? ilogb(most) + 1 : 0;
    for (int mask = 1; mask < 8; mask++) {
        double q[3];
        int is_towards = 1;
        for (int i = 0; i < 3; i++) {
            const int is_stepped = mask >> i & 1;
            const double x = hit->point[i], to = -side * hit->normal[i];
            is_towards &= !is_stepped || to != 0;
            q[i] = is_stepped ? nextafter(x, to > 0 ? HUGE_VAL : -HUGE_VAL) : x;
        }
        if (is_towards && cylint_contains(s, q) == side &&
            squared(q, hit->point, e) < squared(p, hit->point, e))
            return 0;
    }
    return 1;
}

static void from_hit(const struct family_case *c, const cylint_hit *hit)
{
    cylint_shape whole = c->shape;
    if (cylint_ends_are_planes(whole.ends))
        whole.ends = CYLINT_ENDS_CAPPED;
    const int convex = is_convex(&whole);
    for (int inside = 0; inside < 2; inside++) {
        struct tally *sum = &tally[inside];
        const int side = inside ? 1 : -1;
        double p[3];
        if (!CHECK(same_in_hit(&c->shape, hit, side)))
            REPORT_CASE(c);
        sum->points++;
        if (!cylint_outside(&c->shape, hit, side, p)) {
            /* no double may be inside a solid so thin, and a double cone may
             * hold all doubles nearby */
            sum->none++;
            if (!CHECK(memcmp(p, hit->point, sizeof p) == 0 &&
                       (inside || !convex)))
                REPORT_CASE(c);
            continue;
        }
        CHECK(cylint_contains(&c->shape, p) == side);
        if (inside || cylint_is_round(whole.kind) || !cylint_is_bounded(&whole))
            CHECK(is_nearest(&c->shape, hit, side, p));
        sum->moved = fmax(sum->moved, move_of(hit, p));
        if (inside ? cylint_is_bounded(&whole)
                   : convex && is_smooth(&whole, hit))
            check_rays(c, &whole, inside ? NULL : hit, p);
    }
}

static void over_families(int wild)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    memset(tally, 0, sizeof tally);
    EACH_CASE(c, 5, wild ? cases / 10 : cases) {
        cylint_answer a;
        if ((family_is_wild(family) || family_is_scaled(family)) != wild)
            continue;
        cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &a);
        for (int k = 0; k < a.n; k++)
            if (is_finite3(a.hit[k].point))
                from_hit(&c, &a.hit[k]);
    }
    for (int i = 0; i < 2; i++)
        printf("note: %s %ld points, none for %ld, %ld rays; moved by up to "
               "%.3g ulp\n",
               i ? "inside " : "outside", tally[i].points, tally[i].none,
               tally[i].rays, tally[i].moved);
}

TEST(rays_leave_the_solid_or_stay_in_it)
{
    over_families(0);
    CHECK(1000 * tally[1].none < tally[1].points);
}

TEST(rays_of_wild_sizes_leave_the_solid_or_stay_in_it)
{
    over_families(1);
}

TEST(a_point_on_the_wanted_side_is_not_moved)
{
    const cylint_shape s = shape_of("sphere 0 0 0 1");
    cylint_hit hit = {.point = {0, 0, 2}, .normal = {0, 0, 1}};
    double p[3];
    CHECK(cylint_outside(&s, &hit, -1, p) == 1 && p[2] == 2);
    hit.point[2] = 0.5;
    CHECK(cylint_outside(&s, &hit, 1, p) == 1 && p[2] == 0.5);
    hit.point[2] = 1;
    CHECK(cylint_outside(&s, &hit, -1, p) == 1 && p[2] == nextafter(1, 2) &&
          p[0] == 0 && p[1] == 0);
    CHECK(cylint_outside(&s, &hit, 1, p) == 1 && p[2] == nextafter(1, 0));
}

/* A point above the cap and nearer to the axis than the hit's part is not taken. */
TEST(beside_a_rim_the_point_is_beyond_the_part_of_the_hit)
{
    static const char *const shapes[] = {"cylinder 0 0 0  0 0 1  1",
                                         "cone 0 0 0  1  0 0 1  1.5"};
    for (int i = 0; i < 2; i++) {
        const cylint_shape s = shape_of(shapes[i]);
        const double r = i ? 1.5 : 1;
        const cylint_hit hit = {.point = {nextafter(r, 0), 0, nextafter(1, 2)},
                                .normal = {1, 0, 0},
                                .part = CYLINT_PART_LATERAL};
        double p[3];
        CHECK(cylint_contains(&s, hit.point) == -1);
        CHECK(cylint_outside(&s, &hit, -1, p) == 1 &&
              cylint_contains(&s, p) == -1 && p[0] > r && p[1] == 0);
    }
}

TEST(beside_a_rim_the_point_is_beyond_the_cap_of_the_hit)
{
    const cylint_shape s = shape_of("cylinder 0 0 0  0 0 1  1");
    const double r = nextafter(1, 2);
    for (int top = 0; top < 2; top++) {
        const cylint_hit hit = {
            .point = {r, 0, top ? nextafter(1, 0) : 0x1p-1074},
            .normal = {0, 0, top ? 1 : -1},
            .part = top ? CYLINT_PART_CAP1 : CYLINT_PART_CAP0};
        double p[3];
        CHECK(cylint_contains(&s, hit.point) == -1);
        CHECK(cylint_outside(&s, &hit, -1, p) == 1 && p[0] == r && p[1] == 0 &&
              p[2] == (top ? nextafter(1, 2) : -0x1p-1074));
    }
}

/* The axis is the direction of the normal there, and inside. */
TEST(the_outside_of_a_double_cone_at_its_apex_is_found)
{
    static const char *const cones[] = {
        "line 0 0 -1  0 0 1  acone 0 0 0  0 0 1  45 ends=infinite",
        "line 1 2 -1  0 0 1  acone 1 2 3  0 0 1  89 ends=infinite",
        "line 0 0 0  1 2 3  acone 1 2 3  1 2 3  30 ends=infinite"};
    for (int i = 0; i < 3; i++) {
        const struct family_case c = case_of(cones[i]);
        cylint_answer a;
        double p[3];
        cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &a);
        CHECK(a.n == 1 && cylint_contains(&c.shape, a.hit[0].point) == 0);
        CHECK(cylint_outside(&c.shape, &a.hit[0], -1, p) == 1 &&
              cylint_contains(&c.shape, p) == -1);
        CHECK(cylint_outside(&c.shape, &a.hit[0], 1, p) == 1 &&
              cylint_contains(&c.shape, p) == 1);
    }
}

/* One is outside of a double cone whose normal points to larger numbers. */
TEST(at_the_largest_double_finite_points_are_found)
{
    static const char *const cases[] = {
        "line 0x1.fffffffffffffp+1023 0 -1  0 0 1  "
        "acone 0x1.fffffffffffffp+1023 0 0  1 0 0  45 ends=infinite",
        "line 0x1.8p+1023 0 -1  0 0 1  acone 0x1.8p+1023 0 0  -1 0 0  45 "
        "ends=infinite",
        "line 0 0 -0x1p-131  1 0 0  "
        "halfspace 0x1.fffffffffffffp+1023 0 0  0x1p-100 0 0x1p+1000",
        "line 0 0 0x1p-131  1 0 0  "
        "halfspace 0x1.fffffffffffffp+1023 0 0  0x1p-100 0 0x1p+1000",
        "line 0 0 0  1 0 0  halfspace 0x1.fffffffffffffp+1023 0 0  1 0 0"};
    for (int i = 0; i < 5; i++) {
        const struct family_case c = case_of(cases[i]);
        cylint_answer a;
        CHECK(cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &a) == 1);
        for (int side = -1; side <= 1; side += 2) {
            double p[3];
            const int is_found = cylint_outside(&c.shape, &a.hit[0], side, p);
            if (i == 4 && side < 0) /* no double is outside */
                CHECK(!is_found && p[0] == DBL_MAX);
            else
                CHECK(is_found && is_finite3(p) &&
                      cylint_contains(&c.shape, p) == side);
        }
    }
}

TEST(no_double_is_inside_a_solid_that_is_too_thin)
{
    const cylint_shape thin =
        shape_of("capsule 0.1 0.2 0.3  1.7 0.9 1.1  0x1p-70");
    const cylint_hit hit = {.point = {0.9, 0.55, 0.7}, .normal = {0, 0, -1}};
    double p[3];
    CHECK(cylint_outside(&thin, &hit, 1, p) == 0 &&
          memcmp(p, hit.point, sizeof p) == 0);
    cylint_shape none;
    memset(&none, 0, sizeof none);
    CHECK(cylint_outside(&none, &hit, 1, p) == 0 && p[2] == hit.point[2]);
    CHECK(cylint_outside(&none, &hit, -1, p) == 1);
}
