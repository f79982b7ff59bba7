/*
 * test_elliptic.c - distances from elliptic kinds
 *
 * Answers that are certain are those of the build that runs, of the one without a
 * fused multiply-add and of the last stage, which finds all stationary points in
 * triples; nearly all are certain.  The safety is never above the distance, and not
 * far below it.  CYLINT_CASES is the number of points of each family; known.txt has
 * cases that an attack found.
 */
#include <string.h>

#include "closest.h"
#include "distance/one_distance.h"
#include "distance/nearest.h"
#include "distance_points.h"

enum {
    CASES = 3200,
    ENDS = CYLINT_ENDS_NAPPE + 1,
    BESIDE = PLACES, /* 1e-9 from the lateral surface */
    ALL = WANT | CYLINT_WANT_DISTANCE
};

/* n: answers; left: of these, left to triples.  safe, ratios: the number and the
 * sum of the ratios of safety and distance. */
struct tally {
    long n, left, safe;
    double ratios;
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
    }
    return CHECK(safe >= 0 && safe <= size);
}

/* ordinary: no number is so large or small that the answers of triples differ. */
static void check_point(const struct family_case *c, const double p[3],
                        int ordinary, struct tally *sum)
{
    const cylint_shape *s = &c->shape;
    cylint_closest certain, last;
    const cylint_closest all = answer_to(s, p, WANT);
    int right = check_safety(s, p, fabs(all.distance), sum);
    if (cylint_prepared(s)) {
        memset(&certain, 0, sizeof certain);
        memset(&last, 0, sizeof last);
        const int is_certain = in_pairs(s, p, &certain);
        sum->n++;
        sum->left += !is_certain;
        right &= (!is_certain || same(&certain, &all)) &&
                 cylint_distance(s, p, 0, &last) == all.distance;
        if (ordinary) {
            cylint_elliptic_distance(s, p, WANT, &last);
            right &= !is_certain || same(&certain, &last);
        }
    }
    if (!CHECK(right))
        REPORT_POINT(c, p);
}

/* Families.  Of the last ones b and h are made shorter, so that a, b and h differ
 * in length by about 1000. */
static const char *const forms[] = {"ordinary", "elliptic, thin",
                                    "elliptic, skewed", "ordinary"};
enum { FORMS = sizeof forms / sizeof *forms, UNEQUAL = FORMS - 1 };
static struct tally tallies[ENDS][FORMS][PLACES + 1];

static const char *name_of(int form)
{
    return form == UNEQUAL ? "unequal" : forms[form];
}

static void shorten(struct family_case *c, int vector, double by)
{
    for (int i = 0; i < 3; i++)
        c->shape_data[3 * vector + i] *= by;
}

/* A point in every fourth case is beside the lateral surface. */
static void check_form(int ends, int form)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    for (uint64_t i = 0; i < cases;) {
        struct family_case c;
        struct point_frame f;
        double p[3];
        family_case(random_bits(&stream), family_named(forms[form]), 0, &c);
        c.ends = (cylint_ends)ends;
        if (form == UNEQUAL && cylint_is_elliptic(c.shape.kind)) {
            shorten(&c, 2, power(-3, 0));
            shorten(&c, 3, power(-3, 0));
        }
        if (!family_make(&c) || !cylint_is_elliptic(c.shape.kind))
            continue;
        int place = BESIDE;
        if (i++ % 4 == 0) {
            const double z = between(0, 1);
            make_point_frame(&f, &c.shape);
            put(&f, rho_at(&f, z) * (1 + 1e-9 * between(-1, 1)), z, p);
        } else {
            place = (int)draw_point(&c, p);
        }
        check_point(&c, p, 1, &tallies[ends][form][place]);
    }
}

/* What n numbers from 0 to 1 of this mean add up to at most: three standard
 * deviations and one more. */
static double most_of(long n, double mean)
{
    return (double)n * mean + 3 * sqrt((double)n * mean) + 1;
}

/* Counts the answers that are left to triples, about the places from first to last.
 * share: of all answers. */
static void check_left(int form, int ends, int first, int last, double share)
{
    long n = 0, left = 0;
    for (int place = first; place <= last; place++) {
        n += tallies[ends][form][place].n;
        left += tallies[ends][form][place].left;
    }
    printf("note: %s, ends %d, %s: %ld of %ld answers are left to triples\n",
           name_of(form), ends, first == BESIDE ? "beside" : "anywhere", left,
           n);
    CHECK(n > 0 && (double)left < most_of(n, share));
}

TEST(nearly_all_answers_are_certain_and_those_of_triples)
{
    for (int ends = 0; ends < ENDS; ends++) {
        for (int form = 0; form < FORMS; form++)
            check_form(ends, form);
        /* Inside a shape without a cap the nearest point can be on either rim. */
        const int capped = ends == CYLINT_ENDS_CAPPED;
        check_left(0, ends, PLACE_FAR, PLACE_ANY, capped ? 0.02 : 0.062);
        check_left(UNEQUAL, ends, PLACE_FAR, PLACE_ANY, capped ? 0.04 : 0.125);
        check_left(0, ends, BESIDE, BESIDE, 0.001);
        check_left(UNEQUAL, ends, BESIDE, BESIDE, 0.001);
    }
}

/* Where h leans, the section of a cone is not perpendicular to its axis. */
TEST(nearly_all_answers_in_leaning_cones_are_certain)
{
    static const char *const records[] = {
        "ray 0 0 0  1 0 0  econe 0 0 0  1 0 0  0 0.7 0  0.5 0.25 1  0.5",
        "ray 0 0 0  1 0 0  econe 0 0 0  1 0 0  0 0.7 0  1.5 0.75 1  0.5",
        "ray 0 0 0  1 0 0  econe 0 0 0  1 0 0  0 0.7 0  1 0.5 1  0"};
    enum { POINTS = 1000 };
    for (int i = 0; i < 3; i++) {
        const struct family_case c = case_of(records[i]);
        struct tally sum = {0};
        while (sum.n < POINTS) {
            const double z = between(0, 1), x = between(-1, 1),
                         y = between(-1, 1), *h = cylint_axis(&c.shape),
                         r = 1 - (1 - cylint_r1(&c.shape)) * z;
            const double p[3] = {z * h[0] + r * x, z * h[1] + 0.7 * r * y, z};
            if (x * x + y * y < 0.98)
                check_point(&c, p, 1, &sum);
        }
        CHECK((double)sum.left < most_of(sum.n, 0.002));
    }
}

/* The nappe on the point's side of the apex can be the farther one. */
TEST(nearly_all_answers_about_leaning_double_cones_are_certain)
{
    const struct family_case c =
        case_of("econe 0 0 0  1 0 0  0 0.7 0  1.5 0.75 1  0.5  ends=infinite");
    struct tally sum = {0};
    while (sum.n < 1000) {
        const double p[3] = {between(-4, 4), between(-4, 4), between(-4, 4)};
        check_point(&c, p, 1, &sum);
    }
    CHECK((double)sum.left < most_of(sum.n, 0.002));
}

TEST(pairs_decide_part_and_normal_on_a_cap)
{
    const cylint_shape s = shape_of("ecylinder 0 0 0  2 0 0  0 1 0  0 0 3");
    const double p[3] = {0.5, 0.25, 0};
    const unsigned left =
        CYLINT_WANT_DISTANCE | CYLINT_WANT_POINT | CYLINT_ON_SURFACE;
    cylint_closest a;
    CHECK(cylint_elliptic_kernels_plain.pairs(&s, p, ALL, &a) == left &&
          a.feature == CYLINT_FEATURE_CAP0 && a.normal[2] == -1);
}

/* Of the points of the families. */
TEST(the_safety_is_close_to_the_distance)
{
    for (int form = 0; form < FORMS; form++)
        for (int where = 0; where <= PLACES; where++) {
            const char *name = where < PLACES ? place_names[where] : "beside";
            double mean = 1;
            for (int ends = 0; ends < ENDS; ends++) {
                const struct tally *of = &tallies[ends][form][where];
                mean = fmin(mean, of->ratios / (double)of->safe);
                CHECK((double)of->safe - of->ratios < most_of(of->safe, 0.12));
            }
            printf("note: %s, %s: safety / distance %.4f in the mean\n",
                   name_of(form), name, mean);
        }
}

/* Small whole numbers, tenths, zeros; numbers of any exponents. */
TEST(coincidences_have_one_answer)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES) / 10;
    struct tally sum = {0};
    EACH_CASE(c, 3, cases) {
        double p[3];
        if (!cylint_is_elliptic(c.shape.kind))
            continue;
        draw_point(&c, p);
        if (is_finite3(p))
            check_point(&c, p, 0, &sum);
    }
    CHECK(sum.left < sum.n / 2);
}

/* Of the components of a, b and h one is so small that triples return 0 for what it
 * makes of a normal. */
TEST(tiny_components_have_the_answers_of_triples)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    struct tally sum = {0};
    for (uint64_t i = 0; i < cases;) {
        struct family_case c;
        double p[3];
        family_case(random_bits(&stream), family_named("ordinary"), 0, &c);
        const int tiny = 3 + one_of(9), e = 60 + one_of(1000);
        const double x = between(-1, 1);
        c.shape_data[tiny] = ldexp(x, -e);
        if (!family_make(&c) || !cylint_is_elliptic(c.shape.kind))
            continue;
        draw_point(&c, p);
        check_point(&c, p, 1, &sum);
        i++;
    }
    CHECK(sum.left < sum.n);
}
