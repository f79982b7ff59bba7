/*
 * batch_cases.c - races over pairs of lines and shapes: families and drawings
 *
 * The cases are in many small batches.  Their order is shuffled, so that the
 * processor cannot memorise the outcomes of the branches.
 */
#include <stdio.h>
#include <stdlib.h>

#include "batch_parts.h"
#include "classes.h"
#include "cost_inputs.h"
#include "filter/filter.h"

enum {
    BATCHES = 16,
    PAIRED = 256,
    CASES = BATCHES * PAIRED,
    ROUNDS = 1000,
    SEED = 1
};

struct cases {
    const char *part, *shapes;
    struct scene scenes[BATCHES];
    int has_plain;
    double hits, undecided;
};

/* What answers the cases: a build of the kernels, or one by one the plain
 * quadratic or cylint_intersect(). */
struct case_turn {
    const struct cases *cases;
    const char *kernels; /* NULL: one by one */
    int plain;
};

static void paired_turn(void *context, const int *order, int n)
{
    const struct case_turn *t = context;
    cylint_use_kernels(t->kernels);
    for (int k = 0; k < n; k++) {
        const struct scene *s = &t->cases->scenes[order[k]];
        const struct turn pairs = {s, s->lines, t->kernels, PAIRS, QUERY_BOTH};
        const int first = 0;
        if (t->kernels || t->plain) {
            batch_turn((void *)(uintptr_t)&pairs, &first, 1);
            continue;
        }
        for (size_t i = 0; i < PAIRED; i++) {
            cylint_answer answer;
            cylint_intersect(&s->shapes[i], &s->lines[i], CYLINT_WANT_T,
                             &answer);
            s->n[i] = (signed char)answer.n;
            s->t[0][i] = answer.n > 0 ? answer.hit[0].t : NAN;
            s->t[1][i] = answer.n > 1 ? answer.hit[1].t : NAN;
        }
    }
}

static int decided(const cylint_shape *shape, const cylint_line *line)
{
    cylint_answer answer;
    cylint_question question;
    return cylint_filter_one(&cylint_one_plain, shape, line, CYLINT_WANT_T,
                             &answer, &question) != CYLINT_UNDECIDED;
}

static void finish(struct cases *c)
{
    long hits = 0, undecided = 0;
    for (int k = 0; k < BATCHES; k++) {
        struct scene *s = &c->scenes[k];
        scene_finish(s, 1);
        for (size_t i = 0; i < PAIRED; i++) {
            cylint_answer answer;
            hits += cylint_intersect(&s->shapes[i], &s->lines[i],
                                     CYLINT_WANT_COUNT, &answer) > 0;
            undecided += !decided(&s->shapes[i], &s->lines[i]);
        }
    }
    c->hits = 100.0 * (double)hits / CASES;
    c->undecided = 100.0 * (double)undecided / CASES;
}

static void measure(struct cases *c, double seconds)
{
    struct case_turn turns[16];
    struct runner runners[16];
    const int kernels = kernels_count();
    for (int i = 0; i < kernels + 2; i++) {
        turns[i] = (struct case_turn){
            c, i < kernels ? cylint_kernels_name(i) : NULL, i > kernels};
        runners[i] = (struct runner){paired_turn, &turns[i], {0, 0}};
    }
    race(runners, kernels + 1 + c->has_plain, BATCHES, ROUNDS, seconds);
    for (int i = 0; i < kernels; i++) {
        struct row r = no_row;
        r.part = c->part;
        r.kernels = cylint_kernels_name(i);
        r.shapes = c->shapes;
        r.arrangement = arrangement_name(PAIRS);
        r.query = query_name(QUERY_BOTH);
        r.n = PAIRED;
        r.hits = c->hits;
        r.undecided = c->undecided;
        r.ns = runners[i].least.ns / PAIRED;
        r.single = runners[kernels].least.ns / PAIRED;
        if (c->has_plain)
            r.plain = runners[kernels + 1].least.ns / PAIRED;
        print_row(&r);
    }
    fflush(stdout);
}

static struct cases *cases_allocate(void)
{
    struct cases *c = malloc(sizeof *c);
    if (!c) {
        fputs("bench: out of memory\n", stderr);
        exit(4);
    }
    for (int k = 0; k < BATCHES; k++)
        scene_allocate(&c->scenes[k], PAIRED, PAIRED);
    return c;
}

static void cases_free(struct cases *c)
{
    for (int k = 0; k < BATCHES; k++)
        scene_free(&c->scenes[k]);
    free(c);
}

/* The line without low parts, as a batch reads it: a segment's direction is
 * rounded. */
static int plain_line(cylint_line *to, const cylint_line *l)
{
    return cylint_span(to, l->o, l->d, l->tmin, l->tmax) == CYLINT_OK;
}

static void draw_family(struct cases *c, int family)
{
    uint64_t index = 0;
    for (int i = 0; i < CASES;) {
        struct scene *s = &c->scenes[i / PAIRED];
        struct family_case k;
        family_case(SEED, family, index++, &k);
        if (k.shape_status != CYLINT_OK || k.line_status != CYLINT_OK ||
            !plain_line(&s->lines[i % PAIRED], &k.line))
            continue;
        s->shapes[i % PAIRED] = k.shape;
        i++;
    }
    finish(c);
}

void measure_families(double seconds)
{
    struct cases *c = cases_allocate();
    c->part = "families";
    c->has_plain = 0;
    for (int family = 0; family < family_count(); family++) {
        c->shapes = family_label(family);
        draw_family(c, family);
        measure(c, seconds);
    }
    cases_free(c);
}

/* Fills the cases with questions of a drawing; tangents: only tangent lines. */
static int draw_grid(struct cases *c, enum cost_shape shape, struct question *q,
                     int n, int tangents)
{
    int hits, i = 0;
    if (!cost_questions(shape, COST_GRID, q, n, &hits))
        return 0;
    for (int k = 0; k < n && i < CASES; k++) {
        struct scene *s = &c->scenes[i / PAIRED];
        cylint_answer answer;
        cylint_intersect(&q[k].subject.shape, &q[k].line, CYLINT_WANT_COUNT,
                         &answer);
        if (tangents && answer.relation != CYLINT_RELATION_TOUCH)
            continue;
        s->shapes[i % PAIRED] = q[k].subject.shape;
        s->lines[i % PAIRED] = q[k].line;
        i++;
    }
    if (i == CASES)
        finish(c);
    return i == CASES;
}

void measure_drawings(double seconds)
{
    static const char *const names[] = {
        "cylinder: integer grid", "cylinder: exact tangents",
        "cone: integer grid", "cone: exact tangents"};
    enum { MANY = 60 * CASES };
    struct question *q = malloc(MANY * sizeof *q);
    struct cases *c = cases_allocate();
    c->part = "drawing";
    c->has_plain = 1;
    for (int i = 0; q && i < 4; i++) {
        const enum cost_shape shape =
            i < 2 ? COST_CYLINDER_CAPPED : COST_CONE_CAPPED;
        c->shapes = names[i];
        if (draw_grid(c, shape, q, i % 2 ? MANY : CASES, i % 2))
            measure(c, seconds);
    }
    free(q);
    cases_free(c);
}
