/*
 * many_questions.c - many lines or many shapes, in lanes
 *
 * Compiled once for each instruction set.  First every lane is asked whether
 * its line passes by the ball about its shape, which takes the fewest data
 * and operations and neither a division nor a square root.  Lanes that are
 * left are put side by side; as soon as there are enough for a vector they
 * are judged, and only those that hit have their roots rounded.  What a
 * kernel does not decide is asked one by one, without disturbing its
 * neighbours.
 */
#include "lanes.h"
#include "filter.h"

#ifndef CYLINT_SHAPES
#define CYLINT_SHAPES cylint_shapes_plain
#define CYLINT_LINES cylint_lines_plain
#endif

/* Where lanes come from: a run of shapes under one line or a line each, or
 * one shape under many lines.  Only the first pass is compiled for each. */
typedef enum { ONE_LINE, ONE_SHAPE, PAIRS } mode;

typedef struct {
    cylint_job *job;
    const cylint_run *run;     /* ONE_LINE, PAIRS */
    const cylint_shape *shape; /* ONE_SHAPE */
    size_t n;
    int kind, bounded;
    lanes_line line; /* ONE_LINE */
    double speed;    /* ONE_LINE: |u|, not less */
    lanes_shape one; /* ONE_SHAPE */
} source;

/* The lines of so many numbers. */
static void lines_at(const source *from, const size_t *number, lanes_line *l)
{
    const cylint_lines *lines = from->job->lines;
    EACH(i, 3) {
        l->o[i] = v_pick(lines->o[i], number);
        l->u[i] = v_pick(lines->d[i], number);
        l->u_lo[i] = v_set(0);
    }
    l->tmin = lines->tmin ? v_pick(lines->tmin, number) : v_set(0);
    l->tmax = lines->tmax ? v_pick(lines->tmax, number) : v_set(HUGE_VAL);
    l->segment = 0;
}

static void shapes_at(const source *from, const size_t *number, int kind,
                      lanes_shape *s)
{
    const char *shape[LANES];
    unsigned cap[2] = {0, 0}, flip = 0;
    for (int i = 0; i < LANES; i++) {
        const cylint_shape *one = &from->job->shapes[number[i]];
        const int ends = one->ends;
        shape[i] = (const char *)one;
        cap[0] |=
            (unsigned)(ends == CYLINT_ENDS_CAPPED || ends == CYLINT_ENDS_CAP0)
            << i;
        cap[1] |=
            (unsigned)(ends == CYLINT_ENDS_CAPPED || ends == CYLINT_ENDS_CAP1)
            << i;
        flip |= (unsigned)one->flip << i;
    }
/* four members in a row, from `name` on */
#define MEMBERS(name) v_columns(shape, offsetof(cylint_shape, name), four)
    vd four[4];
    MEMBERS(base);
    EACH(i, 3)
        s->base[i] = four[i];
    MEMBERS(axis);
    EACH(i, 3)
        s->axis[i] = four[i];
    MEMBERS(r0);
    s->r[0] = four[0];
    s->r[1] = four[1];
    s->dr = four[2];
    s->dr_lo = four[3];
    if (kind >= CYLINT_KIND_ECYLINDER) {
        const vd turn = v_select(m_from(flip), v_set(-1), v_set(1));
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
    s->cap[0] = m_from(cap[0]);
    s->cap[1] = m_from(cap[1]);
}

/* A ball and a line in every lane. */
typedef struct {
    vd center[3], radius, o[3], u[3];
} lanes_ball;

INLINE void line_of_ball(lanes_ball *b, const lanes_line *l)
{
    EACH(i, 3) {
        b->o[i] = l->o[i];
        b->u[i] = l->u[i];
    }
}

INLINE void shape_of_ball(lanes_ball *b, const cylint_shape *s)
{
    EACH(i, 3)
        b->center[i] = v_set(s->center[i]);
    b->radius = v_set(s->ball);
}

/* Those of lanes from `lane` on, as far as they differ from lane to lane. */
INLINE void ball_at(const source *from, size_t lane, mode m, lanes_ball *b)
{
    const cylint_lines *lines = from->job->lines;
    if (m != ONE_SHAPE) {
        const double *column = from->run->column + lane;
        const size_t stride = from->run->stride;
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
        const size_t *at = from->run->number + lane;
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

INLINE void ball_letters(const lanes_ball *b, letters_lanes *L,
                         letters_sizes *N)
{
    EACH(i, 3) {
        L->u[i] = b->u[i];
        L->D[0][i] = b->o[i] - b->center[i];
    }
    const vd u = v_largest(L->u), D = v_largest(L->D[0]);
    EACH(i, 3) {
        N->u[i] = u;
        N->D[0][i] = D;
    }
}

/* The lanes that pass by for certain. */
INLINE vm pass_by(const lanes_ball *b)
{
    letters_lanes L;
    letters_sizes N;
    ball_letters(b, &L, &N);
    cross_lanes(&L, L.D[0], L.u, L.M[0]);
    cross_sizes(&N, N.D[0], N.u, N.M[0]);
    const vd u = N.u[0], D = N.D[0][0];
    const bounded_value near =
        with_bound(form_ball_lanes(&L, L.M[0], b->radius),
                   form_ball_sizes(&N, N.M[0], b->radius));
    const vd most = v_set(CYLINT_WINDOW), least = v_set(1 / CYLINT_WINDOW);
    const vm window = m_and(v_le(v_max(u, D), most), v_le(least, u));
    return m_and(window, v_lt(near.v, -near.e));
}

/* A value of form_foot: where t stands from the foot of a ball's centre. */
INLINE bounded_value foot(const letters_lanes *L, const letters_sizes *N,
                          double t)
{
    letters_lanes at = *L;
    letters_sizes size = *N;
    at.r[0] = v_set(t);
    size.r[0] = v_set(fabs(t));
    return with_bound(form_foot_lanes(&at), form_foot_sizes(&size));
}

/* The lanes whose ball is not for certain beyond the line's domain or the
 * nearest hit. */
INLINE unsigned within_reach(const lanes_ball *b, const source *from)
{
    const cylint_job *job = from->job;
    const cylint_line *line = job->line;
    letters_lanes L;
    letters_sizes N;
    ball_letters(b, &L, &N);
    const vd reach = b->radius * v_set(from->speed);
    const double end = job->nearest < line->tmax ? job->nearest : line->tmax;
    const bounded_value first = foot(&L, &N, line->tmin);
    const bounded_value last = foot(&L, &N, end);
    const vm before = v_lt(reach, first.v - first.e);
    const vm beyond = v_lt(last.v + last.e, -reach);
    return m_bits(m_not(m_or(before, beyond)));
}

/* A judged and rounded group of lanes, for reading one at a time; t only
 * where it is wanted. */
typedef struct {
    double t[2][LANES], part[2][LANES];
    unsigned undecided, hit[2], leaving_first;
} group;

/* The roots of lanes in use. */
INLINE lanes_root roots_of(const lanes_query *q, const lanes_shape *s,
                           const lanes_line *l, int kind, unsigned want,
                           vm in_use, vm exits, bounded_value t, vd part)
{
    const vd sign = v_select(exits, v_set(1), v_set(-1));
    vd center[3];
    root_centers(center, s, kind, part);
    if (!(want & CYLINT_WANT_FAST))
        return round_root(q, s, center, l, kind, 1, sign, t, part);
    const lanes_root quick = take_root(q, t);
    if (!m_any(m_and(in_use, m_not(quick.sure))))
        return quick;
    return either_root(quick,
                       round_root(q, s, center, l, kind, 1, sign, t, part));
}

INLINE void round_group(const lanes_query *q, const lanes_shape *s,
                        const lanes_line *l, int kind, unsigned want,
                        lanes_verdict *v, group *g)
{
    if (want & CYLINT_WANT_NEAREST) {
        /* one root a lane: both places share one rounding */
        const vm second = m_and(v->hit[1], m_not(v->hit[0]));
        const vm any = m_or(v->hit[0], v->hit[1]);
        if (!m_any(any))
            return;
        const vm exits = m_or(m_and(second, m_not(v->leaving_first)),
                              m_and(m_not(second), v->leaving_first));
        const lanes_root r = roots_of(q, s, l, kind, want, any, exits,
                                      choose(second, v->stop[1], v->stop[0]),
                                      v_select(second, v->part[1], v->part[0]));
        v->undecided = m_or(v->undecided, m_and(any, m_not(r.sure)));
        v_store(g->t[0], r.value);
        v_store(g->t[1], r.value);
        return;
    }
    for (int i = 0; i < 2; i++) {
        if (!m_any(v->hit[i]))
            continue;
        const vm exits = i ? m_not(v->leaving_first) : v->leaving_first;
        const lanes_root r = roots_of(q, s, l, kind, want, v->hit[i], exits,
                                      v->stop[i], v->part[i]);
        v->undecided = m_or(v->undecided, m_and(v->hit[i], m_not(r.sure)));
        v_store(g->t[i], r.value);
    }
}

static void lane_answer(const group *g, int lane, unsigned want,
                        cylint_kernel_answer *a)
{
    a->relation = CYLINT_RELATION_CROSS; /* misses are not told */
    a->n = 0;
    EACH(i, 2) {
        if (!(g->hit[i] >> lane & 1))
            continue;
        const int swapped = (int)(g->leaving_first >> lane & 1);
        a->t[a->n] = g->t[i][lane];
        a->part[a->n] = (int)g->part[i][lane];
        a->side[a->n] = swapped ? !i : i;
        a->n++;
        if (want & CYLINT_WANT_NEAREST)
            return;
    }
}

static int deliver(const source *from, const group *g, const size_t *list,
                   unsigned told, mode m)
{
    cylint_job *job = from->job;
    for (; told; told &= told - 1) {
        const size_t i = (size_t)cylint_lowest(told);
        const size_t number = list[i];
        cylint_kernel_answer answer;
        if (g->undecided >> i & 1) {
            const cylint_shape *shape =
                m == ONE_SHAPE ? from->shape : &job->shapes[number];
            cylint_kernel_ask(job, shape, number, &answer);
            if (answer.relation == CYLINT_RELATION_MISS)
                continue;
        } else {
            lane_answer(g, (int)i, job->want, &answer);
        }
        if (job->take(job, number, &answer))
            return 1;
    }
    return 0;
}

/* Lanes with the nearest hit so far not behind them. */
INLINE vm not_beyond(const source *from, mode m, const lanes_verdict *v)
{
    const cylint_job *job = from->job;
    if (m != ONE_LINE || !(job->want & CYLINT_WANT_NEAREST))
        return m_from((1u << LANES) - 1);
    const bounded_value t = choose(v->hit[0], v->stop[0], v->stop[1]);
    return m_not(v_lt(v_set(job->nearest), t.v - t.e));
}

/* Without a decision about those lanes. */
INLINE lanes_verdict leave_undecided(const lanes_verdict *v, vm lanes)
{
    lanes_verdict rest = *v;
    rest.undecided = m_or(rest.undecided, lanes);
    rest.cross = m_and(rest.cross, m_not(lanes));
    rest.hit[0] = m_and(rest.hit[0], rest.cross);
    rest.hit[1] = m_and(rest.hit[1], rest.cross);
    return rest;
}

/* Judges lanes of the list, of which there are at most LANES; the list has
 * room for as many. */
INLINE int judge(const source *from, size_t *list, int lanes, mode m, int kind)
{
    cylint_job *job = from->job;
    lanes_line line;
    lanes_shape shape;
    const lanes_line *l = m == ONE_LINE ? &from->line : &line;
    const lanes_shape *s = m == ONE_SHAPE ? &from->one : &shape;
    lanes_query q;
    group g;
    for (int i = lanes; i < LANES; i++)
        list[i] = list[0];
    if (m != ONE_LINE)
        lines_at(from, list, &line);
    if (m != ONE_SHAPE)
        shapes_at(from, list, kind, &shape);
    /* a line with an empty domain is none (other invalid lines are left
     * undecided, because their numbers compare to nothing).  Subnormal limits
     * may compare as equal zeros */
    const vm all = m_from((1u << lanes) - 1);
    const vm in_use = m_and(all, v_le(l->tmin, l->tmax));
    lanes_verdict v = lanes_judge(&q, s, l, kind, from->bounded, in_use);
    if (m != ONE_LINE)
        v = leave_undecided(&v, m_and(all, v_eq(l->tmin, l->tmax)));
    const vm of_interest = not_beyond(from, m, &v);
    v.hit[0] = m_and(v.hit[0], of_interest);
    v.hit[1] = m_and(v.hit[1], of_interest);
    if (job->want & CYLINT_WANT_T)
        round_group(&q, s, l, kind, job->want, &v, &g);
    g.undecided = m_bits(v.undecided);
    g.hit[0] = m_bits(v.hit[0]);
    g.hit[1] = m_bits(v.hit[1]);
    g.leaving_first = m_bits(v.leaving_first);
    const unsigned told =
        g.undecided | (job->relations ? m_bits(v.cross) : g.hit[0] | g.hit[1]);
    if (told == 0)
        return 0;
    v_store(g.part[0], v.part[0]);
    v_store(g.part[1], v.part[1]);
    return deliver(from, &g, list, told, m);
}

static int judge_kind(const source *from, size_t *list, int lanes, mode m)
{
#define JUDGE(kind)                                          \
    m == ONE_LINE ? judge(from, list, lanes, ONE_LINE, kind) \
                  : judge(from, list, lanes, m, kind)
    switch (from->kind) {
    case CYLINT_KIND_CYLINDER:
        return JUDGE(CYLINT_KIND_CYLINDER);
    case CYLINT_KIND_CONE:
        return JUDGE(CYLINT_KIND_CONE);
    case CYLINT_KIND_ACONE:
        return JUDGE(CYLINT_KIND_ACONE);
    case CYLINT_KIND_ECYLINDER:
        return JUDGE(CYLINT_KIND_ECYLINDER);
    default:
        return JUDGE(CYLINT_KIND_ECONE);
    }
#undef JUDGE
}

/* First pass, then the second over what it leaves, group by group. */
INLINE int work(const source *from, mode m)
{
    enum { ROOM = 256 };
    size_t list[ROOM + LANES], first = 0, end = 0; /* of numbers left */
    lanes_ball ball;
    if (m == ONE_LINE)
        line_of_ball(&ball, &from->line);
    if (m == ONE_SHAPE)
        shape_of_ball(&ball, from->shape);
    for (size_t lane = 0; lane < from->n; lane += LANES) {
        const size_t rest = from->n - lane;
        unsigned left = rest < LANES ? (1u << rest) - 1 : (1u << LANES) - 1;
        if (m != ONE_SHAPE || rest >= LANES) { /* the caller's end there */
            ball_at(from, lane, m, &ball);
            left &= m_bits(m_not(pass_by(&ball)));
        }
        if (m == ONE_LINE && left && !from->job->relations)
            left &= within_reach(&ball, from);
        if (!left)
            continue;
        for (unsigned i = 0; i < LANES; i++) { /* no branch to guess */
            list[end] = m == ONE_SHAPE ? lane + i : from->run->number[lane + i];
            end += left >> i & 1;
        }
        if (end - first < LANES)
            continue;
        if (judge_kind(from, list + first, LANES, m))
            return 1;
        first += LANES;
        if (end > ROOM - LANES) {
            memmove(list, list + first, (end - first) * sizeof *list);
            end -= first;
            first = 0;
        }
    }
    return end > first && judge_kind(from, list + first, (int)(end - first), m);
}

int CYLINT_SHAPES(cylint_job *job, const cylint_run *run)
{
    source from = {.job = job,
                   .run = run,
                   .n = run->n,
                   .kind = run->kind,
                   .bounded = run->bounded};
    const cylint_line *l = job->line;
    if (!l)
        return work(&from, PAIRS);
    broadcast_line(&from.line, l);
    from.speed =
        sqrt(l->d[0] * l->d[0] + l->d[1] * l->d[1] + l->d[2] * l->d[2]) *
        CYLINT_SLACK;
    return work(&from, ONE_LINE);
}

int CYLINT_LINES(cylint_job *job, const cylint_shape *shape)
{
    source from = {.job = job,
                   .shape = shape,
                   .n = job->lines->n,
                   .kind = shape->kind,
                   .bounded = shape->ends < CYLINT_ENDS_INFINITE};
    broadcast_shape(&from.one, shape);
    return work(&from, ONE_SHAPE);
}
