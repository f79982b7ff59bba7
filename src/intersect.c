/*
 * intersect.c - one line and one shape: relation and hits, by the filter or by
 * exact signs
 *
 * A bounded shape is convex, so the line overlaps it in one interval:
 * [where the lateral quadric Q <= 0] and [where 0 <= z <= 1].  The signs of
 * forms_template.h at the two planes of the caps decide which of these bounds
 * the overlap (overlap_template.h); no root is computed for that.
 */
#include "intersect.h"

#include "roots/roots.h"
#include "dispatch.h"

typedef struct {
    cylint_root root;
    int part, side, apex;
} stop;

typedef struct {
    int relation, n;
    stop at[2]; /* ascending */
} overlap;

static overlap none(void)
{
    overlap v = {
        CYLINT_RELATION_MISS, 0, {{ROOT_APEX, 0, 0, 0}, {ROOT_APEX, 0, 0, 0}}};
    return v;
}

static overlap one(int relation, cylint_root root, int side, int apex)
{
    overlap v = none();
    v.relation = relation;
    v.n = 1;
    v.at[0] = (stop){root, CYLINT_PART_LATERAL, side, apex};
    return v;
}

static overlap two(int relation, stop first, stop last)
{
    overlap v = none();
    v.relation = relation;
    v.n = 2;
    v.at[0] = first;
    v.at[1] = last;
    v.at[0].side = CYLINT_SIDE_ENTERING;
    v.at[1].side = CYLINT_SIDE_LEAVING;
    return v;
}

static stop lateral(cylint_root root)
{
    return (stop){root, CYLINT_PART_LATERAL, 0, 0};
}

static int radius_is_zero(const cylint_query *q, int cap)
{
    return cylint_sign(cylint_end_factor(q->shape, cap)) == 0;
}

/* Q <= 0 on one interval between its roots: a chord, a point or nothing. */
static overlap chord(cylint_query *q, int relation, int apex)
{
    const int G = cylint_sign_G(q);
    if (G < 0)
        return none();
    if (G == 0)
        return one(CYLINT_RELATION_TOUCH, ROOT_DOUBLE, CYLINT_SIDE_BOTH, apex);
    return two(relation, lateral(ROOT_ENTRY), lateral(ROOT_EXIT));
}

/* The line runs parallel to the caps. */
static overlap level(cylint_query *q)
{
    const int above0 = cylint_sign_alpha(q, 0);
    if (above0 < 0)
        return none();
    const int above1 = cylint_sign_alpha(q, 1);
    if (above1 > 0)
        return none();
    if (above0 != 0 && above1 != 0)
        return chord(q, CYLINT_RELATION_CROSS, 0);
    return chord(q, CYLINT_RELATION_ALONG, radius_is_zero(q, above1 == 0));
}

/* The exact signs that decide the overlap with a bounded shape.  E is computed
 * at once, the others when they are needed. */
typedef struct {
    cylint_query *q;
    int E[2], inward[2], G;
} cap_signs;

enum { UNKNOWN = 2 };

static int inward_sign(cap_signs *c, int cap)
{
    if (c->inward[cap] == UNKNOWN)
        c->inward[cap] = (cap ? 1 : -1) * cylint_sign_N(c->q, cap);
    return c->inward[cap];
}

static int sign_G(cap_signs *c)
{
    if (c->G == UNKNOWN)
        c->G = cylint_sign_G(c->q);
    return c->G;
}

#define FORM(name) name##_exactly
#define OVERLAP_INLINE static
#define TRUTH int
#define AND(a, b) ((a) && (b))
#define OR(a, b) ((a) || (b))
#define PART int
#define CHOOSE(a, x, y) ((a) ? (x) : (y))
#define CAP0 CYLINT_PART_CAP0
#define CAP1 CYLINT_PART_CAP1
#define LATERAL CYLINT_PART_LATERAL
#define CAPS cap_signs
#define E(c, i) ((c)->E[i])
#define INWARD(c, i) inward_sign(c, i)
#define G(c) sign_G(c)
#define POSITIVE(x) ((x) > 0)
#define NEGATIVE(x) ((x) < 0)
#define NOT_POSITIVE(x) ((x) <= 0)
#include "signs/overlap_template.h"

/* Where the overlap begins (end = 0) or ends.  On a rim (E = 0) the plane and
 * the lateral root have the same t; the part is lateral. */
static stop stop_at(const cap_signs *c, int up, int end)
{
    const int cap = up ? end : !end;
    if (c->E[cap] < 0)
        return lateral(end ? ROOT_EXIT : ROOT_ENTRY);
    return (stop){cap ? ROOT_CAP1 : ROOT_CAP0,
                  part_at_exactly(up, c->E[cap] > 0, end), 0,
                  c->E[cap] == 0 && radius_is_zero(c->q, cap)};
}

static overlap touch_rim(const cap_signs *c, int cap)
{
    const stop s = stop_at(c, 1, cap);
    return one(CYLINT_RELATION_TOUCH, s.root, CYLINT_SIDE_BOTH, s.apex);
}

/* Bounded shapes; the line is not parallel to the caps.  up: z grows along
 * it. */
static overlap slab(cylint_query *q, int up)
{
    cap_signs c = {q,
                   {cylint_sign_E(q, 0), cylint_sign_E(q, 1)},
                   {UNKNOWN, UNKNOWN},
                   UNKNOWN};
    const stop begin = stop_at(&c, up, 0), end = stop_at(&c, up, 1);
    if (crosses_exactly(&c))
        return two(CYLINT_RELATION_CROSS, begin, end);
    if (c.E[0] == 0 && c.E[1] == 0) /* a ruling: Q = 0 on all of the line */
        return two(CYLINT_RELATION_ALONG, begin, end);
    if (c.E[0] == 0 || c.E[1] == 0)
        return touch_rim(&c, c.E[1] == 0);
    if (misses_exactly(&c))
        return none();
    return one(CYLINT_RELATION_TOUCH, ROOT_DOUBLE, CYLINT_SIDE_BOTH, 0);
}

static overlap bounded(cylint_query *q)
{
    const int up = cylint_sign_beta(q);
    return up == 0 ? level(q) : slab(q, up > 0);
}

/* A line parallel to the axis of a whole cylinder, or to a ruling. */
static overlap parallel(cylint_query *q)
{
    const int C = cylint_sign_C(q);
    overlap v = none();
    v.relation = C < 0    ? CYLINT_RELATION_CROSS
                 : C == 0 ? CYLINT_RELATION_ALONG
                          : CYLINT_RELATION_MISS;
    return v;
}

static overlap whole_cylinder(cylint_query *q)
{
    return cylint_sign_A(q) == 0 ? parallel(q)
                                 : chord(q, CYLINT_RELATION_CROSS, 0);
}

static overlap double_cone(cylint_query *q)
{
    const int A = cylint_sign_A(q);
    if (A > 0) {
        overlap v = chord(q, CYLINT_RELATION_CROSS, 0);
        if (v.n == 1)
            v.at[0].apex = cylint_sign_T(q) == 0;
        return v;
    }
    if (cylint_sign_G(q) == 0)
        return A < 0 ? one(CYLINT_RELATION_CROSS, ROOT_DOUBLE, CYLINT_SIDE_BOTH,
                           1)
                     : parallel(q);
    if (A == 0)
        return cylint_sign_B(q) > 0 ? one(CYLINT_RELATION_CROSS, ROOT_EXIT,
                                          CYLINT_SIDE_LEAVING, 0)
                                    : one(CYLINT_RELATION_CROSS, ROOT_ENTRY,
                                          CYLINT_SIDE_ENTERING, 0);
    overlap v =
        two(CYLINT_RELATION_CROSS, lateral(ROOT_EXIT), lateral(ROOT_ENTRY));
    v.at[0].side = CYLINT_SIDE_LEAVING;
    v.at[1].side = CYLINT_SIDE_ENTERING;
    return v;
}

/* The nappe where rho >= 0. */
static overlap nappe(cylint_query *q)
{
    const int A = cylint_sign_A(q);
    if (A > 0) {
        const int G = cylint_sign_G(q);
        if (G < 0)
            return none();
        const int T = cylint_sign_T(q);
        return T < 0 ? none() : chord(q, CYLINT_RELATION_CROSS, T == 0);
    }
    /* A <= 0: rho changes along the line, and grows with t or shrinks */
    const int grows = cylint_sign_beta(q) * cylint_sign(q->shape->dr);
    const int side = grows > 0 ? CYLINT_SIDE_ENTERING : CYLINT_SIDE_LEAVING;
    const cylint_root root = grows > 0 ? ROOT_ENTRY : ROOT_EXIT;
    if (cylint_sign_G(q) == 0) {
        if (A < 0)
            return one(CYLINT_RELATION_CROSS, ROOT_APEX, side, 1);
        return cylint_sign_C(q) == 0
                   ? one(CYLINT_RELATION_ALONG, ROOT_APEX, side, 1)
                   : none();
    }
    if (A == 0 && cylint_sign_B(q) * grows > 0)
        return none(); /* the half-line lies in the other nappe */
    return one(CYLINT_RELATION_CROSS, root, side, 0);
}

#include "round_overlap.h"

static overlap overlap_of(cylint_query *q)
{
    if (cylint_is_round(q->kind))
        return round_overlap(q);
    if (cylint_ends_are_planes(q->ends))
        return bounded(q);
    if (!cylint_is_tapered(q->kind))
        return whole_cylinder(q);
    return cylint_is_nappe(q->shape) ? nappe(q) : double_cone(q);
}

/* ------------------------------------------------------- the domain ---- */

static const unsigned beside_t =
    CYLINT_WANT_POINT | CYLINT_WANT_NORMAL | CYLINT_WANT_Z | CYLINT_WANT_PHI;

static void describe(cylint_query *q, const stop *at, double t, double more,
                     double error, unsigned want, cylint_hit *hit)
{
    if (want & beside_t)
        cylint_describe_hit(q, at->root, t, more, error, at->part, at->apex,
                            want, hit);
}

/* Opens the query of the surface that a hit lies on: of a ball of a capsule or
 * rcone, or of the shape itself. */
static void open_part(cylint_query *q, const cylint_shape *shape,
                      const cylint_line *line, int part, cylint_shape *ball)
{
    const int end = part == CYLINT_PART_CAP1;
    if (!cylint_is_round(shape->kind) || shape->kind == CYLINT_KIND_SPHERE)
        return;
    if (part == CYLINT_PART_LATERAL) {
        if (q->shape != shape)
            cylint_query_open(q, shape, line);
        return;
    }
    cylint_ball_of(ball, shape, end);
    cylint_query_open(q, ball, line);
}

int cylint_intersect_by_signs(const cylint_shape *shape,
                              const cylint_line *line, unsigned want,
                              cylint_answer *answer)
{
    cylint_shape ball;
    if (shape->kind == CYLINT_KIND_NONE || !line->valid) {
        answer->relation = CYLINT_RELATION_MISS;
        answer->flags = CYLINT_FLAG_INVALID;
        return answer->n = 0;
    }
    cylint_query q;
    cylint_query_open(&q, shape, line);
    const overlap v = overlap_of(&q);
    answer->relation = v.relation;
    answer->n = 0;
    for (int i = 0; i < v.n; i++) {
        double t = 0, more = 0;
        if (!cylint_part_is_present(q.ends, v.at[i].part))
            continue;
        open_part(&q, shape, line, v.at[i].part, &ball);
        const int rounded = (want & (CYLINT_WANT_T | beside_t)) != 0;
        if (!cylint_root_within(&q, v.at[i].root, rounded, &t, &more))
            continue;
        cylint_hit *hit = &answer->hit[answer->n++];
        if (want & CYLINT_WANT_T)
            hit->t = t;
        if (want & CYLINT_WANT_PART) {
            hit->part = v.at[i].part;
            hit->side = v.at[i].side;
        }
        describe(&q, &v.at[i], t, more, CYLINT_ROOT_SLACK * q.t_error * fabs(t),
                 want, hit);
        if (want & CYLINT_WANT_NEAREST)
            break;
    }
    return answer->n;
}

/* The members beside t and part of hits that the filter decided. */
static void describe_hits(const cylint_shape *shape, const cylint_line *line,
                          unsigned want, const cylint_answer *known,
                          const cylint_root_rest *rest, cylint_answer *answer)
{
    cylint_query q;
    cylint_shape ball;
    cylint_query_open(&q, shape, line);
    for (int i = 0; i < known->n; i++) {
        const cylint_hit *k = &known->hit[i];
        const int on_plane =
            k->part != CYLINT_PART_LATERAL && !cylint_is_round(shape->kind);
        const cylint_root root =
            on_plane ? (k->part == CYLINT_PART_CAP0 ? ROOT_CAP0 : ROOT_CAP1)
            : k->side == CYLINT_SIDE_ENTERING ? ROOT_ENTRY
                                              : ROOT_EXIT;
        const stop at = {root, k->part, k->side, 0};
        open_part(&q, shape, line, k->part, &ball);
        cylint_hit *hit = &answer->hit[i];
        if (want & CYLINT_WANT_T)
            hit->t = k->t;
        if (want & CYLINT_WANT_PART) {
            hit->part = k->part;
            hit->side = k->side;
        }
        describe(&q, &at, k->t, rest->more[i], rest->error[i], want, hit);
    }
}

/* t and part by the filter where it decides, the other members from them. */
ASIDE int answer_all(const cylint_shape *shape, const cylint_line *line,
                     unsigned want, cylint_answer *answer)
{
    cylint_answer known;
    cylint_root_rest rest;
    const int n = cylint_filter_one(cylint_kernels_used()->one, shape, line,
                                    want | CYLINT_WANT_T | CYLINT_WANT_PART,
                                    &known, &rest);
    if (n == CYLINT_UNDECIDED)
        return cylint_intersect_by_signs(shape, line, want, answer);
    answer->relation = known.relation;
    answer->n = n;
    if (n > 0)
        describe_hits(shape, line, want, &known, &rest, answer);
    return n;
}

#if CYLINT_IS_PARANOID
static int contradicts(const cylint_shape *shape, const cylint_line *line,
                       unsigned want, const cylint_answer *known)
{
    cylint_answer a;
    cylint_intersect_by_signs(shape, line, want, &a);
    int wrong = a.relation != known->relation || a.n != known->n;
    for (int i = 0; i < a.n && !wrong; i++)
        wrong = ((want & CYLINT_WANT_PART) &&
                 (a.hit[i].part != known->hit[i].part ||
                  a.hit[i].side != known->hit[i].side)) ||
                ((want & CYLINT_WANT_T) && a.hit[i].t != known->hit[i].t);
    return wrong;
}
#endif

/* Relation, n, t and part: by the filter, or else by signs.  The arguments are
 * volatile because the compiler then stores them before the call, instead of
 * saving and restoring registers for them. */
CYLINT_INLINE int answer_t(const cylint_shape *shape, const cylint_line *line,
                           unsigned want, cylint_answer *answer)
{
    const cylint_shape *volatile const its_shape = shape;
    const cylint_line *volatile const its_line = line;
    cylint_answer *volatile const its_answer = answer;
    const volatile unsigned its_want = want;
    const int n = cylint_filter_one(cylint_kernels_used()->one, shape, line,
                                    want, answer, NULL);
    if (n == CYLINT_UNDECIDED)
        return cylint_intersect_by_signs(its_shape, its_line, its_want,
                                         its_answer);
    return n;
}

CYLINT_INLINE int answer_question(const cylint_shape *shape, const cylint_line *line,
                           unsigned want, cylint_answer *answer)
{
    answer->flags = 0;
    if (want & beside_t)
        return answer_all(shape, line, want, answer);
    return answer_t(shape, line, want, answer);
}

int cylint_intersect(const cylint_shape *shape, const cylint_line *line,
                     unsigned want, cylint_answer *answer)
{
    const int n = answer_question(shape, line, want, answer);
#if CYLINT_IS_PARANOID
    cylint_contradiction(contradicts(shape, line, want, answer));
#endif
    return n;
}

int cylint_occluded(const cylint_shape *shape, const cylint_line *line)
{
    cylint_answer answer;
#if CYLINT_IS_PARANOID
    return cylint_intersect(shape, line, CYLINT_WANT_NEAREST, &answer);
#else
    return answer_t(shape, line, CYLINT_WANT_NEAREST, &answer);
#endif
}

int cylint_contains(const cylint_shape *shape, const double point[3])
{
    static const double along[3] = {1, 0, 0};
    cylint_line line;
    if (shape->kind == CYLINT_KIND_NONE ||
        cylint_whole_line(&line, point, along) != CYLINT_OK)
        return -1;
    cylint_query q;
    cylint_query_open(&q, shape, &line);
    if (cylint_is_round(q.kind))
        return round_contains(&q);
    int within = 1; /* the least of the signs */
    if (cylint_ends_are_planes(q.ends)) {
        const int above = cylint_sign_alpha(&q, 0);
        const int below = -cylint_sign_alpha(&q, 1);
        within = above < below ? above : below;
    } else if (q.ends == CYLINT_ENDS_NAPPE) {
        within = cylint_sign_rho0(&q);
    }
    if (within < 0)
        return -1;
    const int lateral_sign = -cylint_sign_C(&q);
    return lateral_sign < within ? lateral_sign : within;
}
