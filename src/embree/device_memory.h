/*
 * device_memory.h - memory in buffers of an Embree device
 *
 * The device's memory monitor counts buffers and may refuse them, as it does
 * Embree's own memory; the device then calls its error function.
 */
#ifndef CYLINT_EMBREE_DEVICE_MEMORY_H
#define CYLINT_EMBREE_DEVICE_MEMORY_H

#include "../bvh/memory.h"
#include "api.h"

cylint_memory_source cylint_device_memory(RTCDevice device);

#endif
