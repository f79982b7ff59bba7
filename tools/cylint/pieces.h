/*
 * pieces.h - the pieces of a line, its first boundary, and the solids that
 * contain a point, in memory that grows
 */
#ifndef CYLINT_COMMAND_PIECES_H
#define CYLINT_COMMAND_PIECES_H

#include "cylint_scene.h"

/* The memory of a thread.  Zero it before use. */
struct piece_memory {
    cylint_workspace work;
    cylint_piece *piece; /* those found last */
    size_t capacity;
};

void piece_memory_free(struct piece_memory *memory);

/* All return CYLINT_NO_ROOM if there is no memory. */

/* Writes all pieces, or the first `most` unless that is 0, to
 * memory->piece.  Returns how many. */
size_t find_pieces(const cylint_scene *scene, const cylint_line *line,
                   const cylint_piece_rule *rule, size_t most,
                   struct piece_memory *memory);

/* As cylint_scene_first_boundary() and cylint_scene_depth(). */
size_t first_boundary(const cylint_scene *scene, const cylint_line *line,
                      unsigned want, cylint_hit *hit,
                      struct piece_memory *memory);
size_t depth_of_point(const cylint_scene *scene, const double point[3],
                      const int *rank, size_t *owner,
                      struct piece_memory *memory);

#endif
