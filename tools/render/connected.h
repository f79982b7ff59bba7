/*
 * connected.h - which shapes hang together
 */
#ifndef CYLINT_CONNECTED_H
#define CYLINT_CONNECTED_H

#include <stddef.h>
#include <stdint.h>

#include "cylint.h"

/* Cylinders and cones belong together if they have an end of their axes in
 * common, to the last bit, or are linked by such; other shapes stand alone.
 * Groups are numbered from 0 in the order of their first shapes.  Returns 0
 * or an exit status. */
int connected_groups(const cylint_shape *shapes, size_t n, uint32_t *group);

#endif
