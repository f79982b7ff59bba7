/*
 * device_memory.h - memory from an Embree device, as its memory monitor likes it
 *
 * Buffers, so that what the adapter holds is counted and may be refused like
 * Embree's own, the refusal being told to the device's error function.
 */
#ifndef CYLINT_EMBREE_DEVICE_MEMORY_H
#define CYLINT_EMBREE_DEVICE_MEMORY_H

#include "../bvh/memory.h"
#include "api.h"

cylint_memory_source cylint_device_memory(RTCDevice device);

#endif
