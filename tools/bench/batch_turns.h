/*
 * batch_turns.h - the queries of a batch, and the turns that answer them
 */
#ifndef BENCH_BATCH_TURNS_H
#define BENCH_BATCH_TURNS_H

#include "batch_scene.h"
#include "race.h"

/* One line against all shapes, all lines against one shape, line i against
 * shape i. */
enum arrangement { ONE_LINE, ONE_SHAPE, PAIRS, ARRANGEMENTS };

/* The first three exist only for ONE_LINE. */
enum query {
    QUERY_COUNT,     /* the number of shapes hit */
    QUERY_ANY,       /* whether a shape is hit; stops at the first */
    QUERY_NEAREST,   /* the shape hit first, and t */
    QUERY_RELATIONS, /* a column: relation */
    QUERY_FIRST,     /* a column: t of the first hit */
    QUERY_BOTH,      /* columns: number of hits and both t */
    QUERIES
};

const char *arrangement_name(enum arrangement arrangement);
const char *query_name(enum query query);

struct turn {
    const struct scene *scene;
    const cylint_line *lines; /* the scene's `lines` or `away` */
    const char *kernels;      /* NULL: the plain quadratic, one by one */
    enum arrangement arrangement;
    enum query query;
};

/* A turn_fn.  Question k is line k against all shapes, shape k against all
 * lines, or line i + k against shape i for all i. */
void batch_turn(void *turn, const int *order, int n);

/* The number of tests in a question. */
size_t turn_tests(const struct turn *t);

/* Percentages of the tests in the given number of questions: hits, and lines
 * that meet the bounding ball of the shape. */
void turn_shares(const struct turn *t, int questions, double *hits,
                 double *reached);

/* The number of builds of the kernels that this processor runs. */
int kernels_count(void);

#endif
