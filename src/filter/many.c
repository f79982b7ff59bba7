/*
 * many.c - many lines or many shapes, in lanes
 *
 * Compiled once for each instruction set.  The first pass tests in every lane
 * whether the line certainly misses the ball about the shape.  This test reads
 * the fewest data and needs neither a division nor a square root.  The lanes
 * that remain are collected.  As soon as they fill a vector they are classified,
 * and the roots of those that hit are rounded.  Undecided lanes are returned as
 * such; they do not affect their neighbours.
 */
#include <stddef.h>

#include "members.h"
#define CYLINT_WIDE
#include "../shapes/upright_template.h"

#ifndef CYLINT_MANY
#define CYLINT_MANY cylint_many_plain
#endif

/* The bits of all lanes. */
#define ALL ((1u << LANES) - 1)

/* What all lanes have in common: the line, the shape, or nothing.  Only the first
 * pass is compiled for each. */
typedef enum { MODE_LINE, MODE_SHAPE, MODE_PAIRS } mode;

/* ---------------------------------------- the first pass: balls about -- */

/* Elements of an array; in_a_row: their numbers follow each other. */
INLINE vd elements(const double *x, const size_t *number, int in_a_row)
{
    return in_a_row ? v_load(x + number[0]) : v_pick(x, number);
}

/* A line and the ball about a shape, which is a sphere; and copies of the columns
 * from which they are loaded: the list that the pass writes cannot change these. */
typedef struct {
    frames frame;
    line_lanes line;
    cylint_run run;
    cylint_lines lines;
    size_t n;
} ball_pass;

/* The lanes whose line certainly misses the ball. */
INLINE vm misses_ball(const local_line *l)
{
    forms f;
    first_form(&f, l, CYLINT_SOLID_SPHERE);
    const bounded_value g = bounded_G(&f, l, CYLINT_SOLID_SPHERE);
    return m_and(l->in_range, v_lt(g.v, -g.e));
}

/* The lanes whose ball is not certainly beyond the line's domain or the nearest
 * hit. */
INLINE unsigned within_reach(const local_line *l,
                             const cylint_filter_batch *from)
{
    const cylint_line *line = from->line;
    const vd reach = l->in.r * v_set(from->speed), one = v_set(1);
    const bounded_value A = bounded_A(ball_A_doubles(&l->in), l, one),
                        B = bounded_B(ball_B_doubles(&l->in, l->in.z), l, one);
    const double end = from->nearest < line->tmax ? from->nearest : line->tmax;
    const bounded_value first = slope_at(A, B, v_set(line->tmin)),
                        last = slope_at(A, B, v_set(end));
    const vm before = v_lt(reach, first.v - first.e);
    const vm beyond = v_lt(last.v + last.e, -reach);
    return m_bits(m_not(m_or(before, beyond)));
}

/* Loads what differs from lane to lane, from lane `lane` on. */
INLINE void pass_at(ball_pass *b, size_t lane, mode m)
{
    const cylint_lines *lines = &b->lines;
    if (m != MODE_SHAPE) {
        const double *column = b->run.column + lane;
        const size_t stride = b->run.stride;
        EACH(i, 3)
            b->frame.of[CYLINT_AT_BASE + i] =
                v_load(column + (size_t)i * stride);
        b->frame.of[CYLINT_AT_R0] = v_load(column + COLUMN_BALL * stride);
    }
    if (m == MODE_SHAPE) {
        EACH(i, 3) {
            b->line.o[i] = v_load(lines->o[i] + lane);
            b->line.d[i] = v_load(lines->d[i] + lane);
        }
    } else if (m == MODE_PAIRS) {
        const size_t *at = b->run.number + lane;
        const int in_a_row = lane + LANES <= b->n && /* not padded */
                             at[LANES - 1] - at[0] == LANES - 1;
        EACH(i, 3) {
            b->line.o[i] = elements(lines->o[i], at, in_a_row);
            b->line.d[i] = elements(lines->d[i], at, in_a_row);
        }
    }
}

/* Loads what all lanes have in common. */
INLINE void load_pass(ball_pass *b, const cylint_filter_batch *from, mode m)
{
    b->n = from->n;
    if (m != MODE_SHAPE)
        b->run = *from->run;
    if (m != MODE_LINE)
        b->lines = *from->lines;
    if (m == MODE_SHAPE)
        b->frame.of[CYLINT_AT_R0] = v_set(from->radius);
    EACH(i, 3) {
        if (m == MODE_SHAPE)
            b->frame.of[CYLINT_AT_BASE + i] = v_set(from->center[i]);
        if (m == MODE_LINE) {
            b->line.o[i] = v_set(from->line->o[i]);
            b->line.d[i] = v_set(from->line->d[i]);
        }
    }
}

/* How many lanes the first pass tests at a time, with one branch for all of them:
 * the outcomes of one vector are hard to predict. */
enum { BLOCK = 16, VECTORS = BLOCK / LANES };

INLINE local_line ball_at(ball_pass *pass, size_t lane, mode m)
{
    const source from = {&pass->frame, &pass->line};
    local_line l;
    pass_at(pass, lane, m);
    load_first(&l, &from, CYLINT_SOLID_SPHERE);
    return l;
}

/* The lanes of a vector whose line does not certainly miss the ball. */
INLINE unsigned lanes_kept(ball_pass *pass, size_t lane, mode m)
{
    const size_t n = pass->n - lane;
    const unsigned there = n < LANES ? (1u << n) - 1 : ALL;
    if (m == MODE_SHAPE && n < LANES) /* the caller's arrays end there */
        return there;
    const local_line ball = ball_at(pass, lane, m);
    return there & m_bits(m_not(misses_ball(&ball)));
}

/* Puts the numbers of the lanes `kept` into the list; returns how many. */
INLINE size_t keep_numbers(size_t *list, const ball_pass *pass, size_t lane,
                           mode m, unsigned kept)
{
    size_t n = 0;
    if (m != MODE_SHAPE)
        return v_keep(list, pass->run.number + lane, kept);
    for (unsigned i = 0; i < LANES; i++) { /* no branch to predict */
        list[n] = lane + i;
        n += kept >> i & 1;
    }
    return n;
}

/* Puts the numbers of lanes that do not certainly miss into the list, until it has
 * `enough`. */
INLINE void first_pass(cylint_filter_batch *from, size_t enough, mode m)
{
    size_t *list = from->list, end = from->end, lane = from->lane;
    ball_pass pass;
    load_pass(&pass, from, m);
    while (lane < pass.n && end < enough) {
        const size_t n = pass.n - lane;
        const int vectors =
            n < BLOCK ? (int)((n + LANES - 1) / LANES) : VECTORS;
        unsigned kept[VECTORS], any = 0;
        for (int i = 0; i < vectors; i++)
            any |= kept[i] = lanes_kept(&pass, lane + (size_t)i * LANES, m);
        for (int i = 0; any && i < vectors; i++) {
            const size_t at = lane + (size_t)i * LANES;
            if (m == MODE_LINE && !from->relations) {
                if (!kept[i])
                    continue;
                const local_line ball = ball_at(&pass, at, m);
                kept[i] &= within_reach(&ball, from);
            }
            end += keep_numbers(list + end, &pass, at, m, kept[i]);
        }
        lane += (size_t)vectors * LANES;
    }
    from->lane = lane;
    from->end = end;
}

/* Fills the list; returns how many of its numbers the next group has. */
static int next_numbers(cylint_filter_batch *from)
{
    enum {
        CAPACITY = sizeof from->list / sizeof *from->list - BLOCK - 2 * LANES
    };
    const size_t due = from->awaited < LANES ? from->awaited : LANES;
    size_t listed = from->end - from->first;
    if (from->first > CAPACITY) {
        memmove(from->list, from->list + from->first,
                listed * sizeof *from->list);
        from->first = 0;
        from->end = listed;
    }
    if (listed < due && from->lane < from->n) {
        const size_t enough = from->first + due;
        if (!from->run)
            first_pass(from, enough, MODE_SHAPE);
        else if (from->line)
            first_pass(from, enough, MODE_LINE);
        else
            first_pass(from, enough, MODE_PAIRS);
        listed = from->end - from->first;
    }
    if (listed > LANES)
        listed = LANES;
    from->awaited += listed;
    return (int)listed;
}

/* ------------------------------------------- shapes from their records -- */

INLINE void set_pair(frames *to, int at, vpair x)
{
    to->of[at] = x.hi;
    to->of[at + CYLINT_LOW] = x.lo;
}

INLINE void set_row(frames *to, int row, const four *x)
{
    EACH(i, 3)
        set_pair(to, CYLINT_AT_COLUMNS + 3 * i + row, x->part[i]);
}

/* Of a cylinder, cone, capsule or round cone with accurate local coordinates and
 * both caps.  The errors are those of upright_rows(), so the bounds of
 * error_bounds.h hold. */
ASIDE void frames_of_records(frames *to, const char *const record[LANES],
                             int solid)
{
    const int is_hull = solid == CYLINT_SOLID_ROUND_CONE;
    vd base[4], top[4];
    four axis;
    rows m;
    v_columns(record, offsetof(cylint_record, p0), base);
    v_columns(record, offsetof(cylint_record, p1), top);
    EACH(i, 4)
        axis.part[i] = v_two_sum(top[i], -base[i]);
    const inverse_lengths inverse =
        upright_rows(&m, &axis, is_hull ? -1 : 1, 0, NULL);
    const vpair height = last_of(&m.x), slope = last_of(&m.z);
    EACH(i, 4)
        to->of[CYLINT_AT_BASE + i] = base[i]; /* and r0 */
    to->of[CYLINT_AT_R1] = top[3];
    set_row(to, 0, &m.x);
    set_row(to, 1, &m.y);
    set_row(to, 2, &m.z);
    set_pair(to, CYLINT_AT_HEIGHT, height);
    set_pair(to, CYLINT_AT_SLOPE, slope);
    to->of[CYLINT_AT_ERROR] = v_set(CYLINT_LOCAL_ERROR);
    if (is_hull) {
        const vpair cosine = cosine_of_hull(&inverse);
        set_pair(to, CYLINT_AT_SINE, slope);
        set_pair(to, CYLINT_AT_COSINE, cosine);
        set_pair(to, CYLINT_AT_SLOPE, one_mul(axis.part[3], inverse.lateral));
        to->of[CYLINT_AT_ERROR] =
            v_set(CYLINT_LOCAL_ERROR) / (cosine.hi * cosine.hi);
    }
    to->of[CYLINT_AT_NORM] = v_set(CYLINT_LOCAL_NORM * CYLINT_SLACK);
    to->of[CYLINT_AT_REACH] =
        (height.hi + v_max(base[3], top[3])) * v_set(CYLINT_SLACK);
    to->fact[FACT_CAP0] = to->fact[FACT_CAP1] = m_if_all(1);
}

/* ------------------------------------------------------- the answers ---- */

/* The questions of a group.  shape: NULL if all have the same, or frames are made
 * of records. */
typedef struct {
    const cylint_filter_batch *from;
    const size_t *number;
    frames frame;
    line_lanes line;
    const cylint_shape *const *shape;
    unsigned in_use;
} group_questions;

INLINE place place_at(const local_line *l, const verdict *v, vd limit,
                      int solid)
{
    point_signs at = no_point_signs;
    if (m_any(v_le(v_abs(limit), v_set(CYLINT_LATE))))
        set_point_signs(&at, l, v, near_limit(limit), solid);
    if (has_end_planes(solid))
        set_between_planes(&at, v->in_plane);
    return place_of(&at, v, limit, solid);
}

INLINE hits hits_of_places(const place *from, const place *to, vm present,
                           int k)
{
    const vm sure = m_and(m_or(from->before, m_or(from->inside, from->after)),
                          m_or(to->before, m_or(to->inside, to->after)));
    const vm begins = m_and_not(from->before, to->before);
    const vm ends = m_and_not(to->after, from->after);
    return (hits){m_and(present, k ? ends : begins), m_not(sure)};
}

/* The lanes whose first root is not certainly beyond the nearest hit.  Where a
 * nappe has no first end, its second root may be before the first. */
INLINE vm may_be_nearest(const estimate *first, const verdict *v,
                         double nearest, int solid)
{
    const vd beyond = (first->t - v_set(nearest)) * first->scale;
    vm sure = m_and(first->is_near, v_lt(v_set(0), first->scale));
    if (solid == CYLINT_SOLID_NAPPE)
        sure = m_and(sure, v->exists[0]);
    return m_not(m_and(sure, v_lt(first->off, beyond)));
}

/* The lanes in which all wanted members of the hits with these roots are
 * certain. */
ASIDE unsigned describe_lanes(const source *from, const pair_line *in,
                              const hit_root *r, unsigned want, int solid,
                              cylint_hit_lanes *to)
{
    unsigned uncertain = 0;
    members_at(to, from, in, r, want, solid);
    for (unsigned i = 0; i < CYLINT_MEMBERS; i++)
        if (want & (unsigned)CYLINT_WANT_POINT << i)
            uncertain |= ~to->certain >> 8 * i;
    return ~uncertain & ALL;
}

/* The lines in pairs.  First loads the numbers of the shapes that these and members
 * of hits read. */
INLINE void lines_in_pairs(pair_line *to, group_questions *x, unsigned want,
                           int solid)
{
    const source from = {&x->frame, &x->line};
    if (x->shape)
        gather_pairs(&x->frame, x->shape, solid);
    if (x->shape && want & CYLINT_WANT_BESIDE_T)
        EACH(i, 3)
            gather_fact(&x->frame, x->shape, FACT_SKEW + i);
    load_pairs(to, &from, solid);
}

/* One function for all solids but spheres; for spheres the code is short and
 * inlined. */
ASIDE void any_lines_in_pairs(pair_line *to, group_questions *x, unsigned want,
                              int solid)
{
    lines_in_pairs(to, x, want, solid);
}

/* Writes the hits k, on these ends, but for t. */
INLINE void store_hits(cylint_filter_group *g, int k, const line_end *end,
                       vm hit)
{
    const vd cap =
        v_select(end->top, v_set(CYLINT_PART_CAP1), v_set(CYLINT_PART_CAP0));
    v_store(g->part[k], v_select(end->on_end, cap, v_set(CYLINT_PART_LATERAL)));
    g->hit[k] = m_bits(hit);
}

/* The hits of lanes that cross, by roots.  Returns the lanes with an undecided hit;
 * removes those whose hits are not wanted from *crosses. */
INLINE vm find_roots(group_questions *x, const local_line *l, verdict *v,
                     vm *crosses, unsigned want, int solid,
                     cylint_filter_group *g)
{
    const source from = {&x->frame, &x->line};
    const int nearest = (want & CYLINT_WANT_NEAREST) != 0;
    pair_line in;
    vm undecided = m_from(0);
    if (cylint_solid_is_hull(solid))
        compute_balls(&v->ball, l);
    for (int k = 0; k < 2; k++) {
        const line_end end_k = end_number(l, v, k, solid);
        const estimate at = estimate_end(l, v, &end_k, solid);
        if (k == 0) {
            if (nearest)
                *crosses = m_and(
                    *crosses, may_be_nearest(&at, v, x->from->nearest, solid));
            if (!m_any(*crosses))
                return undecided;
            if (solid == CYLINT_SOLID_SPHERE)
                lines_in_pairs(&in, x, want, solid);
            else
                any_lines_in_pairs(&in, x, want, solid);
        }
        const root r =
            step_from(at.t, residual_at(&in, l, at.t, &end_k, solid), &at);
        const vm present = is_present(l, v, &end_k, k, solid);
        const hits h = hits_of_roots(&r, l, present);
        store_hits(g, k, &end_k, h.hit);
        undecided =
            m_or(undecided, m_or(h.undecided, m_and_not(present, at.is_near)));
        v_store(g->t[k], r.value);
        if (want & CYLINT_WANT_BESIDE_T && m_any(h.hit)) {
            const hit_root hit = {r.value, r.tail, r.error, end_k.on_end,
                                  end_k.top};
            const pair_line copy = in;
            const unsigned certain =
                describe_lanes(&from, &copy, &hit, want, solid, &g->member[k]);
            undecided = m_or(undecided, m_and_not(h.hit, m_from(certain)));
        }
        if (nearest && !m_any(m_and_not(*crosses, h.hit)))
            break;
    }
    return undecided;
}

/* The same by signs at the ends of the domain. */
INLINE vm find_places(const local_line *l, const verdict *v, int solid,
                      cylint_filter_group *g)
{
    vm undecided = m_from(0);
    place at[2];
    for (int i = 0; i < 2; i++)
        at[i] = place_at(l, v, l->limit[i], solid);
    EACH(k, 2) {
        const line_end end = end_number(l, v, k, solid);
        const vm present = is_present(l, v, &end, k, solid);
        const hits h = hits_of_places(&at[0], &at[1], present, k);
        store_hits(g, k, &end, h.hit);
        undecided = m_or(undecided, h.undecided);
    }
    return undecided;
}

/* Whether the axis from base to top runs along coordinate i, and a line from o with
 * the direction d lies in the plane of an end; o and d are its coordinates i. */
static int lies_in_end(const double base[3], const double top[3], double o,
                       double d, int i)
{
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    return cylint_sign(d) == 0 && cylint_rank(base[j]) == cylint_rank(top[j]) &&
           cylint_rank(base[k]) == cylint_rank(top[k]) &&
           (cylint_rank(o) == cylint_rank(base[i]) ||
            cylint_rank(o) == cylint_rank(top[i]));
}

/* The lanes whose line lies in the plane of an end, one of coordinates.  Only
 * shapes between two points are tested. */
ASIDE unsigned lanes_in_plane(const group_questions *x, unsigned lanes)
{
    const cylint_filter_batch *from = x->from;
    double o[3][LANES], d[3][LANES];
    unsigned found = 0;
    EACH(i, 3) {
        v_store(o[i], x->line.o[i]);
        v_store(d[i], x->line.d[i]);
    }
    for (int lane = 0; lane < LANES; lane++) {
        const cylint_shape *s = x->shape ? x->shape[lane] : from->shapes;
        const cylint_record *record =
            from->records ? &from->records[x->number[lane]] : NULL;
        if (!(lanes >> lane & 1) ||
            (!record && !cylint_has_end_points(s->kind)))
            continue;
        const double *base = record ? record->p0 : cylint_base(s),
                     *top = record ? record->p1 : cylint_top(s);
        for (int i = 0; i < 3; i++)
            if (lies_in_end(base, top, o[i][lane], d[i][lane], i))
                found |= 1u << lane;
    }
    return found;
}

typedef void lanes_kernel(group_questions *x, cylint_filter_group *g);

INLINE void answer_lanes(group_questions *x, int solid, cylint_filter_group *g)
{
    const unsigned want = x->from->want;
    const source from = {&x->frame, &x->line};
    const vm in_use =
        m_and(m_from(x->in_use), v_le(x->line.limit[0], x->line.limit[1]));
    local_line l;
    forms f;
    verdict v;
    g->found = g->undecided = g->hit[0] = g->hit[1] = 0;
    g->leaving_first = g->in_cap_plane = 0;
    load_first(&l, &from, solid);
    first_form(&f, &l, solid);
    v.G = bounded_G(&f, &l, solid);
    const vm alive = m_and_not(in_use, m_and(l.in_range, v_lt(v.G.v, -v.G.e)));
    if (!m_any(alive))
        return;
    load_after_G(&l, &from, solid);
    other_forms(&f, &l, solid);
    v.ball.computed = 0;
    judge(&v, &f, &l, solid);
    v.in_plane = m_from(0);
    if (has_end_planes(solid)) {
        const vm open = m_and_not(m_and(alive, l.in_range),
                                  m_or(v.misses, m_and(v.crosses, v.sided)));
        if (m_any(open))
            judge_in_plane(&v, m_from(lanes_in_plane(x, m_bits(open))));
    }
    vm crosses = m_and(m_and(alive, l.in_range), m_and(v.crosses, v.sided));
    vm undecided = m_and_not(alive, m_or(m_and(v.misses, l.in_range), crosses));
    if (m_any(crosses)) {
        const vm equal = /* may be zeros that differ */
            v_eq(x->line.limit[0], x->line.limit[1]);
        const vm doubtful =
            want & CYLINT_WANT_T
                ? find_roots(x, &l, &v, &crosses, want, solid, g)
                : find_places(&l, &v, solid, g);
        undecided = m_or(undecided, m_and(crosses, m_or(equal, doubtful)));
        crosses = m_and_not(crosses, undecided);
    }
    const unsigned sure = m_bits(crosses);
    g->hit[0] &= sure;
    g->hit[1] &= sure;
    g->undecided = m_bits(undecided);
    g->in_cap_plane = cylint_solid_is_round(solid) ? 0 : m_bits(v.in_plane);
    g->leaving_first = solid == CYLINT_SOLID_DOUBLE_CONE
                           ? m_bits(is_backward(&l, &v, solid))
                           : 0;
    g->found = g->undecided | sure;
}

#define KERNEL(name, solid)                                             \
    ASIDE void name##_lanes(group_questions *x, cylint_filter_group *g) \
    {                                                                   \
        answer_lanes(x, solid, g);                                      \
    }
KERNEL(cylinder, CYLINT_SOLID_CYLINDER)
KERNEL(cone, CYLINT_SOLID_CONE)
KERNEL(whole_cylinder, CYLINT_SOLID_WHOLE_CYLINDER)
KERNEL(double_cone, cylint_whole_cone(x->from->solid))
#define nappe_lanes double_cone_lanes
KERNEL(sphere, CYLINT_SOLID_SPHERE)
KERNEL(capsule, CYLINT_SOLID_CAPSULE)
KERNEL(round_cone, CYLINT_SOLID_ROUND_CONE)
#undef KERNEL

#define MEMBER(name, solid) [solid] = name##_lanes,
static lanes_kernel *const of_solid[CYLINT_SOLIDS] = {
    CYLINT_EACH_SOLID(MEMBER)};
#undef MEMBER
#undef nappe_lanes

/* ------------------------------------------------------- the groups ----- */

/* The same line in all lanes. */
static void broadcast_line(line_lanes *to, const cylint_line *l)
{
    EACH(i, 3) {
        to->o[i] = v_set(l->o[i]);
        to->d[i] = v_set(l->d[i]);
        to->d_lo[i] = v_set(l->d_lo[i]);
    }
    to->limit[0] = v_set(l->tmin);
    to->limit[1] = v_set(l->tmax);
    to->segment = l->segment;
}

/* The lines with these numbers, one in each lane. */
static void gather_lines(line_lanes *to, const cylint_lines *from,
                         const size_t *number)
{
    const int in_a_row = number[LANES - 1] - number[0] == LANES - 1;
    to->limit[0] = v_set(0);
    to->limit[1] = v_set(HUGE_VAL);
    EACH(i, 3) {
        to->o[i] = elements(from->o[i], number, in_a_row);
        to->d[i] = elements(from->d[i], number, in_a_row);
        to->d_lo[i] = v_set(0);
    }
    if (from->tmin)
        to->limit[0] = elements(from->tmin, number, in_a_row);
    if (from->tmax)
        to->limit[1] = elements(from->tmax, number, in_a_row);
    to->segment = 0;
}

static void answer_group(const cylint_filter_batch *from, const size_t *list,
                         int lanes, group_questions *x, cylint_filter_group *g)
{
    const cylint_shape *shape[LANES];
    x->from = from;
    x->number = list;
    if (!from->line)
        gather_lines(&x->line, from->lines, list);
    if (from->records) {
        const char *record[LANES];
        for (int i = 0; i < LANES; i++)
            record[i] = (const char *)&from->records[list[i]];
        frames_of_records(&x->frame, record, from->solid);
    } else if (from->run) {
        for (int i = 0; i < LANES; i++)
            shape[i] = &from->shapes[list[i]];
        gather_shapes(&x->frame, shape, from->solid);
        x->shape = shape;
    }
    x->in_use = (1u << lanes) - 1;
    of_solid[from->solid](x, g);
}

void CYLINT_MANY(cylint_filter_batch *from, cylint_filter_use *use, void *self)
{
    group_questions x;
    cylint_filter_group g;
    x.shape = NULL;
    if (from->line)
        broadcast_line(&x.line, from->line);
    if (!from->run && !from->records)
        broadcast_shape(&x.frame, from->shapes);
    for (int lanes; (lanes = next_numbers(from)) > 0;) {
        size_t *list = from->list + from->first;
        for (int i = lanes; i < LANES; i++)
            list[i] = list[0];
        from->first += (size_t)lanes;
        answer_group(from, list, lanes, &x, &g);
        g.number = list;
        if (g.found && use(self, from, &g))
            return;
    }
}
