/*
 * motion.c - moving shapes and their boxes
 */
#include "motion.h"

#include <float.h>
#include <string.h>

#include "../shapes/shape_facts.h"

int cylint_can_move_into(const cylint_shape *at_0, const cylint_shape *at_1)
{
    return cylint_constructor_kind(at_0) == cylint_constructor_kind(at_1) &&
           at_0->ends == at_1->ends;
}

static double interpolate(double x, double y, double time)
{
    return (1 - time) * x + time * y;
}

static double interpolate_radius(const cylint_shape *at_0,
                                 const cylint_shape *at_1, double time, int end)
{
    return interpolate(cylint_end_factor(at_0, cylint_end_at(at_0, end)),
                       cylint_end_factor(at_1, cylint_end_at(at_1, end)), time);
}

/* The centre of an end, for kinds made of two points. */
static void interpolate_center(double to[3], const cylint_shape *at_0,
                               const cylint_shape *at_1, double time, int end)
{
    for (int i = 0; i < 3; i++)
        to[i] = interpolate(
            cylint_end_center(at_0, cylint_end_at(at_0, end), i),
            cylint_end_center(at_1, cylint_end_at(at_1, end), i), time);
}

static void interpolate3(double to[3], const double x[3], const double y[3],
                         double time)
{
    for (int i = 0; i < 3; i++)
        to[i] = interpolate(x[i], y[i], time);
}

cylint_status cylint_embree_between(const cylint_shape *at_0,
                                    const cylint_shape *at_1, double time,
                                    cylint_shape *shape)
{
    double base[3], top[3], a[3], b[3];
    const cylint_ends ends = (cylint_ends)at_0->ends;
    const double r0 = interpolate_radius(at_0, at_1, time, 0);
    const double r1 = interpolate_radius(at_0, at_1, time, 1);
    if (cylint_has_end_points(at_0->kind)) {
        interpolate_center(base, at_0, at_1, time, 0);
        interpolate_center(top, at_0, at_1, time, 1);
        switch (cylint_constructor_kind(at_0)) {
        case CYLINT_KIND_CONE:
            return cylint_cone(shape, base, r0, top, r1, ends);
        case CYLINT_KIND_SPHERE:
            return cylint_sphere(shape, base, r0, ends);
        default:
            return cylint_round_cone(shape, base, r0, top, r1, ends);
        }
    }
    interpolate3(base, cylint_base(at_0), cylint_base(at_1), time);
    interpolate3(top, cylint_axis(at_0), cylint_axis(at_1), time);
    if (!cylint_is_elliptic(at_0->kind))
        return cylint_tangent_cone(shape, base, top, r1, ends);
    interpolate3(a, cylint_a(at_0), cylint_a(at_1), time);
    interpolate3(b, cylint_b(at_0), cylint_b(at_1), time);
    return cylint_elliptic_cone(shape, base, a, b, top, r1, ends);
}

/* A rounded cone may become a ball on the way; the filter serves spheres alone. */
void cylint_embree_record_between(const cylint_float_filter_shape *at_0,
                                  const cylint_float_filter_shape *at_1,
                                  double time, cylint_float_filter_shape *to)
{
    const int is_sphere = memcmp(at_0->base, at_0->top, sizeof to->base) == 0;
    interpolate3(to->base, at_0->base, at_1->base, time);
    interpolate3(to->top, at_0->top, at_1->top, time);
    to->r0 = interpolate(at_0->r0, at_1->r0, time);
    to->r1 = interpolate(at_0->r1, at_1->r1, time);
    if (!is_sphere && memcmp(to->base, to->top, sizeof to->base) == 0)
        to->r0 = NAN;
}

/*
 * Boxes.  Embree uses (1-t) box_0 + t box_1, which must contain the shape at
 * every t.  A shape is the convex hull of its two discs.  A disc's centre is
 * linear in t.  Along coordinate j the disc reaches f(t) from its centre,
 *
 *   circular: the radius, linear in t; the balls of round shapes likewise;
 *   acone:    0 at v; at v + u the tangent times |u|, the product of a
 *             linear function k and a convex one g, both >= 0;
 *   elliptic: sqrt(a_j^2 + b_j^2), convex; at the top that times k.
 *
 * g is convex, so it is at most its linear interpolation.  k times that is at
 * most the linear interpolation of the products, except if one of k and g grows
 * and the other shrinks: then it may exceed it by t (1-t) |k1-k0| |g1-g0|, at
 * most a quarter of |k1-k0| |g1-g0|, which is added.  So centre + f of each
 * disc, and the larger of the two, are below a linear function.
 */
typedef struct {
    double center[3], k, g[3];
} disc;

static disc disc_of(const cylint_shape *s, int end)
{
    disc d;
    const int cap = cylint_end_at(s, end);
    const double u = sqrt(cylint_axis(s)[0] * cylint_axis(s)[0] +
                          cylint_axis(s)[1] * cylint_axis(s)[1] +
                          cylint_axis(s)[2] * cylint_axis(s)[2]);
    d.k = cylint_end_factor(s, cap);
    for (int j = 0; j < 3; j++) {
        d.center[j] = cylint_end_center(s, cap, j);
        d.g[j] = cylint_is_elliptic(s->kind)
                     ? cylint_elliptic_reach(cylint_a(s), cylint_b(s), j)
                     : cylint_radius_unit(s, u);
    }
    return d;
}

static double reach(const disc *at, const disc *other, int j)
{
    const double dk = at->k - other->k, dg = at->g[j] - other->g[j];
    return at->k * at->g[j] + (dk * dg < 0 ? -dk * dg / 4 : 0);
}

/*
 * Roundings.  The numbers above and those of cylint_embree_between() are doubles
 * with a few roundings each.  Embree stores lower0 and upper0 and their
 * differences to lower1 and upper1, and adds t times these, in floats.  M is the
 * largest of these sizes: the differences are at most 2 M, with errors of 2^-24
 * of that; the product adds as much, the sum half of it.  The sides are moved
 * out by 2^-21 M, more than the total of 5 2^-24 M; the rest covers the doubles
 * and the rounding of M.
 */
void cylint_motion_bounds(const cylint_shape *at_0, const cylint_shape *at_1,
                          int step, cylint_extent *box)
{
    double lo[3], hi[3];
    for (int j = 0; j < 3; j++) {
        double side[2][2] = {{DBL_MAX, -DBL_MAX}, {DBL_MAX, -DBL_MAX}};
        for (int cap = 0; cap < 2; cap++) {
            const disc d[2] = {disc_of(at_0, cap), disc_of(at_1, cap)};
            for (int i = 0; i < 2; i++) {
                const double f = reach(&d[i], &d[1 - i], j);
                side[i][0] = fmin(side[i][0], d[i].center[j] - f);
                side[i][1] = fmax(side[i][1], d[i].center[j] + f);
            }
        }
        const double M = fmax(fmax(fabs(side[0][0]), fabs(side[0][1])),
                              fmax(fabs(side[1][0]), fabs(side[1][1])));
        lo[j] = side[step][0] - 0x1p-21 * M;
        hi[j] = side[step][1] + 0x1p-21 * M;
    }
    *box = cylint_float_box(lo, hi);
}
