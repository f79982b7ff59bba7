/*
 * record.h - two points and a radius at each: the arguments of a constructor
 *
 * Scenes keep these in place of shapes (scene/records.h).
 */
#ifndef CYLINT_RECORD_H
#define CYLINT_RECORD_H

typedef struct cylint_record {
    double p0[3], r0, p1[3], r1;
} cylint_record;

#endif
