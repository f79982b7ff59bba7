/*
 * shapes.h - the shapes of a geometry, and the float filter of hits on them
 *
 * A shape is stored as the arguments of its constructor, 32 or 64 bytes, which the
 * filter reads, too, and a byte for kind and ends.  Shapes that the filter does not
 * decide are stored whole.
 */
#ifndef CYLINT_EMBREE_SHAPES_H
#define CYLINT_EMBREE_SHAPES_H

#include <stdint.h>

#include "../bvh/traverse.h"
#include "../shapes/record.h"
#include "cylint_embree.h"

/* The numbers of small records are floats, none of them subnormal. */
enum {
    CYLINT_RECORD_NUMBERS = sizeof(cylint_record) / sizeof(double),
    CYLINT_SMALL_RECORD = CYLINT_RECORD_NUMBERS * sizeof(float)
};

typedef struct cylint_embree_shapes {
    cylint_memory memory;      /* the records, then `tag`, then `whole` */
    size_t size;               /* of a record */
    uint8_t *tag;              /* with the kind of the constructor */
    const cylint_shape *whole; /* p0[0] of the record is the index */
} cylint_embree_shapes;

/* The record for the float filter. */
void cylint_filter_record_of(cylint_record *to, const cylint_shape *shape);

static inline const void *cylint_embree_record_at(const cylint_embree_shapes *s,
                                                  size_t at)
{
    return (const char *)s->memory.data + at * s->size;
}

/* Writes the record of a shape in doubles. */
static inline void cylint_embree_record(const cylint_embree_shapes *s,
                                        size_t at, cylint_record *to)
{
    const void *from = cylint_embree_record_at(s, at);
    const float *small = from;
    double *number = to->p0;
    if (s->size != CYLINT_SMALL_RECORD) {
        *to = *(const cylint_record *)from;
        return;
    }
    EACH(j, CYLINT_RECORD_NUMBERS)
        number[j] = (double)small[j];
}

/* Copies the n shapes of a view, at least one, to *to, which holds none.  Returns 0
 * if memory is refused; the caller frees its memory then too. */
int cylint_embree_shapes_copy(cylint_embree_shapes *to,
                              const cylint_bvh_input *from);

/* Makes the shape at a time by its constructor.  Without shapes of time 1 it does
 * not move. */
void cylint_embree_shape(const cylint_embree_shapes s[2], size_t at,
                         double time, cylint_shape *shape);

/* The record of a moving shape, or one that the filter does not decide. */
void cylint_embree_moving_record(const cylint_embree_shapes s[2], size_t at,
                                 double time, cylint_record *to);

/* The box at time 0 or 1 (step).  The boxes that Embree interpolates between the
 * two contain the shape at every time.  at_1: NULL if it does not move. */
cylint_extent cylint_embree_box(const cylint_shape *at_0,
                                const cylint_shape *at_1, int step);

/* ------------------------------------------------ the float filter -- */

/* Hits of float rays, computed in doubles with error bounds, for circular and round
 * shapes, most questions by far.  An answer is what cylint_intersect() returns, as
 * far as floats show it, or UNDECIDED. */
typedef enum {
    CYLINT_FLOAT_FILTER_UNDECIDED = -1, /* cylint_intersect() must decide */
    CYLINT_FLOAT_FILTER_MISS,           /* no hit in the domain */
    /* t as a float is less than tmax or, on a ball, equal to it */
    CYLINT_FLOAT_FILTER_HIT
} cylint_float_filter_result;

enum { CYLINT_HIT_FLOATS = 5 };

/*
 * A ray, the question which is its first hit on a slice of a shape, and the answer.
 * All numbers of the line and near are floats; cylint_span() accepts the line.
 * near: a t near the shape.
 */
typedef struct cylint_float_filter_question {
    double near;
    cylint_bvh_line line;
    /* of the shape; of a round kind with negative radii, of an angle cone with the
     * negative tangent as r0; NaN radii: the filter does not decide the shape */
    cylint_record record;
    int ends; /* the shape's */
    cylint_slice slice;
    /* the same in all questions of a call: */
    int exit_only; /* only where the line leaves the shape */
    int describes; /* `floats` are wanted */
    /* the answer; of a HIT: t rounded up to a float, whether the line leaves the
     * shape there, the end of which the ball is hit, or -1, and the floats if they
     * are wanted: the normal, z and phi, equal to the library's doubles rounded to
     * floats */
    cylint_float_filter_result is;
    float t;
    int leaves, ball;
    float floats[CYLINT_HIT_FLOATS];
} cylint_float_filter_question;

/* Answers n questions. */
typedef void cylint_float_filter(cylint_float_filter_question *const of[],
                                 int n);

/* The build in use for one question, or for many. */
cylint_float_filter *cylint_float_filter_used(int many);

/* All builds: two with one lane, and one with four. */
extern cylint_float_filter cylint_float_filter_plain, cylint_float_filter_fma,
    cylint_float_filter_avx2;

#endif
