/*
 * piece_memory.h - memory for pieces that grows, of the library and of the command
 */
#ifndef CYLINT_SCENE_PIECE_MEMORY_H
#define CYLINT_SCENE_PIECE_MEMORY_H

#include "cylint_scene.h"

/* Zero it before use; piece and work.memory are from malloc(). */
typedef struct cylint_piece_memory {
    cylint_workspace work;
    cylint_piece *piece;
    size_t n, capacity;
} cylint_piece_memory;

/* Replaces the workspace by one of more than work->wanted bytes, after a query that
 * had no room.  Returns 0 if there is no memory. */
int cylint_grow_workspace(cylint_workspace *work);

/* Adds all pieces of a line, or the first `most` unless that is 0.  Returns 0 if
 * there is no memory. */
int cylint_add_pieces(const cylint_scene *scene, const cylint_line *line,
                      const cylint_piece_rule *rule, size_t most,
                      cylint_piece_memory *memory);

#endif
