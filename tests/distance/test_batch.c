/*
 * test_batch.c - floor distance: batches return the bits of single
 * questions, in the lanes of all builds
 */
#include <math.h>
#include <string.h>

#include "distance/lanes.h"
#include "distance_points.h"
#include "known_distances.h"
#include "shapes/layout.h"

static const double origin[3] = {0, 0, 0};

static void report(const struct family_case *c, const double p[3])
{
    REPORT_CASE(c);
    REPORT("point %a %a %a", p[0], p[1], p[2]);
}

enum { MANY = 100 };

struct columns {
    double distance[MANY], point[3][MANY], normal[3][MANY];
    signed char part[MANY], feature[MANY];
};

static cylint_closest_columns columns_of(struct columns *c)
{
    cylint_closest_columns to = {c->distance,
                                 c->part,
                                 c->feature,
                                 {c->point[0], c->point[1], c->point[2]},
                                 {c->normal[0], c->normal[1], c->normal[2]}};
    return to;
}

static void check_row(const struct columns *c, int i, const cylint_shape *s,
                      const double p[3])
{
    const cylint_closest a = answer_to(s, p, WANT);
    CHECK(c->distance[i] == a.distance && c->part[i] == a.part);
    CHECK(c->feature[i] == a.feature);
    for (int k = 0; k < 3; k++)
        CHECK(a.part == -1 ? isnan(c->point[k][i]) && isnan(c->normal[k][i])
                           : c->point[k][i] == a.point[k] &&
                                 c->normal[k][i] == a.normal[k]);
}

static void batches_return_the_answers_of_single_questions(void)
{
    static cylint_shape shapes[MANY];
    static double x[3][MANY];
    struct columns c;
    uint64_t stream = 3;
    size_t best = MANY;
    for (int i = 0; i < MANY; i++) {
        struct family_case f;
        double p[3];
        do
            family_case(7, random_int(&stream, family_count()), (uint64_t)i,
                        &f);
        while (cylint_is_elliptic(f.shape.kind) || !cylint_in_range(&f.shape));
        shapes[i] = f.shape;
        draw_point(&f, &stream, p);
        for (int k = 0; k < 3; k++)
            x[k][i] = p[k];
    }
    x[1][5] = NAN;
    const cylint_points points = {MANY, {x[0], x[1], x[2]}};
    const cylint_closest_columns to = columns_of(&c);
    cylint_distance_pairs(shapes, &points, &to);
    for (int i = 0; i < MANY; i++) {
        const double p[3] = {x[0][i], x[1][i], x[2][i]};
        check_row(&c, i, &shapes[i], p);
    }
    cylint_distance_points(&shapes[1], &points, &to);
    double least = HUGE_VAL;
    const double p0[3] = {x[0][0], x[1][0], x[2][0]};
    for (int i = 0; i < MANY; i++) {
        const double p[3] = {x[0][i], x[1][i], x[2][i]};
        check_row(&c, i, &shapes[1], p);
        const cylint_closest a = answer_to(&shapes[i], p0, 0);
        if (fabs(a.distance) < least) {
            least = fabs(a.distance);
            best = (size_t)i;
        }
    }
    cylint_closest a;
    CHECK(cylint_closest_shape(shapes, MANY, p0, HUGE_VAL, WANT, &a) == best);
    CHECK(fabs(a.distance) == least);
    CHECK(cylint_closest_shape(shapes, MANY, p0, least, 0, &a) == best);
    CHECK(cylint_closest_shape(shapes, MANY, p0, nextafter(least, 0), 0, &a) ==
          MANY);
    CHECK(cylint_closest_shape(shapes, MANY, p0, NAN, 0, &a) == MANY);
    CHECK(cylint_closest_shape(shapes, 0, p0, HUGE_VAL, 0, &a) == 0);
}

/* Points about a cylinder. */
static void draw_points(uint64_t *stream, double *const x[3], size_t n)
{
    for (int k = 0; k < 3; k++)
        for (size_t i = 0; i < n; i++)
            x[k][i] = draw(stream, -3, 3);
}

static cylint_shape a_cylinder(cylint_ends ends)
{
    static const double top[3] = {1, 1, 2};
    cylint_shape s;
    cylint_cylinder(&s, origin, top, 1, ends);
    return s;
}

static void check_single_columns(cylint_ends ends)
{
    static double x[3][MANY];
    double *const at[3] = {x[0], x[1], x[2]};
    const cylint_points points = {MANY, {x[0], x[1], x[2]}};
    const cylint_shape s = a_cylinder(ends);
    uint64_t stream = 4;
    struct columns all, one;
    draw_points(&stream, at, MANY);
    const cylint_closest_columns full = columns_of(&all);
    cylint_distance_points(&s, &points, &full);
    for (int column = 0; column < 9; column++) {
        const cylint_closest_columns to = columns_of(&one);
        cylint_closest_columns only = {NULL, NULL, NULL, {NULL}, {NULL}};
        memset(&one, 77, sizeof one);
        struct columns want = one;
        if (column == 0) {
            only.distance = to.distance;
            memcpy(want.distance, all.distance, sizeof all.distance);
        } else if (column == 1) {
            only.part = to.part;
            memcpy(want.part, all.part, sizeof all.part);
        } else if (column == 2) {
            only.feature = to.feature;
            memcpy(want.feature, all.feature, sizeof all.feature);
        } else if (column < 6) {
            only.point[column - 3] = to.point[column - 3];
            memcpy(want.point[column - 3], all.point[column - 3],
                   sizeof all.point[0]);
        } else {
            only.normal[column - 6] = to.normal[column - 6];
            memcpy(want.normal[column - 6], all.normal[column - 6],
                   sizeof all.normal[0]);
        }
        cylint_distance_points(&s, &points, &only);
        if (!CHECK(memcmp(&one, &want, sizeof one) == 0))
            REPORT("column %d", column);
    }
}

/* Without the others; in lanes, and of a shape with one cap one by one. */
static void every_column_can_be_wanted_alone(void)
{
    check_single_columns(CYLINT_ENDS_CAPPED);
    check_single_columns(CYLINT_ENDS_CAP0);
}

/* Points and pairs beyond the first block. */
static void batches_of_several_blocks_return_the_same_bits(void)
{
    enum { N = 2 * CYLINT_POINT_BLOCK + 9 };
    static double x[3][N], distance[N + 1];
    static signed char part[N + 1];
    static cylint_shape shapes[N];
    double *const at[3] = {x[0], x[1], x[2]};
    const cylint_points points = {N, {x[0], x[1], x[2]}};
    const cylint_closest_columns to = {
        distance, part, NULL, {NULL, NULL, NULL}, {NULL, NULL, NULL}};
    const cylint_shape s = a_cylinder(CYLINT_ENDS_CAPPED);
    uint64_t stream = 5;
    draw_points(&stream, at, N);
    for (int i = 0; i < N; i++) {
        const double top[3] = {draw(&stream, 1, 2), 1, draw(&stream, 1, 2)};
        cylint_cylinder(&shapes[i], origin, top, 1, CYLINT_ENDS_CAPPED);
    }
    for (int pairs = 0; pairs < 2; pairs++) {
        distance[N] = part[N] = 77;
        if (pairs)
            cylint_distance_pairs(shapes, &points, &to);
        else
            cylint_distance_points(&s, &points, &to);
        for (int i = 0; i < N; i++) {
            const double p[3] = {x[0][i], x[1][i], x[2][i]};
            const cylint_closest a =
                answer_to(pairs ? &shapes[i] : &s, p, CYLINT_WANT_PART);
            CHECK(distance[i] == a.distance && part[i] == a.part);
        }
        CHECK(distance[N] == 77 && part[N] == 77);
    }
}

/* Columns of all members, or without point and normal, which other lanes serve. */
static cylint_closest_columns columns_with(struct columns *c, int described)
{
    cylint_closest_columns to = columns_of(c);
    for (int k = 0; !described && k < 3; k++)
        to.point[k] = to.normal[k] = NULL;
    return to;
}

static void check_answer(const struct family_case *f, const struct columns *c,
                         int i, const double p[3], int described)
{
    const cylint_closest a =
        answer_to(&f->shape, p, described ? WANT : CYLINT_WANT_PART);
    int same = c->distance[i] == a.distance && c->part[i] == a.part &&
               (a.part == -1 || c->feature[i] == a.feature);
    for (int k = 0; described && a.part != -1 && k < 3; k++)
        same &= c->point[k][i] == a.point[k] &&
                c->normal[k][i] == a.normal[k] &&
                !signbit(c->point[k][i]) == !signbit(a.point[k]) &&
                !signbit(c->normal[k][i]) == !signbit(a.normal[k]);
    if (!CHECK(same))
        report(f, p);
}

/* Points about the shape of a case, answered in lanes and one by one. */
static void check_lanes(const struct family_case *f, int n, uint64_t *stream)
{
    static double x[3][MANY];
    for (int i = 0; i < n; i++) {
        double p[3];
        draw_point(f, stream, p);
        for (int k = 0; k < 3; k++)
            x[k][i] = random_int(stream, 50) ? p[k] : NAN;
    }
    const cylint_points points = {(size_t)n, {x[0], x[1], x[2]}};
    for (int described = 0; described < 2; described++) {
        struct columns c;
        const cylint_closest_columns to = columns_with(&c, described);
        memset(&c, 77, sizeof c);
        cylint_distance_points(&f->shape, &points, &to);
        for (int i = 0; i < n; i++) {
            const double p[3] = {x[0][i], x[1][i], x[2][i]};
            check_answer(f, &c, i, p, described);
        }
        CHECK(n == MANY || c.part[n] == 77);
    }
}

static void make_capped(struct family_case *c)
{
    c->ends = CYLINT_ENDS_CAPPED;
    family_make(c);
}

/* Shapes of a family, each with its point. */
static void check_lanes_of_pairs(int family)
{
    static cylint_shape shapes[MANY];
    static double x[3][MANY];
    static struct family_case f[MANY];
    uint64_t stream = (uint64_t)family;
    for (int i = 0; i < MANY; i++) {
        double p[3];
        family_case(31, family, (uint64_t)i, &f[i]);
        if (i % 16)
            make_capped(&f[i]);
        if (cylint_is_elliptic(f[i].shape.kind))
            cylint_sphere(&f[i].shape, origin, 1 + i, CYLINT_ENDS_CAPPED);
        shapes[i] = f[i].shape;
        draw_point(&f[i], &stream, p);
        for (int k = 0; k < 3; k++)
            x[k][i] = p[k];
    }
    const cylint_points points = {MANY - 3, {x[0], x[1], x[2]}};
    for (int described = 0; described < 2; described++) {
        struct columns c;
        const cylint_closest_columns to = columns_with(&c, described);
        cylint_distance_pairs(shapes, &points, &to);
        for (int i = 0; i < MANY - 3; i++) {
            const double p[3] = {x[0][i], x[1][i], x[2][i]};
            check_answer(&f[i], &c, i, p, described);
        }
    }
}

static void lanes_of_all_builds_return_the_same_bits(void)
{
    for (int k = 0; cylint_kernels_name(k); k++) {
        CHECK(cylint_use_kernels(cylint_kernels_name(k)));
        for (int f = 0; f < family_count(); f++)
            for (uint64_t i = 0; i < 8; i++) {
                struct family_case c;
                uint64_t stream = i * 99 + (uint64_t)f;
                family_case(21, f, i, &c);
                make_capped(&c);
                if (!cylint_is_elliptic(c.shape.kind))
                    check_lanes(&c, 1 + random_int(&stream, MANY), &stream);
            }
        for (int f = 0; f < family_count(); f++)
            check_lanes_of_pairs(f);
    }
    cylint_use_kernels(NULL);
}

static void of_equal_shapes_the_first_is_closest(void)
{
    static const double p[3] = {5, 0, 1}, top[3] = {0, 0, 2};
    cylint_shape s[3];
    cylint_closest a;
    cylint_round_cone(&s[0], origin, 5, p, 0, CYLINT_ENDS_CAP1);
    cylint_cylinder(&s[1], origin, top, 1, CYLINT_ENDS_CAPPED);
    s[2] = s[1];
    CHECK(cylint_closest_shape(s, 3, p, 4, CYLINT_WANT_PART, &a) == 0 ||
          a.part >= 0);
    CHECK(cylint_closest_shape(s + 1, 2, p, 4, CYLINT_WANT_PART, &a) == 0);
    CHECK(a.distance == 4 && a.feature == CYLINT_FEATURE_LATERAL);
}

int main(void)
{
    if (family_count() == 0)
        return check_skip("no GSL: no families to draw from (make deps)");
    RUN(batches_return_the_answers_of_single_questions);
    RUN(every_column_can_be_wanted_alone);
    RUN(batches_of_several_blocks_return_the_same_bits);
    RUN(lanes_of_all_builds_return_the_same_bits);
    RUN(of_equal_shapes_the_first_is_closest);
    return check_end();
}
