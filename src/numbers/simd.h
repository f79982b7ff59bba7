/*
 * simd.h - a lane vector vd, its mask vm and the few operations on them
 *
 * All intrinsics on doubles are in this file.  The operators + - * / of C work
 * on vd; the other operations are the functions below.  v_float(x) is x
 * rounded to floats.  v_like(x, y) is x with the signs of y.
 *
 * The compiler's flags choose the instruction set.  CYLINT_ONE_LANE chooses
 * plain doubles, which are also the choice where no instruction set is
 * available.  CYLINT_NARROW chooses two lanes with branch-free masks, for one line
 * and one shape; compilers with GNU's vectors have two lanes on every processor.
 * With two lanes there are also functions that join two numbers, join the first or
 * the second lanes of two vectors, swap the lanes, and return the first lane.  vq
 * is two vectors, and with CYLINT_NARROW and AVX2 one of four lanes.  Every
 * operation rounds once, so every width gives the same bits.
 */
#ifndef CYLINT_SIMD_H
#define CYLINT_SIMD_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "compiler.h"
#include "double_double.h"
#include "environment.h"

#define INLINE CYLINT_INLINE

/* clang-format off */
#if defined(CYLINT_ONE_LANE)

#define LANES 1

#elif !defined(CYLINT_NARROW) && defined(__AVX512F__) && \
    defined(__AVX512DQ__)

#include <immintrin.h>
#define LANES 8
#define MM(name) _mm512_##name
typedef __m512d vd;
typedef __mmask8 vm;
static inline vm v_lt(vd x, vd y)
{
    return _mm512_cmp_pd_mask(x, y, _CMP_LT_OQ);
}
static inline vm v_le(vd x, vd y)
{
    return _mm512_cmp_pd_mask(x, y, _CMP_LE_OQ);
}
static inline vm v_eq(vd x, vd y)
{
    return _mm512_cmp_pd_mask(x, y, _CMP_EQ_OQ);
}
static inline vd v_select(vm m, vd x, vd y)
{
    return _mm512_mask_blend_pd(m, y, x);
}
static inline vm m_not(vm m) { return (vm)~m; }
static inline vm m_and(vm a, vm b) { return (vm)(a & b); }
static inline vm m_or(vm a, vm b) { return (vm)(a | b); }
static inline vm m_and_not(vm a, vm b) { return (vm)(a & ~b); }
static inline vm m_if(vm m, vm a, vm b) { return (vm)((m & a) | (~m & b)); }
static inline unsigned m_bits(vm m) { return m; }
static inline vm m_from(unsigned bits) { return (vm)bits; }

#elif !defined(CYLINT_NARROW) && defined(__AVX2__) && defined(__FMA__)

#include <immintrin.h>
#define LANES 4
#define MM(name) _mm256_##name
typedef __m256d vd;
typedef __m256d vm;
static inline vm v_lt(vd x, vd y) { return _mm256_cmp_pd(x, y, _CMP_LT_OQ); }
static inline vm v_le(vd x, vd y) { return _mm256_cmp_pd(x, y, _CMP_LE_OQ); }
static inline vm v_eq(vd x, vd y) { return _mm256_cmp_pd(x, y, _CMP_EQ_OQ); }
static inline vd v_select(vm m, vd x, vd y)
{
    return _mm256_blendv_pd(y, x, m);
}
static inline vm m_not(vm m)
{
    return _mm256_xor_pd(m, _mm256_castsi256_pd(_mm256_set1_epi64x(-1)));
}
static inline vm m_from(unsigned bits)
{
    const __m256i lane = _mm256_set_epi64x(8, 4, 2, 1);
    return _mm256_castsi256_pd(_mm256_cmpeq_epi64(lane,
        _mm256_and_si256(lane, _mm256_set1_epi64x((long long)bits))));
}

#elif defined(__SSE2__)

#include <immintrin.h>
#define LANES 2
#define MM(name) _mm_##name
typedef __m128d vd;
typedef __m128d vm;
static inline vm v_lt(vd x, vd y) { return _mm_cmplt_pd(x, y); }
static inline vm v_le(vd x, vd y) { return _mm_cmple_pd(x, y); }
static inline vm v_eq(vd x, vd y) { return _mm_cmpeq_pd(x, y); }
static inline vd v_select(vm m, vd x, vd y)
{
#ifdef __SSE4_1__
    return _mm_blendv_pd(y, x, m);
#else
    return _mm_or_pd(_mm_and_pd(m, x), _mm_andnot_pd(m, y));
#endif
}
static inline vd v_two(double x, double y) { return _mm_set_pd(y, x); }
static inline vd v_firsts(vd x, vd y) { return _mm_unpacklo_pd(x, y); }
static inline vd v_seconds(vd x, vd y) { return _mm_unpackhi_pd(x, y); }
static inline vd v_turned(vd x) { return _mm_shuffle_pd(x, x, 1); }
static inline double v_first(vd x) { return _mm_cvtsd_f64(x); }
static inline vm m_not(vm m)
{
    return _mm_xor_pd(m, _mm_castsi128_pd(_mm_set1_epi32(-1)));
}
static inline vm m_firsts(vm m) { return v_firsts(m, m); }
static inline vm m_seconds(vm m) { return v_seconds(m, m); }
static inline vm m_from(unsigned bits)
{
    return _mm_castsi128_pd(_mm_set_epi32(-(int)(bits >> 1 & 1),
        -(int)(bits >> 1 & 1), -(int)(bits & 1), -(int)(bits & 1)));
}

#elif defined(__aarch64__) || (defined(CYLINT_NARROW) && defined(__GNUC__))

/* By GNU's vectors, also for processors without intrinsics here. */
#define LANES 2
#ifdef __aarch64__
#include <arm_neon.h>
typedef float64x2_t vd;
typedef int64x2_t vm;
static inline vd v_set(double x) { return vdupq_n_f64(x); }
static inline vd v_abs(vd x) { return vabsq_f64(x); }
static inline vd v_sqrt(vd x) { return vsqrtq_f64(x); }
static inline vd v_fma(vd x, vd y, vd z) { return vfmaq_f64(z, x, y); }
static inline vd v_float(vd x) { return vcvt_f64_f32(vcvt_f32_f64(x)); }
#else
typedef double vd __attribute__((vector_size(16)));
typedef int64_t vm __attribute__((vector_size(16)));
static inline vd v_set(double x) { return (vd){x, x}; }
static inline vd v_abs(vd x) { return (vd){fabs(x[0]), fabs(x[1])}; }
static inline vd v_sqrt(vd x)
{
    return (vd){cylint_sqrt(x[0]), cylint_sqrt(x[1])};
}
#endif
static inline vd v_load(const double *x)
{
    vd v;
    memcpy(&v, x, sizeof v);
    return v;
}
static inline void v_store(double *x, vd v) { memcpy(x, &v, sizeof v); }
/* clang for PowerPC compiles these to one instruction.  Of whole vectors x < y is
 * one number there with -faltivec-src-compat=xl, which is to become its default. */
#if defined(__clang__) && defined(__powerpc__)
#define V_COMPARED(x, op, y) ((vm){-(x[0] op y[0]), -(x[1] op y[1])})
#else
#define V_COMPARED(x, op, y) ((vm)(x op y))
#endif
static inline vm v_lt(vd x, vd y) { return V_COMPARED(x, <, y); }
static inline vm v_le(vd x, vd y) { return V_COMPARED(x, <=, y); }
static inline vm v_eq(vd x, vd y) { return V_COMPARED(x, ==, y); }
static inline vm m_if(vm m, vm a, vm b) { return (m & a) | (~m & b); }
static inline vd v_select(vm m, vd x, vd y)
{
    return (vd)m_if(m, (vm)x, (vm)y);
}
static inline vd v_max(vd x, vd y) { return v_select(v_lt(y, x), x, y); }
static inline vd v_like(vd x, vd y)
{
    const vm sign = {INT64_MIN, INT64_MIN};
    return v_select(sign, y, x);
}
static inline vd v_two(double x, double y) { return (vd){x, y}; }
static inline vd v_firsts(vd x, vd y) { return (vd){x[0], y[0]}; }
static inline vd v_seconds(vd x, vd y) { return (vd){x[1], y[1]}; }
static inline vd v_turned(vd x) { return (vd){x[1], x[0]}; }
static inline double v_first(vd x) { return x[0]; }
static inline vm m_not(vm m) { return ~m; }
static inline vm m_and(vm a, vm b) { return a & b; }
static inline vm m_or(vm a, vm b) { return a | b; }
static inline vm m_and_not(vm a, vm b) { return a & ~b; }
static inline vm m_firsts(vm m) { return (vm){m[0], m[0]}; }
static inline vm m_seconds(vm m) { return (vm){m[1], m[1]}; }
static inline unsigned m_bits(vm m)
{
    return (unsigned)(m[0] & 1) | (unsigned)(m[1] & 2);
}
static inline vm m_from(unsigned bits)
{
    return (vm){-(int64_t)(bits & 1), -(int64_t)(bits >> 1 & 1)};
}

#else

#define LANES 1

#endif

#if defined(__FMA__) || LANES == 8 || (LANES == 2 && defined(__aarch64__))
#define V_HAS_FMA 1
#else
#define V_HAS_FMA 0
#endif

#if LANES == 1
typedef double vd;
typedef int vm;
static inline vd v_set(double x) { return x; }
static inline vd v_load(const double *x) { return *x; }
static inline void v_store(double *x, vd v) { *x = v; }
static inline vd v_abs(vd x) { return fabs(x); }
static inline vd v_max(vd x, vd y) { return x > y ? x : y; }
static inline vd v_sqrt(vd x) { return cylint_sqrt(x); }
static inline vd v_float(vd x) { return (double)(float)x; }
static inline vd v_like(vd x, vd y) { return copysign(x, y); }
static inline vm v_lt(vd x, vd y) { return x < y; }
static inline vm v_le(vd x, vd y) { return x <= y; }
static inline vm v_eq(vd x, vd y) { return x == y; }
static inline vd v_select(vm m, vd x, vd y) { return m ? x : y; }
static inline vm m_not(vm m) { return !m; }
static inline vm m_and(vm a, vm b) { return a & b; }
static inline vm m_or(vm a, vm b) { return a | b; }
static inline vm m_and_not(vm a, vm b) { return a & !b; }
static inline vm m_if(vm m, vm a, vm b) { return m ? a : b; }
static inline unsigned m_bits(vm m) { return (unsigned)m; }
static inline vm m_from(unsigned bits) { return (int)bits; }
#if V_HAS_FMA
static inline vd v_fma(vd x, vd y, vd z) { return __builtin_fma(x, y, z); }
#endif

#endif

#ifdef MM /* intrinsics that have the same names at all widths */
static inline vd v_set(double x) { return MM(set1_pd)(x); }
static inline vd v_load(const double *x) { return MM(loadu_pd)(x); }
static inline void v_store(double *x, vd v) { MM(storeu_pd)(x, v); }
static inline vd v_abs(vd x) { return MM(andnot_pd)(v_set(-0.0), x); }
static inline vd v_max(vd x, vd y) { return MM(max_pd)(x, y); }
static inline vd v_sqrt(vd x) { return MM(sqrt_pd)(x); }
static inline vd v_float(vd x) { return MM(cvtps_pd)(MM(cvtpd_ps)(x)); }
static inline vd v_like(vd x, vd y)
{
    return MM(or_pd)(v_abs(x), MM(and_pd)(v_set(-0.0), y));
}
#if V_HAS_FMA
static inline vd v_fma(vd x, vd y, vd z) { return MM(fmadd_pd)(x, y, z); }
#endif
#if LANES < 8 /* masks are vectors */
static inline vm m_and(vm a, vm b) { return MM(and_pd)(a, b); }
static inline vm m_or(vm a, vm b) { return MM(or_pd)(a, b); }
static inline vm m_and_not(vm a, vm b) { return MM(andnot_pd)(b, a); }
static inline vm m_if(vm m, vm a, vm b) { return v_select(m, a, b); }
static inline unsigned m_bits(vm m) { return (unsigned)MM(movemask_pd)(m); }
#endif
#endif

static inline int m_any(vm m)
{
    return m_bits(m) != 0;
}

/* EACH() where the error of a product is one operation.  Elsewhere the code of a
 * product is long, and this is a loop. */
#if V_HAS_FMA
#define EACH_FUSED(i, n) EACH(i, n)
#else
#define EACH_FUSED(i, n) for (int i = 0; i < (n); i++)
#endif

/* x[at[0]], x[at[1]], ... */
static inline vd v_pick(const double *x, const size_t *at)
{
#if LANES == 8
    return _mm512_set_pd(x[at[7]], x[at[6]], x[at[5]], x[at[4]],
                         x[at[3]], x[at[2]], x[at[1]], x[at[0]]);
#elif LANES == 4
    return _mm256_set_pd(x[at[3]], x[at[2]], x[at[1]], x[at[0]]);
#else
    double v[LANES];
    for (int i = 0; i < LANES; i++)
        v[i] = x[at[i]];
    return v_load(v);
#endif
}

/* Writes those of the numbers from[0], from[1], ... whose bits are 1, in their
 * order, and then others up to LANES in all.  Returns the count of these bits. */
#if LANES == 8 && SIZE_MAX == UINT64_MAX
static inline size_t v_keep(size_t *to, const size_t *from, unsigned bits)
{
    const __m512i x = _mm512_loadu_si512(from);
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi64((__mmask8)bits, x));
    return (size_t)_mm_popcnt_u32(bits);
}
#elif LANES == 4 && SIZE_MAX == UINT64_MAX
static inline size_t v_keep(size_t *to, const size_t *from, unsigned bits)
{
    /* the halves of the kept numbers, as indices in eight digits */
    static const uint32_t kept[16] = {
        0x00000000, 0x00000010, 0x00000032, 0x00003210,
        0x00000054, 0x00005410, 0x00005432, 0x00543210,
        0x00000076, 0x00007610, 0x00007632, 0x00763210,
        0x00007654, 0x00765410, 0x00765432, 0x76543210};
    const __m256i shift = _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28);
    const __m256i at = _mm256_srlv_epi32(
        _mm256_set1_epi32((int)kept[bits]), shift);
    const __m256i x = _mm256_loadu_si256((const __m256i *)(const void *)from);
    _mm256_storeu_si256((__m256i *)(void *)to,
                        _mm256_permutevar8x32_epi32(x, at));
    return (size_t)_mm_popcnt_u32(bits);
}
#else
static inline size_t v_keep(size_t *to, const size_t *from, unsigned bits)
{
    size_t n = 0;
    for (unsigned i = 0; i < LANES; i++) { /* no branch to predict */
        to[n] = from[i];
        n += bits >> i & 1;
    }
    return n;
}
#endif

/* Transposes rows of four numbers: to[k] has the k-th number of each row. */
#if LANES >= 4
typedef __m256d v_row;
static inline v_row v_row_at(const double *x) { return _mm256_loadu_pd(x); }

static inline void v_transpose(const v_row row[LANES], vd to[4])
{
#if LANES == 8 /* two rows in each vector */
#define ROWS(i, j) \
    _mm512_insertf64x4(_mm512_castpd256_pd512(row[i]), row[j], 1)
    const vd a = ROWS(0, 2), b = ROWS(1, 3), c = ROWS(4, 6), d = ROWS(5, 7);
#undef ROWS
#define FIRSTS(x, y) _mm512_shuffle_f64x2(x, y, 0x88)
#define SECONDS(x, y) _mm512_shuffle_f64x2(x, y, 0xdd)
#else
    const vd a = row[0], b = row[1], c = row[2], d = row[3];
#define FIRSTS(x, y) _mm256_permute2f128_pd(x, y, 0x20)
#define SECONDS(x, y) _mm256_permute2f128_pd(x, y, 0x31)
#endif
    const vd even_ab = MM(unpacklo_pd)(a, b), odd_ab = MM(unpackhi_pd)(a, b);
    const vd even_cd = MM(unpacklo_pd)(c, d), odd_cd = MM(unpackhi_pd)(c, d);
    to[0] = FIRSTS(even_ab, even_cd);
    to[1] = FIRSTS(odd_ab, odd_cd);
    to[2] = SECONDS(even_ab, even_cd);
    to[3] = SECONDS(odd_ab, odd_cd);
#undef FIRSTS
#undef SECONDS
}
#else
typedef struct {
    double x[4];
} v_row;
static inline v_row v_row_at(const double *x)
{
    return (v_row){{x[0], x[1], x[2], x[3]}};
}

static inline void v_transpose(const v_row row[LANES], vd to[4])
{
    for (int k = 0; k < 4; k++) {
        double v[LANES];
        for (int i = 0; i < LANES; i++)
            v[i] = row[i].x[k];
        to[k] = v_load(v);
    }
}
#endif

/* The same for the rows that begin `at` bytes behind row[0], row[1], ... */
static inline void v_columns(const char *const row[LANES], size_t at,
                             vd to[4])
{
    v_row r[LANES];
    for (int i = 0; i < LANES; i++)
        r[i] = v_row_at((const double *)(const void *)(row[i] + at));
    v_transpose(r, to);
}

#if LANES == 1
typedef pair vpair;
#else
typedef struct {
    vd hi, lo;
} vpair;
#endif

#define REAL vd
#define PAIR vpair
#define EFT(name) v_##name
#define BROADCAST(x) v_set(x)
#if V_HAS_FMA
#define FUSED(a, b, c) v_fma(a, b, c)
#endif
#include "error_free_template.h"
#undef REAL
#undef PAIR
#undef EFT
#undef BROADCAST
#undef FUSED

INLINE vpair pick(vm m, vpair a, vpair b)
{
    return (vpair){v_select(m, a.hi, b.hi), v_select(m, a.lo, b.lo)};
}

INLINE vpair opposite(vpair a)
{
    return (vpair){-a.hi, -a.lo};
}

INLINE vd rounded(vpair x)
{
    return x.hi + x.lo;
}

/* Sums and products of pairs without the final normalisation.  lo can grow to
 * about 30 ulp of the terms: the constants CYLINT_LOCAL_ (error_bounds.h) count
 * that. */
INLINE vpair vpair_add(vpair a, vpair b)
{
    const vpair s = v_two_sum(a.hi, b.hi);
    return (vpair){s.hi, s.lo + (a.lo + b.lo)};
}

INLINE vpair vpair_sub(vpair a, vpair b)
{
    return vpair_add(a, opposite(b));
}

INLINE vpair vpair_mul(vpair a, vpair b)
{
    const vpair p = v_two_prod(a.hi, b.hi);
    return (vpair){p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi)};
}

/* x y + z, rounded once or twice. */
INLINE double sum_of(double x, double y, double z)
{
#ifdef __FMA__
    return __builtin_fma(x, y, z);
#else
    return x * y + z;
#endif
}

INLINE vd v_sum_of(vd x, vd y, vd z)
{
#if V_HAS_FMA
    return v_fma(x, y, z);
#else
    return x * y + z;
#endif
}

/* vpair_mul() with fewer roundings where the processor has a fused multiply-add. */
INLINE vpair vpair_product(vpair a, vpair b)
{
    const vpair p = v_two_prod(a.hi, b.hi);
    return (vpair){p.hi, v_sum_of(a.hi, b.lo, v_sum_of(a.lo, b.hi, p.lo))};
}

/* x^2.  x.lo may be larger than a rounding of x.hi. */
INLINE vpair vpair_square(vpair x)
{
    const vpair square = v_two_prod(x.hi, x.hi);
    return (vpair){square.hi, v_sum_of(x.hi + x.hi + x.lo, x.lo, square.lo)};
}

/* a / b, where `inverse` is about 1 / b; lo can be a few units of hi. */
INLINE vpair vpair_quotient(vpair a, vpair b, vd inverse)
{
    const vd q = a.hi * inverse;
    const vpair back = v_two_prod(q, b.hi);
    const vd remainder = (a.hi - back.hi) - back.lo;
    return (vpair){q, (remainder + v_sum_of(-q, b.lo, a.lo)) * inverse};
}

/* 1 / sqrt(a), the same bits in all builds: y is that of a.hi, and what follows are
 * the next terms of y (1 - e)^(-1/2), e = 1 - a y^2. */
INLINE vpair vpair_inverse_root(vpair a)
{
    const vd y = v_set(1) / v_sqrt(a.hi);
    const vpair yy = v_two_prod(y, y), ayy = v_two_prod(a.hi, yy.hi);
    const vd e = ((v_set(1) - ayy.hi) - ayy.lo) - (a.hi * yy.lo + a.lo * yy.hi);
    return (vpair){y, y * (e * (v_set(0.5) + v_set(0.375) * e))};
}

/* A number and a bound on its error. */
typedef struct {
    vpair v;
    vd e;
} bounded_pairs;

INLINE bounded_pairs choose_pairs(vm m, bounded_pairs x, bounded_pairs y)
{
    return (bounded_pairs){pick(m, x.v, y.v), v_select(m, x.e, y.e)};
}

/* --------------------------------------------- two numbers a lane ------- */

/*
 * vq: a vector for the first and one for the second numbers.  Narrow, with
 * AVX2, one register of four lanes, which can also be (x, y, z, any).
 * q_sum_of(): x y + z, rounded once or twice.  q_product_error(): of x y.
 */
#if defined(CYLINT_NARROW) && defined(__AVX2__) && defined(__FMA__)
typedef __m256d vq;
static inline vq q_join(vd low, vd high) { return _mm256_set_m128d(high, low); }
static inline vd q_low(vq x) { return _mm256_castpd256_pd128(x); }
static inline vd q_high(vq x) { return _mm256_extractf128_pd(x, 1); }
static inline vq q_add(vq x, vq y) { return _mm256_add_pd(x, y); }
static inline vq q_sub(vq x, vq y) { return _mm256_sub_pd(x, y); }
static inline vq q_mul(vq x, vq y) { return _mm256_mul_pd(x, y); }
static inline vq q_sum_of(vq x, vq y, vq z) { return _mm256_fmadd_pd(x, y, z); }
static inline vq q_product_error(vq x, vq y)
{
    return _mm256_fmsub_pd(x, y, q_mul(x, y));
}
static inline vq q_abs(vq x)
{
    return _mm256_andnot_pd(_mm256_set1_pd(-0.0), x);
}
static inline vq q_set(double x) { return _mm256_set1_pd(x); }
static inline vq q_load(const double *x) { return _mm256_loadu_pd(x); }
static inline void q_store(double *x, vq v) { _mm256_storeu_pd(x, v); }
static inline vq q_spread(vd x) /* (x[0], x[0], x[1], x[1]) */
{
    return _mm256_permute4x64_pd(_mm256_castpd128_pd256(x), 0x50);
}
static inline vq q_firsts(vq x) { return _mm256_permute4x64_pd(x, 0x00); }
static inline vq q_seconds(vq x) { return _mm256_permute4x64_pd(x, 0x55); }
static inline vq q_thirds(vq x) { return _mm256_permute4x64_pd(x, 0xAA); }
#else
typedef struct {
    vd low, high;
} vq;
static inline vq q_join(vd low, vd high) { return (vq){low, high}; }
static inline vd q_low(vq x) { return x.low; }
static inline vd q_high(vq x) { return x.high; }
static inline vq q_add(vq x, vq y)
{
    return q_join(x.low + y.low, x.high + y.high);
}
static inline vq q_sub(vq x, vq y)
{
    return q_join(x.low - y.low, x.high - y.high);
}
static inline vq q_mul(vq x, vq y)
{
    return q_join(x.low * y.low, x.high * y.high);
}
static inline vq q_product_error(vq x, vq y)
{
    return q_join(v_two_prod(x.low, y.low).lo, v_two_prod(x.high, y.high).lo);
}
static inline vq q_sum_of(vq x, vq y, vq z)
{
    return q_join(v_sum_of(x.low, y.low, z.low),
                  v_sum_of(x.high, y.high, z.high));
}
static inline vq q_abs(vq x) { return q_join(v_abs(x.low), v_abs(x.high)); }
#if defined(CYLINT_NARROW) && LANES == 2
static inline vq q_set(double x) { return q_join(v_set(x), v_set(x)); }
static inline vq q_load(const double *x)
{
    return q_join(v_load(x), v_load(x + 2));
}
static inline void q_store(double *x, vq v)
{
    v_store(x, v.low);
    v_store(x + 2, v.high);
}
static inline vq q_spread(vd x)
{
    return q_join(v_firsts(x, x), v_seconds(x, x));
}
static inline vq q_firsts(vq x) { return q_spread(v_firsts(x.low, x.low)); }
static inline vq q_seconds(vq x) { return q_spread(v_seconds(x.low, x.low)); }
static inline vq q_thirds(vq x) { return q_spread(v_firsts(x.high, x.high)); }
#endif
#endif

typedef struct {
    vq hi, lo;
} vqpair;

static inline vqpair q_two_sum(vq a, vq b)
{
    const vq s = q_add(a, b), bb = q_sub(s, a);
    return (vqpair){s, q_add(q_sub(a, q_sub(s, bb)), q_sub(b, bb))};
}

static inline vqpair q_two_diff(vq a, vq b)
{
    const vq s = q_sub(a, b), bb = q_sub(s, a);
    return (vqpair){s, q_sub(q_sub(a, q_sub(s, bb)), q_add(b, bb))};
}

#undef MM
/* clang-format on */
#endif
