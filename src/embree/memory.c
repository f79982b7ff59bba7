/*
 * memory.c - memory from an Embree device, or from malloc()
 */
#ifdef __linux__
#define _DEFAULT_SOURCE /* madvise() */
#include <sys/mman.h>
#endif

#include "memory.h"

#include <stdint.h>
#include <stdlib.h>

enum { CACHE_LINE = 64, HUGE_PAGE = 2 << 20 };

/* What is read here and there is found sooner on few large pages. */
static void ask_for_huge_pages(void *data, size_t bytes)
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

int cylint_memory_take(cylint_memory *memory, RTCDevice device, size_t bytes)
{
    char *data = NULL;
    *memory = (cylint_memory){.bytes = bytes};
    if (bytes > SIZE_MAX - CACHE_LINE)
        return 0;
    if (!device)
        data = memory->own = malloc(bytes + CACHE_LINE);
    else if ((memory->buffer = rtcNewBuffer(device, bytes + CACHE_LINE)))
        data = rtcGetBufferData(memory->buffer);
    if (!data)
        return 0;
    memory->data = data + (CACHE_LINE - (uintptr_t)data % CACHE_LINE);
    ask_for_huge_pages(memory->data, bytes);
    return 1;
}

void cylint_memory_give(cylint_memory *memory)
{
    if (memory->buffer)
        rtcReleaseBuffer(memory->buffer);
    free(memory->own);
    *memory = (cylint_memory){0};
}
