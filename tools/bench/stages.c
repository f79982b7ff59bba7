/*
 * stages.c - how far questions must go to be answered, family by family
 *
 *     stages [CASES]      of each family, 100000 if not said; `make stages`
 *
 * Every question counts once, at the furthest arithmetic that it needed, in
 * per cent: first for the verdict (relation, number and parts), then for the
 * roots that belong to it.
 *
 *   kernels  straight-line code in doubles and pairs, all that vectors do
 *   doubles  a sign at a time, each with its own bound
 *   grid     a form that may be 0, but nothing in it was rounded
 *   pairs    pairs of doubles
 *   exact    every digit
 *   middle   every digit, of the equation between two neighbouring doubles
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

static const char *const names[FURTHEST] = {"kernels", "doubles", "grid",
                                            "pairs",   "exact",   "middle"};

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
    unsigned long long asked = 0;
    for (unsigned long long i = 0; i < cases; i++) {
        struct family_case c;
        family_case(1, family, i, &c);
        if (c.line_status == CYLINT_OK && c.shape_status == CYLINT_OK) {
            verdicts->at[furthest(&c, CYLINT_WANT_PART)]++;
            roots->at[furthest(&c, CYLINT_WANT_PART | CYLINT_WANT_T)]++;
            asked++;
        }
    }
    return asked;
}

static void print_tally(const struct tally *tally, unsigned long long asked)
{
    for (int i = 0; i < FURTHEST; i++) {
        const double share = 100 * (double)tally->at[i] / (double)asked;
        if (tally->at[i] == 0) {
            printf(" %7s", "-");
        } else {
            printf(share < 0.01 ? " %7.4f" : " %7.2f", share);
        }
    }
}

static void print_heads(void)
{
    printf("%-28s %47s %47s\n", "% of questions", "verdict", "roots");
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
        const unsigned long long asked =
            count_family(family, cases, &verdicts, &roots);
        if (asked > 0) {
            printf("%-28s", family_name(family));
            print_tally(&verdicts, asked);
            print_tally(&roots, asked);
            putchar('\n');
        }
    }
    return 0;
}
