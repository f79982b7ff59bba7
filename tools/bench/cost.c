/*
 * cost.c - time of a question beside the plain and the full quadratic
 *
 *     cost [BUILD] [ROUNDS]
 *
 * Writes CSV.  One row for each shape, work and mode: ns of the plain
 * quadratic, of the full quadratic (cylint --method=quadratic) and of
 * cylint_intersect(), and the ratios of the last to the first two.  BUILD is
 * copied into the first column.
 */
#include <stdio.h>
#include <stdlib.h>

#include "cost_inputs.h"
#include "race.h"

/* Too many for a branch predictor, few enough for the second-level cache.
 * Their order is shuffled in every round. */
enum { QUESTIONS = 2000, MODES = 3, NAMES = 3 };

static const char *const modes[MODES] = {"verdict", "nearest", "both"};

static const struct contestant *contestant(int name, int mode)
{
    static const char *const names[NAMES] = {"plain", "quadratic", "cylint"};
    return contestant_named(names[name], modes[mode]);
}

static void one_work(const char *build, enum cost_shape shape,
                     enum cost_work work, struct question *q, int rounds)
{
    struct runner runners[NAMES * MODES];
    struct entry entries[NAMES * MODES];
    int hits;
    if (!cost_questions(shape, work, q, QUESTIONS, &hits))
        return;
    for (int i = 0; i < NAMES * MODES; i++) {
        entries[i] = (struct entry){contestant(i % NAMES, i / NAMES), q};
        runners[i] = (struct runner){contestant_turn, &entries[i], {0, 0}};
    }
    race(runners, NAMES * MODES, QUESTIONS, rounds, 20);
    for (int m = 0; m < MODES; m++) {
        const double plain = runners[NAMES * m].least.ns;
        const double method = runners[NAMES * m + 1].least.ns;
        const double ours = runners[NAMES * m + 2].least.ns;
        printf("%s,%s,%s,%.1f,%s,%.2f,%.2f,%.2f,%.3f,%.3f\n", build,
               cost_shape_name(shape), cost_work_name(work),
               100.0 * hits / QUESTIONS, modes[m], plain, method, ours,
               ours / plain, ours / method);
    }
    fflush(stdout);
}

int main(int argc, char **argv)
{
    const char *build = argc > 1 ? argv[1] : "-";
    const int rounds = argc > 2 ? atoi(argv[2]) : 200;
    struct question *q = malloc(QUESTIONS * sizeof *q);
    if (!q)
        return 4;
    timing_begin();
    printf("build,shape,work,hits_percent,mode,plain_ns,full_ns,"
           "cylint_ns,over_plain,over_full\n");
    for (int shape = 0; shape < COST_SHAPES; shape++)
        for (int work = 0; work < COST_WORKS; work++)
            one_work(build, (enum cost_shape)shape, (enum cost_work)work, q,
                     rounds);
    free(q);
    return 0;
}
