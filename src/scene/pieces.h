/*
 * pieces.h - the chords of a line in the shapes and in the solids of a scene
 */
#ifndef CYLINT_SCENE_PIECES_H
#define CYLINT_SCENE_PIECES_H

#include "visit.h"

/* A chord in a shape, or a piece in a solid. */
typedef struct cylint_numbered_chord {
    double t0, t1;
    uint32_t number;
} cylint_numbered_chord;

/* By t0, then by number. */
static inline int cylint_chord_is_before(const cylint_numbered_chord *x,
                                         const cylint_numbered_chord *y)
{
    const int64_t a = cylint_rank(x->t0), b = cylint_rank(y->t0);
    return a != b ? a < b : x->number < y->number;
}

/* Whether solid x owns a place that y contains too: it has the lesser rank, or the
 * same rank and the lower number. */
static inline int cylint_outranks(const int *rank, size_t x, size_t y)
{
    return rank && rank[x] != rank[y] ? rank[x] < rank[y] : x < y;
}

/* Whether the workspace has memory at all; else writes how much to try. */
static inline int cylint_has_room(cylint_workspace *work)
{
    enum { SOME = 16 * sizeof(cylint_numbered_chord) };
    if (work->bytes >= SOME)
        return 1;
    work->wanted = SOME;
    return 0;
}

/* The chords of a shape, as cylint_chord() writes them, for a line or for a point
 * (boundary.c: [0, 1] for a shape that contains it). */
typedef int cylint_chords_of_shape(const void *line, const cylint_shape *shape,
                                   cylint_interval chord[2]);

typedef struct cylint_domain {
    double tmin, tmax;
    cylint_chords_of_shape *chords;
    const void *line;
} cylint_domain;

/* Makes the chords in solids of the n chords in shapes, which have no duplicates
 * and at which the workspace begins.  Returns how many there are, behind these and
 * in no order, or CYLINT_NO_ROOM.  *spare: as much memory as they take.  A scene
 * without solids has those of its shapes, and *spare stays. */
size_t cylint_chords_of_solids(const cylint_scene *scene,
                               const cylint_domain *domain,
                               cylint_numbered_chord *of_shapes, size_t n,
                               cylint_workspace *work,
                               cylint_numbered_chord **of_solids,
                               cylint_numbered_chord **spare);

#endif
