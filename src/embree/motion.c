/*
 * motion.c - moving shapes and their boxes
 */
#include "motion.h"

#include "../bvh/swept_disc.h"
#include "../intersect.h"

int cylint_can_move_into(const cylint_shape *at_0, const cylint_shape *at_1)
{
    return cylint_constructor_kind(at_0) == cylint_constructor_kind(at_1) &&
           at_0->ends == at_1->ends;
}

/* Of n doubles, the members of a record or of semi-axes. */
static void interpolate(void *to, const void *x, const void *y, size_t n,
                        double time)
{
    const double *at_0 = x, *at_1 = y;
    for (size_t i = 0; i < n; i++)
        ((double *)to)[i] = (1 - time) * at_0[i] + time * at_1[i];
}

enum {
    RECORD = sizeof(cylint_record) / sizeof(double),
    SEMI_AXES = sizeof(cylint_semi_axes) / sizeof(double)
};

cylint_status cylint_embree_between(const cylint_shape *at_0,
                                    const cylint_shape *at_1, double time,
                                    cylint_shape *shape)
{
    cylint_record x, y;
    cylint_semi_axes x_axes, y_axes;
    cylint_set_record(&x, at_0);
    cylint_set_record(&y, at_1);
    cylint_set_semi_axes(&x_axes, at_0);
    cylint_set_semi_axes(&y_axes, at_1);
    interpolate(&x, &x, &y, RECORD, time);
    interpolate(&x_axes, &x_axes, &y_axes, SEMI_AXES, time);
    return cylint_make_of_record(shape, cylint_constructor_kind(at_0),
                                 at_0->ends, &x, &x_axes);
}

/* A rounded cone may become a ball on the way; the filter serves only balls that
 * stay balls. */
void cylint_embree_record_between(const cylint_record *at_0,
                                  const cylint_record *at_1, double time,
                                  cylint_record *to)
{
    interpolate(to, at_0, at_1, RECORD, time);
    if (!cylint_filter_serves(to) ||
        (cylint_record_is_point(to) &&
         !(cylint_record_is_point(at_0) && cylint_record_is_point(at_1))))
        to->r0 = NAN;
}

/*
 * Boxes.  Embree uses (1-t) box_0 + t box_1, which must contain the shape at
 * every t.  A shape is the convex hull of its two discs.  A disc's centre is
 * linear in t.  Along coordinate j the disc reaches at most f(t) from its centre,
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
 * disc is below a linear function, which the boxes contain at t = 0 and 1.
 */

/* The box of the discs of a state, by f; writes g of each coordinate, 1 if f is
 * linear. */
static cylint_extent box_of_discs(const cylint_shape *s, double g[3])
{
    const cylint_view view = cylint_plain_view(s);
    cylint_swept_disc disc;
    cylint_swept_disc_of(&disc, &view, s);
    EACH(j, 3)
        g[j] = disc.elliptic ? cylint_elliptic_reach(disc.a, disc.b, j) : 1;
    const cylint_extent box =
        cylint_piece_box(&disc, g, (cylint_shape_piece){0, 1});
    if (cylint_has_tangent(s->kind))
        g[0] = g[1] = g[2] = disc.length;
    return box;
}

/*
 * Roundings.  Embree stores lower0 and upper0 and their differences to lower1 and
 * upper1, and adds t times these, in floats.  M is the largest of these sizes: the
 * differences are at most 2 M, with errors of 2^-24 of that; the product adds as
 * much, the sum half of it.  The sides are moved out by 2^-21 M, more than the
 * total of 5 2^-24 M; the rest covers doubles, those of cylint_embree_between()
 * too.
 */
cylint_extent cylint_motion_box(const cylint_shape *at_0,
                                const cylint_shape *at_1, int step)
{
    double g[2][3], lo[3], hi[3];
    const cylint_extent box[2] = {box_of_discs(at_0, g[0]),
                                  box_of_discs(at_1, g[1])};
    const double dk = cylint_r1(at_1) - cylint_r1(at_0);
    EACH(j, 3) {
        const double product = dk * (g[1][j] - g[0][j]);
        const double more = product < 0 ? -product / 4 : 0;
        double M = 0;
        EACH(i, 2)
            M = fmax(M, fmax(fabsf(box[i].lower[j]), fabsf(box[i].upper[j])));
        lo[j] = box[step].lower[j] - more - 0x1p-21 * (M + more);
        hi[j] = box[step].upper[j] + more + 0x1p-21 * (M + more);
    }
    return cylint_float_box(lo, hi);
}
