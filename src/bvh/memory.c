/*
 * memory.c - memory in whole cache lines, on large pages where there are any
 */
#ifdef __linux__
#define _DEFAULT_SOURCE 1 /* madvise() */
#include <sys/mman.h>
#endif

#include "memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { CACHE_LINE = 64, HUGE_PAGE = 2 << 20 };

/* Random reads cost fewer address translations on large pages. */
static void request_huge_pages(void *data, size_t bytes)
{
#ifdef MADV_HUGEPAGE
    const uintptr_t from = ((uintptr_t)data + HUGE_PAGE - 1) / HUGE_PAGE;
    const uintptr_t to = ((uintptr_t)data + bytes) / HUGE_PAGE;
    if (from < to)
        madvise((void *)(from * HUGE_PAGE), (to - from) * HUGE_PAGE,
                MADV_HUGEPAGE);
#else
    (void)data;
    (void)bytes;
#endif
}

static void *allocate_from_heap(void *owner, size_t bytes, void **handle)
{
    (void)owner;
    return *handle = malloc(bytes);
}

static const cylint_memory_source heap = {NULL, allocate_from_heap, free};

/* The beginning of the next cache line. */
static char *whole_line(void *handle)
{
    return (char *)handle + (CACHE_LINE - (uintptr_t)handle % CACHE_LINE);
}

int cylint_memory_allocate(cylint_memory *memory,
                           const cylint_memory_source *source, size_t bytes)
{
    const cylint_memory_source *from = source ? source : &heap;
    void *handle;
    *memory = (cylint_memory){0};
    if (bytes > SIZE_MAX - CACHE_LINE)
        return 0;
    char *data = from->allocate(from->owner, bytes + CACHE_LINE, &handle);
    if (!data)
        return 0;
    *memory = (cylint_memory){whole_line(data), bytes, handle, from->release};
    request_huge_pages(memory->data, bytes);
    return 1;
}

int cylint_memory_resize(cylint_memory *memory,
                         const cylint_memory_source *source, size_t bytes)
{
    const size_t kept = bytes < memory->bytes ? bytes : memory->bytes;
    if (source) {
        cylint_memory other;
        if (!cylint_memory_allocate(&other, source, bytes))
            return 0;
        memcpy(other.data, memory->data, kept);
        cylint_memory_free(memory);
        *memory = other;
        return 1;
    }
    const ptrdiff_t at = (char *)memory->data - (char *)memory->handle;
    char *handle = realloc(memory->handle, bytes + CACHE_LINE);
    if (!handle)
        return bytes == kept; /* then the memory is longer than it need be */
    memmove(whole_line(handle), handle + at, kept);
    *memory = (cylint_memory){whole_line(handle), bytes, handle, free};
    return 1;
}

void *cylint_resized(void *array, size_t n, size_t size)
{
    if (n > PTRDIFF_MAX / size)
        return NULL;
    void *resized = realloc(array, n > 0 ? n * size : 1);
    if (resized)
        request_huge_pages(resized, n * size);
    return resized;
}

void *cylint_take_room(cylint_room *room, size_t n, size_t size)
{
    const size_t bytes = (n * size + 7) / 8 * 8;
    char *const taken = room->at;
    room->wanted += bytes;
    if (!taken || bytes > room->bytes)
        return NULL;
    room->at += bytes;
    room->bytes -= bytes;
    return taken;
}

void cylint_memory_free(cylint_memory *memory)
{
    if (memory->release)
        memory->release(memory->handle);
    *memory = (cylint_memory){0};
}
