/*
 * test_intersect.c - the library against the oracle, by family
 *
 * Relation, number, parts, sides and every bit of t, point, normal, z and phi must
 * agree, of one case in ten also those of the exact stage alone.  CYLINT_CASES is
 * the number of cases of each family, CYLINT_SEED changes all cases.
 */
#include <math.h>
#include <string.h>

#include "cylint.h"
#include "families.h"
#include "intersect.h"
#include "check.h"
#include "oracle.h"
#include "same.h"
#include "ulps.h"
#include "vectors.h"

enum { CASES = 2000 };

static uint64_t cases(void)
{
    return check_setting("CYLINT_CASES", CASES);
}

TEST(library_and_oracle_agree)
{
    long n = 0, hits = 0;
    EACH_CASE(c, check_seed(), family_is_wild(family) ? cases() / 4 : cases()) {
        cylint_answer got, want;
        memset(&got, 0, sizeof got);
        cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &got);
        oracle_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &want);
        if (!CHECK(is_right(&got, &want, oracle_other(0))))
            report_answers(&c, family_name(family), &got, &want);
        if (number % 10 == 0) {
            cylint_answer exact;
            memset(&exact, 0, sizeof exact);
            cylint_intersect_by_signs(&c.shape, &c.line, CYLINT_WANT_ALL,
                                      &exact);
            if (!CHECK(same_answer(&exact, &got, CYLINT_WANT_ALL)))
                report_answers(&c, "exact stage", &exact, &got);
        }
        n++;
        hits += want.n;
    }
    printf("note: seed %llu: %ld cases, %ld hits\n",
           (unsigned long long)check_seed(), n, hits);
    CHECK(hits > n / 4);
}

static void ends_at(const struct family_case *given, double tmin, double tmax)
{
    struct family_case c = *given;
    cylint_answer got, want;
    if (!(given->line.tmin <= tmin && tmax <= given->line.tmax))
        return;
    c.line.tmin = tmin;
    c.line.tmax = tmax;
    memset(&got, 0, sizeof got);
    cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &got);
    oracle_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &want);
    if (!CHECK(is_right(&got, &want, oracle_other(0)))) {
        REPORT("from %a to %a", tmin, tmax);
        report_answers(&c, "domain", &got, &want);
    }
}

/* The exact root may lie on either side of the end, which is t or beside it. */
TEST(a_domain_may_end_where_a_hit_is_rounded)
{
    EACH_CASE(c, check_seed() + 3, cases() / 3) {
        cylint_answer a;
        c.line = c.line.segment ? c.line : whole_of(c.line);
        cylint_intersect(&c.shape, &c.line, CYLINT_WANT_T, &a);
        for (int k = 0; k < a.n; k++) {
            const double end = stepped(a.hit[k].t, (int)(number % 3) - 1);
            ends_at(&c, end, c.line.tmax);
            ends_at(&c, c.line.tmin, end);
            ends_at(&c, end, end);
        }
    }
}

/* The box has every point that is not outside. */
TEST(contains_is_exact)
{
    EACH_CASE(c, check_seed() + 2, cases() / 4) {
        const double *o = c.line.o;
        const int want = oracle_contains(&c.shape, o);
        double lo[3], hi[3];
        cylint_bounds(&c.shape, lo, hi);
        int good = cylint_contains(&c.shape, o) == want;
        for (int i = 0; i < 3; i++)
            good &= want < 0 || (lo[i] <= o[i] && o[i] <= hi[i]);
        if (!CHECK(good)) {
            REPORT("want %d, family %s", want, family_name(family));
            family_report(&c);
        }
    }
}
