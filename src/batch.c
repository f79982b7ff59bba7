/*
 * batch.c - many lines or many shapes, in lanes
 *
 * Compiled once for each instruction set.  A batch is worked through in
 * blocks: first every lane is asked whether its line passes by for certain,
 * which takes the fewest data and operations and neither a division nor a
 * square root; the lanes that are left are then put side by side, judged,
 * and only those that hit have their roots rounded.  What a kernel does not
 * decide is asked one by one, without disturbing its neighbours.
 */
#include "kernel.h"
#include "kernels.h"

#ifndef CYLINT_SHAPES
#define CYLINT_SHAPES cylint_shapes_plain
#define CYLINT_LINES cylint_lines_plain
#endif

enum { BLOCK = 256 };

/* Where lanes come from: a run of shapes under one line or a line each, or
 * one shape under many lines.  Only the first pass is compiled for each. */
typedef enum { ONE_LINE, ONE_SHAPE, PAIRS } mode;

typedef struct {
    cylint_job *job;
    const cylint_run *run;     /* ONE_LINE, PAIRS */
    const cylint_shape *shape; /* ONE_SHAPE */
    size_t n;
    int bounded;
    lanes_line line;           /* ONE_LINE */
    lanes_shape one;           /* ONE_SHAPE */
} source;

/* The number of a lane. */
INLINE size_t number_of(const source *from, size_t lane, mode m)
{
    return m == ONE_SHAPE ? lane : from->run->number[lane];
}

/* x at the given lanes. */
INLINE vd pick(const double *x, const size_t *at)
{
    double v[LANES];
    for (int i = 0; i < LANES; i++)
        v[i] = x[at[i]];
    return v_load(v);
}

static void line_at(const source *from, const size_t *lane, mode m,
                    lanes_line *l)
{
    if (m == ONE_LINE) {
        *l = from->line;
        return;
    }
    const cylint_lines *lines = from->job->lines;
    size_t at[LANES];
    for (int i = 0; i < LANES; i++)
        at[i] = number_of(from, lane[i], m);
    for (int i = 0; i < 3; i++) {
        l->o[i] = pick(lines->o[i], at);
        l->u[i] = pick(lines->d[i], at);
        l->u_lo[i] = v_set(0);
    }
    l->tmin = lines->tmin ? pick(lines->tmin, at) : v_set(0);
    l->tmax = lines->tmax ? pick(lines->tmax, at) : v_set(HUGE_VAL);
}

static void shape_at(const source *from, const size_t *lane, mode m,
                     int kind, lanes_shape *s)
{
    if (m == ONE_SHAPE) {
        *s = from->one;
        return;
    }
    const size_t stride = from->run->stride;
    const double *column = from->run->column;
#define COLUMN(c) pick(column + (size_t)(c) * stride, lane)
    for (int i = 0; i < 3; i++) {
        s->base[i] = COLUMN(COLUMN_BASE + i);
        s->axis[i] = COLUMN(COLUMN_AXIS + i);
        if (kind >= CYLINT_KIND_ECYLINDER) {
            s->a[i] = COLUMN(COLUMN_A + i);
            s->b[i] = COLUMN(COLUMN_B + i);
            s->axis_lo[i] = v_set(0);
        } else {
            s->axis_lo[i] = COLUMN(COLUMN_AXIS_LO + i);
            s->top[i] = COLUMN(COLUMN_TOP + i);
        }
    }
    s->r[0] = COLUMN(COLUMN_R0);
    s->r[1] = COLUMN(COLUMN_R1);
    s->dr = COLUMN(COLUMN_DR);
    s->dr_lo = COLUMN(COLUMN_DR_LO);
    s->cap[0] = v_lt(v_set(0), COLUMN(COLUMN_CAP0));
    s->cap[1] = v_lt(v_set(0), COLUMN(COLUMN_CAP1));
#undef COLUMN
}

/* What the first pass needs of lanes from `lane` on, which are in a row. */
INLINE void row_at(const source *from, size_t lane, mode m, int kind,
                   lanes_line *l, lanes_shape *s)
{
    if (m == ONE_SHAPE) {
        const cylint_lines *lines = from->job->lines;
        for (int i = 0; i < 3; i++) {
            l->o[i] = v_load(lines->o[i] + lane);
            l->u[i] = v_load(lines->d[i] + lane);
        }
        *s = from->one;
        return;
    }
    const size_t stride = from->run->stride;
    const double *column = from->run->column + lane;
#define COLUMN(c) v_load(column + (size_t)(c) * stride)
    for (int i = 0; i < 3; i++) {
        s->base[i] = COLUMN(COLUMN_BASE + i);
        s->axis[i] = COLUMN(COLUMN_AXIS + i);
        if (kind >= CYLINT_KIND_ECYLINDER) {
            s->a[i] = COLUMN(COLUMN_A + i);
            s->b[i] = COLUMN(COLUMN_B + i);
        }
    }
    s->r[0] = COLUMN(COLUMN_R0);
    s->dr = kind == CYLINT_KIND_CYLINDER ? v_set(0) : COLUMN(COLUMN_DR);
#undef COLUMN
    if (m == ONE_LINE) {
        *l = from->line;
    } else {
        size_t at[LANES];
        for (int i = 0; i < LANES; i++)
            at[i] = from->run->number[lane + (size_t)i < from->n
                                      ? lane + (size_t)i : from->n - 1];
        for (int i = 0; i < 3; i++) {
            l->o[i] = pick(from->job->lines->o[i], at);
            l->u[i] = pick(from->job->lines->d[i], at);
        }
    }
}

/* The lanes that pass by for certain: G < 0 by more than its error. */
INLINE vm pass_by(const lanes_line *l, const lanes_shape *s, int kind)
{
    letters_lanes L;
    letters_sizes N;
    lanes_letters(&L, &N, s, l, kind, 0);
    const vd u = N.u[0], D = N.D[0][0];
    const bounded_value G = with_bound(form_G_lanes(&L), form_G_sizes(&N));
    const vd most = v_set(CYLINT_WINDOW), least = v_set(1 / CYLINT_WINDOW);
    const vm window = m_and(v_le(v_max(u, D), most), v_le(least, u));
    return m_and(window, v_lt(G.v, -G.e));
}

/* First pass over a block: the lanes left, as a list. */
INLINE int lanes_left(const source *from, size_t start, size_t end, mode m,
                      int kind, size_t *left)
{
    int n = 0;
    for (size_t lane = start; lane < end; lane += LANES) {
        lanes_line l;
        lanes_shape s;
        unsigned in = (1u << LANES) - 1;
        if (end - lane < LANES) {
            in = (1u << (end - lane)) - 1;
            if (m == ONE_SHAPE) { /* do not read beyond the caller's arrays */
                for (; lane < end; lane++)
                    left[n++] = lane;
                break;
            }
        }
        row_at(from, lane, m, kind, &l, &s);
        unsigned bits = m_bits(m_not(pass_by(&l, &s, kind))) & in;
        for (; bits; bits &= bits - 1)
#ifdef __GNUC__
            left[n++] = lane + (size_t)__builtin_ctz(bits);
#else
        {
            int k = 0;
            while (!(bits >> k & 1))
                k++;
            left[n++] = lane + (size_t)k;
        }
#endif
    }
    return n;
}

/* A judged and rounded group of lanes, for reading one at a time; t, more
 * and error only where t is wanted. */
typedef struct {
    double t[2][LANES], more[2][LANES], error[2][LANES], part[2][LANES];
    unsigned undecided, cross, hit[2], leaving_first;
} group;

INLINE void round_group(const lanes_query *q, const lanes_shape *s,
                        const lanes_line *l, int kind, unsigned want,
                        lanes_verdict *v, group *g)
{
    const vd plus = v_set(1), minus = v_set(-1);
    if (want & CYLINT_WANT_NEAREST) {
        /* one root a lane: both places share one rounding */
        const vm second = m_and(v->hit[1], m_not(v->hit[0]));
        const vm any = m_or(v->hit[0], v->hit[1]);
        if (!m_any(any))
            return;
        const vm exits = m_or(m_and(second, m_not(v->leaving_first)),
                              m_and(m_not(second), v->leaving_first));
        const bounded_value t = choose(second, v->stop[1], v->stop[0]);
        lanes_root r = take_root(q, t);
        if (!(want & CYLINT_WANT_FAST) || m_any(m_and(any, m_not(r.sure))))
            r = round_root(q, s, l, kind, v_select(exits, plus, minus), t,
                           v_select(second, v->part[1], v->part[0]));
        v->undecided = m_or(v->undecided, m_and(any, m_not(r.sure)));
        for (int i = 0; i < 2; i++) {
            v_store(g->t[i], r.value);
            v_store(g->more[i], r.more);
            v_store(g->error[i], r.error);
        }
        return;
    }
    for (int i = 0; i < 2; i++) {
        if (!m_any(v->hit[i]))
            continue;
        const vm exits = i ? m_not(v->leaving_first) : v->leaving_first;
        lanes_root r = take_root(q, v->stop[i]);
        if (!(want & CYLINT_WANT_FAST) ||
            m_any(m_and(v->hit[i], m_not(r.sure))))
            r = round_root(q, s, l, kind, v_select(exits, plus, minus),
                           v->stop[i], v->part[i]);
        v->undecided = m_or(v->undecided, m_and(v->hit[i], m_not(r.sure)));
        v_store(g->t[i], r.value);
        v_store(g->more[i], r.more);
        v_store(g->error[i], r.error);
    }
}

static void lane_answer(const group *g, int lane, unsigned want,
                        cylint_kernel_answer *a)
{
    a->relation = g->cross >> lane & 1 ? CYLINT_CROSS : CYLINT_MISS;
    a->n = 0;
    for (int i = 0; i < 2; i++) {
        if (!(g->hit[i] >> lane & 1))
            continue;
        const int swapped = (int)(g->leaving_first >> lane & 1);
        a->t[a->n] = g->t[i][lane];
        a->more[a->n] = g->more[i][lane];
        a->error[a->n] = g->error[i][lane];
        a->part[a->n] = (int)g->part[i][lane];
        a->side[a->n] = swapped ? !i : i;
        a->n++;
        if (want & CYLINT_WANT_NEAREST)
            return;
    }
}

static int deliver(const source *from, const group *g, const size_t *lane,
                   int lanes, mode m)
{
    cylint_job *job = from->job;
    unsigned bits = (g->undecided | g->cross) & ((1u << lanes) - 1);
    for (int i = 0; bits >> i; i++) {
        if (!(bits >> i & 1))
            continue;
        const size_t number = number_of(from, lane[i], m);
        cylint_kernel_answer answer;
        if (g->undecided >> i & 1) {
            const cylint_shape *shape = m == ONE_SHAPE
                                      ? from->shape : &job->shapes[number];
            cylint_kernel_ask(job, shape, number, &answer);
            if (answer.relation == CYLINT_MISS)
                continue;
        } else {
            lane_answer(g, i, job->want, &answer);
        }
        if (job->take(job, number, &answer))
            return 1;
    }
    return 0;
}

/* Second pass: judges the lanes of the list. */
INLINE int judge_list(const source *from, size_t *list, int n, mode m,
                      int kind)
{
    cylint_job *job = from->job;
    for (int i = n; i % LANES; i++)
        list[i] = list[n - 1];
    for (int i = 0; i < n; i += LANES) {
        const int lanes = n - i < LANES ? n - i : LANES;
        lanes_line l;
        lanes_shape s;
        lanes_query q;
        group g;
        line_at(from, list + i, m, &l);
        shape_at(from, list + i, m, kind, &s);
        /* a line with an empty domain is none (other invalid lines are left
         * undecided, because their numbers compare to nothing) */
        const vm in_use = m_and(m_from((1u << lanes) - 1),
                                v_le(l.tmin, l.tmax));
        lanes_verdict v = lanes_judge(&q, &s, &l, kind, from->bounded,
                                      in_use);
        if (job->want & CYLINT_WANT_NEAREST && m == ONE_LINE) {
            /* what begins beyond the nearest hit so far is of no interest */
            const vd from_here = v_select(v.hit[0], v.stop[0].v, v.stop[1].v);
            const vd e = v_select(v.hit[0], v.stop[0].e, v.stop[1].e);
            const vm beyond = v_lt(v_set(job->nearest), from_here - e);
            v.hit[0] = m_and(v.hit[0], m_not(beyond));
            v.hit[1] = m_and(v.hit[1], m_not(beyond));
        }
        if (job->want & CYLINT_WANT_T)
            round_group(&q, &s, &l, kind, job->want, &v, &g);
        g.undecided = m_bits(v.undecided);
        g.cross = m_bits(v.cross);
        g.hit[0] = m_bits(v.hit[0]);
        g.hit[1] = m_bits(v.hit[1]);
        g.leaving_first = m_bits(v.leaving_first);
        v_store(g.part[0], v.part[0]);
        v_store(g.part[1], v.part[1]);
        if ((g.undecided | g.cross) != 0 &&
            deliver(from, &g, list + i, lanes, m))
            return 1;
    }
    return 0;
}

INLINE int block_left(const source *from, size_t start, size_t end, mode m,
                      int kind, size_t *list)
{
    switch (m) { /* a first pass of its own for each */
    case ONE_LINE:
        return lanes_left(from, start, end, ONE_LINE, kind, list);
    case ONE_SHAPE:
        return lanes_left(from, start, end, ONE_SHAPE, kind, list);
    default:
        return lanes_left(from, start, end, PAIRS, kind, list);
    }
}

INLINE int work(const source *from, mode m, int kind)
{
    size_t list[BLOCK + LANES];
    for (size_t start = 0; start < from->n; start += BLOCK) {
        const size_t end = from->n - start < BLOCK ? from->n : start + BLOCK;
        const int n = block_left(from, start, end, m, kind, list);
        if (n > 0 && judge_list(from, list, n, m, kind))
            return 1;
    }
    return 0;
}

static int work_on(const source *from, mode m, int kind)
{
    switch (kind) {
    case CYLINT_KIND_CYLINDER:
        return work(from, m, CYLINT_KIND_CYLINDER);
    case CYLINT_KIND_CONE:
        return work(from, m, CYLINT_KIND_CONE);
    case CYLINT_KIND_ACONE:
        return work(from, m, CYLINT_KIND_ACONE);
    case CYLINT_KIND_ECYLINDER:
        return work(from, m, CYLINT_KIND_ECYLINDER);
    default:
        return work(from, m, CYLINT_KIND_ECONE);
    }
}

int CYLINT_SHAPES(cylint_job *job, const cylint_run *run)
{
    source from = {.job = job, .run = run, .n = run->n,
                   .bounded = run->bounded};
    const cylint_line *l = job->line;
    if (l)
        broadcast_line(&from.line, l);
    return work_on(&from, l ? ONE_LINE : PAIRS, run->kind);
}

int CYLINT_LINES(cylint_job *job, const cylint_shape *shape)
{
    source from = {.job = job, .shape = shape, .n = job->lines->n,
                   .bounded = shape->ends < CYLINT_INFINITE};
    broadcast_shape(&from.one, shape, shape->kind);
    return work_on(&from, ONE_SHAPE, shape->kind);
}
