/*
 * filter.h - certified answers in doubles, or "undecided"
 */
#ifndef CYLINT_FILTER_H
#define CYLINT_FILTER_H

#include <float.h>

#include "../shapes/shape_facts.h"
#include "cylint.h"

/* The roots of n hits beyond t: |root - (t + more)| <= error. */
typedef struct {
    double more[2], error[2];
} cylint_root_rest;

/* One line and shape: fills in *answer and returns its n, or returns
 * CYLINT_UNDECIDED.  Point, normal, z and phi are not computed; `rest`, where
 * it is not NULL, receives what finding them needs. */
#define CYLINT_ONE_ARGUMENTS                                           \
    const cylint_shape *shape, const cylint_line *line, unsigned want, \
        cylint_answer *answer, cylint_root_rest *rest
typedef int cylint_kernel_one(CYLINT_ONE_ARGUMENTS);
enum { CYLINT_UNDECIDED = -1 };

/* For shapes without a kernel, and for compilers without vectors of two lanes. */
static inline int cylint_undecided(CYLINT_ONE_ARGUMENTS)
{
    (void)shape;
    (void)line;
    (void)want;
    (void)answer;
    (void)rest;
    return CYLINT_UNDECIDED;
}

/* The functions for one line and one shape: by solid and by whether roots are
 * wanted. */
typedef struct {
    cylint_kernel_one *by_solid[CYLINT_SOLIDS][2];
} cylint_one_kernels;

cylint_kernel_one cylint_hard_round_plain, cylint_hard_round_fma;
cylint_kernel_one cylint_sphere_roots_plain, cylint_sphere_roots_fma,
    cylint_sphere_signs_plain, cylint_sphere_signs_fma,
    cylint_capsule_roots_plain, cylint_capsule_roots_fma,
    cylint_capsule_signs_plain, cylint_capsule_signs_fma,
    cylint_rcone_roots_plain, cylint_rcone_roots_fma, cylint_rcone_signs_plain,
    cylint_rcone_signs_fma;

/*
 * The functions that continue where a kernel of straight or tapered shapes does
 * not decide (hard_question.c).  Q and D: no coordinate of the line's origin
 * exceeds Q, none of its direction exceeds D, in local coordinates.
 *
 * hard: signs are uncertain, or the line is nearly tangent.  `known` is 0, or
 * CYLINT_KNOWN_LINE and the bits of the caps that the line pierces and, times 4,
 * of the ends of the overlap that exist: then only the signs at an end of the
 * domain are uncertain.
 *
 * exact_roots: some roots are not certainly rounded.  The members of the
 * estimates are those of local_roots.h.  Of round kinds `pierced` has the bits of
 * ends on a ball, and `lanes` those of ends on the ball about the top.
 */
enum { CYLINT_KNOWN_LINE = 16 };

typedef struct {
    double Q, D;
    unsigned pierced, lanes, nearest;
    int first;
    double t[2], slope[2], inverse[2], slope_error[2], curvature[2];
    double value[2], more[2], error[2], low[2], high[2];
} cylint_estimates;

typedef int cylint_kernel_hard(CYLINT_ONE_ARGUMENTS, unsigned known, double Q,
                               double D);
typedef int cylint_kernel_roots(CYLINT_ONE_ARGUMENTS,
                                const cylint_estimates *from);
cylint_kernel_hard cylint_hard_plain, cylint_hard_fma;
cylint_kernel_roots cylint_exact_roots_plain, cylint_exact_roots_fma,
    cylint_exact_round_plain, cylint_exact_round_fma;

static inline int cylint_filter_one(const cylint_one_kernels *kernels,
                                    const cylint_shape *shape,
                                    const cylint_line *line, unsigned want,
                                    cylint_answer *answer,
                                    cylint_root_rest *rest)
{
    const unsigned roots = want / CYLINT_WANT_T % 2;
    const unsigned solid =
        (unsigned)shape->prepared & -(unsigned)line->in_range;
    return kernels->by_solid[solid][roots](shape, line, want, answer, rest);
}

/* A question of a batch is a line and a shape, and it has a number.  All
 * questions of one cylint_filter_batch have the same kind of shape, and either
 * the shape or the line may be the same in all. */
enum { COLUMN_CENTER = 0, COLUMN_BALL = 3, COLUMNS };

/* Shapes of one kind: number[i] is the shape of lane i.  The columns hold the
 * balls about them, padded to a multiple of 8 lanes by copies of the last. */
typedef struct {
    int kind, bounded;
    int scalar;       /* the filter does not serve them */
    size_t n, stride; /* of columns, in doubles */
    const size_t *number;
    const double *column;
} cylint_run;

/* The questions, set by the caller, who sets `lane`, `first` and `end` to 0. */
typedef struct {
    const cylint_shape *shapes; /* all, by number; or the one shape */
    const cylint_run *run;      /* NULL: one shape for all lines */
    const cylint_line *line;    /* one line for all shapes, or NULL */
    const cylint_lines *lines;  /* else a line for each number */
    int kind, bounded;
    size_t n;
    unsigned want;
    int relations;  /* wanted even where there is no hit */
    int eager;      /* no answer makes later ones unwanted */
    double nearest; /* one line: hits beyond it are not wanted */
    double speed;   /* one line: |d|, not less */
    /* the numbers that the first pass left are list[first] .. list[end - 1];
     * it goes on at `lane` */
    size_t lane, first, end;
    size_t list[256 + 8];
} cylint_filter_batch;

/* Answers to up to 8 questions: those of lanes in `found` cross, or are
 * undecided; all others miss, or their hits are not wanted.  Masks have a bit
 * for each lane.  Hit 0 leaves and hit 1 enters in lanes of leaving_first. */
typedef struct {
    unsigned found, undecided, hit[2], leaving_first;
    const size_t *number;
    double t[2][8], part[2][8];
} cylint_filter_group;

/* Writes the next group of answers; returns 0 when there are no more. */
typedef int cylint_filter_next(cylint_filter_batch *batch,
                               cylint_filter_group *group);

/* The builds: narrow for single questions, wide for batches. */
extern const cylint_one_kernels cylint_one_plain, cylint_one_fma,
    cylint_one_avx512;
extern cylint_filter_next cylint_many_plain, cylint_many_avx2,
    cylint_many_avx512;

#endif
