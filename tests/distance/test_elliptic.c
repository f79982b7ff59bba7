/*
 * test_elliptic.c - floor distance: elliptic kinds
 *
 * No point of the surface is nearer than the one that is found.  Answers that are
 * certain are those of the build that runs, of the one without a fused
 * multiply-add and of the last stage, in triples; nearly all are certain.  The
 * safety is never above the distance, and not far below it.  CYLINT_CASES is the
 * number of shapes of a family; known.txt has cases that an attack found.
 */
#include <string.h>

#include "closest.h"
#include "distance/elliptic.h"
#include "elliptic_solids.h"

enum {
    CASES = 800,
    MIXED = 20000,
    ANGLES = 180,
    ALL = WANT | CYLINT_WANT_DISTANCE
};

enum { ENDS = CYLINT_ENDS_NAPPE + 1 };

/* safe: the number and the sum of the ratios of safety and distance. */
struct tally {
    long n, left, safe;
    double ratios, least;
};

/* Whether pairs make all members certain. */
static int in_pairs(const cylint_shape *s, const double p[3],
                    cylint_closest *answer)
{
    return !cylint_elliptic_kernels_plain.pairs(s, p, ALL, answer);
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

/* The least distance of a point from the segments, or lines, of the surface at
 * ANGLES angles. */
static double from_rulings(const struct solid *e, int bounded,
                           const double p[3])
{
    double least = HUGE_VAL;
    for (int n = 0; n < ANGLES; n++) {
        const double turn = 6.283185307179586 * n / ANGLES, x = cos(turn),
                     y = sin(turn);
        double at[3], v[3], foot[3];
        place_in_solid(e, x, y, 0, at);
        place_in_solid(e, e->k * x, e->k * y, 1, v);
        for (int i = 0; i < 3; i++) {
            v[i] -= at[i];
            foot[i] = p[i] - at[i];
        }
        const double z = dot3(foot, v) / dot3(v, v);
        add3(foot, bounded ? -fmin(fmax(z, 0), 1) : -z, v);
        least = fmin(least, dot3(foot, foot));
    }
    return sqrt(least);
}

/* drawn: a solid and a point of a family; the answers of triples are right, too. */
static void check_point(const struct solid *e, cylint_ends ends,
                        const double p[3], int drawn, struct tally *sum)
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
    const int is_certain = in_pairs(&s, p, &certain);
    sum->n++;
    sum->left += !is_certain;
    int right = (!is_certain || same(&certain, &all)) &&
                cylint_distance(&s, p, 0, &last) == all.distance;
    if (drawn) {
        cylint_elliptic_distance(&s, p, WANT, &last);
        right &= !is_certain || same(&certain, &last);
        right &=
            fabs(all.distance) <=
            from_rulings(e, ends != CYLINT_ENDS_INFINITE, p) * (1 + 0x1p-30) +
                0x1p-40;
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

/* The share of answers that are left to triples. */
static double share_left(int end, int first_place, int last_place)
{
    long n = 0, left = 0;
    for (int form = 0; form < NEEDLE; form++)
        for (int where = first_place; where <= last_place; where++) {
            n += tallies[end][form][where].n;
            left += tallies[end][form][where].left;
        }
    CHECK(n > 0);
    return (double)left / (double)n;
}

TEST(no_point_is_nearer_and_nearly_all_answers_are_certain)
{
    for (int end = 0; end < ENDS; end++) {
        for (int form = 0; form < FORMS; form++)
            for (int where = 0; where < PLACES; where++)
                check_solids((cylint_ends)end, (enum form)form,
                             (enum where)where, &tallies[end][form][where]);
        const double share = share_left(end, 0, BESIDE - 1),
                     beside = share_left(end, BESIDE, BESIDE);
        printf("note: ends %d: %.2g of all answers are left to triples, %.2g "
               "beside the surface\n",
               end, share, beside);
        /* Inside a shape without a cap the nearest point can be on either rim. */
        CHECK(share < (end == CYLINT_ENDS_CAPPED ? 0.01 : 0.1));
        CHECK(beside < 0.15);
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

TEST(on_the_axis_the_answer_has_the_least_phi)
{
    const struct solid tube = {{1, 2, 3}, {2, 0, 0}, {0, 1, 0}, {0, 0, 8}, 1};
    const double p[3] = {1, 2, 6.7};
    cylint_shape s;
    CHECK(make_solid(&s, &tube, CYLINT_ENDS_CAPPED));
    const cylint_closest a = answer_to(&s, p, WANT);
    CHECK(a.distance == -1 && a.feature == CYLINT_FEATURE_LATERAL);
    CHECK(a.point[0] == 1 && a.point[1] == 3 && a.point[2] == 6.7 &&
          a.normal[1] == 1);
}

/* The axis is x, the radius 1000: point and normal are multiples of (y, z). */
TEST(far_from_a_cylinder_point_and_normal_are_right)
{
    static const double a[3] = {0, -1000, 0}, b[3] = {0, 0, 1000},
                        h[3] = {-2, 0, 0};
    for (int e = 0; e < 1020; e++) {
        const double p[3] = {ldexp(-1.01, e), ldexp(-4.8, e), ldexp(0.325, e)},
                     size = hypot(-4.8, 0.325);
        const double n[3] = {0, -4.8 / size, 0.325 / size},
                     on[3] = {p[0], 1000 * n[1], 1000 * n[2]};
        cylint_shape s;
        cylint_closest got;
        cylint_elliptic_cone(&s, (double[3]){0}, a, b, h, 1,
                             CYLINT_ENDS_INFINITE);
        const int inside = cylint_distance(&s, p, WANT, &got) < 0;
        if (!CHECK(inside == (size * ldexp(1, e) < 1000) &&
                   are_within(got.point, on, 8) &&
                   are_within(got.normal, n, 8)))
            REPORT("2^%d: point %a %a %a", e, got.point[0], got.point[1],
                   got.point[2]);
    }
}
