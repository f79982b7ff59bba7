/*
 * constructed.h - exact coincidences in whole numbers, and their neighbours
 *
 * A base is a shape and a line that is exactly tangent, through a rim or the
 * apex, or along a ruling, for all five kinds.  A neighbour has one of the
 * base's numbers moved by -4 to +4 ulp; there is one for every number and every
 * amount.
 */
#ifndef CYLINT_CONSTRUCTED_H
#define CYLINT_CONSTRUCTED_H

#include "families.h"

enum { CONSTRUCTED_SHIFTS = 9, CONSTRUCTED_MOST = 21 * CONSTRUCTED_SHIFTS };

/* Writes base number `base` of a seed. */
void constructed_base(uint64_t seed, uint64_t base, struct family_case *out);

/* The number of neighbours of a base, counting the base once per number. */
int constructed_neighbours(const struct family_case *base);

/* Writes neighbour `which`; returns 0 if the numbers make no shape or line. */
int constructed_neighbour(const struct family_case *base, int which,
                          struct family_case *out);

/* Every number has its own exponent in -1074 ... 1023. */
void constructed_wild(uint64_t seed, uint64_t index, struct family_case *out);

/* Small whole numbers or tenths, often along the coordinates, rarely with one
 * number far from the others. */
void constructed_plain(uint64_t seed, uint64_t index, struct family_case *out);

#endif
