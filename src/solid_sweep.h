/*
 * solid_sweep.h - where a line is inside a solid made of shapes
 *
 * At an event a line enters or leaves a shape.  A member of a clause holds within
 * the shape's chords, or outside them.  `holding` counts the members of each clause
 * that hold; a line is inside where no clause has 0.
 */
#ifndef CYLINT_SOLID_SWEEP_H
#define CYLINT_SOLID_SWEEP_H

#include <stdint.h>

#include "numbers/bits.h"
#include "cylint_pieces.h"

typedef struct cylint_event {
    double t;
    uint32_t solid;
    int32_t clause; /* its number from 1; negative: a member ceases to hold */
} cylint_event;

static inline int cylint_event_is_before(const cylint_event *x,
                                         const cylint_event *y)
{
    return x->solid != y->solid ? x->solid < y->solid : cylint_less(x->t, y->t);
}

#define SORTED cylint_event
#define IS_BEFORE(x, y) cylint_event_is_before(x, y)
#define SORT cylint_sort_events
#include "merge_sort_template.h"

/* Gets a piece; returns 0 if no more are wanted. */
typedef int cylint_piece_use(void *self, double t0, double t1);

/* The two events of a chord, of a member of clause c, or of a complement (-c). */
static inline void cylint_add_events(cylint_event *to, cylint_interval chord,
                                     uint32_t solid, int32_t clause)
{
    to[0] = (cylint_event){chord.t0, solid, clause};
    to[1] = (cylint_event){chord.t1, solid, -clause};
}

/* Calls `use` for each piece in [tmin, tmax], ascending.  Events are sorted by t.
 * holding[c - 1]: how many members of clause c hold outside all shapes; read and
 * changed for the clauses of events.  failing: how many of all clauses have no such
 * member. */
static inline void cylint_sweep_solid(const cylint_event *event, size_t n,
                                      int32_t *holding, size_t failing,
                                      double tmin, double tmax,
                                      cylint_piece_use *use, void *self)
{
    size_t i = 0;
    double t = tmin, begin = tmin;
    int was_inside = 0;
    for (;;) {
        for (; i < n && !cylint_less(t, event[i].t); i++) {
            const int32_t c = event[i].clause;
            int32_t *count = &holding[(c > 0 ? c : -c) - 1];
            if (c > 0)
                failing -= (*count)++ == 0;
            else
                failing += --*count == 0;
        }
        const int is_inside = failing == 0 && cylint_less(t, tmax);
        if (is_inside && !was_inside)
            begin = t;
        if (was_inside && !is_inside && !use(self, begin, t))
            return;
        if (!cylint_less(t, tmax))
            return;
        was_inside = is_inside;
        t = i < n && cylint_less(event[i].t, tmax) ? event[i].t : tmax;
    }
}

#endif
