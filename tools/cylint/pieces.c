/*
 * pieces.c - the shapes that a line hits, its first boundary, and the solids that
 * contain a point, in memory that grows
 */
#include <stdlib.h>

#include "scene.h"

void piece_memory_free(struct piece_memory *m)
{
    free(m->found.work.memory);
    free(m->found.piece);
    free(m->number);
}

int grow_numbers(struct piece_memory *m)
{
    size_t *larger = grown(m->number, m->number_capacity, &m->number_capacity,
                           sizeof *larger);
    m->number = larger ? larger : m->number;
    return larger != NULL;
}

size_t find_hit(const cylint_scene *scene, const cylint_line *line,
                struct piece_memory *m)
{
    size_t found;
    do
        found = cylint_scene_all(scene, line, 0, m->number, m->number_capacity);
    while (found == m->number_capacity && grow_numbers(m));
    return found < m->number_capacity ? found : CYLINT_NO_ROOM;
}

size_t first_boundary(const cylint_scene *scene, const cylint_line *line,
                      unsigned want, cylint_hit *hit, struct piece_memory *m)
{
    size_t number = CYLINT_NO_ROOM;
    do
        number = cylint_scene_first_boundary(
            scene, line, want & (unsigned)CYLINT_WANT_ALL, hit, &m->found.work);
    while (number == CYLINT_NO_ROOM && cylint_grow_workspace(&m->found.work));
    return number;
}

size_t depth_of_point(const cylint_scene *scene, const double point[3],
                      const int *rank, size_t *owner, struct piece_memory *m)
{
    size_t depth = CYLINT_NO_ROOM;
    do
        depth = cylint_scene_depth(scene, point, rank, owner, &m->found.work);
    while (depth == CYLINT_NO_ROOM && cylint_grow_workspace(&m->found.work));
    return depth;
}
