/*
 * avx512.h - runs the AVX-512 kernels on a processor that has only AVX2
 *
 * cross.sh includes it before all files, with EMULATED before those of these
 * kernels: functions of SIMDe then take the places of the intrinsics.  Other
 * instructions run than on a processor with AVX-512, with the same operands in the
 * same order.
 */
#define __builtin_cpu_supports(name) 1

#ifdef EMULATED
#define SIMDE_ENABLE_NATIVE_ALIASES
#include <simde/x86/avx512.h>
#define __AVX512F__ 1
#define __AVX512DQ__ 1

/* SIMDe 0.7.4 does not have it. */
#undef _mm512_shuffle_f64x2
static inline __m512d _mm512_shuffle_f64x2(__m512d x, __m512d y, int pairs)
{
    typedef long long eight __attribute__((vector_size(64)));
    eight at;
    for (int i = 0; i < 8; i++)
        at[i] = (i & 4) * 2 + (pairs >> i / 2 * 2 & 3) * 2 + i % 2;
    return __builtin_shuffle(x, y, at);
}
#endif
