/*
 * device_memory.c - memory in buffers of an Embree device
 */
#include "device_memory.h"

static void *allocate_buffer(void *device, size_t bytes, void **handle)
{
    RTCBuffer buffer = rtcNewBuffer(device, bytes);
    *handle = buffer;
    return buffer ? rtcGetBufferData(buffer) : NULL;
}

static void release_buffer(void *buffer)
{
    rtcReleaseBuffer(buffer);
}

cylint_memory_source cylint_device_memory(RTCDevice device)
{
    return (cylint_memory_source){device, allocate_buffer, release_buffer};
}
