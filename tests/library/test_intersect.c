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
#include "vectors.h"

enum { CASES = 2000 };

static uint64_t cases(void)
{
    return check_setting("CYLINT_CASES", CASES);
}

/* A normal or a phi of oracle_other() is right, too. */
static int is_right(const cylint_answer *got, const cylint_answer *want)
{
    cylint_answer due = *want;
    for (int i = 0; i < want->n; i++) {
        const cylint_hit *g = &got->hit[i], *other = oracle_other(i);
        for (int k = 0; k < 3; k++)
            if (g->normal[k] == other->normal[k])
                due.hit[i].normal[k] = other->normal[k];
        if (g->phi == other->phi)
            due.hit[i].phi = other->phi;
    }
    return same_answer(got, &due, CYLINT_WANT_ALL);
}

TEST(library_and_oracle_agree)
{
    long n = 0, hits = 0;
    EACH_CASE(c, check_seed(), family_is_wild(family) ? cases() / 4 : cases()) {
        cylint_answer got, want;
        memset(&got, 0, sizeof got);
        cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &got);
        oracle_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &want);
        if (!CHECK(is_right(&got, &want)))
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
}

static void ends_at(const struct family_case *given, double tmin, double tmax)
{
    struct family_case c = *given;
    cylint_answer got, want;
    if (cylint_span(&c.line, given->line.o, given->line.d, tmin, tmax) != 0)
        return;
    cylint_intersect(&c.shape, &c.line, CYLINT_WANT_T, &got);
    oracle_intersect(&c.shape, &c.line, CYLINT_WANT_T, &want);
    if (!CHECK(got.n == want.n) ||
        !CHECK(got.n < 1 || got.hit[0].t == want.hit[0].t)) {
        REPORT("from %a to %a", tmin, tmax);
        family_report(&c);
    }
}

/* The exact root may lie on either side of the end. */
TEST(a_domain_may_end_where_a_hit_is_rounded)
{
    EACH_CASE(c, check_seed() + 3, cases() / 10) {
        cylint_answer a;
        oracle_intersect(&c.shape, &c.line, CYLINT_WANT_T, &a);
        for (int k = 0; k < a.n && !c.line.segment; k++) {
            ends_at(&c, a.hit[k].t, HUGE_VAL);
            ends_at(&c, -HUGE_VAL, a.hit[k].t);
            ends_at(&c, a.hit[k].t, a.hit[k].t);
        }
    }
}

TEST(contains_is_exact)
{
    EACH_CASE(c, check_seed() + 2, cases() / 4) {
        const double *o = c.line.o;
        const int want = oracle_contains(&c.shape, o);
        if (!CHECK(cylint_contains(&c.shape, o) == want)) {
            REPORT("want %d, family %s", want, family_name(family));
            family_report(&c);
        }
    }
}
