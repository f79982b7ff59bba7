/*
 * methods.c - time against error: every method, every family
 *
 *     methods [BUILD] [CASES] [SECONDS]
 *
 * Writes CSV: for each class of shapes, family, method and mode the time of a
 * question and the errors of the answers.  CASES questions are compared with
 * the reference; the first 2000 of them are timed, for SECONDS in all for each
 * class of each family.  BUILD is copied into the first column.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "classes.h"
#include "race.h"
#include "statistics.h"

/* TIMED questions fit into the second-level cache. */
enum { TIMED = 2000, CONTESTANTS = 40, ROUNDS = 1000 };

struct event {
    const char *build;
    int class_number, family, n_runners, cases;
    double seconds;
    struct entry entries[CONTESTANTS];
    struct runner runners[CONTESTANTS];
    struct record records[CONTESTANTS];
    struct question questions[TIMED];
    int n_questions;
};

static void choose_runners(struct event *e)
{
    e->n_runners = 0;
    for (const struct contestant *c = contestants(); c->name; c++) {
        const int i = e->n_runners;
        if (i == CONTESTANTS ||
            !contestant_takes(c, &e->questions[0].subject.shape))
            continue;
        e->entries[i] = (struct entry){c, e->questions};
        e->runners[i] =
            (struct runner){contestant_turn, &e->entries[i], {0, 0}};
        e->n_runners++;
    }
}

static void draw_questions(struct event *e)
{
    uint64_t index = 0;
    e->n_questions = 0;
    while (e->n_questions < TIMED &&
           class_question(e->class_number, e->family, &index,
                          &e->questions[e->n_questions]))
        e->n_questions++;
}

static void compare_with_truth(struct event *e)
{
    uint64_t index = 0;
    for (int i = 0; i < e->n_runners; i++)
        record_clear(&e->records[i]);
    if (!truth_known())
        return;
    for (int k = 0; k < e->cases; k++) {
        struct question q;
        struct truth truth;
        if (!class_question(e->class_number, e->family, &index, &q))
            return;
        truth_of(&q.subject.shape, &q.line, &truth);
        for (int i = 0; i < e->n_runners; i++) {
            const struct contestant *c = e->entries[i].contestant;
            cylint_answer answer;
            contestant_answer(c, &q, &answer);
            record_answer(&e->records[i], &truth, c->want, c->only_hit,
                          &answer);
        }
    }
}

static void print_header(void)
{
    printf("build,shapes,family,method,mode,answered_percent,ns,%s,"
           "radii_median,radii_99,radii_max,ulp_median,ulp_99,ulp_max,"
           "wrong_percent,hit_as_miss,miss_as_hit,tangent,along,number,nan,"
           "cases\n",
           timing_cycle_kind());
}

static void print_runner(struct event *e, int i)
{
    const struct contestant *c = e->entries[i].contestant;
    const struct timing least = e->runners[i].least;
    struct record *k = &e->records[i];
    const struct quantiles radii = sample_quantiles(&k->radii);
    const struct quantiles ulps = sample_quantiles(&k->ulps);
    printf("%s,%s,%s,%s,%s,%.1f,%.2f,%.1f,", e->build,
           class_name(e->class_number), family_label(e->family), c->name,
           c->mode, share_answered(c, e->family), least.ns, least.cycles);
    printf("%.3g,%.3g,%.3g,%.3g,%.3g,%.3g,%.4g", radii.median, radii.most99,
           radii.max, ulps.median, ulps.most99, ulps.max,
           record_percent_wrong(k));
    static const enum verdict columns[] = {
        VERDICT_HIT_AS_MISS, VERDICT_MISS_AS_HIT, VERDICT_TANGENT,
        VERDICT_ALONG,       VERDICT_NUMBER,      VERDICT_NAN};
    for (size_t v = 0; v < sizeof columns / sizeof columns[0]; v++)
        printf(",%.4g", record_percent(k, columns[v]));
    printf(",%ld\n", k->answers);
}

static void run(struct event *e)
{
    draw_questions(e);
    if (e->n_questions < TIMED)
        return; /* the family has no such shapes */
    choose_runners(e);
    race(e->runners, e->n_runners, e->n_questions, ROUNDS, e->seconds);
    compare_with_truth(e);
    for (int i = 0; i < e->n_runners; i++)
        print_runner(e, i);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    struct event *e = calloc(1, sizeof *e);
    if (!e)
        return 4;
    e->build = argc > 1 ? argv[1] : "-";
    e->cases = argc > 2 ? atoi(argv[2]) : 100000;
    e->seconds = argc > 3 ? atof(argv[3]) : 1;
    timing_begin();
    print_header();
    for (e->class_number = 0; e->class_number < class_count();
         e->class_number++)
        for (e->family = 0; e->family < family_count(); e->family++)
            run(e);
    for (int i = 0; i < CONTESTANTS; i++) {
        sample_free(&e->records[i].radii);
        sample_free(&e->records[i].ulps);
    }
    free(e);
    return 0;
}
