/*
 * test_room.c - the arena holds whatever a question may need
 *
 * The library runs here on numbers that are extents only: which limbs a
 * number may have, from the lowest a double can have to the highest, and at
 * each sum one more for a carry.  This file's cylint_exact_* stand in for
 * those of exact.c and take the same room, or more: nothing cancels, nothing
 * is trimmed.  Whichever limbs real numbers have, theirs are among these, so
 * that what is used here is never exceeded.  Signs, on which it depends where
 * the library goes next, are drawn at random.
 */
#include "check.h"
#include "roots/roots.h"

/* A double's limbs (exact.c): of 2^-1074 limb -34, of 2^1023 limb 31, and
 * one above as it is placed. */
enum { LOWEST = -34, LEAF = 67 };

static uint64_t state = 1;

static unsigned below(unsigned n)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(state >> 33) % n;
}

static exact extent(cylint_arena *arena, int n, int exponent)
{
    const exact x = {arena->limb + arena->used, n, exponent, below(2) ? 1 : -1};
    arena->used += n;
    if (arena->used > arena->most)
        arena->most = arena->used;
    return x;
}

static exact zero_extent(const cylint_arena *arena)
{
    return (exact){arena->limb, 0, 0, 0};
}

exact cylint_exact_from(cylint_arena *arena, double x)
{
    (void)x;
    return below(16) ? extent(arena, LEAF, LOWEST) : zero_extent(arena);
}

exact cylint_exact_add(cylint_arena *arena, exact x, exact y)
{
    if (x.sign == 0)
        return y;
    if (y.sign == 0)
        return x;
    const int low = x.exponent < y.exponent ? x.exponent : y.exponent;
    const int xt = x.exponent + x.n, yt = y.exponent + y.n;
    return extent(arena, (xt > yt ? xt : yt) - low + 1, low);
}

exact cylint_exact_mul(cylint_arena *arena, exact x, exact y)
{
    if (x.sign == 0 || y.sign == 0)
        return zero_extent(arena);
    return extent(arena, x.n + y.n, x.exponent + y.exponent);
}

exact cylint_exact_difference(cylint_arena *arena, double x, double y)
{
    const int used = arena->used;
    const exact ex = cylint_exact_from(arena, x);
    const exact ey = cylint_exact_from(arena, y);
    return cylint_exact_keep(arena, used,
                             cylint_exact_add(arena, ex, cylint_exact_neg(ey)));
}

exact cylint_exact_keep(cylint_arena *arena, int used, exact x)
{
    if (x.n > 0 && x.limb >= arena->limb + used) {
        x.limb = arena->limb + used;
        used += x.n;
    }
    arena->used = used;
    return x;
}

double cylint_exact_nearest(exact x, int e)
{
    (void)x;
    (void)e;
    return 1;
}

pair cylint_exact_round(exact x, int *e)
{
    (void)x;
    *e = 0;
    return (pair){1, 0};
}

/* Any shape of a kind, any line: their numbers do not count. */
static void make(int kind, int segment, cylint_shape *s, cylint_line *l)
{
    static const double p[3] = {0, 0, 0}, a[3] = {1, 0, 0}, b[3] = {0, 1, 0},
                        h[3] = {0, 0, 1}, o[3] = {0.3, -5, 0.4},
                        d[3] = {0.1, 1, 0.2};
    switch (kind) {
    case CYLINT_KIND_CYLINDER:
        cylint_cylinder(s, p, h, 1, CYLINT_ENDS_CAPPED);
        break;
    case CYLINT_KIND_CONE:
        cylint_cone(s, p, 1, h, 2, CYLINT_ENDS_CAPPED);
        break;
    case CYLINT_KIND_ACONE:
        cylint_tangent_cone(s, p, h, 1, CYLINT_ENDS_CAPPED);
        break;
    case CYLINT_KIND_ECYLINDER:
        cylint_elliptic_cylinder(s, p, a, b, h, CYLINT_ENDS_CAPPED);
        break;
    default:
        cylint_elliptic_cone(s, p, a, b, h, 2, CYLINT_ENDS_CAPPED);
    }
    if (segment)
        cylint_segment(l, o, d);
    else
        cylint_whole_line(l, o, d);
}

static void ask_signs(cylint_query *q)
{
    for (int cap = 0; cap < 2; cap++) {
        cylint_sign_alpha(q, cap);
        cylint_sign_E(q, cap);
        cylint_sign_N(q, cap);
    }
    cylint_sign_beta(q);
    cylint_sign_det(q);
    cylint_sign_along(q);
    cylint_sign_G(q);
    cylint_sign_A(q);
    cylint_sign_B(q);
    cylint_sign_C(q);
    cylint_sign_T(q);
    cylint_sign_rho0(q);
}

/* t, t against a number, and what else a hit can tell.  A middle between two
 * doubles is made of five numbers. */
static void ask_root(cylint_query *q, cylint_root root)
{
    cylint_hit hit;
    double t = 0, more = 0;
    cylint_root_within(q, root, 1, &t, &more);
    const int used = cylint_exact_mark(q, root);
    const surd in_full = cylint_surd(q, root);
    exact m = cylint_exact_from(&q->arena, 1);
    for (int i = 0; i < 4; i++)
        m = cylint_exact_add(&q->arena, m, cylint_exact_from(&q->arena, 1));
    cylint_sign_at(q, &in_full, m, cylint_exact(q)->one);
    q->arena.used = used;
    for (int part = CYLINT_PART_LATERAL; part <= CYLINT_PART_CAP1; part++)
        for (int apex = 0; apex < 2; apex++)
            cylint_describe_hit(q, root, t, more, 0, part, apex,
                                CYLINT_WANT_ALL, &hit);
}

/* The most limbs in use, in one such question. */
static int limbs_used(int kind, int segment)
{
    cylint_shape s;
    cylint_line l;
    cylint_query q;
    make(kind, segment, &s, &l);
    cylint_query_open(&q, &s, &l);
    q.filters = 0; /* nothing is decided before the exact stage */
    if (below(2))
        ask_signs(&q);
    for (cylint_root root = ROOT_ENTRY; root <= ROOT_CAP1; root++)
        ask_root(&q, root);
    return q.arena.most;
}

static void no_question_needs_more_than_the_arena(void)
{
    enum { KINDS = 5, ROUNDS = 2000 };
    for (int kind = 1; kind <= KINDS; kind++) {
        int most = 0;
        for (int i = 0; i < ROUNDS; i++) {
            const int used = limbs_used(kind, i & 1);
            most = used > most ? used : most;
        }
        printf("note: kind %d: %d of %d limbs\n", kind, most,
               (int)CYLINT_ARENA_LIMBS);
        CHECK(most > LEAF && most <= CYLINT_ARENA_LIMBS);
    }
}

int main(void)
{
    RUN(no_question_needs_more_than_the_arena);
    return check_end();
}
