/*
 * test_double_double.c - double_double.h against MPFR
 *
 * Tests that sums and products are error-free and that pairs keep their error
 * bounds.  error_free_template.h is compiled twice, with products by Dekker's
 * splitting and by fused multiply-add; both must give the same bits.  MPFR has
 * more bits than any of the results.
 */
#include <fenv.h>
#include <math.h>
#include <stdint.h>

#include "check.h"
#include "draw.h"
#include "environment.h"
#include "real.h"

#undef __FMA__
#include "numbers/error_bounds.h"
#include "numbers/double_double.h"

#define REAL double
#define PAIR pair
#define EFT(name) fused_##name
#define BROADCAST(x) (x)
#define INLINE static inline
#define FUSED(a, b, c) fma(a, b, c)
#include "numbers/error_free_template.h"

enum { CASES = 60000, BITS = 1200 };

/* A double in [1, 2) with a random mantissa, a sparse one, or one at an end. */
static double mantissa(void)
{
    switch (below(5)) {
    case 0:
        return 1;
    case 1:
        return 2 - 0x1p-52 * (double)(1 + below(3));
    case 2:
        return 1 + 0x1p-52 * (double)below(4);
    case 3: {
        const double bit = ldexp(1, -(int)(1 + below(52)));
        return 1 + bit + ldexp(1, -(int)(1 + below(52))) * 0.5;
    }
    default:
        return 1 + 0x1p-52 * (double)below((uint64_t)1 << 52);
    }
}

static double signed_mantissa(void)
{
    return below(2) ? mantissa() : -mantissa();
}

/* The exponents of the forms: up to the eighth power of the window. */
static double any_double(void)
{
    const int reach = below(4) ? 8 : 480;
    const double m = signed_mantissa();
    return ldexp(m, (int)below((uint64_t)(2 * reach)) - reach);
}

static pair any_pair(void)
{
    const double hi = any_double();
    int e;
    frexp(hi, &e);
    switch (below(4)) {
    case 0:
        return (pair){hi, 0};
    case 1: /* nearly half an ulp */
        return two_sum(hi, ldexp(below(2) ? 2 - 0x1p-52 : -1, e - 55));
    default:
        e -= 55 + (int)below(3);
        return two_sum(hi, ldexp(signed_mantissa(), e));
    }
}

/* A pair that cancels a, exactly or nearly, in half of the cases. */
static pair cancelling(pair a)
{
    pair b = any_pair();
    switch (below(4)) {
    case 0:
        b.hi = -a.hi;
        b.lo = -a.lo * (double)below(3);
        break;
    case 1:
        b.hi = -nextafter(a.hi, below(2) ? 0 : 2 * a.hi);
        b.lo = a.lo;
        break;
    default:
        return b;
    }
    return two_sum(b.hi, b.lo);
}

static real sum_of(pair a)
{
    return plus(real_of(a.hi), real_of(a.lo));
}

static int is_equal(real x, pair y)
{
    return mpfr_equal_p(x->x, sum_of(y)->x);
}

TEST(sums_and_products_have_no_error)
{
    for (int i = 0; i < CASES; i++) {
        const double a = any_double();
        const double b = below(2) ? cancelling((pair){a, 0}).hi : any_double();
        const pair p = two_prod(a, b);
        const pair f = fused_two_prod(a, b);
        real_fixed(BITS);
        const real x = real_of(a), y = real_of(b);
        if (!CHECK(is_equal(plus(x, y), two_sum(a, b))))
            REPORT("%a + %a", a, b);
        if (!CHECK(is_equal(times(x, y), p) && p.hi == f.hi && p.lo == f.lo))
            REPORT("%a * %a", a, b);
    }
}

/* |result - z| / size. */
static double relative_error(pair result, real z, double size)
{
    const real off = over(minus(sum_of(result), z), real_of(size));
    return fabs(mpfr_get_d(off->x, RND));
}

typedef struct {
    double add, mul, div, sqrt; /* the largest, or NaN if one is */
} errors;

static void keep_largest(double *most, double error)
{
    if (!(error <= *most) && !isnan(*most))
        *most = error;
}

/* Dekker's splitting is correct in rounding to nearest only; the other modes
 * use the fused product. */
static pair product_in_mode(pair a, pair b, int mode)
{
    if (mode == FE_TONEAREST)
        return pair_mul(a, b);
    const pair p = fused_two_prod(a.hi, b.hi);
    return fast_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

static errors worst_of_pairs(int mode)
{
    errors worst = {0, 0, 0, 0};
    for (int i = 0; i < CASES; i++) {
        fesetround(FE_TONEAREST);
        pair a = any_pair(), b = cancelling(a);
        if (b.hi == 0)
            continue;
        fesetround(mode);
        const pair sum = pair_add(a, b);
        const pair product = product_in_mode(a, b, mode);
        const pair quotient = pair_div(a, b);
        const pair size = {fabs(a.hi), a.hi < 0 ? -a.lo : a.lo};
        const pair root = pair_sqrt(size);
        fesetround(FE_TONEAREST);
        real_fixed(BITS);
        const real x = sum_of(a), y = sum_of(b);
        keep_largest(&worst.add,
                     relative_error(sum, plus(x, y), fabs(a.hi) + fabs(b.hi)));
        keep_largest(&worst.mul,
                     relative_error(product, times(x, y), fabs(a.hi * b.hi)));
        keep_largest(&worst.div,
                     relative_error(quotient, over(x, y), fabs(a.hi / b.hi)));
        keep_largest(&worst.sqrt, relative_error(root, root_of(sum_of(size)),
                                                 sqrt(size.hi)));
    }
    return worst;
}

/* Quotients and roots are computed in rounding to nearest only. */
TEST(pairs_stay_within_their_bounds_in_every_rounding_mode)
{
    static const errors nearest = {CYLINT_PAIR_ADD, CYLINT_PAIR_MUL,
                                   CYLINT_PAIR_DIV, CYLINT_PAIR_SQRT},
                        directed = {CYLINT_PAIR_ROUNDING, CYLINT_PAIR_ROUNDING,
                                    HUGE_VAL, HUGE_VAL};
    for (int i = 0; i < ROUNDINGS; i++) {
        const errors e = worst_of_pairs(roundings[i]),
                     *of = i ? &directed : &nearest;
        printf(
            "note: rounding mode %d, largest error over its bound: sum %.2f, "
            "product %.2f, quotient %.2f, root %.2f\n",
            i, e.add / of->add, e.mul / of->mul, e.div / of->div,
            e.sqrt / of->sqrt);
        CHECK(e.add <= of->add && e.mul <= of->mul);
        CHECK(i > 0 || (e.div <= of->div && e.sqrt <= of->sqrt));
    }
}
