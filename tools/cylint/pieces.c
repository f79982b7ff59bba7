/*
 * pieces.c - the pieces of a line, its first boundary, and the solids that contain
 * a point, in memory that grows
 */
#include <stdint.h>
#include <stdlib.h>

#include "pieces.h"

enum { PIECES_FIRST = 256, GROWTH = 8, WORK_FIRST = 1 << 14 };

void piece_memory_free(struct piece_memory *m)
{
    free(m->work.memory);
    free(m->piece);
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

/* Whether there is memory to begin with. */
static int has_work(struct piece_memory *m)
{
    return m->work.memory || grow_work(&m->work);
}

static int grow_pieces(struct piece_memory *m)
{
    const size_t capacity =
        m->capacity > 0 ? GROWTH * m->capacity : PIECES_FIRST;
    cylint_piece *more = capacity <= SIZE_MAX / sizeof *more
                             ? realloc(m->piece, capacity * sizeof *more)
                             : NULL;
    if (more) {
        m->piece = more;
        m->capacity = capacity;
    }
    return more != NULL;
}

void pieces_begin(struct piece_search *s, const cylint_scene *scene,
                  const cylint_line *line, const cylint_piece_rule *rule,
                  int most)
{
    s->scene = scene;
    s->line = *line;
    s->rule = *rule;
    s->rule.after = NULL;
    s->wanted = most > 0 ? (size_t)most : SIZE_MAX;
    s->is_continued = 0;
}

/* The next search begins behind the last piece found. */
static void move_on(struct piece_search *s, const struct piece_memory *m)
{
    s->is_continued = 1;
    s->last = m->piece[m->count - 1];
    if (s->rule.mode == CYLINT_PIECES_CHORDS)
        s->rule.after = &s->last;
    else if (s->last.t1 < s->line.tmax)
        s->line.tmin = s->last.t1;
    else
        s->wanted = 0;
}

/* A search that continues takes as long as the one before, so it has space for more
 * pieces. */
int pieces_next(struct piece_search *s, struct piece_memory *m)
{
    m->count = 0;
    if (s->wanted == 0)
        return 1;
    if (!has_work(m) || ((s->is_continued || !m->piece) && !grow_pieces(m)))
        return 0;
    const size_t capacity = s->wanted < m->capacity ? s->wanted : m->capacity;
    size_t found;
    while ((found = cylint_scene_pieces(s->scene, &s->line, &s->rule, m->piece,
                                        capacity, &m->work)) == CYLINT_NO_ROOM)
        if (!grow_work(&m->work))
            return 0;
    m->count = found;
    s->wanted = found < capacity ? 0 : s->wanted - found;
    if (s->wanted > 0)
        move_on(s, m);
    return 1;
}

int first_boundary(const cylint_scene *scene, const cylint_line *line,
                   unsigned want, cylint_hit *hit, struct piece_memory *m,
                   unsigned long long *shape)
{
    const unsigned members = want & (unsigned)CYLINT_WANT_ALL;
    size_t number;
    if (!has_work(m))
        return 0;
    while ((number = cylint_scene_first_boundary(scene, line, members, hit,
                                                 &m->work)) == CYLINT_NO_ROOM)
        if (!grow_work(&m->work))
            return 0;
    *shape = number < cylint_scene_size(scene) ? number + 1 : 0;
    return 1;
}

int depth_of_point(const cylint_scene *scene, const double point[3],
                   const int *rank, struct piece_memory *m,
                   unsigned long long *depth, unsigned long long *owner)
{
    size_t number, found;
    if (!has_work(m))
        return 0;
    while ((found = cylint_scene_depth(scene, point, rank, &number,
                                       &m->work)) == CYLINT_NO_ROOM)
        if (!grow_work(&m->work))
            return 0;
    *depth = found;
    *owner = number < cylint_scene_size(scene) ? number + 1 : 0;
    return 1;
}
