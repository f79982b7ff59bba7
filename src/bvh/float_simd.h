/*
 * float_simd.h - vectors of floats, for conservative tests
 *
 * The only header of the bounding volume hierarchy with intrinsics.  vf has the
 * operators + - * / of C; other operations are functions.  WIDTH, the number of
 * lanes, divides 8; with CYLINT_FOUR_LANES it divides 4.  vi holds as many 32-bit
 * integers, vm as many truth values.  PARTS vectors hold three numbers.
 *
 *   f_part(x, k)         part k of three numbers x[]; zeros follow them
 *   f_mad(x, y, z)       x y + z, rounded once or twice: results are used with
 *                        error bounds, so builds may differ
 *   f_lower, f_higher    the lesser or greater of x and y; y if x is NaN
 *   f_flipped(x, y)      -x where the sign of y is set, else x
 *   f_from_bits(x, m)    the integers x & m as floats
 *   f_store_keys(p, x)   stores integers in the order of the floats
 *   i_or_where(x, m, y)  x | y where m, else x
 *   i_keep(p, x, m)      stores those of 8 integers x[] whose bits in m are 1, in
 *                        their order, and zeros up to the second integer at least;
 *                        returns how many.  May write up to 10 integers
 */
#ifndef CYLINT_BVH_FLOAT_SIMD_H
#define CYLINT_BVH_FLOAT_SIMD_H

#include <stdint.h>
#include <string.h>

#include "../numbers/compiler.h"

/* clang-format off */
#if defined(__AVX2__) && defined(__FMA__) && !defined(CYLINT_FOUR_LANES)

#include <immintrin.h>
#define EIGHT_LANES
#define MM(name) _mm256_##name
#define MM_BITS(name) _mm256_##name##_si256
enum { WIDTH = 8 };
typedef __m256 vf;
typedef __m256i vi;
typedef __m256 vm;
static inline vi i_load_shorts(const uint16_t *x)
{
    return _mm256_cvtepu16_epi32(
        _mm_loadu_si128((const __m128i *)(const void *)x));
}
static inline vf f_from_bytes(const uint8_t *x)
{
    const __m128i bytes = _mm_loadl_epi64((const __m128i *)(const void *)x);
    return _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(bytes));
}
static inline vf f_part(const float x[3], int k)
{
    return _mm256_setr_ps(x[k], x[k + 1], x[k + 2], 0, 0, 0, 0, 0);
}
static inline vf f_mad(vf x, vf y, vf z) { return _mm256_fmadd_ps(x, y, z); }
static inline vm m_not_greater(vf x, vf y)
{
    return _mm256_cmp_ps(x, y, _CMP_NGT_UQ);
}
static inline vf m_select(vm m, vf x, vf y)
{
    return _mm256_blendv_ps(y, x, m);
}

#elif defined(__SSE2__)

#include <emmintrin.h>
#define MM(name) _mm_##name
#define MM_BITS(name) _mm_##name##_si128
enum { WIDTH = 4 };
typedef __m128 vf;
typedef __m128i vi;
typedef __m128 vm;
static inline vi i_load_shorts(const uint16_t *x)
{
    return _mm_unpacklo_epi16(
        _mm_loadl_epi64((const __m128i *)(const void *)x), _mm_setzero_si128());
}
static inline vf f_from_bytes(const uint8_t *x)
{
    int32_t four;
    memcpy(&four, x, sizeof four);
    const __m128i zero = _mm_setzero_si128();
    const __m128i s = _mm_unpacklo_epi8(_mm_cvtsi32_si128(four), zero);
    return _mm_cvtepi32_ps(_mm_unpacklo_epi16(s, zero));
}
static inline vf f_part(const float x[3], int k)
{
    return _mm_setr_ps(x[k], x[k + 1], x[k + 2], 0);
}
static inline vf f_mad(vf x, vf y, vf z) { return x * y + z; }
static inline vm m_not_greater(vf x, vf y) { return _mm_cmpngt_ps(x, y); }
static inline vf m_select(vm m, vf x, vf y)
{
    return _mm_or_ps(_mm_and_ps(m, x), _mm_andnot_ps(m, y));
}

#endif

#ifdef MM /* intrinsics that have the same names at both widths */

static inline vf f_set(float x) { return MM(set1_ps)(x); }
static inline vf f_load(const float *x) { return MM(loadu_ps)(x); }
static inline void f_store(float *x, vf v) { MM(storeu_ps)(x, v); }
static inline vi i_set(uint32_t x) { return MM(set1_epi32)((int)x); }
static inline vi i_load(const uint32_t *x)
{
    return MM_BITS(loadu)((const vi *)(const void *)x);
}
static inline void i_store(uint32_t *x, vi v)
{
    MM_BITS(storeu)((vi *)(void *)x, v);
}
static inline vi i_right(vi x, int bits) { return MM(srli_epi32)(x, bits); }
static inline vf f_from_bits(vi x, int mask)
{
    return MM(cvtepi32_ps)(MM_BITS(and)(x, MM(set1_epi32)(mask)));
}
static inline void f_store_keys(uint32_t *x, vf v)
{
    const vi bits = MM_BITS(castps)(v);
    const vi flip =
        MM_BITS(or)(MM(srai_epi32)(bits, 31), MM(set1_epi32)(INT32_MIN));
    i_store(x, MM_BITS(xor)(bits, flip));
}
static inline vf f_lower(vf x, vf y) { return MM(min_ps)(x, y); }
static inline vf f_higher(vf x, vf y) { return MM(max_ps)(x, y); }
static inline vf f_abs(vf x) { return MM(andnot_ps)(MM(set1_ps)(-0.0f), x); }
static inline vf f_flipped(vf x, vf y)
{
    return MM(xor_ps)(x, MM(and_ps)(MM(set1_ps)(-0.0f), y));
}
static inline vf f_sqrt(vf x) { return MM(sqrt_ps)(x); }
static inline unsigned f_bits(vm m) { return (unsigned)MM(movemask_ps)(m); }
static inline vi i_or_where(vi x, vm m, vi y)
{
    return MM_BITS(or)(x, MM_BITS(and)(MM_BITS(castps)(m), y));
}

#else

#include <math.h>
enum { WIDTH = 1 };
typedef float vf;
typedef uint32_t vi;
typedef unsigned vm;
static inline vf f_set(float x) { return x; }
static inline vf f_load(const float *x) { return *x; }
static inline vf f_part(const float x[3], int k) { return x[k]; }
static inline vi i_load(const uint32_t *x) { return *x; }
static inline vi i_load_shorts(const uint16_t *x) { return *x; }
static inline vi i_right(vi x, int bits) { return x >> bits; }
static inline vf f_from_bits(vi x, int mask)
{
    return (float)(x & (uint32_t)mask);
}
static inline vf f_from_bytes(const uint8_t *x) { return (float)*x; }
static inline void f_store(float *x, vf v) { *x = v; }
static inline void f_store_keys(uint32_t *x, vf v)
{
    memcpy(x, &v, sizeof v);
    *x ^= *x >> 31 ? 0xffffffffu : 0x80000000u;
}
static inline vf f_lower(vf x, vf y) { return x < y ? x : y; }
static inline vf f_higher(vf x, vf y) { return x > y ? x : y; }
static inline vf f_mad(vf x, vf y, vf z) { return x * y + z; }
static inline vf f_abs(vf x) { return fabsf(x); }
static inline vf f_flipped(vf x, vf y) { return signbit(y) ? -x : x; }
static inline vf f_sqrt(vf x) { return sqrtf(x); }
static inline vm m_not_greater(vf x, vf y) { return !(x > y); }
static inline unsigned f_bits(vm m) { return m; }
static inline vf m_select(vm m, vf x, vf y) { return m ? x : y; }
static inline vi i_set(uint32_t x) { return x; }
static inline vi i_or_where(vi x, vm m, vi y) { return m ? x | y : x; }
static inline void i_store(uint32_t *x, vi v) { *x = v; }

#endif

enum { PARTS = WIDTH == 1 ? 3 : 1 };

#ifdef EIGHT_LANES
static inline int i_keep_four(uint32_t *to, const uint32_t *x, unsigned bits)
{
    /* which are kept, in four digits */
    static const uint16_t kept[16] = {
        0x0000, 0x0000, 0x0001, 0x0010, 0x0002, 0x0020, 0x0021, 0x0210,
        0x0003, 0x0030, 0x0031, 0x0310, 0x0032, 0x0320, 0x0321, 0x3210};
    const __m128i at = _mm_srlv_epi32(_mm_set1_epi32(kept[bits]),
                                      _mm_setr_epi32(0, 4, 8, 12));
    const __m128 all = _mm_loadu_ps((const float *)(const void *)x);
    _mm_storeu_ps((float *)(void *)to, _mm_permutevar_ps(all, at));
    return _mm_popcnt_u32(bits);
}
static inline int i_keep(uint32_t to[10], const uint32_t x[8], unsigned bits)
{
    int n = i_keep_four(to, x, bits & 15);
    n += i_keep_four(to + n, x + 4, bits >> 4);
    to[n] = to[n + 1] = 0;
    return n;
}
#else
static inline int i_keep(uint32_t to[10], const uint32_t x[8], unsigned bits)
{
    int n = 0;
    EACH_BIT(i, bits)
        to[n++] = x[i];
    to[n] = to[n + 1] = 0;
    return n;
}
#endif

/* The lanes (bits) where x > y is false. */
static inline unsigned f_not_greater(vf x, vf y)
{
    return f_bits(m_not_greater(x, y));
}

#undef MM
#undef MM_BITS
/* clang-format on */
#endif
