/*
 * turn_points.h - turns_of() over arrays, of every instruction set
 */
#ifndef TESTS_TURN_POINTS_H
#define TESTS_TURN_POINTS_H

#include <stddef.h>

#include "numbers/double_double.h"

typedef struct {
    pair x, y;
    double ex, ey;
} turn_point;

typedef struct {
    pair turn;
    double error;
} turn_answer;

/* n is a multiple of 8. */
typedef void turns_of_points(size_t n, const turn_point *, turn_answer *);
turns_of_points turns_plain, turns_one, turns_narrow, turns_avx2, turns_avx512;

#endif
