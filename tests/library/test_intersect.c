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
#ifdef HAVE_MPFR
#include "check.h"
#include "oracle.h"
#include "ulps.h"

enum { CASES = 2000 };

/* The numbers of wrong answers and the largest errors of one family. */
struct tally {
    long cases, hits, relation, number, part, t, derived;
    double off[MEASURES]; /* worst */
};

static uint64_t seed(void)
{
    return check_setting("CYLINT_SEED", 1);
}

static uint64_t cases(void)
{
    return check_setting("CYLINT_CASES", CASES);
}

/* `other`: oracle_other(). */
static int compare_derived(struct tally *sum, const cylint_hit *got,
                           const cylint_hit *want, const cylint_hit *other)
{
    double off[MEASURES];
    int good = 1;
    ulps_of_hit(got, want, other, off);
    for (int i = ULPS_POINT; i < MEASURES; i++) {
        sum->off[i] = fmax(sum->off[i], off[i]);
        good &= off[i] == 0;
    }
    return good;
}

static void show(const struct family_case *c, const char *what,
                 const cylint_answer *got, const cylint_answer *want)
{
    const cylint_answer *both[2] = {got, want};
    fprintf(stderr, "# %s\n", what);
    family_report(c);
    for (int k = 0; k < 2; k++) {
        fprintf(stderr, "#   %s relation %d n %d", k ? "want" : "got ",
                both[k]->relation, both[k]->n);
        for (int i = 0; i < both[k]->n; i++) {
            const cylint_hit *h = &both[k]->hit[i];
            fprintf(stderr,
                    "\n#     t %a part %d side %d  point %a %a "
                    "%a  normal %a %a %a  z %a phi %a",
                    h->t, h->part, h->side, h->point[0], h->point[1],
                    h->point[2], h->normal[0], h->normal[1], h->normal[2], h->z,
                    h->phi);
        }
        fputc('\n', stderr);
    }
}

/* Counts and returns the first difference, or returns NULL. */
static const char *compare(struct tally *sum, const cylint_answer *got,
                           const cylint_answer *want)
{
    const char *wrong = NULL;
    sum->cases++;
    sum->hits += want->n;
    if (got->relation != want->relation) {
        sum->relation++;
        return "relation";
    }
    if (got->n != want->n || got->flags != want->flags) {
        sum->number++;
        return "number of hits";
    }
    for (int i = 0; i < want->n && !wrong; i++) {
        const cylint_hit *g = &got->hit[i], *w = &want->hit[i];
        if (g->part != w->part || g->side != w->side) {
            sum->part++;
            wrong = "part or side";
        } else if (g->t != w->t) {
            sum->t++;
            wrong = "t";
        } else if (!compare_derived(sum, g, w, oracle_other(i))) {
            sum->derived++;
            wrong = "point, normal, z or phi";
        }
    }
    return wrong;
}

static void print_tally(const char *name, const struct tally *s)
{
    printf("note: %-22s %8ld %8ld %5ld %5ld %5ld %5ld %5ld  %9.3g %9.3g %9.3g"
           " %9.3g\n",
           name, s->cases, s->hits, s->relation, s->number, s->part, s->t,
           s->derived, s->off[ULPS_POINT], s->off[ULPS_NORMAL], s->off[ULPS_Z],
           s->off[ULPS_PHI]);
}

static void run_family(int family)
{
    struct tally sum = {0};
    for (uint64_t i = 0; i < cases(); i++) {
        struct family_case c;
        cylint_answer got, want;
        family_case(seed(), family, i, &c);
        memset(&got, 0, sizeof got);
        cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &got);
        oracle_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &want);
        const char *wrong = compare(&sum, &got, &want);
        if (!CHECK(wrong == NULL) && check_bad <= CHECK_SHOWN) {
            show(&c, wrong, &got, &want);
        }
    }
    print_tally(family_name(family), &sum);
}

static void library_and_oracle_agree(void)
{
    const int only =
        getenv("CYLINT_FAMILY") ? atoi(getenv("CYLINT_FAMILY")) : -1;
    int bad = 0;
    printf("note: seed %llu; wrong relation, number, part, t, derived; worst "
           "point, normal, z, phi in ulp\n",
           (unsigned long long)seed());
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
    for (int i = 0; i < 3; i++) {
        p[i] = c->line.o[i] + t * c->line.d[i];
    }
    return oracle_contains(&c->shape, p);
}

/* Checks the oracle itself: points of the line just before and just after each
 * hit are inside or outside as the side of the hit says. */
static void oracle_agrees_with_points_sampled_along_the_line(void)
{
    for (uint64_t i = 0; i < cases(); i++) {
        struct family_case c;
        cylint_answer answer;
        family_case(seed(), 0, i, &c);
        if (c.line_word == FAMILY_SEGMENT) {
            continue; /* its d is rounded */
        }
        c.line.tmin = -HUGE_VAL;
        c.line.tmax = HUGE_VAL;
        c.shape.ends = c.shape.ends < CYLINT_ENDS_INFINITE ? CYLINT_ENDS_CAPPED
                                                           : c.shape.ends;
        oracle_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &answer);
        CHECK(answer.n > 0 || answer.relation == CYLINT_RELATION_MISS);
        for (int k = 0; k < answer.n; k++) {
            const double t = answer.hit[k].t, step = 1e-6;
            const int in = answer.hit[k].side == CYLINT_SIDE_ENTERING ? 1 : -1;
            if (answer.n == 2 && answer.hit[1].t - answer.hit[0].t < 4 * step) {
                continue;
            }
            if (!CHECK(inside_at(&c, t + step) == in &&
                       inside_at(&c, t - step) == -in)) {
                family_report(&c);
            }
        }
    }
}

static void occluded_agrees_with_the_oracle(void)
{
    for (int family = 0; family < family_count(); family++) {
        for (uint64_t i = 0; i < cases() / 10; i++) {
            struct family_case c;
            cylint_answer want;
            family_case(seed() + 1, family, i, &c);
            oracle_intersect(&c.shape, &c.line, CYLINT_WANT_NEAREST, &want);
            if (!CHECK(cylint_occluded(&c.shape, &c.line) == want.n)) {
                family_report(&c);
            }
        }
    }
}

static void ends_at(const struct family_case *given, double tmin, double tmax)
{
    struct family_case c = *given;
    cylint_answer got, want;
    if (cylint_span(&c.line, given->line.o, given->line.d, tmin, tmax) != 0) {
        return;
    }
    cylint_intersect(&c.shape, &c.line, CYLINT_WANT_T, &got);
    oracle_intersect(&c.shape, &c.line, CYLINT_WANT_T, &want);
    if (!CHECK(got.n == want.n) ||
        !CHECK(got.n < 1 || got.hit[0].t == want.hit[0].t)) {
        REPORT("from %a to %a", tmin, tmax);
        family_report(&c);
    }
}

/* The exact root may lie on either side of the end. */
static void a_domain_may_end_where_a_hit_is_rounded(void)
{
    for (int family = 0; family < family_count(); family++) {
        for (uint64_t i = 0; i < cases() / 10; i++) {
            struct family_case c;
            cylint_answer a;
            family_case(seed() + 3, family, i, &c);
            oracle_intersect(&c.shape, &c.line, CYLINT_WANT_T, &a);
            for (int k = 0; k < a.n && !c.line.segment; k++) {
                ends_at(&c, a.hit[k].t, HUGE_VAL);
                ends_at(&c, -HUGE_VAL, a.hit[k].t);
                ends_at(&c, a.hit[k].t, a.hit[k].t);
            }
        }
    }
}

static void contains_is_exact(void)
{
    for (int family = 0; family < family_count(); family++) {
        for (uint64_t i = 0; i < cases() / 4; i++) {
            struct family_case c;
            family_case(seed() + 2, family, i, &c);
            const double *o = c.line.o;
            const int want = oracle_contains(&c.shape, o);
            if (!CHECK(cylint_contains(&c.shape, o) == want)) {
                REPORT("want %d, family %s", want, family_name(family));
                family_report(&c);
            }
        }
    }
}

int main(void)
{
    if (family_count() == 0) {
        return check_skip("no GSL: no families to draw from (make deps)");
    }
    RUN(oracle_agrees_with_points_sampled_along_the_line);
    RUN(library_and_oracle_agree);
    RUN(occluded_agrees_with_the_oracle);
    RUN(a_domain_may_end_where_a_hit_is_rounded);
    RUN(contains_is_exact);
    return check_end();
}

#else

#include "program.h"

int main(void)
{
    return check_skip("no MPFR: no oracle to compare with (make deps)");
}

#endif
