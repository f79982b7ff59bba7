/*
 * batch_turns.c - the queries of a batch, and the turns that answer them
 */
#include "batch_turns.h"
#include "../../src/shapes/measure.h"

#include <math.h>

#ifdef __GNUC__
#define INLINE static inline __attribute__((always_inline))
#else
#define INLINE static inline
#endif

static const char *const arrangement_names[] = {"one line", "one shape",
                                                "pairs"};
static const char *const query_names[] = {"count",     "any",     "nearest",
                                          "relations", "first t", "both t"};

const char *arrangement_name(enum arrangement arrangement)
{
    return arrangement_names[arrangement];
}

const char *query_name(enum query query)
{
    return query_names[query];
}

int kernels_count(void)
{
    int n = 0;
    while (cylint_kernels_name(n))
        n++;
    return n;
}

size_t turn_tests(const struct turn *t)
{
    return t->arrangement == ONE_SHAPE ? t->scene->n_lines : t->scene->n_shapes;
}

/* The shape and the line of test i of question k. */
INLINE size_t shape_of(enum arrangement a, size_t i, size_t k)
{
    return a == ONE_SHAPE ? k : i;
}

INLINE size_t line_of(enum arrangement a, size_t i, size_t k)
{
    return a == ONE_LINE ? k : a == ONE_SHAPE ? i : i + k;
}

/* Stores results, so that the compiler keeps their computation. */
static volatile size_t sink;

/* By the rival that the scene has. */
INLINE void rival(const struct turn *t, size_t shape, size_t line,
                  unsigned want, cylint_answer *answer)
{
    const struct scene *s = t->scene;
    const cylint_line *l = &t->lines[line];
    double at[2];
    if (!s->formula) {
        plain_quadratic(&s->subjects[shape].shape, l, want, answer);
        return;
    }
    answer->n = s->formula(&s->lean[shape], l->o, l->d, l->tmin, l->tmax, at);
    answer->relation = CYLINT_RELATION_MISS;
    if (answer->n == 0)
        return;
    answer->relation = CYLINT_RELATION_CROSS;
    answer->hit[0].t = at[2 - answer->n];
    answer->hit[1].t = at[1];
}

/* Each call with constant arguments compiles to a loop of its own. */
INLINE void plain_loop(const struct turn *t, size_t k, enum arrangement a,
                       enum query query)
{
    static const unsigned wants[QUERIES] = {
        [QUERY_NEAREST] = CYLINT_WANT_T | CYLINT_WANT_NEAREST,
        [QUERY_FIRST] = CYLINT_WANT_T | CYLINT_WANT_NEAREST,
        [QUERY_BOTH] = CYLINT_WANT_T};
    const struct scene *s = t->scene;
    const size_t n = turn_tests(t);
    size_t found = n, count = 0;
    double nearest = HUGE_VAL;
    for (size_t i = 0; i < n; i++) {
        cylint_answer answer;
        rival(t, shape_of(a, i, k), line_of(a, i, k), wants[query], &answer);
        if (query == QUERY_RELATIONS)
            s->relation[i] = (signed char)answer.relation;
        if (query == QUERY_BOTH)
            s->n[i] = (signed char)answer.n;
        if (query == QUERY_FIRST || query == QUERY_BOTH)
            s->t[0][i] = answer.n > 0 ? answer.hit[0].t : NAN;
        if (query == QUERY_BOTH)
            s->t[1][i] = answer.n > 1 ? answer.hit[1].t : NAN;
        if (answer.n == 0)
            continue;
        count++;
        if (query == QUERY_ANY)
            break;
        if (query == QUERY_NEAREST && answer.hit[0].t < nearest) {
            nearest = answer.hit[0].t;
            found = i;
        }
    }
    sink = count + found;
}

INLINE void plain_query(const struct turn *t, size_t k, enum arrangement a)
{
    switch (t->query) {
    case QUERY_COUNT:
        plain_loop(t, k, a, QUERY_COUNT);
        return;
    case QUERY_ANY:
        plain_loop(t, k, a, QUERY_ANY);
        return;
    case QUERY_RELATIONS:
        plain_loop(t, k, a, QUERY_RELATIONS);
        return;
    case QUERY_FIRST:
        plain_loop(t, k, a, QUERY_FIRST);
        return;
    case QUERY_BOTH:
        plain_loop(t, k, a, QUERY_BOTH);
        return;
    default:
        plain_loop(t, k, a, QUERY_NEAREST);
    }
}

static void plain_question(const struct turn *t, size_t k)
{
    switch (t->arrangement) {
    case ONE_LINE:
        plain_query(t, k, ONE_LINE);
        return;
    case ONE_SHAPE:
        plain_query(t, k, ONE_SHAPE);
        return;
    default:
        plain_query(t, k, PAIRS);
    }
}

static void columns_query(const struct turn *t, size_t k)
{
    const struct scene *s = t->scene;
    cylint_columns to = {0};
    if (t->query == QUERY_RELATIONS)
        to.relation = s->relation;
    else
        to.t0 = s->t[0];
    if (t->query == QUERY_BOTH) {
        to.n = s->n;
        to.t1 = s->t[1];
    }
    if (t->arrangement == ONE_LINE) {
        cylint_intersect_shapes(&s->pack, &t->lines[k], &to);
    } else if (t->arrangement == ONE_SHAPE) {
        cylint_intersect_lines(&s->shapes[k], &s->columns, &to);
    } else {
        cylint_lines from = s->columns;
        for (int i = 0; i < 3; i++) {
            from.o[i] += k;
            from.d[i] += k;
        }
        cylint_intersect_pairs(&s->pack, &from, &to);
    }
}

static void batch_question(const struct turn *t, size_t k)
{
    const cylint_pack *pack = &t->scene->pack;
    const unsigned want = CYLINT_WANT_T | CYLINT_WANT_NEAREST;
    cylint_hit hit;
    switch (t->query) {
    case QUERY_COUNT:
        sink = cylint_count(pack, &t->lines[k], 0);
        return;
    case QUERY_ANY:
        sink = cylint_count(pack, &t->lines[k], 1);
        return;
    case QUERY_NEAREST:
        sink = cylint_nearest(pack, &t->lines[k], want, &hit);
        return;
    default:
        columns_query(t, k);
    }
}

void batch_turn(void *turn, const int *order, int n)
{
    const struct turn *t = turn;
    if (t->kernels)
        cylint_use_kernels(t->kernels);
    for (int i = 0; i < n; i++) {
        if (t->kernels)
            batch_question(t, (size_t)order[i]);
        else
            plain_question(t, (size_t)order[i]);
    }
}

/* The test of the first pass without its error margin. */
static int meets_ball(const cylint_shape *s, const cylint_line *l)
{
    double D[3], center[3], M2 = 0, d2 = 0;
    const double radius = cylint_ball_about(s, center);
    for (int i = 0; i < 3; i++)
        D[i] = l->o[i] - center[i];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double m = D[j] * l->d[k] - D[k] * l->d[j];
        M2 += m * m;
        d2 += l->d[i] * l->d[i];
    }
    return M2 <= radius * radius * d2;
}

void turn_shares(const struct turn *t, int questions, double *hits,
                 double *reached)
{
    const size_t n = turn_tests(t);
    size_t n_hits = 0, n_reached = 0;
    for (size_t k = 0; k < (size_t)questions; k++)
        for (size_t i = 0; i < n; i++) {
            const cylint_line *line = &t->lines[line_of(t->arrangement, i, k)];
            const cylint_shape shape =
                t->scene->shapes[shape_of(t->arrangement, i, k)];
            cylint_answer answer;
            n_hits +=
                cylint_intersect(&shape, line, CYLINT_WANT_COUNT, &answer) > 0;
            n_reached += (size_t)meets_ball(&shape, line);
        }
    *hits = 100.0 * (double)n_hits / ((double)n * questions);
    *reached = 100.0 * (double)n_reached / ((double)n * questions);
}
