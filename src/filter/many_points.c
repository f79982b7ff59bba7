/*
 * many_points.c - on which side of solids' surfaces points lie, in lanes
 *
 * Compiled once for each instruction set.  Signs are computed in doubles only: a
 * point near a surface is undecided, and so are points that do not fill the lanes.
 */
#include "kernel.h"

#ifndef CYLINT_SIDES
#define CYLINT_SIDES cylint_sides_plain
#endif

/* Points of a block, whose sides are doubles first: compilers convert an array of
 * these in vectors. */
enum { BLOCK = 256 };

/* Sides of n points, LANES or more. */
typedef void sides_kernel(const frames *f, const double *const xyz[3], int n,
                          double *side);

INLINE vd sides_of_lanes(const frames *f, const vd point[3], int solid)
{
    local_line l;
    load_place(&l, point, f, solid);
    const place where = place_in_doubles(&l, solid);
    const vm inside = m_and(l.in_range, where.inside);
    const vm outside = m_and(l.in_range, where.before);
    /* mutant '1' -> '2': slower, that is undecided */
    return v_select(inside, v_set(1),
                    v_select(outside, v_set(-1), v_set(CYLINT_SIGN_UNDECIDED)));
}

/* The last lanes can overlap those before them. */
#define KERNEL(name, solid)                                              \
    ASIDE void name##_sides(const frames *f, const double *const xyz[3], \
                            int n, double *side)                         \
    {                                                                    \
        for (int i = 0; i < n; i += LANES) {                             \
            const int at = i + LANES <= n ? i : n - LANES;               \
            const vd x[3] = {v_load(xyz[0] + at), v_load(xyz[1] + at),   \
                             v_load(xyz[2] + at)};                       \
            v_store(side + at, sides_of_lanes(f, x, solid));             \
        }                                                                \
    }
CYLINT_EACH_SOLID(KERNEL)
#undef KERNEL

#define MEMBER(name, solid) [solid] = name##_sides,
static sides_kernel *const sides_of_solid[CYLINT_SOLIDS] = {
    CYLINT_EACH_SOLID(MEMBER)};
#undef MEMBER

static void answer_points(const cylint_shape *shape,
                          const cylint_points *points, signed char *side)
{
    const int solid = cylint_prepared(shape);
    double of_block[BLOCK];
    frames f;
    if (solid == CYLINT_SOLID_NONE || points->n < LANES)
        return;
    broadcast_shape(&f, shape);
    /* mutant '<' -> '<=': slower, the last lanes once more */
    for (size_t i = 0; i < points->n; i += BLOCK) {
        const size_t ahead = points->n - i;
        const size_t first = ahead < LANES ? points->n - LANES : i;
        const int n = ahead < LANES   ? LANES
                      : ahead < BLOCK ? (int)ahead
                                      : BLOCK;
        const double *const at[3] = {points->xyz[0] + first,
                                     points->xyz[1] + first,
                                     points->xyz[2] + first};
        sides_of_solid[solid](&f, at, n, of_block);
        for (int k = 0; k < n; k++)
            side[first + (size_t)k] = (signed char)(int)of_block[k];
    }
}

/* Points and shapes of one solid, by their numbers. */
static void answer_solids(const cylint_shape *shapes, int solid,
                          const size_t number[LANES],
                          const cylint_points *points, signed char *side)
{
    const cylint_shape *shape[LANES];
    double xyz[3][LANES], of_lane[LANES];
    const double *const at[3] = {xyz[0], xyz[1], xyz[2]};
    frames f;
    for (int i = 0; i < LANES; i++)
        shape[i] = &shapes[number[i]];
    gather_numbers(&f, shape, solid);
    EACH(k, 3)
        v_store(xyz[k], v_pick(points->xyz[k], number));
    sides_of_solid[solid](&f, at, LANES, of_lane);
    for (int i = 0; i < LANES; i++)
        side[number[i]] = (signed char)of_lane[i];
}

/* Pairs wait until those of their solid fill the lanes. */
static void answer_pairs(const cylint_shape *shapes,
                         const cylint_points *points, signed char *side)
{
    size_t number[CYLINT_SOLIDS][LANES];
    /* mutant '0' -> '1': the first is of no solid, and is not used */
    int count[CYLINT_SOLIDS] = {0};
    for (size_t i = 0; i < points->n; i++) {
        const int solid = cylint_prepared(&shapes[i]);
        number[solid][count[solid]++] = i;
        if (count[solid] < LANES)
            continue;
        count[solid] = 0;
        if (solid != CYLINT_SOLID_NONE)
            answer_solids(shapes, solid, number[solid], points, side);
    }
}

void CYLINT_SIDES(const cylint_shape *shapes, size_t each,
                  const cylint_points *points, signed char *side)
{
    memset(side, CYLINT_SIGN_UNDECIDED, points->n);
    if (each)
        answer_pairs(shapes, points, side);
    else
        answer_points(shapes, points, side);
}
