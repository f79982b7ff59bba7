/*
 * packet_filter.h - float_filter.h's questions, many at a time
 */
#ifndef CYLINT_EMBREE_PACKET_FILTER_H
#define CYLINT_EMBREE_PACKET_FILTER_H

#include "float_filter.h"

enum { CYLINT_QUICK_MOST = 16 };

/* Of each question, as bits: whether it enters the shape at a hit; may do so,
 * but float_filter.h's functions must be asked; if not, whether it may still leave
 * it at one; and whether the hit is described.  Floats are as doubles. */
typedef struct cylint_quick_answers {
    unsigned hit, unsure, crosses, described;
    double t[CYLINT_QUICK_MOST], t_error[CYLINT_QUICK_MOST];
    double z[CYLINT_QUICK_MOST], z_error[CYLINT_QUICK_MOST];
    double float_z[CYLINT_QUICK_MOST], phi[CYLINT_QUICK_MOST];
    double normal[3][CYLINT_QUICK_MOST];
} cylint_quick_answers;

/* n questions, 1 to CYLINT_QUICK_MOST, of which all shapes are small or none
 * is.  describe: or no hit is described. */
typedef void cylint_quick_many(const cylint_quick_subject subject[],
                               const cylint_quick_line *const line[], int n,
                               int describe, cylint_quick_answers *to);

/* Of the builds that this processor can run the i-th, the best first, or NULL:
 * there are no more. */
cylint_quick_many *cylint_quick_many_build(int i);

/* The builds. */
extern cylint_quick_many cylint_quick_many_plain, cylint_quick_many_avx2,
    cylint_quick_many_avx512;

#endif
