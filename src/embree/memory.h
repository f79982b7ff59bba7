/*
 * memory.h - memory from an Embree device, as its memory monitor likes it
 *
 * Buffers, so that what the adapter holds is counted and may be refused like
 * Embree's own, the refusal being told to the device's error function; or,
 * where there is no device (NULL), from malloc().
 */
#ifndef CYLINT_EMBREE_MEMORY_H
#define CYLINT_EMBREE_MEMORY_H

#include <stddef.h>

#include "api.h"

typedef struct cylint_memory {
    RTCBuffer buffer; /* the device's, or NULL */
    void *own;        /* from malloc(), or NULL */
    void *data;       /* on a cache line; NULL: none */
    size_t bytes;
} cylint_memory;

/* bytes > 0, not initialised.  0 where it was refused: *memory is none. */
int cylint_memory_take(cylint_memory *memory, RTCDevice device, size_t bytes);

/* Gives it back; none: does nothing. */
void cylint_memory_give(cylint_memory *memory);

#endif
