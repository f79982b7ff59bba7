/*
 * methods.c - time against error: the published methods beside the library
 *
 * Whole lines of the tests' families, both t.  The truth is the library's
 * answer, which the tests compare with an oracle in exact numbers.  A verdict
 * is wrong if the number of hits is.  An error is that of a t along the line,
 * in radii of the shape, of lines with a right verdict.
 */
#include <string.h>

#include "cylint_methods.h"
#include "families.h"
#include "lean.h"
#include "shapes/layout.h"

enum { CASES = 2000, DRAWS = 100 * CASES };

static struct {
    struct lean lean[CASES];
    cylint_shape shape[CASES];
    cylint_line line[CASES];
    cylint_answer truth[CASES];
    double error[2 * CASES]; /* of all t, in radii */
    lean_line *formula;
} in;

/* ----------------------------------------------------------------- input -- */

/* The cases of a family that have this kind, with these ends and whole
 * lines. */
static void draw_cases(int family, family_shape word, cylint_ends ends)
{
    int n = 0;
    for (uint64_t i = 0; i < DRAWS && n < CASES; i++) {
        struct family_case c;
        family_case(1, family, i, &c);
        if (c.shape_word != word ||
            (word == FAMILY_CONE && c.shape_data[3] == c.shape_data[7]))
            continue;
        c.ends = ends;
        for (int j = 0; j < 3 && c.line_word == FAMILY_SEGMENT; j++)
            c.line_data[j + 3] -= c.line_data[j];
        c.line_word = FAMILY_LINE;
        if (!family_make(&c))
            continue;
        lean_prepare(&in.lean[n], &c.shape);
        in.shape[n] = c.shape;
        in.line[n] = c.line;
        cylint_intersect(&c.shape, &c.line, CYLINT_WANT_T, &in.truth[n++]);
    }
    require(n == CASES, "methods: a family has too few cases");
    in.formula = lean_formulas[in.shape[0].kind].line;
}

/* ----------------------------------------------------------------- turns -- */

/* method: NULL stands for the prepared quadratic. */
static void answer_one(cylint_method_fn *method, int i, cylint_answer *a)
{
    double t[2];
    if (method) {
        method(&in.shape[i], &in.line[i], CYLINT_WANT_T, a);
        return;
    }
    const cylint_line *l = &in.line[i];
    a->n = in.formula(&in.lean[i], l->o, l->d, l->tmin, l->tmax, t);
    a->hit[0].t = t[0];
    a->hit[1].t = t[1];
}

static inline int hits_by(const cylint_method *method, int i)
{
    cylint_answer a;
    answer_one(method->answer, i, &a);
    return a.n;
}

BENCH_TURN(by_method, const cylint_method *method = input, hits_by(method, i))
BENCH_TURN(by_library, cylint_answer a,
           cylint_intersect(&in.shape[i], &in.line[i], CYLINT_WANT_T, &a))

/* -------------------------------------------------------------- contests -- */

static void print_errors(const char *subject, const char *family,
                         const cylint_method *method)
{
    int wrong = 0;
    size_t n = 0;
    for (int i = 0; i < CASES; i++) {
        cylint_answer a;
        answer_one(method->answer, i, &a);
        wrong += a.n != in.truth[i].n;
        for (int k = 0; k < a.n && a.n == in.truth[i].n; k++)
            in.error[n++] =
                fabs(a.hit[k].t - in.truth[i].hit[k].t) *
                sqrt(dot3(in.line[i].d, in.line[i].d)) /
                fmax(cylint_r0(&in.shape[i]), cylint_r1(&in.shape[i]));
    }
    qsort(in.error, n, sizeof *in.error, compare_doubles);
    print_figure(subject, family, "wrong", method->name, "%",
                 100.0 * wrong / CASES, 0);
    if (n == 0)
        return;
    print_figure(subject, family, "median error", method->name, "r",
                 in.error[n / 2], 0);
    print_figure(subject, family, "error of 99 %", method->name, "r",
                 in.error[n * 99 / 100], 0);
}

static void compare_methods(const char *subject, const char *family)
{
    static const cylint_method lean = {"prepared quadratic", "", "", NULL};
    const cylint_method *method = cylint_methods();
    for (int is_last = 0; !is_last; method++) {
        cylint_answer a;
        is_last = !method->name;
        const cylint_method *m = is_last ? &lean : method;
        if (m->answer && m->answer(&in.shape[0], &in.line[0], CYLINT_WANT_T,
                                   &a) != CYLINT_OK)
            continue;
        compete(&(struct contest){.subject = subject,
                                  .question = family,
                                  .rival = m->name,
                                  .theirs = by_method,
                                  .ours = by_library,
                                  .input = m,
                                  .questions = CASES,
                                  .only_best_kernels = 1});
        print_errors(subject, family, m);
    }
}

void bench_methods(void)
{
    static const char *const families[] = {"ordinary", "far origin", "grazing",
                                           "nearly parallel"};
    static const struct {
        const char *name;
        family_shape word;
        cylint_ends ends;
    } subjects[] = {
        {"infinite cylinder", FAMILY_CYLINDER, CYLINT_ENDS_INFINITE},
        {"cylinder", FAMILY_CYLINDER, CYLINT_ENDS_CAPPED},
        {"cone", FAMILY_CONE, CYLINT_ENDS_CAPPED}};
    for (int s = 0; s < 3; s++)
        for (int f = 0; f < 4 && is_wanted(subjects[s].name); f++)
            for (int family = 0; family < family_count(); family++)
                if (!strcmp(family_name(family), families[f])) {
                    draw_cases(family, subjects[s].word, subjects[s].ends);
                    compare_methods(subjects[s].name, families[f]);
                }
}
