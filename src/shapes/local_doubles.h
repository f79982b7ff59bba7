/*
 * local_doubles.h - the local coordinates of a shape, in doubles
 */
#ifndef CYLINT_LOCAL_DOUBLES_H
#define CYLINT_LOCAL_DOUBLES_H

#include "record.h"

/*
 * Writes a shape for the kernels that decide by signs (filter.h), and for nothing
 * else: without low parts and without the members that hits take.  The kind is
 * cylinder, cone, capsule or round cone.  A constructor has made this shape of
 * the record, and its local coordinates were accurate.
 */
void cylint_local_in_doubles(cylint_shape *shape, int kind, int ends,
                             const cylint_record *from);

#endif
