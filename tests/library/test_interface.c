/*
 * test_interface.c - version, sizes, and the kernels that a program begins with
 */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "cylint_distance.h"
#include "dispatch.h"

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
