/*
 * stages.c - share of questions that reach each stage, by family of cases
 *
 * A question counts once, at the last stage that it needed: first for the verdict
 * (relation, number and parts of hits), then for the roots.
 *
 *   kernels  the filter: doubles and pairs in lanes
 *   doubles  one sign at a time in doubles, with its own error bound
 *   pairs    pairs of doubles; of a form that is 0, if nothing was lost
 *   exact    exact arithmetic
 *   middle   exact arithmetic on the midpoint of two neighbouring doubles
 */
#include <string.h>

#include "bench.h"
#include "families.h"
#include "roots/roots.h"

enum { STAGES = CYLINT_STAGES + 1 };

static int last_stage(const struct family_case *c, unsigned want)
{
    cylint_answer answer;
    int stage = CYLINT_STAGES;
    memset(cylint_stages, 0, sizeof cylint_stages);
    cylint_intersect(&c->shape, &c->line, want, &answer);
    while (stage > 0 && !cylint_stages[stage - 1])
        stage--;
    return stage;
}

static void count_family(int family, const char *question, unsigned want)
{
    static const char *const names[STAGES] = {"kernels", "doubles", "pairs",
                                              "exact", "middle"};
    double reached[STAGES] = {0}, all = 0;
    for (uint64_t i = 0; i < (uint64_t)most_or(1e5); i++) {
        struct family_case c;
        family_case(1, family, i, &c);
        if (c.line_status != CYLINT_OK || c.shape_status != CYLINT_OK)
            continue;
        reached[last_stage(&c, want)]++;
        all++;
    }
    for (int i = 0; i < STAGES && all > 0; i++)
        print_figure(family_name(family), question, names[i], NULL, "%", NAN,
                     100 * reached[i] / all);
}

void bench_stages(void)
{
    for (int family = 0; family < family_count(); family++) {
        count_family(family, "verdict", CYLINT_WANT_PART);
        count_family(family, "roots", CYLINT_WANT_PART | CYLINT_WANT_T);
    }
}
