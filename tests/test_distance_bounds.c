/*
 * test_distance_bounds.c - floor distance: the errors of the half plane
 *
 * Computes z and rho of half_plane.h, and the distances from the lateral line and
 * from a rim, beside the same from exact numbers, and compares the differences
 * with the bounds of error_bounds.h.
 */
#define CYLINT_NARROW
#include <math.h>

#include "check.h"
#include "distance/exact_distance.h" /* before simd.h */
#include "distance/half_plane.h"
#include "distance/limbs.h"
#include "distance_points.h"
#include "shapes/layout.h"

#if LANES == 2

enum { CASES = 100, POINTS = 4 };

static double most_z, most_rho, most_rim, most_limb_z, most_limb_rho;

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

static double difference(pair x, pair y)
{
    const pair d = pair_sub(normalized(x), y);
    return fabs(d.hi + d.lo);
}

static double compare(double error, double bound, double *most)
{
    const double ratio = bound > 0 ? error / bound : 0;
    *most = fmax(*most, ratio);
    return ratio;
}

static double limbs_off(limbs x, pair y)
{
    return difference(two_sum(x.hi, x.lo), y);
}

static void check_limbs(const struct family_case *c, const double p[3], pair z,
                        pair rho)
{
    upright m;
    double error;
    load_upright(&m, &c->shape, p, 1);
    const limbs root = root_of_limbs(
        square_across(&m), double_root(rough_square_across(&m)), &m, &error);
    const double bound = CYLINT_LIMB_ERROR / CYLINT_LIMB_SNAP * m.snap;
    if (!(error <= 0x1p-53 * m.size)) /* no distance is accepted */
        return;
    if (!CHECK(compare(limbs_off(m.z, z), bound / 4, &most_limb_z) <= 1 &&
               compare(limbs_off(root, rho), error, &most_limb_rho) <= 1)) {
        REPORT_CASE(c);
        REPORT("point %a %a %a: limbs", p[0], p[1], p[2]);
    }
}

static void check_point(const struct family_case *c, const double p[3])
{
    const cylint_shape *s = &c->shape;
    static meridian exactly;
    half_plane m;
    load_half_plane(&m, s, p);
    if (!(m.error < HUGE_VAL) || !(m.size < 0x1p60) || !(m.size > 0x1p-60))
        return;
    cylint_load_meridian(&exactly, s, p);
    cylint_arena *arena = exactly.arena;
    const exact W = exactly.L->vv, h = exactly.height[0];
    const exact hh = cylint_exact_mul(arena, h, h);
    pair z = as_pair(root_of_quotient(hh, W));
    const pair rho = as_pair(root_of_quotient(exactly.q, W));
    if (h.sign < 0)
        z = pair_neg(z);
    check_limbs(c, p, z, rho);
    const double off_z = difference(m.z, z), off_rho = difference(m.rho, rho);
    if (!CHECK(compare(off_z, 0x1p-95 * m.size, &most_z) <= 1 &&
               compare(off_rho, m.error / 4, &most_rho) <= 1)) {
        REPORT_CASE(c);
        REPORT("point %a %a %a: z %g, rho %g", p[0], p[1], p[2], off_z,
               off_rho);
    }
    const nearest rim = {CYLINT_PART_LATERAL, CYLINT_FEATURE_RIM0, 0, 1};
    if (cylint_is_round(s->kind) || !cylint_ends_are_planes(s->ends))
        return;
    exact denominator;
    const surd_sum square =
        cylint_square_of_distance(&exactly, &rim, &denominator);
    const floating v = cylint_surd_sum_value(arena, &square);
    if (v.v.hi == 0)
        return;
    const pair true_rim = as_pair(
        cylint_floating_sqrt(floating_div(v, cylint_floating(denominator))));
    const pair got = length_of(lazy_sub(m.rho, (pair){cylint_r0(s), 0}), m.z);
    if (!(got.hi >= CYLINT_DISTANCE_LEAST)) /* is left to exact numbers */
        return;
    if (!CHECK(compare(difference(got, true_rim), m.error, &most_rim) <= 1)) {
        REPORT_CASE(c);
        REPORT("point %a %a %a: rim", p[0], p[1], p[2]);
    }
}

static void errors_are_below_their_bounds(void)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    for (int f = 0; f < family_count(); f++)
        for (uint64_t i = 0; i < cases; i++) {
            struct family_case c;
            family_case(9, f, i, &c);
            uint64_t stream = i * 64 + (uint64_t)f;
            if (!cylint_prepared(&c.shape) ||
                cylint_is_elliptic(c.shape.kind) ||
                cylint_has_tangent(c.shape.kind) ||
                c.shape.kind == CYLINT_KIND_SPHERE)
                continue;
            for (int k = 0; k < POINTS; k++) {
                double p[3];
                draw_point(&c, &stream, p);
                if (isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]))
                    check_point(&c, p);
            }
        }
    printf("note: largest errors: z %.2g, rho %.2g, rim %.2g; in limbs z %.2g, "
           "rho %.2g of the bounds\n",
           most_z, most_rho, most_rim, most_limb_z, most_limb_rho);
    CHECK(family_count() == 0 || (most_rho > 0 && most_limb_rho > 0));
}

#endif

int main(void)
{
#if LANES == 2
    RUN(errors_are_below_their_bounds);
#endif
    return check_end();
}
