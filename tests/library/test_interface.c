/*
 * test_interface.c - floor shape: order of errors, version, sizes, packs
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "cylint.h"
#include "dispatch.h"

static const double origin[3] = {0, 0, 0}, axis_x[3] = {1, 0, 0};
static const double axis_z[3] = {0, 0, 1};

TEST(a_program_begins_with_the_best_kernels)
{
    const char *used = cylint_kernels_in_use();
    CHECK(strcmp(used, cylint_kernels_name(0)) == 0);
    CHECK((strcmp(used, "plain") == 0) ==
          (cylint_one_used == &cylint_one_plain));
}

/* For every set of faults, the bits of `faults`, a constructor returns the
 * first fault in the order of the list. */
struct faults {
    double number; /* not finite */
    double radius, angle, axis[3], zero[3];
    cylint_ends ends;
};

static struct faults faults_of(int bits, int number, int size, int axis,
                               int ends)
{
    const struct faults f = {bits & number ? NAN : 0,
                             bits & size ? -1 : 1,
                             bits & size ? 90 : 30,
                             {0, 0, bits & axis ? 0 : 1},
                             {0, 0, 0},
                             (cylint_ends)(bits & ends ? 6 : 0)};
    return f;
}

TEST(a_shape_with_several_faults_returns_the_first)
{
    enum { NUMBER = 1, SIZE = 2, AXIS = 4, ENDS = 8, PLANE = 16, ALL = 31 };
    for (int bits = 0; bits <= ALL; bits++) {
        const struct faults f = faults_of(bits, NUMBER, SIZE, AXIS, ENDS);
        const double c[3] = {0, f.number, 0};
        const double b[3] = {0, bits & PLANE ? 0 : 1, 0};
        const cylint_status circular = bits & NUMBER ? CYLINT_ENONFINITE
                                       : bits & SIZE ? CYLINT_ERADIUS
                                       : bits & AXIS ? CYLINT_EAXIS
                                       : bits & ENDS ? CYLINT_EENDS
                                                     : CYLINT_OK;
        const cylint_status elliptic = circular == CYLINT_OK && bits & PLANE
                                           ? CYLINT_EDEGENERATE
                                           : circular;
        const cylint_status angle =
            circular == CYLINT_ERADIUS ? CYLINT_EANGLE : circular;
        cylint_shape s;
        CHECK(cylint_cylinder(&s, c, f.axis, f.radius, f.ends) == circular);
        CHECK(cylint_cone(&s, f.axis, f.radius, c, f.radius, f.ends) ==
              circular);
        CHECK(cylint_cone(&s, f.zero, f.radius, f.axis, f.number, f.ends) ==
              circular);
        CHECK(cylint_elliptic_cone(&s, c, axis_x, b, f.axis, f.radius,
                                   f.ends) == elliptic);
        CHECK(cylint_angle_cone(&s, c, f.axis, f.angle, f.ends) == angle);
        CHECK(cylint_angle_cone(&s, f.axis, f.axis, f.angle + f.number,
                                f.ends) == angle);
        CHECK(cylint_tangent_cone(&s, c, f.axis, f.radius, f.ends) == angle);
        if (!(bits & SIZE)) {
            CHECK(cylint_elliptic_cylinder(&s, c, axis_x, b, f.axis, f.ends) ==
                  elliptic);
        }
    }
}

TEST(a_line_with_several_faults_returns_the_first)
{
    enum { NUMBER = 1, LENGTH = 2, DOMAIN = 4, ALL = 7 };
    for (int bits = 0; bits <= ALL; bits++) {
        const double o[3] = {bits & NUMBER ? -HUGE_VAL : 0, 0, 0};
        const double d[3] = {0, bits & LENGTH ? -0.0 : 1, 0};
        const double end[3] = {o[0], bits & LENGTH ? -0.0 : 1, 0};
        const cylint_status unlimited = bits & NUMBER   ? CYLINT_ENONFINITE
                                        : bits & LENGTH ? CYLINT_EDIRECTION
                                                        : CYLINT_OK;
        const cylint_status limited = unlimited == CYLINT_OK && bits & DOMAIN
                                          ? CYLINT_EDOMAIN
                                          : unlimited;
        cylint_line l;
        CHECK(cylint_whole_line(&l, o, d) == unlimited);
        CHECK(cylint_ray(&l, o, d) == unlimited);
        CHECK(cylint_segment(&l, o, end) == unlimited);
        CHECK(cylint_span(&l, o, d, 1, bits & DOMAIN ? 0 : 2) == limited);
        CHECK(cylint_span(&l, o, d, bits & DOMAIN ? NAN : 1, 2) == limited);
    }
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
}

/* Tests every address, and a copy of the pack. */
TEST(a_pack_keeps_the_callers_pointer)
{
    enum { SHAPES = 20, MOST = 16000 };
    static char memory[MOST + 64];
    cylint_shape shapes[SHAPES];
    cylint_line line;
    cylint_ray(&line, origin, axis_z);
    for (int i = 0; i < SHAPES; i++) {
        const double p0[3] = {0, 0, 30 - i}, p1[3] = {0, 0, 31 - i};
        cylint_cylinder(&shapes[i], p0, p1, 1, CYLINT_ENDS_CAPPED);
    }
    if (!CHECK(cylint_pack_bytes(SHAPES) <= MOST))
        return;
    for (int at = 0; at < 64; at++) {
        cylint_pack pack;
        cylint_hit hit;
        memset(memory, 0x5a, sizeof memory);
        cylint_pack_shapes(&pack, memory + at, shapes, SHAPES);
        CHECK(pack.memory == memory + at);
        const cylint_pack copy = pack;
        CHECK(cylint_nearest(&copy, &line, CYLINT_WANT_T, &hit) == SHAPES - 1 &&
              hit.t == 31 - SHAPES);
        CHECK(cylint_count(&copy, &line, 0) == SHAPES);
        for (int i = 0; i < 64; i++)
            CHECK(i < at ? memory[i] == 0x5a : memory[MOST + i] == 0x5a);
    }
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
