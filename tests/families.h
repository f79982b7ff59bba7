/*
 * families.h - the input every test and benchmark draws from
 *
 * A family is a kind of difficulty; a case is a line and a shape, fixed by
 * (seed, family, index) alone.  Without GSL there are no families.
 */
#ifndef CYLINT_FAMILIES_H
#define CYLINT_FAMILIES_H

#include <stdint.h>
#include <stdio.h>

#include "cylint.h"

typedef enum family_line {
    FAMILY_LINE,    /* o d */
    FAMILY_RAY,     /* o d */
    FAMILY_SEGMENT, /* a b */
    FAMILY_SPAN     /* o d tmin tmax */
} family_line;

typedef enum family_shape {
    FAMILY_CYLINDER,  /* p0 p1 r */
    FAMILY_CONE,      /* p0 r0 p1 r1 */
    FAMILY_ACONE,     /* v u angle */
    FAMILY_ECYLINDER, /* c a b h */
    FAMILY_ECONE      /* c a b h k */
} family_shape;

/* The numbers as a record of the command holds them, and what they make. */
struct family_case {
    family_line line_word;
    double line_data[8];
    family_shape shape_word;
    double shape_data[13];
    cylint_ends ends;
    cylint_line line;
    cylint_shape shape;
    cylint_status line_status, shape_status;
};

int family_count(void);
const char *family_name(int family);

/* 1 where exponents lie hundreds apart, so that most questions go to every
 * digit: slow to ask, and slower for the oracle. */
int family_is_wild(int family);

/* Case `index` of a family; line and shape are made (see the statuses). */
void family_case(uint64_t seed, int family, uint64_t index,
                 struct family_case *out);

/* Makes line and shape anew, after the data were changed.  1 if both are
 * valid. */
int family_make(struct family_case *c);

/* How many numbers a shape's or a line's record holds. */
int family_shape_size(family_shape word);
int family_line_size(family_line word);

/* The case as a record of the command, in hexadecimal, without newline. */
void family_print(FILE *to, const struct family_case *c);

#endif
