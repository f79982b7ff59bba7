/*
 * filter.h - certified answers in doubles and pairs, or "undecided"
 */
#ifndef CYLINT_FILTER_H
#define CYLINT_FILTER_H

#include "../shapes/record.h"
#include "../shapes/shape_facts.h"
#include "cylint.h"

/* ---------------------------------------------------- one question ------ */

enum {
    CYLINT_UNDECIDED = -1,
    /* the members of a hit that are computed from the root */
    CYLINT_WANT_BESIDE_T =
        CYLINT_WANT_POINT | CYLINT_WANT_NORMAL | CYLINT_WANT_Z | CYLINT_WANT_PHI
};

/* The stage that goes on with a question which another did not decide. */
typedef enum {
    CYLINT_REFINE_LINE,  /* the signs of the line are uncertain */
    CYLINT_REFINE_ENDS,  /* only signs at an end of the domain are: `ends`,
                            `exists`, `past`, `rises` and A are set */
    CYLINT_REFINE_ROOTS, /* only roots' nearest doubles are: `ends` and slope[]
                            to error[] are set */
    CYLINT_REFINE_NONE   /* no other stage of the filter serves */
} cylint_refinement;

/* Ends of the overlap as bits, lane i for end i: on the plane or ball of an end;
 * that end is the top; the part is present.  back: end 1 is the first in t. */
typedef struct {
    unsigned on_end, top, present;
    int back;
} cylint_end_bits;

/*
 * One line and one shape, and what the stages compute.  Lane i of the roots
 * belongs to end i (frame.h).  exists, past: bits of members of `verdict` and
 * `point_signs`.  The others are the members of `estimate` and `root`
 * (surfaces.h).
 */
typedef struct {
    const cylint_shape *shape;
    const cylint_line *line;
    cylint_answer *answer;
    unsigned want;
    cylint_refinement next;
    cylint_end_bits ends;
    unsigned exists, past[2];
    int is_along; /* the line lies in the plane of an end */
    int rises;    /* the sign of Q's slope at the line's origin; 0: uncertain */
    double A;     /* of the lateral quadratic; only its sign counts */
    /* no local coordinate of the line's origin exceeds Q, none of its direction
     * exceeds D */
    double Q, D;
    double slope[2], slope_error[2], curvature[2], value[2], tail[2], error[2];
    /* If members beside t are wanted: their hits, and of each hit the members
     * that are not certain. */
    cylint_hit *described;
    unsigned undecided[2];
} cylint_question;

/* Relation, n, and the wanted t, part and side.  Writes *question->answer and
 * returns its n, or sets question->next and returns CYLINT_UNDECIDED.  The shape
 * and the line are those of the question. */
typedef int cylint_kernel_one(const cylint_shape *shape,
                              const cylint_line *line,
                              cylint_question *question);

/* On which side of a shape's surface the point lies: 1 inside, 0 on it, -1
 * outside; or CYLINT_SIGN_UNDECIDED.  No coordinate exceeds CYLINT_FAR. */
typedef int cylint_kernel_point(const cylint_shape *shape,
                                const double point[3]);

/* Writes the wanted members beside t of a hit, from t and part of `known`, and
 * returns those of them that are not certain. */
typedef unsigned cylint_kernel_hit(const cylint_shape *shape,
                                   const cylint_line *line, unsigned want,
                                   const cylint_hit *known, cylint_hit *hit);

typedef struct {
    cylint_kernel_one *by_solid[CYLINT_SOLIDS];
    /* serves a question that by_solid[] does not decide */
    int (*refine)(cylint_question *question);
    cylint_kernel_point *contains[CYLINT_SOLIDS]; /* by solid */
    cylint_kernel_hit *describe;
} cylint_one_kernels;

extern const cylint_one_kernels cylint_one_plain, cylint_one_fma;

/* --------------------------------------------------- many questions ----- */

/* The columns of a run: the centre and the radius of the ball about a shape. */
enum { COLUMN_CENTER = 0, COLUMN_BALL = 3, COLUMNS };

/* Shapes of one solid: number[i] is the shape of lane i.  The columns hold the
 * balls about them, padded to a multiple of 8 lanes by copies of the last. */
typedef struct {
    int solid;        /* none: the filter does not serve them */
    size_t n, stride; /* of columns, in doubles */
    const size_t *number;
    const double *column;
} cylint_run;

/* A question of a batch is a line and a shape, and it has a number.  All questions
 * of one cylint_filter_batch have the same solid, and either the shape or the line
 * may be the same in all.  The caller sets the questions, and `lane`, `first` and
 * `end` to 0.  If the shapes are records, there is no first pass: the caller writes
 * the numbers to `list` and their count to `end`, and n is 0; the line is one for
 * all, only t is wanted, and both caps are present. */
typedef struct {
    const cylint_shape *shapes;   /* all, by number; or the one shape */
    const cylint_record *records; /* all, by number; or NULL: shapes */
    const cylint_run *run;        /* NULL: one shape for all lines */
    const cylint_line *line;      /* one line for all shapes, or NULL */
    const cylint_lines *lines;    /* else a line for each number */
    int solid;
    size_t n;
    unsigned want;
    int relations;  /* wanted even where there is no hit */
    size_t awaited; /* how many numbers the next group waits for */
    double nearest; /* one line: hits beyond it are not wanted; the use of a
                       group may reduce it */
    double speed;   /* one line: |d|, not less */
    double center[3], radius; /* one shape: of the ball about it */
    /* the numbers that the first pass kept are list[first] .. list[end - 1];
     * it goes on at `lane` */
    size_t lane, first, end;
    size_t list[256 + 8];
} cylint_filter_batch;

/* The numbers of hits, in the order of the members of cylint_hit, in lanes.
 * certain: bits of lanes in which all numbers of a member are certain. */
enum {
    CYLINT_HIT_POINT = 0,
    CYLINT_HIT_NORMAL = 3,
    CYLINT_HIT_Z = 6,
    CYLINT_HIT_PHI,
    CYLINT_HIT_NUMBERS
};
enum {
    CYLINT_MEMBER_POINT,
    CYLINT_MEMBER_NORMAL,
    CYLINT_MEMBER_Z,
    CYLINT_MEMBER_PHI,
    CYLINT_MEMBERS
};
typedef struct {
    double number[CYLINT_HIT_NUMBERS][8];
    unsigned certain; /* bit 8 m + i: member m of lane i */
} cylint_hit_lanes;

/* Answers to up to 8 questions: those of lanes in `found` cross, or, in lanes of
 * `in_cap_plane`, are along a cap, or they are undecided; all others miss, or
 * their hits are not wanted.  Masks have a bit for each lane.  Hit 0 leaves and hit
 * 1 enters in lanes of leaving_first. */
typedef struct {
    unsigned found, undecided, hit[2], leaving_first, in_cap_plane;
    const size_t *number;
    double t[2][8], part[2][8];
    cylint_hit_lanes member[2]; /* as far as wanted */
} cylint_filter_group;

/* Uses a group of answers; returns 1 where no more are wanted. */
typedef int cylint_filter_use(void *self, cylint_filter_batch *batch,
                              const cylint_filter_group *group);

/* Answers all questions. */
typedef void cylint_filter_many(cylint_filter_batch *batch,
                                cylint_filter_use *use, void *self);

/* The builds. */
extern cylint_filter_many cylint_many_plain, cylint_many_avx2,
    cylint_many_avx512;

/* Writes what cylint_kernel_point returns, of shape number each * i for point i.
 * A point with a coordinate beyond CYLINT_FAR is undecided. */
typedef void cylint_filter_points(const cylint_shape *shapes, size_t each,
                                  const cylint_points *points,
                                  signed char *side);
extern cylint_filter_points cylint_sides_plain, cylint_sides_avx2,
    cylint_sides_avx512;

#endif
