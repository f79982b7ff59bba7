/*
 * shapes.h - the shapes of a geometry: what their constructors got
 *
 * 32 or 64 bytes a shape, which are also what the float filter reads, and a byte
 * for kind and ends.  Shapes that the filter does not decide are kept whole.
 */
#ifndef CYLINT_EMBREE_SHAPES_H
#define CYLINT_EMBREE_SHAPES_H

#include <stdint.h>

#include "../bvh/memory.h"
#include "../bvh/swept_disc.h"
#include "cylint_embree.h"
#include "float_filter.h"

enum { CYLINT_RECORD_NUMBERS = sizeof(cylint_record) / sizeof(double) };

typedef struct cylint_embree_shapes {
    cylint_memory memory; /* the records, then `tag` */
    cylint_memory whole_memory;
    int small; /* the numbers of records are floats, none of them subnormal */
    uint8_t *tag;              /* with the kind of the constructor */
    const cylint_shape *whole; /* p0[0] of the record is the index */
} cylint_embree_shapes;

/* The record for the float filter. */
void cylint_filter_record_of(cylint_record *to, const cylint_shape *shape);

/* Writes the record of a shape.  Returns 0 if it does not fit. */
int cylint_embree_set_record(const cylint_embree_shapes *s, size_t at,
                             const cylint_shape *shape);

static inline const void *cylint_embree_record_at(const cylint_embree_shapes *s,
                                                  size_t at)
{
    return (const char *)s->memory.data +
           at * (s->small ? sizeof(float) : sizeof(double)) *
               CYLINT_RECORD_NUMBERS;
}

/* Writes the record of a shape in doubles. */
static inline void cylint_embree_record(const cylint_embree_shapes *s,
                                        size_t at, cylint_record *to)
{
    const void *from = cylint_embree_record_at(s, at);
    const float *small = from;
    double *number = to->p0;
    if (!s->small) {
        *to = *(const cylint_record *)from;
        return;
    }
    EACH(j, CYLINT_RECORD_NUMBERS)
        number[j] = (double)small[j];
}

/* Copies n > 0 shapes of a view: number[0], number[1], ... or, if number is NULL,
 * 0, 1, ...  *to holds none before.  Returns 0 if memory is refused; the caller
 * frees *to then too. */
int cylint_embree_shapes_copy(cylint_embree_shapes *to, const cylint_view *from,
                              const uint32_t *number, size_t n, int threads,
                              const cylint_memory_source *source);
void cylint_embree_shapes_free(cylint_embree_shapes *s);

/* ------------------------------------- the shapes of times 0 and 1 -- */

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

#endif
