/*
 * families.h - the random lines and shapes of all tests and benchmarks
 *
 * A family is a kind of difficulty.  A case is a line and a shape; it depends
 * only on seed, family and index.
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
    FAMILY_ECONE,     /* c a b h k */
    FAMILY_SPHERE,    /* c r */
    FAMILY_CAPSULE,   /* p0 p1 r */
    FAMILY_RCONE,     /* p0 r0 p1 r1 */
    FAMILY_HALFSPACE  /* p n */
} family_shape;

enum { FAMILY_SHAPES = FAMILY_HALFSPACE + 1 };

/* The numbers of a record of the command, and the line and shape made of
 * them. */
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

/* The number of a family that exists. */
int family_named(const char *name);

/* Whether the exponents in a case differ by hundreds, so that most questions
 * need exact arithmetic.  Such families are slow, most of all in the oracle. */
int family_is_wild(int family);

/* Whether all lengths of a case are multiplied by one number of any size. */
int family_is_scaled(int family);

/* Whether its shapes are spheres, capsules and round cones. */
int family_is_round(int family);

/* Writes case `index` of a family and makes its line and shape; line_status and
 * shape_status hold their statuses.  Returns `out`. */
struct family_case *family_case(uint64_t seed, int family, uint64_t index,
                                struct family_case *out);

/* A loop over cases 0 to cases - 1 of each family.  In it c is the case, and family
 * and number are its own; a break leaves only this case. */
#define EACH_CASE(c, seed, cases)                                       \
    for (int family = 0; family < family_count(); family++)             \
        for (uint64_t number = 0; number < (uint64_t)(cases); number++) \
            for (struct family_case c,                                  \
                 *once = family_case(seed, family, number, &c);         \
                 once; once = NULL)

/* Makes line and shape from the numbers.  Returns 1 if both are valid.  The ends of
 * a half-space become infinite: it has no others. */
int family_make(struct family_case *c);

/* A case of the numbers of a record of a line and a capped shape, which are not
 * made yet. */
struct family_case family_of(family_line line, const double *line_data,
                             family_shape shape, const double *shape_data);

/* A line along z and a valid shape of this word, which are not made yet. */
struct family_case family_example(family_shape word);

/* The number of numbers in a record of the shape or line. */
int family_shape_size(family_shape word);
int family_line_size(family_line word);

/* How many of these, the first, are lengths: not an angle and not a factor. */
int family_lengths(family_shape word);

/* Whether number i is a radius, an angle or a factor. */
int family_is_size(family_shape word, int i);

/* Whether a shape has two points; others have one and an axis, a sphere has one.
 * The number of the first component of the second point, or of the axis. */
int family_has_points(family_shape word);
int family_axis(family_shape word);

/* Writes the numbers of a shape: its point, the vectors a and b of an elliptic one,
 * its second point or its axis, its first radius if it has two, and its last number
 * if that is a radius, an angle or a factor. */
void family_set_shape(struct family_case *c, family_shape word,
                      const double at[3], const double a[3], const double b[3],
                      const double to[3], double r0, double last);

/* Prints the case as a record of the command, in hexadecimal, without a
 * newline. */
void family_print(FILE *to, const struct family_case *c);

/* Reads what family_print() prints, numbers in decimal too, and makes it.  `ends`
 * may be missing, and so may the line, which is then the x axis.  Returns a
 * pointer behind it, or NULL. */
const char *family_parse(const char *text, struct family_case *c);

/* The case, or the shape, of a record that is right. */
struct family_case case_of(const char *text);
cylint_shape shape_of(const char *text);

/* Reads a case too that constructors refuse, and makes what they do not. */
const char *family_parse_any(const char *text, struct family_case *c);

/* Reads n numbers.  Returns a pointer behind them, or NULL. */
const char *family_numbers(const char *text, int n, double *to);

/* Prints a failed case on standard error, with a newline. */
void family_report(const struct family_case *c);

/* The same within a test of check.h, for its first failures only. */
#define REPORT_CASE(c) (check_bad <= CHECK_SHOWN ? family_report(c) : (void)0)

#endif
