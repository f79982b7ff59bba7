/*
 * test_outside.c - rays that leave a surface
 *
 * From every hit of the families cylint_outside() makes a point outside and a
 * point inside.  cylint_contains() must agree, and rays from the point outside
 * that go away from the nearest point of a convex solid must miss it; every ray
 * from the point inside a bounded solid must hit it once.  CYLINT_CASES is the
 * number of cases of each family.  outside.txt has known points.
 */
#include <math.h>
#include <string.h>

#include "check.h"
#include "cylint_distance.h"
#include "draw.h"
#include "families.h"
#include "records.h"
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

/* Rays from p of which the number of hits is known: none if p is outside of a
 * convex solid and they go away from its nearest point, one if p is inside a
 * bounded one.  All parts of the solid are there.  On a rim or apex the normal is
 * not the direction to p; elliptic kinds have normals of fewer digits. */
static void check_rays(const struct family_case *c, const cylint_shape *whole,
                       int inside, const double p[3])
{
    cylint_closest nearest;
    cylint_distance(whole, p, CYLINT_WANT_PART | CYLINT_WANT_NORMAL, &nearest);
    if (!inside && nearest.feature >= CYLINT_FEATURE_RIM0)
        return;
    for (int k = 0; k < RAYS; k++) {
        double d[3];
        cylint_line ray;
        cylint_answer a;
        random_direction(d);
        const double away = dot3(d, nearest.normal);
        if (!inside && fabs(away) < 1e-9)
            continue;
        scale3(d, inside || away > 0 ? 1 : -1);
        cylint_ray(&ray, p, d);
        tally[inside].rays++;
        if (!CHECK(cylint_intersect(whole, &ray, CYLINT_WANT_COUNT, &a) ==
                   inside)) {
            REPORT_CASE(c);
            REPORT("ray %a %a %a  %a %a %a", p[0], p[1], p[2], d[0], d[1],
                   d[2]);
        }
    }
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
                   : convex && !cylint_is_elliptic(whole.kind))
            check_rays(c, &whole, inside, p);
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
    for (int i = 0; i < 2; i++) {
        printf("note: %s %ld points, none for %ld, %ld rays; moved by up to "
               "%.3g ulp\n",
               i ? "inside " : "outside", tally[i].points, tally[i].none,
               tally[i].rays, tally[i].moved);
        CHECK(tally[i].rays >= (long)(wild ? cases / 10 : cases));
    }
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

/* Reads whether there is a point, and the point if it is known.  Where there is
 * none, the hit's own is returned. */
static const char *check_record(const char *text, const char *known)
{
    struct family_case c;
    double x[8], found, want[3], p[3];
    if (!(text = family_numbers(text, 8, x)) || !family_parse_any(text, &c) ||
        !(known = family_numbers(known, 1, &found)))
        return NULL;
    const char *end = family_numbers(known, 3, want);
    const int side = (int)x[7];
    const cylint_hit hit = {.point = {x[0], x[1], x[2]},
                            .normal = {x[3], x[4], x[5]},
                            .part = (int)x[6]};
    const int is_found = cylint_outside(&c.shape, &hit, side, p);
    if (!CHECK(is_found == (int)found && is_finite3(p) &&
               (!is_found || cylint_contains(&c.shape, p) == side) &&
               (!end || memcmp(p, want, sizeof p) == 0)))
        REPORT("side %d: %a %a %a", side, p[0], p[1], p[2]);
    return end ? end : known;
}

TEST(known_points_are_found)
{
    each_record("tests/library/outside.txt", 28, check_record);
}
