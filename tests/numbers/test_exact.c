/*
 * test_exact.c - exact arithmetic against MPFR, its memory, and scaling; pairs and
 * their error bounds
 *
 * error_free_template.h is compiled twice, with products by Dekker's splitting and
 * by fused multiply-add; both must give the same bits.  CYLINT_CASES is the number
 * of cases of most tests; others take a share of it.
 */
#include <float.h>
#include <gmp.h> /* before mpfr.h */
#include <math.h>

#include "check.h"
#include "draw.h"
#include "environment.h"
#include "real.h"
#include "ulps.h"

#undef __FMA__
#include "numbers/bits.h"
#include "numbers/exact_sum.h"
#include "roots/roots.h"

#define REAL double
#define PAIR pair
#define EFT(name) fused_##name
#define BROADCAST(x) (x)
#define INLINE static inline
#define FUSED(a, b, c) fma(a, b, c)
#include "numbers/error_free_template.h"

enum { BITS = 4400 }; /* sums and products of two sums have no error */

static int cases(void)
{
    return (int)check_setting("CYLINT_CASES", 20000);
}

/* Any finite double: zero, subnormal, a power of two, or with any exponent. */
static double any_double(void)
{
    const uint64_t kind = below(8);
    uint64_t bits = below(2) << 63;
    if (kind > 1)
        bits |= below(2047) << 52;
    if (kind == 1 || kind > 2)
        bits |= below((uint64_t)1 << 52);
    return cylint_from_bits(bits);
}

static real real_of_exact(exact x)
{
    real r = new_real();
    mpz_t z;
    mpz_init(z);
    mpz_import(z, (size_t)x.n, -1, sizeof *x.limb, 0, 0, x.limb);
    mpfr_set_z_2exp(r->x, z, 64 * x.exponent, RND);
    mpz_clear(z);
    r->off = EXACT;
    return x.sign < 0 ? negated(r) : r;
}

/* Whether x has no zero limb at its ends and is the number. */
static int is_real(exact x, real wanted)
{
    const int trimmed = x.sign == 0
                            ? x.n == 0
                            : x.n > 0 && x.limb[0] != 0 && x.limb[x.n - 1] != 0;
    return trimmed && mpfr_equal_p(real_of_exact(x)->x, wanted->x) &&
           mpfr_sgn(wanted->x) == x.sign;
}

static cylint_arena arena;

static void begin_case(void)
{
    real_fixed(BITS);
    cylint_arena_open(&arena);
}

enum { TERMS = 6 };

/* A sum in which terms often cancel, exactly or nearly. */
static exact cancelling_sum(real *sum)
{
    double term[TERMS];
    exact x = cylint_exact_from(&arena, 0);
    *sum = real_of(0);
    for (int i = 0; i < TERMS; i++) {
        term[i] = i > 0 && below(2) ? -term[below((uint64_t)i)] : any_double();
        if (below(4) == 0 && fabs(term[i]) < 0x1p1000)
            term[i] = nextafter(term[i], HUGE_VAL);
        *sum = plus(*sum, real_of(term[i]));
        x = cylint_exact_add(&arena, x, cylint_exact_from(&arena, term[i]));
    }
    return x;
}

TEST(products_of_sums_are_exact)
{
    for (int i = 0; i < cases(); i++) {
        real x, y;
        begin_case();
        const exact a = cancelling_sum(&x), b = cancelling_sum(&y);
        CHECK(is_real(cylint_exact_mul(&arena, a, b), times(x, y)));
    }
}

TEST(keeping_a_number_frees_the_rest)
{
    for (int i = 0; i < cases(); i++) {
        real x, y;
        begin_case();
        const exact before = cancelling_sum(&x);
        const int used = arena.used;
        cancelling_sum(&y);
        exact kept = cancelling_sum(&y);
        kept = cylint_exact_keep(&arena, used, kept);
        CHECK(is_real(kept, y) && is_real(before, x));
        CHECK(arena.used <= used + kept.n);
        const int end = arena.used;
        CHECK(is_real(cylint_exact_keep(&arena, end, before), x));
        CHECK(arena.used == end);
    }
}

/* |x / y - 1| */
static double apart(real x, real y)
{
    return fabs(mpfr_get_d(over(minus(x, y), y)->x, MPFR_RNDA));
}

TEST(roundings_are_within_their_bound)
{
    double worst = 0;
    for (int i = 0; i < cases(); i++) {
        real x, y;
        begin_case();
        exact a = cancelling_sum(&x);
        if (below(2)) {
            a = cylint_exact_mul(&arena, a, cancelling_sum(&y));
            x = times(x, y);
        }
        if (a.sign == 0)
            continue;
        const int top = cylint_top_of(a);
        a.exponent -= top; /* so that nothing is subnormal */
        const pair v = cylint_exact_round(&arena, a);
        const real rounded =
            times(plus(real_of(v.hi), real_of(v.lo)), power_of_two(64 * top));
        const double off = apart(rounded, x);
        worst = fmax(worst, off);
        CHECK(off < CYLINT_EXACT_ROUNDING);
        CHECK(fabs(v.lo) <= CYLINT_NEAREST_ROUNDING * fabs(v.hi));
    }
    printf("note: largest error of rounding to a pair: %.3f 2^-105\n",
           worst * 0x1p105);
}

/* --------------------------------------------------- leading digits ---- */

TEST(inverses_and_roots_are_within_their_bound)
{
    EACH_ENVIRONMENT(there)
        for (int i = 0; i < cases() / 20; i++) {
            real x;
            begin_case();
            const exact a = cancelling_sum(&x);
            if (a.sign == 0)
                continue;
            exact size = a;
            size.sign = 1;
            const exact here = cylint_inverse(&arena, a);
            environment_set(there);
            const exact inverse = cylint_inverse(&arena, a),
                        root = cylint_square_root(&arena, size),
                        both =
                            cylint_inverse_root(&arena, cylint_leading(size));
            environment_reset();
            CHECK(cylint_exact_add(&arena, here, cylint_exact_neg(inverse))
                      .sign == 0);
            const real one = real_of(1), root_x = root_of(real_of_exact(size));
            CHECK(apart(real_of_exact(inverse), over(one, x)) <
                  CYLINT_INVERSE_ERROR);
            CHECK(apart(real_of_exact(root), root_x) < CYLINT_INVERSE_ERROR);
            CHECK(apart(real_of_exact(both), over(one, root_x)) <
                  CYLINT_INVERSE_ERROR);
        }
}

/* hi + lo times 2^e: also below the normal numbers and beyond the largest. */
TEST(sums_are_rounded_once)
{
    EACH_ENVIRONMENT(there)
        for (int i = 0; i < cases() / 4; i++) {
            const int kind = (int)below(4), bits = (int)below(60);
            const int up = (int)below(9) - 4;
            const double hi = ldexp((double)(below((uint64_t)1 << 53) | 1), up);
            const double low = ldexp((double)below(3), -bits);
            const double lo = below(2) ? low : -low;
            const int e = kind == 0   ? -1074 - (int)below(64)
                          : kind == 1 ? 960 + (int)below(16)
                          : kind == 2 ? -1074 - 53
                                      : (int)below(200);
            begin_case();
            const real sum = plus(real_of(hi), real_of(lo));
            const double want = mpfr_get_d(times(sum, power_of_two(e))->x, RND);
            environment_set(there);
            const double got = cylint_exact_nearest(
                cylint_exact_add(&arena, cylint_exact_from(&arena, hi),
                                 cylint_exact_from(&arena, lo)),
                e);
            environment_reset();
            if (!CHECK(memcmp(&got, &want, sizeof got) == 0))
                REPORT("(%a + %a) 2^%d: %a, not %a", hi, lo, e, got, want);
        }
}

/* ----------------------------------------------- memory of the arena --- */

/* The result is within the limbs from `low` up to `top`, and its operation used
 * no more memory than they. */
static void expect_limbs(exact x, int low, int top, int used)
{
    CHECK(arena.most - used <= top - low);
    CHECK(x.sign == 0 || (x.exponent >= low && cylint_top_of(x) <= top));
}

/* bounds/test_arena.c computes the capacity of the arena from these limits. */
TEST(operations_use_no_more_limbs_than_the_capacity_counts)
{
    for (int i = 0; i < cases(); i++) {
        real unused;
        begin_case();
        expect_limbs(cylint_exact_from(&arena, any_double()), -17, 17, 0);
        const exact x = cancelling_sum(&unused), y = cancelling_sum(&unused);
        if (x.sign == 0 || y.sign == 0)
            continue;
        const int xt = cylint_top_of(x), yt = cylint_top_of(y);
        int used = arena.most = arena.used;
        expect_limbs(cylint_exact_mul(&arena, x, y), x.exponent + y.exponent,
                     xt + yt, used);
        used = arena.most = arena.used;
        expect_limbs(cylint_exact_add(&arena, x, y),
                     x.exponent < y.exponent ? x.exponent : y.exponent,
                     (xt > yt ? xt : yt) + 1, used);
    }
}

/* Of positive and negative doubles whose sum is not negative. */
TEST(totals_are_rounded_once)
{
    static const double known[][4] = {{0, -0.0, 0, 0},
                                      {0x1p-1074, 0, 0, 0x1p-1074},
                                      {0x1p-1073, -0x1p-1074, 0, 0x1p-1074},
                                      {DBL_MAX, -DBL_MAX, 1, 1},
                                      {DBL_MAX, DBL_MAX, 0, HUGE_VAL},
                                      {DBL_MAX, 0x1p970, 0, HUGE_VAL},
                                      {DBL_MAX, 0x1p970, -0x1p-1074, DBL_MAX}};
    stream = 5;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        cylint_exact_sum sum = {{0}};
        for (int k = 0; k < 3; k++)
            cylint_sum_add(&sum, known[i][k]);
        CHECK(cylint_sum_rounded(&sum) == known[i][3]);
    }
    for (int i = 0; i < cases() / 10; i++) {
        const int spread = 1 + one_of(1000);
        const int middle = one_of(1500) - 1000;
        cylint_exact_sum sum = {{0}};
        real_fixed(BITS);
        real all = real_of(0);
        for (int n = one_of(40); n > 0; n--) {
            const int e = middle + one_of(spread) - spread / 2;
            const double size = ldexp(random_mantissa(&stream), e);
            const double x = mpfr_cmp_d(all->x, size) < 0 ? size : -size;
            all = plus(all, real_of(x));
            cylint_sum_add(&sum, x);
        }
        CHECK(cylint_sum_rounded(&sum) == mpfr_get_d(all->x, RND));
    }
}

/* Most results are subnormal, or nearly: the processor may flush them. */
TEST(a_scaled_double_is_the_nearest_one_in_every_environment)
{
    EACH_ENVIRONMENT(there)
        for (int i = 0; i < cases() / 10; i++) {
            const double x = any_double();
            const int of_x = x == 0 ? 0 : ilogb(x);
            const int e = one_of(4) ? one_of(64) - 1080 - of_x : one_of(2200);
            const double want = ldexp(x, e);
            environment_set(there);
            const double got = cylint_scaled(x, e);
            environment_reset();
            if (!CHECK(cylint_bits(got) == cylint_bits(want)))
                REPORT("%a 2^%d: %a, want %a", x, e, got, want);
        }
}

/* --------------------------------------------------------------- pairs -- */

/* Of all digits, of few, or next to a power of two.  Exponents are those of the
 * forms: up to the eighth power of the window. */
static double any_high_part(void)
{
    const int kind = one_of(3), reach = one_of(4) ? 8 : 480;
    const int e = whole_between(-reach, reach - 1), bit = one_of(53);
    const double x = kind == 0   ? random_mantissa(&stream)
                     : kind == 1 ? 1 + ldexp(one_of(4), -bit)
                                 : stepped(1, whole_between(-3, 3));
    return ldexp(one_of(2) ? x : -x, e);
}

/* The low part is 0, nearly half an ulp, or any. */
static pair any_pair(void)
{
    const double hi = any_high_part(), half = ulp(hi) / 2;
    const int kind = one_of(3);
    const double low = kind == 0   ? 0
                       : kind == 1 ? half * (1 - 0x1p-53)
                                   : half * between(0, 1);
    return two_sum(hi, one_of(2) ? low : -low);
}

/* A pair that cancels a, exactly or nearly, in half of the cases. */
static pair cancelling(pair a)
{
    const int kind = one_of(4);
    if (kind == 0)
        return two_sum(-a.hi, -a.lo * one_of(3));
    if (kind == 1)
        return two_sum(-stepped(a.hi, one_of(2) ? 1 : -1), a.lo);
    return any_pair();
}

static real sum_of(pair a)
{
    return plus(real_of(a.hi), real_of(a.lo));
}

static int is_sum(pair a, real x)
{
    return mpfr_equal_p(sum_of(a)->x, x->x);
}

TEST(sums_and_products_have_no_error)
{
    for (int i = 0; i < 3 * cases(); i++) {
        const double a = any_high_part(), b = cancelling((pair){a, 0}).hi;
        const pair p = two_prod(a, b), fused = fused_two_prod(a, b);
        real_fixed(BITS);
        const real x = real_of(a), y = real_of(b);
        if (!CHECK(is_sum(two_sum(a, b), plus(x, y)) &&
                   is_sum(p, times(x, y)) && p.hi == fused.hi &&
                   p.lo == fused.lo))
            REPORT("%a and %a", a, b);
    }
}

enum { SUM, PRODUCT, QUOTIENT, ROOT, OPERATIONS };

/* Dekker's splitting is correct in rounding to nearest only; the other modes
 * use the fused product. */
static pair product_in_mode(pair a, pair b, int mode)
{
    if (mode == FE_TONEAREST)
        return pair_mul(a, b);
    const pair p = fused_two_prod(a.hi, b.hi);
    return fast_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

/* The errors of operations on a and b, relative to the sizes of their high
 * parts. */
static void measure_errors(pair a, pair b, int mode, double error[OPERATIONS])
{
    const pair size = a.hi < 0 ? pair_neg(a) : a;
    fesetround(mode);
    const pair got[] = {pair_add(a, b), product_in_mode(a, b, mode),
                        pair_div(a, b), pair_sqrt(size)};
    fesetround(FE_TONEAREST);
    real_fixed(1200);
    const real x = sum_of(a), y = sum_of(b);
    const real due[] = {plus(x, y), times(x, y), over(x, y),
                        root_of(sum_of(size))};
    const double unit[] = {size.hi + fabs(b.hi), fabs(a.hi * b.hi),
                           fabs(a.hi / b.hi), sqrt(size.hi)};
    for (int k = 0; k < OPERATIONS; k++)
        error[k] = fabs(mpfr_get_d(
            over(minus(sum_of(got[k]), due[k]), real_of(unit[k]))->x, RND));
}

/* Quotients and roots have bounds in rounding to nearest only; in directed modes
 * sums and products have the digits that tangents need (shapes/tangent.c). */
TEST(pairs_stay_within_their_bounds_in_every_rounding_mode)
{
    static const double nearest[] = {CYLINT_PAIR_ADD, CYLINT_PAIR_MUL,
                                     CYLINT_PAIR_DIV, CYLINT_PAIR_SQRT};
    for (int m = 0; m < ROUNDINGS; m++) {
        double worst[OPERATIONS] = {0};
        for (int i = 0; i < 3 * cases(); i++) {
            double error[OPERATIONS];
            const pair a = any_pair(), b = cancelling(a);
            if (b.hi == 0)
                continue;
            measure_errors(a, b, roundings[m], error);
            for (int k = SUM; k < (m ? QUOTIENT : OPERATIONS); k++) {
                const double bound = m ? 0x1p-100 : nearest[k];
                worst[k] = fmax(worst[k], error[k] / bound);
                if (!CHECK(error[k] <= bound))
                    REPORT("operation %d, rounding %d: %a + %a, %a + %a", k, m,
                           a.hi, a.lo, b.hi, b.lo);
            }
        }
        printf(
            "note: rounding mode %d, largest error over its bound: sum %.2f, "
            "product %.2f, quotient %.2f, root %.2f\n",
            m, worst[SUM], worst[PRODUCT], worst[QUOTIENT], worst[ROOT]);
    }
}
