/*
 * packet.h - the rays of a packet at the shapes of a primitive
 */
#ifndef CYLINT_EMBREE_PACKET_H
#define CYLINT_EMBREE_PACKET_H

#include "shape_test.h"

/* All rays of a packet. */
void cylint_trace_packet(query *q, unsigned primID, int *valid, void *packet,
                         unsigned N);

#endif
