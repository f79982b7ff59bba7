/*
 * distance_types.h - the text of distance_template.h in two types of numbers
 */
#ifndef CYLINT_DISTANCE_TYPES_H
#define CYLINT_DISTANCE_TYPES_H

#include "head_tail.h"
#include "pair_lanes.h"

#define NUMBER(name) head_tail_##name
#define ON_SURFACE 0
#include "distance_template.h"
#undef NUMBER
#undef ON_SURFACE

#define NUMBER(name) pairs_##name
#define ON_SURFACE 1
#include "distance_template.h"
#undef NUMBER
#undef ON_SURFACE

#endif
