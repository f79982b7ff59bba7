/*
 * stages.c - share of questions that reach each stage, by family
 *
 *     stages [CASES]      of each family, default 100000 (make stages)
 *
 * Prints percentages.  A question counts once, at the last stage that it
 * needed: first for the verdict (relation, number and parts of hits), then for
 * the roots.
 *
 *   kernels  the filter: doubles and pairs in lanes
 *   doubles  one sign at a time in doubles, with its own error bound
 *   pairs    pairs of doubles; of a form that is 0, if nothing was lost
 *   exact    exact arithmetic
 *   middle   exact arithmetic on the midpoint of two neighbouring doubles
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "families.h"
#include "roots/roots.h"

enum { KERNELS, FURTHEST = CYLINT_STAGES + 1 };

static const char *const names[FURTHEST] = {"kernels", "doubles", "pairs",
                                            "exact", "middle"};

static int furthest(const struct family_case *c, unsigned want)
{
    cylint_answer answer;
    int stage = CYLINT_STAGES;
    memset(cylint_stages, 0, sizeof cylint_stages);
    cylint_intersect(&c->shape, &c->line, want, &answer);
    while (stage > KERNELS && !cylint_stages[stage - 1])
        stage--;
    return stage;
}

/* Counts both questions about each case of a family; returns how many. */
static double count_family(int family, uint64_t cases, double at[2][FURTHEST])
{
    double counted = 0;
    for (uint64_t i = 0; i < cases; i++) {
        struct family_case c;
        family_case(1, family, i, &c);
        if (c.line_status != CYLINT_OK || c.shape_status != CYLINT_OK)
            continue;
        at[0][furthest(&c, CYLINT_WANT_PART)]++;
        at[1][furthest(&c, CYLINT_WANT_PART | CYLINT_WANT_T)]++;
        counted++;
    }
    return counted;
}

int main(int argc, char **argv)
{
    const uint64_t cases = argc > 1 ? strtoull(argv[1], NULL, 10) : 100000;
    printf("%-28s %39s %39s\n%-28s", "% of questions by last stage", "verdict",
           "roots", "");
    for (int i = 0; i < 2 * FURTHEST; i++)
        printf(" %7s%s", names[i % FURTHEST], i + 1 < 2 * FURTHEST ? "" : "\n");
    for (int family = 0; family < family_count(); family++) {
        double at[2][FURTHEST] = {{0}};
        const double counted = count_family(family, cases, at);
        if (counted == 0)
            continue;
        printf("%-28s", family_name(family));
        for (int i = 0; i < 2 * FURTHEST; i++) {
            const double share = 100 * at[i / FURTHEST][i % FURTHEST] / counted;
            printf(share == 0     ? " %7.0f"
                   : share < 0.01 ? " %7.4f"
                                  : " %7.2f",
                   share);
        }
        putchar('\n');
    }
    return 0;
}
