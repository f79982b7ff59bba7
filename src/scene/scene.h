/*
 * scene.h - the members of a scene
 */
#ifndef CYLINT_SCENE_SCENE_H
#define CYLINT_SCENE_SCENE_H

#include <math.h>
#include <stdint.h>

#include "cylint_scene.h"
#include "../bvh/traverse.h"
#include "frame.h"
#include "records.h"

enum { CYLINT_SCENE_MOST_SHAPES = 1 << 28 };

/* Solids are given as members: which shape belongs to which clause of which solid.
 * The other arrays are made of these. */

/* A member.  A negative clause: the complement. */
typedef struct cylint_membership {
    uint32_t shape, solid;
    int32_t clause;
} cylint_membership;

/* A line hits a bounded solid only if it hits a shape of it in the hierarchy.  Late
 * members are tested only with lines that hit a member that is not late. */
typedef struct cylint_scene_solid {
    uint32_t number;             /* of the shape that stands for it */
    uint32_t clauses;            /* how many; 0: no member has this solid */
    uint32_t failing;            /* how many without a complement */
    uint32_t first_clause;       /* in `complements` */
    uint32_t first_late, n_late; /* of `late` */
    int is_bounded; /* a clause consists of shapes in the hierarchy ... */
    int has_unshared_clause; /* ... that few solids share */
} cylint_scene_solid;

/* Added to the number of a late member's shape in `of_shapes`. */
enum { CYLINT_LATE_MEMBER = 1 << 30 };

typedef struct cylint_solids {
    size_t n_members;
    const cylint_membership *given; /* as they were set */
    /* In these the clauses of a solid have the numbers 1, 2, ... */
    cylint_membership *of_shapes; /* sorted by shape, late ones last ... */
    uint32_t *first_of_shape; /* ... where those of each begin, and the end */
    cylint_membership *late;  /* late members, sorted by solid */
    size_t n, most_clauses;   /* of solids; of the clauses of one */
    cylint_scene_solid *solid;
    int32_t *complements; /* of each clause of each solid, how many */
    uint32_t *always;     /* shapes beside the hierarchy that all lines test */
    uint32_t *outside; /* solids that contain all points outside their shapes */
    size_t n_late, n_always, n_outside;
    void *memory; /* of these arrays */
    size_t bytes;
} cylint_solids;

/* Whether i is the place in `of_shapes` of a member of the shape that is not late,
 * counted from first_of_shape[shape]. */
static inline int cylint_is_early_member(const cylint_solids *solids,
                                         size_t shape, uint32_t i)
{
    return i < solids->first_of_shape[shape + 1] &&
           !(solids->of_shapes[i].shape & CYLINT_LATE_MEMBER);
}

struct cylint_scene {
    cylint_records records;
    size_t n;
    cylint_shapes_box box; /* of those that were added */
    int is_finished;
    cylint_frame frame;
    cylint_bvh bvh;
    const cylint_traversal *traversal;
    const uint32_t
        *bounded; /* numbers of the shapes in the hierarchy; NULL: all */
    const uint32_t *others; /* numbers of the other shapes, ascending */
    size_t n_bounded, n_others;
    cylint_shape *copies; /* of the other shapes, in a pack */
    void *pack_memory;
    cylint_pack pack;
    double built_cost;          /* of the hierarchy; 0: it is as it was built */
    size_t own_bytes;           /* without the hierarchy's */
    cylint_scene_labels labels; /* end is NULL: none */
    cylint_solids solids;
    cylint_membership *given; /* the members of solids, unless in the file */
    /* of an opened scene; then the records, the hierarchy, the lists, the labels
     * and solids.given lie in it */
    cylint_memory file;
};

/* Writes the shapes that are not in the hierarchy into their pack. */
void cylint_scene_pack_others(cylint_scene *scene);

/* Makes the parts of a scene that are not in its file: its functions and its
 * pack.  All other members are set.  Returns 0 if there is no memory. */
int cylint_scene_complete(cylint_scene *scene);

/* How many of n ascending numbers are less than this one. */
size_t cylint_place_among(const uint32_t *numbers, size_t n, size_t number);

/* Whether a shape is beside the hierarchy. */
int cylint_is_other(const cylint_scene *scene, size_t number);

/* Makes the other members, which are 0, from `given` and `n_members`, which the
 * caller keeps.  The caller frees `memory`, also after a failure. */
cylint_scene_status cylint_solids_make(cylint_solids *solids,
                                       const cylint_scene *scene);

/* The place of the checksum in the file, in bytes. */
enum { CYLINT_FILE_CHECKSUM = 32 };

/* The checksum of a file of at least 512 bytes, a multiple of 64, at the start of
 * a cache line.  It does not depend on the bytes at the checksum's place. */
uint64_t cylint_file_checksum(const void *data, size_t bytes);

/* Writes the result to *status, unless it is NULL.  Returns the scene, or frees
 * it and returns NULL if the result is a failure. */
cylint_scene *cylint_scene_or_null(cylint_scene *scene,
                                   cylint_scene_status result,
                                   cylint_scene_status *status);

#endif
