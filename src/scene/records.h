/*
 * records.h - the shapes of a scene: the arguments of their constructors
 *
 * A record of 64 bytes and a byte hold a shape of two points and two radii; an
 * elliptic shape takes 48 bytes more.  A record gives the constructor its own
 * arguments, so the shape that it makes has the same answers, bit for bit.
 */
#ifndef CYLINT_SCENE_RECORDS_H
#define CYLINT_SCENE_RECORDS_H

#include <stdint.h>

#include "../numbers/compiler.h"
#include "../shapes/record.h"
#include "../shapes/shape_facts.h"
#include "cylint.h"

/* In a tag if cylint_local_in_doubles() serves the shape. */
enum { CYLINT_TAG_PLAIN = 128 };

/* r0 of an elliptic shape's record is the index of its semi-axes. */
typedef struct cylint_records {
    cylint_record *record;
    uint8_t *tag;
    cylint_semi_axes *semi_axes;
    size_t n, capacity, n_elliptic, elliptic_capacity;
} cylint_records;

/* Makes room for n shapes in all.  Returns 0 if there is no memory. */
int cylint_records_reserve(cylint_records *records, size_t n);

/* Adds n shapes.  Returns 0, and adds none, if there is no memory. */
int cylint_records_add(cylint_records *records, const cylint_shape *shapes,
                       size_t n);

/* Whether a shape can take the place of another: both are elliptic or none is, and
 * both are accepted by their constructors or none is. */
int cylint_record_takes(const cylint_records *records, size_t number,
                        const cylint_shape *shape);
void cylint_record_replace(cylint_records *records, size_t number,
                           const cylint_shape *shape);

/* Returns the memory that is not used. */
void cylint_records_trim(cylint_records *records);
void cylint_records_free(cylint_records *records);

/* The bytes of memory that they take. */
size_t cylint_records_bytes(const cylint_records *records);

CYLINT_INLINE int cylint_record_kind(const cylint_records *records,
                                     size_t number)
{
    return records->tag[number] & CYLINT_TAG_KIND;
}

CYLINT_INLINE int cylint_record_ends(const cylint_records *records,
                                     size_t number)
{
    return records->tag[number] / CYLINT_TAG_ENDS % 8;
}

/* Makes the shape by its constructor. */
void cylint_record_shape(const cylint_records *records, size_t number,
                         cylint_shape *shape);

/* Writes a shape's kind, ends and data; its local coordinates need not be
 * written. */
void cylint_record_data(const cylint_records *records, size_t number,
                        cylint_shape *shape);

/*
 * Whether the records, of a file perhaps, can have been made of shapes: their
 * constructors accept them, the tags are right, and the elliptic ones have
 * semi-axes.  It takes a few nanoseconds a plain record: of these it only
 * shows that cylint_local_in_doubles() computes finite numbers.
 */
int cylint_records_are_sound(const cylint_records *records);

#endif
