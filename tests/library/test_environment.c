/*
 * test_environment.c - no floating-point environment changes constructors; version,
 * sizes, and the kernels that a program begins with
 *
 * scene/test_paths.c tests the answers of all calls in every environment, with
 * shapes and lines made there, test_hits.c those of named cases,
 * shapes/test_constructors.c statuses.  CYLINT_CASES is the number of cases of each
 * family, CYLINT_SEED changes them.
 */
#include <math.h>

#include "check.h"
#include "cylint_distance.h"
#include "dispatch.h"
#include "environment.h"
#include "same.h"
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

/* All bits of lines; of shapes those that are the same, too, from the axis on. */
TEST(shapes_and_lines_are_made_the_same)
{
    enum { FROM_AXIS = CYLINT_AT_UNIT - CYLINT_AT_AXIS };
    EACH_CASE(c, check_seed() + 9, check_setting("CYLINT_CASES", 100)) {
        const double *d = c.line.d;
        CHECK(c.line.size == fmax(fabs(d[0]), fmax(fabs(d[1]), fabs(d[2]))));
        EACH_ENVIRONMENT(there) {
            struct family_case made = c;
            environment_set(there);
            family_make(&made);
            environment_reset();
            if (!CHECK(same_bytes(&made.line, &c.line, sizeof c.line) &&
                       made.shape.kind == c.shape.kind &&
                       cylint_left_handed(&made.shape) ==
                           cylint_left_handed(&c.shape) &&
                       same_bytes(cylint_axis(&made.shape),
                                  cylint_axis(&c.shape),
                                  FROM_AXIS * sizeof(double))))
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
