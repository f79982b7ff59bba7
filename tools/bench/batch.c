/*
 * batch.c - the batch functions beside the leanest formula, one by one
 *
 * 512 lines and 512 shapes: each line against all shapes, all lines against
 * each shape, and pairs.  Shapes fill a ball, and lines run from outside
 * through it; the size of the ball gives the share of hits.  A time is that of
 * one test.
 */
#include "lean.h"

enum { N = 512 };

static struct {
    cylint_shape shape[N];
    struct lean lean[N];
    cylint_line line[2 * N]; /* twice the same, so that pairs can be shifted */
    double column[6][2 * N];
    cylint_pack pack;
    void *memory;
    lean_line *formula;
    int kind;
    signed char hits[N];
    double t[2][N];
} in;

/* ----------------------------------------------------------------- input -- */

static void draw_input(double radius)
{
    uint64_t random = 5;
    for (int i = 0; i < N; i++) {
        in.shape[i] = draw_shape(&random, in.kind, radius);
        lean_prepare(&in.lean[i], &in.shape[i]);
    }
    cylint_pack_shapes(&in.pack, in.memory, in.shape, N);
    for (int i = 0; i < N; i++) {
        double o[3], d[3], at[3];
        draw_direction(&random, o);
        draw_in_ball(&random, radius, at);
        scale3(o, 2 * radius + 4);
        minus3(d, at, o);
        unit3(d, d);
        make_ray(&in.line[i], o, d);
        in.line[i + N] = in.line[i];
        for (int c = 0; c < 3; c++) {
            in.column[c][i] = in.column[c][i + N] = o[c];
            in.column[c + 3][i] = in.column[c + 3][i + N] = d[c];
        }
    }
}

/* The share of hits in a ball of this radius. */
static double share_of_hits(double radius)
{
    size_t hits = 0;
    draw_input(radius);
    for (int i = 0; i < N; i++)
        hits += cylint_count(&in.pack, &in.line[i], 0);
    return (double)hits / N / N;
}

/* ----------------------------------------------------------------- turns -- */

/* Which line and which shape test i of question k has. */
enum arrangement { ALL_SHAPES, ALL_LINES, IN_PAIRS };

static const enum arrangement all_shapes = ALL_SHAPES, all_lines = ALL_LINES,
                              in_pairs = IN_PAIRS;

static inline int formula(const cylint_line *l, int shape, double t[2])
{
    return in.formula(&in.lean[shape], l->o, l->d, l->tmin, l->tmax, t);
}

static inline int lean_nearest_of(int line)
{
    double first = HUGE_VAL, t[2];
    int best = N;
    for (int shape = 0; shape < N; shape++) {
        const int hits = formula(&in.line[line], shape, t);
        if (hits && t[2 - hits] < first) {
            first = t[2 - hits];
            best = shape;
        }
    }
    return best;
}

static inline int lean_any_of(int line)
{
    double t[2];
    int shape = 0;
    while (shape < N && !formula(&in.line[line], shape, t))
        shape++;
    return shape < N;
}

static inline int lean_both_of(enum arrangement a, int k)
{
    double t[2] = {0, 0};
    for (int i = 0; i < N; i++) {
        const int line = a == ALL_SHAPES ? k : a == ALL_LINES ? i : k + i;
        const int shape = a == ALL_LINES ? k : i;
        in.hits[i] = (signed char)formula(&in.line[line], shape, t);
        in.t[0][i] = in.hits[i] ? t[0] : (double)NAN;
        in.t[1][i] = in.hits[i] ? t[1] : (double)NAN;
    }
    return in.hits[0] + in.hits[N - 1];
}

/* N lines from number `first` on. */
static cylint_lines lines_from(int first)
{
    cylint_lines lines = {.n = N};
    for (int c = 0; c < 3; c++) {
        lines.o[c] = in.column[c] + first;
        lines.d[c] = in.column[c + 3] + first;
    }
    return lines;
}

static inline int both_of(enum arrangement a, int k)
{
    const cylint_columns to = {.n = in.hits, .t0 = in.t[0], .t1 = in.t[1]};
    const cylint_lines lines = lines_from(a == IN_PAIRS ? k : 0);
    if (a == ALL_SHAPES)
        cylint_intersect_shapes(&in.pack, &in.line[k], &to);
    else if (a == ALL_LINES)
        cylint_intersect_lines(&in.shape[k], &lines, &to);
    else
        cylint_intersect_pairs(&in.pack, &lines, &to);
    return in.hits[0] + in.hits[N - 1];
}

#define ARRANGED const enum arrangement a = *(const enum arrangement *)input
BENCH_TURN(lean_nearest, , lean_nearest_of(i))
BENCH_TURN(lean_any, , lean_any_of(i))
BENCH_TURN(lean_both, ARRANGED, lean_both_of(a, i))
BENCH_TURN(nearest, cylint_hit hit,
           cylint_nearest(&in.pack, &in.line[i], CYLINT_WANT_T, &hit))
BENCH_TURN(any, , cylint_count(&in.pack, &in.line[i], 1))
BENCH_TURN(both, ARRANGED, both_of(a, i))

/* -------------------------------------------------------------- contests -- */

static const struct {
    const char *name;
    bench_turn *theirs, *ours;
    const enum arrangement *input;
} questions[] = {
    {"nearest of 512", lean_nearest, nearest, NULL},
    {"any of 512", lean_any, any, NULL},
    {"both t of 512 shapes", lean_both, both, &all_shapes},
    {"both t of 512 lines", lean_both, both, &all_lines},
    {"both t of 512 pairs", lean_both, both, &in_pairs},
};

void bench_batch(void)
{
    static const struct {
        double share;
        const char *setup;
    } shares[] = {{0.01, "1 % hit"}, {0.5, "50 % hit"}};
    in.memory = allocate(cylint_pack_bytes(N));
    for (int kind = 0; kind < KINDS; kind++)
        for (int k = 0; k < 2 && is_wanted(kind_names[kind]); k++) {
            in.kind = kind;
            approach(share_of_hits, 32, shares[k].share);
            in.formula = lean_formulas[kind].line;
            for (size_t q = 0; q < sizeof questions / sizeof *questions; q++)
                compete(&(struct contest){.subject = kind_names[kind],
                                          .question = questions[q].name,
                                          .setup = shares[k].setup,
                                          .rival = "prepared quadratic",
                                          .theirs = questions[q].theirs,
                                          .ours = questions[q].ours,
                                          .input = questions[q].input,
                                          .questions = N,
                                          .units = N});
        }
    free(in.memory);
}
