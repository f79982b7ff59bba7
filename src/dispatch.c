/*
 * dispatch.c - chooses the build of the kernels for this processor
 */
#include <string.h>

#include "dispatch.h"

static const char *const names[CYLINT_BUILDS] = {"plain", "avx2", "avx512"};

/* __builtin_cpu_supports() tests the processor, and that the operating system
 * saves the registers. */
/* untaken: it depends on the processor */
static int runs(int build)
{
#ifdef CYLINT_BUILDS_X86
    const int avx2 = __builtin_cpu_supports("avx2") &&
                     __builtin_cpu_supports("fma") &&
                     __builtin_cpu_supports("popcnt");
    if (build == CYLINT_BUILD_AVX512)
        return avx2 && __builtin_cpu_supports("avx512f") &&
               __builtin_cpu_supports("avx512vl") &&
               __builtin_cpu_supports("avx512dq");
    if (build == CYLINT_BUILD_AVX2)
        return avx2;
#endif
    return build == CYLINT_BUILD_PLAIN;
}

cylint_build cylint_build_used = CYLINT_BUILD_PLAIN;
const cylint_one_kernels *cylint_one_used = &cylint_one_plain;

#ifdef CYLINT_BUILDS_X86
/* Before the static objects of a C++ program, which may be scenes.  gcc refuses a
 * priority on macOS. */
#ifdef __APPLE__
#define FIRST constructor
#else
#define FIRST constructor(101)
#endif
__attribute__((FIRST)) static void choose_best(void)
{
    __builtin_cpu_init(); /* another constructor may run before libgcc's */
    cylint_use_kernels(NULL);
}
#endif

const char *cylint_kernels_in_use(void)
{
    return names[cylint_build_used];
}

/* untaken: it depends on the processor */
const char *cylint_kernels_name(int number)
{
    for (int build = CYLINT_BUILDS - 1; build >= 0; build--)
        if (runs(build) && number-- == 0)
            return names[build];
    return NULL;
}

/* untaken: it depends on the processor */
int cylint_use_kernels(const char *name)
{
    int build = CYLINT_BUILDS - 1;
    while (build >= 0 &&
           !(runs(build) && (!name || strcmp(name, names[build]) == 0)))
        build--;
    if (build < 0)
        return 0;
    cylint_build_used = (cylint_build)build;
    cylint_one_used = CYLINT_OF_FMA(cylint_one);
    return 1;
}
