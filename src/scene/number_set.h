/*
 * number_set.h - a set of a few numbers of shapes
 *
 * The hierarchy finds a shape of several pieces several times.
 */
#ifndef CYLINT_SCENE_NUMBER_SET_H
#define CYLINT_SCENE_NUMBER_SET_H

#include <stdint.h>
#include <string.h>

enum { CYLINT_SET_SIZE = 256, CYLINT_SET_MOST = 192 };

/* No shape has this number. */
#define CYLINT_NO_SHAPE UINT32_MAX

/* A hash table with open addressing. */
typedef struct {
    uint32_t slot[CYLINT_SET_SIZE];
    int n;
} cylint_number_set;

static inline void cylint_set_clear(cylint_number_set *set)
{
    set->n = 0;
    memset(set->slot, 0xff, sizeof set->slot); /* CYLINT_NO_SHAPE */
}

static inline int cylint_set_is_full(const cylint_number_set *set)
{
    return set->n == CYLINT_SET_MOST;
}

/* The slot that has the number or is free for it. */
static inline uint32_t *cylint_set_slot(cylint_number_set *set, uint32_t number)
{
    uint32_t at = number * UINT32_C(2654435769) >> 24;
    while (set->slot[at] != number && set->slot[at] != CYLINT_NO_SHAPE)
        at = (at + 1) % CYLINT_SET_SIZE;
    return &set->slot[at];
}

/* Adds the number to its slot, which is free.  The set is not full. */
static inline void cylint_set_add(cylint_number_set *set, uint32_t *slot,
                                  uint32_t number)
{
    *slot = number;
    set->n++;
}

#endif
