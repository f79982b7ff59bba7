/*
 * sampling.h - points spread evenly over squares, discs and hemispheres
 *
 * Sample i of a pixel and a purpose is point i of Sobol's sequence in two
 * dimensions, shuffled and scrambled by a hash of both [Burley 2020, Laine &
 * Karras 2011]: any 2^m samples of a pixel are stratified over every
 * partition into 2^m elementary cells; pixels are independent of each other and
 * of the order in which they are traced.
 */
#ifndef CYLINT_SAMPLING_H
#define CYLINT_SAMPLING_H

#include <stdint.h>

#include "vector.h"

/* A well mixed function of two words. */
uint32_t hash_words(uint32_t a, uint32_t b);

/* Point `i` of the sequence `seed`, both coordinates in [0, 1). */
void sample_square(uint32_t i, uint32_t seed, double point[2]);

/* The same, mapped with equal areas to the disc of radius 1 about 0 that is
 * perpendicular to the unit vector n. */
struct vector sample_disc(uint32_t i, uint32_t seed, struct vector n);

/* A unit vector within 90 degrees of the unit vector n, with a density in
 * proportion to its cosine with n. */
struct vector sample_hemisphere(uint32_t i, uint32_t seed, struct vector n);

#endif
