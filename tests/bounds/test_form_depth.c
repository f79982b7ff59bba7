/*
 * test_form_depth.c - floor signs: error_bounds.h has the depth of the forms, and
 * their degree
 *
 * The depth of a form is the largest number of roundings on a path from the
 * data to it.  forms_template.h is compiled with an arithmetic of path lengths:
 * a sum has one rounding more than its longer side, a product one more than
 * both sides together.  The largest depth of all forms and kinds must be
 * CYLINT_DEPTH, neither more nor less.
 */
#include <string.h>

#include "check.h"
#include "shapes/layout.h"
#include "roots/roots.h"

static int longer(int x, int y)
{
    return x > y ? x : y;
}

static int depth_of_sum(int x, int y)
{
    return longer(x, y) + 1;
}

static int depth_of_product(int x, int y)
{
    return x + y + 1;
}

#define INLINE static inline
#define NUM int
#define FORM(name) name##_depth
#define ADD(x, y) depth_of_sum(x, y)
#define SUB(x, y) depth_of_sum(x, y)
#define MUL(x, y) depth_of_product(x, y)
#include "signs/forms_template.h"

enum {
    FIRST_KIND = CYLINT_KIND_CYLINDER,
    LAST_KIND = CYLINT_KIND_RCONE,
    KINDS = LAST_KIND + 1
};

/* A difference of data has a rounding in doubles, and in pairs in the directed
 * modes, where the low part is rounded; in pairs that round to nearest it has none
 * (sign.c). */
static void load(terms_depth *L, int kind)
{
    const int difference = 1;
    memset(L, 0, sizeof *L);
    L->kind = kind;
    for (int i = 0; i < 3; i++) {
        L->u[i] = difference; /* a segment's */
        L->w[i] = cylint_has_end_points(kind) ? difference : 0;
        L->D[0][i] = difference;
        L->D[1][i] = cylint_has_end_points(kind)
                         ? difference
                         : depth_of_sum(L->D[0][i], L->w[i]);
    }
    L->dr = kind == CYLINT_KIND_ACONE ? 0 : difference;
    prepare_depth(L, FORM_END_BALL, 1);
}

static const char *const form_name[CYLINT_FORMS] = {
    "alpha", "det or vv", "C", "rho0", "beta", "rho1", "along",
    "E",     "N",         "G", "A",    "B",    "T",    "ball"};

/* Prints the table; returns its largest entry. */
static int deepest(void)
{
    static const char *const kind_name[KINDS] = {
        "",      "cylinder", "cone",    "acone", "ecylinder",
        "econe", "sphere",   "capsule", "rcone"};
    int most = 0;
    printf("note: %-12s", "form");
    for (int kind = FIRST_KIND; kind <= LAST_KIND; kind++)
        printf(" %9s", kind_name[kind]);
    for (cylint_form f = 0; f < CYLINT_FORMS; f++) {
        printf("\nnote: %-12s", form_name[f]);
        for (int kind = FIRST_KIND; kind <= LAST_KIND; kind++) {
            terms_depth L;
            load(&L, kind);
            const int depth =
                longer(form_depth(&L, f, 0), form_depth(&L, f, 1));
            most = longer(most, depth);
            printf(" %9d", depth);
        }
    }
    putchar('\n');
    return most;
}

TEST(the_deepest_form_has_the_depth_in_error_bounds_h)
{
    const int most = deepest();
    if (!CHECK(most == CYLINT_DEPTH))
        REPORT("depth %d", most);
}

/* The point of the line at a parameter given as a pair. */
static void move_to_t(terms_depth *L)
{
    const int t = 0;
    for (int i = 0; i < 3; i++)
        L->D[0][i] = depth_of_sum(L->D[0][i], depth_of_product(t, L->u[i]));
}

/* Q at D + t u (origin.c) is no deeper than the forms themselves. */
TEST(values_at_a_point_of_the_line_are_no_deeper)
{
    int most = 0;
    for (int kind = FIRST_KIND; kind <= LAST_KIND; kind++) {
        terms_depth L;
        load(&L, kind);
        move_to_t(&L);
        most = longer(most, form_depth(&L, FORM_C, 0));
    }
    printf("note: Q at D + t u: %d\n", most);
    CHECK(most <= CYLINT_DEPTH);
}

#undef NUM
#undef FORM
#undef ADD
#undef SUB
#undef MUL

/* ------------------------------------------------------- underflow ----- */

/* The largest size of a number within the window, and the error that underflow
 * in each operation can cause. */
typedef struct {
    double size, off;
} sized;

/* Where the processor flushes to zero, an operation on doubles loses at most
 * one number below 2^-1022.  An operation on pairs loses one in each of at most
 * 64 steps: three times six of two_sum, three times eleven of Dekker's product, and
 * ten of the error. */
static double lost_per_operation;

static sized sized_add(sized x, sized y)
{
    return (sized){x.size + y.size, x.off + y.off + lost_per_operation};
}

static sized sized_mul(sized x, sized y)
{
    return (sized){x.size * y.size, x.off * y.size + x.size * y.off +
                                        x.off * y.off + lost_per_operation};
}

#define NUM sized
#define FORM(name) name##_sized
#define ADD(x, y) sized_add(x, y)
#define SUB(x, y) sized_add(x, y)
#define MUL(x, y) sized_mul(x, y)
#include "signs/forms_template.h"

/* Scaling a datum can underflow, and taking a difference can too. */
static void load_window(terms_sized *L, int kind)
{
    const sized datum = {CYLINT_WINDOW, 0x1p-1022},
                difference = {CYLINT_WINDOW,
                              2 * 0x1p-1022 + lost_per_operation},
                one = {1, 0};
    memset(L, 0, sizeof *L);
    L->kind = kind;
    for (int i = 0; i < 3; i++) {
        L->u[i] = L->D[0][i] = difference;
        L->w[i] = cylint_has_end_points(kind) ? difference : datum;
        L->D[1][i] = cylint_has_end_points(kind)
                         ? difference
                         : sized_add(L->D[0][i], L->w[i]);
        L->a[i] = L->b[i] = datum;
    }
    L->r[0] = !cylint_has_factors(kind) ? datum
                                        : (sized){kind != CYLINT_KIND_ACONE, 0};
    L->r[1] = datum;
    L->dr = kind == CYLINT_KIND_ACONE ? datum : difference;
    L->one = one;
    prepare_sized(L, FORM_END_BALL, 1);
}

static double lost(const terms_sized *L)
{
    double most = 0;
    for (cylint_form f = 0; f < CYLINT_FORMS; f++)
        for (int end = 0; end < 2; end++)
            most = fmax(most, form_sized(L, f, end).off);
    return most;
}

static double lost_by_any_form(double per_operation)
{
    double most = 0;
    lost_per_operation = per_operation;
    for (int kind = FIRST_KIND; kind <= LAST_KIND; kind++) {
        terms_sized L;
        load_window(&L, kind);
        most = fmax(most, lost(&L));
    }
    return most;
}

TEST(underflow_stays_below_its_bound)
{
    const double in_doubles = lost_by_any_form(0x1p-1022),
                 in_pairs = lost_by_any_form(64 * 0x1p-1022);
    printf("note: lost by underflow: 2^%.1f in doubles, 2^%.1f in pairs\n",
           log2(in_doubles), log2(in_pairs));
    CHECK(in_doubles <= CYLINT_UNDERFLOW && in_pairs <= CYLINT_UNDERFLOW);
    CHECK(in_pairs > CYLINT_UNDERFLOW / 2);
}

/* -------------------------------------------------------- degrees ------ */

static int degree_of_product(int x, int y)
{
    return x + y;
}

#define NUM int
#define FORM(name) name##_degree
#define ADD(x, y) longer(x, y)
#define SUB(x, y) longer(x, y)
#define MUL(x, y) degree_of_product(x, y)
#include "signs/forms_template.h"

/* The terms of a line from its origin, where D is 1, or from o + t d, where it is
 * 2. */
static void set_degrees(terms_degree *L, int kind, int D)
{
    memset(L, 0, sizeof *L);
    L->kind = kind;
    for (int i = 0; i < 3; i++) {
        L->u[i] = L->w[i] = L->a[i] = L->b[i] = 1;
        L->D[0][i] = L->D[1][i] = D;
    }
    L->r[0] = L->r[1] = L->dr = L->one = 1;
    prepare_degree(L, FORM_END_BALL, 1);
}

/* The degree that keeps pairs from underflow: of forms whose signs decide. */
TEST(the_highest_degree_is_in_error_bounds_h)
{
    int most = 0;
    for (int kind = FIRST_KIND; kind <= LAST_KIND; kind++) {
        terms_degree L;
        set_degrees(&L, kind, 1);
        for (cylint_form f = 0; f < CYLINT_FORMS; f++)
            for (int end = 0; end < 2; end++)
                most = longer(most, form_degree(&L, f, end));
    }
    if (!CHECK(most == CYLINT_DEGREE))
        REPORT("degree %d", most);
}

/* origin.c computes two forms there, of kinds that are not elliptic. */
TEST(forms_at_other_points_of_a_line_are_of_no_higher_degree)
{
    for (int kind = FIRST_KIND; kind <= LAST_KIND; kind++) {
        terms_degree L;
        if (cylint_is_elliptic(kind))
            continue;
        set_degrees(&L, kind, 2);
        CHECK(form_degree(&L, FORM_C, 0) <= CYLINT_DEGREE);
        CHECK(form_degree(&L, FORM_ALPHA, 0) <= CYLINT_DEGREE);
        CHECK(form_degree(&L, FORM_ALPHA, 1) <= CYLINT_DEGREE);
    }
}
