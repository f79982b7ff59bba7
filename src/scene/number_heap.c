/*
 * number_heap.c - the lowest of many numbers of shapes
 */
#include "number_heap.h"

static void put(cylint_number_heap *heap, size_t at, size_t number,
                double value)
{
    heap->numbers[at] = number;
    if (heap->values)
        heap->values[at] = value;
}

static void move(cylint_number_heap *heap, size_t to, size_t from)
{
    put(heap, to, heap->numbers[from], heap->values ? heap->values[from] : 0);
}

/* Stores the number in the heap of `n` numbers without its first. */
static void sift_down(cylint_number_heap *heap, size_t n, size_t number,
                      double value)
{
    const size_t *numbers = heap->numbers;
    size_t at = 0, child;
    while ((child = 2 * at + 1) < n) {
        child += child + 1 < n && numbers[child + 1] > numbers[child];
        if (numbers[child] <= number)
            break;
        move(heap, at, child);
        at = child;
    }
    put(heap, at, number, value);
}

static void sift_up(cylint_number_heap *heap, size_t at, size_t number,
                    double value)
{
    for (; at > 0 && heap->numbers[(at - 1) / 2] < number; at = (at - 1) / 2)
        move(heap, at, (at - 1) / 2);
    put(heap, at, number, value);
}

void cylint_heap_add(cylint_number_heap *heap, size_t number, double value)
{
    if (heap->n < heap->capacity)
        sift_up(heap, heap->n++, number, value);
    else
        sift_down(heap, heap->capacity, number, value);
}

void cylint_heap_sort(cylint_number_heap *heap)
{
    for (size_t n = heap->n; n-- > 1;) {
        const size_t number = heap->numbers[n];
        const double value = heap->values ? heap->values[n] : 0;
        move(heap, n, 0);
        sift_down(heap, n, number, value);
    }
}
