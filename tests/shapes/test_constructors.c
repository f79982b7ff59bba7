/*
 * test_constructors.c - constructors and their errors
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "check.h"
#include "cylint_pieces.h"
#include "draw.h"
#include "environment.h"
#include "families.h"
#include "records.h"
#include "same.h"
#include "shapes/shape_facts.h"
#ifdef HAVE_MPFR
#include "real.h"
#endif

static const double bad_numbers[] = {NAN, HUGE_VAL, -HUGE_VAL};
static const double axis_z[3] = {0, 0, 1}, origin[3] = {0, 0, 0};
static const double axis_x[3] = {1, 0, 0};

/* The greatest value of `ends` that a shape may have; a half-space has any. */
static int most_ends(int word)
{
    return word == FAMILY_SPHERE                            ? CYLINT_ENDS_CAPPED
           : word == FAMILY_CAPSULE || word == FAMILY_RCONE ? CYLINT_ENDS_CAP1
                                                            : CYLINT_ENDS_NAPPE;
}

/* Makes the line and the shape of a record in every environment, and compares the
 * first status that is not CYLINT_OK. */
static const char *check_status(const char *text, const char *known)
{
    struct family_case c;
    int want;
    if (!family_parse_any(text, &c) || !(known = read_status(known, &want)))
        return NULL;
    EACH_ENVIRONMENT(there) {
        environment_set(there);
        family_make(&c);
        environment_reset();
        const int status = c.line_status != CYLINT_OK ? (int)c.line_status
                                                      : (int)c.shape_status;
        if (!CHECK(status == want))
            REPORT("%s: status %d", text, status);
    }
    return known;
}

TEST(known_statuses_are_returned_in_every_environment)
{
    each_record("tests/shapes/statuses.txt", 106, check_status);
}

static int answers_miss(const cylint_shape *shape, const cylint_line *line)
{
    cylint_answer answer;
    cylint_interval chord[2];
    answer.relation = answer.n = answer.flags = -1;
    return cylint_chord(shape, line, chord) == 0 &&
           cylint_intersect(shape, line, CYLINT_WANT_ALL, &answer) == 0 &&
           answer.relation == CYLINT_RELATION_MISS && answer.n == 0 &&
           answer.flags == CYLINT_FLAG_INVALID &&
           cylint_occluded(shape, line) == 0;
}

TEST(good_shapes_are_accepted_with_all_ends)
{
    for (int word = 0; word < FAMILY_SHAPES; word++)
        for (int ends = CYLINT_ENDS_CAPPED; ends <= CYLINT_ENDS_NAPPE; ends++) {
            struct family_case c = family_example((family_shape)word);
            const int good = ends <= most_ends(word);
            c.ends = (cylint_ends)ends;
            CHECK(family_make(&c) == good);
            CHECK(c.shape_status == (good ? CYLINT_OK : CYLINT_EENDS));
            CHECK(c.shape.kind ==
                  (good ? CYLINT_KIND_CYLINDER + word : CYLINT_KIND_NONE));
            CHECK(!good ||
                  (int)c.shape.ends ==
                      (word == FAMILY_HALFSPACE ? CYLINT_ENDS_INFINITE : ends));
        }
}

/* Writes faults, bits, into an example of the shape.  NUMBER: the number at `place`
 * is not finite.  which: the wrong value, of three.  Returns the status of the
 * first fault. */
static cylint_status add_faults(struct family_case *c, int faults, int place,
                                int which)
{
    static const int no_ends[] = {-1, CYLINT_ENDS_NAPPE + 1, 1000};
    enum { NUMBER = 1, SIZE = 2, AXIS = 4, ENDS = 8, PLANE = 16 };
    const family_shape word = c->shape_word;
    const int last = family_shape_size(word) - 1;
    cylint_status first = CYLINT_OK;
    if (faults & PLANE && (word == FAMILY_ECYLINDER || word == FAMILY_ECONE)) {
        c->shape_data[7] = 0; /* b = 0 */
        first = CYLINT_EDEGENERATE;
    }
    if (faults & ENDS && word != FAMILY_HALFSPACE) {
        c->ends = (cylint_ends)no_ends[which];
        first = CYLINT_EENDS;
    }
    if (faults & AXIS && (word < FAMILY_SPHERE || word == FAMILY_HALFSPACE)) {
        c->shape_data[family_axis(word) + 2] = 0;
        first = CYLINT_EAXIS;
    }
    if (faults & SIZE && family_is_size(word, last)) {
        c->shape_data[last] = word == FAMILY_ACONE ? 90 : -1;
        first = word == FAMILY_ACONE ? CYLINT_EANGLE : CYLINT_ERADIUS;
    }
    if (faults & NUMBER) {
        c->shape_data[place] = bad_numbers[which];
        first = CYLINT_ENONFINITE;
    }
    return first;
}

TEST(a_shape_with_several_faults_returns_the_first)
{
    for (int word = 0; word < FAMILY_SHAPES; word++)
        for (int i = 0; i < 96 * family_shape_size((family_shape)word); i++) {
            struct family_case c = family_example((family_shape)word);
            const cylint_status first =
                add_faults(&c, i % 32, i / 96, i / 32 % 3);
            family_make(&c);
            if (!CHECK(c.shape_status == first))
                REPORT("%d instead of %d: kind %d, faults %d, number %d",
                       c.shape_status, first, word, i % 32, i / 96);
        }
}

TEST(tangents_are_positive_and_finite)
{
    static const double infinite[3] = {0, HUGE_VAL, 0};
    cylint_shape s;
    CHECK(cylint_tangent_cone(&s, origin, axis_z, 0, 0) == CYLINT_EANGLE);
    CHECK(cylint_tangent_cone(&s, origin, axis_z, -1, 0) == CYLINT_EANGLE);
    CHECK(cylint_tangent_cone(&s, origin, axis_z, NAN, 0) == CYLINT_ENONFINITE);
    CHECK(cylint_tangent_cone(&s, origin, infinite, 1, 0) == CYLINT_ENONFINITE);
    CHECK(cylint_tangent_cone(&s, origin, axis_z, HUGE_VAL, 0) ==
          CYLINT_ENONFINITE);
    CHECK(cylint_tangent_cone(&s, origin, axis_z, DBL_MAX, 0) == CYLINT_OK);
    CHECK(cylint_angle_cone(&s, origin, axis_z, DBL_MAX, 0) == CYLINT_EANGLE);
    /* with further faults, the first */
    CHECK(cylint_tangent_cone(&s, infinite, origin, 0, 6) == CYLINT_ENONFINITE);
    CHECK(cylint_tangent_cone(&s, origin, origin, 0, 6) == CYLINT_EANGLE);
    CHECK(cylint_tangent_cone(&s, origin, origin, 1, 6) == CYLINT_EAXIS);
    CHECK(cylint_tangent_cone(&s, origin, axis_z, 1, 6) == CYLINT_EENDS);
}

/* The shape that the constructor of a kind makes. */
static cylint_shape made_of(cylint_kind kind, cylint_ends ends, const double *x)
{
    struct family_case c;
    if (kind == CYLINT_KIND_ACONE) {
        CHECK(cylint_tangent_cone(&c.shape, x, x + 3, x[6], ends) == CYLINT_OK);
        return c.shape;
    }
    c = family_example((family_shape)(kind - CYLINT_KIND_CYLINDER));
    memcpy(c.shape_data, x,
           (size_t)family_shape_size(c.shape_word) * sizeof *x);
    c.ends = ends;
    CHECK(family_make(&c));
    return c.shape;
}

/* Whether the shape of a case can be made of its arguments, and these are the
 * numbers given if the kind is; of an angle cone the tangent is returned. */
static int has_its_arguments(const struct family_case *c)
{
    double x[CYLINT_ARGUMENTS_MOST];
    const cylint_kind kind = cylint_arguments(&c->shape, x);
    if (c->shape.kind == CYLINT_KIND_NONE)
        return kind == CYLINT_KIND_NONE;
    const cylint_shape again = made_of(kind, (cylint_ends)c->shape.ends, x);
    const int given =
        family_shape_size(c->shape_word) - (c->shape_word == FAMILY_ACONE);
    return same_bytes(&again, &c->shape, sizeof again) &&
           ((int)kind != CYLINT_KIND_CYLINDER + (int)c->shape_word ||
            same_bytes(x, c->shape_data, (size_t)given * sizeof *x));
}

/* Of the families, and with special numbers in each place. */
TEST(a_constructor_makes_the_same_shape_of_its_arguments)
{
    static const double bits[] = {-0.0, 0x1p-1074, DBL_MAX, 0.1};
    EACH_CASE(c, 31, 200)
        if (!CHECK(has_its_arguments(&c)))
            REPORT_CASE(&c);
    for (int word = 0; word < FAMILY_SHAPES; word++)
        for (int i = 0; i < 4 * family_shape_size((family_shape)word); i++) {
            struct family_case c = family_example((family_shape)word);
            c.shape_data[i / 4] = bits[i % 4];
            family_make(&c);
            if (!CHECK(has_its_arguments(&c)))
                REPORT_CASE(&c);
        }
}

/* Equal radii, k = 1, and one ball that holds the other. */
TEST(arguments_of_special_cones_are_those_of_simpler_shapes)
{
    static const double axis_y[3] = {0, 1, 0};
    double x[CYLINT_ARGUMENTS_MOST];
    cylint_shape s;
    cylint_cone(&s, origin, 2, axis_z, 2, CYLINT_ENDS_OPEN);
    CHECK(cylint_arguments(&s, x) == CYLINT_KIND_CYLINDER && x[6] == 2);
    cylint_round_cone(&s, origin, 2, axis_z, 2, CYLINT_ENDS_OPEN);
    CHECK(cylint_arguments(&s, x) == CYLINT_KIND_CAPSULE && x[6] == 2);
    cylint_elliptic_cone(&s, origin, axis_x, axis_y, axis_z, 1, 0);
    CHECK(cylint_arguments(&s, x) == CYLINT_KIND_ECYLINDER && x[11] == 1);
    for (int end = 0; end < 2; end++) {
        cylint_round_cone(&s, origin, end ? 1 : 3, axis_z, end ? 3 : 1, 0);
        CHECK(s.kind == CYLINT_KIND_SPHERE);
        CHECK(cylint_arguments(&s, x) == CYLINT_KIND_RCONE);
        CHECK(x[3] == (end ? 1 : 3) && x[6] == 1 && x[7] == (end ? 3 : 1));
    }
}

TEST(an_empty_domain_has_the_status_of_both_names)
{
    cylint_line l;
    CHECK(cylint_span(&l, origin, axis_z, 1, 0) == CYLINT_EDOMAIN);
    CHECK(cylint_span(&l, origin, axis_z, 1, 0) == CYLINT_ERANGE);
}

TEST(every_status_has_its_text)
{
    static const char *const texts[] = {
        [CYLINT_OK] = "no error",
        [CYLINT_ENONFINITE] = "a number is not finite",
        [CYLINT_EAXIS] = "the axis or normal has no length",
        [CYLINT_EDEGENERATE] = "the vectors a, b, h are linearly dependent",
        [CYLINT_ERADIUS] = "a radius is negative, or all radii are zero",
        [CYLINT_EANGLE] = "the half angle is not between 0 and 90 degrees, "
                          "or its tangent is 0",
        [CYLINT_EENDS] = "this kind of shape has no such ends",
        [CYLINT_EDIRECTION] = "the direction has no length",
        [CYLINT_EDOMAIN] = "the domain is empty or not a number",
        [CYLINT_EMETHOD] = "this method does not support such a shape"};
    check_texts(cylint_strerror, texts, sizeof texts / sizeof *texts);
}

TEST(an_invalid_shape_or_line_misses_with_the_flag)
{
    static const double low[3] = {-DBL_MAX, 0, 0}, high[3] = {DBL_MAX, 0, 0};
    cylint_line line, no_line, no_domain, far;
    cylint_whole_line(&line, origin, axis_x);
    CHECK(cylint_ray(&no_line, origin, origin) == CYLINT_EDIRECTION);
    CHECK(cylint_span(&no_domain, origin, axis_x, 1, (double)NAN) ==
          CYLINT_EDOMAIN);
    CHECK(cylint_segment(&far, low, high) == CYLINT_OK);
    CHECK(cylint_line_length(&no_line) == 0 &&
          cylint_line_length(&no_domain) == 0 &&
          cylint_line_length(&far) == HUGE_VAL);
    for (int word = 0; word < FAMILY_SHAPES; word++) {
        struct family_case c = family_example((family_shape)word);
        family_make(&c);
        CHECK(answers_miss(&c.shape, &no_line));
        CHECK(answers_miss(&c.shape, &no_domain));
        c.shape_data[1] = NAN;
        family_make(&c);
        CHECK(answers_miss(&c.shape, &line));
        CHECK(answers_miss(&c.shape, &no_line));
        CHECK(cylint_contains(&c.shape, origin) == -1);
        double lo[3], hi[3];
        cylint_bounds(&c.shape, lo, hi);
        for (int i = 0; i < 3; i++)
            CHECK(lo[i] == HUGE_VAL && hi[i] == -HUGE_VAL);
    }
}

/* A point next to the apex or the base, but for one coordinate. */
TEST(points_that_are_not_finite_are_outside)
{
    EACH_CASE(c, 9, 50) {
        if (!cylint_is_round(c.shape.kind))
            c.ends = number % 2 ? CYLINT_ENDS_INFINITE : CYLINT_ENDS_NAPPE;
        family_make(&c);
        for (int i = 0; i < 9; i++) {
            double p[3] = {c.shape_data[0], c.shape_data[1], c.shape_data[2]};
            p[i / 3] = bad_numbers[i % 3];
            if (!CHECK(cylint_contains(&c.shape, p) == -1))
                REPORT_CASE(&c);
        }
    }
}

#ifdef HAVE_MPFR

enum { BITS = 4400 }; /* holds the sum and product of any two doubles */

/* |w|^2 <= dr^2 decides which kind it is; here w = p1 and dr are exact. */
TEST(the_kind_is_decided_exactly)
{
    long balls = 0, cones = 0;
    for (int i = 0; i < 100000; i++) {
        double w[3];
        vector exact;
        const double scale = ldexp(1, one_of(200) - 100);
        for (int j = 0; j < 3; j++)
            w[j] = scale * (one_of(2) ? one_of(40) - 20 : between(0, 1));
        double r = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
        for (int k = one_of(3); k > 0; k--)
            r = nextafter(r, one_of(2) ? HUGE_VAL : 0);
        real_fixed(BITS);
        set(exact, w);
        const int is_cone =
            order_of(dot(exact, exact), square_of(real_of(r))) > 0;
        cylint_shape s;
        if (r == 0)
            continue;
        const int end = one_of(2);
        CHECK(cylint_round_cone(&s, origin, end ? r : 0, w, end ? 0 : r,
                                CYLINT_ENDS_CAPPED) == CYLINT_OK);
        if (!CHECK(s.kind ==
                   (is_cone ? CYLINT_KIND_RCONE : CYLINT_KIND_SPHERE)))
            REPORT("rcone 0 0 0 %a  %a %a %a %a", end ? r : 0, w[0], w[1], w[2],
                   end ? 0 : r);
        balls += !is_cone;
        cones += is_cone;
    }
    CHECK(balls > 20000 && cones > 20000);
}

/* Whether hi + lo is to - from, or hi is infinite. */
static int is_difference(double hi, double lo, double to, double from)
{
    real_fixed(BITS);
    return !isfinite(hi) || order_of(plus(real_of(hi), real_of(lo)),
                                     minus(real_of(to), real_of(from))) == 0;
}

/* d + d_lo is b - a, and cylint_axis_pair() is p1 - p0, as real numbers. */
TEST(differences_have_their_low_parts)
{
    EACH_CASE(c, 9, 200) {
        const cylint_line *l = &c.line;
        const cylint_shape *s = &c.shape;
        for (int i = 0; i < 3; i++) {
            CHECK(c.line_word != FAMILY_SEGMENT ||
                  is_difference(l->d[i], l->d_lo[i], c.line_data[3 + i],
                                l->o[i]));
            CHECK(c.shape_word > FAMILY_CONE ||
                  is_difference(cylint_axis(s)[i], cylint_axis_pair(s, i).lo,
                                cylint_top(s)[i], cylint_base(s)[i]));
        }
    }
    /* In two_diff() a sum overflows. */
    const double a[3] = {0, 0, DBL_MAX}, b[3] = {0, 0, 0x1.bdd868b689d97p+1022};
    cylint_line line;
    CHECK(cylint_segment(&line, a, b) == CYLINT_OK &&
          line.d[2] == -0x1.2113cba4bb134p+1023 && line.d_lo[2] == 0x1p+970 &&
          cylint_line_length(&line) == 0x1.2113cba4bb134p+1023);
}

#endif
