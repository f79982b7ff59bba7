/*
 * test_methods.c - the published methods, against the library
 *
 * Each method agrees with cylint_intersect() on well-conditioned input of its
 * shapes, and returns CYLINT_EMETHOD for all others.  A case is well-conditioned if
 * the exact answer changes little where the line moves a little.  On degenerate
 * input that doubles represent exactly (degenerate.txt) the methods keep the
 * contract: tangents, rims, lines along a ruling, in a cap's plane or through an
 * apex, and where the print of a method is wrong or leaves out a case.
 */
#include <errno.h>
#include <math.h>
#include <string.h>

#include "check.h"
#include "cylint_methods.h"
#include "records.h"
#include "same.h"
#include "vectors.h"

enum { CASES = 30000, FEWEST = 100 };

/* Whether the method is published for the kind and ends. */
static int answers_for(const char *name, int kind, int ends)
{
    const int unbounded =
        ends == CYLINT_ENDS_INFINITE || ends == CYLINT_ENDS_NAPPE;

    if (!strcmp(name, "quadratic"))
        return 1;
    if (!strcmp(name, "shene-cylinder"))
        return kind == CYLINT_KIND_CYLINDER && unbounded;
    if (!strcmp(name, "shene-cone"))
        return (kind == CYLINT_KIND_ACONE || kind == CYLINT_KIND_CONE) &&
               ends == CYLINT_ENDS_INFINITE;
    if (!strcmp(name, "gullotti"))
        return kind == CYLINT_KIND_CYLINDER || kind == CYLINT_KIND_ECYLINDER;
    return kind == CYLINT_KIND_CYLINDER;
}

/* Whether the answers are the same and their numbers within `error`.  phi jumps
 * from 1 to 0.  Writes the largest difference of t to *worst if it is larger. */
static int agrees(const cylint_answer *got, const cylint_answer *want,
                  double error, double *worst)
{
    int good =
        got->relation == want->relation && got->n == want->n && !got->flags;
    for (int i = 0; i < want->n && good; i++) {
        const cylint_hit *g = &got->hit[i], *w = &want->hit[i];
        const double turned = fabs(g->phi - w->phi);
        good = g->part == w->part && g->side == w->side &&
               fabs(g->t - w->t) <= error && fabs(g->z - w->z) <= error &&
               (turned <= error || 1 - turned <= error) && g->phi >= 0 &&
               g->phi < 1;
        for (int j = 0; j < 3; j++)
            good = good && fabs(g->point[j] - w->point[j]) <= error &&
                   fabs(g->normal[j] - w->normal[j]) <= error;
        *worst = fmax(*worst, fabs(g->t - w->t));
    }
    return good;
}

/* ------------------------------------------------------------- ordinary -- */

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

/* ----------------------------------------------------------- degenerate -- */

/* The library as a method: the expected answers are checked against it too. */
static cylint_status intersect(const cylint_shape *shape,
                               const cylint_line *line, unsigned want,
                               cylint_answer *answer)
{
    cylint_intersect(shape, line, want, answer);
    return CYLINT_OK;
}

static const cylint_method the_library = {"intersect", "", "", intersect};

/* want: relation, n, t and part. */
static void check_method(const cylint_method *m, const struct family_case *c,
                         const cylint_answer *want)
{
    cylint_answer a, library;
    double worst = 0;
    cylint_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &library);
    CHECK(m->answer(&c->shape, &c->line, CYLINT_WANT_ALL, &a) == CYLINT_OK);
    int good = a.relation == want->relation && a.n == want->n &&
               agrees(&a, &library, 1e-12, &worst);
    for (int i = 0; good && i < a.n; i++)
        good = a.hit[i].part == want->hit[i].part &&
               fabs(a.hit[i].t - want->hit[i].t) <= 1e-12;
    if (!CHECK(good)) {
        REPORT_CASE(c);
        REPORT("--method=%s: %s n %d t %a %a, expected %s %d %a %a", m->name,
               relation_word(a.relation), a.n, a.hit[0].t, a.hit[1].t,
               relation_word(want->relation), want->n, want->hit[0].t,
               want->hit[1].t);
    }
}

/* methods: "all", or their names. */
static void check_methods(const struct family_case *c,
                          const cylint_answer *want, const char *methods)
{
    check_method(&the_library, c, want);
    for (const cylint_method *m = cylint_methods(); m->name; m++)
        if ((strstr(methods, "all") || strstr(methods, m->name)) &&
            answers_for(m->name, c->shape.kind, (int)c->shape.ends))
            check_method(m, c, want);
}

/* Also at four times the size, where t is the same, and a cone with the apex at its
 * base by its tangent. */
static const char *check_record(const char *text, const char *known)
{
    struct family_case c;
    cylint_answer want = {0};
    if (!family_parse(text, &c) || !(known = read_relation(known, &want)))
        return NULL;
    for (int i = 0; i < want.n && known; i++) {
        double x[2] = {0};
        known = family_numbers(known, 2, x);
        want.hit[i].t = x[0];
        want.hit[i].part = (int)x[1];
    }
    for (int times = 0; times < 2 && known; times++) {
        check_methods(&c, &want, known);
        const double *x = c.shape_data;
        if (c.shape_word == FAMILY_CONE && x[3] == 0) {
            struct family_case by_tangent = c;
            cylint_tangent_cone(&by_tangent.shape, x, x + 4, x[7] / x[6],
                                c.ends);
            check_methods(&by_tangent, &want, known);
        }
        for (int i = 0; i < 6; i++)
            c.line_data[i] *= 4;
        for (int i = 0; i < family_lengths(c.shape_word); i++)
            c.shape_data[i] *= 4;
        family_make(&c);
    }
    return known ? known + strlen(known) : NULL;
}

TEST(the_methods_keep_the_contract)
{
    each_record("tests/methods/degenerate.txt", 85, check_record);
}

/* Lines aimed at the apex miss it by an ulp or two.  Whatever the quadratic
 * computes, no hit is on the absent cap. */
TEST(a_pointed_end_is_never_hit_as_a_cap)
{
    const double apex[3] = {1, 2, 3};
    const cylint_shape down = shape_of("cone 1 2 3 0  2 4 7 2"),
                       up = shape_of("cone 2 4 7 2  1 2 3 0");
    cylint_answer a;
    int hits = 0;
    for (int i = 1; i < 1000; i++) {
        const double d[3] = {1 + i / 7.0, 2 - i / 300.0, 4 + i / 11.0};
        double o[3];
        cylint_line line;
        along3(o, apex, -i / 3.0, d);
        cylint_whole_line(&line, o, d);
        cylint_quadratic(&down, &line, CYLINT_WANT_ALL, &a);
        for (int k = 0; k < a.n; k++, hits++)
            CHECK(a.hit[k].part != CYLINT_PART_CAP0);
        cylint_quadratic(&up, &line, CYLINT_WANT_ALL, &a);
        for (int k = 0; k < a.n; k++, hits++)
            CHECK(a.hit[k].part != CYLINT_PART_CAP1);
    }
    CHECK(hits > 500);
}

/* Products of the direction underflow, so that in doubles no ruling is met. */
TEST(a_line_that_meets_no_ruling_in_doubles_misses)
{
    const struct family_case c = case_of(
        "ray 0x1p734 -0x1.4p-1 -0x1p-1074 -0x1.8p-1021 -0x1p-2 -0x1p-1021"
        " acone 0x1.fffffffffffffp1023 0x1.8p-1 0x1p-1"
        " 0x1.8p-1022 0x1.cp-1 -0x1p-1023 0x1p-3 ends=infinite");
    cylint_answer a;
    CHECK(cylint_shene_cone(&c.shape, &c.line, CYLINT_WANT_ALL, &a) ==
              CYLINT_OK &&
          a.relation == CYLINT_RELATION_MISS && a.n == 0);
}

/* A member wanted alone has the value that it has when all are wanted, and no other
 * is written. */
TEST(each_member_is_written_by_itself)
{
    static const unsigned wants[] = {
        CYLINT_WANT_COUNT,  CYLINT_WANT_T,
        CYLINT_WANT_PART,   CYLINT_WANT_POINT,
        CYLINT_WANT_NORMAL, CYLINT_WANT_Z,
        CYLINT_WANT_PHI,    CYLINT_WANT_T | CYLINT_WANT_NEAREST};
    const struct family_case c =
        case_of("line -3 0.6 0.5 1 0 0  cone 0 0 0 1 0 0 2 1.5");
    cylint_answer all, want, a;
    cylint_quadratic(&c.shape, &c.line, CYLINT_WANT_ALL, &all);
    CHECK(all.relation == CYLINT_RELATION_CROSS && all.n == 2);
    for (size_t i = 0; i < sizeof wants / sizeof *wants; i++) {
        memset(&a, UNTOUCHED, sizeof a);
        want.n = wants[i] & CYLINT_WANT_NEAREST ? 1 : 2;
        for (int k = 0; k < 2; k++)
            want.hit[k] = with_members(&all.hit[k], k < want.n ? wants[i] : 0);
        cylint_quadratic(&c.shape, &c.line, wants[i], &a);
        CHECK(a.relation == all.relation && a.n == want.n &&
              same_bytes(a.hit, want.hit, sizeof a.hit));
    }
}

/* Square roots of negative numbers and angles that underflow set errno in some C
 * libraries. */
TEST(methods_do_not_change_errno)
{
    EACH_CASE(c, 20240229, 400) {
        c.ends = number % 2 ? CYLINT_ENDS_INFINITE : c.ends;
        family_make(&c);
        for (const cylint_method *m = cylint_methods(); m->name; m++) {
            cylint_answer a;
            errno = 0;
            m->answer(&c.shape, &c.line, CYLINT_WANT_ALL, &a);
            if (!CHECK(errno == 0)) {
                REPORT("--method=%s: errno %d", m->name, errno);
                REPORT_CASE(&c);
            }
        }
    }
}
