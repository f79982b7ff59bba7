/*
 * test_degenerate.c - degenerate input
 *
 * The published methods keep the contract of cylint_intersect() on degenerate
 * input that doubles represent exactly: tangents, rims, and lines along a
 * ruling, in a cap's plane, along the axis of an open cylinder or through an
 * apex (degenerate.txt).
 */
#include <math.h>

#include "check.h"
#include "method_cases.h"
#include "records.h"
#include "same.h"
#include "vectors.h"

/* The library as a method: the expected answers are checked against it too. */
static cylint_status intersect(const cylint_shape *shape,
                               const cylint_line *line, unsigned want,
                               cylint_answer *answer)
{
    cylint_intersect(shape, line, want, answer);
    return CYLINT_OK;
}

static const cylint_method the_library = {"intersect", "", "", intersect};

/* want: relation, n, t and part. */
static void check_method(const cylint_method *m, const struct family_case *c,
                         const cylint_answer *want)
{
    cylint_answer a, library;
    double worst = 0;
    cylint_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &library);
    CHECK(m->answer(&c->shape, &c->line, CYLINT_WANT_ALL, &a) == CYLINT_OK);
    int good = a.relation == want->relation && a.n == want->n &&
               agrees(&a, &library, 1e-12, &worst);
    for (int i = 0; good && i < a.n; i++)
        good = a.hit[i].part == want->hit[i].part &&
               fabs(a.hit[i].t - want->hit[i].t) <= 1e-12;
    if (!CHECK(good)) {
        REPORT_CASE(c);
        REPORT("--method=%s: %s n %d t %a %a, expected %s %d %a %a", m->name,
               relation_word(a.relation), a.n, a.hit[0].t, a.hit[1].t,
               relation_word(want->relation), want->n, want->hit[0].t,
               want->hit[1].t);
    }
}

/* methods: "all", or their names. */
static void check_methods(const struct family_case *c,
                          const cylint_answer *want, const char *methods)
{
    check_method(&the_library, c, want);
    for (const cylint_method *m = cylint_methods(); m->name; m++)
        if ((strstr(methods, "all") || strstr(methods, m->name)) &&
            answers_for(m->name, c->shape.kind, (int)c->shape.ends))
            check_method(m, c, want);
}

/* Also at four times the size, where t is the same, and a cone with the apex at its
 * base by its tangent. */
static const char *check_record(const char *text, const char *known)
{
    struct family_case c;
    cylint_answer want = {0};
    if (!family_parse(text, &c) || !(known = read_relation(known, &want)))
        return NULL;
    for (int i = 0; i < want.n && known; i++) {
        double x[2] = {0};
        known = family_numbers(known, 2, x);
        want.hit[i].t = x[0];
        want.hit[i].part = (int)x[1];
    }
    for (int times = 0; times < 2 && known; times++) {
        check_methods(&c, &want, known);
        const double *x = c.shape_data;
        if (c.shape_word == FAMILY_CONE && x[3] == 0) {
            struct family_case by_tangent = c;
            cylint_tangent_cone(&by_tangent.shape, x, x + 4, x[7] / x[6],
                                c.ends);
            check_methods(&by_tangent, &want, known);
        }
        for (int i = 0; i < 6; i++)
            c.line_data[i] *= 4;
        for (int i = 0; i < family_shape_size(c.shape_word); i++)
            c.shape_data[i] *= 4;
        family_make(&c);
    }
    return known ? known + strlen(known) : NULL;
}

TEST(the_methods_keep_the_contract)
{
    each_record("tests/methods/degenerate.txt", 64, check_record);
}

/* Lines aimed at the apex miss it by an ulp or two.  Whatever the quadratic
 * computes, no hit is on the absent cap. */
TEST(a_pointed_end_is_never_hit_as_a_cap)
{
    const double apex[3] = {1, 2, 3};
    const cylint_shape down = shape_of("cone 1 2 3 0  2 4 7 2"),
                       up = shape_of("cone 2 4 7 2  1 2 3 0");
    cylint_answer a;
    int hits = 0;
    for (int i = 1; i < 1000; i++) {
        const double d[3] = {1 + i / 7.0, 2 - i / 300.0, 4 + i / 11.0};
        double o[3];
        cylint_line line;
        along3(o, apex, -i / 3.0, d);
        cylint_whole_line(&line, o, d);
        cylint_quadratic(&down, &line, CYLINT_WANT_ALL, &a);
        for (int k = 0; k < a.n; k++, hits++)
            CHECK(a.hit[k].part != CYLINT_PART_CAP0);
        cylint_quadratic(&up, &line, CYLINT_WANT_ALL, &a);
        for (int k = 0; k < a.n; k++, hits++)
            CHECK(a.hit[k].part != CYLINT_PART_CAP1);
    }
    CHECK(hits > 500);
}

/* A member wanted alone has the value that it has when all are wanted, and no other
 * is written. */
TEST(each_member_is_written_by_itself)
{
    static const unsigned wants[] = {
        CYLINT_WANT_COUNT,  CYLINT_WANT_T,
        CYLINT_WANT_PART,   CYLINT_WANT_POINT,
        CYLINT_WANT_NORMAL, CYLINT_WANT_Z,
        CYLINT_WANT_PHI,    CYLINT_WANT_T | CYLINT_WANT_NEAREST};
    const struct family_case c =
        case_of("line -3 0.6 0.5 1 0 0  cone 0 0 0 1 0 0 2 1.5");
    cylint_answer all, want, a;
    cylint_quadratic(&c.shape, &c.line, CYLINT_WANT_ALL, &all);
    CHECK(all.relation == CYLINT_RELATION_CROSS && all.n == 2);
    for (size_t i = 0; i < sizeof wants / sizeof *wants; i++) {
        memset(&a, UNTOUCHED, sizeof a);
        want.n = wants[i] & CYLINT_WANT_NEAREST ? 1 : 2;
        for (int k = 0; k < 2; k++)
            want.hit[k] = with_members(&all.hit[k], k < want.n ? wants[i] : 0);
        cylint_quadratic(&c.shape, &c.line, wants[i], &a);
        CHECK(a.relation == all.relation && a.n == want.n &&
              same_bytes(a.hit, want.hit, sizeof a.hit));
    }
}

/* An angle slightly below 0 is 0, not one turn. */
TEST(an_angle_stays_below_a_turn)
{
    const double y[3] = {0, 1, 0};
    const cylint_shape shape = shape_of("cylinder 0 0 0  0 0 1  1");
    for (int sign = -1; sign <= 1; sign += 2) {
        const double from[3] = {sign * 1e-300, -2, 0.5};
        cylint_line line;
        cylint_answer a;
        cylint_whole_line(&line, from, y);
        CHECK(cylint_quadratic(&shape, &line, CYLINT_WANT_PHI, &a) ==
                  CYLINT_OK &&
              a.n == 2);
        CHECK(a.hit[0].phi >= 0 && a.hit[0].phi < 1e-300);
    }
}

/* Shene's plane is tangent to the cone in a ruling.  The line meets the ruling
 * in one point, or is parallel to it. */
TEST(a_tangent_plane_has_one_ruling)
{
    const double o[3] = {0, 0, 0}, up[3] = {0, 0, 1};
    int touches = 0, misses = 0;
    const cylint_shape cone = shape_of("acone 0 0 0  0 0 1  45  ends=infinite");
    cylint_shape narrow;
    cylint_line line;
    cylint_answer a;
    for (int i = 1; i <= 40; i++) { /* the ruling along (x, y, hypot(x, y)) */
        const double x = i * i - 400, y = 40 * i, z = i * i + 400;
        const double across[3] = {-y, x, 0};
        const double beside[3] = {0, 1, 0}, along[3] = {i / 32., 0, 1};
        const double at[3] = {x - y, y + x, z}; /* on the ruling's tangent */
        cylint_whole_line(&line, at, across);
        cylint_shene_cone(&cone, &line, CYLINT_WANT_T, &a);
        if (a.relation == CYLINT_RELATION_TOUCH)
            touches += CHECK(a.n == 1 && fabs(a.hit[0].t + 1) < 1e-9);
        cylint_tangent_cone(&narrow, o, up, i / 32., CYLINT_ENDS_INFINITE);
        cylint_whole_line(&line, beside, along);
        cylint_shene_cone(&narrow, &line, CYLINT_WANT_T, &a);
        misses += a.relation == CYLINT_RELATION_MISS;
    }
    /* rounding keeps the plane tangent and the line parallel */
    CHECK(touches > 0);
    CHECK(misses > 0);
}
