/*
 * test_distance_oracle.c - floor distance: distances against the oracle
 *
 * CYLINT_CASES is the number of shapes of each family, with POINTS points each.
 * CYLINT_SEED chooses others.
 */
#include <math.h>
#include <string.h>

#include "check.h"
#include "cylint_distance.h"
#include "distance_points.h"
#include "ulps.h"

#ifdef HAVE_MPFR
#include "distance_oracle.h"
#include "oracle.h"

enum { CASES = 250, POINTS = 4 };

#define WANT (CYLINT_WANT_PART | CYLINT_WANT_POINT | CYLINT_WANT_NORMAL)

static struct tally {
    long n, signs, features;
    double distance, point, normal; /* the largest errors in ulp */
    double safety;                  /* the least ratio to the distance */
    long above;                     /* safeties above the distance */
} places[PLACES];

static void report_point(const struct family_case *c, const double p[3],
                         const cylint_closest *got,
                         const struct oracle_closest *want)
{
    REPORT_CASE(c);
    REPORT("point %a %a %a", p[0], p[1], p[2]);
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

static int sign(double x)
{
    return (x > 0) - (x < 0);
}

static double error_of(const double got[3], const double want[3])
{
    double worst = 0;
    for (int i = 0; i < 3; i++) {
        const double off = ulps_member(got[i], want[i]);
        worst = isinf(want[i]) ? worst : fmax(worst, off);
    }
    return worst;
}

static void check_safety(const struct family_case *c, const double p[3],
                         struct tally *sum, const struct oracle_closest *want)
{
    const double safe = cylint_safety(&c->shape, p);
    const double far = fabs(want->distance);
    const int above =
        !(safe >= 0) || (safe > 0 && oracle_distance_error(safe) > 0);
    sum->above += above;
    if (far > 0)
        sum->safety = fmin(sum->safety, safe / far);
    if (!CHECK(!above)) {
        REPORT_CASE(c);
        REPORT("point %a %a %a: safety %a, distance %a", p[0], p[1], p[2], safe,
               want->distance);
    }
}

static void check_point(const struct family_case *c, const double p[3],
                        struct tally *sum)
{
    struct oracle_closest want;
    cylint_closest got;
    memset(&got, 0, sizeof got);
    oracle_distance(&c->shape, p, &want);
    const double returned = cylint_distance(&c->shape, p, WANT, &got);
    sum->n++;
    CHECK(returned == got.distance && got.flags == 0);
    const int wrong_sign = sign(got.distance) != sign(want.distance);
    const int wrong_feature = got.part != want.part ||
                              (want.part >= 0 && got.feature != want.feature);
    const double off =
        want.part < 0 ? 0 : fabs(oracle_distance_error(got.distance));
    const double off_point =
        want.part < 0 ? 0 : error_of(got.point, want.point);
    const double off_normal =
        want.part < 0 ? 0 : error_of(got.normal, want.normal);
    sum->signs += wrong_sign;
    sum->features += wrong_feature;
    sum->distance = fmax(sum->distance, off);
    sum->point = fmax(sum->point, off_point);
    sum->normal = fmax(sum->normal, off_normal);
    if (!CHECK(!wrong_sign && !wrong_feature && off <= 1 && off_point <= 4 &&
               off_normal <= 4))
        report_point(c, p, &got, &want);
    if (want.part >= 0)
        check_safety(c, p, sum, &want);
}

static void print_tally(const char *name, const struct tally *t)
{
    printf("note: %-14s %8ld points, wrong: %ld signs, %ld features; ulp: %.4g "
           "distance, %.4g point, %.4g normal; safety / distance from %.4g, "
           "%ld above\n",
           name, t->n, t->signs, t->features, t->distance, t->point, t->normal,
           t->safety, t->above);
}

static void over_families(int wild)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    const uint64_t seed = check_setting("CYLINT_SEED", 16);
    memset(places, 0, sizeof places);
    for (int k = 0; k < PLACES; k++)
        places[k].safety = 1;
    for (int f = 0; f < family_count(); f++)
        for (uint64_t i = 0; i < (wild ? cases / 20 : cases); i++) {
            struct family_case c;
            if (family_is_wild(f) != wild)
                continue;
            family_case(seed, f, i, &c);
            if (cylint_is_elliptic(c.shape.kind))
                continue;
            uint64_t stream = seed + i * 64 + (uint64_t)f;
            for (int k = 0; k < POINTS; k++) {
                double p[3];
                const enum place place = draw_point(&c, &stream, p);
                if (isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]))
                    check_point(&c, p, &places[place]);
            }
        }
    for (int k = 0; k < PLACES; k++)
        print_tally(place_names[k], &places[k]);
}

static void distances_are_those_of_the_oracle(void)
{
    over_families(0);
}

static void also_of_mixed_exponents(void)
{
    over_families(1);
}

#endif

int main(void)
{
#ifdef HAVE_MPFR
    RUN(distances_are_those_of_the_oracle);
    RUN(also_of_mixed_exponents);
#endif
    return check_end();
}
