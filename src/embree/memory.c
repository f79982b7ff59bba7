/*
 * memory.c - memory from an Embree device
 */
#include "memory.h"

#include <stdint.h>

enum { CACHE_LINE = 64 };

int cylint_memory_take(cylint_memory *memory, RTCDevice device, size_t bytes)
{
    memory->data = NULL;
    memory->bytes = bytes;
    memory->buffer = bytes <= SIZE_MAX - CACHE_LINE
                   ? rtcNewBuffer(device, bytes + CACHE_LINE) : NULL;
    if (memory->buffer) {
        char *data = rtcGetBufferData(memory->buffer);
        memory->data = data + (CACHE_LINE - (uintptr_t)data % CACHE_LINE);
    }
    return memory->buffer != NULL;
}

void cylint_memory_give(cylint_memory *memory)
{
    if (memory->buffer)
        rtcReleaseBuffer(memory->buffer);
    *memory = (cylint_memory){0};
}
