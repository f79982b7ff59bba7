/*
 * batch_core.c - the limits of this core: division, square root, reading memory
 */
#include "batch_core.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* CHAINS: enough independent results to hide the latency of a division.
 * STREAMS: the first pass reads several columns at once, and that is faster
 * than reading one stream. */
enum { CHAINS = 10, STREAMS = 7 };

static volatile double kept;

/* The value of each chain stays between 1 and 3 for division and root. */
#define DEFINE_CHAINS(name, attributes, vector, set, first, work)          \
    attributes static void name(int results)                               \
    {                                                                      \
        enum { LANES_HERE = (int)(sizeof(vector) / sizeof(double)) };      \
        const vector c = set(3);                                           \
        vector x0 = set(1.1), x1 = set(1.2), x2 = set(1.3), x3 = set(1.4), \
               x4 = set(1.5), x5 = set(1.6), x6 = set(1.7), x7 = set(1.8), \
               x8 = set(1.9), x9 = set(2.1);                               \
        for (int i = 0; i < results; i += CHAINS * LANES_HERE) {           \
            x0 = work(c, x0), x1 = work(c, x1), x2 = work(c, x2);          \
            x3 = work(c, x3), x4 = work(c, x4), x5 = work(c, x5);          \
            x6 = work(c, x6), x7 = work(c, x7), x8 = work(c, x8);          \
            x9 = work(c, x9);                                              \
        }                                                                  \
        kept = first(x0) + first(x1) + first(x2) + first(x3) + first(x4) + \
               first(x5) + first(x6) + first(x7) + first(x8) + first(x9);  \
    }

#define SCALAR(x) (x)
#define DIVIDE(c, x) ((c) / (x))

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#define AVX __attribute__((target("avx2")))
#define AVX512 __attribute__((target("avx512f")))
#define DIVIDE_128(c, x) _mm_div_pd(c, x)
#define DIVIDE_256(c, x) _mm256_div_pd(c, x)
#define DIVIDE_512(c, x) _mm512_div_pd(c, x)
#define ROOT_128(c, x) _mm_sqrt_pd(_mm_add_pd(c, x))
#define ROOT_256(c, x) _mm256_sqrt_pd(_mm256_add_pd(c, x))
#define ROOT_512(c, x) _mm512_sqrt_pd(_mm512_add_pd(c, x))

DEFINE_CHAINS(divide_128, , __m128d, _mm_set1_pd, _mm_cvtsd_f64, DIVIDE_128)
DEFINE_CHAINS(divide_256, AVX, __m256d, _mm256_set1_pd, _mm256_cvtsd_f64,
              DIVIDE_256)
DEFINE_CHAINS(divide_512, AVX512, __m512d, _mm512_set1_pd, _mm512_cvtsd_f64,
              DIVIDE_512)
DEFINE_CHAINS(root_128, , __m128d, _mm_set1_pd, _mm_cvtsd_f64, ROOT_128)
DEFINE_CHAINS(root_256, AVX, __m256d, _mm256_set1_pd, _mm256_cvtsd_f64,
              ROOT_256)
DEFINE_CHAINS(root_512, AVX512, __m512d, _mm512_set1_pd, _mm512_cvtsd_f64,
              ROOT_512)

typedef void chains(int results);
static chains *const all[][CORE_WORKS] = {
    {divide_128, root_128}, {divide_256, root_256}, {divide_512, root_512}};

int core_width(int number)
{
    if (number == 0)
        return 128;
    if (number == 1)
        return __builtin_cpu_supports("avx2") ? 256 : 0;
    return number == 2 && __builtin_cpu_supports("avx512f") ? 512 : 0;
}

#define LOAD(k)         \
    _mm256_loadu_si256( \
        (const __m256i *)(const void *)(from + (size_t)(k)*part + i))
AVX static uint64_t read_wide(const char *from, size_t part)
{
    __m256i a = _mm256_setzero_si256(), b = a, c = a, d = a;
    for (size_t i = 0; i + sizeof a <= part; i += sizeof a) {
        a = _mm256_xor_si256(a, _mm256_xor_si256(LOAD(0), LOAD(1)));
        b = _mm256_xor_si256(b, _mm256_xor_si256(LOAD(2), LOAD(3)));
        c = _mm256_xor_si256(c, _mm256_xor_si256(LOAD(4), LOAD(5)));
        d = _mm256_xor_si256(d, LOAD(6));
    }
    a = _mm256_xor_si256(_mm256_xor_si256(a, b), _mm256_xor_si256(c, d));
    return (uint64_t)_mm256_extract_epi64(a, 0) ^
           (uint64_t)_mm256_extract_epi64(a, 1) ^
           (uint64_t)_mm256_extract_epi64(a, 2) ^
           (uint64_t)_mm256_extract_epi64(a, 3);
}

#define HAS_WIDE_READ (core_width(1) != 0)

#else

#define SCALAR_ROOT(c, x) sqrt((c) + (x))
DEFINE_CHAINS(divide_64, , double, SCALAR, SCALAR, DIVIDE)
DEFINE_CHAINS(root_64, , double, SCALAR, SCALAR, SCALAR_ROOT)

typedef void chains(int results);
static chains *const all[][CORE_WORKS] = {{divide_64, root_64}};

int core_width(int number)
{
    return number == 0 ? 64 : 0;
}

#define HAS_WIDE_READ 0
#define read_wide read_narrow

#endif

static uint64_t read_narrow(const char *from, size_t part)
{
    uint64_t sum = 0, v;
    for (size_t i = 0; i + sizeof v <= part; i += sizeof v)
        for (size_t k = 0; k < STREAMS; k++) {
            memcpy(&v, from + k * part + i, sizeof v);
            sum ^= v;
        }
    return sum;
}

void core_turn(void *context, const int *order, int n)
{
    const struct core_turn *t = context;
    int number = 0;
    (void)order;
    while (core_width(number) != t->width)
        number++;
    for (int i = 0; i < n; i++)
        all[number][t->work](CORE_RESULTS);
}

void read_turn(void *context, const int *order, int n)
{
    const struct read_turn *t = context;
    const size_t part = t->bytes / STREAMS;
    (void)order;
    for (int i = 0; i < n; i++)
        kept = (double)(HAS_WIDE_READ ? read_wide(t->from, part)
                                      : read_narrow(t->from, part));
}
