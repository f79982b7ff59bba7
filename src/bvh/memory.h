/*
 * memory.h - memory on whole cache lines, from malloc() or from elsewhere
 */
#ifndef CYLINT_BVH_MEMORY_H
#define CYLINT_BVH_MEMORY_H

#include <stddef.h>

/* take() returns so many bytes of `owner`, or NULL, and in *handle what
 * give() wants in order to take them back. */
typedef struct cylint_memory_source {
    void *owner;
    void *(*take)(void *owner, size_t bytes, void **handle);
    void (*give)(void *handle);
} cylint_memory_source;

typedef struct cylint_memory {
    void *data; /* on a cache line; NULL: none */
    size_t bytes;
    void *handle;
    void (*give)(void *handle);
} cylint_memory;

/* bytes > 0, not initialised; source NULL: from malloc().  0 where it was
 * refused: *memory is none. */
int cylint_memory_allocate(cylint_memory *memory,
                           const cylint_memory_source *source, size_t bytes);

/* Gives it back; none: does nothing. */
void cylint_memory_free(cylint_memory *memory);

#endif
