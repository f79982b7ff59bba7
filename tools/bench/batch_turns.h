/*
 * batch_turns.h - what a batch is asked, and who answers
 */
#ifndef BENCH_BATCH_TURNS_H
#define BENCH_BATCH_TURNS_H

#include "batch_scene.h"
#include "race.h"

/* Shapes under one line, lines against one shape, line i against shape i. */
enum arrangement { ONE_LINE, ONE_SHAPE, PAIRS, ARRANGEMENTS };

/* The first four are of one line and all shapes only. */
enum asked {
    ASK_COUNT,     /* how many are met */
    ASK_ANY,       /* whether any is, stopping there */
    ASK_NEAREST,   /* which is met first, and where */
    ASK_FAST,      /* the same, t as the doubles have it */
    ASK_RELATIONS, /* a column: relation */
    ASK_FIRST,     /* a column: t of the first hit */
    ASK_BOTH,      /* columns: how many, and both t */
    ASKED
};

const char *arrangement_name(enum arrangement arrangement);
const char *asked_name(enum asked asked);

struct turn {
    const struct scene *scene;
    const cylint_line *lines; /* the scene's, or those away */
    const char *kernels;      /* NULL: the plain quadratic, one by one */
    enum arrangement arrangement;
    enum asked asked;
};

/* A turn_fn: question k is line k against all shapes, or shape k against
 * all lines, or all shapes with the lines k further on. */
void batch_turn(void *turn, const int *order, int n);

/* How many tests a question is. */
size_t turn_tests(const struct turn *t);

/* Of the tests of so many questions, per cent that hit; and per cent whose
 * line meets the ball about the shape. */
void turn_shares(const struct turn *t, int questions, double *hits,
                 double *reached);

/* How many builds of the kernels this processor runs. */
int kernels_count(void);

#endif
