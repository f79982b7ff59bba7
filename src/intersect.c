/*
 * intersect.c - one line and one shape: relation and hits, by the filter or by
 * exact signs
 *
 * Where the filter does not decide, roots/roots.h has the ends of the overlap,
 * and these are hits if they are in the domain.
 */
#include "intersect.h"

#include "roots/roots.h"
#include "shapes/local.h"
#include "dispatch.h"

/* By the kernel of the shape's solid; by all stages of the filter, one after the
 * other. */
CYLINT_INLINE int by_kernel(const cylint_shape *shape, const cylint_line *line,
                            unsigned want, cylint_answer *answer,
                            cylint_question *q)
{
    const unsigned solid =
        (unsigned)cylint_prepared(shape) & -(unsigned)line->in_range;
    q->shape = shape;
    q->line = line;
    q->answer = answer;
    q->want = want;
    return cylint_one_used->by_solid[solid](shape, line, q);
}

CYLINT_INLINE int by_filter(const cylint_shape *shape, const cylint_line *line,
                            unsigned want, cylint_answer *answer,
                            cylint_question *q)
{
    const int n = by_kernel(shape, line, want, answer, q);
    return n == CYLINT_UNDECIDED ? cylint_one_used->refine(q) : n;
}

#if CYLINT_IS_PARANOID
/* Whether wanted members differ in a bit. */
static int hits_differ(const cylint_hit *x, const cylint_hit *y, unsigned want)
{
    cylint_hit of_x = {.t = 0}, of_y = {.t = 0};
    cylint_copy_hit(&of_x, x, want);
    cylint_copy_hit(&of_y, y, want);
    return memcmp(&of_x, &of_y, sizeof of_x) != 0;
}

static int answers_differ(const cylint_answer *x, const cylint_answer *y,
                          unsigned want)
{
    /* mutant '!=' -> '==': an effect with PARANOID=1 only */
    int differ = x->relation != y->relation || x->n != y->n;
    for (int i = 0; i < x->n && !differ; i++)
        differ = hits_differ(&x->hit[i], &y->hit[i], want);
    return differ;
}
#endif

/* Writes the wanted members beside t of a hit, from t, part and side of `known`, as
 * far as pairs are certain; returns the others. */
static unsigned describe_in_pairs(const cylint_shape *shape,
                                  const cylint_line *line, unsigned want,
                                  const cylint_hit *known, cylint_hit *hit)
{
    const unsigned undecided = want & CYLINT_WANT_BESIDE_T;
    /* the root of a touch is double, or the apex */
    return undecided && known->side != CYLINT_SIDE_BOTH
               ? cylint_one_used->describe(shape, line, undecided, known, hit)
               : undecided;
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
    const cylint_overlap v = cylint_overlap_of(&q);
    answer->relation = v.relation;
    answer->n = 0;
    for (int i = 0; i < v.n; i++) {
        double t = 0;
        if (!cylint_part_is_present(q.ends, v.at[i].part))
            continue;
        open_part(&q, shape, line, v.at[i].part, &ball);
        const int rounded =
            (want & (CYLINT_WANT_T | CYLINT_WANT_BESIDE_T)) != 0;
        if (!cylint_root_within(&q, v.at[i].root, rounded, &t))
            continue;
        const cylint_hit partial = {
            .t = t, .part = v.at[i].part, .side = v.at[i].side};
        cylint_hit *hit = &answer->hit[answer->n++];
        cylint_copy_hit(hit, &partial,
                        want & (CYLINT_WANT_T | CYLINT_WANT_PART));
        cylint_describe_hit(&q, &v.at[i],
                            describe_in_pairs(shape, line, want, &partial, hit),
                            hit);
#if CYLINT_IS_PARANOID
        const unsigned members = want & CYLINT_WANT_BESIDE_T;
        cylint_hit exact;
        cylint_describe_hit(&q, &v.at[i], members, &exact);
        cylint_contradiction(hits_differ(hit, &exact, members));
#endif
        if (want & CYLINT_WANT_NEAREST)
            break;
    }
    return answer->n;
}

/* Writes the undecided members of a hit that the filter decided. */
ASIDE void complete_hit(const cylint_shape *shape, const cylint_line *line,
                        const cylint_hit *partial, unsigned undecided,
                        cylint_hit *hit)
{
    const int on_plane =
        partial->part != CYLINT_PART_LATERAL && !cylint_is_round(shape->kind);
    const cylint_root root =
        cylint_is_plane(shape->kind) ? ROOT_CAP0
        : on_plane ? (partial->part == CYLINT_PART_CAP0 ? ROOT_CAP0 : ROOT_CAP1)
        : partial->side == CYLINT_SIDE_ENTERING ? ROOT_ENTRY
                                                : ROOT_EXIT;
    const cylint_stop at = {root, partial->part, partial->side, 0};
    cylint_query q;
    cylint_shape ball;
    cylint_query_open(&q, shape, line);
    open_part(&q, shape, line, partial->part, &ball);
    cylint_describe_hit(&q, &at, undecided, hit);
}

/* Writes the hits that the filter decided, with their undecided members. */
static void write_hits(const cylint_question *from, unsigned want,
                       const cylint_answer *partial, cylint_answer *answer)
{
    for (int i = 0; i < partial->n; i++) {
        const cylint_hit *k = &partial->hit[i];
        cylint_hit *hit = &answer->hit[i];
        cylint_copy_hit(hit, k, want & (CYLINT_WANT_T | CYLINT_WANT_PART));
        if (from->undecided[i])
            complete_hit(from->shape, from->line, k, from->undecided[i], hit);
    }
}

/* t and part by the filter where it decides, the other members from them. */
ASIDE int answer_all(const cylint_shape *shape, const cylint_line *line,
                     unsigned want, cylint_answer *answer)
{
    cylint_answer partial;
    cylint_question question;
    question.described = answer->hit;
    const int n =
        by_filter(shape, line, want | CYLINT_WANT_T | CYLINT_WANT_PART,
                  &partial, &question);
    if (n == CYLINT_UNDECIDED)
        return cylint_intersect_by_signs(shape, line, want, answer);
    answer->relation = partial.relation;
    answer->n = n;
    write_hits(&question, want, &partial, answer);
    return n;
}

/* Relation, n, t and part: by the filter, or else by signs. */
CYLINT_INLINE int answer_t(const cylint_shape *shape, const cylint_line *line,
                           unsigned want, cylint_answer *answer)
{
    cylint_question q;
    const int n = by_filter(shape, line, want, answer, &q);
    if (n == CYLINT_UNDECIDED)
        return cylint_intersect_by_signs(q.shape, q.line, q.want, q.answer);
    return n;
}

void cylint_describe(const cylint_shape *shape, const cylint_line *line,
                     unsigned want, cylint_hit *hit)
{
    cylint_answer all;
    const unsigned undecided = describe_in_pairs(shape, line, want, hit, hit);
    if (!undecided)
        return;
    cylint_intersect(shape, line, undecided | CYLINT_WANT_T | CYLINT_WANT_PART,
                     &all);
    for (int i = 0; i < all.n; i++)
        if (all.hit[i].t == hit->t && all.hit[i].part == hit->part &&
            all.hit[i].side == hit->side)
            cylint_copy_hit(hit, &all.hit[i], undecided);
}

int cylint_intersect(const cylint_shape *shape, const cylint_line *line,
                     unsigned want, cylint_answer *answer)
{
    answer->flags = 0;
    const int n = want & CYLINT_WANT_BESIDE_T
                      ? answer_all(shape, line, want, answer)
                      : answer_t(shape, line, want, answer);
#if CYLINT_IS_PARANOID
    cylint_answer by_signs;
    cylint_intersect_by_signs(shape, line, want, &by_signs);
    cylint_contradiction(answers_differ(answer, &by_signs, want));
#endif
    return n;
}

int cylint_occluded(const cylint_shape *shape, const cylint_line *line)
{
    cylint_answer answer;
    return CYLINT_IS_PARANOID
               ? cylint_intersect(shape, line, CYLINT_WANT_NEAREST, &answer)
               : answer_t(shape, line, CYLINT_WANT_NEAREST, &answer);
}

int cylint_occluded_in_doubles(int kind, int ends, const cylint_record *from,
                               const cylint_line *line)
{
    cylint_shape shape;
    cylint_answer answer;
    cylint_question question;
    cylint_local_in_doubles(&shape, kind, ends, from);
    return by_kernel(&shape, line, CYLINT_WANT_NEAREST, &answer, &question);
}

/* Without the filter. */
ASIDE int contains_by_signs(const cylint_shape *shape, const double point[3])
{
    cylint_line line;
    cylint_query q;
    if (shape->kind == CYLINT_KIND_NONE ||
        cylint_open_at(&q, shape, &line, point) != CYLINT_OK)
        return -1;
    if (cylint_is_round(q.kind))
        return cylint_round_contains(&q);
    if (cylint_is_plane(q.kind))
        return -cylint_form_sign(&q, FORM_ALPHA, 0);
    int within = 1; /* the least of the signs */
    if (cylint_ends_are_planes(q.ends)) {
        const int above = cylint_form_sign(&q, FORM_ALPHA, 0);
        const int below = -cylint_form_sign(&q, FORM_ALPHA, 1);
        within = above < below ? above : below;
    } else if (q.ends == CYLINT_ENDS_NAPPE) {
        within = cylint_form_sign(&q, FORM_RHO0, 0);
    }
    if (within < 0)
        return -1;
    const int lateral_sign = -cylint_form_sign(&q, FORM_C, 0);
    return lateral_sign < within ? lateral_sign : within;
}

int cylint_contains(const cylint_shape *shape, const double point[3])
{
    const int side =
        cylint_largest(point) <= CYLINT_FAR
            ? cylint_one_used->contains[cylint_prepared(shape)](shape, point)
            : CYLINT_SIGN_UNDECIDED;
    /* mutant '!' -> '': slower, exact arithmetic decides */
    if (side != CYLINT_SIGN_UNDECIDED && !CYLINT_IS_PARANOID)
        return side;
    const int exactly = contains_by_signs(shape, point);
    cylint_contradiction(side != CYLINT_SIGN_UNDECIDED && side != exactly);
    return exactly;
}
