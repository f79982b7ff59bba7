/*
 * single_ray.h - one ray at the shapes of a primitive
 */
#ifndef CYLINT_EMBREE_SINGLE_RAY_H
#define CYLINT_EMBREE_SINGLE_RAY_H

#include "shape_test.h"

/* 1 if the ray, of which all pointers are set, takes a hit. */
int cylint_trace_single(query *q, unsigned primID);

#endif
