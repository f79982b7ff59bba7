/*
 * The published methods keep the contract of cylint_intersect() on
 * degenerate input that doubles hold exactly: tangents, rims, lines along a
 * ruling, in a cap's plane, down an open cylinder, through an apex.
 */
#include <math.h>

#include "method_cases.h"

#define NO CYLINT_MISS
#define TO CYLINT_TOUCH
#define AL CYLINT_ALONG
#define CR CYLINT_CROSS

/* One case: a line and what is due. */
typedef struct due {
    int ends;
    double o[3], d[3];
    int relation, n;
    double t[2];
    int part[2];
} due;

static void check_due(const cylint_method *m, const cylint_shape *shape,
                      const due *c)
{
    cylint_line line;
    cylint_answer a;

    cylint_whole_line(&line, c->o, c->d);
    CHECK(m->answer(shape, &line, CYLINT_WANT_ALL, &a) == CYLINT_OK);
    int good = a.relation == c->relation && a.n == c->n && a.flags == 0;
    for (int i = 0; good && i < c->n; i++)
        good = a.hit[i].part == c->part[i] &&
               fabs(a.hit[i].t - c->t[i]) <= 1e-12;
    if (!CHECK(good)) {
        report_case(m->name, shape, &line);
        REPORT("relation %d n %d t %a %a, due %d %d %a %a", a.relation, a.n,
               a.hit[0].t, a.hit[1].t, c->relation, c->n, c->t[0], c->t[1]);
    }
}

/* Radius 1 about the z axis, 0 <= z <= 2. */
static const due of_a_cylinder[] = {
    {CYLINT_INFINITE, {-3, 0, 5}, {1, 0, 0}, CR, 2, {2, 4}, {0, 0}},
    {CYLINT_INFINITE, {1, -3, 5}, {0, 1, 0}, TO, 1, {3}, {0}},
    {CYLINT_INFINITE, {2, -3, 5}, {0, 1, 0}, NO, 0, {0}, {0}},
    {CYLINT_INFINITE, {0.5, 0, 5}, {0, 0, 1}, CR, 0, {0}, {0}},
    {CYLINT_INFINITE, {0, -1, 5}, {0, 0, 1}, AL, 0, {0}, {0}},
    {CYLINT_INFINITE, {0, -2, 5}, {0, 0, 1}, NO, 0, {0}, {0}},
    {CYLINT_NAPPE, {-3, 0, 5}, {1, 0, 0}, CR, 2, {2, 4}, {0, 0}},
    {CYLINT_NAPPE, {0, -1, 5}, {0, 0, 1}, AL, 0, {0}, {0}},
    {CYLINT_CAPPED, {-3, 0, 1}, {1, 0, 0}, CR, 2, {2, 4}, {0, 0}},
    {CYLINT_CAPPED, {-3, 0, 5}, {1, 0, 0}, NO, 0, {0}, {0}},
    {CYLINT_CAPPED, {1, -3, 1}, {0, 1, 0}, TO, 1, {3}, {0}},
    {CYLINT_CAPPED, {1, -3, 3}, {0, 1, 0}, NO, 0, {0}, {0}},
    /* down the axis, down a ruling, and back */
    {CYLINT_CAPPED, {0.5, 0, 5}, {0, 0, -1}, CR, 2, {3, 5}, {2, 1}},
    {CYLINT_CAP_0, {0.5, 0, 5}, {0, 0, -1}, CR, 1, {5}, {1}},
    {CYLINT_CAP_1, {0.5, 0, 5}, {0, 0, -1}, CR, 1, {3}, {2}},
    {CYLINT_OPEN, {0.5, 0, 5}, {0, 0, -1}, CR, 0, {0}, {0}},
    {CYLINT_CAPPED, {0, -1, 5}, {0, 0, -1}, AL, 2, {3, 5}, {0, 0}},
    {CYLINT_OPEN, {0, -1, -1}, {0, 0, 1}, AL, 2, {1, 3}, {0, 0}},
    {CYLINT_CAPPED, {0, -2, 5}, {0, 0, -1}, NO, 0, {0}, {0}},
    /* in the planes of the caps: a chord, a tangent, beside */
    {CYLINT_CAPPED, {-3, 0, 0}, {1, 0, 0}, AL, 2, {2, 4}, {0, 0}},
    {CYLINT_CAPPED, {-3, 0, 2}, {1, 0, 0}, AL, 2, {2, 4}, {0, 0}},
    {CYLINT_CAPPED, {1, -3, 2}, {0, 1, 0}, TO, 1, {3}, {0}},
    {CYLINT_OPEN, {1, -3, 0}, {0, 1, 0}, TO, 1, {3}, {0}},
};

/* The library itself as a method, so that what is due is held to the same
 * contract as the methods are. */
static cylint_status intersect(const cylint_shape *shape,
                               const cylint_line *line, unsigned want,
                               cylint_answer *answer)
{
    cylint_intersect(shape, line, want, answer);
    return CYLINT_OK;
}

static const cylint_method the_library = {"intersect", "", "", intersect};

static void cylinder_methods_keep_the_contract(void)
{
    const double p0[3] = {0, 0, 0}, p1[3] = {0, 0, 2};
    const int n = sizeof of_a_cylinder / sizeof *of_a_cylinder;

    for (const cylint_method *m = cylint_methods(); m->name; m++)
        for (int i = 0; i < n; i++) {
            const due *c = &of_a_cylinder[i];
            cylint_shape shape;
            cylint_cylinder(&shape, p0, p1, 1, (cylint_ends)c->ends);
            check_due(&the_library, &shape, c);
            if (answers_for(m->name, CYLINT_KIND_CYLINDER, c->ends))
                check_due(m, &shape, c);
        }
}

/* Apex at the origin, about the z axis, tangent 3/4; z = 1 at (0, 0, 4). */
static const due of_a_cone[] = {
    {CYLINT_INFINITE, {-8, 0, 4}, {1, 0, 0}, CR, 2, {5, 11}, {0, 0}},
    {CYLINT_INFINITE, {-8, 0, -4}, {1, 0, 0}, CR, 2, {5, 11}, {0, 0}},
    {CYLINT_INFINITE, {3, 0, 0}, {0, 0, 1}, CR, 2, {-4, 4}, {0, 0}},
    {CYLINT_INFINITE, {0, 0, -4}, {0, 0, 1}, CR, 1, {4}, {0}},
    {CYLINT_INFINITE, {-8, 0, 0}, {1, 0, 0}, TO, 1, {8}, {0}},
    {CYLINT_INFINITE, {8, 3, 0}, {1, 0, 0}, NO, 0, {0}, {0}},
    {CYLINT_NAPPE, {-8, 0, 4}, {1, 0, 0}, CR, 2, {5, 11}, {0, 0}},
    {CYLINT_NAPPE, {-8, 0, -4}, {1, 0, 0}, NO, 0, {0}, {0}},
    {CYLINT_NAPPE, {3, 0, 0}, {0, 0, 1}, CR, 1, {4}, {0}},
    {CYLINT_NAPPE, {3, 0, 0}, {0, 0, -1}, CR, 1, {-4}, {0}},
    {CYLINT_NAPPE, {0, 0, -4}, {0, 0, 1}, CR, 1, {4}, {0}},
    {CYLINT_NAPPE, {-8, 0, 0}, {1, 0, 0}, TO, 1, {8}, {0}},
    {CYLINT_CAPPED, {0, 0, -4}, {0, 0, 1}, CR, 2, {4, 8}, {0, 2}},
    {CYLINT_OPEN, {0, 0, -4}, {0, 0, 1}, CR, 1, {4}, {0}},
    {CYLINT_CAPPED, {0, 0, 8}, {0, 0, -1}, CR, 2, {4, 8}, {2, 0}},
    {CYLINT_CAPPED, {-8, 0, 0}, {1, 0, 0}, TO, 1, {8}, {0}},
    {CYLINT_CAPPED, {-8, 0, 4}, {1, 0, 0}, AL, 2, {5, 11}, {0, 0}},
};

static void cone_methods_keep_the_contract(void)
{
    const double v[3] = {0, 0, 0}, u[3] = {0, 0, 4};
    const int n = sizeof of_a_cone / sizeof *of_a_cone;

    for (const cylint_method *m = cylint_methods(); m->name; m++)
        for (int i = 0; i < n; i++) {
            const due *c = &of_a_cone[i];
            cylint_shape by_angle, by_radii;
            cylint_tangent_cone(&by_angle, v, u, 0.75,
                                (cylint_ends)c->ends);
            cylint_cone(&by_radii, v, 0, u, 3, (cylint_ends)c->ends);
            check_due(&the_library, &by_angle, c);
            check_due(&the_library, &by_radii, c);
            if (!answers_for(m->name, CYLINT_KIND_CONE, c->ends))
                continue;
            check_due(m, &by_angle, c);
            check_due(m, &by_radii, c);
        }
}

/* Parallel to a ruling, along one, and in the tangent plane of one: tangent
 * 1, about the z axis, so that the quadratic's coefficients are exact. */
static const due of_a_right_angled_cone[] = {
    {CYLINT_INFINITE, {0, 0, -1}, {1, 0, 1}, CR, 1, {0.5}, {0}},
    {CYLINT_INFINITE, {0, 0, 1}, {1, 0, 1}, CR, 1, {-0.5}, {0}},
    {CYLINT_INFINITE, {1, 0, 1}, {1, 0, 1}, AL, 0, {0}, {0}},
    {CYLINT_INFINITE, {0, 1, 0}, {1, 0, 1}, NO, 0, {0}, {0}},
    {CYLINT_NAPPE, {0, 0, 1}, {1, 0, 1}, CR, 1, {-0.5}, {0}},
    {CYLINT_NAPPE, {0, 0, -1}, {1, 0, 1}, NO, 0, {0}, {0}},
    {CYLINT_NAPPE, {1, 0, 1}, {1, 0, 1}, AL, 1, {-1}, {0}},
    {CYLINT_CAPPED, {0, 0, 0.5}, {1, 0, 1}, CR, 2, {-0.25, 0.5}, {0, 2}},
    {CYLINT_CAPPED, {1, 0, 1}, {1, 0, 1}, AL, 2, {-1, 0}, {0, 0}},
};

static void lines_parallel_to_a_ruling_are_told_apart(void)
{
    const double v[3] = {0, 0, 0}, u[3] = {0, 0, 1};
    const cylint_method *m = cylint_methods();
    const int n = sizeof of_a_right_angled_cone /
                  sizeof *of_a_right_angled_cone;

    while (strcmp(m->name, "quadratic"))
        m++;
    for (int i = 0; i < n; i++) {
        const due *c = &of_a_right_angled_cone[i];
        cylint_shape by_angle, by_radii;
        cylint_tangent_cone(&by_angle, v, u, 1, (cylint_ends)c->ends);
        cylint_cone(&by_radii, v, 0, u, 1, (cylint_ends)c->ends);
        check_due(m, &by_angle, c);
        check_due(m, &by_radii, c);
        check_due(&the_library, &by_angle, c);
        check_due(&the_library, &by_radii, c);
    }
}

static void only_what_is_wanted_is_written(void)
{
    const double o[3] = {0, 0, 0}, up[3] = {0, 0, 1};
    const double from[3] = {-3, 0, 0.5}, x[3] = {1, 0, 0};
    cylint_shape shape;
    cylint_line line;
    cylint_answer a;

    cylint_cylinder(&shape, o, up, 1, CYLINT_INFINITE);
    cylint_whole_line(&line, from, x);
    memset(&a, 0x55, sizeof a);
    const cylint_answer before = a;
    cylint_quadratic(&shape, &line, CYLINT_WANT_COUNT, &a);
    CHECK(a.relation == CYLINT_CROSS && a.n == 2);
    CHECK(!memcmp(a.hit, before.hit, sizeof a.hit));
    cylint_quadratic(&shape, &line, CYLINT_WANT_NEAREST | CYLINT_WANT_T, &a);
    CHECK(a.n == 1 && a.hit[0].t == 2);
    CHECK(!memcmp(&a.hit[0].z, &before.hit[0].z, sizeof(double)));
    CHECK(!memcmp(&a.hit[1], &before.hit[1], sizeof a.hit[1]));
}

int main(void)
{
    RUN(cylinder_methods_keep_the_contract);
    RUN(cone_methods_keep_the_contract);
    RUN(lines_parallel_to_a_ruling_are_told_apart);
    RUN(only_what_is_wanted_is_written);
    return check_end();
}
