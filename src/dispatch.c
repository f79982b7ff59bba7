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
    if (build == CYLINT_BUILD_AVX512)
        return __builtin_cpu_supports("avx512f") &&
               __builtin_cpu_supports("avx512vl") &&
               __builtin_cpu_supports("avx512dq");
    if (build == CYLINT_BUILD_AVX2)
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#endif
    return build == CYLINT_BUILD_PLAIN;
}

/* untaken: it depends on the processor */
static int best(void)
{
    int build = CYLINT_BUILDS - 1;
    while (!runs(build))
        build--;
    return build;
}

/* All threads choose the same build. */
cylint_build cylint_build_chosen = CYLINT_BUILDS;

static int choose_and_answer(const cylint_shape *shape, const cylint_line *line,
                             unsigned want, cylint_answer *answer,
                             cylint_question *question)
{
    cylint_choose_build();
    return cylint_filter_one(cylint_one_used(), shape, line, want, answer,
                             question);
}

/* Nothing to do: choose_and_answer() runs all stages of the chosen build. */
static int is_refined(cylint_question *question)
{
    (void)question;
    return CYLINT_UNDECIDED;
}

static int choose_and_contain(const cylint_shape *shape, const double point[3])
{
    cylint_choose_build();
    return cylint_one_used()->contains[cylint_prepared(shape)](shape, point);
}

/* untaken never called: an answer comes before its members */
static unsigned choose_and_describe(const cylint_shape *shape,
                                    const cylint_line *line, unsigned want,
                                    const cylint_hit *known, cylint_hit *hit)
{
    cylint_choose_build();
    return cylint_one_used()->describe(shape, line, want, known, hit);
}

#define ONE(name, solid) [solid] = choose_and_answer,
#define SIDE(name, solid) [solid] = choose_and_contain,
static const cylint_one_kernels choosing = {
    {ONE(none, CYLINT_SOLID_NONE) CYLINT_EACH_SOLID(ONE)},
    is_refined,
    {SIDE(none, CYLINT_SOLID_NONE) CYLINT_EACH_SOLID(SIDE)},
    choose_and_describe};
const cylint_one_kernels *cylint_one_chosen = &choosing;

#ifdef __GNUC__
#define STORE(x, v) __atomic_store_n(&(x), v, __ATOMIC_RELAXED)
#else
#define STORE(x, v) ((x) = (v))
#endif

static cylint_build choose(int build)
{
    const cylint_one_kernels *one = CYLINT_OF_BUILD(
        build, &cylint_one_plain, &cylint_one_fma, &cylint_one_fma);
    STORE(cylint_one_chosen, one);
    STORE(cylint_build_chosen, (cylint_build)build);
    return (cylint_build)build;
}

cylint_build cylint_choose_build(void)
{
    return choose(best());
}

const char *cylint_kernels_in_use(void)
{
    return names[cylint_build_used()];
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
    for (int build = CYLINT_BUILDS - 1; build >= 0; build--)
        if (name ? strcmp(name, names[build]) == 0 : runs(build)) {
            if (!runs(build))
                return 0;
            choose(build);
            return 1;
        }
    return 0;
}
