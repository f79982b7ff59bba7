/*
 * test_known.c - distances and safety: answers known by hand, and properties
 *
 * The records of known.txt have their answers, and they and the cases of the
 * families have the properties.  The oracle's tests of families are in
 * test_oracle.c.  CYLINT_CASES is the number of shapes of each family, with POINTS
 * points each, and a tenth of that with points of any exponents.  CYLINT_SEED
 * changes them.  on_surface.txt has the units within which points are on surfaces.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "closest.h"
#include "distance/nearest.h"
#include "distance/one_distance.h"
#include "distance_points.h"
#include "environment.h"
#include "numbers/bits.h"
#include "records.h"
#include "same.h"
#include "shapes/layout.h"

enum { CASES = 60, POINTS = 4 };

/* ------------------------------------------------------ known answers -- */

enum { MOST = 260, NONE = CYLINT_FEATURE_APEX + 1, ANY };

/* want.distance is NaN, or want.feature ANY, if it is not known. */
static struct record {
    struct family_case c;
    double p[3];
    cylint_closest want;
    int has_place; /* point and normal */
    int in_pairs;  /* pairs decide all of these */
} records[MOST];
static int count;

static int is_refused(const struct record *r)
{
    return r->c.shape_status != CYLINT_OK || !is_finite3(r->p);
}

static const char *take(const char *text, const char *known)
{
    static const char *const features[] = {"lateral", "cap0", "cap1", "rim0",
                                           "rim1",    "apex", "none", "any"};
    struct record *r = &records[count];
    double place[6];
    char word[8];
    int used = 0;
    text = family_numbers(text, 3, r->p);
    if (count == MOST || !text || !family_parse_any(text, &r->c) ||
        !(known = family_numbers(known, 1, &r->want.distance)) ||
        sscanf(known, "%7s%n", word, &used) != 1)
        return NULL;
    while (r->want.feature < ANY &&
           strcmp(features[r->want.feature], word) != 0)
        r->want.feature++;
    if (is_refused(r) && r->want.feature != NONE)
        return NULL;
    known += used;
    used = 0;
    const char *end = family_numbers(known, 6, place);
    if ((r->has_place = end != NULL)) {
        memcpy(r->want.point, place, sizeof r->want.point);
        memcpy(r->want.normal, place + 3, sizeof r->want.normal);
    }
    known = end ? end : known;
    r->in_pairs = sscanf(known, " pairs%n", &used) == 0 && used > 0;
    count++;
    return r->in_pairs ? known + used : known;
}

TEST(every_record_is_read)
{
    each_record("tests/distance/known.txt", 230, take);
}

/* Of an elliptic kind it is within 1 ulp or 2^-113 of the largest length. */
static int is_distance(const cylint_shape *s, const double p[3], double got,
                       double want)
{
    double length[4] = {0};
    if (!cylint_is_elliptic(s->kind) || !isfinite(want))
        return got == want;
    for (int i = 0; i < 3; i++) {
        length[0] = hypot(length[0], p[i] - cylint_base(s)[i]);
        length[1] = hypot(length[1], cylint_a(s)[i]);
        length[2] = hypot(length[2], cylint_b(s)[i]);
        length[3] = hypot(length[3], cylint_axis(s)[i]);
    }
    const double longest =
        fmax(fmax(length[0], length[1]), fmax(length[2], length[3]));
    return fabs(got - want) <= fmax(ulp(want), 0x1p-113 * longest);
}

static int is_feature(const cylint_closest *got, int want)
{
    const int part = want == CYLINT_FEATURE_CAP0   ? CYLINT_PART_CAP0
                     : want == CYLINT_FEATURE_CAP1 ? CYLINT_PART_CAP1
                                                   : CYLINT_PART_LATERAL;
    return want == ANY    ? got->part >= 0
           : want == NONE ? got->part == -1 && got->feature == 0
                          : got->part == part && got->feature == want;
}

/* The nearest doubles; of elliptic kinds point and normal may differ by some units,
 * and in other rounding modes only the sign is right. */
static int is_known(const struct record *r, const cylint_closest *got,
                    struct environment there)
{
    const int elliptic = cylint_is_elliptic(r->c.shape.kind);
    const int rounds = there.rounding != FE_TONEAREST;
    const cylint_closest *want = &r->want;
    const double ulps = elliptic ? 4 : 0, *n = got->normal;
    const int same_sign =
        cylint_sign(got->distance) == cylint_sign(want->distance);
    if (isnan(want->distance))
        return isfinite(got->distance) && got->part >= 0 &&
               (rounds || fabs(dot3(n, n) - 1) < 1e-9);
    if (elliptic && rounds)
        return same_sign;
    return same_sign &&
           got->flags == (is_refused(r) ? CYLINT_FLAG_INVALID : 0) &&
           is_distance(&r->c.shape, r->p, got->distance, want->distance) &&
           is_feature(got, want->feature) &&
           (!r->has_place || (are_within(got->point, want->point, ulps) &&
                              are_within(got->normal, want->normal, ulps)));
}

static int is_safe(const struct record *r, double safe, double distance)
{
    return !signbit(safe) && (r->want.feature == NONE
                                  ? safe == HUGE_VAL
                                  : safe < HUGE_VAL && safe <= fabs(distance) &&
                                        !(safe > fabs(r->want.distance)));
}

static void check_records(struct environment there)
{
    for (int i = 0; i < count; i++) {
        const struct record *r = &records[i];
        const cylint_shape *s = &r->c.shape;
        cylint_closest nearest;
        environment_set(there);
        const cylint_closest a = answer_to(s, r->p, WANT);
        const double alone = answer_to(s, r->p, 0).distance;
        const double safe = cylint_safety(s, r->p);
        const int on = cylint_on_surface(s, r->p, 0);
        const size_t closest =
            cylint_closest_shape(s, 1, r->p, fabs(alone), 0, &nearest);
        environment_reset();
        if (!CHECK(is_known(r, &a, there) &&
                   is_distance(s, r->p, alone, a.distance) &&
                   is_safe(r, safe, a.distance) && !has_negative_zero(&a) &&
                   on == (a.distance == 0) && closest == (a.part < 0))) {
            REPORT_CASE(&r->c);
            REPORT("%s, point %a %a %a: %.17g part %d feature %d, point %.17g "
                   "%.17g %.17g, normal %.17g %.17g %.17g; alone %.17g; safety "
                   "%.17g; on the surface %d",
                   cylint_kernels_in_use(), r->p[0], r->p[1], r->p[2],
                   a.distance, a.part, a.feature, a.point[0], a.point[1],
                   a.point[2], a.normal[0], a.normal[1], a.normal[2], alone,
                   safe, on);
        }
    }
}

TEST(known_answers_are_returned_in_every_environment)
{
    EACH_KERNELS(k)
        check_records(environment_of(0));
    EACH_ENVIRONMENT(there)
        check_records(there);
}

/* Not within less, within enough, in every environment. */
static const char *check_place(const char *text, const char *known)
{
    struct family_case c;
    double p[3], bounds[2];
    if (!(text = family_numbers(text, 3, p)) || !family_parse_any(text, &c) ||
        !(known = family_numbers(known, 2, bounds)))
        return NULL;
    const double less = bounds[0], enough = bounds[1];
    const double ulps[] = {NAN,     -0x1p-1074, fmin(less, 0x1p-1074),
                           less,    enough,     enough + 1.5,
                           HUGE_VAL};
    EACH_ENVIRONMENT(there) {
        int within = 0;
        environment_set(there);
        for (int k = 0; k < 7; k++)
            within |= cylint_on_surface(&c.shape, p, ulps[k]) << k;
        environment_reset();
        if (!CHECK(within == (isnan(enough) ? 0 : 0x70))) {
            REPORT_POINT(&c, p);
            REPORT("not within %a, within %a: %x", less, enough,
                   (unsigned)within);
        }
    }
    return known;
}

TEST(a_point_is_on_a_surface_exactly_or_within_ulps)
{
    each_record("tests/distance/on_surface.txt", 14, check_place);
}

/* Squares of the coordinates overflow, and rounding downward and toward zero an
 * overflow is the largest double. */
TEST(a_safety_beyond_all_squares_is_below_the_distance)
{
    EACH_ENVIRONMENT(there)
        for (int far = 490; far <= 1019; far++) {
            const double p[3] = {ldexp(-12.07, far), ldexp(4.21, far),
                                 ldexp(13.45, far)};
            struct family_case c = case_of("cone 3 0 -3 2  4 0 -3 1");
            for (int ends = 0; ends < 6; ends++) {
                c.ends = (cylint_ends)ends;
                family_make(&c);
                const double d = fabs(answer_to(&c.shape, p, 0).distance);
                environment_set(there);
                const double safe = cylint_safety(&c.shape, p);
                environment_reset();
                if (!CHECK(safe > 0.999 * d && safe <= d))
                    REPORT("2^%d, ends %d: safety %a, distance %a", far, ends,
                           safe, d);
            }
        }
}

/* --------------------------------------------------------- properties -- */

typedef void property(const struct family_case *c, const double p[3]);

/* far: points of any exponents, and shapes of any; the records count as such.
 * elliptic: of elliptic kinds. */
static void over_points(property *check, int far, int elliptic)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    const uint64_t seed = check_setting("CYLINT_SEED", 5);
    for (int i = 0; i < count && far; i++)
        if (cylint_is_elliptic(records[i].c.shape.kind) == elliptic)
            check(&records[i].c, records[i].p);
    EACH_CASE(c, seed,
              far                      ? cases / 10 + 1
              : family_is_wild(family) ? 0
                                       : cases) {
        stream = seed + number * 64 + (uint64_t)family;
        for (int k = 0; k < POINTS; k++) {
            double p[3];
            if (far)
                draw_far_point(&c, family_is_wild(family), p);
            else
                draw_point(&c, p);
            if (cylint_is_elliptic(c.shape.kind) == elliptic && is_finite3(p))
                check(&c, p);
        }
    }
}

/* With CYLINT_SIGNED the answer is that of the shape of the same arguments with
 * both caps.  Its sign is exact, of elliptic kinds too. */
static void check_signed(const struct family_case *c, const double p[3])
{
    struct family_case closed = *c;
    if (cylint_ends_are_planes((int)c->ends))
        closed.ends = CYLINT_ENDS_CAPPED;
    family_make(&closed);
    const cylint_closest a = answer_to(&c->shape, p, WANT | CYLINT_SIGNED);
    const cylint_closest b = answer_to(&closed.shape, p, WANT);
    if (!CHECK(same(&a, &b) &&
               cylint_sign(b.distance) == -cylint_contains(&closed.shape, p)))
        REPORT_POINT(c, p);
}

TEST(signed_distances_are_those_of_the_closed_solid)
{
    over_points(check_signed, 0, 0);
    over_points(check_signed, 1, 0);
    over_points(check_signed, 1, 1);
}

/* The members of `want` that pairs leave, and the distance; all are certain where
 * this is 0. */
static unsigned left_by_pairs(const cylint_shape *s, const double p[3],
                              unsigned want, cylint_closest *answer)
{
    return cylint_one_distances_plain.pairs(s, p, want | CYLINT_WANT_DISTANCE,
                                            answer);
}

/* All that is known of the records that say so. */
TEST(pairs_decide_coincidences)
{
    for (int i = 0; i < count; i++) {
        const struct record *r = &records[i];
        cylint_closest a;
        if (r->in_pairs &&
            !CHECK(!left_by_pairs(&r->c.shape, r->p,
                                  r->has_place ? WANT : CYLINT_WANT_PART, &a) &&
                   a.distance == r->want.distance &&
                   is_feature(&a, r->want.feature)))
            REPORT_POINT(&r->c, r->p);
    }
}

/* Their product with a direction has no low part. */
TEST(pairs_leave_the_point_on_a_ball_of_a_tiny_radius)
{
    static const double p[3] = {0.003, 0.04, -2.7};
    const cylint_shape s =
        shape_of("capsule 0 0.02 0  0.002 0.01 1.6  0x1p-1012");
    cylint_closest answer;
    CHECK(left_by_pairs(&s, p, CYLINT_WANT_POINT, &answer) ==
          CYLINT_WANT_POINT);
}

/* Whether the members that are wanted are those of all, and others keep their
 * bytes.  Without a surface the part is written always, and never a point. */
static int has_wanted(const cylint_shape *s, const double p[3], unsigned want,
                      const cylint_closest *all)
{
    const int has_surface = all->part >= 0;
    cylint_closest got, due;
    memset(&got, UNTOUCHED, sizeof got);
    memset(&due, UNTOUCHED, sizeof due);
    due.distance = all->distance;
    due.flags = all->flags;
    if (want & CYLINT_WANT_PART || !has_surface) {
        due.part = all->part;
        due.feature = all->feature;
    }
    if (want & CYLINT_WANT_POINT && has_surface)
        memcpy(due.point, all->point, sizeof due.point);
    if (want & CYLINT_WANT_NORMAL && has_surface)
        memcpy(due.normal, all->normal, sizeof due.normal);
    cylint_distance(s, p, want, &got);
    return same(&got, &due);
}

static void check_members(const struct family_case *c, const double p[3])
{
    const cylint_closest all = answer_to(&c->shape, p, WANT);
    int good = 1;
    for (unsigned want = 0; want <= WANT; want += CYLINT_WANT_PART)
        good &= has_wanted(&c->shape, p, want, &all);
    if (!CHECK(good))
        REPORT_POINT(c, p);
}

TEST(each_member_alone_is_that_of_all)
{
    for (int elliptic = 0; elliptic < 2; elliptic++) {
        over_points(check_members, 0, elliptic);
        over_points(check_members, 1, elliptic);
    }
}

/* The answers of pairs, of both builds, and the exact ones. */
static void check_paths(const struct family_case *c, const double p[3])
{
    const cylint_closest all = answer_to(&c->shape, p, WANT);
    cylint_shape unprepared = c->shape;
    int good = 1;
    unprepared.library.flag[CYLINT_AT_PREPARED] = 0;
    unprepared.library.flag[CYLINT_AT_IN_RANGE] = 0;
    for (unsigned w = 0; w < 2; w++) {
        const unsigned want = w ? WANT : CYLINT_WANT_PART;
        cylint_closest plain;
        good &= has_wanted(&unprepared, p, want, &all);
        memset(&plain, 0, sizeof plain);
        if (cylint_prepared(&c->shape) &&
            !left_by_pairs(&c->shape, p, want, &plain)) {
            const cylint_closest due = answer_to(&c->shape, p, want);
            good &= same(&plain, &due);
        }
    }
    cylint_use_kernels("plain");
    good &= has_wanted(&c->shape, p, 0, &all) &&
            has_wanted(&c->shape, p, CYLINT_WANT_PART, &all);
    cylint_use_kernels(NULL);
    if (!CHECK(good))
        REPORT_POINT(c, p);
}

TEST(all_paths_return_the_same_bits)
{
    over_points(check_paths, 0, 0);
    over_points(check_paths, 1, 0);
}

/* Of a shape along an axis of coordinates the distance from a plane, or from the
 * cylinder in a plane through its axis, has few bits more than a double: of many
 * points it is midway between two doubles. */
TEST(upright_shapes_are_decided_by_all_digits)
{
    static const family_shape words[] = {FAMILY_CYLINDER, FAMILY_CYLINDER,
                                         FAMILY_CONE, FAMILY_CAPSULE,
                                         FAMILY_SPHERE};
    stream = check_setting("CYLINT_SEED", 5);
    for (int i = 0; i < 20000; i++) {
        struct family_case c = family_example(words[i % 5]);
        double base[3], top[3], p[3];
        const int along = one_of(3);
        random_vector(base, 3);
        random_vector(p, 3);
        copy3(top, base);
        top[along] = between(-3, 3);
        for (int j = 0; j < 3; j++)
            p[j] = one_of(3) ? p[j] : one_of(2) ? base[j] : top[j];
        const double r1 = between(0, 2);
        family_set_shape(&c, c.shape_word, base, base, base, top, between(0, 2),
                         r1);
        if (CHECK(family_make(&c)))
            check_paths(&c, p);
    }
}

static double length_of(const double v[3])
{
    return hypot(hypot(v[0], v[1]), v[2]);
}

/* A triangle of 3, 4 and 5: the foot of a point on the lateral line is nearly
 * an end of it, within 1e-9, where no other feature is near. */
TEST(a_foot_at_an_end_is_decided_by_all_digits)
{
    static const char *const shapes[] = {"cone 3 -2 -2 0  3 -2 2 3",
                                         "rcone 3 -2 -2 1  3 -2 2 3"};
    for (int k = 0; k < 2; k++)
        for (int i = -64; i <= 64; i++) {
            const struct family_case c = case_of(shapes[k]);
            const double p[3] = {6 + ldexp(i, -33), 2, 0.5 - ldexp(i, -35)};
            check_paths(&c, p);
        }
}

/* The size that the manual relates the error of the safety to. */
static double safety_size(const cylint_shape *s, const double p[3],
                          double distance)
{
    const double length = length_of(cylint_axis(s));
    const double reach = s->kind == CYLINT_KIND_SPHERE
                             ? cylint_r0(s)
                             : length + fmax(cylint_r0(s), cylint_r1(s)) *
                                            cylint_radius_unit(s, length);
    double D[3];
    minus3(D, p, cylint_base(s));
    return reach +
           (s->ends == CYLINT_ENDS_INFINITE ? 1.42 * length_of(D) : distance);
}

static double largest_gap;

/* How far the safety is below the distance, in 2^-52 sizes; 0 if it is the double
 * below. */
static double gap_of(const cylint_shape *s, const double p[3], double distance,
                     double safe)
{
    return safe >= nextafter(distance, 0)
               ? 0
               : (distance - safe) / safety_size(s, p, distance) * 0x1p52;
}

/* Where rounding is directed, the safety is the double below the distance. */
static void check_environments(const struct family_case *c, const double p[3])
{
    const cylint_closest want = answer_to(&c->shape, p, WANT);
    const double far = fabs(want.distance);
    EACH_ENVIRONMENT(there) {
        environment_set(there);
        const cylint_closest got = answer_to(&c->shape, p, WANT);
        const double safe = cylint_safety(&c->shape, p);
        environment_reset();
        const double gap = gap_of(&c->shape, p, far, safe);
        const int close = gap <= (there.rounding == FE_TONEAREST ? 16 : 0) ||
                          (there.number != 0 && far < 2 * DBL_MIN);
        if (!CHECK(same(&got, &want) && safe >= 0 && !signbit(safe) &&
                   safe <= far && !has_negative_zero(&got) &&
                   close)) { /* below 2 DBL_MIN it may be flushed to 0 */
            REPORT_POINT(c, p);
            REPORT("distance %a and %a, safety %a", far, got.distance, safe);
        }
        if (there.number == 0)
            largest_gap = fmax(largest_gap, gap);
    }
}

TEST(the_environment_changes_no_answer_and_little_of_the_safety)
{
    over_points(check_environments, 0, 0);
    over_points(check_environments, 1, 0);
    printf("note: the safety is up to %.3g x 2^-52 sizes below the distance\n",
           largest_gap);
}
