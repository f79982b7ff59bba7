/*
 * swept_disc.c - bounded shapes as swept discs, and the boxes of their slices
 */
#include "swept_disc.h"

/* The points x a + y b, x^2 + y^2 <= 1, reach sqrt((a.v)^2 + (b.v)^2) along a
 * unit vector v.  Across the axis they reach the square root of the larger
 * eigenvalue of the Gram matrix of the components of a and b across it. */
static void set_elliptic_reach(cylint_swept_disc *t, double ww)
{
    double a[3], b[3];
    const double aw = cylint_dot(t->a, t->axis), bw = cylint_dot(t->b, t->axis);
    t->across = t->along =
        sqrt(cylint_dot(t->a, t->a) + cylint_dot(t->b, t->b));
    if (!(ww > CYLINT_LEAST_SQUARE))
        return;
    t->along = sqrt((aw * aw + bw * bw) / ww);
    for (int j = 0; j < 3; j++) {
        a[j] = t->a[j] - aw / ww * t->axis[j];
        b[j] = t->b[j] - bw / ww * t->axis[j];
    }
    const double aa = cylint_dot(a, a), ab = cylint_dot(a, b),
                 bb = cylint_dot(b, b);
    const double difference = aa - bb;
    t->across =
        sqrt((aa + bb + sqrt(difference * difference + 4 * ab * ab)) / 2);
}

/* A single ball: its centre moves by a small part of its radius, because a leaf
 * needs the direction of an axis.  Its z can be that of a round cone of which it is
 * an end, so each slice is the whole ball. */
static void set_one_ball(cylint_swept_disc *t)
{
    t->k[1] = t->k[0];
    t->axis[0] = t->k[0] * 0x1p-10;
    t->axis[1] = t->axis[2] = 0;
    t->length = t->axis[0];
    t->shift = 1;
}

void cylint_swept_disc_of(cylint_swept_disc *t, const cylint_view *view,
                          const cylint_shape *s)
{
    const double scale = view->scale;
    for (int j = 0; j < 3; j++) {
        t->base[j] = (cylint_base(s)[j] - view->center[j]) * scale;
        t->axis[j] = cylint_axis(s)[j] * scale;
    }
    const double ww = cylint_dot(t->axis, t->axis);
    t->length = sqrt(ww);
    t->elliptic = cylint_is_elliptic(s->kind);
    const double unit =
        cylint_has_factors(s->kind) ? cylint_radius_unit(s, t->length) : scale;
    t->k[0] = cylint_r0(s) * unit;
    t->k[1] = cylint_r1(s) * unit;
    t->across = 1;
    t->round = cylint_is_round(s->kind);
    t->along = t->round ? 1 : 0;
    t->ends = s->ends;
    t->solid = s->kind == CYLINT_KIND_CYLINDER && s->ends == CYLINT_ENDS_CAPPED;
    t->shift = t->round ? cylint_section_shift(t->k[0], t->k[1], ww) : 0;
    if (s->kind == CYLINT_KIND_SPHERE)
        set_one_ball(t);
    if (!t->elliptic)
        return;
    for (int j = 0; j < 3; j++) {
        t->a[j] = cylint_a(s)[j] * scale;
        t->b[j] = cylint_b(s)[j] * scale;
    }
    set_elliptic_reach(t, ww);
}

/* A disc perpendicular to the axis w reaches sqrt(1 - w_j^2 / ww) of its
 * radius along coordinate j, computed here without the difference.  Where
 * squares underflow, the result is 1. */
void cylint_swept_disc_reach(const cylint_swept_disc *t, double reach[3])
{
    double square[3];
    for (int j = 0; j < 3; j++)
        square[j] = t->axis[j] * t->axis[j];
    const double ww = square[0] + square[1] + square[2];
    const double per_length = 1 / t->length;
    for (int j = 0; j < 3; j++)
        reach[j] =
            t->elliptic ? sqrt(t->a[j] * t->a[j] + t->b[j] * t->b[j])
            : ww > CYLINT_LEAST_SQUARE
                ? sqrt(square[(j + 1) % 3] + square[(j + 2) % 3]) * per_length
                : 1;
}

static double k_at(const double k[2], double z)
{
    const double inside = cylint_larger(0, cylint_smaller(z, 1));
    return k[0] + (k[1] - k[0]) * inside;
}

/*
 * The lateral part of a round shape at z belongs to the ball at z + s, where s is
 * at most `shift` in size and has one sign for all z.  If all planes of cuts are
 * farther than that from the ends, then they cut the lateral part, which is a
 * cone, and each section is at most as wide as that ball.  Else each slice is
 * bounded as the whole; such a shape is so thick that it is rarely cut.
 */
cylint_slice_hull cylint_slice_hull_of(const cylint_swept_disc *t,
                                       cylint_slice slice)
{
    const double overlap = 0x1p-20, count = slice.count;
    const int is_whole = t->round && !(t->shift * count < 1 - 2 * overlap);
    const int at_end[2] = {is_whole || slice.index == 0,
                           is_whole || slice.index == slice.count - 1};
    cylint_slice_hull h;
    h.z[0] = at_end[0] ? 0 : (slice.index - overlap) / count;
    h.z[1] = at_end[1] ? 1 : (slice.index + 1 + overlap) / count;
    for (int end = 0; end < 2; end++) {
        const double s = at_end[end] ? 0 : t->shift;
        h.is_ball[end] = t->round && at_end[end];
        h.k[end] =
            cylint_larger(k_at(t->k, h.z[end] - s), k_at(t->k, h.z[end] + s));
    }
    return h;
}

/*
 * Each coordinate below is computed with at most 16 roundings of numbers not
 * larger than `size`.  The sides are moved out by 2^-48 of size, and by DBL_MIN
 * for underflow.
 */
cylint_extent cylint_slice_box(const cylint_swept_disc *t,
                               const double reach[3], cylint_slice slice)
{
    const cylint_slice_hull h = cylint_slice_hull_of(t, slice);
    double lo[3], hi[3];
    for (int j = 0; j < 3; j++) {
        const double reach0 = h.is_ball[0] ? 1 : reach[j];
        const double reach1 = h.is_ball[1] ? 1 : reach[j];
        const double size = fabs(t->base[j]) + fabs(t->axis[j]) +
                            (t->k[0] + t->k[1]) * cylint_larger(reach0, reach1);
        const double margin = size * 0x1p-48 + DBL_MIN;
        const double from = t->base[j] + h.z[0] * t->axis[j];
        const double to = t->base[j] + h.z[1] * t->axis[j];
        const double out0 = h.k[0] * reach0 + margin;
        const double out1 = h.k[1] * reach1 + margin;
        /* which end is lower is unpredictable, so there is no branch */
        lo[j] = cylint_smaller(from - out0, to - out1);
        hi[j] = cylint_larger(from + out0, to + out1);
    }
    return cylint_float_box(lo, hi);
}
