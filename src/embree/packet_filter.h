/*
 * packet_filter.h - float_filter.h's questions, many at a time
 */
#ifndef CYLINT_EMBREE_PACKET_FILTER_H
#define CYLINT_EMBREE_PACKET_FILTER_H

#include "float_filter.h"

enum { CYLINT_PACKET_FILTER_MOST = 16 };

/* Of each question, as bits: whether it enters the shape at a hit; may do so,
 * but float_filter.h's functions must be asked; if not, whether it may still leave
 * it at one; and whether the hit is described.  Floats are as doubles. */
typedef struct cylint_packet_filter_results {
    unsigned hit, unsure, crosses, described;
    double t[CYLINT_PACKET_FILTER_MOST], t_error[CYLINT_PACKET_FILTER_MOST];
    double z[CYLINT_PACKET_FILTER_MOST], z_error[CYLINT_PACKET_FILTER_MOST];
    double float_z[CYLINT_PACKET_FILTER_MOST], phi[CYLINT_PACKET_FILTER_MOST];
    double normal[3][CYLINT_PACKET_FILTER_MOST];
} cylint_packet_filter_results;

/* n questions, 1 to CYLINT_PACKET_FILTER_MOST, of which all shapes are small or none
 * is.  describe: or no hit is described. */
typedef void cylint_packet_filter(const cylint_float_filter_target subject[],
                                  const cylint_float_filter_ray *const line[],
                                  int n, int describe,
                                  cylint_packet_filter_results *to);

/* Of the builds that this processor can run the i-th, the best first, or NULL:
 * there are no more. */
cylint_packet_filter *cylint_packet_filter_build(int i);

/* The builds. */
extern cylint_packet_filter cylint_packet_filter_plain,
    cylint_packet_filter_avx2, cylint_packet_filter_avx512;

#endif
