/*
 * shapes.h - the shapes of a geometry: what their constructors got
 *
 * 32 or 64 bytes a shape, which are also what the float filter reads, and a byte
 * for the ends.  Shapes that the filter does not decide are kept whole.
 */
#ifndef CYLINT_EMBREE_SHAPES_H
#define CYLINT_EMBREE_SHAPES_H

#include <stdint.h>

#include "../bvh/memory.h"
#include "../bvh/swept_disc.h"
#include "float_filter.h"

void cylint_filter_record_of(cylint_record *to, const cylint_shape *shape);

/* Returns 0 if the shape does not fit. */
int cylint_small_record_of(cylint_small_record *to, const cylint_shape *shape);

typedef struct cylint_embree_shapes {
    cylint_memory memory; /* the records, then `ends` */
    cylint_memory whole_memory;
    int small; /* the records are */
    const uint8_t *ends;
    const cylint_shape *whole; /* p0[0] of the record is the index */
} cylint_embree_shapes;

static inline const void *cylint_embree_record_at(const cylint_embree_shapes *s,
                                                  size_t at)
{
    return (const char *)s->memory.data +
           at *
               (s->small ? sizeof(cylint_small_record) : sizeof(cylint_record));
}

/* Copies n > 0 shapes of a view: number[0], number[1], ... or, if number is NULL,
 * 0, 1, ...  Returns 0 if memory is refused. */
int cylint_embree_shapes_copy(cylint_embree_shapes *to, const cylint_view *from,
                              const uint32_t *number, size_t n, int threads,
                              const cylint_memory_source *source);
void cylint_embree_shapes_free(cylint_embree_shapes *s);

static inline size_t cylint_embree_shapes_bytes(const cylint_embree_shapes *s)
{
    return s->memory.bytes + s->whole_memory.bytes;
}

/* The record of a shape in doubles. */
cylint_record cylint_embree_record(const cylint_embree_shapes *s, size_t at);

/* Makes a shape by its constructor. */
void cylint_embree_shape(const cylint_embree_shapes *s, size_t at,
                         cylint_shape *shape);

#endif
