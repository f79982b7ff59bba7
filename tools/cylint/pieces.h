/*
 * pieces.h - the pieces of a line, its first boundary, and the solids that contain
 * a point, in memory that grows
 */
#ifndef CYLINT_COMMAND_PIECES_H
#define CYLINT_COMMAND_PIECES_H

#include "cylint_scene.h"

/* The memory of a thread.  Zero it before use. */
struct piece_memory {
    cylint_workspace work;
    cylint_piece *piece; /* those found last */
    size_t count, capacity;
};

void piece_memory_free(struct piece_memory *memory);

/* A search for the pieces of a line, some at a time. */
struct piece_search {
    const cylint_scene *scene;
    cylint_line line; /* from the last piece that was found */
    cylint_piece_rule rule;
    cylint_piece last;
    size_t wanted; /* pieces that may follow; SIZE_MAX: all */
    int is_continued;
};

/* most: the number of pieces that are wanted; 0: all. */
void pieces_begin(struct piece_search *search, const cylint_scene *scene,
                  const cylint_line *line, const cylint_piece_rule *rule,
                  int most);

/* All three return 0 if there is no memory. */

/* Writes the next pieces to memory->piece; memory->count is 0 at the end. */
int pieces_next(struct piece_search *search, struct piece_memory *memory);

/* As cylint_scene_first_boundary().  Writes the number of the shape, from 1, or 0
 * if there is none. */
int first_boundary(const cylint_scene *scene, const cylint_line *line,
                   unsigned want, cylint_hit *hit, struct piece_memory *memory,
                   unsigned long long *shape);

/* As cylint_scene_depth().  Writes the owner's number likewise. */
int depth_of_point(const cylint_scene *scene, const double point[3],
                   const int *rank, struct piece_memory *memory,
                   unsigned long long *depth, unsigned long long *owner);

#endif
