/*
 * pieces.c - the shapes and pieces of a line, its first boundary, and the solids
 * that contain a point, in memory that grows
 */
#include <stdlib.h>

#include "scene.h"

enum { WORK_FIRST = 1 << 14 };

void piece_memory_free(struct piece_memory *m)
{
    free(m->work.memory);
    free(m->piece);
    free(m->number);
}

/* Makes the workspace larger than a query wants.  Nothing stays in it. */
static int grow_work(cylint_workspace *work)
{
    const size_t wanted = work->wanted + work->wanted / 2;
    free(work->memory);
    work->bytes = wanted > WORK_FIRST ? wanted : WORK_FIRST;
    work->memory = malloc(work->bytes);
    if (!work->memory)
        work->bytes = 0;
    return work->memory != NULL;
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

static int grow_pieces(struct piece_memory *m)
{
    cylint_piece *larger =
        grown(m->piece, m->capacity, &m->capacity, sizeof *larger);
    m->piece = larger ? larger : m->piece;
    return larger != NULL;
}

/* Searches again with more memory until all pieces have space. */
size_t find_pieces(const cylint_scene *scene, const cylint_line *line,
                   const cylint_piece_rule *rule, size_t most,
                   struct piece_memory *m)
{
    size_t found, wanted;
    int has_memory = m->capacity > 0 || grow_pieces(m);
    while (has_memory) {
        wanted = most > 0 && most < m->capacity ? most : m->capacity;
        found =
            cylint_scene_pieces(scene, line, rule, m->piece, wanted, &m->work);
        if (found < wanted || found == most)
            return found;
        has_memory =
            found == CYLINT_NO_ROOM ? grow_work(&m->work) : grow_pieces(m);
    }
    return CYLINT_NO_ROOM;
}

size_t first_boundary(const cylint_scene *scene, const cylint_line *line,
                      unsigned want, cylint_hit *hit, struct piece_memory *m)
{
    size_t number = CYLINT_NO_ROOM;
    do
        number = cylint_scene_first_boundary(
            scene, line, want & (unsigned)CYLINT_WANT_ALL, hit, &m->work);
    while (number == CYLINT_NO_ROOM && grow_work(&m->work));
    return number;
}

size_t depth_of_point(const cylint_scene *scene, const double point[3],
                      const int *rank, size_t *owner, struct piece_memory *m)
{
    size_t depth = CYLINT_NO_ROOM;
    do
        depth = cylint_scene_depth(scene, point, rank, owner, &m->work);
    while (depth == CYLINT_NO_ROOM && grow_work(&m->work));
    return depth;
}
