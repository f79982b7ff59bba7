/*
 * test_form_depth.c - floor signs: error_bounds.h has the depth of the forms, their
 * degree, and what underflow can lose
 *
 * forms_template.h is compiled with numbers that carry these.  The depth of a form
 * is the largest number of roundings on a path from the data to it: a sum has one
 * rounding more than its longer side, a product one more than both sides together.
 * The degree is how many data are multiplied in it.
 */
#include <string.h>

#include "check.h"
#include "shapes/layout.h"
#include "roots/roots.h"

/* size: the largest within the window; off: the error that underflow in each
 * operation can cause. */
typedef struct {
    int depth, degree;
    double size, off;
} carried;

/* Where the processor flushes to zero, an operation on doubles loses at most
 * one number below 2^-1022.  An operation on pairs loses one in each of at most
 * 64 steps: three times six of two_sum, three times eleven of Dekker's product, and
 * ten of the error. */
static double lost_per_operation = 0x1p-1022;

static int larger(int x, int y)
{
    return x > y ? x : y;
}

static carried plus(carried x, carried y)
{
    return (carried){larger(x.depth, y.depth) + 1, larger(x.degree, y.degree),
                     x.size + y.size, x.off + y.off + lost_per_operation};
}

static carried times(carried x, carried y)
{
    return (carried){
        x.depth + y.depth + 1, x.degree + y.degree, x.size * y.size,
        x.off * y.size + x.size * y.off + x.off * y.off + lost_per_operation};
}

#define INLINE static inline
#define NUM carried
#define FORM(name) name##_bounds
#define ADD(x, y) plus(x, y)
#define SUB(x, y) plus(x, y)
#define MUL(x, y) times(x, y)
#include "signs/forms_template.h"

enum { FIRST_KIND = CYLINT_KIND_CYLINDER, LAST_KIND = CYLINT_KIND_HALFSPACE };

/*
 * The terms of a line and a shape; D is from the line's origin, or from its point
 * at a parameter given as a pair.  Scaling a datum can underflow, and taking a
 * difference can too.  A difference has a rounding in doubles, and in pairs in the
 * directed modes, where the low part is rounded; in pairs that round to nearest it
 * has none (sign.c).
 */
static void load(terms_bounds *L, int kind, int at_parameter)
{
    const carried none = {0, 1, 0, 0}, one = {0, 1, 1, 0},
                  datum = {0, 1, CYLINT_WINDOW, 0x1p-1022},
                  difference = {1, 1, CYLINT_WINDOW,
                                2 * 0x1p-1022 + lost_per_operation};
    memset(L, 0, sizeof *L);
    L->kind = kind;
    for (int i = 0; i < 3; i++) {
        L->u[i] = difference; /* a segment's */
        L->w[i] = cylint_has_end_points(kind) ? difference : datum;
        L->D[0][i] = difference;
        if (at_parameter)
            L->D[0][i] = plus(difference, times(datum, L->u[i]));
        L->D[1][i] = cylint_has_end_points(kind) ? L->D[0][i]
                                                 : plus(L->D[0][i], L->w[i]);
        L->a[i] = L->b[i] = datum;
    }
    L->r[0] = !cylint_has_factors(kind)   ? datum
              : kind == CYLINT_KIND_ACONE ? none
                                          : one;
    L->r[1] = datum;
    L->dr = kind == CYLINT_KIND_ACONE ? datum : difference;
    L->one = one;
    prepare_bounds(L, FORM_END_BALL, 1);
}

/* The largest of each, at both ends. */
static carried worst_of(const terms_bounds *L, cylint_form f)
{
    const carried x = form_bounds(L, f, 0), y = form_bounds(L, f, 1);
    return (carried){larger(x.depth, y.depth), larger(x.degree, y.degree),
                     fmax(x.size, y.size), fmax(x.off, y.off)};
}

/* Of all forms and kinds. */
static carried worst(void)
{
    carried most = {0, 0, 0, 0};
    for (int kind = FIRST_KIND; kind <= LAST_KIND; kind++)
        for (cylint_form f = 0; f < CYLINT_FORMS; f++) {
            terms_bounds L;
            load(&L, kind, 0);
            const carried x = worst_of(&L, f);
            if (!CHECK(x.depth <= CYLINT_DEPTH && x.degree <= CYLINT_DEGREE))
                REPORT("kind %d, form %d: depth %d, degree %d", kind, (int)f,
                       x.depth, x.degree);
            most.depth = larger(most.depth, x.depth);
            most.degree = larger(most.degree, x.degree);
            most.off = fmax(most.off, x.off);
        }
    return most;
}

/* The degree, of forms whose signs decide, keeps pairs from underflow. */
TEST(the_deepest_form_and_the_highest_degree_are_in_error_bounds_h)
{
    const carried most = worst();
    if (!CHECK(most.depth == CYLINT_DEPTH && most.degree == CYLINT_DEGREE))
        REPORT("depth %d, degree %d", most.depth, most.degree);
}

TEST(underflow_stays_below_its_bound)
{
    const double in_doubles = worst().off;
    lost_per_operation *= 64;
    const double in_pairs = worst().off;
    lost_per_operation /= 64;
    printf("note: lost by underflow: 2^%.1f in doubles, 2^%.1f in pairs\n",
           log2(in_doubles), log2(in_pairs));
    CHECK(in_doubles <= CYLINT_UNDERFLOW && in_pairs <= CYLINT_UNDERFLOW);
    CHECK(in_pairs > CYLINT_UNDERFLOW / 2);
}

/* origin.c computes these at o + t d; alpha of kinds that are not elliptic. */
TEST(values_at_a_point_of_the_line_are_within_the_same_bounds)
{
    for (int kind = FIRST_KIND; kind <= LAST_KIND; kind++) {
        terms_bounds L;
        load(&L, kind, 1);
        const carried C = form_bounds(&L, FORM_C, 0),
                      alpha = worst_of(&L, FORM_ALPHA);
        printf("note: kind %d at o + t d: C has depth %d, degree %d\n", kind,
               C.depth, C.degree);
        CHECK(C.depth <= CYLINT_DEPTH && alpha.depth <= CYLINT_DEPTH);
        CHECK(cylint_is_elliptic(kind) ||
              (C.degree <= CYLINT_DEGREE && alpha.degree <= CYLINT_DEGREE));
    }
}
