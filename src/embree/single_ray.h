/*
 * single_ray.h - traces one ray through the shapes of a geometry
 */
#ifndef CYLINT_EMBREE_SINGLE_RAY_H
#define CYLINT_EMBREE_SINGLE_RAY_H

#include "ray_test.h"

/* Returns 1 if the ray test, initialised but for the line, records a hit. */
int cylint_trace_single(ray_test *r, unsigned primID);

#endif
