/*
 * test_environment.c - no floating-point environment changes constructors; version,
 * sizes, and the kernels that a program begins with
 *
 * The statuses and every bit of the differences that constructors compute must be
 * those of the default environment.  scene/test_paths.c tests the answers of all
 * calls, test_hits.c those of named cases, shapes/test_constructors.c statuses.
 * CYLINT_CASES is the number of cases of each family, CYLINT_SEED changes them.
 */
#include <math.h>

#include "check.h"
#include "cylint_distance.h"
#include "cylint_pieces.h"
#include "dispatch.h"
#include "environment.h"
#include "families.h"
#include "shapes/shape_facts.h"

TEST(a_program_begins_with_the_best_kernels)
{
    const char *used = cylint_kernels_in_use();
    CHECK(strcmp(used, cylint_kernels_name(0)) == 0);
    CHECK((strcmp(used, "plain") == 0) ==
          (cylint_one_used == &cylint_one_plain));
}

TEST(version_and_sizes_of_structs_are_those_of_the_header)
{
    char text[40];
    const int number = cylint_version_number();
    snprintf(text, sizeof text, "%d.%d.%d", number / 10000, number / 100 % 100,
             number % 100);
    CHECK(strcmp(cylint_version(), text) == 0);
    CHECK(strcmp(cylint_version(), CYLINT_VERSION) == 0);
    CHECK(number == CYLINT_VERSION_NUMBER);
    CHECK(cylint_sizeof_shape() == sizeof(cylint_shape));
    CHECK(cylint_sizeof_line() == sizeof(cylint_line));
    CHECK(cylint_sizeof_hit() == sizeof(cylint_hit));
    CHECK(cylint_sizeof_answer() == sizeof(cylint_answer));
    CHECK(cylint_sizeof_pack() == sizeof(cylint_pack));
    CHECK(cylint_sizeof_closest() == sizeof(cylint_closest));
}

TEST(a_pack_of_too_many_shapes_has_no_size)
{
    static const size_t shares[] = {1, 2, 8, 100, 184, 200, 208, 256};
    CHECK(cylint_pack_bytes(SIZE_MAX) == SIZE_MAX);
    for (size_t i = 0; i < sizeof shares / sizeof *shares; i++) {
        const size_t n = SIZE_MAX / shares[i];
        for (size_t less = 0; less < 100; less++)
            CHECK(cylint_pack_bytes(n - less) >= n - less);
    }
}

/* The differences that constructors compute: axis, dr and d, high and low parts. */
enum { DIFFERENCES = 14 };

struct made {
    int line_status, shape_status, kind, left_handed;
    double difference[DIFFERENCES];
    double size, largest; /* of the line; of the components of d */
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
                      {growth.hi, growth.lo},
                      c.line.size,
                      0};
    for (int i = 0; i < 3; i++) {
        double *d = &to.difference[2 + 4 * i];
        d[0] = cylint_axis(&c.shape)[i];
        d[1] = cylint_axis_pair(&c.shape, i).lo;
        d[2] = c.line.d[i];
        d[3] = c.line.d_lo[i];
        to.largest = fmax(to.largest, fabs(c.line.d[i]));
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
            int same = got.size == got.largest &&
                       got.line_status == want.line_status &&
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

/* Records have angles, so statuses.txt cannot have these. */
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
