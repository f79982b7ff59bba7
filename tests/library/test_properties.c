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

PROPERTY(a_reversed_line_has_hits_at_minus_t, is_reversed_with_its_line)
PROPERTY(a_domain_may_be_cut_at_a_hit, may_be_cut_at_hits)
PROPERTY(coordinates_may_be_permuted_and_change_sign,
         may_be_permuted_and_mirrored)
PROPERTY(scaling_by_powers_of_two_keeps_the_digits_of_t,
         is_scaled_by_powers_of_two)
PROPERTY(the_origin_is_in_a_chord_if_it_is_inside, has_its_origin)
PROPERTY(hits_ascend_within_the_domain, has_good_members)

TEST(unwanted_members_are_not_written_and_change_nothing)
{
    over_all_families(has_all_wanted_members, CASES / 25);
}
