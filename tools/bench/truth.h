/*
 * truth.h - the correct answer, and the error of another answer
 *
 * The tests' oracle computes verdicts and correctly rounded t.  Here MPFR adds
 * the rest of each root, root - t, so that errors below half an ulp can be
 * measured.
 */
#ifndef BENCH_TRUTH_H
#define BENCH_TRUTH_H

#include "cylint.h"

struct truth {
    cylint_answer answer; /* relation, n, and of each hit t and part */
    double rest[2];       /* t + rest is the root; 0 where 640 bits are
                             too few (exponents hundreds apart) */
    double size;          /* the shape's largest radius over |d|: an error
                             of t over it is the hit's error along the
                             line in radii */
};

/* 0 if built without MPFR. */
int truth_known(void);

void truth_of(const cylint_shape *shape, const cylint_line *line,
              struct truth *truth);

/* The kind of a wrong answer: the first that applies. */
enum verdict {
    VERDICT_RIGHT,
    VERDICT_NAN, /* a t is NaN or infinite */
    VERDICT_HIT_AS_MISS,
    VERDICT_MISS_AS_HIT,
    VERDICT_TANGENT, /* touch for another relation, or the reverse */
    VERDICT_ALONG,   /* the same with along */
    VERDICT_NUMBER,  /* another number of hits */
    VERDICTS
};

enum verdict verdict_of(const struct truth *truth, unsigned want, int only_hit,
                        const cylint_answer *answer);

/* The error of hit i's t in radii and in ulp. */
void error_of(const struct truth *truth, int i, double t, double *radii,
              double *ulps);

#endif
