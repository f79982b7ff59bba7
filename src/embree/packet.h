/*
 * packet.h - traces the rays of a packet through the shapes of a geometry
 */
#ifndef CYLINT_EMBREE_PACKET_H
#define CYLINT_EMBREE_PACKET_H

#include "ray.h"

/* r: a ray test with the data, context and arguments that all rays share. */
void cylint_trace_packet(ray_test *r, unsigned primID, int *valid, void *packet,
                         unsigned N);

#endif
