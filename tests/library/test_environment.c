/*
 * test_environment.c - no floating-point environment changes constructors
 *
 * The statuses and every bit of the differences that constructors compute must be
 * those of the default environment.  scene/test_paths.c tests the answers of all
 * calls, test_hits.c those of named cases, shapes/test_constructors.c statuses.
 */
#include <math.h>

#include "check.h"
#include "cylint_pieces.h"
#include "environment.h"
#include "families.h"
#include "shapes/shape_facts.h"

/* The differences that constructors compute: axis, dr and d, high and low parts. */
enum { DIFFERENCES = 14, TANGENTS = 4000 };

struct made {
    int line_status, shape_status, kind, left_handed;
    double difference[DIFFERENCES];
};

static struct made made_in(struct environment there, struct family_case c)
{
    environment_set(there);
    family_make(&c);
    const int left_handed = cylint_left_handed(&c.shape);
    const pair growth = cylint_radius_growth(&c.shape);
    environment_reset();
    struct made to = {(int)c.line_status,
                      (int)c.shape_status,
                      c.shape.kind,
                      left_handed,
                      {growth.hi, growth.lo}};
    for (int i = 0; i < 3; i++) {
        double *d = &to.difference[2 + 4 * i];
        d[0] = cylint_axis(&c.shape)[i];
        d[1] = cylint_axis_pair(&c.shape, i).lo;
        d[2] = c.line.d[i];
        d[3] = c.line.d_lo[i];
    }
    return to;
}

TEST(shapes_and_lines_are_made_the_same)
{
    const uint64_t seed = check_seed() + 9;
    EACH_CASE(c, seed, check_setting("CYLINT_CASES", 20)) {
        const struct made want = made_in(environment_of(0), c);
        EACH_ENVIRONMENT(there) {
            const struct made got = made_in(there, c);
            int same = got.line_status == want.line_status &&
                       got.shape_status == want.shape_status &&
                       got.kind == want.kind &&
                       got.left_handed == want.left_handed;
            for (int i = 0; i < DIFFERENCES; i++)
                same = same && got.difference[i] == want.difference[i];
            if (!CHECK(same))
                REPORT_CASE(&c);
        }
    }
}

/* The least doubles count, too. */
TEST(the_size_of_a_line_is_its_largest_component)
{
    EACH_ENVIRONMENT(there) {
        const double o[3] = {1, 2, 3}, d[3] = {0x3p-1074, -0x5p-1074, 0};
        cylint_line line;
        environment_set(there);
        cylint_whole_line(&line, o, d);
        environment_reset();
        CHECK(line.size == 0x5p-1074);
    }
}

/* Of which no record has the tangent. */
TEST(subnormal_tangents_are_not_lost)
{
    const double v[3] = {0, 0, 0}, u[3] = {0, 0, 0x1p-1074};
    EACH_ENVIRONMENT(there)
        for (int e = -1074; e < -1022; e++) {
            const double tangent = ldexp(1, e);
            cylint_shape s;
            environment_set(there);
            const cylint_status status =
                cylint_tangent_cone(&s, v, u, tangent, CYLINT_ENDS_OPEN);
            environment_reset();
            CHECK(status == CYLINT_OK && cylint_r1(&s) == tangent);
        }
}

/* All components of a direction can be subnormal. */
TEST(subnormal_directions_make_a_sector)
{
    const double p0[3] = {0, 0, 0}, p1[3] = {0, 0, 2}, outer[2] = {1, 1},
                 sector[2][3] = {{0x1p-1074, 0, 0}, {0, 0x1p-1074, 0}},
                 along[2][3] = {{0, 0, 0x1p-1074}, {0, 1, 0}};
    cylint_shape shapes[CYLINT_TUBE_MEMBERS];
    int clauses[CYLINT_TUBE_MEMBERS];
    size_t n;
    EACH_ENVIRONMENT(there) {
        environment_set(there);
        const cylint_status quarter =
            cylint_tube(p0, p1, outer, NULL, sector, shapes, clauses, &n);
        const cylint_status none =
            cylint_tube(p0, p1, outer, NULL, along, shapes, clauses, &n);
        environment_reset();
        CHECK(quarter == CYLINT_OK && none == CYLINT_EDIRECTION);
    }
}

TEST(tangents_of_angles_are_the_same)
{
    const double v[] = {0, 0, 0}, u[] = {0, 0, 1};
    EACH_ENVIRONMENT(there)
        for (int i = 0; i < TANGENTS; i++) {
            const double part = (double)(i + 1) / (double)(TANGENTS + 1);
            const double angle = i % 3 == 0   ? 90 * part
                                 : i % 3 == 1 ? 90 - part * 0x1p-20
                                              : ldexp(part, -1 - i % 1070);
            cylint_shape want, got;
            const cylint_status status =
                cylint_angle_cone(&want, v, u, angle, CYLINT_ENDS_CAPPED);
            environment_set(there);
            const cylint_status other =
                cylint_angle_cone(&got, v, u, angle, CYLINT_ENDS_CAPPED);
            environment_reset();
            if (!CHECK(status == other && cylint_r1(&want) == cylint_r1(&got)))
                REPORT("acone 0 0 0  0 0 1  %a: got %a, want %a", angle,
                       cylint_r1(&got), cylint_r1(&want));
        }
}

/* ------------------------------------------------------------ self-test -- */

TEST(the_selftest_detects_each_environment)
{
    CHECK(cylint_selftest() == 0);
    EACH_ENVIRONMENT(there) {
        const int want =
            (there.rounding == FE_TONEAREST ? 0 : CYLINT_SELFTEST_DIRECTED) |
            (there.tiny & FLUSH ? CYLINT_SELFTEST_FLUSHED : 0) |
            (there.tiny & ZERO ? CYLINT_SELFTEST_ZEROED : 0);
        environment_set(there);
        const int found = cylint_selftest();
        environment_reset();
        if (!CHECK(found == want))
            REPORT("found %d, not %d", found, want);
    }
}
