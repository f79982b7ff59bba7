/*
 * truth.h - what is right, and by how much an answer is wrong
 *
 * Verdicts and correctly rounded t are the tests' oracle's; here MPFR adds
 * what the rounding of t left over, so that an error below half an ulp can
 * be told.
 */
#ifndef BENCH_TRUTH_H
#define BENCH_TRUTH_H

#include "cylint.h"

struct truth {
    cylint_answer answer; /* relation, n, and of each hit t and part */
    double rest[2];       /* t + rest is the root; 0 where 640 bits do not
                             suffice to tell (exponents hundreds apart) */
    double size;          /* the shape's largest radius, over |d|: an error
                             of t divided by it is the hit's error along the
                             line in radii */
};

/* 0 where the reference is missing (built without MPFR). */
int truth_known(void);

void truth_of(const cylint_shape *shape, const cylint_line *line,
              struct truth *truth);

/* How an answer is wrong; the first that applies. */
enum verdict {
    VERDICT_RIGHT,
    VERDICT_NAN, /* a t is not a number, or infinite */
    VERDICT_HIT_AS_MISS,
    VERDICT_MISS_AS_HIT,
    VERDICT_TANGENT, /* touch called something else, or the reverse */
    VERDICT_ALONG,   /* the same of a line in the surface */
    VERDICT_NUMBER,  /* of hits */
    VERDICTS
};

enum verdict verdict_of(const struct truth *truth, unsigned want, int only_hit,
                        const cylint_answer *answer);

/* The error of hit i's t, in radii and in units in the last place. */
void error_of(const struct truth *truth, int i, double t, double *radii,
              double *ulps);

#endif
