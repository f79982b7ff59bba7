/*
 * test_origin.c - lines that begin exactly on a surface
 *
 * The points lie on the surfaces because their data are whole numbers or their
 * last coordinate is free.  Whatever the domain, the hits are those hits of the
 * whole line whose t lies in it, and for a line that crosses one of them is
 * exactly 0. This holds with all kernels, and whatever is wanted. Of data of
 * few digits, signs that are 0 need no exact numbers.
 */
#include <math.h>

#include "check.h"
#include "cylint.h"
#include "environment.h"
#include "draw.h"
#include "same.h"
#include "signs/sign.h"

enum { CASES = 4000, VERDICT = CYLINT_WANT_T | CYLINT_WANT_PART };

#define ONE 0x1.0d6f3a19c5e27p0

static int either_sign(void)
{
    return one_of(2) ? 1 : -1;
}

/* A point of the circle of radius 5 k. */
static void on_circle(int k, double *x, double *y)
{
    static const int points[][2] = {{3, 4}, {4, 3}, {5, 0}, {0, 5}};
    const int i = one_of(4);
    *x = either_sign() * k * points[i][0];
    *y = either_sign() * k * points[i][1];
}

static cylint_ends any_ends(void)
{
    return (cylint_ends)one_of(CYLINT_ENDS_NAPPE + 1);
}

/* An upright shape of one of several kinds and a point of its mantle, or of its
 * plane z = 0 inside the disc. */
static void upright(cylint_shape *shape, double point[3])
{
    const int k = whole_between(1, 3), m = whole_between(1, 3),
              h = 2 * whole_between(1, 4), on_cap = one_of(2);
    const cylint_ends ends = any_ends();
    const double base[3] = {0, 0, 0}, top[3] = {0, 0, h};
    const double a[3] = {5 * k, 0, 0}, b[3] = {0, 10 * k, 0};
    int r = k;
    point[2] = between(0, h);
    switch (one_of(4)) {
    case 0:
        cylint_cylinder(shape, base, top, 5 * k, ends);
        break;
    case 1:
        cylint_cone(shape, base, 10 * k, top, 10 * m, ends);
        point[2] = h / 2;
        r = k + m;
        break;
    case 2:
        cylint_elliptic_cylinder(shape, base, a, b, top, ends);
        break;
    default:
        cylint_sphere(shape, base, 5 * k, CYLINT_ENDS_CAPPED);
        point[2] = 0;
        break;
    }
    on_circle(r, &point[0], &point[1]);
    if (shape->kind == CYLINT_KIND_ECYLINDER)
        point[1] *= 2;
    if (on_cap && shape->kind != CYLINT_KIND_SPHERE &&
        ends < CYLINT_ENDS_INFINITE) {
        point[0] = between(0, 3 * k);
        point[1] = between(0, 3 * k);
        point[2] = 0;
    }
}

/* A cylinder whose axis is m (3, 4, 0), and a point of its mantle or inside its
 * first cap: x (-4, 3, 0) has the length 5 x. */
static void tilted(cylint_shape *shape, double point[3])
{
    const int k = whole_between(1, 4), m = whole_between(1, 4);
    int i = one_of(m + 1);
    const double base[3] = {0, 0, 0}, top[3] = {3 * m, 4 * m, 0};
    double x, z;
    cylint_cylinder(shape, base, top, 25 * k, any_ends());
    on_circle(5 * k, &x, &z);
    x /= 5;
    if (shape->ends < CYLINT_ENDS_INFINITE && one_of(2)) {
        i = 0;
        x = one_of(2 * k);
        z = between(0, 9 * k);
    }
    point[0] = 3 * i - 4 * x;
    point[1] = 4 * i + 3 * x;
    point[2] = z;
}

static void make_direction(double d[3])
{
    const int is_whole = one_of(3) == 0;
    do
        for (int i = 0; i < 3; i++)
            d[i] = is_whole ? one_of(9) - 4 : between(-1, 1);
    while (d[0] == 0 && d[1] == 0 && d[2] == 0);
}

/* The hits of `all` with tmin <= t <= tmax. */
static cylint_answer cut(const cylint_answer *all, double tmin, double tmax)
{
    cylint_answer cut = *all;
    cut.n = 0;
    for (int i = 0; i < all->n; i++)
        if (tmin <= all->hit[i].t && all->hit[i].t <= tmax)
            cut.hit[cut.n++] = all->hit[i];
    return cut;
}

static void check_domain(const cylint_shape *shape, const double o[3],
                         const double d[3], double tmin, double tmax,
                         const cylint_answer *all)
{
    const cylint_answer want = cut(all, tmin, tmax);
    cylint_answer got, count, first;
    cylint_line line;
    cylint_span(&line, o, d, tmin, tmax);
    cylint_intersect(shape, &line, VERDICT, &got);
    cylint_intersect(shape, &line, CYLINT_WANT_COUNT, &count);
    cylint_intersect(shape, &line, VERDICT | CYLINT_WANT_NEAREST, &first);
    int same = got.n == want.n && count.n == want.n &&
               first.n == (want.n > 0) && got.relation == all->relation &&
               cylint_occluded(shape, &line) == (want.n > 0);
    for (int i = 0; i < got.n && same; i++)
        same = same_hit(&got.hit[i], &want.hit[i], VERDICT);
    if (!CHECK(same &&
               (want.n == 0 || same_hit(&first.hit[0], &want.hit[0], VERDICT))))
        REPORT("%s: kind %d, ends %d, span %a %a %a  %a %a %a  %a %a: %d hits, "
               "%d counted, not %d",
               cylint_kernels_in_use(), shape->kind, shape->ends, o[0], o[1],
               o[2], d[0], d[1], d[2], tmin, tmax, got.n, count.n, want.n);
}

/* begins: the line begins on the surface. */
static void check_line(const cylint_shape *shape, const double o[3],
                       const double d[3], int begins)
{
    /* no other root is ONE or near it */
    static const double domain[][2] = {{0, HUGE_VAL},
                                       {-HUGE_VAL, 0},
                                       {0, 0},
                                       {0, ONE},
                                       {-ONE, 0},
                                       {-0.0, ONE},
                                       {-ONE, -0.0},
                                       {0x1p-1074, HUGE_VAL},
                                       {-HUGE_VAL, -0x1p-1074},
                                       {-ONE, ONE}};
    cylint_answer all;
    cylint_line line;
    cylint_whole_line(&line, o, d);
    cylint_intersect(shape, &line, VERDICT, &all);
    for (size_t i = 0; i < sizeof domain / sizeof *domain; i++)
        check_domain(shape, o, d, domain[i][0], domain[i][1], &all);
    int zeros = 0;
    for (int i = 0; i < all.n; i++)
        zeros += all.hit[i].t == 0;
    if (all.relation == CYLINT_RELATION_CROSS &&
        (shape->ends == CYLINT_ENDS_CAPPED ||
         shape->ends == CYLINT_ENDS_INFINITE))
        CHECK(zeros == begins);
}

static void check_point(const cylint_shape *shape, const double point[3],
                        int is_on)
{
    double d[3];
    make_direction(d);
    EACH_KERNELS(k) {
        if (!CHECK((cylint_contains(shape, point) == 0) == is_on))
            REPORT("%s: kind %d, ends %d, point %a %a %a",
                   cylint_kernels_in_use(), shape->kind, shape->ends, point[0],
                   point[1], point[2]);
        check_line(shape, point, d, is_on);
    }
}

TEST(hits_of_a_domain_are_those_of_the_whole_line)
{
    for (int i = 0; i < CASES; i++) {
        cylint_shape shape;
        double point[3];
        (i % 2 ? tilted : upright)(&shape, point);
        check_point(&shape, point, 1);
    }
}

/* So near that no arithmetic but an exact one finds the difference; then so near
 * that the square of the distance underflows, and t is rounded to 0. */
TEST(a_line_that_begins_beside_a_surface_has_no_hit_at_0)
{
    for (int i = 0; i < CASES; i++) {
        const int k = whole_between(1, 3), e = 40 + one_of(200);
        const double base[3] = {0, 0, 0}, top[3] = {0, 0, 8};
        const double off = either_sign() * ldexp(1, -e);
        const double beside_mantle[3] = {5 * k, off, 1 + between(0, 4)};
        const double x = between(0, k), y = between(0, k);
        const double beside_cap[3] = {x, y, off};
        cylint_shape shape;
        cylint_cylinder(&shape, base, top, 5 * k, CYLINT_ENDS_CAPPED);
        check_point(&shape, i % 2 ? beside_mantle : beside_cap, 0);
        const double point[3] = {5 * k, ldexp(off, -480), 1 + between(0, 4)};
        CHECK(cylint_contains(&shape, point) == -1);
    }
}

/* ------------------------------------------------ without exact numbers -- */

static double tenths(int n)
{
    return 0.1 * whole_between(1, n);
}

/* The sign of a form is 0, and neither it nor those before it in q were computed in
 * exact numbers. */
static void check_zero(cylint_query *q, cylint_form f)
{
    const int sign = cylint_form_sign(q, f, 0);
    if (!CHECK(sign == 0 && !q->exact.ready))
        REPORT("kind %d, form %d: sign %d", q->kind, (int)f, sign);
}

/* From a point of the mantle, or of a rim, whose last coordinate is any number. */
static void check_mantle(int kind)
{
    const int k = whole_between(1, 3), cone = kind == CYLINT_KIND_CONE;
    const double base[3] = {0, 0, 0}, top[3] = {0, 0, 4};
    const double on_rim[3] = {3 * k, -4 * k, 0};
    const double point[3] = {3 * k, 4 * k, cone ? 2 : 1 + between(0, 2)};
    double towards[3];
    cylint_shape shape;
    cylint_line line;
    cylint_query q;
    for (int i = 0; i < 3; i++)
        towards[i] = whole_between(1, 9);
    if (kind == CYLINT_KIND_CAPSULE)
        cylint_capsule(&shape, base, top, 5 * k, CYLINT_ENDS_CAPPED);
    else
        cylint_cone(&shape, base, cone ? 5 * k + 2 : 5 * k, top,
                    cone ? 5 * k - 2 : 5 * k, CYLINT_ENDS_CAPPED);
    cylint_ray(&line, point, towards);
    cylint_query_open(&q, &shape, &line);
    check_zero(&q, FORM_C);
    if (cone)
        return;
    cylint_ray(&line, on_rim, towards);
    cylint_query_open(&q, &shape, &line);
    check_zero(&q, FORM_ALPHA);
    check_zero(&q, FORM_C);
    check_zero(&q, FORM_E);
}

/* Tangents of an upright cylinder along axes and diagonals, and points of its
 * mantle and base, in tenths. */
static void check_tenths(void)
{
    const double r = tenths(90), z = tenths(30);
    const double base[3] = {0, 0, z}, top[3] = {0, 0, z + tenths(50)};
    const double on_mantle[3] = {0, -r, tenths(90)};
    const double x = between(0, 1), y = between(0, 1);
    const double on_base[3] = {x, y, z};
    const double tangent[3] = {1, 0, one_of(2)};
    cylint_shape shape;
    cylint_line line;
    cylint_query q;
    cylint_cylinder(&shape, base, top, r, CYLINT_ENDS_CAPPED);
    cylint_whole_line(&line, on_mantle, tangent);
    cylint_query_open(&q, &shape, &line);
    check_zero(&q, FORM_C);
    check_zero(&q, FORM_G);
    check_zero(&q, FORM_B);
    cylint_whole_line(&line, on_base, tangent);
    cylint_query_open(&q, &shape, &line);
    check_zero(&q, FORM_ALPHA);
}

/* A library that compares every sign with the exact one. */
static int is_paranoid(void)
{
    const double o[3] = {0, 0, 0}, d[3] = {1, 0, 0};
    cylint_shape shape;
    cylint_line line;
    cylint_query q;
    cylint_sphere(&shape, o, 1, CYLINT_ENDS_CAPPED);
    cylint_ray(&line, o, d);
    cylint_query_open(&q, &shape, &line);
    cylint_form_sign(&q, FORM_C, 0);
    return q.exact.ready;
}

TEST(zeros_of_few_digits_need_no_exact_numbers)
{
    if (is_paranoid())
        return;
    for (int i = 0; i < CASES; i++) {
        check_mantle(CYLINT_KIND_CYLINDER);
        check_mantle(CYLINT_KIND_CAPSULE);
        check_mantle(CYLINT_KIND_CONE);
        check_tenths();
    }
}
