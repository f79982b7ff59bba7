/*
 * embree_chords.h - the union of chords in cylinders, as a caller of Embree computes it
 */
#ifndef BENCH_EMBREE_CHORDS_H
#define BENCH_EMBREE_CHORDS_H

#include <stddef.h>

#include "cylint.h"

/* axis: of length 1.  One line of a cache. */
struct prepared_cylinder {
    double p[3], axis[3], length, r;
};

/* Keeps `cylinders`.  Ends the program if Embree fails. */
struct embree_chords *embree_chords_new(
    const struct prepared_cylinder *cylinders, size_t n);
void embree_chords_free(struct embree_chords *scene);

/* Adds the length of the union of a ray's chords to *sum, and returns how many pieces it
 * has.  d: of length 1. */
size_t embree_chords_union(struct embree_chords *scene, const cylint_line *ray,
                           double *sum);

#endif
