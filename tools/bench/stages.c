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

struct tally {
    unsigned long long at[FURTHEST];
};

static const char *const names[FURTHEST] = {"kernels", "doubles", "pairs",
                                            "exact", "middle"};

static int furthest(const struct family_case *c, unsigned want)
{
    cylint_answer answer;
    memset(cylint_stages, 0, sizeof cylint_stages);
    cylint_intersect(&c->shape, &c->line, want, &answer);
    for (int stage = CYLINT_STAGES - 1; stage >= 0; stage--) {
        if (cylint_stages[stage] > 0) {
            return 1 + stage;
        }
    }
    return KERNELS;
}

static unsigned long long count_family(int family, unsigned long long cases,
                                       struct tally *verdicts,
                                       struct tally *roots)
{
    unsigned long long counted = 0;
    for (unsigned long long i = 0; i < cases; i++) {
        struct family_case c;
        family_case(1, family, i, &c);
        if (c.line_status == CYLINT_OK && c.shape_status == CYLINT_OK) {
            verdicts->at[furthest(&c, CYLINT_WANT_PART)]++;
            roots->at[furthest(&c, CYLINT_WANT_PART | CYLINT_WANT_T)]++;
            counted++;
        }
    }
    return counted;
}

static void print_tally(const struct tally *tally, unsigned long long counted)
{
    for (int i = 0; i < FURTHEST; i++) {
        const double share = 100 * (double)tally->at[i] / (double)counted;
        if (tally->at[i] == 0) {
            printf(" %7s", "-");
        } else {
            printf(share < 0.01 ? " %7.4f" : " %7.2f", share);
        }
    }
}

static void print_heads(void)
{
    printf("%-28s %39s %39s\n", "% of questions by last stage", "verdict",
           "roots");
    printf("%-28s", "");
    for (int i = 0; i < 2 * FURTHEST; i++) {
        printf(" %7s", names[i % FURTHEST]);
    }
    putchar('\n');
}

int main(int argc, char **argv)
{
    const unsigned long long cases =
        argc > 1 ? strtoull(argv[1], NULL, 10) : 100000;
    print_heads();
    for (int family = 0; family < family_count(); family++) {
        struct tally verdicts = {{0}}, roots = {{0}};
        const unsigned long long counted =
            count_family(family, cases, &verdicts, &roots);
        if (counted > 0) {
            printf("%-28s", family_name(family));
            print_tally(&verdicts, counted);
            print_tally(&roots, counted);
            putchar('\n');
        }
    }
    return 0;
}
