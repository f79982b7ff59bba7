/*
 * test_elliptic_certain.c - floor distance: elliptic kinds where doubles and pairs
 * make the answer certain
 *
 * Answers that are certain are those of the build that runs, of the one without a
 * fused multiply-add and of the last stage, in triples; nearly all are certain.
 * The safety is never above the distance, and not far below it.  CYLINT_CASES is
 * the number of shapes of a family; known.txt has cases that an attack found.
 */
#include <string.h>

#include "closest.h"
#include "distance/elliptic.h"
#include "distance/nearest.h"
#include "elliptic_solids.h"

enum { CASES = 800, MIXED = 20000, ALL = WANT | CYLINT_WANT_DISTANCE };

enum { ENDS = CYLINT_ENDS_NAPPE + 1 };

/* safe: the number and the sum of the ratios of safety and distance. */
struct tally {
    long n, left, safe;
    double ratios, least;
};

/* Returns the members that are left. */
static unsigned in_pairs(const cylint_shape *s, const double p[3],
                         cylint_closest *answer)
{
    return cylint_elliptic_kernels_plain.pairs(s, p, CYLINT_NO_FEATURE, ALL,
                                               answer);
}

/* Of *a and *b the members that `left` does not name. */
static int are_equal(const cylint_closest *a, const cylint_closest *b,
                     unsigned left)
{
    return (left & CYLINT_WANT_DISTANCE || a->distance == b->distance) &&
           (left & CYLINT_WANT_PART ||
            (a->part == b->part && a->feature == b->feature)) &&
           (left & CYLINT_WANT_POINT ||
            memcmp(a->point, b->point, sizeof a->point) == 0) &&
           (left & CYLINT_WANT_NORMAL ||
            memcmp(a->normal, b->normal, sizeof a->normal) == 0);
}

static int check_safety(const cylint_shape *s, const double p[3], double size,
                        struct tally *sum)
{
    const double safe = cylint_safety(s, p);
    if (size > 0) {
        sum->safe++;
        sum->ratios += safe / size;
        sum->least = fmin(sum->least, safe / size);
    }
    return CHECK(safe >= 0 && safe <= size);
}

/* triples: their answers are right, too. */
static void check_point(const struct solid *e, cylint_ends ends,
                        const double p[3], int triples, struct tally *sum)
{
    cylint_shape s;
    cylint_closest certain, all, last;
    if (!make_solid(&s, e, ends))
        return;
    all = answer_to(&s, p, WANT);
    if (!check_safety(&s, p, fabs(all.distance), sum))
        report_solid(e, ends, p);
    if (!cylint_prepared(&s))
        return;
    memset(&certain, 0, sizeof certain);
    memset(&last, 0, sizeof last);
    const unsigned left = in_pairs(&s, p, &certain);
    sum->n++;
    sum->left += left != 0;
    int right = are_equal(&certain, &all, left) &&
                cylint_distance(&s, p, 0, &last) == all.distance;
    if (triples) {
        cylint_elliptic_distance(&s, p, WANT, &last);
        right &= are_equal(&certain, &last, left);
    }
    if (!CHECK(right))
        report_solid(e, ends, p);
}

static struct tally tallies[ENDS][FORMS][PLACES];

static void check_solids(cylint_ends ends, enum form form, enum where where,
                         struct tally *sum)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    sum->least = 1;
    for (uint64_t i = 0; i < cases; i++) {
        struct solid e;
        double p[3];
        draw_solid(&e, form, i % 2 == 1);
        draw_place(&e, where, p);
        check_point(&e, ends, p, 1, sum);
    }
}

TEST(nearly_all_answers_are_certain)
{
    for (int end = 0; end < ENDS; end++) {
        long n = 0, left = 0;
        for (int form = 0; form < FORMS; form++)
            for (int where = 0; where < PLACES; where++) {
                struct tally *of = &tallies[end][form][where];
                check_solids((cylint_ends)end, (enum form)form,
                             (enum where)where, of);
                n += form < NEEDLE ? of->n : 0;
                left += form < NEEDLE ? of->left : 0;
            }
        const double share = (double)left / (double)n;
        printf("note: ends %d: %.2g of %ld answers are left to triples\n", end,
               share, n);
        /* Inside a shape without a cap the nearest point can be on either rim. */
        CHECK(n > (long)check_setting("CYLINT_CASES", CASES));
        CHECK(share < (end == CYLINT_ENDS_CAPPED ? 0.01 : 0.1));
    }
}

/* Of the points of the last test. */
TEST(the_safety_is_close_to_the_distance)
{
    for (int form = 0; form < FORMS; form++)
        for (int where = 0; where < PLACES; where++) {
            double mean = 1, least = 1;
            for (int end = 0; end < ENDS; end++) {
                const struct tally *of = &tallies[end][form][where];
                mean = fmin(mean, of->ratios / (double)of->safe);
                least = fmin(least, of->least);
            }
            printf("note: %s, %s: safety / distance %.4f in the mean, at least "
                   "%.3g\n",
                   form_names[form], place_names[where], mean, least);
            if (!CHECK(mean > 0.85))
                REPORT("%s %s: %g", form_names[form], place_names[where], mean);
        }
}

/* Small integers, decimals, zeros, or of any exponent up to 2^20. */
static double draw_number(int mode)
{
    switch (mode) {
    case 0:
        return one_of(9) - 4;
    case 1:
        return 0.1 * (one_of(9) - 4);
    case 2:
        return one_of(3) ? 0 : one_of(9) - 4;
    case 3:
        return between(-1, 1);
    default:
        return ldexp(between(-1, 1), one_of(40) - 20);
    }
}

static void draw_mixed(struct solid *e, int mode)
{
    double *const v[4] = {e->c, e->a, e->b, e->h};
    const int aligned = one_of(3) == 0;
    for (int i = 0; i < 12; i++)
        v[i / 3][i % 3] =
            aligned && i >= 3 && i % 3 != i / 3 - 1 ? 0 : draw_number(mode);
    e->k = one_of(3) ? fabs(draw_number(mode)) : one_of(2);
}

/* On the axis, a plane of symmetry, the plane of an end, the lateral surface, or
 * anywhere. */
static void draw_mixed_place(const struct solid *e, int mode, double p[3])
{
    const int where = one_of(6);
    double x = draw_number(mode), y = draw_number(mode), z = draw_number(mode);
    if (where == 0)
        x = y = 0;
    if (where == 1)
        y = 0;
    if (where == 2)
        z = one_of(2);
    if (where == 3) {
        const double turn = between(0, 6.3);
        const double off = pow(10, -one_of(17));
        x = (1 + (e->k - 1) * z) * (1 + off) * cos(turn);
        y = (1 + (e->k - 1) * z) * (1 + off) * sin(turn);
    }
    place_in_solid(e, x, y, z, p);
    for (int i = 0; i < 3 && where == 4; i++)
        p[i] = draw_number(mode);
}

TEST(coincidences_have_one_answer)
{
    const uint64_t cases = check_setting("CYLINT_MIXED", MIXED);
    struct tally sum = {0, 0, 0, 0, 1};
    for (uint64_t i = 0; i < cases; i++) {
        const int mode = one_of(5);
        struct solid e;
        double p[3];
        draw_mixed(&e, mode);
        draw_mixed_place(&e, mode, p);
        check_point(&e, (cylint_ends)one_of(ENDS), p, 0, &sum);
    }
    CHECK(sum.left < sum.n / 2);
}

TEST(on_the_axis_the_answer_is_certain)
{
    const struct solid tube = {{1, 2, 3}, {2, 0, 0}, {0, 1, 0}, {0, 0, 8}, 1};
    const double p[3] = {1, 2, 6.7};
    cylint_shape s;
    cylint_closest a;
    CHECK(make_solid(&s, &tube, CYLINT_ENDS_CAPPED));
    memset(&a, 0, sizeof a);
    CHECK(in_pairs(&s, p, &a) == 0);
    CHECK(a.distance == -1 && a.feature == CYLINT_FEATURE_LATERAL);
    CHECK(a.point[0] == 1 && a.point[1] == 3 && a.point[2] == 6.7 &&
          a.normal[1] == 1);
}
