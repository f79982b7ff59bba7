/*
 * test_distance_bounds.c - floor distance: the errors of the half plane
 *
 * Computes z and rho with heads and tails and with pairs, and the distance from a
 * rim, beside the same from exact numbers, and compares the differences with the
 * bounds that the kernels use.
 */
#define CYLINT_ONE_LANE
#include <math.h>

#include "check.h"
#include "distance/exact_distance.h"
#include "distance/head_tail.h"
#include "distance_points.h"
#include "shapes/layout.h"

enum { CASES = 100, POINTS = 4 };

static double most_z, most_rho, most_rim, most_head_tail_z, most_head_tail_rho;

static pair as_pair(floating x)
{
    return (pair){cylint_scaled(x.v.hi, x.e), cylint_scaled(x.v.lo, x.e)};
}

static floating root_of_quotient(exact x, exact y)
{
    const floating zero = {{0, 0}, 0};
    return x.sign == 0 ? zero
                       : cylint_floating_sqrt(floating_div(cylint_floating(x),
                                                           cylint_floating(y)));
}

static double difference(vpair x, pair y)
{
    const pair d = pair_sub(two_sum(x.hi, x.lo), y);
    return fabs(d.hi + d.lo);
}

static int is_below(double error, double bound, double *most)
{
    const double ratio = bound > 0 ? error / bound : error > 0 ? HUGE_VAL : 0;
    *most = fmax(*most, ratio);
    return ratio <= 1;
}

static void check_head_tail(const struct family_case *c, const double p[3],
                            pair z, pair rho)
{
    const cylint_shape *const at[1] = {&c->shape};
    shape_lanes s;
    half_plane m;
    head_tail_load_shapes(&s, at);
    head_tail_load(&m, &s, p, 1);
    m.error = 0;
    const vpair root = head_tail_rho(&m);
    if (!(m.error <= 0x1p-53 * m.size)) /* no distance is accepted */
        return;
    if (!CHECK(is_below(difference(m.z, z), CYLINT_HEAD_TAIL_ERROR / 4 * m.size,
                        &most_head_tail_z) &&
               is_below(difference(root, rho), m.error, &most_head_tail_rho))) {
        REPORT_POINT(c, p);
        REPORT("heads and tails");
    }
}

static void check_point(const struct family_case *c, const double p[3])
{
    const cylint_shape *const at[1] = {&c->shape};
    static meridian exactly;
    shape_lanes s;
    half_plane m;
    pairs_load_shapes(&s, at);
    pairs_load(&m, &s, p, 1);
    const vpair got_rho = pairs_rho(&m);
    if (!(m.error < HUGE_VAL) || !(m.size < 0x1p60) || !(m.size > 0x1p-60))
        return;
    cylint_load_meridian(&exactly, &c->shape, p);
    cylint_arena *arena = exactly.arena;
    const exact W = exactly.L->vv, h = exactly.height[0];
    const exact hh = cylint_exact_mul(arena, h, h);
    pair z = as_pair(root_of_quotient(hh, W));
    const pair rho = as_pair(root_of_quotient(exactly.q, W));
    if (h.sign < 0)
        z = pair_neg(z);
    if (rho.hi != 0 && rho.hi < CYLINT_DISTANCE_LEAST) /* is left to them */
        return;
    check_head_tail(c, p, z, rho);
    const double off_z = difference(m.z, z), off_rho = difference(got_rho, rho);
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
    const floating v = cylint_surd_quotient_value(arena, &square);
    if (v.v.hi == 0)
        return;
    const pair true_rim = as_pair(cylint_floating_sqrt(v));
    double error = m.error;
    const vpair got = pairs_length(vpair_sub(got_rho, s.r[0]), m.z, &m, &error);
    if (!(got.hi >= CYLINT_DISTANCE_LEAST)) /* is left to exact numbers */
        return;
    if (!CHECK(is_below(difference(got, true_rim), error, &most_rim))) {
        REPORT_POINT(c, p);
        REPORT("rim");
    }
}

TEST(errors_are_below_their_bounds)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    EACH_CASE(c, 9, cases) {
        stream = number * 64 + (uint64_t)family;
        if (!cylint_prepared(&c.shape) || cylint_is_elliptic(c.shape.kind) ||
            cylint_has_tangent(c.shape.kind) ||
            c.shape.kind == CYLINT_KIND_SPHERE)
            continue;
        for (int k = 0; k < POINTS; k++) {
            double p[3];
            draw_point(&c, p);
            if (is_finite3(p))
                check_point(&c, p);
        }
    }
    printf("note: largest errors: z %.2g, rho %.2g, rim %.2g; with heads and "
           "tails z %.2g, rho %.2g of the bounds\n",
           most_z, most_rho, most_rim, most_head_tail_z, most_head_tail_rho);
    CHECK(most_rho > 0 && most_head_tail_rho > 0);
}
