/*
 * test_intersect.c - floor intersect: the library against the oracle, by family
 *
 * Relation, number, parts, sides and every bit of t, point, normal, z and phi must
 * agree.  The largest differences are printed.
 * CYLINT_CASES is the number of cases of each family, CYLINT_SEED changes all
 * cases, CYLINT_FAMILY=n tests one family.
 */
#include <math.h>
#include <string.h>

#include "cylint.h"
#include "families.h"
#include "check.h"
#include "oracle.h"
#include "same.h"
#include "ulps.h"

enum { CASES = 2000 };

/* The largest errors of one family. */
struct tally {
    long cases, hits;
    double off[MEASURES]; /* worst */
};

static uint64_t cases(void)
{
    return check_setting("CYLINT_CASES", CASES);
}

/* Counts and returns the first difference, or returns NULL.  oracle_other() is
 * right too. */
static const char *compare(struct tally *sum, const cylint_answer *got,
                           const cylint_answer *want)
{
    sum->cases++;
    sum->hits += want->n;
    if (got->relation != want->relation || got->n != want->n ||
        got->flags != want->flags)
        return "relation or number of hits";
    for (int i = 0; i < want->n; i++) {
        const cylint_hit *g = &got->hit[i], *w = &want->hit[i];
        double off[MEASURES];
        if (g->part != w->part || g->side != w->side)
            return "part or side";
        ulps_of_hit(g, w, oracle_other(i), off);
        for (int k = 0; k < MEASURES; k++) {
            sum->off[k] = fmax(sum->off[k], off[k]);
            if (off[k] != 0)
                return measure_names[k];
        }
    }
    return NULL;
}

static void run_family(int family)
{
    struct tally sum = {0};
    const uint64_t n = family_is_wild(family) ? cases() / 4 : cases();
    for (uint64_t i = 0; i < n; i++) {
        struct family_case c;
        cylint_answer got, want;
        family_case(check_seed(), family, i, &c);
        memset(&got, 0, sizeof got);
        cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &got);
        oracle_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &want);
        const char *wrong = compare(&sum, &got, &want);
        if (!CHECK(wrong == NULL))
            report_answers(&c, wrong, &got, &want);
    }
    printf("note: %-22s %8ld %8ld  %9.3g %9.3g %9.3g %9.3g %9.3g\n",
           family_name(family), sum.cases, sum.hits, sum.off[ULPS_T],
           sum.off[ULPS_POINT], sum.off[ULPS_NORMAL], sum.off[ULPS_Z],
           sum.off[ULPS_PHI]);
}

TEST(library_and_oracle_agree)
{
    const int only =
        getenv("CYLINT_FAMILY") ? atoi(getenv("CYLINT_FAMILY")) : -1;
    int bad = 0;
    printf(
        "note: seed %llu; cases, hits; worst t, point, normal, z, phi in ulp\n",
        (unsigned long long)check_seed());
    for (int family = 0; family < family_count(); family++) {
        if (only < 0 || family == only) {
            check_bad = 0; /* each family prints its first failures */
            run_family(family);
            bad += check_bad;
        }
    }
    check_bad = bad;
}

/* Whether the point of the line near t is inside or outside. */
static int inside_at(const struct family_case *c, double t)
{
    double p[3];
    for (int i = 0; i < 3; i++)
        p[i] = c->line.o[i] + t * c->line.d[i];
    return oracle_contains(&c->shape, p);
}

/* Checks the oracle itself: points of the line just before and just after each
 * hit are inside or outside as the side of the hit says. */
TEST(oracle_agrees_with_points_sampled_along_the_line)
{
    for (uint64_t i = 0; i < cases(); i++) {
        struct family_case c;
        cylint_answer answer;
        family_case(check_seed(), 0, i, &c);
        if (c.line_word == FAMILY_SEGMENT)
            continue; /* its d is rounded */
        c.line.tmin = -HUGE_VAL;
        c.line.tmax = HUGE_VAL;
        c.shape.ends = c.shape.ends < CYLINT_ENDS_INFINITE ? CYLINT_ENDS_CAPPED
                                                           : c.shape.ends;
        oracle_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &answer);
        CHECK(answer.n > 0 || answer.relation == CYLINT_RELATION_MISS);
        for (int k = 0; k < answer.n; k++) {
            const double t = answer.hit[k].t, step = 1e-6;
            const int in = answer.hit[k].side == CYLINT_SIDE_ENTERING ? 1 : -1;
            if (answer.n == 2 && answer.hit[1].t - answer.hit[0].t < 4 * step)
                continue;
            if (!CHECK(inside_at(&c, t + step) == in &&
                       inside_at(&c, t - step) == -in))
                family_report(&c);
        }
    }
}

TEST(occluded_agrees_with_the_oracle)
{
    EACH_CASE(c, check_seed() + 1, cases() / 10) {
        cylint_answer want;
        oracle_intersect(&c.shape, &c.line, CYLINT_WANT_NEAREST, &want);
        if (!CHECK(cylint_occluded(&c.shape, &c.line) == want.n))
            family_report(&c);
    }
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
