/*
 * test_degenerate.c - floor methods: degenerate input
 *
 * The published methods keep the contract of cylint_intersect() on degenerate
 * input that doubles represent exactly: tangents, rims, and lines along a
 * ruling, in a cap's plane, along the axis of an open cylinder or through an
 * apex.
 */
#include <math.h>

#include "check.h"
#include "families.h"
#include "method_cases.h"

#define NO CYLINT_RELATION_MISS
#define TO CYLINT_RELATION_TOUCH
#define AL CYLINT_RELATION_ALONG
#define CR CYLINT_RELATION_CROSS

/* A line and its expected answer. */
typedef struct expected {
    int ends;
    double o[3], d[3];
    int relation, n;
    double t[2];
    int part[2];
} expected;

/* The library as a method: the expected answers are checked against it too. */
static cylint_status intersect(const cylint_shape *shape,
                               const cylint_line *line, unsigned want,
                               cylint_answer *answer)
{
    cylint_intersect(shape, line, want, answer);
    return CYLINT_OK;
}

static const cylint_method the_library = {"intersect", "", "", intersect};

/* Compares a hit of a method with the library's. */
static int same_hit(const cylint_hit *a, const cylint_hit *b)
{
    const double apart = fabs(a->phi - b->phi);
    int good = a->part == b->part && a->side == b->side &&
               fabs(a->t - b->t) <= 1e-12 && fabs(a->z - b->z) <= 1e-12 &&
               (apart <= 1e-12 || 1 - apart <= 1e-12);

    for (int i = 0; i < 3; i++)
        good = good && fabs(a->point[i] - b->point[i]) <= 1e-12 &&
               fabs(a->normal[i] - b->normal[i]) <= 1e-12;
    return good;
}

/* The line of the case and a shape with its ends. */
static struct family_case case_of(const expected *c, family_shape word,
                                  const double *shape)
{
    const double line[6] = {c->o[0], c->o[1], c->o[2],
                            c->d[0], c->d[1], c->d[2]};
    struct family_case made = family_of(FAMILY_LINE, line, word, shape);
    made.ends = (cylint_ends)c->ends;
    family_make(&made);
    return made;
}

static void check_expected(const cylint_method *m, const struct family_case *in,
                           const expected *c)
{
    cylint_answer a, library;

    cylint_intersect(&in->shape, &in->line, CYLINT_WANT_ALL, &library);
    CHECK(m->answer(&in->shape, &in->line, CYLINT_WANT_ALL, &a) == CYLINT_OK);
    int good = a.relation == c->relation && a.n == c->n && a.flags == 0;
    for (int i = 0; good && i < c->n; i++)
        good = a.hit[i].part == c->part[i] &&
               fabs(a.hit[i].t - c->t[i]) <= 1e-12 &&
               same_hit(&a.hit[i], &library.hit[i]);
    if (!CHECK(good)) {
        REPORT_CASE(in);
        REPORT("--method=%s: relation %d n %d t %a %a, expected %d %d %a %a",
               m->name, a.relation, a.n, a.hit[0].t, a.hit[1].t, c->relation,
               c->n, c->t[0], c->t[1]);
    }
}

/* Radius 1 about the z axis, 0 <= z <= 2. */
static const expected of_a_cylinder[] = {
    {CYLINT_ENDS_INFINITE, {-3, 0, 5}, {1, 0, 0}, CR, 2, {2, 4}, {0, 0}},
    {CYLINT_ENDS_INFINITE, {1, -3, 5}, {0, 1, 0}, TO, 1, {3}, {0}},
    {CYLINT_ENDS_INFINITE, {2, -3, 5}, {0, 1, 0}, NO, 0, {0}, {0}},
    {CYLINT_ENDS_INFINITE, {0.5, 0, 5}, {0, 0, 1}, CR, 0, {0}, {0}},
    {CYLINT_ENDS_INFINITE, {0, -1, 5}, {0, 0, 1}, AL, 0, {0}, {0}},
    {CYLINT_ENDS_INFINITE, {0, -2, 5}, {0, 0, 1}, NO, 0, {0}, {0}},
    {CYLINT_ENDS_NAPPE, {-3, 0, 5}, {1, 0, 0}, CR, 2, {2, 4}, {0, 0}},
    {CYLINT_ENDS_NAPPE, {0, -1, 5}, {0, 0, 1}, AL, 0, {0}, {0}},
    {CYLINT_ENDS_CAPPED, {-3, 0, 1}, {1, 0, 0}, CR, 2, {2, 4}, {0, 0}},
    {CYLINT_ENDS_CAPPED, {-3, 0, 5}, {1, 0, 0}, NO, 0, {0}, {0}},
    {CYLINT_ENDS_CAPPED, {1, -3, 1}, {0, 1, 0}, TO, 1, {3}, {0}},
    {CYLINT_ENDS_CAPPED, {1, -3, 3}, {0, 1, 0}, NO, 0, {0}, {0}},
    /* along the axis and along a ruling, both directions */
    {CYLINT_ENDS_CAPPED, {0.5, 0, 5}, {0, 0, -1}, CR, 2, {3, 5}, {2, 1}},
    {CYLINT_ENDS_CAP0, {0.5, 0, 5}, {0, 0, -1}, CR, 1, {5}, {1}},
    {CYLINT_ENDS_CAP1, {0.5, 0, 5}, {0, 0, -1}, CR, 1, {3}, {2}},
    {CYLINT_ENDS_OPEN, {0.5, 0, 5}, {0, 0, -1}, CR, 0, {0}, {0}},
    {CYLINT_ENDS_CAPPED, {0, -1, 5}, {0, 0, -1}, AL, 2, {3, 5}, {0, 0}},
    {CYLINT_ENDS_OPEN, {0, -1, -1}, {0, 0, 1}, AL, 2, {1, 3}, {0, 0}},
    {CYLINT_ENDS_CAPPED, {0, -2, 5}, {0, 0, -1}, NO, 0, {0}, {0}},
    /* in the planes of the caps: a chord, a tangent, a miss */
    {CYLINT_ENDS_CAPPED, {-3, 0, 0}, {1, 0, 0}, AL, 2, {2, 4}, {0, 0}},
    {CYLINT_ENDS_CAPPED, {-3, 0, 2}, {1, 0, 0}, AL, 2, {2, 4}, {0, 0}},
    {CYLINT_ENDS_CAPPED, {1, -3, 2}, {0, 1, 0}, TO, 1, {3}, {0}},
    {CYLINT_ENDS_OPEN, {1, -3, 0}, {0, 1, 0}, TO, 1, {3}, {0}},
};

/* The case at four times the size: t does not change. */
static expected times_four(const expected *c)
{
    expected scaled = *c;
    for (int i = 0; i < 3; i++) {
        scaled.o[i] *= 4;
        scaled.d[i] *= 4;
    }
    return scaled;
}

static void cylinder_methods_keep_the_contract(void)
{
    const double small[7] = {0, 0, 0, 0, 0, 2, 1},
                 wide[7] = {0, 0, 0, 0, 0, 8, 4};
    const int n = sizeof of_a_cylinder / sizeof *of_a_cylinder;

    for (const cylint_method *m = cylint_methods(); m->name; m++)
        for (int i = 0; i < n; i++) {
            const expected *c = &of_a_cylinder[i], far = times_four(c);
            const struct family_case in = case_of(c, FAMILY_CYLINDER, small),
                                     out = case_of(&far, FAMILY_CYLINDER, wide);
            check_expected(&the_library, &in, c);
            if (!answers_for(m->name, CYLINT_KIND_CYLINDER, c->ends))
                continue;
            check_expected(m, &in, c);
            check_expected(m, &out, &far);
        }
}

/* By a method and by the library: the cone with the apex at the origin, z = 1 at
 * (0, 0, height) and radius there, by its tangent and by its radii. */
static void check_cone(const cylint_method *m, double height, double radius,
                       const expected *c)
{
    const double tangent = radius / height, v[3] = {0, 0, 0},
                 u[3] = {0, 0, height}, turn = 57.29577951308232; /* 180 / pi */
    const double angle[7] = {0, 0, 0, 0, 0, height, atan(tangent) * turn},
                 radii[8] = {0, 0, 0, 0, 0, 0, height, radius};
    struct family_case in[2] = {case_of(c, FAMILY_ACONE, angle),
                                case_of(c, FAMILY_CONE, radii)};
    cylint_tangent_cone(&in[0].shape, v, u, tangent, (cylint_ends)c->ends);
    for (int i = 0; i < 2; i++) {
        check_expected(&the_library, &in[i], c);
        if (answers_for(m->name, CYLINT_KIND_CONE, c->ends))
            check_expected(m, &in[i], c);
    }
}

/* Apex at the origin, about the z axis, tangent 3/4; z = 1 at (0, 0, 4). */
static const expected of_a_cone[] = {
    {CYLINT_ENDS_INFINITE, {-8, 0, 4}, {1, 0, 0}, CR, 2, {5, 11}, {0, 0}},
    {CYLINT_ENDS_INFINITE, {-8, 0, -4}, {1, 0, 0}, CR, 2, {5, 11}, {0, 0}},
    {CYLINT_ENDS_INFINITE, {3, 0, 0}, {0, 0, 1}, CR, 2, {-4, 4}, {0, 0}},
    {CYLINT_ENDS_INFINITE, {0, 0, -4}, {0, 0, 1}, CR, 1, {4}, {0}},
    {CYLINT_ENDS_INFINITE, {-8, 0, 0}, {1, 0, 0}, TO, 1, {8}, {0}},
    {CYLINT_ENDS_INFINITE, {8, 3, 0}, {1, 0, 0}, NO, 0, {0}, {0}},
    {CYLINT_ENDS_NAPPE, {-8, 0, 4}, {1, 0, 0}, CR, 2, {5, 11}, {0, 0}},
    {CYLINT_ENDS_NAPPE, {-8, 0, -4}, {1, 0, 0}, NO, 0, {0}, {0}},
    {CYLINT_ENDS_NAPPE, {3, 0, 0}, {0, 0, 1}, CR, 1, {4}, {0}},
    {CYLINT_ENDS_NAPPE, {3, 0, 0}, {0, 0, -1}, CR, 1, {-4}, {0}},
    {CYLINT_ENDS_NAPPE, {0, 0, -4}, {0, 0, 1}, CR, 1, {4}, {0}},
    {CYLINT_ENDS_NAPPE, {-8, 0, 0}, {1, 0, 0}, TO, 1, {8}, {0}},
    {CYLINT_ENDS_CAPPED, {0, 0, -4}, {0, 0, 1}, CR, 2, {4, 8}, {0, 2}},
    {CYLINT_ENDS_OPEN, {0, 0, -4}, {0, 0, 1}, CR, 1, {4}, {0}},
    {CYLINT_ENDS_CAPPED, {0, 0, 8}, {0, 0, -1}, CR, 2, {4, 8}, {2, 0}},
    {CYLINT_ENDS_CAPPED, {-8, 0, 0}, {1, 0, 0}, TO, 1, {8}, {0}},
    {CYLINT_ENDS_CAPPED, {-8, 0, 4}, {1, 0, 0}, AL, 2, {5, 11}, {0, 0}},
};

static void cone_methods_keep_the_contract(void)
{
    const int n = sizeof of_a_cone / sizeof *of_a_cone;

    for (const cylint_method *m = cylint_methods(); m->name; m++)
        for (int i = 0; i < n; i++)
            check_cone(m, 4, 3, &of_a_cone[i]);
}

static const cylint_method *method_named(const char *name)
{
    const cylint_method *m = cylint_methods();
    while (strcmp(m->name, name))
        m++;
    return m;
}

/* Lines parallel to a ruling, along one, and in the tangent plane of one.  The
 * cone has the tangent 1 and the z axis, so the quadratic's coefficients are
 * exact. */
static const expected of_a_right_angled_cone[] = {
    {CYLINT_ENDS_INFINITE, {0, 0, -1}, {1, 0, 1}, CR, 1, {0.5}, {0}},
    {CYLINT_ENDS_INFINITE, {0, 0, 1}, {1, 0, 1}, CR, 1, {-0.5}, {0}},
    {CYLINT_ENDS_INFINITE, {1, 0, 1}, {1, 0, 1}, AL, 0, {0}, {0}},
    {CYLINT_ENDS_INFINITE, {0, 1, 0}, {1, 0, 1}, NO, 0, {0}, {0}},
    {CYLINT_ENDS_NAPPE, {0, 0, 1}, {1, 0, 1}, CR, 1, {-0.5}, {0}},
    {CYLINT_ENDS_NAPPE, {0, 0, -1}, {1, 0, 1}, NO, 0, {0}, {0}},
    {CYLINT_ENDS_NAPPE, {1, 0, 1}, {1, 0, 1}, AL, 1, {-1}, {0}},
    {CYLINT_ENDS_CAPPED, {0, 0, 0.5}, {1, 0, 1}, CR, 2, {-0.25, 0.5}, {0, 2}},
    {CYLINT_ENDS_CAPPED, {1, 0, 1}, {1, 0, 1}, AL, 2, {-1, 0}, {0, 0}},
};

static void lines_parallel_to_a_ruling_have_their_relations(void)
{
    const int n =
        sizeof of_a_right_angled_cone / sizeof *of_a_right_angled_cone;

    for (int i = 0; i < n; i++)
        check_cone(method_named("quadratic"), 1, 1, &of_a_right_angled_cone[i]);
}

/* A diagonal through two rims.  No double represents its unit vector, so only
 * methods that do not normalise hit both rims. */
static const expected through_rims[] = {
    {CYLINT_ENDS_CAPPED, {-3, 0, -2}, {1, 0, 1}, CR, 2, {2, 4}, {0, 0}},
    {CYLINT_ENDS_OPEN, {-3, 0, -2}, {1, 0, 1}, CR, 2, {2, 4}, {0, 0}},
    {CYLINT_ENDS_CAPPED, {3, 0, -2}, {-2, 0, 2}, CR, 2, {1, 2}, {0, 0}},
    {CYLINT_ENDS_CAPPED, {-3, 0, 0}, {1, 0, 1}, TO, 1, {2}, {0}},
    {CYLINT_ENDS_OPEN, {-3, 0, 0}, {1, 0, 1}, TO, 1, {2}, {0}},
    {CYLINT_ENDS_CAPPED, {-3, 0, -4}, {1, 0, 1}, TO, 1, {4}, {0}},
    {CYLINT_ENDS_OPEN, {-3, 0, -4}, {1, 0, 1}, TO, 1, {4}, {0}},
    {CYLINT_ENDS_OPEN, {-3, 0, 4}, {1, 0, -1}, CR, 2, {2, 4}, {0, 0}},
    {CYLINT_ENDS_CAP0, {-3, 0, 2}, {1, 0, -1}, TO, 1, {2}, {0}},
};

static void a_point_of_a_rim_counts_once_and_as_lateral(void)
{
    static const char *const names[] = {"quadratic", "gullotti",
                                        "closest-points"};
    const double shape[7] = {0, 0, 0, 0, 0, 2, 1};
    const int n = sizeof through_rims / sizeof *through_rims;

    for (int k = 0; k < 3; k++)
        for (int i = 0; i < n; i++) {
            const expected *c = &through_rims[i];
            const struct family_case in = case_of(c, FAMILY_CYLINDER, shape);
            check_expected(&the_library, &in, c);
            check_expected(method_named(names[k]), &in, c);
        }
}

/* Lines aimed at the apex miss it by an ulp or two.  Whatever the quadratic
 * computes, no hit is on the absent cap. */
static void a_pointed_end_is_never_hit_as_a_cap(void)
{
    const double apex[3] = {1, 2, 3}, other[3] = {2, 4, 7};
    cylint_shape down, up;
    cylint_answer a;
    int hits = 0;

    cylint_cone(&down, apex, 0, other, 2, CYLINT_ENDS_CAPPED);
    cylint_cone(&up, other, 2, apex, 0, CYLINT_ENDS_CAPPED);
    for (int i = 1; i < 1000; i++) {
        const double d[3] = {1 + i / 7.0, 2 - i / 300.0, 4 + i / 11.0};
        double o[3];
        cylint_line line;
        for (int j = 0; j < 3; j++)
            o[j] = apex[j] - i / 3.0 * d[j];
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

static void only_wanted_members_are_written(void)
{
    const double o[3] = {0, 0, 0}, up[3] = {0, 0, 1};
    const double from[3] = {-3, 0, 0.5}, x[3] = {1, 0, 0};
    cylint_shape shape;
    cylint_line line;
    cylint_answer a;

    cylint_cylinder(&shape, o, up, 1, CYLINT_ENDS_INFINITE);
    cylint_whole_line(&line, from, x);
    memset(&a, 0x55, sizeof a);
    const cylint_answer before = a;
    cylint_quadratic(&shape, &line, CYLINT_WANT_COUNT, &a);
    CHECK(a.relation == CYLINT_RELATION_CROSS && a.n == 2);
    CHECK(!memcmp(a.hit, before.hit, sizeof a.hit));
    cylint_quadratic(&shape, &line, CYLINT_WANT_NEAREST | CYLINT_WANT_T, &a);
    CHECK(a.n == 1 && a.hit[0].t == 2);
    CHECK(!memcmp(&a.hit[0].z, &before.hit[0].z, sizeof(double)));
    CHECK(!memcmp(&a.hit[1], &before.hit[1], sizeof a.hit[1]));
}

/* A member wanted alone has the value that it has when all are wanted. */
static void each_member_is_written_by_itself(void)
{
    static const unsigned wants[] = {CYLINT_WANT_POINT, CYLINT_WANT_NORMAL,
                                     CYLINT_WANT_Z, CYLINT_WANT_PHI};
    const double o[3] = {0, 0, 0}, up[3] = {0, 0, 2};
    const double from[3] = {-3, 0.6, 0.5}, x[3] = {1, 0, 0};
    cylint_shape shape;
    cylint_line line;
    cylint_answer all;

    cylint_cone(&shape, o, 1, up, 1.5, CYLINT_ENDS_CAPPED);
    cylint_whole_line(&line, from, x);
    cylint_quadratic(&shape, &line, CYLINT_WANT_ALL, &all);
    CHECK(all.n == 2);
    for (int i = 0; i < 4; i++) {
        cylint_answer a, want;
        memset(&a, 0x55, sizeof a);
        memset(&want, 0x55, sizeof want);
        for (int k = 0; k < 2; k++) {
            cylint_hit *to = &want.hit[k];
            if (wants[i] == CYLINT_WANT_POINT)
                memcpy(to->point, all.hit[k].point, sizeof to->point);
            if (wants[i] == CYLINT_WANT_NORMAL)
                memcpy(to->normal, all.hit[k].normal, sizeof to->normal);
            if (wants[i] == CYLINT_WANT_Z)
                to->z = all.hit[k].z;
            if (wants[i] == CYLINT_WANT_PHI)
                to->phi = all.hit[k].phi;
        }
        cylint_quadratic(&shape, &line, wants[i], &a);
        CHECK(a.n == 2 && !memcmp(a.hit, want.hit, sizeof a.hit));
    }
}

/* At the apex of a pointed cone the normal points away from the solid, at that
 * of a double cone against d. */
static void normals_at_an_apex_are_the_librarys(void)
{
    static const expected through_apex[] = {
        {CYLINT_ENDS_CAPPED, {-3, 0, 0}, {1, 0, 0}, TO, 1, {3}, {0}},
        {CYLINT_ENDS_INFINITE, {-2, 0, -1}, {2, 0, 1}, TO, 1, {1}, {0}},
        {CYLINT_ENDS_INFINITE, {-2, 0, 1}, {2, 0, -1}, TO, 1, {1}, {0}},
    };
    const double upward[8] = {0, 0, -1, 1, 0, 0, 0, 0};
    const cylint_method *m = method_named("quadratic");

    for (int i = 0; i < 3; i++) {
        const struct family_case in =
            case_of(&through_apex[i], FAMILY_CONE, upward);
        check_expected(m, &in, &through_apex[i]);
        check_cone(m, 1, 1, &through_apex[i]);
    }
}

/* An angle slightly below 0 is 0, not one turn. */
static void an_angle_stays_below_a_turn(void)
{
    const double o[3] = {0, 0, 0}, up[3] = {0, 0, 1}, y[3] = {0, 1, 0};
    cylint_shape shape;

    cylint_cylinder(&shape, o, up, 1, CYLINT_ENDS_CAPPED);
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
static void a_tangent_plane_has_one_ruling(void)
{
    const double o[3] = {0, 0, 0}, up[3] = {0, 0, 1};
    int touches = 0, misses = 0;
    cylint_shape cone, narrow;
    cylint_line line;
    cylint_answer a;

    cylint_angle_cone(&cone, o, up, 45, CYLINT_ENDS_INFINITE);
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

int main(void)
{
    RUN(each_member_is_written_by_itself);
    RUN(normals_at_an_apex_are_the_librarys);
    RUN(an_angle_stays_below_a_turn);
    RUN(a_tangent_plane_has_one_ruling);
    RUN(cylinder_methods_keep_the_contract);
    RUN(cone_methods_keep_the_contract);
    RUN(lines_parallel_to_a_ruling_have_their_relations);
    RUN(a_point_of_a_rim_counts_once_and_as_lateral);
    RUN(a_pointed_end_is_never_hit_as_a_cap);
    RUN(only_wanted_members_are_written);
    return check_end();
}
