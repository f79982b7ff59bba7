/*
 * connected.h - groups of connected shapes
 */
#ifndef CYLINT_CONNECTED_H
#define CYLINT_CONNECTED_H

#include <stddef.h>
#include <stdint.h>

struct scene;

/* Cylinders and cones are connected if ends of their axes are equal, to the last
 * bit, or if other shapes connect them; every other shape is a group of its own.
 * Groups are numbered from 0 in the order of their first shapes.  Returns 0 or an
 * exit status. */
int connected_groups(const struct scene *scene, uint32_t *group);

#endif
