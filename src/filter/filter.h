/*
 * filter.h - what each build of one_question.c and many_questions.c offers, and what a
 * pack looks like to them
 */
#ifndef CYLINT_KERNELS_H
#define CYLINT_KERNELS_H

#include "cylint.h"

/* What a kernel decided: relation miss or cross, and the n hits that count. */
typedef struct {
    int relation, n, part[2], side[2];
    double t[2];
} cylint_kernel_answer;

/* What is known of the roots of n hits beside t: root = t + more, but for an
 * error of at most that. */
typedef struct {
    double more[2], error[2];
} cylint_root_rest;

/* One line and shape: fills in *answer and returns its n.  Point, normal, z
 * and phi are not wanted of it; who needs more of the roots to find those sets
 * `rest`, and is then told CYLINT_UNDECIDED where it would take signs. */
typedef int cylint_kernel_one(const cylint_shape *shape,
                              const cylint_line *line, unsigned want,
                              cylint_answer *answer, cylint_root_rest *rest);
enum { CYLINT_UNDECIDED = -1 };

/* The way that always answers (intersect.c): by signs and, where need be, every
 * digit. */
int cylint_ask_signs(const cylint_shape *shape, const cylint_line *line,
                     unsigned want, cylint_answer *answer);

/* Shapes that one kernel serves: number[i] is the shape of lane i.  The
 * columns hold the balls about them, padded to a multiple of 8 lanes by
 * copies of the last. */
enum { COLUMN_CENTER = 0, COLUMN_BALL = 3, COLUMNS };

typedef struct {
    int kind, bounded;
    int scalar;       /* no kernel: ask cylint_intersect() */
    size_t n, stride; /* of columns, in doubles */
    const size_t *number;
    const double *column;
} cylint_run;

/* A batch job: which lines meet which shapes, and what becomes of it. */
typedef struct cylint_job cylint_job;
struct cylint_job {
    const cylint_shape *shapes; /* all, by number */
    const cylint_line *line;    /* one line for all shapes, or NULL */
    const cylint_lines *lines;  /* one for each number, where line is NULL */
    unsigned want;
    int relations;  /* asked even where there is no hit */
    double nearest; /* hits beyond it are of no interest */
    /* Takes a decided answer; returns 1 when nothing more is wanted. */
    int (*take)(cylint_job *job, size_t number,
                const cylint_kernel_answer *answer);
    size_t best, count, enough;
    cylint_kernel_answer best_answer;
    const cylint_columns *columns;
};

/* A run of shapes, or (one shape, in lanes = all) a stretch of lines from
 * `first` on.  Returns 1 if the job has enough. */
typedef int cylint_kernel_shapes(cylint_job *job, const cylint_run *run);
typedef int cylint_kernel_lines(cylint_job *job, const cylint_shape *shape);

typedef struct {
    const char *name;
    cylint_kernel_one *one;
    cylint_kernel_shapes *shapes;
    cylint_kernel_lines *lines;
} cylint_kernels;

/* The builds: narrow for single questions, wide for batches. */
extern cylint_kernel_one cylint_one_plain, cylint_one_fma, cylint_one_avx512;
extern cylint_kernel_shapes cylint_shapes_plain, cylint_shapes_avx2,
    cylint_shapes_avx512;
extern cylint_kernel_lines cylint_lines_plain, cylint_lines_avx2,
    cylint_lines_avx512;

/* Those in use: dispatch.c chooses when first asked. */
extern const cylint_kernels *cylint_kernels_chosen;
const cylint_kernels *cylint_choose_kernels(void);
static inline const cylint_kernels *cylint_kernels_used(void)
{
#ifdef __GNUC__
    const cylint_kernels *kernels =
        __atomic_load_n(&cylint_kernels_chosen, __ATOMIC_RELAXED);
#else
    const cylint_kernels *kernels = cylint_kernels_chosen;
#endif
    return kernels ? kernels : cylint_choose_kernels();
}

/* Asks by the general way: number's shape, its line. */
void cylint_kernel_ask(const cylint_job *job, const cylint_shape *shape,
                       size_t number, cylint_kernel_answer *answer);

#endif
