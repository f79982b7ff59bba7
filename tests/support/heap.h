/*
 * heap.h - malloc() and the like, which count and can be refused
 *
 * The linker puts these functions in place of the library's (--wrap).
 */
#ifndef CYLINT_TEST_HEAP_H
#define CYLINT_TEST_HEAP_H

#include <errno.h>
#include <stdlib.h>

#define ADD(counter, n) __atomic_add_fetch(&(counter), (n), __ATOMIC_SEQ_CST)

static struct {
    int unwatched;
    long long requested;
    long long refuse; /* the number of the one that fails, from 1; 0: none */
    long long refuse_from; /* the same, and all later ones */
    long long held, most;  /* not freed yet; the most at one time */
    long long bytes;       /* of malloc() and calloc() */
    int kept;              /* realloc() of existing memory was refused */
} heap;

void *__real_malloc(size_t);
void *__real_calloc(size_t, size_t);
void *__real_realloc(void *, size_t);
void __real_free(void *);
void *__wrap_malloc(size_t);
void *__wrap_calloc(size_t, size_t);
void *__wrap_realloc(void *, size_t);
void __wrap_free(void *);

static int heap_refuses(void)
{
    if (heap.unwatched)
        return 0;
    const long long n = ADD(heap.requested, 1);
    if (n != heap.refuse && !(heap.refuse_from && n >= heap.refuse_from))
        return 0;
    errno = ENOMEM;
    return 1;
}

static void *heap_hold(void *p)
{
    const long long held = ADD(heap.held, !heap.unwatched && p);
    heap.most = held > heap.most ? held : heap.most;
    return p;
}

void *__wrap_malloc(size_t size)
{
    ADD(heap.bytes, (long long)size);
    return heap_refuses() ? NULL : heap_hold(__real_malloc(size));
}

void *__wrap_calloc(size_t n, size_t size)
{
    ADD(heap.bytes, (long long)(n * size));
    return heap_refuses() ? NULL : heap_hold(__real_calloc(n, size));
}

void *__wrap_realloc(void *p, size_t size)
{
    if (heap_refuses()) {
        heap.kept = p != NULL;
        return NULL;
    }
    void *q = __real_realloc(p, size);
    return p ? q : heap_hold(q);
}

void __wrap_free(void *p)
{
    ADD(heap.held, -(!heap.unwatched && p));
    __real_free(p);
}

#endif
