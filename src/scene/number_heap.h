/*
 * number_heap.h - the lowest of many numbers of shapes
 */
#ifndef CYLINT_SCENE_NUMBER_HEAP_H
#define CYLINT_SCENE_NUMBER_HEAP_H

#include <stddef.h>

/* A heap of the lowest numbers from `first` on, with the highest of them
 * first.  values: NULL, or an array with a value for each number. */
typedef struct {
    size_t *numbers;
    double *values;
    size_t n, capacity, first;
} cylint_number_heap;

/* Whether the number may be one of the lowest. */
static inline int cylint_heap_accepts(const cylint_number_heap *heap,
                                      size_t number)
{
    return number >= heap->first &&
           (heap->n < heap->capacity || number < heap->numbers[0]);
}

/* Adds an accepted number.  If the heap is full, it replaces the highest. */
void cylint_heap_add(cylint_number_heap *heap, size_t number, double value);

/* Sorts the numbers, ascending.  Then they are no heap. */
void cylint_heap_sort(cylint_number_heap *heap);

#endif
