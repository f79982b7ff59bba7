/*
 * test_zeros.c - signs that are 0 of data of few digits, without exact numbers
 *
 * Lines begin on a surface, in whole numbers and tenths, or touch it.
 */
#include "check.h"
#include "cylint.h"
#include "draw.h"
#include "signs/sign.h"

enum { CASES = 4000 };

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
