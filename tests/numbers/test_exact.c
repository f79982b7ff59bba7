/*
 * test_exact.c - floor numbers: exact arithmetic against GMP, and its memory
 *
 * Numbers are compared as integers, multiplied by 2^BASE.
 */
#include <float.h>
#include <gmp.h>
#include <math.h>
#include <mpfr.h>

#include "check.h"
#include "environment.h"
#include "numbers/exact_sum.h"
#include "random.h"
#include "roots/roots.h"

enum { BASE = 8192 };

static int cases(void)
{
    return (int)check_setting("CYLINT_CASES", 20000);
}

static uint64_t below(uint64_t n)
{
    static uint64_t stream = 1;
    return random_below(&stream, n);
}

static double from_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Any finite double: zero, subnormal, or with any exponent. */
static double any_double(void)
{
    const uint64_t sign = below(2) << 63;
    switch (below(8)) {
    case 0:
        return from_bits(sign);
    case 1:
        return from_bits(sign | below((uint64_t)1 << 52));
    case 2: /* a power of two */
        return from_bits(sign | below(2047) << 52);
    default:
        return from_bits(sign | below(2047) << 52 | below((uint64_t)1 << 52));
    }
}

static void integer_of_double(mpz_t z, double x, int shift)
{
    int e;
    mpz_set_d(z, ldexp(frexp(x, &e), 53));
    const int up = x == 0 ? 0 : e - 53 + shift;
    if (up >= 0)
        mpz_mul_2exp(z, z, (mp_bitcnt_t)up);
    else
        mpz_fdiv_q_2exp(z, z, (mp_bitcnt_t)-up);
}

static void integer_of(mpz_t z, exact x)
{
    mpz_import(z, (size_t)x.n, -1, sizeof *x.limb, 0, 0, x.limb);
    if (x.n > 0)
        mpz_mul_2exp(z, z, (mp_bitcnt_t)(32 * x.exponent + BASE));
    if (x.sign < 0)
        mpz_neg(z, z);
}

/* Whether x has no zero limb at its ends and x 2^BASE is the integer. */
static int is_integer(exact x, const mpz_t wanted)
{
    mpz_t z;
    mpz_init(z);
    integer_of(z, x);
    const int trimmed = x.sign == 0
                            ? x.n == 0
                            : x.n > 0 && x.limb[0] != 0 && x.limb[x.n - 1] != 0;
    const int same = mpz_cmp(z, wanted) == 0 && mpz_sgn(z) == x.sign;
    mpz_clear(z);
    return trimmed && same;
}

static cylint_arena arena;

static void doubles_are_placed_exactly(void)
{
    mpz_t z;
    mpz_init(z);
    for (int i = 0; i < cases(); i++) {
        const double x = any_double();
        cylint_arena_open(&arena);
        integer_of_double(z, x, BASE);
        if (!CHECK(is_integer(cylint_exact_from(&arena, x), z)))
            REPORT("%a", x);
    }
    mpz_clear(z);
}

enum { TERMS = 6 };

/* A sum in which terms often cancel, exactly or nearly. */
static exact cancelling_sum(mpz_t sum)
{
    double term[TERMS];
    mpz_t z;
    mpz_init(z);
    mpz_set_ui(sum, 0);
    exact x = cylint_exact_from(&arena, 0);
    for (int i = 0; i < TERMS; i++) {
        term[i] = i > 0 && below(2) ? -term[below((uint64_t)i)] : any_double();
        if (below(4) == 0 && fabs(term[i]) < 0x1p1000)
            term[i] = nextafter(term[i], HUGE_VAL);
        integer_of_double(z, term[i], BASE);
        mpz_add(sum, sum, z);
        x = cylint_exact_add(&arena, x, cylint_exact_from(&arena, term[i]));
    }
    mpz_clear(z);
    return x;
}

static void sums_are_exact(void)
{
    mpz_t z;
    mpz_init(z);
    for (int i = 0; i < cases(); i++) {
        cylint_arena_open(&arena);
        CHECK(is_integer(cancelling_sum(z), z));
    }
    mpz_clear(z);
}

static void products_of_sums_are_exact(void)
{
    mpz_t x, y;
    mpz_inits(x, y, NULL);
    for (int i = 0; i < cases(); i++) {
        cylint_arena_open(&arena);
        const exact a = cancelling_sum(x), b = cancelling_sum(y);
        mpz_mul(x, x, y);
        mpz_fdiv_q_2exp(x, x, BASE);
        CHECK(is_integer(cylint_exact_mul(&arena, a, b), x));
    }
    mpz_clears(x, y, NULL);
}

static void keeping_a_number_frees_the_rest(void)
{
    mpz_t x, y;
    mpz_inits(x, y, NULL);
    for (int i = 0; i < cases(); i++) {
        cylint_arena_open(&arena);
        const exact before = cancelling_sum(x);
        const int used = arena.used;
        cancelling_sum(y);
        exact kept = cancelling_sum(y);
        kept = cylint_exact_keep(&arena, used, kept);
        CHECK(is_integer(kept, y) && is_integer(before, x));
        CHECK(arena.used <= used + kept.n);
        const int end = arena.used;
        CHECK(is_integer(cylint_exact_keep(&arena, end, before), x));
        CHECK(arena.used == end);
    }
    mpz_clears(x, y, NULL);
}

/* |x - (hi + lo) 2^e| / |x|. */
static double rounding_error(const mpz_t x, pair v, int e)
{
    mpz_t sum, z;
    mpf_t off, size;
    mpz_inits(sum, z, NULL);
    mpf_init2(off, 256);
    mpf_init2(size, 256);
    integer_of_double(sum, v.hi, e + BASE);
    integer_of_double(z, v.lo, e + BASE);
    mpz_add(sum, sum, z);
    mpz_sub(sum, sum, x);
    mpf_set_z(off, sum);
    mpf_set_z(size, x);
    mpf_div(off, off, size);
    const double relative = fabs(mpf_get_d(off));
    mpf_clear(off);
    mpf_clear(size);
    mpz_clears(sum, z, NULL);
    return relative;
}

static void roundings_are_within_their_bound(void)
{
    double worst = 0;
    mpz_t x, y;
    mpz_inits(x, y, NULL);
    for (int i = 0; i < cases(); i++) {
        cylint_arena_open(&arena);
        exact a = cancelling_sum(x);
        if (below(2)) {
            a = cylint_exact_mul(&arena, a, cancelling_sum(y));
            integer_of(x, a);
        }
        if (a.sign == 0)
            continue;
        int e;
        const pair v = cylint_exact_round(a, &e);
        const double off = rounding_error(x, v, e);
        worst = fmax(worst, off);
        CHECK(off < CYLINT_EXACT_ROUNDING);
        CHECK(fabs(v.hi) >= 1 && fabs(v.hi) <= 2 && v.hi + v.lo == v.hi);
    }
    printf("note: largest error of rounding to a pair: %.3f 2^-104\n",
           worst * 0x1p104);
    mpz_clears(x, y, NULL);
}

/* --------------------------------------------------- leading digits ---- */

enum { DIGITS = 400 };

static void real_of(mpfr_t r, exact x)
{
    mpz_t z;
    mpz_init(z);
    integer_of(z, x);
    mpfr_set_z_2exp(r, z, -BASE, MPFR_RNDN);
    mpz_clear(z);
}

/* |x / y - 1|. */
static double apart(exact x, const mpfr_t y)
{
    mpfr_t r;
    mpfr_init2(r, DIGITS);
    real_of(r, x);
    mpfr_div(r, r, y, MPFR_RNDN);
    mpfr_sub_ui(r, r, 1, MPFR_RNDN);
    const double off = fabs(mpfr_get_d(r, MPFR_RNDA));
    mpfr_clear(r);
    return off;
}

static void inverses_and_roots_in(struct environment there)
{
    mpfr_t x, y;
    mpz_t ignored;
    mpfr_inits2(DIGITS, x, y, (mpfr_ptr)NULL);
    mpz_init(ignored);
    for (int i = 0; i < cases() / 20; i++) {
        cylint_arena_open(&arena);
        const exact a = cancelling_sum(ignored);
        if (a.sign == 0)
            continue;
        exact size = a;
        size.sign = 1;
        const exact here = cylint_inverse(&arena, a);
        environment_set(there);
        const exact inverse = cylint_inverse(&arena, a),
                    root = cylint_square_root(&arena, size),
                    both = cylint_inverse_root(&arena, cylint_leading(size));
        environment_reset();
        CHECK(cylint_exact_add(&arena, here, cylint_exact_neg(inverse)).sign ==
              0);
        real_of(x, a);
        mpfr_ui_div(y, 1, x, MPFR_RNDN);
        CHECK(apart(inverse, y) < CYLINT_INVERSE_ERROR);
        mpfr_abs(x, x, MPFR_RNDN);
        mpfr_sqrt(y, x, MPFR_RNDN);
        CHECK(apart(root, y) < CYLINT_INVERSE_ERROR);
        mpfr_rec_sqrt(y, x, MPFR_RNDN);
        CHECK(apart(both, y) < CYLINT_INVERSE_ERROR);
    }
    mpfr_clears(x, y, (mpfr_ptr)NULL);
    mpz_clear(ignored);
}

static void inverses_and_roots_are_within_their_bound(void)
{
    everywhere(inverses_and_roots_in);
}

/* hi + lo times 2^e: also below the normal numbers and beyond the largest. */
static void sums_are_rounded_once_in(struct environment there)
{
    mpfr_t r;
    mpfr_init2(r, 4400);
    for (int i = 0; i < cases() / 4; i++) {
        const int kind = (int)below(4), bits = (int)below(60);
        const double hi = ldexp((double)(below((uint64_t)1 << 53) | 1),
                                (int)below(9) - 4),
                     lo = ldexp(below(2) ? 1 : -1, -bits) * (double)below(3);
        const int e = kind == 0   ? -1074 - (int)below(64)
                      : kind == 1 ? 960 + (int)below(16)
                      : kind == 2 ? -1074 - 53
                                  : (int)below(200);
        cylint_arena_open(&arena);
        mpfr_set_d(r, hi, MPFR_RNDN);
        mpfr_add_d(r, r, lo, MPFR_RNDN);
        mpfr_mul_2si(r, r, e, MPFR_RNDN);
        const double want = mpfr_get_d(r, MPFR_RNDN);
        environment_set(there);
        const double got = cylint_exact_nearest(
            cylint_exact_add(&arena, cylint_exact_from(&arena, hi),
                             cylint_exact_from(&arena, lo)),
            e);
        environment_reset();
        if (!CHECK(memcmp(&got, &want, sizeof got) == 0))
            REPORT("(%a + %a) 2^%d: %a, not %a", hi, lo, e, got, want);
    }
    mpfr_clear(r);
}

static void sums_are_rounded_once(void)
{
    everywhere(sums_are_rounded_once_in);
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
static void operations_use_no_more_limbs_than_the_capacity_counts(void)
{
    mpz_t z;
    mpz_init(z);
    for (int i = 0; i < cases(); i++) {
        cylint_arena_open(&arena);
        expect_limbs(cylint_exact_from(&arena, any_double()), -34, 33, 0);
        const exact x = cancelling_sum(z), y = cancelling_sum(z);
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
    mpz_clear(z);
}

/* Of positive and negative doubles whose sum is not negative. */
static void totals_are_rounded_once(void)
{
    static const double known[][4] = {{0, -0.0, 0, 0},
                                      {0x1p-1074, 0, 0, 0x1p-1074},
                                      {0x1p-1073, -0x1p-1074, 0, 0x1p-1074},
                                      {DBL_MAX, -DBL_MAX, 1, 1},
                                      {DBL_MAX, DBL_MAX, 0, HUGE_VAL},
                                      {DBL_MAX, 0x1p970, 0, HUGE_VAL},
                                      {DBL_MAX, 0x1p970, -0x1p-1074, DBL_MAX}};
    uint64_t stream = 5;
    mpfr_t all;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        cylint_exact_sum sum = {{0}};
        for (int k = 0; k < 3; k++)
            cylint_sum_add(&sum, known[i][k]);
        CHECK(cylint_sum_rounded(&sum) == known[i][3]);
    }
    mpfr_init2(all, 2200);
    for (int i = 0; i < cases() / 10; i++) {
        const int spread = 1 + random_int(&stream, 1000);
        const int middle = random_int(&stream, 1500) - 1000;
        cylint_exact_sum sum = {{0}};
        mpfr_set_zero(all, 1);
        for (int n = random_int(&stream, 40); n > 0; n--) {
            const int e = middle + random_int(&stream, spread) - spread / 2;
            const double size = ldexp(random_mantissa(&stream), e);
            const double x = mpfr_cmp_d(all, size) < 0 ? size : -size;
            mpfr_add_d(all, all, x, MPFR_RNDN);
            cylint_sum_add(&sum, x);
        }
        CHECK(cylint_sum_rounded(&sum) == mpfr_get_d(all, MPFR_RNDN));
    }
    mpfr_clear(all);
}

int main(void)
{
    RUN(doubles_are_placed_exactly);
    RUN(sums_are_exact);
    RUN(products_of_sums_are_exact);
    RUN(keeping_a_number_frees_the_rest);
    RUN(roundings_are_within_their_bound);
    RUN(inverses_and_roots_are_within_their_bound);
    RUN(sums_are_rounded_once);
    RUN(totals_are_rounded_once);
    RUN(operations_use_no_more_limbs_than_the_capacity_counts);
    return check_end();
}
