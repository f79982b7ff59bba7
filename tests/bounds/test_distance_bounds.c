/*
 * test_distance_bounds.c - floor distance: the errors of pairs, heads and tails
 *
 * Computes z and rho with heads and tails and with pairs, and the distance from a
 * rim, beside the same from exact numbers, and compares the differences with the
 * bounds that the kernels use.  Of elliptic kinds the height over a tangent plane
 * and over an end in pairs and in triples, with the bound times the sizes of the
 * terms; and the local coordinates in doubles with the bounds that features depend
 * on.  Both are compared with determinants in triples.  Bounds add up all
 * roundings, so errors are far below them; if an error is a larger share of its
 * bound than here, a term or a factor of the bound is missing.  CYLINT_CASES is the
 * number of elliptic cases of each family, of others a tenth; CYLINT_SEED changes
 * the points.
 */
#define CYLINT_ONE_LANE
#include <math.h>

#include "check.h"
#include "distance/exact_distance.h"
#include "distance/elliptic_pairs.h"
#include "distance/head_tail.h"
#include "distance_points.h"
#include "shapes/layout.h"

enum { CASES = 4000 };

static int is_below(double error, double bound, double *most)
{
    const double ratio = bound > 0 ? error / bound : error > 0 ? HUGE_VAL : 0;
    *most = fmax(*most, ratio);
    return ratio <= 1;
}

/* Calls check() with a point of each prepared shape, elliptic or not; of elliptic
 * ones without the families of extreme sizes. */
static void over_families(int elliptic, uint64_t cases,
                          void check(const struct family_case *c,
                                     const double p[3]))
{
    stream = check_seed();
    EACH_CASE(c, 9, cases) {
        double p[3];
        if (cylint_is_elliptic(c.shape.kind) != elliptic ||
            !cylint_prepared(&c.shape) ||
            (elliptic && (family_is_wild(family) || family_is_scaled(family))))
            continue;
        draw_point(&c, p);
        if (is_finite3(p))
            check(&c, p);
    }
}

/* ------------------------------------------------------- the half plane -- */

static double most_z, most_rho, most_rim, most_head_tail_z, most_head_tail_rho;

/* sqrt(x / y) */
static pair root_of_quotient(cylint_arena *arena, exact x, exact y)
{
    const exact square =
        cylint_exact_mul(arena, cylint_leading(x), cylint_inverse(arena, y));
    return cylint_exact_round(
        arena, square.sign ? cylint_square_root(arena, square) : square);
}

/* |x - y| */
static double from_pair(vpair x, pair y)
{
    const pair d = pair_sub(two_sum(x.hi, x.lo), y);
    return fabs(d.hi + d.lo);
}

static void check_head_tail(const struct family_case *c, const double p[3],
                            pair z, pair rho)
{
    const cylint_shape *const at[1] = {&c->shape};
    shape_lanes s;
    half_plane m;
    head_tail_load_shapes(&s, at);
    head_tail_load(&m, &s, p, 1);
    const vpair root = head_tail_rho(&m);
    if (!(m.error <= 0x1p-53 * m.size)) /* no distance is accepted */
        return;
    if (!CHECK(is_below(from_pair(m.z, z), CYLINT_HEAD_TAIL_ERROR / 4 * m.size,
                        &most_head_tail_z) &&
               is_below(from_pair(root, rho), m.error, &most_head_tail_rho))) {
        REPORT_POINT(c, p);
        REPORT("heads and tails");
    }
}

static void check_half_plane(const struct family_case *c, const double p[3])
{
    const cylint_shape *const at[1] = {&c->shape};
    static meridian exactly;
    shape_lanes s;
    half_plane m;
    if (cylint_has_tangent(c->shape.kind) ||
        c->shape.kind == CYLINT_KIND_SPHERE)
        return;
    pairs_load_shapes(&s, at);
    pairs_load(&m, &s, p, 1);
    pairs_load_rho(&m);
    const vpair got_rho = m.rho;
    if (!(m.error < HUGE_VAL) || !(m.size < 0x1p60) || !(m.size > 0x1p-60))
        return;
    cylint_load_meridian(&exactly, &c->shape, p);
    cylint_arena *arena = exactly.arena;
    const exact W = exactly.L->vv, h = exactly.height[0];
    const exact hh = cylint_exact_mul(arena, h, h);
    pair z = root_of_quotient(arena, hh, W);
    const pair rho = root_of_quotient(arena, exactly.q, W);
    if (h.sign < 0)
        z = pair_neg(z);
    if (rho.hi != 0 && rho.hi < CYLINT_DISTANCE_LEAST) /* is left to them */
        return;
    check_head_tail(c, p, z, rho);
    const double off_z = from_pair(m.z, z), off_rho = from_pair(got_rho, rho);
    /* The comparison itself errs by 2^-100 of rho. */
    if (!CHECK(is_below(off_z, m.z_error + 0x1p-101 * fabs(z.hi), &most_z) &&
               is_below(off_rho, m.rho_error + 0x1p-100 * rho.hi, &most_rho))) {
        REPORT_POINT(c, p);
        REPORT("z %g, rho %g", off_z, off_rho);
    }
    if (cylint_is_round(c->shape.kind) ||
        !cylint_ends_are_planes(c->shape.ends))
        return;
    const surd_quotient square =
        cylint_square_of_distance(&exactly, CYLINT_FEATURE_RIM0);
    const pair true_rim = root_of_quotient(
        arena, cylint_value_at(&exactly.query, &square.t, square.a, square.b),
        square.d);
    const bounded_pairs got = pairs_length(vpair_sub(got_rho, s.r[0]), m.z, &m);
    if (!(got.v.hi >= CYLINT_DISTANCE_LEAST)) /* is left to exact numbers */
        return;
    if (!CHECK(is_below(from_pair(got.v, true_rim), got.e, &most_rim))) {
        REPORT_POINT(c, p);
        REPORT("rim");
    }
}

TEST(errors_of_the_half_plane_are_below_their_bounds)
{
    over_families(0, check_setting("CYLINT_CASES", CASES) / 10,
                  check_half_plane);
    printf("note: largest errors: z %.2g, rho %.2g, rim %.2g; with heads and "
           "tails z %.2g, rho %.2g of the bounds\n",
           most_z, most_rho, most_rim, most_head_tail_z, most_head_tail_rho);
    CHECK(most_z < 0x1p-7 && most_rho < 0x1p-6 && most_rim < 0x1p-10);
    CHECK(most_head_tail_z < 0x1p-3 && most_head_tail_rho < 0x1p-4);
    CHECK(most_rho > 0 && most_head_tail_rho > 0);
}

/* ------------------------------------------------------- elliptic kinds -- */

static double most_in_pairs, most_in_triples, most_in_doubles;

/* x, y, z and rho of a point times the volume a.(b x h), and the volume. */
struct determinants {
    triple x, y, z, rho, volume;
};

/* D.(u x v) */
static triple determinant(const triple D[3], const double u[3],
                          const double v[3])
{
    triple x[3];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        x[i] = triple_sub(triple_of_pair(two_prod(u[j], v[k])),
                          triple_of_pair(two_prod(u[k], v[j])));
    }
    return triple_dot(D, x);
}

static struct determinants load_determinants(const cylint_shape *s,
                                             const double point[3])
{
    const double *a = cylint_a(s), *b = cylint_b(s), *h = cylint_axis(s);
    const triple k1 = triple_of_pair(two_diff(cylint_r1(s), 1));
    triple D[3], A[3];
    struct determinants to;
    load_difference(D, point, cylint_base(s));
    for (int i = 0; i < 3; i++)
        A[i] = triple_of(a[i]);
    to.x = determinant(D, b, h);
    to.y = determinant(D, h, a);
    to.z = determinant(D, a, b);
    to.volume = determinant(A, b, h);
    to.rho = triple_add(to.volume, triple_mul(k1, to.z));
    return to;
}

/* cos x + sin y - rho of an angle, whose length is brought to 1 in triples. */
static triple height_of(const struct determinants *t, const direction_pair *e)
{
    const triple c = triple_of_pair(e->cos.v), d = triple_of_pair(e->sin.v);
    const triple more = triple_sub(triple_mul2(c, c, d, d), triple_of(1));
    const triple turned = triple_mul2(c, t->x, d, t->y);
    const triple less = triple_times(turned, -0.5 * triple_value(more));
    return triple_sub(triple_add(turned, less), t->rho);
}

/* |x - y| */
static double from_triple(triple x, triple y)
{
    return fabs(triple_value(triple_sub(x, y)));
}

/* A form in pairs and in triples. */
static int is_exact(sized x, triple in_triples, triple y)
{
    const triple in_pairs = triple_add(triple_of(x.v.hi), triple_of(x.v.lo));
    return is_below(from_triple(in_pairs, y), CYLINT_SIZED_ERROR * x.size,
                    &most_in_pairs) &&
           is_below(from_triple(in_triples, y), CYLINT_CLOSE_ERROR * x.size,
                    &most_in_triples);
}

/* The error of x as the quotient of y and the volume. */
static double off_by(double x, triple y, triple volume)
{
    const triple d = triple_sub(triple_times(volume, x), y);
    return fabs(triple_value(d) / triple_value(volume));
}

static void check_place(const struct determinants *t, const elliptic_place *p)
{
    const double off = off_by(p->x, t->x, t->volume) +
                       off_by(p->y, t->y, t->volume) +
                       off_by(p->rho, t->rho, t->volume);
    CHECK(is_below(off, p->error, &most_in_doubles));
    CHECK(
        is_below(off_by(p->z, t->z, t->volume), p->z_error, &most_in_doubles));
}

/* The normal changes by a turn of 2^-20 by no more than the mean of the bounds
 * before and after, but for terms of second order. */
static void check_turned_normal(const cylint_shape *s, const sized D[3],
                                const ruling_in_pairs *before, double angle)
{
    const double turn = 0x1p-20;
    double least[3], most[3];
    ruling_in_pairs after;
    const direction_pair at = direction_of((vpair){cos(angle + turn), 0},
                                           (vpair){sin(angle + turn), 0});
    load_ruling_in_pairs(&after, s, D, 1, &at);
    change_of_normal(least, before, s, turn);
    change_of_normal(most, &after, s, turn);
    for (int i = 0; i < 3; i++) {
        const sized off =
            sized_difference(after.normal.N[i], before->normal.N[i]);
        CHECK(fabs(rounded(off.v)) <=
              0.5001 * (least[i] + most[i]) + CYLINT_SIZED_ERROR * off.size);
    }
}

static void check_elliptic(const struct family_case *c, const double point[3])
{
    const cylint_shape *s = &c->shape;
    elliptic_place p;
    ruling_in_pairs in_pairs;
    normal_in_pairs of_caps;
    sized D[3];
    if (cylint_largest(point) > CYLINT_FAR) /* a hit can overflow */
        return;
    const struct determinants t = load_determinants(s, point);
    locate(&p, s, point, CYLINT_ELLIPTIC_ERROR);
    check_place(&t, &p);
    const double turn = between(0, 6.283185307179586);
    const direction_pair at =
        direction_of((vpair){cos(turn), 0}, (vpair){sin(turn), 0});
    load_pairs_from_axis(D, s, point, sized_double(0));
    load_ruling_in_pairs(&in_pairs, s, D, 1, &at);
    CHECK(is_exact(sized_dot(in_pairs.R, in_pairs.normal.N),
                   height_in_triples(s, point, &at), height_of(&t, &at)));
    check_turned_normal(s, D, &in_pairs, turn);
    load_normal_of_caps(&of_caps, s);
    for (int end = 0; end < 2; end++) {
        load_pairs_from_axis(D, s, point, sized_double(end));
        CHECK(is_exact(sized_dot(D, of_caps.N), height_over_end(s, point, end),
                       end ? triple_sub(t.z, t.volume) : t.z));
    }
}

TEST(errors_of_elliptic_kinds_are_below_their_bounds)
{
    over_families(1, check_setting("CYLINT_CASES", CASES), check_elliptic);
    printf("note: the largest error is %.2g of its bound in pairs, %.2g in "
           "triples, %.2g in doubles\n",
           most_in_pairs, most_in_triples, most_in_doubles);
    CHECK(most_in_pairs > 0x1p-13 && most_in_triples > 0x1p-15 &&
          most_in_doubles > 0x1p-13);
    CHECK(most_in_pairs < 0x1p-7 && most_in_triples < 0x1p-11 &&
          most_in_doubles < 0x1p-2);
}
