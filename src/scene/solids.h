/*
 * solids.h - the solids of a scene that are made of shapes
 *
 * They are given as members: which shape belongs to which clause of which solid.
 * The other arrays are made of these.
 */
#ifndef CYLINT_SCENE_SOLIDS_H
#define CYLINT_SCENE_SOLIDS_H

#include <stdint.h>

#include "cylint_scene.h"

/* A member.  A negative clause: the complement. */
typedef struct cylint_membership {
    uint32_t shape, solid;
    int32_t clause;
} cylint_membership;

/* The hierarchy finds all lines that hit a bounded solid.  A member that is not in
 * it is late if all its solids are bounded: only these lines test it. */
typedef struct cylint_scene_solid {
    uint32_t number;             /* of the shape that stands for it */
    uint32_t clauses;            /* how many; 0: no member has this solid */
    uint32_t failing;            /* how many without a complement */
    uint32_t first_clause;       /* in `complements` */
    uint32_t first_late, n_late; /* of `late` */
    int is_bounded;
} cylint_scene_solid;

typedef struct cylint_solids {
    size_t n_members;
    const cylint_membership *given; /* as they were set */
    /* In these the clauses of a solid have the numbers 1, 2, ... */
    cylint_membership *of_shapes; /* sorted by shape ... */
    uint32_t *first_of_shape; /* ... where those of each begin, and the end */
    cylint_membership *late;  /* late members, sorted by solid */
    size_t n, most_clauses;   /* of solids; of the clauses of one */
    cylint_scene_solid *solid;
    int32_t *complements; /* of each clause of each solid, how many */
    uint32_t *always;     /* shapes beside the hierarchy that all lines test */
    uint32_t *holding; /* solids that contain all points outside their shapes */
    size_t n_always, n_holding;
    void *memory; /* of these arrays */
    size_t bytes;
} cylint_solids;

struct cylint_scene;

/* Makes the other members of `given` and `n_members`, which the caller keeps.  On a
 * failure cylint_solids_free() is needed as well. */
cylint_scene_status cylint_solids_make(cylint_solids *solids,
                                       const struct cylint_scene *scene);

/* Whether a shape is a late member, see cylint_scene_solid.  The scene has
 * solids. */
int cylint_is_late(const struct cylint_scene *scene, uint32_t shape);

/* Frees the memory of all but `given`. */
void cylint_solids_free(cylint_solids *solids);

static inline int cylint_is_member(const cylint_solids *solids, size_t shape)
{
    return solids->n > 0 &&
           solids->first_of_shape[shape] < solids->first_of_shape[shape + 1];
}

#endif
