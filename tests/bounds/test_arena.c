/*
 * test_arena.c - floors numbers and distance: the arena is large enough for every
 * question
 *
 * The functions cylint_exact_*() of this file replace those of exact.c.  They
 * keep only a number's extent, the range of limbs that it can have: all limbs
 * that a double can have, and one more for the carry of each sum.  Nothing
 * cancels and nothing is trimmed, so real numbers never use more limbs
 * (numbers/test_exact.c tests each operation).  Sums of numbers that
 * cylint_leading() has cut, in cylint_angle(), are an exception: they can be
 * longer than here, by some 100 of the limbs that stay free (observed).  Signs
 * decide what the library computes next; they are random.
 *
 * The degree of a number is how many data are multiplied in it: each has LOWEST
 * as the position of its first limb, and positions add.
 */
#include "check.h"
#include "draw.h"
#include "distance/exact_distance.h"
#include "families.h"
#include "roots/roots.h"
#include "shapes/layout.h"

/* The limbs of doubles (exact.c): 2^-1074 is in limb -17, 2^1023 in limb 15,
 * and cylint_exact_from() uses one more. */
enum { LOWEST = -17, LEAF = 34 };

static int larger(int x, int y)
{
    return x > y ? x : y;
}

static exact extent(cylint_arena *arena, int n, int exponent)
{
    const exact x = {arena->limb + arena->used, exponent, (short)n,
                     below(2) ? 1 : -1};
    arena->used += n;
    arena->most = larger(arena->most, arena->used);
    arena->limb[arena->used - 1] = 1;
    return x;
}

exact cylint_exact_from(cylint_arena *arena, double x)
{
    (void)x;
    return below(16) ? extent(arena, LEAF, LOWEST) : cylint_exact_zero(arena);
}

exact cylint_exact_of_integer(cylint_arena *arena, uint64_t m, int e)
{
    (void)m;
    return extent(arena, 2, (e - (e & 63)) / 64);
}

exact cylint_exact_add(cylint_arena *arena, exact x, exact y)
{
    if (x.sign == 0)
        return y;
    if (y.sign == 0)
        return x;
    const int low = x.exponent < y.exponent ? x.exponent : y.exponent;
    const int xt = x.exponent + x.n, yt = y.exponent + y.n;
    return extent(arena, larger(xt, yt) - low + 1, low);
}

exact cylint_exact_mul(cylint_arena *arena, exact x, exact y)
{
    if (x.sign == 0 || y.sign == 0)
        return cylint_exact_zero(arena);
    return extent(arena, x.n + y.n, x.exponent + y.exponent);
}

exact cylint_exact_difference(cylint_arena *arena, double x, double y)
{
    const int used = arena->used;
    const exact ex = cylint_exact_from(arena, x);
    const exact ey = cylint_exact_from(arena, y);
    return cylint_exact_keep(arena, used, cylint_exact_sub(arena, ex, ey));
}

exact cylint_exact_keep(cylint_arena *arena, int used, exact x)
{
    if (x.n > 0 && x.limb >= arena->limb + used) {
        x.limb = arena->limb + used;
        used += x.n;
        arena->limb[used - 1] = 1;
    }
    arena->used = used;
    return x;
}

double cylint_exact_nearest(exact x, int e)
{
    (void)x;
    (void)e;
    /* candidates for a distance, to be compared; of an angle at most 1 */
    return below(2) ? 1 : 0.75;
}

pair cylint_exact_round(cylint_arena *arena, exact x)
{
    cylint_exact_sub(arena, x, cylint_exact_from(arena, 1));
    return (pair){1, 0};
}

/* A shape of the kind and a line; their numbers have no effect here. */
static void make_question(int kind, int segment, cylint_shape *s,
                          cylint_line *l)
{
    static const double line[6] = {0.3, -5, 0.4, 0.1, 1, 0.2};
    struct family_case c =
        family_example((family_shape)(kind - CYLINT_KIND_CYLINDER));
    c.line_word = segment ? FAMILY_SEGMENT : FAMILY_LINE;
    memcpy(c.line_data, line, sizeof line);
    family_make(&c);
    *l = c.line;
    *s = c.shape;
    s->kind = kind; /* the arithmetic here may have made another */
    s->library.flag[CYLINT_AT_SURFACE] = CYLINT_PART_LATERAL;
}

static void compute_signs(cylint_query *q)
{
    const int round = cylint_is_round(q->kind);
    for (cylint_form f = 0; f < CYLINT_FORMS; f++)
        for (int end = 0; end < 2; end++)
            if (round ? f != FORM_T && f != FORM_RHO0 : f != FORM_END_BALL)
                cylint_form_sign(q, f, end);
}

/* Computes t and writes all members of a hit. */
static void compute_root(cylint_query *q, cylint_root root)
{
    cylint_hit hit;
    double t = 0;
    cylint_root_within(q, root, 1, &t);
    for (int part = CYLINT_PART_LATERAL; part <= CYLINT_PART_CAP1; part++)
        for (int apex = 0; apex < 2; apex++) {
            const cylint_stop at = {root, part, 0, apex};
            cylint_describe_hit(q, &at, CYLINT_WANT_ALL, &hit);
        }
}

/* The largest number of limbs in use in one random question. */
static int limbs_used(int kind, int segment)
{
    cylint_shape s;
    cylint_line l;
    cylint_query q;
    make_question(kind, segment, &s, &l);
    cylint_query_open(&q, &s, &l);
    q.filters = 0; /* nothing is decided before the exact stage */
    if (below(2))
        compute_signs(&q);
    for (cylint_root root = ROOT_ENTRY; root <= ROOT_CAP1; root++)
        if (!cylint_is_round(kind) || root != ROOT_APEX)
            compute_root(&q, root);
    return q.arena.most;
}

/* The same for the distance of a point, from every feature. */
static int limbs_of_distance(int kind, cylint_ends ends)
{
    static const double point[3] = {0.3, -5, 0.4};
    int most = 0;
    cylint_shape s;
    cylint_line l;
    make_question(kind, 0, &s, &l);
    s.ends = (int)ends;
    for (int feature = 0; feature <= CYLINT_FEATURE_APEX; feature++) {
        meridian m;
        cylint_closest answer;
        cylint_load_meridian(&m, &s, point);
        const int used = m.arena->used;
        cylint_nearest_feature(&m);
        CHECK(m.arena->used == used);
        cylint_rounded_distance(&m, feature);
        if (below(2)) /* a point on the axis */
            m.q.sign = 0;
        cylint_nearest_point(&m, feature, CYLINT_WANT_ALL, &answer);
        CHECK(m.arena->used == used);
        most = larger(most, m.arena->most);
    }
    return most;
}

TEST(no_distance_needs_more_than_the_arena)
{
    enum { ROUNDS = 2000 };
    for (int kind = 1; kind <= CYLINT_KIND_HALFSPACE; kind++) {
        int most = 0;
        for (int i = 0; i < ROUNDS && !cylint_is_elliptic(kind); i++) {
            const int planes = cylint_is_round(kind) || below(2);
            const cylint_ends ends =
                planes ? CYLINT_ENDS_CAPPED : CYLINT_ENDS_INFINITE;
            most = larger(most, limbs_of_distance(kind, ends));
        }
        printf("note: kind %d: %d of %d limbs\n", kind, most,
               (int)CYLINT_ARENA_LIMBS);
        CHECK(most <= CYLINT_ARENA_LIMBS);
    }
}

TEST(no_question_needs_more_than_the_arena)
{
    enum { ROUNDS = 2000 };
    for (int kind = 1; kind <= CYLINT_KIND_HALFSPACE; kind++) {
        int most = 0;
        for (int i = 0; i < ROUNDS; i++)
            most = larger(most, limbs_used(kind, i & 1));
        printf("note: kind %d: %d of %d limbs\n", kind, most,
               (int)CYLINT_ARENA_LIMBS);
        CHECK(most > LEAF && most <= CYLINT_ARENA_LIMBS);
    }
}
