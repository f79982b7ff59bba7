/*
 * memory.h - memory in whole cache lines, from malloc() or another source
 */
#ifndef CYLINT_BVH_MEMORY_H
#define CYLINT_BVH_MEMORY_H

#include <stddef.h>

/* allocate() returns `bytes` bytes of `owner`, or NULL, and writes *handle, the
 * argument of release(). */
typedef struct cylint_memory_source {
    void *owner;
    void *(*allocate)(void *owner, size_t bytes, void **handle);
    void (*release)(void *handle);
} cylint_memory_source;

typedef struct cylint_memory {
    void *data; /* at the start of a cache line; NULL: no memory */
    size_t bytes;
    void *handle;
    void (*release)(void *handle); /* NULL: the data are the caller's */
} cylint_memory;

/* Allocates bytes without initialising them, by malloc() if `source` is
 * NULL.  Returns 0 and no memory if the source refuses. */
int cylint_memory_allocate(cylint_memory *memory,
                           const cylint_memory_source *source, size_t bytes);

/* Makes the memory `bytes` bytes long, with the first bytes of before; it may move.
 * Returns 0, and the memory stays as it is, if the source refuses memory.  A
 * malloc() that refuses to shorten it is no failure: the memory stays longer. */
int cylint_memory_resize(cylint_memory *memory,
                         const cylint_memory_source *source, size_t bytes);

/* realloc() of n elements, which may be none; of many, on large pages if the system
 * has some.  Returns NULL, and the array stays, if there is no memory. */
void *cylint_resized(void *array, size_t n, size_t size);

/* Memory that is not used yet.  `wanted` also counts what did not fit. */
typedef struct cylint_room {
    char *at;
    size_t bytes, wanted;
} cylint_room;

/* Returns memory for n elements, or NULL. */
void *cylint_take_room(cylint_room *room, size_t n, size_t size);

/* Releases the memory, if there is any. */
void cylint_memory_free(cylint_memory *memory);

#endif
