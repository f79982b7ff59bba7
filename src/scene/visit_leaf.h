/*
 * visit_leaf.h - tests the shapes of a leaf, each once in a visit
 *
 * The hierarchy finds a shape of several pieces several times.  A direct-mapped
 * cache of the shapes that were tested last saves repeated tests.  A hash table
 * with open addressing has those that were visited; if it is full, the piece that
 * contains the first hit or the nearest point decides.
 */
#ifndef CYLINT_SCENE_VISIT_LEAF_H
#define CYLINT_SCENE_VISIT_LEAF_H

#include <string.h>

#include "scene.h"

enum { CYLINT_RECENT = 16, CYLINT_SET_SIZE = 256, CYLINT_SET_MOST = 192 };

/* No shape has this number. */
#define CYLINT_NO_SHAPE UINT32_MAX

typedef struct cylint_tested_shapes {
    int often; /* a shape may be visited more than once: without the table */
    int visited;
    uint32_t recent[CYLINT_RECENT], slot[CYLINT_SET_SIZE];
} cylint_tested_shapes;

static inline void cylint_begin_tests(cylint_tested_shapes *s, int often)
{
    s->often = often;
    s->visited = 0;
    memset(s->recent, 0xff, sizeof s->recent); /* CYLINT_NO_SHAPE */
    if (!often)
        memset(s->slot, 0xff, sizeof s->slot);
}

/* Whether the shape is in the cache, in which it is afterwards. */
static inline int cylint_was_tested(cylint_tested_shapes *s, uint32_t number)
{
    uint32_t *recent = &s->recent[number % CYLINT_RECENT];
    const int was = *recent == number;
    *recent = number;
    return was;
}

/* The slot of the table that has the number or is free for it. */
static inline uint32_t *cylint_slot_of(cylint_tested_shapes *s, uint32_t number)
{
    uint32_t at = number * UINT32_C(2654435769) >> 24;
    while (s->slot[at] != number && s->slot[at] != CYLINT_NO_SHAPE)
        at = (at + 1) % CYLINT_SET_SIZE;
    return &s->slot[at];
}

/* Tests a shape and calls back for it.  Returns whether it did. */
typedef int cylint_shape_test(void *visit, size_t number);

/* Whether the lane's piece contains the first hit or the nearest point of its
 * shape. */
typedef int cylint_owner_test(const void *visit, const cylint_leaf *leaf,
                              int lane);

/* Tests the shape of a lane, unless it was tested. */
CYLINT_INLINE void cylint_test_lane(cylint_tested_shapes *s,
                                    const cylint_leaf *leaf, int lane,
                                    cylint_shape_test *test,
                                    cylint_owner_test *owns, void *visit)
{
    const uint32_t number = leaf->number[lane];
    if (cylint_leaf_piece(leaf, lane).count == 1) {
        test(visit, number);
        return;
    }
    if (s->often) {
        if (!cylint_was_tested(s, number))
            test(visit, number);
        return;
    }
    uint32_t *slot = cylint_slot_of(s, number);
    if (*slot == number)
        return;
    if (s->visited == CYLINT_SET_MOST) {
        if (owns(visit, leaf, lane))
            test(visit, number);
    } else if (!cylint_was_tested(s, number) && test(visit, number)) {
        *slot = number;
        s->visited++;
    }
}

/* The lane with the least bound. */
static inline int cylint_first_lane(unsigned lanes,
                                    const double least[CYLINT_LEAF_SIZE])
{
    int first = cylint_lowest(lanes);
    while (lanes &= lanes - 1)
        if (least[cylint_lowest(lanes)] < least[first])
            first = cylint_lowest(lanes);
    return first;
}

/* Begins to load the lanes' shapes.  Always inlined: GCC removes calls of a
 * function which only prefetches. */
CYLINT_INLINE void cylint_prefetch_shapes(const cylint_scene *scene,
                                          const cylint_leaf *leaf,
                                          unsigned lanes)
{
    const cylint_records *r = &scene->records;
    for (; lanes; lanes &= lanes - 1) {
        const uint32_t number = leaf->number[cylint_lowest(lanes)];
        CYLINT_PREFETCH(&r->record[number]);
        CYLINT_PREFETCH(&r->record[number].r1); /* in another line */
        CYLINT_PREFETCH(&r->tag[number]);
    }
}

#endif
