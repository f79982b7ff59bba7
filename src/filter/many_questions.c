/*
 * many_questions.c - many lines or many shapes, in lanes
 *
 * Compiled once for each instruction set.  The first pass tests in every lane
 * whether the line certainly misses the ball about the shape.  This test reads
 * the fewest data and needs neither a division nor a square root.  The lanes
 * that remain are collected.  As soon as they fill a vector they are classified,
 * and the roots of those that hit are rounded.  Undecided lanes are returned as
 * such; they do not affect their neighbours.
 */
#include "lanes.h"
#include "filter.h"
#include "local_lanes.h"
#include "round_lanes.h"

#ifndef CYLINT_MANY
#define CYLINT_MANY cylint_many_plain
#endif

/* The bits of all lanes. */
#define ALL ((1u << LANES) - 1)

/* What differs from lane to lane.  Only the first pass is compiled for each. */
typedef enum { ONE_LINE, ONE_SHAPE, PAIRS } mode;

static mode mode_of(const cylint_filter_batch *from)
{
    return !from->run ? ONE_SHAPE : from->line ? ONE_LINE : PAIRS;
}

/* Elements of an array; in_a_row: their numbers follow each other. */
INLINE vd elements(const double *x, const size_t *number, int in_a_row)
{
    return in_a_row ? v_load(x + number[0]) : v_pick(x, number);
}

/* The lines of so many numbers. */
static void lines_at(const cylint_filter_batch *from, const size_t *number,
                     lanes_line *l)
{
    const cylint_lines *lines = from->lines;
    const int in_a_row = number[LANES - 1] - number[0] == LANES - 1;
    l->tmin = v_set(0);
    l->tmax = v_set(HUGE_VAL);
    EACH(i, 3) {
        l->o[i] = elements(lines->o[i], number, in_a_row);
        l->u[i] = elements(lines->d[i], number, in_a_row);
        l->u_lo[i] = v_set(0);
    }
    if (lines->tmin)
        l->tmin = elements(lines->tmin, number, in_a_row);
    if (lines->tmax)
        l->tmax = elements(lines->tmax, number, in_a_row);
    l->segment = 0;
}

static void shapes_at(const cylint_filter_batch *from, const size_t *number,
                      int kind, lanes_shape *s)
{
    const char *shape[LANES];
    unsigned cap[2] = {0, 0}, left_handed = 0;
    for (int i = 0; i < LANES; i++) {
        const cylint_shape *one = &from->shapes[number[i]];
        const unsigned caps = cylint_caps_present(one->ends);
        shape[i] = (const char *)one;
        if (kind == CYLINT_KIND_SPHERE)
            continue;
        cap[0] |= (caps & 1) << i;
        cap[1] |= (caps >> 1) << i;
        if (cylint_is_elliptic(kind))
            left_handed |= (unsigned)one->left_handed << i;
    }
/* four members in a row, from `name` on: base, r0, r1, dr, dr_lo are adjacent */
#define MEMBERS(name) v_columns(shape, offsetof(cylint_shape, name), four)
    vd four[4];
    MEMBERS(base); /* and r0 */
    EACH(i, 3)
        s->base[i] = four[i];
    s->r[0] = four[3];
    if (kind == CYLINT_KIND_SPHERE)
        return;
    s->cap[0] = m_from(cap[0]);
    s->cap[1] = m_from(cap[1]);
    if (cylint_is_hull(kind)) {
        s->r[1] = frame_at(&s->frame, shape);
        MEMBERS(top);
        EACH(i, 3)
            s->top[i] = four[i];
        return;
    }
    MEMBERS(axis);
    EACH(i, 3)
        s->axis[i] = four[i];
    MEMBERS(r0);
    s->r[0] = four[0];
    /* mutant '1' -> '2': only whether r[1] is in the window is used, and dr
     * is as large if it is not */
    s->r[1] = four[1];
    s->dr = four[2];
    s->dr_lo = four[3];
    if (cylint_is_elliptic(kind)) {
        const vd turn = v_select(m_from(left_handed), v_set(-1), v_set(1));
        MEMBERS(a);
        EACH(i, 3)
            s->a[i] = four[i];
        MEMBERS(b);
        EACH(i, 3) {
            s->b[i] = turn * four[i];
            s->axis_lo[i] = v_set(0);
        }
    } else {
        MEMBERS(axis_lo);
        EACH(i, 3)
            s->axis_lo[i] = four[i];
        MEMBERS(top);
        EACH(i, 3)
            s->top[i] = four[i];
    }
#undef MEMBERS
}

/* The ball about a shape and a line in every lane. */
typedef struct {
    vd center[3], radius, o[3], u[3];
} lanes_pass;

INLINE void shape_of_pass(lanes_pass *b, const cylint_shape *s)
{
    EACH(i, 3)
        b->center[i] = v_set(s->center[i]);
    b->radius = v_set(s->bound_radius);
}

/* Copies of what the first pass reads: the list that it writes cannot change
 * them. */
typedef struct {
    cylint_run run;
    cylint_lines lines;
    size_t n;
} pass_columns;

INLINE pass_columns columns_of(const cylint_filter_batch *from, mode m)
{
    pass_columns c;
    if (m != ONE_SHAPE)
        c.run = *from->run;
    if (m != ONE_LINE)
        c.lines = *from->lines;
    c.n = from->n;
    return c;
}

/* Those of lanes from `lane` on, as far as they differ from lane to lane. */
INLINE void pass_at(const pass_columns *from, size_t lane, mode m,
                    lanes_pass *b)
{
    const cylint_lines *lines = &from->lines;
    if (m != ONE_SHAPE) {
        const double *column = from->run.column + lane;
        const size_t stride = from->run.stride;
        b->center[0] = v_load(column);
        b->center[1] = v_load(column + stride);
        b->center[2] = v_load(column + 2 * stride);
        b->radius = v_load(column + COLUMN_BALL * stride);
    }
    if (m == ONE_SHAPE) {
        EACH(i, 3) {
            b->o[i] = v_load(lines->o[i] + lane);
            b->u[i] = v_load(lines->d[i] + lane);
        }
    } else if (m == PAIRS) {
        const size_t *at = from->run.number + lane;
        const int in_a_row = lane + LANES <= from->n && /* not padded */
                             at[LANES - 1] - at[0] == LANES - 1;
        EACH(i, 3) {
            b->o[i] = in_a_row ? v_load(lines->o[i] + at[0])
                               : v_pick(lines->o[i], at);
            b->u[i] = in_a_row ? v_load(lines->d[i] + at[0])
                               : v_pick(lines->d[i], at);
        }
    }
}

/* The lanes whose ball is not for certain beyond the line's domain or the
 * nearest hit. */
INLINE unsigned within_reach(const lanes_ball *b,
                             const cylint_filter_batch *from)
{
    const cylint_line *line = from->line;
    const vd reach = b->r * v_set(from->speed);
    const double end = from->nearest < line->tmax ? from->nearest : line->tmax;
    const bounded_value first = ball_slope_at(b, line->tmin);
    const bounded_value last = ball_slope_at(b, end);
    const vm before = v_lt(reach, first.v - first.e);
    const vm beyond = v_lt(last.v + last.e, -reach);
    return m_bits(m_not(m_or(before, beyond)));
}

/* ------------------------------------------------- the first pass ---- */

INLINE void load_pass(const cylint_filter_batch *from, mode m, lanes_pass *b)
{
    if (m == ONE_SHAPE)
        shape_of_pass(b, from->shapes);
    if (m == ONE_LINE)
        EACH(i, 3) {
            b->o[i] = v_set(from->line->o[i]);
            b->u[i] = v_set(from->line->d[i]);
        }
}

/* So many numbers the first pass finds at once where no answer can change it. */
enum { AHEAD = 64 };

/* The first pass takes so many lanes at a time, and it branches on all of their
 * outcomes together: those of one vector are hard to predict. */
enum { BLOCK = 16, VECTORS = BLOCK / LANES };

INLINE lanes_ball ball_at(const pass_columns *columns, size_t lane, mode m,
                          lanes_pass *pass)
{
    pass_at(columns, lane, m, pass);
    return ball_and_line(pass->center, pass->radius, pass->o, pass->u);
}

/* The lanes of a vector whose ball the line does not certainly pass by. */
INLINE unsigned lanes_left(const pass_columns *columns, size_t lane, mode m,
                           lanes_pass *pass)
{
    const size_t rest = columns->n - lane;
    const unsigned there = rest < LANES ? (1u << rest) - 1 : ALL;
    if (m == ONE_SHAPE && rest < LANES) /* the caller's end there */
        return there;
    const lanes_ball ball = ball_at(columns, lane, m, pass);
    return there & m_bits(m_not(passes_ball(&ball)));
}

/* Puts those numbers of a vector into the list; returns how many. */
INLINE size_t keep_numbers(size_t *list, const pass_columns *columns,
                           size_t lane, mode m, unsigned left)
{
    size_t counted[LANES];
    if (m == ONE_SHAPE)
        for (unsigned i = 0; i < LANES; i++)
            counted[i] = lane + i;
    return v_keep(list, m == ONE_SHAPE ? counted : columns->run.number + lane,
                  left);
}

/* Puts the numbers of lanes that do not pass by into the list, until they
 * suffice for a group. */
INLINE void first_pass(cylint_filter_batch *from, mode m)
{
    size_t *list = from->list, end = from->end, lane = from->lane;
    const size_t enough = from->first + (from->eager ? AHEAD : LANES);
    const pass_columns columns = columns_of(from, m);
    lanes_pass pass;
    load_pass(from, m, &pass);
    while (lane < columns.n && end < enough) {
        const size_t rest = columns.n - lane;
        const int vectors =
            rest < BLOCK ? (int)((rest + LANES - 1) / LANES) : VECTORS;
        unsigned left[VECTORS], any = 0;
        for (int i = 0; i < vectors; i++)
            any |= left[i] =
                lanes_left(&columns, lane + (size_t)i * LANES, m, &pass);
        for (int i = 0; any && i < vectors; i++) {
            const size_t at = lane + (size_t)i * LANES;
            if (m == ONE_LINE && !from->relations) {
                if (!left[i])
                    continue;
                const lanes_ball ball = ball_at(&columns, at, m, &pass);
                left[i] &= within_reach(&ball, from);
            }
            end += keep_numbers(list + end, &columns, at, m, left[i]);
        }
        lane += (size_t)vectors * LANES;
    }
    from->lane = lane;
    from->end = end;
}

ASIDE void first_pass_one_line(cylint_filter_batch *from)
{
    first_pass(from, ONE_LINE);
}

ASIDE void first_pass_one_shape(cylint_filter_batch *from)
{
    first_pass(from, ONE_SHAPE);
}

ASIDE void first_pass_pairs(cylint_filter_batch *from)
{
    first_pass(from, PAIRS);
}

/* Fills the list; returns how many of its numbers the next group has. */
static int next_numbers(cylint_filter_batch *from)
{
    static void (*const pass[])(cylint_filter_batch *) = {
        first_pass_one_line, first_pass_one_shape, first_pass_pairs};
    enum {
        CAPACITY =
            sizeof from->list / sizeof *from->list - AHEAD - BLOCK - 2 * LANES
    };
    size_t left = from->end - from->first;
    if (from->first > CAPACITY) {
        memmove(from->list, from->list + from->first,
                left * sizeof *from->list);
        from->first = 0;
        from->end = left;
    }
    if (left < LANES && from->lane < from->n) {
        pass[mode_of(from)](from);
        left = from->end - from->first;
    }
    return left < LANES ? (int)left : LANES;
}

/* ----------------------------------------------------- the groups ---- */

/* Lines and shapes in lanes; in_use: neither padding nor of an empty domain. */
typedef struct {
    lanes_line line;
    lanes_shape shape;
    vm in_use;
} question;

static void load(const cylint_filter_batch *from, const size_t *list, int lanes,
                 question *to)
{
    if (from->line)
        broadcast_line(&to->line, from->line);
    else
        lines_at(from, list, &to->line);
    if (from->run)
        shapes_at(from, list, from->kind, &to->shape);
    else
        broadcast_shape(&to->shape, from->shapes, from->kind);
    /* a line with an empty domain is none (other invalid lines are left
     * undecided, because their numbers compare to nothing) */
    to->in_use =
        m_and(m_from((1u << lanes) - 1), v_le(to->line.tmin, to->line.tmax));
}

/* Where the overlaps end, as doubles have it. */
typedef struct {
    lanes_slopes slopes; /* of both; a hull: of the first */
    bounded_value t[2];
    round_stop last; /* a hull: of the last */
} stops;

/* Subnormal limits may compare as equal zeros: such lanes are undecided. */
INLINE void leave_undecided(lanes_verdict *v, vm lanes)
{
    v->undecided = m_or(v->undecided, lanes);
    v->cross = m_and(v->cross, m_not(lanes));
    v->hit[0] = m_and(v->hit[0], v->cross);
    v->hit[1] = m_and(v->hit[1], v->cross);
}

/* Lanes with the nearest hit so far not behind them. */
INLINE vm not_beyond(const cylint_filter_batch *from, const lanes_verdict *v)
{
    const bounded_value t = choose(v->hit[0], v->stop[0], v->stop[1]);
    return m_not(v_lt(v_set(from->nearest), t.v - t.e));
}

/* Relation and hits, and, if t is wanted, the slopes and stops for rounding. */
INLINE void classify(const cylint_filter_batch *from, const question *x,
                     int kind, stops *at, cylint_filter_group *g)
{
    lanes_query q;
    round_stop stop[2];
    const int hull = cylint_is_hull(kind), sphere = kind == CYLINT_KIND_SPHERE;
    lanes_verdict v =
        sphere ? sphere_classify(&at->slopes, &x->shape, &x->line, x->in_use)
        : hull
            ? round_classify(&at->slopes, &x->shape, &x->line, x->in_use, stop)
            : lanes_classify(&q, &x->shape, &x->line, kind, from->bounded,
                             x->in_use);
    if (!from->line)
        leave_undecided(&v, m_and(x->in_use, v_eq(x->line.tmin, x->line.tmax)));
    if (from->line && from->want & CYLINT_WANT_NEAREST) {
        const vm wanted = not_beyond(from, &v);
        v.hit[0] = m_and(v.hit[0], wanted);
        v.hit[1] = m_and(v.hit[1], wanted);
    }
    g->undecided = m_bits(v.undecided);
    g->hit[0] = m_bits(v.hit[0]);
    g->hit[1] = m_bits(v.hit[1]);
    g->leaving_first = m_bits(v.leaving_first);
    const unsigned hits = g->hit[0] | g->hit[1];
    g->found = g->undecided | (from->relations ? m_bits(v.cross) : hits);
    if (!hits)
        return;
    v_store(g->part[0], v.part[0]);
    v_store(g->part[1], v.part[1]);
    if (!(from->want & CYLINT_WANT_T))
        return;
    if (hull) {
        at->slopes.R = stop[0].R;
        at->slopes.A = stop[0].A;
        at->last = stop[1];
    } else if (!sphere) {
        at->slopes = slopes_of(&q);
    }
    at->t[0] = v.stop[0];
    at->t[1] = v.stop[1];
}

/* A root of each lane. */
typedef struct {
    vm wanted, exits;
    bounded_value t;
    vd part;
} roots;

/* Rounds them.  Returns the lanes where that is uncertain. */
INLINE unsigned round_roots(const lanes_slopes *q, const question *x, int kind,
                            const roots *of, double t[LANES])
{
    const vd sign = v_select(of->exits, v_set(1), v_set(-1));
    vd center[3];
    root_centers(center, &x->shape, kind, of->part);
    const lanes_root r =
        kind == CYLINT_KIND_SPHERE
            ? round_sphere_root(q, &x->shape, &x->line, sign, of->t)
        : cylint_is_hull(kind)
            ? round_part_root(q, &x->shape, &x->line, sign, of->t, of->part)
            : round_root(q, &x->shape, center, &x->line, kind, 1, sign, of->t,
                         of->part);
    v_store(t, r.value);
    return m_bits(m_and(of->wanted, m_not(r.certain)));
}

/* Both hits' roots of round kinds. */
INLINE void round_both(const question *x, int kind, const stops *at,
                       cylint_filter_group *g)
{
    lanes_root root[2];
    if (kind == CYLINT_KIND_SPHERE) {
        round_sphere_roots(root, &at->slopes, &x->shape, &x->line, at->t);
    } else {
        const vd part[2] = {v_load(g->part[0]), v_load(g->part[1])};
        const round_stop stop[2] = {{at->t[0], at->slopes.R, at->slopes.A},
                                    at->last};
        round_part_roots(root, stop, &at->slopes, &x->shape, &x->line, at->t,
                         part);
    }
    EACH(k, 2) {
        v_store(g->t[k], root[k].value);
        g->undecided |= g->hit[k] & ~m_bits(root[k].certain);
    }
}

/* The hits' roots, one or two a lane. */
INLINE void round_hits(const cylint_filter_batch *from, const question *x,
                       int kind, const stops *at, cylint_filter_group *g)
{
    const int nearest = (from->want & CYLINT_WANT_NEAREST) != 0;
    const unsigned other = g->hit[1] & ~g->hit[0];
    if (!nearest && cylint_is_round(kind)) {
        round_both(x, kind, at, g);
        return;
    }
    for (int i = 0; i < 2 - nearest; i++) {
        const unsigned second = nearest ? other : i ? ALL : 0;
        const unsigned wanted = nearest ? g->hit[0] | g->hit[1] : g->hit[i];
        const vm last = m_from(second);
        const roots of = {
            m_from(wanted), m_from(second ^ g->leaving_first),
            choose(last, at->t[1], at->t[0]),
            v_select(last, v_load(g->part[1]), v_load(g->part[0]))};
        if (!wanted)
            continue;
        lanes_slopes slopes = at->slopes;
        if (cylint_is_hull(kind)) {
            slopes.R = choose(last, at->last.R, slopes.R);
            slopes.A = v_select(last, at->last.A, slopes.A);
        }
        g->undecided |= round_roots(&slopes, x, kind, &of, g->t[i]);
    }
    if (nearest) /* one root a lane: it stands in both places */
        memcpy(g->t[1], g->t[0], sizeof g->t[1]);
}

/* Functions of their own for each kind; elliptic kinds round alike, and a
 * capsule is a rounded cone of equal radii. */
typedef struct {
    void (*classify)(const cylint_filter_batch *from, const question *x,
                     stops *at, cylint_filter_group *g);
    void (*round)(const cylint_filter_batch *from, const question *x,
                  const stops *at, cylint_filter_group *g);
} kernels;

#define CLASSIFY(kind)                                          \
    ASIDE void classify_##kind(const cylint_filter_batch *from, \
                               const question *x, stops *at,    \
                               cylint_filter_group *g)          \
    {                                                           \
        classify(from, x, kind, at, g);                         \
    }
#define ROUND(kind)                                             \
    ASIDE void round_##kind(const cylint_filter_batch *from,    \
                            const question *x, const stops *at, \
                            cylint_filter_group *g)             \
    {                                                           \
        round_hits(from, x, kind, at, g);                       \
    }
CLASSIFY(CYLINT_KIND_CYLINDER)
CLASSIFY(CYLINT_KIND_CONE)
CLASSIFY(CYLINT_KIND_ACONE)
CLASSIFY(CYLINT_KIND_ECYLINDER)
CLASSIFY(CYLINT_KIND_ECONE)
CLASSIFY(CYLINT_KIND_SPHERE)
CLASSIFY(CYLINT_KIND_RCONE)
ROUND(CYLINT_KIND_CYLINDER)
ROUND(CYLINT_KIND_CONE)
ROUND(CYLINT_KIND_ACONE)
ROUND(CYLINT_KIND_ECONE)
ROUND(CYLINT_KIND_SPHERE)
ROUND(CYLINT_KIND_RCONE)
#undef CLASSIFY
#undef ROUND

static const kernels of_kind[] = {
    {NULL, NULL},
    {classify_CYLINT_KIND_CYLINDER, round_CYLINT_KIND_CYLINDER},
    {classify_CYLINT_KIND_CONE, round_CYLINT_KIND_CONE},
    {classify_CYLINT_KIND_ACONE, round_CYLINT_KIND_ACONE},
    {classify_CYLINT_KIND_ECYLINDER, round_CYLINT_KIND_ECONE},
    {classify_CYLINT_KIND_ECONE, round_CYLINT_KIND_ECONE},
    {classify_CYLINT_KIND_SPHERE, round_CYLINT_KIND_SPHERE},
    {classify_CYLINT_KIND_RCONE, round_CYLINT_KIND_RCONE},
    {classify_CYLINT_KIND_RCONE, round_CYLINT_KIND_RCONE},
};

/* Lines and one shape that has local coordinates.  lanes: bits of those in use.
 * Without a vector among its arguments the compiler clears the upper halves of
 * the registers where the function ends (vzeroupper). */
typedef void answer_lines(const local_lines *l, const cylint_shape *shape,
                          unsigned want, int relations, unsigned lanes,
                          cylint_filter_group *g);

#define LOCAL(name, tapered, bounded)                                        \
    ASIDE void name##_lines(const local_lines *l, const cylint_shape *shape, \
                            unsigned want, int relations, unsigned lanes,    \
                            cylint_filter_group *g)                          \
    {                                                                        \
        const vm in_use = m_and(m_from(lanes), v_le(l->tmin, l->tmax));      \
        answer_local_lines(l, shape, want, relations, in_use, tapered,       \
                           bounded, g);                                      \
    }
LOCAL(cylinder, 0, 1)
LOCAL(cone, 1, 1)
LOCAL(whole_cylinder, 0, 0)
LOCAL(double_cone, 1, 0)
#undef LOCAL

/* NULL: the shape has no local coordinates, or the filter does not serve it. */
static answer_lines *local_kernel(const cylint_filter_batch *from)
{
    if (from->run)
        return NULL;
    switch (from->shapes->prepared) {
    case CYLINT_SOLID_CYLINDER:
        return cylinder_lines;
    case CYLINT_SOLID_CONE:
        return cone_lines;
    case CYLINT_SOLID_WHOLE_CYLINDER:
        return whole_cylinder_lines;
    case CYLINT_SOLID_DOUBLE_CONE:
        return double_cone_lines;
    default:
        return NULL;
    }
}

static void answer_in_local(const cylint_filter_batch *from, const size_t *list,
                            int lanes, answer_lines *answer,
                            cylint_filter_group *g)
{
    const cylint_shape *shape = from->shapes;
    lanes_line line;
    local_lines l;
    lines_at(from, list, &line);
    EACH(i, 3) {
        l.o[i] = line.o[i];
        l.d[i] = line.u[i];
    }
    l.tmin = line.tmin;
    l.tmax = line.tmax;
    load_local_lines(&l, shape, cylint_is_tapered(shape->kind));
    answer(&l, shape, from->want, from->relations, (1u << lanes) - 1, g);
}

static void answer_group(const cylint_filter_batch *from, const size_t *list,
                         int lanes, cylint_filter_group *g)
{
    question x;
    stops at;
    answer_lines *const local = local_kernel(from);
    if (local) {
        answer_in_local(from, list, lanes, local, g);
        return;
    }
    load(from, list, lanes, &x);
    of_kind[from->kind].classify(from, &x, &at, g);
    if (from->want & CYLINT_WANT_T && g->hit[0] | g->hit[1])
        of_kind[from->kind].round(from, &x, &at, g);
    g->found |= g->undecided;
}

int CYLINT_MANY(cylint_filter_batch *from, cylint_filter_group *g)
{
    for (;;) {
        const int lanes = next_numbers(from);
        size_t *list = from->list + from->first;
        if (lanes == 0)
            return 0;
        for (int i = lanes; i < LANES; i++)
            list[i] = list[0];
        from->first += (size_t)lanes;
        answer_group(from, list, lanes, g);
        g->number = list;
        if (g->found)
            return 1;
    }
}
