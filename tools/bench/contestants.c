/*
 * contestants.c - the table of contestants and the loops that time them
 */
#include "contestants.h"
#include "../../src/shapes/layout.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void prepare_subject(struct subject *s)
{
    const double *w = cylint_axis(&s->shape), r0 = cylint_r0(&s->shape);
    s->axis_axis = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    s->radius = r0 * s->axis_axis;
    if (s->shape.kind == CYLINT_KIND_CYLINDER)
        s->radius *= r0;
}

#define T CYLINT_WANT_T
#define NEAREST (CYLINT_WANT_T | CYLINT_WANT_NEAREST)

#define IN_THREE_MODES(name, answer, answers_for)                 \
    {name, "verdict", answer, answers_for, CYLINT_WANT_COUNT, 0}, \
        {name, "nearest", answer, answers_for, NEAREST, 0},       \
    {                                                             \
        name, "both", answer, answers_for, T, 0                   \
    }

static const struct contestant table[] = {
    IN_THREE_MODES("cylint", NULL, NULL),
    {"cylint", "all", NULL, NULL, CYLINT_WANT_ALL, 0},
    IN_THREE_MODES("shene-cylinder", cylint_shene_cylinder, NULL),
    IN_THREE_MODES("shene-cone", cylint_shene_cone, NULL),
    IN_THREE_MODES("gullotti", cylint_gullotti, NULL),
    IN_THREE_MODES("closest-points", cylint_closest_points, NULL),
    IN_THREE_MODES("quadratic", cylint_quadratic, NULL),
    IN_THREE_MODES("cychosz-waggenspack", cylint_cychosz_waggenspack, NULL),
    IN_THREE_MODES("plain", plain_quadratic, plain_answers_for),
    {"shader", "nearest", shader_cylinder, shader_answers_for, NEAREST, 1},
#ifdef HAVE_GSL
    IN_THREE_MODES("gsl", gsl_quadratic, NULL),
#endif
    {NULL, NULL, NULL, NULL, 0, 0}};

const struct contestant *contestants(void)
{
    return table;
}

const struct contestant *contestant_named(const char *name, const char *mode)
{
    for (const struct contestant *c = table; c->name; c++)
        if (!strcmp(c->name, name) && !strcmp(c->mode, mode))
            return c;
    fprintf(stderr, "bench: no contestant '%s' in mode '%s'\n", name, mode);
    exit(2);
}

int contestant_takes(const struct contestant *c, const cylint_shape *shape)
{
    static const double o[3] = {0, 0, 0}, d[3] = {1, 0, 0};
    cylint_line line;
    cylint_answer answer;

    if (!c->answer)
        return 1;
    if (c->answers_for)
        return c->answers_for(shape);
    cylint_whole_line(&line, o, d);
    struct question q = {{*shape, 0, 0}, line};
    prepare_subject(&q.subject);
    return c->answer(&q.subject.shape, &line, c->want, &answer) == CYLINT_OK;
}

void contestant_answer(const struct contestant *c, const struct question *q,
                       cylint_answer *answer)
{
    if (c->answer)
        c->answer(&q->subject.shape, &q->line, c->want, answer);
    else
        cylint_intersect(&q->subject.shape, &q->line, c->want, answer);
}

void contestant_turn(void *entry, const int *order, int n)
{
    const struct entry *e = entry;
    const struct question *all = e->questions;
    const unsigned want = e->contestant->want;
    cylint_method_fn *const method = e->contestant->answer;
    cylint_answer answer;

    if (method) {
        for (int i = 0; i < n; i++) {
            const struct question *q = &all[order[i]];
            method(&q->subject.shape, &q->line, want, &answer);
        }
    } else {
        for (int i = 0; i < n; i++) {
            const struct question *q = &all[order[i]];
            cylint_intersect(&q->subject.shape, &q->line, want, &answer);
        }
    }
}
