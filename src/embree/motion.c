/*
 * motion.c - moving shapes and their boxes
 */
#include "motion.h"

#include <float.h>

#include "../intersect.h"

int cylint_can_move_into(const cylint_shape *at_0, const cylint_shape *at_1)
{
    return cylint_constructor_kind(at_0) == cylint_constructor_kind(at_1) &&
           at_0->ends == at_1->ends;
}

static void interpolate(double to[], const double x[], const double y[], int n,
                        double time)
{
    for (int i = 0; i < n; i++)
        to[i] = (1 - time) * x[i] + time * y[i];
}

static void interpolate_record(cylint_record *to, const cylint_record *x,
                               const cylint_record *y, double time)
{
    interpolate(to->p0, x->p0, y->p0, 3, time);
    interpolate(to->p1, x->p1, y->p1, 3, time);
    interpolate(&to->r0, &x->r0, &y->r0, 1, time);
    interpolate(&to->r1, &x->r1, &y->r1, 1, time);
}

cylint_status cylint_embree_between(const cylint_shape *at_0,
                                    const cylint_shape *at_1, double time,
                                    cylint_shape *shape)
{
    cylint_record x, y, between;
    cylint_semi_axes x_axes, y_axes, axes;
    cylint_set_record(&x, at_0);
    cylint_set_record(&y, at_1);
    cylint_set_semi_axes(&x_axes, at_0);
    cylint_set_semi_axes(&y_axes, at_1);
    interpolate_record(&between, &x, &y, time);
    interpolate(axes.a, x_axes.a, y_axes.a, 3, time);
    interpolate(axes.b, x_axes.b, y_axes.b, 3, time);
    return cylint_make_of_record(shape, cylint_constructor_kind(at_0),
                                 at_0->ends, &between, &axes);
}

/* A rounded cone may become a ball on the way; the filter serves only balls that
 * stay balls. */
void cylint_embree_record_between(const cylint_record *at_0,
                                  const cylint_record *at_1, double time,
                                  cylint_record *to)
{
    interpolate_record(to, at_0, at_1, time);
    if (!cylint_filter_serves(to) ||
        (cylint_record_is_point(to) &&
         !(cylint_record_is_point(at_0) && cylint_record_is_point(at_1))))
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
cylint_extent cylint_motion_box(const cylint_shape *at_0,
                                const cylint_shape *at_1, int step)
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
    return cylint_float_box(lo, hi);
}
