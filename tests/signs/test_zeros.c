/*
 * test_zeros.c - signs that are 0 of data of few digits, without exact numbers
 *
 * Lines touch a surface, begin on it or lie in a plane, in whole numbers and
 * tenths.  CYLINT_SEED changes them.
 */
#include "check.h"
#include "draw.h"
#include "families.h"
#include "shapes/shape_facts.h"
#include "signs/sign.h"

enum { CASES = 4000 };

/* Whether the sign is 0; adds to *exact those computed in exact numbers. */
static int is_zero(const struct family_case *c, cylint_form f, int end,
                   long *exact)
{
    cylint_query q;
    cylint_query_open(&q, &c->shape, &c->line);
    if (cylint_form_sign(&q, f, end) != 0)
        return 0;
    *exact += q.exact.ready;
    return 1;
}

/* A library that compares every sign with the exact one. */
static int is_paranoid(void)
{
    const struct family_case c = case_of("ray 0 0 0  1 0 0  sphere 0 0 0 1");
    cylint_query q;
    cylint_query_open(&q, &c.shape, &c.line);
    cylint_form_sign(&q, FORM_C, 0);
    return q.exact.ready;
}

/* Few of tenths, which doubles round.  In a second round one coordinate of lines
 * has all digits: few forms need them, those about an axis along it none. */
TEST(zeros_of_few_digits_need_no_exact_numbers)
{
    static const char *const names[] = {"integer grid", "round, whole numbers",
                                        "plain"};
    stream = check_seed();
    for (int i = 0; i < 6 && !is_paranoid(); i++) {
        long zeros = 0, exact = 0;
        for (uint64_t n = 0; n < CASES; n++) {
            struct family_case c;
            family_case(check_seed(), family_named(names[i / 2]), n, &c);
            if (i % 2 && c.line_word != FAMILY_SEGMENT)
                c.line_data[one_of(3)] += between(0, 1);
            family_make(&c);
            const int round = cylint_is_round(c.shape.kind);
            for (cylint_form f = 0; f < CYLINT_FORMS; f++)
                for (int end = 0; end < 2; end++)
                    if (round ? f != FORM_T && f != FORM_RHO0
                              : f != FORM_END_BALL)
                        zeros += is_zero(&c, f, end, &exact);
        }
        CHECK(zeros > CASES / 2 &&
              exact <= (i == 0 || i == 2 ? 0 : zeros / 150));
        printf("note: %s: %ld zeros, %ld of them exact\n", names[i / 2], zeros,
               exact);
    }
}
