/*
 * test_elliptic_certain.c - floor distance: elliptic kinds where doubles and pairs
 * make the answer certain
 *
 * Answers that are certain are those of the build that runs, of the one without a
 * fused multiply-add and of the last stage, in triples; nearly all are certain.
 * Named cases hold what an attack found.  CYLINT_CASES is the number of shapes of a
 * family.
 */
#include <string.h>

#include "distance/elliptic.h"
#include "distance/one_distance.h"
#include "elliptic_solids.h"
#include "known_distances.h"

enum { CASES = 200, MIXED = 20000, ALL = WANT | CYLINT_WANT_DISTANCE };

static const cylint_ends every_ends[] = {
    CYLINT_ENDS_CAPPED, CYLINT_ENDS_OPEN,     CYLINT_ENDS_CAP0,
    CYLINT_ENDS_CAP1,   CYLINT_ENDS_INFINITE, CYLINT_ENDS_NAPPE};
enum { ENDS = sizeof every_ends / sizeof every_ends[0] };

struct tally {
    long n, left;
};

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

static void report(const struct solid *e, cylint_ends ends, const double p[3])
{
    REPORT("econe %a %a %a  %a %a %a  %a %a %a  %a %a %a  %a ends %d, point "
           "%a %a %a",
           e->c[0], e->c[1], e->c[2], e->a[0], e->a[1], e->a[2], e->b[0],
           e->b[1], e->b[2], e->h[0], e->h[1], e->h[2], e->k, (int)ends, p[0],
           p[1], p[2]);
}

/* triples: their answers are right, too. */
static void check_point(const struct solid *e, cylint_ends ends,
                        const double p[3], int triples, struct tally *sum)
{
    cylint_shape s;
    cylint_closest certain, all, last;
    if (!make_solid(&s, e, ends) || !cylint_prepared(&s))
        return;
    memset(&certain, 0, sizeof certain);
    memset(&last, 0, sizeof last);
    const unsigned left = cylint_elliptic_in_pairs_plain(&s, p, ALL, &certain);
    all = answer_to(&s, p, WANT);
    sum->n++;
    sum->left += left != 0;
    int right = are_equal(&certain, &all, left) &&
                cylint_distance(&s, p, 0, &last) == all.distance &&
                cylint_safety(&s, p) <= fabs(all.distance);
    if (triples) {
        cylint_elliptic_distance(&s, p, WANT, &last);
        right &= are_equal(&certain, &last, left);
    }
    if (!CHECK(right))
        report(e, ends, p);
}

static void nearly_all_answers_are_certain(void)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    for (int end = 0; end < ENDS; end++) {
        const cylint_ends ends = every_ends[end];
        struct tally sum = {0, 0};
        for (int form = 0; form < NEEDLE; form++)
            for (int where = 0; where < PLACES; where++)
                for (uint64_t i = 0; i < cases; i++) {
                    struct solid e;
                    double p[3];
                    draw_solid(&e, (enum form)form, i % 2 == 1);
                    draw_place(&e, (enum where)where, p);
                    check_point(&e, ends, p, 1, &sum);
                }
        const double share = (double)sum.left / (double)sum.n;
        printf("note: ends %d: %.2g of %ld answers are left to triples\n", end,
               share, sum.n);
        /* Inside a shape without a cap the nearest point can be on either rim. */
        CHECK(sum.n > (long)cases);
        CHECK(share < (ends == CYLINT_ENDS_CAPPED ? 0.01 : 0.1));
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
    for (int i = 0; i < 3; i++)
        p[i] = where == 4 ? draw_number(mode)
                          : e->c[i] + x * e->a[i] + y * e->b[i] + z * e->h[i];
}

static void coincidences_have_one_answer(void)
{
    const uint64_t cases = check_setting("CYLINT_MIXED", MIXED);
    struct tally sum = {0, 0};
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
 * The other nappe of a double cone is computed as this one, turned about the
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
    CHECK(cylint_elliptic_in_pairs_plain(&s, p, ALL, &a) == 0);
    CHECK(a.distance == -1 && a.feature == LATERAL && a.point[0] == 1 &&
          a.point[1] == 3 && a.point[2] == 6.7 && a.normal[1] == 1);
}

int main(void)
{
    RUN(nearly_all_answers_are_certain);
    RUN(coincidences_have_one_answer);
    RUN(the_other_nappe_is_turned);
    RUN(what_cancels_in_a_normal_is_uncertain);
    RUN(the_foot_is_beside_the_angle);
    RUN(a_flat_shape_has_the_nearer_cap);
    RUN(beside_an_apex_the_normal_is_that_of_the_ruling);
    RUN(on_the_axis_the_answer_is_certain);
    return check_end();
}
