/*
 * test_errors.c - boxes and tangents are within the errors of cylint(3)
 *
 * The sides of boxes are compared with MPFR: none cuts its solid, and none is
 * farther from it than the manual's table says.  That each member of a hit is
 * the nearest double is tested in library/test_intersect.c.  CYLINT_CASES and
 * CYLINT_SEED change the cases.
 */
#include <string.h>

#include "check.h"
#include "environment.h"
#include "families.h"
#include "real.h"
#include "records.h"
#include "shapes/shape_facts.h"
#include "ulps.h"

/* BOX_ULPS: of cylint(3), ACCURACY. */
enum { CASES = 1000, BOX_ULPS = 5, ROUND_ULPS = 1 };

/* --------------------------------------------------------------- boxes -- */

enum { BITS = 4400 }; /* holds the sum and product of any two doubles */

/* The square of the axis's component. */
static real axis_square(const cylint_shape *s, int i)
{
    const int points = cylint_has_end_points(s->kind);
    return square_of(
        minus(real_of(points ? cylint_top(s)[i] : cylint_axis(s)[i]),
              real_of(points ? cylint_base(s)[i] : 0)));
}

/* Half the width of the disc of cap i, or of the ball about end i, along
 * coordinate j; exact where it is a double. */
static real true_reach(const cylint_shape *s, int i, int j)
{
    const real r = real_of(i ? cylint_r1(s) : cylint_r0(s));
    real square;
    if (cylint_is_round(s->kind))
        return r;
    if (cylint_is_elliptic(s->kind)) {
        square = plus(square_of(real_of(cylint_a(s)[j])),
                      square_of(real_of(cylint_b(s)[j])));
    } else {
        square = plus(axis_square(s, (j + 1) % 3), axis_square(s, (j + 2) % 3));
        if (s->kind != CYLINT_KIND_ACONE) {
            const real whole = plus(square, axis_square(s, j));
            return over(times(root_of(times(square, whole)), r), whole);
        }
    }
    return times(root_of(square), r);
}

/* The bound of cap i's disc. */
static real true_bound(const cylint_shape *s, int i, int j, int up)
{
    real center = real_of(cylint_base(s)[j]);
    if (i && cylint_has_end_points(s->kind))
        center = real_of(cylint_top(s)[j]);
    else if (i)
        center = plus(center, real_of(cylint_axis(s)[j]));
    return (up ? plus : minus)(center, true_reach(s, i, j));
}

/* The distance of a side of the box from the solid; infinite if the side cuts
 * the solid. */
static double looseness(const cylint_shape *s, int j, int up, double side)
{
    const real away = real_of(up ? 1 : -1);
    real bound = true_bound(s, 0, j, up);
    if (s->ends < CYLINT_ENDS_INFINITE) {
        const real other = true_bound(s, 1, j, up);
        if (sign_of(times(away, minus(other, bound))) > 0)
            bound = other;
    }
    const double nearest = mpfr_get_d(bound->x, RND);
    if (isinf(side) && ((side > 0) != up || isinf(nearest)))
        return (side > 0) != up ? HUGE_VAL : 0;
    const real at =
        isinf(side) ? times(away, power_of_two(1024)) : real_of(side);
    const real gap = times(away, minus(at, bound));
    if (mpfr_sgn(gap->x) < 0)
        return HUGE_VAL;
    return mpfr_get_d(over(gap, real_of(ulp(nearest)))->x, MPFR_RNDU);
}

static void box_in(struct environment there, const cylint_shape *s,
                   double lo[3], double hi[3])
{
    environment_set(there);
    cylint_bounds(s, lo, hi);
    environment_reset();
}

/* Bounded solids, and whole cylinders across their axes. */
static void measure_box(const struct family_case *c, double most,
                        struct environment there)
{
    const cylint_shape *s = &c->shape;
    const int constant =
        s->kind == CYLINT_KIND_CYLINDER || s->kind == CYLINT_KIND_ECYLINDER;
    double box[2][3];
    if (s->ends >= CYLINT_ENDS_INFINITE && !constant)
        return;
    real_fixed(BITS);
    box_in(there, s, box[0], box[1]);
    for (int j = 0; j < 3; j++) {
        if (s->ends >= CYLINT_ENDS_INFINITE && sign_of(axis_square(s, j)))
            continue;
        for (int up = 0; up < 2; up++) {
            const double off = looseness(s, j, up, box[up][j]);
            if (!CHECK(off <= most)) {
                REPORT("coordinate %d, up %d: %g, rounding %d, subnormals %d",
                       j, up, off, there.rounding, there.tiny);
                REPORT_CASE(c);
            }
        }
    }
}

static void measure_tangent(const struct family_case *c)
{
    if (c->shape.kind != CYLINT_KIND_ACONE)
        return;
    real_fixed(1200);
    const real degrees = times(real_pi(), real_of(c->shape_data[6]));
    const real tangent = function_of(mpfr_tan, over(degrees, real_of(180)));
    if (!CHECK(cylint_r1(&c->shape) == near_double(tangent)))
        REPORT_CASE(c);
}

/* One box in two is made in another environment. */
TEST(boxes_and_tangents_are_within_their_errors)
{
    const uint64_t seed = check_setting("CYLINT_SEED", 3);
    EACH_CASE(c, seed, check_setting("CYLINT_CASES", CASES)) {
        const struct environment there =
            environment_of(number % 2 ? (int)(number / 2 % ENVIRONMENTS) : 0);
        const int round = c.shape_word >= FAMILY_SPHERE;
        measure_box(&c, round ? ROUND_ULPS : BOX_ULPS, there);
        measure_tangent(&c);
    }
    mpfr_free_cache();
}

/* ---------------------------------------------------------- named boxes -- */

static int is_negative_zero(double x)
{
    const double zero = -0.0;
    return memcmp(&x, &zero, sizeof x) == 0;
}

static const char *check_box(const char *text, const char *known)
{
    struct family_case c;
    double x[7];
    const char *end = family_numbers(known, 7, x);
    if (!end || !family_parse(text, &c))
        return NULL;
    EACH_ENVIRONMENT(there) {
        double lo[4] = {0, 0, 0, 7}, hi[4] = {0, 0, 0, 7};
        box_in(there, &c.shape, lo, hi);
        for (int k = 0; k < 3; k++)
            if (!CHECK(lo[k] <= x[1 + k] && hi[k] >= x[4 + k] &&
                       lo[k] >= stepped(x[1 + k], -(int)x[0]) &&
                       hi[k] <= stepped(x[4 + k], (int)x[0]) &&
                       !is_negative_zero(lo[k]) && !is_negative_zero(hi[k])))
                REPORT("%s: coordinate %d from %a to %a", text, k, lo[k],
                       hi[k]);
        CHECK(lo[3] == 7 && hi[3] == 7);
    }
    return end;
}

/* In every environment. */
TEST(named_boxes_are_tight)
{
    each_record("tests/shapes/boxes.txt", 48, check_box);
}
