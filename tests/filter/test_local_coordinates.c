/*
 * test_local_coordinates.c - the matrix of every shape, compared with MPFR
 *
 * CYLINT_CASES is the number of cases of each family, CYLINT_SEED changes all.
 */
#include <math.h>

#include "check.h"
#include "families.h"
#include "numbers/error_bounds.h"
#include "shapes/local.h"
#include "shapes/measure.h"
#include "true_shape.h"

enum { CASES = 200, BITS = 2200 }; /* holds any axis */

/* No error here is a larger share of the one that is stated, which adds up all
 * roundings; so a stated error that lacks a factor is found. */
#define SHARE 0x1p-5

/* ------------------------------------------------------- the matrix ----- */

/* The largest error found, in units of the largest that is allowed. */
static double worst_row;

static int rows_are_accurate(const cylint_shape *s, true_shape *m)
{
    const double bound = SHARE * cylint_frame_error(s) * cylint_norm(s);
    int good = 1;
    for (int r = 0; r < 3; r++) {
        double size = 0, off = 0;
        for (int i = 0; i < 3; i++) {
            size += fabs(mpfr_get_d(m->row[r][i]->x, MPFR_RNDZ));
            off += off_by(m->row[r][i], cylint_column(s, i)[r],
                          cylint_column_lo(s, i)[r]);
        }
        worst_row = fmax(worst_row, off / bound);
        good &= off <= bound && size <= cylint_norm(s);
    }
    return good;
}

/* Whether a number of the shape has SHARE of the relative error; low parts may
 * underflow where x is tiny beside 1. */
static int is_near(real x, const cylint_shape *s, int at, double error)
{
    const pair y = cylint_number_pair(s, at);
    return off_by(x, y.hi, y.lo) <= SHARE * error * fmax(fabs(y.hi), 0x1p-900);
}

static int sizes_are_accurate(const cylint_shape *s, true_shape *m)
{
    const double error =
        cylint_is_hull(s->kind) ? cylint_frame_error(s) : CYLINT_LOCAL_ERROR;
    return is_near(m->height, s, CYLINT_AT_HEIGHT, CYLINT_LOCAL_ERROR) &&
           (cylint_is_elliptic(s->kind) ||
            (is_near(m->sine, s, CYLINT_AT_SINE, error) &&
             is_near(m->cosine, s, CYLINT_AT_COSINE, error))) &&
           is_near(m->slope, s, CYLINT_AT_SLOPE, error) &&
           cylint_height(s) + fmax(cylint_r0(s), cylint_r1(s)) <=
               cylint_reach(s);
}

/* Whether the build without fused operations writes the same bits, but for numbers
 * that are tiny beside 1. */
static int has_one_form(const cylint_shape *s)
{
    cylint_shape plain = *s;
    cylint_measure_local_plain(&plain);
    for (int i = 0; i < CYLINT_NUMBERS; i++) {
        double *x = &plain.library.number[i], y = s->library.number[i];
        if (fmax(fabs(*x), fabs(y)) < 0x1p-900)
            *x = y;
    }
    return memcmp(&plain, s, sizeof plain) == 0;
}

/* Whether the shape is one of those for which error_bounds.h states its bounds. */
static int is_within_limits(const cylint_shape *s)
{
    const double error = cylint_frame_error(s);
    return error >= CYLINT_LOCAL_ERROR && error <= CYLINT_LOCAL_WORST &&
           cylint_is_long_enough(cylint_axis(s)) &&
           (!cylint_is_elliptic(s->kind) ||
            (cylint_is_long_enough(cylint_a(s)) &&
             cylint_is_long_enough(cylint_b(s)))) &&
           (!cylint_is_hull(s->kind) ||
            fabs(cylint_sine(s)) <= CYLINT_LOCAL_STEEPEST);
}

/* Returns whether the shape has local coordinates. */
static int matrix_is_accurate(const cylint_shape *s)
{
    true_shape m;
    if (s->kind == CYLINT_KIND_NONE || !cylint_prepared(s) ||
        s->kind == CYLINT_KIND_SPHERE)
        return 0;
    CHECK(has_one_form(s)); /* in each build */
    real_fixed(BITS);
    set_true_shape(&m, s);
    if (!CHECK(is_within_limits(s) && rows_are_accurate(s, &m) &&
               sizes_are_accurate(s, &m)))
        REPORT("kind %d, axis %a %a %a, radii %a %a", s->kind,
               cylint_axis(s)[0], cylint_axis(s)[1], cylint_axis(s)[2],
               cylint_r0(s), cylint_r1(s));
    return 1;
}

TEST(the_matrix_is_as_accurate_as_it_states)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    const uint64_t seed = check_seed();
    const int extreme = family_named("extreme sizes");
    /* a slope of about 2^-1025, the low parts of which underflow */
    const double p0[3] = {0, 0, -0x1.8487cec45be26p-120},
                 p1[3] = {0, -0x1.bea8fae24911p+14, 0};
    cylint_shape thin;
    int usable = 0;
    cylint_round_cone(&thin, p0, 0, p1, 0x1.a7070b54813bcp-1011,
                      CYLINT_ENDS_CAPPED);
    CHECK(!matrix_is_accurate(&thin));
    EACH_CASE(c, seed, family == extreme ? 40 * cases : cases)
        usable += matrix_is_accurate(&c.shape);
    CHECK(usable > 0);
    printf("note: largest error of a row: %.2g of the allowed one\n",
           worst_row);
}
