/*
 * round_residual_lanes.h - round_residual_template.h in lanes
 */
#ifndef CYLINT_ROUND_RESIDUAL_LANES_H
#define CYLINT_ROUND_RESIDUAL_LANES_H

#include "../numbers/simd.h"

/* Of one root in each lane. */
#define V vd
#define PAIR vpair
#define FORM(name) name##_lanes
#define ADD(x, y) ((x) + (y))
#define SUB(x, y) ((x) - (y))
#define SUM_OF(x, y, z) v_sum_of(x, y, z)
#define NEGATED(x) (-(x))
#define RESULT(x, y, rest) (((x) + (y)) + (rest))
#define TWO_SUM(x, y) v_two_sum(x, y)
#define TWO_PROD(x, y) v_two_prod(x, y)
#include "round_residual_template.h"

#endif
