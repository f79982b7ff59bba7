/*
 * turns.h - angles in turns: 1 is a whole turn
 *
 * A node is an angle of k/256 turns, 0 <= k <= 32.  The angle of (u, v), where
 * 0 <= v <= u, is that of a node near to it and atan(q), where
 *
 *     q = (v cos - u sin) / (u cos + v sin),   |q| < CYLINT_TURN_TANGENT
 *
 * is the tangent of the angle beyond the node.  The nodes, and the multiples of a
 * quarter by which the octants differ, are doubles.  So only the angle beyond the
 * node has an error.
 */
#ifndef CYLINT_NUMBERS_TURNS_H
#define CYLINT_NUMBERS_TURNS_H

#include "compiler.h"

/* Of each node the cosine, hi and lo, and the sine, hi and lo. */
extern const double cylint_turn_node[33][4] CYLINT_HIDDEN;

/* The node is the nearest to r (SLOPE - CURVE r), r = v / u, which differs from
 * the angle by less than 0.137 nodes.  Then |q| <= tan(0.637 / 256 turns). */
#define CYLINT_TURN_SLOPE 0.167858
#define CYLINT_TURN_CURVE 0.042325
#define CYLINT_TURN_TANGENT 0x1.02p-6

/* 1 / (2 pi) as a pair. */
#define CYLINT_TURN_PER_RADIAN 0x1.45f306dc9c883p-3
#define CYLINT_TURN_PER_RADIAN_LO -0x1.6b01ec5417056p-57

#endif
