/*
 * test_ordinary.c - ordinary input, against the library
 *
 * Each published method agrees with cylint_intersect() on well-conditioned
 * input of its shapes, and returns CYLINT_EMETHOD for all others.  Degenerate
 * input is in test_degenerate.c, misprints are in test_misprints.c.  A case is
 * well-conditioned if the exact answer changes little where the line moves a
 * little.
 */
#include <math.h>

#include "method_cases.h"
#include "random.h"
#include "same.h"

enum { CASES = 30000, FEWEST = 100 };

static cylint_answer exact(const struct family_case *c)
{
    cylint_answer a;
    cylint_line line = c->line;
    if (line.segment) /* the methods read the rounded direction */
        cylint_span(&line, c->line.o, c->line.d, c->line.tmin, c->line.tmax);
    cylint_intersect(&c->shape, &line, CYLINT_WANT_ALL, &a);
    return a;
}

/* The apex of a cone is then so far away that planes through it are inaccurate. */
static int is_nearly_constant(const struct family_case *c)
{
    const double *x = c->shape_data;
    return (c->shape_word == FAMILY_CONE &&
            fabs(x[3] - x[7]) < 0.1 * fmax(x[3], x[7])) ||
           (c->shape_word == FAMILY_ECONE && fabs(x[12] - 1) < 0.1);
}

/* Whether the answers for lines moved by 1e-4 have the same hits, moved by less
 * than 1e-2. */
static int is_well_conditioned(const struct family_case *c,
                               const cylint_answer *want)
{
    for (int i = 0; i < 12; i++) {
        struct family_case moved = *c;
        double *x = i < 6 ? moved.line.o : moved.line.d;
        x[i / 2 % 3] += (i % 2 ? 1e-4 : -1e-4) * (i < 6 ? 1 : c->line.size);
        moved.line.segment = 0;
        memset(moved.line.d_lo, 0, sizeof moved.line.d_lo);
        const cylint_answer a = exact(&moved);
        if (a.relation != want->relation || a.n != want->n ||
            a.relation == CYLINT_RELATION_TOUCH)
            return 0;
        for (int k = 0; k < a.n; k++)
            if (a.hit[k].part != want->hit[k].part ||
                a.hit[k].side != want->hit[k].side ||
                fabs(a.hit[k].t - want->hit[k].t) >
                    1e-2 * (1 + fabs(want->hit[k].t)))
                return 0;
    }
    return 1;
}

TEST(every_method_agrees_with_the_library_or_refuses_the_shape)
{
    enum { KINDS = 1 + CYLINT_KIND_ECONE, ENDS = 1 + CYLINT_ENDS_NAPPE };
    int compared[KINDS][ENDS] = {{0}}, hits = 0;
    double worst = 0;
    for (uint64_t i = 0; i < CASES; i++) {
        struct family_case c;
        family_case(20240229, 0, i, &c);
        c.ends = (cylint_ends)(i % ENDS);
        family_make(&c);
        const cylint_answer want = exact(&c);
        if (is_nearly_constant(&c) || !is_well_conditioned(&c, &want))
            continue;
        compared[c.shape.kind][c.ends]++;
        hits += want.n;
        for (const cylint_method *m = cylint_methods(); m->name; m++) {
            cylint_answer got;
            const cylint_status status =
                m->answer(&c.shape, &c.line, CYLINT_WANT_ALL, &got);
            if (!answers_for(m->name, c.shape.kind, (int)c.ends)) {
                CHECK(status == CYLINT_EMETHOD &&
                      got.relation == CYLINT_RELATION_MISS && got.n == 0 &&
                      got.flags == CYLINT_FLAG_INVALID);
                continue;
            }
            if (!CHECK(status == CYLINT_OK &&
                       agrees(&got, &want, 1e-9, &worst)))
                report_answers(&c, m->name, &got, &want);
        }
    }
    for (int kind = CYLINT_KIND_CYLINDER; kind < KINDS; kind++)
        for (int ends = 0; ends < ENDS; ends++)
            if (!CHECK(compared[kind][ends] > FEWEST))
                REPORT("kind %d, ends %d: %d compared", kind, ends,
                       compared[kind][ends]);
    CHECK(hits > CASES / 8);
    printf("note: t within %.1e of the library's\n", worst);
}

TEST(refused_shapes_and_lines_miss_with_the_flag)
{
    const double o[3] = {0, 0, 0}, up[3] = {0, 0, 1}, x[3] = {1, 0, 0};
    cylint_shape good, cone, half_space, bad;
    cylint_line line, no_line;
    cylint_answer answer;
    cylint_cylinder(&good, o, up, 1, CYLINT_ENDS_INFINITE);
    cylint_tangent_cone(&cone, o, up, 1, CYLINT_ENDS_INFINITE);
    CHECK(cylint_halfspace(&half_space, o, up) == CYLINT_OK);
    CHECK(cylint_cylinder(&bad, o, o, 1, CYLINT_ENDS_INFINITE) == CYLINT_EAXIS);
    cylint_whole_line(&line, o, x);
    CHECK(cylint_whole_line(&no_line, o, o) == CYLINT_EDIRECTION);
    for (const cylint_method *m = cylint_methods(); m->name; m++) {
        const cylint_shape *shape =
            answers_for(m->name, CYLINT_KIND_CYLINDER, CYLINT_ENDS_INFINITE)
                ? &good
                : &cone;
        CHECK(m->answer(shape, &no_line, CYLINT_WANT_ALL, &answer) ==
                  CYLINT_OK &&
              answer.relation == CYLINT_RELATION_MISS && answer.n == 0 &&
              answer.flags == CYLINT_FLAG_INVALID);
        for (int i = 0; i < 2; i++)
            CHECK(m->answer(i ? &half_space : &bad, &line, CYLINT_WANT_ALL,
                            &answer) == CYLINT_EMETHOD &&
                  answer.flags == CYLINT_FLAG_INVALID && answer.n == 0);
    }
}

TEST(the_table_names_each_method_once)
{
    int n = 0;
    for (const cylint_method *m = cylint_methods(); m->name; m++, n++) {
        CHECK(m->answer && m->source[0] && m->shapes[0]);
        for (const cylint_method *k = cylint_methods(); k != m; k++)
            CHECK(strcmp(k->name, m->name) && k->answer != m->answer);
    }
    CHECK(n == 6);
}
