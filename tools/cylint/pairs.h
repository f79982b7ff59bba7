/*
 * pairs.h - pairs of lines and shapes, answered in batches
 *
 * A record's line and shape are written to the arrays that the library's
 * batches read.  The answers are the same as one at a time.
 */
#ifndef CYLINT_PAIRS_H
#define CYLINT_PAIRS_H

#include "cylint.h"
#include "grammar.h"

enum { PAIRS_MOST = 256 }; /* their memory, 230 kB, stays in the cache */

struct pairs {
    int count;
    cylint_line line; /* of the next pair, until pairs_take() */
    cylint_shape shapes[PAIRS_MOST];
    double o[3][PAIRS_MOST], d[3][PAIRS_MOST];
    double tmin[PAIRS_MOST], tmax[PAIRS_MOST];
    const char *tail[PAIRS_MOST];
    size_t tail_length[PAIRS_MOST];

    signed char relation[PAIRS_MOST], n[PAIRS_MOST];
    signed char part0[PAIRS_MOST], part1[PAIRS_MOST];
    double t0[PAIRS_MOST], t1[PAIRS_MOST];
    void *memory; /* for packing the shapes */
};

/* NULL: no memory. */
struct pairs *pairs_make(void);
void pairs_free(struct pairs *pairs);

/* Whether lines of this kind and a cylint_intersect() mask can be answered in
 * batches.  Batches have rounded directions, and no sides. */
int pairs_can_answer(int line_kind, unsigned want, int sides);

/* Sets the places of line, shape and tail to those of the next pair.
 * pairs_take() adds it. */
void pairs_place(struct pairs *pairs, struct parts *parts);
void pairs_take(struct pairs *pairs);

/* Intersects all pairs.  Of each answer the wanted members, relation and n are
 * written. */
void pairs_intersect(struct pairs *pairs, unsigned want);
void pairs_get(const struct pairs *pairs, int i, unsigned want,
               cylint_answer *answer);

#endif
