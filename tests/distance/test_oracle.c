/*
 * test_oracle.c - distances against the oracle; the safety is never above them
 *
 * CYLINT_CASES is the number of shapes of each family, with POINTS points each; a
 * twentieth of that with points of any exponents, and for families of such shapes.
 * CYLINT_ELLIPTIC is the same of elliptic kinds, with a tenth in place of the
 * twentieth; their oracle takes a quarter of a millisecond a point.  CYLINT_SEED
 * chooses others.
 */
#include <limits.h>
#include <math.h>
#include <string.h>

#include "closest.h"
#include "distance_oracle.h"
#include "distance_points.h"
#include "environment.h"
#include "numbers/bits.h"
#include "oracle.h"
#include "shapes/layout.h"

enum { CASES = 250, ELLIPTIC = 100, POINTS = 4, STRAIN = 6, LEAN = 6 };

static struct tally {
    long n;
    double distance, point, normal; /* the largest errors in ulp */
    double safety;                  /* the least ratio to the distance */
    long ties;                      /* of features, or of points, that round to
                                       the same distance: elliptic kinds */
} places[PLACES];

static void report_point(const struct family_case *c, const double p[3],
                         const cylint_closest *got,
                         const struct oracle_closest *want)
{
    REPORT_POINT(c, p);
    REPORT("got  %.17g part %d feature %d, point %.17g %.17g %.17g, normal "
           "%.17g %.17g %.17g",
           got->distance, got->part, got->feature, got->point[0], got->point[1],
           got->point[2], got->normal[0], got->normal[1], got->normal[2]);
    REPORT("want %.17g part %d feature %d, point %.17g %.17g %.17g, normal "
           "%.17g %.17g %.17g",
           want->distance, want->part, want->feature, want->point[0],
           want->point[1], want->point[2], want->normal[0], want->normal[1],
           want->normal[2]);
}

/* Of a number, in units in the last place; infinite for -0, NaN, and a wrong 0. */
static double ulps_from(double got, double want)
{
    if (is_negative_zero(got) || (want == 0 && got != 0))
        return HUGE_VAL;
    const double half = want > 1 ? 0.5 : 1; /* avoids overflow and underflow */
    const double off = fabs(half * got - half * want) / ulp(want) / half;
    return isnan(off) ? HUGE_VAL : off;
}

/* Smaller numbers than `least` are equal. */
static double error_of(const double got[3], const double want[3], double least)
{
    double worst = 0;
    for (int i = 0; i < 3; i++) {
        const double off = ulps_from(got[i], want[i]);
        if (!isinf(want[i]) && fmax(fabs(got[i]), fabs(want[i])) >= least)
            worst = fmax(worst, off);
    }
    return worst;
}

/* In all rounding modes. */
static void check_safety(const struct family_case *c, const double p[3],
                         struct tally *sum, const struct oracle_closest *want)
{
    const double far = fabs(want->distance);
    for (int m = 0; m < ENVIRONMENTS; m += 4) {
        environment_set(environment_of(m));
        const double safe = cylint_safety(&c->shape, p);
        environment_reset();
        const int above =
            !(safe >= 0) || signbit(safe) ||
            (isinf(safe) ? !isinf(want->distance)
                         : safe > 0 && oracle_distance_error(safe) > 0);
        if (far > 0 && m == 0)
            sum->safety = fmin(sum->safety, safe / far);
        if (!CHECK(!above)) {
            REPORT_POINT(c, p);
            REPORT("safety %a, distance %a, rounding %d", safe, want->distance,
                   m / 4);
        }
    }
}

/* Of the last distance, which may have been rounded to 0. */
static int sign_of_oracle(const struct oracle_closest *want)
{
    return want->distance != 0 || oracle_distance_is_zero()
               ? cylint_sign(want->distance)
           : signbit(want->distance) ? -1
                                     : 1;
}

/* Of an answer from the oracle's: whether sign and feature are wrong, and the
 * largest errors in ulp. */
struct differences {
    int sign, feature;
    double distance, point, normal;
};

static void check_differences(const struct family_case *c, const double p[3],
                              struct tally *sum, const cylint_closest *got,
                              const struct oracle_closest *want,
                              struct differences off)
{
    sum->distance = fmax(sum->distance, off.distance);
    sum->point = fmax(sum->point, off.point);
    sum->normal = fmax(sum->normal, off.normal);
    /* a distance that is not 0 is not rounded to it */
    const int elliptic = cylint_is_elliptic(c->shape.kind);
    const int is_rounded = !elliptic && fabs(got->distance) > 0x1p-1074;
    if (!CHECK(!off.sign && !off.feature &&
               off.distance <= (is_rounded ? 0.5 : 1) &&
               off.point <= (elliptic ? 4 : 0) &&
               off.normal <= (elliptic ? 4 : 0)))
        report_point(c, p, got, want);
}

/* The error of an elliptic distance: in ulp, or, if that is less, in 2^-113 of
 * the lengths. */
static double elliptic_error(double got, const struct oracle_closest *want)
{
    const double off = fabs(oracle_distance_error(got));
    const double unit = ulp(want->distance) / (want->length * 0x1p-113);
    return off < HUGE_VAL ? fmin(off, off * unit) : off;
}

/* Components of the point that are below 2^-100 of their terms can be 0.  The
 * largest term is at least as large as the largest coordinate, and as the base.
 */
static double point_error(const cylint_shape *s, const double got[3],
                          const double want[3])
{
    double checked[3], size = 0;
    for (int i = 0; i < 3; i++)
        size = fmax(size, fmax(fabs(want[i]), fabs(cylint_base(s)[i])));
    for (int i = 0; i < 3; i++)
        checked[i] =
            got[i] == 0 && fabs(want[i]) < 0x1p-98 * size ? want[i] : got[i];
    return error_of(checked, want, 0);
}

/* Whether the point is on the surface, but for roundings, and as far from p as
 * the distance states. */
static int is_as_near(const cylint_shape *s, const double p[3],
                      const cylint_closest *got)
{
    struct oracle_closest at;
    double size = 0, of_point = 0, of_p = 0;
    for (int i = 0; i < 3; i++) {
        size = hypot(size, got->point[i] - p[i]);
        of_point =
            fmax(of_point, fmax(ulp(got->point[i]), ulp(cylint_base(s)[i])));
        of_p = fmax(of_p, ulp(p[i]));
    }
    oracle_distance(s, got->point, &at);
    return fabs(at.distance) <= 8 * of_point &&
           !(fabs(size - fabs(got->distance)) > 8 * fmax(of_p, of_point));
}

/* Of elliptic kinds a nearest point that the oracle does not choose may be right:
 * it is on the surface, and as far away. */
static int is_right_too(const cylint_shape *s, const double p[3],
                        const cylint_closest *got,
                        const struct oracle_closest *want, int wrong_feature)
{
    const double near = fabs(want->distance);
    const double tolerance = fmax(ulp(near), want->length * 0x1p-113);
    return (want->too_near || want->is_tie ||
            (wrong_feature &&
             fabs(want->by_feature[got->feature] - near) <= tolerance)) &&
           is_as_near(s, p, got);
}

static void check_point(const struct family_case *c, const double p[3],
                        struct tally *sum)
{
    const cylint_shape *s = &c->shape;
    const int elliptic = cylint_is_elliptic(s->kind);
    struct oracle_closest want;
    cylint_closest got;
    memset(&got, 0, sizeof got);
    oracle_distance(s, p, &want);
    sum->n++;
    CHECK(cylint_distance(s, p, WANT, &got) == got.distance && got.flags == 0);
    struct differences off = {
        .sign = cylint_sign(got.distance) != sign_of_oracle(&want) ||
                cylint_contains(s, p) != oracle_contains(s, p),
        .feature = got.part != want.part};
    if (want.part >= 0) {
        check_safety(c, p, sum, &want);
        off.feature |= got.feature != want.feature;
        off.distance = elliptic ? elliptic_error(got.distance, &want)
                                : fabs(oracle_distance_error(got.distance));
        off.point = elliptic ? point_error(s, got.point, want.point)
                             : error_of(got.point, want.point, 0);
        off.normal = error_of(got.normal, want.normal, elliptic ? 0x1p-80 : 0);
    }
    if (elliptic && is_right_too(s, p, &got, &want, off.feature))
        sum->ties++, off.feature = 0, off.point = off.normal = 0;
    check_differences(c, p, sum, &got, &want, off);
}

static void print_tally(const char *name, const struct tally *t)
{
    printf("note: %-14s %8ld points, ulp: %.4g distance, %.4g point, %.4g "
           "normal; safety / distance from %.4g; %ld ties\n",
           name, t->n, t->distance, t->point, t->normal, t->safety, t->ties);
}

/* h += lean a, or h += lean (a - 2 b). */
static void lean_axis(double *x, double lean, int both)
{
    for (int i = 0; i < 3; i++)
        x[9 + i] += lean * x[3 + i] - (both ? 2 * lean * x[6 + i] : 0);
}

/* Makes an elliptic shape longer, thinner, more oblique or nearly a cylinder.
 * is_promised() leaves out what becomes too flat. */
static void strain(struct family_case *c)
{
    double *x = c->shape_data;
    const int mode = one_of(6), both = one_of(2);
    if (mode == 0)
        lean_axis(x, between(-3, 3), both);
    if (mode == 1 || mode == 2)
        lean_axis(x, power(0, LEAN), both);
    for (int v = 3; v < 12 && (mode == 2 || mode == 3); v += 3) {
        const double by = power(-STRAIN, STRAIN);
        for (int i = 0; i < 3; i++)
            x[v + i] *= by;
    }
    if (mode == 4 && c->shape_word == FAMILY_ECONE)
        x[12] = 1 + small(-17, -1);
    if (mode == 5 && c->shape_word == FAMILY_ECONE)
        x[12] = power(-STRAIN, STRAIN);
    family_make(c);
}

/* The largest exponent of n numbers; *least: at most the exponents of those
 * that are not 0. */
static int exponents_of(const double x[3], int *least)
{
    int most = INT_MIN / 2, exponent;
    for (int i = 0; i < 3; i++) {
        frexp(x[i], &exponent);
        if (x[i] != 0 && exponent > most)
            most = exponent;
        if (x[i] != 0 && exponent < *least)
            *least = exponent;
    }
    return most;
}

/* The distance of this point from an elliptic shape is promised to 1 ulp.  The
 * vectors are scaled, so that no product overflows or underflows. */
static int is_promised(const cylint_shape *s, const double p[3])
{
    const double *data[] = {cylint_a(s), cylint_b(s), cylint_axis(s)};
    double least = HUGE_VAL, most = 0, normal[3], half[3], v[3][3];
    int low = INT_MAX, high = INT_MIN / 2;
    for (int i = 0; i < 3; i++) {
        const int e = exponents_of(data[i], &low);
        high = e > high ? e : high;
        half[i] = 0.5 * p[i] - 0.5 * cylint_base(s)[i];
    }
    const int far = exponents_of(half, &low);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            v[i][k] = ldexp(data[i][k], -high);
        least = fmin(least, length3(v[i]));
        most = fmax(most, length3(v[i]));
    }
    cross3(normal, v[0], v[1]);
    return most <= 1e12 * least &&
           (cylint_r1(s) == 0 || fabs(log10(cylint_r1(s))) <= 6) &&
           fabs(dot3(normal, v[2])) >= 0x1p-60 * most * most * most &&
           low >= high - 899 && far < high + 1299;
}

/* far: points of any exponents, and shapes of any. */
static void over_families(int far, int elliptic)
{
    const uint64_t cases = elliptic ? check_setting("CYLINT_ELLIPTIC", ELLIPTIC)
                                    : check_setting("CYLINT_CASES", CASES);
    const uint64_t seed = check_setting("CYLINT_SEED", 2);
    memset(places, 0, sizeof places);
    for (int k = 0; k < PLACES; k++)
        places[k].safety = 1;
    EACH_CASE(c, seed, far ? cases / (elliptic ? 10 : 20) + 1 : cases) {
        const int wild = family_is_wild(family);
        if ((wild && !far) || cylint_is_elliptic(c.shape.kind) != elliptic)
            continue;
        stream = seed + number * 64 + (uint64_t)family;
        if (elliptic && !far)
            strain(&c);
        if (c.shape.kind == CYLINT_KIND_NONE)
            continue;
        for (int k = 0; k < POINTS; k++) {
            double p[3];
            const enum place place =
                far ? draw_far_point(&c, wild, p) : draw_point(&c, p);
            if (!is_finite3(p) || (elliptic && !is_promised(&c.shape, p)))
                continue;
            check_point(&c, p, &places[place]);
        }
    }
    for (int k = 0; k < PLACES; k++)
        print_tally(place_names[k], &places[k]);
}

TEST(distances_are_those_of_the_oracle)
{
    over_families(0, 0);
}

TEST(distances_of_any_exponents_are_those_of_the_oracle)
{
    over_families(1, 0);
}

TEST(elliptic_distances_are_those_of_the_oracle)
{
    over_families(0, 1);
}

TEST(elliptic_distances_of_any_exponents_are_those_of_the_oracle)
{
    over_families(1, 1);
}
