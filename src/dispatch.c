/*
 * dispatch.c - chooses the build of the kernels for this processor
 */
#include <string.h>

#include "dispatch.h"

/* Best first.  The last one runs on every processor. */
static const cylint_kernels builds[] = {
#ifdef CYLINT_BUILDS_X86
    {"avx512", &cylint_one_fma, cylint_many_avx512},
    {"avx2", &cylint_one_fma, cylint_many_avx2},
#endif
    {"plain", &cylint_one_plain, cylint_many_plain},
};

enum { BUILDS = sizeof builds / sizeof builds[0] };

/* __builtin_cpu_supports() tests the processor, and that the operating system
 * saves the registers. */
/* untaken: it depends on the processor */
static int runs(int build)
{
#ifdef CYLINT_BUILDS_X86
    if (build == 0)
        return __builtin_cpu_supports("avx512f") &&
               __builtin_cpu_supports("avx512vl") &&
               __builtin_cpu_supports("avx512dq");
    if (build == 1)
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#endif
    return build == BUILDS - 1;
}

/* untaken: it depends on the processor */
static int best(void)
{
    int build = 0;
    while (!runs(build))
        build++;
    return build;
}

/* NULL until the first use.  All threads choose the same build. */
const cylint_kernels *cylint_kernels_chosen;

static int choose_and_answer(const cylint_shape *shape,
                             const cylint_line *line, unsigned want,
                             cylint_answer *answer, cylint_question *question)
{
    return cylint_filter_one(cylint_choose_kernels()->one, shape, line, want,
                             answer, question);
}

static int is_refined(cylint_question *question)
{
    (void)question;
    return CYLINT_UNDECIDED;
}

#define CHOOSE                               \
    {                                        \
        choose_and_answer, choose_and_answer \
    }
static const cylint_one_kernels choosing = {
    {CHOOSE, CHOOSE, CHOOSE, CHOOSE, CHOOSE, CHOOSE, CHOOSE, CHOOSE, CHOOSE},
    is_refined};
const cylint_one_kernels *cylint_one_chosen = &choosing;

#ifdef __GNUC__
#define STORE(x, v) __atomic_store_n(&(x), v, __ATOMIC_RELAXED)
#else
#define STORE(x, v) ((x) = (v))
#endif

static const cylint_kernels *choose(int build)
{
    STORE(cylint_kernels_chosen, &builds[build]);
    STORE(cylint_one_chosen, builds[build].one);
    return &builds[build];
}

const cylint_kernels *cylint_choose_kernels(void)
{
    return choose(best());
}

const char *cylint_kernels_in_use(void)
{
    return cylint_kernels_used()->name;
}

/* untaken: it depends on the processor */
const char *cylint_kernels_name(int number)
{
    for (int build = 0; build < BUILDS; build++)
        if (runs(build) && number-- == 0)
            return builds[build].name;
    return NULL;
}

/* untaken: it depends on the processor */
int cylint_use_kernels(const char *name)
{
    for (int build = 0; build < BUILDS; build++)
        if (name ? strcmp(name, builds[build].name) == 0 : runs(build)) {
            if (!runs(build))
                return 0;
            choose(build);
            return 1;
        }
    return 0;
}
