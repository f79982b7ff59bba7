/*
 * test_properties.c - properties of answers, without an oracle
 *
 * properties.h has the properties; fuzz/shapes.c tests them on other cases.
 * CYLINT_CASES is the number of cases of each family.
 */
#include "check.h"
#include "properties.h"

enum { CASES = 500 };

/* Tests the property on some cases of each family. */
static void over_all_families(int (*holds)(const struct family_case *c),
                              uint64_t cases)
{
    EACH_CASE(c, 3, cases) {
        if (!CHECK(holds(&c)))
            REPORT_CASE(&c);
    }
}

#define PROPERTY(name, holds)                                           \
    TEST(name)                                                          \
    {                                                                   \
        over_all_families(holds, check_setting("CYLINT_CASES", CASES)); \
    }

PROPERTY(a_capped_shape_has_an_even_number_of_hits, has_even_hits)
PROPERTY(a_reversed_line_has_hits_at_minus_t, is_reversed_with_its_line)
PROPERTY(hits_in_a_domain_are_the_lines_hits_within_it, is_cut_by_its_domain)
PROPERTY(a_domain_may_be_cut_at_a_hit, may_be_cut_at_hits)
PROPERTY(a_line_may_begin_anywhere, may_begin_anywhere)
PROPERTY(coordinates_may_be_permuted, is_permuted)
PROPERTY(coordinates_may_change_sign, is_mirrored)
PROPERTY(scaling_by_powers_of_two_keeps_the_digits_of_t,
         is_scaled_by_powers_of_two)
PROPERTY(the_ends_may_be_swapped, is_turned_round)
PROPERTY(an_ellipses_axes_may_be_swapped_or_reversed, has_any_axes)
PROPERTY(a_cone_with_equal_radii_is_a_cylinder, is_constant_cone)
PROPERTY(a_circular_shape_is_an_elliptic_one_with_equal_axes,
         is_elliptic_with_equal_axes)
PROPERTY(missing_caps_only_remove_hits, loses_hits_with_caps)
PROPERTY(the_origin_is_in_a_chord_if_it_is_inside, has_its_origin)
PROPERTY(hits_ascend_within_the_domain, has_good_members)

TEST(unwanted_members_are_not_written_and_change_nothing)
{
    over_all_families(has_all_wanted_members, CASES / 25);
}
