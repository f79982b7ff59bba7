/*
 * piece_world.h - a scene of shapes and random solids, and its pieces by a loop
 * over all cells
 *
 * Coordinates are small whole numbers: such shapes touch, share faces, lie in each
 * other and are the same, and lines run along rulings, caps and through apexes.
 */
#ifndef CYLINT_PIECE_WORLD_H
#define CYLINT_PIECE_WORLD_H

#include <stdlib.h>

#include "cylint_scene.h"
#include "answers.h"
#include "check.h"

enum { SHAPES = 24, MEMBERS = 48, MOST = 4096, LINES = 40 };

/* ------------------------------------------------ a loop over all cells -- */

static struct {
    cylint_shape shape[SHAPES];
    size_t n;
    int rank[SHAPES];
    cylint_member member[MEMBERS];
    size_t members, solids;
    cylint_scene *scene;
    /* of a line */
    cylint_line line;
    cylint_interval chord[SHAPES][2];
    int chords[SHAPES];
    double end[4 * SHAPES + 2];
    size_t ends;
} world;

/* The number of a solid, as the header defines it. */
static inline size_t number_of(size_t solid)
{
    size_t least[2] = {SIZE_MAX, SIZE_MAX};
    for (size_t i = 0; i < world.members; i++)
        if (world.member[i].solid == solid) {
            size_t *at = &least[world.member[i].clause < 0];
            *at = world.member[i].shape < *at ? world.member[i].shape : *at;
        }
    return least[0] < SIZE_MAX ? least[0] : least[1];
}

/* Which shapes contain a cell of world.line. */
static inline void shapes_at(double t0, double t1, int in[SHAPES])
{
    for (size_t i = 0; i < world.n; i++) {
        in[i] = 0;
        for (int j = 0; j < world.chords[i]; j++)
            in[i] |= world.chord[i][j].t0 <= t0 && t1 <= world.chord[i][j].t1;
    }
}

/* Whether a solid contains a place in these shapes. */
static inline int solid_contains(size_t solid, const int in[SHAPES])
{
    int has_members = 0;
    for (size_t i = 0; i < world.members; i++) {
        const cylint_member *m = &world.member[i];
        int holds = 0;
        if (m->solid != solid)
            continue;
        has_members = 1;
        for (size_t j = 0; j < world.members; j++) {
            const cylint_member *k = &world.member[j];
            if (k->solid == solid && abs(k->clause) == abs(m->clause))
                holds |= in[k->shape] == (k->clause > 0);
        }
        if (!holds)
            return 0;
    }
    return has_members;
}

static inline int is_member(size_t shape)
{
    for (size_t i = 0; i < world.members; i++)
        if (world.member[i].shape == shape)
            return 1;
    return 0;
}

static inline int compare_doubles(const void *x, const void *y)
{
    const double a = *(const double *)x, b = *(const double *)y;
    return (a > b) - (a < b);
}

static inline void find_chords(const cylint_line *line)
{
    world.line = *line;
    world.ends = 0;
    world.end[world.ends++] = line->tmin;
    world.end[world.ends++] = line->tmax;
    for (size_t i = 0; i < world.n; i++) {
        world.chords[i] = cylint_chord(&world.shape[i], line, world.chord[i]);
        for (int j = 0; j < world.chords[i]; j++) {
            world.end[world.ends++] = world.chord[i][j].t0;
            world.end[world.ends++] = world.chord[i][j].t1;
        }
    }
    qsort(world.end, world.ends, sizeof *world.end, compare_doubles);
}

enum { ALL = -1 };

/* The owner of a place in these shapes and how many solids contain it, of all or of
 * the one of this number. */
static inline size_t depth_in(const int in[SHAPES], const int *rank, int only,
                              size_t *owner)
{
    size_t depth = 0;
    *owner = SIZE_MAX;
    for (size_t i = 0; i < world.n + world.solids; i++) {
        const int is_shape = i < world.n;
        const size_t number = is_shape ? i : number_of(i - world.n);
        if ((only != ALL && number != (size_t)only) ||
            !(is_shape ? !is_member(i) && in[i]
                       : solid_contains(i - world.n, in)))
            continue;
        depth++;
        if (*owner == SIZE_MAX ||
            (rank && rank[number] != rank[*owner] ? rank[number] < rank[*owner]
                                                  : number < *owner))
            *owner = number;
    }
    return depth;
}

/* Whether the same solids contain two places.  Chords of members that change no
 * solid divide nothing. */
static inline int same_set(const int x[SHAPES], const int y[SHAPES])
{
    for (size_t i = 0; i < world.n; i++)
        if (!is_member(i) && x[i] != y[i])
            return 0;
    for (size_t i = 0; i < world.solids; i++)
        if (solid_contains(i, x) != solid_contains(i, y))
            return 0;
    return 1;
}

/* Pieces, of all solids or of the one of this number. */
static inline size_t pieces_of_solids(const cylint_piece_rule *rule, int only,
                                      cylint_piece *to)
{
    size_t n = 0;
    int in[SHAPES], before[SHAPES] = {0};
    for (size_t i = 0; i + 1 < world.ends; i++) {
        const double t0 = world.end[i], t1 = world.end[i + 1];
        size_t owner;
        if (!(t0 < t1))
            continue;
        shapes_at(t0, t1, in);
        const size_t depth = depth_in(in, rule->rank, only, &owner);
        const int follows = n > 0 && to[n - 1].t1 == t0;
        if (depth > 0 && follows &&
            (rule->mode == CYLINT_PIECES_UNION ||
             (rule->mode == CYLINT_PIECES_OWNER && owner == to[n - 1].shape) ||
             (rule->mode == CYLINT_PIECES_CELLS && same_set(before, in)))) {
            to[n - 1].t1 = t1;
            if (to[n - 1].depth < depth)
                to[n - 1].depth = depth;
        } else if (depth > 0) {
            to[n++] = (cylint_piece){t0, t1, owner, depth};
        }
        memcpy(before, in, sizeof before);
    }
    return n;
}

static inline size_t expected_pieces(const cylint_piece_rule *rule,
                                     cylint_piece *to)
{
    const cylint_piece_rule unions = {.mode = CYLINT_PIECES_UNION};
    size_t n = 0;
    if (rule->mode != CYLINT_PIECES_CHORDS)
        return pieces_of_solids(rule, ALL, to);
    for (int number = 0; number < (int)world.n; number++)
        n += pieces_of_solids(&unions, number, to + n);
    qsort(to, n, sizeof *to, by_begin);
    return n;
}

/* ----------------------------------------------------------- workspaces -- */

static double workspace[1 << 16];

/* At first too small, or large. */
static inline cylint_workspace any_workspace(void)
{
    return (cylint_workspace){workspace, (size_t)one_of(2) * sizeof workspace,
                              0};
}

/* Whether a query is to be repeated with more memory. */
static inline int needs_more(size_t n, cylint_workspace *work)
{
    if (n != CYLINT_NO_ROOM)
        return 0;
    if (!CHECK(work->wanted > work->bytes && work->wanted <= sizeof workspace))
        exit(1);
    work->bytes = work->wanted;
    return 1;
}

static inline size_t pieces_in_world(const cylint_line *line,
                                     const cylint_piece_rule *rule,
                                     cylint_piece *to, size_t capacity)
{
    cylint_workspace work = any_workspace();
    size_t n;
    do
        n = cylint_scene_pieces(world.scene, line, rule, to, capacity, &work);
    while (needs_more(n, &work));
    return n;
}

/* All pieces in each mode and what else is computed from chords, of a line and of
 * its origin. */
typedef struct {
    size_t n[4];
    cylint_piece piece[4][MOST];
    double sum;
    size_t depth, owner, boundary;
    cylint_hit hit;
} world_answers;

/* scene: of the world, or one like it. */
static inline void answer_all(const cylint_scene *scene,
                              const cylint_line *line, world_answers *to)
{
    cylint_workspace work = {workspace, sizeof workspace, 0};
    cylint_piece_rule rule = {.mode = CYLINT_PIECES_UNION, .rank = world.rank};
    memset(to, 0, sizeof *to);
    for (int mode = 0; mode <= CYLINT_PIECES_CHORDS; mode++) {
        rule.mode = (cylint_piece_mode)mode;
        to->n[mode] = cylint_scene_pieces(scene, line, &rule, to->piece[mode],
                                          MOST, &work);
    }
    CHECK(cylint_scene_line_sums(scene, line, &rule, NULL, 1, 0, &to->sum) ==
          CYLINT_SCENE_OK);
    to->boundary = cylint_scene_first_boundary(scene, line, CYLINT_WANT_ALL,
                                               &to->hit, &work);
    to->depth =
        cylint_scene_depth(scene, line->o, world.rank, &to->owner, &work);
}

/* ------------------------------------------------------ random scenes -- */

static inline struct family_case whole_case(void)
{
    static const char *const names[] = {"integer grid", "round, whole numbers",
                                        "half-space, whole numbers"};
    const int n = one_of(16);
    struct family_case c;
    return *family_case(random_bits(&stream),
                        family_named(names[n < 10   ? 0
                                           : n < 15 ? 1
                                                    : 2]),
                        0, &c);
}

static inline cylint_shape any_shape(void)
{
    return whole_case().shape;
}

/* Some come from so far away that different roots round to one double. */
static inline cylint_line any_line(void)
{
    cylint_line line = whole_case().line;
    if (one_of(4) == 0) {
        const int axis = one_of(3);
        double o[3] = {line.o[0], line.o[1], line.o[2]}, d[3] = {0, 0, 0};
        o[axis] = -ldexp(1, 50 + one_of(6));
        d[axis] = one_of(2) ? 1 : 0x1p100; /* in range, or not */
        cylint_whole_line(&line, o, d);
    }
    return line;
}

/* Makes a new scene in place of the one before. */
static inline void make_shapes(void)
{
    cylint_scene_free(world.scene);
    for (world.n = 0; world.n < SHAPES; world.n++)
        world.shape[world.n] = one_of(8) == 0 && world.n > 0
                                   ? world.shape[one_of((int)world.n)]
                                   : any_shape();
    for (size_t i = 0; i < world.n; i++)
        world.rank[i] = one_of(3);
    world.scene = cylint_scene_new(world.shape, world.n, 1, NULL);
    world.members = world.solids = 0;
}

/* Solid i has shape i, a shape in common with all others, and sometimes more. */
static inline void draw_sharing_solids(void)
{
    world.solids = 18;
    for (size_t i = 0; i < world.solids; i++) {
        world.member[world.members++] = (cylint_member){i, i, 1};
        world.member[world.members++] =
            (cylint_member){SHAPES - 1, i, one_of(2) ? 2 : -2};
    }
    for (int n = one_of(MEMBERS - 36); n > 0; n--)
        world.member[world.members++] =
            (cylint_member){(size_t)one_of(SHAPES), (size_t)one_of(18),
                            one_of(2) ? 1 : 2 - 4 * one_of(2)};
}

/* Of up to 8 shapes and 4 clauses. */
static inline void draw_solids(void)
{
    world.solids = 1 + (size_t)one_of(4);
    for (size_t i = 0; i < world.solids; i++)
        for (int n = 1 + one_of(8); n > 0; n--) {
            const size_t shape = (size_t)one_of(SHAPES);
            const int clause = 1 + one_of(4);
            world.member[world.members++] =
                (cylint_member){shape, i, one_of(3) ? clause : -clause};
        }
}

/* Solids may share shapes. */
static inline void make_solids(void)
{
    do {
        world.members = 0;
        (one_of(4) ? draw_solids : draw_sharing_solids)();
    } while (cylint_scene_set_solids(world.scene, world.member,
                                     world.members) != CYLINT_SCENE_OK);
}

#endif
