/*
 * radical.h - R = sqrt(S G), half the square root of the discriminant
 *
 * Over an arithmetic with a product and a square root.  Of kinds whose S is a
 * square (forms_template.h), S here is its root, form_root_of_S().
 */
#ifndef CYLINT_RADICAL_H
#define CYLINT_RADICAL_H

#include "../shapes/shape_facts.h"

#define CYLINT_RADICAL(kind, S, G, MUL, SQRT) \
    (cylint_S_is_square(kind) ? MUL(S, SQRT(G)) : SQRT(MUL(S, G)))

#endif
