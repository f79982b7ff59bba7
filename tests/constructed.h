/*
 * constructed.h - exact coincidences in whole numbers, and their neighbours
 *
 * A base is a line that is tangent to a shape, passes a rim or the apex, or
 * runs along a ruling, exactly, for all five kinds; its neighbours have one
 * of its numbers moved by -4 to +4 units in the last place, every number by
 * every amount.  Unlike the families these need no GSL.
 */
#ifndef CYLINT_CONSTRUCTED_H
#define CYLINT_CONSTRUCTED_H

#include "families.h"

enum { CONSTRUCTED_SHIFTS = 9, CONSTRUCTED_MOST = 21 * CONSTRUCTED_SHIFTS };

/* Base number `base` of a seed. */
void constructed_base(uint64_t seed, uint64_t base, struct family_case *out);

/* How many neighbours a base has, itself among them once per number. */
int constructed_neighbours(const struct family_case *base);

/* Neighbour `which` of it; 0 where the numbers make no shape or line. */
int constructed_neighbour(const struct family_case *base, int which,
                          struct family_case *out);

/* Every number with an exponent of its own out of -1074 ... 1023. */
void constructed_wild(uint64_t seed, uint64_t index, struct family_case *out);

/* Small whole numbers or tenths, often along the coordinates, rarely one that
 * is far from the others. */
void constructed_plain(uint64_t seed, uint64_t index, struct family_case *out);

/* x moved by that many units in the last place; infinities not reached. */
double constructed_stepped(double x, int ulps);

#endif
