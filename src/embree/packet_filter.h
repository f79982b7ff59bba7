/*
 * packet_filter.h - the float filter, one question in each vector lane
 */
#ifndef CYLINT_EMBREE_PACKET_FILTER_H
#define CYLINT_EMBREE_PACKET_FILTER_H

#include "float_filter.h"

enum { CYLINT_PACKET_FILTER_MOST = 16 };

/* For each question, as bits: hit, the line enters the shape at a hit; uncertain,
 * the functions of float_filter.h must decide; crosses, without a hit at the
 * entry there may be one at the exit; described, the floats of the hit are
 * certain.  Floats are stored as doubles. */
typedef struct cylint_packet_filter_results {
    unsigned hit, uncertain, crosses, described;
    double t[CYLINT_PACKET_FILTER_MOST], t_error[CYLINT_PACKET_FILTER_MOST];
    double z[CYLINT_PACKET_FILTER_MOST], z_error[CYLINT_PACKET_FILTER_MOST];
    double float_z[CYLINT_PACKET_FILTER_MOST], phi[CYLINT_PACKET_FILTER_MOST];
    double normal[3][CYLINT_PACKET_FILTER_MOST];
} cylint_packet_filter_results;

/* Answers n questions, 1 to CYLINT_PACKET_FILTER_MOST.  All shapes are small or
 * none is.  describe = 0: no hit is described. */
typedef void cylint_packet_filter(const cylint_float_filter_target target[],
                                  const cylint_float_filter_ray *const line[],
                                  int n, int describe,
                                  cylint_packet_filter_results *to);

/* The build in use. */
cylint_packet_filter *cylint_packet_filter_used(void);

/* All builds. */
extern cylint_packet_filter cylint_packet_filter_plain,
    cylint_packet_filter_avx2, cylint_packet_filter_avx512;

#endif
