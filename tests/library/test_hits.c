/*
 * test_hits.c - members of hits that are known exactly, and domains
 *
 * The records of hits.txt must have their hits bit for bit, those of hard.txt the
 * relation and each t, with each member wanted alone, in every floating-point
 * environment, and from the exact stage alone.
 */
#include <math.h>

#include "check.h"
#include "families.h"
#include "environment.h"
#include "intersect.h"
#include "records.h"
#include "same.h"
#ifdef HAVE_MPFR
#include "oracle.h"
#endif

enum { MOST = 600 };

static struct record {
    struct family_case c;
    cylint_answer want;
    unsigned known; /* members of want */
} records[MOST];
static int count;

/* The next record, of which these members are known. */
static struct record *begin_record(const char *text, const char **known,
                                   unsigned members)
{
    struct record *r = &records[count];
    if (count == MOST || !family_parse(text, &r->c) ||
        !(*known = read_relation(*known, &r->want)))
        return NULL;
    r->known = members | CYLINT_WANT_NEAREST;
    count++;
    return r;
}

static const char *take(const char *text, const char *known)
{
    struct record *r = begin_record(text, &known, CYLINT_WANT_ALL);
    if (!r)
        return NULL;
    cylint_answer *a = &r->want;
    for (int i = 0; i < a->n && known; i++) {
        double x[11];
        known = family_numbers(known, 11, x);
        a->hit[i] = (cylint_hit){.part = (int)x[0],
                                 .side = (int)x[1],
                                 .t = x[2],
                                 .point = {x[3], x[4], x[5]},
                                 .normal = {x[6], x[7], x[8]},
                                 .z = x[9],
                                 .phi = x[10]};
    }
    return known;
}

static const char *take_hard(const char *text, const char *known)
{
    double t[2];
    struct record *r = begin_record(text, &known, CYLINT_WANT_T);
    if (!r || !(known = family_numbers(known, 2, t)))
        return NULL;
    for (int i = 0; i < r->want.n; i++)
        r->want.hit[i].t = t[i];
    return known;
}

TEST(every_record_is_read)
{
    each_record("tests/library/hits.txt", 227, take);
    each_record("tests/library/hard.txt", 281, take_hard);
}

/* A case is made and answered in the environment; in the last two rounds it is only
 * answered there, and only made there. */
TEST(hits_are_the_nearest_doubles_in_every_environment)
{
    enum { WANTS = 8 };
    static const unsigned wants[WANTS] = {
        CYLINT_WANT_ALL,    CYLINT_WANT_T, CYLINT_WANT_PART, CYLINT_WANT_POINT,
        CYLINT_WANT_NORMAL, CYLINT_WANT_Z, CYLINT_WANT_PHI,  EVERY_WANT};
    EACH_ENVIRONMENT(there)
        for (int i = 0; i < count; i++)
            for (int k = 0; k < WANTS + 3; k++) {
                struct family_case c = records[i].c;
                const int exactly = k == WANTS;
                const unsigned want = k < WANTS ? wants[k] : CYLINT_WANT_ALL;
                cylint_answer got;
                memset(&got, 0, sizeof got);
                environment_set(there);
                if (k != WANTS + 1)
                    family_make(&c);
                if (k == WANTS + 2)
                    environment_reset();
                (exactly ? cylint_intersect_by_signs
                         : cylint_intersect)(&c.shape, &c.line, want, &got);
                environment_reset();
                if (!CHECK(same_answer(&got, &records[i].want,
                                       want & records[i].known)))
                    report_answers(&c, exactly ? "exact stage" : "got", &got,
                                   &records[i].want);
            }
}

TEST(unwanted_members_are_not_written_and_change_nothing)
{
    EACH_CASE(c, 3, 20)
        for (unsigned want = 0; want < 2 * CYLINT_WANT_NEAREST; want++)
            if (!CHECK(has_wanted_members(&c, want)))
                REPORT_CASE(&c);
}

#ifdef HAVE_MPFR

/* The normal is the point minus c: 2^-54 before 3/4 and 5/8.  If c[1] exceeds
 * 2^-54 by 2^-94, the second component is nearer to the middle of two doubles
 * than 2^-90 of itself; if by 2^-90, it is not. */
TEST(the_oracle_has_both_doubles_beside_a_middle)
{
    static const double line[] = {0.75, 0.625, -2, 0, 0, 1};
    static const double beyond[] = {0x1p-94, 0x1p-90};
    for (int i = 0; i < 2; i++) {
        const double ball[] = {0x1p-54, 0x1p-54 + beyond[i], 0, 1};
        struct family_case c =
            family_of(FAMILY_LINE, line, FAMILY_SPHERE, ball);
        cylint_answer want;
        CHECK(family_make(&c));
        oracle_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &want);
        const double *n = want.hit[0].normal;
        const double *other = oracle_other(0)->normal;
        CHECK(n[0] == 0.75 && other[0] == 0x1.7ffffffffffffp-1);
        CHECK(n[1] == 0x1.3ffffffffffffp-1);
        CHECK(other[1] == (i == 0 ? 0.625 : n[1]) && other[2] == n[2]);
    }
}

#endif
