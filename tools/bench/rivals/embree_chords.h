/*
 * embree_chords.h - the union of chords in cylinders, as a caller of Embree
 * computes it
 */
#ifndef BENCH_EMBREE_CHORDS_H
#define BENCH_EMBREE_CHORDS_H

#include <stddef.h>

#include "cylint.h"

struct embree_chords *embree_chords_new(float (*end)[2][3], float (*radius)[2],
                                        size_t n);
void embree_chords_free(struct embree_chords *scene);

/* The length of the union of a ray's chords; d has length 1. */
double embree_chords_union(const struct embree_chords *scene,
                           const cylint_line *ray);

#endif
