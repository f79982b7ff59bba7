/*
 * test_elliptic_certain.c - floor distance: elliptic kinds where doubles and pairs
 * make the answer certain
 *
 * Answers that are certain are those of the build that runs, of the one without a
 * fused multiply-add and of the last stage, in triples; nearly all are certain.
 * The safety is never above the distance, and not far below it.  Named cases hold
 * what an attack found.  CYLINT_CASES is the number of shapes of a family.
 */
#include <string.h>

#include "distance/elliptic.h"
#include "distance/nearest.h"
#include "elliptic_solids.h"
#include "known_distances.h"

enum { CASES = 800, MIXED = 20000, ALL = WANT | CYLINT_WANT_DISTANCE };

static const cylint_ends every_ends[] = {
    CYLINT_ENDS_CAPPED, CYLINT_ENDS_OPEN,     CYLINT_ENDS_CAP0,
    CYLINT_ENDS_CAP1,   CYLINT_ENDS_INFINITE, CYLINT_ENDS_NAPPE};
enum { ENDS = sizeof every_ends / sizeof every_ends[0] };

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

static void nearly_all_answers_are_certain(void)
{
    for (int end = 0; end < ENDS; end++) {
        long n = 0, left = 0;
        for (int form = 0; form < FORMS; form++)
            for (int where = 0; where < PLACES; where++) {
                struct tally *of = &tallies[end][form][where];
                check_solids(every_ends[end], (enum form)form,
                             (enum where)where, of);
                n += form < NEEDLE ? of->n : 0;
                left += form < NEEDLE ? of->left : 0;
            }
        const double share = (double)left / (double)n;
        printf("note: ends %d: %.2g of %ld answers are left to triples\n", end,
               share, n);
        /* Inside a shape without a cap the nearest point can be on either rim. */
        CHECK(n > (long)check_setting("CYLINT_CASES", CASES));
        CHECK(share < (every_ends[end] == CYLINT_ENDS_CAPPED ? 0.01 : 0.1));
    }
}

/* Of the points of the last test. */
static void the_safety_is_close_to_the_distance(void)
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

static uint64_t stream = 25;

/* Small integers, decimals, zeros, or of any exponent up to 2^20. */
static double draw_number(int mode)
{
    switch (mode) {
    case 0:
        return random_int(&stream, 9) - 4;
    case 1:
        return 0.1 * (random_int(&stream, 9) - 4);
    case 2:
        return random_int(&stream, 3) ? 0 : random_int(&stream, 9) - 4;
    case 3:
        return 2 * random_unit(&stream) - 1;
    default:
        return ldexp(2 * random_unit(&stream) - 1,
                     random_int(&stream, 40) - 20);
    }
}

static void draw_mixed(struct solid *e, int mode)
{
    double *const v[4] = {e->c, e->a, e->b, e->h};
    const int aligned = random_int(&stream, 3) == 0;
    for (int i = 0; i < 12; i++)
        v[i / 3][i % 3] =
            aligned && i >= 3 && i % 3 != i / 3 - 1 ? 0 : draw_number(mode);
    e->k = random_int(&stream, 3) ? fabs(draw_number(mode))
                                  : random_int(&stream, 2);
}

/* On the axis, a plane of symmetry, the plane of an end, the lateral surface, or
 * anywhere. */
static void draw_mixed_place(const struct solid *e, int mode, double p[3])
{
    const int where = random_int(&stream, 6);
    double x = draw_number(mode), y = draw_number(mode), z = draw_number(mode);
    if (where == 0)
        x = y = 0;
    if (where == 1)
        y = 0;
    if (where == 2)
        z = random_int(&stream, 2);
    if (where == 3) {
        const double turn = 6.3 * random_unit(&stream);
        const double off = pow(10, -random_int(&stream, 17));
        x = (1 + (e->k - 1) * z) * (1 + off) * cos(turn);
        y = (1 + (e->k - 1) * z) * (1 + off) * sin(turn);
    }
    place_in_solid(e, x, y, z, p);
    for (int i = 0; i < 3 && where == 4; i++)
        p[i] = draw_number(mode);
}

static void coincidences_have_one_answer(void)
{
    const uint64_t cases = check_setting("CYLINT_MIXED", MIXED);
    struct tally sum = {0, 0, 0, 0, 1};
    for (uint64_t i = 0; i < cases; i++) {
        const int mode = random_int(&stream, 5);
        struct solid e;
        double p[3];
        draw_mixed(&e, mode);
        draw_mixed_place(&e, mode, p);
        check_point(&e, every_ends[random_int(&stream, ENDS)], p, 0, &sum);
    }
    CHECK(sum.left < sum.n / 2);
}

/* ----------------------------------------------------------- named cases -- */

static cylint_shape shape_of(const struct solid *e, cylint_ends ends)
{
    cylint_shape s;
    CHECK(make_solid(&s, e, ends));
    return s;
}

/* The other nappe of a double cone is computed as this one, turned about the
 * apex: so are its triples, and of two nearest points the one with the least
 * phi. */
static void the_other_nappe_is_turned(void)
{
    const struct solid cone = {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 1}, 2};
    const cylint_shape s = shape_of(&cone, CYLINT_ENDS_INFINITE);
    const double on_axis[3] = {0, 0, -5};
    const cylint_closest a = answer_to(&s, on_axis, WANT);
    /* The rulings of (0, 2, 1) from the apex (0, 0, -1). */
    CHECK(fabs(a.distance + 8 / sqrt(5)) <= 1e-15 * 4);
    CHECK(a.point[0] == 0 && a.point[1] > 0 && a.normal[1] > 0);
    const double t = 1e-12, outside[3] = {0, 8 + t, -5};
    const cylint_closest b = answer_to(&s, outside, WANT);
    const double off = (outside[1] - 8) / sqrt(5);
    CHECK(fabs(b.distance - off) <= 1e-15 * off);
    CHECK(b.point[1] < outside[1] && b.point[2] < -5);
}

/* a and h are nearly parallel: the terms of a normal cancel to 2^-33 of them. */
static void what_cancels_in_a_normal_is_uncertain(void)
{
    const struct solid e = {
        {-0x1.ed589896ab5dcp-31, -0x1.928388bf84946p+25,
         -0x1.8a90e8395e76cp+15},
        {0x1.ae0fd275dc2b8p+2, -0x1.55bf86e5de0bp+26, 0x1.6314881263fep+18},
        {0x1.d8eadf98ecdfp-33, -0x1.94ca3a4cccafp-13, -0x1.0790c48f63fe8p-8},
        {0x1.10d79a2709dcp-35, -0x1.39103d89e2cp+16, 0x1.0e9090e0c02e8p-19},
        0x1.f15b888dbd7ccp-2};
    const double p[3] = {-0x1.3d8ae9b61e694p-3, -0x1.b51275c2879p+25,
                         -0x1.312f7c66c8b62p+28};
    const cylint_shape s = shape_of(&e, CYLINT_ENDS_NAPPE);
    const double d = answer_to(&s, p, 0).distance;
    CHECK(fabs(d - 319974815.96852636) <= 1e-7);
    CHECK(cylint_safety(&s, p) <= d);
}

/* 2^-55 from the surface the foot on the tangent plane is as far beside the ruling
 * as the error of the angle. */
static void the_foot_is_beside_the_angle(void)
{
    const struct solid e = {{0, 0.30000000000000004, 0.30000000000000004},
                            {0.2, 0, 0},
                            {-0.2, 0.2, -0.30000000000000004},
                            {-0.2, 0, -0.2},
                            1};
    const double p[3] = {-0.30000000000000004, 0.1, 0.1};
    const cylint_shape s = shape_of(&e, CYLINT_ENDS_NAPPE);
    const cylint_closest a = answer_to(&s, p, WANT);
    CHECK(a.distance == 0x1p-55);
    CHECK(a.normal[0] == 0x1.3fffffffffffep-53 && a.normal[1] == -1 &&
          a.normal[2] == -0x1.3fffffffffffep-53);
}

/* The axis is nearly in the plane of the section: a.(b x h) is 1e-3 of its terms,
 * and the point is nearly in the middle. */
static void a_flat_shape_has_the_nearer_cap(void)
{
    const struct solid e = {
        {0x1.f490e688p-2, -0x1.23a29968p-2, 0x1.8265f1fp-3},
        {0x1.63192788d8d52p-6, 0x1.e0cdb8d44d695p-2, -0x1.b9194905709bep-4},
        {0x1.660b94bdecc32p+0, 0x1.a8a5d744b502ap-1, -0x1.9f91b9a14f836p-2},
        {0x1.6b85ef841dd48p+0, 0x1.4c8a21fd1c0aap+0, -0x1.073dbf0681aa2p-1},
        1};
    const double p[3] = {0x1.32e73280bc6c5p+0, 0x1.7571acca2dad9p-2,
                         -0x1.182b1d0461191p-4};
    const cylint_shape s = shape_of(&e, CYLINT_ENDS_CAPPED);
    const cylint_closest a = answer_to(&s, p, WANT);
    CHECK(a.distance == -0.00031562053061795297 && a.feature == CAP0);
}

/* On the surface, one rounding from the apex: nearly all digits of x and y have
 * cancelled. */
static void beside_an_apex_the_normal_is_that_of_the_ruling(void)
{
    const struct solid e = {{0.2, -0.4, 0.4},
                            {0.4, 0, 0.2},
                            {-0.30000000000000004, 0.4, 0.30000000000000004},
                            {0.1, 0, -0.1},
                            0};
    const double p[3] = {0.30000000000000004, -0.4, 0.30000000000000004};
    const cylint_shape s = shape_of(&e, CYLINT_ENDS_OPEN);
    const cylint_closest a = answer_to(&s, p, WANT);
    CHECK(a.distance == 0 && a.feature == LATERAL);
    CHECK(a.normal[0] == 0.48507125007266594 &&
          a.normal[1] == 0.72760687510899891 &&
          a.normal[2] == -0.48507125007266594);
}

static void on_the_axis_the_answer_is_certain(void)
{
    const struct solid tube = {{1, 2, 3}, {2, 0, 0}, {0, 1, 0}, {0, 0, 8}, 1};
    const cylint_shape s = shape_of(&tube, CYLINT_ENDS_CAPPED);
    const double p[3] = {1, 2, 6.7};
    cylint_closest a;
    memset(&a, 0, sizeof a);
    CHECK(in_pairs(&s, p, &a) == 0);
    CHECK(a.distance == -1 && a.feature == LATERAL && a.point[0] == 1 &&
          a.point[1] == 3 && a.point[2] == 6.7 && a.normal[1] == 1);
}

/* Far along a thin cylinder the error of its local coordinates is larger than
 * their circle. */
static void a_large_error_of_local_coordinates_leaves_no_safety(void)
{
    const double c[3] = {0x1.e40a3c08p-2, -0x1.2722ddap-1, 0x1.84b3e10cp-1};
    const double a[3] = {-0x1.ca41ab0894793p-41, 0x1.c149043420eebp-44,
                         0x1.d8ec540984505p-39};
    const double b[3] = {0x1.335dfb04d84f2p-28, 0x1.1719724d5cb91p-26,
                         0x1.c7844210af6ffp-27};
    const double h[3] = {-0x1.46b0fb057931fp+15, 0x1.8b4a11488c19ep+12,
                         0x1.4ed31dd3908bfp+10};
    const double p[3] = {-0x1.947d7ae62ec6dp+16, 0x1.e9688df088fc4p+13,
                         0x1.9ea83cdfed63p+11};
    cylint_shape s;
    cylint_closest q;
    cylint_elliptic_cylinder(&s, c, a, b, h, CYLINT_ENDS_INFINITE);
    const double size = fabs(cylint_distance(&s, p, 0, &q));
    CHECK(size < 0x1p-38 && cylint_safety(&s, p) <= size);
}

int main(void)
{
    RUN(nearly_all_answers_are_certain);
    RUN(the_safety_is_close_to_the_distance);
    RUN(coincidences_have_one_answer);
    RUN(the_other_nappe_is_turned);
    RUN(what_cancels_in_a_normal_is_uncertain);
    RUN(the_foot_is_beside_the_angle);
    RUN(a_flat_shape_has_the_nearer_cap);
    RUN(beside_an_apex_the_normal_is_that_of_the_ruling);
    RUN(on_the_axis_the_answer_is_certain);
    RUN(a_large_error_of_local_coordinates_leaves_no_safety);
    return check_end();
}
